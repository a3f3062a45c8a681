"""The clear sky and the sun: the published model, and the light that it brings to a scene."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import illuminant
from illuminant import colorimetry
from illuminant.errors import DataError, SceneError
from illuminant.scene import Scene
from illuminant.sky import SUN_RADIUS, sky_radiance, sun_radiance

GOLDEN = json.loads((Path(__file__).parents[1] / "golden" / "sky.json").read_text())
NM = np.arange(380.0, 781.0)
LUMINOUS = 683.002 * np.asarray(colorimetry.matching_functions()[1].at(NM))
"""lm/W at every nm."""


def outside(sky, objects=None, **camera):
    return Scene.build(
        camera={"eye": [0, 1, 0], "target": [0, 1.5, -1], "size": [8, 8], "field_of_view": 30.0} | camera,
        objects=objects or BEHIND,
        materials={
            "chalk": {"kind": "diffuse", "reflectance": 0.5},
            "black": {"kind": "diffuse", "reflectance": 0.0},
        },
        lights={"sky": {"kind": "sky", "elevation_deg": 40.0, "azimuth_deg": 70.0} | sky},
    )


BEHIND = {"ball": {"sphere": {"center": [0, 0, 99], "radius": 0.1}, "material": "black"}}


def luminance(scene, **options):
    options = {"sampling": "fitted:8", "filter": ("box", 0.5)} | options
    return np.asarray(illuminant.render(scene, **options).xyz, float)[..., 1]


FLOOR = {
    "floor": {"rectangle": {"corner": [-9, 0, 9], "edges": [[18, 0, 0], [0, 0, -18]]}, "material": "chalk"}
}
DOWN = {"eye": [0, 3, 0], "target": [0, 0, 0], "up": [0, 0, -1]}


def towards_sun(elevation_deg, azimuth_deg):
    elevation, azimuth = np.radians([elevation_deg, azimuth_deg])
    return np.array(
        [np.cos(elevation) * np.sin(azimuth), np.sin(elevation), -np.cos(elevation) * np.cos(azimuth)]
    )


def test_the_sky_is_the_published_model():
    elevation, turbidity, albedo, theta, gamma, nm, expected = np.array(GOLDEN["sky"]).T
    found = sky_radiance(
        np.radians(theta),
        np.radians(gamma),
        nm,
        elevation=np.radians(elevation),
        turbidity=turbidity,
        ground_albedo=albedo,
    )
    np.testing.assert_allclose(found, expected, rtol=2e-5)


def test_the_sun_is_the_published_model():
    elevation, turbidity, gamma, nm, expected = np.array(GOLDEN["sun"]).T
    found = sun_radiance(np.radians(elevation), np.radians(gamma), nm, turbidity=turbidity)
    # Their disc is wider; radiance there is scaled and its limb lies further out.
    middle = gamma == 0.0
    np.testing.assert_allclose(found[middle], expected[middle] * (0.51 / 0.5358) ** 2, rtol=2e-3)
    np.testing.assert_allclose(found, expected * (0.51 / 0.5358) ** 2, rtol=2e-2)


@pytest.mark.parametrize("technique", ["path", "raytrace", "phong"])
def test_the_camera_sees_the_model(technique):
    """Luminance in every direction of an image, and nothing below the horizon."""
    scene = outside({"sun": False, "turbidity": 4.0, "ground_albedo": 0.5}, target=[0.3, 1.3, -1])
    found = luminance(scene, technique=technique, samples=64)
    from_eye = np.array([0.3, 0.3, -1.0]) / np.linalg.norm([0.3, 0.3, -1.0])
    right = np.cross(from_eye, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, from_eye)
    half = np.tan(np.radians(15.0))
    place = half * (np.arange(8) + 0.5 - 4.0) / 4.0
    way = from_eye + place[None, :, None] * right - place[:, None, None] * up
    way /= np.linalg.norm(way, axis=2, keepdims=True)
    gamma = np.arccos(way @ towards_sun(40.0, 70.0))
    spectra = sky_radiance(
        np.arccos(way[..., 1])[..., None],
        gamma[..., None],
        NM,
        elevation=np.radians(40.0),
        turbidity=4.0,
        ground_albedo=0.5,
    )
    # Just above the horizon the sky changes within a pixel.
    np.testing.assert_allclose(found[:7], (spectra @ LUMINOUS)[:7], rtol=1e-2)
    below = luminance(outside({}, target=[0, 0.5, -1]), technique=technique, samples=4)
    assert not below.any()


def test_illuminance_of_a_floor_under_the_open_sky():
    """The integral of the model over the hemisphere, and what the disc of the sun adds."""
    scene = outside({"sun": False}, FLOOR, **DOWN)
    found = luminance(scene, samples=256, depth=2).mean() * np.pi / 0.5
    n = 400
    z = (np.arange(n) + 0.5) / n
    phi = 2 * np.pi * (np.arange(n) + 0.5) / n
    sine = np.sqrt(1 - z**2)[:, None]
    way = np.stack([sine * np.cos(phi), np.broadcast_to(z[:, None], (n, n)), sine * np.sin(phi)], axis=2)
    gamma = np.arccos(np.clip(way @ towards_sun(40.0, 70.0), -1, 1))
    nm = np.arange(380.0, 781.0, 10.0)
    radiance = np.stack(
        [sky_radiance(np.arccos(z)[:, None], gamma, one, elevation=np.radians(40.0)) for one in nm], axis=2
    )
    irradiance = (radiance * z[:, None, None]).mean(axis=(0, 1)) * 2 * np.pi
    expected = 10.0 * irradiance @ np.interp(nm, NM, LUMINOUS)
    assert found == pytest.approx(expected, rel=1e-2)

    with_sun = luminance(outside({}, FLOOR, **DOWN), samples=256, depth=2).mean() * np.pi / 0.5
    rings = SUN_RADIUS * np.sqrt((np.arange(50) + 0.5) / 50)
    disc = sun_radiance(np.radians(40.0), rings[:, None], NM).mean(axis=0) @ LUMINOUS
    direct = disc * np.pi * SUN_RADIUS**2 * np.sin(np.radians(40.0))
    assert with_sun - found == pytest.approx(direct, rel=1e-2)
    # As measured on clear days: about 60 to 80 klx, a sixth of it from the sky.
    assert 50_000 < with_sun < 90_000
    assert 0.1 < found / with_sun < 0.35


@pytest.mark.parametrize("technique", ["distributed", "path"])
def test_the_penumbra_of_the_sun_is_as_wide_as_its_disc(technique):
    """An edge 2 m above the floor, with the sun in the zenith: a ramp of 2 · 2 m · tan 0.255°."""
    roof = {"rectangle": {"corner": [-9, 2, 9], "edges": [[9, 0, 0], [0, 0, -18]]}, "material": "black"}
    scene = Scene.build(
        camera={
            "eye": [0, 1, 0],
            "target": [0, 0, 0],
            "up": [0, 0, -1],
            "size": [48, 4],
            "field_of_view": 3.0,
        },
        objects=FLOOR | {"roof": roof},
        materials={
            "chalk": {"kind": "diffuse", "reflectance": 0.5},
            "black": {"kind": "diffuse", "reflectance": 0.0},
        },
        lights={"sky": {"kind": "sky", "elevation_deg": 90.0}},
    )
    options = {"technique": technique, "samples": 1024, "sampling": "uniform:8", "depth": 2, "ambient": 0.0}
    image = illuminant.render(scene, filter=("box", 0.5), lamps=True, **options)
    found = np.asarray(image.layers["lamp:sky sun"], float)[..., 1].mean(axis=0)
    level = found / found[40:].mean()
    x = np.tan(np.radians(1.5)) * (np.arange(48) + 0.5 - 24) / 24
    # The square of the distance from the middle of the ramp, by its derivative.
    density = np.where(np.abs(x) < 0.012, np.gradient(level, x), 0.0)
    middle = np.sum(density * x) / np.sum(density)
    spread = np.sqrt(np.sum(density * (x - middle) ** 2) / np.sum(density))
    # Of an even disc seen along one axis r/2; as its limb is dark, for path <r²>/2 over what it sends.
    part = 1.0 / 4.0
    if technique == "path":
        ring = (np.arange(1000) + 0.5) / 1000
        weight = ring * sun_radiance(np.pi / 2, ring * SUN_RADIUS, 555.0)
        part = np.sum(weight * ring**2) / np.sum(weight) / 2.0
    assert spread == pytest.approx(2.0 * np.tan(SUN_RADIUS) * np.sqrt(part), rel=0.05)
    assert abs(middle) < 0.1 * 2.0 * SUN_RADIUS


def test_spectra_hardly_matter():
    scene = outside({"elevation_deg": 5.0}, FLOOR, **DOWN)
    exact, fitted = (
        np.asarray(illuminant.render(scene, sampling=sampling, samples=16).xyz, float).mean(axis=(0, 1))
        for sampling in ("1nm", "fitted:8")
    )
    np.testing.assert_allclose(fitted, exact, rtol=5e-3)


def test_layers_tell_the_sun_from_the_sky():
    image = illuminant.render(outside({}, FLOOR, **DOWN), samples=16, lamps=True)
    assert {"lamp:sky", "lamp:sky sun"} <= set(image.layers)
    both = image.layers["lamp:sky"] + image.layers["lamp:sky sun"]
    np.testing.assert_allclose(both, image.xyz, rtol=1e-4)


@pytest.mark.parametrize(
    ("sky", "message"),
    [
        ({"turbidity": 0.5}, "turbidity"),
        ({"elevation_deg": -3.0}, "elevation_deg"),
        ({"ground_albedo": 1.5}, "ground_albedo"),
        ({"spectrum": "D65"}, "spectrum"),
        ({"elevation": 3.0}, "elevation_deg"),
    ],
)
def test_mistakes_are_named(sky, message):
    with pytest.raises(SceneError, match=message):
        outside(sky)


def test_angles_out_of_range_are_refused():
    with pytest.raises(DataError, match="elevation"):
        sky_radiance(0.5, 0.5, 550.0, elevation=-0.1)
    assert sun_radiance(0.5, 1.01 * SUN_RADIUS, 550.0) == 0.0
