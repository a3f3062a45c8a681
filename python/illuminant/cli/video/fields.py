"""`illuminant video fields`: two pictures as the fields of a frame, and back."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Assume

__all__ = ["fields"]


def fields(
    first: Annotated[
        Path,
        typer.Argument(
            metavar="ODD", help="Picture of the first field; with --split: FRAME.", show_default=False
        ),
    ],
    second: Annotated[
        Path,
        typer.Argument(metavar="EVEN", help="Picture 1/60 s later; with --split: ODD.", show_default=False),
    ],
    third: Annotated[
        Path,
        typer.Argument(metavar="OUT", help="Frame to be written; with --split: EVEN.", show_default=False),
    ],
    split: Annotated[
        bool, typer.Option("--split", help="Write the two fields of a frame: FRAME ODD EVEN.")
    ] = False,
    full: Annotated[
        bool, typer.Option("--full", help="With --split: fields of full height, lines between filled in.")
    ] = False,
    assume: Assume = None,
) -> None:
    """Weave the odd lines of one picture and the even lines of the next into a frame.

    Lines count from 1 at the top. Code values come back bit for bit with --split.

    \b
    Example:
      illuminant video fields frame-000.png frame-001.png tape-000.png
      illuminant video fields --split tape-000.png odd.png even.png
    """
    from illuminant.cli.report import note
    from illuminant.display.picture import Picture
    from illuminant.display.video import frame_buffer, interlace
    from illuminant.errors import UsageError

    if full and not split:
        raise UsageError("--full goes with --split.")
    if split:
        for path in (second, third):
            frame_buffer.check_png(path)
        frame = frame_buffer.opened(first, assume)
        parts = interlace.split(frame.codes)
        for parity, (path, part) in enumerate(zip((second, third), parts, strict=True)):
            text = {"Description": f"{('odd', 'even')[parity]} lines of a frame"}
            field = Picture(part, frame.display, frame.bits, text)
            if full:
                filled = interlace.full_height(part, parity, frame.height) / frame.top
                field = Picture.of_values(filled, frame.display, frame.bits, text)
            field.save(path)
            note(f"{path}: {field.height} lines")
        return
    frame_buffer.check_png(third)
    odd, even = frame_buffer.opened(first, assume), frame_buffer.opened(second, assume)
    if (odd.display, odd.bits) != (even.display, even.bits):
        one, other = (f"{p.display.name} of {p.bits} bits" for p in (odd, even))
        raise UsageError(f"The fields of a frame are alike: {first} is {one}, and {second} is {other}.")
    woven = Picture(
        interlace.weave(odd.codes, even.codes), odd.display, odd.bits, {"Description": "two fields"}
    )
    woven.save(third)
    note(f"{third}: odd lines of {first}, even lines of {second}")
