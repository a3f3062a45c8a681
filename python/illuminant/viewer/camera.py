"""The camera of the page as a camera of the scene, and back.

viser's cameras look along +z with y down (the convention of OpenCV), state the vertical field of view in radians and
a quaternion (w, x, y, z); a scene's camera has an eye, a target, an up vector and the horizontal field of view in
degrees. Everything is in metres.

    tan(h/2) = tan(v/2) · width / height
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["horizontal_deg", "limited", "rotation", "scene_camera", "vertical_rad"]

WIDEST_DEG = 170.0


def vertical_rad(horizontal_deg: float, width: float, height: float) -> float:
    """The vertical field of view, radians, of a horizontal one in degrees.

    Example:
        >>> round(math.degrees(vertical_rad(90.0, 200, 100)), 3)
        53.13
    """
    return 2.0 * math.atan(math.tan(math.radians(horizontal_deg) / 2.0) * height / width)


def horizontal_deg(vertical_rad: float, width: float, height: float) -> float:
    """The horizontal field of view, degrees, of a vertical one in radians; at most 170.

    Example:
        >>> round(horizontal_deg(math.radians(53.13010235), 200, 100), 6)
        90.0
    """
    return min(WIDEST_DEG, math.degrees(2.0 * math.atan(math.tan(vertical_rad / 2.0) * width / height)))


def rotation(wxyz: Sequence[float]) -> NDArray[np.float64]:
    """The matrix (3, 3) of a quaternion (w, x, y, z), whose columns are right, down and forward of the camera.

    Example:
        >>> rotation([1, 0, 0, 0]).tolist()
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    import numpy as np

    w, x, y, z = np.asarray(wxyz, float) / np.linalg.norm(wxyz)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def limited(width: int, height: int, pixels: int) -> tuple[int, int]:
    """A size of the same shape with at most so many pixels.

    Example:
        >>> limited(1600, 800, 320_000), limited(100, 50, 10**6)
        ((800, 400), (100, 50))
    """
    shrink = min(1.0, math.sqrt(pixels / max(1, width * height)))
    return max(1, round(width * shrink)), max(1, round(height * shrink))


def scene_camera(
    own: Mapping[str, Any],
    wxyz: Sequence[float],
    position: Sequence[float],
    fov: float,
    size: tuple[int, int],
    distance: float,
) -> dict[str, Any]:
    """The camera of a scene (`Scene.description["camera"]`) as the page has turned it.

    Args:
        own: the scene's camera, of which lens, shutter and all else stay.
        wxyz, position, fov: the page's camera.
        size: pixels of the image.
        distance: from the eye to what it looks at, metres.
    """
    turn = rotation(wxyz)
    eye = [float(v) for v in position]
    target = [e + distance * float(d) for e, d in zip(eye, turn[:, 2], strict=True)]
    # A camera that a person holds does not move by itself.
    camera = {key: one for key, one in own.items() if key not in ("crop", "end")}
    return camera | {
        "eye": eye,
        "target": target,
        "up": [-float(v) for v in turn[:, 1]],
        "field_of_view_deg": horizontal_deg(fov, *size),
        "size": list(size),
    }
