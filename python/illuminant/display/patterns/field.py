"""Fields of one colour, over the screen or in a window.

A meter reads a window in the middle of a black screen: a box large enough for its measuring head, and no larger, since
a power supply that is made for typical pictures gives less to a white screen than to a white window (book 5.4).

Units: colours are code values, 0 to 1; the window's side is a fraction of the screen's height and of its width, so its
area is the square of that fraction (0.316 makes the window of 10 % that displays are rated by).

Example:
    >>> from illuminant.display.patterns.screen import Screen
    >>> values = window(Screen(40, 20), color=0.5, window=0.5)
    >>> values[10, 20].tolist(), values[0, 0].tolist(), float((values[..., 0] > 0).mean())
    ([0.5, 0.5, 0.5], [0.0, 0.0, 0.0], 0.25)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Color, Screen, rgb
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from illuminant.display.patterns.screen import Values

__all__ = ["black", "field", "white", "window"]


def field(screen: Screen, *, color: Color = 0.5) -> Values:
    """The whole screen in one colour."""
    return screen.blank(color)


def black(screen: Screen) -> Values:
    """Nothing: what a monitor shows while it warms up."""
    return screen.blank(0.0)


def white(screen: Screen) -> Values:
    """All of the screen at the largest code."""
    return screen.blank(1.0)


def window(screen: Screen, *, color: Color = 1.0, window: float = 0.3, background: Color = 0.0) -> Values:
    """A box of one colour in the middle of the screen.

    Args:
        screen: what it is drawn for.
        color: of the box.
        window: its side as a fraction of the screen's, above 0 up to 1.
        background: colour around it.

    Raises:
        UsageError: the fraction is not possible, or a colour.
    """
    if not 0.0 < window <= 1.0:
        raise UsageError(f"A window is a fraction of the screen's side, above 0 up to 1, not {window:g}.")
    values = screen.blank(background)
    width, height = (max(1, round(side * window)) for side in (screen.width, screen.height))
    left, top = (screen.width - width) // 2, (screen.height - height) // 2
    values[top : top + height, left : left + width] = rgb(color)
    return values
