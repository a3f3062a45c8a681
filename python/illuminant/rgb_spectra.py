"""Spectra for RGB: three numbers for the eye become a curve, once it is said what they are.

RGB has a role, and each role a constructor of its own: the albedo of a surface, the emission of a light, or raw
numbers that are no colour (a roughness, an index, a normal) and of which no spectrum is made. The curve is the smooth
sigmoid of Jakob and Hanika (2019), under the white of the RGB system; nothing is clamped, and how far its colour is
from the RGB asked for is returned with it.

Example:
    >>> red = rgb_albedo([0.8, 0.1, 0.1])
    >>> red.spectrum.quantity, red.delta_e < 0.1
    ('reflectance', True)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectrum import RANGE_NM, Spectrum, floats, whole_range

__all__ = ["FromRgb", "RawRgb", "rgb_albedo", "rgb_emission", "rgb_raw"]


class FromRgb(NamedTuple):
    """A spectrum made of RGB.

    Attributes:
        spectrum: the curve.
        delta_e: CIEDE2000 between the RGB and the curve's colour under the white of the RGB system; above about 0.5
            there is no smooth spectrum of that colour, and this is the nearest.
    """

    spectrum: Spectrum
    delta_e: float


class RawRgb(NamedTuple):
    """Three numbers that are stored as RGB and are no colour."""

    red: float
    green: float
    blue: float


def rgb_albedo(rgb: Sequence[float], system: str = "sRGB", range_nm: Sequence[int] = RANGE_NM) -> FromRgb:
    """The reflectance of a surface whose colour is RGB.

    Args:
        rgb: linear values, each in [0, 1]; (1, 1, 1) reflects all light.
        system: name of the RGB system (`illuminant.rgb_system`).
        range_nm: wavelengths of the curve, at 1 nm; the ends hold outside.

    Raises:
        DataError: a value outside [0, 1].
        UsageError: no such RGB system.

    Example:
        >>> set(rgb_albedo([0.5, 0.5, 0.5]).spectrum.values)
        {0.5}
    """
    values = _three(rgb)
    if not all(0.0 <= value <= 1.0 for value in values):
        raise DataError(f"RGB of the role albedo must be from 0 to 1, found {list(values)}")
    wavelengths, curve, delta_e = core().upsample_albedo(list(values), _known(system), whole_range(range_nm))
    origin = f"Jakob and Hanika (2019) from {system}"
    points = (tuple(wavelengths.tolist()), tuple(curve.tolist()))
    return FromRgb(Spectrum(_name(values), *points, "hold", "1", origin, "reflectance"), delta_e)


def rgb_emission(rgb: Sequence[float], system: str = "sRGB", range_nm: Sequence[int] = RANGE_NM) -> FromRgb:
    """The light of a lamp whose colour is RGB; (1, 1, 1) is the white of the system.

    Args:
        rgb: linear values, at least 0, of any size.
        system: name of the RGB system (`illuminant.rgb_system`).
        range_nm: wavelengths of the curve, at 1 nm; zero outside.

    Returns:
        A relative spectrum: its XYZ, with K_m included, is that of the RGB in its system (Y = 1 for the white).

    Raises:
        DataError: a value below 0.
        UsageError: no such RGB system.

    Example:
        >>> round(float(rgb_emission([1, 1, 1]).spectrum.xyz()[1]), 6)
        1.0
    """
    values = _three(rgb)
    if not all(value >= 0.0 for value in values):
        raise DataError(f"RGB of the role emission must be at least 0, found {list(values)}")
    wavelengths, curve, delta_e = core().upsample_emission(
        list(values), _known(system), whole_range(range_nm)
    )
    origin = f"Jakob and Hanika (2019) from {system}"
    points = (tuple(wavelengths.tolist()), tuple(curve.tolist()))
    return FromRgb(Spectrum(_name(values), *points, "zero", "relative", origin, "emission"), delta_e)


def rgb_raw(rgb: Sequence[float]) -> RawRgb:
    """Three numbers that are no colour: kept as they are, and no spectrum.

    Raises:
        DataError: not three finite numbers.

    Example:
        >>> rgb_raw([0.5, 0.5, 1.0])
        RawRgb(red=0.5, green=0.5, blue=1.0)
    """
    return RawRgb(*_three(rgb))


def _three(rgb: Sequence[float]) -> tuple[float, ...]:
    values = floats(rgb, "RGB")
    if len(values) != 3 or not all(map(math.isfinite, values)):
        raise DataError(f"RGB is three finite numbers, not {list(values)}")
    return values


def _known(system: str) -> str:
    known = list(core().rgb_systems())
    if system not in known:
        raise UsageError(f"There is no RGB system {system!r}: known are {', '.join(known)}.")
    return system


def _name(rgb: tuple[float, ...]) -> str:
    return f"rgb {' '.join(f'{value:g}' for value in rgb)}"
