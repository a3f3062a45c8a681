"""The schools of the eye and of the light (book 4.1)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant.errors import UsageError
from illuminant.transport_coefficients import Diffuse, Directional


@st.composite
def rooms(draw):
    """Random diffuse enclosures: a patch sends on at most 90 % of what reaches it."""
    count = draw(st.integers(1, 5))
    unit = st.floats(0.0, 1.0)
    rows = np.array(draw(st.lists(unit, min_size=count * count, max_size=count * count))).reshape(
        count, count
    )
    lit = draw(st.lists(unit, min_size=count, max_size=count))
    return Diffuse(lit, 0.9 * rows / np.maximum(rows.sum(axis=1, keepdims=True), 1.0))


@given(rooms())
def test_both_schools_come_to_one_value(room):
    eye = room.seen_from_eye()
    for patch in range(len(room.lit)):
        for approximation in (1, 2, 3):
            seen = eye.from_eye(patch, approximation)
            assert seen == pytest.approx(room.from_light(approximation)[patch], abs=1e-9)
    np.testing.assert_allclose(room.from_light(400), room.solved(), atol=1e-9)


@given(rooms())
def test_light_grows_towards_the_balance(room):
    images = np.array([room.from_light(i) for i in range(6)])
    assert (np.diff(images, axis=0) >= 0).all()
    assert (images <= room.solved() + 1e-9).all()


def test_the_second_approximation_adds_the_double_bounce():
    # One patch lights another that the light does not reach (book eq 4.4).
    room = Diffuse([1.0, 0.0], [[0.0, 0.4], [0.0, 0.0]])
    eye = room.seen_from_eye()
    assert eye.from_eye(1, 1) == 0.0
    assert eye.from_eye(1, 2) == pytest.approx(0.4)
    assert eye.from_eye(1, 1, ambient=0.5) == pytest.approx(0.2)


def test_a_mirror_needs_the_coefficients_of_the_eye():
    # Patch 1 sends on light from patch 0 to the eye alone, and none to patch 0.
    lit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]])
    exchanged = np.zeros((3, 2, 2))
    exchanged[2, 0, 1] = 0.9
    mirror = Directional(lit, exchanged)
    assert mirror.from_eye(1, 2) == pytest.approx(0.9)
    assert mirror.from_eye(0, 5) == 1.0
    assert mirror.coefficients == 2**3 + 2**2


def test_coefficients_are_counted():
    room = Diffuse(np.zeros(7), np.zeros((7, 7)))
    assert room.coefficients == 49
    assert room.seen_from_eye().coefficients == 7**3 + 7**2


@pytest.mark.parametrize(
    ("lit", "exchanged", "message"),
    [
        ([1.0], [[1.0]], "create energy"),
        ([1.0, 1.0], [[0.0]], "must have the shape"),
        ([-1.0], [[0.0]], "not negative"),
        ([np.nan], [[0.0]], "finite"),
    ],
)
def test_what_is_no_room_is_refused(lit, exchanged, message):
    with pytest.raises(UsageError, match=message):
        Diffuse(lit, exchanged)
