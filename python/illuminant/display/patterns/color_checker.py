"""The ColorChecker in the display's own colours (book figure 5.2).

Twenty-four patches in four rows of six, on black: beside the real chart under D65 each should match. Colours follow
from the measured reflectances of the library by 1 nm, under D65 or another lamp, and are adapted from that lamp's white
to the display's (Bradford; nothing changes when both are D65). A perfect diffuser is the display's white, so the white
patch has Y = 0.89 of it.

| chart | colours |
| --- | --- |
| "measured" | mean of 30 charts (BabelColor 2012), under `light` |
| "Ohta" | N. Ohta (1997), ISO 17321-1, under `light` |
| "book" | XYZ as figure 5.2 prints them |
| "book adapted" | the same, adapted from illuminant C to the display's white |

The printed table is scaled so that the brightest patch has Y = 1 and the darkest is black. It is relative to
illuminant C (its white has x, y = 0.310, 0.316), though it is meant for a monitor of D6500: there its white is
(1.030, 0.969, 1.096) with the NTSC primaries, a bluish tint, and beyond the display (ERRATA 59).

Patches outside the display's gamut are named by `patches`, and clamped in the pattern; with sRGB that is cyan.

References: McCamy, Marcus and Davidson (1976), A color-rendition chart; CIE 15:2018.

Example:
    >>> found = patches("sRGB")
    >>> found.outside, found.names[18], found.codes[18].round(2).tolist()
    (('cyan',), 'white 9.5', [0.96, 0.96, 0.94])
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.patterns.screen import Screen
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.displays import Display
    from illuminant.display.patterns.screen import Values
    from illuminant.spectrum import Spectrum

    Array = NDArray[np.float64]

__all__ = [
    "BOOK",
    "CHARTS",
    "NAMES",
    "Patches",
    "chart_xyz",
    "color_checker",
    "note",
    "patches",
    "reflectances",
]

CHARTS = ("measured", "Ohta", "book", "book adapted")

NAMES = (
    "dark skin", "light skin", "blue sky", "foliage", "blue flower", "bluish green",
    "orange", "purplish blue", "moderate red", "purple", "yellow green", "orange yellow",
    "blue", "green", "red", "yellow", "magenta", "cyan",
    "white 9.5", "neutral 8", "neutral 6.5", "neutral 5", "neutral 3.5", "black 2",
)  # fmt: skip
"""The patches, in rows from the top."""

BOOK = (
    (0.092, 0.081, 0.058), (0.411, 0.376, 0.303), (0.183, 0.186, 0.373),
    (0.094, 0.117, 0.067), (0.269, 0.244, 0.503), (0.350, 0.460, 0.531),
    (0.386, 0.311, 0.066), (0.123, 0.102, 0.359), (0.284, 0.192, 0.151),
    (0.059, 0.040, 0.102), (0.368, 0.474, 0.127), (0.497, 0.460, 0.094),
    (0.050, 0.035, 0.183), (0.149, 0.234, 0.106), (0.176, 0.102, 0.048),
    (0.614, 0.644, 0.112), (0.300, 0.192, 0.332), (0.149, 0.192, 0.421),
    (0.981, 1.000, 1.184), (0.632, 0.644, 0.763), (0.374, 0.381, 0.451),
    (0.189, 0.192, 0.227), (0.067, 0.068, 0.080), (0.000, 0.000, 0.000),
)  # fmt: skip
"""XYZ of figure 5.2, relative to illuminant C, the white patch Y = 1."""

OUTSIDE = 1e-3
"""A patch lies outside the gamut when a linear value leaves 0 to 1 by more than this: less is not seen."""


@dataclass(frozen=True)
class Patches:
    """The chart on a display.

    Attributes:
        names: of the patches.
        xyz: (24, 3) what is asked for, cd/m².
        linear: (24, 3) linear values that give it, unclamped.
        codes: (24, 3) code values, clamped to 0 to 1.
        outside: names of the patches that were clamped.
        white: luminance of a perfect diffuser, cd/m².
    """

    names: tuple[str, ...]
    xyz: Array
    linear: Array
    codes: Array
    outside: tuple[str, ...]
    white: float


def reflectances(chart: str = "measured") -> list[Spectrum]:
    """The reflectances of the 24 patches of a chart, "measured" or "Ohta"."""
    from illuminant import spectra

    group = "ColorChecker Ohta" if chart == "Ohta" else "ColorChecker"
    return [spectra.load(f"{group}/{name}") for name in NAMES]


def chart_xyz(white: tuple[float, float], chart: str = "measured", light: str = "D65") -> Array:
    """XYZ (24, 3) of the chart beside a white, relative: a perfect diffuser has Y = 1.

    Args:
        white: x and y of the display's white.
        chart: a name of `CHARTS`.
        light: the lamp on the measured charts: a name of the library, `2856K`, or a file.

    Raises:
        UsageError: there is no such chart.
        DataError: there is no such light, or it is no lamp.
    """
    import numpy as np

    from illuminant import color, spectrum_word

    if chart not in CHARTS:
        raise UsageError(f"A chart is {', '.join(CHARTS[:-1])} or {CHARTS[-1]}, not {chart!r}.")
    if chart == "book":
        return np.array(BOOK)
    if chart == "book adapted":
        # The white of the table itself, so that its greys become the display's.
        return np.asarray(color.adapt(np.array(BOOK), BOOK[18], color.white_xyz(white), method="Bradford"))
    lamp = spectrum_word.light(light)
    curves = reflectances(chart)
    nm = curves[0].wavelengths_nm
    values = np.stack([np.ones_like(curves[0].values), *(curve.values for curve in curves)])
    xyz = color.spectra_to_xyz(values, nm, illuminant=lamp)
    return np.asarray(color.adapt(xyz[1:], xyz[0].tolist(), color.white_xyz(white), method="Bradford"))


def patches(
    display: Display | str, chart: str = "measured", light: str = "D65", white_luminance: float | None = None
) -> Patches:
    """The chart on a display, with the patches that it cannot show.

    Args:
        display: a `Display`, or a name of one.
        chart: a name of `CHARTS`.
        light: the lamp on the measured charts.
        white_luminance: of a perfect diffuser, cd/m²; default that at which the display shows it.
    """
    import numpy as np

    from illuminant.display.displays import named

    shown = named(display)
    level = white_luminance or shown.shown_white
    xyz = chart_xyz(shown.white, chart, light) * level
    linear = np.asarray(shown.from_xyz(xyz), np.float64)
    beyond = np.asarray(((linear < -OUTSIDE) | (linear > 1.0 + OUTSIDE)).any(axis=1))
    codes = np.clip(shown.encode(np.clip(linear, 0.0, 1.0)), 0.0, 1.0)
    names = tuple(name for name, out in zip(NAMES, beyond.tolist(), strict=True) if out)
    return Patches(NAMES, xyz, linear, np.asarray(codes, np.float64), names, level)


def note(screen: Screen, *, chart: str = "measured", light: str = "D65") -> list[str]:
    """What a person should know of the pattern: patches that are not shown right, and the tint of the book's table."""
    found = patches(screen.display, chart, light)
    lines = []
    if chart == "book":
        lines.append(
            "The table of figure 5.2 is relative to illuminant C: its white is bluish on this display "
            '("book adapted" takes it to the display\'s white).'
        )
    if found.outside:
        lines.append(f"Outside the gamut of {screen.display.name}, and clamped: {', '.join(found.outside)}.")
    return lines


def color_checker(screen: Screen, *, chart: str = "measured", light: str = "D65") -> Values:
    """The chart: 6 by 4 square patches on black, as large as the screen allows."""
    codes = patches(screen.display, chart, light).codes
    values = screen.blank()
    # A patch is six times as wide as the gap around it.
    unit = min(screen.width / (6 * 7 + 1), screen.height / (4 * 7 + 1))
    left, top = (screen.width - unit * 43) / 2, (screen.height - unit * 29) / 2
    for index, code in enumerate(codes.tolist()):
        row, column = divmod(index, 6)
        x, y = left + unit * (1 + 7 * column), top + unit * (1 + 7 * row)
        values[round(y) : round(y + 6 * unit), round(x) : round(x + 6 * unit)] = code
    return values
