"""Spectral samplings: how wavelengths are carried, and what that costs in colour.

A renderer carries a few numbers for a spectrum. Which, and how they become XYZ, is its spectral sampling:
`fitted:N` (wavelengths and weights chosen for the lamps and materials at hand), `uniform:N`, `hall:N` (boxes;
Hall 1983), `meyer` and `gauss:A,B,C` (Gauss quadrature along AC1C2; Meyer 1988), `rgb` and `xyz` (colours
multiplied as colours, book 3.5.1), and `1nm`, the reference. `names()` lists them all.

`compare` is the study of the book's 3.5.2 with numbers: products of one to four reflectances, as light meets them
when it goes from surface to surface, by a sampling and at 1 nm, in CIEDE2000. `illuminant spectra compare` prints
it; what a sampling costs in a scene of yours, `illuminant spectra error SCENE` says.

Example:
    >>> [study] = compare(["fitted:8"], ["D65"], products=500)
    >>> study.by_lamp["D65"].mean < 0.2
    True
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from illuminant.spectra import Spectrum

__all__ = ["LAMPS", "SAMPLINGS", "Error", "Study", "compare", "names"]

LAMPS = ("C", "D65", "A", "FL2", "FL11")
"""The lamps of the study: daylight twice, tungsten, a fluorescent lamp with a broad spectrum and one of three lines."""

SAMPLINGS = (
    "rgb",
    "rgb:white",
    "xyz",
    "meyer",
    "gauss:4,2,2",
    "uniform:4",
    "uniform:8",
    "uniform:16",
    "uniform:32",
    "hall:9:even",
    "hall:9",
    "hall:9:global",
    "fitted:4",
    "fitted:8",
    "fitted:12",
    "fitted:16",
)
"""The samplings of the study."""

FITTED_ON = 2000
"""The most products under each lamp that a fit may look at."""

MOST_JUDGED = 100_000
"""The most products under each lamp to judge by, where no number is given."""

SEED = 1


@dataclass(frozen=True)
class Error:
    """ΔE00 against 1 nm over many products.

    Attributes:
        mean, p95, max: over the products.
        worst: the names of the reflectances whose product is the largest.
        lit: the same with every product lit so that its Y is half that of the white, so that dark ones count as much as
            light ones; None for `lit` itself.
        products: how many.
    """

    mean: float
    p95: float
    max: float
    worst: tuple[str, ...]
    products: int
    lit: Error | None = None


@dataclass(frozen=True)
class Study:
    """What one sampling costs.

    Attributes:
        sampling: its name.
        wavelengths_nm: those of its samples; where each lamp has its own fit, by lamp.
        by_lamp: the error under each lamp.
    """

    sampling: str
    wavelengths_nm: Mapping[str, tuple[float, ...]]
    by_lamp: Mapping[str, Error]


def names() -> dict[str, str]:
    """Every form of the name of a sampling, with what it means.

    Example:
        >>> names()["1nm"]
        'every nm: the reference'
    """
    return dict(core().sampling_names())


def compare(
    samplings: Sequence[str] = SAMPLINGS,
    lamps: Sequence[str | Spectrum] = LAMPS,
    reflectances: Sequence[str | Spectrum] | str = "ColorChecker",
    *,
    unknown: Sequence[str | Spectrum] | None = None,
    depth: int = 4,
    products: int | None = None,
    together: bool = False,
    range_nm: tuple[int, int] = (380, 780),
) -> list[Study]:
    """The error of samplings on products of reflectances under lamps, each beside a perfect diffuser with Y = 1.

    Args:
        samplings: their names.
        lamps: names of the library, or spectra.
        reflectances: names or spectra; one word is all of the library that begin with it and a slash. Fitted samplings
            are fitted on at most `FITTED_ON` of their products.
        unknown: other reflectances to judge by, which no fit has seen; None judges by all products of `reflectances`.
        depth: the most reflections of a product.
        products: the most products to judge by under each lamp; None for all, 20,474 of the 24 patches, up to
            `MOST_JUDGED`.
        together: whether all lamps are in one scene, so that a fit must serve them with the same wavelengths.
        range_nm: the wavelengths that are carried.

    Returns:
        One study for each sampling, in their order.

    Raises:
        UsageError: a sampling has no such name, there is no reflectance, two lamps have one name, the range is none, or
            depth or products are below 1.
        DataError: a spectrum has no such name.

    Example:
        >>> [rgb, fitted] = compare(["rgb", "fitted:8"], ["FL11"], products=300)
        >>> rgb.by_lamp["FL11"].mean > 20 * fitted.by_lamp["FL11"].mean
        True
    """
    light = [_spectrum(lamp) for lamp in lamps]
    known = _reflectances(reflectances)
    judged = known if unknown is None else _reflectances(unknown)
    names_of = [lamp.name for lamp in light]
    if len(set(names_of)) < len(names_of):
        raise UsageError("Two of the lamps have one name; give each its own.")
    if depth < 1 or (products is not None and products < 1):
        raise UsageError("A study needs products of at least one reflection, and at least one product.")
    if not 1 <= range_nm[0] < range_nm[1] <= 20_000:
        raise UsageError(
            f"The range is {range_nm[0]} to {range_nm[1]} nm; expected one whole nm and a larger one."
        )
    studies = []
    for sampling in samplings:
        by_lamp: dict[str, Error] = {}
        wavelengths: dict[str, tuple[float, ...]] = {}
        for group in [light] if together else [[lamp] for lamp in light]:
            try:
                found = core().sampling_error(
                    sampling,
                    [lamp.given(range_nm) for lamp in group],
                    [spectrum.given(range_nm) for spectrum in known],
                    [spectrum.given(range_nm) for spectrum in judged],
                    depth,
                    FITTED_ON,
                    MOST_JUDGED if products is None else products,
                    SEED,
                    range_nm,
                )
            except ValueError as error:
                raise UsageError(f"{error}.") from error
            for lamp, facts in zip(group, found["by_lamp"], strict=True):
                lit = _error(facts["lit"], facts["products"], judged)
                by_lamp[lamp.name] = _error(facts["exposed"], facts["products"], judged, lit)
                wavelengths[lamp.name] = tuple(found["wavelengths_nm"])
        studies.append(Study(sampling, wavelengths, by_lamp))
    return studies


def _error(facts: dict[str, Any], products: int, judged: list[Spectrum], lit: Error | None = None) -> Error:
    worst = tuple(judged[number].name for number in facts["reflectances"])
    return Error(facts["mean"], facts["p95"], facts["max"], worst, products, lit)


def _spectrum(value: str | Spectrum) -> Spectrum:
    from illuminant import spectra

    return spectra.load(value) if isinstance(value, str) else value


def _reflectances(values: Sequence[str | Spectrum] | str) -> list[Spectrum]:
    from illuminant import spectra

    if isinstance(values, str):
        start = f"{values.rstrip('/')}/".casefold()
        values = [name for name in spectra.names("reflectance") if name.casefold().startswith(start)]
    found = [_spectrum(value) for value in values]
    if not found:
        raise UsageError(
            "There is no reflectance to multiply; expected a group such as ColorChecker, or names."
        )
    return found
