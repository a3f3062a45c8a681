"""`illuminant video gamut`: the cube of RGB as the signal carries it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["gamut"]


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
