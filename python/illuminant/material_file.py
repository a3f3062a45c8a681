"""The material file of the book: reflectance, n, k, and whether the material conducts (Hall 1989, III.7.1).

Lines are of five kinds: `#` comments; `n` and a number, the index of refraction; `k` and a number, the coefficient of
absorption; `conductor` or `dielectric`; and a wavelength in nm with a reflectance, in ascending order. The same form
serves for lamps, without the words. The book's reader wants whole wavelengths, takes what it does not know for data,
and fails on repeated wavelengths and on files without data; here the wavelengths may have fractions, and all that is
not as above is an error with its line.

Example:
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "glass.mtl"
    >>> _ = path.write_text("# Material: crown glass\\ndielectric\\nn 1.51124\\n399 0.043291\\n656 0.041134\\n")
    >>> glass = read_material(path)
    >>> glass.conductor, glass.n, glass.k, glass.curve.values
    (False, 1.51124, None, (0.043291, 0.041134))
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant import output
from illuminant.errors import DataError
from illuminant.spectrum import Quantity, Spectrum
from illuminant.spectrum_file import comment, no_word, number_text, read_table, rows_text, spectrum_of

if TYPE_CHECKING:
    import os

__all__ = ["MaterialFile", "read_material", "write_material"]


@dataclass(frozen=True, slots=True)
class MaterialFile:
    """What a material file says.

    Attributes:
        curve: its data, the reflectance of a material or the power of a lamp.
        n: index of refraction, or None.
        k: coefficient of absorption, or None.
        conductor: True, False (dielectric), or None when the file does not say.
        comments: the text of its comments, without the signs.
    """

    curve: Spectrum
    n: float | None = None
    k: float | None = None
    conductor: bool | None = None
    comments: tuple[str, ...] = ()


def read_material(path: str | os.PathLike[str], *, quantity: Quantity | None = None) -> MaterialFile:
    """A material file of the book.

    Args:
        path: the file; its name may end in anything.
        quantity: what its data are; None: as a `# quantity:` line says, else a reflectance where the file says n, k,
            conductor or dielectric, and else unknown.

    Raises:
        DataError: with file and line: as for `illuminant.spectra.read`; an unknown word; n or k without a number; a
            word twice, or conductor and dielectric both.
    """
    table = read_table(Path(path))
    if table.columns_line:
        raise DataError(no_word(table.first), table.file, table.columns_line)
    words = table.words
    conducts = True if "conductor" in words else False if "dielectric" in words else None
    curve = spectrum_of(table, quantity=quantity)
    return MaterialFile(curve, words.get("n"), words.get("k"), conducts, table.comments)


def write_material(path: str | os.PathLike[str], material: MaterialFile) -> None:
    """Write a material file that `read_material` reads: the same numbers and comments.

    Its rule outside, unit and provenance are not part of the form; what shall be kept of them is to stand in the
    comments. The book's own reader wants whole wavelengths.

    Raises:
        ImageError: the path cannot be written.
        MachineError: the disk is full or fails.

    Example:
        >>> import pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "copper.mtl"
        >>> curve = Spectrum("copper", [380, 700], [0.070, 0.755], quantity="reflectance")
        >>> write_material(path, MaterialFile(curve, 0.617, 2.630, True, ("Material: copper",)))
        >>> print(path.read_text(), end="")
        # Material: copper
        conductor
        n 0.617
        k 2.63
        380 0.07
        700 0.755
    """
    text = "".join(comment(line) for line in material.comments)
    if material.conductor is not None:
        text += "conductor\n" if material.conductor else "dielectric\n"
    for word, value in (("n", material.n), ("k", material.k)):
        if value is not None:
            text += f"{word} {number_text(float(value))}\n"
    output.write_bytes(path, (text + rows_text(material.curve, " ")).encode())
