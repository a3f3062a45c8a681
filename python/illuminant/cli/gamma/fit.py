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
            metavar="READINGS", help="CSV: code and luminances, or a table of calibrate.", show_default=False
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
    black: Annotated[
        float, typer.Option("--black", metavar="L", help="Luminance to take off every reading first.")
    ] = 0.0,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", metavar="FILE", help="Draw readings and fit (.png, .svg).", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Fit the gamma of a monitor to luminances measured at some codes, column by column, with its error.

    For a whole description, with black and primaries, of a table of r, g, b and X, Y, Z: calibrate fit.

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
    from illuminant.errors import DataError, UsageError
    from illuminant.plots import style

    if plot is not None:
        style.check_format(plot)
    measured = read_readings(readings)
    fits = {}
    for name, column in measured.items():
        try:
            fits[name] = fit_gamma(*column, model, cutoff=cutoff, white_code=white, black=black)
        except UsageError as error:
            raise UsageError(f"{readings}, {name}: {error}") from error
        except DataError as error:
            raise DataError(f"{name}: {error.message}", str(readings)) from error
    if json:
        emit_json({name: _facts(found) for name, found in fits.items()})
    else:
        for name, found in fits.items():
            typer.echo(f"{name}: {_sentence(found)}")
    if plot is not None:
        from illuminant.plots.gamma_curves import fitted

        style.save(fitted(measured, fits), plot)
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
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="Description to write (.toml).", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Make the matrix of a monitor from the chromaticities of its phosphors, printed or measured.

    \b
    Example:
      illuminant gamma phosphors monitor.csv
      illuminant gamma phosphors monitor.csv --gamma 2.35 -o monitor.toml
    """
    from illuminant import output as files
    from illuminant.cli.report import emit_json, note
    from illuminant.display.gamma.phosphors import COLOURS, read_phosphors
    from illuminant.errors import UsageError

    if output is not None:
        if output.suffix.lower() != ".toml":
            raise UsageError(f"{output}: a description is saved as .toml.")
        files.check(output)
    found = read_phosphors(readings)
    monitor = found.display(gamma, readings.stem)
    if output is not None:
        monitor.save(output, "From the chromaticities of its phosphors (`illuminant gamma phosphors`).")
        note(f"{output}: description of {monitor.name}; use it by --display {output}")
    if json:
        emit_json(
            {
                "primaries": found.primaries,
                "white": found.white,
                "luminances": found.luminances,
                "additivity": found.additivity,
                "transfer": monitor.response,
                "to_xyz": monitor.to_xyz_matrix,
                "from_xyz": monitor.from_xyz_matrix,
            }
        )
        return
    for name, (x, y) in zip(COLOURS, (*found.primaries, found.white), strict=True):
        typer.echo(f"{name:<6} x {x:.4f}  y {y:.4f}")
    if found.additivity is not None:
        typer.echo(f"guns together {100 * found.additivity:.1f} % of white")
    for title, rows in (("RGB to XYZ", monitor.to_xyz_matrix), ("XYZ to RGB", monitor.from_xyz_matrix)):
        typer.echo(title)
        for row in rows:
            typer.echo("  ".join(f"{value:9.5f}" for value in row))
