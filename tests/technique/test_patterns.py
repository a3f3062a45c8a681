"""Patterns that functions make on surfaces and in space (Perlin 1985; Norton, Rockwood and Skolmoski 1982)."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.errors import SceneError
from illuminant.scene import Scene

SKY = {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 100.0}
KINDS = ["noise", "turbulence", "marble", "wood", "checker", "stripes"]


def wall(reflectance, size=32, view=1.0, shift=0.0, **more):
    """A wall under even light: what is seen is its reflectance."""
    return Scene.build(
        camera={
            "eye": [shift, 0, 2],
            "target": [shift, 0, 0],
            "size": [size, size],
            "field_of_view": float(np.degrees(2 * np.arctan(view / 4))),
        },
        materials={"wall": {"kind": "diffuse", "reflectance": reflectance} | more},
        objects={
            "wall": {
                "rectangle": {"corner": [-50, -50, 0], "edges": [[100, 0, 0], [0, 100, 0]]},
                "material": "wall",
            }
        },
        lights={"sky": SKY},
    )


def seen(scene, samples=16, **options):
    options = {"sampling": "uniform:8", "depth": 2, "filter": ("box", 0.5)} | options
    image = illuminant.render(scene, samples=samples, **options)
    return np.asarray(image.xyz, float)[..., 1]


def level(pattern, **options):
    """The value of a pattern between black and white, as it is seen."""
    white = seen(wall(0.9), samples=64).mean()
    made = wall({"colours": [0.0, 0.9], "scale": 0.25} | pattern, **options.pop("view", {}))
    return seen(made, **options) / white


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_finer_than_a_pixel_is_its_mean(kind):
    """A pixel that holds a hundred waves shows, without a sample more, the mean of what is seen near by."""
    pattern = {"pattern": kind, "octaves": 3, "axis": [1.0, 0.3, 0.2], "origin": [0.03, 0.02, 0.11]}
    near = level(pattern, view={"view": 6.0, "size": 96}, samples=64).mean()
    far = level(pattern | {"scale": 0.002}, view={"view": 40.0, "size": 8}, samples=64)
    np.testing.assert_allclose(far, near, rtol=0.12)
    assert far.std() < 0.02 * far.mean()


def test_stripes_are_layers_along_their_axis():
    found = level(
        {"pattern": "stripes", "axis": [1, 0, 0], "scale": 0.25, "origin": [-0.5, 0, 0]}, samples=64
    )
    # Four layers in the metre that is seen, white first.
    middles = found[:, [4, 12, 20, 28]].mean(axis=0)
    np.testing.assert_allclose(middles, [1, 0, 1, 0], atol=0.03)
    assert np.ptp(found, axis=0).max() < 0.2


def test_a_solid_pattern_goes_through_the_block():
    """The side of a block and its front agree on the edge between them; a pattern of texture coordinates does not."""
    pattern = {"pattern": "noise", "scale": 0.3, "colours": [0.05, 0.9], "octaves": 2}
    front, side = (
        Scene.build(
            camera={"eye": eye, "target": target, "size": [8, 64], "field_of_view": 1.0},
            materials={"one": {"kind": "diffuse", "reflectance": pattern}},
            objects={"block": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "material": "one"}},
            lights={"sky": SKY},
        )
        for eye, target in (([0.94, 0, 9], [0.94, 0, 1]), ([9, 0, 0.94], [1, 0, 0.94]))
    )
    a, b = (seen(made, samples=64) for made in (front, side))
    # The last column of the front is the first of the side.
    shared = np.corrcoef(a[:, -1], b[:, 0])[0, 1]
    apart = np.corrcoef(a[:, -1], b[::-1, 0])[0, 1]
    assert shared > 0.9 > apart + 0.3


def test_a_moving_object_takes_its_pattern_along():
    def ball(center, motion):
        return Scene.build(
            camera={"eye": [center, 0, 5], "target": [center, 0, 0], "size": [24, 24], "field_of_view": 16.0}
            | ({"shutter": [1.0, 1.0]} if motion else {}),
            materials={
                "one": {
                    "kind": "diffuse",
                    "reflectance": {"pattern": "marble", "scale": 0.4, "colours": [0.1, 0.9]},
                }
            },
            objects={"ball": {"sphere": {"center": [0, 0, 0], "radius": 0.6}, "material": "one"} | motion},
            lights={"sky": SKY},
        )

    still = seen(ball(0.0, {}))
    moved = seen(ball(3.0, {"motion": [{"translate": [3.0, 0, 0]}]}))
    np.testing.assert_allclose(moved.mean(), still.mean(), rtol=1e-2)
    np.testing.assert_allclose(moved[6:18, 6:18], still[6:18, 6:18], rtol=0.1)


def test_noise_as_relief_tilts_normals_as_much_as_it_rises():
    """Under light from one side the cosine varies with the slope about that of the plane."""

    def lit(height):
        made = Scene.build(
            camera={"eye": [0, 0, 2], "target": [0, 0, 0], "size": [48, 48], "field_of_view": 60.0},
            materials={
                "wall": {
                    "kind": "diffuse",
                    "reflectance": 0.5,
                    "bump": {"pattern": "noise", "scale": 0.2, "height": height, "octaves": 1},
                }
            },
            objects={
                "wall": {
                    "rectangle": {"corner": [-5, -5, 0], "edges": [[10, 0, 0], [0, 10, 0]]},
                    "material": "wall",
                }
            },
            lights={
                "sun": {
                    "kind": "directional",
                    "direction": [-1, 0, -1],
                    "spectrum": "E",
                    "illuminance_lx": 1000.0,
                }
            },
        )
        return seen(made, samples=16)

    flat, low, high = (lit(height) for height in (0.0, 0.01, 0.02))
    assert flat.std() < 1e-3 * flat.mean()
    # To first order the cosine changes by the slope along the light, linear in height; its mean stays.
    assert high.std() / low.std() == pytest.approx(2.0, rel=0.1)
    assert low.mean() == pytest.approx(flat.mean(), rel=0.02)


def test_roughness_by_a_pattern():
    rough = {"pattern": "checker", "coordinates": "uv", "scale": 0.5, "black": 0.02, "white": 0.4}
    made = Scene.build(
        camera={"eye": [0, 3, 3], "target": [0, 0, 0], "size": [32, 32], "field_of_view": 35.0},
        materials={"one": {"kind": "conductor", "metal": "silver", "roughness": rough}},
        objects={
            "floor": {
                "rectangle": {"corner": [-1, 0, 1], "edges": [[2, 0, 0], [0, 0, -2]]},
                "material": "one",
            }
        },
        lights={
            "lamp": {
                "kind": "directional",
                "direction": [0, -1, -1],
                "spectrum": "E",
                "illuminance_lx": 1000.0,
            }
        },
    )
    image = seen(made, samples=16)
    quarters = np.array(
        [
            [image[10:14, 10:14].mean(), image[10:14, 18:22].mean()],
            [image[19:24, 9:13].mean(), image[19:24, 19:23].mean()],
        ]
    )
    # Two by two in turn.
    assert np.all(
        np.sort([quarters[0, 0], quarters[1, 1]]) > 3 * max(quarters[0, 1], quarters[1, 0])
    ) or np.all(np.sort([quarters[0, 1], quarters[1, 0]]) > 3 * max(quarters[0, 0], quarters[1, 1]))


@pytest.mark.parametrize("technique", ["raytrace", "distributed", "phong"])
def test_every_technique_shows_them(technique):
    pattern = {"pattern": "checker", "scale": 0.25, "origin": [0, 0, 0.1]}
    found = level(pattern, technique=technique, ambient=1.0, samples=16)
    assert np.abs(found - level(pattern, samples=64)).mean() < 0.05


def test_summed_areas_blur_as_the_pyramid_does():
    """An image of fine stripes, near by and from afar: the same means, whichever way they are found."""
    image = np.zeros((64, 64, 3), np.float32)
    image[:, ::2] = 1.0
    for view, spread in ((0.5, None), (60.0, 0.02)):
        found = [
            seen(
                wall({"image": image, "repeat": [50, 50], "filtering": filtering}, size=16, view=view),
                samples=32,
            )
            for filtering in ("pyramid", "summed-area")
        ]
        np.testing.assert_allclose(found[1].mean(), found[0].mean(), rtol=0.02)
        if spread:
            assert found[1].std() < spread * found[1].mean()


@pytest.mark.parametrize(
    ("reflectance", "message"),
    [
        ({"pattern": "granite", "colours": [0.1, 0.2]}, "pattern"),
        ({"pattern": "noise"}, "colours"),
        ({"pattern": "noise", "colours": [0.1, 1.2]}, "colours"),
        ({"pattern": "noise", "colours": [0.1, 0.2], "scale": 0.0}, "scale"),
        ({"pattern": "stripes", "colours": [0.1, 0.2], "axis": [0, 0, 0]}, "axis"),
        ({"pattern": "noise", "colours": [0.1, 0.2], "octaves": 40}, "octaves"),
    ],
)
def test_mistakes_are_named(reflectance, message):
    with pytest.raises(SceneError, match=message):
        wall(reflectance)
