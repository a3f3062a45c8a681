"""Hot colours: those whose composite signal leaves the bounds of what can be sent, and their repair (book 5.5, R5.53).

    amplitude of the colour   A = 92.5 √(I² + Q²)              IRE
    signal of a flat colour   7.5 + 92.5 Y ± A                 IRE

On the air, 120 IRE is the absence of the carrier: above, the sound buzzes; at −20 IRE the signal comes near sync. Of
the cube's corners yellow and cyan rise to 131 IRE and blue and red fall to −23; green stays below 120.
Bars of 75 % (EIA RS-189-A) stay below 100.

The repair takes away colour and keeps Y and the hue: I and Q are multiplied by the largest factor up to 1 that is
legal, which for each bound is a quotient. The result lies between the colour and its grey, thus in the RGB cube.

Sources: book 5.5; EIA RS-189-A (1976); SMPTE 170M (2004); Martindale and Paeth (1991), Television color encoding and
"hot" broadcast colors, Graphics Gems II, who also bound the amplitude of colour, at 50 IRE.

Example:
    >>> yellow = [[[1.0, 1.0, 0.0]]]
    >>> [round(float(level[0, 0]), 1) for level in composite_range(yellow)]
    [48.1, 130.8]
    >>> bool(hot(yellow)[0, 0]), bool(hot(repaired(yellow))[0, 0])
    (True, False)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.color.axes import rgb_to_yiq, yiq_to_rgb
from illuminant.display.video.standard import Levels
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["Limits", "chroma_amplitude", "composite_range", "hot", "repaired", "signal_excess"]


@dataclass(frozen=True)
class Limits:
    """Bounds in IRE.

    Attributes:
        low, high: of the signal.
        chroma: of the amplitude of its colour (half of peak to peak); None: none of its own.

    Raises:
        UsageError: they leave no room for the greys from black to white.
    """

    low: float = -20.0
    high: float = 120.0
    chroma: float | None = None

    def __post_init__(self) -> None:
        if not (self.low <= 0.0 and self.high >= 100.0):
            raise UsageError(
                f"Bounds of {self.low:g} to {self.high:g} IRE exclude greys: expected 0 or less, and 100 or more."
            )
        if self.chroma is not None and not self.chroma >= 0.0:
            raise UsageError(f"A bound of {self.chroma:g} IRE on colour is not usable: expected 0 or more.")


def _base_and_amplitude(rgb: ArrayLike, levels: Levels | None) -> tuple[Float64, Float64, Float64]:
    import numpy as np

    found = Levels() if levels is None else levels
    yiq = np.asarray(rgb_to_yiq(np.asarray(rgb, np.float64), matrix="standard"), np.float64)
    amplitude = found.range * np.hypot(yiq[..., 1], yiq[..., 2])
    return yiq, found.setup + found.range * yiq[..., 0], amplitude


def chroma_amplitude(rgb: ArrayLike, *, levels: Levels | None = None) -> Float64:
    """Amplitude (...) of the colour of RGB (..., 3), IRE; peak to peak is twice as much.

    Example:
        >>> round(2 * float(chroma_amplitude([0.75, 0.0, 0.0])), 1)
        87.7
    """
    return _base_and_amplitude(rgb, levels)[2]


def composite_range(rgb: ArrayLike, *, levels: Levels | None = None) -> tuple[Float64, Float64]:
    """Lowest and highest level (...) of the signal of flat colours (..., 3), IRE.

    Example:
        >>> [round(float(level), 1) for level in composite_range([1.0, 1.0, 1.0])]
        [100.0, 100.0]
    """
    _, base, amplitude = _base_and_amplitude(rgb, levels)
    return base - amplitude, base + amplitude


def hot(rgb: ArrayLike, limits: Limits | None = None, *, levels: Levels | None = None) -> NDArray[np.bool_]:
    """Which colours (..., 3) leave the bounds, by more than 10⁻⁹ IRE.

    Args:
        rgb: code values of the NTSC primaries.
        limits: None: −20 to 120 IRE.
        levels: of the signal.
    """
    import numpy as np

    bounds = Limits() if limits is None else limits
    _, base, amplitude = _base_and_amplitude(rgb, levels)
    outside = (base - amplitude < bounds.low - 1e-9) | (base + amplitude > bounds.high + 1e-9)
    if bounds.chroma is not None:
        outside |= amplitude > bounds.chroma + 1e-9
    return np.asarray(outside)


def repaired(
    rgb: ArrayLike,
    limits: Limits | None = None,
    *,
    levels: Levels | None = None,
    margin_ire: float = 0.0,
) -> Float64:
    """The colours (..., 3) with as much of their saturation as is legal; Y and hue stay.

    Args:
        rgb: code values from 0 to 1.
        limits: None: −20 to 120 IRE.
        levels: of the signal.
        margin_ire: to keep from each bound: 0.5 leaves room for rounding to 8 bits.

    Returns:
        Legal colours are the very numbers that came in.

    Raises:
        UsageError: the margin is negative, or the luminance of a colour alone is out of bounds.

    Example:
        >>> repaired([1.0, 1.0, 0.0]).round(3).tolist()
        [0.97, 0.97, 0.232]
    """
    import numpy as np

    bounds = Limits() if limits is None else limits
    if not margin_ire >= 0.0:
        raise UsageError(f"A margin of {margin_ire:g} IRE is not usable: expected 0 or more.")
    colours = np.asarray(rgb, np.float64)
    yiq, base, amplitude = _base_and_amplitude(colours, levels)
    if not ((base >= bounds.low) & (base <= bounds.high)).all():
        raise UsageError(
            "The luminance of a colour alone is out of bounds, which less colour does not repair."
        )
    room = np.minimum(bounds.high - base, base - bounds.low)
    if bounds.chroma is not None:
        room = np.minimum(room, bounds.chroma)
    room = np.maximum(room - margin_ire, 0.0)
    illegal = amplitude > room
    factor = np.where(illegal, room / np.where(illegal, amplitude, 1.0), 1.0)
    yiq[..., 1:] *= factor[..., None]
    return np.where(illegal[..., None], yiq_to_rgb(yiq, matrix="standard"), colours)


def signal_excess(ire: ArrayLike, limits: Limits | None = None) -> Float64:
    """By how many IRE samples of a signal lie out of bounds, 0 inside; overshoot at edges counts.

    Example:
        >>> signal_excess([100.0, 125.0, -22.0]).tolist()
        [0.0, 5.0, 2.0]
    """
    import numpy as np

    bounds = Limits() if limits is None else limits
    values = np.asarray(ire, np.float64)
    return np.maximum(np.maximum(values - bounds.high, bounds.low - values), 0.0)
