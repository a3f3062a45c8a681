"""Chromatic adaptation: what looks under one white as a colour does under another.

M⁻¹ diag(M XYZ_to / M XYZ_from) M (von Kries 1902), with M of

- "von Kries": cones of Hunt, Pointer and Estévez, normalised to D65 (Fairchild 2013);
- "Bradford": Lam 1985, without its nonlinear blue (ICC.1:2010);
- "CAT16": Li et al. 2017, complete adaptation.

Nothing in `illuminant.color` adapts a colour unless it is asked to by name.

Example:
    >>> adapt([0.9505, 1.0, 1.0891], (0.9505, 1.0, 1.0891), "D50", method="Bradford").round(4).tolist()
    [0.9643, 1.0, 0.8251]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.color.triples import asked, converted, step
from illuminant.color.whites import White, white_xyz

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["METHODS", "adapt", "adaptation_matrix"]

METHODS = ("von Kries", "Bradford", "CAT16")
"""Names of the methods; upper and lower case are one."""


def adaptation_matrix(white_from: White, white_to: White, *, method: str) -> NDArray[np.float64]:
    """The matrix (3, 3) that takes XYZ seen under one white to XYZ that looks the same under another.

    Args:
        white_from, white_to: as `illuminant.color.white_xyz` takes them.
        method: one of `METHODS`.

    Raises:
        UsageError: the method is not known, or a white has no response in a cone.

    Example:
        >>> (adaptation_matrix("D65", "D65", method="CAT16").round(12) + 0.0).tolist()
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    import numpy as np

    return np.asarray(asked("adaptation_matrix", method, white_xyz(white_from), white_xyz(white_to)))


def adapt(
    xyz: ArrayLike, white_from: White, white_to: White, *, method: str, out: Array | None = None
) -> Array:
    """XYZ (..., 3) that looks under `white_to` as `xyz` does under `white_from`; arguments as `adaptation_matrix`."""
    matrix = adaptation_matrix(white_from, white_to, method=method)
    return converted([step("matrix", matrix.tolist())], xyz, out)
