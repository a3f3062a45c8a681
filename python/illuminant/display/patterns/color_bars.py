"""Colour bars: EIA RS-189-A, the same for a frame buffer, and SMPTE ECR 1-1978 (book figures 5.16, 5.17, 5.19).

Seven bars from left to right, by falling Y_t: white, yellow, cyan, green, magenta, red, blue, each of 75 % of the
signals that make it at full level. In units of a bar's width, the row at the bottom is −I, white at 100 %, +Q (each
5/4), and black.

| | upper part | between | bottom |
| --- | --- | --- | --- |
| EIA RS-189-A | ¾ bars | | ¼: −I, white, +Q, black |
| SMPTE ECR 1-1978 | ⅔ bars | 1/12: the split | ¼: −I, white, +Q, black, PLUGE, black |

The split is blue, black, magenta, black, cyan, black, white: each stands below a bar with the same amount of blue. With
red and green turned off, it vanishes when chroma and hue of a decoder are right.

−I and +Q are carriers of 20 IRE on black, the amplitude of the burst. Their signals are negative in part: an encoder
makes them, and a frame buffer cannot. There, Y_t is added, as little as makes the smallest signal 0; the vectors
remain, and the waveform rises (`bar_levels`). With a setup of 7.5 IRE, 20 IRE are I = −0.2162 and Q = 0.2162; without,
0.2, which gives the signals of SMPTE RP 219. In a file without negative values the encoded pattern has its signals
clipped at 0, as any frame buffer would, and its −I and +Q are then no longer what the standard says.

All values are signals, that is, code values; they are loaded as they are, without correction to the display's primaries
or transfer function (book 5.3).

References: EIA (1976), RS-189-A; SMPTE (1978), ECR 1-1978; SMPTE RP 219:2002 for the lifted values.

Example:
    >>> [round(value, 4) for value in minus_i(lift=True, setup=0.0)]
    [0.0, 0.2456, 0.4125]
    >>> [round(value, 4) for value in plus_q(lift=True, setup=0.0)]
    [0.2536, 0.0, 0.4703]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from illuminant.display.patterns.screen import Screen
from illuminant.display.video.standard import Levels

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.patterns.screen import Color, Values

    Array = NDArray[np.float64]

__all__ = [
    "BARS",
    "BarLevels",
    "bar_levels",
    "bars_75",
    "blue_only",
    "eia",
    "encoded_eia",
    "minus_i",
    "plus_q",
    "smpte",
]

Rgb = tuple[float, float, float]

BARS = {
    "white": (1.0, 1.0, 1.0),
    "yellow": (1.0, 1.0, 0.0),
    "cyan": (0.0, 1.0, 1.0),
    "green": (0.0, 1.0, 0.0),
    "magenta": (1.0, 0.0, 1.0),
    "red": (1.0, 0.0, 0.0),
    "blue": (0.0, 0.0, 1.0),
}
"""The seven bars at full level, in order."""

SETUP = Levels().setup
"""Level of black, IRE."""

PLUGE_STEP = 0.04
"""Step of the bars of PLUGE from black, as a fraction of the range."""


class BarLevels(NamedTuple):
    """What a waveform monitor and a vectorscope show of a bar.

    Attributes:
        luminance: level without carrier, IRE.
        carrier: amplitude from peak to peak, IRE.
        low, high: where the carrier reaches, IRE.
        angle_deg: on the vectorscope, from the axis of B−Y, 0 to 360; 0 without carrier.
    """

    luminance: float
    carrier: float
    low: float
    high: float
    angle_deg: float


def bars_75() -> dict[str, Rgb]:
    """The seven bars of 75 %.

    Example:
        >>> bars_75()["yellow"]
        (0.75, 0.75, 0.0)
    """
    return {name: (0.75 * r, 0.75 * g, 0.75 * b) for name, (r, g, b) in BARS.items()}


def _carrier(axis: str, lift: bool, setup: float) -> Rgb:
    import numpy as np

    from illuminant.color.axes import yiq_to_rgb

    levels = Levels(setup=setup)
    # The amplitude of the burst, on black.
    amount = (-1.0 if axis[0] == "-" else 1.0) * levels.burst / levels.range
    signals = np.asarray(
        yiq_to_rgb([0.0, *((amount, 0.0) if axis[1] == "I" else (0.0, amount))], matrix="standard")
    )
    r, g, b = (signals - min(0.0, signals.min()) if lift else signals).tolist()
    return r, g, b


def minus_i(*, lift: bool, setup: float = SETUP) -> Rgb:
    """Signals of the bar −I; `lift` adds the least Y_t that leaves none negative."""
    return _carrier("-I", lift, setup)


def plus_q(*, lift: bool, setup: float = SETUP) -> Rgb:
    """Signals of the bar +Q; `lift` adds the least Y_t that leaves none negative."""
    return _carrier("+Q", lift, setup)


def bar_levels(*, lift: bool = False, setup: float = SETUP) -> dict[str, BarLevels]:
    """Levels of every bar, as a waveform monitor and a vectorscope show them (figures 5.16 and 5.17).

    Args:
        lift: the frame buffer's −I and +Q, else the standard's.
        setup: level of black, IRE.

    Example:
        >>> found = bar_levels()
        >>> [round(found[name].luminance, 1) for name in ("white", "green", "blue", "black")]
        [76.9, 48.2, 15.4, 7.5]
        >>> round(found["-I"].low, 1), round(found["-I"].high, 1)
        (-12.5, 27.5)
    """
    colors = {
        **bars_75(),
        "-I": minus_i(lift=lift, setup=setup),
        "white 100%": (1.0, 1.0, 1.0),
        "+Q": plus_q(lift=lift, setup=setup),
        "black": (0.0, 0.0, 0.0),
    }
    return {name: _levels(color, Levels(setup=setup)) for name, color in colors.items()}


def _levels(color: Rgb, levels: Levels) -> BarLevels:
    import numpy as np

    from illuminant.color.axes import monochrome, rgb_to_yvu
    from illuminant.display.video.legality import chroma_amplitude, composite_range
    from illuminant.display.video.scopes import hue_and_amplitude

    amplitude = float(chroma_amplitude(color, levels=levels))
    low, high = (float(level) for level in composite_range(color, levels=levels))
    angle = (
        hue_and_amplitude(np.asarray(rgb_to_yvu(color)[:0:-1], np.float64))[0] if amplitude > 1e-7 else 0.0
    )
    return BarLevels(levels.of(float(monochrome(color))), 2.0 * amplitude, low, high, angle)


def _seven(screen: Screen, values: Values, bottom: float) -> None:
    screen.bars(values, list(bars_75().values()), [1] * 7, 0.0, bottom)


def eia(screen: Screen, *, setup: float = SETUP) -> Values:
    """EIA bars for a frame buffer: −I and +Q lifted (figure 5.17)."""
    values = screen.blank()
    _seven(screen, values, 0.75)
    bottom: list[Color] = [minus_i(lift=True, setup=setup), 1.0, plus_q(lift=True, setup=setup), 0.0]
    screen.bars(values, bottom, [5 / 4, 5 / 4, 5 / 4, 13 / 4], 0.75, 1.0)
    return values


def encoded_eia(screen: Screen, *, setup: float = SETUP) -> Values:
    """EIA bars as an encoder makes them (figure 5.16): −I and +Q on black, with their negative signals.

    These are values for an encoder; a file cannot hold what is below 0.
    """
    import numpy as np

    values = eia(screen, setup=setup)
    edges = screen.edges([5 / 4, 5 / 4, 5 / 4, 13 / 4], screen.width)
    rows = slice(round(screen.height * 0.75), screen.height)
    values[rows, : edges[1]] = np.array(minus_i(lift=False, setup=setup))
    values[rows, edges[2] : edges[3]] = np.array(plus_q(lift=False, setup=setup))
    return values


def smpte(screen: Screen, *, setup: float = SETUP) -> Values:
    """SMPTE bars with the split and PLUGE, for a frame buffer (figure 5.19).

    −I and +Q are lifted. PLUGE has black in place of the bar below black, which a frame buffer cannot hold.
    """
    values = screen.blank()
    bars = bars_75()
    _seven(screen, values, 2 / 3)
    split = ["blue", "", "magenta", "", "cyan", "", "white"]
    screen.bars(values, [bars[name] if name else 0.0 for name in split], [1] * 7, 2 / 3, 3 / 4)
    bottom: list[Color] = [
        minus_i(lift=True, setup=setup),
        1.0,
        plus_q(lift=True, setup=setup),
        0.0,
        0.0,
        0.0,
        PLUGE_STEP,
        0.0,
    ]
    screen.bars(values, bottom, [5 / 4] * 4 + [1 / 3] * 3 + [1], 3 / 4, 1.0)
    return values


def blue_only(values: ArrayLike) -> Array:
    """What a monitor with its red and green guns off shows: chroma and hue are judged by it (book 5.4, step 5).

    Example:
        >>> blue_only([[0.2, 0.4, 0.6]]).tolist()
        [[0.0, 0.0, 0.6]]
    """
    import numpy as np

    return np.asarray(values, np.float64) * [0.0, 0.0, 1.0]
