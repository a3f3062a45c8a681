"""What figures IV.1 and IV.2 share: a hemi-cube whose cells are shaded by their delta form factors, and one of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Sheet
from illuminant.plots.sketch import Sketch, View, new_sketches

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["draw_cell", "face_sheet", "shades"]

RESOLUTION = 16


def shades(delta: NDArray[np.float64]) -> list[tuple[float, float, float]]:
    """From white for none to a blue for the largest."""
    import numpy as np

    part = np.clip(delta / delta.max(), 0.0, 1.0)
    blue = np.array([0.0, 0.45, 0.70])
    return [tuple(1.0 - 0.85 * p * (1.0 - blue)) for p in part]


def draw_cell(top: bool, chosen: tuple[float, float]) -> tuple[Figure, NDArray[np.float64]]:
    """The half cube with the cell of a face nearest to a place, its distance, its angles; the middle of that cell."""
    import numpy as np

    from illuminant.atlas.chapter_4.hemicube import hemicube
    from illuminant.plots.style import GREY, line_look

    red = line_look(1)["color"]
    cells = hemicube(RESOLUTION)
    view = View(38.0, 26.0)
    figure, (axes,) = new_sketches((6.4, 5.0))
    sketch = Sketch(axes, view)
    # The side towards x and the top are seen; the side towards y too. All stand but those that hide the middle.
    face = 0 if top else 1
    shown = (cells.faces == face) | (cells.faces == (3 if top else 4))
    per_area = shades(cells.delta)
    sketch.patches(
        [one for one, yes in zip(cells.corners, shown & (cells.faces != face), strict=True) if yes],
        [one for one, yes in zip(per_area, shown & (cells.faces != face), strict=True) if yes],
        linewidths=0.2,
        zorder=1.5,
        alpha=0.55,
    )
    base = np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]], float)
    sketch.patch(base, face="#efece5", zorder=1)
    own = cells.faces == face
    sketch.patches(
        [one for one, yes in zip(cells.corners, own, strict=True) if yes],
        [one for one, yes in zip(per_area, own, strict=True) if yes],
        linewidths=0.3,
        zorder=3,
        alpha=0.8,
    )
    sketch.box([-1, -1, 0], [1, 1, 1])
    x, y, z = np.eye(3)
    place = np.array([chosen[0], chosen[1], 1.0]) if top else np.array([1.0, chosen[0], chosen[1]])
    number = int(np.argmin(np.linalg.norm(cells.middles - place, axis=1) + 9.0 * ~own))
    middle = cells.middles[number]
    sketch.patch(cells.corners[number], face=red, edge=red, zorder=6)
    for axis, name in ((x, "x"), (y, "y"), (z, "z")):
        sketch.arrow([0, 0, 0], 1.45 * axis, name, GREY, linewidth=0.8, zorder=4)
    sketch.line([[0, 0, 0], middle], color=red, linewidth=1.4, zorder=6)
    sketch.label((0.3 if top else 0.55) * middle, "$r$", (10, -3) if top else (2, -13), color=red)
    sketch.dot([0, 0, 0])
    sketch.angle([0, 0, 0], z, middle, 0.42, "" if top else "$\\theta_n$", "#222222", 10.0)
    outward = z if top else x
    sketch.arrow(middle, middle + 0.4 * outward, zorder=7, linewidth=1.0)
    sketch.line([middle, middle * 1.32], color=red, linewidth=0.7, linestyle=(0, (3, 2)), zorder=6)
    sketch.angle(middle, outward, middle, 0.26, "" if top else "$\\theta_m$", "#222222", 11.0)
    if top:
        # Both arcs are narrow: their labels stand beside them.
        sketch.label([0.0, 0.0, 0.36], "$\\theta_n$", (-11, 0))
        sketch.label(middle + 0.26 * z, "$\\theta_m$", (15, -4))
        foot = np.array([middle[0], 0.0, 1.0])
        sketch.line([z, foot, middle], color="#222222", linewidth=0.8, linestyle=(0, (3, 2)), zorder=6)
        sketch.label((z + foot) / 2, "$x_q$", (6, -8), fontsize=9)
        sketch.label(0.3 * foot + 0.7 * middle, "$y_q$", (6, 9), fontsize=9)
    else:
        foot = np.array([1.0, middle[1], 0.0])
        sketch.line([x, foot, middle], color="#222222", linewidth=0.8, linestyle=(0, (3, 2)), zorder=6)
        sketch.label((x + foot) / 2, "$y_q$", (3, -9), fontsize=9)
        sketch.label((foot + middle) / 2, "$z_q$", (10, 0), fontsize=9)
    sketch.label(middle, "$\\Delta A_q$", (26, -10) if top else (4, 19), color=red)
    sketch.frame()
    return figure, middle


def face_sheet(
    top: bool,
    chosen: tuple[float, float],
    face: list[list[int]],
    equation: str,
    printed: Callable[[NDArray[np.float64]], float],
) -> Sheet:
    """The drawing of a face, its delta form factors, and their sums against the exact form factor of that face.

    Args:
        top: the top, or the side towards x.
        chosen: where in the face the drawn cell lies.
        face: corners of the face.
        equation: of the delta form factor, as the check names it.
        printed: that form factor per area at the middle of a cell, times π, as the book prints it.
    """
    import numpy as np

    from illuminant.atlas.chapter_4.hemicube import hemicube, point_to_polygon

    figure, middle = draw_cell(top, chosen)
    cells, fine = hemicube(RESOLUTION), hemicube(64)
    number = 0 if top else 1
    own = cells.faces == number
    error = [abs(float(hemicube(n).delta.sum()) - 1.0) for n in (32, 64)]
    share = float(fine.delta[fine.faces == number].sum()) / point_to_polygon(np.array(face, float))
    drawn = int(np.argmin(np.linalg.norm(cells.middles - middle, axis=1)))
    stated = (2.0 / RESOLUTION) ** 2 * printed(middle) / np.pi
    return Sheet(
        picture=figure,
        columns={
            **{axis: cells.middles[own, i] for i, axis in enumerate("xyz")},
            "delta form factor": cells.delta[own],
            "as printed, for intensities": np.pi * cells.delta[own],
        },
        checks=(
            Check("sum over all cells of a cube of 64, less 1", error[1], at_most=1e-3),
            Check("error at 32 cells along an edge over that at 64", error[0] / error[1], "", 3.5, 4.5),
            Check(
                f"share of the {'top' if top else 'side'} over its exact form factor", share, "", 0.999, 1.001
            ),
            Check(
                f"drawn cell over eq {equation} divided by π, less 1",
                abs(float(cells.delta[drawn]) / stated - 1.0),
                at_most=1e-12,
            ),
        ),
    )
