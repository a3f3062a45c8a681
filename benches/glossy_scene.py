"""The glossy, textured scene of `glossy.py` as plain numbers: three balls of rough metal on tiles under a lamp."""

from __future__ import annotations

import numpy as np

BALLS = [
    {"center": [-1.25, 0.0, 0.6], "radius": 0.6, "metal": "copper", "peer": "Cu", "roughness": 0.1},
    {"center": [0.0, 0.6, 0.6], "radius": 0.6, "metal": "gold", "peer": "Au", "roughness": 0.2},
    {"center": [1.25, 0.0, 0.6], "radius": 0.6, "metal": "silver", "peer": "Ag", "roughness": 0.3},
]
"""z is up."""

CAMERA = {"eye": [0.0, -5.0, 2.2], "target": [0.0, 0.0, 0.5], "up": [0.0, 0.0, 1.0], "field_of_view": 40.0}
FLOOR = {"corner": [-4.0, -4.0, 0.0], "edges": [[8.0, 0.0, 0.0], [0.0, 8.0, 0.0]], "repeat": 8.0}
LAMP = {"corner": [-1.0, -1.0, 4.0], "edges": [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0]], "radiance": 1.0}
DEPTH = 8


def tiles(size: int = 64) -> np.ndarray:
    """Linear RGB (size, size, 3): a board of two greys, with a gradient, so that a texture has to be looked up."""
    y, x = np.mgrid[0:size, 0:size] / size
    board = np.where((np.floor(2 * x) + np.floor(2 * y)) % 2 == 0, 0.6, 0.15)
    return np.repeat((board * (0.7 + 0.3 * x))[..., None], 3, axis=2).astype(np.float32)


def ball(center: list[float], radius: float, rows: int = 48) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, normals and triangles of a ball of so many rows, for renderers that know no spheres."""
    columns = 2 * rows
    theta = np.pi * np.arange(rows + 1)[:, None] / rows
    phi = 2 * np.pi * np.arange(columns)[None, :] / columns
    normals = np.stack(
        [
            np.sin(theta) * np.cos(phi),
            np.sin(theta) * np.sin(phi),
            np.broadcast_to(np.cos(theta), (rows + 1, columns)),
        ],
        axis=2,
    ).reshape(-1, 3)
    faces = []
    for i in range(rows):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = a + columns, b + columns
            faces += [(a, c, b), (b, c, d)]
    return np.asarray(center) + radius * normals, normals, np.asarray(faces)
