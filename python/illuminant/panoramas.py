"""Pictures of all that surrounds a place: as cube, as mirrored ball, and as latitude and longitude (book figure 4.2).

All are seen with the up axis up: x to the right, -z ahead. The latitude-longitude image has the zenith in its top row,
and looks ahead in its middle column. The faces of a cube are seen from inside, in a cross

               up
        left  ahead  right  behind
              down

of four by three faces, or in a row of six: right, left, up, down, behind, ahead. A mirrored ball is photographed from
far behind it (from +z, looking ahead), and fills the square of the image; its middle shows what is behind.

Example:
    >>> import numpy as np
    >>> from illuminant.panoramas import latitude_longitude
    >>> latitude_longitude(np.ones((8, 48, 3)), "cube").shape
    (16, 32, 3)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.errors import ImageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["LAYOUTS", "latitude_longitude"]

LAYOUTS = ("latlong", "cube", "sphere")

CROSS = {"right": (1, 2), "left": (1, 0), "up": (0, 1), "down": (2, 1), "behind": (1, 3), "ahead": (1, 1)}
"""Row and column of each face in a cross; their order is that in a row."""


def latitude_longitude(image: Array, layout: str) -> Array:
    """An image of the surroundings by latitude and longitude.

    Args:
        image: (h, w, 3), linear.
        layout: "latlong" (returned as it is), "cube" or "sphere".

    Returns:
        (2 n, 4 n, 3) for a cube of faces of n pixels, (h, 2 h, 3) for a ball of h pixels; linear between pixels.

    Raises:
        ImageError: the image has not the shape of its layout.
    """
    import numpy as np

    height, width = image.shape[:2]
    if layout == "latlong":
        return image
    if layout == "sphere":
        if height != width:
            raise ImageError(f"a mirrored ball is a square image, not {width} × {height} pixels")
        x, y, z = _directions(height)
        # The normal that mirrors a direction to the camera lies half-way between both.
        length = np.sqrt(np.maximum(2.0 * (1.0 + z), 1e-12))
        return _bilinear(image, (x / length + 1.0) / 2.0 * width, (1.0 - y / length) / 2.0 * height)
    if width == 6 * height:
        size = height
        faces = {name: image[:, i * size : (i + 1) * size] for i, name in enumerate(CROSS)}
    elif 3 * width == 4 * height and height % 3 == 0:
        size = height // 3
        faces = {
            name: image[row * size : (row + 1) * size, column * size : (column + 1) * size]
            for name, (row, column) in CROSS.items()
        }
    else:
        raise ImageError(
            f"a cube is a row of six square faces or a cross of four by three, not {width} × {height} pixels"
        )
    x, y, z = _directions(2 * size)
    found = np.zeros((*x.shape, 3))
    # For each face: the axis on which it lies, and what is right and up on it.
    sides = {
        "right": (x, z, y),
        "left": (-x, -z, y),
        "up": (y, x, z),
        "down": (-y, x, -z),
        "behind": (z, -x, y),
        "ahead": (-z, x, y),
    }
    largest = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    for name, (axis, right, up) in sides.items():
        here = axis >= largest
        depth = axis[here]
        found[here] = _bilinear(
            faces[name], (right[here] / depth + 1.0) / 2.0 * size, (1.0 - up[here] / depth) / 2.0 * size
        )
    return found


def _directions(height: int) -> tuple[Array, Array, Array]:
    """The directions at which the pixels of a latitude-longitude image look."""
    import numpy as np

    theta = (np.arange(height) + 0.5)[:, None] / height * np.pi
    phi = (np.arange(2 * height) + 0.5)[None, :] / height * np.pi - np.pi
    return np.sin(theta) * np.sin(phi), np.cos(theta) + 0.0 * phi, -np.sin(theta) * np.cos(phi)


def _bilinear(image: Array, x: Array, y: Array) -> Array:
    """Values between the centres of pixels; x and y in pixels from the upper left corner."""
    import numpy as np

    height, width = image.shape[:2]
    x, y = np.clip(x - 0.5, 0.0, width - 1.0), np.clip(y - 0.5, 0.0, height - 1.0)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    right, below = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    fx, fy = (x - left)[..., None], (y - top)[..., None]
    upper = image[top, left] * (1.0 - fx) + image[top, right] * fx
    lower = image[below, left] * (1.0 - fx) + image[below, right] * fx
    return np.asarray(upper * (1.0 - fy) + lower * fy)
