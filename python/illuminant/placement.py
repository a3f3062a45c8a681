"""Where an object stands: from scale, rotate and translate, or a matrix, to one transform in metres.

A transform is a float64 (3, 4) matrix from the object to the world. Points are scaled, then rotated, then translated:
M = T·R·S; a list of rotations is done in the order in which it is written. Rotations are anticlockwise when the axis
points at the viewer (right-handed).

Example:
    >>> from illuminant.placement import transform
    >>> transform(scale=2.0, translate=[10.0, 0.0, 0.0], unit_m=0.01).round(3).tolist()
    [[2.0, 0.0, 0.0, 0.1], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0]]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["METRES", "even_scale", "rotation", "transform", "turn_up"]

METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
"""Metres in each length unit."""


def rotation(axis: Any, degrees: float) -> np.ndarray:
    """The 3 × 3 matrix of a turn about an axis through the origin (Rodrigues).

    Args:
        axis: "x", "y", "z" or three numbers of any length but zero.
        degrees: the angle; multiples of 90 about x, y and z are exact.

    Raises:
        DataError: the axis has no length.
    """
    import numpy as np

    if isinstance(axis, str):
        axis = [float(axis == name) for name in "xyz"]
    direction = np.array(axis, float)
    length = np.linalg.norm(direction)
    if not length > 0:
        raise DataError("axis must have a length")
    x, y, z = direction / length
    quarter = degrees / 90.0
    if quarter == round(quarter):
        cosine, sine = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarter) % 4]
    else:
        cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    outer = np.outer([x, y, z], [x, y, z])
    return cosine * np.eye(3) + sine * cross + (1 - cosine) * outer


def turn_up(come_from: str, go_to: str) -> np.ndarray:
    """The 3 × 3 rotation that takes data whose up axis is `come_from` to a world whose up axis is `go_to`.

    Example:
        >>> (turn_up("y", "z") @ [0, 1, 0]).tolist()
        [0.0, 0.0, 1.0]
    """
    import numpy as np

    if come_from == go_to:
        return np.eye(3)
    return rotation("x", 90.0 if come_from == "y" else -90.0)


def transform(
    scale: float | Sequence[float] | None = None,
    rotate: Sequence[tuple[Any, float]] = (),
    translate: Sequence[float] | None = None,
    matrix: Sequence[Sequence[float]] | None = None,
    unit_m: float = 1.0,
) -> np.ndarray:
    """The transform of an object, in metres.

    Args:
        scale: a factor, or one for each axis; a negative one mirrors.
        rotate: pairs of axis and degrees, in order.
        translate: in length units.
        matrix: three or four rows of four numbers instead of all others, the last column in length units.
        unit_m: metres in the length unit.

    Returns:
        float64 (3, 4), object to world.

    Raises:
        DataError: the transform flattens the object (its determinant is zero), or the fourth row of the matrix is
            not 0 0 0 1.
    """
    import numpy as np

    result = np.zeros((3, 4))
    if matrix is not None:
        rows = np.array(matrix, float)
        if len(rows) == 4 and rows[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
            raise DataError("the fourth row of the matrix must be 0, 0, 0, 1")
        result[:, :3] = rows[:3, :3]
        result[:, 3] = rows[:3, 3] * unit_m
    else:
        factors = np.ones(3) if scale is None else np.array(scale, float) * np.ones(3)
        linear = np.diag(factors)
        for axis, degrees in rotate:
            linear = rotation(axis, degrees) @ linear
        result[:, :3] = linear
        if translate is not None:
            result[:, 3] = np.array(translate, float) * unit_m
    with np.errstate(all="ignore"):  # numbers at the end of all numbers are refused too
        size = np.linalg.norm(result[:, :3], axis=0)
        volume, most = abs(np.linalg.det(result[:, :3])), float(np.prod(size))
    if not volume > 1e-12 * most or not (size > 0).all():
        raise DataError("the transform flattens the object to nothing")
    return result + 0.0  # no negative zeros: equal scenes have equal bytes


def even_scale(linear: np.ndarray) -> float | None:
    """The factor of a transform that scales all directions alike, or None when it does not."""
    import numpy as np

    product = linear.T @ linear
    square = np.trace(product) / 3.0
    if np.abs(product - square * np.eye(3)).max() > 1e-6 * square:
        return None
    return float(np.sqrt(square))
