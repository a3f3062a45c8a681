"""Resolution wedges: lines that run together, in black and white or along one axis of Y_t I Q.

A wedge has n pairs of lines side by side, finer from top to bottom by the same factor in each step down, from
`coarsest` to `lines`. Where they merge, the display, or the signal on its way to it, resolves no more. Figures at the
side say how fine: lines (light and dark counted) in a length equal to the picture's height. In a picture of width w
and height h, n lines are n w / (2 h) cycles in the width.

Along I and Q, Y_t stays at 0.5 and the lines differ in colour alone. All three wedges have the same geometry (book
figure 5.24), and the largest contrast that keeps the signals between 0 and 1. NTSC carries Y_t to 4.2 MHz, I to 1.3
and Q to 0.5 MHz, 221, 68 and 26 cycles in the width: sent through `illuminant.display.video.transmission.transmit`,
Q merges to grey first, then I, then Y.

Edges of lines lie anywhere between pixels: each pixel takes the part of it that each line covers, so what is left of
moiré where lines are as fine as pixels is little, and the rest comes from the screen or the signal.

Example:
    >>> from illuminant.display.patterns.screen import Screen
    >>> values = wedges(Screen(320, 240), axis="I")
    >>> from illuminant.color import rgb_to_yiq
    >>> yiq = rgb_to_yiq(values[60:180, 40:280])
    >>> [round(float(abs(yiq[..., k] - middle).max()), 3) for k, middle in enumerate((0.5, 0.0, 0.0))]
    [0.0, 0.451, 0.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import yiq_to_rgb
from illuminant.display.patterns import lettering
from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.patterns.screen import Values

__all__ = ["AXES", "COARSEST", "fineness", "wedges"]

AXES = ("Y", "I", "Q")

COARSEST = 30
"""Lines per picture height at the top: 20 cycles in the width of a picture of 4 : 3."""

ROUND = (30, 50, 80, 120, 200, 300, 500, 800, 1200, 2000, 3000)
"""Figures written beside a wedge, besides the finest."""

PAIRS = 8


def _square(phase: NDArray[np.float64], width: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean of a square wave of period 1, -1 to 1, over an interval of this width around a phase."""
    import numpy as np

    def integral(t: NDArray[np.float64]) -> NDArray[np.float64]:
        part = t - np.floor(t)
        return np.minimum(part, 1.0 - part)

    return (integral(phase + width / 2) - integral(phase - width / 2)) / width


def fineness(height: int, coarsest: float, finest: float) -> tuple[slice, NDArray[np.float64]]:
    """Rows of a picture that wedges take, and how fine each is, in lines per picture height.

    Example:
        >>> rows, lines = fineness(480, 30, 480)
        >>> rows, lines[[0, -1]].round(6).tolist()
        (slice(38, 442, None), [30.0, 480.0])
    """
    import numpy as np

    rows = slice(round(height * 0.08), round(height * 0.92))
    return rows, np.geomspace(coarsest, finest, rows.stop - rows.start)


def wedges(
    screen: Screen, *, axis: str = "all", lines: int | None = None, coarsest: int = COARSEST
) -> Values:
    """A wedge for each axis, side by side, or for one.

    Args:
        screen: what it is drawn for.
        axis: "Y", "I", "Q", or "all".
        lines: the finest, in lines per picture height; default what the pixels can show, up to 800.
        coarsest: the coarsest, 4 or more, and less than the finest.

    Raises:
        UsageError: axis or lines are not possible.
    """
    import numpy as np

    chosen = AXES if axis == "all" else (axis.upper(),)
    if not set(chosen) <= set(AXES):
        raise UsageError(f"An axis is {', '.join(AXES)} or all, not {axis!r}.")
    lines = min(800, screen.height) if lines is None else lines
    if not 4 <= coarsest < lines <= 4000:
        raise UsageError(
            f"A wedge has 4 to 4000 lines per picture height, more at the bottom, not {coarsest} to {lines}."
        )
    values = screen.blank(0.5)
    rows, fine = fineness(screen.height, coarsest, lines)
    period = 2.0 * screen.height / fine  # of a pair of lines, in pixels
    edges = screen.edges([1.0] * len(chosen), screen.width)
    scale = max(1, screen.height // 270)
    for name, left, right in zip(chosen, edges[:-1], edges[1:], strict=True):
        unit = np.asarray(yiq_to_rgb(np.eye(3)[AXES.index(name)]), np.float64)
        amplitude = 0.5 / np.abs(unit).max()
        pairs = min(PAIRS, int((right - left) * 0.6 / period[0]))
        if pairs < 1:
            raise UsageError(f"The screen of {screen.width}x{screen.height} is too narrow for a wedge.")
        x = np.arange(left, right) + 0.5 - (left + right) / 2
        phase = x[None, :] / period[:, None]
        width = np.broadcast_to(1.0 / period[:, None], phase.shape)
        inside = np.abs(x)[None, :] <= pairs * period[:, None] / 2
        wave = np.where(inside, _square(phase, width), 0.0)
        values[rows, left:right] += wave[..., None] * (amplitude * unit)
        if screen.height >= 160:
            lettering.write(values, name, ((left + right) // 2, rows.start // 2), 0.0, scale)
            for number in (*(n for n in ROUND if coarsest <= n < 0.8 * lines), lines):
                row = rows.start + int(np.searchsorted(fine[:-1], number))
                lettering.write(values, str(number), (right - 15 * scale, row), 0.0, scale)
    return np.clip(values, 0.0, 1.0)
