"""Every kind of mistake in a scene file: its kind, key and line, the sentence once for each, and all at once."""

import copy
import re
import stat
import tomllib
from pathlib import Path

import pytest

from illuminant import scene_file
from illuminant.errors import Problem, SceneError
from illuminant.scene import Scene

# A right scene; each test below changes it in one place.
GOOD = """\
title = "test"
length_unit = "cm"

[camera]
eye = [0, 1, 4]
target = [0, 0, 0]
size = [8, 8]

[spectra]
paint = { wavelengths_nm = [400, 700], values = [0.2, 0.4] }
warm = { rgb = [1.0, 0.8, 0.6], role = "emission" }

[materials.wall]
kind = "diffuse"
reflectance = "paint"

[materials.metal]
kind = "conductor"
metal = "gold"

[materials.glass]
kind = "dielectric"
medium = "BK7"

[materials.bulb]
kind = "emitter"
spectrum = "A"
flux_lm = 800

[objects.floor]
material = "wall"
rectangle = { corner = [0, 0, 0], edges = [[0, 0, 1], [1, 0, 0]] }

[objects.ball]
material = "metal"
sphere = { radius = 1 }

[objects.lamp]
material = "bulb"
disc = { normal = [0, -1, 0], radius = 1 }

[lights.spot]
kind = "spot"
position = [0, 5, 0]
direction = [0, -1, 0]
half_angle_deg = 20
spectrum = "D65"
intensity_cd = 100
"""


def problems_of(text: str, folder: Path) -> list[Problem]:
    path = folder / "scene.toml"
    path.write_text(text)
    return scene_file.check(path)


def test_the_right_scene_has_no_mistakes(tmp_path):
    assert problems_of(GOOD, tmp_path) == []


# What is replaced by what; then kind, table, key, and a piece of the sentence.
# fmt: off
MISTAKES = [
    # --- form ---
    ("title =", "titel =", "unknown-key", "", "titel", 'did you mean "title"?'),
    ('"cm"', '"km"', "choice", "", "length_unit",
     'must be "m", "cm", "mm", "in" or "ft", found the text "km"'),
    ("eye = [0, 1, 4]", "eye = [0, 1]", "length", "camera", "eye", "must have 3 entries, found 2"),
    ("eye = [0, 1, 4]", 'eye = "here"', "type", "camera", "eye", "must be a list"),
    ("eye = [0, 1, 4]", "eye = [0, nan, 4]", "type", "camera", "eye[1]", "must be a finite number"),
    ("eye = [0, 1, 4]", "", "missing-key", "camera", "eye", "is missing; expected position of the eye"),
    ("size =", "sise =", "unknown-key", "camera", "sise", 'did you mean "size"?'),
    ("size = [8, 8]", "size = [8.5, 8]", "type", "camera", "size[0]", "must be a whole number"),
    ("size = [8, 8]", "size = [0, 8]", "range", "camera", "size[0]", "must be at least 1"),
    ("size = [8, 8]", "field_of_view = 180", "range", "camera", "field_of_view", "must be below 180"),
    ("size = [8, 8]", "field_of_view = 5e-324", "range", "camera", "field_of_view", "must be at least 0.001"),
    ("[materials.wall]", "[materials]\nwall = 3\n[materials.w]", "type", "materials.wall", "",
     "must be a table"),
    ('kind = "diffuse"', 'kind = "difuse"', "choice", "materials.wall", "kind", 'did you mean "diffuse"?'),
    ('kind = "diffuse"', "", "missing-key", "materials.wall", "kind", "is missing"),
    ('kind = "diffuse"', 'kind = "diffuse"\nroughness = 0.1', "unknown-key", "materials.wall", "roughness",
     "it belongs to kind conductor or dielectric"),
    ('metal = "gold"', 'metal = "gold"\nroughness = "a"', "type", "materials.metal", "roughness",
     "must be a number"),
    ('metal = "gold"', 'metal = "gold"\nroughness = 1.5', "range", "materials.metal", "roughness",
     "at most 1"),
    ("sphere = { radius = 1 }", "sphere = { radius = 1, centre = [0, 0, 0] }", "unknown-key",
     "objects.ball", "sphere.centre", 'did you mean "center"?'),
    ("sphere = { radius = 1 }", "sphere = { radius = 0 }", "range", "objects.ball", "sphere.radius",
     "above 0"),
    # --- camera ---
    ("target = [0, 0, 0]", "target = [0, 1, 4]", "camera", "camera", "target", "looks nowhere"),
    ("size = [8, 8]", "up = [0, -1, -4]", "camera", "camera", "up", "parallel to the direction of view"),
    ("size = [8, 8]", "size = [1000000000, 1000000000]", "size", "camera", "size", "at most 67108864 pixels"),
    ("size = [8, 8]", "size = [8, 8]\ncrop = [4, 4, 2, 9]", "crop", "camera", "crop", "inside 8 × 8 pixels"),
    # --- spectra ---
    ("[400, 700], values", "[700, 400], values", "spectrum", "spectra.paint", "wavelengths_nm", "increasing"),
    ("[400, 700], values = [0.2, 0.4]", "[400], values = [0.2]", "spectrum", "spectra.paint",
     "wavelengths_nm", "only one point"),
    ("values = [0.2, 0.4]", "values = [0.2]", "spectrum", "spectra.paint", "wavelengths_nm", "2 wavelengths"),
    ("values = [0.2, 0.4]", "values = [20, 40]", "spectrum-value", "materials.wall", "reflectance",
     "scale = 0.01"),
    ("values = [0.2, 0.4]", "values = [-0.1, 0.4]", "spectrum", "spectra.paint", "wavelengths_nm",
     "value -0.1"),
    ("values = [0.2, 0.4] }", 'values = [0.2, 0.4], outside = "error" }', "spectrum-range",
     "materials.wall", "reflectance", "known from 400 to 700 nm"),
    ("{ wavelengths_nm = [400, 700], values = [0.2, 0.4] }", '{ file = "none.csv" }', "missing-file",
     "spectra.paint", "file", "none.csv"),
    ("{ wavelengths_nm = [400, 700], values = [0.2, 0.4] }", '"paint"', "cycle", "spectra.paint", "",
     "by itself"),
    ("{ wavelengths_nm = [400, 700], values = [0.2, 0.4] }", "{ constant = 1, blackbody_k = 3 }",
     "exactly-one", "spectra.paint", "", "found constant and blackbody_k"),
    ("{ wavelengths_nm = [400, 700], values = [0.2, 0.4] }", "{ scale = 2 }", "exactly-one",
     "spectra.paint", "", "found none"),
    ("{ wavelengths_nm = [400, 700], values = [0.2, 0.4] }", "[1, 2]", "type", "spectra.paint", "",
     "a spectrum"),
    ('reflectance = "paint"', 'reflectance = "pain"', "unknown-spectrum", "materials.wall", "reflectance",
     'did you mean "paint"?'),
    ('reflectance = "paint"', 'reflectance = "D65"', "spectrum-use", "materials.wall", "reflectance",
     "is a spectrum of light, where a reflectance is expected"),
    ('spectrum = "A"', 'spectrum = "D64"', "unknown-spectrum", "materials.bulb", "spectrum",
     "did you mean 'D65'?"),
    ('spectrum = "A"', "spectrum = 0", "spectrum-value", "materials.bulb", "spectrum", "zero everywhere"),
    # --- RGB and its role ---
    ('reflectance = "paint"', "reflectance = { rgb = [0.1, 0.2, 0.3] }", "rgb-role", "materials.wall",
     "reflectance.role", "RGB needs to say what it is"),
    ('reflectance = "paint"', 'reflectance = "warm"', "rgb-role", "spectra.warm", "role",
     'must be "albedo" for a reflectance'),
    ('metal = "gold"', 'k = 2\nn = { rgb = [1, 1, 1], role = "albedo" }', "rgb-role", "materials.metal",
     "n.rgb", "not possible for an index of refraction"),
    ('metal = "gold"', 'n = 2\nk = { rgb = [1, 1, 1], role = "emission" }', "rgb-role", "materials.metal",
     "k.rgb", "not possible for an extinction coefficient"),
    ('medium = "BK7"', 'medium = "BK7"\nabsorption = { rgb = [1, 1, 1], role = "albedo" }', "rgb-role",
     "materials.glass", "absorption.rgb", "not possible for an absorption coefficient"),
    ("rgb = [1.0, 0.8, 0.6]", "rgb = [1.0, -0.8, 0.6]", "range", "spectra.warm", "rgb", "at least 0"),
    ('role = "emission"', 'role = "emission", system = "sRBG"', "unknown-rgb-system", "spectra.warm",
     "system", 'did you mean "sRGB"?'),
    # --- materials ---
    ('metal = "gold"', 'metal = "golld"', "unknown-spectrum", "materials.metal", "metal",
     'did you mean "gold"?'),
    ('metal = "gold"', 'metal = "BK7"', "unknown-spectrum", "materials.metal", "metal", "has n but no k"),
    ('metal = "gold"', "", "missing-key", "materials.metal", "", "metal, or n and k, is missing"),
    ('metal = "gold"', "n = 0.2", "missing-key", "materials.metal", "", "k is missing"),
    ('metal = "gold"', 'metal = "gold"\nn = 0.2', "exactly-one", "materials.metal", "n", "given twice"),
    ('medium = "BK7"', 'medium = "gold"', "spectrum-use", "materials.glass", "medium", "is a metal"),
    ('medium = "BK7"', "n = 0", "spectrum-value", "materials.glass", "n", "n must be above 0"),
    ('medium = "BK7"', "n = 1e308", "spectrum-value", "materials.glass", "n", "n is at most 100,000 in visible light"),
    ('metal = "gold"', "n = 0.2\nk = 1e6", "spectrum-value", "materials.metal", "k", "k is at most 100,000"),
    # --- quantities ---
    ("flux_lm = 800", "intensity_cd = 800", "quantity", "materials.bulb", "intensity_cd",
     "does not fit an emitter"),
    ("flux_lm = 800", "flux_lm = 800\npower_w = 8", "quantity", "materials.bulb", "",
     "found power_w and flux_lm"),
    ("flux_lm = 800", "", "quantity", "materials.bulb", "", "found none"),
    ("flux_lm = 800", "flux_lm = -800", "range", "materials.bulb", "flux_lm", "must be above 0"),
    ("intensity_cd = 100", "illuminance_lx = 100", "quantity", "lights.spot", "illuminance_lx",
     "a spot light"),
    # --- lights ---
    ('kind = "spot"', 'kind = "laser"', "choice", "lights.spot", "kind", 'found the text "laser"'),
    ("direction = [0, -1, 0]", "direction = [0, 0, 0]", "direction", "lights.spot", "direction",
     "have a length"),
    ("half_angle_deg = 20", "half_angle_deg = 20\npenumbra_deg = 30", "range", "lights.spot",
     "penumbra_deg", "at most half_angle_deg"),
    # --- objects ---
    ('material = "metal"', 'material = "metall"', "unknown-material", "objects.ball", "material",
     'did you mean "metal"?'),
    ("sphere = { radius = 1 }", "", "exactly-one", "objects.ball", "", "found none"),
    ("sphere = { radius = 1 }", "sphere = { radius = 1 }\nbox = { min = [0, 0, 0], max = [1, 1, 1] }",
     "exactly-one", "objects.ball", "", "found sphere and box"),
    ("sphere = { radius = 1 }", "sphere = { radius = 1 }\nscale = [1, 2, 1]", "transform", "objects.ball",
     "scale", "same in all directions for a sphere"),
    ("sphere = { radius = 1 }", "sphere = { radius = 1 }\nscale = 0", "transform", "objects.ball", "scale",
     "flattens the object"),
    ("sphere = { radius = 1 }", "box = { min = [0, 0, 0], max = [1, 0, 1] }", "mesh", "objects.ball", "box",
     "min must be below max"),
    ("sphere = { radius = 1 }", 'mesh = "none.ply"', "missing-file", "objects.ball", "mesh",
     "there is no such file"),
    ("sphere = { radius = 1 }", 'mesh = "none.abc"', "mesh", "objects.ball", "mesh", "expected .obj, .ply"),
    ("sphere = { radius = 1 }",
     "mesh = { positions = [[0, 0, 0], [1, 0, 0], [2, 0, 0]], faces = [[0, 1, 2]] }", "mesh",
     "objects.ball", "mesh", "1 face without area, first face 0"),
    ("sphere = { radius = 1 }",
     "mesh = { positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = [[0, 1, 3]] }", "mesh",
     "objects.ball", "mesh", "vertex numbers out of range 0 to 2"),
    ("sphere = { radius = 1 }",
     "mesh = { positions = [[0, 0, 0], [1, nan, 0], [0, 1, 0]], faces = [[0, 1, 2]] }", "mesh",
     "objects.ball", "mesh", "1 vertex has a position that is not a finite number"),
    ("sphere = { radius = 1 }", "mesh = { positions = [], faces = [] }", "mesh", "objects.ball", "mesh",
     "rows of 3"),
    ("corner = [0, 0, 0], edges", "corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 9]], edges", "mesh",
     "objects.floor", "rectangle", "corner and edges, or corners"),
    ("edges = [[0, 0, 1], [1, 0, 0]]", "edges = [[0, 0, 1], [0, 0, 2]]", "mesh", "objects.floor",
     "rectangle", "enclose no area"),
]
# fmt: on


@pytest.mark.parametrize(("old", "new", "kind", "table", "key", "says"), MISTAKES)
def test_one_mistake(old, new, kind, table, key, says, tmp_path):
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    found = [problem for problem in problems_of(text, tmp_path) if problem.kind == kind]
    assert len(found) == 1, problems_of(text, tmp_path)
    problem = found[0]
    assert (problem.table, problem.key) == (table, key)
    assert says in str(problem)
    assert problem.file.endswith("scene.toml")
    last = re.split(r"[.\[]", key)[0] if key else table.split(".")[-1]
    line = text.splitlines()[problem.line - 1]
    assert (last in line) or (kind == "missing-key" and table.split(".")[-1] in line), line


def test_all_mistakes_are_told_at_once_in_the_order_of_the_file(tmp_path):
    text = (
        GOOD.replace("title", "titel")
        .replace('metal = "gold"', 'metal = "golld"')
        .replace("flux_lm", "flux_ml")
    )
    text = text.replace('"D65"', '"D64"').replace("radius = 1 }", "radius = -1 }", 1)
    problems = problems_of(text, tmp_path)
    assert [problem.kind for problem in problems] == [
        "unknown-key",
        "unknown-spectrum",
        "quantity",
        "unknown-key",
        "range",
        "unknown-spectrum",
    ]
    assert [problem.line for problem in problems] == sorted(problem.line for problem in problems)


def test_two_mistakes_of_one_table_are_both_told(tmp_path):
    problems = problems_of(
        GOOD.replace('metal = "gold"', 'metal = "golld"\nroughness = "a"\nsheen = 1'), tmp_path
    )
    assert [problem.key for problem in problems] == ["metal", "roughness", "sheen"]


def test_the_sentence_of_a_mistake(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(GOOD.replace('material = "metal"', 'material = "metall"'))
    with pytest.raises(SceneError) as caught:
        Scene.load(path)
    assert str(caught.value) == (
        f'{path}:35: [objects.ball] material: there is no material "metall"; [materials] has wall, metal, glass, bulb '
        '(did you mean "metal"?)'
    )
    assert isinstance(caught.value, ValueError)
    assert caught.value.exit_code == 2


# --- the whole scene, and the file ------------------------------------------------------------------------------


def test_no_light(tmp_path):
    text = GOOD[: GOOD.index("[objects.lamp]")]
    assert [problem.kind for problem in problems_of(text, tmp_path)] == ["no-light"]


def test_no_object(tmp_path):
    text = GOOD[: GOOD.index("[objects.floor]")] + GOOD[GOOD.index("[lights.spot]") :]
    assert [problem.kind for problem in problems_of(text, tmp_path)] == ["no-objects"]


def test_no_camera(tmp_path):
    text = GOOD[: GOOD.index("[camera]")] + GOOD[GOOD.index("[spectra]") :]
    assert [(problem.kind, problem.table) for problem in problems_of(text, tmp_path)] == [
        ("missing-key", "camera")
    ]


def test_an_empty_file_says_what_is_missing(tmp_path):
    kinds = {problem.kind for problem in problems_of("", tmp_path)}
    assert kinds == {"missing-key", "no-objects", "no-light"}


def test_a_file_that_is_not_toml(tmp_path):
    problems = problems_of(GOOD.replace("[camera]", "[camera"), tmp_path)
    assert [(problem.kind, problem.line) for problem in problems] == [("toml", 4)]


def test_a_key_given_twice(tmp_path):
    problems = problems_of(GOOD.replace("size = [8, 8]", "size = [8, 8]\nsize = [9, 9]"), tmp_path)
    assert [problem.kind for problem in problems] == ["toml"]
    assert problems[0].line == 8


def test_a_file_that_is_not_text(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(b"a = 1\n\xff\xfe\n")
    assert [(p.kind, p.line) for p in scene_file.check(path)] == [("toml", 2)]


def test_a_file_that_is_not_there(tmp_path):
    (problem,) = scene_file.check(tmp_path / "none.toml")
    assert (problem.kind, problem.message) == ("missing-file", "there is no such file")
    (problem,) = scene_file.check(tmp_path)
    assert problem.message == "is a folder"


def test_a_file_that_may_not_be_read(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(GOOD)
    path.chmod(0)
    try:
        path.read_text()
        pytest.skip("this user may read everything")
    except PermissionError:
        (problem,) = scene_file.check(path)
        assert "cannot be read (permission denied)" in problem.message
    finally:
        path.chmod(stat.S_IRUSR | stat.S_IWUSR)


@pytest.mark.parametrize("table", ["camera", "render", "spectra", "materials", "objects", "lights"])
def test_a_table_that_is_none(table, tmp_path):
    problems = problems_of(f"{table} = 3\n", tmp_path)
    assert (table, "must be a table, found 3") in [(problem.table, problem.message) for problem in problems]


def test_an_environment_image_that_is_not_one(tmp_path):
    (tmp_path / "broken.exr").write_bytes(b"not an image")
    light = '[lights.sky]\nkind = "environment"\nluminance_cd_m2 = 1\n'
    for image, kind in (("none.exr", "missing-file"), ("broken.exr", "image")):
        (problem,) = problems_of(GOOD + light + f'image = "{image}"\n', tmp_path)
        assert (problem.kind, problem.table, problem.key) == (kind, "lights.sky", "image")
    (problem,) = problems_of(GOOD + light, tmp_path)
    assert problem.message == "must have a spectrum or an image; found neither"
    (problem,) = problems_of(
        GOOD + light.replace("luminance_cd_m2", "flux_lm") + 'spectrum = "D65"\n', tmp_path
    )
    assert (problem.kind, problem.key) == ("quantity", "flux_lm")


def paths_in(value, path=()):
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in items:
        yield from paths_in(one, (*path, key))


GOOD_DATA = tomllib.loads(GOOD) | {"render": {"samples": 4, "filter": {"kind": "box", "radius": 0.5}}}
ODD = [
    None, True, -1, 0, 3, 1e308, -1e-320, float("nan"), float("inf"), 2**63, "", "A", "gold.n", "paint", [], [1], [[]],
    [1, 2, 3], ["a", 1, {}], {}, {"kind": "spot"}, {"rgb": [1, 1, 1], "role": "albedo"}, {"file": "\0"}, "a\0b",
]  # fmt: skip


@pytest.mark.parametrize("odd", ODD, ids=repr)
def test_no_value_anywhere_does_more_than_a_scene_error(odd):
    for path in list(paths_in(GOOD_DATA))[1:]:
        data = copy.deepcopy(GOOD_DATA)
        holder = data
        for part in path[:-1]:
            holder = holder[part]
        holder[path[-1]] = odd
        try:
            scene = scene_file.resolve(scene_file.plain(data))
        except SceneError as error:
            assert all("\n" not in str(problem) for problem in error.problems)
        else:
            assert len(scene.hash()) == 64
