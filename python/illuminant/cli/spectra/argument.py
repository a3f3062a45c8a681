"""What a word means where a spectrum is asked for, and the options that several verbs share.

A word is a name of the library, a file, or a lamp that is an equation: `blackbody:2856` and `daylight:6504`, in K.
A file whose path is also a name of the library is meant when a folder stands before it: `./D65`.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from illuminant.spectra import MaterialFile, Quantity, Spectrum

__all__ = [
    "Column",
    "FileQuantity",
    "check_file_options",
    "is_file",
    "load",
    "material_of",
    "numbers",
    "quantity_of",
    "range_of",
]

FileQuantity = Annotated[
    str | None,
    typer.Option(
        "--quantity",
        metavar="NAME",
        help="What a file that does not say so holds: emission, reflectance, n or k.",
        show_default=False,
    ),
]

Column = Annotated[
    str | None,
    typer.Option(
        "--column", metavar="NAME", help="Column of values in a file that has several.", show_default=False
    ),
]

_FILE_ENDINGS = {".csv", ".tsv", ".spd", ".txt", ".dat", ".mat", ".mtl", ".material"}
_EQUATION = re.compile(r"(blackbody|daylight):(.*)", re.IGNORECASE)


def is_file(word: str) -> bool:
    """Whether a word means a file rather than a name of the library.

    Example:
        >>> is_file("D65"), is_file("paint.csv"), is_file("./D65"), is_file("ColorChecker/red")
        (False, True, True, False)
    """
    from illuminant import spectra
    from illuminant.errors import DataError

    if re.match(r"\.{0,2}/|~|\.{1,2}$", word):
        return True
    try:
        spectra.find(word)
    except DataError:
        return Path(word).is_file() or Path(word).suffix.casefold() in _FILE_ENDINGS
    return False


def check_file_options(words: list[str], quantity: str | None, column: str | None) -> None:
    """Refuse --quantity and --column where no word means a file."""
    from illuminant.errors import UsageError

    for option, value in (("--quantity", quantity), ("--column", column)):
        if value is not None and not any(is_file(word) for word in words):
            raise UsageError(f"{option} goes with a file{f', and {words[0]} is none' if words else ''}.")


def load(word: str, quantity: str | None = None, column: str | None = None) -> Spectrum:
    """The spectrum that a word means.

    Args:
        word: see this module.
        quantity: what a file holds that does not say so.
        column: of a file that has several.

    Raises:
        DataError: there is no such name (with near ones), or the file is broken (with its line).
        UsageError: a temperature that is none, or a quantity that is none.

    Example:
        >>> load("blackbody:2856").name, load("D65").quantity
        ('blackbody 2856 K', 'emission')
    """
    from illuminant import spectra

    found = _EQUATION.fullmatch(word)
    if found:
        return _lamp(found[1].casefold(), found[2])
    if not is_file(word):
        return spectra.load(word)
    path = Path(word).expanduser()
    given = quantity_of(quantity)
    spectrum = spectra.read(path, column=column)
    if given and not spectrum.quantity:
        spectrum = spectra.read(path, column=column, quantity=given, name=spectrum.name)
    elif given and given != spectrum.quantity:
        from illuminant.errors import UsageError

        raise UsageError(f"--quantity {given}: {word} says that it holds {spectrum.quantity}.")
    return spectrum


def material_of(word: str) -> MaterialFile | None:
    """What a material file of the book says beside its curve (n, k, conductor or dielectric); None for all others."""
    from illuminant import spectra
    from illuminant.errors import DataError

    if _EQUATION.fullmatch(word) or not is_file(word):
        return None
    try:
        found = spectra.read_material(Path(word).expanduser(), quantity="")
    except DataError:
        return None
    return found if (found.n, found.k, found.conductor) != (None, None, None) else None


def _lamp(kind: str, text: str) -> Spectrum:
    """A blackbody (Planck 1900) or daylight (CIE 15:2018) by 1 nm."""
    import numpy as np

    from illuminant.core import core
    from illuminant.errors import UsageError
    from illuminant.spectra import Spectrum

    try:
        temperature = float(text)
        grid = np.arange(300.0, 831.0)
        light = core().planck if kind == "blackbody" else core().daylight
        values = light(grid, temperature).tolist()
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


def quantity_of(text: str | None) -> Quantity | None:
    """A quantity as an option gives it; refuses what is none."""
    from illuminant.errors import UsageError

    match text and text.casefold():
        case None:
            return None
        case "emission" | "reflectance" | "n" | "k" as quantity:
            return quantity
    raise UsageError(f"--quantity {text}: expected emission, reflectance, n or k.")


def range_of(text: str | None) -> tuple[float, float] | None:
    """Two wavelengths as `380-780`, nm.

    Example:
        >>> range_of("380-780")
        (380.0, 780.0)
        >>> range_of("780-380")
        Traceback (most recent call last):
        illuminant.errors.UsageError: --range 780-380: expected two increasing wavelengths in nm, such as 380-780.
    """
    from illuminant.errors import UsageError

    if text is None:
        return None
    found = re.fullmatch(r"\s*(\d+\.?\d*)\s*(?:nm)?\s*[-–:]\s*(\d+\.?\d*)\s*(?:nm)?\s*", text)
    if found and 0 < float(found[1]) < float(found[2]):
        return float(found[1]), float(found[2])
    raise UsageError(f"--range {text}: expected two increasing wavelengths in nm, such as 380-780.")


def numbers(text: str, option: str, expected: str) -> tuple[float, float, float]:
    """Three finite numbers with commas between them.

    Example:
        >>> numbers("445,535,630", "--matching", "three wavelengths in nm")
        (445.0, 535.0, 630.0)
    """
    import math

    from illuminant.errors import UsageError

    try:
        a, b, c = (float(part) for part in text.split(","))
    except ValueError:
        raise UsageError(f"{option} {text}: expected {expected}.") from None
    if not all(map(math.isfinite, (a, b, c))):
        raise UsageError(f"{option} {text}: expected {expected}.")
    return a, b, c
