"""Samples that are no radiance: dropped, counted, reported with where they went wrong, and followed again.

A lamp of 10³⁸ W/(sr m² nm) overflows single precision once its light becomes XYZ.
"""

import json

import numpy as np
import pytest

import illuminant
from illuminant.rendering import replay
from illuminant.scene import Scene

SAMPLES = 4


def blinding(scale, size=8) -> Scene:
    """Left half of the view: a lamp far too bright; right half: a grey wall that sees the sky and not the lamp."""
    return Scene.build(
        camera={"eye": [0, 0, 1], "target": [0, 0, 0], "size": [size, size], "field_of_view": 50},
        objects={
            "monster": {
                "material": "too bright",
                "rectangle": {"corner": [-1, -1, 0], "edges": [[1, 0, 0], [0, 2, 0]]},
            },
            "wall": {
                "material": "grey",
                "rectangle": {"corner": [0, -1, 0], "edges": [[1, 0, 0], [0, 2, 0]]},
            },
        },
        materials={
            "too bright": {"kind": "emitter", "spectrum": 1.0, "radiance_scale": scale},
            "grey": {"kind": "diffuse", "reflectance": 0.5},
        },
        lights={"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 100}},
    )


OPTIONS = {"depth": 2, "filter": "box", "sampling": "uniform:8"}


@pytest.fixture(scope="module")
def image():
    return illuminant.render(blinding(1e38), samples=SAMPLES, layers="samples", keep_spectra=True, **OPTIONS)


def test_the_render_ends_normally_and_the_rest_of_the_image_is_right(image):
    """What is dropped leaves no trace in the sums: the wall is as with a decent lamp."""
    assert np.isfinite(image.xyz).all()
    assert all(np.isfinite(layer).all() for layer in image.layers.values())
    decent = illuminant.render(blinding(1.0), samples=SAMPLES, **OPTIONS)
    assert np.array_equal(image.xyz[:, 4:], decent.xyz[:, 4:])
    assert (image.xyz[:, :4] == 0).all()
    assert (image.xyz[:, 4:, 1] > 0).all()


def test_dropped_samples_are_counted(image):
    assert image.statistics["dropped"] == 8 * 4 * SAMPLES
    assert image.statistics["samples"] == 8 * 8 * SAMPLES
    assert (image.layers["samples"][:, :4] == 0).all()
    assert (image.layers["samples"][:, 4:] == SAMPLES).all()
    assert image.settings["dropped"] == 8 * 4 * SAMPLES


def test_dropped_samples_are_reported_with_their_place(image):
    """Pixel, sample, object and material; each one once, and all of them if they are few."""
    reports = image.statistics["dropped_samples"]
    assert 0 < len(reports) <= image.statistics["dropped"]
    for report in reports:
        (x, y), sample = report["pixel"], report["sample"]
        assert 0 <= x < 4 and 0 <= y < 8 and 0 <= sample < SAMPLES
        assert report["object"] == "monster"
        assert report["material"] == "too bright"
    assert len({(*report["pixel"], report["sample"]) for report in reports}) == len(reports)


@pytest.mark.parametrize("technique", ["constant", "gouraud", "phong"])
def test_scanline_techniques_name_what_is_seen_where_a_sample_was_dropped(technique):
    options = OPTIONS | {"technique": technique, "illumination": "bouknight"}
    statistics = illuminant.render(blinding(3e38), samples=SAMPLES, **options).statistics
    assert statistics["dropped"] == 8 * 4 * SAMPLES
    assert statistics["dropped_samples"]
    for report in statistics["dropped_samples"]:
        assert (report["object"], report["material"]) == ("monster", "too bright")
        assert report["pixel"][0] < 4


def test_a_dropped_sample_can_be_followed_again(image):
    """The very path: it meets the lamp, and brings what was dropped."""
    report = image.statistics["dropped_samples"][0]
    path = replay(blinding(1e38), tuple(report["pixel"]), report["sample"], **OPTIONS)
    assert [vertex["object"] for vertex in path["passes"][0]] == ["monster"]
    assert not np.isfinite(path["xyz"]).all()


def test_a_sample_followed_again_is_the_one_in_the_film():
    """One sample a pixel: its XYZ is the image, bit by bit (the film holds multiples of 2⁻⁴⁸)."""
    scene = blinding(1.0)
    image = illuminant.render(scene, samples=1, **OPTIONS)
    for x, y in [(1, 2), (4, 0), (7, 5)]:
        path = replay(scene, (x, y), 0, **OPTIONS)
        assert np.allclose(path["xyz"], image.xyz[y, x], rtol=1e-7, atol=0)
    later = illuminant.render(scene, samples=3, **OPTIONS)
    mean = np.mean([replay(scene, (6, 3), k, **OPTIONS)["xyz"] for k in range(3)], axis=0)
    assert np.allclose(mean, later.xyz[3, 6], rtol=1e-7, atol=0)


def test_the_object_at_fault_may_be_far_along_the_path(core_render):
    """A wall of reflectance 1 near the lamp is seen; the lamp itself is not, and is to blame."""
    scene = Scene.build(
        camera={"eye": [0, 0.5, 1], "target": [0, 0.5, 0], "size": [4, 4], "field_of_view": 20},
        objects={
            "wall": {
                "material": "grey",
                "rectangle": {"corner": [-1, 0, 0], "edges": [[2, 0, 0], [0, 1, 0]]},
            },
            "monster": {
                "material": "too bright",
                "rectangle": {"corner": [-1, 0.2, 1.5], "edges": [[0, 0.8, 0], [2, 0, 0]]},
            },
        },
        materials={
            "too bright": {"kind": "emitter", "spectrum": 1.0, "radiance_scale": 3e38},
            "grey": {"kind": "diffuse", "reflectance": 0.5},
        },
    )
    render = core_render(scene, depth=2, sampling="uniform:4")
    assert render.run(0, 2)
    statistics = render.statistics()
    assert statistics["dropped"] == 4 * 4 * 2
    assert {report["object"] for report in statistics["dropped_samples"]} <= {"wall", "monster"}


@pytest.mark.parametrize("scale", [1e12, 1e16, 1e22, 1e30])
def test_a_sample_is_either_in_the_sum_or_dropped(scale):
    """However bright: the mean of equal samples is that sample, or nothing; never cut off, never turned negative."""
    result = illuminant.render(blinding(scale), samples=64, **OPTIONS)
    lamp = result.xyz[:, :4, 1]
    # 683 Σ ȳ = 683 · 106.857 lm/W nm
    kept = np.isclose(lamp, 683.0 * 106.857 * scale, rtol=1e-3).all()
    dropped = result.statistics["dropped"] == 8 * 4 * 64 and (lamp == 0).all()
    assert kept or dropped, f"{lamp.min():g} to {lamp.max():g}, {result.statistics['dropped']} dropped"


SCENE_FILE = """
[camera]
eye = [0, 0, 1]
target = [0, 0, 0]
size = [2, 2]
field_of_view = 60
[materials.lamp]
kind = "emitter"
spectrum = 1.0
radiance_scale = 1e38
[objects.monster]
material = "lamp"
rectangle = { corner = [-9, -9, 0], edges = [[WIDTH, 0, 0], [0, 18, 0]] }
[lights.sky]
kind = "environment"
spectrum = "E"
luminance_cd_m2 = 1
"""


def test_the_command_follows_a_dropped_path_again(command, tmp_path):
    """`--pixel x,y --sample k` prints the vertices, and the value that is no radiance."""
    file = tmp_path / "scene.toml"
    file.write_text(SCENE_FILE.replace("WIDTH", "9"))
    output = tmp_path / "image.exr"
    options = ("--samples", "2", "--filter", "box", "--sampling", "uniform:8")
    rendered = command("render", file, "-o", output, "--json", *options)
    assert rendered.returncode == 0, rendered.stderr
    assert json.loads(rendered.stdout)["dropped"] == 4
    assert output.exists()
    again = command("render", file, "--pixel", "0,1", "--sample", "1", *options)
    assert again.returncode == 0, again.stderr
    assert "monster" in again.stdout
    assert "inf" in again.stdout.lower()


def test_an_image_of_which_every_sample_was_dropped_is_black(command, tmp_path):
    """It is no interruption: the command ends well, says what was dropped, and the image is there."""
    file = tmp_path / "scene.toml"
    file.write_text(SCENE_FILE.replace("WIDTH", "18"))
    output = tmp_path / "image.exr"
    rendered = command("render", file, "-o", output, "--samples", "2", "--sampling", "uniform:8", "--json")
    assert rendered.returncode == 0, rendered.stderr
    assert json.loads(rendered.stdout)["dropped"] == 8
    assert output.exists()


def test_a_lane_that_the_film_cannot_hold_is_dropped_though_its_xyz_is_nothing(core_render):
    """In the infrared ȳ is all but zero: the spectra overflow where XYZ does not."""
    scene = Scene.build(
        range_nm=[800, 1200],
        camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [4, 4], "field_of_view": 20},
        objects={"ball": {"material": "grey", "sphere": {"center": [0, 0, 0], "radius": 1}}},
        materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
        lights={"sky": {"kind": "environment", "spectrum": 1.0, "radiance_scale": 1e15}},
    )
    for layers, dropped in [([], 0), (["spectra"], 4 * 4 * 2)]:
        render = core_render(scene, sampling="uniform:4", layers=layers)
        assert render.run(0, 2)
        assert render.statistics()["dropped"] == dropped
