"""The options that mean the same in every verb."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["Exposure", "Json", "SceneFile"]

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
