"""From spectra to XYZ, for whole images.

XYZ_c = k Σ S(λ) c̄(λ) v(λ) over each nm of a range, with the spectrum v in straight lines between its bands, the
matching functions c̄ of an observer, and the illuminant S (1 without). That is linear in the n values of a spectrum, so
the weights (n, 3) are found once and an image is one product (..., n) × (n, 3); it gives what the 1 nm sums of each
pixel would give, to rounding. Sums are in float64 whatever the type of the input.

An observer is a name ("CIE 1931 2 deg"), or a pair: wavelengths in nm (m,) and matching functions (m, 3), in straight
lines between them and 0 outside. A spectrum that stands alone is the name of a library spectrum, an
`illuminant.spectra.Spectrum`, or a pair of wavelengths and values.

Example:
    >>> import numpy as np
    >>> bands = np.arange(380, 781, 5)
    >>> image = np.full((2, 2, 81), 0.5, np.float32)            # a grey of 50 %
    >>> xyz = spectra_to_xyz(image, bands, illuminant="D65")
    >>> xyz.shape, xyz.dtype.name, xyz[0, 0].astype(float).round(4).tolist()
    ((2, 2, 3), 'float32', [0.4752, 0.5, 0.5443])
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from illuminant.color.triples import asked, floating, output
from illuminant.errors import UsageError, suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.spectra import Spectrum

    Array = NDArray[np.floating[Any]]
    Float64 = NDArray[np.float64]

__all__ = ["observer_table", "observers", "spectra_to_xyz", "spectral_weights"]

_TABLES = Path(__file__).resolve().parents[1] / "data" / "observers"


def observers() -> list[str]:
    """Names of the observers that ship with illuminant.

    Example:
        >>> "cie 1931 2deg" in observers()
        True
    """
    return sorted(path.stem.replace("_", " ") for path in _TABLES.glob("*.csv"))


def observer_table(observer: str | tuple[ArrayLike, ArrayLike]) -> tuple[Float64, Float64]:
    """Wavelengths in nm (m,) and matching functions x̄, ȳ, z̄ (m, 3) of an observer.

    Args:
        observer: a name (case, blanks and underscores do not count), or a pair of such arrays, which is checked.

    Raises:
        UsageError: there is none of that name, or the pair has not these shapes.

    Example:
        >>> wavelengths, matching = observer_table("CIE 1931 2 deg")
        >>> matching[wavelengths == 555].round(4).tolist()
        [[0.5121, 1.0, 0.0057]]
    """
    if isinstance(observer, str):
        folded = {"".join(name.split()): name for name in observers()}
        name = folded.get("".join(observer.casefold().replace("_", " ").split()))
        if name is None:
            hint = suggestion(observer, folded.values())
            raise UsageError(f"There is no observer {observer!r}{'; ' + hint if hint else '.'}")
        return _table(name)
    try:
        wavelengths, matching = observer
    except (TypeError, ValueError) as error:
        raise UsageError("An observer is a name, or a pair of wavelengths and matching functions.") from error
    pair = floating(wavelengths, "wavelengths"), floating(matching, "matching functions")
    if pair[0].ndim != 1 or pair[1].shape != (len(pair[0]), 3):
        shapes = f"{pair[0].shape} and {pair[1].shape}"
        raise UsageError(f"An observer's arrays have shapes (m,) and (m, 3), not {shapes}.")
    return pair[0].astype("float64"), pair[1].astype("float64")


@functools.cache
def _table(name: str) -> tuple[Float64, Float64]:
    """The table of a shipped observer."""
    import numpy as np

    lines = (_TABLES / f"{name.replace(' ', '_')}.csv").read_text(encoding="utf-8").splitlines()
    rows = np.array([[float(field) for field in line.split(",")] for line in lines if line[:1].isdigit()])
    table = np.ascontiguousarray(rows[:, 0]), np.ascontiguousarray(rows[:, 1:4])
    for array in table:
        array.flags.writeable = False
    return table


def spectrum_points(
    spectrum: str | Spectrum | tuple[ArrayLike, ArrayLike], outside: str = "zero"
) -> tuple[list[float], list[float], str]:
    """Wavelengths, values and rule outside of a spectrum that stands alone; the rule of a pair is `outside`."""
    from illuminant import spectra

    if isinstance(spectrum, str):
        spectrum = spectra.load(spectrum)
    if isinstance(spectrum, spectra.Spectrum):
        if spectrum.outside == "error":
            raise UsageError(f"Spectrum {spectrum.name!r} must say what it is worth outside its range.")
        return list(spectrum.wavelengths_nm), list(spectrum.values), spectrum.outside
    try:
        wavelengths, values = spectrum
    except (TypeError, ValueError) as error:
        raise UsageError("A spectrum is a name, a Spectrum, or a pair of wavelengths and values.") from error
    pair = [floating(part, "points of a spectrum") for part in (wavelengths, values)]
    if any(part.ndim != 1 for part in pair):
        raise UsageError("The wavelengths and values of a spectrum are two lists of numbers.")
    return pair[0].tolist(), pair[1].tolist(), outside


def _weights(
    wavelengths_nm: ArrayLike,
    observer: str | tuple[ArrayLike, ArrayLike],
    illuminant: Any,
    scale: str,
    interpolation: str,
    outside: str | None,
    range_nm: Sequence[float],
) -> Any:
    """The weights of the core."""
    bands = floating(wavelengths_nm, "wavelengths")
    if bands.ndim != 1:
        raise UsageError(f"The wavelengths of the bands are one list, not an array of shape {bands.shape}.")
    wavelengths, matching = observer_table(observer)
    lamp = None if illuminant is None else spectrum_points(illuminant)
    rule = outside or ("zero" if illuminant is None else "hold")
    try:
        first, last = (float(end) for end in range_nm)
    except (TypeError, ValueError) as error:
        raise UsageError("A range is its first and its last wavelength.") from error
    arguments = (bands.tolist(), (wavelengths, matching), lamp, [first, last], rule, interpolation, scale)
    return asked("SpectralWeights", *arguments)


def spectral_weights(
    wavelengths_nm: ArrayLike,
    *,
    observer: str | tuple[ArrayLike, ArrayLike] = "CIE 1931 2 deg",
    illuminant: str | Spectrum | tuple[ArrayLike, ArrayLike] | None = None,
    scale: Literal["relative", "absolute"] = "relative",
    interpolation: Literal["linear", "none"] = "linear",
    outside: Literal["zero", "hold"] | None = None,
    range_nm: Sequence[float] = (380, 780),
) -> Float64:
    """The weights (n, 3) that take a spectrum of n bands to XYZ; arguments as `spectra_to_xyz`.

    Example:
        >>> weights = spectral_weights([400, 500, 600, 700], outside="hold")
        >>> round(float(weights[:, 1].sum()), 12)
        1.0
    """
    import numpy as np

    weights = _weights(wavelengths_nm, observer, illuminant, scale, interpolation, outside, range_nm)
    return np.array(weights.rows).T


def spectra_to_xyz(
    spectra: ArrayLike,
    wavelengths_nm: ArrayLike,
    *,
    observer: str | tuple[ArrayLike, ArrayLike] = "CIE 1931 2 deg",
    illuminant: str | Spectrum | tuple[ArrayLike, ArrayLike] | None = None,
    scale: Literal["relative", "absolute"] = "relative",
    interpolation: Literal["linear", "none"] = "linear",
    outside: Literal["zero", "hold"] | None = None,
    range_nm: Sequence[float] = (380, 780),
    out: Array | None = None,
) -> Array:
    """XYZ (..., 3) of spectra (..., n).

    Args:
        spectra: values at the bands; reflectances when there is an illuminant, light when there is none.
        wavelengths_nm: wavelengths of the n bands, nm, increasing, at any distances.
        observer: as this module says.
        illuminant: the lamp's spectrum, 0 outside its range; None for spectra that are light themselves.
        scale: "relative": a spectrum of 1 everywhere has Y = 1; "absolute": 683 lm/W, so that a radiance in
            W·sr⁻¹·m⁻²·nm⁻¹ gives cd/m².
        interpolation: "linear": straight lines between bands, summed at 1 nm; "none": each band stands for its own
            width, and matching functions and illuminant are read there (for equal steps Σ S c̄ v Δλ of CIE 15).
        outside: what a spectrum is worth beyond its bands; default "hold" with an illuminant, "zero" without.
        range_nm: first and last wavelength of the sum, whole nm; bands outside count nothing.
        out: array (..., 3) of the type of the spectra to fill.

    Returns:
        XYZ, float32 for float32 spectra, else float64.

    Raises:
        UsageError: shapes do not fit, wavelengths do not increase, or a name is not known.

    Example:
        >>> spectra_to_xyz([1.0, 1.0], [360, 830], range_nm=(360, 830)).round(3).tolist()
        [1.0, 1.0, 1.0]
    """
    import numpy as np

    weights = _weights(wavelengths_nm, observer, illuminant, scale, interpolation, outside, range_nm)
    array = floating(spectra, "spectra")
    bands = len(weights.rows[0])
    if array.ndim == 0 or array.shape[-1] != bands:
        raise UsageError(
            f"Spectra of {bands} bands need a last axis of that length, and the shape is {array.shape}."
        )
    result = output((*array.shape[:-1], 3), array.dtype, out)
    apart = not result.flags.c_contiguous or np.may_share_memory(result, array)
    direct = np.empty(result.shape, result.dtype) if apart else result
    weights.xyz(array, direct)
    if apart:
        result[...] = direct
    return result
