"""Linear spaces with other axes: Y_t I Q of NTSC video and its colour differences, and Meyer's A C₁ C₂.

- Y_t I Q (book eqs 5.2 and 5.3), in three forms called `matrix`:
    - "exact": eq 5.2 with 0.114 for the printed 0.144 and −0.523 for −0.528 (ERRATA 13, 14), and back its exact
      inverse, so that there and back is good to all digits;
    - "book": the same there, and back the rounded eq 5.3: there and back is good to 3 × 10⁻⁴;
    - "standard": what these are rounded from. V = 0.877283 (R − Y_t) and U = 0.492111 (B − Y_t), turned by 33°:
      I = V cos 33° − U sin 33°, Q = V sin 33° + U cos 33° (FCC 1953, 47 CFR 73.682, who round to 0.877 and 0.493;
      SMPTE 170M-2004).
- Y_t, V, U: the colour differences before they are turned. The book's footnote 15 calls these I and Q (ERRATA 15).
- A C₁ C₂ (book eq 3.6, Meyer): axes along which tristimulus values vary most; the inverse is exact.

Shapes, types and `out` are as `illuminant.color.triples` says.

Example:
    >>> (rgb_to_yiq([1.0, 1.0, 1.0]).round(12) + 0.0).tolist()
    [1.0, 0.0, 0.0]
    >>> yiq_to_rgb(rgb_to_yiq([0.1, 0.7, 0.4])).round(14).tolist()
    [0.1, 0.7, 0.4]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.color.triples import asked, converted, step
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = [
    "LUMINANCE",
    "TURN_DEG",
    "ac1c2_to_xyz",
    "monochrome",
    "rgb_to_yiq",
    "rgb_to_yvu",
    "xyz_to_ac1c2",
    "yiq_matrix",
    "yiq_to_rgb",
    "yvu_to_rgb",
]


LUMINANCE = (0.299, 0.587, 0.114)
"""Shares of R, G and B in Y_t (book eq 5.5)."""

V_GAIN, U_GAIN = 0.877283, 0.492111
"""Of R − Y_t and B − Y_t: with them yellow and cyan reach up to 4/3 of white, and red and blue down to −1/3."""

TURN_DEG = 33.0
"""From V to I, and from U to Q: I lies along orange and cyan, where the eye sees finer detail."""

# Eq 5.2, corrected; the core has the same.
_BOOK = (LUMINANCE, (0.596, -0.275, -0.321), (0.212, -0.523, 0.311))


def yiq_matrix(matrix: str = "exact") -> NDArray[np.float64]:
    """The matrix (3, 3) from RGB of the NTSC primaries to Y_t, I, Q.

    Args:
        matrix: "exact" or "book" (eq 5.2, corrected, for both) or "standard".

    Raises:
        UsageError: another name.

    Example:
        >>> yiq_matrix("standard")[1:].round(4).tolist()
        [[0.5959, -0.2746, -0.3213], [0.2115, -0.5227, 0.3112]]
    """
    import numpy as np

    if _known(matrix) != "standard":
        return np.array(_BOOK)
    turn = np.radians(TURN_DEG)
    rotation = np.array(
        [[1.0, 0.0, 0.0], [0.0, np.cos(turn), -np.sin(turn)], [0.0, np.sin(turn), np.cos(turn)]]
    )
    return np.asarray(rotation @ _yvu_matrix())


def _known(matrix: str) -> str:
    if matrix not in ("exact", "book", "standard"):
        raise UsageError(f"There is no matrix {matrix!r} of Y I Q: expected exact, book or standard.")
    return matrix


def _yvu_matrix() -> NDArray[np.float64]:
    """From RGB to Y_t, V, U."""
    import numpy as np

    y = np.array(LUMINANCE)
    red, _, blue = np.eye(3)
    return np.stack([y, V_GAIN * (red - y), U_GAIN * (blue - y)])


def rgb_to_yiq(rgb: ArrayLike, *, matrix: str = "exact", out: Array | None = None) -> Array:
    """Y_t, I and Q of RGB (..., 3) of the NTSC primaries (book eq 5.2, corrected).

    Args:
        rgb: (..., 3), code values, which are gamma-corrected; nothing is clamped.
        matrix: "exact" and "book" are the same here; "standard" is what they are rounded from.
        out: as `illuminant.color.triples` says.

    Example:
        >>> rgb_to_yiq([1.0, 0.0, 0.0]).tolist()
        [0.299, 0.596, 0.212]
    """
    if _known(matrix) == "standard":
        return converted([step("matrix", yiq_matrix(matrix).tolist())], rgb, out)
    return converted([step("named", "rgb_to_yiq")], rgb, out)


def yiq_to_rgb(yiq: ArrayLike, *, matrix: str = "exact", out: Array | None = None) -> Array:
    """RGB of the NTSC primaries of Y_t, I and Q (..., 3).

    Args:
        yiq: (..., 3).
        matrix: "exact": the inverse of eq 5.2; "book": eq 5.3; "standard": the inverse of the standard's.
        out: as `illuminant.color.triples` says.

    Example:
        >>> yiq_to_rgb([0.5, 0.0, 0.0]).round(15).tolist()
        [0.5, 0.5, 0.5]
        >>> yiq_to_rgb([0.0, 1.0, 0.0], matrix="book").tolist()
        [0.9557, -0.2716, -1.1082]
    """
    if _known(matrix) == "book":
        return converted([step("named", "yiq_to_rgb")], yiq, out)
    return converted([step("matrix", asked("matrix_inverse", yiq_matrix(matrix).tolist()))], yiq, out)


def rgb_to_yvu(rgb: ArrayLike, *, out: Array | None = None) -> Array:
    """Y_t, V = 0.877 (R − Y_t) and U = 0.492 (B − Y_t) of RGB (..., 3) (book footnote 15, ERRATA 15).

    Example:
        >>> rgb_to_yvu([1.0, 0.0, 0.0]).round(4).tolist()
        [0.299, 0.615, -0.1471]
    """
    return converted([step("matrix", _yvu_matrix().tolist())], rgb, out)


def yvu_to_rgb(yvu: ArrayLike, *, out: Array | None = None) -> Array:
    """RGB of Y_t, V and U (..., 3); the inverse of `rgb_to_yvu`.

    Example:
        >>> yvu_to_rgb(rgb_to_yvu([0.2, 0.5, 0.9])).round(14).tolist()
        [0.2, 0.5, 0.9]
    """
    return converted([step("matrix", asked("matrix_inverse", _yvu_matrix().tolist()))], yvu, out)


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
