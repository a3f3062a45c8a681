"""Luminances of a monitor at some code values, from a file, for the fit of its gamma.

A CSV with the code in the first column and a luminance in each of the others, under a line of names; one other column
is a grey field or one gun, three are three guns, each fitted by itself. `#` begins a comment.

    code,luminance
    0,0.06
    32,1.05
    255,101.3

Codes are any numbers from 0 up, in any order, and may come more than once; the largest is the code of white unless it
is said otherwise. Luminances are in cd/m², or in any unit that is the same for all; a negative one is a meter's noise.

A table of `illuminant.display.calibration.readings`, r, g, b and X, Y, Z, is read too: its Y of the greys, and of red,
green and blue each alone, with black as the first of each.

Errors: `DataError` with file and line.
"""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, NamedTuple

from illuminant.display.table_text import rows, text_of
from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.calibration import readings as calibration

__all__ = ["Measured", "read_readings"]

FEWEST = 4
"""Codes of a column of a table of r, g, b and X, Y, Z: one with fewer has no gamma."""


class Measured(NamedTuple):
    """One column.

    Attributes:
        codes: (n,).
        luminances: (n,) what was measured at them, cd/m².
    """

    codes: NDArray[np.float64]
    luminances: NDArray[np.float64]


def read_readings(path: str | os.PathLike[str]) -> dict[str, Measured]:
    """Read a file of readings: each column by its name.

    Raises:
        DataError: there is no such file, it has no rows, or a row is not a code and its luminances.

    Example:
        >>> import tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "grey.csv"
        >>> _ = path.write_text("code,luminance\\n0,0.06\\n128,22.1\\n255,101.3\\n")
        >>> read_readings(path)["luminance"].codes.tolist()
        [0.0, 128.0, 255.0]
    """
    import numpy as np

    file, text = os.fspath(path), text_of(path)
    names: list[str] | None = None
    found: list[list[float]] = []
    for line, cells in rows(text):
        if names is None:
            if [cell.strip('"') for cell in cells[:3]] == ["r", "g", "b"] or ";" in cells[0]:
                from illuminant.display.calibration import readings as calibration

                return _columns(calibration.parse(text, file))
            names = _names(file, line, cells)
            if not _is_number(cells[0]):
                continue
        if len(cells) != len(names):
            raise DataError(f"Expected {len(names)} values, not {len(cells)}.", file, line)
        if wrong := [cell for cell in cells if not _is_number(cell)]:
            raise DataError(f"{wrong[0]!r} is no number.", file, line)
        row = [float(cell) for cell in cells]
        if row[0] < 0:
            raise DataError(f"A code is 0 or above, not {row[0]:g}.", file, line)
        found.append(row)
    if not found or names is None:
        raise DataError("The file has no readings: expected rows of a code and a luminance.", file)
    table = np.array(found)
    return {name: Measured(table[:, 0], table[:, i]) for i, name in enumerate(names) if i}


def _columns(table: calibration.Readings) -> dict[str, Measured]:
    """Greys and guns of a table of calibration, as whole codes."""
    import numpy as np

    most, black = 2**table.bits - 1, (table.codes == 0.0).all(axis=1)
    chosen = {"grey": np.ptp(table.codes, axis=1) < 1e-9}
    for gun, name in enumerate(("red", "green", "blue")):
        chosen[name] = black | (
            (table.codes[:, gun] > 0.0) & (np.delete(table.codes, gun, axis=1) == 0.0).all(axis=1)
        )
    columns = {
        name: Measured(most * table.codes[own].max(axis=1), table.xyz[own, 1]) for name, own in chosen.items()
    }
    kept = {name: column for name, column in columns.items() if len(np.unique(column.codes)) >= FEWEST}
    if not kept:
        raise DataError(f"There are not {FEWEST} levels of grey or of a channel in this table.", table.file)
    return kept


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _names(file: str, line: int, cells: list[str]) -> list[str]:
    """Names of the columns from the first row, or made up when it holds numbers already."""
    if len(cells) < 2:
        raise DataError("Expected at least two columns, code and luminance.", file, line)
    if _is_number(cells[0]):
        return [
            "code",
            *(["luminance"] if len(cells) == 2 else [f"column {i}" for i in range(1, len(cells))]),
        ]
    if len(set(cells)) != len(cells):
        raise DataError("Two columns have one name.", file, line)
    return cells
