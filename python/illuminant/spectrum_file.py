"""Spectra in text files: reading and writing.

Three forms:
    - CSV: a wavelength in nm and a value on each line, with a comma, tabs or blanks between, or several columns;
    - SPD: two columns, as spectroradiometers and renderers write them;
    - the material file of the book (Hall 1989, III.7.1), whose further lines `illuminant.material_file` heeds.

Reading tells them apart by what is in them, writing by the name of the file. A file that breaks a rule of
`illuminant.spectrum` is refused with its name, the line and what was expected.

Example:
    >>> import pathlib, tempfile
    >>> from illuminant import spectra
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "d65.csv"
    >>> spectra.write(path, spectra.load("D65"))
    >>> spectra.read(path) == spectra.load("D65")
    True
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from illuminant import output, sources
from illuminant.errors import DataError, UsageError
from illuminant.sources import SourceError
from illuminant.spectrum import OUTSIDE, Outside, Quantity, Spectrum, mistake_in, one_of

if TYPE_CHECKING:
    import os

__all__ = [
    "FORMATS",
    "MAX_BYTES",
    "Format",
    "Table",
    "comment",
    "fold",
    "no_word",
    "number_text",
    "quantity_of",
    "read",
    "read_table",
    "rows_text",
    "spectrum_of",
    "text_of",
    "write",
]

MAX_BYTES = 10_000_000
"""The largest spectrum file that `read` accepts."""

Format = Literal["csv", "spd", "material"]
FORMATS = {"csv": (".csv",), "spd": (".spd", ".txt", ".dat"), "material": (".mtl", ".mat", ".material")}
"""The forms of a spectrum file, and the ends of names that choose them."""


@dataclass(frozen=True, slots=True)
class Table:
    """A file of numbers.

    Attributes:
        file: its path.
        header: its `# key: value` lines, and `header_lines` where they stand.
        columns: the names of its columns, if it gives any; `columns_line` where they stand or 0, `first` the first.
        rows: the numbers, and `lines` where they stand.
        words: the lines of a material file: n and k with their number, conductor or dielectric with 1.
        comments: the text of every line that is a comment.
    """

    file: str
    header: dict[str, str]
    header_lines: dict[str, int]
    columns: tuple[str, ...]
    columns_line: int
    first: str
    rows: tuple[tuple[float, ...], ...]
    lines: tuple[int, ...]
    words: dict[str, float]
    comments: tuple[str, ...]


def read(
    path: str | os.PathLike[str],
    *,
    column: str | None = None,
    quantity: Quantity | None = None,
    outside: Outside | None = None,
    name: str | None = None,
) -> Spectrum:
    """A spectrum from a text file: CSV, the two columns of an SPD file, or a material file of the book.

    Each line holds a wavelength in nm and a value, with a comma, tabs or blanks between. Lines that begin
    with `#` or `;` are comments, and so is what follows a `#`; comments of the form `# key: value` with the
    keys name, quantity, unit, source, provenance and outside are heeded. The first line of data may hold
    names of columns.

    Args:
        path: a file of at most `MAX_BYTES` bytes of text.
        column: name of the column of values, where there are more than one.
        quantity: "emission", "reflectance", "n" or "k"; decides which values are refused and what holds
            outside the range. None: as the header says, else unknown.
        outside: None: as the header says, else zero for emission and hold for all others.
        name: None: as the header says, else the name of the file.

    Raises:
        DataError: with file and line: cannot be read, too large, not text, empty, one point, a row that is
            not numbers, out of order, a repeated wavelength, not finite, negative (n and k excepted), a
            reflectance above 1, wavelengths in micrometres, several columns and no `column`; in a material
            file an unknown word, n or k without a number, or a word twice.

    Example:
        >>> import pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "lamp.spd"
        >>> _ = path.write_text("; my lamp\\n400 0.5\\n500 1.0\\n450 0.7\\n")
        >>> try:
        ...     read(path)
        ... except DataError as error:
        ...     print(error.line, error.message)
        4 wavelength 450 nm comes after 500 nm; expected increasing wavelengths
    """
    table = read_table(Path(path))
    return spectrum_of(table, column=column, quantity=quantity, outside=outside, name=name)


def spectrum_of(
    table: Table,
    *,
    column: str | None = None,
    quantity: Quantity | None = None,
    outside: Outside | None = None,
    name: str | None = None,
) -> Spectrum:
    """The spectrum of a file that was read; arguments as for `read`."""
    index = _column(table, column)
    said = quantity if quantity is not None else quantity_of(table.header.get("quantity", "").casefold())
    if not said and quantity is None and table.words:
        said = "reflectance"  # only materials have an index or conduct
    stated = outside or table.header.get("outside", "").casefold()
    rule = stated or ("zero" if said == "emission" else "hold")
    if rule not in OUTSIDE:
        line = 0 if outside else table.header_lines["outside"]
        raise DataError(f"outside is {rule!r}; expected {one_of(OUTSIDE)}", table.file, line)
    wavelengths = tuple(row[0] for row in table.rows)
    values = tuple(row[index] for row in table.rows)
    mistake = mistake_in(wavelengths, values, said)
    if mistake:
        raise DataError(mistake[1], table.file, table.lines[mistake[0]] if table.lines else 0)
    origin = "; ".join(filter(None, map(table.header.get, ("source", "provenance"))))
    return Spectrum(
        name=name or next(filter(None, map(table.header.get, NAME_KEYS)), Path(table.file).stem),
        wavelengths_nm=wavelengths,
        values=values,
        outside=rule,  # type: ignore[arg-type]
        unit=table.header.get("unit") or ("relative" if said == "emission" else "1"),
        provenance=origin or table.file,
        quantity=said,
    )


NAME_KEYS = ("name", "material", "light source")
"""The header lines that may name a spectrum; the latter two are the book's."""


def write(
    path: str | os.PathLike[str],
    spectrum: Spectrum,
    format: Format | None = None,  # noqa: A002 - the word that the whole field uses
) -> None:
    """Write a spectrum to a file that `read` reads: the same samples, to the last bit.

    Name, quantity, unit, provenance and rule outside go into comments of the form `# key: value`.

    Args:
        path: the file; replaced as a whole or not at all.
        spectrum: what to write.
        format: "csv", "spd" (two columns), or "material" (the book's form, without n and k; see
            `write_material`); None: by the end of the name, .csv, .spd, .txt, .dat, .mtl, .mat or .material.

    Raises:
        UsageError: no such format, or the end of the name means none.
        ImageError: the path cannot be written.
        MachineError: the disk is full or fails.

    Example:
        >>> import pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "ramp.spd"
        >>> write(path, Spectrum("ramp", [400, 700.5], [0.0, 0.6], "hold"))
        >>> print(path.read_text(), end="")
        # name: ramp
        # unit: 1
        # outside: hold
        400 0.0
        700.5 0.6
    """
    path = Path(path)
    fitting = [form for form, ends in FORMATS.items() if path.suffix.casefold() in ends]
    chosen = format or "".join(fitting)
    if chosen not in FORMATS:
        what = f"no format {format!r}" if format else f"no format for {path.name!r}"
        raise UsageError(f"There is {what}: expected one of {', '.join(FORMATS)}.")
    said = {
        "name": spectrum.name,
        "quantity": spectrum.quantity,
        "unit": spectrum.unit,
        "provenance": spectrum.provenance,
        "outside": spectrum.outside,
    }
    text = "".join(comment(f"{key}: {value}") for key, value in said.items() if value)
    if chosen == "csv":
        text += f"wavelength_nm,{spectrum.quantity or 'value'}\n"
    output.write_bytes(path, (text + rows_text(spectrum, "," if chosen == "csv" else " ")).encode())


def rows_text(spectrum: Spectrum, separator: str) -> str:
    """The samples, one on each line."""
    rows = zip(spectrum.wavelengths_nm, spectrum.values, strict=True)
    return "".join(f"{number_text(nm)}{separator}{value!r}\n" for nm, value in rows)


def comment(text: str) -> str:
    """A line of comment; what would break the line or the file becomes a blank.

    Example:
        >>> comment("name: a\\nb")
        '# name: a b\\n'
    """
    return f"# {''.join(c if c.isprintable() else ' ' for c in text)}".rstrip() + "\n"


def number_text(value: float) -> str:
    """A number that reads back exactly, whole ones without a point.

    Example:
        >>> number_text(400.0), number_text(400.5)
        ('400', '400.5')
    """
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def _column(table: Table, column: str | None) -> int:
    """Number of the column of values."""
    choices = table.columns[1:]
    if column is not None:
        folded = [fold(choice) for choice in choices]
        if fold(column) not in folded:
            known = one_of(choices) if choices else "a file whose first line names its columns"
            raise DataError(f"no column {column!r}; expected {known}", table.file)
        return 1 + folded.index(fold(column))
    width = len(table.rows[0]) if table.rows else 2
    if width > 2:
        known = f" ({', '.join(choices)})" if choices else ""
        message = f"{width} columns{known}; expected two, a wavelength and a value, or a choice of column"
        raise DataError(message, table.file, table.lines[0])
    return 1


def read_table(path: Path) -> Table:
    """Read a file into numbers; all that can be wrong with a row by itself is found here."""
    file = str(path)
    header: dict[str, str] = {}
    header_lines: dict[str, int] = {}
    columns: tuple[str, ...] = ()
    columns_line, first = 0, ""
    words: dict[str, float] = {}
    word_lines: dict[str, int] = {}
    comments: list[str] = []
    rows: list[tuple[float, ...]] = []
    lines: list[int] = []
    for number, line in enumerate(re.split(r"\r\n|\r|\n", text_of(path)), start=1):
        content, _, remark = line.partition("#")
        if content.lstrip().startswith(";"):
            content, remark = "", content.lstrip()[1:]
        if not content.strip():
            if line.strip():
                comments.append(remark.removeprefix(" ").rstrip())
            key, colon, value = remark.partition(":")
            if colon:
                header.setdefault(key.strip().casefold(), value.strip())
                header_lines.setdefault(key.strip().casefold(), number)
            continue
        if _word(content, number, file, words, word_lines):
            continue
        fields = _fields(content)
        numbers = [_number(text) for text in fields]
        # Other names may be numbers, as of patches; but a row whose wavelength is mistyped is no header.
        if not lines and not columns and numbers[0] is None and fields[0][:1] not in "0123456789+-.":
            columns, columns_line, first = tuple(fields), number, fields[0]
            continue
        bad = next((i for i, value in enumerate(numbers) if value is None), None)
        if bad is not None:
            if words and bad == 0:
                raise DataError(no_word(fields[0]), file, number)
            raise DataError(f"{_expected(bad)}, found {_shown(fields[bad])}{_hint(fields)}", file, number)
        width = len(rows[0]) if rows else max(2, len(columns) if "," in content else 2)
        if len(fields) < 2 or (rows and len(fields) != width) or (columns and len(fields) < width):
            message = f"{len(fields)} {'number' if len(fields) == 1 else 'numbers'}; expected {width}"
            raise DataError(message + (" (a wavelength and a value)" if width == 2 else ""), file, number)
        rows.append(tuple(value for value in numbers if value is not None))
        lines.append(number)
    if words and columns:
        raise DataError(no_word(first), file, columns_line)
    if columns and rows and len(columns) != len(rows[0]):
        columns = ()  # words with blanks in them, as in "Wavelength (nm)   Power": they name nothing
    return Table(
        file,
        header,
        header_lines,
        columns,
        columns_line,
        first,
        tuple(rows),
        tuple(lines),
        words,
        tuple(comments),
    )


WORD = re.compile(r"\s*(?:(n|k)(?:\s+(\S+))?|(conductor|dielectric))\s*")
"""A line of a material file that is no data: an index, or the kind of the material."""


def _word(content: str, line: int, file: str, words: dict[str, float], lines: dict[str, int]) -> bool:
    """Take in a line of a material file that is no data; False when it is none."""
    match = WORD.fullmatch(content)
    if not match or "," in content:
        return False
    name, text, kind = match.groups()
    value = 1.0 if kind else _number(text or "")
    if value is None or not -1e9 < value < 1e9:
        raise DataError(f"expected a number after {name!r}, found {_shown(text or '')}", file, line)
    word = kind or name
    other = {"conductor": "dielectric", "dielectric": "conductor"}.get(word, "")
    for earlier in (word, other):
        if earlier in words:
            message = f"{word!r} after {earlier!r} in line {lines[earlier]}; expected one of them once"
            raise DataError(message, file, line)
    words[word], lines[word] = value, line
    return True


def no_word(text: str) -> str:
    """The sentence about a word that a material file does not have."""
    expected = "'n', 'k', 'conductor', 'dielectric', or a wavelength and a value"
    return f"{_shown(text)} means nothing in a material file; expected {expected}"


def _fields(content: str) -> list[str]:
    """The fields of a line: at commas where there are any, else at blanks and tabs."""
    parts = content.split(",") if "," in content else content.split()
    return [part.strip().strip('"').strip() for part in parts]


def _number(text: str) -> float | None:
    """A number as files write it, or None; `1_000` is Python's alone and is no number here."""
    if "_" in text:
        return None
    try:
        return float(text)
    except ValueError:
        return None


def _expected(column: int) -> str:
    return "expected a wavelength in nm" if column == 0 else f"expected a number in column {column + 1}"


def _shown(text: str) -> str:
    if not text:
        return "nothing"
    return repr(text if len(text) <= 40 else text[:37] + "...")


def _hint(fields: list[str]) -> str:
    return " (separate numbers by a comma, a tab or blanks)" if any(";" in text for text in fields) else ""


def text_of(path: Path) -> str:
    """The text of a file of at most `MAX_BYTES`."""
    file = str(path)
    try:
        data = sources.read(path, MAX_BYTES)
    except SourceError as error:
        wanted = {"folder": "; expected a spectrum file", "large": "; expected a spectrum as text"}
        raise DataError(error.message + wanted.get(error.kind, ""), file) from None
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise DataError("is text in UTF-16; expected UTF-8", file)
    if re.search(rb"[\x00-\x08\x0e-\x1f]", data):
        raise DataError("is a binary file; expected text with a wavelength and a value on each line", file)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Instruments write degree signs in old encodings; they stand in comments, and numbers are ASCII.
        return data.decode("latin-1")


def fold(name: str) -> str:
    """The form in which names are compared: `White 9.5 (.05 D)` and `white_9.5` are one."""
    without_density = re.sub(r"\s*\([^()]*\)\s*$", "", name)
    return " ".join(without_density.replace("_", " ").casefold().split())


def quantity_of(text: str) -> Quantity:
    """One of the quantities; anything else is unknown."""
    match text:
        case "emission" | "reflectance" | "n" | "k":
            return text
    return ""
