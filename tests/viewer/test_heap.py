"""What is freed goes back to the system."""

import os
from pathlib import Path

import numpy as np
import pytest

from illuminant.viewer import heap


def resident_mb() -> float:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


@pytest.mark.skipif(heap._glibc() is None or not Path("/proc/self/statm").exists(), reason="needs glibc")
def test_small_blocks_that_live_on_hold_no_memory_that_is_free():
    heap.large_blocks_apart()
    heap.give_back(0.0)  # what earlier tests have left free would be filled first
    before = resident_mb()
    kept, large = [], []
    for _ in range(2000):
        large.append(np.ones(100_000 // 8))  # smaller than what is mapped by itself
        kept.append(np.ones(40))
    full = resident_mb()
    assert full - before > 150.0
    large.clear()
    heap.give_back(0.0)
    assert resident_mb() < before + 0.3 * (full - before)
    assert len(kept) == 2000
