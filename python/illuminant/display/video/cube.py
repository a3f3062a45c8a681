"""The RGB cube in Y I Q: its edges, its surface, and the hot colours on it (book figure 5.23).

The cube becomes a slanted box that stands on black and ends in white, Y from 0 to 1. Its corners blue, magenta and red
have much I and Q and little Y: colours that the signal carries worst. Where the box leaves the bounds of the signal
(`legality`), its colours are hot.

Example:
    >>> [name for name, rgb, yiq, is_hot in corners() if is_hot]
    ['yellow', 'cyan', 'red', 'blue']
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, NamedTuple

from illuminant.color.axes import rgb_to_yiq
from illuminant.display.patterns.color_bars import BARS
from illuminant.display.video.legality import Limits, hot

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Float64 = NDArray[np.float64]

__all__ = ["CORNERS", "Corner", "Edge", "corners", "edges", "hot_share", "surface"]

CORNERS = {"black": (0.0, 0.0, 0.0), **BARS}
"""RGB of the corners by name, white first after black and then by falling Y."""


class Corner(NamedTuple):
    """A corner of the cube: its name, RGB (3,), Y I Q (3,), and whether it is hot."""

    name: str
    rgb: Float64
    yiq: Float64
    hot: bool


class Edge(NamedTuple):
    """Points (n, 3) along an edge of the cube in RGB and in Y I Q, and which of them (n,) are hot."""

    rgb: Float64
    yiq: Float64
    hot: NDArray[np.bool_]


def corners(limits: Limits | None = None) -> list[Corner]:
    """The eight corners."""
    import numpy as np

    rgb = np.array(list(CORNERS.values()))
    rows = zip(CORNERS, rgb, rgb_to_yiq(rgb), hot(rgb, limits).tolist(), strict=True)
    return [Corner(*row) for row in rows]


def edges(points: int = 33, limits: Limits | None = None) -> list[Edge]:
    """The twelve edges, each from the corner that is nearer to black.

    Example:
        >>> len(edges()), edges()[0].rgb[[0, -1]].tolist()
        (12, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    """
    import numpy as np

    t = np.linspace(0.0, 1.0, points)
    found = []
    for axis in range(3):
        for ends in product((0.0, 1.0), repeat=2):
            rgb = np.empty((points, 3))
            rgb[:, axis] = t
            rgb[:, [other for other in range(3) if other != axis]] = ends
            found.append(Edge(rgb, np.asarray(rgb_to_yiq(rgb), np.float64), hot(rgb, limits)))
    return found


def surface(steps: int = 17) -> Float64:
    """RGB (6, steps, steps, 3) on the faces of the cube."""
    import numpy as np

    t = np.linspace(0.0, 1.0, steps)
    u, v = np.meshgrid(t, t, indexing="ij")
    faces = []
    for axis in range(3):
        for side in (0.0, 1.0):
            face = np.full((steps, steps, 3), side)
            face[..., (axis + 1) % 3], face[..., (axis + 2) % 3] = u, v
            faces.append(face)
    return np.stack(faces)


def hot_share(limits: Limits | None = None, steps: int = 64) -> float:
    """Which part of the cube's volume is hot, from cells of 1/steps.

    Example:
        >>> 0.0 < hot_share() < 0.1
        True
    """
    import numpy as np

    t = (np.arange(steps) + 0.5) / steps
    rgb = np.stack(np.meshgrid(t, t, t, indexing="ij"), axis=-1)
    return float(hot(rgb, limits).mean())
