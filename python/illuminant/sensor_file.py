"""Tables of sensors: where they are, what they face, and what a meter read there.

Columns `x`, `y`, `z` in metres; `nx`, `ny`, `nz`, the direction that each faces, up where they are missing; and
`illuminance_lx`, where something was measured. `illuminant radiosity show` writes such tables too.

Example:
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "desk.csv"
    >>> _ = path.write_text("x,y,z,illuminance_lx\\n1,0.8,2,512\\n")
    >>> found = read(path, measured=True)
    >>> found.points, found.normals, found.illuminance_lx
    ([[1.0, 0.8, 2.0]], [[0.0, 1.0, 0.0]], [512.0])
"""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass

from illuminant import sources
from illuminant.errors import DataError

__all__ = ["MOST_BYTES", "Sensors", "read"]

PLACE = ("x", "y", "z")
FACING = ("nx", "ny", "nz")
READING = "illuminance_lx"

MOST_BYTES = 10_000_000
"""The largest table."""


@dataclass(frozen=True)
class Sensors:
    """A table.

    Attributes:
        points: in metres.
        normals: the direction that each faces, of any length.
        illuminance_lx: what was measured; empty where that was not asked for.
    """

    points: list[list[float]]
    normals: list[list[float]]
    illuminance_lx: list[float]


def read(
    path: str | os.PathLike[str], *, measured: bool = False, up: Sequence[float] = (0.0, 1.0, 0.0)
) -> Sensors:
    """Read a table of sensors (CSV).

    Args:
        path: the file.
        measured: whether each line must hold what was measured.
        up: what a sensor faces of which nothing is said.

    Raises:
        DataError: the file cannot be read or holds no sensors, or a line lacks a number; the sentence names the line.
    """
    name = os.fspath(path)
    found = Sensors([], [], [])
    wanted = ", ".join(PLACE + (FACING if not measured else ())) + (f" and {READING}" if measured else "")
    try:
        with io.StringIO(sources.read(path, MOST_BYTES).decode("utf-8-sig"), newline="") as stream:
            for line, row in enumerate(csv.DictReader(stream), start=2):
                try:
                    point = [float(row[key]) for key in PLACE]
                    normal = [float(row.get(key) or default) for key, default in zip(FACING, up, strict=True)]
                    reading = float(row[READING]) if measured else 1.0
                except (KeyError, TypeError, ValueError):
                    raise DataError(f"{name}:{line}: expected numbers in the columns {wanted}.") from None
                if not all(map(math.isfinite, [*point, *normal, reading])) or not any(normal) or reading <= 0:
                    raise DataError(
                        f"{name}:{line}: numbers must be finite, directions not 0, and illuminance above 0."
                    )
                found.points.append(point)
                found.normals.append(normal)
                found.illuminance_lx.extend([reading] if measured else [])
    except sources.SourceError as error:
        raise DataError(f"{name} cannot be read as a table: {error.clause}.") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise DataError(f"{name} cannot be read as a table: {error}.") from error
    if not found.points:
        raise DataError(f"{name} holds no sensors.")
    return found
