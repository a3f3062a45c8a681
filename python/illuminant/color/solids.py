"""HSV and HSL: the solids in which colours are picked (book figure 3.1).

All are made of RGB in [0, 1]; whether linear or code values, is the caller's choice. Hues are in degrees: red 0,
green 120, blue 240; a hue of any size is taken, one in [0, 360) is given. Grey has hue 0 and saturation 0.

| solid | hue | saturation | height |
| --- | --- | --- | --- |
| HSV hexcone (Smith 1978) | linear in each sextant | (max − min)/max | V = max |
| HSL double hexcone (Rogers 1985) | linear in each sextant | (max − min)/(1 − \\|2L − 1\\|) | L = (max + min)/2 |
| HSL double cone (Joblove and Greenberg 1978) | angle across the neutral axis | max − min | L = (max + min)/2 |
| HSL cylinder (the same) | angle across the neutral axis | (max − min)/(1 − \\|2L − 1\\|) | L = (max + min)/2 |

The last two have a circle for a cross-section: the hexagon of the others with each ray from its centre stretched to
the length of a corner, so that the hue is atan2(√3 (G − B), 2R − G − B). Shapes, types and `out` are as
`illuminant.color.triples` says.

Example:
    >>> rgb_to_hsv([0.0, 0.5, 0.25]).tolist(), rgb_to_hsl([0.0, 0.5, 0.25]).tolist()
    ([150.0, 1.0, 0.5], [150.0, 1.0, 0.25])
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from illuminant.color.triples import converted, step

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Solid", "hsl_to_rgb", "hsv_to_rgb", "rgb_to_hsl", "rgb_to_hsv"]

Solid = Literal["double hexcone", "double cone", "cylinder"]
"""The solids of HSL."""


def rgb_to_hsv(rgb: ArrayLike, *, out: Array | None = None) -> Array:
    """Hue in degrees, saturation and value of RGB (..., 3) (Smith 1978).

    Example:
        >>> rgb_to_hsv([0.5, 0.5, 0.0]).tolist()
        [60.0, 1.0, 0.5]
    """
    return converted([step("named", "rgb_to_hsv")], rgb, out)


def hsv_to_rgb(hsv: ArrayLike, *, out: Array | None = None) -> Array:
    """RGB of hue in degrees, saturation and value (..., 3).

    Example:
        >>> hsv_to_rgb([240.0, 0.5, 1.0]).tolist()
        [0.5, 0.5, 1.0]
    """
    return converted([step("named", "hsv_to_rgb")], hsv, out)


def rgb_to_hsl(rgb: ArrayLike, *, solid: Solid = "double hexcone", out: Array | None = None) -> Array:
    """Hue in degrees, saturation and lightness of RGB (..., 3).

    Args:
        rgb: in [0, 1].
        solid: "double hexcone", "double cone" or "cylinder".
        out: as `illuminant.color.triples` says.

    Example:
        >>> rgb_to_hsl([0.0, 0.5, 0.0], solid="double cone").round(9).tolist()
        [120.0, 0.5, 0.25]
    """
    return converted([step("rgb_to_hsl", solid)], rgb, out)


def hsl_to_rgb(hsl: ArrayLike, *, solid: Solid = "double hexcone", out: Array | None = None) -> Array:
    """RGB of hue in degrees, saturation and lightness (..., 3); arguments as `rgb_to_hsl`.

    Example:
        >>> hsl_to_rgb([0.0, 1.0, 0.75]).tolist()
        [1.0, 0.5, 0.5]
    """
    return converted([step("hsl_to_rgb", solid)], hsl, out)
