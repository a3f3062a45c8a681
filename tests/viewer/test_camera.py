"""The page's camera and the scene's are one."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant.viewer.camera import horizontal_deg, limited, rotation, scene_camera, vertical_rad


@given(st.floats(5, 150), st.integers(16, 4000), st.integers(16, 4000))
def test_fields_of_view_go_there_and_back(degrees, width, height):
    there = vertical_rad(degrees, width, height)
    assert horizontal_deg(there, width, height) == pytest.approx(degrees, rel=1e-9)


@given(st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(v * v for v in q) > 1e-3))
def test_a_quaternion_is_a_rotation(wxyz):
    turn = rotation(wxyz)
    assert np.allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_a_quarter_turn_about_y_looks_along_x():
    half = math.sqrt(0.5)
    camera = scene_camera(
        {"lens": None, "crop": [0, 0, 1, 1]}, [half, 0, half, 0], [1, 2, 3], 1.0, (200, 100), 2.0
    )
    assert np.allclose(camera["eye"], [1, 2, 3])
    assert np.allclose(camera["target"], [3, 2, 3])
    assert np.allclose(camera["up"], [0, -1, 0])
    assert "crop" not in camera
    assert camera["size"] == [200, 100]


@given(st.integers(1, 8000), st.integers(1, 8000), st.integers(100, 10**6))
def test_a_limited_picture_keeps_its_shape(width, height, pixels):
    w, h = limited(width, height, pixels)
    assert 1 <= w <= width and 1 <= h <= height
    assert w * h <= pixels * 1.05 + w + h
