"""The gamma chart: a display's γ is read where a solid patch is as bright as fine lines.

Lines of black and of full code, one pixel each, are on the average half as bright as full code, whatever the γ: light
adds in the eye. A solid patch of code c has the fraction c^γ of it, and equals the lines where c = 0.5^(1/γ). So among
patches made for γ from 1 to 3, each on lines, the one that vanishes (seen from far, or with half-closed eyes) names the
γ of the display. Grey, red, green and blue have a row each: differing γ is why greys do not track (book 5.4, step 3).

The display must show each pixel as one pixel; a screen that scales its picture makes grey of the lines. Horizontal
lines are the default, for a CRT's beam does not follow a checker from pixel to pixel; `weave="checker"` is for others.

A display whose curve is no power, as that of sRGB, matches the power that has 0.5 at the same code: 2.255 for sRGB
(code 0.7354), so that the patch that vanishes is 2.2.

Example:
    >>> round(matching_code(2.2), 4), round(matching_code(1.0), 4)
    (0.7297, 0.5)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns import lettering
from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from illuminant.display.patterns.screen import Values

__all__ = ["GAMMAS", "WEAVES", "gamma_chart", "matching_code"]

GAMMAS = tuple(1.0 + 0.2 * step for step in range(11))
"""γ of the patches: 1.0 to 3.0."""

WEAVES = ("lines", "checker")

_ROWS = ((1.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def matching_code(gamma: float) -> float:
    """The code value that is half as bright as full code on a display of this γ: 0.5^(1/γ)."""
    return float(0.5 ** (1.0 / gamma))


def gamma_chart(screen: Screen, *, weave: str = "lines") -> Values:
    """Patches for γ 1.0 to 3.0 on lines or a checker, in four rows.

    Args:
        screen: what it is drawn for.
        weave: "lines" or "checker".

    Raises:
        UsageError: the weave is neither.
    """
    import numpy as np

    if weave not in WEAVES:
        raise UsageError(f"A weave is {' or '.join(WEAVES)}, not {weave!r}.")
    y, x = np.mgrid[: screen.height, : screen.width]
    on = (y if weave == "lines" else x + y) % 2
    values = screen.blank()
    # A strip at the top is left for the numbers.
    rows = screen.edges([0.5, *[1.0] * len(_ROWS)], screen.height)
    columns = screen.edges([1.0] * len(GAMMAS), screen.width)
    for color, top, bottom in zip(_ROWS, rows[1:-1], rows[2:], strict=True):
        values[top:bottom] = on[top:bottom, :, None] * np.array(color)
        inner_rows = slice(top + (bottom - top) // 4, bottom - (bottom - top) // 4)
        for gamma, left, right in zip(GAMMAS, columns[:-1], columns[1:], strict=True):
            margin = (right - left) // 5
            values[inner_rows, left + margin : right - margin] = matching_code(gamma) * np.array(color)
    scale = max(1, min(screen.width // 300, rows[1] // 12))
    for gamma, left, right in zip(GAMMAS, columns[:-1], columns[1:], strict=True):
        lettering.write(values, f"{gamma:.1f}", ((left + right) // 2, rows[1] // 2), 0.75, scale)
    return values
