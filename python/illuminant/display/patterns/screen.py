"""The screen a pattern is drawn for: how many pixels, how many bits, which display.

A pattern is an array (h, w, 3) of code values from 0 to 1, which `illuminant.display.picture.Picture.of_values`
quantises to n bits: code value v becomes round((2^n - 1) v). A value that must be one exact code is given as
code / (2^n - 1) by `Screen.code`.

Places are fractions of the picture, 0 at left or top. Band i of `edges` ends where band i + 1 begins, and each edge is
the nearest between two pixels, so that bands cover the picture without a gap whatever its size.

Errors: `UsageError` for a size below 16 or above 16384 pixels, bits outside 1 to 16, or a display that is not known.

Example:
    >>> screen = Screen(70, 20, bits=8)
    >>> screen.edges([1, 1, 1, 1, 1, 1, 1], screen.width)
    [0, 10, 20, 30, 40, 50, 60, 70]
    >>> screen.code(51)
    0.2
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.displays import Display

    Values = NDArray[np.float64]

__all__ = ["SMALLEST", "Color", "Screen", "rgb"]

SMALLEST, LARGEST = 16, 16_384
"""Fewest and most pixels along a side."""

Color = float | Sequence[float]
"""Code values of red, green and blue, or one for all three."""


@dataclass(frozen=True)
class Screen:
    """Size, bits a channel, and display.

    Attributes:
        width, height: pixels.
        bits: of a code value, 1 to 16.
        display_name: a name or file as `illuminant.display.displays.named` takes it, or a `Display`.
    """

    width: int = 1920
    height: int = 1080
    bits: int = 8
    display_name: str | Display = "sRGB"

    def __post_init__(self) -> None:
        """Refuse what cannot be drawn on."""
        for side in (self.width, self.height):
            if not SMALLEST <= side <= LARGEST:
                raise UsageError(
                    f"A pattern of {self.width}x{self.height} pixels: expected {SMALLEST} to {LARGEST} along a side."
                )
        if not 1 <= self.bits <= 16:
            raise UsageError(f"A code value has 1 to 16 bits, not {self.bits}.")

    @property
    def display(self) -> Display:
        """What shows the pattern."""
        from illuminant.display.displays import named

        return named(self.display_name)

    @property
    def most(self) -> int:
        """The largest code, 2^bits - 1."""
        return int(2**self.bits) - 1

    def code(self, number: float) -> float:
        """Code value of an exact code, 0 to `most`."""
        return number / self.most

    def blank(self, color: Color = 0.0) -> Values:
        """The whole screen in one colour."""
        import numpy as np

        values = np.empty((self.height, self.width, 3))
        values[:] = rgb(color)
        return values

    def edges(self, parts: Sequence[float], length: int) -> list[int]:
        """Pixels at which bands begin and end that share a length in these parts."""
        total, done, found = float(sum(parts)), 0.0, [0]
        for part in parts:
            done += part
            found.append(round(length * done / total))
        return found

    def bars(
        self, values: Values, colors: Sequence[Color], parts: Sequence[float], top: float, bottom: float
    ) -> None:
        """Draw bars side by side, of widths in these parts, between two heights (fractions)."""
        rows = slice(round(self.height * top), round(self.height * bottom))
        edges = self.edges(parts, self.width)
        for color, left, right in zip(colors, edges[:-1], edges[1:], strict=True):
            values[rows, left:right] = rgb(color)


def rgb(color: Color | Any, what: str = "A colour") -> tuple[float, float, float]:
    """Three code values from 0 to 1 of a colour, or of one number for a grey.

    Raises:
        UsageError: it is neither one number nor three, or lies outside 0 to 1.

    Example:
        >>> rgb(0.5)
        (0.5, 0.5, 0.5)
    """
    try:
        numbers = [float(color)] * 3 if isinstance(color, int | float) else [float(c) for c in color]
    except (TypeError, ValueError) as error:
        raise UsageError(f"{what} is a code value or three of them, not {color!r}.") from error
    if len(numbers) != 3:
        raise UsageError(f"{what} is a code value or three of them, not {len(numbers)}.")
    if not all(0.0 <= number <= 1.0 for number in numbers):
        shown = ", ".join(f"{number:g}" for number in numbers)
        raise UsageError(f"{what} has code values from 0 to 1, not {shown}.")
    return numbers[0], numbers[1], numbers[2]
