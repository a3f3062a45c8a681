"""`illuminant gamma table` and `levels`: lookup tables, and what they lose."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.gamma.options import Gamma, InBits, OutBits, Rounding
from illuminant.cli.options import Json

if TYPE_CHECKING:
    from illuminant.display.gamma.lookup_table import LookupTable

__all__ = ["levels", "table"]

Contrast = Annotated[
    float | None,
    typer.Option(
        "--log",
        metavar="C",
        help="For an image stored logarithmically over a contrast of C : 1.",
        show_default=False,
    ),
]


def _made(gamma: str, in_bits: int, out_bits: int, rounding: Any, contrast: float | None) -> LookupTable:
    """The table that the options ask for."""
    from illuminant.display.gamma.lookup_table import correction_table, log_table

    if contrast is not None:
        return log_table(gamma, in_bits, out_bits, contrast, rounding)
    return correction_table(gamma, in_bits, out_bits, rounding)


def table(
    gamma: Gamma = "2.2",
    in_bits: InBits = 8,
    out_bits: OutBits = 8,
    rounding: Rounding = "nearest",
    log: Contrast = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Write a .csv, .cube or .spi1d instead of printing.",
            show_default=False,
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Print the lookup table that corrects for a monitor, or write it to a file.

    \b
    Example:
      illuminant gamma table --rounding truncate       # table 5.1 of the book
      illuminant gamma table --gamma 2.4 --out-bits 10 -o monitor.cube
    """
    from illuminant.cli.report import emit_json, note
    from illuminant.display.gamma.table_file import check_table_path, write_table

    if output is not None:
        check_table_path(output)
    made = _made(gamma, in_bits, out_bits, rounding, log)
    if output is not None:
        write_table(made, output)
        note(f"{output}: {made.name}, {in_bits} bits to {out_bits}")
    if json:
        facts = {"name": made.name, "in_bits": in_bits, "out_bits": out_bits, "rounding": rounding}
        emit_json(facts | {"entries": made.entries})
    elif output is None:
        typer.echo(_columns(made))


def _columns(made: LookupTable) -> str:
    """A table in columns that fit into 80 characters, each read downwards."""
    entries = made.entries.tolist()
    wide, high = len(str(len(entries) - 1)), len(str(max(entries)))
    cells = [f"{code:>{wide}} {entry:>{high}}" for code, entry in enumerate(entries)]
    count = max(1, 78 // (wide + high + 4))
    rows = -(-len(cells) // count)
    return "\n".join("   ".join(cells[row::rows]) for row in range(rows))


def levels(
    gamma: Gamma = "2.2",
    in_bits: InBits = 8,
    out_bits: OutBits = 8,
    rounding: Rounding = "nearest",
    log: Contrast = None,
    share: Annotated[
        float, typer.Option("--share", metavar="F", help="How much of the dark end is looked at.")
    ] = 0.1,
    json: Json = False,
) -> None:
    """Say which levels a lookup table loses: codes never used, codes that become one, and how far the dark end spreads.

    \b
    Example:
      illuminant gamma levels --rounding truncate
      illuminant gamma levels --out-bits 10
    """
    from illuminant.cli.report import emit_json
    from illuminant.display.gamma.levels import lost_levels, spread

    made = _made(gamma, in_bits, out_bits, rounding, log)
    found = lost_levels(made)
    code, entry = spread(made, share)
    low, high = found.largest_gap
    if json:
        emit_json(
            {
                "name": made.name,
                "used": found.used,
                "unused": found.unused,
                "merged": found.merged,
                "merged_codes": found.merged_codes,
                "largest_gap": [low, high],
                "share": share,
                "spread": entry,
            }
        )
        return
    total = 1 << out_bits
    typer.echo(f"{made.name}, {in_bits} bits to {out_bits}, {rounding}")
    typer.echo(f"display codes used    {found.used} of {total}, {len(found.unused)} never")
    typer.echo(f"image codes merged    {found.merged_codes} of {1 << in_bits} fall on that of another")
    typer.echo(f"largest gap           {low} to {high}, {high - low - 1} codes between")
    typer.echo(
        f"lowest {100 * share:.3g} %{'':<{max(1, 12 - len(f'{100 * share:.3g}'))}} "
        f"up to code {round(code * ((1 << in_bits) - 1))}, spread over {100 * entry:.3g} % of the display's range"
    )
