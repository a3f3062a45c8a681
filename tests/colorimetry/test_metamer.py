"""Metamers: the same colour under one lamp, another under another, always a reflectance."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from illuminant import colorimetry, spectra
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum

PATCHES = [name for name in spectra.names("reflectance") if name.startswith("ColorChecker/")]
GRID = np.arange(380.0, 781.0)


def lab(spectrum, lamp):
    white = Spectrum("white", (380, 780), (1, 1)).xyz(lamp)
    return core().xyz_to_lab(spectrum.xyz(lamp), white)


@pytest.mark.parametrize("patch", PATCHES)
def test_alike_under_one_lamp_and_not_under_another(patch):
    paint, d65, a = spectra.load(patch), spectra.load("D65"), spectra.load("A")
    made = colorimetry.metamer(paint, d65, seed=1)
    np.testing.assert_allclose(made.spectrum.xyz(d65), paint.xyz(d65), rtol=1e-10, atol=1e-14)
    assert float(core().delta_e_2000(lab(made.spectrum, a), lab(paint, a))) > 0.3
    rms = np.sqrt(np.mean((made.spectrum.at(GRID) - paint.at(GRID)) ** 2))
    assert rms == pytest.approx(made.distance) == pytest.approx(made.largest)


@settings(max_examples=40)
@given(
    values=st.lists(st.floats(0.0, 1.0), min_size=2, max_size=12),
    seed=st.integers(0, 2**64 - 1),
    lamp=st.sampled_from(["A", "D65", "FL11", "HP1", "LED-RGB1"]),
    observer=st.sampled_from(["CIE 1931 2°", "CIE 1964 10°", "book"]),
    share=st.floats(0.01, 1.0),
)
def test_any_reflectance_any_lamp(values, seed, lamp, observer, share):
    paint = Spectrum("paint", np.linspace(380, 780, len(values)), values, quantity="reflectance")
    light = spectra.load(lamp)
    try:
        most = colorimetry.metamer(paint, light, seed=seed, observer=observer)
    except DataError as error:
        assert "0 or 1 nearly everywhere" in error.message
        assert np.mean(np.minimum(paint.at(GRID), 1 - paint.at(GRID)) > 1e-6) < 0.1
        return
    made = colorimetry.metamer(paint, light, seed=seed, observer=observer, distance=share * most.largest)
    assert made.distance == pytest.approx(share * most.largest)
    assert min(made.spectrum.values) >= 0.0 and max(made.spectrum.values) <= 1.0
    np.testing.assert_allclose(
        made.spectrum.xyz(light, observer), paint.xyz(light, observer), rtol=1e-10, atol=1e-12
    )


def test_seeds_give_different_ones_and_the_same_seed_the_same():
    made = [colorimetry.metamer("ColorChecker/neutral 5", "D65", seed=seed) for seed in range(4)]
    assert len({m.spectrum.values for m in made}) == 4
    assert made[2] == colorimetry.metamer("ColorChecker/neutral 5", "D65", seed=2)


def test_matrix_r():
    """The projection, written out as a matrix (Cohen and Kappauf 1982)."""
    a = core().matching_functions(GRID, "CIE 1931 2°") * spectra.load("FL11").at(GRID)[:, None]
    r = a @ np.linalg.solve(a.T @ a, a.T)
    red = spectra.load("ColorChecker/red").at(GRID)
    np.testing.assert_allclose(colorimetry.fundamental("ColorChecker/red", "FL11"), r @ red, atol=1e-10)
    other = colorimetry.metamer("ColorChecker/red", "FL11", seed=5).spectrum
    np.testing.assert_allclose(r @ other.at(GRID), r @ red, atol=1e-10)


def test_what_is_refused():
    grey = spectra.load("ColorChecker/neutral 5")
    white = Spectrum("white", (380, 780), (1, 1))
    heat = Spectrum("heat", (900, 1000), (1, 1), "zero")
    for call, message in (
        (lambda: colorimetry.metamer(white, "D65"), "0 or 1 nearly everywhere"),
        (
            lambda: colorimetry.metamer("D65", "D65"),
            "a reflectance lies between 0 and 1, and at 380 nm it is",
        ),
        (lambda: colorimetry.metamer(grey, heat), "the lamp must not be negative and must give light"),
        (lambda: colorimetry.metamer(grey, "D65", distance=0.9), "a distance of 0.9 was asked for"),
        (lambda: colorimetry.metamer(grey, "D65", distance=-0.1), "a distance of -0.1 was asked for"),
        (lambda: colorimetry.fundamental(grey, heat), "the lamp must not be negative and must give light"),
    ):
        with pytest.raises(DataError, match=message):
            call()
    for seed in (-1, 2**64, 1.0, True):
        with pytest.raises(UsageError, match="A seed is a whole number"):
            colorimetry.metamer(grey, "D65", seed=seed)
