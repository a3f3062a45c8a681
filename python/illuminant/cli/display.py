"""`illuminant display`: a finished image becomes what a display is sent."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.look import asked_look
from illuminant.cli.options import (
    Assume,
    Bits,
    DisplayName,
    DitherName,
    Exposure,
    GamutName,
    Json,
    Pipeline,
    ToneName,
    Transfer,
)

__all__ = ["display"]


def display(
    image: Annotated[
        Path, typer.Argument(metavar="IN", help="Image (.exr), or a picture (.png).", show_default=False)
    ],
    output: Annotated[
        Path,
        typer.Argument(
            metavar="OUT", help="Picture to be written (.png, or .rle for run lengths).", show_default=False
        ),
    ],
    name: DisplayName = None,
    exposure: Exposure = None,
    absolute: Annotated[
        bool,
        typer.Option(
            "--absolute", help="Show luminances as they are: a cd/m² of the image is one on the display."
        ),
    ] = False,
    transfer: Transfer = None,
    tone: ToneName = "none",
    gamut: GamutName = None,
    dither: DitherName = "none",
    bits: Bits = 8,
    seed: Annotated[
        int, typer.Option("--seed", metavar="N", help="Of the random dither (0).", show_default=False)
    ] = 0,
    pipeline: Pipeline = "ideal",
    ocio: Annotated[
        str | None,
        typer.Option(
            "--ocio",
            metavar="CONFIG",
            help="OpenColorIO config that goes from scene to display, in place of --tone, --gamut and --transfer.",
            show_default=False,
        ),
    ] = None,
    ocio_display: Annotated[
        str | None, typer.Option("--ocio-display", metavar="NAME", help="Display of the config (its first).")
    ] = None,
    view: Annotated[
        str | None, typer.Option("--view", metavar="NAME", help="View of that display (its first).")
    ] = None,
    assume: Assume = None,
    json: Json = False,
) -> None:
    """Show an image on a display: exposure, primaries, tone, gamut, transfer, dither, bits.

    An EXR holds absolute colour; without --exposure its scene's white becomes 0.8. A PNG is a picture for one display,
    and looks the same on the other: white is shown as white, and every colour beside it as it was.

    \b
    Examples:
      illuminant display room.exr room.png --display 'Display P3' --bits 10
      illuminant display room.exr room.png --gamut clamp --dither blue-noise
      illuminant display left.png right.png --display monitor.toml
    """
    from dataclasses import replace

    from illuminant.cli.report import emit_json, note
    from illuminant.display.dither import quantise
    from illuminant.display.ocio import Config
    from illuminant.display.picture import check_name
    from illuminant.errors import UsageError
    from illuminant.image import RELATIVE, UNIT, Image
    from illuminant.output import check

    check(check_name(output))
    if absolute and exposure is not None:
        raise UsageError("--absolute shows luminances as they are: it goes without --exposure.")
    config = None
    if ocio is not None:
        if transfer or gamut or tone != "none" or pipeline != "ideal":
            raise UsageError(f"--ocio {ocio}: goes without --transfer, --tone, --gamut and --pipeline.")
        config = Config(ocio)
        ocio_display, view = config.chosen(ocio_display, view)
        found = config.described(ocio_display, view)
        if name is None and found is None:
            raise UsageError(
                f"--ocio-display {ocio_display}: say what it is with --display (a name, .toml or .icc)."
            )
        name = name or (found.name if found else None)
    elif ocio_display or view:
        raise UsageError("--ocio-display and --view go with --ocio.")
    look = asked_look(name, exposure, transfer, tone, gamut, dither, bits, seed, pipeline)
    opened = Image.open(image, assume)
    chosen = False
    if absolute:
        if opened.unit != UNIT:
            raise UsageError(
                f"{image} is {RELATIVE}: its luminances are not known, so --absolute cannot show them."
            )
        exposure = 1.0 / look.target.shown_white
    elif exposure is None and opened.exposure is None:
        exposure, chosen = opened.auto_exposure(), True
    shown = opened.shown(look, exposure=exposure)
    if config is not None and ocio_display and view:
        values = config.values(opened.xyz, shown.exposure, ocio_display, view)
        codes = quantise(values, bits, dither, seed)
        shown = replace(shown, picture=replace(shown.picture, codes=codes), negative=0.0, above=0.0)
        shown.picture.text["OpenColorIO"] = f"{ocio}: {ocio_display}, {view}"
    shown.picture.save(output)
    facts = {
        "file": output,
        "display": look.target.name,
        "exposure": shown.exposure,
        "chromaticity_outside": shown.negative,
        "too_bright": shown.above,
        "not_finite": shown.not_finite,
        "bits": bits,
        "look": look.to_dict(),
    }
    if json:
        emit_json(facts)
        return
    note(f"{output}: {shown.picture.width}x{shown.picture.height}, {bits} bits, for {look.target.name}")
    if output.suffix.lower() == ".rle":
        from illuminant.display.run_length import compression

        note(
            f"Run lengths take {100 * (1 - compression(output.read_bytes()).reduction):.0f} % of the pixels' bytes."
        )
    if chosen:
        note(f"White is shown as 0.8; --exposure {shown.exposure:g} repeats it.")
    if shown.outside >= 0.0005:
        note(
            f"{100 * shown.negative:.1f} % of the pixels have a chromaticity outside the gamut, "
            f"{100 * shown.above:.1f} % are too bright: moved by {look.method}."
        )
    if shown.not_finite:
        note(f"{shown.not_finite:,} pixels are no numbers, and black.")
