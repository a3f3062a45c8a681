"""`illuminant display` and `illuminant gamut`: finished images become pictures, and mistakes are one sentence."""

import json
import struct
import zlib
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import PIL.Image
import pytest
from PIL import ImageCms

from illuminant import png
from illuminant.cli import run
from illuminant.display import displays
from illuminant.display.picture import Picture
from illuminant.image import Image


@pytest.fixture
def exr(tmp_path: Path) -> Path:
    """A grey ramp to 100 cd/m² beside saturated colours."""
    rng = np.random.default_rng(3)
    xyz = np.linspace(0.0, 100.0, 64)[None, :, None] * np.array([0.9505, 1.0, 1.089])
    colours = rng.uniform(0.0, 60.0, (8, 64, 3))
    Image(np.concatenate([np.repeat(xyz, 8, axis=0), colours])).save(tmp_path / "a.exr")
    return tmp_path / "a.exr"


def shown(path: Path) -> Picture:
    return Picture.open(path)


def test_an_image_is_shown(exr: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["display", str(exr), str(tmp_path / "a.png"), "--exposure", "0.01", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (
        facts["display"] == "sRGB"
        and facts["look"]["gamut"] == "cook"
        and facts["chromaticity_outside"] > 0.1
    )
    picture = shown(tmp_path / "a.png")
    assert picture.codes[0, -1].tolist() == [255, 255, 255] and picture.codes[0, 0].tolist() == [0, 0, 0]


def test_a_picture_for_one_display_looks_the_same_on_another(exr: Path, tmp_path: Path) -> None:
    description = tmp_path / "mine.toml"
    description.write_text(
        'name = "mine"\nprimaries = [[0.69, 0.31], [0.2, 0.72], [0.14, 0.05]]\nwhite = [0.3127, 0.329]\n'
        'response = ["gamma 1.9", "gamma 2.1", "gamma 2.3"]\npeak = 200.0\n'
    )
    first, second = tmp_path / "a.png", tmp_path / "b.png"
    assert run(["display", str(exr), str(first), "--exposure", "0.01", "--bits", "16"]) == 0
    assert run(["display", str(first), str(second), "--display", str(description), "--bits", "16"]) == 0
    a, b = shown(first), shown(second)
    assert b.display.name == "mine"
    np.testing.assert_allclose(b.xyz() / 200.0, a.xyz() / 80.0, atol=2e-4)
    with PIL.Image.open(second) as opened:
        assert ImageCms.getProfileDescription(
            ImageCms.ImageCmsProfile(__import__("io").BytesIO(opened.info["icc_profile"]))
        ).startswith("mine")


def test_absolute_luminances_are_shown_as_they_are(exr: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.png"
    assert run(["display", str(exr), str(out), "--display", "Rec.2020 PQ", "--absolute", "--bits", "12"]) == 0
    np.testing.assert_allclose(shown(out).xyz()[0, :, 1], np.linspace(0.0, 100.0, 64), rtol=0.01, atol=0.01)


def test_the_traditional_way_shows_fewer_codes(exr: Path, tmp_path: Path) -> None:
    """Figure 5.1: linear light in 8 bits loses dark codes; 0 to 255 through table 5.1 leaves 184."""
    wide = Image(
        np.repeat((np.linspace(0.0, 1.0, 4096) ** 2.2)[None, :, None], 3, axis=2) * [0.9505, 1.0, 1.089]
    )
    wide.save(tmp_path / "ramp.exr")
    arguments = ["--display", "book NTSC", "--exposure", "1"]
    for pipeline in ("ideal", "traditional"):
        out = str(tmp_path / f"{pipeline}.png")
        assert run(["display", str(tmp_path / "ramp.exr"), out, *arguments, "--pipeline", pipeline]) == 0
    ideal, traditional = (
        np.unique(shown(tmp_path / f"{name}.png").codes[..., 1]) for name in ("ideal", "traditional")
    )
    assert len(ideal) == 256 and len(traditional) == 184
    assert {20, 28, 33, 38} <= set(traditional.tolist()) and 34 not in traditional  # table 5.1


@pytest.mark.parametrize("name", ["ordered-4", "blue-noise", "floyd-steinberg", "random"])
def test_dither_keeps_the_mean(exr: Path, tmp_path: Path, name: str) -> None:
    out = tmp_path / "a.png"
    assert run(["display", str(exr), str(out), "--exposure", "0.01", "--dither", name, "--bits", "2"]) == 0
    assert run(["display", str(exr), str(tmp_path / "b.png"), "--exposure", "0.01", "--bits", "16"]) == 0
    assert abs(shown(out).values[:8].mean() - shown(tmp_path / "b.png").values[:8].mean()) < 0.01


def test_run_lengths_hold_a_picture(exr: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["display", str(exr), "--exposure", "0.01", "--display", "book NTSC"]
    assert run([*arguments, str(tmp_path / "a.rle")]) == 0
    assert "Run lengths take" in capsys.readouterr().err
    assert run([*arguments, str(tmp_path / "a.png")]) == 0
    packed = Picture.open(tmp_path / "a.rle")
    assert (packed.codes == shown(tmp_path / "a.png").codes).all() and packed.display.gamma == 2.2
    assert run(["display", str(tmp_path / "a.rle"), str(tmp_path / "b.png")]) == 0
    assert run(["display", str(exr), str(tmp_path / "b.rle")]) == 2
    assert "sRGB with 8 bits is not that" in capsys.readouterr().err


def test_info_of_a_picture_says_how_it_was_shown(
    exr: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "a.png"
    assert (
        run(["display", str(exr), str(out), "--gamut", "clamp", "--dither", "ordered-4", "--bits", "4"]) == 0
    )
    capsys.readouterr()
    assert run(["info", str(out)]) == 0
    said = capsys.readouterr().out
    assert "PNG, 4 bits a channel, sRGB; display sRGB, tone none, gamut clamp, dither ordered-4" in said
    assert run(["info", str(out), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["look"]["dither"] == "ordered-4"


def test_info_of_run_lengths_says_their_display_and_what_they_save(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    codes = np.zeros((486, 512, 3), np.uint8)
    Picture(codes, displays.named("book NTSC")).save(tmp_path / "a.rle")
    assert run(["info", str(tmp_path / "a.rle")]) == 0
    said = capsys.readouterr().out
    assert "512x486" in said and "run lengths, 8 bits a channel, γ = 2.2" in said
    assert "9,808 bytes for 746,496, 76.1 to 1" in said
    assert run(["info", str(tmp_path / "a.rle"), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["compression"]["stored"] == 9808 and facts["display"]["response"] == "gamma 2.2"
    (tmp_path / "b.rle").write_bytes(b"ILRL")
    assert run(["info", str(tmp_path / "b.rle")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_opencolorio_agrees(exr: Path, tmp_path: Path) -> None:
    grey = Image(Image.open(exr).xyz[:8])
    grey.save(tmp_path / "grey.exr")
    arguments = [
        "display",
        str(tmp_path / "grey.exr"),
        str(tmp_path / "a.png"),
        "--exposure",
        "0.01",
        "--bits",
        "16",
    ]
    assert run([*arguments, "--ocio", "ocio://default", "--view", "Un-tone-mapped"]) == 0
    theirs = shown(tmp_path / "a.png")
    assert run(arguments) == 0
    np.testing.assert_allclose(theirs.values, shown(tmp_path / "a.png").values, atol=2e-4)


def test_what_is_no_number_is_black_and_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    xyz = np.full((4, 4, 3), 0.5)
    xyz[0, 0], xyz[1, 1, 1], xyz[2, 2] = np.nan, np.inf, -1e30
    Image(xyz).save(tmp_path / "a.exr")
    assert run(["display", str(tmp_path / "a.exr"), str(tmp_path / "a.png"), "--exposure", "1"]) == 0
    assert "2 pixels are no numbers, and black." in capsys.readouterr().err
    codes = shown(tmp_path / "a.png").codes
    assert codes[0, 0].tolist() == codes[1, 1].tolist() == codes[2, 2].tolist() == [0, 0, 0]


def bomb(path: Path) -> None:
    """A PNG that claims a trillion pixels."""
    content = png.SIGNATURE
    for kind, data in (
        (b"IHDR", struct.pack(">IIBBBBB", 1 << 20, 1 << 20, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(b"\0" * 1000)),
        (b"IEND", b""),
    ):
        content += struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(content)


def test_hostile_files_are_one_sentence(
    exr: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "cut.exr").write_bytes(exr.read_bytes()[:-300])
    (tmp_path / "text.png").write_text("no image")
    bomb(tmp_path / "bomb.png")
    PIL.Image.new("RGB", (2, 2)).save(tmp_path / "bare.png")
    spec = oiio.ImageSpec(2, 2, 2, oiio.FLOAT)
    spec.channelnames = ("U", "V")
    file = oiio.ImageOutput.create("uv.exr")
    assert file is not None
    file.open(str(tmp_path / "uv.exr"), spec)
    file.write_image(np.zeros((2, 2, 2), np.float32))
    file.close()
    for name, sentence in (
        ("cut.exr", "cannot be read"),
        ("text.png", "is not a whole PNG"),
        ("bomb.png", "has 1048576 × 1048576 pixels"),
        ("bare.png", "does not say which display"),
        ("uv.exr", "has no colour: its channels are U, V."),
        ("none.exr", "there is no such file"),
    ):
        assert run(["display", str(tmp_path / name), str(tmp_path / "out.png")]) == 2, name
        said = capsys.readouterr().err
        assert sentence in said and said.startswith("Error: ") and said.count("\n") == 1, said
        assert not (tmp_path / "out.png").exists()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["a.jpg"], "a picture for a display is saved as .png"),
        (["a.png", "--display", "CRT"], "There is no display 'CRT'"),
        (["a.png", "--gamut", "squash"], "There is no gamut method 'squash'"),
        (["a.png", "--dither", "salt"], "There is no dither 'salt'"),
        (["a.png", "--tone", "loud"], "There is no tone operator 'loud'"),
        (["a.png", "--transfer", "gamma 0"], "no response"),
        (["a.png", "--bits", "0"], "1 to 16 bits"),
        (["a.png", "--pipeline", "bad"], "There is no pipeline 'bad': known are ideal, traditional"),
        (["a.png", "--absolute", "--exposure", "1"], "goes without --exposure"),
        (["a.png", "--view", "x"], "go with --ocio"),
        (["a.png", "--ocio", "none.ocio"], "there is no such file"),
        (["a.png", "--ocio", "ocio://default", "--view", "x"], "has no view 'x'"),
        (["a.png", "--ocio", "ocio://default", "--gamut", "clamp"], "goes without --transfer"),
    ],
)
def test_a_wrong_option_is_one_sentence(
    exr: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    sentence: str,
) -> None:
    monkeypatch.chdir(exr.parent)
    assert run(["display", "a.exr", *arguments]) == 2
    said = capsys.readouterr().err
    assert sentence in said and said.startswith("Error: ") and said.count("\n") == 1, said


def test_the_figures_of_the_gamut_study_are_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["gamut", "strips", "-o", str(tmp_path / "s.png"), "--methods", "clamp,scale"]) == 0
    assert shown(tmp_path / "s.png").width == 768
    assert run(["gamut", "paths", "-o", str(tmp_path / "p.svg")]) == 0
    assert run(["gamut", "deviation", "-o", str(tmp_path / "d.svg"), "--measure", "de00"]) == 0
    assert {"p.svg", "d.svg"} <= {path.name for path in tmp_path.iterdir()}
    assert run(["gamut", "study", "--methods", "clamp,cook", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["cook"]["wide"]["hue"] < found["clamp"]["wide"]["hue"]
    assert run(["gamut", "study", "--methods", "squash"]) == 2
    assert "--methods squash: there is no such gamut method" in capsys.readouterr().err
