"""`illuminant gamma`: tables, fits and studies from the command line."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant.display.displays import named

Command = Callable[..., "subprocess.CompletedProcess[str]"]

READINGS = "code,luminance\n" + "".join(
    f"{code},{90 * (code / 255) ** 2.35 + 0.3:.6f}\n" for code in range(0, 256, 15)
)


@pytest.fixture
def readings(tmp_path: Path) -> Path:
    path = tmp_path / "crt.csv"
    path.write_text(READINGS)
    return path


def test_the_table_of_the_book_is_printed_in_columns(inside: Command) -> None:
    done = inside("gamma", "table", "--rounding", "truncate")
    assert done.returncode == 0
    assert max(map(len, done.stdout.splitlines())) <= 80
    words = [int(word) for word in done.stdout.split()]
    entries = dict(zip(words[::2], words[1::2], strict=True))
    assert sorted(entries) == list(range(256))
    assert (entries[3], entries[4], entries[255]) == (33, 38, 255)
    facts = json.loads(inside("gamma", "table", "--rounding", "truncate", "--json").stdout)
    assert facts["entries"] == [entries[code] for code in range(256)]


def test_a_table_is_written_and_its_mistakes_are_sentences(inside: Command, tmp_path: Path) -> None:
    done = inside("gamma", "table", "--gamma", "sRGB", "--out-bits", "10", "-o", tmp_path / "a.cube")
    assert done.returncode == 0 and done.stdout == ""
    assert "LUT_1D_SIZE 256" in (tmp_path / "a.cube").read_text()
    done = inside("gamma", "table", "--log", "1000", "--out-bits", "12", "-o", tmp_path / "a.csv")
    assert done.stderr.endswith("contrast 1000, 8 bits to 12\n")
    for arguments, sentence in (
        (("--gamma", "0"), "A γ is a number above 0"),
        (("--gamma", "fast"), "fast"),
        (("--in-bits", "20"), "1 to 16 bits"),
        (("--rounding", "up"), "nearest or truncate"),
        (("-o", tmp_path / "a.txt"), "ends in .csv, .cube or .spi1d"),
        (("--log", "0.5"), "contrast"),
    ):
        done = inside("gamma", "table", *arguments)
        assert done.returncode == 2, arguments
        assert done.stderr.startswith("Error: ") and sentence in done.stderr, arguments


def test_lost_levels_are_told(inside: Command) -> None:
    done = inside("gamma", "levels", "--rounding", "truncate")
    assert "184 of 256, 72 never" in done.stdout
    assert "up to code 25, spread over 34.5 %" in done.stdout
    facts = json.loads(inside("gamma", "levels", "--rounding", "truncate", "--json").stdout)
    assert set(range(34, 38)) <= set(facts["unused"]) and len(facts["unused"]) == 72
    assert inside("gamma", "levels", "--share", "2").returncode == 2


def test_readings_are_fitted_and_drawn(inside: Command, readings: Path, tmp_path: Path) -> None:
    done = inside("gamma", "fit", readings, "--model", "offset", "--plot", tmp_path / "fit.png")
    assert done.stdout.startswith("luminance: γ 2.35 ± ")
    assert "floor 0.3 ±" in done.stdout
    assert (tmp_path / "fit.png").stat().st_size > 10_000
    assert "γ 2.35 ±" in inside("gamma", "fit", readings, "--black", "0.3").stdout
    facts = json.loads(inside("gamma", "fit", readings, "--json", "--cutoff", "5").stdout)["luminance"]
    assert facts["gamma"] == pytest.approx(2.35, abs=0.05) and facts["cutoff"] >= 5
    for arguments, sentence in (
        ((tmp_path / "none.csv",), "cannot be read"),
        ((readings, "--model", "cubic"), "no model"),
        ((readings, "--cutoff", "89"), "needs readings of 89 and more"),
        ((readings, "--cutoff", "-1"), "0 or more"),
        ((readings, "--plot", tmp_path / "fit.jpg"), ".png or .svg"),
    ):
        done = inside("gamma", "fit", *arguments)
        assert done.returncode == 2 and sentence in done.stderr, arguments


def test_a_table_that_tells_no_gamma_is_named(inside: Command, tmp_path: Path) -> None:
    path = tmp_path / "equal.csv"
    path.write_text("code,luminance\n" + "".join(f"{code},1e308\n" for code in range(0, 256, 15)))
    done = inside("gamma", "fit", path)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith(f"Error: {path}: luminance: A gamma needs at least two readings above 0")


def test_phosphors_make_a_matrix(inside: Command, tmp_path: Path) -> None:
    path = tmp_path / "crt.csv"
    path.write_text("colour,x,y\nred,0.67,0.33\ngreen,0.21,0.71\nblue,0.14,0.08\nwhite,0.313,0.329\n")
    assert "  0.589" in inside("gamma", "phosphors", path).stdout
    facts = json.loads(inside("gamma", "phosphors", path, "--json").stdout)
    assert np.sum(facts["to_xyz"], axis=1)[1] == pytest.approx(1.0)
    assert facts["additivity"] is None
    done = inside("gamma", "phosphors", path, "--gamma", "2.35", "-o", tmp_path / "crt.toml")
    assert done.returncode == 0 and "description of crt" in done.stderr
    display = named(tmp_path / "crt.toml")
    assert (display.white, display.gamma) == ((0.313, 0.329), 2.35)
    np.testing.assert_allclose(display.to_xyz_matrix, facts["to_xyz"], atol=1e-12)
    assert inside("gamma", "phosphors", path, "-o", tmp_path / "crt.icc").returncode == 2


@pytest.mark.parametrize("verb", ["response", "brightness", "banding"])
def test_each_figure_is_drawn(inside: Command, tmp_path: Path, verb: str) -> None:
    done = inside("gamma", verb, "-o", tmp_path / "a.png")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.png").stat().st_size > 10_000
    assert done.stderr.startswith(f"{tmp_path / 'a.png'}: ")
    assert inside("gamma", verb, "-o", tmp_path / "no" / "a.png").returncode == 2


def test_the_numbers_of_the_studies_are_json(inside: Command, tmp_path: Path) -> None:
    out = ("--json", "-o", tmp_path / "a.svg")
    facts = json.loads(inside("gamma", "banding", "--bits", "8,10", "--steps", *out).stdout)
    assert facts["10"]["before storage"]["colours"] > facts["8"]["before storage"]["colours"]
    assert json.loads(inside("gamma", "brightness", *out).stdout)["lightness"] > 0.999
    done = inside("gamma", "drift", "--gammas", "1.8,2.2", "--primaries", "sRGB", *out)
    facts = json.loads(done.stdout)
    assert len(facts["names"]) == 24 and facts["contrast"][1] == pytest.approx(1.0)
    assert done.stderr.startswith("Warning: cyan: outside of sRGB")


def test_mistakes_in_the_studies_are_sentences(inside: Command, tmp_path: Path) -> None:
    for arguments, sentence in (
        (("drift", "--gammas", "a,b"), "numbers with commas"),
        (("drift", "--gammas", "-1"), "above 0"),
        (("drift", "--primaries", "mine"), "no display 'mine'"),
        (("brightness", "--black", "0"), "share"),
        (("banding", "--bits", "8.5"), "whole numbers"),
        (("banding", "--bits", "12"), "8 bits"),
        (("banding", "--color", "1,1"), "three numbers"),
    ):
        done = inside("gamma", *arguments, "-o", tmp_path / "a.png")
        assert done.returncode == 2 and sentence in done.stderr, (arguments, done.stderr)
        assert not (tmp_path / "a.png").exists()


def test_the_verb_alone_lists_its_verbs(inside: Command) -> None:
    done = inside("gamma")
    assert done.returncode == 0
    for verb in (
        "table",
        "levels",
        "fit",
        "phosphors",
        "response",
        "drift",
        "brightness",
        "banding",
        "remap",
    ):
        assert f"  {verb} " in done.stdout


def test_a_picture_is_mapped_to_another_display_and_told_what_it_lost(
    inside: Command, tmp_path: Path
) -> None:
    from illuminant.display.picture import Picture

    codes = np.random.default_rng(0).integers(0, 256, (40, 50, 3), dtype=np.uint8)
    before, after, back = (tmp_path / f"{name}.png" for name in ("before", "after", "back"))
    Picture(codes, "sRGB", 8, {"Note": "kept"}).save(before)
    done = inside("gamma", "remap", before, after, "--to", "Display P3")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("ΔE00 ") and "clamped          0.00 %" in done.stdout
    there = Picture.open(after)
    assert there.display.name == "Display P3" and there.text["Note"] == "kept"
    np.testing.assert_allclose(there.xyz(), Picture.open(before).xyz(), atol=1.0)
    assert inside("display", before, back, "--display", "Display P3", "--gamut", "clamp").returncode == 0
    np.testing.assert_array_equal(Picture.open(back).codes, there.codes)
    facts = json.loads(inside("gamma", "remap", after, back, "--to", "sRGB", "--json").stdout)
    assert facts["from"] == "Display P3" and 0.0 < facts["mean"] < 0.5
    away = np.abs(Picture.open(back).codes.astype(int) - codes)
    # Mapped back, codes are off by what was rounded on the way: more than a half step.
    assert away.max() >= 1 and away.mean() < 1.0
    fine = json.loads(
        inside("gamma", "remap", before, back, "--to", "Display P3", "--bits", "16", "--json").stdout
    )
    assert fine["mean"] < 0.01
    wide = inside("gamma", "remap", before, back, "--from", "Rec.2020 PQ", "--to", "sRGB")
    assert wide.returncode == 0 and "0.00 % of pixels" not in wide.stdout


def test_a_mapping_keeps_no_word_of_the_display_it_left(inside: Command, tmp_path: Path) -> None:
    import PIL.Image

    from illuminant.display.picture import Picture

    before, after, mute = (tmp_path / f"{name}.png" for name in ("before", "after", "mute"))
    text = {"Note": "kept", "Look": '{"display": "sRGB"}', "Exposure": "0.5"}
    Picture(np.full((2, 2, 3), 90, np.uint8), "sRGB", 8, text).save(before)
    assert inside("gamma", "remap", before, after, "--to", "Display P3").returncode == 0
    there = Picture.open(after).text
    assert there["Note"] == "kept" and not {"Look", "Exposure"} & set(there)
    assert json.loads(there["Display"])["name"] == "Display P3"
    assert inside("gamma", "remap", before, after, "--to", "sRGB", "--bits", 10).returncode == 0
    assert Picture.open(after).text["Exposure"] == "0.5"
    PIL.Image.new("RGB", (2, 2), (90, 90, 90)).save(mute)
    done = inside("gamma", "remap", mute, after, "--to", "Display P3")
    assert done.returncode != 0 and "--assume" in done.stderr
    told = json.loads(
        inside("gamma", "remap", mute, after, "--to", "sRGB", "--assume", "SMPTE-C", "--json").stdout
    )
    assert told["from"] == "SMPTE-C"
    told = json.loads(
        inside("gamma", "remap", before, after, "--to", "sRGB", "--assume", "SMPTE-C", "--json").stdout
    )
    assert told["from"] == "sRGB"


def test_mistakes_in_a_mapping_are_sentences(inside: Command, tmp_path: Path) -> None:
    from illuminant.display.picture import Picture

    path, out = tmp_path / "a.png", tmp_path / "b.png"
    Picture(np.zeros((2, 2, 3), np.uint8), "sRGB").save(path)
    for arguments, sentence in (
        ((path, out, "--to", "mine"), "no display 'mine'"),
        ((tmp_path / "none.png", out, "--to", "sRGB"), "cannot be read"),
        ((path, tmp_path / "b.jpg", "--to", "sRGB"), "saved as .png"),
        ((path, out, "--to", "sRGB", "--match", "near"), "relative or absolute"),
        ((path, out, "--to", "sRGB", "--bits", "20"), "1 to 16 bits"),
        ((path, out), "--to"),
    ):
        done = inside("gamma", "remap", *arguments)
        assert done.returncode == 2 and sentence in done.stderr, (arguments, done.stderr)
        assert not out.exists()
    path.write_bytes(path.read_bytes()[:60])
    assert inside("gamma", "remap", path, out, "--to", "sRGB").returncode == 2
