"""The colour fidelity index with the 99 samples of CIE 224:2017, which colour-science carries, against its own."""

import warnings

import numpy as np
import pytest

from illuminant import colorimetry, spectra
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum


@pytest.fixture(scope="module")
def colour():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    return colour


@pytest.fixture(scope="module")
def samples(colour):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from colour.quality.cfi2017 import load_TCS_CIE2017

        table = load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    return [
        Spectrum(f"CES {i}", table.wavelengths, table.values[:, i], quantity="reflectance") for i in range(99)
    ]


@pytest.mark.parametrize("name", ["A", "D65", "FL1", "FL2", "FL7", "FL11", "LED-B3", "LED-RGB1", "HP1"])
def test_against_colour_science(colour, samples, name):
    grid = np.arange(380.0, 781.0, 5)
    lamp = colour.SpectralDistribution(spectra.load(name).at(grid), grid)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        other = colour.quality.colour_fidelity_index_CIE2017(lamp, additional_data=True)
    found = colorimetry.fidelity_index(name, samples, step_nm=5)
    # It finds the colour temperature in a table, to about 1 K.
    assert found.general == pytest.approx(other.R_f, abs=0.05)
    np.testing.assert_allclose(found.special, other.R_s, atol=0.3)
    assert found.cct_k == pytest.approx(other.CCT, abs=3)


def test_at_1_nm_it_is_nearly_the_same(samples):
    for name in ("FL2", "LED-B3"):
        fine, coarse = (colorimetry.fidelity_index(name, samples, step_nm=step) for step in (1, 5))
        assert fine.general == pytest.approx(coarse.general, abs=0.3)


def test_what_has_none(samples):
    with pytest.raises(DataError, match="needs at least one sample"):
        colorimetry.fidelity_index("D65", [])
    with pytest.raises(DataError, match="too far from any blackbody"):
        green = Spectrum("green", (500, 520, 540), (0, 1, 0), "zero")
        colorimetry.fidelity_index(green, samples)
    with pytest.raises(UsageError, match="from 1 to 5"):
        colorimetry.fidelity_index("D65", samples, step_nm=10)
