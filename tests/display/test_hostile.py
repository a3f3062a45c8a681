"""Broken, foreign and oversized image files: one clear sentence, or a repair that the documentation tells."""

import json
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio
import PIL.Image
import pytest

from illuminant import exr, info, machine, png
from illuminant.cli import run
from illuminant.display import displays, run_length
from illuminant.display.picture import Picture
from illuminant.errors import ImageError, MachineError, UsageError
from illuminant.image import Image

NESTED = "[" * 100_000
XYZ = ("float[8]", exr.XYZ)


def write_exr(
    path: Path,
    attributes: dict[str, Any],
    pixels: Any = None,
    names: tuple[str, ...] = ("R", "G", "B"),
    windows: tuple[int, ...] = (),
) -> Path:
    """An EXR with any attributes; windows are x, y, full_x, full_y, full_width, full_height."""
    pixels = np.ones((2, 3, len(names)), np.float32) if pixels is None else np.asarray(pixels, np.float32)
    height, width, count = pixels.shape
    spec = oiio.ImageSpec(width, height, count, oiio.FLOAT)
    spec.channelnames = names
    if windows:
        spec.x, spec.y, spec.full_x, spec.full_y, spec.full_width, spec.full_height = windows
    for key, value in attributes.items():
        if isinstance(value, tuple):
            spec.attribute(key, *value)
        else:
            spec.attribute(key, value)
    file = oiio.ImageOutput.create(str(path))
    assert file is not None
    assert file.open(str(path), spec) and file.write_image(pixels), file.geterror()
    file.close()
    return path


def write_png(
    path: Path, *extra: tuple[bytes, bytes], header: bytes = b"", pixels: bytes | None = None
) -> Path:
    """A PNG of 2 × 2 grey-blue pixels with further chunks before the pixels."""
    header = header or struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)
    rows = (b"\0" + bytes((100, 100, 120)) * 2) * 2
    data = zlib.compress(rows) if pixels is None else pixels
    content = png.SIGNATURE
    for kind, body in ((b"IHDR", header), *extra, (b"IDAT", data), (b"IEND", b"")):
        content += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(content)
    return path


def text(keyword: str, value: str) -> tuple[bytes, bytes]:
    return b"tEXt", keyword.encode("latin-1") + b"\0" + value.encode("latin-1")


@pytest.mark.parametrize("value", [np.inf, np.nan, -np.inf])
def test_an_image_of_no_numbers_has_exposure_one_and_is_black(value: float, tmp_path: Path) -> None:
    image = Image(np.full((4, 4, 3), value))
    assert image.auto_exposure() == 1.0 and image.white() == 0.0
    assert image.save(tmp_path / "a.png").exposure == 1.0
    assert Picture.open(tmp_path / "a.png").codes.max() == 0


def test_one_infinite_pixel_has_no_say_in_the_exposure() -> None:
    xyz = np.zeros((10, 10, 3))
    xyz[0, 0] = np.inf
    assert Image(xyz).auto_exposure() == 1.0
    xyz[1, 1] = 40.0  # alone above 0, and beyond the percentile
    assert Image(xyz).auto_exposure() == 0.02
    emission = np.zeros((10, 10, 1))
    xyz[2:] = 80.0
    assert Image(xyz, layers={"emission": emission}).auto_exposure() == 0.01


def test_an_exposure_that_is_none_is_refused() -> None:
    with pytest.raises(UsageError, match="An exposure is a positive number, not inf"):
        Image(np.ones((1, 1, 3))).shown(exposure=np.inf)


@pytest.mark.parametrize(
    "attributes",
    [
        {"illuminant:exposure": "abc"},
        {"illuminant:exposure": -1.0},
        {"illuminant:exposure": float("inf")},
        {"illuminant:exposure": ("float[3]", (1.0, 2.0, 3.0))},
        {"whiteLuminance": "abc"},
        {"whiteLuminance": float("nan")},
        {"illuminant:unit": 3.0},
        {"illuminant:settings": 3.0},
        {"illuminant:settings": "[1]"},
        {"illuminant:basis": 3.0},
    ],
)
def test_an_attribute_of_another_type_is_left_out(attributes: dict[str, Any], tmp_path: Path) -> None:
    path = write_exr(tmp_path / "a.exr", {"chromaticities": XYZ, **attributes})
    image = Image.open(path)
    assert (image.xyz == 1.0).all() and image.exposure is None and image.settings == {}
    assert run(["info", str(path)]) == 0


@pytest.mark.parametrize(
    ("attributes", "sentence"),
    [
        ({"illuminant:toXYZ": "abc"}, "illuminant:toXYZ holds no numbers"),
        ({"illuminant:toXYZ": ("float[4]", (1.0, 2.0, 3.0, 4.0))}, "illuminant:toXYZ has 4 numbers"),
        ({"illuminant:settings": NESTED}, "its attribute illuminant:settings is damaged"),
        ({"illuminant:settings": "{"}, "its attribute illuminant:settings is damaged"),
        ({"chromaticities": ("float[8]", (*exr.XYZ[:7], 0.0))}, "its white has a y of 0"),
        ({"chromaticities": ("float[8]", (*exr.XYZ[:7], float("nan")))}, "are not x and y of four colours"),
        ({"chromaticities": ("float[8]", (0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.3, 0.3))}, "lie on one line"),
        ({"chromaticities": ("float[8]", (0.0,) * 8)}, "its white has a y of 0"),
    ],
)
def test_a_damaged_attribute_is_one_sentence(
    attributes: dict[str, Any], sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_exr(tmp_path / "a.exr", {"chromaticities": XYZ, **attributes})
    for command in (["display", str(path), str(tmp_path / "a.png")], ["info", str(path)]):
        assert run(command) == 2
        said = capsys.readouterr().err
        assert sentence in said and said.startswith("Error: ") and said.count("\n") == 1, said


def test_bytes_that_are_no_text_are_one_sentence(tmp_path: Path) -> None:
    """Every byte of the header in turn becomes one that UTF-8 does not have."""
    content = write_exr(tmp_path / "a.exr", {"chromaticities": XYZ, "illuminant:unit": "cd/m2"}).read_bytes()
    refused = 0
    for at in range(4, 400):
        (tmp_path / "b.exr").write_bytes(content[:at] + b"\xff" + content[at + 1 :])
        try:
            Image.open(tmp_path / "b.exr")
        except (ImageError, MachineError) as error:
            refused += 1
            assert "\n" not in str(error)
    assert refused > 50


def test_infinite_pixels_of_another_system_are_read_without_a_warning(tmp_path: Path) -> None:
    pixels = np.ones((2, 2, 3))
    pixels[0, 0, 0] = np.inf
    rec709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
    image = Image.open(write_exr(tmp_path / "a.exr", {"chromaticities": ("float[8]", rec709)}, pixels))
    np.testing.assert_allclose(image.xyz[1, 1], [0.9505, 1.0, 1.0891], atol=2e-4)


@pytest.mark.parametrize("names", [("Y", "RY", "BY"), ("BY", "RY", "Y")])
def test_luminance_and_chroma_are_refused_by_name(names: tuple[str, ...], tmp_path: Path) -> None:
    path = write_exr(tmp_path / "a.exr", {}, names=names)
    with pytest.raises(ImageError, match="its channels Y, RY, BY are luminance and chroma"):
        Image.open(path)


def test_a_data_window_is_put_into_the_display_window(tmp_path: Path) -> None:
    pixels = np.arange(1.0, 7.0).reshape(2, 3, 1).repeat(3, axis=2)
    path = write_exr(tmp_path / "a.exr", {"chromaticities": XYZ}, pixels, windows=(12, 21, 10, 20, 4, 5))
    expected = np.zeros((5, 4))
    expected[1:3, 2:4] = [[1, 2], [4, 5]]
    assert np.array_equal(Image.open(path).xyz[..., 1], expected)
    path = write_exr(tmp_path / "b.exr", {"chromaticities": XYZ}, pixels, windows=(-1, -1, 0, 0, 2, 2))
    assert np.array_equal(Image.open(path).xyz[..., 1], [[5, 6], [0, 0]])


DISPLAY = '{"name": "a", "primaries": [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]], "white": [%s, %s]}'


@pytest.mark.parametrize(
    "value",
    [
        DISPLAY % ("1" + "0" * 400, "0.3"),
        DISPLAY % ("1" + "0" * 5000, "0.3"),
        DISPLAY % ("0.3", "0"),
        DISPLAY % ("NaN", "0.3"),
        NESTED,
        "[1]",
        "5",
        '{"name": "a", "primaries": [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]], "white": [0.3, 0.3]}',
    ],
)
def test_a_text_that_is_no_display_is_passed_over(value: str, tmp_path: Path) -> None:
    path = write_png(tmp_path / "a.png", text("Display", value), (b"sRGB", b"\0"))
    assert Picture.open(path).display.name == "sRGB"


@pytest.mark.parametrize("xy", [(0.3, 0.0, *[0.1] * 6), (0.3, 0.3, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3)])
def test_numbers_that_are_no_display_state_none(xy: tuple[float, ...], tmp_path: Path) -> None:
    chrm = struct.pack(">8I", *(round(value * 1e5) for value in xy))
    path = write_png(tmp_path / "a.png", (b"gAMA", struct.pack(">I", 45455)), (b"cHRM", chrm))
    with pytest.raises(ImageError, match="does not say which display"):
        Picture.open(path)


@pytest.mark.parametrize("keyword", ["", "a" * 80, "a\nb", " a", "a  b", "\x80"])
def test_a_keyword_that_png_forbids_is_kept_but_never_written(keyword: str, tmp_path: Path) -> None:
    path = write_png(tmp_path / "a.png", (b"sRGB", b"\0"), text(keyword, "x"), text("Title", "räume"))
    picture = Picture.open(path)
    assert picture.text == {keyword: "x", "Title": "räume"}
    picture.save(tmp_path / "b.png")
    assert set(Picture.open(tmp_path / "b.png").text) == {"Title", "Display"}


def test_a_file_states_its_display_once_and_the_picture_stays_as_it_was(tmp_path: Path) -> None:
    write_png(tmp_path / "a.png", (b"sRGB", b"\0")).read_bytes()
    picture = Picture.open(tmp_path / "a.png")
    picture.text["Display"] = json.dumps(displays.named("Adobe RGB").to_dict())
    before = dict(picture.text)
    picture.save(tmp_path / "b.png", {"Title": "x"})
    assert picture.text == before
    written = [data for kind, data in png.chunks((tmp_path / "b.png").read_bytes()) if kind == b"iTXt"]
    assert sum(data.startswith(b"Display\0") for data in written) == 1
    assert Picture.open(tmp_path / "b.png").display.name == "sRGB"
    assert Picture.open(tmp_path / "b.png").text["Title"] == "x"


@pytest.mark.parametrize(
    "code", [b"\x09\x10\x01\x01", b"\x09\x10\x00\x00", b"\x09\x10\x00", b"", b"\x63\x10\x00\x01"]
)
def test_a_code_point_that_no_png_has_is_passed_over(code: bytes, tmp_path: Path) -> None:
    path = write_png(tmp_path / "a.png", (b"cICP", code), (b"sRGB", b"\0"))
    assert Picture.open(path).display.name == "sRGB"
    path = write_png(tmp_path / "a.png", (b"cICP", b"\x09\x10\x00\x01"), (b"sRGB", b"\0"))
    assert Picture.open(path).display.name == "Rec.2020 PQ"


def test_a_text_that_inflates_without_end_is_refused(tmp_path: Path) -> None:
    packed = zlib.compress(bytes((1 << 24) + 1))
    for chunk in ((b"zTXt", b"Comment\0\0" + packed), (b"iTXt", b"Comment\0\1\0\0\0" + packed)):
        with pytest.raises(ImageError, match=r"its text 'Comment' is larger than 16,777,216 bytes"):
            Picture.open(write_png(tmp_path / "a.png", chunk))


def test_many_texts_that_inflate_are_refused(tmp_path: Path) -> None:
    packed = zlib.compress(bytes(1 << 23))
    chunks = [(b"zTXt", b"Comment %d\0\0" % number + packed) for number in range(3)]
    assert len(Picture.open(write_png(tmp_path / "a.png", *chunks[:2]), "sRGB").text) == 2
    with pytest.raises(ImageError, match=r"its texts are longer than 16,777,216 letters"):
        Picture.open(write_png(tmp_path / "a.png", *chunks), "sRGB")


HEADER = struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)


@pytest.mark.parametrize(
    ("header", "pixels", "sentence"),
    [
        (HEADER, zlib.compress(bytes(10)), "its pixels have 10 bytes instead of 14"),
        (HEADER, zlib.compress(bytes(14))[:-9], "its pixels have"),
        (HEADER, zlib.compress(bytes(14))[:-2], "its pixels end too soon"),
        (HEADER, zlib.compress(bytes(15)), "its pixels have more than 14 bytes"),
        (HEADER, zlib.compress(bytes(14))[:-1] + b"\xff", "incorrect data check"),
        (HEADER, b"", "its pixels have 0 bytes"),
        (HEADER, b"abc", "incorrect header check"),
        (HEADER, zlib.compress(b"\7" + bytes(13)), "its pixels have an unknown filter"),
        (HEADER, zlib.compress(bytes(7) + b"\7" + bytes(6)), "its pixels have an unknown filter"),
        (struct.pack(">IIBBBBB", 2, 2, 3, 2, 0, 0, 0), zlib.compress(bytes(14)), "is of no kind of PNG"),
        (struct.pack(">IIBBBBB", 2, 2, 8, 3, 0, 0, 0), zlib.compress(bytes(6)), "its palette is missing"),
        (struct.pack(">IIBBBBB", 9, 9, 8, 0, 0, 0, 1), zlib.compress(bytes(50)), "its pixels have 50 bytes"),
        (HEADER[:9], zlib.compress(bytes(14)), "is not a whole PNG"),
        (
            struct.pack(">IIBBBBB", 1 << 14, 1 << 14, 8, 2, 0, 0, 0),
            zlib.compress(bytes(1 << 20)),
            "its pixels have",
        ),
    ],
)
def test_missing_pixels_are_one_sentence_and_no_other(
    header: bytes,
    pixels: bytes,
    sentence: str,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(machine, "memory_available", lambda: None)
    path = write_png(tmp_path / "a.png", header=header, pixels=pixels)
    assert run(["display", str(path), str(tmp_path / "b.png"), "--assume", "sRGB"]) == 2
    said = capfd.readouterr()
    assert sentence in said.err and said.err.startswith("Error: ") and said.err.count("\n") == 1, said.err
    assert not said.out


PALETTE = (b"PLTE", bytes(6))


@pytest.mark.parametrize(
    ("extra", "sentence"),
    [
        ([(b"IHDR", HEADER)], "it has more than one IHDR chunk"),
        ([(b"IEND", b"")], "it has more than one IEND chunk"),
        ([PALETTE, PALETTE], "it has more than one PLTE chunk"),
        ([(b"PLTE", bytes(7))], "its palette is not of 1 to 256 colours"),
        ([(b"IDAT", b""), text("Title", "x")], "other chunks part its pixels"),
        ([(b"IDAT", b""), PALETTE], "other chunks part its pixels"),
        ([(b"ABCD", b"")], "it has a chunk 'ABCD' that is unknown"),
    ],
)
def test_chunks_out_of_order_are_one_sentence_and_no_other(
    extra: list[tuple[bytes, bytes]], sentence: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = write_png(tmp_path / "a.png", (b"sRGB", b"\0"), *extra)
    assert run(["display", str(path), str(tmp_path / "b.png")]) == 2
    said = capfd.readouterr().err
    assert sentence in said and said.startswith("Error: ") and said.count("\n") == 1, said


@pytest.mark.parametrize("length", [1, 2, 5, 8191])
def test_pixels_in_many_chunks_are_read(length: int, tmp_path: Path) -> None:
    data = zlib.compress((b"\0" + bytes((100, 100, 120)) * 2) * 2)
    parts = [(b"IDAT", data[at : at + length]) for at in range(0, len(data), length)]
    path = write_png(tmp_path / "a.png", *parts, pixels=b"")
    assert (Picture.open(path, "sRGB").codes == (100, 100, 120)).all()


@pytest.mark.parametrize(("mode", "size"), [("1", (13, 5)), ("L", (3, 3)), ("P", (9, 4)), ("RGBA", (17, 9))])
def test_whole_files_of_every_kind_are_read(mode: str, size: tuple[int, int], tmp_path: Path) -> None:
    rng = np.random.default_rng(7)
    codes = rng.integers(0, 256, (size[1], size[0], 4), np.uint8)
    picture = PIL.Image.fromarray(codes, "RGBA").convert("RGB").convert(mode)
    if mode == "RGBA":
        picture.putalpha(PIL.Image.fromarray(codes[..., 3]))
    picture.save(tmp_path / "a.png")
    read = Picture.open(tmp_path / "a.png", "sRGB")
    expected = np.asarray(picture.convert("RGB")) // (255 if mode == "1" else 1)
    assert np.array_equal(read.codes, expected)


def test_an_interlaced_file_is_read(tmp_path: Path) -> None:
    rows = b""
    values = np.arange(1, 10).reshape(3, 3)
    for left, top, across, down in png._PASSES:
        part = values[top::down, left::across]
        if part.size:
            rows += b"".join(b"\0" + bytes(row.tolist()) for row in part)
    header = struct.pack(">IIBBBBB", 3, 3, 8, 0, 0, 0, 1)
    path = write_png(tmp_path / "a.png", header=header, pixels=zlib.compress(rows))
    assert np.array_equal(Picture.open(path, "sRGB").codes[..., 0], values)


def test_what_does_not_fit_into_memory_is_refused_before_it_is_decoded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    image = Image(np.ones((100, 100, 3)))
    image.save(tmp_path / "a.exr")
    image.save(tmp_path / "a.png")
    picture = Picture.open(tmp_path / "a.png")
    Picture(picture.codes, displays.named("book NTSC")).save(tmp_path / "a.rle")
    for name, needed in (("a.exr", 12 * 30_000), ("a.png", 800_000), ("a.rle", 800_000)):
        monkeypatch.setattr(machine, "memory_available", lambda free=needed: free)
        Image.open(tmp_path / name)
        monkeypatch.setattr(machine, "memory_available", lambda free=needed - 1: free)
        with pytest.raises(
            MachineError, match=rf"{name} needs about {needed // 1000} kB of memory, and .* are free"
        ):
            Image.open(tmp_path / name)
        assert run(["display", str(tmp_path / name), str(tmp_path / "out.png")]) == 3
        assert capsys.readouterr().err.count("\n") == 1


def test_a_matte_is_kept_from_run_lengths_to_run_lengths(tmp_path: Path) -> None:
    rng = np.random.default_rng(2)
    codes, matte = rng.integers(0, 256, (5, 7, 3), np.uint8), rng.integers(0, 256, (5, 7), np.uint8)
    Picture(codes, displays.named("book NTSC"), matte=matte).save(tmp_path / "a.rle")
    picture = Picture.open(tmp_path / "a.rle")
    assert picture.matte is not None and np.array_equal(picture.matte, matte)
    picture.save(tmp_path / "b.rle")
    again = run_length.read(tmp_path / "b.rle")
    assert again.matte is not None and np.array_equal(again.matte, matte) and np.array_equal(again.rgb, codes)
    picture.save(tmp_path / "c.png")
    assert Picture.open(tmp_path / "c.png").matte is None
    with pytest.raises(UsageError, match=r"The matte of this picture is uint8 of shape \(5, 7\)"):
        Picture(codes, displays.named("sRGB"), matte=matte[1:])


def test_opacity_is_a_matte(tmp_path: Path) -> None:
    PIL.Image.new("RGBA", (2, 1), (200, 100, 50, 10)).save(tmp_path / "a.png")
    picture = Picture.open(tmp_path / "a.png", "book NTSC")
    assert picture.matte is not None and (picture.matte == 10).all()
    picture.save(tmp_path / "a.rle")
    found = run_length.read(tmp_path / "a.rle")
    assert (
        found.matte is not None and (found.matte == 10).all() and found.rgb[0, 0].tolist() == [200, 100, 50]
    )


@pytest.mark.parametrize(
    ("keyword", "value"),
    [
        ("Exposure", "abc"),
        ("Exposure", "0"),
        ("Exposure", "nan"),
        ("Exposure", "1e-320"),
        ("Settings", '{"size": 5}'),
        ("Settings", '{"size": ["a", {}]}'),
        ("Settings", '{"samples": [], "scene": "a.toml"}'),
        ("Settings", '{"samples": ["a"], "scene": ["a"]}'),
        ("Settings", '{"developed": 3}'),
        ("Settings", '{"developed": [3, {}, {"stage": 4}]}'),
        ("Settings", NESTED),
        ("Look", '{"gamut": [], "bits": {}}'),
        ("Look", "[1]"),
    ],
)
def test_facts_of_another_form_are_left_out(keyword: str, value: str, tmp_path: Path) -> None:
    path = write_png(tmp_path / "a.png", (b"sRGB", b"\0"), text(keyword, value))
    facts = info.image_facts(path)
    assert "exposure" not in facts and not {"size", "samples"} & set(facts["settings"])
    assert run(["info", str(path)]) == 0 and run(["info", str(path), "--json"]) == 0
