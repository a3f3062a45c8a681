"""`illuminant calibrate fit`: a display described by its readings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Json

if TYPE_CHECKING:
    from illuminant.display.calibration.report import Chart, Criterion

__all__ = ["criteria", "fit"]


def fit(
    table: Annotated[
        Path, typer.Argument(metavar="READINGS", help="Table of readings (.csv).", show_default=False)
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="Description to write (.toml).", show_default=False
        ),
    ] = None,
    icc: Annotated[
        Path | None,
        typer.Option("--icc", metavar="FILE", help="ICC profile to write (.icc).", show_default=False),
    ] = None,
    name: Annotated[
        str | None,
        typer.Option("--name", metavar="NAME", help="Of the display (that of FILE).", show_default=False),
    ] = None,
    assumed: Annotated[
        str, typer.Option("--assumed", metavar="NAME", help="Display it was taken for before.")
    ] = "sRGB",
    low: Annotated[
        float,
        typer.Option("--low", metavar="F", help="Leave out readings below this fraction of white."),
    ] = 0.0,
    luminance: Annotated[
        float, typer.Option("--luminance", metavar="L", help="White it should have, cd/m².")
    ] = 103.0,
    json: Json = False,
) -> None:
    """Fit black, primaries, gain, offset and gamma to readings, judge them, and write the description.

    ΔE00 before: taken for --assumed; after: driven through the description, by what was read.

    \b
    Example:
      illuminant calibrate fit studio/readings.csv -o studio.toml --icc studio.icc
    """
    from illuminant.cli.report import emit_json, note, warning
    from illuminant.display.calibration import readings, report
    from illuminant.display.calibration.fit import fit as fitted
    from illuminant.errors import UsageError
    from illuminant.output import check

    for path, extension in ((output, ".toml"), (icc, ".icc")):
        if path is not None:
            if path.suffix.lower() not in (extension, ".icm" if extension == ".icc" else extension):
                raise UsageError(f"{path}: expected a name that ends in {extension}.")
            check(path)
    found = readings.read(table)
    result = fitted(found, low=low)
    model = result.model
    show = report.as_read(found, model)
    before = report.nominal_chart(show, assumed=assumed)
    after = report.described_chart(show, model)
    lines = report.verdict(found, after=after, luminance=luminance)
    title = name or (output or icc or table).stem
    facts = _facts(title, result, before, after, lines)
    if found.unread is not None and len(found.unread):
        warning(f"{len(found.unread)} rows of {table} have no reading, and were left out.")
    for row in result.outliers:
        code = ", ".join(f"{value:.3g}" for value in found.codes[row].tolist())
        warning(f"The reading of code {code} is far from what all others say: was it typed or shown wrongly?")
    if result.drift is not None and abs(result.drift) > 0.02:
        warning(
            f"White changed by {100 * result.drift:+.1f} % between its first and last reading: warm up longer."
        )
    if result.additivity is not None and abs(result.additivity) > 0.03:
        warning(
            f"White differs by {100 * result.additivity:+.1f} % from the sum of red, green and blue: the display "
            "mixes its channels, and no description of this kind is good."
        )
    if json:
        emit_json(facts)
    else:
        _print(title, facts, before, after, assumed)
        criteria(lines)
    from illuminant.display.calibration import description

    if output is not None:
        description.save(output, model, title)
        note(f"{output}: description of {title}; use it by --display {output}")
    if icc is not None:
        description.save_icc(icc, model, title)
        note(f"{icc}: ICC profile of {title}")


def _facts(title: str, result: Any, before: Chart, after: Chart, lines: list[Criterion]) -> dict[str, Any]:
    from illuminant import color

    model = result.model
    chromaticities = [color.xyz_to_xyy(row)[:2].tolist() for row in model.primaries]
    x, y, luminance = color.xyz_to_xyy(model.white).tolist()
    return {
        "name": title,
        "white": {"x": x, "y": y, "luminance": luminance},
        "black": {"XYZ": model.black.tolist()},
        "primaries": dict(zip(("red", "green", "blue"), chromaticities, strict=True)),
        "gamma": model.gamma.tolist(),
        "gain": model.gain.tolist(),
        "offset": model.offset.tolist(),
        "residual": {"mean": float(result.residuals.mean()), "max": float(result.residuals.max())},
        "additivity": result.additivity,
        "drift": result.drift,
        "outliers": result.outliers,
        "before": _chart(before),
        "after": _chart(after),
        "verdict": [line._asdict() for line in lines],
    }


def _chart(chart: Chart) -> dict[str, Any]:
    return {
        "mean": chart.mean,
        "max": chart.max,
        "mean_all": chart.mean_all,
        "outside": chart.outside,
        "white": chart.white,
        "patches": chart.differences,
    }


def _print(title: str, facts: dict[str, Any], before: Chart, after: Chart, assumed: str) -> None:
    white = facts["white"]
    typer.echo(f"{title}")
    typer.echo(f"  white      x, y = {white['x']:.4f}, {white['y']:.4f}  {white['luminance']:.2f} cd/m²")
    typer.echo(f"  black      {facts['black']['XYZ'][1]:.3f} cd/m²")
    for k, (gun, (x, y)) in enumerate(facts["primaries"].items()):
        typer.echo(
            f"  {gun:<10} x, y = {x:.4f}, {y:.4f}  gamma {facts['gamma'][k]:.3f}  gain {facts['gain'][k]:.3f}"
            f"  offset {facts['offset'][k]:+.3f}"
        )
    residual = facts["residual"]
    typer.echo(
        f"  readings   ΔE00 mean {residual['mean']:.2f}, max {residual['max']:.2f} from the description"
    )
    for label, chart in ((f"as {assumed}", before), ("described", after)):
        out = f"; outside, left out: {', '.join(chart.outside)}" if chart.outside else ""
        typer.echo(f"  {label:<10} ColorChecker ΔE00 mean {chart.mean:.2f}, max {chart.max:.2f}{out}")


def criteria(lines: list[Criterion]) -> None:
    """Print a verdict."""
    for line in lines:
        typer.echo(
            f"  {'good' if line.passed else 'BAD ':<5}{line.name:<17}{line.found} (wanted: {line.wanted})"
        )
