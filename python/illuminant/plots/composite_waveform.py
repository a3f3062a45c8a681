"""A waveform monitor: IRE on time, of one line or of a whole picture (book 5.3, figures 5.16 and 5.17)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.video import scopes
from illuminant.plots.style import GREY, INK, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from illuminant.display.video.composite import Signal

__all__ = ["draw", "waveform"]

IRE_RANGE = (-50.0, 140.0)
"""Of the screen."""

_TRACE = "#1E7A3C"


def waveform(
    signal: Signal, line: int | None = None, *, show: str = "flat", size: tuple[float, float] = (8.0, 5.0)
) -> Figure:
    """The signal of a line as a trace, or of all lines as the light of a beam, with the graticule in IRE.

    Args:
        signal: see `illuminant.display.video.composite.encode`.
        line: row of the picture, from 0; None: all.
        show: "flat": the whole signal, or "luminance": without its colour.
        size: width and height, inches.

    Raises:
        UsageError: no such line, or another `show`.

    Example:
        >>> import numpy as np
        >>> from illuminant.display.video.composite import encode
        >>> waveform(encode(np.ones((2, 754, 3))), 0).axes[0].get_ylabel()
        'level (IRE)'
    """
    with styled():
        figure, axes = new_figure(size)
        draw(axes, signal, line, show=show)
    return figure


def draw(axes: Axes, signal: Signal, line: int | None = None, *, show: str = "flat") -> None:
    """The same in axes of a figure; arguments and errors as `waveform`."""
    import numpy as np

    ends = (0.0, float(signal.time_us[-1]))
    if line is not None:
        time, ire = scopes.waveform(signal, line, show=show, finer=8)
        axes.plot(time, ire[0], color=_TRACE, linewidth=0.6)
    else:
        time, ire = scopes.beam(signal, show=show)
        screen = scopes.density(time, ire, (ends, IRE_RANGE), (910, 570))
        # A beam that passes a place ten times lights it little more than twice as much.
        lit = np.log1p(screen / max(1.0, len(ire) / 60))
        axes.imshow(
            lit,
            extent=(*ends, *IRE_RANGE),
            cmap="Greens",
            vmin=0.0,
            vmax=max(float(np.quantile(lit, 0.995)), 1e-9),
            aspect="auto",
            interpolation="nearest",
        )
    for level, name in _graticule(signal):
        axes.axhline(level, color=GREY, linewidth=0.5, linestyle=(0, (4, 3)), zorder=0.5)
        axes.annotate(
            name,
            (1.0, level),
            (4, 0),
            xycoords=("axes fraction", "data"),
            textcoords="offset points",
            va="center",
            fontsize=7.5,
            color=INK,
        )
    axes.set_xlim(*ends)
    axes.set_ylim(*IRE_RANGE)
    axes.set_yticks(range(-40, 141, 20))
    axes.set_xlabel("time from the leading edge of sync (µs)")
    axes.set_ylabel("level (IRE)")
    what = "Luminance" if show == "luminance" else "Composite signal"
    axes.set_title(f"{what} of {'all lines' if line is None else f'line {line}'}")


def _graticule(signal: Signal) -> list[tuple[float, str]]:
    """Levels with a name, from the top."""
    levels = signal.levels
    named = [
        (120.0, "limit"),
        (levels.white, "white"),
        (levels.setup, "black"),
        (levels.blanking, "blanking"),
        (levels.sync, "sync"),
    ]
    return [pair for pair in named if pair[1] != "blanking" or levels.setup - levels.blanking >= 5.0]
