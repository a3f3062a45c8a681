"""`illuminant spectra`: the library of measured spectra."""

from __future__ import annotations

from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["app"]

app = typer.Typer(help="List and show the measured spectra that scenes can name.", no_args_is_help=False)


@app.callback(invoke_without_command=True)
def _start(context: typer.Context) -> None:
    if context.invoked_subcommand is None:
        list_names()


@app.command("list")
def list_names(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="WORD", help="Only names that hold these.", show_default=False),
    ] = None,
    json: Json = False,
) -> None:
    """List the names of the library, with what each is.

    \b
    Example:
      illuminant spectra list checker
    """
    from illuminant import spectra
    from illuminant.cli.report import emit_json

    wanted = [word.casefold() for word in words or []]
    found = [entry for entry in spectra.entries() if all(word in entry.name.casefold() for word in wanted)]
    if json:
        emit_json([{"name": entry.name, "quantity": entry.quantity} for entry in found])
        return
    width = max((len(entry.name) for entry in found), default=0)
    for entry in found:
        typer.echo(f"{entry.name:<{width}}  {entry.quantity}".rstrip())


@app.command("show")
def show(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Such as D65 or gold.n.", show_default=False)],
    json: Json = False,
) -> None:
    """Show where a spectrum comes from, its range, and its values.

    \b
    Example:
      illuminant spectra show gold.n
    """
    from illuminant import spectra
    from illuminant.cli.report import emit_json

    spectrum = spectra.load(name)
    if json:
        emit_json(
            {
                "name": spectrum.name,
                "unit": spectrum.unit,
                "outside": spectrum.outside,
                "provenance": spectrum.provenance,
                "wavelengths_nm": list(spectrum.wavelengths_nm),
                "values": list(spectrum.values),
            }
        )
        return
    first, last = spectrum.range_nm
    unit = "no unit" if spectrum.unit in ("", "1") else spectrum.unit
    typer.echo(f"{spectrum.name}: {unit}, {first:g} to {last:g} nm, outside: {spectrum.outside}")
    if spectrum.provenance:
        typer.echo(spectrum.provenance)
    for wavelength, value in zip(spectrum.wavelengths_nm, spectrum.values, strict=True):
        typer.echo(f"{wavelength:8g}  {value:.6g}")
