"""Whites: the colour that counts as neutral.

A white is given as

- XYZ, three numbers, in the unit of the colours beside it;
- a chromaticity x, y, two numbers: XYZ with Y = 1;
- the name of an illuminant: for A, C, D50, D55, D60, D65, D75 and E the chromaticity that standards print (CIE
  15:2004, table T.3, 2° observer; D60 that of ACES, TB-2018-001), for any other lamp of `illuminant.spectra` what the
  CIE 1931 2° observer sees of its spectrum.

Example:
    >>> [round(value, 4) for value in white_xyz("D65")]
    [0.9505, 1.0, 1.0891]
    >>> white_xyz((0.25, 0.5))
    (0.5, 1.0, 0.5)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from illuminant.errors import UsageError

__all__ = ["CHROMATICITIES", "White", "white_xyz"]

White = str | Sequence[float]
"""A name, x and y, or XYZ."""

CHROMATICITIES = {
    "A": (0.44758, 0.40745),
    "C": (0.31006, 0.31616),
    "D50": (0.34570, 0.35850),
    "D55": (0.33243, 0.34744),
    "D60": (0.32168, 0.33767),
    "D65": (0.31270, 0.32900),
    "D75": (0.29903, 0.31488),
    "E": (1 / 3, 1 / 3),
}
"""x and y of the illuminants that standards print."""


def white_xyz(white: White | Any) -> tuple[float, float, float]:
    """XYZ of a white.

    Args:
        white: a name, (x, y) or (X, Y, Z); arrays serve as well.

    Raises:
        UsageError: it is none of the three, or not a colour that can be a white.
        DataError: there is no illuminant of that name.
    """
    if isinstance(white, str):
        pair = CHROMATICITIES.get(white.strip().upper())
        return white_xyz(pair) if pair else _of_lamp(white)
    try:
        numbers = [float(number) for number in white]
    except (TypeError, ValueError) as error:
        raise UsageError(f"A white is a name, x and y, or X, Y and Z, not {white!r}.") from error
    if len(numbers) == 2:
        x, y = numbers
        if not (y > 0.0 and x >= 0.0 and x + y <= 1.0):
            raise UsageError(
                f"A white's x and y must lie in the triangle of chromaticities, and {x}, {y} do not."
            )
        return x / y, 1.0, (1.0 - x - y) / y
    if len(numbers) == 3:
        if not all(0.0 < number < float("inf") for number in numbers):
            raise UsageError(f"A white's X, Y and Z must be above 0, and {numbers} are not.")
        return numbers[0], numbers[1], numbers[2]
    raise UsageError(f"A white is a name, x and y, or X, Y and Z, not {len(numbers)} numbers.")


def _of_lamp(name: str) -> tuple[float, float, float]:
    """XYZ with Y = 1 of a lamp of the library."""
    from illuminant import spectra
    from illuminant.color.spectral import spectra_to_xyz

    lamp = spectra.load(name)
    if lamp.quantity != "emission":
        raise UsageError(f"A white is the colour of a lamp, and {name!r} is no lamp.")
    x, y, z = spectra_to_xyz(lamp.values, lamp.wavelengths_nm).tolist()
    return x / y, 1.0, z / y
