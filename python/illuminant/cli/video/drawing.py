"""`illuminant video wedges` and `gamut`: figures that need no picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["gamut", "wedges"]


def wedges(
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="Picture (.png).", show_default=False)
    ],
    size: Annotated[str, typer.Option("--size", metavar="WxH", help="Pixels.")] = "640x480",
    cycles: Annotated[
        str | None,
        typer.Option(
            "--cycles",
            metavar="A,B",
            help="Cycles in the width at the top and at the bottom (20, and half the width up to 320).",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Draw resolving wedges in Y, I and Q, whose stripes draw together downwards.

    Sent through `video transmit`, Q merges to grey first, then I, then Y.

    \b
    Example:
      illuminant video wedges -o wedges.png
      illuminant video transmit wedges.png sent.png
    """
    from illuminant.cli.report import note
    from illuminant.cli.video.argument import size_of
    from illuminant.display.picture import Picture
    from illuminant.display.video import frame_buffer
    from illuminant.display.video import wedges as drawn
    from illuminant.errors import UsageError

    width, height = size_of(size)
    ends = (20.0, min(320.0, width / 2.0))
    if cycles is not None:
        try:
            first, last = (float(part) for part in cycles.split(","))
        except ValueError:
            raise UsageError(f"--cycles {cycles}: expected two numbers, such as 20,320.") from None
        ends = (first, last)
    frame_buffer.check_png(output)
    image = drawn.wedges(width, height, coarsest=ends[0], finest=ends[1])
    text = {"Description": "resolving wedges in Y, I and Q"}
    Picture.of_values(image, "NTSC 1953 D65", text=text).save(output)
    note(f"{output}: wedges in Y, I and Q, {ends[0]:g} to {ends[1]:g} cycles in the width")


def gamut(
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="Plot (.png or .svg).", show_default=False)
    ],
) -> None:
    """Plot the cube of RGB in Y I Q, with the colours marked that NTSC cannot carry.

    \b
    Example:
      illuminant video gamut -o gamut.png
    """
    from illuminant import plots
    from illuminant.cli.report import note
    from illuminant.display.video import cube
    from illuminant.plots import style

    style.check_format(output)
    style.save(plots.yiq_gamut(), output)
    names = [corner.name for corner in cube.corners() if corner.hot]
    note(f"{output}: hot corners are {', '.join(names[:-1])} and {names[-1]}")
