"""The RGB cube in Y I Q, with the colours that NTSC cannot carry (book figure 5.23).

To the left the box seen from its side, Y upwards; to the right seen along Y, with I to the right and Q upwards. Dots
mark where its surface is hot: the composite signal leaves its bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from illuminant.display.video import cube
from illuminant.display.video.legality import Limits, hot
from illuminant.plots.style import DPI, GREY, INK, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["yiq_gamut"]

FROM_SIDE = ((0.0, 1.0), (-0.92, -0.22), (0.55, -0.30))
"""Where one unit of Y, of I and of Q lies on the paper."""

FROM_ABOVE = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))

# Where names of corners are free of edges and axes seen from the side; elsewhere they stand outwards of the middle.
_ASIDE = {"white": (22.0, 7.0), "green": (-22.0, -9.0), "magenta": (30.0, 7.0)}

# Ends of the arrows along Y, I and Q.
_TIPS = ((1.18, 0.0, 0.0), (0.0, 0.78, 0.0), (0.0, 0.0, 0.70))


def yiq_gamut(limits: Limits | None = None, *, size: tuple[float, float] = (9.0, 5.0)) -> Figure:
    """The box of all colours of a monitor in Y I Q, from its side and along Y.

    Args:
        limits: of the signal; None: −20 to 120 IRE.
        size: width and height, inches.

    Example:
        >>> [axes.get_title(loc="left") for axes in yiq_gamut().axes]
        ['RGB in Y I Q', 'seen along Y']
    """
    from matplotlib.figure import Figure

    with styled():
        figure = Figure(figsize=size, dpi=DPI, layout="constrained", facecolor="white")
        side, above = figure.subplots(1, 2)
        for axes, view, title in ((side, FROM_SIDE, "RGB in Y I Q"), (above, FROM_ABOVE, "seen along Y")):
            axes.set_aspect("equal", anchor="N")
            axes.set_axis_off()
            axes.set_title(title)
            _draw(axes, view, limits)
        share = cube.hot_share(limits, 48)
        figure.supxlabel(
            f"dots: hot colours, {100 * share:.1f} % of all (signal outside {_bounds(limits or Limits())})",
            fontsize=8.5,
            color=INK,
        )
    return figure


def _bounds(limits: Limits) -> str:
    text = f"{limits.low:g} to {limits.high:g} IRE".replace("-", "−")
    return text if limits.chroma is None else f"{text}, or colour above {limits.chroma:g}"


def _seen(points: NDArray[np.float64], view: Sequence[tuple[float, float]]) -> NDArray[np.float64]:
    """Points (..., 3) of Y I Q on the paper (..., 2)."""
    import numpy as np

    return np.asarray(points @ np.array(view))


def _draw(axes: Axes, view: Sequence[tuple[float, float]], limits: Limits | None) -> None:
    """Axes, hot dots, edges in their own colours, names of the corners."""
    import numpy as np
    from matplotlib.collections import LineCollection

    from illuminant.color.axes import rgb_to_yiq

    for name, tip in zip("YIQ", _TIPS, strict=True):
        end = _seen(np.array(tip), view)
        if np.hypot(*end) < 1e-9:
            continue
        start = np.zeros(2) if name == "Y" else -end
        arrow = {"arrowstyle": "->", "color": GREY, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", tuple(end), tuple(start), arrowprops=arrow, zorder=1)
        axes.annotate(name, tuple(end * 1.07), ha="center", va="center", fontsize=9.5)
    faces = cube.surface(33).reshape(-1, 3)
    marked = faces[hot(faces, limits)]
    dots = _seen(np.asarray(rgb_to_yiq(marked), np.float64), view)
    axes.scatter(dots[:, 0], dots[:, 1], s=9.0, c=marked, edgecolors=INK, linewidths=0.3, zorder=2)
    for edge in cube.edges():
        path = _seen(edge.yiq, view)
        segments = np.stack([path[:-1], path[1:]], axis=1)
        colours = np.clip((edge.rgb[:-1] + edge.rgb[1:]) / 2.0, 0.0, 1.0) * 0.92
        axes.add_collection(LineCollection(list(segments), colors=colours, linewidths=2.4, zorder=3))
    centre = _seen(np.array([0.5, 0.0, 0.0]), view)
    for corner in cube.corners(limits):
        at = _seen(corner.yiq, view)
        out = at - centre
        length = float(np.hypot(*out))
        shift = out / length * 13.0 if length > 1e-6 else np.array([46.0, -8.0])
        if view is FROM_SIDE:
            shift = np.array(_ASIDE.get(corner.name, tuple(shift)))
        axes.annotate(
            corner.name if length > 1e-6 else ("white, black" if corner.name == "white" else ""),
            tuple(at),
            tuple(shift),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=8.0,
            fontweight="bold" if corner.hot else "normal",
        )
    reach = np.concatenate([_seen(edge.yiq, view) for edge in cube.edges()] + [_seen(np.array(_TIPS), view)])
    low, high = reach.min(axis=0), reach.max(axis=0)
    margin = 0.1 * float((high - low).max())
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
