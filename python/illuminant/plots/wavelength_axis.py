"""The axis of wavelength: its range, its ticks, and a strip below the curves in the colours of the spectrum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from illuminant.errors import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from illuminant.plots.observer import Functions
    from illuminant.spectra import Spectrum

__all__ = ["VISIBLE_NM", "draw_wavelength_axis", "shown_range"]

VISIBLE_NM = (380.0, 780.0)
"""What is shown when nothing else is asked for."""


def shown_range(
    spectra: Sequence[Spectrum], wanted: tuple[float, float] | None = None
) -> tuple[float, float]:
    """The wavelengths to show, nm: those asked for, else 380–780 nm, else all that the curves have.

    Args:
        spectra: the curves that shall be seen.
        wanted: first and last wavelength, or None.

    Raises:
        UsageError: the wanted range is none, or a curve lies outside of it.

    Example:
        >>> from illuminant import spectra
        >>> shown_range([spectra.load("gold.n")])
        (380.0, 780.0)
        >>> shown_range([spectra.Spectrum("infrared", [800, 1100], [1, 1])])
        (800.0, 1100.0)
    """
    if wanted is not None:
        first, last = wanted
        if not (0 < first < last and math.isfinite(last)):
            raise UsageError(f"Range {first:g}-{last:g} nm: expected two increasing wavelengths above zero.")
    else:
        first, last = VISIBLE_NM
        if any(s.range_nm[0] >= last or s.range_nm[1] <= first for s in spectra):
            return min(s.range_nm[0] for s in spectra), max(s.range_nm[1] for s in spectra)
    for s in spectra:
        if s.range_nm[0] >= last or s.range_nm[1] <= first:
            raise UsageError(
                f"{s.name} is known from {s.range_nm[0]:g} to {s.range_nm[1]:g} nm, and nothing of that lies in the "
                f"range {first:g}-{last:g} nm."
            )
    return first, last


def draw_wavelength_axis(
    axes: Axes, range_nm: tuple[float, float], observer: Functions | None, zero_line: bool = False
) -> None:
    """Set up the horizontal axis in nm.

    Args:
        axes: where.
        range_nm: first and last wavelength shown.
        observer: whose colours the strip below the axis shows; None: no strip.
        zero_line: draw a line at 0, for curves with negative values.
    """
    import numpy as np
    from matplotlib.ticker import MaxNLocator
    from matplotlib.transforms import BboxTransformTo, ScaledTranslation, blended_transform_factory

    from illuminant.plots.monochromatic import spectrum

    axes.set_xlim(*range_nm)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=9, steps=[1, 2, 5, 10], integer=True))
    axes.grid(True)
    axes.set_xlabel("wavelength (nm)")
    if zero_line:
        axes.axhline(0.0, color="#888888", linewidth=0.8, zorder=1.5)
    if observer is None:
        return
    edges = np.linspace(*range_nm, 801)
    # As wide as the axes, and in inches below them, so that it stays clear of the ticks at any height.
    inches = axes.figure.dpi_scale_trans + ScaledTranslation(0, 0, BboxTransformTo(axes.bbox))
    below = blended_transform_factory(axes.transAxes, inches)
    strip = axes.inset_axes((0.0, -0.14, 1.0, 0.12), transform=below)
    strip.imshow(
        spectrum(observer, (edges[1:] + edges[:-1]) / 2)[np.newaxis],
        extent=(*range_nm, 0, 1),
        aspect="auto",
        interpolation="nearest",
    )
    strip.set_axis_off()
    axes.tick_params(axis="x", length=0, pad=13)
    axes.spines["bottom"].set_visible(False)
