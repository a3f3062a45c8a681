"""Chroma and hue of an NTSC monitor, set by the blue-only view of the split bars: step 5 of book 5.4.

A decoder multiplies I and Q by its chroma and turns them by its hue before it makes RGB of Y_t I Q. With red and green
off, each bar of the SMPTE pattern has the same blue as the piece of the split below it, when both knobs are right. Of
the four pairs with blue, the outer two (white over blue, blue over white) show chroma, the inner two (cyan over
magenta, magenta over cyan) hue:

    outer = 0 where chroma is right, inner = 0 where hue is right

The two interact, so they are turned in turn. What is judged is the difference of blue signals, which an eye sees above
about 0.01.

Example:
    >>> outer, inner = split(Decoder(chroma=1.2, hue_deg=0.0))
    >>> abs(outer) > 0.1
    True
    >>> done = adjust(Decoder(chroma=0.8, hue_deg=12.0))
    >>> abs(done.chroma - 1.0) < 0.02, abs(done.hue_deg) < 1.0
    (True, True)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from illuminant.color.axes import rgb_to_yiq, yiq_to_rgb
from illuminant.display.patterns.color_bars import bars_75

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["Decoder", "adjust", "split"]

SEEN = 0.01
"""Difference of signals that an eye sees along an edge."""


@dataclass(frozen=True)
class Decoder:
    """The two knobs.

    Attributes:
        chroma: factor on I and Q; 1 is right.
        hue_deg: by how much they are turned; 0 is right.
    """

    chroma: float = 1.0
    hue_deg: float = 0.0

    def rgb(self, signals: ArrayLike) -> Array:
        """RGB (..., 3) that the decoder makes of a picture's RGB after encoding; not clamped."""
        import numpy as np

        yiq = np.asarray(rgb_to_yiq(signals, matrix="standard"), np.float64)
        c, s = math.cos(math.radians(self.hue_deg)), math.sin(math.radians(self.hue_deg))
        i, q = yiq[..., 1], yiq[..., 2]
        turned = [yiq[..., 0], self.chroma * (i * c - q * s), self.chroma * (i * s + q * c)]
        return np.asarray(yiq_to_rgb(np.stack(turned, axis=-1), matrix="standard"), np.float64)


def split(decoder: Decoder) -> tuple[float, float]:
    """Differences of blue along the split: outer bars (blue less white), and inner (magenta less cyan)."""
    blue = {name: float(decoder.rgb(color)[2]) for name, color in bars_75().items()}
    return blue["blue"] - blue["white"], blue["magenta"] - blue["cyan"]


def adjust(decoder: Decoder, *, most_rounds: int = 50) -> Decoder:
    """Turn both knobs until the split cannot be seen; what a person does, with steps by what is seen.

    Returns:
        The decoder with its knobs as they were left: chroma within 0.02 and hue within 1°, if they began in reach
        (chroma above 0.2, hue within 60°).
    """
    for _ in range(most_rounds):
        outer, inner = split(decoder)
        if abs(outer) < SEEN / 2 and abs(inner) < SEEN / 2:
            break
        # More chroma makes the blue bar bluer than the white one; a turn to greater hue makes cyan bluer than magenta.
        decoder = replace(decoder, chroma=max(0.05, decoder.chroma - outer * 0.8))
        _, inner = split(decoder)
        sensitivity = _inner_slope(decoder)
        decoder = replace(decoder, hue_deg=decoder.hue_deg - max(-10.0, min(10.0, inner / sensitivity)))
    return decoder


def _inner_slope(decoder: Decoder) -> float:
    """Change of the inner difference for a small turn of hue, tried out as a hand does."""
    trial = replace(decoder, hue_deg=decoder.hue_deg + 1.0)
    slope = split(trial)[1] - split(decoder)[1]
    return slope if abs(slope) > 1e-4 else math.copysign(1e-4, slope)
