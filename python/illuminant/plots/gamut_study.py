"""The gamut methods in plots: paths in the RGB cube (book figure 5.8) and deviation along gradients (figure 5.10)."""

from __future__ import annotations

import itertools
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import new_figure, save, styled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["save_deviation", "save_paths"]

COLOURS = ("orange", "yellow-green", "blue", "rose")
"""What the gradients of the figures are called, by their hue."""

_DASHES = ("-", (0, (5, 2)), (0, (2, 1.5)), "-.", (0, (1, 1)))

_HUES = (30.0, 80.0, 235.0, 340.0)


def _gradients(kind: str, steps: int) -> Array:
    """The gradients of the figures, (4, steps, 3), linear RGB of the small display."""
    from illuminant.display import displays, gamut_study

    small = gamut_study.small_display()
    every = gamut_study.gradients(small, displays.named("sRGB"), kind, hues=72, steps=steps)
    return every[[round(hue / 5.0) for hue in _HUES]]


def save_paths(methods: Sequence[str], path: str | os.PathLike[str]) -> None:
    """Draw where each method takes gradients that leave the RGB cube (figure 5.8), one cube for each method.

    Grey lines are the gradients asked for; coloured ones what is shown.

    Raises:
        UsageError: the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    import numpy as np

    from illuminant.display import gamut, gamut_study

    small = gamut_study.small_display()
    lines = np.concatenate([_gradients(kind, 129) for kind in ("bright", "saturated")])
    columns = min(len(methods), 3)
    rows = -(-len(methods) // columns)
    with styled():
        figure, first = new_figure((3.3 * columns, 3.1 * rows))
        first.remove()
        for number, method in enumerate(methods, start=1):
            axes = figure.add_subplot(rows, columns, number, projection="3d")
            _draw_cube(axes)
            for line in lines:
                inside = gamut.bring_inside(line, method, small)
                colour = np.clip(inside[len(line) // 2], 0.0, 1.0) ** (1 / 2.2)
                shown = line[(line > -0.4).all(axis=1) & (line < 1.5).all(axis=1)]
                axes.plot(*shown.T, color="0.6", linewidth=0.8, linestyle=":")
                axes.plot(*inside.T, color=colour, linewidth=1.8)
            axes.set_title(method)
            axes.set_xlabel("R", labelpad=-8)
            axes.set_ylabel("G", labelpad=-8)
            axes.set_zlabel("B", labelpad=-8)
            axes.set_xticks([0, 1], ["0", "1"])
            axes.set_yticks([0, 1], ["0", "1"])
            axes.set_zticks([0, 1], ["0", "1"])
            axes.tick_params(pad=-3)
            axes.view_init(elev=24, azim=-60)
            axes.set_box_aspect((1, 1, 1), zoom=1.0)
        save(figure, path)


def _draw_cube(axes: Any) -> None:
    """The edges of the cube, and its neutral axis."""
    corners = [(r, g, b) for r in (0, 1) for g in (0, 1) for b in (0, 1)]
    for one in corners:
        for other in corners:
            if one < other and sum(a != b for a, b in zip(one, other, strict=True)) == 1:
                axes.plot(*zip(one, other, strict=True), color="0.3", linewidth=0.7)
    axes.plot([0, 1], [0, 1], [0, 1], color="0.3", linewidth=0.7, linestyle="--")


def save_deviation(methods: Sequence[str], measure: str, path: str | os.PathLike[str]) -> None:
    """Plot the deviation of each method along gradients that leave the gamut (figure 5.10).

    Args:
        methods: names.
        measure: `lab` (ΔE*ab, as in the book) or `de00` (CIEDE2000).
        path: ends with .png or .svg.

    Raises:
        UsageError: the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    import numpy as np

    from illuminant.display import gamut, gamut_study

    small = gamut_study.small_display()
    steps = 513
    along = np.linspace(0.0, 1.0, steps)
    with styled():
        figure, first = new_figure((10.0, 5.4))
        first.remove()
        panels = figure.subplots(2, len(_HUES), sharex=True, sharey="row")
        for row, kind in zip(panels, gamut_study.KINDS, strict=True):
            for axes, name, line in zip(row, COLOURS, _gradients(kind, steps), strict=True):
                for method, dashes in zip(methods, itertools.cycle(_DASHES), strict=False):
                    shown = gamut.bring_inside(line, method, small)
                    delta_e, lab = gamut_study.deviation(line, shown, small)
                    axes.plot(
                        along,
                        lab if measure == "lab" else delta_e,
                        label=method,
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
        save(figure, path)
