"""The cells of a hemi-cube and of a whole cube, and their delta form factors (book eqs 4.32, IV.1 to IV.7).

A cube of edge 2 stands about a small area whose normal is z. A cell of area ΔA on its top, z = 1, has the delta form
factor ΔA/(π (x² + y² + 1)²), one on the side x = 1 z ΔA/(π (y² + z² + 1)²). The book leaves out π (its form factors are
for intensities), so its own sum to π. The core has the same cells for radiosity; these stand for drawings.

Example:
    >>> round(float(hemicube(32).delta.sum()), 2)
    1.0
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Cells", "cube", "hemicube", "point_to_polygon", "seen_through"]


class Cells(NamedTuple):
    """The cells of a cube.

    Attributes:
        middles: (n, 3), points of its faces.
        corners: (n, 4, 3).
        delta: (n,), the form factor of each for a small area at the centre with the normal z; 0 below it.
        faces: (n,), 0 the top, 1 to 4 the sides towards x, y, −x, −y, 5 the bottom.
    """

    middles: Array
    corners: Array
    delta: Array
    faces: NDArray[np.int64]


def cube(resolution: int) -> Cells:
    """A whole cube of so many cells along an edge."""
    import numpy as np

    edge = np.linspace(-1.0, 1.0, resolution + 1)
    low, high = edge[:-1], edge[1:]
    u0, v0 = (one.ravel() for one in np.meshgrid(low, low))
    u1, v1 = (one.ravel() for one in np.meshgrid(high, high))
    around = np.stack(
        [np.stack([u, v], axis=-1) for u, v in ((u0, v0), (u1, v0), (u1, v1), (u0, v1))], axis=1
    )
    # For each face the directions of u, of v and outward.
    x, y, z = np.eye(3)
    frames = ((x, y, z), (y, z, x), (-x, z, y), (-y, z, -x), (x, z, -y), (x, -y, -z))
    corners = np.concatenate([around[..., :1] * u + around[..., 1:] * v + out for u, v, out in frames])
    middles = corners.mean(axis=1)
    area = (2.0 / resolution) ** 2
    faces = np.repeat(np.arange(6), resolution**2)
    outward = np.array([out for _, _, out in frames])[faces]
    # cos θ at the area, cos θ at the cell, over r².
    r2 = (middles**2).sum(axis=1)
    towards = np.einsum("ij,ij->i", middles, outward)
    delta = np.maximum(middles[:, 2], 0.0) * towards * area / (np.pi * r2 * r2)
    return Cells(middles, corners, delta, faces)


def hemicube(resolution: int) -> Cells:
    """Half a cube, of an even number of cells along an edge: the top and the upper halves of the sides."""
    whole = cube(resolution)
    upper = whole.middles[:, 2] > 0.0
    return Cells(whole.middles[upper], whole.corners[upper], whole.delta[upper], whole.faces[upper])


def seen_through(cells: Cells, polygon: Array) -> NDArray[np.bool_]:
    """The cells through whose middles a convex polygon (k, 3) is seen from the centre."""
    import numpy as np

    edges = np.cross(polygon, np.roll(polygon, -1, axis=0))
    inside = cells.middles @ edges.T
    ahead = cells.middles @ polygon.mean(axis=0) > 0.0
    return np.asarray(((inside >= 0.0).all(axis=1) | (inside <= 0.0).all(axis=1)) & ahead)


def point_to_polygon(polygon: Array) -> float:
    """The exact form factor of a polygon above the plane, from the origin with the normal z (Lambert 1760)."""
    import numpy as np

    total = 0.0
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        across = np.cross(a, b)
        length = float(np.linalg.norm(across))
        total += float(np.arctan2(length, a @ b)) * float(across[2]) / length
    return abs(total) / (2.0 * float(np.pi))
