"""The options that mean the same in every verb."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = [
    "Adaptive",
    "Elements",
    "Exposure",
    "FormFactors",
    "Gather",
    "Json",
    "LightSamples",
    "Patches",
    "SceneFile",
    "Solver",
]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).", show_default=False)]

Exposure = Annotated[
    float | None,
    typer.Option(
        "--exposure",
        metavar="FACTOR",
        help="Display value of 1 cd/m²; without it the scene's white becomes 0.8.",
        show_default=False,
    ),
]

Json = Annotated[bool, typer.Option("--json", help="Print the result on stdout as JSON.")]

Elements = Annotated[
    int | None,
    typer.Option(
        "--elements", metavar="N", help="About how many elements radiosity cuts surfaces into (6000)."
    ),
]

Patches = Annotated[
    int | None,
    typer.Option(
        "--patches", metavar="N", help="About how many patches these make, which send light on (as many)."
    ),
]

Adaptive = Annotated[
    float | None,
    typer.Option(
        "--adaptive",
        metavar="F",
        help="Cut elements again about which direct light differs by more than this fraction (never).",
    ),
]

FormFactors = Annotated[
    str | None,
    typer.Option(
        "--form-factors",
        metavar="HOW",
        help="How form factors are found: rays:N, hemicube:N, scanline:N, area:N (rays:1024).",
    ),
]

Solver = Annotated[
    str | None,
    typer.Option(
        "--solver",
        metavar="NAME",
        help="How radiosity is solved: bicgstab, gauss-seidel, gauss, progressive (bicgstab).",
    ),
]

LightSamples = Annotated[
    int | None,
    typer.Option(
        "--light-samples", metavar="N", help="At how many places of an element each lamp is asked (64)."
    ),
]

Gather = Annotated[
    str | None,
    typer.Option(
        "--gather",
        metavar="HOW",
        help="What a pixel makes of radiosity: none shows it, direct asks lamps again, full looks around (none).",
    ),
]
