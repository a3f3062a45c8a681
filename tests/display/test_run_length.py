"""Run-length encoded images: nothing is lost, and no file does harm."""

import struct
import time
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from illuminant.display import run_length
from illuminant.errors import ImageError, UsageError

NTSC = ((0.67, 0.33), (0.21, 0.71), (0.14, 0.08))
D65 = (0.3127, 0.3290)
HEADER = 88


def encoded(rgb: np.ndarray, matte: np.ndarray | None = None, gamma: float | None = 2.2) -> bytes:
    return run_length.encode(rgb, matte, primaries=NTSC, white=D65, gamma=gamma)


def reference(content: bytes) -> np.ndarray:
    """Decodes as the format is written down, one record after the other."""
    channels, (width, height) = content[5], struct.unpack_from(">II", content, 8)
    counts = struct.unpack_from(f">{height}I", content, HEADER)
    record = HEADER + 4 * height
    value = record + sum(counts)
    image = np.zeros((height, width, channels), dtype=np.uint8)
    for y, count in enumerate(counts):
        x = 0
        for _ in range(count):
            number = content[record] % 128 + 1
            kept = 1 if content[record] >= 128 else number
            pixels = np.frombuffer(content, np.uint8, channels * kept, value).reshape(kept, channels)
            image[y, x : x + number] = pixels
            x, record, value = x + number, record + 1, value + channels * kept
        assert x == width
    assert value == len(content)
    return image


def drawn(width: int = 640, height: int = 486) -> tuple[np.ndarray, np.ndarray]:
    """Three shaded balls over a chequered floor, and how much of each pixel they cover."""
    y, x = np.mgrid[0:height, 0:width].astype(np.float64)
    rgb = np.empty((height, width, 3))
    rgb[:] = (20, 30, 70)
    floor = y > 0.6 * height
    checks = ((x // 40 + y // 30) % 2)[..., None] * 120 + 60
    rgb[floor] = np.broadcast_to(checks, rgb.shape)[floor]
    matte = np.zeros((height, width))
    for cx, cy, radius, color in (
        (150, 240, 90, (1, 0.2, 0.1)),
        (330, 200, 70, (0.1, 0.8, 0.3)),
        (480, 260, 110, (0.2, 0.3, 1)),
    ):
        distance = np.hypot(x - cx, y - cy)
        cover = np.clip(radius + 0.5 - distance, 0, 1)
        height_of_ball = np.sqrt(np.clip(radius**2 - distance**2, 0, None)) / radius
        lit = np.clip(0.3 + 0.7 * (height_of_ball - (x - cx) / radius / 2), 0, 1)
        rgb += cover[..., None] * (255 * lit[..., None] * np.array(color) - rgb)
        matte = np.maximum(matte, cover)
    return np.rint(rgb).astype(np.uint8), np.rint(255 * matte).astype(np.uint8)


few_colours = arrays.arrays(
    np.uint8,
    st.tuples(st.integers(1, 6), st.integers(1, 300), st.just(4)),
    elements=st.sampled_from([0, 255]),
    fill=st.just(7),
)


@settings(max_examples=80, deadline=None)
@given(image=few_colours, with_matte=st.booleans())
def test_nothing_is_lost(image: np.ndarray, with_matte: bool) -> None:
    matte = image[..., 3] if with_matte else None
    content = encoded(image[..., :3], matte)
    back = run_length.decode(content)
    assert (back.rgb == image[..., :3]).all()
    if matte is None:
        assert back.matte is None
    else:
        assert back.matte is not None and (back.matte == matte).all()
    assert (reference(content)[..., :3] == image[..., :3]).all()


@pytest.mark.parametrize("width", [1, 2, 127, 128, 129, 256, 257, 1000])
def test_runs_and_stretches_longer_than_a_record_are_split(width: int) -> None:
    flat = np.full((3, width, 3), 9, dtype=np.uint8)
    noise = np.random.default_rng(1).integers(0, 256, (3, width, 3), dtype=np.uint8)
    for rgb in (flat, noise, np.concatenate([flat, noise], axis=1)):
        content = encoded(rgb)
        assert (run_length.decode(content).rgb == rgb).all()
        assert (reference(content) == rgb).all()
    assert run_length.compression(encoded(flat)).records == 3 * -(-width // 128)


def test_a_run_ends_with_its_line() -> None:
    content = encoded(np.zeros((5, 7, 3), dtype=np.uint8))
    assert struct.unpack_from(">5I", content, HEADER) == (1, 1, 1, 1, 1)
    assert content[HEADER + 20 : HEADER + 25] == bytes([128 + 6] * 5)


def test_the_bytes_are_those_of_the_page() -> None:
    rgb = np.array([[[1, 2, 3]] * 3 + [[4, 5, 6], [7, 8, 9]]], dtype=np.uint8)
    content = encoded(rgb, gamma=None)
    assert content[:16] == b"ILRL\x01\x03\x00\x00" + struct.pack(">II", 5, 1)
    assert struct.unpack_from(">9d", content, 16) == (0.67, 0.33, 0.21, 0.71, 0.14, 0.08, 0.3127, 0.329, 1.0)
    assert content[HEADER:] == struct.pack(">I", 2) + bytes([0x82, 0x01]) + bytes(range(1, 10))


def test_a_run_needs_equal_mattes() -> None:
    rgb = np.zeros((1, 6, 3), dtype=np.uint8)
    matte = np.array([[0, 0, 0, 255, 255, 255]], dtype=np.uint8)
    assert run_length.compression(encoded(rgb)).records == 1
    assert run_length.compression(encoded(rgb, matte)).records == 2


@pytest.mark.parametrize("gamma", [None, 1.0, 2.2])
def test_the_header_says_what_the_numbers_mean(gamma: float | None, tmp_path: Path) -> None:
    rgb, matte = drawn(64, 48)
    path = tmp_path / "a.rle"
    saved = run_length.write(path, rgb, matte, primaries=NTSC, white=D65, gamma=gamma)
    back = run_length.read(path)
    assert (back.primaries, back.white, back.gamma) == (NTSC, D65, gamma)
    assert back.matte is not None and (back.rgb == rgb).all() and (back.matte == matte).all()
    assert saved.stored == path.stat().st_size and saved.unpacked == 64 * 48 * 4


def test_a_synthetic_image_is_reduced_as_the_book_says() -> None:
    rgb, matte = drawn()
    for found in (run_length.compression(encoded(rgb)), run_length.compression(encoded(rgb, matte))):
        assert 0.50 <= found.reduction <= 0.85
        assert found.ratio == pytest.approx(1 / (1 - found.reduction))


def test_an_image_without_runs_grows_by_less_than_two_in_a_hundred() -> None:
    noise = np.random.default_rng(2).integers(0, 256, (200, 512, 3), dtype=np.uint8)
    assert -0.02 < run_length.compression(encoded(noise)).reduction < 0


def test_sizes_are_those_of_the_book() -> None:
    width, height = run_length.FORMATS["video"]
    assert run_length.storage(width, height) == 746_496
    assert run_length.storage(width, height, matte=True) == 995_328
    assert run_length.storage(width, height, floating=True) == 2_985_984
    with pytest.raises(UsageError, match="at least one pixel"):
        run_length.storage(0, 5)


def test_a_4k_image_takes_about_a_second() -> None:
    rgb, matte = drawn()
    rgb, matte = (np.tile(a, (5, 7) + (1,) * (a.ndim - 2))[:2160, :4096] for a in (rgb, matte))
    begin = time.process_time()
    content = encoded(rgb, matte)
    back = run_length.decode(content)
    # A machine under load is slower than the second that this takes, but not ten times.
    assert time.process_time() - begin < 10.0
    assert (back.rgb == rgb).all()


@cache
def small() -> bytes:
    """The edge of a ball, 32 x 4 pixels."""
    rgb, matte = drawn()
    return encoded(rgb[200:204, 230:262], matte[200:204, 230:262])


def test_a_file_cut_anywhere_is_refused() -> None:
    content = small()
    assert len(content) > 150
    for end in range(len(content)):
        with pytest.raises(ImageError):
            run_length.decode(content[:end])
        with pytest.raises(ImageError):
            run_length.compression(content[:end])


@settings(max_examples=150, deadline=None)
@given(
    changes=st.lists(st.tuples(st.integers(0, 400), st.integers(0, 255)), min_size=1, max_size=6),
    junk=st.binary(max_size=200),
)
def test_damage_is_an_image_error_or_another_image(changes: list[tuple[int, int]], junk: bytes) -> None:
    content = bytearray(small())
    for at, value in changes:
        content[at % len(content)] = value
    for bytes_ in (bytes(content), junk, small()[:HEADER] + junk, small() + junk[:20]):
        try:
            found = run_length.decode(bytes_)
        except ImageError:
            continue
        assert found.rgb.dtype == np.uint8 and found.rgb.shape[2] == 3


@pytest.mark.parametrize(
    ("at", "with_", "sentence"),
    [
        (0, b"P6\n5", "does not begin with ILRL"),
        (4, b"\x02", "version 2"),
        (5, b"\x05", "a value that no version"),
        (6, b"\x02", "a value that no version"),
        (7, b"\x01", "a value that no version"),
        (8, struct.pack(">I", 0), "is empty: 0 x 4"),
        (8, struct.pack(">I", 0xFFFFFFFF), "larger than the format holds"),
        (8, struct.pack(">II", 65535, 4096), "bytes cannot hold"),
        (8, struct.pack(">II", 65535, 65535), "larger than the format holds"),
        (16, struct.pack(">d", np.nan), "chromaticity that is none"),
        (80, struct.pack(">d", 0.0), "γ of 0.0"),
        (HEADER, struct.pack(">I", 0xFFFFFFFF), "should have 42949"),
        (HEADER, struct.pack(">I", 0), "records of line 0 do not fill its 32 pixels"),
        (HEADER + 16, b"\xff", "records of line 0 do not fill its 32 pixels"),
    ],
)
def test_a_damaged_file_is_refused_with_its_reason(
    at: int, with_: bytes, sentence: str, tmp_path: Path
) -> None:
    content = bytearray(small())
    content[at : at + len(with_)] = with_
    path = tmp_path / "bad.rle"
    path.write_bytes(content)
    with pytest.raises(ImageError, match=sentence) as raised:
        run_length.read(path)
    assert str(raised.value).startswith(str(path))


def test_bytes_after_the_end_are_refused() -> None:
    with pytest.raises(ImageError, match="goes on after its end"):
        run_length.decode(small() + b"\0")


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(ImageError, match=r"no\.rle cannot be read: there is no such file"):
        run_length.read(tmp_path / "no.rle")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"rgb": np.zeros((2, 2, 4), np.uint8)}, "uint8 of shape"),
        ({"rgb": np.zeros((2, 2, 3))}, "not float64"),
        ({"rgb": np.zeros((0, 2, 3), np.uint8)}, "is empty"),
        ({"rgb": np.broadcast_to(np.uint8(0), (2, 70000, 3))}, "larger than the format"),
        ({"matte": np.zeros((3, 2), np.uint8)}, "matte should be"),
        ({"matte": np.full((2, 2), 0.5)}, "matte should be"),
        ({"primaries": NTSC[:2]}, "x and y of three primaries"),
        ({"white": (np.nan, 0.3)}, "chromaticity"),
        ({"white": ("a", 0.3)}, "are numbers"),
        ({"white": None}, "are numbers"),
        ({"gamma": -1.0}, "γ of -1.0"),
        ({"gamma": float("inf")}, "γ of inf"),
    ],
)
def test_an_image_that_is_none_is_refused(arguments: dict[str, object], sentence: str) -> None:
    whole = {"rgb": np.zeros((2, 2, 3), np.uint8), "primaries": NTSC, "white": D65} | arguments
    with pytest.raises(UsageError, match=sentence):
        run_length.encode(**whole)  # type: ignore[arg-type]
