"""`illuminant spectra compare`: spectral samplings beside each other on reflectances under lamps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Json

if TYPE_CHECKING:
    from illuminant.sampling import Study

__all__ = ["compare"]


def compare(
    sampling: Annotated[
        list[str] | None,
        typer.Option(
            "--sampling",
            metavar="NAME",
            help="A spectral sampling; may stand several times (16 of them).",
            show_default=False,
        ),
    ] = None,
    lamp: Annotated[
        list[str] | None,
        typer.Option(
            "--lamp",
            metavar="NAME",
            help="A lamp; may stand several times (C, D65, A, FL2, FL11).",
            show_default=False,
        ),
    ] = None,
    reflectances: Annotated[
        str, typer.Option("--reflectances", metavar="GROUP", help="A group of the library.")
    ] = "ColorChecker",
    depth: Annotated[
        int, typer.Option("--depth", metavar="N", min=1, max=6, help="The most reflections of a product.")
    ] = 4,
    products: Annotated[
        int | None,
        typer.Option(
            "--products", metavar="N", min=1, help="Judge by at most so many (all).", show_default=False
        ),
    ] = None,
    together: Annotated[
        bool, typer.Option("--together", help="All lamps in one scene: one fit for all.")
    ] = False,
    lit: Annotated[
        bool, typer.Option("--lit", help="Every product lit to half the white, so that dark ones count.")
    ] = False,
    json: Json = False,
) -> None:
    """Compare spectral samplings: mean and maximum ΔE00 against 1 nm.

    Judged are all products of one to four reflectances of a chart, each beside a perfect diffuser under its lamp; a fit
    has looked at no more than 2,000 of them. The table is one of Markdown.

    \b
    Example:
      illuminant spectra compare
      illuminant spectra compare --sampling meyer --sampling fitted:8 --lamp FL11
    """
    from illuminant import sampling as room
    from illuminant.cli.report import emit_json

    studies = room.compare(
        sampling or room.SAMPLINGS,
        lamp or room.LAMPS,
        reflectances,
        depth=depth,
        products=products,
        together=together,
    )
    if json:
        emit_json([_facts(study) for study in studies])
        return
    lamps = list(studies[0].by_lamp)
    typer.echo("| sampling | " + " | ".join(lamps) + " |")
    typer.echo("| --- |" + " --- |" * len(lamps))
    for study in studies:
        typer.echo(f"| `{study.sampling}` | " + " | ".join(_cells(study, lit)) + " |")


def _cells(study: Study, lit: bool) -> list[str]:
    errors = [(error.lit if lit else error) or error for error in study.by_lamp.values()]
    return [f"{_shown(error.mean)} / {_shown(error.max)}" for error in errors]


def _shown(value: float) -> str:
    return f"{value:.3f}" if value < 1 else f"{value:.1f}"


def _facts(study: Study) -> dict[str, Any]:
    from dataclasses import asdict

    return asdict(study)
