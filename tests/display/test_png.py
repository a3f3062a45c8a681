"""PNG files: valid for other readers, and labelled so that they show the same colour."""

import io
import json
import struct
import zlib
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import PIL.Image
import PIL.PngImagePlugin
import pytest
from PIL import ImageCms

from illuminant import png
from illuminant.display import displays
from illuminant.display.look import Look
from illuminant.display.picture import Picture
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
    saved = image.save(path, Look(bits=bits), exposure=0.0125)
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


@pytest.mark.parametrize(
    "name",
    [
        "sRGB",
        "Rec.709",
        "Rec.2020",
        "Display P3",
        "Adobe RGB",
        "Rec.2020 PQ",
        "Rec.2020 HLG",
        "ACES AP1",
        "XYZ",
    ],
)
def test_a_png_comes_back_as_the_same_colour(image: Image, tmp_path: Path, name: str) -> None:
    image.save(tmp_path / "a.png", Look(name, bits=16), exposure=0.01)
    back = Image.open(tmp_path / "a.png")
    np.testing.assert_allclose(back.xyz, image.xyz * 0.01, rtol=0, atol=3e-4)
    assert back.unit == "relative" and back.settings == image.settings


def test_srgb_is_stated(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png")
    found = chunks_of(tmp_path / "a.png")
    assert b"sRGB" in found and b"cICP" not in found and b"iCCP" not in found and b"sBIT" not in found
    assert struct.unpack(">I", found[b"gAMA"]) == (45455,)
    assert struct.unpack(">8I", found[b"cHRM"])[:4] == (31270, 32900, 64000, 33000)


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("Display P3", b"\x0c\x0d\x00\x01"),
        ("Rec.2020 PQ", b"\x09\x10\x00\x01"),
        ("Rec.2020 HLG", b"\x09\x12\x00\x01"),
        ("XYZ", b"\x0a\x08\x00\x01"),
    ],
)
def test_a_display_with_a_code_point_is_stated_by_it(
    image: Image, tmp_path: Path, name: str, code: bytes
) -> None:
    image.save(tmp_path / "a.png", Look(name))
    found = chunks_of(tmp_path / "a.png")
    assert found[b"cICP"] == code and b"sRGB" not in found and b"cHRM" in found and b"iCCP" not in found


@pytest.mark.parametrize(("name", "gamma"), [("Rec.709", 2.4), ("Adobe RGB", 563 / 256), ("book NTSC", 2.2)])
def test_any_other_display_is_stated_by_numbers_and_by_a_profile(
    image: Image, tmp_path: Path, name: str, gamma: float
) -> None:
    image.save(tmp_path / "a.png", Look(name))
    found = chunks_of(tmp_path / "a.png")
    assert b"sRGB" not in found and b"cICP" not in found
    assert struct.unpack(">I", found[b"gAMA"]) == (round(100_000 / gamma),)
    display = displays.named(name)
    stated = np.array(struct.unpack(">8I", found[b"cHRM"])) / 1e5
    np.testing.assert_allclose(stated, np.ravel([display.white, *display.primaries]), atol=6e-6)
    with PIL.Image.open(tmp_path / "a.png") as opened:
        profile = ImageCms.ImageCmsProfile(io.BytesIO(opened.info["icc_profile"]))
    assert ImageCms.getProfileDescription(profile).strip() == name


def without(path: Path, *kinds: bytes) -> Path:
    """The same file without some chunks, and without our own text."""
    kept = [(kind, data) for kind, data in png.chunks(path.read_bytes()) if kind not in (*kinds, b"iTXt")]
    content = png.SIGNATURE
    for kind, data in kept:
        content += struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.with_name("less.png").write_bytes(content)
    return path.with_name("less.png")


@pytest.mark.parametrize("name", ["sRGB", "Display P3", "Rec.2020 PQ", "Adobe RGB", "book NTSC", "Rec.709"])
def test_the_chunks_alone_say_the_same(image: Image, tmp_path: Path, name: str) -> None:
    image.save(tmp_path / "a.png", Look(name, bits=16), exposure=0.01)
    whole = Picture.open(tmp_path / "a.png")
    for dropped in [()] if name in ("sRGB", "Display P3", "Rec.2020 PQ") else [(), (b"iCCP",)]:
        found = Picture.open(without(tmp_path / "a.png", *dropped))
        np.testing.assert_allclose(
            found.xyz() / found.display.peak, whole.xyz() / whole.display.peak, rtol=0, atol=3e-4
        )


def test_chunks_are_believed_over_a_text_that_was_left_behind(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png", Look("Display P3"))
    with PIL.Image.open(tmp_path / "a.png") as opened:
        text = PIL.PngImagePlugin.PngInfo()
        text.add_itxt("Display", opened.text["Display"])
        profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
        opened.save(tmp_path / "b.png", pnginfo=text, icc_profile=profile)
    found = Picture.open(tmp_path / "b.png").display
    np.testing.assert_allclose(found.primaries, displays.named("sRGB").primaries, atol=1e-3)


def test_a_file_that_does_not_say_its_display_is_questioned(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png", exposure=0.01)
    bare = without(tmp_path / "a.png", b"sRGB", b"gAMA", b"cHRM")
    with pytest.raises(
        ImageError, match=r"less\.png does not say which display its numbers are for: name one"
    ):
        Image.open(bare)
    np.testing.assert_allclose(
        Image.open(bare, assume="sRGB").xyz, Image.open(tmp_path / "a.png").xyz, atol=1e-12
    )


@pytest.mark.parametrize("bits", [1, 2, 5, 10, 12])
def test_any_number_of_bits_comes_back(image: Image, tmp_path: Path, bits: int) -> None:
    picture = image.shown(Look(bits=bits), exposure=0.0125).picture
    assert picture.codes.max() == 2**bits - 1
    picture.save(tmp_path / "a.png")
    back = Picture.open(tmp_path / "a.png")
    assert back.bits == bits and (back.codes == picture.codes).all()
    assert chunks_of(tmp_path / "a.png")[b"sBIT"] == bytes([bits] * 3)


def test_a_display_that_no_png_can_state_is_refused(image: Image, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot state the primaries of ACES AP0"):
        image.save(tmp_path / "a.png", Look("ACES AP0"))
    with pytest.raises(UsageError, match=r"no display 'CMYK': known are sRGB, "):
        image.save(tmp_path / "a.png", Look("CMYK"))
    assert not list(tmp_path.iterdir())


def test_a_grey_file_and_one_with_opacity_are_read_as_they_are(tmp_path: Path) -> None:
    PIL.Image.new("L", (2, 1), 100).save(tmp_path / "grey.png")
    assert (Picture.open(tmp_path / "grey.png", "sRGB").codes == 100).all()
    PIL.Image.new("RGBA", (2, 1), (200, 100, 50, 10)).save(tmp_path / "clear.png")
    assert Picture.open(tmp_path / "clear.png", "sRGB").codes[0, 0].tolist() == [200, 100, 50]


def test_the_text_says_what_made_it_and_what_one_means(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png", exposure=0.0125)
    header = png.read_header(tmp_path / "a.png")
    assert header.text["Software"].startswith("illuminant ")
    assert header.text["Description"] == "display white is 80 cd/m2 (exposure 0.0125)"
    assert float(header.text["Exposure"]) == 0.0125
    assert header.text["Unit"] == "cd/m2"
    assert header.settings == {"scene": "a.toml", "samples": 4}
    with PIL.Image.open(tmp_path / "a.png") as opened:
        assert json.loads(opened.text["Display"])["name"] == "sRGB"
        assert json.loads(opened.text["Look"])["gamut"] == "cook"


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
