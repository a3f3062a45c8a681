"""`illuminant radiosity solve`: a scene becomes a solution."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import (
    Adaptive,
    AllowOutside,
    Elements,
    FormFactors,
    Json,
    LightSamples,
    MemoryLimit,
    Patches,
    SceneFile,
    Solver,
)

__all__ = ["solve"]


def solve(
    scene: SceneFile,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="The solution (SCENE.solution).", show_default=False
        ),
    ] = None,
    technique: Annotated[
        str | None,
        typer.Option(
            "--technique",
            metavar="NAME",
            help="radiosity, or hybrid, which follows mirrors and glass too (the scene's, or radiosity).",
        ),
    ] = None,
    elements: Elements = None,
    patches: Patches = None,
    adaptive: Adaptive = None,
    form_factors: FormFactors = None,
    solver: Solver = None,
    light_samples: LightSamples = None,
    illumination: Annotated[
        str | None,
        typer.Option(
            "--illumination", metavar="NAME", help="What a surface does: general, bouknight (general)."
        ),
    ] = None,
    sampling: Annotated[
        str | None,
        typer.Option("--sampling", metavar="NAME", help="How wavelengths are carried (fitted:8)."),
    ] = None,
    threads: Annotated[
        int | None, typer.Option("--threads", metavar="N", help="Threads (all cores).")
    ] = None,
    allow_outside: AllowOutside = False,
    memory_limit: MemoryLimit = None,
    json: Json = False,
) -> None:
    """Solve for the light between the surfaces of a scene, and write the solution.

    By radiosity surfaces are diffusers of their reflectance, and what is transparent is left out.

    \b
    Examples:
      illuminant radiosity solve room.toml -o room.solution
      illuminant radiosity solve room.toml --elements 50000 --patches 5000 --adaptive 0.2
    """
    from illuminant import output as files
    from illuminant import radiosity
    from illuminant.cli.radiosity.report import closing, facts
    from illuminant.cli.report import emit_json, note
    from illuminant.errors import UsageError

    path = files.check(output or Path(scene.stem + ".solution"))
    if technique == "specular-radiosity":
        raise UsageError(
            "--technique specular-radiosity: it keeps radiance in all directions and is not written; use render."
        )
    found = radiosity.solve(
        scene,
        technique=technique,
        elements=elements,
        patches=patches,
        adaptive=adaptive,
        form_factors=form_factors,
        solver=solver,
        light_samples=light_samples,
        illumination=illumination,
        sampling=sampling,
        threads=threads,
        allow_outside=allow_outside,
        memory_limit=memory_limit,
    )
    found.save(path)
    if json:
        emit_json(facts(found) | {"file": path})
    else:
        note(closing(str(path), facts(found)))
