"""The scale of false colours, drawn small into the picture: a bar in the colours, numbers below it, the unit above.

A logarithmic scale has its numbers at powers of ten, a linear one at its ends and in the middle.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Codes = NDArray[np.uint8]

__all__ = ["amount", "marks", "with_scale"]

BAR = (240, 12)
EDGE = 14
LETTERS = 12


def amount(value: float) -> str:
    """A quantity with four digits, and no power of ten where people write none.

    Example:
        >>> amount(23451.7), amount(1540.2), amount(0.01234), amount(3e-9)
        ('23,450', '1,540', '0.01234', '3e-09')
    """
    rounded = float(f"{value:.4g}")
    return f"{rounded:,.0f}" if 1000.0 <= abs(rounded) < 1e9 else f"{value:.4g}"


def marks(low: float, high: float, *, logarithmic: bool) -> list[tuple[float, str]]:
    """Where numbers stand on a scale (0 to 1), and the numbers.

    Example:
        >>> marks(0.5, 500.0, logarithmic=True)[0]
        (0.10034333188799373, '1')
        >>> marks(0.0, 10.0, logarithmic=False)
        [(0.0, '0'), (0.5, '5'), (1.0, '10')]
    """
    if not logarithmic:
        return [(part, f"{low + part * (high - low):.3g}") for part in (0.0, 0.5, 1.0)]
    length = math.log10(high / low)
    powers = range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)
    return [((power - math.log10(low)) / length, _number(power)) for power in powers]


def _number(power: int) -> str:
    return f"{10**power:,}" if 0 <= power <= 6 else f"{10.0**power:.3g}"


def with_scale(
    codes: Codes, colours: str, low: float, high: float, title: str, *, logarithmic: bool
) -> Codes:
    """A picture with a scale at its lower left; a picture that is too small for one is left as it is.

    Args:
        codes: (h, w, 3).
        colours: name of the map of colours.
        low, high: what the ends of the map stand for.
        title: quantity and unit.
        logarithmic: whether equal steps are equal ratios.
    """
    import matplotlib
    import numpy as np
    from matplotlib import colormaps
    from PIL import Image, ImageDraw, ImageFont

    (width, height), (down, across) = BAR, codes.shape[:2]
    box = (width + 2 * EDGE + 20, height + 2 * LETTERS + 26)
    if across < box[0] + 2 * EDGE or down < box[1] + 2 * EDGE:
        return codes
    picture = Image.fromarray(codes)
    draw: Any = ImageDraw.Draw(picture)
    font = ImageFont.truetype(f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf", LETTERS)
    left, top = EDGE, down - EDGE - box[1]
    draw.rectangle((left, top, left + box[0], top + box[1]), fill=(20, 20, 20))
    start, bar = left + (box[0] - width) // 2, top + LETTERS + 12
    draw.text((left + box[0] / 2, top + 6), title, fill=(240, 240, 240), font=font, anchor="ma")
    ramp = np.asarray(colormaps[colours](np.linspace(0, 1, width), bytes=True)[:, :3])
    picture.paste(Image.fromarray(np.repeat(ramp[None], height, axis=0)), (start, bar))
    for part, number in marks(low, high, logarithmic=logarithmic):
        place = start + part * (width - 1)
        draw.line((place, bar + height, place, bar + height + 3), fill=(240, 240, 240))
        draw.text((place, bar + height + 5), number, fill=(240, 240, 240), font=font, anchor="ma")
    return np.asarray(picture)
