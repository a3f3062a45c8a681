"""What is between keyframes: closed forms, another program's splines and turns, and what must never happen."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation, Slerp

from illuminant import placement
from illuminant.keyframes import between, misfit, turned, turns

NUMBERS = st.floats(-1e6, 1e6)


def rotation_of(value):
    """The matrix of a rotation, or of a list of them, by the code that places objects."""
    several = value if isinstance(value, list) else [value]
    return placement.transform(rotate=[(one["axis"], one["degrees"]) for one in several])[:, :3]


def test_steps_lines_and_curves_in_closed_form():
    times, values = [1.0, 3.0], [10.0, 20.0]
    for time, u in ((1.5, 0.25), (2.0, 0.5), (2.9, 0.95)):
        assert between(times, values, time, "step") == 10.0
        assert between(times, values, time, "linear") == pytest.approx(10 + 10 * u, rel=1e-14)
        assert between(times, values, time, "smooth") == pytest.approx(
            10 + 10 * (3 * u**2 - 2 * u**3), rel=1e-14
        )
    for kind in ("step", "linear", "smooth"):
        assert [between(times, values, time, kind) for time in (-5.0, 1.0, 3.0, 99.0)] == [
            10.0,
            10.0,
            20.0,
            20.0,
        ]


def test_a_smooth_curve_is_that_of_scipy_away_from_its_ends():
    """Its ends differ on purpose: there the value comes to rest, since it holds still beyond."""
    generator = np.random.default_rng(1)
    times = np.cumsum(generator.uniform(0.1, 2.0, 12))
    values = generator.uniform(-1.0, 1.0, 12)
    theirs = PchipInterpolator(times, values)
    for time in np.linspace(times[1], times[-2], 200):
        assert between(times.tolist(), values.tolist(), time, "smooth") == pytest.approx(
            theirs(time), abs=1e-13
        )


def test_a_smooth_curve_has_no_corner():
    times, values = [0.0, 1.0, 1.5, 4.0], [0.0, 1.0, 3.0, 4.0]
    h = 1e-6
    for time in (0.0, 1.0, 1.5, 4.0):
        before, at, after = (between(times, values, time + d, "smooth") for d in (-h, 0, h))
        assert (after - at) / h == pytest.approx((at - before) / h, abs=1e-4)


@given(
    st.lists(NUMBERS, min_size=2, max_size=6), st.floats(0, 1), st.sampled_from(["linear", "smooth", "step"])
)
def test_a_value_never_leaves_the_range_of_its_neighbours(values, u, kind):
    times = [float(i) for i in range(len(values))]
    time = u * (len(values) - 1)
    i = min(int(time), len(values) - 2)
    assert min(values[i : i + 2]) <= between(times, values, time, kind) <= max(values[i : i + 2])


def test_lists_and_tables_go_number_by_number():
    values = [
        {"wavelengths_nm": [400, 700], "values": [0.0, 1.0], "outside": "hold"},
        {"wavelengths_nm": [400, 700], "values": [1.0, 0.0], "outside": "hold"},
    ]
    assert between([0.0, 1.0], values, 0.25, "linear") == {
        "wavelengths_nm": [400, 700],
        "values": [0.25, 0.75],
        "outside": "hold",
    }


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ([[1, 2], [3, 4, 5]], "lists have different lengths"),
        ([{"a": 1}, {"b": 1}], "tables have different keys"),
        ([{"a": "x"}, {"a": "y"}], "texts differ"),
        ([True, False], "true and false differ"),
        ([1.0, "A"], "values differ in type"),
        ([1, 2.5], ""),
        (["A", "A"], ""),
    ],
)
def test_what_changes_in_steps_only(values, why):
    assert misfit(values) == why


def test_a_list_of_rotations_is_the_turn_that_placement_makes_of_it():
    value = [{"axis": "x", "degrees": 30.0}, {"axis": [1.0, 2.0, 0.5], "degrees": -200.0}]
    theirs = Rotation.from_matrix(rotation_of(value)).as_quat()
    assert abs(np.dot(theirs, turns(value))) == pytest.approx(1.0, abs=1e-12)


def test_a_turn_between_axes_goes_straight_and_the_shortest_way():
    times = [0.0, 2.0]
    values = [[{"axis": "x", "degrees": 350.0}], {"axis": [0.0, 1.0, 1.0], "degrees": 100.0}]
    ends = Rotation.from_matrix([rotation_of(value) for value in values])
    slerp = Slerp(times, ends)
    for time in (0.3, 1.0, 1.7):
        ours = rotation_of(turned(times, values, time, "linear"))
        np.testing.assert_allclose(ours, slerp(time).as_matrix(), atol=1e-12)
    for time in (-1.0, 0.0, 2.0, 9.0):
        assert turned(times, values, time, "linear") is values[time >= 2.0]


def test_a_smooth_turn_is_a_rotation_without_corners():
    times = [0.0, 1.0, 2.5, 3.0, 4.0]
    generator = np.random.default_rng(3)
    values = [
        {"axis": generator.normal(size=3).tolist(), "degrees": float(generator.uniform(0, 360))}
        for _ in times
    ]
    for time in np.linspace(0.01, 3.99, 30):
        matrix = rotation_of(turned(times, values, float(time), "smooth"))
        np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(matrix) == pytest.approx(1.0)
    h = 1e-5
    for time in times[1:-1]:
        before, at, after = (rotation_of(turned(times, values, time + d, "smooth")) for d in (-h, 0.0, h))
        np.testing.assert_allclose((after - at) / h, (at - before) / h, atol=2e-3)


def test_an_axis_without_length_is_no_turn():
    with pytest.raises(ValueError, match="axis must have a length"):
        turns({"axis": [0, 0, 0], "degrees": 10})


def test_a_turn_of_nothing_is_nothing():
    still = {"axis": "x", "degrees": 0.0}
    turn = turned([0.0, 1.0], [still, {"axis": "y", "degrees": 0.0}], 0.5, "linear")
    assert turn["degrees"] == 0.0 and not math.isnan(sum(map(float, [turn["degrees"]])))
