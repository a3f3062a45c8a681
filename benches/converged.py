"""Converged images: rendered once, kept in the temporary folder, and the common one from which bias is measured.

A converged image is keyed by scene, renderer, options and number of samples, and takes a seed of its own
(`SEED`), so that no measured image shares its paths.

The common reference, `compare_mitsuba.py --reference 1nm`, is an image by illuminant at every nm. That costs
about 13 times an image of 32 wavelengths, so its noise is taken from a cheaper sampling, the carrier:

    R = C(N samples) + (F(n samples) - C(n samples)),    n << N

with F the reference's sampling and C the carrier's. Every sampling of illuminant follows the same paths for the
same seed, so F and C of the same n samples differ by their wavelengths alone: their difference has hardly any
noise, and the mean of R is that of F, whatever the error of the carrier (two levels of the multilevel Monte Carlo
method: Heinrich 2001). `--carrier` with the reference's own name takes F(N samples) alone.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

from renderer_process import RendererProcess

CACHE = Path(tempfile.gettempdir()) / "illuminant-benches"
SEED = 987_654


def converged(name: str, key: str, process: RendererProcess, samples: int) -> np.ndarray:
    """The image (h, w, 3) of that renderer with that many samples: kept, or rendered and then kept."""
    CACHE.mkdir(exist_ok=True)
    digest = hashlib.sha256(f"{key} {samples} {SEED}".encode()).hexdigest()[:24]
    kept = CACHE / f"{digest}.npy"
    if not kept.exists():
        print(f"converged image of {name}, {samples} samples ...", file=sys.stderr, flush=True)
        # Written beside and renamed, so that a file of that name is always whole.
        partial = CACHE / f"{digest}.{os.getpid()}.npy"
        process.render(seed=SEED, samples=samples, output=partial)
        partial.rename(kept)
    image: np.ndarray = np.load(kept)
    return image


def corrected(carrier: np.ndarray, few_reference: np.ndarray, few_carrier: np.ndarray) -> np.ndarray:
    """R = C(N) + (F(n) - C(n)), see the top of this file.

    >>> corrected(np.array([2.0]), np.array([1.5]), np.array([1.0])).tolist()
    [2.5]
    """
    return carrier + (few_reference - few_carrier)
