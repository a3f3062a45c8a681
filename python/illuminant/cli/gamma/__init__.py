"""`illuminant gamma`: tables, fits and studies of the gamma of monitors; one module for verbs that belong together.

A new verb is its function, and its line below.
"""

from __future__ import annotations

import typer

from illuminant.cli.gamma import fit, remap, study, table

__all__ = ["app"]

app = typer.Typer(no_args_is_help=False)
app.command("table", short_help="Print or write a lookup table.")(table.table)
app.command("levels", short_help="Say which levels a table loses.")(table.levels)
app.command("fit", short_help="Fit a gamma to measured luminances.")(fit.fit)
app.command("phosphors", short_help="Make a monitor's matrix from readings.")(fit.phosphors)
app.command("response", short_help="Plot response and correction.")(study.response)
app.command("drift", short_help="Plot what a wrong gamma does to colours.")(study.drift)
app.command("brightness", short_help="Plot perceived brightness.")(study.brightness)
app.command("banding", short_help="Compare two ways to store an image.")(study.banding)
app.command("remap", short_help="Map a picture from one display to another.")(remap.remap)


@app.callback(invoke_without_command=True)
def _start(context: typer.Context) -> None:
    """The gamma of monitors: its correction, its measurement, and what goes wrong with it.

    \b
    Example:
      illuminant gamma table --gamma 2.2 --rounding truncate
      illuminant gamma fit readings.csv --plot fit.png
    """
    if context.invoked_subcommand is None:
        typer.echo(context.get_help(), nl=False)
