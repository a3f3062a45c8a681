"""`illuminant dither`: dithers compared and measured; patterns and halftones (book 5.1.4, figures 5.11, 5.12)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Assume, Exposure, Json

if TYPE_CHECKING:
    from illuminant.display.picture import Picture

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True)

_MOST_PIXELS = 200_000_000

Output = Annotated[
    Path, typer.Option("-o", "--output", metavar="FILE", help="Picture to be written.", show_default=False)
]

Mean = Annotated[
    str | None,
    typer.Option(
        "--mean", metavar="KIND", help="What is kept on average: light or codes.", show_default=False
    ),
]

Grey = Annotated[bool, typer.Option("--grey", help="Without colour.")]


@app.callback()
def _start() -> None:
    """Compare dithers and patterns, which show more levels than a display has (book 5.1.4).

    To dither a picture of your own: illuminant display IN OUT --dither NAME --bits N.

    \b
    Example:
      illuminant dither study
      illuminant dither compare -o bands.png
    """


def _named(names: str | None, default: Any) -> list[str]:
    """The dithers asked for."""
    from illuminant.display import patterning

    found = [name.strip().casefold() for name in names.split(",")] if names else list(default)
    for name in found:
        patterning.check(name)
    return found


def _opened(image: Path, assume: str | None, exposure: float | None) -> Picture:
    """The picture, or the image as a picture for sRGB."""
    from illuminant.display.look import Look
    from illuminant.display.picture import EXTENSIONS, Picture
    from illuminant.image import Image

    if image.suffix.lower() in EXTENSIONS and exposure is None:
        return Picture.open(image, assume)
    return Image.open(image, assume).shown(Look(bits=16), exposure=exposure).picture


@app.command("list", short_help="List the dithers.")
def listing(json: Json = False) -> None:
    """List the dithers, what each does and where it comes from.

    \b
    Example:
      illuminant dither list
    """
    from illuminant.cli.report import emit_json
    from illuminant.display import dither

    about = {name: dither.described(name) for name in dither.names()}
    if json:
        emit_json({name: {"does": does, "source": source} for name, (does, source) in about.items()})
        return
    for name, (does, source) in about.items():
        typer.echo(f"{name:<27} {does}{f' ({source})' if source else ''}")


@app.command("compare", short_help="Draw a gradation, or an image, by several dithers (figure 5.12).")
def compare(
    output: Output,
    image: Annotated[
        Path | None,
        typer.Argument(
            metavar="IN",
            help="Image (.exr) or picture (.png) in place of the gradation.",
            show_default=False,
        ),
    ] = None,
    dithers: Annotated[
        str | None,
        typer.Option(
            "--dithers",
            metavar="NAMES",
            help="Dithers and pattern-WxH, in this order: none,ordered-2,... (those of the figure).",
            show_default=False,
        ),
    ] = None,
    bits: Annotated[
        int | None,
        typer.Option("--bits", metavar="N", help="Bits, 1 to 8 (3; of an image 1).", show_default=False),
    ] = None,
    width: Annotated[int, typer.Option("--width", metavar="N", help="Of the gradation, pixels.")] = 256,
    band: Annotated[int, typer.Option("--band", metavar="N", help="Height of a band, pixels.")] = 32,
    enlarge: Annotated[
        int, typer.Option("--enlarge", metavar="N", help="Each pixel as N x N, to look at it.")
    ] = 1,
    columns: Annotated[
        int | None,
        typer.Option(
            "--columns",
            metavar="N",
            help="How many stand side by side (1; of an image, up to 1600 pixels).",
            show_default=False,
        ),
    ] = None,
    mean: Mean = None,
    grey: Grey = False,
    bare: Annotated[bool, typer.Option("--bare", help="Without labels and gaps.")] = False,
    exposure: Exposure = None,
    assume: Assume = None,
) -> None:
    """Draw a grey gradation under several dithers (figure 5.12: 3 bits, width 256), or an image.

    The mean of codes is kept in a gradation, as in the figure; in an image that of light, or it would be too bright.

    \b
    Examples:
      illuminant dither compare -o bands.png
      illuminant dither compare --dithers none,blue-noise --bits 2 -o bands.png
      illuminant dither compare room.png --grey -o halftones.png
    """
    import numpy as np

    from illuminant.cli.report import note
    from illuminant.display import displays, dither_study, patterning
    from illuminant.display.picture import Picture
    from illuminant.errors import UsageError
    from illuminant.image import check_output
    from illuminant.plots.dither_study import labelled

    if output.suffix.lower() != ".png":
        raise UsageError(f"{output}: a comparison is saved as .png.")
    check_output(output)
    names = _named(dithers, dither_study.BANDS)
    depth = bits if bits is not None else 3 if image is None else 1
    if not 1 <= depth <= 8:
        raise UsageError(f"--bits {depth}: a comparison has 1 to 8 bits, as many as its file.")
    if not 1 <= enlarge <= 32:
        raise UsageError(f"--enlarge {enlarge}: expected 1 to 32.")
    if columns is not None and columns < 1:
        raise UsageError(f"--columns {columns}: expected 1 or more.")
    if image is None:
        codes = dither_study.comparison(names, depth, width, band, mean=mean or "codes")
        parts: list[Any] = np.split(np.repeat(codes[..., None], 3, axis=-1), len(names))
        display, fitting = displays.named("sRGB"), 1
    else:
        picture = _opened(image, assume, exposure)
        parts = [
            patterning.halftone(picture, name, depth, grey=grey, mean=mean or "light").codes for name in names
        ]
        display, fitting = picture.display, 1600 // (parts[0].shape[1] * enlarge)
    beside = min(len(names), max(1, fitting) if columns is None else columns)
    pixels = len(names) * parts[0].shape[0] * parts[0].shape[1] * enlarge**2
    if pixels > _MOST_PIXELS:
        raise UsageError(
            f"The comparison would have {pixels / 1e6:,.0f} megapixels, and {_MOST_PIXELS / 1e6:,.0f} are enough."
        )
    top = (1 << depth) - 1
    # Spread over the file's 8 bits; halves go up.
    shown = [((2 * 255 * part.astype(np.uint32) + top) // (2 * top)).astype(np.uint8) for part in parts]
    shown = [part.repeat(enlarge, axis=0).repeat(enlarge, axis=1) for part in shown]
    sheet = _bare(shown, beside) if bare else labelled(shown, names, columns=beside)
    Picture(sheet, display, 8).save(
        output, {"Description": f"dithers at {depth} bits a channel: {', '.join(names)}"}
    )
    note(f"{output}: {depth} {'bit' if depth == 1 else 'bits'}, {', '.join(names)}")


def _bare(parts: Any, columns: int) -> Any:
    """Pictures side by side and nothing else; a last row that is not full is black at its end."""
    import numpy as np

    full = [*parts, *([np.zeros_like(parts[0])] * (-len(parts) % columns))]
    return np.concatenate(
        [np.concatenate(full[row : row + columns], axis=1) for row in range(0, len(full), columns)]
    )


@app.command("patterns", short_help="Draw the patterns of cells (figure 5.11).")
def patterns(
    output: Output,
    cells: Annotated[
        str | None,
        typer.Option("--cells", metavar="WxH,...", help="Which cells (2x2,2x3,3x3).", show_default=False),
    ] = None,
) -> None:
    """Draw the patterns by which cells show levels at one bit, and print how many there are (figure 5.11).

    \b
    Example:
      illuminant dither patterns -o patterns.svg
    """
    from illuminant.display import patterning
    from illuminant.plots.dither_study import save_patterns

    chosen = [cell.strip() for cell in cells.split(",")] if cells else list(patterning.CELLS)
    save_patterns(chosen, output)
    typer.echo("cell   levels at 1 bit    at 8 bits")
    for cell in chosen:
        typer.echo(f"{cell:<7}{patterning.levels(cell):15,}{patterning.levels(cell, 8):13,}")


@app.command("halftone", short_help="Turn a picture into one of one bit, or a few.")
def halftone(
    image: Annotated[
        Path, typer.Argument(metavar="IN", help="Image (.exr) or picture (.png).", show_default=False)
    ],
    output: Annotated[
        Path, typer.Argument(metavar="OUT", help="Picture to be written (.png).", show_default=False)
    ],
    by: Annotated[
        str,
        typer.Option(
            "--dither", metavar="NAME", help="pattern-WxH, or a dither (pattern-2x2).", show_default=False
        ),
    ] = "pattern-2x2",
    bits: Annotated[
        int, typer.Option("--bits", metavar="N", help="Bits of a channel, 1 to 16 (1).", show_default=False)
    ] = 1,
    enlarge: Annotated[bool, typer.Option("--enlarge", help="Every pixel becomes a cell.")] = False,
    grey: Grey = False,
    mean: Mean = None,
    exposure: Exposure = None,
    seed: Annotated[
        int, typer.Option("--seed", metavar="N", help="Of the random dither (0).", show_default=False)
    ] = 0,
    assume: Assume = None,
) -> None:
    """Turn a picture into a halftone: few codes, arranged so that the eye sees many.

    A pattern shows the mean of a cell; a dither keeps more detail. What is kept on average is light. With --mean codes
    it is the codes: too bright, but the practice of the book's time.

    \b
    Examples:
      illuminant dither halftone room.png dots.png --grey
      illuminant dither halftone room.png dots.png --dither floyd-steinberg
      illuminant dither halftone small.png big.png --dither pattern-3x3 --enlarge
    """
    from illuminant.cli.report import note
    from illuminant.display import patterning
    from illuminant.errors import UsageError
    from illuminant.image import check_output

    if output.suffix.lower() != ".png":
        raise UsageError(f"{output}: a halftone is saved as .png.")
    check_output(output)
    patterning.check(by)
    picture = _opened(image, assume, exposure)
    made = patterning.halftone(picture, by, bits, enlarge=enlarge, grey=grey, mean=mean or "light", seed=seed)
    made.save(output)
    note(f"{output}: {made.width}x{made.height}, {bits} {'bit' if bits == 1 else 'bits'}, by {by.casefold()}")


@app.command("study", short_help="Measure the grain and the banding of dithers.")
def study(
    dithers: Annotated[
        str | None,
        typer.Option(
            "--dithers", metavar="NAMES", help="Dithers and pattern-WxH (all dithers).", show_default=False
        ),
    ] = None,
    bits: Annotated[
        int, typer.Option("--bits", metavar="N", help="Bits of a channel, 1 to 16 (8).", show_default=False)
    ] = 8,
    density: Annotated[
        float,
        typer.Option(
            "--density",
            metavar="N",
            help="Pixels a degree at the viewer's eye (42: 0.25 mm from 60 cm).",
            show_default=False,
        ),
    ] = 42.0,
    json: Json = False,
) -> None:
    """Measure dithers: grain on flat fields, steps on a gradation, errors of the mean; in codes.

    low is the part of the noise below 1/8 of the sampling frequency, 1 for white noise; visible the grain as seen,
    after Mannos and Sakrison's contrast sensitivity; step the largest step of the local mean. See docs/dither.md.

    \b
    Example:
      illuminant dither study --dithers none,ordered-2,blue-noise --bits 8
    """
    from illuminant.cli.report import emit_json
    from illuminant.display import dither, dither_study

    found = dither_study.study(_named(dithers, dither.names()), bits, density)
    if json:
        emit_json({name: one.to_dict() for name, one in found.items()})
        return
    typer.echo(f"{'':<27} {'grain':>6} {'low':>6} {'visible':>8} {'step':>6} {'in L*':>7} {'mean':>7}")
    for name, one in found.items():
        low = "     –" if one.low != one.low else f"{one.low:6.2f}"
        numbers = f"{one.visible:8.3f} {one.step:6.3f} {one.step_lightness:7.3f} {one.mean:7.4f}"
        typer.echo(f"{name:<27} {one.grain:6.3f} {low} {numbers}")


@app.command("spectrum", short_help="Plot power spectra of the noise of dithers.")
def spectrum(
    dithers: Annotated[
        list[str], typer.Argument(metavar="NAME...", help="Dithers and pattern-WxH.", show_default=False)
    ],
    output: Output,
    bits: Annotated[
        int, typer.Option("--bits", metavar="N", help="Bits of a channel, 1 to 16 (8).", show_default=False)
    ] = 8,
    part: Annotated[
        float | None,
        typer.Option(
            "--part",
            metavar="P",
            help="A single field, at this part of the way from one code to the next (the mean of many).",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Plot radially averaged power spectra of the noise on flat fields, 1 for white noise.

    \b
    Example:
      illuminant dither spectrum random blue-noise floyd-steinberg -o spectra.svg
    """
    from illuminant.cli.report import note
    from illuminant.plots.dither_study import save_spectra
    from illuminant.plots.style import check_format

    check_format(output)
    names = _named(",".join(dithers), ())
    save_spectra(names, output, bits, part)
    note(f"{output}: {', '.join(names)}")
