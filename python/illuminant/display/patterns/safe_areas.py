"""Safe action and safe title areas: what a viewer's set is sure to show (book 5.5, figure 5.28).

A receiver hides the edges of a picture. What matters in the action belongs within one rectangle in its middle, text
within a smaller one:

| standard | action | title |
| --- | --- | --- |
| RP 27.3 (SMPTE 1983), for CRTs | 90 % | 80 % |
| ST 2046-1 (SMPTE 2009), for flat displays | 93 % | 90 % |

The fractions are of the picture's width and of its height. Corners of the older one are rounded on a CRT, and are
square here. `overlay` draws both over a picture, `outside` says how much of what must be seen is lost.

Example:
    >>> rectangle(640, 480, ACTION), rectangle(640, 480, TITLE)
    ((32, 24, 608, 456), (64, 48, 576, 432))
    >>> outside([[0, 0, 0], [0, 0, 0], [0, 0, 9]], 0.3)
    1.0
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Color, Screen, rgb
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.patterns.screen import Values

__all__ = [
    "ACTION",
    "STANDARDS",
    "TITLE",
    "detail",
    "fractions",
    "inside",
    "outside",
    "overlay",
    "rectangle",
    "safe_areas",
]

STANDARDS = {"RP 27.3": (0.9, 0.8), "ST 2046-1": (0.93, 0.9)}
"""Fractions of safe action and of safe title."""

ACTION, TITLE = STANDARDS["RP 27.3"]


def fractions(standard: str) -> tuple[float, float]:
    """Fractions of safe action and of safe title.

    Raises:
        UsageError: there is no such standard.
    """
    if standard not in STANDARDS:
        raise UsageError(f"Safe areas are those of {' or '.join(STANDARDS)}, not {standard!r}.")
    return STANDARDS[standard]


def rectangle(width: int, height: int, fraction: float) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of an area in the middle, in pixels; right and bottom are the first beyond it.

    Raises:
        UsageError: a picture without pixels, or a fraction that is not above 0 and up to 1.
    """
    if width < 1 or height < 1:
        raise UsageError(f"A picture of {width} × {height} pixels has no safe areas.")
    if not 0.0 < fraction <= 1.0:
        raise UsageError(f"A safe area of {fraction:g} of the picture: expected above 0, up to 1.")
    left, top = round(width * (1.0 - fraction) / 2.0), round(height * (1.0 - fraction) / 2.0)
    return left, top, width - left, height - top


def inside(width: int, height: int, fraction: float) -> NDArray[np.bool_]:
    """Which pixels (height, width) lie in an area.

    Example:
        >>> int(inside(10, 10, 0.8).sum())
        64
    """
    import numpy as np

    left, top, right, bottom = rectangle(width, height, fraction)
    mask = np.zeros((height, width), bool)
    mask[top:bottom, left:right] = True
    return mask


def outside(marks: ArrayLike, fraction: float = TITLE) -> float:
    """Which part of what is marked lies outside an area: 0 when all is safe, or when nothing is marked.

    Args:
        marks: (h, w), weights or a mask of what must be seen: text, action, or what `detail` finds.
        fraction: of the area.

    Raises:
        UsageError: the marks have not two axes.
    """
    import numpy as np

    weights = np.abs(np.asarray(marks, np.float64))
    if weights.ndim != 2:
        raise UsageError(f"Marks have rows and columns, not the shape {weights.shape}.")
    total = float(weights.sum())
    lost = float(weights[~inside(weights.shape[1], weights.shape[0], fraction)].sum())
    return lost / total if total else 0.0


def detail(values: ArrayLike, threshold: float = 0.1) -> NDArray[np.bool_]:
    """Where (h, w) a picture has edges: a step of R, G or B to the next column or row above the threshold."""
    import numpy as np

    from illuminant.display.video.transmission import picture

    array = picture(values)
    mask = np.zeros(array.shape[:2], bool)
    across = np.abs(np.diff(array, axis=1)).max(axis=-1) > threshold
    down = np.abs(np.diff(array, axis=0)).max(axis=-1) > threshold
    mask[:, :-1] |= across
    mask[:, 1:] |= across
    mask[:-1] |= down
    mask[1:] |= down
    return mask


def overlay(
    values: ArrayLike, *, standard: str = "RP 27.3", color: Color | None = None, thickness: int | None = None
) -> Values:
    """A picture with both areas outlined, and a cross in the middle.

    Args:
        values: (h, w, 3), code values from 0 to 1; not changed.
        standard: a name of `STANDARDS`.
        color: of the lines; None: black where the picture is light and white where it is dark, so that they are seen on
            all of it.
        thickness: of a line in pixels; None: 1/400 of the height, at least 1.

    Raises:
        UsageError: `values` are no picture, there is no such standard, or lines do not fit.
    """
    import numpy as np

    from illuminant.color.axes import monochrome
    from illuminant.display.video.transmission import picture

    areas = fractions(standard)
    array = picture(values).copy()
    height, width = array.shape[:2]
    t = max(1, round(height / 400)) if thickness is None else thickness
    left, top, right, bottom = rectangle(width, height, areas[1])
    if t < 1 or 2 * t >= min(right - left, bottom - top):
        raise UsageError(f"Lines of {t} pixels cannot be drawn into {width} × {height}.")
    drawn = np.zeros((height, width), bool)
    for fraction in areas:
        left, top, right, bottom = rectangle(width, height, fraction)
        drawn[top:bottom, [*range(left, left + t), *range(right - t, right)]] = True
        drawn[[*range(top, top + t), *range(bottom - t, bottom)], left:right] = True
    arm = max(2, min(width, height) // 24)
    middle_x, middle_y = width // 2, height // 2
    bar, post = (slice(max(0, middle - t // 2), middle - t // 2 + t) for middle in (middle_y, middle_x))
    drawn[bar, max(0, middle_x - arm) : middle_x + arm] = True
    drawn[max(0, middle_y - arm) : middle_y + arm, post] = True
    if color is None:
        array[drawn] = np.where(monochrome(array[drawn]) > 0.5, 0.0, 1.0)[:, None]
    else:
        array[drawn] = rgb(color)
    return array


def safe_areas(
    screen: Screen, *, standard: str = "RP 27.3", color: Color = 1.0, background: Color = 0.25
) -> Values:
    """The outlines on a field of one colour."""
    return overlay(screen.blank(background), standard=standard, color=color)
