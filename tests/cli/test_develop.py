"""`illuminant develop`: what it writes, what it says, and one sentence for each mistake."""

import json
from pathlib import Path

import numpy as np
import pytest

from illuminant.cli import run
from illuminant.image import Image

SCENE = """
[camera]
eye = [0, 1, 4]
target = [0, 0.5, 0]
size = [24, 16]

[materials.paint]
kind = "diffuse"
reflectance = "ColorChecker/orange"

[materials.grey]
kind = "diffuse"
reflectance = 0.5

[objects.ball]
material = "paint"
sphere = { center = [0, 0.5, 0], radius = 0.5 }

[objects.floor]
material = "grey"
rectangle = { corners = [[-3, 0, 3], [3, 0, 3], [3, 0, -3], [-3, 0, -3]] }

[lights."window=left"]
kind = "point"
position = [-2, 3, 2]
spectrum = "D65"
flux_lm = 2000

[lights.desk]
kind = "point"
position = [2, 1, 2]
spectrum = "A"
flux_lm = 800
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an image that keeps everything, and one that keeps nothing."""
    folder = tmp_path_factory.mktemp("develop")
    (folder / "room.toml").write_text(SCENE)
    kept = ["--lamps", "--keep-spectra", "--develop-for", "FL11"]
    for name, options in (("room.exr", kept), ("plain.exr", [])):
        assert (
            run(["render", str(folder / "room.toml"), "-o", str(folder / name), "--samples", "4", *options])
            == 0
        )
    return folder


def developed(folder: Path, *options: str, source: str = "room.exr", to: str = "out.exr") -> int:
    return run(["develop", str(folder / source), str(folder / to), *options])


def test_powers_by_name_and_what_is_said(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert developed(folder, "--power", "desk=0", "--power", "window=left=2") == 0
    said = capsys.readouterr().err
    assert "lamp desk times 0" in said and "lamp window=left times 2" in said
    before, after = Image.open(folder / "room.exr"), Image.open(folder / "out.exr")
    assert np.allclose(after.xyz, 2.0 * before.layers["lamp:window=left"], rtol=1e-5)


def test_without_options_it_is_the_same_image(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert developed(folder) == 0
    assert "as it was" in capsys.readouterr().err
    assert np.array_equal(Image.open(folder / "room.exr").xyz, Image.open(folder / "out.exr").xyz)


def test_the_exposure_of_a_picture_stays(folder: Path) -> None:
    before = Image.open(folder / "room.exr")
    assert developed(folder, "--lamp", "desk=FL11", to="out.png") == 0
    assert Image.open(folder / "out.png").settings["developed"][0]["lamps"] == {"desk": "FL11"}
    assert developed(folder, "--power", "desk=0", to="dark.png") == 0
    bright, dark = (Image.open(folder / name).xyz[..., 1].mean() for name in ("out.png", "dark.png"))
    assert dark < bright
    assert before.exposure is not None


def test_facts_as_json(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert developed(folder, "--lamp", "desk=2856K", "--regular", "10", "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    [how] = facts["developed"]
    assert how["regular"]["step_nm"] == 10
    assert how["refit"]["desk"]["mean"] < 1
    assert Image.open(folder / "out.exr").layers["spectra"].shape == (16, 24, 41)


def test_info_says_how_it_was_developed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert developed(folder, "--observer", "10", "--power", "desk=0.5") == 0
    capsys.readouterr()
    assert run(["info", str(folder / "out.exr")]) == 0
    said = capsys.readouterr().out
    assert "developed       seen by CIE 1964 10°" in said
    assert "lamp desk times 0.5" in said
    assert "Make it again" not in said


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--power", "lamp=0"], "There is no lamp 'lamp' in"),
        (["--power", "desk=much"], "--power desk=much: expected a factor"),
        (["--power", "desk"], "--power desk: expected a lamp and a value"),
        (["--lamp", "desk=FL99"], "no spectrum 'FL99' in the library"),
        (["--lamp", "desk=0K"], "expected a temperature in K"),
        (["--observer", "20"], "--observer 20: there is no such observer"),
        (["--observer", "none.csv"], "none.csv"),
        (["--regular", "99"], "--regular 99: expected a step"),
        (["--bits", "99"], "99"),
        (["--exposure", "-1"], "positive number"),
        (["--rgb", "none"], "none"),
    ],
)
def test_mistakes_are_one_sentence(
    folder: Path, options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert developed(folder, *options, to="never.exr") == 2
    said = capsys.readouterr().err.strip()
    assert said.startswith("Error: ") and message in said and "\n" not in said
    assert not (folder / "never.exr").exists()


def test_an_image_that_keeps_nothing_says_how_to_keep_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert developed(folder, "--power", "desk=0", source="plain.exr") == 2
    assert "render it again with --lamps" in capsys.readouterr().err
    assert developed(folder, "--observer", "10", source="plain.exr") == 2
    assert "keeps no spectra: render it again with --keep-spectra --lamps" in capsys.readouterr().err


def test_a_truncated_file_is_one_sentence(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    content = (folder / "room.exr").read_bytes()
    for length in (0, 3, 200, len(content) // 2):
        (folder / "cut.exr").write_bytes(content[:length])
        assert developed(folder, "--power", "desk=0", source="cut.exr") == 2
        said = capsys.readouterr().err.strip()
        assert said.startswith("Error: ") and "cut.exr" in said and "\n" not in said


def test_a_regular_grid_goes_into_an_exr(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert developed(folder, "--regular", "10", to="out.png") == 2
    assert "a PNG holds no spectra" in capsys.readouterr().err


def test_the_seed_of_a_random_dither_is_an_option(folder: Path) -> None:
    bytes_of = []
    for seed in ("0", "7", "7"):
        assert developed(folder, "--dither", "random", "--bits", "2", "--seed", seed, to="out.png") == 0
        bytes_of.append((folder / "out.png").read_bytes())
    assert bytes_of[0] != bytes_of[1] and bytes_of[1] == bytes_of[2]


def test_the_help_fits_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["develop", "--help"]) == 0
    said = capsys.readouterr().out
    assert "illuminant develop room.exr night.png" in said
    assert max(map(len, said.splitlines())) <= 80
