"""`illuminant diff`: ΔE00 and FLIP between two files."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant.difference import diff
from illuminant.image import Image

Command = Callable[..., "subprocess.CompletedProcess[str]"]

# CIE 1931 XYZ, Y relative to 100, of two greys of CIE Lab L* 50 and L* 51 under D65: ΔE00 at L* 50.5 is 1/S_L.
WHITE = np.array([0.95047, 1.0, 1.08883])


def grey(lightness: float) -> np.ndarray:
    return np.full((16, 24, 3), ((lightness + 16) / 116) ** 3 * WHITE)


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    a, b = Image(grey(50) * 100, exposure=0.01), Image(grey(51) * 100, exposure=0.01)
    a.save(tmp_path / "a.exr")
    b.save(tmp_path / "b.exr")
    return tmp_path / "a.exr", tmp_path / "b.exr"


def test_one_step_of_lightness(files: tuple[Path, Path]) -> None:
    found = diff(*files)
    s_l = 1 + 0.015 * 0.5**2 / np.sqrt(20 + 0.5**2)
    assert found.mean == pytest.approx(1 / s_l, abs=2e-3)
    assert found.max == pytest.approx(found.p95, abs=1e-6)
    assert 0 < found.flip < 0.1


def test_an_image_does_not_differ_from_itself(files: tuple[Path, Path]) -> None:
    found = diff(files[0], files[0])
    assert (found.mean, found.max, found.flip) == (0.0, 0.0, 0.0)


def test_absolute_images_share_one_exposure(files: tuple[Path, Path]) -> None:
    bright = Image(grey(50) * 200)
    assert diff(files[0], bright).mean > 10
    assert diff(files[0], bright, exposure=0.005).exposure == 0.005


def test_the_limit_decides_the_exit_code(files: tuple[Path, Path], inside: Command) -> None:
    assert inside("diff", *files, "--max", "1.5").returncode == 0
    done = inside("diff", *files, "--max", "0.5")
    assert done.returncode == 1
    assert done.stdout.startswith("ΔE00 mean 0.99")
    assert done.stderr == "Different: mean 0.9992 is above 0.5.\n"
    done = inside("diff", *files, "--max", "0.5", "--measure", "flip", "--json")
    assert done.returncode == 0
    assert set(json.loads(done.stdout)) == {"mean", "p95", "max", "flip", "exposure"}


@pytest.mark.parametrize("name", ["map.exr", "map.png"])
def test_the_map_is_written(files: tuple[Path, Path], inside: Command, name: str) -> None:
    path = files[0].with_name(name)
    done = inside("diff", *files, "-o", path)
    assert (done.returncode, done.stderr) == (0, f"{path}: map of ΔE00, white is 1\n")
    assert (Image.open(path).width, Image.open(path).height) == (24, 16)


def test_wrong_input_is_one_sentence(files: tuple[Path, Path], inside: Command, tmp_path: Path) -> None:
    Image(np.ones((2, 2, 3))).save(tmp_path / "small.exr")
    for arguments, sentence in (
        ((files[0], tmp_path / "none.exr"), "none.exr cannot be read: there is no such file.\n"),
        ((files[0], tmp_path / "small.exr"), "The images differ in size: 24x16 and 2x2 pixels.\n"),
        ((*files, "--measure", "rms"), "--measure rms: expected mean, p95, max or flip.\n"),
        ((*files, "-o", tmp_path / "no" / "a.png"), f"there is no folder {tmp_path / 'no'}.\n"),
    ):
        done = inside("diff", *arguments)
        assert done.returncode == 2
        assert done.stderr.startswith("Error: ") and done.stderr.endswith(sentence)
        assert done.stderr.count("\n") == 1
