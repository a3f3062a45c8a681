"""`illuminant new`, `check` and `info`: all that needs no rendering."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from illuminant.cli import run

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def test_a_scene_without_mistakes(scene: Path, command: Command) -> None:
    done = command("check", scene)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{scene}: no mistakes\n", "")


def test_all_mistakes_are_reported_at_once(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene.write_text(
        scene.read_text().replace("eye =", "eyes =").replace('spectrum = "A"', 'spectrum = "AA"')
    )
    assert run(["check", str(scene)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) >= 2
    assert any(line.startswith(f"{scene}:4: [camera] eyes: ") and "eye" in line for line in lines)
    assert any("[materials.lamp] spectrum: " in line for line in lines)
    assert run(["check", str(scene), "--json"]) == 1
    assert len(json.loads(capsys.readouterr().out)) == len(lines)


def test_a_missing_file_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "none.toml"
    assert run(["check", str(path)]) == 2
    assert capsys.readouterr().err == f"Error: {path}: there is no such file.\n"


def test_check_needs_a_scene_or_prints_the_schema(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check"]) == 2
    assert "Name a scene file" in capsys.readouterr().err
    assert run(["check", "--schema"]) == 0
    assert "field_of_view" in capsys.readouterr().out


def test_new_writes_a_scene_that_has_no_mistakes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "room.toml"
    assert run(["new", str(path)]) == 0
    assert (
        capsys.readouterr().err == f"{path} is written; make an image of it with: illuminant render {path}\n"
    )
    assert run(["check", str(path)]) == 0


def test_new_never_overwrites(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = scene.read_text()
    assert run(["new", str(scene)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert scene.read_text() == before
    assert run(["new", str(scene.with_suffix(".png"))]) == 2
    assert "ends with .toml" in capsys.readouterr().err


def test_info_says_what_was_found(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["info"]) == 0
    out = capsys.readouterr().out
    for word in ("illuminant", "Embree          4.", "x86-64-v3 found", "usable", "free of", "openimageio"):
        assert word in out


def test_info_says_what_to_do_about_what_was_not_found(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from illuminant import core, embree

    monkeypatch.setenv(embree.VARIABLE, "/none/libembree4.so")
    core.embree.cache_clear()
    try:
        assert run(["info"]) == 0
    finally:
        core.embree.cache_clear()
    out = capsys.readouterr().out
    assert "Embree          not found\n                -> ILLUMINANT_EMBREE names /none/libembree4.so" in out


def test_info_of_what_is_no_image(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["info", str(scene)]) == 2
    assert capsys.readouterr().err == f"Error: {scene} cannot be read: only .exr, .png and .rle are.\n"


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["frob"], "No such command 'frob' (see `illuminant --help`)."),
        (["render"], "Missing argument 'SCENE' (see `illuminant render --help`)."),
        (["render", "a.toml", "--smples", "3"], "No such option: --smples"),
    ],
)
def test_a_wrong_command_line_is_one_sentence(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"Error: {sentence}") and captured.err.count("\n") == 1


@pytest.mark.parametrize("verb", ["new", "check", "render", "farm", "farm render", "diff", "info", "view"])
def test_every_help_has_an_example_and_fits_80_columns(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*verb.split(), "--help"]) == 0
    out = capsys.readouterr().out
    assert f"illuminant {verb} " in out.split("Example")[1]
    assert max(map(len, out.splitlines())) <= 80


def test_debug_shows_the_traceback(tmp_path: Path, command: Command, inside: Command) -> None:
    done = command("render", tmp_path / "none.toml", "--debug")
    assert done.returncode != 0 and "Traceback" in done.stderr
    done = inside("render", tmp_path / "none.toml")
    assert done.returncode == 2 and "Traceback" not in done.stderr


def test_what_only_the_core_finds_is_reported_with_its_line(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = scene.read_text().replace("target = [0.0, 0.6, 0.0]", "target = [0.0, 0.6, 9.0]")
    scene.write_text(text.replace("samples = 8", 'samples = 8\nsampling = "uniform:99"'))
    assert run(["check", str(scene)]) == 1
    eye, sampling = capsys.readouterr().out.splitlines()
    assert eye.startswith(f"{scene}:4: [camera] eye: the camera sees nothing from here towards target: ")
    assert sampling.startswith(f"{scene}:10: [render] sampling: ")
    assert run(["render", str(scene)]) == 2
    assert capsys.readouterr().err.startswith(f"Error: {eye}\n")


def test_warnings_are_shown_and_are_no_mistakes(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The core's (a lamp with lines) and the scene's own (an RGB colour that no smooth reflectance has)."""
    text = scene.read_text().replace('spectrum = "A"', 'spectrum = "FL11"')
    text = text.replace("[render]\n", '[render]\nsampling = "uniform:32"\n')
    rgb = '{ rgb = [1.0, 0.0, 0.0], role = "albedo", system = "Rec.2020" }'
    scene.write_text(text.replace("reflectance = 0.5", f"reflectance = {rgb}"))
    assert run(["check", str(scene)]) == 0
    shown = capsys.readouterr()
    assert shown.out == f"{scene}: no mistakes\n"
    own, lamp = shown.err.splitlines()
    assert own.startswith("Warning: ") and "materials.grey" in own and "ΔE00" in own
    assert lamp.startswith('Warning: lamp "lamp" has a spectrum too fine for uniform:32')
    assert run(["render", str(scene), "--samples", "1", "-o", str(scene.with_suffix(".png"))]) == 0
    assert capsys.readouterr().err.splitlines()[:2] == [own, lamp]


def test_rgb_beside_measured_spectra_is_said_to_mislead(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Book 3.5.3. Alone, or beside a grey, RGB misleads nobody."""
    rgb = '{ rgb = [0.5, 0.2, 0.1], role = "albedo" }'
    text = scene.read_text().replace("reflectance = 0.5", f"reflectance = {rgb}")
    scene.write_text(text)
    assert run(["check", str(scene)]) == 0
    assert capsys.readouterr().err == ""
    scene.write_text(text + '\n[materials.paint]\nkind = "diffuse"\nreflectance = "ColorChecker/red"\n')
    assert run(["check", str(scene)]) == 0
    err = capsys.readouterr().err
    assert err.startswith(
        "Warning: materials.grey.reflectance: made from RGB (ΔE00 of the round trip at most 0.00"
    )
    assert "a guess" in err and len(err.splitlines()) == 1
