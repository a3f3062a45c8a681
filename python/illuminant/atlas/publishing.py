"""Plates as files: a picture (PNG), its data (CSV) and a page (Markdown) each, and an index of all.

The pages are those of the atlas in the documentation's site; formulas stand between $, as KaTeX reads them.
"""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from illuminant import output
from illuminant.atlas.plate import Check, Plate, Sheet
from illuminant.errors import ImageError

__all__ = ["CHAPTERS", "data", "index", "page", "publish"]

CHAPTERS = {
    1: "Introduction",
    2: "The illumination process",
    3: "Perceptual response",
    4: "Illumination models",
    5: "Image display",
    102: "Appendix II: surface properties from data",
    103: "Appendix III: functions",
    104: "Appendix IV: form factors",
}
"""Names of the chapters by `Plate.order`."""


def publish(
    plates: Sequence[Plate],
    folder: str | os.PathLike[str],
    quick: bool = False,
    on_done: Callable[[Plate, Sheet], object] | None = None,
) -> dict[str, Sheet]:
    """Draw plates and write their pictures, data and pages into a folder, and an index.

    Args:
        plates: which.
        folder: made if its parent exists.
        quick: small settings.
        on_done: called after each.

    Returns:
        The sheets by the plates' names. Whether a claim holds is told by the sheet, and raises nothing.

    Raises:
        ImageError, MachineError: the folder or a file cannot be written.
    """
    from illuminant import plots

    target = Path(folder)
    try:
        target.mkdir(exist_ok=True)
    except OSError as error:
        raise ImageError(f"{target} cannot be made: {(error.strerror or str(error)).lower()}.") from error
    sheets: dict[str, Sheet] = {}
    for plate in plates:
        sheet = plate.sheet(quick)
        plots.save(sheet.picture, target / f"{plate.stem}.png")
        output.write_bytes(target / f"{plate.stem}.csv", data(sheet).encode())
        output.write_bytes(target / f"{plate.stem}.md", page(plate, sheet).encode())
        sheets[plate.name] = sheet
        if on_done is not None:
            on_done(plate, sheet)
    output.write_bytes(target / "index.md", index(plates).encode())
    return sheets


def data(sheet: Sheet) -> str:
    """The columns of a sheet as CSV: a line of names, then rows; numbers to 8 digits, nothing for NaN."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(sheet.columns)
    for row in zip(*sheet.columns.values(), strict=True):
        writer.writerow([_cell(value) for value in row])
    return text.getvalue()


def _cell(value: Any) -> str:
    if isinstance(value, str):
        return value
    number = float(value)
    return "" if math.isnan(number) else f"{number:.8g}"


def page(plate: Plate, sheet: Sheet) -> str:
    """The page of a plate."""
    parts = [
        f"# {plate.kind.capitalize()} {plate.number}: {plate.title}",
        f"![{plate.title}]({plate.stem}.png)",
        plate.shows,
        f"**Claim.** {plate.claim}",
        _table(sheet.checks),
    ]
    if plate.kind == "table":
        parts.append(_columns(sheet))
    if plate.printed:
        parts.append(f"**In print.** {plate.printed}")
    parts.append(f"**Today.** {plate.today}")
    parts.append(f"Data: [{plate.stem}.csv]({plate.stem}.csv)")
    name = plate.name if plate.kind == "figure" else f'"{plate.name}"'
    parts.append("\n".join(["```sh", f"illuminant atlas {name}", *plate.commands, "```"]))
    return "\n\n".join(parts) + "\n"


def _table(checks: Sequence[Check]) -> str:
    rows = []
    for check in checks:
        found, held = f"{check.value:.5g} {check.unit}".rstrip(), "yes" if check.holds else "**no**"
        rows.append(f"| {check.what} | {found} | {check.bounds} | {held} |")
    return "\n".join(["| number | found | must be | holds |", "| --- | --- | --- | --- |", *rows])


def _columns(sheet: Sheet) -> str:
    """The columns as a table, numbers to 4 digits."""
    lines = [sheet.columns, ["---"] * len(sheet.columns)]
    for row in zip(*sheet.columns.values(), strict=True):
        lines.append(
            [one if isinstance(one, str) else "" if math.isnan(one) else f"{one:.4g}" for one in row]
        )
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def index(plates: Sequence[Plate]) -> str:
    """The page that shows all plates by chapter."""
    lines = [
        "# The atlas",
        "",
        "The figures and tables of Roy Hall, *Illumination and Color in Computer Generated Imagery* (1989), made by",
        "illuminant: each with its data, a claim that is checked in numbers whenever it is drawn, and what is done",
        "today. Curves that the book has wrong are drawn right, and as printed dashed.",
    ]
    chapter = 0
    for plate in plates:
        if plate.order[0] != chapter:
            chapter = plate.order[0]
            head = f"Chapter {chapter}: {CHAPTERS[chapter]}" if chapter < 100 else CHAPTERS[chapter]
            lines += ["", f"## {head}", "", "| | |", "| --- | --- |"]
        name = f"{plate.kind.capitalize()} {plate.number}"
        lines.append(
            f"| [![{plate.title}]({plate.stem}.png)]({plate.stem}.md) "
            f"| [{name}: {plate.title}]({plate.stem}.md)<br>{plate.claim} |"
        )
    return "\n".join(lines) + "\n"
