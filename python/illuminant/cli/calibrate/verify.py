"""`illuminant calibrate verify`: a description judged by readings of the ColorChecker through it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["verify"]


def verify(
    description: Annotated[
        Path, typer.Argument(metavar="DISPLAY", help="Description (.toml).", show_default=False)
    ],
    table: Annotated[
        Path, typer.Argument(metavar="READINGS", help="Readings of its chart (.csv).", show_default=False)
    ],
    limit: Annotated[
        float, typer.Option("--max", metavar="X", help="End with 1 if the mean ΔE00 is above this.")
    ] = 1.0,
    json: Json = False,
) -> None:
    """Compare the ColorChecker as it was read with what it should be.

    The chart's windows and table are made by `illuminant calibrate patterns --verify DISPLAY`.

    \b
    Example:
      illuminant calibrate verify studio.toml check/readings.csv
    """
    from illuminant.cli.report import emit_json, sentence
    from illuminant.display.calibration import readings
    from illuminant.display.calibration.description import read_chart
    from illuminant.errors import UsageError

    if not limit >= 0:
        raise UsageError(f"--max {limit:g}: expected a number from 0 up.")
    chart = read_chart(description, readings.read(table))
    if json:
        emit_json(
            {
                "mean": chart.mean,
                "max": chart.max,
                "mean_all": chart.mean_all,
                "outside": chart.outside,
                "white": chart.white,
                "patches": chart.differences,
            }
        )
    else:
        for patch, error in chart.differences.items():
            typer.echo(f"  {patch:<15}{error:6.2f}{'  outside the gamut' if patch in chart.outside else ''}")
        typer.echo(f"ΔE00 mean {chart.mean:.2f}, max {chart.max:.2f} over the patches inside the gamut")
    if chart.mean > limit:
        sentence("Different", f"the mean {chart.mean:.2f} is above {limit:g}.")
        raise typer.Exit(1)
