"""What is no number never reaches an output image unnoticed.

Data of a scene that would make NaN or infinity are refused with a sentence that names them, or the samples that meet
them are dropped, counted, and attributed to object and material. What the caller puts into an image himself is saved as
it is in an EXR, where the file says so, and black in a PNG.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import illuminant
from illuminant.errors import Error
from illuminant.image import Image
from illuminant.scene import Scene

OPTIONS: dict[str, Any] = {"samples": 2, "depth": 4, "sampling": "uniform:8", "threads": 1}
BAD = (math.nan, math.inf, -math.inf)


def tables(**changed: Any) -> dict[str, Any]:
    """A room of a wall, a metal ball and a lamp, with parts of it replaced."""
    found: dict[str, Any] = {
        "camera": {"eye": [0, 0, 3], "target": [0, 0, 0], "size": [8, 8], "field_of_view": 60},
        "materials": {
            "paint": {"kind": "diffuse", "reflectance": 0.5},
            "metal": {"kind": "conductor", "metal": "copper", "roughness": 0.2},
            "glow": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 1000.0},
        },
        "objects": {
            "wall": {
                "material": "paint",
                "rectangle": {"corner": [-2, -2, -1], "edges": [[4, 0, 0], [0, 4, 0]]},
            },
            "ball": {"material": "metal", "sphere": {"radius": 0.5}},
            "lamp": {
                "material": "glow",
                "rectangle": {"corner": [-1, 1.5, 0], "edges": [[2, 0, 0], [0, 0, 1]]},
            },
        },
    }
    for path, value in changed.items():
        *parents, last = path.split("__")
        place = found
        for parent in parents:
            place = place.setdefault(parent, {})
        place[last] = value
    return found


def rendered(scene: Scene, **options: Any) -> Image:
    """An image in which every number is one, or is counted with its place."""
    image = illuminant.render(scene, **{**OPTIONS, **options})
    for name, layer in {"xyz": image.xyz, **image.layers}.items():
        assert np.isfinite(layer).all(), name
    dropped = image.statistics["dropped"]
    assert image.settings["dropped"] == dropped
    if dropped:
        reports = image.statistics["dropped_samples"]
        assert reports
        known = set(scene_names(scene)) | {None, ""}
        for report in reports:
            assert {"pixel", "sample", "object", "material"} <= set(report)
            assert report["object"] in known
    return image


def scene_names(scene: Scene) -> list[str]:
    return [thing["name"] for thing in scene.description["objects"]]


def refused_or_counted(**changed: Any) -> str:
    """`refused`, `dropped` or `clean`."""
    try:
        scene = Scene.build(**tables(**changed))
        image = rendered(scene)
    except Error as error:
        assert str(error).strip()
        return "refused"
    return "dropped" if image.statistics["dropped"] else "clean"


@pytest.mark.parametrize("value", BAD)
@pytest.mark.parametrize(
    "place",
    [
        "materials__paint__reflectance", "materials__metal__roughness", "materials__glow__luminance_cd_m2",
        "objects__ball__sphere__radius", "camera__field_of_view", "objects__wall__scale",
    ],
)  # fmt: skip
def test_a_number_that_is_none_is_refused(place: str, value: float) -> None:
    assert refused_or_counted(**{place: value}) == "refused"


@pytest.mark.parametrize("value", BAD)
@pytest.mark.parametrize(
    "part",
    [
        "positions",
        "normals",
        "uvs",
        "camera",
        "spectrum",
        "image",
        "texture",
        "transform",
        "density",
        "direction",
    ],
)
def test_arrays_with_numbers_that_are_none_are_refused(part: str, value: float) -> None:
    mesh: dict[str, Any] = {
        "positions": np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]),
        "faces": np.array([[0, 1, 2]]),
        "normals": np.array([[0.0, 0, 1]] * 3),
        "uvs": np.array([[0.0, 0], [1, 0], [0, 1]]),
    }
    changed: dict[str, Any] = {"objects__mesh": {"material": "paint", "mesh": mesh}}
    pixels = np.full((4, 8, 3), 0.5)
    pixels[1, 2, 0] = value
    match part:
        case "positions" | "normals" | "uvs":
            mesh[part][1, 0] = value
        case "camera":
            changed["camera__eye"] = [0, value, 3]
        case "spectrum":
            changed["materials__paint__reflectance"] = {"wavelengths_nm": [400, 700], "values": [0.5, value]}
        case "image":
            changed["lights"] = {"sky": {"kind": "environment", "image": pixels, "luminance_cd_m2": 100.0}}
        case "texture":
            changed["materials__paint__reflectance"] = {"image": pixels}
        case "transform":
            changed["objects__ball__translate"] = [0, value, 0]
        case "density":
            cells = np.ones((2, 2, 2))
            cells[0, 1, 0] = value
            changed["medium"] = {
                "scattering": 0.1,
                "density": cells,
                "box": {"min": [-1, -1, -1], "max": [1, 1, 1]},
            }
        case "direction":
            changed["lights"] = {"far": {"kind": "directional", "direction": [0, value, -1], "spectrum": "D65",
                                         "illuminance_lx": 100.0}}  # fmt: skip
    assert refused_or_counted(**changed) == "refused"


@pytest.mark.parametrize(
    "changed",
    [
        {"materials__metal__roughness": 1e-300},
        {"materials__metal__roughness": 1e-3},
        {"materials__metal__roughness": 1e30},
        {"materials__metal__roughness": 0.5, "materials__metal__distribution": "ggx"},
        {"objects__ball__sphere": {"radius": 1e-30}},
        {"objects__ball__sphere": {"radius": 1e30}},
        {"objects__ball__translate": [0, 0, 1e30]},
        {"camera__field_of_view": 1e-30},
        {"camera__field_of_view": 179.999999},
        {"camera__eye": [0, 0, 1e30]},
        {"materials__glow__luminance_cd_m2": 1e-300},
        {"materials__glow__luminance_cd_m2": 1e-40},
        {"materials__glow__luminance_cd_m2": 1e38},
        {"materials__glow__luminance_cd_m2": 1e300},
        {"objects__lamp__rectangle": {"corner": [0, 1, 0], "edges": [[0, 0, 0], [0, 0, 1]]}},
        {"objects__lamp__rectangle": {"corner": [0, 1, 0], "edges": [[1e-20, 0, 0], [0, 0, 1e-20]]}},
        {"objects__lamp__rectangle": {"corner": [-1e15, 1, 0], "edges": [[2e15, 0, 0], [0, 0, 2e15]]}},
        {"objects__wall__mesh": {"positions": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "faces": [[0, 1, 2]]},
         "objects__wall__rectangle": None},
        {"medium": {"scattering": 1e30}},
        {"medium": {"absorption": 1e300}},
        {"atmosphere": {"kind": "distance", "power": 300.0, "unit": 1e9}},
        {"atmosphere": {"kind": "fog", "start": 0, "end": 1e-30, "spectrum": "D65", "luminance_cd_m2": 1e38}},
        {"lights": {"p": {"kind": "point", "position": [0, 0, 1], "spectrum": "D65", "intensity_cd": 1e38}}},
        {"lights": {"p": {"kind": "point", "position": [0, 0, 0.5], "spectrum": "A", "intensity_cd": 1.0}}},
        {"lights": {"e": {"kind": "environment", "image": np.full((2, 4, 3), 3e38), "luminance_cd_m2": 1e30}}},
        {"materials__metal": {"kind": "conductor", "n": 1e-30, "k": 1e30}},
        {"materials__metal": {"kind": "dielectric", "n": 1e30}},
        {"materials__metal": {"kind": "dielectric", "n": 1.5, "absorption": 1e30}},
        {"materials__metal": {"kind": "coated", "n": 1.0, "pigment": 1.0, "absorption": 1e30, "thickness": 1e30}},
    ],
    ids=lambda changed: ",".join(changed) + " " + json.dumps(changed, default=lambda _: "array")[-60:],
)  # fmt: skip
@pytest.mark.parametrize("technique", ["path", "raytrace"])
def test_absurd_scenes_are_refused_or_counted_and_the_image_is_finite(
    changed: dict[str, Any], technique: str
) -> None:
    try:
        scene = Scene.build(**tables(**changed))
        rendered(scene, technique=technique)
    except Error as error:
        assert str(error).strip()


def test_an_exr_environment_of_infinities_is_refused_by_name(tmp_path: Path) -> None:
    pixels = np.ones((4, 8, 3))
    pixels[2, 3] = np.inf
    Image(pixels, unit="relative").save(tmp_path / "sky.exr", rgb="sRGB")
    with pytest.raises(
        Error, match=r"sky\.exr.*1 pixels with a value that is not a finite number, first at \(3, 2\)"
    ):
        Scene.build(
            **tables(lights={"sky": {"kind": "environment", "image": "sky.exr", "luminance_cd_m2": 1.0}}),
            directory=tmp_path,
        )


@pytest.mark.parametrize("value", BAD)
def test_a_png_of_numbers_that_are_none_is_black_there_and_nothing_else_changes(
    value: float, tmp_path: Path
) -> None:
    xyz = np.full((4, 4, 3), 50.0)
    whole = Image(xyz.copy()).shown(exposure=0.01).picture.codes
    xyz[1, 2] = value
    codes = Image(xyz).shown(exposure=0.01).picture.codes
    different = (codes != whole).any(axis=2)
    assert different[1, 2] and different.sum() == 1
    assert Image(xyz).save(tmp_path / "a.png", exposure=0.01).path.exists()


def test_an_exr_keeps_what_the_caller_put_into_it_and_it_is_read_back_as_such(tmp_path: Path) -> None:
    xyz = np.ones((2, 2, 3))
    xyz[0, 1] = (np.nan, np.inf, -np.inf)
    Image(xyz).save(tmp_path / "a.exr")
    found = Image.open(tmp_path / "a.exr").xyz
    assert np.isnan(found[0, 1, 0]) and found[0, 1, 1] == np.inf and np.isfinite(found[1]).all()


@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_numbers_that_are_none_are_counted_when_an_image_is_saved(tmp_path, caplog, name):
    xyz = np.ones((4, 5, 3))
    xyz[1, 2, 0] = xyz[3, 4] = np.nan
    illuminant.Image(xyz, layers={"depth": np.full((4, 5, 1), np.inf)}).save(tmp_path / name, exposure=0.5)
    assert [record.getMessage() for record in caplog.records] == [
        f"{tmp_path / name}: the colour of 2 pixels is no number (NaN)."
    ]
