"""`illuminant calibrate walk`: asks for the readings of a table, one after another."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from illuminant.display.calibration.readings import Readings

__all__ = ["walk"]


def walk(
    table: Annotated[
        Path, typer.Argument(metavar="READINGS", help="Table to fill in (.csv).", show_default=False)
    ],
    units: Annotated[
        str, typer.Option("--as", metavar="FORM", help="How readings are typed: xyY or XYZ.")
    ] = "xyY",
) -> None:
    """Ask for each reading that a table lacks, and save it at once.

    Show the windows of the page beside it in the same order. `b` goes back, `q` or the end of the input stops; the next
    run goes on where this one stopped.

    \b
    Example:
      illuminant calibrate walk studio/readings.csv
    """
    from illuminant.cli.report import note
    from illuminant.display.calibration import readings
    from illuminant.errors import UsageError

    if units not in ("xyY", "XYZ"):
        raise UsageError(f"--as {units}: expected xyY or XYZ.")
    found = readings.read(table, empty=True)
    bits = found.bits
    most = 2**bits - 1
    total = len(found.codes) + (0 if found.unread is None else len(found.unread))
    ask = sys.stdin.isatty()
    while found.unread is not None and len(found.unread):
        code = found.unread[0]
        shown = ",".join(str(round(value * most)) for value in code.tolist())
        if ask:
            print(
                f"{len(found.codes) + 1}/{total}  r,g,b = {shown}   {' '.join(units)}? ", end="", flush=True
            )
        line = sys.stdin.readline()
        word = line.strip()
        if not line or word == "q":
            break
        if word == "b":
            found = _back(found)
        elif word:
            try:
                reading = readings.typed(word, units)
            except UsageError as error:
                if not ask:
                    raise
                note(str(error))
                continue
            found = _next(found, reading)
        else:
            continue
        found.save(table, bits=bits)
    left = 0 if found.unread is None else len(found.unread)
    note(f"{table}: {len(found.codes)} of {total} readings" + (f", {left} to go" if left else ""))
    if not left:
        note(f"next: illuminant calibrate fit {table} -o {table.parent.name or 'display'}.toml")


def _next(found: Readings, reading: list[float]) -> Readings:
    """The table with one more reading."""
    import numpy as np

    from illuminant.display.calibration.readings import Readings

    assert found.unread is not None
    return Readings(
        np.concatenate([found.codes, found.unread[:1]]),
        np.concatenate([found.xyz, [reading]]),
        found.about,
        found.unread[1:],
        found.file,
        found.bits,
    )


def _back(found: Readings) -> Readings:
    """The table without its last reading."""
    import numpy as np

    from illuminant.display.calibration.readings import Readings

    assert found.unread is not None
    if not len(found.codes):
        return found
    unread = np.concatenate([found.codes[-1:], found.unread])
    return Readings(found.codes[:-1], found.xyz[:-1], found.about, unread, found.file, found.bits)
