"""Dominant and complementary wavelength and purity: mixtures, a second implementation, and what has none."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant import colorimetry
from illuminant.core import core
from illuminant.errors import DataError

OBSERVERS = ("CIE 1931 2°", "CIE 1964 10°")


def monochromatic(wavelength_nm, observer):
    xyz = core().matching_functions(np.array([wavelength_nm]), observer)[0]
    return xyz[:2] / xyz.sum()


@given(
    wavelength_nm=st.floats(420, 670),
    share=st.floats(0.01, 1.0),
    observer=st.sampled_from(OBSERVERS),
    white=st.sampled_from(["E", "D65", "A", "FL11"]),
)
def test_a_mixture_of_white_and_one_wavelength(wavelength_nm, share, observer, white):
    w = np.array(colorimetry.chromaticity(white, observer))
    color = w + share * (monochromatic(wavelength_nm, observer) - w)
    found = colorimetry.dominant_wavelength(color, white, observer)
    # Where the boundary is nearly straight the wavelength is ill determined; the purity is not.
    assert found.wavelength_nm == pytest.approx(wavelength_nm, abs=0.02)
    assert found.purity == pytest.approx(share, abs=1e-6)
    assert not found.complementary
    assert colorimetry.purity(color, white, observer) == found.purity


@given(share=st.floats(0.05, 0.3), wavelength_nm=st.floats(510, 550))
def test_a_purple_has_the_complementary_wavelength(share, wavelength_nm):
    w = np.array(colorimetry.chromaticity("E"))
    color = w - share * (monochromatic(wavelength_nm, OBSERVERS[0]) - w)
    found = colorimetry.dominant_wavelength(color)
    assert found.complementary
    assert found.wavelength_nm == pytest.approx(wavelength_nm, abs=1e-3)
    assert 0 < found.purity <= 1.2
    edge = np.array(found.boundary)
    assert colorimetry.purity(w + 0.5 * (edge - w)) == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("observer", OBSERVERS)
def test_against_colour_science(observer):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour

        key = (
            "CIE 1931 2 Degree Standard Observer"
            if "1931" in observer
            else "CIE 1964 10 Degree Standard Observer"
        )
        # The same ends of the boundary, and so the same line of purples.
        functions = colour.MSDS_CMFS[key]
        seen = functions.wavelengths[functions.values.sum(axis=1) >= 0.005]
        cmfs = functions.copy().trim(colour.SpectralShape(seen[0], seen[-1], 1))
        white = np.array([0.3127, 0.3290])
        for color in ([0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.45, 0.45], [0.25, 0.3], [0.4, 0.2]):
            wavelength, boundary, _ = colour.dominant_wavelength(color, white, cmfs)
            share = colour.excitation_purity(color, white, cmfs)
            found = colorimetry.dominant_wavelength(color, white, observer)
            assert found.complementary == (wavelength < 0)
            assert found.wavelength_nm == pytest.approx(abs(float(wavelength)), abs=0.6)  # it finds whole nm
            assert found.purity == pytest.approx(float(share), abs=1e-6)
            np.testing.assert_allclose(found.boundary, boundary, atol=1e-6)


@pytest.mark.parametrize(("observer", "reach"), [(OBSERVERS[0], 0.002), (OBSERVERS[1], 0.012)])
def test_no_light_lies_far_beyond_the_line_of_purples(observer, reach):
    """What the tables hold beyond the ends of the boundary lies inside it, or within a fraction of a percent."""
    white = np.array([1 / 3, 1 / 3])
    for wavelength_nm in (360.0, 370.0, 380.0, 720.0, 750.0, 780.0, 830.0):
        found = colorimetry.dominant_wavelength(monochromatic(wavelength_nm, observer), white, observer)
        assert 1 - 2 * reach < found.purity < 1.003


def test_what_has_none():
    assert colorimetry.purity("D65", "D65") == 0.0
    for color, white, message in (
        ("D65", "D65", "the colour is the white itself"),
        ((0.3, float("inf")), "E", "finite x and y"),
        ((0.9, 0.95), (0.9, 0.9), "the white lies outside the chromaticities of light"),
    ):
        with pytest.raises(DataError, match=message):
            colorimetry.dominant_wavelength(color, white)
