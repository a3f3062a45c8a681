"""Matching colours with three lights (book 3.2, figures 3.2 to 3.7).

Three lights match a test light when both sides have the same XYZ: M a = XYZ, where the columns of M are the XYZ of the
three at amount 1. The amounts are a = M⁻¹ XYZ, and the matching functions of the three are M⁻¹ (x̄, ȳ, z̄). A negative
amount means that the light has to be added to the test side.

A primary is a wavelength in nm (a line of power 1), or a spectrum: a library name, an `illuminant.spectra.Spectrum`, or
a pair of wavelengths and values, in power for each nm.

Example:
    >>> lines = matching_functions((445, 535, 630), [445, 500, 535, 630]).round(3) + 0.0
    >>> lines[[0, 2, 3]].tolist()                        # each line matches itself
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    >>> bool(lines[1, 2] < 0)                            # red is needed on the side of blue-green
    True
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.color.rgb import inverse, transform
from illuminant.color.spectral import observer_table, spectra_to_xyz, spectrum_points
from illuminant.color.triples import floating
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.spectra import Spectrum

    Float64 = NDArray[np.float64]
    Light = float | str | Spectrum | tuple[ArrayLike, ArrayLike]

__all__ = ["matching_amounts", "matching_functions", "primaries_to_xyz"]

_Observer = Any


def _line_xyz(wavelengths_nm: ArrayLike, observer: _Observer) -> Float64:
    """x̄, ȳ, z̄ at wavelengths (m,)."""
    import numpy as np

    wanted = floating(wavelengths_nm, "wavelengths")
    known, matching = observer_table(observer)
    columns = [np.interp(wanted, known, matching[:, c], left=0.0, right=0.0) for c in range(3)]
    return np.stack(columns, axis=-1)


def _light_xyz(light: Light, observer: _Observer, range_nm: Sequence[float]) -> Float64:
    """Σ c̄ S, the XYZ of a light without 683 lm/W."""
    if isinstance(light, int | float):
        return _line_xyz(light, observer)
    wavelengths, values, outside = spectrum_points(light)
    xyz = spectra_to_xyz(
        values,
        wavelengths,
        observer=observer,
        scale="absolute",
        outside="hold" if outside == "hold" else "zero",
        range_nm=range_nm,
    )
    found: Float64 = (xyz / 683.0).astype("float64", copy=False)
    return found


def primaries_to_xyz(
    primaries: Sequence[Light],
    *,
    observer: _Observer = "CIE 1931 2 deg",
    range_nm: Sequence[float] = (380, 780),
) -> Float64:
    """The matrix M (3, 3) whose columns are the XYZ of three lights (without the factor 683 lm/W).

    Args:
        primaries: three lights, as this module says.
        observer: as `illuminant.color.spectra_to_xyz`.
        range_nm: of the sums over spectra.

    Raises:
        UsageError: there are not three, or one can be matched by the other two.

    Example:
        >>> primaries_to_xyz((445, 535, 630))[1].round(4).tolist()      # ȳ at the three lines
        [0.0298, 0.9149, 0.265]
    """
    import numpy as np

    if isinstance(primaries, str) or len(primaries) != 3:
        raise UsageError("Colour matching needs three lights.")
    matrix = np.stack([_light_xyz(light, observer, range_nm) for light in primaries], axis=1)
    try:
        inverse(matrix)
    except UsageError as error:
        raise UsageError(f"One of the three lights can be matched by the other two: {error}") from error
    return matrix


def matching_functions(
    primaries: Sequence[Light],
    wavelengths_nm: ArrayLike,
    *,
    observer: _Observer = "CIE 1931 2 deg",
    range_nm: Sequence[float] = (380, 780),
) -> Float64:
    """How much of three lights matches a line of power 1 at each wavelength.

    Args:
        primaries: three lights, as this module says.
        wavelengths_nm: (m,).
        observer, range_nm: as `primaries_to_xyz`.

    Returns:
        (m, 3), negative where the light goes to the test side.

    Raises:
        UsageError: as `primaries_to_xyz`.

    Example:
        >>> bool(matching_functions((445, 535, 630), range(380, 781)).min() < -0.05)
        True
    """
    matrix = inverse(primaries_to_xyz(primaries, observer=observer, range_nm=range_nm))
    functions: Float64 = transform(matrix, _line_xyz(wavelengths_nm, observer)).astype("float64", copy=False)
    return functions


def matching_amounts(
    test: Light,
    primaries: Sequence[Light],
    *,
    observer: _Observer = "CIE 1931 2 deg",
    range_nm: Sequence[float] = (380, 780),
) -> Float64:
    """How much of three lights matches a test light: the colour-matching experiment (book figures 3.2 and 3.4).

    Args:
        test: the light to be matched.
        primaries: the three lights that match it.
        observer, range_nm: as `primaries_to_xyz`.

    Returns:
        Three amounts; a negative one is added to the test light instead.

    Raises:
        UsageError: as `primaries_to_xyz`.

    Example:
        >>> (matching_amounts(535, (445, 535, 630)).round(12) + 0.0).tolist()
        [0.0, 1.0, 0.0]
    """
    matrix = inverse(primaries_to_xyz(primaries, observer=observer, range_nm=range_nm))
    amounts: Float64 = transform(matrix, _light_xyz(test, observer, range_nm)).astype("float64", copy=False)
    return amounts
