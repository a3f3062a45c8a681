"""Safe action and safe title areas: what a viewer's set is sure to show (book figure 5.28).

| standard | action | title |
| --- | --- | --- |
| RP 27.3 (SMPTE 1983), for CRTs | 90 % | 80 % |
| ST 2046-1 (SMPTE 2009), for flat displays | 93 % | 90 % |

The fractions are of the picture's width and of its height. Corners of the older one are rounded on a CRT, and are
square here.

Example:
    >>> rectangle(1000, 500, 0.9)
    (50, 25, 950, 475)
    >>> outside([[0, 0, 0], [0, 0, 0], [0, 0, 9]], 0.3)
    1.0
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Color, Screen, rgb
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from illuminant.display.patterns.screen import Values

__all__ = ["STANDARDS", "outside", "overlay", "rectangle", "safe_areas"]

STANDARDS = {"RP 27.3": (0.9, 0.8), "ST 2046-1": (0.93, 0.9)}
"""Fractions of safe action and of safe title."""


def rectangle(width: int, height: int, fraction: float) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of the area, in pixels; right and bottom are outside it."""
    left, top = round(width * (1 - fraction) / 2), round(height * (1 - fraction) / 2)
    return left, top, width - left, height - top


def outside(marks: ArrayLike, fraction: float) -> float:
    """Which part of what is marked lies outside an area: 0 when all is safe.

    Args:
        marks: (h, w), weights or a mask of what must be seen; 0 elsewhere.
        fraction: of the area.

    Returns:
        The fraction of the weights; 0 when there is nothing at all.
    """
    import numpy as np

    weights = np.abs(np.asarray(marks, np.float64))
    total = float(weights.sum())
    left, top, right, bottom = rectangle(weights.shape[1], weights.shape[0], fraction)
    return 1.0 - float(weights[top:bottom, left:right].sum()) / total if total else 0.0


def overlay(values: ArrayLike, *, standard: str = "RP 27.3", color: Color = 1.0) -> Values:
    """A picture with both areas outlined, and a cross in the middle.

    Args:
        values: (h, w, 3), code values; not changed.
        standard: a name of `STANDARDS`.
        color: of the lines.

    Raises:
        UsageError: there is no such standard.
    """
    import numpy as np

    if standard not in STANDARDS:
        raise UsageError(f"Safe areas are those of {' or '.join(STANDARDS)}, not {standard!r}.")
    result = np.array(values, np.float64)
    height, width = result.shape[:2]
    thick, ink = max(1, height // 360), rgb(color)
    for fraction in STANDARDS[standard]:
        left, top, right, bottom = rectangle(width, height, fraction)
        result[top : top + thick, left:right] = result[bottom - thick : bottom, left:right] = ink
        result[top:bottom, left : left + thick] = result[top:bottom, right - thick : right] = ink
    arm, middle_x, middle_y = height // 30, (width - thick) // 2, (height - thick) // 2
    result[middle_y : middle_y + thick, middle_x - arm : middle_x + thick + arm] = ink
    result[middle_y - arm : middle_y + thick + arm, middle_x : middle_x + thick] = ink
    return result


def safe_areas(
    screen: Screen, *, standard: str = "RP 27.3", color: Color = 1.0, background: Color = 0.25
) -> Values:
    """The outlines on a field of one colour."""
    return overlay(screen.blank(background), standard=standard, color=color)
