"""Crosshatch and dots: convergence, linearity, centring and size, set before any colour (book 5.4, step 1).

Lines, or dots where they would cross, enclose squares that fill the screen symmetrically, so that the middle one is
centred. Where the three beams do not meet, white lines have coloured edges; where deflection is not linear, squares are
not square.

Example:
    >>> from illuminant.display.patterns.screen import Screen
    >>> values = crosshatch(Screen(320, 240), count=6)
    >>> values[120, 160].tolist(), values[100, 140].tolist()
    ([1.0, 1.0, 1.0], [0.0, 0.0, 0.0])
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Color, Screen, rgb
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.patterns.screen import Values

__all__ = ["crosshatch", "dots"]


def _marks(length: int, spacing: float, thickness: int) -> NDArray[np.bool_]:
    """Pixels along a side that lie on a line; one runs through the middle, and outermost lines are kept inside."""
    import numpy as np

    # A line of an odd number of pixels has no middle on a side of an even number, and the other way round.
    thickness += (length - thickness) % 2
    on = np.zeros(length, bool)
    reach = int((length - thickness) / 2 / spacing + 1e-9)
    for k in range(-reach, reach + 1):
        first = (length - thickness) // 2 + (1 if k > 0 else -1) * round(abs(k) * spacing)
        on[max(0, first) : first + thickness] = True
    return on


def _grid(screen: Screen, count: int, thickness: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    if not 1 <= count <= screen.height // 4:
        raise UsageError(f"A crosshatch has 1 to {screen.height // 4} squares in the height, not {count}.")
    spacing = (screen.height - thickness) / count
    return _marks(screen.width, spacing, thickness), _marks(screen.height, spacing, thickness)


def crosshatch(screen: Screen, *, count: int = 14, color: Color = 1.0) -> Values:
    """Lines around squares, so many in the picture's height.

    Args:
        screen: what it is drawn for.
        count: squares in the height; an even number puts lines on the edges.
        color: of the lines, code values.

    Raises:
        UsageError: more squares than the screen has room for.
    """
    columns, rows = _grid(screen, count, max(1, screen.height // 540))
    values = screen.blank()
    values[rows[:, None] | columns[None, :]] = rgb(color)
    return values


def dots(screen: Screen, *, count: int = 14, color: Color = 1.0) -> Values:
    """A dot at each crossing of the lines of `crosshatch`."""
    columns, rows = _grid(screen, count, max(2, screen.height // 270))
    values = screen.blank()
    values[rows[:, None] & columns[None, :]] = rgb(color)
    return values
