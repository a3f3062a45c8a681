"""What figures 4.25 and 4.26 share: two patches at an angle, and cubes about them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["draw_cubes", "frames", "misfit_deg", "solid_angles"]

MIDDLES = ((0.0, 0.0, 0.0), (2.3, 0.3, 1.0))
NORMALS = ((0.0, 0.0, 1.0), (-0.85, -0.1, 0.5))
EDGE = 0.42
"""Half the edge of a cube as drawn, metres."""


def frames() -> tuple[Array, Array]:
    """Two rotations whose columns are the axes of the patches, the third the normal."""
    import numpy as np

    def frame(normal: tuple[float, ...]) -> Array:
        z = np.array(normal) / np.linalg.norm(normal)
        x = np.cross([0.0, 1.0, 0.0], z)
        x = x / np.linalg.norm(x)
        return np.stack([x, np.cross(z, x), z], axis=1)

    return frame(NORMALS[0]), frame(NORMALS[1])


def solid_angles(resolution: int) -> Array:
    """Of all cells of a cube, steradians, exactly: the sum over corners of arctan(u v/√(1 + u² + v²))."""
    import numpy as np

    edge = np.linspace(-1.0, 1.0, resolution + 1)
    u, v = np.meshgrid(edge, edge)
    corner = np.arctan(u * v / np.sqrt(1.0 + u * u + v * v))
    cell = corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]
    return np.tile(cell.ravel(), 6)


def misfit_deg(resolution: int, turns: tuple[Array, Array], whole: bool = False) -> Array:
    """How far the opposite of each cell's direction lies from the nearest middle of a cell of the other cube, degrees.

    Only cells are counted whose opposite direction the other (hemi-)cube has.
    """
    import numpy as np

    from illuminant.atlas.chapter_4.hemicube import cube, hemicube

    cells = cube(resolution) if whole else hemicube(resolution)
    local = cells.middles / np.linalg.norm(cells.middles, axis=1, keepdims=True)
    source, target = (local @ turn.T for turn in turns)
    upper = -source @ turns[1][:, 2] > 1e-9 if not whole else np.ones(len(source), bool)
    cos = (-source[upper] @ target.T).max(axis=1)
    return np.asarray(np.degrees(np.arccos(np.clip(cos, -1.0, 1.0))))


def draw_cubes(resolution: int, local: bool) -> Figure:
    """The patches with hemi-cubes that stand as they do, or with cubes that stand alike."""
    import numpy as np

    from illuminant.atlas.chapter_4.hemicube import cube, hemicube
    from illuminant.plots.sketch import SURFACE, Sketch, View, new_sketches
    from illuminant.plots.style import line_look

    red, blue = line_look(1)["color"], line_look(0)["color"]
    figure, (axes,) = new_sketches((7.2, 4.2))
    sketch = Sketch(axes, View(-62.0, 20.0))
    turns = frames()
    middles = [np.array(one) for one in MIDDLES]
    way = middles[1] - middles[0]
    cells = hemicube(resolution) if local else cube(resolution)
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    for number, (turn, middle, sign) in enumerate(zip(turns, middles, (1.0, -1.0), strict=True)):
        about = turn if local else np.eye(3)
        corners = EDGE * cells.corners @ about.T + middle
        directions = cells.middles @ about.T
        directions = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        hit = int(np.argmax(directions @ (sign * way)))
        assert sketch.view is not None
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1])
        outward *= np.sign(np.einsum("ij,ij->i", outward, corners.mean(axis=1) - middle))[:, None]
        seen = outward @ sketch.view.towards_eye > 0.0
        patch = 1.5 * EDGE * square @ turn.T + middle
        sketch.patch(patch, face=SURFACE, zorder=1 if local else 3.2)
        faces = ["#ffffff66"] * len(corners)
        for side, layer in ((~seen, 2.0), (seen, 4.0)):
            sketch.patches(
                list(corners[side]),
                [f for f, yes in zip(faces, side, strict=True) if yes],
                linewidths=0.3 if layer > 3 else 0.12,
                zorder=layer,
            )
        sketch.patch(corners[hit], face=red if number == 0 else blue, edge="#222222", zorder=5, linewidth=0.5)
        sketch.arrow(middle, middle + 0.95 * turn[:, 2], "$\\mathbf{N}$", zorder=6, linewidth=1.1)
        sketch.label(patch[0], ("source", "target")[number], (-10, -10), fontsize=9)
        for at in (middle,):
            sketch.dot(at, 3.0)
    sketch.ray(middles, "#222222")
    sketch.frame()
    return figure
