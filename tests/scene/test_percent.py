"""A reflectance file in percent, with the scale that makes fractions of it."""

import pytest

from illuminant import scene_file
from illuminant.errors import SceneError

SCENE = """
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
field_of_view = 40
size = [8, 8]
[materials.paint]
kind = "diffuse"
reflectance = {{ file = "paint.csv"{scale} }}
[lights.sky]
kind = "environment"
spectrum = "D65"
luminance_cd_m2 = 100
[objects.ball]
sphere = {{ center = [0, 0, 0], radius = 0.8 }}
material = "paint"
"""


def scene(folder, scale):
    (folder / "paint.csv").write_text("400,10\n500,50\n700,90\n")
    (folder / "scene.toml").write_text(SCENE.format(scale=scale))
    return scene_file.load(folder / "scene.toml")


def test_percents_are_checked_after_they_are_scaled(tmp_path):
    curves = scene(tmp_path, ", scale = 0.01").description["curves"]
    paint = next(curve for curve in curves if curve["wavelengths"][0] == 400)
    assert paint["values"] == pytest.approx([0.1, 0.5, 0.9])
    assert paint["outside"] == "hold"


@pytest.mark.parametrize(("scale", "said"), [("", "are these percent?"), (", scale = 0.02", "found 1.8")])
def test_what_is_no_fraction_even_then_is_refused(tmp_path, scale, said):
    with pytest.raises(SceneError, match="paint") as caught:
        scene(tmp_path, scale)
    assert said in str(caught.value)
