"""`illuminant gamma fit` and `phosphors`: a monitor from readings of a meter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Json

if TYPE_CHECKING:
    from illuminant.display.gamma.fitting import GammaFit

__all__ = ["fit", "phosphors"]


def fit(
    readings: Annotated[
        Path,
        typer.Argument(
            metavar="READINGS", help="CSV: code, and luminances in the other columns.", show_default=False
        ),
    ],
    model: Annotated[
        str,
        typer.Option("--model", metavar="NAME", help="power, offset or gain-offset-gamma."),
    ] = "power",
    cutoff: Annotated[
        float | None,
        typer.Option(
            "--cutoff",
            metavar="L",
            help="Leave out luminances below this (power: found by itself; others: none).",
            show_default=False,
        ),
    ] = None,
    white: Annotated[
        float | None,
        typer.Option(
            "--white", metavar="CODE", help="Code of white (the largest measured).", show_default=False
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", metavar="FILE", help="Draw readings and fit (.png, .svg).", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Fit the gamma of a monitor to luminances measured at some codes, column by column.

    \b
    power               L = peak v^γ, on logarithms, with a cutoff
    offset              L = peak v^γ + floor
    gain-offset-gamma   L = peak (gain v + 1 - gain)^γ

    \b
    Example:
      illuminant gamma fit readings.csv
      illuminant gamma fit readings.csv --model offset --plot fit.png
    """
    from illuminant.cli.report import emit_json, note
    from illuminant.display.gamma.fitting import fit_gamma
    from illuminant.display.gamma.readings import read_readings
    from illuminant.errors import UsageError
    from illuminant.plots import style

    if plot is not None:
        style.check_format(plot)
    measured = read_readings(readings)
    fits = {}
    for name, luminances in measured.luminances.items():
        try:
            fits[name] = fit_gamma(measured.codes, luminances, model, cutoff=cutoff, white_code=white)
        except UsageError as error:
            raise UsageError(f"{readings}, {name}: {error}") from error
    if json:
        emit_json({name: _facts(found) for name, found in fits.items()})
    else:
        for name, found in fits.items():
            typer.echo(f"{name}: {_sentence(found)}")
    if plot is not None:
        from illuminant.plots.gamma_curves import fitted

        style.save(fitted(measured.codes, measured.luminances, fits), plot)
        note(f"{plot}: readings, fit and residuals")


def _facts(found: GammaFit) -> dict[str, Any]:
    return {
        "model": found.model,
        "gamma": found.gamma,
        "gamma_error": found.gamma_error,
        "parameters": found.parameters,
        "errors": found.errors,
        "cutoff": found.cutoff,
        "used": found.used,
        "residuals": found.residuals,
        "scatter": found.scatter,
    }


def _sentence(found: GammaFit) -> str:
    """A fit in one line."""
    parts = [f"γ {found.gamma:.4g} ± {found.gamma_error:.2g}"]
    for name, unit in (("peak", " cd/m²"), ("floor", " cd/m²"), ("gain", "")):
        if name in found.parameters:
            parts.append(f"{name} {found.parameters[name]:.4g} ± {found.errors[name]:.2g}{unit}")
    parts.append(f"{int(found.used.sum())} of {len(found.used)} readings from {found.cutoff:.3g} cd/m² up")
    parts.append(f"scatter {100 * found.scatter:.2g} %")
    return ", ".join(parts)


def phosphors(
    readings: Annotated[
        Path,
        typer.Argument(
            metavar="READINGS",
            help="CSV: red, green, blue, white with x,y or x,y,Y or X,Y,Z.",
            show_default=False,
        ),
    ],
    gamma: Annotated[float, typer.Option("--gamma", metavar="G", help="γ of the monitor.")] = 2.2,
    json: Json = False,
) -> None:
    """Make the matrix of a monitor from the chromaticities of its phosphors, printed or measured.

    \b
    Example:
      illuminant gamma phosphors monitor.csv
    """
    from illuminant.cli.report import emit_json
    from illuminant.display.gamma.phosphors import COLOURS, read_phosphors

    found = read_phosphors(readings)
    system = found.system(gamma, readings.stem)
    if json:
        emit_json(
            {
                "primaries": found.primaries,
                "white": found.white,
                "luminances": found.luminances,
                "additivity": found.additivity,
                "transfer": system.transfer,
                "to_xyz": system.to_xyz,
                "from_xyz": system.from_xyz,
            }
        )
        return
    for name, (x, y) in zip(COLOURS, (*found.primaries, found.white), strict=True):
        typer.echo(f"{name:<6} x {x:.4f}  y {y:.4f}")
    if found.additivity is not None:
        typer.echo(f"guns together {100 * found.additivity:.1f} % of white")
    for title, rows in (("RGB to XYZ", system.to_xyz), ("XYZ to RGB", system.from_xyz)):
        typer.echo(title)
        for row in rows:
            typer.echo("  ".join(f"{value:9.5f}" for value in row))
