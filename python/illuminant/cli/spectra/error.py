"""`illuminant spectra error`: what spectral samplings cost in colour in a scene."""

from __future__ import annotations

from typing import Annotated

import typer

from illuminant.cli.options import AllowOutside, Json, SceneFile

__all__ = ["error"]


def error(
    scene: SceneFile,
    sampling: Annotated[
        list[str] | None,
        typer.Option(
            "--sampling",
            metavar="NAME",
            help="A spectral sampling; may stand several times (the scene's own, else fitted:8).",
            show_default=False,
        ),
    ] = None,
    allow_outside: AllowOutside = False,
    json: Json = False,
) -> None:
    """Say what a spectral sampling costs in colour in a scene: ΔE00 against 1 nm.

    A few paths are followed through the scene at every nm and in the sampling; a fit has seen other paths. Mean, 95th
    percentile and maximum are over pixels, and the worst is named by its lamp and by the material that the camera sees.
    Light that a prism has dispersed has wavelengths of its own, and is left out.

    \b
    Example:
      illuminant spectra error room.toml
      illuminant spectra error room.toml --sampling rgb --sampling fitted:12
    """
    from illuminant.cli.report import emit_json, warning
    from illuminant.job import Job

    rows = []
    wanted: list[str | None] = [*sampling] if sampling else [None]
    for name in wanted:
        job = Job(scene, allow_outside=allow_outside, sampling=name)
        for text in job.warnings():
            warning(text)
        wavelengths = [float(w) for w in job.core_render.wavelengths()]
        rows.append(
            {"sampling": job.settings.sampling, **job.spectral_error(), "wavelengths_nm": wavelengths}
        )
    if json:
        emit_json(rows)
        return
    width = max(len(row["sampling"]) for row in rows)
    typer.echo(f"{'':{width}}   mean    p95    max  worst")
    for row in rows:
        if not row["judged"]:
            typer.echo(
                f"{row['sampling']:<{width}}  nothing to judge: the image has no light, or only dispersed light"
            )
            continue
        worst = f"{row['material'] or 'surroundings'} under {row['lamp']}" if row["max"] > 0 else "none"
        typer.echo(
            f"{row['sampling']:<{width}} {row['mean']:6.3f} {row['p95']:6.3f} {row['max']:6.3f}  {worst}"
        )
