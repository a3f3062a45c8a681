"""Looks, false colours, marks, split and maps."""

import numpy as np
import pytest

from illuminant.display.look import Look
from illuminant.viewer.composition import MARK, MODES, compose, difference_map, false_colour, split
from illuminant.viewer.state import State


@pytest.fixture(scope="module")
def state(repository):
    return State.of(repository / "scenes" / "cornell.toml", look=Look(exposure=0.01))


def test_a_picture_is_what_show_makes(state):
    from dataclasses import replace

    from illuminant.display.look import show

    xyz = np.random.default_rng(1).uniform(0, 90, (8, 9, 3))
    assert (compose(xyz, state).codes == show(xyz, state.look).picture.codes).all()
    brighter = replace(state, stops=1.0)
    assert (compose(xyz, brighter).codes == show(2 * xyz, state.look).picture.codes).all()


def test_marks_stand_where_the_display_cannot_show_a_colour(state):
    xyz = np.array([[[20.0, 21.0, 22.0], [5.0, 60.0, 5.0], [300.0, 310.0, 330.0]]])
    codes = compose(xyz, state, MODES[2]).codes
    assert [tuple(int(v) for v in pixel) == MARK for pixel in codes[0]] == [False, True, True]


def test_false_colours_are_equal_for_equal_ratios():
    codes, (low, high) = false_colour(np.array([[0.0, 0.5, 1.0, 10.0, 100.0, 1000.0]]))
    assert (low, high) == (pytest.approx(high / 1000), high)
    assert (codes[0, 0] == codes[0, 1]).all()
    assert len({tuple(c) for c in codes[0, 2:]}) == 4


def test_a_lamp_does_not_take_the_top_of_the_scale_and_the_title_says_that_it_is_above(state):
    xyz = np.full((20, 20, 3), 50.0)
    xyz[:4] = 40_000.0  # a fifth of the picture is lamp
    lamp = np.zeros((20, 20), bool)
    lamp[:4] = True
    made = compose(xyz, state, MODES[1], shining=lamp)
    assert made.scale == (pytest.approx(0.05), pytest.approx(50.0))
    assert made.title == "luminance, cd/m²; lightest: > 50"
    assert compose(xyz, state, MODES[1]).scale[1] == pytest.approx(40_000.0)
    alone = compose(xyz[:4], state, MODES[1], shining=lamp[:4])
    assert alone.scale[1] == pytest.approx(40_000.0), "a picture of nothing but lamps has their scale"
    given = compose(xyz, state, MODES[1], scale=(1.0, 1000.0))
    assert given.scale == (1.0, 1000.0)
    assert given.title.endswith("> 1,000")


def test_the_divider_parts_two_pictures_also_of_different_sizes():
    small, large = np.zeros((2, 4, 3), np.uint8), np.full((4, 8, 3), 9, np.uint8)
    joined = split(small, large, 0.25)
    assert joined.shape == (4, 8, 3)
    assert (joined[:, :2] == 0).all() and (joined[:, 2] == 255).all() and (joined[:, 3:] == 9).all()
    assert (split(small, large, 0.0) == large).all()


@pytest.mark.parametrize("kind", ["ΔE00", "FLIP"])
def test_equal_pictures_have_no_difference(kind):
    xyz = np.random.default_rng(2).uniform(0, 50, (16, 16, 3))
    codes, mean = difference_map(xyz, xyz, 0.01, kind)
    assert mean == pytest.approx(0.0, abs=1e-6)
    assert len(np.unique(codes.reshape(-1, 3), axis=0)) == 1
    assert difference_map(xyz, 1.3 * xyz, 0.01, kind)[1] > 0.0
