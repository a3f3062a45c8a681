"""What a word means where a spectrum is asked for, and the options that several verbs share.

The words are those of `illuminant.spectrum_word`.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.spectrum_word import equation, is_file

if TYPE_CHECKING:
    from illuminant.spectra import MaterialFile, Quantity, Spectrum

__all__ = [
    "Column",
    "FileQuantity",
    "check_file_options",
    "is_file",
    "load",
    "material_of",
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

    lamp = equation(word)
    if lamp is not None:
        return lamp
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

    if equation(word) is not None or not is_file(word):
        return None
    try:
        found = spectra.read_material(Path(word).expanduser(), quantity="")
    except DataError:
        return None
    return found if (found.n, found.k, found.conductor) != (None, None, None) else None


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
