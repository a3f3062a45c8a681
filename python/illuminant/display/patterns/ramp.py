"""Ramps and steps: tracking, banding, and the smallest step that can be seen.

- `ramp`: from black to full, as a band each for grey, red, green and blue, or for one of them. Even steps are those of
  the code, or of light: then the code is what the display's own curve asks for.
- `steps`: a grey scale in even steps, and below it the same from right to left, so that light and dark stand together.
- `shadows`: a very gradual ramp near black, rounded to 8 bits above and to 10 below. The eye tells the steps of 8 bits,
  and on a good screen those of 10 bits are gone (book 5.1.2, footnote 10). It needs 10 bits or more; a screen that
  has 8 shows the same steps in both.

Example:
    >>> from illuminant.display.patterns.screen import Screen
    >>> values = shadows(Screen(1920, 100, bits=10), level=0.1)
    >>> import numpy as np
    >>> [len(np.unique(values[row, :, 0])) for row in (20, 80)]
    [27, 103]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from illuminant.display.patterns.screen import Values

__all__ = ["CHANNELS", "EVEN", "ramp", "shadows", "steps"]

CHANNELS = {
    "grey": (1.0, 1.0, 1.0),
    "red": (1.0, 0.0, 0.0),
    "green": (0.0, 1.0, 0.0),
    "blue": (0.0, 0.0, 1.0),
}

EVEN = ("code", "light")
"""In what the steps of a ramp are even."""


def _even(screen: Screen, values: Values, even: str) -> Values:
    """Code values of numbers that count evenly in code or in light."""
    import numpy as np

    if even not in EVEN:
        raise UsageError(f"A ramp is even in {' or '.join(EVEN)}, not {even!r}.")
    return values if even == "code" else np.asarray(screen.display.encode(values), np.float64)


def ramp(screen: Screen, *, channel: str = "all", even: str = "code") -> Values:
    """From black at the left to full at the right.

    Args:
        screen: what it is drawn for.
        channel: "grey", "red", "green", "blue", or "all" for a band each.
        even: "code" or "light".

    Raises:
        UsageError: channel or even are not known.
    """
    import numpy as np

    if channel != "all" and channel not in CHANNELS:
        raise UsageError(f"A channel is {', '.join(CHANNELS)} or all, not {channel!r}.")
    colors = list(CHANNELS.values()) if channel == "all" else [CHANNELS[channel]]
    along = np.repeat(np.linspace(0.0, 1.0, screen.width)[:, None], 3, axis=1)
    codes = _even(screen, along, even)
    values = screen.blank()
    edges = screen.edges([1.0] * len(colors), screen.height)
    for color, top, bottom in zip(colors, edges[:-1], edges[1:], strict=True):
        # The other guns stay off, whatever the code of no light is.
        values[top:bottom] = np.where(np.array(color) > 0.0, codes, 0.0)
    return values


def steps(screen: Screen, *, count: int = 11, even: str = "code") -> Values:
    """A grey scale of so many steps, and below it the same reversed.

    Raises:
        UsageError: fewer than 2 steps, or more than a quarter of the screen's pixels.
    """
    import numpy as np

    if not 2 <= count <= screen.width // 4:
        raise UsageError(f"A grey scale has 2 to {screen.width // 4} steps on this screen, not {count}.")
    greys = np.repeat(np.linspace(0.0, 1.0, count)[:, None], 3, axis=1)
    codes = np.clip(_even(screen, greys, even), 0.0, 1.0).tolist()
    values = screen.blank()
    screen.bars(values, codes, [1.0] * count, 0.0, 0.5)
    screen.bars(values, codes[::-1], [1.0] * count, 0.5, 1.0)
    return values


def shadows(screen: Screen, *, level: float = 0.125) -> Values:
    """A ramp from black to a low code value, in steps of 8 bits above and of 10 bits below.

    Args:
        screen: with 10 bits or more.
        level: code value at the right, above 0 up to 1.

    Raises:
        UsageError: fewer than 10 bits, or a level that is not possible.
    """
    import numpy as np

    if screen.bits < 10:
        raise UsageError(f"Steps of 10 bits cannot be shown with {screen.bits} bits: 10 to 16 are needed.")
    if not 0.0 < level <= 1.0:
        raise UsageError(f"A level is a code value above 0 up to 1, not {level:g}.")
    along = np.linspace(0.0, level, screen.width)
    values = screen.blank()
    middle = screen.height // 2
    values[:middle] = (np.round(along * 255.0) / 255.0)[:, None]
    values[middle:] = (np.round(along * 1023.0) / 1023.0)[:, None]
    return values
