"""Recursive and distributed ray tracing: `raytrace` and `distributed`."""

from __future__ import annotations

import json

import numpy as np
import pytest

import illuminant
from illuminant.core import core
from illuminant.errors import SceneError, UsageError
from illuminant.scene import Scene

POINT = {"kind": "point", "position": [1.0, 3.0, 2.0], "spectrum": "D65", "intensity_cd": 2000.0}

MATERIALS = {
    "chalk": {"kind": "diffuse", "reflectance": 0.8},
    "mirror": {"kind": "conductor", "metal": "silver"},
    "glass": {"kind": "dielectric", "n": 1.5},
    "satin": {"kind": "conductor", "metal": "copper", "roughness": 0.2},
    "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 5000.0},
    "sky": {"kind": "diffuse", "reflectance": 0.5},
}


def rectangle(material, corner, *edges):
    return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}


def room(ball="chalk", lights=None, lamp=False, size=(48, 36), **more):
    """A floor and a ball, under a point or a square lamp."""
    objects = {
        "floor": rectangle("chalk", [-4, 0, 4], [8, 0, 0], [0, 0, -8]),
        "ball": {"sphere": {"center": [0, 0.8, 0], "radius": 0.8}, "material": ball},
    }
    if lamp:
        objects["lamp"] = rectangle("lamp", [-0.5, 3, -0.5], [1, 0, 0], [0, 0, 1])
    return Scene.build(
        camera={"eye": [0, 1.5, 5], "target": [0, 0.7, 0], "size": list(size), "field_of_view": 40.0}
        | more.pop("camera", {}),
        objects=objects | more.pop("objects", {}),
        materials=MATERIALS | more.pop("materials", {}),
        lights=({} if lamp else {"key": POINT}) if lights is None else lights,
    )


def luminance(scene, technique, **options):
    options = {"sampling": "uniform:8", "samples": 1, "ambient": 0.0, "filter": ("box", 1e-6)} | options
    return np.asarray(illuminant.render(scene, technique=technique, **options).xyz, float)[..., 1]


# The limits in which techniques are one


@pytest.mark.parametrize("model", ["general", "whitted", "hall", "phong", "cook-torrance"])
@pytest.mark.parametrize("ball", ["chalk", "mirror", "glass"])
def test_without_chance_distributed_is_raytrace(model, ball):
    """One sample, a point light, and nothing rough."""
    scene = room(ball)
    options = {"illumination": model, "ambient": 0.2}
    found = luminance(scene, "distributed", **options)
    np.testing.assert_allclose(found, luminance(scene, "raytrace", **options), rtol=1e-5, atol=1e-4)


def test_all_are_path_where_all_agree():
    """Direct light of a point on a floor, and what a mirror shows of it: no technique sees more."""
    scene = Scene.build(
        camera={"eye": [0, 1.5, 5], "target": [0, 0.7, 0], "size": [48, 36], "field_of_view": 40.0},
        objects={
            "floor": rectangle("chalk", [-4, 0, 4], [8, 0, 0], [0, 0, -8]),
            "wall": rectangle("mirror", [-2, 0, -1.5], [4, 0, 0], [0, 3, 0]),
        },
        materials=MATERIALS,
        lights={"key": POINT},
    )
    path = luminance(scene, "path", depth=3)
    assert (path > 0).mean() > 0.5
    for technique in ("raytrace", "distributed"):
        np.testing.assert_allclose(luminance(scene, technique, depth=3), path, rtol=1e-4, atol=1e-3)
    scene = room("chalk")
    direct = luminance(scene, "path", depth=2)
    for technique in ("raytrace", "distributed"):
        np.testing.assert_allclose(luminance(scene, technique, depth=2), direct, rtol=1e-4, atol=1e-3)


def test_raytrace_has_no_noise():
    """The seed changes nothing where a pixel is seen at one place."""
    scene = room("glass", lamp=True)
    images = [luminance(scene, "raytrace", illumination="hall", seed=seed) for seed in (0, 7)]
    # The place itself is that of the seed, a millionth of a pixel from the middle.
    np.testing.assert_allclose(*images, rtol=1e-3, atol=1e-3)


def test_soft_shadows_are_those_of_path():
    scene = room(lamp=True)
    path = luminance(scene, "path", samples=1024, depth=2)
    found = luminance(scene, "distributed", samples=1024)
    inside = path < 0.9 * path.max()
    assert np.abs(found - path)[inside].mean() < 0.01 * path[inside].mean()
    rough = luminance(scene, "distributed", samples=1)
    assert np.abs(rough - path)[inside].mean() > 0.03 * path[inside].mean()


def test_gloss_of_general_is_that_of_path():
    """A rough metal that mirrors a lamp and a floor in direct light: one bounce, of which both see all."""
    scene = room("satin", lamp=True, size=(32, 24))
    path = luminance(scene, "path", samples=2048, depth=3)
    found = luminance(scene, "distributed", samples=2048, depth=3)
    ball = np.zeros(path.shape, bool)
    ball[8:14, 13:19] = True
    # Path also sees what the ball gives the floor and the floor the floor; of what the ball shows it is little.
    assert found[ball].mean() == pytest.approx(path[ball].mean(), rel=0.03)


# The tree


def test_without_rays_there_is_the_local_model():
    """With two segments no ray is followed, and a mirror shows nothing of the floor."""
    scene = room("mirror")
    deep, local = (
        luminance(scene, "raytrace", illumination="whitted", **options)[22:27, 20:28]
        for options in ({}, {"depth": 2})
    )
    assert local.mean() < 0.2 * deep.mean()


def test_adaptive_depth_saves_rays_and_costs_less_than_the_threshold():
    """Book figure 4.16: what is not followed weighs less than the threshold."""
    walls = {
        "back": rectangle("mirror", [-3, 0, -2], [6, 0, 0], [0, 4, 0]),
        "front": rectangle("mirror", [3, 0, 6], [-6, 0, 0], [0, 4, 0]),
    }
    scene = room("glass", objects=walls)
    found = {}
    for threshold in (0.0, 0.01, 0.1):
        image = illuminant.render(
            scene,
            technique="raytrace",
            illumination="hall",
            sampling="uniform:8",
            samples=1,
            depth=12,
            threshold=threshold,
            ambient=0.0,
            filter=("box", 1e-6),
        )
        found[threshold] = (np.asarray(image.xyz, float)[..., 1], image.statistics)
    exact, all_rays = found[0.0]
    for threshold in (0.01, 0.1):
        cut, fewer = found[threshold]
        assert fewer["rays"] < (0.8 if threshold == 0.01 else 0.5) * all_rays["rays"]
        assert fewer["pruned"] > 0
        # No surface is brighter than the brightest, and at most some dozen of rays were cut.
        assert np.abs(cut - exact).max() < 12 * threshold * exact.max()
    assert all_rays["pruned"] == 0


def test_beers_law_in_glass():
    """What a plate absorbs, within 0.2 %: A^d (Kay and Greenberg 1979)."""
    plates = {
        thickness: room(
            "chalk",
            camera={"eye": [0, 0.4, 5], "target": [0, 0.4, 0]},
            objects={
                "plate": {"box": {"min": [-3, -1, 3], "max": [3, 3, 3 + thickness]}, "material": "tinted"}
            },
            materials={"tinted": {"kind": "dielectric", "n": 1.0, "absorption": 3.0}},
        )
        for thickness in (0.01, 0.1, 0.2)
    }
    seen = {
        thickness: luminance(scene, "raytrace", threshold=0.0)[10, 24] for thickness, scene in plates.items()
    }
    pixel = 2 * np.tan(np.radians(20.0)) / 48
    slant = np.sqrt(1 + (7.5 * pixel) ** 2 + (0.5 * pixel) ** 2)
    assert seen[0.1] / seen[0.01] == pytest.approx(np.exp(-0.27 * slant), rel=2e-3)
    assert seen[0.2] / seen[0.01] == pytest.approx(np.exp(-0.57 * slant), rel=2e-3)


def test_bodies_that_overlap_by_priority():
    """A glass that is filled: the water reaches into the wall, and the wall counts (Schmidt and Budge 2002)."""

    def block(water_to, priority):
        return room(
            "chalk",
            camera={"eye": [0, 0.4, 5], "target": [0, 0.4, 0]},
            objects={
                "wall": {"box": {"min": [-3, -1, 2.5], "max": [3, 3, 3.0]}, "material": "wall"},
                "water": {"box": {"min": [-3, -1, 1.0], "max": [3, 3, water_to]}, "material": "water"},
            },
            materials={
                "wall": {"kind": "dielectric", "n": 1.5, "absorption": 1.0, "priority": priority},
                "water": {"kind": "dielectric", "n": 1.33, "absorption": 0.5},
            },
        )

    for technique, options in (
        ("raytrace", {"threshold": 0.0, "depth": 4}),
        ("path", {"samples": 64, "depth": 4}),
    ):
        images = [
            luminance(block(water_to, 1), technique, **options)[12:20, 12:36] for water_to in (2.6, 2.7, 2.99)
        ]
        # However far the water reaches into the wall, the same is seen.
        np.testing.assert_allclose(images[1], images[0], rtol=1e-4)
        np.testing.assert_allclose(images[2], images[0], rtol=1e-4)


# Lamps that have an area


def test_fixed_centres_band_random_ones_are_noisy_jittered_ones_between():
    """Book figures 4.17 and 4.18, in the half-shadow of a ball: error of the mean, and steps from pixel to pixel."""
    scene = room(lamp=True, size=(64, 48))
    exact = luminance(scene, "path", samples=2048, depth=2)
    half = np.zeros(exact.shape, bool)
    half[26:44, 8:56] = True
    errors = {
        how: np.sqrt(
            np.mean((luminance(scene, "distributed", samples=16, light_centres=how) - exact)[half] ** 2)
        )
        for how in ("fixed:4", "fixed:16", "random", "jittered")
    }
    assert errors["jittered"] < 0.6 * errors["random"]
    assert errors["fixed:16"] < errors["fixed:4"]
    # Fixed centres make the same error everywhere: more samples do not mend it.
    banded = luminance(scene, "distributed", samples=64, light_centres="fixed:4")
    assert np.sqrt(np.mean((banded - exact)[half] ** 2)) == pytest.approx(errors["fixed:4"], rel=0.05)


# Random numbers


def test_error_falls_as_samplers_promise():
    """The slope of log MSE over log samples of smooth direct light, against the integral over the lamp."""
    side, eye, size = 1.0, np.array([0.5, 4.0, 4.5]), (12, 8)
    target = np.array([1.5, 0.0, 1.5])
    scene = Scene.build(
        camera={"eye": eye.tolist(), "target": target.tolist(), "size": list(size), "field_of_view": 15.0},
        objects={
            "floor": rectangle("chalk", [-9, 0, 9], [18, 0, 0], [0, 0, -18]),
            "lamp": rectangle("lamp", [-side / 2, 3, -side / 2], [side, 0, 0], [0, 0, side]),
        },
        materials=MATERIALS,
    )
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    step = 2 * np.tan(np.radians(7.5)) / size[0]
    x, y = np.meshgrid(
        (np.arange(size[0]) + 0.5 - size[0] / 2) * step, (size[1] / 2 - np.arange(size[1]) - 0.5) * step
    )
    view = forward + x[..., None] * right + y[..., None] * up
    point = eye - view * (eye[1] / view[..., 1:2])
    nodes, weights = np.polynomial.legendre.leggauss(24)
    u, v = np.meshgrid(nodes * side / 2, nodes * side / 2)
    to = np.stack([u, np.full_like(u, 3.0), v], -1) - point[:, :, None, None, :]
    r2 = (to**2).sum(-1)
    kernel = (to[..., 1] ** 2 / r2**2) * np.outer(weights, weights) * (side / 2) ** 2
    exact = kernel.sum((-2, -1))
    counts = np.array([16, 64, 256, 1024, 4096])
    slopes = {}
    for sampler in ("random", "jittered", "poisson-disk", "sobol-owen"):
        mse = []
        for n in counts:
            found = luminance(scene, "path", samples=int(n), depth=2, sampler=sampler)
            mse.append(np.mean((found / exact * (exact.mean() / found.mean()) - 1) ** 2))
        slopes[sampler] = np.polyfit(np.log(counts), np.log(mse), 1)[0]
    assert -1.1 < slopes["random"] < -0.9, slopes
    assert slopes["jittered"] < -1.2, slopes
    assert slopes["sobol-owen"] < -1.2, slopes
    assert slopes["poisson-disk"] < -0.9, slopes


# Lens and motion


def spot_of_light(focus, distance, *, f_number=0.5, focal=100.0, blades=None, technique="distributed"):
    """A small bright square on the axis at a distance, seen through a lens."""
    side = 0.02
    camera = {
        "eye": [0, 0, 0],
        "target": [0, 0, -1],
        "up": [0, 1, 0],
        "size": [101, 101],
        "field_of_view": 20.0,
        "focal_length_mm": focal,
        "f_number": f_number,
        "focus_distance": focus,
    } | ({} if blades is None else {"blades": blades})
    scene = Scene.build(
        camera=camera,
        objects={"lamp": rectangle("lamp", [-side / 2, -side / 2, -distance], [side, 0, 0], [0, side, 0])},
        materials={"lamp": MATERIALS["lamp"]},
    )
    return luminance(scene, technique, samples=1024, illumination="general", filter=("box", 0.5))


def spread(image, focus, distance, side=0.02):
    """Mean square of the distance from the middle in the focal plane, m², without that of lamp and pixel themselves."""
    pixel = 2 * focus * np.tan(np.radians(10.0)) / 101
    x, y = np.meshgrid(np.arange(101) - 50, np.arange(101) - 50)
    own = ((side * focus / distance) ** 2 + pixel**2) / 6
    return (image * (x**2 + y**2)).sum() / image.sum() * pixel**2 - own


@pytest.mark.parametrize("technique", ["distributed", "path"])
@pytest.mark.parametrize(("focus", "distance"), [(2.0, 4.0), (2.0, 1.2), (3.0, 3.0)])
def test_a_point_out_of_focus_is_a_disc_of_the_thin_lens(technique, focus, distance):
    """Its diameter in the focal plane is A |d − f|/d (book figure 4.19)."""
    diameter = 0.1 / 0.5 * abs(distance - focus) / distance
    # The mean square of the distance from the middle of a disc is an eighth of that of its diameter.
    found = spread(spot_of_light(focus, distance, technique=technique), focus, distance)
    if diameter == 0:
        assert abs(found) < 3e-5  # a fifth of a pixel squared
    else:
        assert np.sqrt(8 * found) == pytest.approx(diameter, rel=0.03)


def test_blades_shape_what_is_out_of_focus():
    """The mean square of the distance from the middle of a regular polygon is r²(2 + cos 2π/n)/6."""
    disc, triangle = (spread(spot_of_light(2.0, 1.2, blades=blades), 2.0, 1.2) for blades in (None, 3))
    assert triangle / disc == pytest.approx((2 - 0.5) / 6 / 0.5, rel=0.05)


@pytest.mark.parametrize("technique", ["distributed", "path"])
def test_a_moving_edge_is_a_ramp(technique):
    """Coverage is proportional to time."""
    scene = Scene.build(
        camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [40, 3], "field_of_view": 20.0},
        objects={
            "half": rectangle("lamp", [-5, -1, 0], [5, 0, 0], [0, 2, 0])
            | {"translate": [-1.0, 0, 0], "motion": [{"translate": [1.0, 0, 0]}]}
        },
        materials={"lamp": MATERIALS["lamp"] | {"sides": "both"}},
    )
    row = luminance(scene, technique, samples=1024, illumination="general", filter=("box", 0.5))[1]
    row /= row[0]
    width = 2 * 10 * np.tan(np.radians(10.0)) / 40
    x = (np.arange(40) - 19.5) * width
    np.testing.assert_allclose(row, np.clip((1.0 - x) / 2.0, 0, 1), atol=0.01)


def test_a_camera_that_moves_blurs_as_an_object_does():
    def scene(**camera):
        moving = {} if camera else {"translate": [0.2, 0, 0], "motion": [{"translate": [-0.2, 0, 0]}]}
        return Scene.build(
            camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [40, 30], "field_of_view": 20.0} | camera,
            objects={"card": rectangle("lamp", [-0.5, -0.5, 0], [1, 0, 0], [0, 1, 0]) | moving},
            materials={"lamp": MATERIALS["lamp"]},
        )

    options = {"samples": 512, "illumination": "general", "filter": ("box", 0.5)}
    objects = luminance(scene(), "path", **options)
    camera = luminance(
        scene(
            eye=[-0.2, 0, 10],
            target=[-0.2, 0, 0],
            moves_to={"eye": [0.2, 0, 10], "target": [0.2, 0, 0]},
        ),
        "path",
        **options,
    )
    np.testing.assert_allclose(camera, objects, atol=0.02 * objects.max())


def test_a_shutter_that_opens_for_a_moment_is_sharp():
    def row(shutter):
        scene = Scene.build(
            camera={
                "eye": [0, 0, 10],
                "target": [0, 0, 0],
                "size": [40, 3],
                "field_of_view": 20.0,
                "shutter": shutter,
            },
            objects={
                "half": rectangle("lamp", [-5, -1, 0], [5, 0, 0], [0, 2, 0])
                | {"translate": [-1.0, 0, 0], "motion": [{"translate": [1.0, 0, 0]}]}
            },
            materials={"lamp": MATERIALS["lamp"]},
        )
        return luminance(scene, "path", samples=64, illumination="general", filter=("box", 0.5))[1]

    blurred = ((row([0.0, 1.0]) > 50) & (row([0.0, 1.0]) < 4950)).sum()
    sharp = ((row([0.5, 0.5]) > 50) & (row([0.5, 0.5]) < 4950)).sum()
    assert blurred > 15
    assert sharp <= 1


# Filters


@pytest.mark.parametrize("kind", ["box", "tent", "gaussian", "mitchell", "blackman-harris"])
def test_filters_keep_the_mean_and_blur_an_edge(kind):
    scene = Scene.build(
        camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [24, 8], "field_of_view": 10.0},
        objects={"half": rectangle("lamp", [-5, -5, 0], [5.03, 0, 0], [0, 10, 0])},
        materials={"lamp": MATERIALS["lamp"]},
    )
    image = luminance(scene, "path", samples=1024, illumination="general", filter=kind)
    row = image.mean(axis=0)
    row /= row[:6].mean()
    assert row[:6] == pytest.approx(1.0, abs=0.01)
    assert row[-6:] == pytest.approx(0.0, abs=0.01)
    if kind == "mitchell":
        # Its negative lobes sharpen: brighter before the edge, darker than nothing behind it.
        assert row.max() > 1.005
        assert row.min() < -0.005
    else:
        assert (np.diff(row) < 0.01).all()


# Mistakes


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"threshold": 1.0}, "expected a weight from 0 to below 1"),
        ({"light_centres": "fixed"}, "fixed with their number"),
        ({"light_centres": "fixed:0"}, "fixed with their number"),
        ({"sampler": "halton"}, "expected sobol-owen, random"),
        ({"filter": "lanczos"}, "mitchell or blackman-harris"),
    ],
)
def test_mistakes_of_options_are_named(options, message):
    with pytest.raises(UsageError, match=message):
        luminance(room(), "distributed", **options)


@pytest.mark.parametrize(
    ("camera", "message"),
    [
        ({"f_number": 2.0}, "focal_length_mm.*is missing"),
        ({"blades": 6}, "focal_length_mm.*is missing"),
        ({"focal_length_mm": 50.0, "f_number": 2.0, "blades": 2}, "blades"),
        ({"shutter": [0.7, 0.2]}, "must open before it closes"),
        ({"moves_to": {"eyes": [0, 0, 0]}}, "not a key"),
    ],
)
def test_mistakes_of_cameras_are_named(camera, message):
    with pytest.raises(SceneError, match=message):
        room(camera=camera)


def test_the_core_refuses_a_threshold_that_follows_nothing():
    scene = room()
    settings = {"technique": "raytrace", "threshold": 1.5}
    with pytest.raises(ValueError, match="threshold must lie from 0"):
        core().Render(scene.core(0), json.dumps(settings))
