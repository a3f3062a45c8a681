"""`illuminant calibrate`: adjust, measure and describe a display; one module for each verb.

A new verb is its module, and its line below.
"""

from __future__ import annotations

import typer

from illuminant.cli.calibrate import fit, guide, log, patterns, simulate, verify, walk

__all__ = ["app"]

app = typer.Typer(no_args_is_help=False)
app.command("guide", short_help="Print the six steps and what must hold.")(guide.guide)
app.command("patterns", short_help="Write patterns to step through.")(patterns.patterns)
app.command("walk", short_help="Ask for readings one after another.")(walk.walk)
app.command("fit", short_help="Describe a display by its readings.")(fit.fit)
app.command("verify", short_help="Judge a description by new readings.")(verify.verify)
app.command("log", short_help="Keep the record; say when to repeat.")(log.log)
app.command("simulate", short_help="Make readings of a simulated monitor.")(simulate.simulate)


@app.callback(invoke_without_command=True)
def _start(context: typer.Context) -> None:
    """Adjust a display, measure it, and describe it so that colours on it can be trusted.

    \b
    Example:
      illuminant calibrate guide
      illuminant calibrate patterns -o studio
      illuminant calibrate walk studio/readings.csv
      illuminant calibrate fit studio/readings.csv -o studio.toml --icc studio.icc
    """
    if context.invoked_subcommand is None:
        guide.guide(json=False)
