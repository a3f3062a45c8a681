"""`illuminant video scope`: a waveform monitor and a vectorscope."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Assume
from illuminant.cli.video.argument import Bands, Picture

__all__ = ["scope"]


def scope(
    picture: Picture,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="Plot (.png or .svg).", show_default=False)
    ],
    line: Annotated[
        int | None,
        typer.Option("--line", metavar="N", help="Row of the picture, from 0 (all).", show_default=False),
    ] = None,
    kind: Annotated[
        str, typer.Option("--kind", metavar="NAME", help="waveform, luminance or vectorscope.")
    ] = "waveform",
    bars: Annotated[
        float, typer.Option("--bars", metavar="PERCENT", help="Level of the bars whose targets are drawn.")
    ] = 75.0,
    bandwidth: Bands = None,
    assume: Assume = None,
) -> None:
    """Show the composite signal of a picture, of one line or of all, as instruments do.

    The waveform monitor has IRE on time, with or without colour (luminance). The
    vectorscope has U and V, with targets for the 75 % bars.

    \b
    Example:
      illuminant video scope room.png -o line.png --line 120
      illuminant video scope room.png -o hues.png --kind vectorscope
    """
    from illuminant import plots
    from illuminant.cli.report import note
    from illuminant.cli.video import argument
    from illuminant.display.video import frame_buffer, transmission
    from illuminant.display.video.composite import encode
    from illuminant.errors import UsageError
    from illuminant.plots import style

    if kind not in ("waveform", "luminance", "vectorscope"):
        raise UsageError(f"--kind {kind}: expected waveform, luminance or vectorscope.")
    if not 0.0 < bars <= 100.0:
        raise UsageError(f"--bars {bars:g}: expected a percentage above 0, up to 100.")
    band = argument.bandwidth(bandwidth)
    style.check_format(output)
    values = frame_buffer.opened(picture, assume).values
    if line is not None and not 0 <= line < len(values):
        raise UsageError(f"--line {line}: {picture} has rows 0 to {len(values) - 1}.")
    signal = encode(transmission.on_lines(values), bandwidth=band)
    if kind == "vectorscope":
        figure = plots.vectorscope(signal, line, bars=bars / 100.0)
    else:
        figure = plots.waveform(signal, line, show="flat" if kind == "waveform" else kind)
    style.save(figure, output)
    note(f"{output}: {kind} of {'all lines' if line is None else f'line {line}'}")
