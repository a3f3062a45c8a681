"""What scanline techniques can be told: shadows, coverage, what is at infinity, subdivision."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.errors import MachineError, UsageError
from illuminant.scene import Scene

LIGHTS = {
    "point": {"kind": "point", "position": [0.7, 3.0, 0.4], "spectrum": "D65", "intensity_cd": 3000.0},
    "spot": {
        "kind": "spot",
        "position": [0.7, 3.0, 0.4],
        "direction": [-0.2, -1.0, -0.1],
        "half_angle_deg": 40.0,
        "spectrum": "D65",
        "intensity_cd": 3000.0,
    },
    "sun": {
        "kind": "directional",
        "direction": [-0.4, -1.0, -0.2],
        "spectrum": "D65",
        "illuminance_lx": 1000.0,
    },
}


def rectangle(corner, *edges):
    return {"rectangle": {"corner": corner, "edges": edges}}


def stage(light="point", *, tilt=0.0, things=True):
    """A floor, tipped by an angle in degrees, on which a ball and a plate throw shadows."""
    s, c = np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
    objects = {"floor": rectangle([-3, -3 * s, 3 * c], [6, 0, 0], [0, 6 * s, -6 * c]) | {"material": "chalk"}}
    if things:
        objects["ball"] = {"sphere": {"center": [-0.6, 0.8, 0.2], "radius": 0.5}, "material": "chalk"}
        objects["plate"] = rectangle([0.2, 0.9, 0.6], [0.9, 0, 0], [0, 0.3, -0.9]) | {"material": "chalk"}
    lights = {}
    if light == "lamp":
        objects["lamp"] = rectangle([-0.2, 3, -0.2], [0.4, 0, 0], [0, 0, 0.4]) | {"material": "lamp"}
    else:
        lights = {"light": LIGHTS[light]}
    return Scene.build(
        camera={"eye": [0, 5, 5], "target": [0, 0.3, 0], "size": [160, 120], "field_of_view": 40.0},
        objects=objects,
        materials={
            "chalk": {"kind": "diffuse", "reflectance": 0.8},
            "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 20000.0},
        },
        lights=lights,
    )


def luminance(scene, technique="phong", **options):
    options = {
        "illumination": "bouknight",
        "sampling": "uniform:8",
        "samples": 1,
        "ambient": 0.0,
        "filter": ("box", 0.5),
    } | options
    return np.asarray(illuminant.render(scene, technique=technique, **options).xyz, float)[..., 1]


# Shadow maps


@pytest.mark.parametrize("light", ["point", "spot", "sun", "lamp"])
def test_maps_show_the_shadows_that_rays_find(light):
    lit, rays = luminance(stage(light)), luminance(stage(light), shadows="rays")
    assert (rays < 0.9 * lit).sum() > 300
    apart = []
    for size in (256, 1024):
        maps = luminance(stage(light), shadows=f"maps:{size}")
        assert (maps <= lit * (1 + 1e-5)).all()
        apart.append(np.abs(maps - rays).mean() / lit.mean())
    # What is left lies along edges, and is as wide as texels are, to the facets of the ball; a lamp with an area is
    # asked at the same four places by each map, while rays go where its solid angle says.
    assert apart[1] < 0.02, apart
    assert apart[1] < 0.7 * apart[0], apart


@pytest.mark.parametrize("light", ["point", "sun", "spot"])
@pytest.mark.parametrize("tilt", [0.0, 30.0, 70.0, -40.0])
def test_a_plane_does_not_shade_itself_in_a_map(light, tilt):
    scene = stage(light, tilt=tilt, things=False)
    lit = luminance(scene)
    assert (lit > 0).sum() > 1000
    for size in (64, 512):
        np.testing.assert_array_equal(luminance(scene, shadows=f"maps:{size}"), lit)


def test_every_technique_takes_maps():
    for technique in ("constant", "gouraud", "phong"):
        scene = stage("sun")
        options = {"subdivide": 64.0}
        lit = luminance(scene, technique, **options).sum()
        assert luminance(scene, technique, shadows="maps", **options).sum() < 0.97 * lit


def test_maps_beyond_the_memory_are_refused(monkeypatch):
    monkeypatch.setattr("illuminant.machine.memory_available", lambda: 500_000_000)
    with pytest.raises(MachineError, match="shadow maps of this scene needs about"):
        luminance(stage("lamp"), shadows="maps:16384")
    luminance(stage("sun"), shadows="maps:1024")


# Area coverage


@pytest.mark.parametrize(
    ("technique", "options"),
    [
        ("constant", {}),
        ("gouraud", {"interpolation": "screen"}),
        ("gouraud", {"interpolation": "screen", "layers": "terms,depth"}),
    ],
)
def test_coverage_is_the_mean_of_its_places(technique, options):
    """Where light is constant or linear on the screen, one evaluation at the middle of a fragment is exact."""
    filtered = {"filter": ("gaussian", 1.5), **options}
    many = luminance(stage(), technique, samples=32, **filtered)
    one = luminance(stage(), technique, samples=1, antialiasing="coverage", **filtered)
    np.testing.assert_allclose(one, many, rtol=2e-5, atol=1e-5 * many.max())


def test_coverage_shades_each_polygon_once_and_is_near_supersampling():
    many = luminance(stage(), samples=32, illumination="phong")
    one = luminance(stage(), samples=1, illumination="phong", antialiasing="coverage")
    np.testing.assert_allclose(one, many, rtol=0.01, atol=2e-3 * many.max())


@pytest.mark.parametrize("angle", [0.0, 7.0, 45.0, 83.0])
def test_coverage_is_the_area_of_an_edge(angle):
    """A half-plane covers of a pixel what a polygon says that it covers, to a few of 32 places."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    corner = np.array([0.013, 0.021, 0.0])
    along, across = np.array([c, s, 0.0]), np.array([-s, c, 0.0])
    scene = Scene.build(
        camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [32, 32], "field_of_view": 10.0},
        objects={
            "half": {
                "rectangle": {
                    "corner": (corner - 50 * along).tolist(),
                    "edges": [(100 * along).tolist(), (50 * across).tolist()],
                },
                "material": "chalk",
            }
        },
        materials={"chalk": {"kind": "diffuse", "reflectance": 0.8}},
        lights={"sun": LIGHTS["sun"] | {"direction": [0, 0, -1]}},
    )
    found = luminance(scene, "constant", antialiasing="coverage")
    found /= found.max()
    width = 2 * 10 * np.tan(np.radians(5.0)) / 32
    fine = (np.arange(32 * 64) + 0.5) / 64 - 16
    x, y = np.meshgrid(fine * width - corner[0], -fine * width - corner[1])
    inside = (x * across[0] + y * across[1] > 0).astype(float)
    exact = inside.reshape(32, 64, 32, 64).mean(axis=(1, 3))
    assert np.abs(found - exact).max() < 2.5 / 32
    assert np.abs(found - exact)[(exact > 0) & (exact < 1)].mean() < 1.5 / 32


def test_coverage_sees_through_glass_and_to_the_surroundings():
    scene = Scene.build(
        camera={"eye": [0, 0, 4], "target": [0, 0, 0], "size": [40, 40], "field_of_view": 40.0},
        objects={
            "sheet": rectangle([-1, -1, 0.5], [1.3, 0, 0], [0.2, 1.7, 0]) | {"material": "green"},
            "ball": {"sphere": {"center": [0.2, 0.1, -1], "radius": 0.8}, "material": "chalk"},
        },
        materials={
            "chalk": {"kind": "diffuse", "reflectance": 0.8},
            "green": {"kind": "filter", "transmittance": "sRGB/green"},
        },
        lights={
            "sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0},
            "sun": LIGHTS["sun"],
        },
    )
    for technique in ("constant", "gouraud", "phong"):
        many = luminance(scene, technique, samples=32)
        one = luminance(scene, technique, antialiasing="coverage")
        np.testing.assert_allclose(one, many, rtol=0.02, atol=5e-3 * many.max())


# Eye and lights at infinity


def square(**light):
    """A glossy square that faces the eye, with a lamp near it."""
    return Scene.build(
        camera={"eye": [0, 0, 4], "target": [0, 0, 0], "size": [33, 33], "field_of_view": 20.0},
        objects={"square": rectangle([-1, -1, 0], [2, 0, 0], [0, 2, 0]) | {"material": "paint"}},
        materials={"paint": {"kind": "coated", "roughness": 0.2, "pigment": 0.3}},
        lights={
            "lamp": {
                "kind": "point",
                "position": [1.0, 0.5, 3.0],
                "spectrum": "D65",
                "intensity_cd": 2000.0,
                **light,
            }
        },
    )


@pytest.mark.parametrize("model", ["phong", "blinn", "cook-torrance", "general"])
def test_with_eye_and_lights_at_infinity_a_plane_has_one_colour(model):
    """All directions are the same, and so is what the model makes of them."""
    found = {
        name: luminance(square(), illumination=model, infinite=name, filter=("box", 1e-6))
        for name in ("", "eye", "lights", "eye,lights")
    }
    spread = {name: np.ptp(image) / image.mean() for name, image in found.items()}
    assert spread["eye,lights"] < 1e-5
    assert min(spread[name] for name in ("", "eye", "lights")) > 1e-3
    # In the middle of image and scene both are where they are.
    for image in found.values():
        assert image[16, 16] == pytest.approx(found[""][16, 16], rel=1e-4)


def test_lights_at_infinity_still_throw_shadows():
    for shadows in ("rays", "maps"):
        lit = luminance(stage("lamp"), infinite="lights")
        assert luminance(stage("lamp"), infinite="lights", shadows=shadows).sum() < 0.99 * lit.sum()


# Subdivision


def test_subdivided_polygons_show_the_highlight_that_gouraud_misses():
    exact = luminance(square(), "phong", illumination="phong")
    errors = [
        np.abs(luminance(square(), "gouraud", illumination="phong", **options) / exact - 1).max()
        for options in ({}, {"subdivide": 64.0}, {"subdivide": 4.0})
    ]
    assert errors[0] > 0.1
    assert errors[1] < 0.3 * errors[0]
    assert errors[2] < 0.3 * errors[1]


def test_subdivision_opens_no_cracks_and_keeps_the_outline():
    scene = stage()
    whole, fine = (luminance(scene, "phong", **options) for options in ({}, {"subdivide": 3.0}))
    np.testing.assert_array_equal(fine[10:-10, 20:-20] > 0, whole[10:-10, 20:-20] > 0)
    assert np.median(np.abs(fine / np.maximum(whole, 1e-9) - 1)) < 1e-4


def test_a_floor_under_the_eye_is_subdivided():
    """A polygon that goes on behind the eye has no size on the screen."""
    scene = Scene.build(
        camera={"eye": [0, 1, 0], "target": [0, 0, -4], "size": [60, 40], "field_of_view": 70.0},
        objects={"floor": rectangle([-500, 0, 500], [1000, 0, 0], [0, 0, -1000]) | {"material": "chalk"}},
        materials={"chalk": {"kind": "diffuse", "reflectance": 0.8}},
        lights={"lamp": LIGHTS["point"] | {"position": [0, 2, -5]}},
    )
    exact = luminance(scene, "phong")
    found = luminance(scene, "gouraud", subdivide=2.0)
    seen = exact > 0
    assert seen.sum() > 1000
    assert np.median(np.abs(found[seen] / exact[seen] - 1)) < 0.01


def test_a_sphere_is_subdivided_on_its_surface():
    """A flat polygon gets the normal of its place; the more of them, the nearer to a sphere."""
    scene = Scene.build(
        camera={"eye": [0, 0, 4], "target": [0, 0, 0], "size": [240, 240], "field_of_view": 20.0},
        objects={"ball": {"sphere": {"center": [0, 0, 0], "radius": 0.6}, "material": "chalk"}},
        materials={"chalk": {"kind": "diffuse", "reflectance": 0.8}},
        lights={"sun": LIGHTS["sun"]},
    )
    exact = luminance(scene, "path", illumination="general", depth=2)
    middle = (slice(80, 160), slice(80, 160))
    errors = [
        np.abs(luminance(scene, "constant", subdivide=area) - exact)[middle].mean() for area in (1e6, 1.0)
    ]
    assert errors[1] < 0.4 * errors[0], errors


# Refusals


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"shadows": "map"}, "expected none, rays, or maps"),
        ({"shadows": "maps:4"}, "expected none, rays, or maps"),
        ({"antialiasing": "fsaa"}, "expected supersampling or coverage"),
        ({"infinite": "camera"}, "known are eye, lights"),
        ({"subdivide": 0.5}, "expected an area of 1 pixel or more"),
    ],
)
def test_mistakes_are_named(options, message):
    with pytest.raises(UsageError, match=message):
        luminance(stage(), **options)
