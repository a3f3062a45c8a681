"""`illuminant video`: what becomes of a picture on its way through NTSC; one module for what belongs together.

A new verb is its function, and its line below.
"""

from __future__ import annotations

import typer

from illuminant.cli.video import check, drawing, fields, pictures, scope, transmit

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True)
app.command("transmit", short_help="Send a picture through NTSC and back.")(transmit.transmit)
app.command("check", short_help="Find hot colours and lost detail.")(check.check)
app.command("scope", short_help="Waveform monitor and vectorscope.")(scope.scope)
app.command("fields", short_help="Weave two pictures into a frame, or split it.")(fields.fields)
app.command("monochrome", short_help="What a black and white set shows.")(pictures.monochrome)
app.command("safe", short_help="Draw safe action and safe title.")(pictures.safe)
app.command("components", short_help="A picture in Y, I and Q.")(pictures.components)
app.command("gamut", short_help="Plot the RGB cube in Y I Q.")(drawing.gamut)


@app.callback()
def _start() -> None:
    """NTSC video: transmission, hot colours, fields, safe areas, waveform and vectorscope.

    Pictures are PNG files, whose code values are taken as a frame buffer holds them.

    \b
    Example:
      illuminant video check room.png
      illuminant video transmit room.png sent.png
      illuminant video scope room.png -o line.png --line 120
    """
