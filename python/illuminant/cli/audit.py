"""`illuminant audit`: what becomes of the light that reaches a material, and which laws its model breaks."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.options import AllowOutside, Json
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.auditing import Audit

__all__ = ["audit"]


def audit(
    target: Annotated[
        str,
        typer.Argument(
            metavar="MATERIAL|SCENE",
            help="A material in words, a scene file, or FILE.toml#material.",
            show_default=False,
        ),
    ],
    illumination: Annotated[
        str, typer.Option("--illumination", metavar="NAME", help="The illumination model.")
    ] = "general",
    angles: Annotated[
        str | None,
        typer.Option(
            "--angles",
            metavar="DEG,...",
            help="Angles of incidence, 0 to 180; above 90 from inside.",
            show_default=False,
        ),
    ] = None,
    wavelengths: Annotated[
        str | None,
        typer.Option("--wavelengths", metavar="NM,...", help="Wavelengths, 380 to 780.", show_default=False),
    ] = None,
    draws: Annotated[
        int, typer.Option("--draws", metavar="N", help="Directions drawn for each angle.")
    ] = 20_000,
    plots: Annotated[
        Path | None,
        typer.Option("--plots", metavar="DIR", help="Draw the shares of each material.", show_default=False),
    ] = None,
    allow_outside: AllowOutside = False,
    json: Json = False,
) -> None:
    """Say how much of the light is reflected, transmitted and absorbed, and test the laws of physics.

    For each angle, shares of power are means over the wavelengths, in percent. Ends with 1 when a law is broken
    that the model claims.

    \b
    Example:
      illuminant audit "copper, circular mill"
      illuminant audit room.toml#wall --angles 0,60,85 --plots audit
    """
    from illuminant.auditing import ANGLES_DEG, WAVELENGTHS_NM
    from illuminant.auditing import audit as run
    from illuminant.cli.report import emit_json, note, sentence

    found = run(
        target,
        illumination=illumination,
        angles_deg=ANGLES_DEG if angles is None else tuple(numbers(angles, "--angles")),
        wavelengths_nm=WAVELENGTHS_NM
        if wavelengths is None
        else tuple(numbers(wavelengths, "--wavelengths")),
        draws=draws,
        allow_outside=allow_outside,
    )
    if json:
        emit_json([one.facts() for one in found])
    else:
        for one in found:
            _table(one)
    if plots is not None:
        from illuminant.plots.audit import save

        for path in save(found, plots):
            note(f"{path}: shares against angle and wavelength")
    broken = [
        f"{one.material}: {law.name}" for one in found for law in one.laws if law.claimed and not law.kept
    ]
    if broken:
        sentence("Broken", "; ".join(broken) + ".")
        raise typer.Exit(1)


def _table(one: Audit) -> None:
    typer.echo(f"{one.material}  ({one.illumination}: {one.source})")
    typer.echo("  angle  reflected           transmitted         absorbed")
    typer.echo("         coherent scattered  coherent scattered")
    rows = zip(
        one.angles_deg,
        one.coherent_reflection.mean(axis=1),
        one.scattered_reflection.mean(axis=1),
        one.coherent_transmission.mean(axis=1),
        one.scattered_transmission.mean(axis=1),
        one.absorbed.mean(axis=1),
        strict=True,
    )
    for angle, *shares in rows:
        a, b, c, d, e = (f"{100 * share:.2f}" for share in shares)
        typer.echo(f"  {angle:4g}°  {a:>8} {b:>9}  {c:>8} {d:>9}  {e:>8}")
    if one.emitted:
        typer.echo("  It shines, whatever light it receives.")
    typer.echo("  law            largest violation  allowed")
    for law in one.laws:
        verdict = "kept" if law.kept else "BROKEN" if law.claimed else "broken, as the model says"
        typer.echo(
            f"  {law.name:<14} {law.largest:17.2g}  {law.allowed:7.2g}  {verdict} {law.where}".rstrip()
        )
    typer.echo(f"  smallest p of chi-square {one.p_value:.2g}; largest weight of a draw {one.weight:.2g}")
    typer.echo("")
