"""Arguments that the verbs of `illuminant video` share, and how their words are read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.display.video.standard import Bandwidth

__all__ = ["Bands", "Correct", "Out", "Picture", "bandwidth"]

Picture = Annotated[Path, typer.Argument(metavar="IN", help="Picture (.png).", show_default=False)]
Out = Annotated[Path, typer.Argument(metavar="OUT", help="Picture to be written (.png).", show_default=False)]
Bands = Annotated[
    str | None,
    typer.Option("--bandwidth", metavar="Y,I,Q", help="Bandwidths in MHz (4.2,1.3,0.5).", show_default=False),
]
Correct = Annotated[
    bool,
    typer.Option("--correct", help="Take the colours of the file to NTSC's primaries first, and back after."),
]


def bandwidth(text: str | None) -> Bandwidth:
    """Three numbers with commas between them; None: those of the standard.

    Raises:
        UsageError: anything else.

    Example:
        >>> bandwidth("4.2,1,0.5").i
        1.0
        >>> bandwidth("4.2")
        Traceback (most recent call last):
        illuminant.errors.UsageError: --bandwidth 4.2: expected three numbers in MHz, such as 4.2,1.3,0.5.
    """
    from illuminant.display.video.standard import BANDWIDTH, Bandwidth

    if text is None:
        return BANDWIDTH
    return Bandwidth(*numbers(text, "--bandwidth", "three numbers in MHz, such as 4.2,1.3,0.5", count=3))
