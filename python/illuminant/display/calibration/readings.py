"""Readings: which code values a screen showed, and what an instrument read; as a table in a CSV file.

    # bits: 8
    # monitor: studio 2
    r,g,b,X,Y,Z
    0,0,0,0.21,0.22,0.25
    255,255,255,98.4,103.1,112.0

The first line that is no comment names the columns: r, g, b, and either X, Y, Z in cd/m² or x, y, Y with Y in cd/m².
With `# bits: n` code values are whole numbers from 0 to 2^n - 1, without it fractions from 0 to 1. Other comments
`# key: value` are kept. A row whose three readings are all empty has not been read, and is left out; a row of which
only some are empty is a mistake. Blanks around a number, blank lines, and a byte-order mark are allowed; so are
semicolons between numbers, as spreadsheets write them where the comma is the decimal sign (0,21 is then 0.21).

Errors: `DataError` with the file and line, and what was expected; it is never a half-read table.

Example:
    >>> import numpy as np
    >>> table = Readings(np.array([[0, 0, 0], [1, 1, 1]]), np.array([[0, 0, 0], [95.0, 100.0, 109.0]]))
    >>> parse(table.text(bits=8)).xyz.tolist()
    [[0.0, 0.0, 0.0], [95.0, 100.0, 109.0]]
"""

from __future__ import annotations

import math
import os
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from illuminant import output
from illuminant.display.table_text import text_of
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Readings", "parse", "plan", "read", "table", "typed"]

LARGEST = 1e5
"""cd/m² that no display gives: a larger reading is a slip."""

_XYZ, _XYY = ["r", "g", "b", "X", "Y", "Z"], ["r", "g", "b", "x", "y", "Y"]


@dataclass(frozen=True)
class Readings:
    """A table of readings.

    Attributes:
        codes: (n, 3) code values, 0 to 1.
        xyz: (n, 3) cd/m².
        about: comments of the file, by key.
        unread: (m, 3) code values of rows without a reading.
        file: where they came from, for messages; may be "".
        bits: of the code values in the file they came from; 8 without one.
    """

    codes: Array
    xyz: Array
    about: dict[str, str] = field(default_factory=dict)
    unread: Array | None = None
    file: str = ""
    bits: int = 8

    def __post_init__(self) -> None:
        """Refuse arrays that are no readings."""
        import numpy as np

        for name in ("codes", "xyz"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), np.float64))
        if self.codes.shape != self.xyz.shape or self.codes.ndim != 2 or self.codes.shape[1] != 3:
            raise UsageError(
                f"Readings are code values and XYZ of one shape (n, 3), not {self.codes.shape} and {self.xyz.shape}."
            )
        if not (np.isfinite(self.codes).all() and np.isfinite(self.xyz).all()):
            raise UsageError("Readings are finite numbers, and one of these is not.")
        if ((self.codes < 0) | (self.codes > 1)).any() or (self.xyz < 0).any():
            raise UsageError("Readings have code values from 0 to 1, and XYZ from 0 up.")

    def greys(self) -> Readings:
        """Those of equal code values in all three channels, by rising code value."""
        import numpy as np

        same = (np.abs(self.codes - self.codes[:, :1]) < 1e-9).all(axis=1)
        order = np.argsort(self.codes[same, 0], kind="stable")
        return Readings(self.codes[same][order], self.xyz[same][order], self.about, None, self.file)

    def text(self, *, bits: int = 8) -> str:
        """The table as a CSV file, with the rows that have no reading at its end."""
        whole = table(self.codes, self.xyz, self.about, bits=bits)
        if self.unread is None or not len(self.unread):
            return whole
        return whole + table(self.unread, None, bits=bits).split("\n", 2)[2]

    def save(self, path: str | os.PathLike[str], *, bits: int = 8) -> None:
        """Save as a CSV file, atomically."""
        output.write_bytes(path, self.text(bits=bits).encode())


def table(codes: Array, xyz: Array | None, about: dict[str, str] | None = None, *, bits: int = 8) -> str:
    """A table as text; without readings, with empty places to be filled in."""
    import numpy as np

    most = 2**bits - 1
    lines = [f"# bits: {bits}"]
    lines += [f"# {key}: {value}" for key, value in (about or {}).items() if key != "bits"]
    lines.append(",".join(_XYZ))
    for index, code in enumerate(np.round(np.asarray(codes) * most).astype(int).tolist()):
        reading = [f"{value:.5g}" for value in xyz[index].tolist()] if xyz is not None else ["", "", ""]
        lines.append(",".join([*map(str, code), *reading]))
    return "\n".join(lines) + "\n"


def plan(*, bits: int = 8, levels: int = 11, channels: int = 7) -> Array:
    """Code values (n, 3) to be measured: black, greys, each channel, and white again at the end.

    The last white tells how far the monitor drifted meanwhile. All are exact codes of n bits.

    Args:
        bits: of a code.
        levels: greys, with black and white.
        channels: levels of each channel, without black.

    Raises:
        UsageError: fewer levels than a fit needs.

    Example:
        >>> plan().shape, (plan()[-1] * 255).tolist()
        ((33, 3), [255.0, 255.0, 255.0])
    """
    import numpy as np

    if levels < 3 or channels < 3:
        raise UsageError(f"A fit needs 3 levels of grey and of each channel, not {levels} and {channels}.")
    most = 2**bits - 1
    greys = np.repeat(np.round(np.linspace(0.0, 1.0, levels) * most)[:, None], 3, axis=1)
    some = np.round(np.linspace(0.0, 1.0, channels + 1)[1:] * most)
    single = [np.outer(some, np.eye(3)[k]) for k in range(3)]
    return np.asarray(np.concatenate([greys, *single, greys[-1:]]) / most, np.float64)


def read(path: str | os.PathLike[str], *, empty: bool = False) -> Readings:
    """Read a table.

    Args:
        path: of the CSV file.
        empty: whether a table without any reading is accepted, for its code values.

    Raises:
        DataError: the file cannot be read, or a line is wrong; file and line are named.
    """
    return parse(text_of(path, "The readings"), os.fspath(path), empty=empty)


def typed(words: str, units: str) -> list[float]:
    """XYZ of a reading as a person types it: three numbers with blanks, commas or semicolons between.

    Args:
        words: what was typed.
        units: "xyY" or "XYZ".

    Raises:
        UsageError: it is no reading.

    Example:
        >>> typed("0.25 0.5 100", "xyY")
        [50.0, 100.0, 50.0]
    """
    cells = [cell for cell in re.split(r"[\s,;]+", words.strip()) if cell]
    if len(cells) != 3:
        raise UsageError(f"Expected three numbers, {', '.join(units)}, and found {len(cells)}.")
    try:
        numbers = [_number(cell, name, "", 0) for cell, name in zip(cells, units, strict=True)]
        return _xyz(numbers, "", 0) if units == "xyY" else numbers
    except DataError as error:
        raise UsageError(str(error)) from error


def parse(text: str, file: str = "", *, empty: bool = False) -> Readings:
    """Readings of the text of a CSV file; errors as for `read`."""
    import numpy as np

    about: dict[str, str] = {}
    header: list[str] | None = None
    most = 1.0
    unread: list[list[float]] = []
    codes: list[list[float]] = []
    found: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if line.startswith("#"):
            key, colon, value = line[1:].partition(":")
            if colon:
                about[key.strip().lower()] = value.strip()
            if colon and key.strip().lower() == "bits":
                if header is not None:
                    raise DataError("The number of bits must stand above the readings.", file, number)
                most = _most(value.strip(), file, number)
            continue
        if not line.strip(",; \t"):
            continue
        cells = [cell.strip() for cell in re.split("[;\t]" if re.search("[;\t]", line) else ",", line)]
        if header is None:
            header = _header(cells, file, number)
            continue
        if len(cells) != 6:
            raise DataError(f"Expected 6 numbers ({','.join(header)}), found {len(cells)}.", file, number)
        code = [_code(cell, most, file, number) for cell in cells[:3]]
        if not any(cells[3:]):
            unread.append(code)
            continue
        reading = [
            _number(cell, name, file, number) for cell, name in zip(cells[3:], header[3:], strict=True)
        ]
        codes.append(code)
        found.append(_xyz(reading, file, number) if header[3:] == _XYY[3:] else reading)
    if header is None:
        raise DataError("There is no line that names the columns: r,g,b,X,Y,Z or r,g,b,x,y,Y.", file)
    if not codes and not (empty and unread):
        raise DataError("There are no readings in this table.", file)
    bits = int(about.pop("bits", "8"))
    shape = (-1, 3)
    return Readings(
        np.reshape(codes, shape), np.reshape(found, shape), about, np.reshape(unread, shape), file, bits
    )


def _most(value: str, file: str, line: int) -> float:
    if not value.isdecimal() or not 1 <= int(value) <= 16:
        raise DataError(f"The number of bits is a whole number from 1 to 16, not {value!r}.", file, line)
    return float(2 ** int(value) - 1)


def _header(cells: list[str], file: str, line: int) -> list[str]:
    for known in (_XYZ, _XYY):
        if cells == known or [cell.strip('"') for cell in cells] == known:
            return known
    raise DataError(
        f"Expected the columns r,g,b,X,Y,Z or r,g,b,x,y,Y, found {','.join(cells)[:60]!r}.", file, line
    )


def _number(cell: str, name: str, file: str, line: int) -> float:
    if not cell:
        raise DataError(f"{name} is empty: fill in all three readings of a line, or none.", file, line)
    try:
        value = float(cell.replace(",", "."))
    except ValueError:
        raise DataError(f"{name} is {cell[:20]!r}: expected a number.", file, line) from None
    if not math.isfinite(value) or not 0.0 <= value <= LARGEST:
        raise DataError(f"{name} is {cell}: expected a number from 0 to {LARGEST:g}.", file, line)
    return value


def _code(cell: str, most: float, file: str, line: int) -> float:
    value = _number(cell, "A code value", file, line)
    if value > most:
        hint = (
            "; write `# bits: 8` above the columns if codes are whole numbers of 8 bits" if most == 1 else ""
        )
        raise DataError(f"A code value is {cell}: expected one from 0 to {most:g}{hint}.", file, line)
    return value / most


def _xyz(reading: list[float], file: str, line: int) -> list[float]:
    x, y, luminance = reading
    if luminance == 0.0:
        return [0.0, 0.0, 0.0]
    if not (y > 0.0 and x + y <= 1.0):
        raise DataError(f"x and y are {x:g} and {y:g}: no colour has these chromaticities.", file, line)
    return [luminance * x / y, luminance, luminance * (1.0 - x - y) / y]
