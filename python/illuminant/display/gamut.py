"""Bringing colours that a display cannot show into its gamut (book 5.1.3 and III.9).

A colour lies outside because a channel is below 0 (its chromaticity is outside the triangle of the primaries) or
above 1 (it is too bright). The formulas are in the core (`crates/display/src/gamut.rs`);
`illuminant.display.gamut_study` measures the methods.

| name | what it keeps | source |
| --- | --- | --- |
| `clamp` | each channel that is inside | book III.9, `CLR_clamp_rgb` |
| `scale` | chromaticity, if no channel is negative | book III.9, `CLR_scale_rgb` |
| `constant-intensity` | r + g + b, and the direction from the neutral axis | book III.9, `CLR_clip_rgb` |
| `constant-luminance` | luminance and dominant wavelength | book 5.1.3 |
| `cook` | dominant wavelength, by adding white; then chromaticity | Cook 1981, book 5.1.3 |
| `oklab` | lightness and hue in Oklab | Ottosson 2020 |
| `oklab-adaptive` | hue in Oklab | Ottosson 2021 |
| `cam16` | lightness and hue in CAM16-UCS | Li et al. 2017 |
| `soft` | smoothness: what is inside gives way too | after ACES 1.3 |
| `scale-image` | chromaticity and contrast of the whole image, which is darkened | book 5.1.3 |

Example:
    >>> from illuminant.display import gamut
    >>> gamut.bring_inside([2.0, 1.0, 0.0], method="clamp").tolist()
    [1.0, 1.0, 0.0]
    >>> gamut.bring_inside([2.0, 1.0, 0.0], method="scale").tolist()
    [1.0, 0.5, 0.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.displays import Display

    Array = NDArray[np.floating[Any]]

__all__ = ["DEFAULT", "bring_inside", "classify", "methods"]

DEFAULT = "cook"
"""The method that is used when none is named; docs/display.md has the figures that chose it."""


def methods() -> list[str]:
    """The names of the methods."""
    return [str(name) for name in core().gamut_methods()]


def bring_inside(linear: ArrayLike, method: str = DEFAULT, display: str | Display = "sRGB") -> Array:
    """Linear RGB of a display, brought into its gamut.

    Args:
        linear: (..., 3); 0 to 1 is inside. NaN becomes 0.
        method: one of `methods()`. `scale-image` divides by the largest channel of all the colours given.
        display: whose RGB this is.

    Returns:
        (..., 3), from 0 to 1.

    Raises:
        UsageError: no such method or display, or no colours.
    """
    import numpy as np

    from illuminant.display import displays

    if method.casefold() not in methods():
        raise UsageError(f"There is no gamut method {method!r}: known are {', '.join(methods())}.")
    colours = np.asarray(linear, np.float64)
    if method.casefold() == "scale-image":
        finite = colours[np.isfinite(colours)]
        colours = colours / max(1.0, float(finite.max(initial=0.0)))
    return displays.named(display).map_gamut(colours, method)


def classify(linear: ArrayLike, slack: float = 1e-4) -> Array:
    """Where colours lie: 0 inside, 1 with a negative channel, 2 too bright, 3 no number (book 5.1.3).

    Args:
        linear: (..., 3).
        slack: a hair of rounding that is no colour outside, of the largest channel.

    Returns:
        (...,) uint8.

    Example:
        >>> classify([[0.5, 0.5, 0.5], [0.5, -0.1, 2.0], [0.5, 0.5, 2.0]]).tolist()
        [0, 1, 2]
    """
    import numpy as np

    colours = np.asarray(linear, np.float64)
    largest = np.maximum(colours.max(axis=-1, initial=0.0), 0.0)
    kind = np.where(largest > 1.0 + slack, 2, 0)
    kind = np.where(colours.min(axis=-1) < -slack * largest - 1e-7, 1, kind)
    return np.where(np.isfinite(colours).all(axis=-1), kind, 3).astype(np.uint8)
