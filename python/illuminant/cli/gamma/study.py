"""`illuminant gamma response`, `drift`, `brightness` and `banding`: figures 5.3 to 5.7 of the book."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.gamma.options import Bits, Color, Gamma, Picture
from illuminant.cli.options import Json
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.display.gamma.banding import Banding

__all__ = ["banding", "brightness", "drift", "response"]


def response(
    output: Picture,
    gamma: Gamma = "2.2",
    bits: Annotated[int, typer.Option("--bits", metavar="N", help="Bits of the table shown.")] = 6,
) -> None:
    """Plot the response of a monitor and the curve that corrects it (figures 5.3 and 5.4).

    \b
    Example:
      illuminant gamma response --gamma 2.2 -o response.png
    """
    from illuminant.cli.report import note
    from illuminant.plots import style
    from illuminant.plots.gamma_curves import response_and_correction

    style.check_format(output)
    style.save(response_and_correction(gamma, bits), output)
    note(f"{output}: response and correction")


def drift(
    output: Picture,
    gamma: Annotated[float, typer.Option("--gamma", metavar="G", help="γ of the monitor.")] = 2.2,
    gammas: Annotated[
        str | None,
        typer.Option(
            "--gammas", metavar="A,B", help="γ' of the corrections (1.4 to 3 by 0.2).", show_default=False
        ),
    ] = None,
    display: Annotated[
        str, typer.Option("--primaries", metavar="NAME", help="Those of a display: a name, .toml or .icc.")
    ] = "book NTSC",
    json: Json = False,
) -> None:
    """Plot what a wrong gamma of correction does to the ColorChecker (figure 5.5), and print by how much.

    \b
    Example:
      illuminant gamma drift -o drift.png
      illuminant gamma drift --gammas 1.8,2.2,2.6 --primaries sRGB -o drift.png
    """
    from illuminant.cli.report import emit_json, note, warning
    from illuminant.display.gamma.drift import GAMMAS, study
    from illuminant.plots import style
    from illuminant.plots.gamma_drift import drift as drawn

    style.check_format(output)
    wanted = numbers(gammas, "--gammas") if gammas is not None else list(GAMMAS)
    found = study(wanted, monitor_gamma=gamma, display=display)
    style.save(drawn(found), output)
    if found.outside:
        warning(f"{', '.join(found.outside)}: outside of {found.display.name}, clamped.")
    mean, largest = found.difference.mean(axis=1), found.difference.max(axis=1)
    coloured = found.saturation[:, found.saturation[0] > 0]
    if json:
        facts = {"monitor_gamma": gamma, "gammas": wanted, "names": found.names, "xy": found.xy}
        facts |= {"difference": found.difference, "contrast": found.contrast}
        emit_json(facts | {"saturation": found.saturation})
    else:
        typer.echo("   γ'  ΔE00 mean   max  contrast  saturation")
        for row, each in enumerate(wanted):
            typer.echo(
                f"{each:5.2f}  {mean[row]:9.2f} {largest[row]:5.1f}  {found.contrast[row]:8.3f}  "
                f"{coloured[row].mean():10.3f}"
            )
    note(f"{output}: the ColorChecker with {len(wanted)} gammas of correction")


def brightness(
    output: Picture,
    gamma: Gamma = "2.2",
    black: Annotated[
        float, typer.Option("--black", metavar="F", help="Luminance of black as a share of white's.")
    ] = 0.01,
    json: Json = False,
) -> None:
    """Plot perceived brightness over intensity, beside L* and the monitor's response (figure 5.6).

    \b
    Example:
      illuminant gamma brightness --black 0.005 -o brightness.png
    """
    from dataclasses import asdict

    from illuminant.cli.report import emit_json, note
    from illuminant.display.gamma.brightness import resemblance
    from illuminant.plots import style
    from illuminant.plots.gamma_curves import perceived

    style.check_format(output)
    found = resemblance(gamma, black)
    style.save(perceived(black, gamma), output)
    if json:
        emit_json(asdict(found))
    else:
        typer.echo(f"brightness over code   r {found.logarithmic:.4f}")
        typer.echo(f"L* over code           r {found.lightness:.4f}")
        typer.echo(f"equal steps, response  r {found.response:.4f}")
    note(f"{output}: perceived brightness with black at {black:g} of white")


def banding(
    output: Picture,
    gamma: Gamma = "2.2",
    bits: Bits = "8,6",
    color: Color = "0.8,0.55,0.35",
    steps: Annotated[
        bool, typer.Option("--steps", help="Draw the steps of the darkest 5 % instead, to 16 bits.")
    ] = False,
    json: Json = False,
) -> None:
    """Compare correction before storage with correction at display (figure 5.7): picture and numbers.

    The picture is to be looked at pixel by pixel on a monitor of that gamma.

    \b
    Example:
      illuminant gamma banding -o banding.png
      illuminant gamma banding --steps --bits 8,10 -o steps.png
    """
    from dataclasses import asdict

    from illuminant.cli.report import emit_json, note
    from illuminant.display.gamma.banding import compared, gradation
    from illuminant.display.gamma.storage import WAYS
    from illuminant.errors import UsageError
    from illuminant.plots import style
    from illuminant.plots.banding_sheet import sheet, staircase

    style.check_format(output)
    wanted = numbers(bits, "--bits")
    if any(bit != int(bit) for bit in wanted) or len(wanted) > 4:
        raise UsageError(f"--bits {bits}: expected up to four whole numbers with commas between them.")
    whole = [int(bit) for bit in wanted]
    surface = numbers(color, "--color")
    figure: Any = (
        staircase(whole, colour=surface, gamma=gamma) if steps else sheet(whole, colour=surface, gamma=gamma)
    )
    smooth = gradation(surface)
    pairs = {bit: compared(smooth, bit, gamma) for bit in whole}
    style.save(figure, output)
    if json:
        emit_json({bit: dict(zip(WAYS, map(asdict, pair), strict=True)) for bit, pair in pairs.items()})
    else:
        typer.echo("bits  corrected       colours  below 10 %  largest ΔL*  colour ΔE00  error")
        for bit, pair in pairs.items():
            for way, found in zip(WAYS, pair, strict=True):
                typer.echo(f"{bit:4d}  {way:<14}  {_numbers(found)}")
    note(f"{output}: correction before storage and at display")


def _numbers(found: Banding) -> str:
    return (
        f"{found.colours:7d}  {found.low_colours:10d}  {found.largest_step:11.2f}  "
        f"{found.largest_colour_step:11.2f}  {found.mean_error:5.2f}"
    )
