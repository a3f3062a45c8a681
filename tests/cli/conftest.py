"""A small scene for the tests of the command."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from illuminant.cli import run

SCENE = """\
title = "a ball under a lamp"

[camera]
eye = [0.0, 1.0, 4.0]
target = [0.0, 0.6, 0.0]
size = [32, 24]

[render]
samples = 8

[materials.grey]
kind = "diffuse"
reflectance = 0.5

[materials.lamp]
kind = "emitter"
spectrum = "A"
luminance_cd_m2 = 2000.0

[objects.floor]
rectangle = { corner = [-3.0, 0.0, 3.0], edges = [[6.0, 0.0, 0.0], [0.0, 0.0, -6.0]] }
material = "grey"

[objects.ball]
sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }
material = "grey"

[objects.lamp]
sphere = { center = [1.0, 3.0, 1.0], radius = 0.3 }
material = "lamp"
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """The path of a small scene file, alone in its folder."""
    path = tmp_path / "ball.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def inside(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., "subprocess.CompletedProcess[str]"]:
    """Runs `illuminant` with the given arguments as `command` does, but in this process, which saves its start."""

    def call(*arguments: object, cwd: Path | None = None) -> "subprocess.CompletedProcess[str]":
        words = [str(argument) for argument in arguments]
        with monkeypatch.context() as context:
            if cwd is not None:
                context.chdir(cwd)
            code = run(words)
        captured = capsys.readouterr()
        return subprocess.CompletedProcess(words, code, captured.out, captured.err)

    return call
