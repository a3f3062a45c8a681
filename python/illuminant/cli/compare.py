"""`illuminant compare`: one scene by every technique and model."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from illuminant.cli.options import AllowOutside, Exposure, Json, MemoryLimit

__all__ = ["compare"]


def compare(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (.toml).", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Contact sheet, .png (SCENE-compare.png)."),
    ] = None,
    techniques: Annotated[
        str | None,
        typer.Option("--techniques", metavar="NAME,...", help="Only these techniques.", show_default=False),
    ] = None,
    illuminations: Annotated[
        str | None,
        typer.Option("--illuminations", metavar="NAME,...", help="Only these models.", show_default=False),
    ] = None,
    only: Annotated[
        str | None,
        typer.Option(
            "--only",
            metavar="TECHNIQUE:MODEL,...",
            help="Only these pairs, in this order.",
            show_default=False,
        ),
    ] = None,
    columns: Annotated[
        int | None,
        typer.Option(
            "--columns", metavar="N", help="Images in a row (a row for each technique).", show_default=False
        ),
    ] = None,
    captions: Annotated[
        str, typer.Option("--captions", metavar="WHAT", help="Under the images: numbers, difference, names.")
    ] = "numbers",
    sampling: Annotated[
        str | None, typer.Option("--sampling", metavar="NAME", help="How wavelengths are carried (fitted:8).")
    ] = None,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help="Samples of each pixel (64).")
    ] = None,
    size: Annotated[
        str | None, typer.Option("--size", metavar="WxH", help="Pixels, such as 320x180 (the camera's).")
    ] = None,
    depth: Annotated[
        int | None, typer.Option("--depth", metavar="N", help="Longest path in segments.", show_default=False)
    ] = None,
    exposure: Exposure = None,
    allow_outside: AllowOutside = False,
    memory_limit: MemoryLimit = None,
    json: Json = False,
) -> None:
    """Render a scene by all pairs of technique and illumination model that have a meaning, and lay them side by side.

    Energy is mean luminance; it, ΔE00 and FLIP are relative to path with general.

    \b
    Example:
      illuminant compare room.toml --size 320x240 --samples 32 -o sheet.png
      illuminant compare room.toml --only gouraud:phong,raytrace:whitted,path:general --columns 3 --captions names
    """
    import shlex

    from illuminant.cli.report import emit_json, note
    from illuminant.comparison import check_layout, check_sheet, save_sheet
    from illuminant.comparison import compare as run

    path = output or Path(f"{scene.stem}-compare.png")
    check_sheet(path)
    check_layout(columns, captions)
    options: dict[str, Any] = {"sampling": sampling, "samples": samples, "size": size, "depth": depth}
    found = run(
        scene,
        techniques=techniques.split(",") if techniques else None,
        illuminations=illuminations.split(",") if illuminations else None,
        only=only,
        on_start=None if json else lambda pair: note(f"{pair.technique} with {pair.illumination} …"),
        allow_outside=allow_outside,
        memory_limit=memory_limit,
        **options,
    )
    if json:
        emit_json([one.facts() for one in found])
    else:
        widest = max(10, *(len(one.pair.technique) for one in found))
        typer.echo(f"{'technique':<{widest}} illumination   seconds  energy   ΔE00   FLIP")
        for one in found:
            typer.echo(
                f"{one.pair.technique:<{widest}} {one.pair.illumination:<14} {one.seconds:7.2f} "
                f"{100 * one.energy:6.1f}% {one.delta_e:6.2f}  {one.flip:.3f}"
            )
    asked: dict[str, Any] = {
        "techniques": techniques,
        "illuminations": illuminations,
        "only": only,
        "columns": columns,
    }
    asked |= {"captions": captions if captions != "numbers" else None, **options, "exposure": exposure}
    words = [word for name, value in asked.items() if value is not None for word in (f"--{name}", str(value))]
    words += ["--allow-outside"] if allow_outside else []
    command = shlex.join(["illuminant", "compare", str(scene), *words])
    save_sheet(path, found, exposure, columns=columns, captions=captions, command=command)
    note(f"{path}: contact sheet")
