"""`illuminant radiosity relight`: other lamps and paints."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from illuminant.cli.options import Json

__all__ = ["relight"]


def relight(
    solution: Annotated[Path, typer.Argument(metavar="SOLUTION", help="A solution.", show_default=False)],
    lamp: Annotated[
        list[str] | None,
        typer.Option(
            "--lamp",
            metavar="NAME=CHANGE",
            help="A factor (0 is off), or a spectrum of the library; may be given again.",
            show_default=False,
        ),
    ] = None,
    paint: Annotated[
        list[str] | None,
        typer.Option(
            "--paint",
            metavar="NAME=REFLECTANCE",
            help="Make a material a diffuser: a number, or a spectrum of the library; may be given again.",
            show_default=False,
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="The new solution (SOLUTION itself).", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Change lamps and paints of a solution, without new form factors.

    Other lamps are a matter of multiplying; other paints take a few iterations. What is written is the new solution.

    \b
    Examples:
      illuminant radiosity relight room.solution --lamp ceiling=0.3 --lamp desk=A -o dim.solution
      illuminant radiosity relight room.solution --paint "wall=ColorChecker/blue"
    """
    import time

    from illuminant import output as files
    from illuminant import radiosity
    from illuminant.cli.radiosity.report import facts
    from illuminant.cli.report import emit_json, note
    from illuminant.errors import UsageError

    path = files.check(output or solution)
    lamps = {name: _number_or_name(change) for name, change in _pairs("--lamp", lamp)}
    materials = {
        name: {"kind": "diffuse", "reflectance": _number_or_name(change)}
        for name, change in _pairs("--paint", paint)
    }
    if not lamps and not materials:
        raise UsageError("Nothing to change: give --lamp NAME=CHANGE or --paint NAME=REFLECTANCE.")
    before = radiosity.Solution.load(solution)
    start = time.monotonic()
    found = before.relight(lamps=lamps, materials=materials)
    seconds = time.monotonic() - start
    found.save(path)
    if json:
        emit_json(facts(found) | {"file": path, "seconds_relighting": seconds})
    else:
        note(f"{path}: relit in {seconds * 1000:.0f} ms")


def _pairs(option: str, given: list[str] | None) -> list[tuple[str, str]]:
    from illuminant.errors import UsageError

    found = []
    for text in given or []:
        name, equals, change = text.partition("=")
        if not equals or not name.strip() or not change.strip():
            raise UsageError(f"{option} {text}: expected a name, = and its new value.")
        found.append((name.strip(), change.strip()))
    return found


def _number_or_name(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text
