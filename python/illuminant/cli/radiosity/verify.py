"""`illuminant radiosity verify`: measured illuminance beside that of a solution."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["verify"]


def verify(
    solution: Annotated[Path, typer.Argument(metavar="SOLUTION", help="A solution.", show_default=False)],
    measured: Annotated[
        Path,
        typer.Argument(
            metavar="MEASURED",
            help="A CSV file with the columns x, y, z (m), nx, ny, nz and illuminance_lx.",
            show_default=False,
        ),
    ],
    most: Annotated[
        float | None,
        typer.Option(
            "--max", metavar="E", help="Fail (exit code 1) if the RMS error is above this fraction."
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Compare illuminance measured in a real room with that of a solution (Meyer et al. 1986).

    \b
    Example:
      illuminant radiosity verify room.solution meter.csv --max 0.1
    """
    from illuminant import radiosity
    from illuminant.cli.report import emit_json, note
    from illuminant.real_and_synthetic import radiometry
    from illuminant.sensor_file import read

    table = read(measured, measured=True)
    loaded = radiosity.Solution.load(solution)
    found = radiometry(loaded, table.points, table.normals, table.illuminance_lx)
    if json:
        emit_json(
            {
                "points": found.points,
                "measured_lx": found.measured,
                "computed_lx": found.computed,
                "errors": found.errors,
                "rms": found.rms,
                "mean": found.mean,
                "largest": found.largest,
            }
        )
    else:
        print(f"{'x':>8} {'y':>8} {'z':>8} {'measured':>10} {'computed':>10} {'error':>8}")
        for point, was, now, error in zip(
            found.points, found.measured, found.computed, found.errors, strict=True
        ):
            place = " ".join(f"{value:8.3f}" for value in point)
            print(f"{place} {was:10.4g} {now:10.4g} {100 * error:+7.1f}%")
        note(
            f"RMS error {100 * found.rms:.1f} %, mean {100 * found.mean:+.1f} %, largest {100 * found.largest:.1f} %"
        )
    if most is not None and found.rms > most:
        raise typer.Exit(1)
