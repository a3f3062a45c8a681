"""`illuminant video check`: hot colours, lost detail, and what lies outside the safe areas."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.options import Assume, Json
from illuminant.cli.video.argument import Bands, Picture
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.video.legality import Limits

    Float64 = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = ["check"]


def check(
    picture: Picture,
    limit: Annotated[
        float | None,
        typer.Option(
            "--max",
            metavar="PERCENT",
            help="End with 1 if more of the pixels fail the check named by --measure.",
            show_default=False,
        ),
    ] = None,
    measure: Annotated[
        str,
        typer.Option(
            "--measure",
            metavar="NAME",
            help="hot, fine, chroma, q-axis, cross-colour, isoluminant, action or title.",
        ),
    ] = "hot",
    ire: Annotated[
        str,
        typer.Option("--limits", metavar="LOW,HIGH", help="Bounds of the signal in IRE."),
    ] = "-20,120",
    chroma: Annotated[
        float | None,
        typer.Option("--chroma", metavar="IRE", help="Bound on the amplitude of colour.", show_default=False),
    ] = None,
    threshold: Annotated[
        float,
        typer.Option("--threshold", metavar="F", help="Loss from which detail counts, in parts of white."),
    ] = 0.1,
    bandwidth: Bands = None,
    marked: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Write the picture in grey with what fails in red (.png).",
            show_default=False,
        ),
    ] = None,
    repair: Annotated[
        Path | None,
        typer.Option(
            "--repair",
            metavar="FILE",
            help="Write the picture with hot colours desaturated until legal (.png).",
            show_default=False,
        ),
    ] = None,
    assume: Assume = None,
    json: Json = False,
) -> None:
    """Say what of a picture NTSC cannot carry, in percent of its pixels.

    Hot colours leave the bounds of the composite signal. Fine luminance, and chroma
    above all near the Q axis, is lost to the bandwidths; cross-colour will shimmer.
    Isoluminant colours meet and are one in black and white. Of the edges in the
    picture, action and title count those outside the safe areas.

    \b
    Example:
      illuminant video check room.png
      illuminant video check room.png --max 0 --repair legal.png
    """
    from illuminant.cli.report import emit_json, note, sentence
    from illuminant.cli.video import argument
    from illuminant.display.patterns import safe_areas
    from illuminant.display.video import black_and_white, frame_buffer, hazards, legality
    from illuminant.errors import UsageError

    names = [*(name.replace(" ", "-") for name in hazards.HAZARDS), "isoluminant", "action", "title"]
    if measure not in names:
        raise UsageError(f"--measure {measure}: expected {', '.join(names[:-1])} or {names[-1]}.")
    if limit is not None and not 0.0 <= limit <= 100.0:
        raise UsageError(f"--max {limit:g}: expected a percentage from 0 to 100.")
    bounds = _limits(ire, chroma)
    band = argument.bandwidth(bandwidth)
    for path in (marked, repair):
        if path is not None:
            frame_buffer.check_png(path)
    buffer = frame_buffer.opened(picture, assume)
    values = buffer.values
    found = hazards.hazards(values, threshold=threshold, limits=bounds, bandwidth=band)
    masks = {name.replace(" ", "-"): mask for name, mask in found.items()}
    masks["isoluminant"] = black_and_white.isoluminant(values)
    edges = safe_areas.detail(values, threshold)
    percent = {name: 100.0 * float(mask.mean()) for name, mask in masks.items()}
    percent["action"] = 100.0 * safe_areas.outside(edges, safe_areas.ACTION)
    percent["title"] = 100.0 * safe_areas.outside(edges, safe_areas.TITLE)
    low, high = legality.composite_range(values)
    facts = {"percent": percent, "lowest_ire": float(low.min()), "highest_ire": float(high.max())}
    if json:
        emit_json(facts)
    else:
        typer.echo(f"signal {low.min():.1f} to {high.max():.1f} IRE (flat colours)")
        words = {name.replace(" ", "-"): text for name, text in hazards.HAZARDS.items()} | {
            "isoluminant": "colours that meet and are one in black and white",
            "action": "of the edges lie outside safe action",
            "title": "of the edges lie outside safe title",
        }
        for name, text in words.items():
            typer.echo(f"{percent[name]:6.2f} %  {name:<13}{text}")
    if marked is not None:
        shown = _marked(values, measure, masks, edges)
        frame_buffer.with_values(buffer, shown, f"in red: {measure}").save(marked)
        note(f"{marked}: in red what fails as {measure}")
    if repair is not None:
        # Half a step of 8 bits moves the signal by up to 0.4 IRE.
        legal = legality.repaired(values, bounds, margin_ire=0.5)
        frame_buffer.with_values(buffer, legal, "hot colours desaturated").save(repair)
        note(f"{repair}: {percent['hot']:.2f} % of the pixels desaturated")
    if limit is not None and percent[measure] > limit:
        sentence("Unfit", f"{measure} {percent[measure]:.3g} % is above {limit:g} %.")
        raise typer.Exit(1)


def _limits(text: str, chroma: float | None) -> Limits:
    from illuminant.display.video.legality import Limits

    low, high = numbers(text, "--limits", "two levels in IRE, such as -20,120", count=2)
    return Limits(low, high, chroma)


def _marked(values: Float64, measure: str, masks: dict[str, Mask], edges: Mask) -> Float64:
    """The picture in grey, darker, with what fails in red."""
    from illuminant.display.patterns import safe_areas
    from illuminant.display.video import black_and_white

    height, width = values.shape[:2]
    if measure in ("action", "title"):
        part = safe_areas.ACTION if measure == "action" else safe_areas.TITLE
        mask = edges & ~safe_areas.inside(width, height, part)
    else:
        mask = masks[measure]
    shown = 0.7 * black_and_white.preview(values)
    shown[mask] = (1.0, 0.1, 0.1)
    return shown
