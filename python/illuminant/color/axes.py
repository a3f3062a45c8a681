"""Linear spaces with other axes: Y_t I Q of NTSC video, and Meyer's A C₁ C₂.

- Y_t I Q (book eqs 5.2 and 5.3): the rounded matrices of the standard, eq 5.2 with 0.114 for the printed 0.144 and
  −0.523 for −0.528 (ERRATA 13, 14). There and back is good to 3 × 10⁻⁴ only, since both are rounded.
- A C₁ C₂ (book eq 3.6, Meyer): axes along which tristimulus values vary most; the inverse is exact.

Shapes, types and `out` are as `illuminant.color.triples` says.

Example:
    >>> (rgb_to_yiq([1.0, 1.0, 1.0]).round(12) + 0.0).tolist()
    [1.0, 0.0, 0.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.color.triples import converted, step

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["ac1c2_to_xyz", "monochrome", "rgb_to_yiq", "xyz_to_ac1c2", "yiq_to_rgb"]


def rgb_to_yiq(rgb: ArrayLike, *, out: Array | None = None) -> Array:
    """Y_t, I and Q of RGB (..., 3) of the NTSC primaries (book eq 5.2, corrected).

    Example:
        >>> rgb_to_yiq([1.0, 0.0, 0.0]).tolist()
        [0.299, 0.596, 0.212]
    """
    return converted([step("named", "rgb_to_yiq")], rgb, out)


def yiq_to_rgb(yiq: ArrayLike, *, out: Array | None = None) -> Array:
    """RGB of the NTSC primaries of Y_t, I and Q (..., 3) (book eq 5.3).

    Example:
        >>> yiq_to_rgb([0.5, 0.0, 0.0]).tolist()
        [0.5, 0.5, 0.5]
    """
    return converted([step("named", "yiq_to_rgb")], yiq, out)


def monochrome(rgb: ArrayLike) -> Array:
    """Y_t of RGB (..., 3) of the NTSC primaries: what a black and white set shows (book eq 5.5); shape (...).

    Example:
        >>> monochrome([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).tolist()
        [0.299, 0.587]
    """
    return rgb_to_yiq(rgb)[..., 0]


def xyz_to_ac1c2(xyz: ArrayLike, *, out: Array | None = None) -> Array:
    """A, C₁ and C₂ of XYZ (..., 3) (book eq 3.6).

    Example:
        >>> xyz_to_ac1c2([1.0, 1.0, 1.0]).round(4).tolist()
        [0.9986, -0.134, 0.5165]
    """
    return converted([step("named", "xyz_to_ac1c2")], xyz, out)


def ac1c2_to_xyz(ac1c2: ArrayLike, *, out: Array | None = None) -> Array:
    """XYZ of A, C₁ and C₂ (..., 3).

    Example:
        >>> ac1c2_to_xyz(xyz_to_ac1c2([0.3, 0.4, 0.5])).round(12).tolist()
        [0.3, 0.4, 0.5]
    """
    return converted([step("named", "ac1c2_to_xyz")], ac1c2, out)
