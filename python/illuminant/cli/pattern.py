"""`illuminant pattern`: test patterns for any display, size and number of bits."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from illuminant.cli.options import Json
from illuminant.cli.words import numbers

__all__ = ["code_values", "pattern"]


def pattern(
    name: Annotated[str, typer.Argument(metavar="NAME", help="A pattern, or list.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="A .png (NAME.png).", show_default=False),
    ] = None,
    display: Annotated[
        str, typer.Option("--display", metavar="NAME", help="Display by name, .toml or .icc.")
    ] = "sRGB",
    size: Annotated[str, typer.Option("--size", metavar="WxH", help="Pixels.")] = "1920x1080",
    bits: Annotated[
        int | None,
        typer.Option(
            "--bits", metavar="N", help="Bits a channel (8; shadows has 10 or more).", show_default=False
        ),
    ] = None,
    color: Annotated[
        str | None,
        typer.Option(
            "--color",
            metavar="R,G,B",
            help="Code values 0-1 of field, window, lines; one for a grey.",
            show_default=False,
        ),
    ] = None,
    background: Annotated[
        str | None,
        typer.Option(
            "--background", metavar="R,G,B", help="Code values around window or areas.", show_default=False
        ),
    ] = None,
    window: Annotated[
        float | None,
        typer.Option(
            "--window", metavar="F", help="Side of the window, of the screen's (0.3).", show_default=False
        ),
    ] = None,
    levels: Annotated[
        str | None,
        typer.Option("--levels", metavar="NAME", help="PLUGE: frame-buffer or video.", show_default=False),
    ] = None,
    setup: Annotated[
        float | None,
        typer.Option("--setup", metavar="IRE", help="Bars: level of black (7.5).", show_default=False),
    ] = None,
    blue_only: Annotated[bool, typer.Option("--blue-only", help="Red and green off.")] = False,
    channel: Annotated[
        str | None,
        typer.Option("--channel", metavar="NAME", help="Ramp: grey, red, green, blue.", show_default=False),
    ] = None,
    even: Annotated[
        str | None,
        typer.Option(
            "--even", metavar="IN", help="Ramp, steps: even in code or light (code).", show_default=False
        ),
    ] = None,
    count: Annotated[
        int | None,
        typer.Option("--count", metavar="N", help="Steps, or squares in the height.", show_default=False),
    ] = None,
    level: Annotated[
        float | None,
        typer.Option("--level", metavar="V", help="Shadows: code value at the right.", show_default=False),
    ] = None,
    weave: Annotated[
        str | None,
        typer.Option("--weave", metavar="NAME", help="Gamma chart: lines or checker.", show_default=False),
    ] = None,
    chart: Annotated[
        str | None,
        typer.Option(
            "--chart",
            metavar="NAME",
            help="ColorChecker: measured, Ohta, book, book adapted.",
            show_default=False,
        ),
    ] = None,
    light: Annotated[
        str | None,
        typer.Option("--light", metavar="LAMP", help="ColorChecker: lamp on it (D65).", show_default=False),
    ] = None,
    axis: Annotated[
        str | None,
        typer.Option("--axis", metavar="NAME", help="Wedges: Y, I or Q alone.", show_default=False),
    ] = None,
    lines: Annotated[
        int | None,
        typer.Option(
            "--lines", metavar="N", help="Wedges: the finest, per picture height.", show_default=False
        ),
    ] = None,
    coarsest: Annotated[
        int | None,
        typer.Option("--coarsest", metavar="N", help="Wedges: the coarsest (30).", show_default=False),
    ] = None,
    standard: Annotated[
        str | None,
        typer.Option(
            "--standard", metavar="NAME", help="Safe areas: RP 27.3 or ST 2046-1.", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Draw a test pattern as a PNG that states its display, or list the patterns and their options.

    \b
    Example:
      illuminant pattern list
      illuminant pattern window --color 0.5 --window 0.3 -o grey.png
      illuminant pattern colorchecker --display "Display P3" --bits 16
    """
    from illuminant.cli.report import emit_json, note, warning
    from illuminant.display import patterns
    from illuminant.display.patterns.screen import Screen
    from illuminant.errors import UsageError
    from illuminant.settings import size_of

    given: dict[str, Any] = {
        "color": color if color is None else code_values(color, "--color"),
        "background": background if background is None else code_values(background, "--background"),
        "window": window,
        "levels": levels,
        "setup": setup,
        "channel": channel,
        "even": even,
        "count": count,
        "level": level,
        "weave": weave,
        "chart": chart,
        "light": light,
        "axis": axis,
        "lines": lines,
        "coarsest": coarsest,
        "standard": standard,
    }
    given = {word: value for word, value in given.items() if value is not None}
    if name == "list":
        if given or output is not None or blue_only:
            raise UsageError("`illuminant pattern list` takes no options but --json.")
        _list(json)
        return
    known = patterns.options(name)
    for word in given:
        if word not in known:
            its = ", ".join(f"--{option}" for option in known)
            raise UsageError(
                f"--{word} does not go with {name}, {f'which has {its}' if its else 'which has none'}."
            )
    path = output or Path(f"{name}.png")
    if path.suffix.lower() != ".png":
        raise UsageError(f"{path}: a pattern is written as .png.")
    from illuminant.output import check

    check(path)
    width, height = size_of(size)
    screen = Screen(width, height, patterns.PATTERNS[name].bits if bits is None else bits, display)
    if blue_only and name not in ("smpte", "eia"):
        raise UsageError(f"--blue-only is a view of smpte and eia, not of {name}.")
    patterns.save(path, name, screen, blue_only=blue_only, **given)
    said = patterns.notes(name, screen, **given)
    for line in said:
        warning(line)
    if json:
        shown = screen.display.name
        emit_json({"file": path, "pattern": name, "size": [width, height], "bits": screen.bits,
                   "display": shown, "options": {**known, **given}, "notes": said})  # fmt: skip
    else:
        note(f"{path}: {name}, {width}x{height}, {screen.bits} bits, {screen.display.name}")


def _list(json: bool) -> None:
    """All patterns, with what they are for and their options."""
    from illuminant.cli.report import emit_json
    from illuminant.display import patterns

    if json:
        emit_json(
            {
                name: {"summary": entry.summary, "bits": entry.bits, "options": patterns.options(name)}
                for name, entry in patterns.PATTERNS.items()
            }
        )
        return
    for name, entry in patterns.PATTERNS.items():
        typer.echo(f"{name:<14}{entry.summary}")
        options = " ".join(f"--{option}" for option in patterns.options(name))
        if options:
            typer.echo(f"{'':<14}{options}")


def code_values(text: str, option: str) -> float | tuple[float, float, float]:
    """One code value, or three with commas between them.

    Raises:
        UsageError: they are not numbers from 0 to 1, or not one or three.
    """
    from illuminant.display.patterns.screen import rgb

    values = numbers(text, option, "a code value, or three such as 0.5,0.5,0.25", count=(1, 3))
    r, g, b = rgb(values[0] if len(values) == 1 else values, option)
    return r if len(values) == 1 else (r, g, b)
