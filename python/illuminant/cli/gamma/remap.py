"""`illuminant gamma remap`: a picture made for one display, mapped to another from its stored codes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from illuminant.cli.options import Assume, Json

__all__ = ["remap"]


def remap(
    picture: Annotated[Path, typer.Argument(metavar="IN", help="Picture (.png).", show_default=False)],
    output: Annotated[
        Path,
        typer.Argument(metavar="OUT", help="The picture for the other display (.png).", show_default=False),
    ],
    target: Annotated[
        str,
        typer.Option(
            "--to", metavar="DISPLAY", help="For which display: a name, .toml or .icc.", show_default=False
        ),
    ],
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="DISPLAY",
            help="For which it was made, whatever its file says (what it says).",
            show_default=False,
        ),
    ] = None,
    bits: Annotated[
        int | None,
        typer.Option("--bits", metavar="N", help="Bits of the result (as many).", show_default=False),
    ] = None,
    match: Annotated[
        str, typer.Option("--match", metavar="HOW", help="relative (white to white) or absolute (cd/m²).")
    ] = "relative",
    assume: Assume = None,
    json: Json = False,
) -> None:
    """Map a picture from one display to another, so that it looks the same, and say what was lost.

    The loss is the colour difference from what the first display showed. The picture is that of
    `illuminant display IN OUT --display DISPLAY --gamut clamp`, which has other ways with colours out of gamut.

    \b
    Example:
      illuminant gamma remap old.png new.png --from "book NTSC" --to sRGB
      illuminant gamma remap photo.png wall.png --to wall.toml --bits 10
    """
    from illuminant import output as files
    from illuminant.cli.report import emit_json, note
    from illuminant.display.displays import named
    from illuminant.display.gamma.remapping import loss
    from illuminant.display.gamma.remapping import remap as mapped
    from illuminant.display.picture import Picture
    from illuminant.display.video.frame_buffer import OUTDATED
    from illuminant.errors import UsageError

    if output.suffix.lower() != ".png":
        raise UsageError(f"{output}: a picture is saved as .png.")
    files.check(output)
    goal = named(target)
    found = Picture.open(picture, assume=assume or source)
    origin = found.display if source is None else named(source)
    out_bits = found.bits if bits is None else bits
    how: Any = match
    codes, clamped = mapped(found.codes, origin, goal, bits=found.bits, out_bits=out_bits, match=how)
    lost = loss(found.codes, codes, origin, goal, bits=found.bits, out_bits=out_bits, match=how)
    # What the file says of the scene stays true; how its light became codes, and for which display, does not.
    text = {key: value for key, value in found.text.items() if goal == found.display or key not in OUTDATED}
    Picture(codes, goal, out_bits, text).save(output)
    if json:
        emit_json(
            {
                "from": origin.name,
                "to": goal.name,
                "bits": out_bits,
                "mean": lost.mean,
                "max": lost.largest,
                "levels": {"before": lost.levels_before, "after": lost.levels},
                "colours": {"before": lost.colours_before, "after": lost.colours},
                "clamped": clamped,
            }
        )
        return
    note(f"{output}: {origin.name} to {goal.name}, {out_bits} bits")
    typer.echo(f"ΔE00             mean {lost.mean:.3f}, max {lost.largest:.2f}")
    before, after = lost.levels_before, lost.levels
    for name, old, new in zip(("red", "green", "blue"), before, after, strict=True):
        typer.echo(f"codes of {name:<7} {old} became {new}")
    typer.echo(f"colours          {lost.colours_before} became {lost.colours}")
    typer.echo(f"clamped          {100 * clamped:.2f} % of pixels")
