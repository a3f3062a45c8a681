"""Triangle meshes as plain arrays, the built-in shapes, and what makes a mesh usable.

The built-in shapes are rectangle, box and disc; a sphere stays a true sphere and never becomes a mesh. A face's
front is the side from which its vertices run anticlockwise; the built-in shapes face outwards.

A disc is a regular polygon of 128 sides with the disc's area: its radius is that of the disc times
sqrt(x / sin x), x = 2π/128, which is 0.02 % more.

Example:
    >>> from illuminant.shapes import box
    >>> mesh = box([0, 0, 0], [1, 1, 1])
    >>> mesh.positions.shape, mesh.indices.shape
    ((24, 3), (12, 3))
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

__all__ = ["DISC_SIDES", "LARGEST", "Mesh", "box", "disc", "mesh_from_arrays", "quadrilateral", "rectangle"]

LARGEST = 1e12
"""The largest coordinate in metres: beyond it the products of single precision overflow."""

DISC_SIDES = 128
"""Sides of the polygon that stands for a disc."""


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh.

    Attributes:
        positions: float64 (V, 3), in metres once the scene is resolved.
        indices: int64 (F, 3), vertex numbers from 0.
        normals: float64 (V, 3), unit length, or None when the faces are flat.
        uvs: float64 (V, 2) texture coordinates, or None.
    """

    positions: np.ndarray
    indices: np.ndarray
    normals: np.ndarray | None = None
    uvs: np.ndarray | None = None

    def checked(self, zero_area: str = "error") -> Mesh:
        """The same mesh, after making sure that rays can be traced against it in single precision.

        Args:
            zero_area: "error" refuses faces without area, "remove" leaves them out.

        Raises:
            DataError: no faces, a vertex number out of range, a NaN or infinity, or a face without area.
        """
        import numpy as np

        if not len(self.positions) or not len(self.indices):
            raise DataError("the mesh is empty (it has no faces)")
        wrong = np.flatnonzero(((self.indices < 0) | (self.indices >= len(self.positions))).any(axis=1))
        if len(wrong):
            raise DataError(
                f"{_faces(len(wrong))} with vertex numbers out of range 0 to {len(self.positions) - 1}, "
                f"first face {wrong[0]}: {self.indices[wrong[0]].tolist()}"
            )
        for name, values in (("position", self.positions), ("normal", self.normals), ("uv", self.uvs)):
            if values is None:
                continue
            for bad, what in (
                (~np.isfinite(values), "that is not a finite number"),
                (np.abs(values) > LARGEST, f"beyond {LARGEST:g}"),
            ):
                wrong = np.flatnonzero(bad.any(axis=1))
                if len(wrong):
                    count = "1 vertex has" if len(wrong) == 1 else f"{len(wrong)} vertices have"
                    raise DataError(f"{count} a {name} {what}, first vertex {wrong[0]}")
        a, b, c = (self.positions.astype(np.float32).astype(np.float64)[self.indices[:, i]] for i in range(3))
        edges = np.stack([b - a, c - b, a - c])
        longest = np.einsum("efi,efi->ef", edges, edges).max(axis=0)
        doubled = np.linalg.norm(np.cross(edges[0], -edges[2]), axis=1)
        wrong = np.flatnonzero(doubled <= 1e-12 * longest)
        if not len(wrong):
            return self
        if zero_area == "error":
            raise DataError(
                f"{_faces(len(wrong))} without area, first face {wrong[0]} with vertices "
                f"{self.indices[wrong[0]].tolist()}"
            )
        if len(wrong) == len(self.indices):
            raise DataError("the mesh is empty (no face has an area)")
        return Mesh(self.positions, np.delete(self.indices, wrong, axis=0), self.normals, self.uvs)

    def smoothed(self) -> Mesh:
        """The same mesh with a normal for each vertex, the mean of the faces around it weighted by their angles.

        Vertices at the same position count as one, so that a seam in the texture does not show.
        """
        import numpy as np

        _, group = np.unique(self.positions, axis=0, return_inverse=True)
        group = group.reshape(-1)
        corners = self.positions[self.indices]
        sums = np.zeros((int(group.max()) + 1, 3))
        face = _unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        for i in range(3):
            first = _unit(corners[:, (i + 1) % 3] - corners[:, i])
            second = _unit(corners[:, (i + 2) % 3] - corners[:, i])
            angle = np.arccos(np.clip(np.einsum("fi,fi->f", first, second), -1.0, 1.0))
            np.add.at(sums, group[self.indices[:, i]], face * angle[:, None])
        normals = _unit(sums)[group]
        lost = np.flatnonzero(np.linalg.norm(normals, axis=1) < 0.5)
        if len(lost):  # opposite faces cancel, or the vertex has no face: any unit vector does
            normals[lost] = (0.0, 0.0, 1.0)
        return Mesh(self.positions, self.indices, normals, self.uvs)

    def transformed(self, linear: np.ndarray) -> Mesh:
        """The same mesh under a 3 × 3 matrix that keeps orientation (a scale, a change of axes)."""
        import numpy as np

        with np.errstate(all="ignore"):  # what becomes no number is refused by `checked`
            normals = None if self.normals is None else _unit(self.normals @ np.linalg.inv(linear))
            return Mesh(self.positions @ linear.T, self.indices, normals, self.uvs)

    def reversed(self) -> Mesh:
        """The same mesh with the front of its faces on the other side (the vertex normals stay)."""
        return Mesh(self.positions, self.indices[:, ::-1], self.normals, self.uvs)


def mesh_from_arrays(positions: Any, faces: Any, normals: Any = None, uvs: Any = None) -> Mesh:
    """A mesh from arrays, or from nested lists of a scene file.

    Args:
        positions: (V, 3) numbers.
        faces: (F, 3) or (F, 4) vertex numbers, or a list that mixes triangles and quadrilaterals; a quadrilateral
            becomes two triangles that share the edge from its first to its third vertex.
        normals: (V, 3), any length but zero, or None.
        uvs: (V, 2) or None.

    Raises:
        DataError: a wrong shape or type; the numbers themselves are judged by `Mesh.checked`.
    """
    import numpy as np

    points = _table(positions, "positions", 3)
    try:
        if isinstance(faces, np.ndarray) and faces.ndim == 2:
            rows = [faces]
        else:
            rows = [np.array([row]) for row in faces]
        triangles = []
        for row in rows:
            if row.ndim != 2 or row.shape[1] not in (3, 4) or row.dtype.kind not in "iu":
                raise ValueError
            triangles.append(row[:, [0, 1, 2]])
            if row.shape[1] == 4:
                triangles.append(row[:, [0, 2, 3]])
        indices = np.concatenate(triangles).astype(np.int64) if triangles else np.zeros((0, 3), np.int64)
    except (ValueError, TypeError, OverflowError):
        raise DataError("faces must be rows of three or four vertex numbers") from None
    extra = []
    for values, name, width in ((normals, "normals", 3), (uvs, "uvs", 2)):
        table = None if values is None else _table(values, name, width)
        if table is not None and len(table) != len(points):
            raise DataError(f"{name} has {len(table)} rows where positions has {len(points)}")
        extra.append(table)
    if extra[0] is not None:
        with np.errstate(all="ignore"):  # what becomes no number is refused by `checked`
            length = np.linalg.norm(extra[0], axis=1, keepdims=True)
            if (length == 0).any():
                raise DataError(f"normal {int(np.argmin(length[:, 0]))} has no length")
            extra[0] = extra[0] / length
    return Mesh(points, indices, extra[0], extra[1])


def rectangle(corner: Sequence[float], edges: Sequence[Sequence[float]]) -> Mesh:
    """A parallelogram from one corner and the two edges from it; its normal is first edge × second edge."""
    import numpy as np

    origin, (first, second) = np.array(corner, float), np.array(edges, float)
    return quadrilateral([origin, origin + first, origin + first + second, origin + second])


def quadrilateral(corners: Sequence[Any]) -> Mesh:
    """A flat, convex four-sided face from its corners in order.

    Raises:
        DataError: the corners are not in one plane (within 1 % of the longest diagonal), or the face is folded.
    """
    import numpy as np

    points = np.array(corners, float)
    first, second = points[2] - points[0], points[3] - points[1]
    normal = np.cross(first, second)
    length = np.linalg.norm(normal)
    size = max(np.linalg.norm(first), np.linalg.norm(second))
    if length <= 1e-12 * size**2:
        raise DataError("the four corners enclose no area")
    if abs(np.dot(points[1] - points[0], normal / length)) > 0.01 * size:
        raise DataError("the four corners are not in one plane")
    for i in range(4):
        turn = np.cross(points[(i + 1) % 4] - points[i], points[(i + 2) % 4] - points[(i + 1) % 4])
        if np.dot(turn, normal) <= 0:
            raise DataError("the four corners do not go round a convex face in order")
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    return Mesh(points, np.array([[0, 1, 2], [0, 2, 3]], np.int64), None, uvs)


def box(low: Sequence[float], high: Sequence[float]) -> Mesh:
    """A box along the axes, each face with its own four vertices and a whole texture.

    Raises:
        DataError: a side is zero or negative.
    """
    import numpy as np

    low_corner, high_corner = np.array(low, float), np.array(high, float)
    for axis, name in enumerate("xyz"):
        if not low_corner[axis] < high_corner[axis]:
            raise DataError(f"min must be below max, but in {name} it is {low[axis]:g} and {high[axis]:g}")
    positions: list[np.ndarray] = []
    indices: list[list[int]] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            face = np.empty((4, 3))
            face[:, axis] = high_corner[axis] if side else low_corner[axis]
            face[:, u] = [low_corner[u], high_corner[u], high_corner[u], low_corner[u]]
            face[:, v] = [low_corner[v], low_corner[v], high_corner[v], high_corner[v]]
            first = 4 * len(positions)
            positions.append(face if side else face[::-1])
            indices += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    uvs = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float), (6, 1))
    return Mesh(np.concatenate(positions), np.array(indices, np.int64), None, uvs)


def disc(center: Sequence[float], normal: Sequence[float], radius: float, sides: int = DISC_SIDES) -> Mesh:
    """A disc as a regular polygon of the same area.

    Raises:
        DataError: the normal has no length.
    """
    import numpy as np

    axis = np.array(normal, float)
    if not np.linalg.norm(axis) > 0:
        raise DataError("normal must have a length")
    axis = axis / np.linalg.norm(axis)
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)
    step = 2 * np.pi / sides
    angle = step * np.arange(sides)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rim = np.array(center, float) + radius * np.sqrt(step / np.sin(step)) * (
        circle @ np.stack([first, second])
    )
    positions = np.concatenate([np.array([center], float), rim])
    following = (np.arange(sides) + 1) % sides
    indices = np.stack([np.zeros(sides, np.int64), 1 + np.arange(sides), 1 + following], axis=1)
    uvs = np.concatenate([[[0.5, 0.5]], 0.5 + 0.5 * circle])
    return Mesh(positions, indices, None, uvs)


def _faces(count: int) -> str:
    return "1 face" if count == 1 else f"{count} faces"


def _table(values: Any, name: str, width: int) -> np.ndarray:
    import numpy as np

    try:
        table = np.array(values, dtype=np.float64)
    except (ValueError, TypeError):
        table = np.zeros(0)
    if table.ndim != 2 or table.shape[1] != width:
        raise DataError(f"{name} must be rows of {width} numbers")
    return table


def _unit(vectors: np.ndarray) -> np.ndarray:
    import numpy as np

    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1.0)
