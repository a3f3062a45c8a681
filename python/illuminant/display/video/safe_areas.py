"""Safe action and safe title (book 5.5, figure 5.28; SMPTE RP 27.3, 1983).

A receiver hides the edges of a picture. What matters in the action belongs in the middle 90 % of width and height, text
in the middle 80 %. The areas here are rectangles; the recommended practice rounds their corners.

Example:
    >>> rectangle(640, 480, ACTION), rectangle(640, 480, TITLE)
    ((32, 24, 608, 456), (64, 48, 576, 432))
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["ACTION", "TITLE", "detail", "inside", "outside_share", "overlay", "rectangle"]

ACTION, TITLE = 0.9, 0.8
"""Parts of width and of height."""


def rectangle(width: int, height: int, part: float) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of an area in the middle, in pixels; right and bottom are the first beyond it.

    Raises:
        UsageError: an image without pixels, or a part that is not above 0 and up to 1.
    """
    if width < 1 or height < 1:
        raise UsageError(f"An image of {width} × {height} pixels has no safe areas.")
    if not 0.0 < part <= 1.0:
        raise UsageError(f"A safe area of {part:g} of the picture: expected above 0, up to 1.")
    left, top = round(width * (1.0 - part) / 2.0), round(height * (1.0 - part) / 2.0)
    return left, top, width - left, height - top


def inside(width: int, height: int, part: float) -> NDArray[np.bool_]:
    """Which pixels (height, width) lie in an area.

    Example:
        >>> int(inside(10, 10, 0.8).sum())
        64
    """
    import numpy as np

    left, top, right, bottom = rectangle(width, height, part)
    mask = np.zeros((height, width), bool)
    mask[top:bottom, left:right] = True
    return mask


def overlay(rgb: ArrayLike, *, thickness: int | None = None) -> Float64:
    """The picture (h, w, 3) with the two areas drawn: their frames, and a cross in the middle.

    Lines are black where the picture is light and white where it is dark, so they are seen on all of it.

    Args:
        rgb: code values from 0 to 1.
        thickness: of a line in pixels; None: 1/400 of the height, at least 1.

    Raises:
        UsageError: `rgb` is no picture.
    """
    import numpy as np

    from illuminant.color.axes import monochrome
    from illuminant.display.video.transmission import picture

    array = picture(rgb).copy()
    height, width = array.shape[:2]
    t = max(1, round(height / 400)) if thickness is None else thickness
    left, top, right, bottom = rectangle(width, height, TITLE)
    if t < 1 or 2 * t >= min(right - left, bottom - top):
        raise UsageError(f"Lines of {t} pixels cannot be drawn into {width} × {height}.")
    drawn = np.zeros((height, width), bool)
    for part in (ACTION, TITLE):
        left, top, right, bottom = rectangle(width, height, part)
        drawn[top:bottom, [*range(left, left + t), *range(right - t, right)]] = True
        drawn[[*range(top, top + t), *range(bottom - t, bottom)], left:right] = True
    arm = max(2, min(width, height) // 24)
    middle_x, middle_y = width // 2, height // 2
    bar = slice(max(0, middle_y - t // 2), middle_y - t // 2 + t)
    post = slice(max(0, middle_x - t // 2), middle_x - t // 2 + t)
    drawn[bar, max(0, middle_x - arm) : middle_x + arm] = True
    drawn[max(0, middle_y - arm) : middle_y + arm, post] = True
    contrast = np.where(monochrome(array) > 0.5, 0.0, 1.0)
    array[drawn] = contrast[drawn][:, None]
    return array


def detail(rgb: ArrayLike, threshold: float = 0.1) -> NDArray[np.bool_]:
    """Where (h, w) a picture has edges: a step of R, G or B to the next column or row above the threshold."""
    import numpy as np

    from illuminant.display.video.transmission import picture

    array = picture(rgb)
    mask = np.zeros(array.shape[:2], bool)
    across = np.abs(np.diff(array, axis=1)).max(axis=-1) > threshold
    down = np.abs(np.diff(array, axis=0)).max(axis=-1) > threshold
    mask[:, :-1] |= across
    mask[:, 1:] |= across
    mask[:-1] |= down
    mask[1:] |= down
    return mask


def outside_share(mask: ArrayLike, part: float = TITLE) -> float:
    """Which share of marked pixels lies outside an area; 0 when nothing is marked.

    Args:
        mask: (h, w): where there is text, or action, or what `detail` finds.
        part: `TITLE` or `ACTION`.

    Raises:
        UsageError: the mask has not two axes.

    Example:
        >>> import numpy as np
        >>> outside_share(np.ones((10, 10))), outside_share(np.zeros((10, 10)))
        (0.36, 0.0)
    """
    import numpy as np

    marked = np.asarray(mask).astype(bool)
    if marked.ndim != 2:
        raise UsageError(f"A mask has rows and columns, not the shape {marked.shape}.")
    total = int(marked.sum())
    lost = int((marked & ~inside(marked.shape[1], marked.shape[0], part)).sum())
    return lost / total if total else 0.0
