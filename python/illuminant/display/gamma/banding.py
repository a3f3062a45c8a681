"""Banding in numbers: how coarse the steps of a smooth gradation become when it is stored (book figure 5.7).

A gradation goes in equal small steps from dark to a surface's colour, as a curved surface under a lamp does. What a
monitor shows of it after storage is a staircase, and of its steps are told

- how many distinct colours there are, and how many of them below 10 % of intensity;
- the largest step in L*, over all and below 10 % (intensity banding);
- the largest jump of chromaticity between neighbours: ΔE00 of two colours brought to one luminance, that of their mean
  (colour banding). It comes with colours that are not neutral, whose red, green and blue step at different places.

Steps of the gradation itself are taken small enough not to matter: 16,384 samples by default, 0.01 in L* at most.
L*a*b* is taken with the monitor's white.

Example:
    >>> smooth = gradation((0.8, 0.55, 0.35))
    >>> before, at = compared(smooth, bits=8)
    >>> before.colours, at.colours
    (577, 357)
    >>> round(before.largest_step, 2), round(at.largest_step, 2)
    (0.37, 2.25)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.gamma.response import Curve
from illuminant.display.gamma.storage import at_display, before_storage
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.color.rgb import System

    Float64 = NDArray[np.float64]

__all__ = ["COLOUR", "LOW", "Banding", "banding", "compared", "gradation", "shaded_sphere"]

COLOUR = (0.80, 0.55, 0.35)
"""A warm surface, linear RGB under a white lamp, when none is named."""

LOW = 0.1
"""Up to which share of white's luminance a step counts as one of low intensity."""


@dataclass(frozen=True)
class Banding:
    """The steps of a gradation that was stored.

    Attributes:
        colours: distinct colours in a row, each counted where it differs from the one before.
        low_colours: those of them whose Y is below `LOW`.
        levels: distinct intensities of red, green and blue.
        largest_step: largest step of L* between neighbours.
        largest_low_step: the same where the lower of the two has Y below `LOW`.
        largest_colour_step: largest ΔE00 between neighbours brought to one luminance.
        mean_error: mean ΔE00 from the gradation itself.
    """

    colours: int
    low_colours: int
    levels: tuple[int, int, int]
    largest_step: float
    largest_low_step: float
    largest_colour_step: float
    mean_error: float


def gradation(colour: Sequence[float] = COLOUR, count: int = 16384, *, top: float = 1.0) -> Float64:
    """A ramp (count, 3) of linear RGB from black to a colour, even in intensity^(1/2.4) so that dark parts are wide.

    Args:
        colour: linear RGB of the bright end, 0 to 1.
        count: samples.
        top: how far the ramp goes, as a share of the colour; 0.05 makes one of low intensities alone.

    Raises:
        UsageError: the colour is no RGB of 0 to 1, or there are fewer than two samples.

    Example:
        >>> gradation((1.0, 0.5, 0.25), 3)[-1].tolist()
        [1.0, 0.5, 0.25]
    """
    import numpy as np

    if count < 2:
        raise UsageError(f"A gradation has at least two samples, not {count}.")
    if not 0.0 < top <= 1.0:
        raise UsageError(f"A gradation goes up to a share above 0 and at most 1, not {top}.")
    return np.linspace(0.0, 1.0, count)[:, None] ** 2.4 * top * _surface(colour)


def shaded_sphere(
    size: int = 256,
    colour: Sequence[float] = COLOUR,
    *,
    light: Sequence[float] = (-0.5, 0.6, 0.62),
    background: float = 0.02,
) -> Float64:
    """A sphere of a diffuse surface under a distant lamp, (size, size, 3) of linear RGB, on a ground that darkens.

    Args:
        size: pixels along a side.
        colour: linear RGB where the lamp is overhead.
        light: towards the lamp: x to the right, y up, z to the eye.
        background: Y of the ground at its upper edge; it falls to 0 at the lower one.

    Raises:
        UsageError: the colour is no RGB of 0 to 1, or the size is below 2.
    """
    import numpy as np

    if size < 2:
        raise UsageError(f"A picture has at least 2 pixels along a side, not {size}.")
    at = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    x, y = at[None, :] / 0.9, -at[:, None] / 0.9
    inside = x**2 + y**2 < 1.0
    z = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    direction = np.asarray(light, np.float64) / np.linalg.norm(light)
    cosine = np.maximum(direction[0] * x + direction[1] * y + direction[2] * z, 0.0)
    ground = background * np.linspace(1.0, 0.0, size)[:, None, None] * np.ones((size, size, 3))
    return np.asarray(np.where(inside[..., None], cosine[..., None] * _surface(colour), ground))


def _surface(colour: Sequence[float]) -> Float64:
    """A colour as an array, when it is one that a monitor shows."""
    import numpy as np

    try:
        rgb = np.array([float(part) for part in colour])
    except (TypeError, ValueError):
        rgb = np.empty(0)
    if rgb.shape != (3,) or not ((rgb >= 0) & (rgb <= 1)).all() or not rgb.any():
        raise UsageError(f"A colour is three numbers from 0 to 1, not all 0, and not {colour}.")
    return rgb


def banding(shown: ArrayLike, smooth: ArrayLike, system: System = "book NTSC") -> Banding:
    """The steps in what is shown of a gradation.

    Args:
        shown: (n, 3) linear RGB that the monitor shows.
        smooth: (n, 3) what was to be shown.
        system: the monitor's primaries and white.

    Raises:
        UsageError: the shapes differ, or there is no such system.
    """
    import numpy as np

    from illuminant import color

    rgb, wanted = np.asarray(shown, np.float64), np.asarray(smooth, np.float64)
    if rgb.ndim != 2 or rgb.shape[1] != 3 or len(rgb) < 2 or rgb.shape != wanted.shape:
        raise UsageError(f"A gradation is two arrays (n, 3), not {rgb.shape} and {wanted.shape}.")
    monitor = color.system(system)
    white = color.white_xyz(monitor.white)

    def lab(values: Float64) -> Float64:
        return np.asarray(color.xyz_to_lab(values, white), np.float64)

    xyz = np.asarray(color.rgb_to_xyz(rgb, monitor), np.float64)
    error = color.delta_e_2000(lab(xyz), lab(np.asarray(color.rgb_to_xyz(wanted, monitor))))
    change = np.flatnonzero((np.diff(rgb, axis=0) != 0).any(axis=1))
    colours = np.concatenate([xyz[:1], xyz[change + 1]])
    before, after = colours[:-1], colours[1:]
    step = np.abs(np.diff(lab(colours)[:, 0]))
    low = np.minimum(before[:, 1], after[:, 1]) < LOW
    # Black has no chromaticity, so the step out of it is one of intensity alone.
    lit = np.minimum(before[:, 1], after[:, 1]) > 0
    mean = 0.5 * (before[lit, 1:2] + after[lit, 1:2])
    jumps = color.delta_e_2000(
        lab(before[lit] * mean / before[lit, 1:2]), lab(after[lit] * mean / after[lit, 1:2])
    )
    return Banding(
        len(colours),
        int(np.count_nonzero(colours[:, 1] < LOW)),
        (len(np.unique(rgb[:, 0])), len(np.unique(rgb[:, 1])), len(np.unique(rgb[:, 2]))),
        float(step.max(initial=0.0)),
        float(step[low].max(initial=0.0)),
        float(np.max(jumps, initial=0.0)),
        float(np.mean(error)),
    )


def compared(
    smooth: ArrayLike,
    bits: int = 8,
    gamma: Curve = 2.2,
    *,
    display_bits: int | None = None,
    system: System = "book NTSC",
) -> tuple[Banding, Banding]:
    """The steps of a gradation corrected before storage, and corrected at display (book figure 5.7).

    Args:
        smooth: (n, 3) linear RGB.
        bits: of the file.
        gamma: γ of the monitor, or the name of a curve.
        display_bits: of the entries of the table at display; None: those of the file.
        system: the monitor's primaries and white.
    """
    return (
        banding(before_storage(smooth, bits, gamma), smooth, system),
        banding(at_display(smooth, bits, gamma, display_bits=display_bits), smooth, system),
    )
