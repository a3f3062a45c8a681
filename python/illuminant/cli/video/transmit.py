"""`illuminant video transmit`: a picture through the composite signal and back."""

from __future__ import annotations

from typing import Annotated

import typer

from illuminant.cli.options import Assume
from illuminant.cli.video.argument import Bands, Correct, Out, Picture

__all__ = ["transmit"]


def transmit(
    picture: Picture,
    out: Out,
    decoder: Annotated[
        str,
        typer.Option(
            "--decoder", metavar="NAME", help="How luminance and colour part: comb, notch, low-pass."
        ),
    ] = "comb",
    hue: Annotated[
        float, typer.Option("--hue", metavar="DEG", help="Hue control: turns all colours by degrees.")
    ] = 0.0,
    chroma: Annotated[
        float, typer.Option("--chroma", metavar="F", help="Chroma control: 0 is black and white, 1 right.")
    ] = 1.0,
    bandwidth: Bands = None,
    setup: Annotated[float, typer.Option("--setup", metavar="IRE", help="Level of black.")] = 7.5,
    lines: Annotated[
        int | None,
        typer.Option(
            "--lines", metavar="N", help="Scan lines, such as 485 (each row is one).", show_default=False
        ),
    ] = None,
    frame: Annotated[
        int,
        typer.Option("--frame", metavar="N", help="Number of the frame: dots crawl from one to the next."),
    ] = 0,
    correct: Correct = False,
    beside: Annotated[
        bool, typer.Option("--beside", help="Write the original to the left of what is received.")
    ] = False,
    assume: Assume = None,
) -> None:
    """Send a picture through NTSC: encode it, decode it, and write what a receiver shows.

    \b
    Example:
      illuminant video transmit room.png sent.png
      illuminant video transmit room.png sent.png --decoder notch --hue 10
    """
    from illuminant.cli.report import note
    from illuminant.cli.video import argument
    from illuminant.display.video import frame_buffer, transmission
    from illuminant.display.video.standard import Levels
    from illuminant.errors import UsageError

    band = argument.bandwidth(bandwidth)
    if lines is not None and not 2 <= lines <= 10_000:
        raise UsageError(f"--lines {lines}: expected 2 to 10000.")
    frame_buffer.check_png(out)
    buffer = frame_buffer.opened(picture, assume)
    original = buffer.values
    ntsc = "NTSC 1953 D65"
    sent = transmission.corrected(original, buffer.display, ntsc) if correct else original
    received = transmission.transmit(
        sent,
        decoder=decoder,
        hue_deg=hue,
        chroma=chroma,
        bandwidth=band,
        levels=Levels(setup=setup),
        lines=lines,
        frame=frame,
    )
    if correct:
        received = transmission.corrected(received.clip(0.0, 1.0), ntsc, buffer.display)
    lost = abs(received - original).mean()
    if beside:
        import numpy as np

        received = np.concatenate([original, received], axis=1)
    frame_buffer.with_values(buffer, received, f"sent through NTSC, decoder {decoder}").save(out)
    note(f"{out}: decoder {decoder}; code values differ by {100 * lost:.2g} % of white on average")
