"""Translucent sheets, which scatter light on both sides, against closed forms."""

from __future__ import annotations

import re

import numpy as np
import pytest

import illuminant
from illuminant import scene_file
from illuminant.errors import SceneError
from illuminant.scene import Scene

PAPER = {
    "kind": "translucent",
    "reflectance": {"wavelengths_nm": [380.0, 780.0], "values": [0.2, 0.7]},
    "transmittance": {"wavelengths_nm": [380.0, 780.0], "values": [0.6, 0.1]},
}

WHITE = PAPER | {"transmittance": {"wavelengths_nm": [380.0, 780.0], "values": [0.8, 0.3]}}
"""Nothing is absorbed: R + T = 1."""

LAMP = {"kind": "point", "spectrum": "E", "power_w": 4 * np.pi * 401}
"""A lamp of 1 W/(sr nm): its power is that of 401 nm in all directions."""

SKY = {"sky": {"kind": "environment", "spectrum": 1.0, "radiance_scale": 1.0}}
SHEET = {"rectangle": {"corner": [-2, -2, 0], "edges": [[4, 0, 0], [0, 4, 0]]}, "material": "paper"}
BALL = {"sphere": {"radius": 1.0}, "material": "paper"}


def scene(paper, lights, *, sheet=SHEET, eye=2.0, field_of_view=1.0, **more):
    """A sheet in the plane z = 0, seen from the z axis."""
    return Scene.build(
        camera={
            "eye": [0, 0, eye],
            "target": [0, 0, 0],
            "size": [8, 8],
            "field_of_view": field_of_view,
        },
        objects={"sheet": sheet} | more.pop("objects", {}),
        materials={"paper": paper} | more.pop("materials", {}),
        lights=lights,
        **more,
    )


def lanes(made, **options):
    """Wavelengths, and the mean radiance in each lane."""
    options = {"technique": "path", "samples": 16, "sampling": "uniform:8"} | options
    image = illuminant.render(made, keep_spectra=True, **options)
    return image.wavelengths_nm, np.asarray(image.layers["spectra"], float).mean(axis=(0, 1))


def share(paper, key, nm):
    return np.interp(nm, paper[key]["wavelengths_nm"], paper[key]["values"])


@pytest.mark.parametrize("sheet", [SHEET, BALL], ids=["sheet", "sphere"])
def test_what_absorbs_nothing_is_invisible_in_a_uniform_field(sheet):
    """E = π L on both sides, so a sheet shows (R + T) L = L; in a closed one the field is L too."""
    _, found = lanes(scene(WHITE, SKY, sheet=sheet, field_of_view=20.0, eye=3.0), samples=4096)
    np.testing.assert_allclose(found, 1.0, rtol=3e-3)


@pytest.mark.parametrize("technique", ["raytrace", "distributed"])
def test_ambient_light_comes_from_both_sides(technique):
    nm, found = lanes(scene(PAPER, SKY), technique=technique)
    wanted = share(PAPER, "reflectance", nm) + share(PAPER, "transmittance", nm)
    np.testing.assert_allclose(found, wanted, rtol=1e-4)


@pytest.mark.parametrize("eye", [2.0, -2.0], ids=["front", "back"])
@pytest.mark.parametrize(("key", "side"), [("reflectance", 1.0), ("transmittance", -1.0)])
@pytest.mark.parametrize("technique", ["path", "raytrace", "distributed", "phong"])
def test_a_lamp_on_either_side(technique, key, side, eye):
    """L = R/π · I/d² on the side of the lamp, T/π · I/d² on the other."""
    distance = 0.7
    lamp = LAMP | {"position": [0, 0, np.sign(eye) * side * distance]}
    ambient = {} if technique == "path" else {"ambient": 0.0}
    nm, found = lanes(scene(PAPER, {"lamp": lamp}, eye=eye), technique=technique, **ambient)
    np.testing.assert_allclose(found, share(PAPER, key, nm) / np.pi / distance**2, rtol=2e-3)


@pytest.mark.parametrize("technique", ["path", "raytrace", "distributed"])
def test_what_stands_before_the_lamp_shades_the_sheet(technique):
    card = {
        "rectangle": {"corner": [-0.1, -0.1, -0.3], "edges": [[0.2, 0, 0], [0, 0.2, 0]]},
        "material": "card",
    }
    made = scene(
        PAPER,
        {"lamp": LAMP | {"position": [0, 0, -0.7]}},
        objects={"card": card},
        materials={"card": {"kind": "diffuse", "reflectance": 0.0}},
    )
    ambient = {} if technique == "path" else {"ambient": 0.0}
    assert lanes(made, technique=technique, **ambient)[1].max() == 0.0


def test_an_opal_globe():
    """A lamp in the middle of a sphere: each point gets E = I/r² + R E, and shows T E/π."""
    made = scene(PAPER, {"lamp": LAMP | {"position": [0, 0, 0]}}, sheet=BALL, eye=4.0)
    nm, found = lanes(made, samples=16384)
    wanted = share(PAPER, "transmittance", nm) / np.pi / (1 - share(PAPER, "reflectance", nm))
    np.testing.assert_allclose(found, wanted, rtol=1e-2)


@pytest.mark.parametrize("technique", ["path", "distributed"])
def test_a_lamp_with_an_area_behind_the_sheet(technique):
    """A disc of radius a at the distance d lights a sheet that faces it with E = π L a²/(a² + d²)."""
    lamp = {"disc": {"center": [0, 0, -0.5], "normal": [0, 0, 1], "radius": 0.5}, "material": "lamp"}
    emitter = {"kind": "emitter", "spectrum": 1.0, "radiance_scale": 1.0}
    made = scene(PAPER, {}, objects={"lamp": lamp}, materials={"lamp": emitter})
    options = {} if technique == "path" else {"ambient": 0.0}
    nm, found = lanes(made, technique=technique, samples=1024, depth=2, **options)
    np.testing.assert_allclose(found, share(PAPER, "transmittance", nm) * 0.5, rtol=1e-2)


def test_air_is_on_both_sides():
    """Air that absorbs takes exp(−σ d) of light on its way to the sheet, also from the other side."""
    made = scene(
        PAPER,
        {"lamp": LAMP | {"position": [0, 0, -0.7]}},
        medium={"absorption": 0.8, "scattering": 0.0},
    )
    nm, found = lanes(made, depth=2, samples=4096)
    wanted = share(PAPER, "transmittance", nm) / np.pi / 0.7**2 * np.exp(-0.8 * (2.0 + 0.7))
    np.testing.assert_allclose(found, wanted, rtol=1e-2)


def test_a_sheet_in_a_body_is_in_it_on_both_sides():
    """A body of index 1 that absorbs, with a sheet in its middle."""
    made = scene(
        PAPER,
        {"lamp": LAMP | {"position": [0, 0, -0.7]}},
        objects={"body": {"box": {"min": [-3, -3, -1], "max": [3, 3, 1]}, "material": "body"}},
        materials={"body": {"kind": "dielectric", "n": 1.0, "absorption": 0.8}},
    )
    nm, found = lanes(made, depth=3)
    wanted = share(PAPER, "transmittance", nm) / np.pi / 0.7**2 * np.exp(-0.8 * (1.0 + 0.7))
    np.testing.assert_allclose(found, wanted, rtol=2e-3)


def test_historical_models_see_a_diffuser():
    lamp = {"lamp": LAMP | {"position": [0, 0, 0.7]}}
    plain = {"kind": "diffuse", "reflectance": PAPER["reflectance"]}
    options = {"technique": "raytrace", "illumination": "whitted"}
    np.testing.assert_array_equal(
        lanes(scene(PAPER, lamp), **options)[1], lanes(scene(plain, lamp), **options)[1]
    )


def test_an_image_leaves_room_for_what_is_transmitted():
    """White and black in the image: white reflects what is not transmitted, and both let through alike."""
    image = np.zeros((1, 4, 3), np.float32)
    image[:, :2] = 1.0
    paper = {
        "kind": "translucent",
        "reflectance": {"image": image, "encoding": "linear"},
        "transmittance": 0.4,
    }

    def left_and_right(z):
        made = scene(paper, {"lamp": LAMP | {"position": [0, 0, z]}})
        halves = []
        for x in (-1.0, 1.0):
            there = made.replace(
                camera={"eye": [x, 0, 2], "target": [x, 0, 0], "size": [4, 4], "field_of_view": 0.5}
            )
            halves.append(lanes(there)[1] * np.pi * (1 + z * z) ** 1.5 / abs(z))
        return halves

    left, right = left_and_right(0.7)
    np.testing.assert_allclose(left, 0.6, rtol=5e-3)
    np.testing.assert_allclose(right, 0.0, atol=1e-3)
    for half in left_and_right(-0.7):
        np.testing.assert_allclose(half, 0.4, rtol=5e-3)


def test_the_audit_finds_both_shares_and_no_broken_law():
    (found,) = illuminant.audit(PAPER, angles_deg=[0.0, 60.0], wavelengths_nm=[400.0, 700.0], draws=20_000)
    assert found.passes
    assert found.scattered_reflection == pytest.approx(np.tile([0.225, 0.6], (2, 1)), abs=0.01)
    assert found.scattered_transmission == pytest.approx(np.tile([0.575, 0.2], (2, 1)), abs=0.01)


FILE = """\
[camera]
eye = [0, 0, 2]
target = [0, 0, 0]

[materials.paper]
kind = "translucent"
reflectance = { wavelengths_nm = [400, 600], values = [0.2, 0.7] }
transmittance = 0.4

[objects.sheet]
material = "paper"
rectangle = { corner = [-1, -1, 0], edges = [[2, 0, 0], [0, 2, 0]] }

[lights.sky]
kind = "environment"
spectrum = "E"
luminance_cd_m2 = 100
"""


def test_more_than_all_light_is_refused_with_its_place(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(FILE)
    (problem,) = scene_file.check(path)
    assert str(problem) == (
        f"{path}:8: [materials.paper] transmittance: must not exceed 1 together with reflectance; "
        "at 600 nm they add up to 1.1"
    )
    with pytest.raises(SceneError, match=re.escape("at 600 nm they add up to 1.1")):
        Scene.load(path)
    path.write_text(FILE.replace("transmittance = 0.4", "transmittance = 0.3"))
    assert scene_file.check(path) == []


@pytest.mark.parametrize(
    ("old", "new", "kind", "key"),
    [
        ("transmittance = 0.4", "", "missing-key", "transmittance"),
        ("transmittance = 0.4", "transmittance = 1.4", "spectrum-value", "transmittance"),
        ("transmittance = 0.4", "transmittance = 0.2\nroughness = 0.1", "unknown-key", "roughness"),
    ],
)
def test_mistakes_of_the_table(tmp_path, old, new, kind, key):
    path = tmp_path / "scene.toml"
    path.write_text(FILE.replace(old, new))
    (problem,) = scene_file.check(path)
    assert (problem.kind, problem.table, problem.key) == (kind, "materials.paper", key)
