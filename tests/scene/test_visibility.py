"""Cameras that see nothing are refused; what is small, far or at the edge is not taken for nothing."""

import numpy as np
import pytest

from illuminant import examination, visibility
from illuminant.errors import SceneError
from illuminant.scene import Scene

LAMP = {"lamp": {"kind": "emitter", "spectrum": "A", "luminance_cd_m2": 1000}}


def seen_by(camera, lights=None, **shape):
    return Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, -1], "size": [64, 32], "field_of_view": 60} | camera,
        materials=LAMP,
        objects={"thing": {"material": "lamp", **shape}},
        lights=lights,
    )


BALL = {"sphere": {"center": [0, 0, -5], "radius": 1}}
SLIVER = {"mesh": {"positions": [[-9, 0.21, -5], [9, 0.21, -5], [0, 0.2100001, -5]], "faces": [[0, 1, 2]]}}
FAR = {"mesh": {"positions": [[0.1, 0, -9], [0.1001, 0, -9], [0.1, 0.0001, -9]], "faces": [[0, 1, 2]]}}
GROUND = {"rectangle": {"corner": [-50, -1, 50], "edges": [[100, 0, 0], [0, 0, -100]]}}


@pytest.mark.parametrize(
    ("camera", "shape", "blind"),
    [
        ({}, BALL, False),
        ({"target": [0, 0, 1]}, BALL, True),
        ({"target": [1, 0, 0]}, BALL, True),
        ({"target": [1, 0, -1]}, BALL, False),
        ({"eye": [0, 0, -5], "target": [0, 0, 1]}, BALL, False),  # inside of it
        ({"crop": [0, 0, 4, 4]}, BALL, True),
        ({"crop": [24, 8, 40, 24]}, BALL, False),
        ({}, GROUND, False),
        ({"target": [0, 1, 0], "up": [0, 0, 1]}, GROUND, True),
        ({}, SLIVER, False),
        ({}, FAR, False),
        ({"target": [0, 0, 1]}, FAR, True),
    ],
)
def test_what_is_in_the_view(camera, shape, blind):
    assert visibility.blind(seen_by(camera, **shape)) is blind


def test_what_hides_between_the_rays_of_the_grid_is_still_in_the_view():
    for shape in (SLIVER, FAR):
        scene = seen_by({}, **shape)
        assert not scene.core().sees_anything()
        assert visibility.holds_anything(scene)


def test_an_environment_is_seen_by_every_camera():
    sky = {"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 10}}
    assert not visibility.blind(seen_by({"target": [0, 0, 1]}, sky, **BALL))


def test_the_planes_are_the_sides_of_the_image():
    """A point projected to a pixel lies inside, if the pixel is in the image or in the margin around it."""
    scene = seen_by({"eye": [1, 2, 3], "target": [2, 1, -1]}, **BALL)
    normals = visibility.planes(scene.description["camera"])
    points = np.random.default_rng(5).normal(size=(500, 3)) * 4
    inside = ((points - [1, 2, 3]) @ normals.T >= 0).all(axis=1)
    assert 10 < inside.sum() < 490
    for point, expected in zip(points, inside, strict=True):
        pixel = scene.core().project(list(point))
        within = pixel is not None and -16 <= pixel[0] <= 64 + 16 and -16 <= pixel[1] <= 32 + 16
        assert within == expected


def test_a_camera_that_sees_nothing_is_a_mistake_with_its_place(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(
        """
[camera]
target = [0, 0, 5]
eye = [0, 0, 0]

[materials.lamp]
kind = "emitter"
spectrum = "A"
flux_lm = 800

[objects.ball]
material = "lamp"
sphere = { center = [0, 0, -5], radius = 1 }
"""
    )
    scene = Scene.load(path)
    [problem] = examination.problems(scene)
    assert (problem.file, problem.line, problem.table, problem.key) == (str(path), 4, "camera", "eye")
    assert "sees nothing" in problem.message and problem.kind == "camera"
    with pytest.raises(SceneError, match=r"a\.toml:4: \[camera\] eye: the camera sees nothing"):
        examination.refuse(scene)
    assert examination.problems(scene.replace(camera={"target": [0, 0, -1]})) == []


def test_words_of_render_that_the_core_does_not_know_are_mistakes(tmp_path):
    scene = Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, -1], "crop": [0, 0, 9, 9]},
        materials=LAMP,
        objects={"ball": {"material": "lamp", "sphere": {"radius": 1}}},
        render={"technique": "magic", "sampling": "uniform:99", "illumination": "general"},
    )
    found = examination.problems(scene)
    assert [(problem.table, problem.key) for problem in found] == [
        ("render", "technique"),
        ("render", "sampling"),
    ]
    assert [problem.key for problem in examination.problems(scene, words=["sampling"])] == ["sampling"]
