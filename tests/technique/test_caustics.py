"""`path` with caustics: paths from lamps through what mirrors and bends their light."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.errors import UsageError
from illuminant.optics import fresnel_dielectric
from illuminant.scene import Scene

MATERIALS = {
    "chalk": {"kind": "diffuse", "reflectance": 0.7},
    "glass": {"kind": "dielectric", "n": 1.5, "dispersion": False},
    "crown": {"kind": "dielectric", "medium": "BK7"},
    "frosted": {"kind": "dielectric", "medium": "BK7", "roughness": 0.1},
    "water": {"kind": "dielectric", "n": 1.33, "dispersion": False},
    "silver": {"kind": "conductor", "metal": "silver"},
    "grey": {"kind": "filter", "transmittance": 0.5},
    "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 10000.0},
}
POINT = {"kind": "point", "position": [0.0, 3.0, 0.0], "spectrum": "D65", "intensity_cd": 1000.0}
LAMP = {"sphere": {"center": [1.0, 3.5, 0.6], "radius": 0.6}, "material": "lamp"}
FLAT_LAMP = {
    "rectangle": {"corner": [-0.6, 3.6, -0.6], "edges": [[1.2, 0, 0], [0, 0, 1.2]]},
    "material": "lamp",
}
BALL = {"sphere": {"center": [0, 0.8, 0], "radius": 0.6}, "material": "glass"}
FLOOR = {"rectangle": {"corner": [-3, 0, 3], "edges": [[6, 0, 0], [0, 0, -6]]}, "material": "chalk"}


def scene(objects, lights=None, materials=None, **camera):
    return Scene.build(
        camera={"eye": [0, 3, 5], "target": [0, 0.2, 0], "size": [32, 32], "field_of_view": 40.0} | camera,
        objects={"floor": FLOOR} | objects,
        materials=MATERIALS | (materials or {}),
        lights=lights or {},
    )


def render(scene, samples, **options):
    return illuminant.render(scene, samples=samples, **{"sampling": "uniform:8", "depth": 8} | options)


def luminance(scene, samples, **options):
    return np.asarray(render(scene, samples, **options).xyz, float)[..., 1]


def blocks(image, size=8):
    h, w = image.shape
    return image.reshape(h // size, size, w // size, size).mean(axis=(1, 3))


@pytest.mark.parametrize(
    ("objects", "lights"),
    [
        ({"ball": BALL, "lamp": LAMP}, None),
        (
            {
                "wall": {
                    "rectangle": {"corner": [-1.5, 0, -1], "edges": [[3, 0, 0], [0, 2, 0]]},
                    "material": "silver",
                }
            }
            | {"lamp": FLAT_LAMP},
            None,
        ),
        # A floor in water: light is squeezed at the surface, and seen through it from within alone.
        (
            {
                "water": {"box": {"min": [-2.9, -0.5, -2.9], "max": [2.9, 1.0, 2.9]}, "material": "water"},
                "lamp": LAMP | {"sphere": {"center": [1.0, 3.5, 0.6], "radius": 1.0}},
            },
            None,
        ),
        ({"ball": BALL | {"material": "crown"}, "lamp": LAMP}, None),
        ({"ball": BALL | {"material": "frosted"}, "lamp": LAMP}, None),
        ({"ball": BALL}, {"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 300.0}}),
        ({"ball": BALL}, {"sky": {"kind": "sky", "elevation_deg": 50.0, "sun": False}}),
    ],
    ids=["ball", "mirror", "water", "dispersion", "frosted", "environment", "sky"],
)
def test_paths_from_lamps_bring_what_chance_finds(objects, lights):
    """Where both can, path finds the same image with them and without, with fewer samples."""
    camera = {"eye": [0, 0.9, 2.0], "target": [0, 0.0, 0]} if "water" in objects else {}
    image = scene(objects, lights, **camera)
    expected = render(image, 2048, seed=3).xyz
    found = render(image, 512, caustics=True).xyz
    np.testing.assert_allclose(found.mean(axis=(0, 1)), expected.mean(axis=(0, 1)), rtol=1.2e-2)
    a, b = (blocks(np.asarray(xyz, float)[..., 1]) for xyz in (found, expected))
    assert np.sqrt(np.mean((a - b) ** 2)) < 0.04 * b.max()


def below(objects, lights=None, size=(24, 24)):
    """What a camera at the side of the lamp sees of 0.2 m of the floor below it."""
    camera = {
        "eye": [0.35, 0.6, 0.0],
        "target": [0, 0, 0],
        "up": [0, 0, -1],
        "size": list(size),
        "field_of_view": 16.0,
    }
    return scene(objects, lights or {"key": POINT}, **camera)


def test_a_point_lamp_behind_a_filter():
    """E = T I cos θ / r²: without paths from lamps, the shadow of the filter is black."""
    plate = {
        "rectangle": {"corner": [-0.2, 1.5, 0.2], "edges": [[0.4, 0, 0], [0, 0, -0.4]]},
        "material": "grey",
    }
    image = below({"plate": plate})
    assert not luminance(image, 4, depth=3).any()
    found = luminance(image, 1024, depth=3, caustics=True, filter=("box", 0.5))[6:18, 6:18].mean()
    assert found == pytest.approx(0.5 * 1000.0 / 9.0 * 0.7 / np.pi, rel=1.2e-2)


def test_a_slab_of_glass_brings_a_point_lamp_nearer():
    """Along the axis E = T² I / (h - t (1 - 1/n))², and what is reflected to and fro inside adds R² of it."""
    # Too high for light that its sides mirror to reach the axis again.
    slab = {"box": {"min": [-0.3, 2.2, -0.3], "max": [0.3, 2.7, 0.3]}, "material": "glass"}
    found = luminance(below({"slab": slab}), 1024, caustics=True, filter=("box", 0.5))[6:18, 6:18].mean()
    r = float(fresnel_dielectric(1.0, 1.5))
    h = 3.0 - 0.5 * (1.0 - 1.0 / 1.5)
    through = (1 - r) ** 2 / h**2 + (1 - r) ** 2 * r**2 / (h + 1.0 / 1.5) ** 2
    assert found == pytest.approx(1000.0 * through * 0.7 / np.pi, rel=1.5e-2)


def test_a_point_lamp_seen_by_a_mirror():
    """A second lamp behind the mirror, as far as the first is before it."""
    wall = {"rectangle": {"corner": [-1, 0, -1], "edges": [[2, 0, 0], [0, 2, 0]]}, "material": "silver"}
    camera = {"eye": [0, 1.0, 2.0], "target": [0, 0, 0.5], "size": [16, 16], "field_of_view": 30.0}
    key = POINT | {"position": [0.0, 2.0, 1.0], "spectrum": "E"}
    image = scene({"wall": wall}, {"key": key}, **camera)
    found = luminance(image, 2048, depth=3, caustics=True, filter=("box", 0.5))
    direct = luminance(image, 64, depth=2, filter=("box", 0.5))
    mirrored = scene({}, {"key": key | {"position": [0.0, 2.0, -3.0]}}, **camera)
    virtual = luminance(mirrored, 64, depth=2, filter=("box", 0.5))
    ratio = blocks((found - direct) / virtual, 4)[1:3, 1:3]
    # What silver reflects of white light at about 66°.
    assert 0.93 < ratio.mean() < 0.985
    assert np.abs(ratio / ratio.mean() - 1).max() < 0.05


def test_crop_threads_and_ranges_change_no_bit():
    image = scene({"ball": BALL}, {"key": POINT})
    whole = render(image, 8, caustics=True).xyz
    np.testing.assert_array_equal(render(image, 8, caustics=True, threads=1).xyz, whole)
    part = scene({"ball": BALL}, {"key": POINT}, crop=[4, 10, 20, 30])
    np.testing.assert_array_equal(render(part, 8, caustics=True).xyz, whole[10:30, 4:20])


def test_a_crop_changes_no_bit_where_roughness_is_drawn():
    """Between two rungs of a textured roughness one is drawn, wherever light from a lamp meets it."""
    rough = {
        "kind": "coated",
        "pigment": 0.5,
        "roughness": {"pattern": "noise", "scale": 0.3, "black": 0.1, "white": 0.5},
    }
    floor = {"top": FLOOR | {"material": "rough", "translate": [0, 0.01, 0]}}
    images = [
        render(scene({"ball": BALL} | floor, {"key": POINT}, {"rough": rough}, **crop), 4, caustics=True).xyz
        for crop in ({}, {"crop": [4, 10, 20, 30]})
    ]
    np.testing.assert_array_equal(images[1], images[0][10:30, 4:20])


def test_layers_and_error_count_both_ends():
    lights = {"key": POINT, "more": POINT | {"position": [1, 3, 1]}}
    image = render(scene({"ball": BALL}, lights), 8, caustics=True, lamps=True)
    both = image.layers["lamp:key"] + image.layers["lamp:more"]
    np.testing.assert_allclose(both, image.xyz, rtol=1e-4, atol=1e-4)
    stopped, exact = (
        render(scene({"ball": BALL}, lights), n, caustics=True, **options)
        for n, options in ((None, {"error": 0.05}), (256, {}))
    )
    np.testing.assert_allclose(stopped.xyz.mean(axis=(0, 1)), exact.xyz.mean(axis=(0, 1)), rtol=0.05)


def test_without_glass_and_mirrors_nothing_changes():
    image = scene({"ball": BALL | {"material": "chalk"}}, {"key": POINT})
    np.testing.assert_array_equal(luminance(image, 4, caustics=True), luminance(image, 4))


def test_who_cannot_says_so(caplog):
    image = scene({"ball": BALL}, {"key": POINT})
    with pytest.raises(UsageError, match="caustics go with path alone"):
        render(image, 1, technique="raytrace", caustics=True)
    fog = Scene.build(
        camera={"eye": [0, 3, 5], "target": [0, 0.2, 0], "size": [8, 8]},
        objects={"floor": FLOOR},
        materials=MATERIALS,
        lights={"key": POINT},
        medium={"scattering": 0.1},
    )
    with pytest.raises(UsageError, match="what is in the air"):
        render(fog, 1, caustics=True)
    render(image, 1)
    assert "--caustics follows it from the lamp" in caplog.text
    caplog.clear()
    render(image, 1, caustics=True)
    assert "caustics" not in caplog.text
