"""`illuminant atlas`: the figures and tables of the book, drawn by our own code, with claims checked in numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["atlas"]


def atlas(
    numbers: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NUMBER]...|list",
            help='Plates: 2.21, II.3, "table 2.1"; or the word list.',
            show_default=False,
        ),
    ] = None,
    all_plates: Annotated[bool, typer.Option("--all", help="Every figure and table.")] = False,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for pictures, CSV and pages.")
    ] = Path("atlas"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Small settings: the same claims in less time.")
    ] = False,
    json: Json = False,
) -> int:
    """Draw figures and tables of Hall's book (1989), each with its data and a claim checked in numbers.

    For each plate a picture, the data as CSV and a page in Markdown are written. Exit code 1 when a claim fails.

    \b
    Example:
      illuminant atlas list
      illuminant atlas 2.21 5.10
      illuminant atlas --all -o atlas
    """
    from illuminant.atlas import Plate, Sheet, plate, plates, publish
    from illuminant.cli.report import emit_json, note, sentence
    from illuminant.errors import UsageError

    asked = numbers or []
    if asked == ["list"] and not all_plates:
        if json:
            emit_json([{"name": one.name, "title": one.title, "claim": one.claim} for one in plates()])
        else:
            for one in plates():
                typer.echo(f"{one.name:<10} {one.title}")
        return 0
    if bool(asked) == all_plates:
        raise UsageError("Name plates such as 2.21, or --all; `illuminant atlas list` shows which there are.")
    chosen = plates() if all_plates else tuple(dict.fromkeys(plate(name) for name in asked))

    def told(one: Plate, sheet: Sheet) -> None:
        if json:
            return
        note(f"{output / one.stem}.png: {one.title} ({sheet.seconds:.1f} s)")
        for check in sheet.checks:
            note(f"  {check}")
            if not check.holds:
                sentence("Error", f"the claim of {one.kind} {one.number} fails: {check}.")

    sheets = publish(chosen, output, quick, told)
    if json:
        emit_json(
            [
                {
                    "name": one.name,
                    "title": one.title,
                    "claim": one.claim,
                    "holds": sheets[one.name].holds,
                    "seconds": sheets[one.name].seconds,
                    "files": [output / f"{one.stem}{end}" for end in (".png", ".csv", ".md")],
                    "checks": [
                        {
                            "what": check.what,
                            "value": check.value,
                            "unit": check.unit,
                            "at_least": check.at_least,
                            "at_most": check.at_most,
                            "holds": check.holds,
                        }
                        for check in sheets[one.name].checks
                    ],
                }
                for one in chosen
            ]
        )
    return 0 if all(sheet.holds for sheet in sheets.values()) else 1
