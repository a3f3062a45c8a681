"""What the light of a lamp is like, and which surfaces look alike under it.

- correlated colour temperature and Duv (CIE 15:2018; the nearest point of Planck's law in u, v of 1960),
- dominant or complementary wavelength and excitation purity (CIE 15:2018),
- colour rendering index (CIE 13.3-1995) and, over samples of your own, colour fidelity index (CIE 224:2017),
- metamers: other reflectances of the same colour under one lamp (Cohen and Kappauf 1982).

A light is given as a `Spectrum`, as a name of the library (`"FL11"`), or as its chromaticity (x, y). Observers are
`"CIE 1931 2°"` (the default), `"CIE 1964 10°"`, `"book"` (the 5 nm table of Hall 1989, III.7.3, with its two slips put
right) and `"book as printed"`. All sums run at 1 nm.

Example:
    >>> from illuminant import colorimetry
    >>> lamp = colorimetry.correlated_color_temperature("FL2")
    >>> round(lamp.cct_k), round(lamp.duv, 4)
    (4225, 0.0019)
    >>> round(colorimetry.rendering_index("FL2").general)
    64
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum, load
from illuminant.spectrum import OBSERVER, RANGE_NM, floats, whole_range

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Color = Spectrum | str | Sequence[float] | NDArray[np.float64]

__all__ = [
    "ColorTemperature",
    "Dominant",
    "FidelityIndex",
    "Metamer",
    "RenderingIndex",
    "chromaticity",
    "correlated_color_temperature",
    "dominant_wavelength",
    "fidelity_index",
    "fundamental",
    "matching_functions",
    "metamer",
    "observers",
    "purity",
    "rendering_index",
]

WIDE_NM = (360, 830)
"""The range of the CIE's tables, over which the chromaticity of a light is summed."""


class ColorTemperature(NamedTuple):
    """Correlated colour temperature.

    Attributes:
        cct_k: temperature of the nearest blackbody, K.
        duv: distance from the blackbodies in (u, v) of 1960, positive above them, on the green side.
    """

    cct_k: float
    duv: float


class Dominant(NamedTuple):
    """Where the line from the white through a colour meets the boundary of all colours.

    Attributes:
        wavelength_nm: the dominant wavelength; for a purple the complementary one.
        complementary: whether it is the complementary one.
        purity: excitation purity, 0 for the white and 1 on the boundary.
        boundary: x and y of the boundary on the side of the colour.
    """

    wavelength_nm: float
    complementary: bool
    purity: float
    boundary: tuple[float, float]


class RenderingIndex(NamedTuple):
    """How a lamp renders colours.

    Attributes:
        general: the general index R_a, the mean of the first eight.
        special: R_1 to R_14.
        cct_k: correlated colour temperature of the lamp, K.
        duv: its distance from the blackbodies.
        reference: "blackbody" below 5000 K, "daylight" from there on.
        reference_distance: from the reference in (u, v) of 1960; above 0.0054 the CIE calls the index less accurate.
    """

    general: float
    special: tuple[float, ...]
    cct_k: float
    duv: float
    reference: str
    reference_distance: float


class FidelityIndex(NamedTuple):
    """How faithfully a lamp renders colours.

    Attributes:
        general: the general index R_f.
        special: the index of each sample.
        cct_k: correlated colour temperature of the lamp, K.
        duv: its distance from the blackbodies.
    """

    general: float
    special: tuple[float, ...]
    cct_k: float
    duv: float


class Metamer(NamedTuple):
    """A reflectance of the same colour as another under one lamp.

    Attributes:
        spectrum: the reflectance, at 1 nm.
        distance: root mean square of its difference from the given one.
        largest: the largest distance that this seed allows within [0, 1].
    """

    spectrum: Spectrum
    distance: float
    largest: float


def observers() -> list[str]:
    """The names of the observers, the default first.

    Example:
        >>> observers()
        ['CIE 1931 2°', 'CIE 1964 10°', 'book', 'book as printed']
    """
    return list(core().observers())


def matching_functions(observer: str = OBSERVER) -> tuple[Spectrum, Spectrum, Spectrum]:
    """The matching functions x̄, ȳ and z̄ of an observer, at 1 nm, zero outside.

    Raises:
        UsageError: no such observer.

    Example:
        >>> [round(curve.area((380, 780)), 3) for curve in matching_functions("book")]
        [106.854, 106.856, 106.845]
        >>> [round(curve.area((380, 780)), 3) for curve in matching_functions("book as printed")]
        [106.85, 106.856, 106.935]
    """
    import numpy as np

    name = _observer(observer)
    first, last = RANGE_NM if name.startswith("book") else WIDE_NM
    grid = np.arange(first, last + 1.0)
    table = core().matching_functions(grid, name)
    x, y, z = (
        Spectrum(f"{axis}, {name}", tuple(grid.tolist()), tuple(table[:, i].tolist()), "zero")
        for i, axis in enumerate(("x̄", "ȳ", "z̄"))
    )
    return x, y, z


def chromaticity(light: Color, observer: str = OBSERVER) -> tuple[float, float]:
    """The chromaticity (x, y) of a light.

    Args:
        light: a spectrum of light, a name of the library, or x and y, which come back as they are.
        observer: see `observers`.

    Raises:
        DataError: no light between 360 and 830 nm; x and y are no two numbers.
        UsageError: no such observer; the spectrum is a reflectance.

    Example:
        >>> x, y = chromaticity("D65")
        >>> round(x, 4), round(y, 4)
        (0.3127, 0.329)
        >>> x, y = chromaticity("D65", "CIE 1964 10°")
        >>> round(x, 4), round(y, 4)
        (0.3138, 0.331)
    """
    name = _observer(observer)
    spectrum = load(light) if isinstance(light, str) else light
    if isinstance(spectrum, Spectrum):
        xyz = spectrum.xyz(observer=name, range_nm=_span(spectrum))
        total = float(xyz.sum())
        if not total > 0.0:
            raise DataError(f"spectrum {spectrum.name!r} gives no light that the eye sees")
        return float(xyz[0]) / total, float(xyz[1]) / total
    pair = floats(spectrum, "chromaticity")
    if len(pair) != 2:
        raise DataError(f"a chromaticity is x and y, and this has {len(pair)} numbers")
    return pair[0], pair[1]


def correlated_color_temperature(light: Color, observer: str = OBSERVER) -> ColorTemperature:
    """The correlated colour temperature of a light, from 500 to 100,000 K, and its Duv.

    The nearest point on the curve of blackbodies, with c₂ = 14 387.77 µm·K (SI of 2019), found to rounding.

    Args:
        light: a spectrum of light, a name of the library, or x and y.
        observer: see `observers`; the CIE defines the quantity for the 2° observer.

    Raises:
        DataError: Duv beyond ±0.05, where the CIE gives the word no meaning; out of range; no light.
        UsageError: no such observer.

    Example:
        >>> from illuminant.spectra import load
        >>> round(correlated_color_temperature(load("A")).cct_k)
        2855
        >>> round(correlated_color_temperature((0.3457, 0.3585)).cct_k)
        5001
    """
    name = _observer(observer)
    cct_k, duv = _asked(core().correlated_color_temperature, list(chromaticity(light, name)), name)
    return ColorTemperature(cct_k, duv)


def dominant_wavelength(color: Color, white: Color = "E", observer: str = OBSERVER) -> Dominant:
    """The dominant wavelength of a colour beside a white, or the complementary one of a purple, and its purity.

    Args:
        color: a spectrum of light (for a surface its product with the lamp), a name of the library, or x and y.
        white: the same; default the equal-energy light.
        observer: see `observers`.

    Raises:
        DataError: the colour is the white; the white is no light's.
        UsageError: no such observer.

    Example:
        >>> red = dominant_wavelength((0.64, 0.33), white="D65")
        >>> round(red.wavelength_nm, 1), red.complementary, round(red.purity, 2)
        (611.3, False, 0.92)
    """
    name = _observer(observer)
    pair, beside = list(chromaticity(color, name)), list(chromaticity(white, name))
    wavelength, complementary, share, (x, y) = _asked(core().dominant_wavelength, pair, beside, name)
    return Dominant(wavelength, complementary, share, (x, y))


def purity(color: Color, white: Color = "E", observer: str = OBSERVER) -> float:
    """The excitation purity of a colour beside a white: 0 for the white, 1 for light of one wavelength.

    Arguments and errors as for `dominant_wavelength`, but the white itself has a purity.

    Example:
        >>> purity("D65", white="D65"), round(purity((0.64, 0.33), white="D65"), 2)
        (0.0, 0.92)
    """
    if chromaticity(color, observer) == chromaticity(white, observer):
        return 0.0
    return dominant_wavelength(color, white, observer).purity


def rendering_index(lamp: Spectrum | str, *, step_nm: int = 1) -> RenderingIndex:
    """The colour rendering index of a lamp (CIE 13.3-1995), with the 2° observer, 360-830 nm.

    Rᵢ = 100 − 4.6 ΔEᵢ, with ΔE in W*U*V* of 1964 between test colour sample i under the lamp, its chromaticity
    shifted by that of the lamp, and under a blackbody (below 5000 K) or daylight of the same colour temperature.

    Args:
        lamp: a spectrum of light or its name in the library.
        step_nm: the step of all sums, 1 to 10 nm. At 5 nm the points alone count of a lamp that is tabulated so,
            and the numbers are those that CIE 15 publishes; 1 nm suits all lamps.

    Raises:
        UsageError: another step.
        DataError: no light; no colour temperature; one above 25,000 K.

    Example:
        >>> found = rendering_index("FL11")
        >>> round(found.general), round(found.special[8]), found.reference
        (83, 25, 'blackbody')
        >>> [round(r) for r in rendering_index("FL2", step_nm=5).special[:9]]    # as in CIE 15
        [56, 77, 90, 57, 59, 67, 74, 33, -84]
    """
    spectrum = load(lamp) if isinstance(lamp, str) else lamp
    if isinstance(step_nm, bool) or not isinstance(step_nm, int) or not 1 <= step_nm <= 10:
        raise UsageError(f"The step is a whole number of nm from 1 to 10, not {step_nm!r}.")
    found = _asked(core().rendering_index, *spectrum.given(WIDE_NM), step_nm)
    general, special, cct_k, duv, distance = found
    reference = "blackbody" if cct_k < 5000.0 else "daylight"
    return RenderingIndex(general, tuple(special), cct_k, duv, reference, distance)


def fidelity_index(
    lamp: Spectrum | str, samples: Sequence[Spectrum | str], *, step_nm: int = 1
) -> FidelityIndex:
    """The colour fidelity index of a lamp over given samples (CIE 224:2017), 380-780 nm.

    R_f = 10 ln(exp((100 − 6.73 ΔE)/10) + 1), with ΔE the mean difference in CAM02-UCS, for the 10° observer, between
    each sample under the lamp and under a blackbody (to 4000 K), daylight (from 5000 K) or a mixture of the same
    colour temperature.

    Args:
        lamp: a spectrum of light or its name in the library.
        samples: reflectances or their names. Those of CIE 224 are not shipped here; colour-science has them.
            With others the number is no R_f of the CIE, but compares lamps over the surfaces that matter to you.
        step_nm: the step of all sums, 1 to 5 nm.

    Raises:
        UsageError: another step.
        DataError: no samples; no light; no colour temperature; one above 25,000 K.

    Example:
        >>> patches = [f"TCS/{i}" for i in range(1, 15)]
        >>> round(fidelity_index("D65", patches).general, 1)
        100.0
        >>> fidelity_index("FL2", patches).general < fidelity_index("FL7", patches).general
        True
    """
    if isinstance(step_nm, bool) or not isinstance(step_nm, int) or not 1 <= step_nm <= 5:
        raise UsageError(f"The step is a whole number of nm from 1 to 5, not {step_nm!r}.")
    light = load(lamp) if isinstance(lamp, str) else lamp
    surfaces = [load(sample) if isinstance(sample, str) else sample for sample in samples]
    given = [surface.given(RANGE_NM) for surface in surfaces]
    general, special, cct_k, duv = _asked(core().fidelity_index, light.given(RANGE_NM), given, step_nm)
    return FidelityIndex(general, tuple(special), cct_k, duv)


def metamer(
    reflectance: Spectrum | str,
    lamp: Spectrum | str,
    *,
    seed: int = 0,
    distance: float | None = None,
    observer: str = OBSERVER,
    range_nm: Sequence[int] = RANGE_NM,
) -> Metamer:
    """Another reflectance that has the same XYZ under a lamp, to rounding.

    To the reflectance is added a smooth black metamer, which the observer does not see under this lamp: one that
    is orthogonal to the lamp times each matching function (Cohen and Kappauf 1982). The result lies in [0, 1]
    without being clamped.

    Args:
        reflectance: a reflectance or its name in the library.
        lamp: a spectrum of light or its name.
        seed: chooses among the metamers; the same seed gives the same one.
        distance: root mean square of the difference; None: the largest that fits into [0, 1].
        observer: see `observers`.
        range_nm: whole nm over which XYZ is summed and the metamer is tabulated; outside, its ends hold.

    Raises:
        DataError: no reflectance; a reflectance that is 0 or 1 nearly everywhere; a distance that does not fit.
        UsageError: no such observer, or a seed that is no whole number from 0 to 2⁶⁴ − 1.

    Example:
        >>> import numpy as np
        >>> from illuminant.spectra import load
        >>> grey, d65, a = load("ColorChecker/neutral 5"), load("D65"), load("A")
        >>> other = metamer(grey, d65, seed=3).spectrum
        >>> bool(np.abs(other.xyz(d65) - grey.xyz(d65)).max() < 1e-10)
        True
        >>> bool(np.abs(other.xyz(a) - grey.xyz(a)).max() > 1e-3)
        True
    """
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed < 2**64:
        raise UsageError(f"A seed is a whole number from 0 to 2**64 - 1, not {seed!r}.")
    name, span = _observer(observer), whole_range(range_nm)
    surface = load(reflectance) if isinstance(reflectance, str) else reflectance
    light = load(lamp) if isinstance(lamp, str) else lamp
    (wavelengths, values), found, largest = _asked(
        core().metamer, surface.given(span), light.given(span), name, span, seed, distance
    )
    origin = f"metamer of {surface.name} under {light.name} for {name}, seed {seed} (Cohen and Kappauf 1982)"
    spectrum = Spectrum(
        f"metamer of {surface.name}",
        tuple(wavelengths.tolist()),
        tuple(values.tolist()),
        "hold",
        "1",
        origin,
        "reflectance",
    )
    return Metamer(spectrum, found, largest)


def fundamental(
    reflectance: Spectrum | str,
    lamp: Spectrum | str,
    *,
    observer: str = OBSERVER,
    range_nm: Sequence[int] = RANGE_NM,
) -> NDArray[np.float64]:
    """The fundamental of a reflectance: the part R r that makes its colour; the rest is its black metamer.

    R = A(AᵀA)⁻¹Aᵀ, where A holds the lamp times each matching function (Cohen and Kappauf 1982).

    Args:
        reflectance: a reflectance or its name in the library.
        lamp: a spectrum of light or its name.
        observer: see `observers`.
        range_nm: first and last nm.

    Returns:
        Its value at every whole nm of the range. It may be negative or above 1, so it is no spectrum.

    Raises:
        DataError: the lamp gives no light.
        UsageError: no such observer.

    Example:
        >>> fundamental("ColorChecker/red", "D65").shape
        (401,)
    """
    name, span = _observer(observer), whole_range(range_nm)
    surface = load(reflectance) if isinstance(reflectance, str) else reflectance
    light = load(lamp) if isinstance(lamp, str) else lamp
    _, values = _asked(core().fundamental, surface.given(span), light.given(span), name, span)
    found: NDArray[np.float64] = values
    return found


def _span(spectrum: Spectrum) -> tuple[int, int]:
    """The range of the CIE's tables, or what is known of it where a spectrum may not be asked beyond its own."""
    if spectrum.outside != "error":
        return WIDE_NM
    first, last = spectrum.range_nm
    return max(WIDE_NM[0], -int(-first // 1)), min(WIDE_NM[1], int(last))


def _observer(name: str) -> str:
    """The name of an observer as the core writes it."""
    known = observers()
    folded = {each.rstrip("°").casefold(): each for each in known}
    found = folded.get(str(name).strip().rstrip("°").casefold())
    if found is None:
        raise UsageError(f"There is no observer {name!r}: known are {', '.join(known)}.")
    return found


def _asked(function: Callable[..., Any], *arguments: object) -> Any:
    """The answer of the core, whose mistakes are the data's."""
    try:
        return function(*arguments)
    except ValueError as error:
        raise DataError(str(error)) from None
