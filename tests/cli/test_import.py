"""Importing the package, and asking for help, load nothing large."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

LARGE = (
    "numpy",
    "OpenImageIO",
    "trimesh",
    "pydantic",
    "rich",
    "scipy",
    "matplotlib",
    "embreex",
    "flip_evaluator",
)

_LOADED = """
import json, sys
{statement}
print("\\n" + json.dumps(sorted(sys.modules)))
"""


def modules_after(statement: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", _LOADED.format(statement=statement)],
        capture_output=True,
        text=True,
        check=True,
    )
    return set(json.loads(done.stdout.splitlines()[-1]))


def test_importing_loads_no_large_package_and_no_data() -> None:
    loaded = modules_after("import illuminant; illuminant.__all__; dir(illuminant)")
    assert not loaded & {*LARGE, "typer", "illuminant._core", "illuminant.spectra"}
    assert {name for name in loaded if name.startswith("illuminant")} == {"illuminant"}


@pytest.mark.parametrize("arguments", [[], ["--help"], ["render", "--help"], ["--version"]])
def test_help_loads_no_large_package(arguments: list[str]) -> None:
    loaded = modules_after(f"from illuminant.cli import run; run({arguments!r})")
    # Typer reads the arguments with pydantic, when that is there (0.05 s).
    assert not loaded & ({*LARGE, "illuminant._core", "illuminant.spectra"} - {"pydantic"})


def test_rendering_plain_meshes_imports_nothing_slow(scenes: Path, tmp_path: Path) -> None:
    """A second `make demo` begins within 2 s: SciPy and trimesh alone would take longer."""
    words = ["render", str(scenes / "demo.toml"), "--samples", "1", "--size", "16x9"]
    loaded = modules_after(
        f"from illuminant.cli import run; run({[*words, '-o', str(tmp_path / 'a.png')]!r})"
    )
    assert "numpy" in loaded and (tmp_path / "a.png").exists()
    assert not loaded & {"trimesh", "scipy", "OpenImageIO", "rich", "matplotlib", "flip_evaluator", "embreex"}


def test_every_lazy_name_is_there_and_stays_what_it_is() -> None:
    import illuminant

    for name in illuminant.__all__:
        assert getattr(illuminant, name) is getattr(illuminant, name), name
    import illuminant.cli.render
    import illuminant.rendering

    assert callable(illuminant.render) and callable(illuminant.diff)
    with pytest.raises(AttributeError, match="has no attribute 'frobnicate'"):
        illuminant.frobnicate  # noqa: B018


def test_the_version_is_that_of_the_core(
    repository: Path, command: Callable[..., subprocess.CompletedProcess[str]]
) -> None:
    from illuminant.core import core

    done = command("--version")
    assert done.returncode == 0
    assert done.stdout == f"illuminant {core().__version__}\n"
    assert f'version = "{core().__version__}"' in (repository / "Cargo.toml").read_text()


def test_the_package_runs_as_a_module() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "illuminant", "render", "--help"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("Usage: python -m illuminant render")
