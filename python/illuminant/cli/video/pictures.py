"""`illuminant video monochrome`, `safe` and `components`: a picture seen in another way."""

from __future__ import annotations

from typing import Annotated

import typer

from illuminant.cli.options import Assume
from illuminant.cli.video.argument import Out, Picture

__all__ = ["components", "monochrome", "safe"]


def monochrome(picture: Picture, out: Out, assume: Assume = None) -> None:
    """Write what a black and white set shows, and say which edges of colour it loses.

    \b
    Example:
      illuminant video monochrome room.png grey.png
    """
    from illuminant.cli.report import note, warning
    from illuminant.display.video import black_and_white, frame_buffer

    frame_buffer.check_png(out)
    buffer = frame_buffer.opened(picture, assume)
    grey = black_and_white.preview(buffer.values)
    frame_buffer.with_values(buffer, grey, "luminance Y of NTSC").save(out)
    note(f"{out}: 0.299 R + 0.587 G + 0.114 B")
    lost = black_and_white.isoluminant(buffer.values)
    if lost.any():
        warning(
            f"{100 * lost.mean():.2g} % of the pixels lie at edges between colours that differ by ΔE00 20 or more "
            "and are one in black and white; check --measure isoluminant -o MAP.png shows them."
        )


def safe(
    picture: Picture,
    out: Out,
    standard: Annotated[
        str,
        typer.Option("--standard", metavar="NAME", help="RP 27.3 (90 and 80 %) or ST 2046-1 (93 and 90 %)."),
    ] = "RP 27.3",
    assume: Assume = None,
) -> None:
    """Draw safe action and safe title over a picture, in black or white, whichever is seen.

    On a plain field they are the pattern safe-areas.

    \b
    Example:
      illuminant video safe titles.png framed.png
      illuminant video safe titles.png framed.png --standard "ST 2046-1"
    """
    from illuminant.cli.report import note
    from illuminant.display.patterns import safe_areas
    from illuminant.display.video import frame_buffer

    frame_buffer.check_png(out)
    buffer = frame_buffer.opened(picture, assume)
    values = buffer.values
    drawn = safe_areas.overlay(values, standard=standard)
    frame_buffer.with_values(buffer, drawn, f"safe action and safe title, {standard}").save(out)
    height, width = values.shape[:2]
    parts = safe_areas.fractions(standard)
    action, title = (safe_areas.rectangle(width, height, part) for part in parts)
    note(f"{out}: safe action {_span(action)}, safe title {_span(title)}")


def _span(area: tuple[int, int, int, int]) -> str:
    left, top, right, bottom = area
    return f"{left},{top} to {right - 1},{bottom - 1}"


def components(
    picture: Picture,
    out: Out,
    bands: Annotated[
        bool,
        typer.Option("--bands", help="Instead the picture in grey through 4.2, 1.3 and 0.5 MHz."),
    ] = False,
    assume: Assume = None,
) -> None:
    """Write four pictures on a sheet: the original, and its parts in Y, in I and in Q.

    The parts in I and Q are shown on a grey of one half.

    \b
    Example:
      illuminant video components room.png yiq.png
      illuminant video components room.png bands.png --bands
    """
    import numpy as np

    from illuminant.cli.report import note
    from illuminant.display.video import black_and_white, frame_buffer, transmission
    from illuminant.display.video.standard import BANDWIDTH

    frame_buffer.check_png(out)
    buffer = frame_buffer.opened(picture, assume)
    values = buffer.values
    if bands:
        grey = black_and_white.preview(values)
        passed = [transmission.band_limited(grey, mhz) for mhz in (BANDWIDTH.y, BANDWIDTH.i, BANDWIDTH.q)]
        parts, what = [grey, *passed], "grey, 4.2, 1.3 and 0.5 MHz"
    else:
        y, i, q = transmission.components(values)
        parts, what = [values, y, 0.5 + i, 0.5 + q], "original, Y, I and Q"
    sheet = np.concatenate([np.concatenate(parts[:2], axis=1), np.concatenate(parts[2:], axis=1)])
    frame_buffer.with_values(buffer, sheet, what).save(out)
    note(f"{out}: {what}, from the upper left")
