"""`illuminant spectra error` and `spectra compare`."""

import json
from pathlib import Path
from typing import Any

import pytest

from illuminant import sampling
from illuminant.cli import run
from illuminant.errors import UsageError


def rows(text: str) -> list[list[str]]:
    """The cells of a table of Markdown, without its second line."""
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()]
    return [lines[0], *lines[2:]]


def test_a_scene_is_judged_by_each_sampling(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["spectra", "error", str(scene), "--sampling", "rgb", "--sampling", "fitted:8", "--json"]) == 0
    shown = capsys.readouterr()
    rgb, fitted = json.loads(shown.out)
    assert (rgb["sampling"], fitted["sampling"]) == ("rgb", "fitted:8")
    assert rgb["mean"] > 10 * fitted["mean"]
    assert len(fitted["wavelengths_nm"]) == 8 and fitted["judged"] > 100
    assert "rgb multiplies colours instead of spectra" in shown.err


def test_without_a_name_it_is_the_scene_s_own(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["spectra", "error", str(scene)]) == 0
    head, line = capsys.readouterr().out.splitlines()
    assert head.split() == ["mean", "p95", "max", "worst"]
    assert line.startswith("fitted:8") and " under lamp" in line
    assert len(line) <= 80


def test_where_all_light_is_dispersed_nothing_is_judged(
    scenes: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["spectra", "error", str(scenes / "prism.toml")]) == 0
    assert "nothing to judge" in capsys.readouterr().out


def test_samplings_are_compared_in_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    words = [
        "--sampling",
        "rgb",
        "--sampling",
        "fitted:8",
        "--lamp",
        "D65",
        "--lamp",
        "FL11",
        "--products",
        "500",
    ]
    assert run(["spectra", "compare", *words]) == 0
    head, rgb, fitted = rows(capsys.readouterr().out)
    assert head == ["sampling", "D65", "FL11"]
    assert (rgb[0], fitted[0]) == ("`rgb`", "`fitted:8`")
    for by_rgb, by_fit in zip(rgb[1:], fitted[1:], strict=True):
        assert float(by_rgb.split("/")[0]) > 20 * float(by_fit.split("/")[0])


def test_dark_products_count_more_when_lit(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["spectra", "compare", "--sampling", "uniform:8", "--lamp", "A", "--products", "300"]
    assert run(words) == 0
    plain = float(rows(capsys.readouterr().out)[1][1].split("/")[0])
    assert run([*words, "--lit"]) == 0
    assert float(rows(capsys.readouterr().out)[1][1].split("/")[0]) > plain
    assert run([*words, "--json"]) == 0
    [study] = json.loads(capsys.readouterr().out)
    error = study["by_lamp"]["A"]
    assert error["products"] == 300 and error["lit"]["mean"] > error["mean"] > 0 and error["worst"]


@pytest.mark.parametrize("given", [{"depth": 0}, {"products": 0}, {"range_nm": (780, 380)}])
def test_a_study_of_nothing_is_refused(given: dict[str, Any]) -> None:
    with pytest.raises(UsageError, match=r"at least one|expected one whole nm"):
        sampling.compare(["rgb"], ["D65"], **given)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("spectra compare --sampling fitted:99", 'fitted:N takes a whole number N from 1 to 32, not "99"'),
        ("spectra compare --sampling gauss:3,3,1 --lamp A", "there is no Gauss rule of 3 points for C1"),
        ("spectra compare --sampling hall:900,1000", "holds nothing of the range"),
        ("spectra compare --lamp A --lamp a", "Two of the lamps have one name"),
        ("spectra compare --lamp FL13", "no spectrum 'FL13' in the library"),
        ("spectra compare --reflectances Munsell", "There is no reflectance to multiply"),
        ("spectra error none.toml", "there is no such file"),
    ],
)
def test_one_sentence_for_each_mistake(words: str, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(words.split()) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert len(shown.err.splitlines()) == 1 and sentence in shown.err
