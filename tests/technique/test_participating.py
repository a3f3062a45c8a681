"""Participating media in `path`, against closed forms."""

from __future__ import annotations

import logging

import numpy as np
import pytest

import illuminant
from illuminant.errors import SceneError
from illuminant.scene import Scene

COLOURED = {"wavelengths_nm": [380.0, 780.0], "values": [1.6, 0.2]}
"""An extinction that falls by eight over the spectrum, 1/m."""


def coloured(nm):
    return np.interp(nm, COLOURED["wavelengths_nm"], COLOURED["values"])


def slab(medium, lights, *, thickness=2.0, size=(8, 8), wall=None):
    """A slab of a medium before the camera, 10 m wide, with a wall behind it if one is wanted."""
    box = {"min": [-5, -5, -thickness], "max": [5, 5, 0]}
    # Something must be in a scene: far behind the camera.
    objects = {
        "speck": {"sphere": {"center": [0, 0, 50], "radius": 0.001}, "material": "black"},
    }
    if wall:
        objects["wall"] = {
            "rectangle": {"corner": [-9, -9, -thickness - 1], "edges": [[18, 0, 0], [0, 18, 0]]},
            "material": wall,
        }
    return Scene.build(
        camera={"eye": [0, 0, 1], "target": [0, 0, -1], "size": list(size), "field_of_view": 1.0},
        objects=objects,
        materials={
            "black": {"kind": "diffuse", "reflectance": 0.0},
            "lamp": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 100.0},
        },
        lights=lights,
        medium={key: value for key, value in ({"box": box} | medium).items() if value is not None},
    )


SKY = {"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 100.0}}


def lanes(scene, **options):
    """Wavelengths and the mean of each lane."""
    options = {"technique": "path", "sampling": "uniform:8", "samples": 4096} | options
    image = illuminant.render(scene, keep_spectra=True, **options)
    return image.wavelengths_nm, np.asarray(image.layers["spectra"], float).mean(axis=(0, 1))


@pytest.mark.parametrize("phase", [{}, {"mean_cosine": 0.7}, {"phase": "rayleigh"}])
@pytest.mark.parametrize("density", [False, True])
def test_what_only_scatters_is_invisible_in_a_uniform_field(phase, density):
    """Albedo 1 under the same radiance from everywhere (within 0.5 %), for every wavelength by itself."""
    medium = {"scattering": COLOURED} | phase
    if density:
        medium["density"] = np.random.default_rng(3).uniform(0, 1, (3, 2, 4))
    _nm, seen = lanes(slab(medium, SKY), samples=2048)
    _, empty = lanes(slab({"scattering": 0.0}, SKY), samples=1)
    np.testing.assert_allclose(seen / empty, 1.0, atol=5e-3)


def test_transmission_of_a_slab_is_beers_law():
    """Within 0.5 %, with coefficients that depend on wavelength; the slab only absorbs."""
    nm, seen = lanes(slab({"absorption": COLOURED}, SKY), samples=4096)
    _, empty = lanes(slab({"absorption": 0.0}, SKY), samples=1)
    np.testing.assert_allclose(seen / empty, np.exp(-2.0 * coloured(nm)), rtol=5e-3)


def test_transmission_through_a_density_that_varies():
    """The optical depth is the integral along the ray: two cells, linear between their centres."""
    cells = np.zeros((1, 1, 2))
    cells[0, 0] = [1.0, 3.0]
    _nm, seen = lanes(slab({"absorption": 0.4, "density": cells}, SKY), samples=8192)
    _, empty = lanes(slab({"absorption": 0.0}, SKY), samples=1)
    # Along the middle the mean of 1 over a quarter, 1 to 3 over a half, and 3 over a quarter is 2.
    np.testing.assert_allclose(seen / empty, np.exp(-2.0 * 0.4 * 2.0), rtol=1e-2)


def test_a_density_thicker_than_any_cloud_is_seen_in_moments():
    """Millions of mean free paths, which only scatter: what falls in comes out again near where it fell in."""
    cells = np.random.default_rng(5).uniform(0, 1, (3, 2, 4))
    options = {"samples": 4, "sampling": "uniform:8", "depth": 8}
    thick = slab({"scattering": 1e6, "density": cells}, SKY, size=(64, 64))
    _nm, seen = lanes(thick, **options)
    _, empty = lanes(slab({"scattering": 0.0}, SKY), samples=1)
    # Of a semi-infinite slab with isotropic scattering about half has come out after 8 segments, in every lane alike.
    assert np.ptp(seen / empty) < 1e-5
    assert 0.4 < np.mean(seen / empty) < 0.9


def test_a_wall_behind_the_slab_is_dimmed():
    scene = slab({"absorption": 0.5}, {}, wall="lamp")
    clear = slab({"absorption": 0.0}, {}, wall="lamp")
    _, seen = lanes(scene)
    _, empty = lanes(clear, samples=1)
    np.testing.assert_allclose(seen / empty, np.exp(-1.0), rtol=5e-3)


@pytest.mark.parametrize(
    ("phase", "value"),
    [
        ({}, 1 / (4 * np.pi)),
        ({"mean_cosine": 0.5}, (1 - 0.25) / (4 * np.pi * (1 + 0.25 + 2 * 0.5 * 0.6) ** 1.5)),
        ({"phase": "rayleigh"}, 3 / (16 * np.pi) * (1 + 0.36)),
    ],
)
def test_single_scattering_of_a_slab(phase, value):
    """Parallel light that falls in by θ: L = σ_s p E ∫ exp(−σ_t (1 + 1/cos θ) z) dz, within 0.5 % in every lane."""
    sun = {"kind": "directional", "direction": [0.8, 0.0, -0.6], "spectrum": "E", "illuminance_lx": 100.0}
    medium = {"scattering": COLOURED, "absorption": 0.3} | phase
    nm, seen = lanes(slab(medium, {"sun": sun}), depth=2, samples=8192)
    # It is scattered back: the cosine between where it goes and where it came from is −0.6.
    extinction = coloured(nm) + 0.3
    slant = 1 + 1 / 0.6
    integral = (1 - np.exp(-extinction * slant * 2.0)) / (extinction * slant)
    # E at normal incidence in a lane: a white diffuser that faces the sun shows E/π.
    facing = Scene.build(
        camera={"eye": [0, 0, 1], "target": [0, 0, -1], "size": [2, 2], "field_of_view": 1.0},
        objects={
            "wall": {
                "rectangle": {"corner": [-1, -1, 0], "edges": [[2, 0, 0], [0, 2, 0]]},
                "material": "white",
            }
        },
        materials={"white": {"kind": "diffuse", "reflectance": 1.0}},
        lights={"sun": sun | {"direction": [0, 0, -1]}},
    )
    _, white = lanes(facing, samples=1, depth=2)
    np.testing.assert_allclose(seen, coloured(nm) * value * white * np.pi * integral, rtol=5e-3)


def test_glass_keeps_the_medium_out():
    """Fog around a ball of glass: no light is scattered in it."""

    def scene(medium):
        return Scene.build(
            camera={"eye": [0, 0, 4], "target": [0, 0, 0], "size": [4, 4], "field_of_view": 1.0},
            objects={"ball": {"sphere": {"center": [0, 0, 0], "radius": 1.9}, "material": "glass"}},
            materials={"glass": {"kind": "dielectric", "n": 1.0}},
            lights=SKY,
            medium=medium,
        )

    _, seen = lanes(scene({"absorption": 0.5, "box": {"min": [-2, -2, -2], "max": [2, 2, 2]}}))
    _, empty = lanes(scene({"absorption": 0.0}), samples=1)
    np.testing.assert_allclose(seen / empty, np.exp(-0.5 * 0.2), rtol=5e-3)


def test_the_sky_is_blue_because_air_scatters_it():
    """Rayleigh's λ⁻⁴ over a path of air: bluer than the sun, and the sun behind it redder."""
    nm = np.linspace(380.0, 780.0, 41)
    air = {"wavelengths_nm": nm.tolist(), "values": (0.2 * (550.0 / nm) ** 4).tolist()}
    sun = {"kind": "directional", "direction": [0.8, 0.0, -0.6], "spectrum": "D65", "illuminance_lx": 1e5}
    image = illuminant.render(
        slab({"scattering": air, "phase": "rayleigh"}, {"sun": sun}), sampling="fitted:8", samples=64
    )
    x, y, z = np.asarray(image.xyz, float).mean(axis=(0, 1))
    assert x / (x + y + z) < 0.27
    assert y / (x + y + z) < 0.28


def test_other_techniques_say_that_they_do_not_see_it(caplog):
    scene = slab({"scattering": 0.5}, SKY, wall="lamp")
    with caplog.at_level(logging.WARNING):
        illuminant.render(scene, technique="raytrace", sampling="uniform:8", samples=1)
    assert "does not see what is in the air" in caplog.text


@pytest.mark.parametrize(
    ("medium", "message"),
    [
        ({"mean_cosine": 1.0}, "mean_cosine"),
        ({"phase": "rayleigh", "mean_cosine": 0.2}, "belongs to the phase henyey-greenberg"),
        ({"density": np.ones((2, 2, 2))}, "density fills it"),
        ({"density": np.ones((2, 2))}, "three axes"),
        ({"density": -np.ones((2, 2, 2))}, "not negative"),
        ({"density": "nothing.npy"}, "no such file"),
        ({"density": np.ones((1, 10_001, 1))}, "at most 10,000 cells"),
        ({"box": {"min": [0, 0, 0], "max": [1, 0, 1]}}, "max above min"),
        ({"scatter": 1.0}, "not a key"),
    ],
)
def test_mistakes_are_named(medium, message):
    if message == "density fills it":
        medium = medium | {"box": None}
    with pytest.raises(SceneError, match=message):
        slab({"scattering": 0.5} | medium, SKY)
