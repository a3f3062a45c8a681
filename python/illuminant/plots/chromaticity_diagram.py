"""A chromaticity diagram, drawn: ground, spectral locus, Planckian locus, gamuts and points (book figures 3.7, 3.9)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError
from illuminant.plots import labels
from illuminant.plots import observer as observers
from illuminant.plots.diagram import Diagram, diagram
from illuminant.plots.monochromatic import brightest
from illuminant.plots.style import INK, new_figure, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    Points = NDArray[np.float64]

__all__ = ["CLOSE_TEMPERATURES_K", "TEMPERATURES_K", "WAVELENGTHS_NM", "chromaticity"]

WAVELENGTHS_NM = (420, 440, 460, 470, 480, 490, *range(500, 601, 10), 620, 700)
"""Wavelengths marked on the spectral locus; where marks crowd, some go without a name."""

TEMPERATURES_K = (2000, 3000, 4000, 6500, 10000)
"""Colour temperatures marked on the Planckian locus."""

CLOSE_TEMPERATURES_K = (1800, 2200, 2700, 3000, 3500, 4000, 5000, 5700, 6500, 8000, 10000, 20000)
"""Those marked in a diagram that is zoomed; lamps are sold by most of them."""

_GAMUTS = ("#000000", "#8E24AA", "#00695C", "#C2185B", "#4E342E", "#1565C0")
_NUMBERED = 12  # beyond so many points, numbers stand beside them and the names in the legend


def chromaticity(
    kind: str | Sequence[float] | Diagram = "xy",
    points: Mapping[str, ArrayLike] | None = None,
    *,
    gamuts: Sequence[str] = (),
    observer: str | observers.Functions = "1931",
    planckian: bool | None = None,
    plain: bool = False,
    zoom: bool = False,
    size: tuple[float, float] | None = None,
) -> Figure:
    """A chromaticity diagram with the spectral locus.

    The ground shows each chromaticity as bright as sRGB can; outside the gamut of sRGB it is clipped, so the colours
    there are the nearest that the file can hold and not the true ones.

    Args:
        kind: "xy", "uv" (u'v' of 1976), three wavelengths of primaries, or a `Diagram`.
        points: names, and where each lies (2,), from `Diagram.point`.
        gamuts: names of RGB systems whose triangles are drawn, each with its white.
        observer: a name, see `observer.named`, or its functions; a `Diagram` has its own.
        planckian: draw the locus of blackbodies; None: in xy and u'v', and not for primaries.
        plain: white ground.
        zoom: show only the surroundings of the points.
        size: width and height, inches; None: as wide as it takes for a diagram 7 inches wide.

    Raises:
        UsageError: no such diagram, observer or RGB system; `zoom` without points.

    Example:
        >>> from illuminant import spectra
        >>> from illuminant.plots.diagram import diagram
        >>> figure = chromaticity("xy", {"A": diagram("xy").point(spectra.load("A"))}, gamuts=["sRGB"])
        >>> figure.axes[0].get_xlabel()
        'x'
    """
    import numpy as np

    plane = kind if isinstance(kind, Diagram) else diagram(kind, observer)
    given = {name: np.asarray(at, dtype=np.float64) for name, at in (points or {}).items()}
    if plane.primaries_nm:
        corners = plane.project(plane.observer.at(plane.primaries_nm))
        given |= {f"{w:g} nm": at for w, at in zip(plane.primaries_nm, corners, strict=True)}
    triangles = [plane.gamut(system) for system in gamuts]
    _, locus = plane.spectral_locus()
    if zoom and not points:
        raise UsageError("A diagram can be zoomed to points only, and none is given.")
    if zoom:
        low, high = _window([given[name] for name in points or ()])
    else:
        low, high = _extent(
            [locus, *(triangle for _, triangle, _ in triangles), *([at] for at in given.values())]
        )
    numbered = len(given) > _NUMBERED
    if size is None:
        aspect = float((high - low)[1] / (high - low)[0])
        size = (7.0 + (2.4 if numbered else 0.0), 6.3 * aspect + 0.9)
    with styled():
        figure, axes = new_figure(size)
        axes.set_aspect("equal")
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.grid(True)
        axes.set_xlabel(plane.axes[0])
        axes.set_ylabel(plane.axes[1])
        axes.set_title(f"{plane.title}, {plane.observer.title}", wrap=True)
        if not plain:
            _draw_ground(axes, plane, locus, (low, high))
        _draw_locus(axes, locus)
        handles = _draw_gamuts(axes, triangles)
        if plane.primaries_nm:
            _outline(axes, corners, "#333333", linewidth=1.0)
        temperatures: tuple[int, ...] = ()
        if (not plane.primaries_nm) if planckian is None else planckian:
            temperatures = CLOSE_TEMPERATURES_K if zoom else TEMPERATURES_K
            handles += _draw_planckian(axes, plane, temperatures)
        marks = _draw_points(axes, given, numbered)
        if numbered:
            figure.legend(handles=[*handles, *marks], loc="outside right upper")
        elif handles and zoom:
            figure.legend(handles=handles, loc="outside lower left", ncols=4)
        elif handles:
            # Colours lie below the line x + y = 1, and u'v' leaves the corner of the reds' purples empty.
            below = plane.axes[0] == "u'"
            axes.legend(handles=handles, loc="lower right" if below else "upper right")
        # Names are placed on the paper, so its measures have to be known.
        figure.draw_without_rendering()
        taken = _name_wavelengths(axes, plane, locus)
        _name_points(axes, plane, given, temperatures, taken, numbered)
    return figure


def _extent(parts: Sequence[ArrayLike]) -> tuple[Points, Points]:
    """Two corners of what is shown, with a margin for names."""
    import numpy as np

    everything = np.concatenate([np.asarray(part, dtype=np.float64) for part in parts])
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.07 * float((high - low).max())
    return low - margin, high + margin


def _window(points: Sequence[Points]) -> tuple[Points, Points]:
    """Two corners of a square around points, with room for their names and some of the locus of blackbodies."""
    import numpy as np

    given = np.array(points)
    centre = (given.min(axis=0) + given.max(axis=0)) / 2
    half = 0.65 * float((given.max(axis=0) - given.min(axis=0)).max()) + 0.015
    return centre - half, centre + half


def _draw_ground(axes: Axes, plane: Diagram, locus: Points, window: tuple[Points, Points]) -> None:
    """The inside of the spectral locus, as far as it is shown, in its colours, cut along the locus."""
    import numpy as np
    from matplotlib.patches import Polygon

    low, high = np.maximum(locus.min(axis=0), window[0]), np.minimum(locus.max(axis=0), window[1])
    steps = (np.arange(512) + 0.5) / 512
    x, y = low[0] + (high[0] - low[0]) * steps, low[1] + (high[1] - low[1]) * steps
    image = axes.imshow(
        brightest(plane.colour(np.stack(np.meshgrid(x, y), axis=-1))),
        origin="lower",
        extent=(low[0], high[0], low[1], high[1]),
        interpolation="bilinear",
        aspect="equal",
        zorder=1,
    )
    image.set_clip_path(Polygon(locus, closed=True, transform=axes.transData))


def _draw_locus(axes: Axes, locus: Points) -> None:
    """The spectral locus, and the line of purples."""
    axes.plot(*locus.T, color=INK, linewidth=1.2, zorder=3)
    axes.plot(*locus[[0, -1]].T, color=INK, linewidth=1.0, linestyle=(0, (4, 2)), zorder=3)


def _outline(axes: Axes, corners: Points, colour: str, **look: Any) -> list[Any]:
    """A closed line with a white edge, which shows on any ground."""
    import numpy as np
    from matplotlib.patheffects import Normal, Stroke

    closed = np.concatenate([corners, corners[:1]])
    effects = [Stroke(linewidth=look.get("linewidth", 1.5) + 1.4, foreground="white"), Normal()]
    return list(axes.plot(*closed.T, color=colour, zorder=4, path_effects=effects, **look))


def _draw_gamuts(axes: Axes, triangles: Sequence[tuple[str, Points, Points]]) -> list[Any]:
    """Triangles of RGB systems, each with a cross at its white; the lines for the legend."""
    handles: list[Any] = []
    for number, (name, corners, white) in enumerate(triangles):
        colour = _GAMUTS[number % len(_GAMUTS)]
        handles += _outline(axes, corners, colour, linewidth=1.4, label=name)
        axes.plot(*white, marker="+", markersize=7, color=colour, zorder=5)
    return handles


def _planckian_points(plane: Diagram) -> Points:
    """Blackbodies from 1,500 K to 100,000 K, evenly in 1 / T."""
    import numpy as np

    return plane.planckian_locus(1e6 / np.linspace(1e6 / 1500, 10, 150))


def _draw_planckian(axes: Axes, plane: Diagram, temperatures: Sequence[int]) -> list[Any]:
    """The locus of blackbodies with marks at some temperatures; the line for the legend."""
    line = axes.plot(*_planckian_points(plane).T, color=INK, linewidth=1.0, zorder=3, label="blackbodies")
    marked = plane.planckian_locus(temperatures)
    axes.plot(*marked.T, linestyle="none", marker=".", markersize=4, color=INK, zorder=3)
    return list(line)


def _draw_points(axes: Axes, points: Mapping[str, Points], numbered: bool) -> list[Any]:
    """A circle for each point; the marks for a legend in which they are numbered."""
    marks: list[Any] = []
    for number, (name, at) in enumerate(points.items(), start=1):
        marks += axes.plot(
            *at,
            marker="o",
            markersize=4.5 if numbered else 5.5,
            markerfacecolor="white",
            markeredgecolor="black",
            markeredgewidth=1.0,
            linestyle="none",
            zorder=6,
            label=f"{number}  {name}",
        )
    return marks


# --- names --------------------------------------------------------------------------------------------------


def _on_paper(axes: Axes, points: ArrayLike) -> list[tuple[float, float]]:
    """Points (n, 2) of the diagram in 1/72 inch on the paper."""
    import numpy as np

    scale = 72.0 / axes.figure.dpi
    return [(float(x), float(y)) for x, y in axes.transData.transform(np.atleast_2d(points)) * scale]


def _name(axes: Axes, text: str, at: Points, offset: tuple[float, float], size: float) -> None:
    """A text whose centre lies at an offset, in 1/72 inch, from a point of the diagram."""
    from matplotlib.patheffects import withStroke

    annotation = axes.annotate(
        text,
        tuple(at),
        xytext=offset,
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=size,
        zorder=7,
        path_effects=[withStroke(linewidth=1.6, foreground="white", alpha=0.75)],
    )
    annotation.set_in_layout(False)


def _name_wavelengths(axes: Axes, plane: Diagram, locus: Points) -> list[labels.Box]:
    """Ticks on the outside of the spectral locus, with names where there is room; the boxes of the names."""
    import numpy as np

    size = 7.5
    centre = np.array(_on_paper(axes, locus.mean(axis=0)))[0]
    taken: list[labels.Box] = []
    corners = (
        np.array(_on_paper(axes, plane.project(plane.observer.at(plane.primaries_nm))))
        if plane.primaries_nm
        else ()
    )
    # The ends first: they are the last to go without a name.
    for wavelength in sorted(WAVELENGTHS_NM, key=lambda w: (w % 20 != 0, w)):
        three = plane.project(plane.observer.at([wavelength - 1.0, wavelength, wavelength + 1.0]))
        before, at, after = np.array(_on_paper(axes, three))
        along = after - before
        normal = np.array([along[1], -along[0]]) / max(float(np.hypot(*along)), 1e-12)
        if normal @ (at - centre) < 0:
            normal = -normal
        arrow = {"arrowstyle": "-", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
        tick = axes.annotate(
            "", tuple(three[1]), tuple(4.5 * normal), textcoords="offset points", arrowprops=arrow, zorder=3
        )
        tick.set_in_layout(False)
        text = f"{wavelength} nm" if wavelength == max(WAVELENGTHS_NM) else f"{wavelength}"
        width, height = labels.extent(text, size)
        # Where the locus hardly moves, a name beside a primary would be taken for the primary's.
        if any(
            abs(wavelength - primary) > 12 and np.hypot(*(at - corner)) < 25
            for primary, corner in zip(plane.primaries_nm, corners, strict=True)
        ):
            continue
        # The nearest edge of the name lies just beyond the tick.
        offset = normal * (6.5 + abs(normal[0]) * width / 2 + abs(normal[1]) * height / 2 - 1.0)
        x, y = at + offset
        box = (x - width / 2, y - height / 2, x + width / 2, y + height / 2)
        if labels.free(box, taken):
            taken.append(box)
            _name(axes, text, three[1], (float(offset[0]), float(offset[1])), size)
    return taken


def _name_points(
    axes: Axes,
    plane: Diagram,
    points: Mapping[str, Points],
    temperatures: Sequence[int],
    taken: Sequence[labels.Box],
    numbered: bool,
) -> None:
    """Names or numbers of points, then colour temperatures where they do not cover these."""
    import numpy as np

    size = 7.0 if numbered else 8.0
    names = list(points)
    texts = [str(number) for number in range(1, len(names) + 1)] if numbered else names
    obstacles = list(taken)
    if temperatures:
        obstacles += labels.around(_on_paper(axes, _planckian_points(plane)), 1.0)
    if plane.primaries_nm:
        red, green, blue = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
        for a, b in ((red, green), (green, blue), (blue, red)):
            edge = a + (b - a) * np.linspace(0, 1, 100)[:, np.newaxis]
            obstacles += labels.around(_on_paper(axes, edge), 1.0)
        _, locus = plane.spectral_locus()
        purples = locus[-1] + (locus[0] - locus[-1]) * np.linspace(0, 1, 100)[:, np.newaxis]
        obstacles += labels.around(_on_paper(axes, np.concatenate([locus, purples])), 1.0)
    where = [_on_paper(axes, points[name])[0] for name in names]
    centres = labels.place(where, texts, obstacles, size)
    for name, text, at, (x, y) in zip(names, texts, where, centres, strict=True):
        _name(axes, text, points[name], (x - at[0], y - at[1]), size)
        width, height = labels.extent(text, size)
        obstacles.append((x - width / 2, y - height / 2, x + width / 2, y + height / 2))
    obstacles += labels.around(where, 3.5)
    if temperatures:
        low, high = np.transpose([axes.get_xlim(), axes.get_ylim()])
        marked = plane.planckian_locus(temperatures)
        shown = np.all((marked > low) & (marked < high), axis=1)
        temperatures = [t for t, seen in zip(temperatures, shown, strict=True) if seen]
        marked = marked[shown]
        where = _on_paper(axes, marked)
        texts = [f"{temperature:,} K" for temperature in temperatures]
        for text, place, at, (x, y) in zip(
            texts, marked, where, labels.place(where, texts, obstacles, 6.5), strict=True
        ):
            # A name far from its mark would seem to belong to another.
            if abs(x - at[0]) < 27 and abs(y - at[1]) < 14:
                _name(axes, text, place, (x - at[0], y - at[1]), 6.5)
