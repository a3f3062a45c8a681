"""What there is to say of one spectrum: its facts, and the numbers that follow from its curve."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.spectra import Spectrum

__all__ = ["facts"]

OBSERVER = "CIE 1931 2°"

RANGE_NM = (360, 830)
"""The tables of the CIE's observer, and so the sums for XYZ."""

SODIUM_NM = 589.3
"""The wavelength at which glass makers and gemmologists state n, the mean of the two D lines."""


def facts(spectrum: Spectrum, header: dict[str, str]) -> dict[str, Any]:
    """Facts of a spectrum as `illuminant spectra show --json` prints them.

    `area` is `Spectrum.area`, the sum at every whole nm of the curve's own range. What follows from the curve is in
    `derived`, by the CIE 1931 2° observer and 1 nm sums from 360 to 830 nm:

        emission       x, y; cct_k, duv and ra (R_a of CIE 13.3) where these are defined; of a radiance also Y in cd/m²
        reflectance    xyz with Y = 1 for a perfect diffuser under D65, lab, srgb (#rrggbb), clipped says whether sRGB
                       cannot show it
        n, k           the value at 589.3 nm, where the curve is known there

    Args:
        spectrum: a curve.
        header: of its table in the library, or empty.

    Example:
        >>> from illuminant import spectra
        >>> derived = facts(spectra.load("D65"), spectra.header("D65"))["derived"]
        >>> round(derived["x"], 4), round(derived["y"], 4)
        (0.3127, 0.329)
    """
    import numpy as np

    steps = np.diff(spectrum.wavelengths_nm)
    even = bool(np.allclose(steps, steps[0], rtol=1e-6))
    return {
        "name": spectrum.name,
        "title": header.get("name", ""),
        "quantity": spectrum.quantity,
        "unit": spectrum.unit,
        "range_nm": list(spectrum.range_nm),
        "points": len(spectrum.values),
        "step_nm": float(steps[0]) if even else None,
        "outside": spectrum.outside,
        "area": _area(spectrum),
        "derived": _derived(spectrum),
        "source": header.get("source", ""),
        "provenance": header.get("provenance", "") or spectrum.provenance,
        "licence": header.get("licence", ""),
        "wavelengths_nm": list(spectrum.wavelengths_nm),
        "values": list(spectrum.values),
    }


def _area(spectrum: Spectrum) -> float | None:
    """The area; None where the range holds no two whole nm."""
    from illuminant.errors import UsageError

    try:
        return spectrum.area()
    except UsageError:
        return None


def _derived(spectrum: Spectrum) -> dict[str, Any]:
    """The numbers that follow from the curve; none for a quantity that is not known."""
    match spectrum.quantity:
        case "emission":
            return _of_lamp(spectrum)
        case "reflectance":
            return _of_reflectance(spectrum)
        case "n" | "k":
            first, last = spectrum.range_nm
            known = first <= SODIUM_NM <= last
            return {"wavelength_nm": SODIUM_NM, "value": float(spectrum.at(SODIUM_NM))} if known else {}
    return {}


def _of_lamp(lamp: Spectrum) -> dict[str, Any]:
    from illuminant import colorimetry
    from illuminant.errors import DataError

    try:
        x, y = colorimetry.chromaticity(lamp)
    except DataError:  # no light, or not known where it is needed
        return {}
    found: dict[str, Any] = {"observer": OBSERVER, "x": x, "y": y}
    if lamp.unit == "W sr-1 m-2 nm-1":
        found["luminance_cd_m2"] = float(lamp.xyz(range_nm=RANGE_NM)[1])
    # Both are defined for lights near the colours of blackbodies only.
    with contextlib.suppress(DataError):
        found["cct_k"], found["duv"] = colorimetry.correlated_color_temperature((x, y))
    with contextlib.suppress(DataError):
        found["ra"] = colorimetry.rendering_index(lamp).general
    return found


def _of_reflectance(reflectance: Spectrum) -> dict[str, Any]:
    import numpy as np

    from illuminant.core import core
    from illuminant.display.look import Look, show
    from illuminant.errors import DataError
    from illuminant.spectra import load

    light = load("D65")
    try:
        xyz = reflectance.xyz(light, range_nm=RANGE_NM)
    except DataError:  # not known where it is needed
        return {}
    white = light.xyz(range_nm=RANGE_NM)
    shown = show(xyz[np.newaxis, np.newaxis], Look(gamut="clamp"))
    return {
        "observer": OBSERVER,
        "light": "D65",
        "xyz": xyz.tolist(),
        "lab": core().xyz_to_lab(xyz, white / white[1]).tolist(),
        "srgb": "#" + "".join(f"{value:02x}" for value in shown.picture.codes[0, 0]),
        "clipped": shown.outside > 0,
    }
