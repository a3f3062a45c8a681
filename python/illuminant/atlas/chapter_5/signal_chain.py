"""A colour on its way from the computed image to the monitor, with its numbers at each station (book 5.3, figure 5.18).

    linear RGB → code values of 8 bits → line (terminators) → Y, I, Q → composite signal → Y, I, Q → RGB → light

All steps are those of the library; a flat field of the colour goes through them, and its numbers are read in the
middle of a line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Float64 = NDArray[np.float64]

__all__ = ["Stations", "passed"]


class Stations(NamedTuple):
    """Numbers of one colour.

    Attributes:
        linear: RGB of the image, parts of white.
        codes: in the frame buffer, 0 to 255.
        line: levels behind the distribution amplifier, parts of white.
        yiq: in the encoder.
        composite: lowest and highest level, IRE.
        received: Y, I, Q in the receiver.
        rgb: that drive the guns.
        xyz: of the light, Y of white is 100.
        delta_e: ΔE00 between that and the light that was computed.
    """

    linear: Float64
    codes: Float64
    line: Float64
    yiq: Float64
    composite: tuple[float, float]
    received: Float64
    rgb: Float64
    xyz: Float64
    delta_e: float


def passed(linear: tuple[float, float, float], terminators: int = 1, hue_deg: float = 0.0) -> Stations:
    """A colour through the system.

    Args:
        linear: RGB of the NTSC primaries, 0 to 1.
        terminators: of the line between frame buffer and encoder; one is right.
        hue_deg: the receiver's hue control; 0 is right.
    """
    import numpy as np

    from illuminant import color
    from illuminant.atlas.chapter_5.still_life import DISPLAY
    from illuminant.display.displays import named
    from illuminant.display.picture import Picture
    from illuminant.display.video.composite import encode
    from illuminant.display.video.decoders import decode
    from illuminant.display.video.distribution import load_factor
    from illuminant.display.video.legality import composite_range
    from illuminant.display.video.standard import ACTIVE

    display = named(DISPLAY)
    asked = np.array(linear)
    picture = Picture.of_values(display.encode(asked)[None, None], display)
    line = picture.values[0, 0] * load_factor(terminators)
    low, high = composite_range(line)
    signal = encode(np.broadcast_to(line, (6, ACTIVE, 3)))
    rgb = decode(signal, hue_deg=hue_deg)[3, ACTIVE // 2]
    light = display.decode(np.clip(rgb, 0.0, 1.0))
    to_xyz = display.to_xyz_matrix
    white = tuple(to_xyz.sum(axis=1))
    before, after = (color.xyz_to_lab(to_xyz @ one, white) for one in (asked, light))
    return Stations(
        linear=asked,
        codes=picture.codes[0, 0].astype(np.float64),
        line=line,
        yiq=np.asarray(color.rgb_to_yiq(line, matrix="standard"), np.float64),
        composite=(float(low), float(high)),
        received=np.asarray(color.rgb_to_yiq(rgb, matrix="standard"), np.float64),
        rgb=rgb,
        xyz=100.0 * np.asarray(to_xyz @ light),
        delta_e=float(color.delta_e_2000(before, after)),
    )
