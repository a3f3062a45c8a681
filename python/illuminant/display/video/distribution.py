"""Faults between frame buffer and encoder, and what corrects them (book 5.3, R5.69; figures 5.14, 5.15 and 5.18).

- `Mismatch`: outputs whose gain and offset differ, so that a white field is not white. A video distribution amplifier
  has both controls: `matched` finds them from what a black and a white field measure.
- `load_factor`: a line of 75 Ω wants one terminator. With n of them the level is 2 / (n + 1) of what it should be:
  twice as high without any, two thirds with two.
- `delayed`: a frame buffer that lags behind sync (long cables, no phase adjustment of its genlock) moves the picture
  to the right; black follows from the left. `cable_delay_us` is the delay of a length of cable.

Levels are parts of white, before setup is added.

Example:
    >>> import numpy as np
    >>> fault = Mismatch(gain=(1.05, 1.0, 0.9), offset=(0.0, 0.02, 0.0))
    >>> repair = matched(fault.applied([0.0, 0.0, 0.0]), fault.applied([1.0, 1.0, 1.0]))
    >>> repair.applied(fault.applied([0.2, 0.5, 0.7])).round(12).tolist()
    [0.2, 0.5, 0.7]
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.video.standard import ACTIVE_US
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["Mismatch", "cable_delay_us", "delayed", "load_factor", "matched"]

SPEED_IN_CABLE = 0.66
"""Of a signal in a coaxial cable with a core of polyethylene, in parts of the speed of light."""


@dataclass(frozen=True)
class Mismatch:
    """Gain and offset of R, G and B: v → gain · v + offset.

    Attributes:
        gain: factors.
        offset: parts of white.

    Raises:
        UsageError: a gain is not positive, or there are not three of each.
    """

    gain: tuple[float, float, float] = (1.0, 1.0, 1.0)
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        import math

        if len(self.gain) != 3 or len(self.offset) != 3:
            raise UsageError("A mismatch has a gain and an offset for each of R, G and B.")
        if not all(math.isfinite(g) and g > 0.0 for g in self.gain) or not all(
            map(math.isfinite, self.offset)
        ):
            raise UsageError("A mismatch has gains above 0, and offsets in parts of white.")

    def applied(self, rgb: ArrayLike) -> Float64:
        """The signals (..., 3) after it; not clamped."""
        import numpy as np

        return np.asarray(np.asarray(rgb, np.float64) * np.array(self.gain) + np.array(self.offset))


def matched(black: ArrayLike, white: ArrayLike) -> Mismatch:
    """How a distribution amplifier is set so that a black field measures 0 and a white field 1.

    Args:
        black, white: measured levels (3,) of R, G and B.

    Raises:
        UsageError: white is not above black.

    Example:
        >>> matched([0.1, 0.1, 0.1], [0.9, 0.6, 1.1]).gain
        (1.25, 2.0, 1.0)
    """
    import numpy as np

    low, high = np.asarray(black, np.float64), np.asarray(white, np.float64)
    if low.shape != (3,) or high.shape != (3,) or not (high > low).all():
        raise UsageError("A black and a white field measure three levels each, white above black.")
    gain = 1.0 / (high - low)
    r, g, b = (float(v) for v in gain.round(12))
    offsets = [float(v) for v in -low * gain]
    return Mismatch((r, g, b), (offsets[0], offsets[1], offsets[2]))


def load_factor(terminators: int) -> float:
    """Level of a source of 75 Ω with a number of terminators of 75 Ω on its line, 1 with one.

    Raises:
        UsageError: the number is negative.

    Example:
        >>> [round(load_factor(n), 3) for n in (0, 1, 2)]
        [2.0, 1.0, 0.667]
    """
    if terminators < 0:
        raise UsageError("A line has no fewer than 0 terminators.")
    return 2.0 / (terminators + 1)


def cable_delay_us(metres: float) -> float:
    """Delay of a coaxial cable, µs.

    Example:
        >>> round(cable_delay_us(100.0), 2)
        0.51
    """
    return metres / (SPEED_IN_CABLE * 299.792458)


def delayed(rgb: ArrayLike, delay_us: float) -> Float64:
    """The picture (h, w, 3) that comes too late by some time; before it, to the left, there is black.

    Args:
        rgb: code values; a row is the 52.6 µs of a line that are seen.
        delay_us: negative: too early, and black follows it.

    Raises:
        UsageError: `rgb` is no picture, or the delay is not finite.

    Example:
        >>> delayed([[[1.0, 1.0, 1.0]] * 4], 52.6 / 4)[0, :, 0].tolist()
        [0.0, 1.0, 1.0, 1.0]
    """
    import numpy as np

    from illuminant.display.video.transmission import picture

    array = picture(rgb)
    if not np.isfinite(delay_us):
        raise UsageError("A delay is a number of µs.")
    width = array.shape[1]
    shift = float(np.clip(delay_us / ACTIVE_US * width, -width, width))
    whole = int(np.floor(shift))
    part = shift - whole
    padded = np.zeros((array.shape[0], 3 * width + 2, 3))
    padded[:, width + 1 : 2 * width + 1] = array
    start = width + 1 - whole
    return np.asarray(
        (1.0 - part) * padded[:, start : start + width] + part * padded[:, start - 1 : start - 1 + width]
    )
