"""`illuminant render --frames`: every frame once, in files that are whole, and what happens to those that are there."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import illuminant
from illuminant import png
from illuminant.animation import Animation
from illuminant.errors import UsageError
from illuminant.frames import file_of, frame_numbers, render_frames
from illuminant.image import Image

Command = Callable[..., "subprocess.CompletedProcess[str]"]

MOVES = """
[animation]
frames = [0, 9]
frames_per_second = 10

[animation.keys."camera.eye"]
times = [0.0, 1.0]
values = [[0.0, 1.0, 4.0], [1.0, 1.0, 4.0]]

[animation.keys."materials.lamp.luminance_cd_m2"]
times = [0.0, 1.0]
values = [2000.0, 4000.0]
"""


@pytest.fixture
def moving(scene: Path) -> Path:
    """A small scene with ten frames."""
    scene.write_text(scene.read_text() + MOVES)
    return scene


def lines(done: "subprocess.CompletedProcess[str]") -> list[str]:
    assert done.returncode == 0, done.stderr
    return [line for line in done.stderr.splitlines() if not line.startswith("Warning: ")]


def test_frames_are_those_of_the_still_scenes(moving: Path, inside: Command) -> None:
    said = lines(inside("render", moving.name, "--frames", "0-8x4", "-o", "f.####.exr", cwd=moving.parent))
    assert [line.split(": ")[0] for line in said] == ["f.0000.exr", "f.0004.exr", "f.0008.exr", "3 frames"]
    animation = Animation.load(moving)
    for number in (0, 4, 8):
        found = Image.open(moving.parent / f"f.{number:04d}.exr")
        still = illuminant.render(animation.still(number))
        np.testing.assert_array_equal(found.xyz, still.xyz.astype(np.float32))
        assert found.settings["frame"] == number
        assert found.settings["scene_hash"] == still.settings["scene_hash"]
    assert not [path for path in moving.parent.iterdir() if path.name.startswith(".")]


def test_without_an_output_frames_are_named_by_the_scene(moving: Path, inside: Command) -> None:
    assert inside("render", moving.name, "--frames", "3,5", "--samples", 1, cwd=moving.parent).returncode == 0
    assert sorted(path.name for path in moving.parent.glob("*.png")) == ["ball.0003.png", "ball.0005.png"]


def test_finished_frames_are_passed_over_and_the_others_made(moving: Path, inside: Command) -> None:
    words = ["render", moving.name, "--frames", "0-2", "-o", "f.####.png", "-o", "f.####.exr"]
    lines(inside(*words, cwd=moving.parent))
    files = sorted(moving.parent.glob("f.*"))
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in files}
    assert len(files) == 6
    said = lines(inside(*words, cwd=moving.parent))
    assert all(line.endswith("finished before") for line in said[:3])
    assert said[-1].startswith("3 frames: 0 rendered, 3 finished before")
    assert all(path.stat().st_mtime_ns == stamp for path, (_, stamp) in before.items())

    (moving.parent / "f.0000.png").unlink()
    broken = moving.parent / "f.0001.exr"
    broken.write_bytes(broken.read_bytes()[:-100])
    facts = json.loads(inside(*words, "--json", cwd=moving.parent).stdout)
    assert [(one["frame"], one["skipped"]) for one in facts] == [(0, False), (1, False), (2, True)]
    assert {path: path.read_bytes() for path in files} == {
        path: content for path, (content, _) in before.items()
    }

    facts = json.loads(inside(*words, "--json", "--again", cwd=moving.parent).stdout)
    assert [one["skipped"] for one in facts] == [False, False, False]


def test_the_way_to_the_scene_makes_no_frame_anew(moving: Path, inside: Command) -> None:
    words = ["--frames", "1", "-o", "f.####.png", "-o", "f.####.exr", "--samples", "1", "--json"]
    for scene, skipped in ((moving.name, False), (f"./{moving.name}", True), (moving, True)):
        done = inside("render", scene, *words, cwd=moving.parent)
        assert json.loads(done.stdout)[0]["skipped"] is skipped, done.stderr


@pytest.mark.parametrize(
    ("more", "skipped"),
    [
        (["--threads", "1"], True),
        (["--samples", "2"], False),
        (["--seed", "5"], False),
        (["--technique", "raytrace"], False),
        (["--size", "16x12"], False),
        (["--layers", "depth"], False),
        (["--half"], False),
        (["--rgb", "sRGB"], False),
        (["--time", "0.1s"], False),
    ],
)
def test_a_frame_made_with_other_options_is_made_anew(
    moving: Path, inside: Command, more: list[str], skipped: bool
) -> None:
    words = ["render", moving.name, "--frames", "4", "-o", "f.exr", "--json", "--samples", "1"]
    assert not json.loads(inside(*words, cwd=moving.parent).stdout)[0]["skipped"]
    for expected in (skipped, True):
        assert json.loads(inside(*words, *more, cwd=moving.parent).stdout)[0]["skipped"] is expected


@pytest.mark.parametrize(
    "more", [["--exposure", "0.001"], ["--tone", "reinhard"], ["--bits", "6"], ["--display", "Display P3"]]
)
def test_a_picture_shown_otherwise_is_made_anew(moving: Path, inside: Command, more: list[str]) -> None:
    words = ["render", moving.name, "--frames", "4", "-o", "f.png", "--json", "--samples", "1"]
    assert not json.loads(inside(*words, cwd=moving.parent).stdout)[0]["skipped"]
    assert [json.loads(inside(*words, *more, cwd=moving.parent).stdout)[0]["skipped"] for _ in range(2)] == [
        False,
        True,
    ]


def test_a_changed_scene_makes_anew_only_the_frames_that_changed(moving: Path, inside: Command) -> None:
    words = ["render", moving.name, "--frames", "0,5,9", "--samples", "1", "--json"]
    inside(*words, cwd=moving.parent)
    text = moving.read_text()
    moving.write_text(
        text.replace("frames_per_second = 10", 'frames_per_second = 10\ninterpolation = "smooth"')
    )
    facts = json.loads(inside(*words, cwd=moving.parent).stdout)
    # In the middle a smooth curve is where the line is, and so it is at its ends.
    assert [one["skipped"] for one in facts] == [True, True, False]
    moving.write_text(text.replace("radius = 0.5", "radius = 0.4"))
    assert not any(one["skipped"] for one in json.loads(inside(*words, cwd=moving.parent).stdout))


def test_all_pictures_have_one_exposure_also_in_a_later_run(moving: Path, inside: Command) -> None:
    said = lines(inside("render", moving.name, "--frames", "9,4", "--samples", "1", cwd=moving.parent))
    exposures = [png.read_header(moving.parent / f"ball.000{n}.png").text["Exposure"] for n in (4, 9)]
    assert exposures[0] == exposures[1]
    assert f"All pictures have one exposure; --exposure {float(exposures[0]):g} repeats it." in said
    lines(inside("render", moving.name, "--frames", "all", "--samples", "1", cwd=moving.parent))
    found = {png.read_header(path).text["Exposure"] for path in moving.parent.glob("*.png")}
    assert found == {exposures[0]}


def exposures(folder: Path) -> dict[str, str]:
    return {path.name: png.read_header(path).text["Exposure"] for path in sorted(folder.glob("f.*.png"))}


def test_parts_of_a_sequence_and_frames_made_again_have_its_exposure(moving: Path, inside: Command) -> None:
    words = ("render", moving.name, "-o", "f.####.png", "--frames")
    lines(inside(*words, "1-2", cwd=moving.parent))
    lines(inside(*words, "8", cwd=moving.parent))
    lines(inside(*words, "8,9", "--again", cwd=moving.parent))
    found = exposures(moving.parent)
    assert len(found) == 4 and len(set(found.values())) == 1
    assert lines(inside(*words, "1-2,8-9", cwd=moving.parent))[-1].startswith(
        "4 frames: 0 rendered, 4 finished"
    )


def test_a_black_frame_says_nothing_of_the_exposure_of_others(moving: Path, inside: Command) -> None:
    # With depth 1 only lamps are seen, and the first frame looks past the one that there is.
    up = '[animation.keys."camera.target"]\ntimes = [0.0, 0.1]\nvalues = [[0.0, 0.5, 0.0], [0.0, 2.5, 0.0]]\n'
    moving.write_text(moving.read_text() + up)
    words = ("render", moving.name, "-o", "f.####.png", "--depth", "1", "--frames")
    lines(inside(*words, "0-1", cwd=moving.parent))
    found = exposures(moving.parent)
    assert not Image.open(moving.parent / "f.0000.png").xyz.any()
    alone = Animation.load(moving).still(1)
    assert float(found["f.0001.png"]) == illuminant.render(alone, depth=1).auto_exposure()
    assert lines(inside(*words, "0-1", cwd=moving.parent))[-1].startswith("2 frames: 0 rendered, 2 finished")


def test_more_samples_may_be_wanted_of_frames_that_end_by_their_error(moving: Path, inside: Command) -> None:
    words = ("render", moving.name, "-o", "f.####.exr", "--frames", "4", "--error", "0.01%", "--samples")
    for samples, made in ((4, "1 rendered"), (4, "1 finished before"), (16, "1 rendered")):
        assert made in lines(inside(*words, samples, cwd=moving.parent))[-1]
    assert Image.open(moving.parent / "f.0004.exr").settings["samples"] == 16


def test_the_command_in_the_header_makes_a_frame_again(moving: Path, inside: Command) -> None:
    lines(inside("render", moving.name, "--frames", "2-3", cwd=moving.parent))
    words = json.loads(inside("info", "ball.0003.png", "--json", cwd=moving.parent).stdout)["remake"].split()
    assert words[words.index("--frames") + 1] == "3"
    words[words.index("ball.0003.png")] = "b.png"
    lines(inside(*words[1:], cwd=moving.parent))
    assert (moving.parent / "ball.0003.png").read_bytes() == (moving.parent / "b.png").read_bytes()


# --- fields --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", ["odd-first", "even-first"])
def test_a_frame_of_fields_has_the_lines_of_two_moments(moving: Path, inside: Command, order: str) -> None:
    text = moving.read_text().replace("frames = [0, 9]", f'frames = [0, 9]\nfields = "{order}"')
    moving.write_text(text)
    out = ["-o", "f.####.exr", "--layers", "depth"]
    lines(inside("render", moving.name, "--frames", "2", *out, cwd=moving.parent))
    frame = Image.open(moving.parent / "f.0002.exr")
    # A scene at twice the rate has the two fields as frames 4 and 5.
    double = text.replace("frames_per_second = 10", "frames_per_second = 20").replace(
        f'[0, 9]\nfields = "{order}"', "[0, 9]"
    )
    moving.with_name("double.toml").write_text(double)
    lines(inside("render", "double.toml", "--frames", "4,5", *out, cwd=moving.parent))
    fields = [Image.open(moving.parent / f"f.000{number}.exr") for number in (4, 5)]
    odd, even = fields if order == "odd-first" else fields[::-1]
    np.testing.assert_array_equal(frame.xyz[0::2], odd.xyz[0::2])
    np.testing.assert_array_equal(frame.xyz[1::2], even.xyz[1::2])
    np.testing.assert_array_equal(frame.layers["depth"][1::2], even.layers["depth"][1::2])
    assert not np.array_equal(odd.xyz, even.xyz)
    facts = json.loads(
        inside("render", moving.name, "--frames", "2", *out, "--json", cwd=moving.parent).stdout
    )
    assert facts[0]["skipped"] and facts[0]["time_s"] == 0.2
    swapped = "even-first" if order == "odd-first" else "odd-first"
    moving.write_text(text.replace(order, swapped))
    facts = json.loads(
        inside("render", moving.name, "--frames", "2", *out, "--json", cwd=moving.parent).stdout
    )
    assert not facts[0]["skipped"]


# --- what is known already -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("technique", ["path", "radiosity"])
def test_frames_in_which_only_the_camera_moves_share_the_ray_structure_and_change_no_bit(
    moving: Path, technique: str
) -> None:
    text = moving.read_text()
    moving.write_text(text[: text.index('[animation.keys."materials')])
    animation = Animation.load(moving)
    options = {"technique": technique, "elements": 60, "form_factors": "rays:64", "samples": 4}
    made = list(render_frames(animation, "1-3", moving.parent / "f.####.exr", **options))
    assert len({id(frame.jobs[0].scene._geometry) for frame in made}) == 1
    for frame in made:
        alone = illuminant.render(animation.still(frame.number), **options)
        assert frame.image is not None
        np.testing.assert_array_equal(frame.image.xyz, alone.xyz)


# --- being stopped, and mistakes -----------------------------------------------------------------------------------


def test_ctrl_c_leaves_whole_frames_only_and_the_same_command_goes_on(moving: Path) -> None:
    words = [
        sys.executable,
        "-m",
        "illuminant",
        "render",
        moving.name,
        "--frames",
        "all",
        "--size",
        "160x120",
    ]
    words += ["--samples", "48", "-o", "f.####.exr"]
    work = subprocess.Popen(words, cwd=moving.parent, stderr=subprocess.PIPE, text=True)
    first = moving.parent / "f.0001.exr"
    end = time.monotonic() + 120
    while not first.exists() and time.monotonic() < end:
        time.sleep(0.05)
    time.sleep(0.1)
    work.send_signal(signal.SIGINT)
    _, said = work.communicate(timeout=60)
    assert work.returncode == 130, said
    there = sorted(path.name for path in moving.parent.glob("f.*"))
    assert 2 <= len(there) < 10
    assert not [path for path in moving.parent.iterdir() if path.name.startswith(".")]
    assert "frames are there. The same command goes on." in said
    for name in there:
        assert Image.open(moving.parent / name).settings["samples"] == 48
    stamps = {name: (moving.parent / name).stat().st_mtime_ns for name in there}
    words[words.index("all")] = f"0-{len(there)}"
    done = subprocess.run([*words, "--json"], cwd=moving.parent, capture_output=True, text=True, timeout=120)
    assert [one["skipped"] for one in json.loads(done.stdout)] == [True] * len(there) + [False]
    assert {name: (moving.parent / name).stat().st_mtime_ns for name in there} == stamps


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--frames", "0-10"], "--frames 0-10: the animation has the frames 0 to 9."),
        (["--frames", "5-2"], "--frames 5-2: 5 is after 2."),
        (["--frames", "x"], "--frames x: expected all, or frames such as 12, 1-48, 1-48x2 or 5,7,9."),
        (["--frames", ""], "--frames : expected all"),
        (["--frames", "1-3x0"], "expected all"),
        (["--frames", "0-3", "-o", "a.png"], "a.png is one name for 4 frames: write ####"),
        (["--frames", "0-3", "-o", "no/a.####.png"], "there is no folder no"),
        (["--frames", "0-3", "-o", "a.####.gif"], "an image is saved as .exr"),
        (["--again"], "--again: goes with --frames"),
        (["--frames", "0-1", "--pixel", "1,1"], "--pixel 1,1: goes with --frames for one frame, not 2."),
    ],
)
def test_mistakes_of_the_command(moving: Path, inside: Command, words: list[str], says: str) -> None:
    done = inside("render", moving.name, *words, cwd=moving.parent)
    assert done.returncode == 2 and says in done.stderr, done.stderr
    assert sorted(path.name for path in moving.parent.iterdir()) == ["ball.toml"]


def test_a_scene_without_an_animation_is_refused(scene: Path, inside: Command) -> None:
    done = inside("render", scene, "--frames", "all")
    assert done.returncode == 2 and "[animation]: is missing, so the scene has no frames" in done.stderr


def test_fields_keep_no_spectra(moving: Path) -> None:
    moving.write_text(moving.read_text().replace("[0, 9]", '[0, 9]\nfields = "odd-first"', 1))
    with pytest.raises(UsageError, match="--keep-spectra: the two fields"):
        next(render_frames(moving, "0", keep_spectra=True))


def test_numbers_and_names() -> None:
    assert frame_numbers("all", 3, 5) == [3, 4, 5]
    assert frame_numbers("allx2", 3, 8) == [3, 5, 7]
    assert frame_numbers("8, 3-5", 3, 8) == [3, 4, 5, 8]
    assert [str(file_of(name, 7)) for name in ("a.#.png", "#/a.##.png", "{frame}.exr", "a.png")] == [
        "a.7.png",
        "#/a.07.png",
        "0007.exr",
        "a.png",
    ]


def test_info_knows_the_frame(moving: Path, inside: Command) -> None:
    lines(
        inside(
            "render", moving.name, "--frames", "3", "-o", "f.####.png", "--samples", "1", cwd=moving.parent
        )
    )
    told = inside("info", "f.0003.png", "--scene", moving.name, cwd=moving.parent)
    assert (told.returncode, "made from it as it is now" in told.stdout) == (0, True)
    moving.write_text(moving.read_text().replace("4000.0", "5000.0"))
    assert inside("info", "f.0003.png", "--scene", moving.name, cwd=moving.parent).returncode == 1


@pytest.mark.parametrize("size", [[float("inf"), 4], [2**40, 2**40], [0, 4], ["8", 4], [8]])
def test_a_size_in_a_header_that_cannot_be(scene: Path, size: list[float]) -> None:
    from illuminant.info import same_scene

    assert not same_scene({"scene_hash": "0" * 64, "size": size}, scene)
