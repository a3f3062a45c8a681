"""Memory that was freed goes back to the system: a viewer makes and drops large arrays for hours.

glibc keeps freed memory for the next request. It serves blocks of up to 32 MB from heaps as soon as blocks of that size
have been freed, and each of many threads has a heap of its own; small blocks that live on then hold whole pictures that
are gone. In ten minutes of a viewer's use that was 300 MB, while 60 MB were in use. So blocks of more than
`LARGE_BYTES` come from the system and return to it one by one, and what is free in the heaps is given back
now and then. With another C library nothing is done.

Example:
    >>> give_back()
"""

from __future__ import annotations

import ctypes
import threading
import time
from typing import Any

__all__ = ["LARGE_BYTES", "PAUSE_S", "give_back", "large_blocks_apart"]

LARGE_BYTES = 1 << 20
"""From this size on a block is mapped by itself; to map one costs some microseconds, and its pages are zeroed."""

PAUSE_S = 5.0
"""Between two times that heaps are given back: it takes some milliseconds."""

_M_MMAP_THRESHOLD = -3  # malloc.h of glibc

_lock = threading.Lock()
_last = float("-inf")


def large_blocks_apart() -> None:
    """From now on take large blocks of this process from the system one by one."""
    library = _glibc()
    if library is not None:
        library.mallopt(_M_MMAP_THRESHOLD, LARGE_BYTES)


def give_back(pause: float = PAUSE_S) -> None:
    """Give what is free in the heaps back to the system.

    Args:
        pause: nothing is done if this was done less than so many seconds ago.
    """
    global _last
    with _lock:
        now = time.monotonic()
        if now - _last < pause:
            return
        _last = now
    library = _glibc()
    if library is not None:
        library.malloc_trim(0)


def _glibc() -> Any:
    """The C library of this process, if it has these calls."""
    library = ctypes.CDLL(None)
    return library if hasattr(library, "malloc_trim") and hasattr(library, "mallopt") else None
