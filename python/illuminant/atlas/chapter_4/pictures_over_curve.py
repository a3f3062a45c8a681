"""Rendered pictures, each pixel as it was rendered, over one pair of axes for what a line across them shows.

Pictures are placed as in `illuminant.plots.picture_sheet`; the axes are as wide as the row of pictures.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["pictures_over_curve"]

DPI = 150
MARGIN = 15
LINE = 23
"""Pixels of a margin and of a line of caption."""

LEFT, RIGHT, BELOW = 95, 30, 75
"""Pixels beside and below the axes for their labels."""

LEAST_ACROSS = 950
"""Pixels of the sheet, which pictures are enlarged by whole multiples to fill."""


def pictures_over_curve(
    pictures: Sequence[NDArray[Any]], captions: Sequence[str], curve_height: int = 360
) -> tuple[Figure, Axes]:
    """Pictures in a row over empty axes.

    Args:
        pictures: code values (h, w, 3) of 8 bits for sRGB, all of one size.
        captions: one for each; lines are broken at newlines.
        curve_height: pixels of the axes.

    Example:
        >>> import numpy as np
        >>> figure, axes = pictures_over_curve([np.zeros((90, 300, 3), np.uint8)] * 2, ["left", "right"])
        >>> (figure.get_size_inches() * figure.dpi).round().astype(int).tolist()
        [1245, 678]
    """
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant.plots.style import INK

    height, width = np.shape(pictures[0])[:2]
    magnify = max(1, -(-LEAST_ACROSS // (len(pictures) * (width + MARGIN))))
    height, width = height * magnify, width * magnify
    across = MARGIN + len(pictures) * (width + MARGIN)
    captions_height = 10 + LINE * max(caption.count("\n") + 1 for caption in captions)
    top_part = MARGIN + height + captions_height
    total = top_part + curve_height + BELOW + MARGIN
    # A thousandth more, or a size that is a whole number of pixels may be cut to one less.
    figure = Figure(figsize=((across + 1e-3) / DPI, (total + 1e-3) / DPI), dpi=DPI, facecolor="white")
    for place, (picture, caption) in enumerate(zip(pictures, captions, strict=True)):
        left = MARGIN + place * (width + MARGIN)
        pixels: Any = np.repeat(np.repeat(np.asarray(picture), magnify, axis=0), magnify, axis=1)
        figure.figimage(pixels, xo=left, yo=total - MARGIN - height, origin="upper")
        figure.text(
            left / across,
            1.0 - (MARGIN + height + 5) / total,
            caption,
            color=INK,
            fontsize=8.5,
            ha="left",
            va="top",
            linespacing=1.2,
        )
    axes = figure.add_axes(
        (LEFT / across, BELOW / total, (across - LEFT - RIGHT) / across, curve_height / total)
    )
    return figure, axes
