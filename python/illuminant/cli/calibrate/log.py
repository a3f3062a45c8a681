"""`illuminant calibrate log`: the record of a monitor, and when to look at it again."""

from __future__ import annotations

import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.options import Json
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.display.calibration.record import Triple

__all__ = ["log"]


def log(
    record: Annotated[
        Path, typer.Argument(metavar="RECORD", help="Record (.csv), made if missing.", show_default=False)
    ],
    table: Annotated[
        Path | None,
        typer.Option("--readings", metavar="FILE", help="Take them from a table.", show_default=False),
    ] = None,
    white: Annotated[
        str | None,
        typer.Option("--white", metavar="X,Y,Z", help="White, cd/m², after adjusting.", show_default=False),
    ] = None,
    low: Annotated[
        str | None,
        typer.Option("--low", metavar="X,Y,Z", help="Low field, cd/m².", show_default=False),
    ] = None,
    found: Annotated[
        str | None,
        typer.Option(
            "--found", metavar="X,Y,Z,X,Y,Z", help="White and low before adjusting.", show_default=False
        ),
    ] = None,
    kind: Annotated[str, typer.Option("--kind", metavar="NAME", help="full or analyzer.")] = "full",
    date: Annotated[
        str | None,
        typer.Option("--date", metavar="DAY", help="Such as 2026-05-02 (today).", show_default=False),
    ] = None,
    note: Annotated[str, typer.Option("--note", metavar="TEXT", help="Anything.", show_default=False)] = "",
    json: Json = False,
) -> None:
    """Add readings to the record of a monitor, or without any say when it is to be looked at again.

    \b
    Example:
      illuminant calibrate log studio-log.csv --readings studio/readings.csv
      illuminant calibrate log studio-log.csv
    """
    from illuminant.cli.report import emit_json
    from illuminant.display.calibration import record as records
    from illuminant.errors import UsageError

    if table is not None and (white or low):
        raise UsageError("--readings has white and low field: leave out --white and --low.")
    if (white is None) != (low is None):
        raise UsageError("--white and --low belong together.")
    entry = None
    if table is not None or white is not None:
        pair = _of_table(table) if table is not None else (_triple(white, "--white"), _triple(low, "--low"))
        entry = records.Entry(_day(date), kind, *pair, note=note)
        entry = records.append(record, entry, _pair(found) if found is not None else None)
    elif found is not None or note or date is not None:
        raise UsageError("Nothing to record: give --readings, or --white and --low.")
    entries = records.read(record)
    if not entries:
        raise UsageError(f"There is no record {record} yet: give --readings, or --white and --low.")
    next_time = records.schedule(entries)
    if json:
        emit_json(
            {
                "entries": len(entries),
                "moved": entries[-1].moved,
                "analyzer": next_time.analyzer.isoformat(),
                "full": next_time.full.isoformat(),
                "reason": next_time.reason,
            }
        )
        return
    if entry is not None:
        typer.echo(f"{record}: {len(entries)} {'entry' if len(entries) == 1 else 'entries'}")
    typer.echo(next_time.reason)
    typer.echo(f"next with the analyzer: {next_time.analyzer}; in full: {next_time.full}")


def _numbers(text: str | None, option: str, count: int) -> list[float]:
    from illuminant.errors import UsageError

    expected = f"{count} numbers from 0 up, with commas between them"
    values = numbers(text or "", option, expected, count=count)
    if not all(0.0 <= value <= 1e5 for value in values):
        raise UsageError(f"{option} {text}: expected {expected}.")
    return values


def _triple(text: str | None, option: str) -> Triple:
    x, y, z = _numbers(text, option, 3)
    return x, y, z


def _pair(text: str) -> tuple[Triple, Triple]:
    a, b, c, d, e, f = _numbers(text, "--found", 6)
    return (a, b, c), (d, e, f)


def _day(text: str | None) -> datetime.date:
    from illuminant.errors import UsageError

    if text is None:
        return datetime.date.today()
    try:
        return datetime.date.fromisoformat(text)
    except ValueError as error:
        raise UsageError(f"--date {text}: expected a day such as 2026-05-02.") from error


def _of_table(path: Path) -> tuple[Triple, Triple]:
    """White, and the grey nearest to code 0.2, of a table."""
    import numpy as np

    from illuminant.display.calibration import readings
    from illuminant.errors import DataError

    greys = readings.read(path).greys()
    full = greys.xyz[greys.codes[:, 0] == 1.0]
    middle = (greys.codes[:, 0] > 0.05) & (greys.codes[:, 0] < 0.5)
    if not len(full) or not middle.any():
        raise DataError("A record needs white and a grey of code 0.05 to 0.5.", str(path))
    nearest = greys.xyz[middle][int(np.argmin(np.abs(greys.codes[middle, 0] - 0.2)))]
    (x, y, z), (u, v, w) = full.mean(axis=0).tolist(), nearest.tolist()
    return (x, y, z), (u, v, w)
