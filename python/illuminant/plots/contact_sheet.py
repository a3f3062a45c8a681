"""A contact sheet: images of one size side by side, pixel for pixel, with what they are written under them.

Images are not scaled: what the sheet shows is what each image would show by itself. A caption that is too wide for its
image breaks at the dot between technique and model.

Example:
    >>> import numpy as np
    >>> grey = np.full((60, 100, 3), 128, np.uint8)
    >>> sheet([[(grey, ("path · general", "ΔE00 1.2"))]]).shape
    (107, 116, 3)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import GREY, INK, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Codes = NDArray[np.uint8] | NDArray[np.uint16]

__all__ = ["GAP", "picture_sheet", "sheet"]

GAP = 8
"""Pixels between images, and around them."""
LEADING = 1.3
"""From one line to the next, in sizes of type."""


def sheet(
    rows: Sequence[Sequence[tuple[Codes, Sequence[str]]]],
    *,
    title_size: float = 13.0,
    note_size: float = 11.0,
) -> Bytes:
    """Images in rows, each over its lines of text.

    Args:
        rows: images (h, w, 3) of 8 bits, all of one shape, each with its lines; the first is its title, the others are
            notes in grey.
        title_size, note_size: of type, in pixels.

    Returns:
        (h, w, 3) on white.
    """
    import numpy as np
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    cells = [cell for row in rows for cell in row]
    height, width = cells[0][0].shape[:2]
    columns = max(len(row) for row in rows)
    with styled():
        figure = Figure(dpi=72, facecolor="white")  # at 72 to the inch a point of type is a pixel
        canvas: Any = FigureCanvasAgg(figure)
        texts = [_lines(canvas, lines, width, title_size, note_size) for _, lines in cells]
        below = max((sum(size * LEADING for _, size, _ in text) for text in texts), default=0.0)
        step = (width + GAP, height + round(below) + GAP)
        whole = (columns * step[0] + GAP, len(rows) * step[1] + GAP)
        figure.set_size_inches(whole[0] / 72, whole[1] / 72)
        placed = []
        number = 0
        for down, row in enumerate(rows):
            for across, (pixels, _) in enumerate(row):
                x, y = GAP + across * step[0], GAP + down * step[1]
                placed.append((x, y, pixels))
                baseline = y + height + 0.0
                for text, size, colour in texts[number]:
                    baseline += size * LEADING
                    at = ((x + width / 2) / whole[0], 1 - (baseline - 0.2 * size) / whole[1])
                    figure.text(*at, text, fontsize=size, color=colour, ha="center", va="baseline")
                number += 1
        canvas.draw()
        drawn = np.array(np.asarray(canvas.buffer_rgba())[..., :3])
    for x, y, pixels in placed:
        drawn[y : y + height, x : x + width] = pixels
    return drawn


def picture_sheet(
    pictures: Sequence[NDArray[Any]], captions: Sequence[str], columns: int, magnify: int = 1
) -> Figure:
    """A sheet as a figure, which `illuminant.plots.save` writes pixel for pixel.

    Args:
        pictures: code values (h, w, 3) of 8 bits for sRGB, all of one shape.
        captions: one for each; the first line is its title, what follows after newlines are notes.
        columns: pictures in a row.
        magnify: how many pixels of the sheet make one of a picture, along each side.

    Raises:
        ValueError: the pictures differ in size, or there are not as many captions.

    Example:
        >>> import numpy as np
        >>> figure = picture_sheet([np.zeros((60, 100, 3), np.uint8)] * 2, ["left", "right"], columns=2)
        >>> (figure.get_size_inches() * figure.dpi).astype(int).tolist()
        [224, 93]
    """
    import numpy as np
    from matplotlib.figure import Figure

    if len({np.shape(picture) for picture in pictures}) != 1 or len(pictures) != len(captions):
        raise ValueError("a sheet needs pictures of one size and a caption for each")
    large = [np.repeat(np.repeat(np.asarray(one), magnify, axis=0), magnify, axis=1) for one in pictures]
    cells = [(pixels, caption.split("\n")) for pixels, caption in zip(large, captions, strict=True)]
    drawn = sheet([cells[at : at + columns] for at in range(0, len(cells), columns)])
    height, width = drawn.shape[:2]
    # A thousandth more, or a size that is a whole number of pixels may be cut to one less.
    figure = Figure(figsize=((width + 1e-3) / 100, (height + 1e-3) / 100), dpi=100, facecolor="white")
    figure.figimage(drawn, origin="upper")
    return figure


def _lines(
    canvas: Any, lines: Sequence[str], width: int, title_size: float, note_size: float
) -> list[tuple[str, float, str]]:
    """Lines with their size and colour; what is too wide breaks at a dot, and is then made smaller."""
    from matplotlib.font_manager import FontProperties

    renderer = canvas.get_renderer()

    def extent(text: str, size: float) -> float:
        return float(renderer.get_text_width_height_descent(text, FontProperties(size=size), False)[0])

    found = []
    for number, line in enumerate(lines):
        size, colour = (note_size, GREY) if number else (title_size, INK)
        parts = [line] if extent(line, size) <= width else line.split(" · ")
        for part in parts:
            found.append((part, size * min(1.0, width / max(extent(part, size), 1.0)), colour))
    return found
