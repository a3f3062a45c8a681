"""`illuminant render`: from a scene file to an image, and every way in which that can end."""

import contextlib
import json
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant import png
from illuminant.image import Image

Command = Callable[..., "subprocess.CompletedProcess[str]"]
PROGRAM = str(Path(sys.executable).with_name("illuminant"))


def test_one_scene_two_files_and_a_closing_line(scene: Path, command: Command) -> None:
    done = command("render", scene.name, "-o", "a.exr", "-o", "a.png", cwd=scene.parent)
    assert (done.returncode, done.stdout) == (0, "")
    closing, exposure = [line for line in done.stderr.splitlines() if not line.startswith("Warning: ")][:2]
    assert re.fullmatch(
        r"a\.exr, a\.png: [\d.]+ s, 8 samples per pixel, \S+ Msamples/s, \S+ Mrays/s, [\d.]+ [MG]B, "
        r"spectral ΔE00 \S+ \(max \S+\), 0 dropped",
        closing,
    )
    assert re.fullmatch(r"White, \S+ cd/m2, is shown as 0\.8; --exposure \S+ repeats it\.", exposure)
    image = Image.open(scene.parent / "a.exr")
    assert (image.width, image.height, image.unit) == (32, 24, "cd/m2")
    assert image.settings["scene"] == "ball.toml" and image.settings["samples"] == 8
    assert 1 < image.xyz[..., 1].mean() < 2000
    assert png.read_header(scene.parent / "a.png").settings == image.settings


def test_without_an_output_the_picture_is_named_by_the_scene(scene: Path, inside: Command) -> None:
    assert inside("render", scene.name, "--samples", 1, cwd=scene.parent).returncode == 0
    assert sorted(path.name for path in scene.parent.iterdir()) == ["ball.png", "ball.toml"]


def test_the_exposure_and_the_command_in_the_header_repeat_the_picture(scene: Path, inside: Command) -> None:
    first = inside("render", scene.name, "-o", "a.png", "--json", cwd=scene.parent)
    facts = json.loads(first.stdout)
    words = json.loads(inside("info", "a.png", "--json", cwd=scene.parent).stdout)["remake"].split()
    words[words.index("a.png")] = "b.png"
    assert inside(*words[1:], "--threads", "1", cwd=scene.parent).returncode == 0
    assert (scene.parent / "a.png").read_bytes() == (scene.parent / "b.png").read_bytes()
    assert png.read_header(scene.parent / "b.png").text["Exposure"] == f"{facts['exposure']:g}"


def test_json_goes_to_stdout_and_says_everything(scene: Path, inside: Command) -> None:
    done = inside("render", scene, "-o", scene.with_suffix(".png"), "--json")
    facts = json.loads(done.stdout)
    assert facts["files"] == [str(scene.with_suffix(".png"))]
    assert facts["complete"] is True and facts["samples"] == 32 * 24 * 8 and facts["samples_per_pixel"] == 8
    assert {"mean", "p95", "max"} <= set(facts["spectral_error"])
    assert facts["seconds"] > 0 and facts["mrays_per_second"] > 0 and facts["peak_memory"] > 1e6


def test_layers_lamps_and_lanes_are_channels(scene: Path, inside: Command) -> None:
    done = inside(
        "render", scene, "-o", scene.with_suffix(".exr"), "--layers", "depth,normal,albedo,samples", "--lamps",
        "--keep-spectra", "--sampling", "uniform:8", "--size", "16x12",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    image = Image.open(scene.with_suffix(".exr"))
    assert {"depth", "normal", "albedo", "samples", "spectra"} <= set(image.layers)
    lamps = [layer for name, layer in image.layers.items() if name.startswith("lamp:")]
    np.testing.assert_allclose(sum(lamps), image.xyz, rtol=1e-4, atol=1e-4)
    assert image.wavelengths_nm is not None and len(image.wavelengths_nm) == 8
    np.testing.assert_allclose(image.layers["spectra"] @ image.to_xyz.T, image.xyz, rtol=1e-4, atol=1e-4)
    assert set(np.unique(image.layers["samples"])) == {8.0}
    hit = np.linalg.norm(image.layers["normal"], axis=2)[6, 8]
    assert hit == pytest.approx(1.0, abs=0.05)


def test_the_exposure_of_the_scene_is_used_unless_an_option_gives_another(
    scene: Path, inside: Command
) -> None:
    scene.write_text(scene.read_text().replace("[render]", "[render]\nexposure = 0.004"))
    path = scene.with_suffix(".png")
    done = inside("render", scene, "-o", path, "--json")
    assert json.loads(done.stdout)["exposure"] == 0.004
    assert "repeats it" not in inside("render", scene, "-o", path).stderr
    assert (
        json.loads(inside("render", scene, "-o", path, "--exposure", 0.01, "--json").stdout)["exposure"]
        == 0.01
    )


def test_the_same_command_writes_the_same_bytes(scene: Path, inside: Command) -> None:
    def written(*options: object) -> list[bytes]:
        paths = [scene.with_name(name) for name in ("a.exr", "a.png")]
        done = inside("render", scene, "-o", paths[0], "-o", paths[1], "--layers", "depth,samples", *options)
        assert done.returncode == 0, done.stderr
        return [path.read_bytes() for path in paths]

    first = written()
    assert written() == first
    assert written("--threads", 1) == first
    assert written("--threads", 2) == first
    assert all(a != b for a, b in zip(written("--seed", 1), first, strict=True))


def test_dropped_samples_come_with_the_command_that_follows_them(scene: Path, inside: Command) -> None:
    text = scene.read_text().replace("luminance_cd_m2 = 2000.0", "radiance_scale = 1e38")
    scene.write_text(text.replace('spectrum = "A"', "spectrum = 1.0"))
    words = ("--samples", 2, "--seed", 3, "--size", "16x12", "--depth", 2)
    done = inside("render", scene.name, "-o", "a.png", *words, "--json", cwd=scene.parent)
    assert done.returncode == 0
    facts = json.loads(done.stdout)
    item = facts["dropped_samples"][0]
    (x, y), k = item["pixel"], item["sample"]
    assert item["object"] in ("ball", "floor", "lamp") and item["material"] in ("grey", "lamp")
    again = f"illuminant render ball.toml --samples 2 --size 16x12 --depth 2 --seed 3 --pixel {x},{y} --sample {k}"
    assert item["again"] == again
    lines = [line for line in done.stderr.splitlines() if line.startswith("Warning: Sample")]
    assert len(lines) == min(3, facts["dropped"])
    assert lines[0] == (
        f"Warning: Sample {k} of pixel {x},{y} is no radiance and was dropped "
        f"(object {item['object']}, material {item['material']}); to follow it again: {again}"
    )
    assert f"Warning: {facts['dropped']:,} samples were dropped in all" in done.stderr
    followed = inside(*again.split()[1:], cwd=scene.parent)
    assert followed.returncode == 0
    assert followed.stdout.splitlines()[-1].startswith("XYZ  (") and "inf" in followed.stdout


def test_layers_in_a_png_are_warned_of(scene: Path, inside: Command) -> None:
    done = inside("render", scene, "-o", scene.with_suffix(".png"), "--layers", "depth", "--samples", 1)
    assert "Warning: A PNG holds no layers: add -o FILE.exr to keep them.\n" in done.stderr


def test_time_ends_the_work(scene: Path, inside: Command) -> None:
    done = inside("render", scene, "-o", scene.with_suffix(".png"), "--time", "1s", "--json")
    facts = json.loads(done.stdout)
    assert done.returncode == 0 and facts["complete"]
    assert 0.4 < facts["seconds"] < 1.5
    assert facts["samples_per_pixel"] == facts["settings"]["samples"] > 8


def test_error_ends_the_work_at_that_error(scene: Path, inside: Command) -> None:
    path = scene.with_suffix(".exr")
    done = inside("render", scene, "-o", path, "--error", "5%", "--json")
    samples = json.loads(done.stdout)["settings"]["samples"]
    assert done.returncode == 0 and samples >= 64
    reference = scene.with_name("reference.exr")
    assert inside("render", scene, "-o", reference, "--samples", samples * 64, "--seed", 7).returncode == 0
    truth = Image.open(reference).xyz[..., 1]
    error = np.abs(Image.open(path).xyz[..., 1] - truth) / np.maximum(truth, truth.mean())
    # 95 % of the pixels have a standard error below 5 %, so at most one in ten is off by more than 2 × 5 %.
    assert (error < 0.1).mean() > 0.9


def test_one_path_is_followed_again(scene: Path, inside: Command) -> None:
    done = inside("render", scene, "--pixel", "16,12", "--sample", 3, "--json")
    path = json.loads(done.stdout)
    assert done.returncode == 0 and path["passes"][0][0]["object"] == "ball"
    shown = inside("render", scene, "--pixel", "16,12", "--sample", 3).stdout
    assert shown.startswith("  0  ball (grey) at (") and "XYZ  (" in shown
    assert [path.name for path in scene.parent.iterdir()] == ["ball.toml"]
    done = inside("render", scene, "--pixel", "32,0")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "--pixel 32,0: the pixels of this image run from 0,0 to 31,23." in done.stderr


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["none.toml"], "none.toml"),
        (["ball.toml", "-o", "none/a.png"], "there is no folder none."),
        (["ball.toml", "-o", "."], "it is a folder"),
        (["ball.toml", "-o", "a.jpg"], "saved as .exr"),
        (["ball.toml", "--size", "1000000000x1000000000"], "that is 1e+18 pixels"),
        (["ball.toml", "--samples", "0"], "--samples 0: expected a whole number"),
        (["ball.toml", "--exposure", "-1"], "--exposure -1: expected a positive number."),
        (["ball.toml", "--rgb", "CMYK"], "no RGB system 'CMYK'"),
        (["ball.toml", "--bits", "17"], "1 to 16 bits"),
        (["ball.toml", "--display", "CRT"], "There is no display 'CRT': known are sRGB"),
        (["ball.toml", "--gamut", "squash"], "There is no gamut method 'squash'"),
        (["ball.toml", "--dither", "salt"], "There is no dither 'salt'"),
        (["ball.toml", "--tone", "loud"], "There is no tone operator 'loud'"),
        (["ball.toml", "--sampling", "uniform:99"], "99"),
        (["ball.toml", "--sampling", "rainbow"], "rainbow"),
        (["ball.toml", "--technique", "magic"], "magic"),
        (["ball.toml", "--illumination", "candle"], "candle"),
    ],
)
def test_wrong_input_is_one_sentence_before_the_work(
    scene: Path, inside: Command, arguments: list[str], sentence: str
) -> None:
    done = inside("render", *arguments, cwd=scene.parent)
    assert done.returncode == 2
    assert sentence in done.stderr and done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1
    assert [path.name for path in scene.parent.iterdir()] == ["ball.toml"]


def test_all_mistakes_of_a_scene_are_errors_with_their_lines(scene: Path, inside: Command) -> None:
    scene.write_text(scene.read_text().replace("eye =", "eyes =").replace('"diffuse"', '"difuse"'))
    done = inside("render", scene.name, cwd=scene.parent)
    assert done.returncode == 2
    assert all(line.startswith("Error: ball.toml:") for line in done.stderr.splitlines())
    assert done.stderr.count("\n") >= 2


def test_half_floats_give_way_to_a_bright_lamp(scene: Path, inside: Command) -> None:
    scene.write_text(scene.read_text().replace("2000.0", "2.0e7"))
    done = inside("render", scene, "-o", scene.with_suffix(".exr"), "--half")
    assert done.returncode == 0
    assert "ball.exr has 32-bit floats, since a value of this image is above 65504." in done.stderr


def test_an_output_lost_during_the_work_is_kept_elsewhere(
    scene: Path, inside: Command, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    import shutil

    from illuminant.job import Job

    folder, spare = scene.parent / "out", tmp_path_factory.mktemp("spare")
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(spare))
    warnings = Job.warnings
    monkeypatch.setattr(Job, "warnings", lambda job: [shutil.rmtree(folder), warnings(job)][1])
    done = inside("render", scene, "-o", folder / "a.png")
    assert done.returncode == 2
    kept = next(spare.rglob("a.png"))
    assert done.stderr.endswith(f"there is no folder {folder}; the image is kept as {kept}.\n")


def wait_for_work(process: "subprocess.Popen[str]") -> None:
    """Until the process has computed for a while (its threads have used more than a second)."""
    began = time.monotonic()
    while process.poll() is None and time.monotonic() - began < 30:
        fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
        if (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK") > 2.0:
            return
        time.sleep(0.05)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_writes_what_is_done(scene: Path, number: signal.Signals) -> None:
    path = scene.with_suffix(".exr")
    process = subprocess.Popen(
        [PROGRAM, "render", str(scene), "-o", str(path), "--samples", "100000000", "--layers", "samples"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    wait_for_work(process)
    began = time.monotonic()
    process.send_signal(number)
    _, err = process.communicate(timeout=30)
    assert time.monotonic() - began < 5
    assert process.returncode == 130
    assert re.search(
        r"Interrupted: every pixel holds \d+ samples( or more, \S+ on average)?; the image so far", err
    )
    image = Image.open(path)
    assert image.xyz.min() >= 0 and image.layers["samples"].min() >= 1
    assert sorted(item.name for item in scene.parent.iterdir()) == ["ball.exr", "ball.toml"]


def test_a_crop_is_a_part_of_the_image(scene: Path, inside: Command) -> None:
    inside("render", scene, "-o", scene.with_name("whole.exr"))
    scene.write_text(scene.read_text().replace("[render]", "crop = [10, 5, 20, 15]\n\n[render]"))
    assert inside("render", scene, "-o", scene.with_name("part.exr")).returncode == 0
    whole, part = Image.open(scene.with_name("whole.exr")), Image.open(scene.with_name("part.exr"))
    assert np.array_equal(part.xyz, whole.xyz[5:15, 10:20])
    assert (part.settings["size"], part.settings["crop"]) == ([32, 24], [10, 5, 20, 15])
    done = inside("render", scene, "--size", "16x12")
    assert done.stderr == "Error: --size 16x12: the scene's crop ends at 20,15, outside this image.\n"
    assert "from 10,5 to 19,14." in inside("render", scene, "--pixel", "1,1").stderr


def test_ctrl_c_before_the_work_writes_nothing(
    scene: Path, inside: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    from illuminant import job

    class Swallowing(job.Job):
        """A library that is imported while the scene is read may catch whatever is raised."""

        def __init__(self, *arguments: object, **options: object) -> None:
            with contextlib.suppress(BaseException):
                signal.raise_signal(signal.SIGINT)
            super().__init__(*arguments, **options)

    monkeypatch.setattr(job, "Job", Swallowing)
    done = inside("render", scene, "-o", scene.with_suffix(".png"))
    assert (done.returncode, done.stderr) == (130, "Interrupted: nothing was written.\n")
    assert [item.name for item in scene.parent.iterdir()] == ["ball.toml"]


def test_progress_shows_only_on_a_terminal(scene: Path, inside: Command) -> None:
    arguments = ["render", str(scene), "-o", str(scene.with_suffix(".png")), "--time", "0.7s"]
    assert "\x1b" not in inside(*arguments).stderr
    child, terminal = pty.fork()
    if child == 0:
        os.execv(PROGRAM, [PROGRAM, *arguments])
    shown = b""
    while select.select([terminal], [], [], 30)[0]:
        try:
            part = os.read(terminal, 4096)
        except OSError:
            break
        if not part:
            break
        shown += part
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    text = shown.decode()
    assert "Msamples/s" in text and " left" in text and "ball.toml" in text
    assert "0:00 left" in text.splitlines()[-3] or "is shown as 0.8" in text


def test_python_renders_the_same_bits(scene: Path, inside: Command) -> None:
    import illuminant

    partial: list[int] = []
    image = illuminant.render(
        scene, samples=20, on_partial=lambda image: partial.append(image.settings["samples"]), threads=1
    )
    assert partial == [1, 4, 16, 20]
    assert image.statistics["samples_per_pixel"] == 20
    inside("render", scene, "-o", scene.with_suffix(".exr"), "--samples", 20)
    assert np.array_equal(Image.open(scene.with_suffix(".exr")).xyz, image.xyz.astype(np.float32))


def test_a_render_can_be_watched_and_stopped_from_python(scene: Path) -> None:
    from illuminant.rendering import progressive, render

    seen: list[float] = []
    image = render(scene, samples=10**6, progress=lambda now: seen.append(now.samples) or len(seen) < 3)
    assert len(seen) == 3 and 0 < image.statistics["samples_per_pixel"] < 10**6
    images = list(progressive(scene, samples=64))
    assert [item.settings["samples"] for item in images] == [1, 4, 16, 64]
    assert not np.array_equal(images[0].xyz, images[1].xyz)


def test_ctrl_c_in_python_raises_with_the_image(scene: Path) -> None:
    from illuminant.rendering import RenderInterrupted, render

    # A shell that starts the tests in the background has them ignore Ctrl-C.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def interrupt(now: object) -> None:
        signal.raise_signal(signal.SIGINT)

    try:
        with pytest.raises(RenderInterrupted, match=r"(every pixel holds|some pixels hold)") as caught:
            render(scene, samples=10**6, progress=interrupt)
    finally:
        signal.signal(signal.SIGINT, before)
    assert isinstance(caught.value.image, Image)


@pytest.mark.parametrize(
    "options",
    [
        [
            "--samples",
            "4",
            "--sampler",
            "jittered",
            "--caustics",
            "--layers",
            "depth,normal",
            "--keep-spectra",
        ],
        [
            "--technique",
            "phong",
            "--illumination",
            "blinn",
            "--shadows",
            "rays",
            "--layers",
            "terms",
            "--half",
        ],
        ["--technique", "raytrace", "--illumination", "hall", "--threshold", "0.01", "--cones"],
        ["--technique", "radiosity", "--elements", "80", "--form-factors", "rays:32", "--gather", "direct"],
        ["--technique", "hybrid", "--elements", "60", "--form-factors", "rays:32", "--mechanisms", "dd,sd"],
        [
            "--error",
            "20%",
            "--samples",
            "128",
            "--filter",
            "mitchell:2",
            "--depth",
            "3",
            "--seed",
            "5",
            "--lamps",
        ],
    ],
    ids=lambda options: "-".join(options[:2]),
)
def test_the_command_in_the_header_makes_the_image_again(scene, inside, options):
    import shlex

    from illuminant.image import Image

    assert inside("render", scene, "-o", scene.parent / "a.exr", "--samples", "2", *options).returncode == 0
    said = json.loads(inside("info", scene.parent / "a.exr", "--json").stdout)
    program, *words = shlex.split(said["remake"])
    words[words.index("-o") + 1] = str(scene.parent / "b.exr")
    assert program == "illuminant"
    assert inside(*words).returncode == 0
    one, other = (Image.open(scene.parent / name) for name in ("a.exr", "b.exr"))
    assert one.xyz.tobytes() == other.xyz.tobytes()
    assert one.layers.keys() == other.layers.keys()
    assert one.settings == other.settings


def test_info_tells_whether_the_scene_has_changed(scene, inside):
    assert (
        inside("render", scene, "-o", scene.parent / "a.png", "--samples", "1", "--size", "8x6").returncode
        == 0
    )
    same = inside("info", scene.parent / "a.png", "--scene", scene)
    assert (same.returncode, "was made from it as it is now" in same.stdout) == (0, True)
    scene.write_text(scene.read_text().replace("radius = 0.5", "radius = 0.4"))
    changed = inside("info", scene.parent / "a.png", "--scene", scene)
    assert (changed.returncode, "NOT made from it" in changed.stdout) == (1, True)
    assert inside("info", "--scene", scene).returncode == 2
