"""What a wrong gamma does to colours: the ColorChecker through a correction that does not fit the monitor.

An image corrected for γ' on a monitor of γ shows

    intensity = (linear^(1/γ'))^γ = linear^(γ/γ')

for red, green and blue each. 0 and 1 stay, so black and white are right whatever γ' is; all in between is too bright
with γ' > γ and too dark with γ' < γ. Of a colour the largest component moves least in proportion: it loses saturation
with γ' > γ, and runs to a primary, or to the sum of two that are alike, with γ' < γ (book 5.1.2, figure 5.5). Contrast,
the slope of log intensity, is γ/γ' for greys.

The colours are the 24 of `illuminant.display.patterns.color_checker` in a monitor's linear RGB.
Differences are CIEDE2000 against the right display, in L*a*b* with the monitor's white.

Example:
    >>> shown([0.0, 127 / 255, 1.0], correction_gamma=2.6, monitor_gamma=2.2).round(3).tolist()
    [0.0, 0.554, 1.0]
    >>> found = study([1.8, 2.2, 2.6])
    >>> found.difference.mean(axis=1).round(1).tolist(), found.contrast.round(2).tolist()
    ([5.5, 0.0, 4.4], [1.22, 1.0, 0.85])
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from illuminant.display.gamma.response import correction, positive, response
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.displays import Display

    Float64 = NDArray[np.float64]

__all__ = ["GAMMAS", "MONITOR", "Drift", "shown", "study"]

GAMMAS = (1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""The gammas of correction of figure 5.5, when none are named."""

MONITOR = "book NTSC"
"""The book's monitor; all 24 colours lie inside of it."""

WHITE, BLACK = "white 9.5", "black 2"


@dataclass(frozen=True, eq=False)
class Drift:
    """The chart, shown with several gammas of correction.

    Attributes:
        names: (24) of the patches.
        monitor_gamma: γ of the monitor.
        gammas: (n,) γ' of the corrections.
        linear: (n, 24, 3) RGB shown.
        xyz: (n, 24, 3) of them, Y = 1 for the monitor's white.
        difference: (n, 24) ΔE00 from the right display.
        saturation: (n, 24) distance from the white in u'v', divided by that of the right display; nan for greys.
        contrast: (n,) log of the ratio of the white patch to the black patch, divided by that of the right display.
        outside: names of the patches clamped.
        display: the monitor; of its description primaries and white count.
    """

    names: tuple[str, ...]
    monitor_gamma: float
    gammas: Float64
    linear: Float64
    xyz: Float64
    difference: Float64
    saturation: Float64
    contrast: Float64
    outside: tuple[str, ...]
    display: Display

    @property
    def xy(self) -> Float64:
        """Chromaticities (n, 24, 2)."""
        import numpy as np

        return np.asarray(self.xyz[..., :2] / self.xyz.sum(axis=-1, keepdims=True))


def shown(linear: ArrayLike, correction_gamma: float, monitor_gamma: float = 2.2) -> Float64:
    """Intensities that a monitor shows of linear values corrected for another γ.

    Args:
        linear: any shape, 0 to 1.
        correction_gamma: γ' of the correction.
        monitor_gamma: γ of the monitor.

    Raises:
        UsageError: a γ is not above 0.

    Example:
        >>> shown(0.5, 2.2, 2.2).round(12).tolist()
        0.5
    """
    code = correction(linear, positive(correction_gamma, "The γ of the correction"))
    return response(code, positive(monitor_gamma, "The γ of the monitor"))


def study(
    gammas: Sequence[float] = GAMMAS, *, monitor_gamma: float = 2.2, display: str | Display = MONITOR
) -> Drift:
    """The drift of the ColorChecker with the gamma of correction (book figure 5.5).

    Args:
        gammas: γ' of the corrections.
        monitor_gamma: γ of the monitor.
        display: a display or its name, for the monitor's primaries and white.

    Raises:
        UsageError: a γ is not above 0, none is given, or there is no such display.
    """
    import numpy as np

    from illuminant import color
    from illuminant.display.displays import named
    from illuminant.display.patterns import color_checker

    if not len(gammas):
        raise UsageError("A drift needs at least one γ of correction.")
    monitor = named(display)
    patches = color_checker.patches(replace(monitor, response="linear", peak=1.0, black=0.0, reference=None))
    right = patches.linear.clip(0.0, 1.0)
    linear = np.stack([shown(right, gamma, monitor_gamma) for gamma in gammas])
    xyz = np.concatenate([right[None], linear]) @ monitor.to_xyz_matrix.T
    white = color.white_xyz(monitor.white)
    lab = color.xyz_to_lab(xyz, white)
    uv = color.xyz_to_uvy(xyz)[..., :2] - color.xyz_to_uvy(white)[:2]
    distance = np.linalg.norm(uv, axis=-1)
    # A grey has no saturation that could be lost.
    coloured = distance[0] > 0.01
    saturation = np.where(coloured, distance[1:] / np.where(coloured, distance[0], 1.0), np.nan)
    ends = xyz[:, [patches.names.index(WHITE), patches.names.index(BLACK)], 1]
    contrast = np.log(ends[:, 0] / ends[:, 1])
    return Drift(
        patches.names,
        float(monitor_gamma),
        np.array(gammas, np.float64),
        linear,
        xyz[1:],
        np.asarray(color.delta_e_2000(lab[:1], lab[1:])),
        saturation,
        contrast[1:] / contrast[0],
        patches.outside,
        monitor,
    )
