"""The scenes that ship: each loads without a mistake or a warning, and holds what it says."""

import gzip

import numpy as np
import pytest

from illuminant import spectra
from illuminant.core import core
from illuminant.scene import Scene

NAMES = [
    "bunny",
    "colorchecker-a",
    "colorchecker-d65",
    "colorchecker-fl11",
    "copper-spheres",
    "copper-spheres-mapped",
    "cornell",
    "cornell-fl11",
    "crystal-ball",
    "demo",
    "environment",
    "finishes",
    "glass-and-copper",
    "metamers",
    "morning",
    "prism",
    "reading-room",
    "tiles",
    "turntable",
    "two-filters",
    "whitted",
]


@pytest.mark.parametrize("name", NAMES)
def test_it_loads(name, scenes):
    scene = Scene.load(scenes / f"{name}.toml")
    assert scene.title
    assert not scene.warnings
    assert Scene.from_bytes(scene.to_bytes()).hash() == scene.hash()


def test_no_scene_is_forgotten(scenes):
    assert sorted(path.stem for path in scenes.glob("*.toml")) == NAMES


def test_the_starter_scene_loads(repository):
    assert Scene.load(repository / "python" / "illuminant" / "data" / "starter.toml").title


def test_files_are_small(scenes):
    for path in scenes.rglob("*"):
        assert not path.is_file() or path.stat().st_size < 1_000_000, path


def test_the_demo_is_large_enough_and_smooth_lit(scenes):
    scene = Scene.load(scenes / "demo.toml")
    width, height = scene.description["camera"]["size"]
    assert width >= 960
    assert height >= 540
    kinds = {material["surface"]["kind"] for material in scene.description["materials"]}
    assert kinds == {"diffuse", "conductor", "dielectric"}


def test_the_cornell_box_is_the_published_one(scenes):
    scene = Scene.load(scenes / "cornell.toml")
    lamp = [thing["name"] for thing in scene.description["objects"]].index("lamp")
    corners = scene.shapes()[scene.placements()[lamp][0]]["positions"] * 1000
    assert np.allclose(np.sort(corners[:, 0]), [213, 213, 343, 343])
    assert np.allclose(corners[:, 1], 548.8)
    assert np.allclose(np.sort(corners[:, 2]), [227, 227, 332, 332])
    assert np.isclose(scene.description["camera"]["field_of_view_deg"], 2 * np.degrees(np.arctan(12.5 / 35)))
    assert scene.triangles == 38


@pytest.mark.parametrize(("word", "lamp"), [("d65", "D65"), ("a", "A"), ("fl11", "FL11")])
def test_the_colorcheckers_differ_in_the_lamp_only(word, lamp, scenes):
    scene = Scene.load(scenes / f"colorchecker-{word}.toml")
    assert len(scene.description["objects"]) == 25
    light = {"kind": "directional", "direction": [0, 0, -1], "illuminance_lx": 1000 * np.pi}
    same = scene.replace(lights={"lamp": light | {"spectrum": "D65"}})
    assert same.hash() == Scene.load(scenes / "colorchecker-d65.toml").hash()
    assert scene.description["curves"][scene.description["lights"][0]["spectrum"]]["name"] == lamp


def test_the_metamers_match_under_d65_and_not_under_a(scenes):
    grid = np.arange(380.0, 781.0)
    pair = [spectra.read(scenes / "spectra" / f"metamer_{letter}.csv") for letter in "ab"]

    def delta_e(lamp):
        light = spectra.load(lamp).at(grid)
        white = core().xyz(grid, light, "zero")
        lab = [core().xyz_to_lab(core().xyz(grid, one.at(grid) * light, "zero"), white) for one in pair]
        return float(core().delta_e_2000(*lab))

    assert delta_e("D65") < 0.1
    assert delta_e("A") > 5.0


def test_the_bunny_says_where_it_comes_from(scenes):
    header = gzip.decompress((scenes / "meshes" / "bunny.ply.gz").read_bytes())[:600].decode(errors="replace")
    assert "Stanford 3D Scanning Repository" in header
    assert "Public Domain" in header
