"""What a scene tells the historical models, instead of the rule."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.errors import SceneError
from illuminant.scene import Scene

PAINT = {"kind": "coated", "reflectance": "ColorChecker/red", "roughness": 0.2}


def scene(coefficients, material=None):
    """A ball under a lamp."""
    told = {} if coefficients is None else {"coefficients": coefficients}
    return Scene.build(
        camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [16, 16]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": "one"}},
        materials={"one": (material or PAINT) | told},
        lights={
            "sun": {"kind": "directional", "direction": [-1, -1, -2], "spectrum": "E", "illuminance_lx": 1000}
        },
    )


def xyz(made, illumination="phong"):
    image = illuminant.render(
        made, technique="phong", illumination=illumination, sampling="uniform:8", samples=2
    )
    return np.asarray(image.xyz, float)


def test_what_is_told_one_model_leaves_the_others_alone():
    told = scene({"phong": {"specular": 0.0, "diffuse": 0.5}})
    assert np.abs(xyz(told) - xyz(scene(None))).max() > 10
    for model in ("blinn", "whitted", "general"):
        np.testing.assert_array_equal(xyz(told, model), xyz(scene(None), model))


def test_what_is_told_all_is_told_each_unless_it_has_its_own():
    told = scene({"all": {"diffuse": 0.5}, "blinn": {"diffuse": 0.25}})
    np.testing.assert_array_equal(xyz(told), xyz(scene({"phong": {"diffuse": 0.5}})))
    np.testing.assert_array_equal(xyz(told, "blinn"), xyz(scene({"blinn": {"diffuse": 0.25}}), "blinn"))


def test_multipliers_scale_their_terms():
    dark = scene({"phong": {"specular": 0.0, "ambient": 0.2, "diffuse": 0.2}})
    bright = scene({"phong": {"specular": 0.0, "ambient": 0.8, "diffuse": 0.8}})
    np.testing.assert_allclose(xyz(bright), 4.0 * xyz(dark), rtol=1e-5)


def test_curves_stand_for_those_of_the_rule():
    told = {"specular": 0.0, "diffuse_curve": "ColorChecker/blue"}
    plain = scene({"phong": {"specular": 0.0}}, {"kind": "diffuse", "reflectance": "ColorChecker/blue"})
    np.testing.assert_allclose(xyz(scene({"phong": told})), xyz(plain), rtol=1e-6)


def test_materials_in_words_take_them_too():
    told = scene({"phong": {"specular": 0.0}}, {"kind": "named", "name": "copper, satin"})
    assert xyz(told).max() < xyz(scene(None, {"kind": "named", "name": "copper, satin"})).max()


def test_they_last_through_replace_and_files(tmp_path):
    made = scene({"phong": {"diffuse_curve": "ColorChecker/blue", "exponent": 20.0}})
    made.save(tmp_path / "scene.npz")
    assert Scene.load(tmp_path / "scene.npz").hash() == made.hash()
    assert made.replace(camera={"size": [16, 16]}).hash() == made.hash()


@pytest.mark.parametrize(
    ("coefficients", "message"),
    [
        ({"fong": {}}, "no historical model.*did you mean"),
        ({"general": {}}, "has no coefficients"),
        ({"phong": {"shine": 1.0}}, "is not a key of this table"),
        ({"phong": {"diffuse": -1.0}}, "must be at least 0"),
        ({"phong": {"half_angle_deg": 5.0, "exponent": 80.0}}, "is given twice"),
        ({"phong": {"terminator": 9.0}}, "must be at most 5"),
        ({"phong": {"distribution": "blin"}}, "did you mean"),
        ({"phong": {"diffuse_curve": 1.5}}, "1.5"),
        ({"phong": 3}, "must be a table"),
    ],
)
def test_mistakes_are_named(coefficients, message):
    with pytest.raises(SceneError, match=message):
        scene(coefficients)
