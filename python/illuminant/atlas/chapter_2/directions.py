"""The vectors at a surface, closed forms of the book's appendix III.1 (eqs III.4 to III.15).

All are unit vectors that point away from the surface; `ni` is the index on the side of the light, `nt` that behind. The
core has the same forms and shades with them; here they stand for drawings, and are tested against the same numbers.

Example:
    >>> import numpy as np
    >>> light = np.array([0.6, 0.0, 0.8])
    >>> reflected(light, np.array([0.0, 0.0, 1.0])).round(6).tolist()
    [-0.6, 0.0, 0.8]
    >>> (refracted(light, np.array([0.0, 0.0, 1.0]), 1.0, 1.5).round(6) + 0.0).tolist()
    [-0.4, 0.0, -0.916515]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["between", "half", "half_refracted", "half_refracted_printed", "reflected", "refracted"]


def _unit(vector: Array) -> Array:
    import numpy as np

    return np.asarray(vector / np.linalg.norm(vector))


def between(first: Array, second: Array) -> float:
    """The angle between two directions, degrees, exact for small ones too."""
    import numpy as np

    return float(np.degrees(2.0 * np.arctan2(np.linalg.norm(first - second), np.linalg.norm(first + second))))


def reflected(vector: Array, normal: Array) -> Array:
    """The mirror direction 2 N (N·L) − L (eq III.6)."""
    import numpy as np

    return np.asarray(2.0 * (vector @ normal) * normal - vector)


def refracted(vector: Array, normal: Array, ni: float, nt: float) -> Array | None:
    """The refracted direction (eqs III.7 to III.10); None beyond the critical angle."""
    import numpy as np

    cos = float(vector @ normal)
    sin2 = (1.0 - cos * cos) * (ni / nt) ** 2
    if sin2 >= 1.0:
        return None
    return np.asarray((cos * ni / nt - np.sqrt(1.0 - sin2)) * normal - vector * ni / nt)


def half(light: Array, view: Array) -> Array:
    """The normal H that mirrors one direction to the other (eq III.11)."""
    return _unit(light + view)


def half_refracted(light: Array, through: Array, ni: float, nt: float) -> Array:
    """The normal H′ that refracts L to T: ∓(n_i L + n_t T), on the side of L (eqs III.12 to III.15 put right)."""
    return _unit((ni * light + nt * through) * (-1.0 if nt > ni else 1.0))


def half_refracted_printed(light: Array, through: Array, ni: float, nt: float) -> Array:
    """H′ as eqs III.13 and III.14 print it for n_i < n_t: with n_i/n_t − 1 where n_t/n_i − 1 belongs."""
    return _unit(-(through + (light + through) / (ni / nt - 1.0)))
