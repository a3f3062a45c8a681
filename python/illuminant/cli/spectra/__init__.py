"""`illuminant spectra`: the library of measured spectra, and spectra from files; one module for each verb.

A new verb is its module, and its line below.
"""

from __future__ import annotations

import typer

from illuminant.cli.spectra import compare, convert, error, listing, plot, show

__all__ = ["app"]

app = typer.Typer(no_args_is_help=False)
app.command("list", short_help="List the names of the library.")(listing.list_names)
app.command("show", short_help="Show what a spectrum is, and its values.")(show.show)
app.command("plot", short_help="Plot spectra, observers, chromaticities.")(plot.plot)
app.command("convert", short_help="Write a spectrum to a file of another kind.")(convert.convert)
app.command("error", short_help="Say what a sampling costs in a scene.")(error.error)
app.command("compare", short_help="Compare spectral samplings.")(compare.compare)


@app.callback(invoke_without_command=True)
def _start(context: typer.Context) -> None:
    """List, show, plot and convert measured spectra: those of the library, and those of files.

    \b
    Example:
      illuminant spectra show D65
      illuminant spectra plot D65 FL11 --normalise 560 -o lamps.png
    """
    if context.invoked_subcommand is None:
        listing.list_names()
