"""`illuminant new`: a commented scene to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["new"]


def new(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="The scene file to write.", show_default=False)
    ],
) -> None:
    """Write a commented starter scene; an existing file is never overwritten.

    \b
    Example:
      illuminant new room.toml
    """
    from illuminant.cli.report import note
    from illuminant.new import write_starter

    write_starter(file)
    note(f"{file} is written; make an image of it with: illuminant render {file}")
