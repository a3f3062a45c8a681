"""The resolved scene: plain data, its hash, its bytes, and what `replace` changes and keeps."""

import json
import math

import numpy as np
import pytest

from illuminant import spectra
from illuminant.errors import DataError, SceneError
from illuminant.scene import Scene

TRIANGLE = {"positions": np.eye(3), "faces": np.array([[0, 1, 2]])}


def small(**changes) -> Scene:
    parts = {
        "camera": {"eye": [0, 0, 300], "target": [0, 0, 0], "size": [16, 9]},
        "materials": {
            "grey": {"kind": "diffuse", "reflectance": 0.5},
            "lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 800, "reflectance": 0.5},
        },
        "objects": {
            "ball": {"material": "grey", "sphere": {"center": [100, 0, 0], "radius": 50}},
            "left": {"material": "grey", "mesh": TRIANGLE},
            "right": {"material": "lamp", "mesh": TRIANGLE, "translate": [100, 0, 0]},
        },
        "lights": {"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 1000}},
        "length_unit": "cm",
    }
    return Scene.build(**(parts | changes))


def test_the_description_is_in_metres_and_has_what_the_core_reads():
    scene = small()
    description = scene.description
    assert list(description) == [
        "range",
        "curves",
        "materials",
        "skins",
        "objects",
        "lights",
        "camera",
        "atmosphere",
        "medium",
    ]
    assert description["camera"] == {
        "eye": [0.0, 0.0, 3.0],
        "target": [0.0, 0.0, 0.0],
        "up": [0.0, 1.0, 0.0],
        "field_of_view_deg": 40.0,
        "size": [16, 9],
        "crop": None,
        "shutter": [0.0, 1.0],
        "lens": None,
        "end": None,
    }
    assert description["materials"] == [
        {"name": "grey", "surface": {"kind": "diffuse", "reflectance": 0}, "coefficients": [], "priority": 0},
        {"name": "lamp", "surface": {"kind": "diffuse", "reflectance": 0}, "coefficients": [], "priority": 0},
    ]
    assert description["objects"][2]["emission"] == {
        "spectrum": 1,
        "quantity": {"kind": "flux_lm", "value": 800.0},
        "sides": "front",
        "distribution": None,
    }
    assert [curve["name"] for curve in description["curves"]] == ["0.5", "A", "D65"]
    assert description["curves"][0] == {
        "name": "0.5",
        "wavelengths": [380.0, 780.0],
        "values": [0.5, 0.5],
        "outside": "hold",
    }
    assert json.loads(json.dumps(description)) == description


def test_shapes_are_held_once_and_arrays_are_read_only():
    scene = small()
    assert scene.arrays["placements"].tolist() == [0, 1, 1]
    assert scene.arrays["shape:0:sphere"].tolist() == [1.0, 0.0, 0.0, 0.5]
    assert scene.arrays["placement:2"][0, :, 3].tolist() == [1.0, 0.0, 0.0]
    assert scene.triangles == 2
    shapes = scene.shapes()
    assert shapes[0]["kind"] == "sphere"
    assert shapes[1]["normals"] is None
    assert np.allclose(shapes[1]["positions"], 0.01 * np.eye(3))
    with pytest.raises(ValueError, match="read-only"):
        scene.arrays["shape:1:positions"][0, 0] = 1.0


def test_a_mirrored_object_keeps_its_front_outside():
    scene = small(
        objects={
            "left": {"material": "grey", "mesh": TRIANGLE},
            "right": {"material": "lamp", "mesh": TRIANGLE, "scale": [-1, 1, 1]},
        }
    )
    assert scene.arrays["shape:0:indices"].tolist() == [[0, 1, 2]]
    assert scene.arrays["shape:1:indices"].tolist() == [[2, 1, 0]]


# --- hash and bytes ---------------------------------------------------------------------------------------------


def test_equal_scenes_have_equal_hashes_and_any_change_another():
    base = small().hash()
    assert small().hash() == base
    assert len(base) == 64
    camera = {"eye": [0, 0, 300], "target": [0, 0, 0], "size": [16, 9]}
    others = [
        small(camera=camera | {"eye": [0, 0, 301]}),
        small(materials=small_materials(reflectance=0.51)),
        small(lights={}),
        small(length_unit="mm"),
        small(range_nm=(380, 770)),
    ]
    hashes = [scene.hash() for scene in others]
    assert len({base, *hashes}) == len(others) + 1


@pytest.mark.parametrize("range_nm", [(780, 380), (380, 380), (380.5, 780)])
def test_a_range_is_whole_nanometres_that_rise(range_nm):
    with pytest.raises(SceneError, match=r"range_nm.*larger last wavelength in whole nm"):
        small(range_nm=range_nm)


def small_materials(reflectance):
    return {
        "grey": {"kind": "diffuse", "reflectance": reflectance},
        "lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 800, "reflectance": 0.5},
    }


def test_title_render_and_the_way_of_writing_do_not_count():
    lists = {"positions": np.eye(3).tolist(), "faces": [[0, 1, 2]]}
    objects = {
        "ball": {"material": "grey", "sphere": {"center": (100, 0, 0), "radius": np.float64(50)}},
        "left": {"material": "grey", "mesh": lists},
        "right": {"material": "lamp", "mesh": lists, "matrix": [[1, 0, 0, 100], [0, 1, 0, 0], [0, 0, 1, 0]]},
    }
    named = {"grey": {"kind": "diffuse", "reflectance": "half"}, "lamp": small_materials(0.5)["lamp"]}
    same = small(title="other", render={"samples": 4}, objects=objects)
    assert same.hash() == small().hash()
    assert same.render_defaults == {"samples": 4}
    assert small(materials=named, spectra={"half": 0.5}).hash() == small().hash()


def test_bytes_and_back(tmp_path):
    scene = small(spectra={"half": 0.5}, title="a")
    data = scene.to_bytes()
    back = Scene.from_bytes(data)
    assert back.hash() == scene.hash()
    assert back.to_bytes() == data
    assert (back.title, back.frame) == ("a", scene.frame)
    assert back.replace(materials={"grey": {"kind": "diffuse", "reflectance": "half"}}).hash() == scene.hash()
    scene.save(tmp_path / "scene.illuminant")
    assert Scene.load(tmp_path / "scene.illuminant").hash() == scene.hash()


@pytest.mark.parametrize("data", [b"", b"PK\x03\x04 nothing", small().to_bytes()[:-50]])
def test_bytes_that_are_no_scene(data, tmp_path):
    with pytest.raises(DataError, match="is not a scene written by"):
        Scene.from_bytes(data)
    path = tmp_path / "scene.illuminant"
    path.write_bytes(data)
    with pytest.raises(SceneError):
        Scene.load(path)


# --- replace ----------------------------------------------------------------------------------------------------


def test_replacing_the_camera_keeps_all_else():
    scene = small()
    other = scene.replace(camera={"eye": [0, 100, 300], "size": (32, 18)})
    assert other.description["camera"]["eye"] == [0.0, 1.0, 3.0]
    assert other.description["camera"]["size"] == [32, 18]
    assert other.description["materials"] == scene.description["materials"]
    assert all(other.arrays[name] is scene.arrays[name] for name in scene.arrays)
    assert scene.description["camera"]["size"] == [16, 9]
    assert other.replace(camera={"eye": [0, 0, 300], "size": [16, 9]}).hash() == scene.hash()


def test_a_whole_camera_of_the_description_can_be_given_back():
    scene = small()
    camera = scene.description["camera"] | {"size": [4, 4], "crop": [0, 0, 2, 2]}
    assert scene.replace(camera=camera).description["camera"] == camera


def test_replacing_materials_changes_reflection_and_emission():
    scene = small()
    other = scene.replace(materials={"lamp": {"kind": "diffuse", "reflectance": 0.2}})
    assert [thing["emission"] for thing in other.description["objects"]] == [None, None, None]
    assert [curve["name"] for curve in other.description["curves"]] == ["0.5", "0.2", "D65"]
    other = scene.replace(materials={"grey": {"kind": "emitter", "spectrum": "E", "power_w": 1}})
    assert [bool(thing["emission"]) for thing in other.description["objects"]] == [True, True, True]
    changed = small(materials=small_materials(0.25))
    assert scene.replace(materials={"grey": small_materials(0.25)["grey"]}).hash() == changed.hash()


def test_replacing_lights():
    scene = small()
    lamp = {"kind": "point", "position": [0, 200, 0], "spectrum": {"blackbody_k": 2700}, "flux_lm": 800}
    other = scene.replace(lights={"sky": None, "lamp": lamp})
    (light,) = other.description["lights"]
    assert (light["name"], light["position"]) == ("lamp", [0.0, 2.0, 0.0])
    assert (
        other.replace(
            lights={"lamp": None, "sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 1000}}
        ).hash()
        == scene.hash()
    )


def test_replacing_with_mistakes_tells_all_of_them():
    scene = small()
    with pytest.raises(SceneError) as caught:
        scene.replace(
            camera={"target": [0, 0, 300]},
            materials={"gray": {"kind": "diffuse", "reflectance": 0.1}, "grey": {"kind": "diffuse"}},
            lights={"sky": {"kind": "environment", "spectrum": "D66", "luminance_cd_m2": 1}},
        )
    kinds = [problem.kind for problem in caught.value.problems]
    assert kinds == ["camera", "unknown-material", "missing-key", "unknown-spectrum"]
    dark = scene.replace(lights={"sky": None})
    with pytest.raises(SceneError, match="the scene has no light"):
        dark.replace(materials={"lamp": {"kind": "diffuse", "reflectance": 0.2}})


# --- from Python ------------------------------------------------------------------------------------------------


def test_objects_may_be_a_list():
    scene = small(
        objects=[
            {"material": "lamp", "sphere": {"radius": 1}},
            {"name": "b", "material": "grey", "sphere": {"radius": 2}},
        ]
    )
    assert [thing["name"] for thing in scene.description["objects"]] == ["object 1", "b"]


def test_spectra_and_images_may_be_objects_and_arrays():
    image = np.ones((4, 8, 3), np.float64)
    scene = small(
        materials={
            "grey": {"kind": "diffuse", "reflectance": spectra.load("ColorChecker/red")},
            "lamp": small_materials(0.5)["lamp"],
        },
        lights={"sky": {"kind": "environment", "image": image, "luminance_cd_m2": 100}},
    )
    assert scene.arrays["image:sky"].dtype == np.float32
    assert scene.description["lights"][0]["image"] == "sky"
    red = scene.description["curves"][scene.description["materials"][0]["surface"]["reflectance"]]
    assert tuple(red["values"]) == spectra.load("ColorChecker/red").values
    image[:] = 0.0  # the scene has its own
    assert scene.arrays["image:sky"].max() == 1.0
    plain = scene.replace(lights={"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 100}})
    assert "image:sky" not in plain.arrays
    assert plain.hash() != scene.hash()


@pytest.mark.parametrize(
    "image", [np.ones((4, 8)), -np.ones((2, 4, 3)), np.zeros((2, 4, 3)), np.full((1, 2, 3), np.nan)]
)
def test_images_that_are_no_environment(image):
    with pytest.raises(SceneError, match=r"\[lights.sky\] image"):
        small(lights={"sky": {"kind": "environment", "image": image, "luminance_cd_m2": 1}})


def test_mistakes_in_python_have_no_file_but_a_place():
    with pytest.raises(SceneError) as caught:
        small(length_unit="yd")
    (problem,) = caught.value.problems
    assert (problem.file, problem.line, problem.key) == ("", 0, "length_unit")
    assert str(problem).startswith("scene: length_unit: must be ")


def test_rgb_becomes_a_spectrum_by_its_role():
    grey = small(
        materials={
            "grey": {"kind": "diffuse", "reflectance": {"rgb": [0.5, 0.5, 0.5], "role": "albedo"}},
            "lamp": small_materials(0.5)["lamp"],
        }
    )
    curve = grey.description["curves"][grey.description["materials"][0]["surface"]["reflectance"]]
    assert np.allclose(curve["values"], 0.5, atol=1e-3)  # a neutral scene stays neutral
    assert curve["outside"] == "hold"


def test_the_rule_outside_follows_the_use():
    points = {"wavelengths_nm": [400, 700], "values": [0.5, 0.5]}
    scene = small(
        spectra={"points": points},
        materials={
            "grey": {"kind": "diffuse", "reflectance": "points"},
            "lamp": {"kind": "emitter", "spectrum": "points", "flux_lm": 1},
        },
    )
    reflectance = scene.description["curves"][scene.description["materials"][0]["surface"]["reflectance"]]
    emission = scene.description["curves"][scene.description["objects"][2]["emission"]["spectrum"]]
    assert (reflectance["outside"], emission["outside"]) == ("hold", "zero")


def test_z_up_worlds():
    scene = small(
        up="z",
        camera={"eye": [9, 9, 9], "target": [0, 0, 0]},
        objects={"a": {"material": "lamp", "mesh": TRIANGLE | {"up": "y"}}},
    )
    assert scene.description["camera"]["up"] == [0.0, 0.0, 1.0]
    assert np.allclose(scene.arrays["shape:0:positions"], 0.01 * np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]))


def test_the_correct_viewing_distance():
    scene = small().replace(camera={"field_of_view": 53.13010235415598})
    assert math.isclose(scene.viewing_distance(0.30), 0.30, rel_tol=1e-12)


# --- the core ---------------------------------------------------------------------------------------------------


def test_the_core_takes_the_scene_and_the_geometry_is_built_once():
    scene = small()
    core = scene.core(threads=1)
    assert scene.core() is core
    other = scene.replace(
        camera={"size": [4, 4]}, materials={"grey": {"kind": "diffuse", "reflectance": 0.1}}
    )
    assert other.core() is not core
    assert other._geometry.core is scene._geometry.core
