"""Matching functions: at their own primaries, under a change of primaries, and against the core."""

import numpy as np
import pytest

from illuminant import rgb_system, spectra
from illuminant.core import core
from illuminant.errors import UsageError
from illuminant.plots.observer import for_primaries, in_space, named, names, primaries_matrix

EYE = named("1931")
PRIMARIES = (445.0, 535.0, 630.0)


def test_each_function_is_one_at_its_own_primary_and_nothing_at_the_others() -> None:
    np.testing.assert_allclose(for_primaries(EYE, PRIMARIES).at(PRIMARIES), np.eye(3), atol=1e-13)


def test_the_order_of_the_primaries_does_not_matter() -> None:
    one, other = for_primaries(EYE, PRIMARIES), for_primaries(EYE, (630, 445, 535))
    np.testing.assert_array_equal(one.values, other.values)
    assert one.labels == other.labels == ("L 445 nm", "M 535 nm", "H 630 nm")


def test_each_function_has_its_negative_lobes() -> None:
    """Book figure 3.5: between two primaries the third has to be added to the test light."""
    lmh = for_primaries(EYE, PRIMARIES)
    assert np.all(lmh.at(np.arange(450, 535))[:, 2] < 0), "red, between blue and green"
    assert np.all(lmh.at(np.arange(540, 630))[:, 0] < 0), "blue, between green and red"
    assert np.all(lmh.at(np.arange(400, 445))[:, 1] < 0), "green, below blue"
    assert np.all(lmh.at(np.arange(640, 700))[:, 1] < 0), "green, beyond red"
    assert lmh.values.min() > -0.3


@pytest.mark.parametrize("wavelength", [400.0, 480.0, 507.5, 580.0, 660.0])
def test_the_amounts_bring_the_xyz_of_the_test_light(wavelength: float) -> None:
    amounts = for_primaries(EYE, PRIMARIES).at(wavelength)
    np.testing.assert_allclose(primaries_matrix(EYE, PRIMARIES) @ amounts, EYE.at(wavelength), atol=1e-14)


def test_tristimulus_values_are_those_of_the_core() -> None:
    for name in ("A", "D65", "FL11"):
        lamp = spectra.load(name)
        mine = 683.0 * EYE.sample(lamp)
        theirs = core().xyz(lamp.wavelengths_nm, lamp.values, lamp.outside, (360, 830))
        np.testing.assert_allclose(mine, theirs, rtol=1e-12)


def test_a_reflectance_under_a_light_is_their_product() -> None:
    grey, lamp = spectra.Spectrum("grey", [300, 900], [0.25, 0.25]), spectra.load("FL11")
    np.testing.assert_allclose(EYE.sample(grey, lamp), 0.25 * EYE.sample(lamp), rtol=1e-12)


def test_ac1c2_is_the_matrix_of_the_book() -> None:
    """Book eq 3.6, whose rows are scaled so that each curve of figure 3.14 reaches 1 or -1 (to their four digits)."""
    matrix = [[-0.0177, 1.0090, 0.0073], [-1.5370, 1.0821, 0.3209], [0.1946, -0.2045, 0.5264]]
    functions = in_space(EYE, "AC1C2")
    np.testing.assert_allclose(functions.values, EYE.values @ np.array(matrix).T, rtol=0, atol=1e-15)
    x, y, z = EYE.at(600.0)
    assert functions.at(600.0)[1] == pytest.approx(-1.5370 * x + 1.0821 * y + 0.3209 * z)
    np.testing.assert_allclose(np.abs(functions.values).max(axis=0), 1.0, atol=1e-3)


def test_the_functions_of_an_rgb_system_sample_its_white_to_one() -> None:
    """The functions are linear in XYZ, so D65 comes out as equal amounts in sRGB (to the 4 digits of its white)."""
    rgb = in_space(EYE, "srgb").sample(spectra.load("D65"))
    np.testing.assert_allclose(rgb / rgb[1], 1.0, atol=1e-3)
    assert in_space(EYE, "srgb").title.startswith(str(rgb_system.named("sRGB")["name"]))


def test_every_observer_of_the_library_peaks_where_eyes_do() -> None:
    assert "1931" in names()
    for name in names():
        functions = named(name)
        x, y, z = functions.wavelengths_nm[np.argmax(functions.values, axis=0)]
        assert 590 <= x <= 605 and 550 <= y <= 562 and 440 <= z <= 450, name


@pytest.mark.parametrize("primaries", [(445, 535), (445, 445, 630), (445, 535, 900), (100, 535, 630)])
def test_primaries_that_are_not_three_visible_ones_are_refused(primaries: tuple[float, ...]) -> None:
    with pytest.raises(UsageError, match="expected three different wavelengths from 360 to 830 nm"):
        for_primaries(EYE, primaries)


def test_primaries_of_which_one_matches_another_are_refused() -> None:
    """Beyond 700 nm all light has one chromaticity: two reds and a blue span a plane only."""
    with pytest.raises(UsageError, match="one can be matched by the two others"):
        for_primaries(EYE, (445, 750, 751))


def test_unknown_names_are_refused_with_those_there_are() -> None:
    with pytest.raises(
        UsageError, match=r"no observer '1913' \(did you mean \"1931\"\?\): known are 1931, 1964, book"
    ):
        named("1913")
    with pytest.raises(UsageError, match=r"no space 'ac1c3' \(did you mean \"ac1c2\"\?\)"):
        in_space(EYE, "ac1c3")
