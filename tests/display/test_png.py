"""PNG files: valid for other readers, and labelled so that they show the same colour."""

import struct
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import PIL.Image
import pytest

from illuminant import png
from illuminant.errors import ImageError, UsageError
from illuminant.image import Image


def chunks_of(path: Path) -> dict[bytes, bytes]:
    return dict(png.chunks(path.read_bytes()))


@pytest.fixture
def image() -> Image:
    ramp = np.linspace(0.0, 80.0, 33)
    xyz = ramp[None, :, None] * np.array([0.9504559, 1.0, 1.0890578])
    return Image(np.repeat(xyz, 5, axis=0), settings={"scene": "a.toml", "samples": 4})


@pytest.mark.parametrize("bits", [8, 16])
def test_other_readers_agree_on_the_pixels(image: Image, tmp_path: Path, bits: int) -> None:
    path = tmp_path / "a.png"
    saved = image.save(path, exposure=0.0125, bits=bits)
    assert saved == (path, 0.0125, False, pytest.approx(0.0, abs=0.1))
    with PIL.Image.open(path) as opened:
        opened.load()
        assert opened.size == (33, 5)
        if bits == 8:
            assert opened.getpixel((32, 0)) == (255, 255, 255)
            assert opened.getpixel((0, 0)) == (0, 0, 0)
    file = oiio.ImageInput.open(str(path))
    assert file.spec().format == (oiio.UINT8 if bits == 8 else oiio.UINT16)
    code = np.asarray(file.read_image(oiio.DOUBLE))[0, 16]
    file.close()
    np.testing.assert_allclose(code, 1.055 * 0.5 ** (1 / 2.4) - 0.055, atol=0.6 / (2**bits - 1))


@pytest.mark.parametrize("rgb", ["sRGB", "Rec.709", "Rec.2020", "Display P3", "Adobe RGB", "ACES AP1", "XYZ"])
def test_a_png_comes_back_as_the_same_colour(image: Image, tmp_path: Path, rgb: str) -> None:
    image.save(tmp_path / "a.png", exposure=0.01, rgb=rgb, bits=16)
    back = Image.open(tmp_path / "a.png")
    np.testing.assert_allclose(back.xyz, image.xyz * 0.01, rtol=0, atol=3e-4)
    assert back.unit == "relative" and back.settings == image.settings


def test_srgb_is_stated(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png")
    found = chunks_of(tmp_path / "a.png")
    assert b"sRGB" in found and b"cICP" not in found
    assert struct.unpack(">I", found[b"gAMA"]) == (45455,)
    assert struct.unpack(">8I", found[b"cHRM"])[:4] == (31270, 32900, 64000, 33000)


def test_other_systems_are_stated_by_code_point_or_by_primaries(image: Image, tmp_path: Path) -> None:
    for rgb, code in (
        ("Rec.2020", b"\x09\x0e\x00\x01"),
        ("Display P3", b"\x0c\x0d\x00\x01"),
        ("Adobe RGB", None),
    ):
        image.save(tmp_path / "a.png", rgb=rgb)
        found = chunks_of(tmp_path / "a.png")
        assert found.get(b"cICP") == code and b"sRGB" not in found and b"cHRM" in found, rgb


def test_a_system_that_no_png_can_state_is_refused(image: Image, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot state the primaries of ACES AP0"):
        image.save(tmp_path / "a.png", rgb="ACES AP0")
    with pytest.raises(UsageError, match=r"no RGB system 'CMYK': known are sRGB, "):
        image.save(tmp_path / "a.png", rgb="CMYK")
    assert not list(tmp_path.iterdir())


def test_the_text_says_what_made_it_and_what_one_means(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png", exposure=0.0125)
    header = png.read_header(tmp_path / "a.png")
    assert header.text["Software"].startswith("illuminant ")
    assert header.text["Description"] == "display white is 80 cd/m2 (exposure 0.0125)"
    assert float(header.text["Exposure"]) == 0.0125
    assert header.text["Unit"] == "cd/m2"
    assert header.settings == {"scene": "a.toml", "samples": 4}
    with PIL.Image.open(tmp_path / "a.png") as opened:
        assert opened.text["RGB system"] == "sRGB"


def test_the_chosen_exposure_repeats_the_bytes(image: Image, tmp_path: Path) -> None:
    saved = image.save(tmp_path / "a.png")
    assert saved.chosen and saved.exposure is not None
    image.save(tmp_path / "b.png", exposure=float(f"{saved.exposure:g}"))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_notebook_gets_a_png(image: Image) -> None:
    content = image._repr_png_()
    assert next(kind for kind, _ in png.chunks(content)) == b"IHDR"


def test_damage_is_one_sentence(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png")
    content = (tmp_path / "a.png").read_bytes()
    (tmp_path / "cut.png").write_bytes(content[:-20])
    (tmp_path / "flipped.png").write_bytes(content[:60] + bytes([content[60] ^ 1]) + content[61:])
    (tmp_path / "text.png").write_text("no image")
    for name in ("cut.png", "flipped.png", "text.png"):
        with pytest.raises(ImageError, match=rf"{name} is not a whole PNG"):
            Image.open(tmp_path / name)
    with pytest.raises(ImageError, match=r"none\.png cannot be read: there is no such file\."):
        Image.open(tmp_path / "none.png")
