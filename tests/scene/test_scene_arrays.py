"""Arrays of a written scene that cannot be those of one."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from illuminant.errors import DataError, SceneError
from illuminant.scene import Scene

Arrays = dict[str, Any]


@pytest.fixture(scope="module")
def cornell() -> Scene:
    return Scene.load(Path(__file__).parents[2] / "scenes/cornell.toml")


def test_a_scene_that_was_written_is_read(cornell: Scene) -> None:
    assert Scene.from_bytes(cornell.to_bytes()).hash() == cornell.hash()


CHANGES: dict[str, Callable[[Arrays], Arrays]] = {
    "no-placements": lambda a: without(a, "placements"),
    "no-transform": lambda a: without(a, "placement:0"),
    "no-vertices": lambda a: without(a, "shape:0:positions"),
    "no-such-shape": lambda a: {"placements": a["placements"] + np.uint32(99)},
    "shapes-in-floats": lambda a: {"placements": a["placements"].astype(float)},
    "single-precision": lambda a: {"placement:0": a["placement:0"].astype(np.float32)},
    "three-columns": lambda a: {"placement:0": a["placement:0"][:, :, :3]},
    "signed-indices": lambda a: {"shape:0:indices": a["shape:0:indices"].astype(np.int64)},
    "mesh-and-sphere": lambda a: {"shape:0:sphere": np.ones(4)},
    "coordinates-alone": lambda a: {"shape:99:uvs": np.ones((4, 2), np.float32)},
    "no-number": lambda a: {"shape:x:sphere": np.ones(4)},
    "flat-image": lambda a: {"image:a": np.ones((4, 4), np.float32)},
    "unknown": lambda a: {"secret": np.ones(4)},
}


def without(arrays: Arrays, name: str) -> Arrays:
    del arrays[name]
    return {}


@pytest.mark.parametrize("change", CHANGES)
def test_arrays_that_cannot_be_are_refused(cornell: Scene, change: str) -> None:
    arrays = dict(cornell.arrays)
    arrays |= CHANGES[change](arrays)
    wrong = Scene(cornell.description, arrays, frame=cornell.frame).to_bytes()
    with pytest.raises(DataError, match="is not a scene written by this version"):
        Scene.from_bytes(wrong)


def test_indices_beyond_the_vertices_are_refused_by_the_core(cornell: Scene) -> None:
    arrays = dict(cornell.arrays)
    arrays["shape:0:indices"] = arrays["shape:0:indices"] + np.uint32(1000)
    with pytest.raises(SceneError, match="names a corner beyond"):
        Scene.from_bytes(Scene(cornell.description, arrays, frame=cornell.frame).to_bytes()).core()


def test_a_written_scene_names_no_files(cornell: Scene, tmp_path: Path) -> None:
    (tmp_path / "secret.csv").write_text("400 0.5\n700 0.5\n")
    frame = {
        **cornell.frame,
        "spectra": {"a": {"file": str(tmp_path / "secret.csv")}, "b": {"constant": 0.5}},
    }
    written = Scene(cornell.description, cornell.arrays, frame=frame).to_bytes()
    read = Scene.from_bytes(written)
    name = read.description["materials"][0]["name"]
    assert read.replace(materials={name: {"kind": "diffuse", "reflectance": "b"}})
    with pytest.raises(SceneError, match="its own"):
        read.replace(materials={name: {"kind": "diffuse", "reflectance": "its own"}})
