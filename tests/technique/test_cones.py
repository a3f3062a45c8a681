"""`raytrace` with cones (Amanatides 1984): one sample a pixel sees what part of it surfaces cover."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.errors import UsageError
from illuminant.scene import Scene

MATERIALS = {
    "chalk": {"kind": "diffuse", "reflectance": 0.8},
    "mirror": {"kind": "conductor", "metal": "silver"},
    "glass": {"kind": "dielectric", "n": 1.5},
    "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 5000.0},
}
POINT = {"kind": "point", "position": [1.0, 3.0, 2.0], "spectrum": "D65", "intensity_cd": 2000.0}


def rectangle(material, corner, *edges):
    return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}


def room(ball, lamp=False, size=(96, 72), **more):
    objects = {
        "floor": rectangle("chalk", [-4, 0, 4], [8, 0, 0], [0, 0, -8]),
        "ball": {"sphere": {"center": [0, 0.8, 0], "radius": 0.8}, "material": ball},
    }
    if lamp:
        objects["lamp"] = rectangle("lamp", [-0.5, 3, -0.5], [1, 0, 0], [0, 0, 1])
    return Scene.build(
        camera={"eye": [0, 1.5, 5], "target": [0, 0.7, 0], "size": list(size), "field_of_view": 40.0},
        objects=objects | more,
        materials=MATERIALS,
        lights={} if lamp else {"key": POINT},
    )


def luminance(scene, **options):
    options = {"technique": "raytrace", "sampling": "uniform:8", "samples": 1, "ambient": 0.1} | options
    return np.asarray(illuminant.render(scene, filter=("box", 0.5), **options).xyz, float)[..., 1]


def error(found, exact):
    """Root mean square, with highlights no brighter than the picture's white."""
    white = np.percentile(exact, 99)
    return np.sqrt(np.mean((np.minimum(found, white) - np.minimum(exact, white)) ** 2)) / white


def test_area_is_area():
    """A card before black, and a ball: the mean of the image is the part that they cover."""
    card = Scene.build(
        camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [40, 40], "field_of_view": 20.0},
        objects={"card": rectangle("lamp", [-0.737, -0.611, 0], [1.3, 0.4, 0], [-0.2, 1.1, 0])},
        materials=MATERIALS,
    )
    side = 2 * 10 * np.tan(np.radians(10.0))
    area = 1.3 * 1.1 + 0.4 * 0.2
    assert luminance(card, cones=True).mean() == pytest.approx(5000.0 * area / side**2, rel=5e-3)
    ball = Scene.build(
        camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [40, 40], "field_of_view": 20.0},
        objects={"ball": {"sphere": {"center": [0.03, 0.07, 0], "radius": 0.6}, "material": "lamp"}},
        materials=MATERIALS,
    )
    seen = np.pi * (10 * np.tan(np.arcsin(0.06))) ** 2
    assert luminance(ball, cones=True).mean() == pytest.approx(5000.0 * seen / side**2, rel=1e-2)


@pytest.mark.parametrize("ball", ["chalk", "mirror", "glass"])
def test_one_cone_is_as_smooth_as_many_rays(ball):
    scene = room(ball)
    exact = luminance(scene, samples=256)
    cone, ray = luminance(scene, cones=True), luminance(scene)
    assert error(cone, exact) < 0.012
    assert error(cone, exact) < 0.75 * error(ray, exact)
    assert cone.mean() == pytest.approx(exact.mean(), rel=5e-3)


def test_soft_shadows_are_the_part_of_the_lamp_that_is_seen():
    """A straight edge under a square lamp: the penumbra of 256 places, smooth with one."""
    edge = rectangle("chalk", [-4, 1, 4], [3.9, 0, 0], [0, 0, -8])
    scene = Scene.build(
        camera={
            "eye": [2, 2.5, 0],
            "target": [0.4, 0, 0],
            "up": [0, 1, 0],
            "size": [64, 8],
            "field_of_view": 40.0,
        },
        objects={
            "floor": rectangle("chalk", [-4, 0, 4], [8, 0, 0], [0, 0, -8]),
            "edge": edge,
            "lamp": rectangle("lamp", [-0.3, 3, -0.3], [0.6, 0, 0], [0, 0, 0.6]),
        },
        materials=MATERIALS,
    )
    exact = luminance(scene, samples=16, light_centres="fixed:256", ambient=0.0)
    cone = luminance(scene, cones=True, ambient=0.0)
    # A disc stands for the square: the same width within a tenth, no steps.
    assert np.abs(cone - exact).max() < 0.06 * exact.max()
    assert cone.mean() == pytest.approx(exact.mean(), rel=0.02)


@pytest.mark.parametrize("ball", ["chalk", "mirror", "glass"])
def test_soft_shadows_of_a_ball(ball):
    scene = room(ball, lamp=True)
    exact = luminance(scene, samples=64, light_centres="fixed:64")
    cone = luminance(scene, cones=True)
    assert error(cone, exact) < 0.04
    assert cone.mean() == pytest.approx(exact.mean(), rel=0.02)


def test_bodies_inside_each_other_and_moved_ones():
    """Instances, meshes and a ball in a glass ball: the mean of many rays."""
    inner = {"inner": {"sphere": {"center": [0, 0.8, 0], "radius": 0.3}, "material": "chalk"}}
    box = {
        "box": {
            "box": {"min": [-0.3, 0, -0.3], "max": [0.3, 0.6, 0.3]},
            "material": "chalk",
            "translate": [1.4, 0, 0.6],
            "rotate": {"axis": "y", "degrees": 30.0},
        }
    }
    scene = room("glass", **inner, **box)
    exact, cone = luminance(scene, samples=256), luminance(scene, cones=True)
    assert cone.mean() == pytest.approx(exact.mean(), rel=0.01)
    assert error(cone, exact) < 0.03


def test_there_is_no_chance_in_cones():
    scene = room("glass", lamp=True)
    np.testing.assert_array_equal(
        luminance(scene, cones=True), luminance(scene, cones=True, seed=7, threads=1)
    )


def test_cones_go_with_raytrace_alone():
    with pytest.raises(UsageError, match="cones go with raytrace alone"):
        luminance(room("chalk"), technique="distributed", cones=True)
    tables = {"technique": "raytrace", "cones": True}
    scene = Scene.build(
        camera={"eye": [0, 1.5, 5], "target": [0, 0.7, 0], "size": [8, 8]},
        objects={"floor": rectangle("chalk", [-4, 0, 4], [8, 0, 0], [0, 0, -8])},
        materials=MATERIALS,
        lights={"key": POINT},
        render=tables,
    )
    # What the scene wants of its own technique is nothing to another.
    illuminant.render(scene, technique="path", samples=1, sampling="uniform:8")
