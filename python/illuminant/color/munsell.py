"""Munsell notation: hue, value and chroma of a painted chip, such as `5R 4/14` or `N 5/`.

The renotation data (Newhall, Nickerson and Judd 1943) and the interpolation within them (ASTM D1535) are those of
colour-science, an optional package: `pip install illuminant[munsell]`. Colours are those of the chips under
illuminant C, 2° observer, with Y = 1 for a perfect diffuser; adapt them to another white with `adapt`.

Example:
    >>> parse_munsell("5R 4/14"), parse_munsell("N 5/").chroma
    (Munsell(hue='5R', value=4.0, chroma=14.0), 0.0)
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant.color.chromaticity import xyy_to_xyz, xyz_to_xyy
from illuminant.errors import MachineError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Munsell", "munsell_to_xyz", "parse_munsell", "xyz_to_munsell"]

_NUMBER = r"(\d+(?:\.\d+)?|\.\d+)"
_NEUTRAL = re.compile(rf"N\s*{_NUMBER}\s*/?\s*(?:0(?:\.0*)?)?", re.IGNORECASE)
_COLOUR = re.compile(rf"{_NUMBER}\s*(BG|GY|YR|RP|PB|B|G|Y|R|P)\s*{_NUMBER}\s*/\s*{_NUMBER}", re.IGNORECASE)


class Munsell(NamedTuple):
    """A colour in Munsell notation.

    Attributes:
        hue: number and letters, as "5YR"; "N" for neutral colours.
        value: lightness, 0 black to 10 white.
        chroma: distance from the neutral axis, 0 on it.
    """

    hue: str
    value: float
    chroma: float

    def __str__(self) -> str:
        """The notation."""
        if self.hue == "N":
            return f"N {self.value:g}/"
        return f"{self.hue} {self.value:g}/{self.chroma:g}"


def parse_munsell(notation: str) -> Munsell:
    """Hue, value and chroma of a notation; a chroma of 0 makes the hue "N".

    Raises:
        UsageError: it is no Munsell notation, or its value or hue is above 10.

    Example:
        >>> str(parse_munsell("2.5 yr 6/0"))
        'N 6/'
    """
    text = str(notation).strip()
    neutral, colour = _NEUTRAL.fullmatch(text), _COLOUR.fullmatch(text)
    if neutral:
        found = Munsell("N", float(neutral[1]), 0.0)
    elif colour:
        step, value, chroma = (float(colour[i]) for i in (1, 3, 4))
        if step > 10.0:
            raise UsageError(f"The steps of a Munsell hue run from 0 to 10, and {text!r} has {step:g}.")
        found = Munsell(f"{step:g}{colour[2].upper()}" if chroma else "N", value, chroma)
    else:
        raise UsageError(f"{text!r} is no Munsell notation; expected one like '5R 4/14' or 'N 5/'.")
    if found.value > 10.0:
        raise UsageError(f"A Munsell value runs from 0 to 10, and that of {text!r} is {found.value:g}.")
    return found


def _asked(function: str) -> Callable[[Any], Any]:
    """A function of colour-science."""
    import numpy as np

    # It warns of packages that it does without, and changes how NumPy prints: neither is asked for here.
    with warnings.catch_warnings(), np.printoptions():
        warnings.simplefilter("ignore")
        try:
            import colour
        except ImportError as error:
            raise MachineError(
                "Munsell notation needs the package colour-science: pip install 'illuminant[munsell]'."
            ) from error
    found: Callable[[Any], Any] = getattr(colour, function)
    return found


def munsell_to_xyz(notation: str | Sequence[str]) -> NDArray[np.float64]:
    """XYZ under illuminant C of Munsell notations.

    Args:
        notation: one, or a list of n.

    Returns:
        (3,) or (n, 3), Y = 1 for a perfect diffuser.

    Raises:
        UsageError: a notation is not one, or lies outside the renotation data.
        MachineError: colour-science is not installed.
    """
    import numpy as np

    single = isinstance(notation, str)
    asked = _asked("munsell_colour_to_xyY")
    rows = []
    for text in [notation] if isinstance(notation, str) else notation:
        colour = parse_munsell(text)
        # That package writes a grey without the stroke.
        written = f"N{colour.value:.6f}" if colour.hue == "N" else str(colour)
        try:
            rows.append(np.asarray(asked(written), np.float64))
        except (AssertionError, ValueError) as error:
            raise UsageError(f"{text!r} lies outside the Munsell renotation data.") from error
    xyz: NDArray[np.float64] = xyy_to_xyz(np.reshape(rows, (-1, 3))).astype(np.float64, copy=False)
    return xyz[0] if single else xyz


def xyz_to_munsell(xyz: ArrayLike) -> Munsell | list[Munsell]:
    """The Munsell notation of XYZ seen under illuminant C: a search, some hundredths of a second for each colour.

    Args:
        xyz: (3,) or (n, 3), Y = 1 for a perfect diffuser.

    Returns:
        A `Munsell`, or a list of n.

    Raises:
        UsageError: the array has another shape, or a colour lies outside the renotation data.
        MachineError: colour-science is not installed.
    """
    import numpy as np

    xyy = xyz_to_xyy(np.asarray(xyz, np.float64))
    if xyy.ndim > 2:
        raise UsageError(f"Munsell notations are found for (3,) or (n, 3), not for {xyy.shape}.")
    asked = _asked("xyY_to_munsell_colour")
    found = []
    for row in np.reshape(xyy, (-1, 3)):
        try:
            found.append(parse_munsell(str(asked(row))))
        except (AssertionError, ValueError, RuntimeError) as error:
            raise UsageError(
                f"xyY {row.round(4).tolist()} lies outside the Munsell renotation data."
            ) from error
    return found[0] if xyy.ndim == 1 else found
