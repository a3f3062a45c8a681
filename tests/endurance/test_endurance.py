"""A minute each of what runs for hours by `make kills` and `make soak`; and what those found last is on record."""

import importlib.util
import re
import sys
from datetime import date
from types import ModuleType

import pytest


@pytest.fixture(scope="module")
def load(repository):
    """Imports a program of the folder `endurance`."""

    def load(name: str) -> ModuleType:
        spec = importlib.util.spec_from_file_location(name, repository / "endurance" / f"{name}.py")
        assert spec and spec.loader
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module  # dataclasses look their module up
        spec.loader.exec_module(module)
        return module

    return load


def test_killed_renders_go_on_to_the_same_bits(load, tmp_path):
    options = ["--size", "64x64", "--samples", "32", "--keep-spectra"]
    found = load("kills").survive(8, 5, options, tmp_path)
    assert found["kills"] == 8
    assert found["renders that came to their end, to the bit"] >= 1
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".exr", ".exr"]


def test_mixed_work_leaves_nothing_behind(load, tmp_path):
    soak = load("soak")
    found = soak.soak(25.0, 3, tmp_path)
    assert len(found) >= 2
    first, last = found[0], found[-1]
    assert last.threads <= first.threads + 1
    assert last.files <= first.files
    assert not any(one.temporary for one in found)
    # A few rounds are no proof of flat memory; a leak of an image or a scene a round would be seen.
    assert last.memory < 1.5 * first.memory


@pytest.mark.parametrize("name", ["kills", "soak"])
def test_what_the_long_runs_found_is_on_record(repository, name):
    text = (repository / "endurance" / f"{name}.txt").read_text()
    found = re.match(r"illuminant [\d.]+, (\d{4}-\d\d-\d\d): ", text)
    assert found
    assert date.fromisoformat(found[1]) <= date.today()
    page = (repository / "docs" / "reliability.md").read_text()
    for line in text.splitlines():
        assert line.strip() in page, f"docs/reliability.md does not have {line.strip()!r}"
