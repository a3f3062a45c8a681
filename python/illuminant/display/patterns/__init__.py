"""Test patterns by name, for any display, size and number of bits (book 5.4; figures 5.2, 5.16-19, 5.24, 5.28).

| module | patterns |
| --- | --- |
| `field` | field, window, black, white |
| `pluge` | pluge |
| `color_bars` | eia, smpte; their levels in IRE and as vectors |
| `gamma_chart` | gamma |
| `ramp` | ramp, steps, shadows |
| `color_checker` | colorchecker |
| `wedges` | wedges |
| `convergence` | crosshatch, dots |
| `safe_areas` | safe-areas; what of a picture lies outside |

Every pattern is a function of a `Screen` and options by keyword that gives code values (h, w, 3) from 0 to 1; a new
one is its module, and an entry of `PATTERNS` below. The same arguments give the same bits.

Errors: `UsageError` for a name, option or value that is not possible; the sentence says what is.

Example:
    >>> values = draw("window", Screen(64, 48), color=0.5, window=0.25)
    >>> values.shape, values[24, 32].tolist()
    ((48, 64, 3), [0.5, 0.5, 0.5])
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError, suggestion

if TYPE_CHECKING:
    import os

    from illuminant.display.patterns.screen import Values
    from illuminant.display.picture import Picture

__all__ = ["PATTERNS", "Pattern", "Screen", "draw", "names", "notes", "options", "picture", "save"]


@dataclass(frozen=True)
class Pattern:
    """One entry of the registry.

    Attributes:
        module, function: where it is drawn.
        summary: what it is for, in a line.
        bits: of a code value when nobody says.
        loaded_raw: whether its values are signals, the same on every display.
    """

    module: str
    function: str
    summary: str
    bits: int = 8
    loaded_raw: bool = True


PATTERNS = {
    "field": Pattern("field", "field", "the whole screen in one colour"),
    "window": Pattern("field", "window", "a box of one colour in the middle, for a meter"),
    "black": Pattern("field", "black", "a black screen, for warming up"),
    "white": Pattern("field", "white", "a white screen"),
    "pluge": Pattern("pluge", "pluge", "bars 4 % above and below black, for brightness"),
    "smpte": Pattern("color_bars", "smpte", "SMPTE ECR 1-1978 bars: split bars for chroma and hue, PLUGE"),
    "eia": Pattern("color_bars", "eia", "EIA RS-189-A bars for a frame buffer: -I and +Q lifted"),
    "gamma": Pattern("gamma_chart", "gamma_chart", "patches on lines that vanish at the display's gamma"),
    "ramp": Pattern("ramp", "ramp", "from black to full in grey, red, green and blue"),
    "steps": Pattern("ramp", "steps", "a grey scale in steps, both ways"),
    "shadows": Pattern("ramp", "shadows", "a ramp near black, in steps of 8 and of 10 bits", bits=10),
    "colorchecker": Pattern(
        "color_checker", "color_checker", "the 24 patches in the display's colours", 8, False
    ),
    "wedges": Pattern("wedges", "wedges", "resolution along Y, I and Q"),
    "crosshatch": Pattern("convergence", "crosshatch", "lines around squares, for convergence and size"),
    "dots": Pattern("convergence", "dots", "dots, for convergence"),
    "safe-areas": Pattern("safe_areas", "safe_areas", "safe action and safe title"),
}
"""The patterns by name."""


def names() -> list[str]:
    """Names of the patterns.

    Example:
        >>> names()[:3]
        ['field', 'window', 'black']
    """
    return list(PATTERNS)


def _pattern(name: str) -> Pattern:
    found = PATTERNS.get(name)
    if found is None:
        hint = suggestion(name, PATTERNS)
        raise UsageError(
            f"There is no pattern {name!r}{f' ({hint})' if hint else ''}: there are {', '.join(PATTERNS)}."
        )
    return found


def _function(pattern: Pattern, name: str) -> Callable[..., Any] | None:
    module = import_module(f"illuminant.display.patterns.{pattern.module}")
    return getattr(module, name, None)


def options(name: str) -> dict[str, Any]:
    """Options of a pattern and their defaults.

    Example:
        >>> options("window")
        {'color': 1.0, 'window': 0.3, 'background': 0.0}
    """
    pattern = _pattern(name)
    function = _function(pattern, pattern.function)
    assert function is not None
    parameters = list(inspect.signature(function).parameters.values())[1:]
    return {parameter.name: parameter.default for parameter in parameters}


def _checked(name: str, given: dict[str, Any]) -> None:
    known = options(name)
    for word in given:
        if word not in known:
            its = f"its options are {', '.join(known)}" if known else "it has no options"
            raise UsageError(f"The pattern {name} has no option {word}: {its}.")


def draw(name: str, screen: Screen | None = None, **given: Any) -> Values:
    """Code values (h, w, 3), 0 to 1, of a pattern.

    Args:
        name: of the pattern.
        screen: what it is drawn for; default 1920x1080 pixels of an sRGB display, 8 bits or what the pattern needs.
        given: options of the pattern (`options`).

    Raises:
        UsageError: name, options or values are not possible.
    """
    pattern = _pattern(name)
    _checked(name, given)
    function = _function(pattern, pattern.function)
    assert function is not None
    values: Values = function(screen or Screen(bits=pattern.bits), **given)
    return values


def notes(name: str, screen: Screen | None = None, **given: Any) -> list[str]:
    """What a person should know of a pattern on this screen; mostly nothing."""
    pattern = _pattern(name)
    _checked(name, given)
    function = _function(pattern, "note")
    found: list[str] = function(screen or Screen(bits=pattern.bits), **given) if function else []
    return found


def picture(name: str, screen: Screen | None = None, *, blue_only: bool = False, **given: Any) -> Picture:
    """A pattern as the codes of its display, with texts that say how it was drawn.

    Args:
        name, screen, given: as for `draw`.
        blue_only: with red and green at 0, as a monitor shows it whose other guns are off.
    """
    import json

    from illuminant.display.patterns import color_bars
    from illuminant.display.picture import Picture

    screen = screen or Screen(bits=_pattern(name).bits)
    values = draw(name, screen, **given)
    settings = {
        "pattern": name,
        "size": [screen.width, screen.height],
        "bits": screen.bits,
        "display": screen.display.name,
        **({"blue_only": True} if blue_only else {}),
        **{word: list(value) if isinstance(value, tuple) else value for word, value in given.items()},
    }
    text = {"Description": f"test pattern {name}", "Settings": json.dumps(settings)}
    return Picture.of_values(
        color_bars.blue_only(values) if blue_only else values, screen.display, screen.bits, text
    )


def save(
    path: str | os.PathLike[str],
    name: str,
    screen: Screen | None = None,
    *,
    blue_only: bool = False,
    **given: Any,
) -> None:
    """Save a pattern as a PNG that states its display, atomically; arguments as for `picture`.

    Raises:
        UsageError: name, options or values are not possible.
        ImageError, MachineError: the file cannot be written.
    """
    picture(name, screen, blue_only=blue_only, **given).save(path)
