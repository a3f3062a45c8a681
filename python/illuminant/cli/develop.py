"""`illuminant develop`: the same image under another observer, other lamps or other powers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.look import asked_look
from illuminant.cli.options import Assume, Bits, DisplayName, DitherName, GamutName, Json, ToneName, Transfer

if TYPE_CHECKING:
    from illuminant.image import Image, Saved

__all__ = ["develop"]


def develop(
    image: Annotated[
        Path,
        typer.Argument(metavar="IN", help="Image that keeps lamps or spectra (.exr).", show_default=False),
    ],
    output: Annotated[
        Path,
        typer.Argument(metavar="OUT", help="Image to be written (.exr or .png).", show_default=False),
    ],
    observer: Annotated[
        str | None,
        typer.Option(
            "--observer",
            metavar="WHO",
            help="Who looks: 2 or 10 degrees, or a CSV file of a camera's curves (2).",
            show_default=False,
        ),
    ] = None,
    matrix: Annotated[
        str,
        typer.Option(
            "--matrix",
            metavar="HOW",
            help="How a camera's RGB becomes XYZ: fit, balance (white alone), or a CSV file (fit).",
            show_default=False,
        ),
    ] = "fit",
    lamp: Annotated[
        list[str] | None,
        typer.Option(
            "--lamp",
            metavar="NAME=SPECTRUM",
            help="Another spectrum for a lamp: a name of the library, 2856K, or a file.",
            show_default=False,
        ),
    ] = None,
    power: Annotated[
        list[str] | None,
        typer.Option(
            "--power",
            metavar="NAME=FACTOR",
            help="Another power for a lamp; 0 switches it off.",
            show_default=False,
        ),
    ] = None,
    regular: Annotated[
        float | None,
        typer.Option(
            "--regular",
            metavar="STEP",
            help="Write spectra on a regular grid of so many nm, for other readers.",
            show_default=False,
        ),
    ] = None,
    exposure: Annotated[
        float | None,
        typer.Option(
            "--exposure",
            metavar="FACTOR",
            help="Display value of 1 cd/m² (that of IN, so that both compare).",
            show_default=False,
        ),
    ] = None,
    display: DisplayName = "sRGB",
    transfer: Transfer = None,
    tone: ToneName = "none",
    gamut: GamutName = None,
    dither: DitherName = "none",
    bits: Bits = 8,
    rgb: Annotated[
        str | None,
        typer.Option(
            "--rgb",
            metavar="SYSTEM",
            help="RGB system of an EXR: sRGB, Rec.2020, ... (XYZ).",
            show_default=False,
        ),
    ] = None,
    seed: Annotated[
        int, typer.Option("--seed", metavar="N", help="Of the random dither (0).", show_default=False)
    ] = 0,
    assume: Assume = None,
    json: Json = False,
) -> None:
    """Show an image under another observer, other lamps or other powers.

    Nothing is rendered again: IN was rendered with --lamps --keep-spectra. A new spectrum has the old one's luminance.
    --lamp and --power may be given many times.

    \b
    Examples:
      illuminant develop room.exr night.png --power window=0 --power desk=0.3
      illuminant develop room.exr tungsten.png --lamp window=A
      illuminant develop room.exr ten.exr --observer 10 --regular 10
    """
    from illuminant.cli.report import emit_json
    from illuminant.display import developing
    from illuminant.errors import UsageError
    from illuminant.image import Image, check_output

    check_output(output)
    if regular is not None and output.suffix.lower() != ".exr":
        raise UsageError(f"--regular {regular:g}: a PNG holds no spectra; name an .exr to be written.")
    look = asked_look(display, exposure, transfer, tone, gamut, dither, bits, seed)
    source = Image.open(image, assume)
    names = developing.lamps_of(source)
    lamps = dict(_pair("--lamp", word, names) for word in lamp or [])
    powers = {
        name: _factor(name, text) for name, text in (_pair("--power", word, names) for word in power or [])
    }
    made = developing.develop(
        source, observer=observer, matrix=matrix, lamps=lamps, power=powers, regular=regular, name=str(image)
    )
    saved = made.save(output, look, rgb=rgb)
    stages = made.settings.get("developed")
    before = source.settings.get("developed")
    done = stages[len(before or []) :] if isinstance(stages, list) else []
    if json:
        emit_json(_facts(source, made, saved, done))
    else:
        _say(saved, [line for stage in done for line in developing.described(stage)])


def _pair(option: str, word: str, names: list[str]) -> tuple[str, str]:
    """Name and value of NAME=VALUE; a name of a lamp may hold = itself."""
    from illuminant.errors import UsageError

    for name in names:
        if word.startswith(f"{name}="):
            return name, word[len(name) + 1 :]
    name, equals, value = word.partition("=")
    if not equals or not name or not value:
        known = f"; lamps are {', '.join(names)}" if names else ""
        raise UsageError(f"{option} {word}: expected a lamp and a value, such as {option} desk=0.5{known}.")
    return name, value


def _factor(name: str, text: str) -> float:
    from illuminant.errors import UsageError

    try:
        return float(text)
    except ValueError:
        raise UsageError(f"--power {name}={text}: expected a factor from 0 up, such as 0.5.") from None


def _facts(source: Image, made: Image, saved: Saved, done: list[Any]) -> dict[str, Any]:
    return {
        "file": saved.path,
        "exposure": saved.exposure,
        "outside": saved.outside,
        "white_before": source.white(),
        "white": made.white(),
        "developed": done,
        "settings": made.settings,
    }


def _say(saved: Saved, lines: list[str]) -> None:
    """The file, and what was done."""
    from illuminant.cli.report import note

    shown = f", exposure {saved.exposure:g}" if saved.exposure is not None else ""
    note(f"{saved.path}: {lines[0] if len(lines) == 1 else 'developed' if lines else 'as it was'}{shown}")
    for line in lines if len(lines) > 1 else []:
        note(f"  {line}")
    if saved.outside and saved.outside >= 0.0005:
        note(f"{100 * saved.outside:.1f} % of the pixels are outside the gamut or above white.")
