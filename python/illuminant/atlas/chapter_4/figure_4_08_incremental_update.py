"""Figure 4.8: a value updated by additions along edges and across a scanline (book 4.2.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

CORNERS = ((3.0, 1.0), (19.5, 6.5), (8.0, 15.0))
VALUES = (0.15, 0.95, 0.5)
DEPTHS = (1.0, 3.0, 1.5)
"""A triangle in pixels, with a value and the distance from the eye at each corner."""

MARKED = 9


def draw(quick: bool) -> Sheet:
    """The triangle with the values that additions give; beside it one scanline, on the screen and in space."""
    import numpy as np

    from illuminant.plots.sketch import Sketch, new_sketches
    from illuminant.plots.style import GREY, TODAY, line_look

    corners, values, depths = np.array(CORNERS), np.array(VALUES), np.array(DEPTHS)
    x, row, found = _scan(corners, values)
    shares = _shares(corners, np.stack([x, row], axis=-1))
    plane = shares @ values
    # What lies between corners in space: values over distances, and 1 over distances, are linear on the screen.
    in_space = (shares @ (values / depths)) / (shares @ (1.0 / depths))

    figure, (left, right) = new_sketches((8.8, 4.2), 2)
    sketch = Sketch(left)
    pixel = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    boxes = [pixel + np.array([a, b]) for a, b in zip(x, row, strict=True)]
    sketch.patches(boxes, [(v, v, v) for v in found], linewidths=0.2)
    sketch.line(np.vstack([corners, corners[:1]]), color="#222222", linewidth=1.3, zorder=5)
    red = line_look(1)["color"]
    on = row == MARKED
    sketch.line(
        [[x[on].min() - 0.5, MARKED], [x[on].max() + 0.5, MARKED]], color=red, linewidth=1.0, zorder=6
    )
    sketch.arrow([x[on].min() + 2, MARKED], [x[on].min() + 6, MARKED], colour=red)
    sketch.label([x[on].min(), MARKED], "start of the span", (-12, 10), color=red, ha="right", fontsize=8.5)
    for name, corner, value, shift in zip("ABC", corners, values, ((-14, -8), (26, 0), (0, 12)), strict=True):
        sketch.dot(corner)
        sketch.label(corner, f"{name}: {value:g}", shift)
    edge = corners[2] - corners[0]
    middle = corners[0] + 0.2 * edge
    sketch.arrow(middle - [1.0, 0.0], middle + 0.2 * edge - [1.0, 0.0])
    sketch.label(middle - [1.0, 0.0], "rate per\nscanline", (-24, 10), fontsize=8.5)
    sketch.label([x[on].max() + 0.5, MARKED], "rate per pixel", (6, 6), color=red, fontsize=8.5, ha="left")
    sketch.paper([[-5.0, 0.0], [23.5, 0.0]])
    sketch.frame(0.03)

    right.plot(x[on], found[on], drawstyle="steps-mid", **line_look(1), label="by additions, on the screen")
    right.plot(x[on], in_space[on], **TODAY, label="in space (today)")
    right.plot(
        x[on],
        plane[on],
        linestyle="none",
        marker="o",
        markersize=2.5,
        color=GREY,
        label="plane through A, B, C",
    )
    right.set(xlabel="pixel of the marked scanline", ylabel="value", title=f"scanline {MARKED}")
    right.grid(True)
    right.legend()
    return Sheet(
        picture=figure,
        columns={"pixel": x, "scanline": row, "by additions": found, "plane": plane, "in space": in_space},
        checks=(
            Check(
                "by additions less the plane through the corners",
                float(np.abs(found - plane).max()),
                at_most=1e-12,
            ),
            Check(
                "largest difference between screen and space",
                float(np.abs(found - in_space).max()),
                at_least=0.05,
            ),
        ),
    )


def _scan(corners: Array, values: Array) -> tuple[Array, Array, Array]:
    """Pixels whose middles are inside, with the value that additions give: one for a scanline, one for a pixel."""
    import numpy as np

    order = np.argsort(corners[:, 1])
    (low, middle, high), (a, b, c) = corners[order], values[order]
    columns, rows, found = [], [], []
    # Each edge: where it is at a scanline, the value there, and the rates of both per scanline.
    edges = []
    for (first, second), (v, w) in (((low, high), (a, c)), ((low, middle), (a, b)), ((middle, high), (b, c))):
        rise = second[1] - first[1]
        start = np.ceil(first[1])
        slope, rate = (second[0] - first[0]) / rise, (w - v) / rise
        edges.append(
            [
                start,
                second[1],
                first[0] + (start - first[1]) * slope,
                v + (start - first[1]) * rate,
                slope,
                rate,
            ]
        )
    for line in range(int(np.ceil(low[1])), int(np.floor(high[1])) + 1):
        active = [edge for edge in edges if edge[0] <= line <= edge[1]]
        left, right = sorted(active[:2], key=lambda edge: float(edge[2]))
        width = right[2] - left[2]
        if width > 0.0:
            per_pixel = (right[3] - left[3]) / width
            pixel = np.ceil(left[2])
            value = left[3] + (pixel - left[2]) * per_pixel
            while pixel <= right[2]:
                columns.append(pixel)
                rows.append(float(line))
                found.append(value)
                pixel, value = pixel + 1.0, value + per_pixel
        for edge in active:
            edge[2] += edge[4]
            edge[3] += edge[5]
    return np.array(columns), np.array(rows), np.array(found)


def _shares(corners: Array, points: Array) -> Array:
    """Barycentric coordinates of points (n, 2), (n, 3)."""
    import numpy as np

    square = np.vstack([corners.T, np.ones(3)])
    return np.asarray(np.linalg.solve(square, np.vstack([points.T, np.ones(len(points))])).T)


PLATE = Plate(
    number="4.8",
    title="Incremental update across a scanline",
    shows="A value at the corners of a polygon is carried along its edges by adding a rate per scanline, and across a "
    "scanline by adding a rate per pixel. Here a triangle on a raster; A, B and C are 1, 3 and 1.5 away from the eye.",
    claim="One addition a pixel gives exactly the plane through the values at the corners, on the screen; in space the "
    "value between them is another, for perspective is not linear.",
    today="Values are divided by the distance before they are interpolated and multiplied by it after that "
    "(`--interpolation object`, what is taken if nothing is said); `screen` is the book's.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique gouraud --interpolation screen --samples 4 -o screen.png",
    ),
)
