"""The gamut methods in plots: paths in the RGB cube (book figure 5.8) and deviation along gradients (figure 5.10)."""

from __future__ import annotations

import itertools
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import line_look, new_figure, save, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["COLOURS", "deviation", "gradients", "paths", "save_deviation", "save_paths"]

COLOURS = ("orange", "yellow-green", "blue", "rose")
"""What the gradients of the figures are called, by their hue."""

_DASHES = ("-", (0, (5, 2)), (0, (2, 1.5)), "-.", (0, (1, 1)))

_HUES = (30.0, 80.0, 235.0, 340.0)


def gradients(kind: str, steps: int) -> Array:
    """The gradients of the figures, (4, steps, 3), linear RGB of the small display, in the order of `COLOURS`."""
    from illuminant.display import displays, gamut_study

    small = gamut_study.small_display()
    every = gamut_study.gradients(small, displays.named("sRGB"), kind, hues=72, steps=steps)
    return every[[round(hue / 5.0) for hue in _HUES]]


def paths(methods: Sequence[str]) -> Figure:
    """Where each method takes gradients that leave the RGB cube (figure 5.8), one cube for each method.

    Grey lines are the gradients asked for; coloured ones what is shown.
    """
    import numpy as np

    from illuminant.color import hsv_to_rgb
    from illuminant.display import gamut, gamut_study

    small = gamut_study.small_display()
    lines = np.concatenate([gradients(kind, 129) for kind in gamut_study.KINDS])
    hues = hsv_to_rgb([[hue, 0.95, 0.82] for hue in (*_HUES, *_HUES)])
    columns = min(len(methods), 3)
    rows = -(-len(methods) // columns)
    low, high = -0.18, 1.32  # of what is seen beside the cube
    with styled():
        figure, first = new_figure((3.0 * columns, 3.0 * rows))
        first.remove()
        for number, method in enumerate(methods, start=1):
            axes = figure.add_subplot(rows, columns, number, projection="3d")
            axes.set_axis_off()
            _draw_cube(axes)
            for line, colour in zip(lines, hues, strict=True):
                inside = gamut.bring_inside(line, method, small)
                asked = line[(line > low).all(axis=1) & (line < high).all(axis=1)]
                axes.plot(*asked.T, color="0.5", linewidth=0.9, linestyle=":")
                axes.plot(*inside.T, color=colour, linewidth=1.8)
            axes.set_title(method, y=1.0)
            for name, corner in zip("RGB", np.eye(3), strict=True):
                axes.text(*(1.14 * corner), name, ha="center", va="center")
            axes.set(xlim=(low, high), ylim=(low, high), zlim=(low, high))
            axes.view_init(elev=24, azim=-60)
            axes.set_box_aspect((1, 1, 1), zoom=1.32)
    return figure


def save_paths(methods: Sequence[str], path: str | os.PathLike[str]) -> None:
    """Draw the paths of methods into a file (figure 5.8).

    Raises:
        UsageError: the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    save(paths(methods), path)


def _draw_cube(axes: Any) -> None:
    """The edges of the cube, and its neutral axis."""
    corners = [(r, g, b) for r in (0, 1) for g in (0, 1) for b in (0, 1)]
    for one in corners:
        for other in corners:
            if one < other and sum(a != b for a, b in zip(one, other, strict=True)) == 1:
                axes.plot(*zip(one, other, strict=True), color="0.3", linewidth=0.7)
    axes.plot([0, 1], [0, 1], [0, 1], color="0.3", linewidth=0.7, linestyle="--")


def deviation(
    methods: Sequence[str], measure: str = "lab", *, steps: int = 513, size: tuple[float, float] = (10.0, 5.4)
) -> Figure:
    """The deviation of each method along gradients that leave the gamut (figure 5.10).

    Args:
        methods: names.
        measure: `lab` (ΔE*ab, as in the book) or `de00` (CIEDE2000).
        steps: colours of a gradient.
        size: width and height, inches.
    """
    import numpy as np

    from illuminant.display import gamut, gamut_study

    small = gamut_study.small_display()
    along = np.linspace(0.0, 1.0, steps)
    with styled():
        figure, first = new_figure(size)
        first.remove()
        panels = figure.subplots(2, len(_HUES), sharex=True, sharey="row")
        for row, kind in zip(panels, gamut_study.KINDS, strict=True):
            for axes, name, line in zip(row, COLOURS, gradients(kind, steps), strict=True):
                for number, (method, dashes) in enumerate(
                    zip(methods, itertools.cycle(_DASHES), strict=False)
                ):
                    shown = gamut.bring_inside(line, method, small)
                    delta_e, lab = gamut_study.deviation(line, shown, small)
                    axes.plot(
                        along,
                        lab if measure == "lab" else delta_e,
                        label=method,
                        color=line_look(number)["color"],
                        linewidth=1.4,
                        linestyle=dashes,
                    )
                axes.set_title(f"{name}, {'brighter' if kind == 'bright' else 'more saturated'}", fontsize=9)
                axes.set_xlim(0.0, 1.0)
        for axes in panels[1]:
            axes.set_xlabel("along the gradient")
        for axes in panels[:, 0]:
            axes.set_ylabel("ΔE*ab" if measure == "lab" else "ΔE00")
        panels[0, 0].legend(fontsize=7, loc="upper left")
    return figure


def save_deviation(methods: Sequence[str], measure: str, path: str | os.PathLike[str]) -> None:
    """Plot the deviation of methods into a file (figure 5.10).

    Raises:
        UsageError: the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    save(deviation(methods, measure), path)
