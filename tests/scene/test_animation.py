"""Animations: a scene at a time, the still scene of a frame, motion while the shutter is open, and every mistake."""

import tomllib

import numpy as np
import pytest

import illuminant
from illuminant import scene_file
from illuminant.animation import Animation, path_of
from illuminant.errors import SceneError
from illuminant.scene import Scene
from illuminant.scene_file import resolve

STILL = """\
title = "a ball that moves"

[camera]
eye = [0.0, 1.0, 4.0]
target = [0.0, 0.5, 0.0]
size = [32, 24]

[spectra]
paint = "ColorChecker/red"

[materials.grey]
kind = "diffuse"
reflectance = 0.5

[materials."shiny metal"]
kind = "conductor"
metal = "copper"
roughness = 0.1

[objects.ball]
material = "grey"
sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }
translate = [0.0, 0.0, 0.0]

[objects.cube]
material = "shiny metal"
box = { min = [-1.5, 0.0, -0.5], max = [-0.5, 1.0, 0.5] }
rotate = { axis = "y", degrees = 0.0 }

[lights.lamp]
kind = "point"
position = [0.0, 3.0, 2.0]
spectrum = "A"
intensity_cd = 100.0

[lights.day]
kind = "environment"
spectrum = "D65"
luminance_cd_m2 = 50.0

[animation]
frames = [0, 30]
"""
FIRST_LINE_OF_KEYS = STILL.count("\n") + 1


def keyed(path, times, values, more=""):
    """The text of a scene in which one key changes."""
    name = f"'{path}'" if '"' in path else f'"{path}"'
    return f"{STILL}[animation.keys.{name}]\ntimes = {times}\nvalues = {values}\n{more}"


def animation_of(text):
    return Animation.build(tomllib.loads(text))


def problems_of(text, folder):
    path = folder / "scene.toml"
    path.write_text(text)
    return scene_file.check(path)


# --- a scene at a time --------------------------------------------------------------------------------------------


CHANGES = [
    ("camera.eye", "[[0, 1, 4], [2, 1, 4]]", [1.0, 1, 4]),
    ("camera.eye[0]", "[0, 2]", 1.0),
    ("camera.field_of_view", "[30, 50]", 40.0),
    ("objects.ball.translate", "[[0, 0, 0], [0, 1, 0]]", [0, 0.5, 0]),
    ("objects.ball.sphere.radius", "[0.2, 0.4]", pytest.approx(0.3)),
    ("objects.cube.rotate.degrees", "[0, 700]", 350.0),
    ("objects.cube.rotate", '[{ axis = "y", degrees = 0 }, { axis = "y", degrees = 700 }]',
     {"axis": "y", "degrees": 350.0}),
    ("lights.lamp.intensity_cd", "[100, 300]", 200.0),
    ("lights.lamp.spectrum", '["A", "D65"]', "A"),
    ('materials."shiny metal".roughness', "[0.1, 0.3]", pytest.approx(0.2)),
    ("materials.grey.reflectance", "[0.1, 0.5]", pytest.approx(0.3)),
    ("spectra.paint", '["ColorChecker/red", "ColorChecker/green"]', "ColorChecker/red"),
]  # fmt: skip


@pytest.mark.parametrize(("path", "values", "expected"), CHANGES, ids=[one[0] for one in CHANGES])
def test_a_key_has_its_value_at_a_time_and_the_scene_is_that_of_a_file_that_states_it(path, values, expected):
    animation = animation_of(keyed(path, "[0, 1]", values))
    found = animation.data(0.5)
    holder = found
    for part in path_of(path):
        holder = holder[part]
    assert holder == expected
    assert "animation" not in found
    assert animation.still(15).hash() == resolve(found).hash()
    first, last = (animation.still(frame).hash() for frame in (0, 30))
    shown = not path.startswith("spectra")  # nothing uses that one
    assert (first != last) is shown


def test_what_is_not_keyed_stays_and_the_tables_are_not_changed():
    animation = animation_of(keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [2, 1, 4]]"))
    before = repr(animation.tables)
    assert animation.data(0.7)["lights"] == animation.tables["lights"]
    animation.still(17)
    assert repr(animation.tables) == before


def test_a_scene_with_an_animation_is_shown_at_its_first_frame(tmp_path):
    text = keyed("lights.lamp.intensity_cd", "[0, 1]", "[100, 400]").replace(
        "frames = [0, 30]", "frames = [15, 30]"
    )
    path = tmp_path / "a.toml"
    path.write_text(text)
    still = STILL.replace("intensity_cd = 100.0", "intensity_cd = 250.0").replace(
        "[animation]\nframes = [0, 30]", ""
    )
    (tmp_path / "b.toml").write_text(still)
    assert Scene.load(path).hash() == Scene.load(tmp_path / "b.toml").hash()
    assert Animation.load(path).still(15).hash() == Scene.load(path).hash()


def test_a_key_need_not_be_stated_twice(tmp_path):
    text = keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [2, 1, 4]]").replace("eye = [0.0, 1.0, 4.0]\n", "", 1)
    assert problems_of(text, tmp_path) == []


@pytest.mark.parametrize(
    ("rate", "frame", "seconds"),
    [("24", 12, 0.5), ("25.0", 5, 0.2), ('"30000/1001"', 30000, 1001.0), ("30", 3, 0.1)],
)
def test_the_time_of_a_frame_is_its_number_over_the_rate(rate, frame, seconds):
    animation = animation_of(f"{STILL}frames_per_second = {rate}\n")
    assert animation.time(frame) == seconds


def test_keys_may_be_told_by_frames_and_are_met_exactly():
    text = keyed("lights.lamp.intensity_cd", "[0]", "[100, 170, 300]").replace(
        "times = [0]", "frames = [0, 7, 11]"
    )
    animation = animation_of(text + 'interpolation = "smooth"\n')
    assert [animation.data(animation.time(frame))["lights"]["lamp"]["intensity_cd"] for frame in (0, 7, 11)] == [
        100, 170, 300,
    ]  # fmt: skip


def test_fields_are_half_a_frame_apart():
    animation = animation_of(f'{STILL}frames_per_second = "30000/1001"\nfields = "odd-first"\n')
    assert 1 / (animation.time(4, 1) - animation.time(4)) == pytest.approx(59.94, abs=1e-3)
    assert animation.time(5) - animation.time(4, 1) == pytest.approx(animation.time(4, 1) - animation.time(4))


# --- while the shutter is open -------------------------------------------------------------------------------------


def shuttered(text, shutter="[0.0, 0.5]"):
    return text.replace("size = [32, 24]", f"size = [32, 24]\nshutter = {shutter}")


def test_without_a_shutter_frames_are_sharp():
    scene = animation_of(keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [2, 1, 4]]")).still(3)
    assert scene.description["camera"]["end"] is None


def test_a_keyed_camera_moves_to_where_the_next_frame_begins():
    animation = animation_of(shuttered(keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [3, 1, 4]]")))
    here, there = animation.still(3), animation.still(4)
    assert here.description["camera"]["end"]["eye"] == there.description["camera"]["eye"]
    assert here.description["camera"]["end"]["target"] == here.description["camera"]["target"]
    assert animation.still(30).description["camera"]["end"] is None, "beyond the last key it holds still"


def test_a_keyed_object_moves_on_its_arc_to_where_the_next_frame_begins():
    text = shuttered(keyed("objects.cube.rotate.degrees", "[0, 1]", "[0, 2700]"))
    animation = animation_of(text)
    here, there = animation.still(3), animation.still(4)
    cube = [one["name"] for one in here.description["objects"]].index("cube")
    motion = here.arrays[f"placement:{cube}"]
    assert len(motion) == 1 + 9, "90 degrees in a frame, 10 a step"
    np.testing.assert_allclose(motion[-1], there.arrays[f"placement:{cube}"][0], atol=1e-12)
    middle = animation.data(animation.time(3) + 4 / 9 / 30)["objects"]["cube"]["rotate"]["degrees"]
    assert middle == pytest.approx(270 + 40)
    ball = [one["name"] for one in here.description["objects"]].index("ball")
    assert len(here.arrays[f"placement:{ball}"]) == 1


def test_what_moves_is_blurred_and_a_field_lasts_half_as_long():
    text = keyed("objects.ball.translate", "[0, 1]", "[[0, 0, 0], [30, 0, 0]]")
    whole = animation_of(shuttered(text, "[0.0, 1.0]"))
    field = animation_of(shuttered(text, "[0.0, 1.0]").replace("[0, 30]", '[0, 30]\nfields = "odd-first"', 1))
    ball = [one["name"] for one in whole.still(0).description["objects"]].index("ball")
    shifts = [animation.still(0).arrays[f"placement:{ball}"][-1][0, 3] for animation in (whole, field)]
    assert shifts == [pytest.approx(1.0), pytest.approx(0.5)]
    sharp = illuminant.render(animation_of(text).still(0), samples=16)
    blurred = illuminant.render(whole.still(0), samples=16)
    row = sharp.height // 2
    assert np.ptp(np.diff(blurred.xyz[row, :, 1])) < 0.8 * np.ptp(np.diff(sharp.xyz[row, :, 1]))


# --- mistakes ------------------------------------------------------------------------------------------------------


LINE = FIRST_LINE_OF_KEYS
EYES = "[[0, 1, 4], [2, 1, 4]]"
# The text; then kind, table, key, line, and a piece of the sentence.
# fmt: off
MISTAKES = {
    "no frames": (STILL.replace("frames = [0, 30]", ""), "missing-key", "animation", "frames", LINE - 2,
                  "is missing; expected first and last frame"),
    "frames in the wrong order": (STILL.replace("[0, 30]", "[30, 0]"), "range", "animation", "frames", LINE - 1,
                                  "not before it"),
    "a misspelt key": (STILL + "frames_per_secnd = 24\n", "unknown-key", "animation", "frames_per_secnd", LINE,
                       'did you mean "frames_per_second"?'),
    "a rate that is none": (STILL + 'frames_per_second = "fast"\n', "type", "animation", "frames_per_second", LINE,
                            "30000/1001"),
    "a rate of nothing": (STILL + "frames_per_second = 0\n", "range", "animation", "frames_per_second", LINE,
                          "must be at least 0.001"),
    "fields by another word": (STILL + 'fields = "upper-first"\n', "choice", "animation", "fields", LINE,
                               'must be "none", "odd-first" or "even-first"'),
    "keys that are no table": (STILL + "keys = 3\n", "type", "animation", "keys", LINE, "must be a table"),
    "a path that is none": (keyed("camera..eye", "[0]", "[1]"), "path", 'animation.keys."camera..eye"', "", LINE,
                            "is no path of a key"),
    "a table alone": (keyed("camera", "[0]", "[1]"), "path", "animation.keys.camera", "", LINE, "is no path"),
    "a misspelt table": (keyed("camara.eye", "[0, 1]", EYES), "path", 'animation.keys."camara.eye"', "", LINE,
                         'did you mean "camera"?'),
    "an option": (keyed("render.seed", "[0]", "[1]"), "path", 'animation.keys."render.seed"', "", LINE,
                  "cannot change with time"),
    "the size": (keyed("camera.size", "[0, 1]", "[[8, 8], [16, 16]]"), "path", 'animation.keys."camera.size"', "",
                 LINE, "the same in all frames"),
    "an object that is not there": (keyed("objects.bal.translate", "[0]", "[[0, 0, 0]]"), "path",
                                    'animation.keys."objects.bal.translate"', "", LINE, 'did you mean "ball"?'),
    "a key that is not there": (keyed("lights.lamp.intensity", "[0, 1]", "[1, 2]"), "unknown-key",
                                'animation.keys."lights.lamp.intensity"', "values[0]", LINE + 2,
                                'did you mean "intensity_cd"?'),
    "an index that is not there": (keyed("camera.eye[3]", "[0, 1]", "[1, 2]"), "path", 'animation.keys."camera.eye[3]"',
                                   "", LINE, "camera.eye has no [3]"),
    "more times than values": (keyed("camera.eye", "[0, 1, 2]", EYES), "length", 'animation.keys."camera.eye"',
                               "values", LINE + 2, "must be as many as times, of which there are 3; found 2"),
    "times that go back": (keyed("camera.eye", "[1, 0]", EYES), "range", 'animation.keys."camera.eye"', "times[1]",
                           LINE + 1, "must be after the one before it, 1"),
    "times that stand": (keyed("camera.eye", "[1, 1]", EYES), "range", 'animation.keys."camera.eye"', "times[1]",
                         LINE + 1, "found 1"),
    "times and frames": (keyed("camera.eye", "[0, 1]", EYES, "frames = [0, 30]"), "exactly-one",
                         'animation.keys."camera.eye"', "", LINE, "found times and frames"),
    "no values": (keyed("camera.eye", "[0, 1]", EYES).replace("values = " + EYES, ""), "missing-key",
                  'animation.keys."camera.eye"', "values", LINE, "is missing"),
    "a line between texts": (keyed("lights.lamp.spectrum", "[0, 1]", '["A", "D65"]', 'interpolation = "linear"'),
                             "interpolation", 'animation.keys."lights.lamp.spectrum"', "interpolation", LINE + 3,
                             'expected "step"'),
    "a curve between matrices": (
        keyed("objects.ball.matrix", "[0, 1]", "[[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], "
              "[[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]]", 'interpolation = "smooth"'
              ).replace("translate = [0.0, 0.0, 0.0]\n", ""),
        "interpolation", 'animation.keys."objects.ball.matrix"', "interpolation", LINE + 2, "no rigid motion"),
    "a value of another kind": (keyed("camera.eye", "[0, 1]", '[[0, 1, 4], "here"]'), "type",
                                'animation.keys."camera.eye"', "values[1]", LINE + 2,
                                "at 1 s, must be a list, found the text \"here\""),
    "a list that is too short": (keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [0, 1]]"), "length",
                                 'animation.keys."camera.eye"', "values[1]", LINE + 2, "must have 3 entries"),
    "a value out of range": (keyed("materials.grey.reflectance", "[0, 2]", "[0.5, 1.5]"), "spectrum-value",
                             'animation.keys."materials.grey.reflectance"', "values[1]", LINE + 2, "at 2 s, "),
    "a spectrum that is not there": (keyed("lights.lamp.spectrum", "[0, 2]", '["A", "D64"]'), "unknown-spectrum",
                                     'animation.keys."lights.lamp.spectrum"', "values[1]", LINE + 2, "D65"),
    "two quantities": (keyed("lights.lamp.power_w", "[0, 2]", "[5, 10]"), "quantity", "lights.lamp", "", 30,
                       "found power_w and intensity_cd"),
    "two paths to one thing": (
        keyed("camera.eye", "[0, 1]", EYES) + '[animation.keys."camera.eye[0]"]\ntimes = [0]\nvalues = [1]\n',
        "exactly-one", 'animation.keys."camera.eye[0]"', "", LINE + 3, 'changes what [animation.keys."camera.eye"]'),
    "a motion of its own": (
        keyed("objects.ball.translate", "[0, 1]", "[[0, 0, 0], [1, 0, 0]]").replace(
            "radius = 0.5 }", "radius = 0.5 }\nmotion = [{ translate = [1, 0, 0] }]"),
        "exactly-one", "objects.ball", "motion", 23, "stands instead of keyframes"),
    "an eye that meets its target": (keyed("camera.eye", "[0, 1]", "[[0, 1, 4], [0.0, 0.5, 0.0]]"), "camera",
                                     "camera", "target", 5, "at 1 s: is the same point as eye"),
}
# fmt: on


@pytest.mark.parametrize("name", MISTAKES)
def test_one_mistake(name, tmp_path):
    text, kind, table, key, line, says = MISTAKES[name]
    problems = problems_of(text, tmp_path)
    assert len(problems) == 1, problems
    problem = problems[0]
    assert (problem.kind, problem.table, problem.key, problem.line) == (kind, table, key, line)
    assert says in str(problem)


def test_a_mistake_of_the_still_scene_is_said_once_whatever_moves(tmp_path):
    text = keyed("camera.eye", "[0, 1]", EYES).replace('metal = "copper"', 'metal = "coper"')
    text = text.replace("size = [32, 24]", "size = [0, 24]")
    problems = problems_of(text, tmp_path)
    assert [(problem.table, problem.key) for problem in problems] == [
        ("camera", "size[0]"),
        ('materials."shiny metal"', "metal"),
    ]


def test_a_wrong_value_is_reported_once_though_it_is_held(tmp_path):
    text = keyed("materials.grey.reflectance", "[0, 0.5]", "[0.5, -1]") + (
        '[animation.keys."camera.eye"]\ntimes = [0, 1]\nvalues = [[0, 1, 4], [1, 1, 4]]\n'
        '[animation.keys."camera.field_of_view"]\ntimes = []\nvalues = []\n'
    )
    problems = problems_of(text, tmp_path)
    assert [(problem.key, problem.line) for problem in problems] == [
        ("values[1]", LINE + 2), ("times", LINE + 7), ("values", LINE + 8),
    ]  # fmt: skip
    assert "must have at least 1 entry, found 0" in str(problems[1])


def test_a_mistake_between_keyframes_is_found_in_its_frame(tmp_path):
    """The eye passes through the target halfway."""
    path = tmp_path / "a.toml"
    path.write_text(keyed("camera.eye", "[0, 1]", "[[0, 0.5, 4], [0, 0.5, -4]]"))
    animation = Animation.load(path)
    assert animation.still(14).hash() != animation.still(16).hash()
    with pytest.raises(SceneError, match=r"a\.toml:5: \[camera\] target: at 0\.5 s: is the same point"):
        animation.still(15)
    assert animation.still(17).description["camera"]["eye"][2] < 0, "the next frame is right again"


def test_a_scene_without_an_animation_has_no_frames(scenes):
    with pytest.raises(SceneError, match=r"\[animation\]: is missing, so the scene has no frames"):
        Animation.load(scenes / "cornell.toml")


@pytest.mark.parametrize("key", ["camera.eye", "objects.cube.translate"])
def test_a_cut_is_not_smeared(key):
    """What is keyed in steps jumps between two frames, also beside something that moves."""
    values = "[[0, 1, 4], [3, 1, 4]]"
    text = shuttered(
        keyed(key, "[0, 0.33333333333]", values, 'interpolation = "step"\n')
        + '[animation.keys."camera.target"]\ntimes = [0, 1]\nvalues = [[0, 0.5, 0], [1, 0.5, 0]]\n'
        + '[animation.keys."objects.cube.rotate.degrees"]\ntimes = [0, 1]\nvalues = [0, 90]\n'
    )
    animation = animation_of(text)
    tables = animation._moving(animation.time(9), 1 / 30)
    assert tables["camera"]["moves_to"].keys() == {"target"}
    motion = tables["objects"]["cube"]["motion"]
    assert motion[-1]["rotate"]["degrees"] == pytest.approx(30.0)
    assert all(step.get("translate") == tables["objects"]["cube"].get("translate") for step in motion)
    before, after = animation.data(animation.time(9)), animation.data(animation.time(10))
    assert before != after and before["camera"]["target"] != after["camera"]["target"]
    group, *inner = key.split(".")
    for part in inner:
        before[group], after[group] = before[group][part], after[group][part]
    assert (before[group], after[group]) == ([0, 1, 4], [3, 1, 4])
    animation.still(9)


def test_the_turntable_turns(scenes):
    animation = Animation.load(scenes / "turntable.toml")
    assert {track.path[0] for track in animation.tracks} == {"camera", "objects", "materials"}
    hashes = {animation.still(frame).hash() for frame in (0, 12, 24, 36, 47)}
    assert len(hashes) == 5
