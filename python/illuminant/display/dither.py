"""Dither: fewer codes than the eye can count, without steps (book 5.1.4, figure 5.12).

The formulas are in the core (`crates/display/src/dither`). A dither comes last, after the transfer function and at
the depth of the display.

| name | where the error goes | source |
| --- | --- | --- |
| `none` | nowhere: the nearest code | – |
| `random` | a threshold of its own for every pixel and channel | book 5.1.4 |
| `ordered-2`, `ordered-4` | the book's tiles | Limb 1969; Jarvis, Judice and Ninke 1976 |
| `bayer-2` … `bayer-64` | recursive tiles | Bayer 1973 |
| `blue-noise` | a tile without low frequencies | Ulichney 1993 |
| `floyd-steinberg` | 7, 3, 5 and 1 sixteenths to the neighbours that come later | Floyd and Steinberg 1976 |
| `floyd-steinberg-book` | 3/8 right, 3/8 below, 1/4 below right | book 5.1.4 (ERRATA 58) |
| `floyd-steinberg-serpentine` | the same as the first, every other row backwards | Ulichney 1987 |
| `dot-diffusion`, `dot-diffusion-4` | to neighbours of a higher class, in cells of 8 × 8 or 4 × 4 | Knuth 1987 |

Example:
    >>> import numpy as np
    >>> from illuminant.display import dither
    >>> field = np.full((8, 8, 3), 5.5 / 255, np.float32)
    >>> float(dither.quantise(field, 8, "ordered-2").mean())
    5.5
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Codes = NDArray[np.uint8] | NDArray[np.uint16]

__all__ = ["check", "names", "quantise"]


def names() -> list[str]:
    """The names of the dithers."""
    return [str(name) for name in core().dithers()]


def check(name: str) -> None:
    """Refuse a name that no dither has.

    Raises:
        UsageError: the sentence lists those there are.
    """
    if name.casefold() not in names():
        raise UsageError(f"There is no dither {name!r}: known are {', '.join(names())}.")


def quantise(values: ArrayLike, bits: int = 8, name: str = "none", seed: int = 0) -> Codes:
    """Codes of values from 0 to 1.

    Args:
        values: (h, w, c) with c from 1 to 4, float32 or float64; values outside 0 to 1 are taken to the nearer end,
            NaN to 0.
        bits: 1 to 16.
        name: one of `names()`.
        seed: of `random`.

    Returns:
        (h, w, c), uint8 up to 8 bits and uint16 above, from 0 to 2^bits − 1.

    Raises:
        UsageError: no such dither, or the array or the number of bits is not possible.
    """
    import numpy as np

    array: Any = np.asarray(values)
    if array.dtype not in (np.float32, np.float64):
        array = array.astype(np.float64)
    check(name)
    if array.ndim != 3 or array.size == 0:
        raise UsageError(f"Values to be dithered are an array (height, width, channels), not {array.shape}.")
    try:
        codes: Codes = core().dither(np.ascontiguousarray(array), bits, name.casefold(), seed)
    except (ValueError, OverflowError) as error:
        raise UsageError(f"{str(error)[:1].upper()}{str(error)[1:].rstrip('.')}.") from error
    return codes
