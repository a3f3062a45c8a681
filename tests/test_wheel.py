"""The wheel installs into an empty environment, in a path with a space in it, and renders the demo there."""

import os
import shutil
import struct
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PROGRAMS = Path(sys.executable).parent


def run(*arguments: object, **options: object) -> str:
    """What the command prints; its complaint, if it fails, is in the failure of the test."""
    done = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, timeout=900, **options)
    assert done.returncode == 0, f"{arguments}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def wheel(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, as `make wheel` builds it."""
    folder = tmp_path_factory.mktemp("dist")
    run(PROGRAMS / "maturin", "build", "--quiet", "--release", "--strip", "--out", folder, cwd=repository)
    (file,) = folder.glob("*.whl")
    return file


def test_the_wheel_serves_every_python_from_3_11_on(wheel):
    assert "-cp311-abi3-" in wheel.name


def test_the_wheel_holds_the_licences_the_types_and_the_data_but_no_test(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    endings = ("licenses/LICENSE-MIT", "licenses/LICENSE-APACHE", "/py.typed", "/_core.pyi", "_core.abi3.so")
    for ending in endings:
        assert any(name.endswith(ending) for name in names), ending
    assert any(name.startswith("illuminant/data/") for name in names)
    assert {name.split("/")[0] for name in names} == {
        "illuminant",
        next(n for n in names if "dist-info" in n).split("/")[0],
    }
    assert not [name for name in names if name.endswith((".pyc", "conftest.py")) or "/tests/" in name]


def test_the_wheel_renders_the_demo_in_an_empty_environment_in_a_path_with_a_space(
    wheel, repository, scenes, tmp_path
):
    home = tmp_path / "a place with spaces"
    home.mkdir()
    run(PROGRAMS / "uv", "venv", "--quiet", "--python", sys.executable, home / "env")
    install = [PROGRAMS / "uv", "pip", "install", "--quiet", "--python", home / "env" / "bin" / "python"]
    run(*install, "--require-hashes", "-r", repository / "requirements" / "run.txt")
    run(*install, "--no-deps", wheel)
    shutil.copytree(scenes, home / "scenes")

    clean = {
        name: value for name, value in os.environ.items() if not name.startswith(("ILLUMINANT_", "PYTHON"))
    }
    program = home / "env" / "bin" / "illuminant"
    image = home / "the image.png"
    run(
        program,
        "render",
        "scenes/demo.toml",
        "--size",
        "96x54",
        "--samples",
        4,
        "-o",
        image,
        cwd=home,
        env=clean,
    )

    header = image.read_bytes()[:24]
    assert header.startswith(b"\x89PNG")
    assert struct.unpack(">II", header[16:24]) == (96, 54)
    where = run(
        home / "env/bin/python", "-c", "import illuminant; print(illuminant.__file__)", cwd=home, env=clean
    )
    assert where.startswith(str(home))
