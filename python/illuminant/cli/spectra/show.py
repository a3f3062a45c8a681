"""`illuminant spectra show`: what a spectrum is, where it comes from, and its values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Json
from illuminant.cli.spectra.argument import Column, FileQuantity

if TYPE_CHECKING:
    from illuminant.spectra import Spectrum

__all__ = ["block_plot", "show"]


def show(
    word: Annotated[
        str,
        typer.Argument(
            metavar="WHAT",
            help="A name such as D65 or gold.n, a file, blackbody:K or daylight:K.",
            show_default=False,
        ),
    ],
    values: Annotated[bool, typer.Option("--values/--no-values", help="List the values.")] = True,
    quantity: FileQuantity = None,
    column: Column = None,
    json: Json = False,
) -> None:
    """Show what a spectrum is, where it comes from, its colour, and its values.

    Lamps have a chromaticity, reflectances a colour under D65, both for the CIE 1931 2° observer.

    \b
    Example:
      illuminant spectra show "ColorChecker/dark skin" --no-values
      illuminant spectra show paint.csv --quantity reflectance
    """
    import shutil
    import sys

    from illuminant import spectra
    from illuminant.cli.report import emit_json
    from illuminant.cli.spectra.argument import check_file_options, is_file, load, material_of
    from illuminant.cli.spectra.facts import facts

    check_file_options([word], quantity, column)
    spectrum = load(word, quantity, column)
    header = {} if ":" in word or is_file(word) else spectra.header(word)
    found = facts(spectrum, header)
    beside = material_of(word)
    if beside is not None:
        found |= {"n": beside.n, "k": beside.k, "conductor": beside.conductor}
    if json:
        emit_json(found)
        return
    terminal = sys.stdout.isatty()
    width = max(40, shutil.get_terminal_size().columns if terminal else 80)
    _print_facts(found, min(width, 100))
    typer.echo("\n" + "\n".join(block_plot(spectrum, min(width, 100) - 2)))
    if values:
        typer.echo("")
        _print_values(spectrum, width if terminal else 0)


def _print_facts(found: dict[str, Any], width: int) -> None:
    import textwrap

    title = found["title"]
    typer.echo(f"{found['name']}: {title}" if title and title != found["name"] else found["name"])
    material = ", ".join(f"{key} {found[key]:g}" for key in ("n", "k") if found.get(key) is not None)
    if found.get("conductor") is not None:
        material += f"{', ' if material else ''}{'conductor' if found['conductor'] else 'dielectric'}"
    first, last = found["range_nm"]
    step = f", {found['step_nm']:g} nm apart" if found["step_nm"] else ""
    plain = found["unit"] in ("", "1")
    unit, by_unit = ("", "") if plain else (f" ({found['unit']})", f" x {found['unit']}")
    outside = {"zero": "zero", "hold": "the value of the nearer end", "error": "an error"}[found["outside"]]
    lines = [
        ("quantity", (found["quantity"] or "unknown; --quantity says which") + unit),
        ("range", f"{first:g} to {last:g} nm, {found['points']} points{step}"),
        ("outside", outside),
        *([] if found["quantity"] in ("n", "k") else [("area", f"{found['area'] or 0:.6g} nm{by_unit}")]),
        *([("material", material)] if material else []),
        *_derived_lines(found["derived"]),
        *((key, found[key]) for key in ("source", "provenance", "licence") if found[key]),
    ]
    for key, text in lines:
        typer.echo(
            textwrap.fill(
                text, width, initial_indent=f"{key:<14}", subsequent_indent=" " * 14, break_on_hyphens=False
            )
        )


def _derived_lines(derived: dict[str, Any]) -> list[tuple[str, str]]:
    """The derived numbers as lines of name and text."""
    if "x" in derived:
        lines = [("chromaticity", f"x {derived['x']:.4f}, y {derived['y']:.4f} ({derived['observer']})")]
        if "cct_k" in derived:
            index = f"; colour rendering R_a {derived['ra']:.1f}" if "ra" in derived else ""
            lines.append(("temperature", f"{derived['cct_k']:.0f} K, Duv {derived['duv']:.4f}{index}"))
        if "luminance_cd_m2" in derived:
            lines.append(("luminance", f"{derived['luminance_cd_m2']:.4g} cd/m²"))
        return lines
    if "lab" in derived:
        lightness, a, b = derived["lab"]
        clipped = ", clipped: sRGB cannot show it" if derived["clipped"] else ""
        return [
            (
                f"under {derived['light']}",
                "XYZ "
                + " ".join(f"{v:.4f}" for v in derived["xyz"])
                + f" ({derived['observer']}, white Y = 1)",
            ),
            ("", f"L* {lightness:.2f}, a* {a:.2f}, b* {b:.2f}"),
            ("", f"sRGB {derived['srgb']}{_swatch(derived['srgb'])}{clipped}"),
        ]
    if "value" in derived:
        return [(f"at {derived['wavelength_nm']:g} nm", f"{derived['value']:.6g}")]
    return []


def _swatch(code: str) -> str:
    """A patch of a colour (`#rrggbb`), on a terminal that says that it shows any; else nothing."""
    import os
    import sys

    if not sys.stdout.isatty() or "NO_COLOR" in os.environ:
        return ""
    if os.environ.get("COLORTERM") not in ("truecolor", "24bit"):
        return ""
    red, green, blue = (int(code[i : i + 2], 16) for i in (1, 3, 5))
    return f" \x1b[48;2;{red};{green};{blue}m    \x1b[0m"


def block_plot(spectrum: Spectrum, width: int, rows: int = 5) -> list[str]:
    """A curve as lines of block characters: the largest value within each column, over a line of wavelengths.

    Args:
        spectrum: a curve; shown from 380 to 780 nm, or whole where it lies outside of these.
        width: columns of the terminal that may be used.
        rows: lines for the curve; each holds eight steps.

    Example:
        >>> from illuminant.spectra import Spectrum
        >>> for line in block_plot(Spectrum("ramp", [380, 780], [0, 1]), 17, rows=1):
        ...     print(line)
        1 ▁▁▂▂▃▃▄▅▅▆▆▇▇█
          380        780
    """
    import numpy as np

    from illuminant.plots.wavelength_axis import shown_range

    first, last = shown_range([spectrum])
    first, last = max(first, spectrum.range_nm[0]), min(last, spectrum.range_nm[1])
    own, samples = np.array(spectrum.wavelengths_nm), np.array(spectrum.values)
    top = f"{max(0.0, float(samples[(own >= first) & (own <= last)].max(initial=0.0))):.3g}"
    count = width - len(top) - 2
    edges = np.linspace(first, last, count + 1)
    ends = spectrum.at(edges)
    heights = np.maximum(ends[:-1], ends[1:])
    inside = (own >= first) & (own < last)
    np.maximum.at(heights, ((own[inside] - first) / (last - first) * count).astype(int), samples[inside])
    low = min(0.0, float(heights.min()))
    span = float(heights.max()) - low
    eighths = np.zeros(count, int) if span <= 0 else np.rint((heights - low) / span * rows * 8).astype(int)
    blocks = " ▁▂▃▄▅▆▇█"
    lines = []
    for row in reversed(range(rows)):
        label = top if row == rows - 1 else f"{low:.3g}" if row == 0 and low < 0 else ""
        bar = "".join(blocks[min(8, max(0, int(value) - 8 * row))] for value in eighths)
        lines.append(f"{label[: len(top)]:>{len(top)}} {bar}".rstrip())
    ends_text = (f"{first:g}", f"{last:g}" if count < 24 else f"{last:g} nm")
    lines.append(f"{'':{len(top)}} {ends_text[0]}{ends_text[1]:>{max(1, count - len(ends_text[0]))}}")
    return lines


def _print_values(spectrum: Spectrum, width: int) -> None:
    """Wavelengths and values: in columns that fill a terminal, or one pair on each line when `width` is 0."""
    cells = [f"{w:8g}  {v:.6g}" for w, v in zip(spectrum.wavelengths_nm, spectrum.values, strict=True)]
    longest = max(map(len, cells)) + 1
    columns = max(1, width // longest)
    rows = -(-len(cells) // columns)
    for row in range(rows):
        typer.echo("".join(f"{cell:<{longest}}" for cell in cells[row::rows]).rstrip())
