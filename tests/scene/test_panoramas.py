"""Surroundings as cube, as mirrored ball, and by latitude and longitude."""

from __future__ import annotations

import numpy as np
import pytest

from illuminant.errors import ImageError, SceneError
from illuminant.panoramas import latitude_longitude
from illuminant.scene import Scene


def colour(x, y, z):
    """A smooth picture of directions."""
    return np.stack([0.5 + 0.4 * x, 0.5 + 0.4 * y, 0.5 + 0.4 * z], axis=-1)


def expected(height):
    """The same by latitude and longitude."""
    theta = (np.arange(height) + 0.5)[:, None] / height * np.pi
    phi = (np.arange(2 * height) + 0.5)[None, :] / height * np.pi - np.pi
    return colour(np.sin(theta) * np.sin(phi), np.cos(theta) + 0 * phi, -np.sin(theta) * np.cos(phi))


def face(size, right, up, ahead):
    """A face of a cube, seen from inside."""
    at = (np.arange(size) + 0.5) / size * 2 - 1
    s, t = np.meshgrid(at, -at)
    d = sum(np.multiply.outer(part, np.array(axis, float)) for part, axis in ((s, right), (t, up)))
    d = d + np.array(ahead, float)
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    return colour(d[..., 0], d[..., 1], d[..., 2])


FACES = {
    "right": ([0, 0, 1], [0, 1, 0], [1, 0, 0]),
    "left": ([0, 0, -1], [0, 1, 0], [-1, 0, 0]),
    "up": ([1, 0, 0], [0, 0, 1], [0, 1, 0]),
    "down": ([1, 0, 0], [0, 0, -1], [0, -1, 0]),
    "behind": ([-1, 0, 0], [0, 1, 0], [0, 0, 1]),
    "ahead": ([1, 0, 0], [0, 1, 0], [0, 0, -1]),
}


def test_a_cube_in_a_row_and_in_a_cross():
    size = 32
    faces = {name: face(size, *axes) for name, axes in FACES.items()}
    row = np.concatenate(list(faces.values()), axis=1)
    cross = np.zeros((3 * size, 4 * size, 3))
    places = {
        "up": (0, 1),
        "left": (1, 0),
        "ahead": (1, 1),
        "right": (1, 2),
        "behind": (1, 3),
        "down": (2, 1),
    }
    for name, (i, j) in places.items():
        cross[i * size : (i + 1) * size, j * size : (j + 1) * size] = faces[name]
    for image in (row, cross):
        found = latitude_longitude(image, "cube")
        assert np.abs(found - expected(2 * size)).max() < 0.02
    # Neighbouring faces of the cross meet.
    assert np.abs(cross[size - 1, size : 2 * size] - cross[size, size : 2 * size]).max() < 0.04


def test_a_mirrored_ball():
    size = 256
    at = (np.arange(size) + 0.5) / size * 2 - 1
    x, y = np.meshgrid(at, -at)
    z = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    found = latitude_longitude(colour(2 * z * x, 2 * z * y, 2 * z * z - 1), "sphere")
    # Near the direction away from the camera the rim of the ball shows everything in a pixel.
    error = np.abs(found - expected(size)).max(axis=2)
    assert np.quantile(error, 0.98) < 0.03


@pytest.mark.parametrize(("layout", "shape"), [("cube", (10, 50, 3)), ("sphere", (10, 20, 3))])
def test_other_shapes_are_refused(layout, shape):
    with pytest.raises(ImageError, match=r"not .* pixels"):
        latitude_longitude(np.ones(shape), layout)
    with pytest.raises(SceneError, match=r"not .* pixels"):
        scene(np.ones(shape, np.float32), layout)


def scene(image, layout):
    """A ball in surroundings."""
    return Scene.build(
        camera={"eye": [0, 0, 3], "target": [0, 0, 0]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": "grey"}},
        materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
        lights={"sky": {"kind": "environment", "image": image, "layout": layout, "luminance_cd_m2": 100.0}},
    )


def test_a_scene_takes_any_layout():
    made = scene(np.ones((8, 48, 3), np.float32), "cube")
    assert made.arrays["image:sky"].shape == (16, 32, 3)
