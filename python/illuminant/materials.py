"""Materials as people know them: a metal, glass, paint, plastic or lacquer with a finish, in words.

`find` turns a statement into the table of the scene file that it stands for:

    what it is [, finish] [, m = slope] [, σ = height nm]

- a metal of the library: "copper, circular mill", "gold, polished, σ = 5 nm", "aluminium, brushed";
- a transparent medium: "crown glass, ground", "water", "diamond";
- paint, plastic or glaze of a colour, or of a reflectance of the library: "red paint, gloss",
  "ColorChecker/blue sky plastic, matte";
- lacquer over metal: "copper, circular mill, lacquered"; metal flake: "blue metal flake, gloss".

In a scene file: `kind = "named"`, `name = "copper, circular mill"`.

Example:
    >>> find("gold, polished, σ = 3 nm")
    {'kind': 'conductor', 'metal': 'gold', 'roughness': 0.02, 'roughness_across': 0.02, 'sigma_nm': 3.0}
    >>> find("red paint, gloss")["reflectance"]
    'ColorChecker/red'
"""

from __future__ import annotations

import re
from typing import Any

from illuminant import finishes, spectra
from illuminant.core import core
from illuminant.errors import DataError, suggestion
from illuminant.spectrum import Spectrum

__all__ = ["find", "names", "pigment_of"]

METALS = {
    "aluminum": "aluminium",
    "steel": "iron",
    "stainless steel": "iron",
    "stainless": "iron",
    "chrome": "chromium",
}
"""Other words for metals of the library; iron is the nearest to steel of which n and k are known."""

MEDIA = {"glass": "BK7", "crown glass": "BK7", "quartz": "fused silica", "silica": "fused silica"}
"""Other words for media of the library."""

COLOURS = {
    "white": "ColorChecker/white 9.5",
    "black": "ColorChecker/black 2",
    "grey": "ColorChecker/neutral 5",
    "gray": "ColorChecker/neutral 5",
    **{
        name: f"ColorChecker/{name}"
        for name in ("red", "green", "blue", "yellow", "orange", "purple", "magenta", "cyan")
    },
}
"""The reflectances that stand for plain words."""

COATS = ("paint", "plastic", "glaze", "enamel", "metal flake")

NUMBER = re.compile(r"(m|σ|sigma)\s*=\s*([0-9.eE+-]+)\s*(nm|um|µm|μm)?")


def names() -> list[str]:
    """What a statement may begin with: metals, media and colours of paint, plastic, glaze or metal flake."""
    metals = [name.removesuffix(".k") for name in spectra.names("k")]
    media = [name.removesuffix(".n") for name in spectra.names("n") if name.removesuffix(".n") not in metals]
    coats = [f"{colour} {coat}" for colour in COLOURS for coat in COATS]
    return [*metals, *METALS, *media, *MEDIA, *coats]


def find(text: str) -> dict[str, Any]:
    """The table of the scene file for a material in words; see this module's page.

    Raises:
        DataError: the words are not understood; the message says what is known.

    Example:
        >>> find("crown glass, ground")
        {'kind': 'dielectric', 'medium': 'BK7', 'finish': 'ground'}
    """
    head, *parts = (" ".join(part.split()) for part in text.split(","))
    if not head:
        raise DataError(f'"{text}" names no material; for example "copper, circular mill"')
    numbers: dict[str, float] = {}
    finish = ""
    lacquered = False
    for part in parts:
        number = NUMBER.fullmatch(part)
        if number:
            numbers |= _number(part, number)
        elif part.lower() == "lacquered":
            lacquered = True
        elif finish:
            raise DataError(f'"{text}" names two finishes, "{finish}" and "{part}"')
        else:
            finish = finishes.finish(part).name
    metal = METALS.get(head.lower(), head.lower())
    coat = next((coat for coat in COATS if head.lower().endswith(" " + coat)), "")
    if f"{metal}.k" in spectra.names("k"):
        if lacquered:
            relief = _relief(finish or "polished", numbers, metal)
            slope = max(relief.get("roughness", 0.0), relief.get("roughness_across", 0.0))
            if "finish" in relief:
                slope = max(finishes.finish(relief["finish"], metal).slope)
            return {"kind": "coated", "metal": metal, "metal_roughness": slope}
        return {"kind": "conductor", "metal": metal} | _relief(finish or "polished", numbers, metal)
    if lacquered:
        raise DataError(f'"{text}": only metals are lacquered; a glossy paint is "red paint, gloss"')
    medium = MEDIA.get(head.lower(), head)
    known = {name.removesuffix(".n").lower(): name.removesuffix(".n") for name in spectra.names("n")}
    if medium.lower() in known:
        return {"kind": "dielectric", "medium": known[medium.lower()]} | _relief(finish or "gloss", numbers)
    if coat:
        colour = head[: -len(coat) - 1]
        reflectance = COLOURS.get(colour.lower(), colour)
        try:
            reflectance = spectra.find(reflectance).name
        except DataError:
            choices = f"{', '.join(COLOURS)} and reflectances of the library"
            message = f'"{colour}" is no colour of {coat}; known are {choices}'
            hint = suggestion(colour, COLOURS)
            raise DataError(message + (f" ({hint})" if hint else "")) from None
        table = {"kind": "coated", "reflectance": reflectance} | _relief(finish or "gloss", numbers)
        if coat == "metal flake":
            table |= {"metal": "aluminium", "coverage": 0.3, "metal_roughness": 0.15}
        return table
    hint = suggestion(head, names())
    raise DataError(
        f'"{head}" is no material that is known by a word; metals, media, and paint, plastic, glaze or metal flake of '
        f'a colour are, for example "copper, circular mill" or "red paint, gloss"'
        + (f" ({hint})" if hint else "")
    )


def _number(part: str, number: re.Match[str]) -> dict[str, float]:
    """The slope or the height that a part gives."""
    try:
        value = float(number[2])
    except ValueError:
        raise DataError(f'"{part}" has no number that can be read') from None
    if number[1] == "m":
        if number[3] or not 0.0 <= value <= 1.0:
            raise DataError(f'"{part}": a slope lies between 0 and 1 and has no unit')
        return {"m": value}
    if not number[3]:
        raise DataError(f'"{part}": a height needs its unit, nm or µm')
    return {"sigma": value * (1.0 if number[3] == "nm" else 1000.0)}


def _relief(finish: str, numbers: dict[str, float], material: str = "") -> dict[str, Any]:
    """The keys of the scene file for a finish, of which numbers may replace a part."""
    if not numbers:
        return {"finish": finish}
    found = finishes.finish(finish, material)
    along, across = (numbers["m"],) * 2 if "m" in numbers else found.slope
    sigma = None if found.sigma_nm is None or found.is_smooth else max(found.sigma_nm)
    keys: dict[str, Any] = {"roughness": along, "roughness_across": across}
    if "sigma" in numbers:
        sigma = numbers["sigma"]
    return keys if sigma is None else keys | {"sigma_nm": sigma}


def pigment_of(paint: Spectrum, index: Spectrum) -> Spectrum:
    """The reflectance of the pigment in a paint of which the total reflectance is known (Saunderson 1942).

    Args:
        paint: reflectance of the finished paint near normal incidence, surface included.
        index: index of refraction of the vehicle.

    Example:
        >>> white = Spectrum("", (400.0, 700.0), (1.0, 0.04), "hold", "reflectance")
        >>> glass = Spectrum("", (400.0, 700.0), (1.5, 1.5), "hold", "n")
        >>> [round(value, 6) for value in pigment_of(white, glass).values]
        [1.0, 0.0]
    """
    import numpy as np

    n = index.at(np.asarray(paint.wavelengths_nm))
    values = core().optics("pigment", [np.asarray(paint.values, dtype=float), np.asarray(n, dtype=float)])
    return Spectrum(
        f"pigment of {paint.name}",
        paint.wavelengths_nm,
        tuple(map(float, values)),
        paint.outside,
        paint.quantity,
    )
