"""What a word means where a spectrum is asked for: a name of the library, a file, or a lamp that is an equation.

Equations are `blackbody:2856`, or `2856K` for short (Planck 1900), and `daylight:6504` (CIE 15:2018), in K, by 1 nm
from 300 to 830 nm. A file whose path is also a name of the library is meant when a folder stands before it: `./D65`.

Example:
    >>> load("2856K").name, load("D65").quantity
    ('blackbody 2856 K', 'emission')
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    from illuminant.spectrum import Spectrum

__all__ = ["equation", "is_file", "light", "load"]

_FILE_ENDINGS = {".csv", ".tsv", ".spd", ".txt", ".dat", ".mat", ".mtl", ".material"}
_EQUATION = re.compile(r"(blackbody|daylight):(.*)", re.IGNORECASE)
_KELVIN = re.compile(r"(\d+(?:\.\d+)?) ?K")


def is_file(word: str) -> bool:
    """Whether a word means a file rather than a name of the library.

    Example:
        >>> is_file("D65"), is_file("paint.csv"), is_file("./D65"), is_file("ColorChecker/red")
        (False, True, True, False)
    """
    from illuminant import spectra

    if re.match(r"\.{0,2}/|~|\.{1,2}$", word):
        return True
    try:
        spectra.find(word)
    except DataError:
        return Path(word).is_file() or Path(word).suffix.casefold() in _FILE_ENDINGS
    return False


def load(word: str) -> Spectrum:
    """The spectrum that a word means.

    Raises:
        DataError: there is no such name (with near ones), or the file is broken (with its line).
        UsageError: a temperature that is none.
    """
    from illuminant import spectra

    lamp = equation(word)
    if lamp is not None:
        return lamp
    return spectra.read(Path(word).expanduser()) if is_file(word) else spectra.load(word)


def light(word: str) -> Spectrum:
    """The spectrum of a lamp that a word means.

    Raises:
        DataError, UsageError: as `load`; also where the spectrum is that of a reflectance, or of n or k.

    Example:
        >>> light("BK7.n")
        Traceback (most recent call last):
        illuminant.errors.DataError: 'BK7.n' is a spectrum of n, and a lamp has one of emission
    """
    spectrum = load(word)
    if spectrum.quantity not in ("emission", ""):
        raise DataError(f"{word!r} is a spectrum of {spectrum.quantity}, and a lamp has one of emission")
    if min(spectrum.values) < 0:
        raise DataError(f"{word!r} has values below 0, and a lamp has none")
    return spectrum


def equation(word: str) -> Spectrum | None:
    """The blackbody or daylight that a word means; None for other words.

    Raises:
        UsageError: the temperature is none, or there is no daylight of it.

    Example:
        >>> equation("daylight:6504").name, equation("D65")
        ('daylight 6504 K', None)
    """
    short, found = _KELVIN.fullmatch(word), _EQUATION.fullmatch(word)
    if short is None and found is None:
        return None
    kind, text = ("blackbody", short[1]) if short else ("", "")
    if found:
        kind, text = found[1].casefold(), found[2]

    import numpy as np

    from illuminant.core import core
    from illuminant.spectra import Spectrum

    try:
        temperature = float(text)
        grid = np.arange(300.0, 831.0)
        of = core().planck if kind == "blackbody" else core().daylight
        values = of(grid, temperature).tolist()
        if not any(values):
            raise ValueError
    except ValueError:
        limits = "a temperature in K" if kind == "blackbody" else "a colour temperature of 4000 to 25000 K"
        raise UsageError(f"{kind}:{text}: expected {limits}, such as {kind}:6504.") from None
    unit = "W sr-1 m-2 nm-1" if kind == "blackbody" else "relative"
    source = "Planck (1900)" if kind == "blackbody" else "CIE 15:2018, equations of daylight"
    return Spectrum(
        f"{kind} {temperature:g} K", tuple(grid.tolist()), tuple(values), "zero", unit, source, "emission"
    )
