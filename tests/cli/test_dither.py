"""`illuminant dither`: dithers from the command line."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant.display import dither, dither_study, patterning
from illuminant.display.picture import Picture

Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def photograph(tmp_path: Path) -> Path:
    """A small picture with colour."""
    values = np.random.default_rng(1).random((24, 32, 3)) * 0.2 + np.linspace(0, 0.8, 32)[None, :, None]
    path = tmp_path / "in.png"
    Picture.of_values(values, "sRGB").save(path)
    return path


@pytest.mark.parametrize("verb", ["gamut", "gamut strips", "dither", "dither halftone", "video transmit"])
def test_the_help_fits_a_terminal(inside: Command, verb: str) -> None:
    done = inside(*verb.split(), "--help")
    assert done.returncode == 0 and max(map(len, done.stdout.splitlines())) <= 80


def test_every_dither_is_listed(inside: Command) -> None:
    done = inside("dither", "list")
    assert [line.split()[0] for line in done.stdout.splitlines()] == dither.names()
    assert max(map(len, done.stdout.splitlines())) <= 100
    facts = json.loads(inside("dither", "list", "--json").stdout)
    assert facts["bayer-16"] == {"does": "a recursive tile of 16 x 16", "source": "Bayer 1973"}


def test_the_bands_of_the_figure_are_drawn(inside: Command, tmp_path: Path) -> None:
    done = inside("dither", "compare", "-o", tmp_path / "a.png", "--bare")
    assert done.returncode == 0 and done.stderr.endswith(
        "3 bits, none, floyd-steinberg, ordered-2, ordered-4, dot-diffusion-4\n"
    )
    picture = Picture.open(tmp_path / "a.png")
    assert picture.display.name == "sRGB"
    wanted = np.floor(dither_study.comparison() * (255 / 7) + 0.5)
    np.testing.assert_array_equal(picture.codes, np.repeat(wanted[..., None], 3, axis=2))
    inside(
        "dither",
        "compare",
        "-o",
        tmp_path / "b.png",
        "--enlarge",
        2,
        "--dithers",
        "none,pattern-2x2",
        "--bits",
        1,
    )
    labelled = Picture.open(tmp_path / "b.png")
    assert labelled.width > 512 + 40 and labelled.height == 2 * 64 + 3 * 2
    assert set(np.unique(labelled.codes[2:66, -514:-2])) == {0, 255}


def test_an_image_is_compared_and_turned_into_a_halftone(
    inside: Command, photograph: Path, tmp_path: Path
) -> None:
    done = inside(
        "dither",
        "compare",
        photograph,
        "--dithers",
        "none,blue-noise,bayer-8",
        "--bare",
        "-o",
        tmp_path / "a.png",
    )
    assert done.returncode == 0 and "1 bit," in done.stderr
    sheet = Picture.open(tmp_path / "a.png")
    assert (sheet.width, sheet.height) == (3 * 32, 24)
    wanted = patterning.halftone(Picture.open(photograph), "blue-noise").codes
    np.testing.assert_array_equal(sheet.codes[:, 32:64], wanted * 255)
    done = inside(
        "dither", "halftone", photograph, tmp_path / "h.png", "--dither", "pattern-2x3", "--enlarge", "--grey"
    )
    assert done.stderr == f"{tmp_path / 'h.png'}: 64x72, 1 bit, by pattern-2x3\n"
    made = Picture.open(tmp_path / "h.png")
    assert made.bits == 1 and (made.codes == made.codes[..., :1]).all()


def test_the_seed_of_a_random_halftone_is_an_option(
    inside: Command, photograph: Path, tmp_path: Path
) -> None:
    def made(*options: object) -> np.ndarray:
        done = inside("dither", "halftone", photograph, tmp_path / "h.png", "--dither", "random", *options)
        assert done.returncode == 0
        return Picture.open(tmp_path / "h.png").codes

    np.testing.assert_array_equal(made(), made("--seed", 0))
    assert (made("--seed", 7) != made()).any()
    np.testing.assert_array_equal(made("--seed", 7), made("--seed", 7))


def test_the_patterns_are_drawn_and_counted(inside: Command, tmp_path: Path) -> None:
    done = inside("dither", "patterns", "-o", tmp_path / "a.svg")
    assert [line.split() for line in done.stdout.splitlines()[1:]] == [
        ["2x2", "5", "1,021"],
        ["2x3", "7", "1,531"],
        ["3x3", "10", "2,296"],
    ]
    assert (tmp_path / "a.svg").stat().st_size > 5_000


def test_the_study_prints_a_table_and_json(inside: Command) -> None:
    done = inside("dither", "study", "--dithers", "none,ordered-2")
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert done.stdout.splitlines()[1].split() == ["none", "0.000", "–", "0.000", "0.984", "0.386", "0.4894"]
    facts = json.loads(
        inside("dither", "study", "--dithers", "none,pattern-2x2", "--bits", 3, "--json").stdout
    )
    assert facts["none"]["low"] is None and facts["pattern-2x2"]["step"] == pytest.approx(0.234, abs=1e-3)


def test_spectra_are_drawn(inside: Command, tmp_path: Path) -> None:
    done = inside("dither", "spectrum", "random", "pattern-2x2", "-o", tmp_path / "a.png", "--part", 0.3)
    assert done.returncode == 0 and (tmp_path / "a.png").stat().st_size > 10_000


def test_mistakes_are_sentences(inside: Command, photograph: Path, tmp_path: Path) -> None:
    out = ("-o", tmp_path / "a.png")
    for arguments, sentence in (
        (("compare", "-o", tmp_path / "a.svg"), "saved as .png"),
        (("compare", "-o", tmp_path / "none" / "a.png"), "none"),
        (("compare", *out, "--dithers", "bayer"), "no dither 'bayer'"),
        (("compare", *out, "--dithers", "pattern-99x2"), "1 to 64"),
        (("compare", *out, "--bits", 9), "1 to 8 bits"),
        (("compare", *out, "--width", 0), "2 to 16,384"),
        (("compare", *out, "--enlarge", 0), "1 to 32"),
        (("compare", *out, "--columns", 0), "1 or more"),
        (("compare", *out, "--band", 1000, "--enlarge", 32), "megapixels"),
        (("compare", *out, "--mean", "dark"), "light or of codes"),
        (("compare", tmp_path / "no.png", *out), "no such file|cannot be read"),
        (("halftone", photograph, tmp_path / "h.jpg"), "saved as .png"),
        (("halftone", photograph, tmp_path / "h.png", "--dither", "ink"), "no dither 'ink'"),
        (("halftone", photograph, tmp_path / "h.png", "--bits", 0), "1 to 16"),
        (("halftone", photograph, tmp_path / "h.png", "--dither", "random", "--enlarge"), "cannot enlarge"),
        (("patterns", *out, "--cells", "2by2"), "WxH"),
        (("patterns", *out, "--cells", "9x9"), "up to 64 patterns"),
        (("study", "--bits", 40), "1 to 16"),
        (("study", "--density", 0), "positive"),
        (("spectrum", "random", "-o", tmp_path / "a.jpg"), ".png or .svg"),
        (("spectrum", "random", *out, "--part", 2), "between two codes"),
    ):
        done = inside("dither", *arguments)
        assert done.returncode == 2, arguments
        assert done.stderr.startswith("Error: "), arguments
        assert any(part in done.stderr for part in sentence.split("|")), (arguments, done.stderr)
    assert not list(tmp_path.glob("h.*")) and not (tmp_path / "a.png").exists()


def test_the_page_of_dithers_names_them_all(repository: Path) -> None:
    text = (repository / "docs" / "dither.md").read_text(encoding="utf-8")
    for name in dither.names():
        assert f"`{name}`" in text or f"\n{name} " in text
