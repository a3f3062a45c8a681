"""The library of spectra, and spectra from files.

A spectrum here is a curve on wavelength: samples in nm, straight lines between them, and a stated rule
outside their range. The library ships illuminants of the CIE, ColorChecker patches, n and k of metals, n of
transparent media, the two material files of the book (III.7.1) and the Cornell box; `docs/spectra.md` lists
them with their sources. The tables are made by `tools/make_spectra.py` from colour-science and the
refractiveindex.info database.

Names: `D65`, `FL11`, `LED-B1`, `gold.n`, `BK7.n`, `ColorChecker/dark skin`, `ColorChecker Ohta/cyan`,
`book/copper`, `Cornell/white`. Upper and lower case are the same, and so are a blank and an underscore.

Rules that hold everywhere:
    - outside its range the spectrum of a lamp is zero, and a reflectance, n or k holds its end value;
    - wavelengths increase, at least two of them, all numbers finite;
    - light and reflectance are never negative, and a reflectance is at most 1. n and k may have any sign
      (a medium with gain has k below 0): what a material accepts is decided where it is used;
    - nothing is clamped, sorted or resampled.

Importing this module reads no data and no large package; `load` reads the index and the one file asked for.

Example:
    >>> from illuminant import spectra
    >>> d65 = spectra.load("D65")
    >>> d65.range_nm, d65.outside, d65.unit
    ((300.0, 780.0), 'zero', 'relative')
    >>> float(spectra.load("gold.k").at(548.6))
    2.455
"""

from __future__ import annotations

import functools
import math
import operator
import re
import stat
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from illuminant.errors import DataError

if TYPE_CHECKING:
    import os

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "MAX_BYTES",
    "Entry",
    "Outside",
    "Quantity",
    "Spectrum",
    "entries",
    "find",
    "header",
    "load",
    "names",
    "provenance",
    "read",
]

Outside = Literal["zero", "hold", "error"]
Quantity = Literal["", "emission", "reflectance", "n", "k"]

MAX_BYTES = 10_000_000
"""The largest spectrum file that `read` accepts."""

DATA = Path(__file__).resolve().parent / "data"
QUANTITIES = ("", "emission", "reflectance", "n", "k")
OUTSIDE = ("zero", "hold", "error")


@dataclass(frozen=True, slots=True)
class Spectrum:
    """A curve on wavelength, linear between its samples.

    Args:
        name: what messages call it.
        wavelengths_nm: at least two, increasing, above zero; any sequence or array of numbers.
        values: as many; in `unit`.
        outside: value outside the range: "zero", "hold" (that of the nearest end) or "error".
        unit: "1" (reflectance, n, k), "relative" (power known but for a factor), or a unit such as
            "W sr-1 m-2 nm-1" (absolute).
        provenance: where it comes from, in one line.
        quantity: "emission", "reflectance", "n", "k", or "" when unknown.

    Raises:
        DataError: the samples break a rule of this module; the message names the wavelength.

    Example:
        >>> Spectrum("ramp", [400, 700], [0.0, 0.6], "hold").at([390, 500, 710]).round(9).tolist()
        [0.0, 0.2, 0.6]
    """

    name: str
    wavelengths_nm: tuple[float, ...]
    values: tuple[float, ...]
    outside: Outside = "hold"
    unit: str = "1"
    provenance: str = ""
    quantity: Quantity = ""

    def __post_init__(self) -> None:
        """Turn the samples into tuples of float and check them."""
        subject = f"spectrum {self.name!r}: " if self.name else "spectrum: "
        for key in ("wavelengths_nm", "values"):
            object.__setattr__(self, key, _floats(getattr(self, key), subject + key))
        if len(self.wavelengths_nm) != len(self.values):
            counts = f"{len(self.wavelengths_nm)} wavelengths and {len(self.values)} values"
            raise DataError(f"{subject}{counts}; expected as many of one as of the other")
        if self.outside not in OUTSIDE:
            raise DataError(f"{subject}outside is {self.outside!r}; expected {_one_of(OUTSIDE)}")
        if self.quantity not in QUANTITIES:
            raise DataError(f"{subject}quantity is {self.quantity!r}; expected {_one_of(QUANTITIES[1:])}")
        mistake = _mistake(self.wavelengths_nm, self.values, self.quantity)
        if mistake:
            raise DataError(subject + mistake[1])

    @property
    def range_nm(self) -> tuple[float, float]:
        """First and last wavelength, nm."""
        return self.wavelengths_nm[0], self.wavelengths_nm[-1]

    def at(self, wavelengths_nm: ArrayLike) -> NDArray[np.float64]:
        """The curve at any wavelengths.

        Args:
            wavelengths_nm: array of any shape, nm.

        Returns:
            Array of that shape, in `unit`.

        Raises:
            DataError: a wavelength is outside the range and `outside` is "error".

        Example:
            >>> load("D65").at([560, 900]).tolist()
            [100.0, 0.0]
        """
        import numpy as np

        wanted = np.asarray(wavelengths_nm, dtype=np.float64)
        first, last = self.range_nm
        if self.outside == "error" and not np.all((wanted >= first) & (wanted <= last)):
            raise DataError(f"spectrum {self.name!r} is known from {first:g} to {last:g} nm only")
        end = 0.0 if self.outside == "zero" else None
        return np.asarray(np.interp(wanted, self.wavelengths_nm, self.values, left=end, right=end))


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


# --- the library --------------------------------------------------------------------------------------------


@functools.cache
def entries() -> tuple[Entry, ...]:
    """All of the library, in the order of its documentation; reads the index only.

    Example:
        >>> entries()[0]
        Entry(name='A', file='illuminants/a.csv', column='power', quantity='emission', also=())
    """
    lines = _text(DATA / "library.csv").splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    return tuple(
        Entry(name, file, column, _quantity(quantity), tuple(filter(None, also.split("|"))))
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
    folded = _fold(name)
    if folded in known:
        return known[folded]
    if folded.endswith(".k") and folded[:-2] + ".n" in known:
        entry = known[folded[:-2] + ".n"]
        reason = _table(DATA / entry.file).header.get("k", "none")
        raise DataError(f"{entry.name[:-2]!r} has n but no k: {reason.removeprefix('none: ')}")
    if folded + ".n" in known:
        parts = [known[folded + end].name for end in (".n", ".k") if folded + end in known]
        raise DataError(f"{name!r} is a material, not one spectrum; ask for {_one_of(parts)}")
    near = _near(folded)
    hint = f"did you mean {_one_of(near)}?" if near else "illuminant.spectra.names() lists all of them"
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
    return dict(_table(DATA / find(name).file).header)


def provenance(name: str) -> str:
    """Where a spectrum of the library comes from: the published source, and the package that carried it here.

    Example:
        >>> provenance("FL11").split(";")[0]
        'CIE 15:2004, Colorimetry, 3rd edition'
    """
    return load(name).provenance


def _fold(name: str) -> str:
    """The form in which names are compared: `White 9.5 (.05 D)` and `white_9.5` are one."""
    without_density = re.sub(r"\s*\([^()]*\)\s*$", "", name)
    return " ".join(without_density.replace("_", " ").casefold().split())


@functools.cache
def _index() -> dict[str, Entry]:
    """Folded name, or other name, to entry."""
    return {_fold(name): entry for entry in entries() for name in (entry.name, *entry.also)}


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


def _quantity(text: str) -> Quantity:
    """One of the quantities; anything else is unknown."""
    match text:
        case "emission" | "reflectance" | "n" | "k":
            return text
    return ""


# --- files --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Table:
    """A file of numbers: its `# key: value` lines, the names of its columns, and each row with its line."""

    file: str
    header: dict[str, str]
    header_lines: dict[str, int]
    columns: tuple[str, ...]
    rows: tuple[tuple[float, ...], ...]
    lines: tuple[int, ...]


def read(
    path: str | os.PathLike[str],
    *,
    column: str | None = None,
    quantity: Quantity | None = None,
    outside: Outside | None = None,
    name: str | None = None,
) -> Spectrum:
    """A spectrum from a text file: CSV, or two columns of an SPD file.

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
            reflectance above 1, wavelengths in micrometres, several columns and no `column`.

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
    table = _table(Path(path))
    index = _column(table, column)
    said = quantity if quantity is not None else _quantity(table.header.get("quantity", "").casefold())
    stated = outside or table.header.get("outside", "").casefold()
    rule = stated or ("zero" if said == "emission" else "hold")
    if rule not in OUTSIDE:
        line = 0 if outside else table.header_lines["outside"]
        raise DataError(f"outside is {rule!r}; expected {_one_of(OUTSIDE)}", table.file, line)
    wavelengths = tuple(row[0] for row in table.rows)
    values = tuple(row[index] for row in table.rows)
    mistake = _mistake(wavelengths, values, said)
    if mistake:
        raise DataError(mistake[1], table.file, table.lines[mistake[0]] if table.lines else 0)
    origin = "; ".join(table.header[key] for key in ("source", "provenance") if key in table.header)
    return Spectrum(
        name=name or table.header.get("name") or Path(path).stem,
        wavelengths_nm=wavelengths,
        values=values,
        outside=rule,  # type: ignore[arg-type]
        unit=table.header.get("unit") or ("relative" if said == "emission" else "1"),
        provenance=origin or str(path),
        quantity=said,
    )


def _column(table: _Table, column: str | None) -> int:
    """Number of the column of values."""
    choices = table.columns[1:]
    if column is not None:
        folded = [_fold(choice) for choice in choices]
        if _fold(column) not in folded:
            known = _one_of(choices) if choices else "a file whose first line names its columns"
            raise DataError(f"no column {column!r}; expected {known}", table.file)
        return 1 + folded.index(_fold(column))
    width = len(table.rows[0]) if table.rows else 2
    if width > 2:
        known = f" ({', '.join(choices)})" if choices else ""
        message = f"{width} columns{known}; expected two, a wavelength and a value, or a choice of column"
        raise DataError(message, table.file, table.lines[0])
    return 1


def _table(path: Path) -> _Table:
    """Read a file into numbers; all that can be wrong with a row by itself is found here."""
    file = str(path)
    header: dict[str, str] = {}
    header_lines: dict[str, int] = {}
    columns: tuple[str, ...] = ()
    rows: list[tuple[float, ...]] = []
    lines: list[int] = []
    for number, line in enumerate(re.split(r"\r\n|\r|\n", _text(path)), start=1):
        content, _, comment = line.partition("#")
        if content.lstrip().startswith(";"):
            content, comment = "", content.lstrip()[1:]
        if not content.strip():
            key, colon, value = comment.partition(":")
            if colon:
                header.setdefault(key.strip().casefold(), value.strip())
                header_lines.setdefault(key.strip().casefold(), number)
            continue
        fields = _fields(content)
        numbers = [_number(text) for text in fields]
        # Other names may be numbers, as of patches; but a row whose wavelength is mistyped is no header.
        if not lines and not columns and numbers[0] is None and fields[0][:1] not in "0123456789+-.":
            columns = tuple(fields)
            continue
        bad = next((i for i, value in enumerate(numbers) if value is None), None)
        if bad is not None:
            raise DataError(f"{_expected(bad)}, found {_shown(fields[bad])}{_hint(fields)}", file, number)
        width = len(rows[0]) if rows else max(2, len(columns) if "," in content else 2)
        if len(fields) < 2 or (rows and len(fields) != width) or (columns and len(fields) < width):
            message = f"{len(fields)} {'number' if len(fields) == 1 else 'numbers'}; expected {width}"
            raise DataError(message + (" (a wavelength and a value)" if width == 2 else ""), file, number)
        rows.append(tuple(value for value in numbers if value is not None))
        lines.append(number)
    if columns and rows and len(columns) != len(rows[0]):
        columns = ()  # words with blanks in them, as in "Wavelength (nm)   Power": they name nothing
    return _Table(file, header, header_lines, columns, tuple(rows), tuple(lines))


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


def _text(path: Path) -> str:
    """The text of a file of at most `MAX_BYTES`."""
    file = str(path)
    try:
        mode = path.stat().st_mode
        # Opening a pipe or a device could wait for ever.
        if stat.S_ISREG(mode):
            with path.open("rb") as stream:
                data = stream.read(MAX_BYTES + 1)
        else:
            data = None
    except FileNotFoundError:
        raise DataError("no such file", file) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DataError(f"cannot be read: {reason[:1].lower()}{reason[1:]}", file) from None
    if data is None:
        kind = "a folder" if stat.S_ISDIR(mode) else "not a regular file"
        raise DataError(f"is {kind}; expected a spectrum file", file)
    if len(data) > MAX_BYTES:
        raise DataError(f"is larger than {MAX_BYTES // 1_000_000} MB; expected a spectrum as text", file)
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise DataError("is text in UTF-16; expected UTF-8", file)
    if re.search(rb"[\x00-\x08\x0e-\x1f]", data):
        raise DataError("is a binary file; expected text with a wavelength and a value on each line", file)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Instruments write degree signs in old encodings; they stand in comments, and numbers are ASCII.
        return data.decode("latin-1")


# --- rules --------------------------------------------------------------------------------------------------


def _floats(values: Iterable[float], subject: str) -> tuple[float, ...]:
    """Any one-dimensional sequence of numbers as a tuple of float."""
    if type(values) is tuple and set(map(type, values)) == {float}:
        return values
    tolist = getattr(values, "tolist", None)
    try:
        return tuple(float(value) for value in (tolist() if tolist else values))
    except (TypeError, ValueError):
        raise DataError(f"{subject} is not a list of numbers") from None


def _fine(wavelengths: tuple[float, ...], values: tuple[float, ...], quantity: str) -> bool:
    """Whether samples keep all rules, told at once; `_mistake` walks through the others to find which is broken."""
    return (
        len(wavelengths) > 1
        and wavelengths[0] > 0
        and 20 <= wavelengths[-1] < math.inf
        and all(map(operator.lt, wavelengths, wavelengths[1:]))
        and all(map(math.isfinite, values))
        and (min(values) >= 0 or quantity in ("n", "k"))
        and (max(values) <= 1 or quantity != "reflectance")
    )


def _mistake(
    wavelengths: tuple[float, ...], values: tuple[float, ...], quantity: str
) -> tuple[int, str] | None:
    """The first sample that breaks a rule of this module, and a sentence about it; None when all is well."""
    if _fine(wavelengths, values, quantity):
        return None
    if not wavelengths:
        return 0, "no data; expected at least two lines with a wavelength and a value"
    before = 0.0
    for i, (wavelength, value) in enumerate(zip(wavelengths, values, strict=True)):
        if not math.isfinite(wavelength):
            return i, f"wavelength {wavelength:g}; expected a finite number of nm"
        if wavelength <= 0:
            return i, f"wavelength {wavelength:g} nm; expected one above zero"
        if i and wavelength == before:
            return i, f"wavelength {wavelength:g} nm twice; expected increasing wavelengths"
        if i and wavelength < before:
            return (
                i,
                f"wavelength {wavelength:g} nm comes after {before:g} nm; expected increasing wavelengths",
            )
        if not math.isfinite(value):
            return i, f"value {value:g} at {wavelength:g} nm; expected a finite number"
        if value < 0 and quantity not in ("n", "k"):
            kind = quantity or "spectrum (other than of n or k)"
            return i, f"value {value:g} at {wavelength:g} nm; expected {_article(kind)} that is not negative"
        if value > 1 and quantity == "reflectance":
            hint = "; are these percent?" if value > 2 else ""
            return i, f"value {value:g} at {wavelength:g} nm; expected a reflectance from 0 to 1{hint}"
        before = wavelength
    if len(wavelengths) == 1:
        return 0, "only one point; expected at least two"
    if wavelengths[-1] < 20:
        ends = f"{wavelengths[0]:g} to {wavelengths[-1]:g}"
        return 0, f"wavelengths from {ends} look like micrometres; expected nm"
    return None


def _article(noun: str) -> str:
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def _one_of(choices: Iterable[str]) -> str:
    """`'a', 'b' or 'c'`."""
    quoted = [repr(choice) for choice in choices]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
