"""Readings of a monitor: luminances of a small field at some code values, from a file.

A CSV with the code in the first column and a luminance in each of the others, under a line of names; one other column
is a grey field or one gun, three are three guns, each fitted by itself. `#` begins a comment.

    code,luminance
    0,0.06
    32,1.05
    255,101.3

Codes are any numbers from 0 up, in any order, and may come more than once; the largest is the code of white unless it
is said otherwise. Luminances are in cd/m², or in any unit that is the same for all; a negative one is a meter's noise.

Errors: `DataError` with file and line.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Readings", "read_readings"]

MAX_BYTES = 10_000_000


@dataclass(frozen=True, eq=False)
class Readings:
    """Codes, and what was measured at them.

    Attributes:
        codes: (n,).
        luminances: for each column by name, (n,), cd/m².
    """

    codes: NDArray[np.float64]
    luminances: dict[str, NDArray[np.float64]]


def read_readings(path: str | os.PathLike[str]) -> Readings:
    """Read a file of readings.

    Raises:
        DataError: there is no such file, it has no rows, or a row is not a code and its luminances.

    Example:
        >>> import tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "grey.csv"
        >>> _ = path.write_text("code,luminance\\n0,0.06\\n128,22.1\\n255,101.3\\n")
        >>> readings = read_readings(path)
        >>> readings.codes.tolist(), list(readings.luminances)
        ([0.0, 128.0, 255.0], ['luminance'])
    """
    import numpy as np

    path = Path(path)
    try:
        if path.stat().st_size > MAX_BYTES:
            raise DataError("The file is too large for readings.", str(path))
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise DataError(
            f"The file cannot be read: {(error.strerror or str(error)).lower()}.", str(path)
        ) from error
    except UnicodeDecodeError as error:
        raise DataError("The file is no text.", str(path)) from error
    names: list[str] | None = None
    rows: list[list[float]] = []
    for line, content in enumerate(text.splitlines(), 1):
        fields = [field.strip() for field in content.partition("#")[0].split(",")]
        if fields == [""]:
            continue
        if names is None:
            names = _names(path, line, fields)
            if not _is_number(fields[0]):
                continue
        if len(fields) != len(names):
            raise DataError(f"Expected {len(names)} values, not {len(fields)}.", str(path), line)
        if wrong := [field for field in fields if not _is_number(field)]:
            raise DataError(f"{wrong[0]!r} is no number.", str(path), line)
        row = [float(field) for field in fields]
        if row[0] < 0:
            raise DataError(f"A code is 0 or above, not {row[0]:g}.", str(path), line)
        rows.append(row)
    if not rows or names is None:
        raise DataError("The file has no readings: expected rows of a code and a luminance.", str(path))
    table = np.array(rows)
    return Readings(table[:, 0], {name: table[:, i] for i, name in enumerate(names) if i})


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _names(path: Path, line: int, fields: list[str]) -> list[str]:
    """Names of the columns from the first row, or made up when it holds numbers already."""
    if len(fields) < 2:
        raise DataError("Expected at least two columns, code and luminance.", str(path), line)
    if _is_number(fields[0]):
        return [
            "code",
            *(["luminance"] if len(fields) == 2 else [f"column {i}" for i in range(1, len(fields))]),
        ]
    if len(set(fields)) != len(fields):
        raise DataError("Two columns have one name.", str(path), line)
    return fields
