"""`illuminant spectra list`: the names of the library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.options import Json
from illuminant.cli.spectra.argument import quantity_of

if TYPE_CHECKING:
    from illuminant.spectra import Entry

__all__ = ["list_names"]


def list_names(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="WORD", help="Only names that hold all of these.", show_default=False),
    ] = None,
    quantity: Annotated[
        str | None,
        typer.Option(
            "--quantity", metavar="NAME", help="Only emission, reflectance, n or k.", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """List the library: name, quantity, range, step, and the source as a heading.

    Into a pipe goes one line for each name, with tabs between the columns.

    \b
    Example:
      illuminant spectra list checker
      illuminant spectra list --quantity emission
    """
    import sys

    from illuminant import spectra
    from illuminant.cli.report import emit_json, note

    wanted = [word.casefold() for word in words or []]
    kind = quantity_of(quantity)
    found = [
        entry
        for entry in spectra.entries()
        if all(any(word in name.casefold() for name in (entry.name, *entry.also)) for word in wanted)
        and kind in (None, entry.quantity)
    ]
    headers: dict[str, dict[str, str]] = {}
    for entry in found:
        if entry.file not in headers:
            headers[entry.file] = spectra.header(entry.name)
    if json:
        emit_json([_facts(entry, headers[entry.file]) for entry in found])
    elif not found:
        note("No name of the library is like that; `illuminant spectra list` shows them all.")
    elif sys.stdout.isatty():
        _table(found, headers)
    else:
        for entry in found:
            header = headers[entry.file]
            extent, step = _extent(header)
            typer.echo("\t".join([entry.name, entry.quantity, extent, step, header.get("source", "")]))


def _extent(header: dict[str, str]) -> tuple[str, str]:
    """`300-780 nm` and `5 nm`, from the line of a header that says so."""
    extent, _, step = header.get("range", "").partition(", ")
    return extent, step.replace(" wavelengths", " points")


def _facts(entry: Entry, header: dict[str, str]) -> dict[str, object]:
    extent, step = _extent(header)
    return {
        "name": entry.name,
        "also": list(entry.also),
        "quantity": entry.quantity,
        "range": extent,
        "step": step,
        "source": header.get("source", ""),
    }


def _table(found: list[Entry], headers: dict[str, dict[str, str]]) -> None:
    """Aligned columns under headings: the folder of the library, and the source that the names below share."""
    import os
    import shutil

    columns = shutil.get_terminal_size().columns
    bold = ("", "") if "NO_COLOR" in os.environ else ("\x1b[1m", "\x1b[0m")
    width = max(len(entry.name) for entry in found)
    extents = max(len(_extent(header)[0]) for header in headers.values())
    above = ""
    for entry in found:
        header = headers[entry.file]
        heading = f"{entry.file.split('/')[0]}: {header.get('source', '')}"
        if heading != above:
            cut = heading if len(heading) <= columns else heading[: columns - 1] + "…"
            typer.echo(f"{chr(10) if above else ''}{bold[0]}{cut}{bold[1]}")
            above = heading
        extent, step = _extent(header)
        typer.echo(f"  {entry.name:<{width}}  {entry.quantity:<11}  {extent:<{extents}}  {step}".rstrip())
