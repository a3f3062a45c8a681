"""Pictures side by side with their captions, each pixel as it was rendered.

matplotlib's `imshow` resamples a picture, and mixes code values as if they were light; here each picture keeps its
pixels (or becomes whole multiples of them), and only the captions are drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import INK, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["picture_sheet"]

DPI = 100
MARGIN = 10
LINE = 15
"""Pixels of a margin and of a line of caption."""


def picture_sheet(
    pictures: Sequence[NDArray[np.uint8]],
    captions: Sequence[str],
    columns: int,
    magnify: int = 1,
) -> Figure:
    """A sheet of pictures of one size.

    Args:
        pictures: code values (h, w, 3) of 8 bits for sRGB.
        captions: one for each; lines are broken at newlines.
        columns: pictures in a row.
        magnify: how many pixels of the sheet make one of a picture, along each side.

    Raises:
        ValueError: the pictures differ in size, or there are not as many captions.

    Example:
        >>> import numpy as np
        >>> figure = picture_sheet([np.zeros((20, 30, 3), np.uint8)] * 2, ["left", "right"], columns=2)
        >>> (figure.get_size_inches() * figure.dpi).round().astype(int).tolist()
        [90, 52]
    """
    import numpy as np
    from matplotlib.figure import Figure

    if len({np.shape(picture) for picture in pictures}) != 1 or len(pictures) != len(captions):
        raise ValueError("a sheet needs pictures of one size and a caption for each")
    height, width = np.shape(pictures[0])[0] * magnify, np.shape(pictures[0])[1] * magnify
    rows = -(-len(pictures) // columns)
    below = 7 + LINE * max(caption.count("\n") + 1 for caption in captions)
    size = (MARGIN + columns * (width + MARGIN), MARGIN + rows * (height + below))
    with styled():
        # A thousandth more, or a size that is a whole number of pixels may be cut to one less.
        figure = Figure(figsize=((size[0] + 1e-3) / DPI, (size[1] + 1e-3) / DPI), dpi=DPI, facecolor="white")
        for place, (picture, caption) in enumerate(zip(pictures, captions, strict=True)):
            row, column = divmod(place, columns)
            left, top = MARGIN + column * (width + MARGIN), MARGIN + row * (height + below)
            large: Any = np.repeat(np.repeat(np.asarray(picture), magnify, axis=0), magnify, axis=1)
            figure.figimage(large, xo=left, yo=size[1] - top - height, origin="upper")
            figure.text(
                left / size[0],
                1.0 - (top + height + 3) / size[1],
                caption,
                color=INK,
                fontsize=8.5,
                ha="left",
                va="top",
                linespacing=1.25,
            )
    return figure
