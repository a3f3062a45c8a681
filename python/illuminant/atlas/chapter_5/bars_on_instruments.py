"""Colour bars as instruments show them: the pattern, two of its lines on a waveform monitor, and the vectorscope.

Figures 5.16 and 5.17 differ in their bars −I and +Q alone, so one layout draws both.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from illuminant.display.patterns.color_bars import BarLevels
    from illuminant.display.video.composite import Signal

    Float64 = NDArray[np.float64]

__all__ = ["BOTTOM", "LINES", "Read", "columns", "instruments", "read", "screen_of_bars"]

LINES = 16
"""Scan lines of the pattern: each is like the others of its row of bars."""

UPPER, LOWER = 4, 14
"""A line of the seven bars, and one of the row below."""

BOTTOM = ("-I", "white 100%", "+Q")
"""The bars of the row below, before its black."""


class Read(NamedTuple):
    """What instruments read of a bar in the signal: luminance and carrier peak to peak in IRE, hue in degrees."""

    luminance: float
    carrier: float
    angle_deg: float


def screen_of_bars(encoded: bool) -> Float64:
    """Signals (16, 754, 3) of the EIA bars, as an encoder makes them or as a frame buffer holds them."""
    from illuminant.display.patterns.color_bars import eia, encoded_eia
    from illuminant.display.patterns.screen import Screen
    from illuminant.display.video.standard import ACTIVE

    return (encoded_eia if encoded else eia)(Screen(ACTIVE, LINES))


def read(signal: Signal, line: int, centre: float) -> Read:
    """What is read in the middle of a bar.

    Args:
        signal: of the pattern.
        line: row of it.
        centre: place of the bar's middle, in parts of the width.
    """
    import numpy as np

    from illuminant.display.video import scopes

    at = round(centre * signal.active.shape[1])
    hue, amplitude = scopes.hue_and_amplitude(scopes.vectors(signal, line)[at])
    # Four samples are a cycle of the subcarrier, so their mean is the luminance.
    return Read(float(np.mean(signal.active[line, at - 8 : at + 8])), 2.0 * amplitude, hue)


def columns(signal: Signal, expected: dict[str, BarLevels]) -> dict[str, Any]:
    """A row for each bar: what the standard says, and what is read in the signal."""
    names = [name for name in expected if name != "black"]
    centres = {name: (UPPER, (k + 0.5) / 7.0) for k, name in enumerate(names[:7])}
    centres |= {name: (LOWER, (k + 0.5) * 1.25 / 7.0) for k, name in enumerate(BOTTOM)}
    found = [read(signal, *centres[name]) for name in names]
    levels = [expected[name] for name in names]
    return {
        "bar": names,
        "luminance by the standard, IRE": [level.luminance for level in levels],
        "luminance read, IRE": [one.luminance for one in found],
        "carrier by the standard, IRE peak to peak": [level.carrier for level in levels],
        "carrier read, IRE peak to peak": [one.carrier for one in found],
        "hue by the standard, degrees": [level.angle_deg for level in levels],
        "hue read, degrees": [one.angle_deg if one.carrier > 1.0 else 0.0 for one in found],
        "lowest, IRE": [level.low for level in levels],
        "highest, IRE": [level.high for level in levels],
    }


def instruments(values: Float64, signal: Signal) -> Figure:
    """Waveforms of a line of the bars and of one of the row below; beside them the pattern and the vectors of both."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant.display.video import scopes
    from illuminant.plots import chroma_vectors, composite_waveform
    from illuminant.plots.style import DPI

    figure = Figure(figsize=(9.0, 6.0), dpi=DPI, layout="constrained", facecolor="white")
    grid = figure.add_gridspec(6, 2, width_ratios=(1.25, 1.0))
    for row, (line, title) in enumerate(((UPPER, "A line of the bars"), (LOWER, "A line of the row below"))):
        axes = figure.add_subplot(grid[3 * row : 3 * row + 3, 0])
        composite_waveform.draw(axes, signal, line)
        axes.set_title(title)
        if row == 0:
            axes.set_xlabel("")
    pattern, scope = figure.add_subplot(grid[:2, 1]), figure.add_subplot(grid[2:, 1])
    pattern.imshow(np.clip(values, 0.0, 1.0), extent=(0.0, 4.0, 0.0, 3.0), interpolation="nearest")
    pattern.set_axis_off()
    pattern.set_title("The pattern")
    scope.set_aspect("equal")
    scope.set_axis_off()
    chroma_vectors.draw(scope, signal, UPPER)
    below = scopes.vectors(signal, LOWER)
    # Dots are the bars themselves; on the way from one to the next, and through white and black, is a thin line.
    scope.plot(*below.T, color="black", linewidth=0.4, alpha=0.4, zorder=1.8)
    width = signal.active.shape[1] * 1.25 / 7.0
    for k, name in enumerate(BOTTOM):
        bar = below[round((k + 0.25) * width) : round((k + 0.75) * width)]
        scope.plot(*bar.T, ".", color="black", markersize=2.0, zorder=3)
        if name != "white 100%":
            scope.annotate(
                name.replace("-", "−"),
                bar.mean(axis=0),
                (9, 0),
                textcoords="offset points",
                va="center",
                fontsize=8.0,
            )
    scope.set_title("Vectorscope; black: the row below")
    return figure
