"""`illuminant calibrate guide`: the six steps of a calibration, and what must hold."""

from __future__ import annotations

import textwrap

import typer

from illuminant.cli.options import Json

__all__ = ["guide"]


def guide(json: Json = False) -> None:
    """Print the six steps of a calibration: what to do, patterns to show, and what must hold.

    \b
    Example:
      illuminant calibrate guide
    """
    from illuminant.cli.report import emit_json
    from illuminant.display.calibration.guide import STEPS

    if json:
        emit_json(
            [
                {
                    "title": step.title,
                    "todo": step.todo,
                    "patterns": step.patterns,
                    "passes": step.passes,
                    "modern": step.modern,
                }
                for step in STEPS
            ]
        )
        return
    for number, step in enumerate(STEPS, 1):
        typer.echo(f"{number}. {step.title}")
        for line in step.todo:
            _paragraph(line, "   ", "   ")
        _paragraph(f"without such knobs: {step.modern}", "   ", "   ")
        _paragraph(", ".join(step.patterns), "   patterns: ", "             ")
        for line in step.passes:
            _paragraph(line, "   passes:   ", "             ")
        typer.echo("")
    typer.echo("Patterns: `illuminant pattern NAME`, or all in a folder by `illuminant calibrate patterns`.")


def _paragraph(text: str, first: str, rest: str) -> None:
    typer.echo(textwrap.fill(text, 79, initial_indent=first, subsequent_indent=rest, break_on_hyphens=False))
