"""`illuminant radiosity`: the light between surfaces, solved for once; one module for each verb."""

from __future__ import annotations

import typer

from illuminant.cli.radiosity import relight, show, solve, verify

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True)
app.command("solve", short_help="Solve for the light between surfaces.")(solve.solve)
app.command("relight", short_help="Change lamps and paints of a solution.")(relight.relight)
app.command("show", short_help="Image, mesh or illuminance of a solution.")(show.show)
app.command("verify", short_help="Compare measured illuminance with a solution.")(verify.verify)


@app.callback()
def _start() -> None:
    """Solve for the light between surfaces once, then see it from anywhere, and change lamps and paints.

    \b
    Example:
      illuminant radiosity solve room.toml -o room.solution
      illuminant radiosity relight room.solution --lamp sun=0.5 -o evening.solution
      illuminant radiosity show evening.solution -o evening.png
    """
