"""CIE 1976 L*a*b* and L*u*v*, and back.

| form | L* | cube roots of a* and b* |
| --- | --- | --- |
| "CIE" (ISO/CIE 11664-4 and -5) | 116 (Y/Y_w)^⅓ − 16, and 903.3 Y/Y_w below 0.008856 | straight below 0.008856 too |
| "book" (eqs 3.4, 3.5, for 1 ≤ Y ≤ 100) | 25 (100 Y/Y_w)^⅓ − 16: the white 100.04, black −16 | down to black |

a* = 500 (f(X/X_w) − f(Y/Y_w)), b* = 200 (f(Y/Y_w) − f(Z/Z_w)); u* = 13 L* (u′ − u′_w), v* = 13 L* (v′ − v′_w).

The white is given as `illuminant.color.white_xyz` takes it; when it is a name or x and y, XYZ is relative, with
Y = 1 for the white. Shapes, types and `out` are as `illuminant.color.triples` says. The cube root has a relative error
below 3 × 10⁻¹⁶ in float64 and 2 × 10⁻⁷ in float32. Negative XYZ has no meaning, and goes through by the same formula.

Example:
    >>> xyz_to_lab([0.5, 0.5, 0.5], "D65").round(2).tolist()
    [76.07, 6.78, 4.45]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from illuminant.color.triples import converted, step
from illuminant.color.whites import White, white_xyz

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Form", "lab_to_xyz", "luv_to_xyz", "xyz_to_lab", "xyz_to_luv"]

Form = Literal["CIE", "book"]
"""Which definition of L* is meant."""


def xyz_to_lab(
    xyz: ArrayLike, white: White = "D65", *, form: Form = "CIE", out: Array | None = None
) -> Array:
    """L*a*b* of XYZ (..., 3) beside a white (book eq 3.4).

    Raises:
        UsageError: white or form are not known.

    Example:
        >>> xyz_to_lab([0.2, 0.2, 0.2], (1.0, 1.0, 1.0)).round(3).tolist()
        [51.837, 0.0, 0.0]
    """
    return converted([step("xyz_to_lab", white_xyz(white), form)], xyz, out)


def lab_to_xyz(
    lab: ArrayLike, white: White = "D65", *, form: Form = "CIE", out: Array | None = None
) -> Array:
    """XYZ of L*a*b* (..., 3): the inverse of `xyz_to_lab`.

    Example:
        >>> lab_to_xyz([100.0, 0.0, 0.0], (0.95, 1.0, 1.09)).round(12).tolist()
        [0.95, 1.0, 1.09]
    """
    return converted([step("lab_to_xyz", white_xyz(white), form)], lab, out)


def xyz_to_luv(
    xyz: ArrayLike, white: White = "D65", *, form: Form = "CIE", out: Array | None = None
) -> Array:
    """L*u*v* of XYZ (..., 3) beside a white (book eq 3.5). Black has u* = v* = 0.

    Raises:
        UsageError: white or form are not known.

    Example:
        >>> float(xyz_to_luv([0.0, 0.0, 0.0], form="book")[0])
        -16.0
    """
    return converted([step("xyz_to_luv", white_xyz(white), form)], xyz, out)


def luv_to_xyz(
    luv: ArrayLike, white: White = "D65", *, form: Form = "CIE", out: Array | None = None
) -> Array:
    """XYZ of L*u*v* (..., 3): the inverse of `xyz_to_luv`. At L* = 0 the chromaticity is taken as the white's.

    Example:
        >>> luv_to_xyz(xyz_to_luv([0.3, 0.2, 0.1])).round(12).tolist()
        [0.3, 0.2, 0.1]
    """
    return converted([step("luv_to_xyz", white_xyz(white), form)], luv, out)
