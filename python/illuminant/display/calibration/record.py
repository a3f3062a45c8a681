"""The record of a monitor: its readings after each calibration, and when to calibrate again (book 5.4, step 6).

A line of a CSV file holds date, kind, readings of the white and of a low field, and the ΔE00 by which the monitor had
moved since the line before. How often to look again depends on how far it had to be brought back:

- with the analyzer, once a month; sooner when it drifts: after the time in which it would move by ΔE00 1 at the rate
  it had, but not before a week (and for a first record, after a month);
- in full, with comparator or colorimeter, after six months, or at once when the drift was above ΔE00 5, which an
  analyzer that was taught an old white cannot judge.

Kinds: "analyzer" and "full". Dates are ISO 8601 days.

Example:
    >>> import datetime
    >>> first = Entry(datetime.date(1988, 5, 2), "full", (97.9, 103.0, 112.2), (2.8, 3.0, 3.3))
    >>> schedule([first]).analyzer.isoformat()
    '1988-06-01'
"""

from __future__ import annotations

import datetime
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from illuminant import output
from illuminant.display.table_text import text_of
from illuminant.errors import DataError, UsageError

__all__ = ["KINDS", "Entry", "Schedule", "append", "drift", "read", "schedule"]

KINDS = ("analyzer", "full")

MONTH, WEEK, HALF_YEAR = 30, 7, 182
"""Days."""

LAST = datetime.date.max - datetime.timedelta(days=HALF_YEAR)
"""The last date after which there is one to calibrate again."""

TOLERATED, LARGE = 1.0, 5.0
"""ΔE00 that a monitor may move between two looks at it, and that calls for a full calibration."""

COLUMNS = "date,kind,white_X,white_Y,white_Z,low_X,low_Y,low_Z,moved_delta_e,note"

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Entry:
    """One line of the record.

    Attributes:
        date: of the calibration.
        kind: "analyzer" or "full".
        white, low: XYZ of the white field and of the field of low intensity, cd/m², after adjusting.
        moved: ΔE00 from the state that the line before had left to that found now; None for the first line.
        note: anything, in one line.
    """

    date: datetime.date
    kind: str
    white: Triple
    low: Triple
    moved: float | None = None
    note: str = ""


class Schedule(NamedTuple):
    """When to look again.

    Attributes:
        analyzer: date of the next look with the analyzer.
        full: date of the next full calibration.
        reason: why, in a sentence.
    """

    analyzer: datetime.date
    full: datetime.date
    reason: str


def drift(left: Entry, white: Triple, low: Triple) -> float:
    """ΔE00 between what a calibration left and what is found, the larger of white and low field.

    Beside the white that was left, so a loss of luminance counts as well as a tint.
    """
    import numpy as np

    from illuminant import color

    pairs = [(left.white, white), (left.low, low)]
    labs = [[color.xyz_to_lab(np.array(xyz), left.white) for xyz in pair] for pair in pairs]
    return max(float(color.delta_e_2000(before, now)) for before, now in labs)


def schedule(entries: list[Entry]) -> Schedule:
    """When to look again, by the record.

    Raises:
        UsageError: the record is empty.
    """
    if not entries:
        raise UsageError("There is no record to go by: calibrate first.")
    last = entries[-1]
    full = max((entry.date for entry in entries if entry.kind == "full"), default=last.date)
    full += datetime.timedelta(days=HALF_YEAR)
    if last.moved is None or len(entries) < 2:
        return Schedule(
            last.date + datetime.timedelta(days=MONTH), full, "A first record: look again in a month."
        )
    days = max(1, (last.date - entries[-2].date).days)
    rate = last.moved / days
    wait = MONTH if rate * MONTH <= TOLERATED else max(WEEK, math.floor(TOLERATED / rate))
    if last.moved > LARGE and last.kind != "full":
        reason = f"It moved by ΔE00 {last.moved:.1f}, more than {LARGE:g}: calibrate in full now."
        return Schedule(last.date + datetime.timedelta(days=wait), last.date, reason)
    reason = f"It moved by ΔE00 {last.moved:.1f} in {days} days: look again in {wait} days."
    return Schedule(last.date + datetime.timedelta(days=wait), full, reason)


def read(path: str | os.PathLike[str]) -> list[Entry]:
    """The lines of a record, in order; none when there is no file yet.

    Raises:
        DataError: a line is wrong; file and line are named.
    """
    path = Path(path)
    if not path.exists():
        return []
    text = text_of(path, "The record")
    entries: list[Entry] = []
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    if not lines or lines[0][1].strip() != COLUMNS:
        raise DataError(f"This is no record of calibrations: its first line must be {COLUMNS}.", str(path), 1)
    for number, line in lines[1:]:
        entry = _entry(line, str(path), number)
        if entries and entry.date < entries[-1].date:
            raise DataError(f"The date {entry.date} is before that of the line above.", str(path), number)
        entries.append(entry)
    return entries


def _entry(line: str, file: str, number: int) -> Entry:
    cells = line.split(",", 9)
    if len(cells) != 10:
        raise DataError(f"Expected 10 columns, found {len(cells)}.", file, number)
    try:
        date = datetime.date.fromisoformat(cells[0].strip())
    except ValueError:
        raise DataError(f"{cells[0]!r} is no date such as 1988-05-02.", file, number) from None
    if date > LAST:
        raise DataError(f"The date {date} is after {LAST}, and has no next one.", file, number)
    if cells[1].strip() not in KINDS:
        raise DataError(f"A kind is {' or '.join(KINDS)}, not {cells[1]!r}.", file, number)
    try:
        values = [float(cell) for cell in cells[2:8]]
        moved = float(cells[8]) if cells[8].strip() else None
    except ValueError:
        raise DataError("Expected numbers in the columns of the readings.", file, number) from None
    if not all(math.isfinite(value) and value >= 0.0 for value in [*values, moved or 0.0]):
        raise DataError("Readings are numbers from 0 up.", file, number)
    note = cells[9].strip().strip('"')
    return Entry(
        date,
        cells[1].strip(),
        (values[0], values[1], values[2]),
        (values[3], values[4], values[5]),
        moved,
        note,
    )


def append(path: str | os.PathLike[str], entry: Entry, found: tuple[Triple, Triple] | None = None) -> Entry:
    """Add a line to a record, which is made if there is none, atomically.

    Args:
        path: of the CSV file.
        entry: the new line; its `moved` is worked out here.
        found: XYZ of white and low field before adjusting; default those after, when nothing was turned.

    Returns:
        The line as it was written.

    Raises:
        UsageError: its date is before that of the last line, its kind is not known, or its readings have no light.
        DataError: the record there is cannot be read.
    """
    entries = read(path)
    if entry.kind not in KINDS:
        raise UsageError(f"A kind is {' or '.join(KINDS)}, not {entry.kind!r}.")
    if not all(math.isfinite(value) and value > 0.0 for value in entry.white):
        raise UsageError("The white of a record needs X, Y and Z above 0.")
    if entry.date > LAST:
        raise UsageError(f"A calibration of {entry.date} has no next one: expected a date up to {LAST}.")
    if entries and entry.date < entries[-1].date:
        raise UsageError(f"The record goes on to {entries[-1].date}, after {entry.date}.")
    moved = drift(entries[-1], *(found or (entry.white, entry.low))) if entries else None
    note = " ".join(entry.note.split())
    entry = Entry(entry.date, entry.kind, entry.white, entry.low, moved, note)
    entries.append(entry)
    rows = [COLUMNS]
    for one in entries:
        numbers = [f"{value:.5g}" for value in (*one.white, *one.low)]
        rows.append(
            ",".join(
                [
                    one.date.isoformat(),
                    one.kind,
                    *numbers,
                    f"{one.moved:.2f}" if one.moved is not None else "",
                    one.note,
                ]
            )
        )
    output.write_bytes(path, ("\n".join(rows) + "\n").encode())
    return entry
