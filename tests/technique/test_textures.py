"""Images on surfaces: what they are for every technique, and what is wrong with them."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant import spectra
from illuminant.errors import SceneError
from illuminant.scene import Scene

LAMP = {"kind": "directional", "direction": [-1, -2, -1], "spectrum": "D65", "illuminance_lx": 3000.0}
SKY = {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 200.0}
SQUARE = {"rectangle": {"corner": [-1, 0, 1], "edges": [[2, 0, 0], [0, 0, -2]]}}
PAIRS = [
    ("path", "general"),
    ("path", "phong"),
    ("phong", "general"),
    ("phong", "cook-torrance"),
    ("gouraud", "phong"),
    ("gouraud", "general"),
    ("constant", "bouknight"),
]


def scene(material, shape=None, **camera):
    """A surface under sun and sky."""
    view = {"eye": [0, 2, 2], "target": [0, 0, 0], "size": [24, 24], "field_of_view": 30} | camera
    return Scene.build(
        camera=view,
        materials={"one": material},
        objects={"thing": (shape or SQUARE) | {"material": "one"}},
        lights={"sun": LAMP, "sky": SKY},
    )


def xyz(made, technique="path", illumination="general", samples=8, **options):
    """The image of a scene, in 8 samples at fixed wavelengths."""
    image = illuminant.render(
        made, technique=technique, illumination=illumination, sampling="uniform:8", samples=samples, **options
    )
    return np.asarray(image.xyz, float)


def mixture(parts):
    """The reflectance that a colour of an image has."""
    basis = [spectra.load(f"sRGB/{name}") for name in ("red", "green", "blue")]
    curve = parts[0] * basis[0] + parts[1] * basis[1] + parts[2] * basis[2]
    return {"wavelengths_nm": list(curve.wavelengths_nm), "values": list(curve.values)}


@pytest.mark.parametrize(("technique", "illumination"), PAIRS)
@pytest.mark.parametrize("kind", ["diffuse", "translucent", "coated"])
def test_an_image_of_one_colour_is_that_colour(technique, illumination, kind):
    parts = (0.6, 0.25, 0.1)
    image = np.broadcast_to(np.float32(parts), (5, 7, 3)).copy()
    rest = {"kind": kind} | {"coated": {"roughness": 0.2}, "translucent": {"transmittance": 0.3}}.get(
        kind, {}
    )
    key = "pigment" if kind == "coated" else "reflectance"
    plain = xyz(scene(rest | {key: mixture(parts)}), technique, illumination)
    shown = xyz(scene(rest | {key: {"image": image}}), technique, illumination)
    assert shown.max() > 50
    np.testing.assert_allclose(shown, plain, rtol=2e-4, atol=1e-3 * plain.max())


def test_an_image_of_finished_paint_is_seen_through_its_surface():
    parts = (0.5, 0.3, 0.2)
    image = np.broadcast_to(np.float32(parts), (2, 2, 3)).copy()
    plain = xyz(scene({"kind": "coated", "reflectance": mixture(parts)}))
    shown = xyz(scene({"kind": "coated", "reflectance": {"image": image}}))
    np.testing.assert_allclose(shown, plain, rtol=1e-3)


@pytest.mark.parametrize(("technique", "illumination"), [("path", "general"), ("phong", "phong")])
def test_an_image_of_one_roughness_is_that_roughness(technique, illumination):
    image = np.full((3, 3, 3), 0.5, np.float32)
    metal = {"kind": "conductor", "metal": "gold"}
    plain = xyz(scene(metal | {"roughness": 0.3}), technique, illumination)
    shown = xyz(
        scene(metal | {"roughness": {"image": image, "black": 0.1, "white": 0.5}}), technique, illumination
    )
    np.testing.assert_allclose(shown, plain, rtol=1e-4)


def test_roughness_between_two_rungs_is_a_mixture():
    # A ramp along u; the middle of the square lies between two rungs.
    ramp = np.repeat(np.linspace(0, 1, 256, dtype=np.float32)[None, :, None], 2, axis=0).repeat(3, axis=2)
    metal = {"kind": "conductor", "metal": "gold"}
    narrow = {"field_of_view": 0.5, "size": [8, 8]}
    shown = {}
    for technique in ("path", "phong"):
        made = scene(
            metal | {"roughness": {"image": ramp, "wrap": "clamp", "black": 0.12, "white": 0.5}}, **narrow
        )
        plain = scene(metal | {"roughness": 0.31}, **narrow)
        shown[technique] = xyz(made, technique, samples=64)[..., 1].mean()
        assert shown[technique] == pytest.approx(xyz(plain, technique, samples=64)[..., 1].mean(), rel=0.02)


@pytest.mark.parametrize(("technique", "illumination"), PAIRS)
def test_a_board_seen_from_far_away_is_the_mean_of_its_fields(technique, illumination):
    board = np.zeros((64, 64, 3), np.float32)
    board[::2, ::2] = board[1::2, 1::2] = (0.9, 0.5, 0.1)
    table = {"image": board, "repeat": [50, 50]}
    far = {"eye": [0, 40, 40], "field_of_view": 2.0}
    shown = xyz(scene({"kind": "diffuse", "reflectance": table}, **far), technique, illumination, samples=4)
    plain = xyz(
        scene({"kind": "diffuse", "reflectance": mixture((0.45, 0.25, 0.05))}, **far),
        technique,
        illumination,
        samples=4,
    )
    np.testing.assert_allclose(shown, plain, rtol=2e-3, atol=1e-3 * plain.max())


def test_a_board_lies_as_its_coordinates_say():
    board = np.full((2, 2, 3), 0.05, np.float32)
    board[0, 0] = 0.9  # upper left: small u, large v
    for technique in ("path", "phong", "gouraud", "constant"):
        made = scene(
            {"kind": "diffuse", "reflectance": {"image": board, "wrap": "clamp"}},
            eye=[0, 4, 0.01],
            up=[0, 0, -1],
        )
        y = xyz(made, technique, "general" if technique == "path" else "phong")[..., 1]
        bright = y[3:6, 3:6].mean()
        assert bright > 4 * max(y[3:6, 18:21].mean(), y[18:21, 3:6].mean()), technique


def test_parts_of_measured_paints():
    image = np.zeros((1, 1, 3), np.float32)
    image[0, 0, 0] = 1.0
    basis = ["ColorChecker/red", "ColorChecker/blue", "ColorChecker/white 9.5"]
    shown = xyz(scene({"kind": "diffuse", "reflectance": {"image": image, "basis": basis}}))
    np.testing.assert_allclose(
        shown, xyz(scene({"kind": "diffuse", "reflectance": "ColorChecker/red"})), rtol=1e-4
    )


@pytest.mark.parametrize("technique", ["path", "phong"])
def test_a_map_of_flat_normals_changes_nothing_and_a_tilted_one_tilts(technique):
    flat = np.full((4, 4, 3), (0.5, 0.5, 1.0), np.float32)
    paint = {"kind": "diffuse", "reflectance": 0.5}
    plain = xyz(scene(paint), technique, depth=2)
    np.testing.assert_allclose(
        xyz(scene(paint | {"normal_map": {"image": flat}}), technique, depth=2), plain, rtol=1e-5
    )
    # u runs along x: a normal towards the sun, whose light comes from (1, 2, 1).
    n = np.array([1.0, -1.0, 2.0]) / 6**0.5  # along u, along v = −z, up
    tilted = np.full((4, 4, 3), (n + 1) / 2, np.float32)
    lit = scene(paint | {"normal_map": {"image": tilted}})
    lit = lit.replace(lights={"sky": None})
    dark = scene(paint).replace(lights={"sky": None})
    ratio = (
        xyz(lit, technique, depth=2, ambient=0.0)[8:16, 8:16, 1]
        / xyz(dark, technique, depth=2, ambient=0.0)[8:16, 8:16, 1]
    )
    np.testing.assert_allclose(ratio, 6**0.5 / 2, rtol=1e-3)


def test_heights_tilt_as_a_slope_of_the_same_height_does():
    # One metre up over the two metres of the square along u.
    ramp = np.repeat(np.linspace(0, 1, 128, dtype=np.float32)[None, :, None], 2, axis=0).repeat(3, axis=2)
    paint = {"kind": "diffuse", "reflectance": 0.5}
    made = scene(paint | {"bump": {"image": ramp, "height": 1.0, "wrap": "clamp"}}, field_of_view=10)
    flat = scene(paint, field_of_view=10)
    ratio = [
        xyz(one.replace(lights={"sky": None}), "phong", ambient=0.0)[8:16, 8:16, 1] for one in (made, flat)
    ]
    slope = 1.0 / 2.0 * 128 / 127
    n = np.array([-slope, 1.0, 0.0]) / np.hypot(slope, 1.0)
    sun = np.array([1, 2, 1]) / 6**0.5
    np.testing.assert_allclose(ratio[0] / ratio[1], n @ sun / sun[1], rtol=1e-3)


def test_the_seed_and_the_threads_do_not_matter_to_a_bit():
    ramp = np.random.default_rng(1).random((16, 16, 3)).astype(np.float32)
    made = scene(
        {"kind": "conductor", "metal": "copper", "roughness": {"image": ramp, "black": 0.1, "white": 0.4}},
        {"sphere": {"center": [0, 0, 0], "radius": 0.5}},
    )
    one = xyz(made, threads=1)
    np.testing.assert_array_equal(one, xyz(made, threads=2))


@pytest.mark.parametrize(
    ("material", "message"),
    [
        ({"kind": "diffuse", "reflectance": {"image": "none.png"}}, "there is no such file"),
        ({"kind": "diffuse", "reflectance": {"image": 3}}, "must be the name of a file"),
        (
            {"kind": "diffuse", "reflectance": {"image": "x", "wrap": "round"}},
            '"repeat", "clamp" or "mirror"',
        ),
        (
            {"kind": "conductor", "metal": "gold", "roughness": "rough"},
            "must be a number from 0 to 1, or an image",
        ),
        ({"kind": "conductor", "metal": "gold", "roughness": {"image": np.full((2, 2, 3), 2.0)}}, "0 to 1"),
        (
            {"kind": "diffuse", "reflectance": 0.5, "normal_map": {"image": np.zeros((2, 2, 3))}},
            "no map of normals",
        ),
        ({"kind": "diffuse", "reflectance": {"image": np.full((2, 2), np.nan)}}, "finite"),
        (
            {"kind": "diffuse", "reflectance": {"image": np.ones((2, 2, 3)), "basis": [0.9, 0.5, 0.1]}},
            "reflect 1.500 of the light",
        ),
        (
            {
                "kind": "diffuse",
                "reflectance": 0.5,
                "bump": {"image": np.ones((2, 2)), "height": 1.0},
                "normal_map": {"image": np.ones((2, 2, 3))},
            },
            "is given twice",
        ),
    ],
)
def test_mistakes_are_named(material, message):
    with pytest.raises(SceneError, match=message):
        scene(material)


def test_a_mesh_without_coordinates_is_refused():
    mesh = {"mesh": {"positions": np.eye(3), "faces": [[0, 1, 2]]}}
    with pytest.raises(SceneError, match="no texture coordinates"):
        scene({"kind": "diffuse", "reflectance": {"image": np.full((2, 2, 3), 0.5)}}, mesh)


def test_colours_beyond_the_gamut_are_clipped_and_said():
    image = np.zeros((2, 2, 3), np.float32)
    image[..., 1] = 1.0
    made = scene({"kind": "diffuse", "reflectance": {"image": image, "rgb_system": "Rec.2020"}})
    assert any("clipped" in sentence for sentence in made.warnings)


def test_a_scene_keeps_its_images(tmp_path):
    image = np.random.default_rng(2).random((4, 4, 3)).astype(np.float32)
    made = scene({"kind": "diffuse", "reflectance": {"image": image}})
    made.save(tmp_path / "scene.npz")
    again = Scene.load(tmp_path / "scene.npz")
    assert again.hash() == made.hash()
    np.testing.assert_array_equal(xyz(made), xyz(again))
    plain = made.replace(materials={"one": {"kind": "diffuse", "reflectance": 0.5}})
    assert not any(name.startswith("image:") for name in plain.arrays)
    np.testing.assert_array_equal(xyz(plain), xyz(scene({"kind": "diffuse", "reflectance": 0.5})))
