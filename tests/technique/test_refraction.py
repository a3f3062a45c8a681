"""Refraction by geometrical optics: Snell's law at every wavelength, the critical angle, a slab's shift."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

import illuminant
from illuminant import spectra
from illuminant.scene import Scene

LAMP = {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 1000.0}


def rectangle(material, corner, *edges):
    return {
        "rectangle": {"corner": list(corner), "edges": [list(edge) for edge in edges]},
        "material": material,
    }


def one_ray_a_pixel(scene, **options):
    options = {
        "technique": "raytrace",
        "sampling": "uniform:8",
        "samples": 1,
        "filter": ("box", 1e-6),
    } | options
    return np.asarray(illuminant.render(scene, ambient=0.0, threshold=0.0, **options).xyz, float)[..., 1]


def angles(size, field_of_view):
    """Of the middles of pixels from the axis, degrees, from the left."""
    half = np.tan(np.radians(field_of_view / 2))
    return np.degrees(np.arctan(half * (2 * (np.arange(size) + 0.5) / size - 1)))


@pytest.mark.parametrize("n", [1.1, 1.2, 1.33])
def test_total_reflection_begins_at_the_critical_angle(n):
    """A ray through the top of a block meets its side at sin i = 1/n, to the pixel of 0.001°."""
    size, view = 400, 0.4
    top = np.degrees(
        np.arcsin(np.sqrt(n**2 - 1))
    )  # where sin²θ = n² − 1 the ray inside meets the side at arcsin 1/n
    slope = np.array([np.sin(np.radians(top)), -np.cos(np.radians(top)), 0.0])
    target = np.array([0.6, 0.0, 0.0])
    scene = Scene.build(
        # Columns run along the angle: to the right rays fall flatter.
        camera={
            "eye": list(target - 10 * slope),
            "target": list(target),
            "up": [0, 0, 1],
            "size": [size, 3],
            "field_of_view": view,
        },
        objects={
            "block": {"box": {"min": [-9, -30, -1], "max": [1, 0, 1]}, "material": "glass"},
            "lamp": rectangle("lamp", [1.001, -40, 50], [500, 0, 0], [0, 0, -100]),
        },
        materials={"glass": {"kind": "dielectric", "n": n, "dispersion": False}, "lamp": LAMP},
    )
    row = one_ray_a_pixel(scene, depth=3)[1]
    seen = np.flatnonzero(row > 0)
    # On one side of the critical angle light passes, on the other none at all.
    assert 0.3 * size < len(seen) < 0.7 * size
    assert np.array_equal(seen, np.arange(seen[0], seen[0] + len(seen)))
    edges = [seen[0] - 0.5, seen[-1] + 0.5]
    found = min((np.interp(edge, np.arange(size), angles(size, view)) for edge in edges), key=abs)
    assert abs(found) < 1.5 * view / size


@pytest.mark.parametrize("thickness", [0.05, 0.2, 0.8])
@pytest.mark.parametrize("technique", ["raytrace", "path"])
def test_a_slab_shifts_what_is_behind_it(technique, thickness):
    """s = t sin θ (1 − cos θ / √(n² − sin²θ)), for the ray that sees the edge of a lamp through the slab."""
    n, tilt, size, view = 1.6, np.radians(40.0), 1600, 8.0
    normal = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    side = np.array([np.cos(tilt), 0.0, -np.sin(tilt)])
    corner = np.array([0, -4, 3.0]) - 4 * side
    faces = [
        rectangle("glass", corner + shift * normal, *edges)
        for shift, edges in (
            (0.5 * thickness, (8 * side, [0, 8, 0])),
            (-0.5 * thickness, ([0, 8, 0], 8 * side)),
        )
    ]

    def edge(objects):
        scene = Scene.build(
            camera={"eye": [0, 0, 10], "target": [0, 0, 0], "size": [size, 3], "field_of_view": view},
            objects={"lamp": rectangle("lamp", [0, -5, 0], [9, 0, 0], [0, 10, 0])} | objects,
            materials={"glass": {"kind": "dielectric", "n": n, "dispersion": False}, "lamp": LAMP},
        )
        options = {"technique": technique, "depth": 3} | ({"samples": 64} if technique == "path" else {})
        row = one_ray_a_pixel(scene, **options)[1]
        return np.flatnonzero(row > 0.3 * row.max())[0]

    plain, shifted = edge({}), edge({"front": faces[0], "back": faces[1]})
    assert abs(plain - size / 2) <= 1
    slope = np.tan(np.radians(angles(size, view)[shifted]))
    ray = np.array([slope, 0.0, -1.0]) / np.hypot(slope, 1.0)
    cosine = abs(ray @ normal)
    sine = np.sqrt(1 - cosine**2)
    shift = thickness * sine * (1 - cosine / np.sqrt(n**2 - sine**2))
    # Without the slab the ray would meet the plane of the lamp beside the edge.
    expected = shift / abs(ray[2])
    assert abs(10 * slope) == pytest.approx(expected, abs=1.5 * 20 * np.tan(np.radians(view / 2)) / size)


def test_a_prism_disperses_by_snell_at_every_wavelength(scenes):
    """A distant line of light through 60° of BK7: where it is seen at each wavelength, and that there is no gap."""
    eye, view, columns = np.array([-0.661, 0.0, 1.888]), 3.2, 600
    forward = -eye / np.linalg.norm(eye)
    right = np.cross(forward, [0, 1, 0])
    index = spectra.load("BK7.n")

    def leaves(angle, n):
        """The direction in which a ray leaves the prism that enters at an angle from the axis of the camera."""
        ray = np.cos(angle) * forward + np.sin(angle) * right
        for normal, ratio in (([0.5, 0, np.sqrt(0.75)], 1 / n), ([-0.5, 0, np.sqrt(0.75)], n)):
            cosine = -ray @ np.array(normal)
            ray = ratio * ray + (ratio * cosine - np.sqrt(1 - ratio**2 * (1 - cosine**2))) * np.array(normal)
        return ray

    middle = leaves(0.0, float(index.at(550.0)))
    # So far away that it does not matter where in the prism light leaves.
    distance = 1e5
    across = np.cross([0, 1, 0], middle)
    width = 2 * distance * np.tan(np.radians(0.004))
    line = distance * middle - 0.5 * width * across - np.array([0, 4000, 0])
    tables = tomllib.loads((scenes / "prism.toml").read_text())
    scene = Scene.build(
        camera={"eye": list(eye), "target": [0, 0, 0], "size": [columns, 2], "field_of_view": view},
        objects={
            "prism": tables["objects"]["prism"],
            "line": rectangle("lamp", line, [0, 8000, 0], width * across),
        },
        materials={"glass": tables["materials"]["glass"], "lamp": LAMP},
    )
    image = illuminant.render(
        scene, sampling="uniform:32", samples=4096, depth=3, keep_spectra=True, filter=("box", 0.5)
    )
    seen = np.asarray(image.layers["spectra"], float).mean(axis=0)
    place = np.radians(angles(columns, view))
    for lane, nm in enumerate(image.wavelengths_nm):
        if not 420 <= nm <= 700:
            continue
        n = float(index.at(nm))
        off = np.array([np.cross(leaves(angle, n), middle)[1] for angle in place])
        expected = np.degrees(
            np.interp(0.0, *((off, place) if off[-1] > off[0] else (off[::-1], place[::-1])))
        )
        found = np.degrees(np.sum(seen[:, lane] * place) / np.sum(seen[:, lane]))
        assert found == pytest.approx(expected, abs=0.01), nm
    # Few paths meet so narrow a line: by six columns, 0.03°.
    rainbow = seen.sum(axis=1).reshape(-1, 6).sum(axis=1)
    lit = np.flatnonzero(rainbow > 0.02 * rainbow.max())
    assert np.all(rainbow[lit[0] : lit[-1]] > 0)
