"""The notebooks run from their first cell to their last, say what their text says, and are kept without outputs."""

import importlib.util
import json
import re
import warnings
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="module")
def site():
    """`tools/site/notebooks.py`, which no package holds."""
    spec = importlib.util.spec_from_file_location("notebooks", REPOSITORY / "tools" / "site" / "notebooks.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def written(site, tmp_path_factory):
    """Every notebook as a page: its text by its name, and its folder."""
    folder = tmp_path_factory.mktemp("pages")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # those of kernels and their sockets are not ours
        found = site.pages(REPOSITORY / "notebooks", folder)
    return folder, {page.stem: page.read_text(encoding="utf-8") for page in found}


def number(text, pattern):
    """The number that a page prints behind some words."""
    found = re.search(pattern, text)
    assert found, pattern
    return float(found[1])


def test_there_are_three():
    assert [path.stem for path in NOTEBOOKS] == [
        "1_spectra_and_colour",
        "2_one_scene_every_model",
        "3_from_light_to_display",
    ]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_kept_without_outputs(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert cells[0]["cell_type"] == "markdown", "it begins with words"
    for cell in cells:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
    assert path.stat().st_size < 20_000


def test_every_notebook_becomes_a_page_with_its_pictures(written):
    folder, texts = written
    assert list(texts) == [path.stem for path in NOTEBOOKS]
    for name, text in texts.items():
        linked = re.findall(r"!\[[^\]]*\]\(([^)]+\.png)\)", text)
        assert len(linked) >= 4, name
        assert all((folder / link).read_bytes().startswith(b"\x89PNG") for link in linked)
        assert "%matplotlib" not in text and ".ipynb" not in text and "Traceback" not in text


def test_spectra_and_colour_says_what_is_right(written):
    text = written[1]["1_spectra_and_colour"]
    by_hand, library = (
        re.search(rf"^{who} \[([^\]]+)\]", text, re.MULTILINE)[1] for who in ("by hand", "library")
    )
    assert [float(word) for word in by_hand.split()] == pytest.approx(
        [float(w) for w in library.split()], abs=2e-6
    )
    assert number(text, r"FL11 +0\.\d+ +0\.\d+ +(\d+) ") == pytest.approx(4001, abs=2)
    assert number(text, r"D65, 2° observer +ΔE00 ([\d.]+)") < 1e-3
    assert number(text, r"D65, 10° observer ΔE00 ([\d.]+)") > 1


def test_one_scene_says_what_is_right(written):
    text = written[1]["2_one_scene_every_model"]
    apart = {
        (technique, model): float(value)
        for technique, model, value in re.findall(r"^(\w+) +([\w-]+) +[\d.]+% +([\d.]+) ", text, re.MULTILINE)
    }
    assert apart["path", "general"] == 0
    assert apart["gouraud", "bouknight"] > apart["raytrace", "whitted"] > apart["raytrace", "hall"] > 1
    assert number(text, r"add up to the whole within ([\d.e-]+)") < 1e-6


def test_from_light_to_display_says_what_is_right(written):
    text = written[1]["3_from_light_to_display"]
    outside = [
        number(text, rf"{name} +([\d.]+)% of the pixels") for name in ("sRGB", "Display P3", "Rec.2020")
    ]
    assert outside == sorted(outside, reverse=True) and outside[0] > 10
    assert re.search(r"^chunks: .*iCCP", text, re.MULTILINE)
    assert number(text, r"of the pixels: ΔE00 mean ([\d.]+)") < 1
