"""`illuminant gamut`: what the gamut methods do, in strips, paths and numbers (book figures 5.8 to 5.10)."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True)

Output = Annotated[
    Path, typer.Option("-o", "--output", metavar="FILE", help="Picture to be written.", show_default=False)
]

Methods = Annotated[
    str | None,
    typer.Option("--methods", metavar="NAMES", help="Which methods, in this order: clamp,scale,... (all)."),
]


@app.callback()
def _start() -> None:
    """Compare the methods that bring colours into a display's gamut (book 5.1.3).

    \b
    Example:
      illuminant gamut study
      illuminant gamut strips -o strips.png --methods oklab,scale,clamp
    """


def _chosen(methods: str | None) -> list[str]:
    """The methods asked for."""
    from illuminant.display import gamut
    from illuminant.errors import UsageError

    known = gamut.methods()
    found = [name.strip().casefold() for name in methods.split(",")] if methods else known
    for name in found:
        if name not in known:
            raise UsageError(
                f"--methods {name}: there is no such gamut method; known are {', '.join(known)}."
            )
    return found


@app.command("study", short_help="Measure every method.")
def study(methods: Methods = None, json: Json = False) -> None:
    """Measure the methods: deviation, hue, lightness, and kinks that show as Mach bands.

    Over gradients that become too bright, gradients that become too saturated, and the colours of Rec.2020 that sRGB
    cannot show. Mean, 95th percentile and largest are ΔE00; hue in degrees; kink is explained in docs/display.md.

    \b
    Example:
      illuminant gamut study --methods clamp,cook,oklab
    """
    from illuminant.cli.report import emit_json
    from illuminant.display import gamut_study

    found = gamut_study.study(_chosen(methods))
    if json:
        emit_json(
            {name: {kind: one.to_dict() for kind, one in kinds.items()} for name, kinds in found.items()}
        )
        return
    for kind in ("bright", "saturated", "wide"):
        typer.echo(
            f"{kind:<20} {'mean':>6} {'95 %':>6} {'max':>6} {'hue':>6} {'ΔL*':>6} {'kink':>6} {'inside':>6}"
        )
        for name, kinds in found.items():
            one = kinds[kind]
            numbers = (one.mean, one.p95, one.max, one.hue, one.lightness)
            kink = f"{one.kink:6.0f}" if kind != "wide" else "     –"
            typer.echo(
                f"  {name:<18} " + " ".join(f"{v:6.2f}" for v in numbers) + f" {kink} {one.inside:6.2f}"
            )


@app.command("strips", short_help="Strips of gradients, right and clipped (figure 5.9).")
def strips(output: Output, methods: Methods = None) -> None:
    """Draw gradients as strips: the right colours, then what each method makes of them (figure 5.9).

    The gamut is a small one inside that of sRGB, so that the first strip of each group can be shown.

    \b
    Example:
      illuminant gamut strips -o strips.png
    """
    from illuminant.cli.report import note
    from illuminant.display import gamut_study
    from illuminant.display.look import Look, show
    from illuminant.image import check_output

    check_output(output)
    chosen = _chosen(methods)
    shown = show(gamut_study.strips(chosen), Look(gamut="clamp"))
    shown.picture.save(output, {"Description": f"strips from the top: right, {', '.join(chosen)}"})
    note(f"{output}: in each group from the top: right, {', '.join(chosen)}")


@app.command("paths", short_help="Paths of clipping in the RGB cube (figure 5.8).")
def paths(output: Output, methods: Methods = "constant-intensity,scale,clamp") -> None:
    """Draw where gradients that leave the RGB cube are taken (figure 5.8).

    \b
    Example:
      illuminant gamut paths -o paths.svg
    """
    from illuminant.plots import gamut_study as plots

    plots.save_paths(_chosen(methods), output)


@app.command("deviation", short_help="Deviation along gradients (figure 5.10).")
def deviation(
    output: Output,
    methods: Methods = "constant-intensity,scale,clamp,cook,oklab",
    measure: Annotated[
        str,
        typer.Option(
            "--measure", metavar="NAME", help="lab (ΔE*ab, as the book's) or de00 (lab).", show_default=False
        ),
    ] = "lab",
) -> None:
    """Plot how far the methods take the colours of gradients from what they should be (figure 5.10).

    \b
    Example:
      illuminant gamut deviation -o deviation.svg --measure de00
    """
    from illuminant.errors import UsageError
    from illuminant.plots import gamut_study as plots

    if measure not in ("lab", "de00"):
        raise UsageError(f"--measure {measure}: expected lab or de00.")
    plots.save_deviation(_chosen(methods), measure, output)
