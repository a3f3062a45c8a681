"""Chromaticities of a monitor's phosphors, from its manufacturer or from a meter (book 5.1.1).

A CSV with one row for each of red, green, blue and white, in any order, and columns `colour,x,y`, `colour,x,y,Y` or
`colour,X,Y,Z`; `#` begins a comment. A manufacturer prints x and y; a meter gives luminances too, which tell whether
the guns add up to white as a monitor's should:

    additivity = (Y_red + Y_green + Y_blue) / Y_white

1 within a few per cent; below it, the power supply gives in under load, or black was not set right. The display that
comes of the readings has their primaries and white (book eq 3.2), a power law, and the luminance of white where that
was read. Readings of more levels give more: `illuminant.display.calibration`.

Errors: `DataError` with file and line.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant.display.table_text import rows, text_of
from illuminant.errors import DataError

if TYPE_CHECKING:
    from illuminant.display.displays import Display

__all__ = ["COLOURS", "Phosphors", "read_phosphors"]

COLOURS = ("red", "green", "blue", "white")

_COLUMNS = {("x", "y"), ("x", "y", "Y"), ("X", "Y", "Z")}


@dataclass(frozen=True)
class Phosphors:
    """The colours of a monitor at full value.

    Attributes:
        primaries: x and y of red, green and blue.
        white: x and y of white.
        luminances: of red, green, blue and white, cd/m²; None where only chromaticities are known.
    """

    primaries: tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
    white: tuple[float, float]
    luminances: tuple[float, float, float, float] | None = None

    @property
    def additivity(self) -> float | None:
        """Sum of the luminances of the three guns over that of white; None without luminances."""
        if self.luminances is None:
            return None
        return sum(self.luminances[:3]) / self.luminances[3]

    def display(self, gamma: float = 2.2, name: str = "monitor") -> Display:
        """The display of these phosphors.

        Args:
            gamma: γ of the monitor.
            name: for people.

        Raises:
            UsageError: primaries on one line, a white outside of them, or a γ that is not above 0.

        Example:
            >>> found = Phosphors(((0.67, 0.33), (0.21, 0.71), (0.14, 0.08)), (0.313, 0.329))
            >>> found.display(2.4).response, found.display().peak
            ('gamma 2.4', 100.0)
        """
        from illuminant.display.displays import Display
        from illuminant.display.gamma.response import curve_name

        peak = {} if self.luminances is None else {"peak": self.luminances[3]}
        return Display(name, self.primaries, self.white, curve_name(gamma), **peak)


def read_phosphors(path: str | os.PathLike[str]) -> Phosphors:
    """Read chromaticities, or what a meter said.

    Raises:
        DataError: there is no such file, a colour is missing or there twice, or a row is no colour.

    Example:
        >>> import tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "crt.csv"
        >>> rows = ["red,0.63,0.34,22.1", "green,0.31,0.595,66.0", "blue,0.155,0.07,9.9", "white,0.313,0.329,100"]
        >>> _ = path.write_text("\\n".join(["colour,x,y,Y", *rows]))
        >>> round(read_phosphors(path).additivity, 3)
        0.98
    """
    path = Path(path)
    columns: tuple[str, ...] | None = None
    found: dict[str, tuple[float, ...]] = {}
    for line, fields in rows(text_of(path)):
        if columns is None:
            columns = tuple(fields[1:])
            if columns not in _COLUMNS:
                raise DataError(
                    "Expected the columns colour,x,y or colour,x,y,Y or colour,X,Y,Z.", str(path), line
                )
            continue
        name = fields[0].casefold()
        if name not in COLOURS:
            raise DataError(f"{fields[0]!r} is none of {', '.join(COLOURS)}.", str(path), line)
        if name in found:
            raise DataError(f"{name} is there twice.", str(path), line)
        found[name] = _numbers(path, line, fields[1:], columns)
    if missing := [name for name in COLOURS if name not in found]:
        raise DataError(f"There is no {missing[0]}: expected {', '.join(COLOURS)}.", str(path))
    if columns == ("X", "Y", "Z"):
        found = {name: (x / (x + y + z), y / (x + y + z), y) for name, (x, y, z) in found.items()}
    red, green, blue, white = ((found[name][0], found[name][1]) for name in COLOURS)
    lights = None
    if len(found["white"]) == 3:
        lights = (found["red"][2], found["green"][2], found["blue"][2], found["white"][2])
    return Phosphors((red, green, blue), white, lights)


def _numbers(path: Path, line: int, fields: list[str], columns: tuple[str, ...]) -> tuple[float, ...]:
    """The numbers of a row, when they are a colour."""
    try:
        values = tuple(float(field) for field in fields)
    except ValueError:
        values = ()
    if len(values) != len(columns) or not all(math.isfinite(value) for value in values):
        raise DataError(f"Expected the numbers {', '.join(columns)}.", str(path), line)
    if columns == ("X", "Y", "Z"):
        if min(values) < 0 or values[1] <= 0:
            raise DataError("X, Y and Z of a light are 0 or more, and Y is above 0.", str(path), line)
    elif not (0 <= values[0] <= 1 and 0 < values[1] <= 1 and values[0] + values[1] <= 1):
        raise DataError("x and y of a light are between 0 and 1, and so is their sum.", str(path), line)
    elif len(values) == 3 and values[2] <= 0:
        raise DataError("The luminance of a light is above 0.", str(path), line)
    return values
