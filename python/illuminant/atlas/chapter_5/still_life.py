"""A picture for the plates of video: a still life rendered once, as a frame buffer holds it.

Balls of full colours before a striped wall on a tiled floor (`still_life.toml` beside this file). Its code values are
those of 8 bits for the NTSC primaries with a white of D65, which the standard prescribes; `seen` takes such values to
the sRGB of a page, so that a plate shows what the receiver shows.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["DISPLAY", "seen", "still_life"]

DISPLAY = "NTSC 1953 D65"


@cache
def still_life(quick: bool) -> Float64:
    """Code values (h, w, 3), 0 to 1, of the still life; 160 × 120 pixels, or 440 × 330: all that a line carries."""
    import numpy as np

    from illuminant.display.look import Look
    from illuminant.rendering import render
    from illuminant.scene import load

    scene = load(Path(__file__).with_name("still_life.toml"))
    size, samples = ("160x120", 4) if quick else ("440x330", 9)
    values = np.array(render(scene, size=size, samples=samples).shown(Look(DISPLAY)).picture.values)
    values.flags.writeable = False
    return values


def seen(values: ArrayLike) -> NDArray[np.uint8]:
    """Code values (h, w, 3) of the NTSC primaries as codes of sRGB; what lies outside 0 to 1 is clamped."""
    import numpy as np

    from illuminant.display.picture import Picture
    from illuminant.display.video.transmission import corrected

    inside = np.clip(np.asarray(values, np.float64), 0.0, 1.0)
    return np.asarray(Picture.of_values(corrected(inside, DISPLAY, "sRGB"), "sRGB").codes, np.uint8)
