"""Energy over roughness and incidence: maps in the place of the book's surfaces, and sections through them.

A map has the height σ upwards and the angle of incidence to the right; what lies below 0 or above 1, where the theory
makes light, is orange. Below each map stand sections at the heights `reflected_energy.HEIGHTS_NM`, with the series of
D whole, dashed as the book computes it, and what the model `general` does at the greatest height.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.atlas.chapter_2.reflected_energy import HEIGHTS_NM, SLOPES, Equilibrium, equilibrium

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["TITLES", "Column", "columns", "panels", "share_bar", "share_map", "today"]

TITLES = tuple(f"m = {m:.2f}" for m in SLOPES)

IMPOSSIBLE = "#E69F00"
"""The colour of a share below 0 or above 1."""

BAND: dict[str, Any] = {"color": "#000000", "linewidth": 4.8, "alpha": 0.28, "solid_capstyle": "butt"}
"""What is done today, broad and pale: it lies behind the sections and shows where they agree with it."""

TOLERANCE = 0.005
"""What is left of that to the errors of integration and of the series as the book cuts it."""


@dataclass(frozen=True)
class Column:
    """A map and the sections below it.

    Attributes:
        title: above the map.
        theta_deg, sigma_nm, share: of the map; rows of heights, columns of angles.
        at_deg: angles of the sections.
        cut: shares at `HEIGHTS_NM`, rows of heights.
        printed: as the book computes them, if it differs.
        today: angles and shares of the model `general` at the greatest of the heights.
    """

    title: str
    theta_deg: Array
    sigma_nm: Array
    share: Array
    at_deg: Array
    cut: Array
    printed: Array | None = None
    today: tuple[Array, Array] | None = None


def today(m: float, quick: bool) -> Equilibrium:
    """What `general` does at the greatest of the heights."""
    angles = (0, 40, 70, 80, 89) if quick else (0, 20, 40, 50, 60, 65, 70, 75, 80, 83, 86, 89)
    return equilibrium(m, HEIGHTS_NM[-1], tuple(map(float, angles)), 8_000)


def share_map(axes: Any, x: Array, y: Array, share: Array, colours: str = "Blues_r") -> tuple[Any, Any]:
    """Draw a share from 0 to 1, orange where it is neither, with lines at each quarter.

    Args:
        axes: of matplotlib.
        x, y: of the columns and rows.
        share: rows of y, columns of x.
        colours: from 0 to 1, by a name of matplotlib.

    Returns:
        The filled contours and the lines, for `share_bar`.
    """
    import numpy as np
    from matplotlib import colormaps

    from illuminant.plots.style import INK

    scale = colormaps[colours].with_extremes(under=IMPOSSIBLE, over=IMPOSSIBLE)
    levels = np.r_[-TOLERANCE, np.linspace(0.05, 0.95, 19), 1.0 + TOLERANCE]
    filled = axes.contourf(x, y, share, levels=levels, cmap=scale, vmin=0.0, vmax=1.0, extend="both")
    return filled, axes.contour(x, y, share, levels=[0.25, 0.5, 0.75], colors=INK, linewidths=0.7)


def share_bar(figure: Figure, axes: Sequence[Any], shown: tuple[Any, Any], what: str) -> None:
    """The scale of maps, beside them.

    Args:
        figure: of the maps.
        axes: of the maps.
        shown: from `share_map`.
        what: its label.
    """
    filled, lines = shown
    bar = figure.colorbar(filled, ax=list(axes), ticks=(0, 0.25, 0.5, 0.75, 1.0), aspect=14, pad=0.01)
    bar.set_label(what)
    bar.add_lines(lines)


def panels(
    columns: Sequence[Column], what: str, limits: tuple[float, float], colours: str = "Blues_r"
) -> Figure:
    """The figure.

    Args:
        columns: from left to right.
        what: the share that is shown.
        limits: of the axis of the sections.
        colours: of the maps from 0 to 1, by a name of matplotlib; white where nothing is amiss.
    """
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from illuminant.plots.style import DPI, GREY, PRINTED, line_look

    figure = Figure(figsize=(9.0, 5.2), dpi=DPI, layout="constrained", facecolor="white")
    grid: Any = figure.subplots(2, len(columns), sharex=True, sharey="row", squeeze=False)
    shown: Any = None
    for number, (column, (above, below)) in enumerate(zip(columns, grid.T, strict=True)):
        shown = share_map(above, column.theta_deg, column.sigma_nm, column.share, colours)
        above.set(title=column.title, xlim=(0, 90), xticks=(0, 30, 60, 90))
        below.axhline(1.0, color=GREY, linewidth=0.6)
        below.axhline(0.0, color=GREY, linewidth=0.6)
        if column.today is not None:
            below.plot(*column.today, **BAND)
        for i, values in enumerate(column.cut):
            below.plot(column.at_deg, values, **line_look(i))
            if column.printed is not None:
                below.plot(column.at_deg, column.printed[i], **{**line_look(i), **PRINTED})
        below.set(xlabel="incidence θ, degrees", ylim=limits)
        below.grid(True)
        if number == 0:
            above.set_ylabel("height σ, nm")
            below.set_ylabel(what)
    share_bar(figure, grid[0].tolist(), shown, what)
    entries: list[Line2D] = [Line2D([], [], **line_look(i)) for i in range(len(HEIGHTS_NM))]
    labels = [f"σ = {height:g} nm" for height in HEIGHTS_NM]
    if any(column.printed is not None for column in columns):
        entries.append(Line2D([], [], color=GREY, **PRINTED))
        labels.append("D as in III.4")
    if any(column.today is not None for column in columns):
        entries.append(Line2D([], [], **BAND))
        labels.append(f"today: general, σ = {HEIGHTS_NM[-1]:g} nm")
    figure.legend(entries, labels, loc="outside lower center", ncols=len(labels))
    return figure


def columns(shown: Sequence[Column], share: str) -> Mapping[str, Any]:
    """The data of a figure in long format.

    Args:
        shown: the maps and sections.
        share: name of the share.
    """
    import numpy as np

    kinds: list[str] = []
    titles: list[str] = []
    rows: list[Array] = []

    def add(kind: str, title: str, theta: Array, sigma: Array, values: Array) -> None:
        t, s = (one.ravel() for one in np.meshgrid(theta, sigma))
        rows.append(np.stack([t, s, np.ravel(values)]))
        kinds.extend([kind] * t.size)
        titles.extend([title] * t.size)

    heights = np.array(HEIGHTS_NM)
    for one in shown:
        add("map", one.title, one.theta_deg, one.sigma_nm, one.share)
        add("section", one.title, one.at_deg, heights, one.cut)
        if one.printed is not None:
            add("section, D as in III.4", one.title, one.at_deg, heights, one.printed)
        if one.today is not None:
            add("today", one.title, one.today[0], heights[-1:], one.today[1])
    theta, sigma, values = np.concatenate(rows, axis=1)
    return {"curve": kinds, "surface": titles, "theta, degrees": theta, "sigma, nm": sigma, share: values}
