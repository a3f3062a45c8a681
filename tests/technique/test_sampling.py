"""Spectral samplings in renders: the two filters of the book, the reported error against images, and a prism."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import illuminant
from illuminant import spectra
from illuminant.colorimetry import matching_functions
from illuminant.difference import diff
from illuminant.job import Job
from illuminant.scene import Scene


def small(scene, longest):
    """The scene with an image no longer than so many pixels."""
    size = scene.description["camera"]["size"]
    return scene.replace(camera={"size": [max(1, round(side * longest / max(size))) for side in size]})


# --- two filters over a white base (book figures 3.12 and 3.13) ---


@pytest.fixture(scope="module")
def overlap(scenes):
    """Renders the two filters: Y where they overlap beside that of the base, and the chroma there."""
    scene = small(Scene.load(scenes / "two-filters.toml"), 96)

    def rendered(sampling):
        image = illuminant.render(scene, samples=16, sampling=sampling)
        height, width = image.xyz.shape[:2]
        both = image.xyz[height * 38 // 100 : height * 60 // 100, width * 43 // 100 : width * 58 // 100]
        base = image.xyz[height * 85 // 100 :, width // 3 : width * 2 // 3]
        x, y, z = (both / base.mean(axis=(0, 1))).mean(axis=(0, 1))
        return y, max(x, y, z) - min(x, y, z)

    return rendered


@pytest.mark.parametrize("sampling", ["1nm", "hall:9", "hall:9:global", "fitted:8", "fitted:16"])
def test_where_two_filters_overlap_a_spectral_sampling_is_black(overlap, sampling):
    luminance, chroma = overlap(sampling)
    assert luminance < 1e-3
    assert chroma < 1e-3


@pytest.mark.parametrize("sampling", ["rgb", "rgb:white", "rgb:area", "xyz"])
def test_where_two_filters_overlap_colours_multiplied_show_colour(overlap, sampling):
    luminance, chroma = overlap(sampling)
    assert luminance > 2e-3
    assert chroma > 2e-3


def test_four_samples_of_meyer_miss_cut_offs(overlap):
    """What lies between two wavelengths is not seen: here each filter passes two of the four, so black is black."""
    assert overlap("meyer")[0] < 1e-3


# --- the error that is reported ---

SCENES = [
    "bunny.toml",
    "colorchecker-a.toml",
    "colorchecker-d65.toml",
    "colorchecker-fl11.toml",
    "copper-spheres-mapped.toml",
    "copper-spheres.toml",
    "cornell-fl11.toml",
    "cornell.toml",
    "crystal-ball.toml",
    "demo.toml",
    "environment.toml",
    "finishes.toml",
    "glass-and-copper.toml",
    "metamers.toml",
    "morning.toml",
    "prism.toml",
    "reading-room.toml",
    "tiles.toml",
    "turntable.toml",
    "two-filters.toml",
    "whitted.toml",
]


def test_all_scenes_are_judged(scenes):
    assert sorted(path.name for path in scenes.glob("*.toml")) == SCENES


COARSE = {"elements": 200, "form_factors": "rays:64", "light_samples": 8}
"""For the room that is solved for before it is seen: its wavelengths err alike however finely it is cut, and 1 nm
solves for it many times over."""


def without_dispersion(scene):
    """The same scene with every index that of 589.3 nm: dispersed light has noise of its own, which is no error."""
    tables = tomllib.loads(Path(scene.path).read_text())["materials"]
    glass = {name: table for name, table in tables.items() if table["kind"] == "dielectric"}
    return scene.replace(materials={name: table | {"dispersion": False} for name, table in glass.items()})


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("sampling", ["fitted:8", "fitted:4"])
def test_the_reported_error_is_that_of_the_image(scenes, name, sampling):
    """Mean ΔE00 between a render and the same paths at 1 nm; both below 0.002 are nothing to compare."""
    scene = without_dispersion(Scene.load(scenes / name))
    scene = small(scene, 64)
    reported = Job(scene, sampling=sampling, **COARSE).spectral_error()["mean"]
    reference = illuminant.render(scene, samples=4, sampling="1nm", **COARSE)
    found = diff(reference, illuminant.render(scene, samples=4, sampling=sampling, **COARSE)).mean
    assert max(found, reported) < 0.002 or 0.5 < found / reported < 2.0


def test_another_lamp_has_another_error(scenes):
    scene = Scene.load(scenes / "colorchecker-d65.toml")
    day = Job(scene, sampling="uniform:16").spectral_error()
    lines = Job(Scene.load(scenes / "colorchecker-fl11.toml"), sampling="uniform:16").spectral_error()
    assert lines["mean"] > 5 * day["mean"] > 0
    assert lines["lamp"] == "lamp" and isinstance(lines["material"], str)
    assert 0 < day["mean"] <= day["p95"] <= day["max"]


def test_the_reference_has_no_error(scenes):
    error = Job(small(Scene.load(scenes / "cornell.toml"), 32), sampling="1nm").spectral_error()
    assert (error["mean"], error["max"]) == (0.0, 0.0)


def test_the_wavelengths_depend_on_the_scene_alone(scenes):
    """Not on seed, threads or crop: parts of an image are rendered with the wavelengths of the whole."""
    scene = small(Scene.load(scenes / "cornell.toml"), 64)
    part = scene.replace(camera={"crop": [8, 8, 24, 16]})
    jobs = [Job(scene), Job(scene, seed=7, threads=1), Job(part)]
    first, *others = [job.core_render.wavelengths().tolist() for job in jobs]
    assert all(other == first for other in others)
    assert len(first) == 8


@pytest.mark.parametrize("sampling", ["fitted:8", "hall:9", "uniform:8", "1nm"])
@pytest.mark.parametrize("lit", [False, True], ids=["alone", "beside daylight"])
def test_a_lamp_that_nobody_sees_is_rendered_and_said(sampling, lit):
    """Infrared light alone is black at 1 nm; a coarser sampling draws lines from it into the visible."""
    infrared = {"wavelengths_nm": [840.0, 900.0, 950.0], "values": [0.0, 1.0, 0.0], "outside": "zero"}
    lights = {"heat": {"kind": "environment", "spectrum": infrared, "radiance_scale": 1.0}}
    if lit:
        lights["day"] = {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0}
    scene = Scene.build(
        camera={"eye": [0, 1, 3], "target": [0, 0, 0], "size": [16, 12]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": "paint"}},
        materials={"paint": {"kind": "diffuse", "reflectance": "ColorChecker/red"}},
        lights=lights,
        range_nm=[380, 1000],
    )
    job = Job(scene, samples=4, sampling=sampling)
    assert any("the observer sees nothing" in text for text in job.warnings()) is not lit
    error = job.spectral_error()
    assert (error["judged"] > 0) == (lit and sampling != "1nm")
    luminance = illuminant.render(scene, samples=4, sampling=sampling).xyz[..., 1]
    assert np.isfinite(luminance).all()
    if lit:
        assert luminance.max() > 50
    elif sampling == "1nm":
        assert not luminance.any()


@pytest.mark.parametrize("name", ["metamers.toml", "colorchecker-fl11.toml"])
def test_kept_spectra_and_their_matrix_are_the_image(scenes, name):
    """Also with two lamps of different spectra, whose light is kept together."""
    image = illuminant.render(small(Scene.load(scenes / name), 48), samples=4, keep_spectra=True)
    again = np.einsum("hwn,cn->hwc", image.layers["spectra"], image.to_xyz)
    assert again == pytest.approx(image.xyz, rel=1e-5, abs=1e-5 * image.xyz.max())


# --- a prism ---


def through_the_prism(scene, n, offsets):
    """Whether the camera sees the strip along rays at fractions of the width, and what the two faces let through.

    Snell's law in the plane of the camera; Fresnel's equations for unpolarised light. `n` has shape (401,), `offsets`
    (columns,); the result has shape (401, columns).
    """
    camera = scene.description["camera"]
    eye, target = (np.asarray(camera[key], float)[[0, 2]] for key in ("eye", "target"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.array([-forward[1], forward[0]])
    half = np.tan(np.radians(camera["field_of_view_deg"]) / 2)
    direction = forward[None, :] + (2 * offsets[:, None] - 1) * half * right[None, :]
    direction = np.broadcast_to(
        direction / np.linalg.norm(direction, axis=1, keepdims=True), (len(n), len(offsets), 2)
    )
    origin = np.broadcast_to(eye, direction.shape)
    apex, left, back = np.array([[0.2887, 0.0], [-0.1443, 0.25], [-0.1443, -0.25]])
    kept = 1.0
    for a, b, ratio in [(apex, left, 1 / n), (back, apex, n)]:
        along = (b - a) / np.linalg.norm(b - a)
        normal = np.array([along[1], -along[0]])
        distance = ((a - origin) @ normal) / (direction @ normal)
        origin = origin + distance[..., None] * direction
        cos_i = direction @ normal
        normal = normal * np.sign(cos_i)[..., None]
        cos_i = np.abs(cos_i)
        sin2 = ratio[:, None] ** 2 * (1 - cos_i**2)
        cos_t = np.sqrt(1 - sin2)
        eta = 1 / ratio[:, None]
        s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
        p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
        kept = kept * (1 - 0.5 * (s**2 + p**2))
        direction = ratio[:, None, None] * direction + (cos_t - ratio[:, None] * cos_i)[..., None] * normal
    corner, edge = np.array([-0.9957, -2.8301]), np.array([0.00944, -0.0033])
    normal = np.array([edge[1], -edge[0]])
    distance = ((corner - origin) @ normal) / (direction @ normal)
    place = (origin + distance[..., None] * direction - corner) @ edge / (edge @ edge)
    return np.where((place >= 0) & (place <= 1), kept, 0.0)


@pytest.mark.parametrize("sampling", ["fitted:8", "uniform:4"])
def test_a_prism_shows_a_continuous_spectrum(scenes, sampling):
    """X, Y and Z along it agree with 401 wavelengths traced by Snell's law, within 2 % of their largest."""
    columns, rows = 96, 24
    scene = small(Scene.load(scenes / "prism.toml"), columns)
    image = illuminant.render(scene, samples=4096, sampling=sampling, depth=3, filter="box")
    assert image.xyz.shape == (rows, columns, 3)
    found = image.xyz.mean(axis=0)
    nm = np.arange(380.0, 781.0)
    matching = np.stack([curve.at(nm) for curve in matching_functions()])
    lamp = spectra.load("D65").at(nm)
    lamp = lamp * 1000.0 / (683.0 * (matching[1] @ lamp))
    n = spectra.load("BK7.n").at(nm)
    inside = (np.arange(columns * 16) + 0.5) / (columns * 16)
    seen = through_the_prism(scene, n, inside).reshape(401, columns, 16).mean(axis=2)
    exact = 683.0 * np.einsum("cw,w,wx->xc", matching, lamp, seen)
    assert (exact[:, 1] > 0.05 * exact[:, 1].max()).sum() > 10
    off = np.abs(found - exact) / exact.max(axis=0)
    assert off.max() < 0.02
