"""Two ways to store an image for a monitor (book figure 5.1, 5.1.2).

| way | file | at display |
| --- | --- | --- |
| correction before storage | `store_corrected`: v = I^(1/γ), then whole numbers | nothing: codes go out as they are |
| correction at display | `store_linear`: whole numbers of I itself | a table of eq 5.1: `show_through_table` |

The second was common, and loses levels where eyes see best: between dark steps of the file lie codes of the display
that no pixel can have. `light` is what the monitor makes of the codes that reach it.

Intensities are relative, 0 to 1, of any shape; what lies outside is clamped. Bits are 1 to 16.

Example:
    >>> dark = [0.010, 0.011, 0.012, 0.013]
    >>> store_corrected(dark, 8, 2.2).tolist()
    [31, 33, 34, 35]
    >>> show_through_table(store_linear(dark, 8), correction_table(2.2)).tolist()
    [34, 34, 34, 34]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.display.gamma.lookup_table import (
    LookupTable,
    Rounding,
    correction_table,
    quantised,
    top_code,
)
from illuminant.display.gamma.response import Curve, correction, response

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Codes = NDArray[np.unsignedinteger[Any]]
    Float64 = NDArray[np.float64]

__all__ = [
    "WAYS",
    "at_display",
    "before_storage",
    "light",
    "show_through_table",
    "store_corrected",
    "store_linear",
]

WAYS = ("before storage", "at display")
"""Where the correction is done, in the words of figure 5.7."""


def store_corrected(
    linear: ArrayLike, bits: int = 8, gamma: Curve = 2.2, rounding: Rounding = "nearest"
) -> Codes:
    """Codes of a file whose intensities are corrected before they become whole numbers.

    Args:
        linear: intensities 0 to 1, of any shape.
        bits: of the file.
        gamma: γ of the monitor, or the name of a curve.
        rounding: "nearest" or "truncate".

    Raises:
        UsageError: an argument is not possible.
    """
    return quantised(correction(linear, gamma), bits, rounding)


def store_linear(linear: ArrayLike, bits: int = 8, rounding: Rounding = "nearest") -> Codes:
    """Codes of a file that holds intensities as they are; arguments as `store_corrected`."""
    return quantised(linear, bits, rounding)


def show_through_table(codes: ArrayLike, table: LookupTable) -> Codes:
    """Codes that reach the monitor when those of a file go through a table.

    Raises:
        UsageError: a code is no whole number or too large for the table.
    """
    return table(codes)


def light(codes: ArrayLike, bits: int = 8, gamma: Curve = 2.2) -> Float64:
    """Intensities that a monitor shows of codes, 0 to 1.

    Example:
        >>> light([0, 128, 255], 8, 2.0).round(3).tolist()
        [0.0, 0.252, 1.0]
    """
    import numpy as np

    return response(np.asarray(codes, np.float64) / top_code(bits), gamma)


def before_storage(
    linear: ArrayLike, bits: int = 8, gamma: Curve = 2.2, rounding: Rounding = "nearest"
) -> Float64:
    """Intensities that a monitor shows of a file that was corrected before storage.

    Example:
        >>> before_storage([0.0, 0.01, 1.0], 8).round(4).tolist()
        [0.0, 0.0097, 1.0]
    """
    return light(store_corrected(linear, bits, gamma, rounding), bits, gamma)


def at_display(
    linear: ArrayLike,
    bits: int = 8,
    gamma: Curve = 2.2,
    rounding: Rounding = "nearest",
    *,
    display_bits: int | None = None,
) -> Float64:
    """Intensities that a monitor shows of a linear file through a table.

    Args:
        linear: intensities 0 to 1, of any shape.
        bits: of the file.
        gamma: γ of the monitor, or the name of a curve.
        rounding: of the file and of the table.
        display_bits: of the table's entries; None: those of the file.

    Example:
        >>> at_display([0.0, 0.01, 1.0], 8).round(4).tolist()
        [0.0, 0.0119, 1.0]
    """
    shown_bits = bits if display_bits is None else display_bits
    table = correction_table(gamma, bits, shown_bits, rounding)
    return light(show_through_table(store_linear(linear, bits, rounding), table), shown_bits, gamma)
