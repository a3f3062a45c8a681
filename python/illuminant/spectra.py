"""The library of spectra, and spectra from files and from RGB.

A spectrum is a curve on wavelength (`illuminant.spectrum.Spectrum`): samples in nm, straight lines between them, and a
stated rule outside their range. The library ships illuminants of the CIE, ColorChecker patches, the test colour
samples of the CIE, n and k of metals, n of transparent media, the two material files of the book (III.7.1) and the
Cornell box; `docs/spectra.md` lists them with their sources. The tables are made by `tools/make_spectra.py` from
colour-science and the refractiveindex.info database.

Names: `D65`, `FL11`, `LED-B1`, `gold.n`, `BK7.n`, `ColorChecker/dark skin`, `ColorChecker Ohta/cyan`, `TCS/9`,
`book/copper`, `Cornell/white`. Upper and lower case are the same, and so are a blank and an underscore.

Files are read and written by `illuminant.spectrum_file` and `illuminant.material_file`, RGB becomes spectra in
`illuminant.rgb_spectra`; their names are here too.

Importing this module reads no data and no large package; `load` reads the index and the one file asked for.

Example:
    >>> from illuminant import spectra
    >>> d65 = spectra.load("D65")
    >>> d65.range_nm, d65.outside, d65.unit
    ((300.0, 780.0), 'zero', 'relative')
    >>> float(spectra.load("gold.k").at(548.6))
    2.455
    >>> (d65 * spectra.load("ColorChecker/red")).quantity
    'emission'
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from illuminant.errors import DataError
from illuminant.material_file import MaterialFile, read_material, write_material
from illuminant.rgb_spectra import FromRgb, RawRgb, rgb_albedo, rgb_emission, rgb_raw
from illuminant.spectrum import Extrapolation, Interpolation, Outside, Quantity, Spectrum, one_of
from illuminant.spectrum_file import (
    FORMATS,
    MAX_BYTES,
    Format,
    fold,
    quantity_of,
    read,
    read_table,
    text_of,
    write,
)

__all__ = [
    "FORMATS",
    "MAX_BYTES",
    "Entry",
    "Extrapolation",
    "Format",
    "FromRgb",
    "Interpolation",
    "MaterialFile",
    "Outside",
    "Quantity",
    "RawRgb",
    "Spectrum",
    "entries",
    "find",
    "header",
    "load",
    "names",
    "provenance",
    "read",
    "read_material",
    "rgb_albedo",
    "rgb_emission",
    "rgb_raw",
    "write",
    "write_material",
]

DATA = Path(__file__).resolve().parent / "data"


@dataclass(frozen=True, slots=True)
class Entry:
    """One name of the library.

    Attributes:
        name: as the documentation writes it.
        file: path of its table, relative to the data folder.
        column: its column there.
        quantity: "emission", "reflectance", "n" or "k".
        also: other names for it.
    """

    name: str
    file: str
    column: str
    quantity: Quantity
    also: tuple[str, ...] = ()


@functools.cache
def entries() -> tuple[Entry, ...]:
    """All of the library, in the order of its documentation; reads the index only.

    Example:
        >>> entries()[0]
        Entry(name='A', file='illuminants/a.csv', column='power', quantity='emission', also=())
    """
    lines = text_of(DATA / "library.csv").splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    return tuple(
        Entry(name, file, column, quantity_of(quantity), tuple(filter(None, also.split("|"))))
        for name, file, column, quantity, also in rows[1:]
    )


def names(quantity: Quantity | None = None) -> list[str]:
    """Names of the library, or those of one quantity.

    Args:
        quantity: "emission", "reflectance", "n" or "k"; None for all.

    Example:
        >>> names("k")
        ['silver.k', 'aluminium.k', 'gold.k', 'copper.k', 'iron.k', 'chromium.k']
    """
    return [entry.name for entry in entries() if quantity is None or entry.quantity == quantity]


def find(name: str) -> Entry:
    """The entry that a name means.

    Args:
        name: a name of the library; case does not matter, and blanks and underscores are the same.

    Raises:
        DataError: there is none; the message suggests near ones. Where a material has n but no k, it says so.

    Example:
        >>> find("colorchecker/DARK_SKIN").name
        'ColorChecker/dark skin'
        >>> find("Au.n").name
        'gold.n'
        >>> find("FL13")
        Traceback (most recent call last):
        illuminant.errors.DataError: no spectrum 'FL13' in the library; did you mean 'FL3', 'FL1' or 'FL3.13'?
    """
    known = _index()
    folded = fold(name)
    if folded in known:
        return known[folded]
    if folded.endswith(".k") and folded[:-2] + ".n" in known:
        entry = known[folded[:-2] + ".n"]
        reason = read_table(DATA / entry.file).header.get("k", "none")
        raise DataError(f"{entry.name[:-2]!r} has n but no k: {reason.removeprefix('none: ')}")
    if folded + ".n" in known:
        parts = [known[folded + end].name for end in (".n", ".k") if folded + end in known]
        raise DataError(f"{name!r} is a material, not one spectrum; ask for {one_of(parts)}")
    near = _near(folded)
    hint = f"did you mean {one_of(near)}?" if near else "illuminant.spectra.names() lists all of them"
    raise DataError(f"no spectrum {name!r} in the library; {hint}")


@functools.lru_cache(maxsize=256)
def load(name: str) -> Spectrum:
    """A spectrum of the library.

    Args:
        name: see `find`.

    Raises:
        DataError: see `find`.

    Example:
        >>> white = load("Cornell/white")
        >>> white.range_nm, white.quantity, white.values[0]
        ((400.0, 700.0), 'reflectance', 0.343)
    """
    entry = find(name)
    return read(DATA / entry.file, column=entry.column, quantity=entry.quantity, name=entry.name)


def header(name: str) -> dict[str, str]:
    """All header lines of the table behind a name: name, quantity, unit, source, provenance, licence, range,
    outside.

    Example:
        >>> header("book/copper")["n"]
        '0.617 at 589 nm (Jenkins and White 1976, table 25A)'
    """
    return dict(read_table(DATA / find(name).file).header)


def provenance(name: str) -> str:
    """Where a spectrum of the library comes from: the published source, and the package that carried it here.

    Example:
        >>> provenance("FL11").split(";")[0]
        'CIE 15:2004, Colorimetry, 3rd edition'
    """
    return load(name).provenance


@functools.cache
def _index() -> dict[str, Entry]:
    """Folded name, or other name, to entry."""
    return {fold(name): entry for entry in entries() for name in (entry.name, *entry.also)}


def _near(folded: str) -> list[str]:
    """Up to three names that a person may have meant."""
    import difflib

    known = _index()
    last_part = folded.rsplit("/", 1)[-1]
    near = [key for key in known if "/" in key and key.rsplit("/", 1)[1] == last_part]
    if not near:
        near = difflib.get_close_matches(folded, known, n=3, cutoff=0.65)
    if not near:
        ends = {key.rsplit("/", 1)[1]: key for key in reversed(known) if "/" in key}
        near = [ends[end] for end in difflib.get_close_matches(last_part, ends, n=3, cutoff=0.65)]
    return list(dict.fromkeys(known[key].name for key in near))[:3]
