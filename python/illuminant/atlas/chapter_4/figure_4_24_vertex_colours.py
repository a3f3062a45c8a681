"""Figure 4.24: from the colours of patches to those of their corners (Cohen and Greenberg 1985; book 4.4.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

COUNT = 4
LAMP_AT = (1.1, 0.9, 1.0)
"""Patches along an edge of a square of edge 1, and a point light above it."""


def draw(quick: bool) -> Sheet:
    """A surface of patches and the values at its corners by the book's rule; the error of means without it."""
    import numpy as np

    from illuminant.plots.sketch import Sketch, new_sketches
    from illuminant.plots.style import line_look

    edge = np.linspace(0.0, 1.0, COUNT + 1)
    middle = (edge[1:] + edge[:-1]) / 2

    def lit(x: Array, y: Array) -> Array:
        """Irradiance of a point light, 1 where it is largest."""
        a, b, h = LAMP_AT
        return np.asarray((h * h / ((x - a) ** 2 + (y - b) ** 2 + h * h)) ** 1.5)

    def ramp(x: Array, y: Array) -> Array:
        return np.asarray(0.2 + 0.5 * x + 0.2 * y)

    def errors(field: object) -> tuple[Array, Array, Array]:
        assert callable(field)
        patches = field(*np.meshgrid(middle, middle))
        exact = field(*np.meshgrid(edge, edge))
        return vertex_values(patches), mean_values(patches), exact

    patches = lit(*np.meshgrid(middle, middle))
    found, means, exact = errors(lit)
    linear, _, linear_exact = errors(ramp)
    rim = np.ones_like(found, dtype=bool)
    rim[1:-1, 1:-1] = False

    figure, (left, right) = new_sketches((8.6, 4.3), 2)
    for axes, values, title in (
        (left, found, "corners inside: means; at the rim: extrapolated"),
        (right, means, "means everywhere"),
    ):
        sketch = Sketch(axes)
        for j in range(COUNT):
            for i in range(COUNT):
                shade = 0.25 + 0.7 * patches[j, i]
                square = [
                    [edge[i], edge[j]],
                    [edge[i + 1], edge[j]],
                    [edge[i + 1], edge[j + 1]],
                    [edge[i], edge[j + 1]],
                ]
                sketch.patch(square, face=(shade, shade, shade))
                sketch.label([middle[i], middle[j]], f"{patches[j, i]:.2f}", fontsize=8, color="#222222")
        for j in range(COUNT + 1):
            for i in range(COUNT + 1):
                at, off = np.array([edge[i], edge[j]]), 100 * (values[j, i] / exact[j, i] - 1)
                sketch.dot(at, 3.5, color=line_look(1 if rim[j, i] else 0)["color"])
                sketch.label(
                    at,
                    f"{values[j, i]:.2f}\n"
                    + ("0 %" if abs(off) < 0.5 else f"{off:+.0f} %".replace("-", "−")),
                    (0, 0),
                    fontsize=6.5,
                    color="#222222",
                    bbox={
                        "boxstyle": "round,pad=0.15",
                        "facecolor": "white",
                        "edgecolor": line_look(1 if rim[j, i] else 0)["color"],
                        "linewidth": 0.6,
                    },
                )
        axes.set_title(title)
        sketch.frame(0.08)
    x, y = np.meshgrid(edge, edge)
    return Sheet(
        picture=figure,
        columns={
            "x": x.ravel(),
            "y": y.ravel(),
            "by the rule": found.ravel(),
            "means": means.ravel(),
            "exact": exact.ravel(),
        },
        checks=(
            Check(
                "error of the rule on a linear ramp",
                float(np.abs(linear - linear_exact).max()),
                at_most=1e-12,
            ),
            Check(
                "mean error at the rim, over that of means",
                float(np.abs(found - exact)[rim].mean() / np.abs(means - exact)[rim].mean()),
                at_most=0.75,
            ),
            Check("largest difference inside", float(np.abs(found - means)[~rim].max()), at_most=0.0),
        ),
    )


def mean_values(patches: Array) -> Array:
    """Values at corners as means of the patches about them, at the rim of those that are there."""
    import numpy as np

    padded = np.pad(patches, 1, mode="edge")
    return np.asarray((padded[1:, 1:] + padded[1:, :-1] + padded[:-1, 1:] + padded[:-1, :-1]) / 4)


def vertex_values(patches: Array) -> Array:
    """The book's rule: inside means; at the rim what makes the middle towards the next corner within their mean."""
    found = mean_values(patches)
    inner = found[1:-1, 1:-1].copy()
    found[1:-1, 0], found[1:-1, -1] = 2 * found[1:-1, 0] - inner[:, 0], 2 * found[1:-1, -1] - inner[:, -1]
    found[0, 1:-1], found[-1, 1:-1] = 2 * found[0, 1:-1] - inner[0], 2 * found[-1, 1:-1] - inner[-1]
    for j in (0, -1):
        for i in (0, -1):
            found[j, i] = 2 * patches[j, i] - inner[j, i]
    return found


PLATE = Plate(
    number="4.24",
    title="From patch colours to vertex colours",
    shows="Radiosity gives a value to each patch, and pictures want them at corners. Inside a surface a corner has the "
    "mean of the patches about it (blue); at the rim (red) the value that, with the next corner within, has the "
    "mean of the adjacent patches in the middle between. Below each value its error against the exact one; a point "
    "light.",
    claim="The rule keeps a linear ramp exactly, up to the rim, and where light falls off with the distance it errs "
    "less than plain means do there.",
    today="The program fits a plane to the elements about a corner, weighed by nearness: the same on such a grid, "
    "and it also holds for triangles of any shape.",
    draw=draw,
    commands=("illuminant radiosity solve scenes/cornell.toml --elements 2000 -o cornell.solution",),
)
