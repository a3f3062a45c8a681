"""The edges of a solution's elements and patches, drawn over the picture, and how far the picture is away.

The browser draws the lines; the distance of every pixel goes with the picture, so that it hides what lies behind.

    z = distance / √(1 + u² + v²)        depth along the axis of the camera; u, v are a pixel's tangents
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from illuminant.job import Job
from illuminant.viewer.camera import limited

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.radiosity import Mesh
    from illuminant.scene import Scene

    Array = NDArray[np.float32]

__all__ = ["WIRES", "depth", "edges"]

WIRES = ("none", "elements", "patches")

MOST_PIXELS = 500 * 320
"""Of an image of depth."""

BEHIND = 1.01
"""How much farther than the surface its pixels are said to be, so that edges on it are seen."""


def edges(mesh: Mesh, kind: str) -> Array:
    """The ends (n, 2, 3) of edges, metres, each edge once.

    Args:
        mesh: of a solution.
        kind: `elements` for all edges, `patches` for those between patches and at the ends of surfaces.
    """
    import numpy as np

    faces = mesh.faces
    # Corners at one place, of two surfaces or of two sides of one, are one corner.
    places, corner = np.unique(np.round(mesh.positions, 7), axis=0, return_inverse=True)
    pairs = np.sort(corner.reshape(-1)[faces[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2), axis=1)
    if kind == "patches":
        owner = np.repeat(np.asarray(mesh.patches), 3)
        known, which = np.unique(pairs, axis=0, return_inverse=True)
        least, most = np.full(len(known), np.iinfo(np.int64).max), np.full(len(known), -1)
        np.minimum.at(least, which.reshape(-1), owner)
        np.maximum.at(most, which.reshape(-1), owner)
        alone = np.bincount(which.reshape(-1)) == 1
        pairs = known[(least != most) | alone]
    else:
        pairs = np.unique(pairs, axis=0)
    return np.asarray(places[pairs], np.float32)


def depth(scene: Scene, camera: Mapping[str, Any]) -> Array:
    """How far along the camera's axis the surfaces are (h, w), metres; a large number where there is none."""
    import numpy as np

    width, height = limited(camera["size"][0], camera["size"][1], MOST_PIXELS)
    seen = scene.replace(camera=dict(camera) | {"size": [width, height]})
    job = Job(seen, technique="path", sampling="uniform:4", samples=1, depth=1, layers="depth")
    for _ in job.passes():
        pass
    distance = np.asarray(job.image().layers["depth"], float)[..., 0]
    half = math.tan(math.radians(camera["field_of_view_deg"]) / 2.0)
    u = half * (2.0 * (np.arange(width) + 0.5) / width - 1.0)
    v = half * height / width * (2.0 * (np.arange(height) + 0.5) / height - 1.0)
    along = distance / np.sqrt(1.0 + u[None, :] ** 2 + v[:, None] ** 2)
    return np.where(np.isfinite(along) & (along > 0), BEHIND * along, 1e6).astype(np.float32)
