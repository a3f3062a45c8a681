"""A vectorscope: the colour of a picture as points, with the targets of the 75 % bars (book 5.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import TURN_DEG
from illuminant.display.patterns.color_bars import BARS
from illuminant.display.video import scopes
from illuminant.plots.style import GREY, INK, new_figure, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from illuminant.display.video.composite import Signal

__all__ = ["draw", "vectorscope"]

RADIUS_IRE = 62.0
"""Of the screen: bars of full level stay on it."""

_TRACE = "#1E7A3C"


def vectorscope(
    signal: Signal, line: int | None = None, *, bars: float = 0.75, size: tuple[float, float] = (6.2, 6.4)
) -> Figure:
    """U to the right and V upwards, in IRE, of a line or of all.

    Args:
        signal: see `illuminant.display.video.composite.encode`.
        line: row of the picture, from 0; None: all.
        bars: level of the bars whose targets are drawn, 0.75 or 1.
        size: width and height, inches.

    Raises:
        UsageError: no such line, or the signal has no burst.

    Example:
        >>> import numpy as np
        >>> from illuminant.display.video.composite import encode
        >>> vectorscope(encode(np.ones((2, 754, 3))), 0).axes[0].get_title(loc="left")
        'Vectorscope, line 0; targets of 75 % bars'
    """
    with styled():
        figure, axes = new_figure(size)
        draw(axes, signal, line, bars=bars)
    return figure


def draw(axes: Axes, signal: Signal, line: int | None = None, *, bars: float = 0.75) -> None:
    """The same in axes of a figure; arguments and errors as `vectorscope`."""
    import numpy as np

    points = scopes.vectors(signal, line)
    burst = scopes.burst_vector(signal, line or 0)
    axes.set_aspect("equal")
    axes.set_axis_off()
    _graticule(axes, bars, scopes.targets(bars, levels=signal.levels))
    axes.plot([0.0, burst[0]], [0.0, burst[1]], color=_TRACE, linewidth=1.2)
    if line is not None:
        axes.plot(points[:, 0], points[:, 1], color=_TRACE, linewidth=0.5, zorder=2)
        axes.plot(points[:, 0], points[:, 1], ".", color=_TRACE, markersize=2.0, zorder=2)
    else:
        _beam(axes, points)
    axes.set_xlim(-1.18 * RADIUS_IRE, 1.18 * RADIUS_IRE)
    axes.set_ylim(-1.18 * RADIUS_IRE, 1.18 * RADIUS_IRE)
    where = "all lines" if line is None else f"line {line}"
    axes.set_title(f"Vectorscope, {where}; targets of {100 * bars:g} % bars")
    beyond = float((np.hypot(points[:, 0], points[:, 1]) > RADIUS_IRE).mean())
    if beyond > 0.0:
        axes.annotate(
            f"{100 * beyond:.1f} % of the samples lie outside the circle",
            (0.5, 0.0),
            xycoords="axes fraction",
            ha="center",
            fontsize=7.5,
            color=INK,
        )


def _beam(axes: Axes, points: NDArray[np.float64]) -> None:
    """All lines as the light of a beam."""
    import numpy as np

    span = (-RADIUS_IRE, RADIUS_IRE)
    screen = np.log1p(scopes.density(points[:, 0], points[:, 1], (span, span), (440, 440)))
    axes.imshow(
        np.ma.masked_equal(screen, 0.0),
        extent=(*span, *span),
        cmap="Greens",
        vmin=-0.6 * float(screen.max()),
        vmax=max(float(screen.max()), 1e-9),
        interpolation="nearest",
        zorder=2,
    )


def _graticule(axes: Axes, bars: float, targets: dict[str, NDArray[np.float64]]) -> None:
    """Circle, axes, and for each bar a box of ±2.5° and ±2.5 IRE, as on the screen of an instrument."""
    import numpy as np

    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(RADIUS_IRE * np.cos(turn), RADIUS_IRE * np.sin(turn), color=GREY, linewidth=0.8)
    for degrees in range(0, 360, 10):
        direction = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
        axes.plot(*(direction[:, None] * [RADIUS_IRE, RADIUS_IRE * 1.03]), color=GREY, linewidth=0.6)
    axis_i, axis_q = np.radians(90.0 + TURN_DEG), np.radians(TURN_DEG)
    rays = (("U", 0.0, 1), ("V", np.pi / 2, 1), ("I", axis_i, 1), ("Q", axis_q, 1), ("−I", axis_i, -1))
    for name, angle, sign in rays:
        tip = sign * RADIUS_IRE * np.array([np.cos(angle), np.sin(angle)])
        axes.plot([0.0, tip[0]], [0.0, tip[1]], color=GREY, linewidth=0.5, linestyle=(0, (4, 3)))
        axes.annotate(name, (1.1 * tip[0], 1.1 * tip[1]), ha="center", va="center", fontsize=8.5)
    for name, (u, v) in targets.items():
        if name == "burst":
            # Traces run all about it.
            axes.annotate(
                "burst",
                (u, v),
                (0, 6),
                textcoords="offset points",
                ha="center",
                fontsize=7.5,
                zorder=4,
                bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.85},
            )
            continue
        radius, angle = np.hypot(u, v), np.arctan2(v, u)
        a = angle + np.radians(2.5) * np.array([-1, -1, 1, 1, -1])
        r = radius + 2.5 * np.array([-1, 1, 1, -1, -1])
        rgb = tuple(0.85 * value for value in BARS[name])
        axes.plot(r * np.cos(a), r * np.sin(a), color=rgb, linewidth=1.4, zorder=3)
        # Beyond the box and the loops about it.
        out = np.array([np.cos(angle), np.sin(angle)])
        axes.annotate(
            name,
            tuple((radius + 5.5) * out),
            ha="left" if out[0] > 0.5 else "right" if out[0] < -0.5 else "center",
            va="bottom" if out[1] > 0.4 else "top" if out[1] < -0.4 else "center",
            fontsize=8.0,
            color=INK,
        )
