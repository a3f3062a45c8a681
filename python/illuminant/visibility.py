"""Whether a scene's camera can see anything at all.

The core follows a coarse grid of camera rays (128 × 128) and says whether one of them meets a surface. Where none
does, a thing may still hide between the rays: a far lamp, a wire. So a camera is called blind only if, besides, every
triangle and every sphere lies outside its pyramid of view: beyond one of the four planes through the eye and the
sides of the image, or behind the eye. That test errs on the side of seeing.

Example:
    >>> from illuminant.scene import Scene
    >>> scene = Scene.build(
    ...     camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [64, 64]},
    ...     materials={"lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 800}},
    ...     objects={"ball": {"sphere": {"radius": 1.0}, "material": "lamp"}},
    ... )
    >>> blind(scene), blind(scene.replace(camera={"target": [0, 0, 6]}))
    (False, True)
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

    from illuminant.scene import Scene

__all__ = ["blind", "holds_anything", "planes"]

MARGIN = 16
"""Pixels around the image that count as seen: the largest radius of a reconstruction filter."""


def blind(scene: Scene, threads: int = 0) -> bool:
    """Whether the camera of a scene sees neither an object nor an environment.

    Args:
        scene: any scene.
        threads: for building the ray structure; 0 for one a processor.

    Raises:
        SceneError, MachineError: as `Scene.core`.
    """
    return not scene.core(threads).sees_anything() and not holds_anything(scene)


def planes(camera: Mapping[str, Any]) -> np.ndarray:
    """Inward normals of the pyramid of view, whose planes all pass through the eye.

    Args:
        camera: as in `Scene.description`.

    Returns:
        float64 (5, 3): left, top, right, bottom, and the one behind the eye.
    """
    import numpy as np

    eye, target, up = (np.array(camera[key], dtype=np.float64) for key in ("eye", "target", "up"))
    forward = target - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    upright = np.cross(right, forward)
    width, height = (float(side) for side in camera["size"])
    left, top, end, bottom = camera.get("crop") or [0, 0, width, height]
    half: float = math.tan(math.radians(camera["field_of_view_deg"]) / 2)

    def across(column: float) -> float:
        return half * (2 * column / width - 1)

    def down(row: float) -> float:
        return half * (1 - 2 * row / height) * height / width

    return np.stack(
        [
            right - across(left - MARGIN) * forward,
            down(top - MARGIN) * forward - upright,
            across(end + MARGIN) * forward - right,
            upright - down(bottom + MARGIN) * forward,
            forward,
        ]
    )


def holds_anything(scene: Scene) -> bool:
    """Whether a part of an object may lie in the camera's pyramid of view, or there is an environment."""
    import numpy as np

    description = scene.description
    if any(light["kind"] in ("environment", "sky") for light in description["lights"]):
        return True
    eye = np.array(description["camera"]["eye"], dtype=np.float64)
    normals = planes(description["camera"])
    shapes = scene.shapes()
    for number, keys in scene.placements():
        shape = shapes[number]
        for key in keys:
            linear, offset = key[:, :3], key[:, 3]
            if shape["kind"] == "sphere":
                distances = normals @ (linear @ shape["center"] + offset - eye)
                radius = shape["radius"] * np.linalg.norm(linear, 2)
                if (distances >= -radius * np.linalg.norm(normals, axis=1)).all():
                    return True
                continue
            points = shape["positions"] @ linear.T + (offset - eye)
            outside = points @ normals.T < 0
            if not outside[shape["indices"]].all(axis=1).any(axis=1).all():
                return True
    return False
