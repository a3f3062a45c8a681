"""Curves of spectra on one axis of wavelength."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError
from illuminant.plots import observer as observers
from illuminant.plots.style import line_look, new_figure, styled
from illuminant.plots.wavelength_axis import draw_wavelength_axis, shown_range
from illuminant.spectra import load

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from illuminant.spectra import Spectrum

__all__ = ["curve_points", "curves", "value_for_normalising"]


def curve_points(
    spectrum: Spectrum, range_nm: tuple[float, float], normalise_nm: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavelengths and values to draw: the samples within a range, and the ends of the line there.

    Where nothing was measured nothing is drawn, whatever the rule outside the range.

    Args:
        spectrum: a curve.
        range_nm: first and last wavelength shown.
        normalise_nm: the values are divided by that at this wavelength.

    Raises:
        UsageError: the curve has no value above zero at `normalise_nm`, or is not known there.

    Example:
        >>> from illuminant.spectra import Spectrum
        >>> ramp = Spectrum("ramp", [400, 500, 600], [0.0, 1.0, 2.0])
        >>> [a.tolist() for a in curve_points(ramp, (450, 700), normalise_nm=550)]
        [[450.0, 500.0, 600.0], [0.3333333333333333, 0.6666666666666666, 1.3333333333333333]]
    """
    import numpy as np

    first, last = max(range_nm[0], spectrum.range_nm[0]), min(range_nm[1], spectrum.range_nm[1])
    inner = [w for w in spectrum.wavelengths_nm if first < w < last]
    wavelengths = np.array([first, *inner, last])
    values = spectrum.at(wavelengths)
    if normalise_nm is not None:
        values = values / value_for_normalising(spectrum, normalise_nm)
    return wavelengths, values


def value_for_normalising(spectrum: Spectrum, wavelength_nm: float) -> float:
    """The value of a curve by which it is divided to be 1 at a wavelength.

    Raises:
        UsageError: the curve is not known there, or is not above zero.

    Example:
        >>> value_for_normalising(load("D65"), 560)
        100.0
    """
    first, last = spectrum.range_nm
    value = float(spectrum.at(wavelength_nm)) if first <= wavelength_nm <= last else math.nan
    if not value > 0:
        what = "is not known" if math.isnan(value) else f"is {value:g}"
        raise UsageError(
            f"{spectrum.name} {what} at {wavelength_nm:g} nm: expected a value above zero for normalising."
        )
    return value


def _axis_label(spectrum: Spectrum) -> str:
    """What the vertical axis of a curve other than n and k shows, with its unit."""
    if spectrum.quantity == "emission":
        return "relative power" if spectrum.unit == "relative" else f"power ({_typeset(spectrum.unit)})"
    if spectrum.quantity == "reflectance":
        return "reflectance"
    return "value" if spectrum.unit in ("", "1") else f"value ({_typeset(spectrum.unit)})"


def _typeset(unit: str) -> str:
    """`W sr⁻¹ m⁻²` of `W sr-1 m-2`."""
    superscripts = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    parts = unit.split()
    return " ".join(
        p.rstrip("-0123456789") + p[len(p.rstrip("-0123456789")) :].translate(superscripts) for p in parts
    )


def _own_look(reflectance: Spectrum) -> dict[str, Any]:
    """The line of a reflectance in its own colour under D65, as sRGB can show it, with a dark edge."""
    from matplotlib.patheffects import Normal, Stroke

    from illuminant.display.look import Look, show

    eye, light = observers.named(), load("D65")
    xyz = eye.sample(reflectance, light) / eye.sample(light)[1]
    code = show(xyz[None, None], Look(gamut="clamp")).picture.codes[0, 0]
    return {
        "color": tuple(code / 255.0),
        "linewidth": 1.8,
        "path_effects": [Stroke(linewidth=2.6, foreground="#444444"), Normal()],
    }


def curves(
    spectra: Sequence[Spectrum],
    *,
    normalise_nm: float | None = None,
    range_nm: tuple[float, float] | None = None,
    plain: bool = False,
    size: tuple[float, float] = (8.0, 5.0),
) -> Figure:
    """Curves of spectra on one axis of wavelength, with a strip below in the colours of the spectrum.

    Curves of one quantity share the vertical axis; a second quantity has its own at the right.

    Args:
        spectra: one or more.
        normalise_nm: bring each curve to 1 at this wavelength.
        range_nm: wavelengths shown; None: 380–780 nm, or all where a curve lies outside of these.
        plain: without the strip.
        size: width and height, inches.

    Raises:
        UsageError: no spectra, three quantities without `normalise_nm`, or see `curve_points` and `shown_range`.

    Example:
        >>> from illuminant import spectra
        >>> figure = curves([spectra.load("D65"), spectra.load("book/copper")])
        >>> [axes.get_ylabel() for axes in figure.axes]
        ['relative power', 'reflectance']
    """
    if not spectra:
        raise UsageError("A plot of curves needs at least one spectrum.")
    shown = shown_range(spectra, range_nm)
    points = [curve_points(s, shown, normalise_nm) for s in spectra]
    names = {"n": "index of refraction n", "k": "extinction coefficient k"}
    indices = ", ".join(text for key, text in names.items() if any(s.quantity == key for s in spectra))
    labels = [indices if s.quantity in names else _axis_label(s) for s in spectra]
    if normalise_nm is not None:
        labels = [f"relative to the value at {normalise_nm:g} nm"] * len(spectra)
    kinds = list(dict.fromkeys(labels))
    if len(kinds) > 2:
        raise UsageError(
            f"These are {len(kinds)} quantities ({'; '.join(kinds)}) and a plot has two axes: "
            "normalise the curves, or plot fewer."
        )
    with styled():
        figure, left = new_figure(size)
        sides = {kinds[0]: left}
        if len(kinds) == 2:
            sides[kinds[1]] = left.twinx()
            sides[kinds[1]].spines["right"].set_visible(True)
        # Twenty-four patches are told apart best by their own colours; a thin dark edge shows those near white.
        own = len(spectra) > 8 and all(s.quantity == "reflectance" for s in spectra)
        lines = []
        for number, (s, label, xy) in enumerate(zip(spectra, labels, points, strict=True)):
            look = _own_look(s) if own else line_look(number)
            name = f"{s.name} (right)" if label != kinds[0] else s.name
            lines += sides[label].plot(*xy, label=name, clip_on=False, **look)
        lowest = min(values.min() for _, values in points)
        for label, axes in sides.items():
            axes.set_ylabel(label)
            if lowest >= 0:
                axes.set_ylim(bottom=0.0)
        draw_wavelength_axis(left, shown, None if plain else observers.named(), zero_line=lowest < 0)
        if len(spectra) == 1:
            left.set_title(spectra[0].name)
        else:
            figure.legend(handles=lines, loc="outside right upper", ncols=1 if len(lines) <= 30 else 2)
    return figure
