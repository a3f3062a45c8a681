"""The options that mean the same in every verb."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = [
    "Adaptive",
    "AllowOutside",
    "Assume",
    "Bits",
    "DisplayName",
    "DitherName",
    "Elements",
    "Exposure",
    "FormFactors",
    "GamutName",
    "Gather",
    "Json",
    "LightSamples",
    "MemoryLimit",
    "Patches",
    "Pipeline",
    "SceneFile",
    "Solver",
    "ToneName",
    "Transfer",
]

AllowOutside = Annotated[
    bool,
    typer.Option(
        "--allow-outside",
        help="Let the scene name files outside its folder: only for scenes that you trust.",
    ),
]

MemoryLimit = Annotated[
    str | None,
    typer.Option(
        "--memory-limit",
        metavar="SIZE",
        help="Refuse the work if it would take more memory, such as 4GB or 500MB (what is free).",
        show_default=False,
    ),
]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).", show_default=False)]

Exposure = Annotated[
    float | None,
    typer.Option(
        "--exposure",
        metavar="FACTOR",
        help="Display value of 1 cd/m²; without it the scene's white becomes 0.8.",
        show_default=False,
    ),
]

DisplayName = Annotated[
    str | None,
    typer.Option(
        "--display",
        metavar="NAME",
        help="Display of a PNG: sRGB, 'Display P3', 'Rec.2020 PQ', ..., or a description .toml or .icc (sRGB).",
        show_default=False,
    ),
]

Transfer = Annotated[
    str | None,
    typer.Option(
        "--transfer",
        metavar="NAME",
        help="Response in place of the display's own: 'gamma 2.4', sRGB, BT.1886, PQ, HLG, linear.",
        show_default=False,
    ),
]

ToneName = Annotated[
    str,
    typer.Option(
        "--tone",
        metavar="NAME",
        help="Tone operator for high contrast: none, reinhard, filmic, filmic-hue (none).",
        show_default=False,
    ),
]

GamutName = Annotated[
    str | None,
    typer.Option(
        "--gamut",
        metavar="NAME",
        help="What becomes of colours that the display cannot show: clamp, scale, constant-intensity, "
        "constant-luminance, cook, oklab, oklab-adaptive, cam16, soft, scale-image (cook).",
        show_default=False,
    ),
]

DitherName = Annotated[
    str,
    typer.Option(
        "--dither",
        metavar="NAME",
        help="none, random, ordered-2, ordered-4, bayer-8, blue-noise, floyd-steinberg, dot-diffusion, ... (none).",
        show_default=False,
    ),
]

Bits = Annotated[
    int,
    typer.Option("--bits", metavar="N", help="Bits of a channel of a PNG, 1 to 16 (8).", show_default=False),
]

Pipeline = Annotated[
    str,
    typer.Option(
        "--pipeline",
        metavar="NAME",
        help="ideal, or traditional: linear light stored, gamma by a lookup table of 8 bits (figure 5.1).",
        show_default=False,
    ),
]

Assume = Annotated[
    str | None,
    typer.Option(
        "--assume",
        metavar="DISPLAY",
        help="Display (EXR: RGB system) of a file that does not say which its numbers are for.",
        show_default=False,
    ),
]

Json = Annotated[bool, typer.Option("--json", help="Print the result on stdout as JSON.")]

Elements = Annotated[
    int | None,
    typer.Option(
        "--elements", metavar="N", help="About how many elements radiosity cuts surfaces into (6000)."
    ),
]

Patches = Annotated[
    int | None,
    typer.Option(
        "--patches", metavar="N", help="About how many patches these make, which send light on (as many)."
    ),
]

Adaptive = Annotated[
    float | None,
    typer.Option(
        "--adaptive",
        metavar="F",
        help="Cut elements again about which direct light differs by more than this fraction (never).",
    ),
]

FormFactors = Annotated[
    str | None,
    typer.Option(
        "--form-factors",
        metavar="HOW",
        help="How form factors are found: rays:N, hemicube:N, scanline:N, area:N (rays:1024).",
    ),
]

Solver = Annotated[
    str | None,
    typer.Option(
        "--solver",
        metavar="NAME",
        help="How radiosity is solved: bicgstab, gauss-seidel, gauss, progressive (bicgstab).",
    ),
]

LightSamples = Annotated[
    int | None,
    typer.Option(
        "--light-samples", metavar="N", help="At how many places of an element each lamp is asked (64)."
    ),
]

Gather = Annotated[
    str | None,
    typer.Option(
        "--gather",
        metavar="HOW",
        help="What a pixel makes of radiosity: none shows it, direct asks lamps again, full looks around (none).",
    ),
]
