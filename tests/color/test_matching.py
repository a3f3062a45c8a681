"""Matching with three lights, and projections (book 3.2)."""

import numpy as np
import pytest

from illuminant import color
from illuminant.errors import UsageError

LINES = (445, 535, 630)
GRID = np.arange(380, 781)


def test_each_primary_is_matched_by_itself():
    functions = color.matching_functions(LINES, LINES)
    np.testing.assert_allclose(functions, np.eye(3), atol=1e-12)


def test_the_curves_of_the_book_have_their_negative_lobes():
    """Figure 3.5: between the lines of blue and green it is red that goes to the test side."""
    low, middle, high = color.matching_functions(LINES, GRID).T
    between = (GRID > 450) & (GRID < 530)
    assert (high[between] < 0).all() and high.min() < -0.05
    assert (low[(GRID > 540) & (GRID < 625)] < 0).all()
    assert (middle[(GRID > 400) & (GRID < 440)] < 0).all()
    assert min(low.max(), middle.max(), high.max()) > 0.9


def test_a_match_has_the_colour_of_the_test_light():
    observer = color.observer_table("CIE 1931 2 deg")
    test = (GRID, 1.0 + np.sin(GRID / 40.0))
    for primaries in (LINES, ("LED-RGB1", "A", "FL11")):
        amounts = color.matching_amounts(test, primaries)
        mixed = color.transform(color.primaries_to_xyz(primaries), amounts)
        wanted = color.spectra_to_xyz(test[1], GRID, observer=observer, scale="absolute") / 683
        np.testing.assert_allclose(mixed, wanted, rtol=1e-9)


def test_amounts_are_the_sum_over_the_matching_functions():
    """Figure 3.3: the test light times the matching functions, summed at 1 nm."""
    values = np.exp(-(((GRID - 500.0) / 15.0) ** 2))
    amounts = color.matching_amounts((GRID, values), LINES)
    np.testing.assert_allclose(amounts, values @ color.matching_functions(LINES, GRID), rtol=1e-10)
    assert amounts[2] < 0, "red goes to the test side of a saturated blue-green"


def test_a_spectral_locus_sums_to_one_and_its_primaries_are_corners():
    locus = color.chromaticity(color.matching_functions(LINES, GRID[20:-80]))
    np.testing.assert_allclose(locus.sum(axis=1), 1.0, atol=1e-12)
    np.testing.assert_allclose(locus[GRID[20:-80] == 535], [[0, 1, 0]], atol=1e-12)


def test_lights_that_match_each_other_are_refused():
    with pytest.raises(UsageError, match=r"can be matched by the other two: .*singular"):
        color.matching_functions((500, 500, 600), GRID)
    with pytest.raises(UsageError, match="three lights"):
        color.matching_functions((500, 600), GRID)
