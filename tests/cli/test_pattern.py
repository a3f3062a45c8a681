"""`illuminant pattern`: every pattern is written, states its display, and a mistake is one sentence."""

import json

import numpy as np
import pytest

from illuminant.cli import run
from illuminant.display import patterns
from illuminant.display.picture import Picture


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", patterns.names())
def test_every_pattern_is_written_as_it_is_drawn(folder, name):
    assert run(["pattern", name, "--size", "160x90"]) == 0
    picture = Picture.open(folder / f"{name}.png")
    screen = patterns.Screen(160, 90, patterns.PATTERNS[name].bits)
    np.testing.assert_array_equal(picture.codes, patterns.picture(name, screen).codes)
    assert (picture.display.name, picture.bits) == ("sRGB", screen.bits)


def test_the_same_command_gives_the_same_bytes(folder):
    arguments = ["pattern", "colorchecker", "--size", "160x90", "--display", "Display P3", "--bits", "16"]
    assert run([*arguments, "-o", "a.png"]) == run([*arguments, "-o", "b.png"]) == 0
    assert (folder / "a.png").read_bytes() == (folder / "b.png").read_bytes()
    assert Picture.open(folder / "a.png").display.name == "Display P3"


def test_options_reach_the_pattern_and_stand_in_the_file(folder):
    assert run(["pattern", "window", "--color", "0.2,0.4,1", "--window", "0.5", "--size", "64x64"]) == 0
    picture = Picture.open(folder / "window.png")
    assert picture.codes[32, 32].tolist() == [51, 102, 255]
    settings = json.loads(picture.text["Settings"])
    assert settings["pattern"] == "window" and settings["color"] == [0.2, 0.4, 1.0]


def test_blue_alone_is_shown_of_the_bars(folder):
    assert run(["pattern", "smpte", "--blue-only", "--size", "140x96"]) == 0
    codes = Picture.open(folder / "smpte.png").codes
    assert codes[..., :2].max() == 0 and codes[..., 2].max() == 255


def test_patches_outside_the_gamut_are_named(folder, capsys):
    assert run(["pattern", "colorchecker", "--size", "64x64", "--json"]) == 0
    captured = capsys.readouterr()
    assert "cyan" in captured.err
    told = json.loads(captured.out)
    assert "cyan" in told["notes"][0] and told["options"] == {"chart": "measured", "light": "D65"}


def test_the_tint_of_the_printed_chart_is_told(folder, capsys):
    assert run(["pattern", "colorchecker", "--chart", "book", "--size", "64x64"]) == 0
    assert "illuminant C" in capsys.readouterr().err


def test_list_names_every_pattern_with_its_options(capsys):
    assert run(["pattern", "list"]) == 0
    out = capsys.readouterr().out
    assert all(f"{name} " in out for name in patterns.names()) and "--window" in out
    assert max(map(len, out.splitlines())) <= 80
    assert run(["pattern", "list", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == patterns.names()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["bar"], "There is no pattern 'bar'"),
        (["black", "--color", "1"], "--color does not go with black, which has none"),
        (["ramp", "--window", "0.5"], "which has --channel, --even"),
        (["window", "--color", "red"], "--color red: expected a code value"),
        (["window", "--color", "0.1,0.2"], "--color 0.1,0.2: expected a code value, or three"),
        (["window", "--color", "1.5"], "not 1.5"),
        (["window", "--color", "nan"], "--color nan: expected a code value"),
        (["window", "--window", "2"], "not 2"),
        (["window", "--size", "big"], "--size big: expected width and height"),
        (["window", "--size", "1x1"], "16 to 16384"),
        (["window", "--bits", "20"], "1 to 16 bits, not 20"),
        (["window", "--bits", "0"], "1 to 16 bits, not 0"),
        (["colorchecker", "--light", "0K"], "expected a temperature in K"),
        (["window", "--display", "TV"], "There is no display 'TV'"),
        (["window", "-o", "a.jpg"], "written as .png"),
        (["window", "-o", "none/a.png"], "there is no folder none"),
        (["shadows", "--bits", "8"], "8 bits: 10 to 16 are needed"),
        (["ramp", "--blue-only"], "--blue-only is a view of smpte and eia"),
        (["list", "--color", "1"], "takes no options"),
    ],
)
def test_a_mistake_is_one_sentence_and_writes_nothing(folder, capsys, arguments, words):
    assert run(["pattern", *arguments]) == 2
    captured = capsys.readouterr()
    assert words in captured.err and captured.err.count("\n") == 1
    assert list(folder.iterdir()) == []
