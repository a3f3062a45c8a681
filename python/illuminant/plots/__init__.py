"""Plots of spectra, of matching functions and of chromaticity diagrams, drawn by matplotlib.

    curves(spectra)                curves on wavelength, over a strip in the colours of the spectrum
    matching_functions(observer)   x̄, ȳ, z̄, or their like in another space or for three monochromatic lights
    chromaticity("xy")             a diagram with the spectral locus, lamps, materials and gamuts
    distributions(), coefficients()   highlights of the literature in polar plots, and their coefficients
    picture_sheet(pictures, captions, columns)   pictures side by side, pixel for pixel
    projection(primaries_nm)       how the diagram of three lights comes about, in their space
    waveform(signal), vectorscope(signal)   a composite video signal as instruments show it
    yiq_gamut()                    the RGB cube in Y I Q, with the colours that NTSC cannot carry
    save(figure, path)             a PNG or an SVG, the same bytes for the same figure

The modules `observer` and `diagram` compute the numbers and know nothing of matplotlib; the others draw them.
matplotlib is imported only when a figure is made. A figure belongs to no window, and a user's matplotlibrc does not
change it.

Example:
    >>> from illuminant import plots, spectra
    >>> figure = plots.curves([spectra.load("D65"), spectra.load("FL11")], normalise_nm=560)
    >>> plots.save(figure, "lamps.svg")                      # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.plots.chroma_vectors import vectorscope
    from illuminant.plots.chromaticity_diagram import chromaticity
    from illuminant.plots.composite_waveform import waveform
    from illuminant.plots.contact_sheet import picture_sheet
    from illuminant.plots.lobes import coefficients, distributions
    from illuminant.plots.matching import matching_functions
    from illuminant.plots.projection_space import projection
    from illuminant.plots.spectral_curves import curves
    from illuminant.plots.style import save
    from illuminant.plots.yiq_cube import yiq_gamut

__all__ = [
    "chromaticity",
    "coefficients",
    "curves",
    "distributions",
    "matching_functions",
    "picture_sheet",
    "projection",
    "save",
    "vectorscope",
    "waveform",
    "yiq_gamut",
]

# Where each name lives; no module bears the name of a function, which importing it would replace.
_HOME = {
    "chromaticity": "chromaticity_diagram",
    "coefficients": "lobes",
    "distributions": "lobes",
    "curves": "spectral_curves",
    "matching_functions": "matching",
    "picture_sheet": "contact_sheet",
    "projection": "projection_space",
    "save": "style",
    "vectorscope": "chroma_vectors",
    "waveform": "composite_waveform",
    "yiq_gamut": "yiq_cube",
}


def __getattr__(name: str) -> Any:
    """Look up a lazy name of this package and keep it (PEP 562)."""
    from importlib import import_module

    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    return globals()[name]


def __dir__() -> list[str]:
    """Names that exist already and those that are looked up on first use."""
    return sorted({*globals(), *__all__})
