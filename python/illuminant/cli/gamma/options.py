"""Options of several verbs of `illuminant gamma`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["Bits", "Color", "Gamma", "InBits", "OutBits", "Picture", "Rounding"]

Gamma = Annotated[
    str,
    typer.Option("--gamma", metavar="G", help="γ of the monitor, or the name of a curve such as sRGB."),
]

InBits = Annotated[int, typer.Option("--in-bits", metavar="N", help="Bits of the image's codes.")]

OutBits = Annotated[int, typer.Option("--out-bits", metavar="N", help="Bits of the display's codes.")]

Rounding = Annotated[
    str, typer.Option("--rounding", metavar="HOW", help="How entries become whole: nearest or truncate.")
]

Bits = Annotated[str, typer.Option("--bits", metavar="A,B", help="Bits of the files that are compared.")]

Color = Annotated[str, typer.Option("--color", metavar="R,G,B", help="Linear RGB of the surface, 0 to 1.")]

Picture = Annotated[
    Path,
    typer.Option("-o", "--output", metavar="FILE", help="A .png or .svg.", show_default=False),
]
