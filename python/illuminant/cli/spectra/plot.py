"""`illuminant spectra plot`: curves, matching functions and chromaticity diagrams as PNG or SVG."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.spectra.argument import Column, FileQuantity
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from illuminant.spectra import Spectrum

__all__ = ["plot"]


def plot(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="WHAT", help="Names, files, blackbody:K or daylight:K.", show_default=False),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A .png or .svg; else a PNG named after WHAT.",
            show_default=False,
        ),
    ] = None,
    wavelengths: Annotated[
        str | None,
        typer.Option("--range", metavar="A-B", help="Wavelengths shown, nm (380-780).", show_default=False),
    ] = None,
    normalise: Annotated[
        float | None,
        typer.Option(
            "--normalise", metavar="NM", help="Make each curve 1 at this wavelength.", show_default=False
        ),
    ] = None,
    observer: Annotated[
        str | None,
        typer.Option(
            "--observer",
            metavar="NAME",
            help="Matching functions of 1931, 1964 or book.",
            show_default=False,
        ),
    ] = None,
    space: Annotated[
        str | None,
        typer.Option(
            "--space",
            metavar="NAME",
            help="Matching functions in ac1c2 or an RGB system.",
            show_default=False,
        ),
    ] = None,
    matching: Annotated[
        str | None,
        typer.Option(
            "--matching",
            metavar="A,B,C",
            help="Matching functions for lights of three wavelengths.",
            show_default=False,
        ),
    ] = None,
    chromaticity: Annotated[
        str | None,
        typer.Option(
            "--chromaticity",
            metavar="KIND",
            help="Diagram with WHAT as points: xy, uv, or A,B,C (lights of three wavelengths).",
            show_default=False,
        ),
    ] = None,
    projection: Annotated[
        bool, typer.Option("--projection", help="With --chromaticity A,B,C: its plane in space.")
    ] = False,
    gamut: Annotated[
        list[str] | None,
        typer.Option(
            "--gamut", metavar="SYSTEM", help="In a diagram: an RGB system; repeatable.", show_default=False
        ),
    ] = None,
    light: Annotated[
        str | None,
        typer.Option(
            "--light", metavar="WHAT", help="In a diagram: lamp on reflectances (D65).", show_default=False
        ),
    ] = None,
    planckian: Annotated[
        bool | None,
        typer.Option("--planckian/--no-planckian", help="In a diagram: blackbodies.", show_default=False),
    ] = None,
    zoom: Annotated[
        bool, typer.Option("--zoom", help="In a diagram: only the surroundings of WHAT.")
    ] = False,
    plain: Annotated[bool, typer.Option("--plain", help="Without the colours of the spectrum.")] = False,
    size: Annotated[
        str | None, typer.Option("--size", metavar="WxH", help="Pixels of the PNG.", show_default=False)
    ] = None,
    quantity: FileQuantity = None,
    column: Column = None,
) -> None:
    """Plot spectra as curves or as points of a chromaticity diagram, or the eye's matching functions.

    \b
    Example:
      illuminant spectra plot D65 FL11 --normalise 560 -o lamps.png
      illuminant spectra plot --observer 1931 --space ac1c2 -o ac1c2.svg
      illuminant spectra plot --matching 445,535,630
      illuminant spectra plot D65 FL11 --chromaticity xy --gamut sRGB
    """
    from illuminant.cli.report import note
    from illuminant.cli.spectra.argument import check_file_options, load, range_of
    from illuminant.errors import UsageError
    from illuminant.plots import style

    given = {
        "--normalise": normalise is not None,
        "--range": wavelengths is not None,
        "--observer": observer is not None,
        "--space": space is not None,
        "--projection": projection,
        "--gamut": bool(gamut),
        "--light": light is not None,
        "--planckian": planckian is not None,
        "--zoom": zoom,
    }
    kind, allowed = _kind(words or [], matching, chromaticity, observer or space, projection)
    for option, is_given in given.items():
        if is_given and option not in allowed:
            raise UsageError(f"{option} does not go with {kind}.")
    check_file_options(words or [], quantity, column)
    shown = range_of(wavelengths)
    path = style.check_format(output or f"{_stem(words or [], matching, chromaticity, observer, space)}.png")
    look: dict[str, Any] = {"plain": plain}
    pixels = _pixels(size) if size is not None else None
    if pixels is not None:
        # A hair more than the quotient, as a part of a pixel is cut off.
        look["size"] = (WIDTH_INCHES + 1e-6, WIDTH_INCHES * pixels[1] / pixels[0] + 1e-6)
    spectra = [load(word, quantity, column) for word in words or []]
    if chromaticity is not None and projection:
        from illuminant.plots import projection as in_space

        wanted = "three wavelengths in nm, such as 445,535,630, with --projection"
        lights = numbers(chromaticity, "--chromaticity", wanted, count=3)
        figure = in_space(lights, observer=observer or "1931", **look)
    elif chromaticity is not None:
        figure = _diagram(
            spectra, chromaticity, observer, light, gamut or [], planckian, look | {"zoom": zoom}
        )
    elif spectra:
        from illuminant.plots import curves

        figure = curves(spectra, normalise_nm=normalise, range_nm=shown, **look)
    else:
        from illuminant.plots import matching_functions

        primaries = (
            numbers(matching, "--matching", "three wavelengths in nm, such as 445,535,630", count=3)
            if matching
            else None
        )
        figure = matching_functions(
            observer or "1931", space=space or "xyz", primaries_nm=primaries, range_nm=shown, **look
        )
    if pixels is not None:
        figure.set_dpi(pixels[0] / WIDTH_INCHES)
    style.save(figure, path)
    note(f"{path}: {kind}{f' of {len(spectra)} spectra' if len(spectra) > 1 else ''}")


def _kind(
    words: list[str], matching: str | None, chromaticity: str | None, observer: str | None, projection: bool
) -> tuple[str, set[str]]:
    """Which plot is asked for, in words, and the options that belong to it."""
    from illuminant.errors import UsageError

    if chromaticity is not None:
        if matching is not None:
            raise UsageError(
                "--matching and --chromaticity are two plots; for the diagram of three lights write "
                f"--chromaticity {matching}."
            )
        if projection:
            if words:
                raise UsageError(f"--projection shows three lights by themselves, without {words[0]}.")
            return "a chromaticity diagram in space", {"--observer", "--projection"}
        return "a chromaticity diagram", {"--observer", "--gamut", "--light", "--planckian", "--zoom"}
    if matching is not None or observer is not None:
        if words:
            raise UsageError(f"Matching functions are a plot by themselves, without {words[0]}.")
        own = {"--observer", "--range"} if matching is not None else {"--observer", "--range", "--space"}
        return "matching functions", own
    if not words:
        raise UsageError(
            "Name what to plot: spectra, --observer 1931, --matching 445,535,630 or --chromaticity xy."
        )
    return "curves", {"--normalise", "--range"}


def _stem(
    words: list[str], matching: str | None, chromaticity: str | None, observer: str | None, space: str | None
) -> str:
    """Name of the file when none is given: after the first of what is plotted."""
    import re

    if words:
        name = Path(words[0]).stem if Path(words[0]).is_file() else words[0]
    elif chromaticity is not None:
        name = f"chromaticity {chromaticity}"
    elif matching is not None:
        name = f"matching {matching}"
    else:
        name = " ".join(part for part in ("observer", observer or "1931", space) if part)
    return re.sub(r"[^\w.+-]+", "-", name).strip("-.") or "plot"


WIDTH_INCHES = 8.0
"""Width of a figure whose pixels are given: they decide how fine it is, and not how large its type."""


def _pixels(size: str) -> tuple[int, int]:
    """Width and height as `1600x1000`."""
    from illuminant.errors import UsageError
    from illuminant.settings import size_of

    sides = size_of(size)
    if not (min(sides) >= 200 and max(sides) <= min(10_000, 3 * min(sides))):
        raise UsageError(
            f"--size {size}: expected width and height from 200 to 10000, at most three to one, such as 1600x1000."
        )
    return sides[0], sides[1]


def _diagram(
    spectra: list[Spectrum],
    kind: str,
    observer: str | None,
    light: str | None,
    gamuts: list[str],
    planckian: bool | None,
    look: dict[str, Any],
) -> Figure:
    """A chromaticity diagram with lamps, and reflectances under a light, as points."""
    from illuminant.cli.spectra.argument import load
    from illuminant.errors import UsageError
    from illuminant.plots import chromaticity
    from illuminant.plots.diagram import diagram

    lamp = load(light or "D65")
    if lamp.quantity != "emission":
        raise UsageError(f"--light {light}: expected a lamp, not {lamp.quantity or 'an unknown quantity'}.")
    lit = any(s.quantity == "reflectance" for s in spectra)
    if light is not None and not lit:
        raise UsageError("--light goes with reflectances, and none is named.")
    plane = diagram(kind, observer or "1931")
    # Where the light itself lies is where a grey does.
    if lit and lamp.name not in [s.name for s in spectra]:
        spectra = [lamp, *spectra]
    points: dict[str, Any] = {}
    for spectrum in spectra:
        alike = sum(name.partition(" (")[0] == spectrum.name for name in points)
        name = f"{spectrum.name} ({alike + 1})" if alike else spectrum.name
        points[name] = plane.point(spectrum, lamp)
    return chromaticity(plane, points, gamuts=gamuts, planckian=planckian, **look)
