"""`illuminant calibrate patterns`: a folder of patterns to step through, and a table for the readings."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["patterns"]


def patterns(
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="FOLDER", help="Where to write.", show_default=False),
    ],
    size: Annotated[str, typer.Option("--size", metavar="WxH", help="Pixels of the screen.")] = "1920x1080",
    bits: Annotated[int, typer.Option("--bits", metavar="N", help="Bits a channel.")] = 8,
    window: Annotated[
        float, typer.Option("--window", metavar="F", help="Side of the windows, of the screen's.")
    ] = 0.3,
    description: Annotated[
        Path | None,
        typer.Option(
            "--verify",
            metavar="FILE",
            help="The ColorChecker through this description (.toml), to verify it.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Write patterns with a page to step through them in a browser, and a table to fill in.

    Turn the profile of the display off while it is measured: a browser would use it.

    \b
    Example:
      illuminant calibrate patterns -o studio --size 2560x1440
      illuminant calibrate patterns -o check --verify studio.toml
    """
    from illuminant.cli.report import note
    from illuminant.display.calibration import session
    from illuminant.display.patterns.screen import Screen
    from illuminant.settings import size_of

    width, height = size_of(size)
    screen = Screen(width, height, bits)
    codes, about = None, {}
    if description is not None:
        from illuminant.display.calibration.description import chart_codes

        codes, about = chart_codes(description), {"chart": description.name}
    files = session.write(output, screen, codes=codes, window=window, about=about)
    note(f"{files[0]}: {len(files) - 2} patterns; open it in a browser and press f")
    note(f"{files[1]}: fill in the readings, or run `illuminant calibrate walk {files[1]}`")
