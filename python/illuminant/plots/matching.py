"""Matching functions of an observer (book figures 3.5, 3.8 and 3.14)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from illuminant.plots import observer as observers
from illuminant.plots.style import new_figure, styled
from illuminant.plots.wavelength_axis import draw_wavelength_axis, shown_range

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["matching_functions"]

# Of the function that answers to long, to middle and to short wavelengths.
_LONG, _MIDDLE, _SHORT = "#C8322B", "#1E8E3E", "#2A5CAA"


def matching_functions(
    observer: str | observers.Functions = "1931",
    *,
    space: str = "xyz",
    primaries_nm: Sequence[float] | None = None,
    range_nm: tuple[float, float] | None = None,
    plain: bool = False,
    size: tuple[float, float] = (8.0, 5.0),
) -> Figure:
    """The three functions by which an observer samples a spectrum.

    Args:
        observer: a name, see `observer.named`, or its functions.
        space: "xyz", "ac1c2" (book eq 3.6 and figure 3.14) or an RGB system; not with `primaries_nm`.
        primaries_nm: three wavelengths: the amounts of these lights that match each wavelength (book figure 3.5).
        range_nm: wavelengths shown; None: 380–780 nm.
        plain: without the strip in the colours of the spectrum.
        size: width and height, inches.

    Raises:
        UsageError: no such observer or space, or unusable primaries.

    Example:
        >>> figure = matching_functions(primaries_nm=(445, 535, 630))
        >>> [line.get_label() for line in figure.axes[0].lines[:3]]
        ['L 445 nm', 'M 535 nm', 'H 630 nm']
    """
    import numpy as np

    eye = observers.named(observer) if isinstance(observer, str) else observer
    shown = shown_range([], range_nm)
    if primaries_nm is not None:
        functions = observers.for_primaries(eye, primaries_nm)
        colours = (_SHORT, _MIDDLE, _LONG)
        label = "power that matches unit power"
    else:
        functions = observers.in_space(eye, space)
        # A is the achromatic axis; C1 and C2 are red against green and blue against yellow.
        colours = ("#222222", _LONG, _SHORT) if space.casefold() == "ac1c2" else (_LONG, _MIDDLE, _SHORT)
        label = "response to unit power"
    grid = np.linspace(*shown, max(801, round(shown[1] - shown[0]) + 1))
    values = functions.at(grid)
    with styled():
        figure, axes = new_figure(size)
        lines = [
            axes.plot(grid, column, color=colour, label=name, clip_on=False)[0]
            for column, colour, name in zip(values.T, colours, functions.labels, strict=True)
        ]
        for w, colour in zip(sorted(primaries_nm or ()), colours, strict=False):
            if shown[0] <= w <= shown[1]:
                axes.plot([w], [1.0], marker="o", markersize=5, color=colour, zorder=3)
        negative = bool(values.min() < -1e-6)
        if not negative:
            axes.set_ylim(bottom=0.0)
        axes.set_ylabel(label)
        axes.set_title(functions.title)
        draw_wavelength_axis(axes, shown, None if plain else eye, zero_line=negative)
        figure.legend(handles=lines, loc="outside right upper")
    return figure
