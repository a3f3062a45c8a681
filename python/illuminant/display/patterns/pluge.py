"""PLUGE: bars just above and just below black, by which the brightness of a monitor is set.

A central black bar stands between one that is 4 % of the range blacker than black and one that is 4 % brighter, on
black (book 5.4). Brightness is right when the blacker bar cannot be told from black and the brighter one can.

A frame buffer whose smallest code is black holds nothing below it: that version has the brighter bar only. Video levels
have room: with n bits black is the code 16 · 2^(n−8) and white 235 · 2^(n−8) (ITU-R BT.601, BT.709), and 4 % below
black is the code 7.24, rounded to 7, with 8 bits. The screen must then be driven with video levels, or the pattern
looks grey.

Example:
    >>> from illuminant.display.patterns.screen import Screen
    >>> values = pluge(Screen(100, 20, bits=8), levels="video")
    >>> sorted({round(value * 255) for value in values[10, :, 0].tolist()})
    [7, 16, 25]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.color_bars import PLUGE_STEP
from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from illuminant.display.patterns.screen import Values

__all__ = ["LEVELS", "pluge", "video_code"]

LEVELS = ("frame-buffer", "video")
"""Where black and white lie: at the smallest and largest code, or with room below and above."""


def video_code(signal: float, bits: int) -> int:
    """The code of a signal, 0 for black and 1 for white, with video levels.

    Raises:
        UsageError: fewer than 8 bits leave no room.

    Example:
        >>> video_code(0.0, 8), video_code(1.0, 10), video_code(-0.04, 10)
        (16, 940, 29)
    """
    if bits < 8:
        raise UsageError(
            f"Video levels need 8 bits or more, not {bits}: below them there is no room under black."
        )
    return round((16.0 + 219.0 * signal) * 2.0 ** (bits - 8))


def pluge(screen: Screen, *, levels: str = "frame-buffer") -> Values:
    """The three bars, or two of them for a frame buffer.

    Args:
        screen: what it is drawn for.
        levels: "frame-buffer" or "video".

    Raises:
        UsageError: the levels are neither, or the bits leave no room for video levels.
    """
    if levels not in LEVELS:
        raise UsageError(f"Levels are {' or '.join(LEVELS)}, not {levels!r}.")
    if levels == "video":
        below, black, above = (
            screen.code(video_code(signal, screen.bits)) for signal in (-PLUGE_STEP, 0.0, PLUGE_STEP)
        )
    else:
        below, black, above = 0.0, 0.0, PLUGE_STEP
    values = screen.blank(black)
    screen.bars(values, [black, below, black, above, black], [2, 1, 1, 1, 2], 0.2, 0.8)
    return values
