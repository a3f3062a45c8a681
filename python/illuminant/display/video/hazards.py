"""What a picture will lose or gain on its way through NTSC, pixel by pixel (book 5.5, R5.53).

- `hot`: the colour leaves the bounds of the signal (`legality`).
- `fine`: luminance beyond 4.2 MHz, which a line of 442 pixels can just hold: that part is lost.
- `chroma`: colour of I beyond 1.3 MHz or of Q beyond 0.5: edges and small text in saturated colours smear.
- `q axis`: those of `chroma` that lose more Q than I: yellow-green and purple, whose band is the narrowest.
- `cross-colour`: luminance about the subcarrier, which receivers take for colour: stripes and weaves shimmer.

A loss is the difference of the picture from the picture through the standard's filter, measured in Y, I or Q from 0 to
1; a pixel is marked where it exceeds `threshold`. Edges of black and white exceed it as well, by the overshoot that the
filter makes of them, unless the picture is as soft as the signal.

Example:
    >>> import numpy as np
    >>> text = np.zeros((2, 640, 3))
    >>> text[:, 300:304] = [0.6, 0.0, 0.6]
    >>> found = hazards(text)
    >>> [bool(found[name].any()) for name in ("chroma", "q axis", "hot")]
    [True, True, False]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import rgb_to_yiq
from illuminant.display.video import filters
from illuminant.display.video.decoders import NOTCH_MHZ
from illuminant.display.video.legality import Limits, hot
from illuminant.display.video.standard import ACTIVE, BANDWIDTH, Bandwidth
from illuminant.display.video.transmission import picture, resampled
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["HAZARDS", "hazards", "losses", "worst_share"]

HAZARDS = {
    "hot": "colours outside the bounds of the signal",
    "fine": "luminance too fine for 4.2 MHz",
    "chroma": "colour too fine for the bands of I and Q",
    "q axis": "of these, colours near the Q axis",
    "cross-colour": "luminance that receivers take for colour",
}
"""What each hazard is, in words."""


def losses(rgb: ArrayLike, bandwidth: Bandwidth = BANDWIDTH) -> dict[str, Float64]:
    """What the bands take from Y, I and Q of a picture, and what of Y lies about the subcarrier.

    Args:
        rgb: (h, w, 3), code values of the NTSC primaries.
        bandwidth: of Y, I and Q.

    Returns:
        `y`, `i`, `q`, `subcarrier`: (h, w) each, with sign.

    Raises:
        UsageError: `rgb` is no picture.
    """
    import numpy as np

    array = picture(rgb)
    width = array.shape[1]
    yiq = rgb_to_yiq(array)
    line = np.moveaxis(resampled(yiq, ACTIVE, 1), -1, 0)

    def back(samples: Float64) -> Float64:
        return resampled(samples, width, 1)

    passes = (
        filters.low_pass(bandwidth.y),
        filters.i_pass(bandwidth.i),
        filters.chroma_pass(bandwidth.q),
    )
    found = {
        name: yiq[..., k] - back(filters.filtered(line[k], taps, "hold"))
        for k, (name, taps) in enumerate(zip("yiq", passes, strict=True))
    }
    # The band beyond the picture's edges is empty: its edge is held, then only what varies is left.
    steady = line[0] - filters.filtered(line[0], filters.chroma_pass(NOTCH_MHZ), "hold")
    found["subcarrier"] = back(filters.filtered(steady, filters.chroma_band(NOTCH_MHZ), "zero"))
    return found


def hazards(
    rgb: ArrayLike,
    *,
    threshold: float = 0.1,
    limits: Limits | None = None,
    bandwidth: Bandwidth = BANDWIDTH,
) -> dict[str, NDArray[np.bool_]]:
    """Which pixels (h, w) of a picture are in danger, by the names of `HAZARDS`.

    Args:
        rgb: (h, w, 3), code values of the NTSC primaries.
        threshold: from which loss on a pixel is marked, in parts of white.
        limits: of hot colours; None: −20 to 120 IRE.
        bandwidth: of Y, I and Q.

    Raises:
        UsageError: `rgb` is no picture, or the threshold is not from 0.001 to 1.
    """
    import numpy as np

    if not 0.001 <= threshold <= 1.0:
        raise UsageError(
            f"A threshold of {threshold:g} is not usable: expected 0.001 to 1, in parts of white."
        )
    array = picture(rgb)
    lost = losses(array, bandwidth)
    colour = np.hypot(lost["i"], lost["q"]) > threshold
    return {
        "hot": hot(array, limits),
        "fine": np.abs(lost["y"]) > threshold,
        "chroma": colour,
        "q axis": colour & (np.abs(lost["q"]) > np.abs(lost["i"])),
        "cross-colour": np.abs(lost["subcarrier"]) > threshold,
    }


def worst_share(found: dict[str, NDArray[np.bool_]]) -> tuple[str, float]:
    """The hazard that marks the largest share of pixels, and that share.

    Example:
        >>> import numpy as np
        >>> worst_share({"hot": np.array([[True, False]]), "fine": np.array([[False, False]])})
        ('hot', 0.5)
    """
    name = max(found, key=lambda key: float(found[key].mean()))
    return name, float(found[name].mean())
