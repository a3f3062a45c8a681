"""Correlated colour temperature: blackbodies, a second implementation, and what has none."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant import colorimetry, spectra
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum

GRID = np.arange(360.0, 831.0)


def blackbody(temperature_k):
    power = core().planck(GRID, temperature_k)
    return Spectrum("blackbody", GRID, power, "zero", "relative", quantity="emission")


@given(temperature_k=st.floats(1000, 25_000))
def test_a_blackbody_has_its_own_temperature(temperature_k):
    found = colorimetry.correlated_color_temperature(blackbody(temperature_k))
    assert found.cct_k == pytest.approx(temperature_k, abs=0.01)
    assert abs(found.duv) < 1e-8


@pytest.mark.parametrize("observer", ["CIE 1964 10°", "book"])
def test_with_another_observer_too(observer):
    for temperature_k in (1000, 2856, 6500, 25_000):
        power = core().planck(np.arange(360.0, 831.0), float(temperature_k))
        lamp = Spectrum("blackbody", GRID, power, "zero")
        found = colorimetry.correlated_color_temperature(lamp, observer)
        assert found.cct_k == pytest.approx(temperature_k, abs=1)


def test_against_ohno_of_colour_science():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour

        for name in ("A", "D50", "D65", "FL1", "FL2", "FL5", "FL11", "LED-RGB1", "HP1"):
            x, y = colorimetry.chromaticity(name)
            uv = np.array([4 * x, 6 * y]) / (-2 * x + 12 * y + 3)
            cct_k, duv = colour.temperature.uv_to_CCT_Ohno2013(uv, start=1000, end=25_000, spacing=1.001)
            found = colorimetry.correlated_color_temperature(name)
            assert found.cct_k == pytest.approx(cct_k, abs=1), name
            assert found.duv == pytest.approx(duv, abs=1e-5), name


def test_every_form_of_a_light_is_the_same_light():
    forms = (spectra.load("FL2"), "FL2", "fl2", colorimetry.chromaticity("FL2"))
    found = {colorimetry.correlated_color_temperature(light) for light in forms}
    assert len(found) == 1
    assert colorimetry.correlated_color_temperature(1e-6 * spectra.load("FL2")).cct_k == pytest.approx(
        found.pop().cct_k
    )


def test_what_has_no_temperature():
    for light, message in (
        ((0.2, 0.7), "too far from any blackbody"),
        ((0.1, 0.1), "redder than a blackbody of 500 K or bluer"),
        ((0.3, 0.0), "y above 0"),
        ((0.3, float("nan")), "y above 0"),
        ((0.3, 0.3, 0.3), "a chromaticity is x and y, and this has 3 numbers"),
        (Spectrum("heat", (900, 1000), (1, 1), "zero"), "no light that the eye sees"),
    ):
        with pytest.raises(DataError, match=message):
            colorimetry.correlated_color_temperature(light)
    with pytest.raises(UsageError, match=r"no observer 'CIE 2006': known are CIE 1931 2°"):
        colorimetry.correlated_color_temperature("D65", "CIE 2006")
    with pytest.raises(UsageError, match="under a lamp only"):
        colorimetry.chromaticity("ColorChecker/red")
