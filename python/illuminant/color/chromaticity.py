"""Chromaticities: what is left of a colour when its size is taken away.

- x = X/(X + Y + Z), y = Y/(X + Y + Z) (CIE 1931), kept with Y;
- u′ = 4X/(X + 15Y + 3Z), v′ = 9Y/(X + 15Y + 3Z) (CIE 1976), kept with Y;
- L/(L + M + H) and so on, the projection onto the plane of sum 1 for any three primaries (book figure 3.6).

Black has no chromaticity: its x, y, u′ and v′ are given as 0, and lead back to black. Shapes, types and `out` are as
`illuminant.color.triples` says.

Example:
    >>> xyz_to_xyy([0.9505, 1.0, 1.0891]).round(4).tolist()
    [0.3127, 0.329, 1.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.color.triples import converted, step

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["chromaticity", "uvy_to_xyz", "xyy_to_xyz", "xyz_to_uvy", "xyz_to_xyy"]


def xyz_to_xyy(xyz: ArrayLike, *, out: Array | None = None) -> Array:
    """x, y and Y of XYZ (..., 3).

    Example:
        >>> xyz_to_xyy([0.5, 1.0, 0.5]).tolist()
        [0.25, 0.5, 1.0]
    """
    return converted([step("named", "xyz_to_xyy")], xyz, out)


def xyy_to_xyz(xyy: ArrayLike, *, out: Array | None = None) -> Array:
    """XYZ of x, y and Y (..., 3); where y is 0, X and Z are 0.

    Example:
        >>> xyy_to_xyz([0.25, 0.5, 1.0]).tolist()
        [0.5, 1.0, 0.5]
    """
    return converted([step("named", "xyy_to_xyz")], xyy, out)


def xyz_to_uvy(xyz: ArrayLike, *, out: Array | None = None) -> Array:
    """u′, v′ and Y of XYZ (..., 3).

    Example:
        >>> xyz_to_uvy([0.9505, 1.0, 1.0891]).round(4).tolist()
        [0.1978, 0.4683, 1.0]
    """
    return converted([step("named", "xyz_to_uvy")], xyz, out)


def uvy_to_xyz(uvy: ArrayLike, *, out: Array | None = None) -> Array:
    """XYZ of u′, v′ and Y (..., 3); where v′ is 0, X and Z are 0.

    Example:
        >>> uvy_to_xyz(xyz_to_uvy([0.2, 0.3, 0.4])).round(12).tolist()
        [0.2, 0.3, 0.4]
    """
    return converted([step("named", "uvy_to_xyz")], uvy, out)


def chromaticity(amounts: ArrayLike, *, out: Array | None = None) -> Array:
    """Amounts (..., 3) of any three primaries, divided by their sum (book figure 3.6).

    Where the sum is 0 there is no such point: infinities, or NaN for black.

    Example:
        >>> chromaticity([3.0, -1.0, 2.0]).tolist()
        [0.75, -0.25, 0.5]
    """
    return converted([step("named", "project")], amounts, out)
