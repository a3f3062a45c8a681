"""`illuminant diff`: how far two images are apart, as an eye sees it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Assume, Exposure, Json

__all__ = ["diff"]


def diff(
    a: Annotated[
        Path, typer.Argument(metavar="A", help="Reference image (.exr or .png).", show_default=False)
    ],
    b: Annotated[Path, typer.Argument(metavar="B", help="Image to be compared with it.", show_default=False)],
    limit: Annotated[
        float | None,
        typer.Option(
            "--max", metavar="X", help="End with 1 if the measure is above this.", show_default=False
        ),
    ] = None,
    measure: Annotated[
        str,
        typer.Option("--measure", metavar="NAME", help="What --max limits: mean, p95, max (ΔE00) or flip."),
    ] = "mean",
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Map of ΔE00: numbers as .exr, or colours as .png.",
            show_default=False,
        ),
    ] = None,
    exposure: Exposure = None,
    assume: Assume = None,
    json: Json = False,
) -> None:
    """Compare two images of one size: CIEDE2000 (mean, 95th percentile, max) and FLIP.

    Absolute images are both shown with one exposure, the given one or that of A.

    \b
    Example:
      illuminant diff reference.exr room.exr --max 0.5 -o map.png
    """
    from illuminant.cli.report import emit_json, note, sentence
    from illuminant.difference import MEASURES, check_map, diff, save_map
    from illuminant.errors import UsageError

    if measure not in MEASURES:
        raise UsageError(f"--measure {measure}: expected {', '.join(MEASURES[:-1])} or {MEASURES[-1]}.")
    if limit is not None and not limit >= 0:
        raise UsageError(f"--max {limit:g}: expected a number from 0 up.")
    if output is not None:
        check_map(output)
    found = diff(a, b, exposure=exposure, assume=assume)
    facts = {
        "mean": found.mean,
        "p95": found.p95,
        "max": found.max,
        "flip": found.flip,
        "exposure": found.exposure,
    }
    if json:
        emit_json(facts)
    else:
        typer.echo(
            f"ΔE00 mean {found.mean:.4g}, 95th percentile {found.p95:.4g}, max {found.max:.4g} at "
            f"{found.worst[0]},{found.worst[1]}; FLIP {found.flip:.4g}"
        )
    if output is not None:
        save_map(output, found)
        note(f"{output}: map of ΔE00, white is {found.scale:.3g}")
    if limit is not None and facts[measure] > limit:
        sentence("Different", f"{measure} {facts[measure]:.4g} is above {limit:g}.")
        raise typer.Exit(1)
