"""ICC profiles: LittleCMS (in Pillow) reads what we write, and we read what it writes."""

import hashlib
import io
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import ImageCms

from illuminant.display import profile
from illuminant.errors import DataError, UsageError

SRGB = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))
D65 = (0.3127, 0.3290)
D50 = np.array([0.9642, 1.0, 0.8249])


def srgb(code: np.ndarray) -> np.ndarray:
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)


def pq(code: np.ndarray) -> np.ndarray:
    """SMPTE ST 2084, cd/m²."""
    root = code ** (1 / 78.84375)
    return 10000 * (np.maximum(root - 0.8359375, 0) / (18.8515625 - 18.6875 * root)) ** (1 / 0.1593017578125)


@dataclass(frozen=True)
class Monitor:
    """What stands for a display: all that a profile needs of one."""

    name: str = "Monitor of the test – groß"
    primaries: Any = SRGB
    white: Any = D65
    response: str = "sRGB"
    peak: float = 103.0
    curve: Any = srgb

    def decode(self, code: np.ndarray) -> np.ndarray:
        """Linear values of code values."""
        return np.asarray(self.curve(np.asarray(code)))


MONITORS = {
    "sRGB": Monitor(),
    "gamma": Monitor(
        "NTSC", ((0.67, 0.33), (0.21, 0.71), (0.14, 0.08)), (0.3101, 0.3162), "2.2", 80.0, lambda c: c**2.2
    ),
    "linear": Monitor("linear", REC2020, D65, "linear", 1000.0, lambda c: c),
    "uneven": Monitor("uneven", SRGB, (0.29, 0.30), "table", 250.0, lambda c: c ** np.array([1.8, 2.2, 2.6])),
    "S-shaped": Monitor("S", SRGB, D65, "table", 250.0, lambda c: c**2 * (3 - 2 * c)),
}


def opened(content: bytes) -> ImageCms.ImageCmsProfile:
    return ImageCms.ImageCmsProfile(io.BytesIO(content))


def matrix(monitor: Monitor) -> np.ndarray:
    columns = np.array([[x, y, 1 - x - y] for x, y in monitor.primaries]).T
    x, y = monitor.white
    return np.asarray(columns * np.linalg.solve(columns, [x / y, 1, (1 - x - y) / y]))


def lab(xyz: np.ndarray) -> np.ndarray:
    ratio = xyz / D50
    f = np.where(ratio > (6 / 29) ** 3, np.cbrt(ratio), ratio / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack(
        [116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1
    )


def under_d50(monitor: Monitor, codes: np.ndarray) -> np.ndarray:
    """XYZ of codes, adapted from the monitor's white to D50."""
    bradford = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
    to_xyz = matrix(monitor)
    gain = (bradford @ D50) / (bradford @ to_xyz.sum(axis=1))
    return monitor.decode(codes) @ np.asarray(np.linalg.inv(bradford) @ np.diag(gain) @ bradford @ to_xyz).T


@pytest.mark.parametrize("version", [2, 4])
@pytest.mark.parametrize("monitor", MONITORS.values(), ids=MONITORS)
def test_littlecms_finds_the_display_in_the_profile(monitor: Monitor, version: int) -> None:
    found: Any = opened(profile.encode(monitor, version=version)).profile
    ascii_name = monitor.name.encode("ascii", "replace").decode()
    assert found.profile_description == (monitor.name if version == 4 else ascii_name)
    assert found.copyright and found.is_matrix_shaper and int(found.version) == version
    assert found.luminance[0][1] == pytest.approx(monitor.peak, abs=1e-4)
    native = np.linalg.inv(np.array(found.chromatic_adaptation[0]))
    for colorant, (x, y) in zip(
        (found.red_colorant, found.green_colorant, found.blue_colorant), monitor.primaries, strict=True
    ):
        xyz = native @ colorant[0]
        np.testing.assert_allclose(xyz[:2] / xyz.sum(), (x, y), atol=1e-4)
    white = native @ found.media_white_point[0]
    np.testing.assert_allclose(white[:2] / white.sum(), monitor.white, atol=1e-4)


@pytest.mark.parametrize("version", [2, 4])
@pytest.mark.parametrize("monitor", MONITORS.values(), ids=MONITORS)
def test_littlecms_shows_the_colours_that_were_meant(monitor: Monitor, version: int) -> None:
    codes = np.array(
        [
            [255, 255, 255],
            [128, 128, 128],
            [30, 30, 30],
            [255, 0, 0],
            [0, 255, 0],
            [0, 0, 255],
            [200, 90, 40],
            [12, 160, 222],
        ]
    )
    image = PIL.Image.fromarray(codes[None].astype(np.uint8))
    ours = opened(profile.encode(monitor, version=version))
    transform = ImageCms.buildTransform(
        ours,
        ImageCms.createProfile("LAB", 5000),
        "RGB",
        "LAB",
        renderingIntent=ImageCms.Intent.RELATIVE_COLORIMETRIC,
    )
    shown = np.asarray(ImageCms.applyTransform(image, transform))[0].astype(np.float64)
    expected = lab(under_d50(monitor, codes / 255))
    # Pillow's Lab has 8 bits: L in 255ths of 100, a and b in ones, as two's complement, clipped to what fits.
    a_and_b = np.where(shown[:, 1:] > 127, shown[:, 1:] - 256, shown[:, 1:])
    np.testing.assert_allclose(shown[:, 0] * 100 / 255, expected[:, 0], atol=0.3)
    np.testing.assert_allclose(a_and_b, np.clip(expected[:, 1:], -128, 127), atol=0.75)


def test_littlecms_takes_our_srgb_for_its_own() -> None:
    ramp = np.stack(np.meshgrid(*[np.arange(0, 256, 15)] * 3), axis=-1).reshape(1, -1, 3).astype(np.uint8)
    image = PIL.Image.fromarray(ramp)
    ours, theirs = opened(profile.encode(MONITORS["sRGB"])), ImageCms.createProfile("sRGB")
    for source, target in ((ours, theirs), (theirs, ours)):
        back = ImageCms.profileToProfile(image, source, target)
        assert back is not None
        assert np.abs(np.asarray(back).astype(int) - ramp).max() <= 1


@pytest.mark.parametrize("version", [2, 4])
@pytest.mark.parametrize("monitor", MONITORS.values(), ids=MONITORS)
def test_a_display_comes_back_from_its_profile(monitor: Monitor, version: int, tmp_path: Path) -> None:
    path = tmp_path / "a.icc"
    profile.write(path, monitor, version=version)
    found = profile.read(path)
    assert found.description == monitor.name and found.version == version
    np.testing.assert_allclose(found.primaries, monitor.primaries, atol=1e-4)
    np.testing.assert_allclose(found.white, monitor.white, atol=1e-4)
    assert found.peak == pytest.approx(monitor.peak, abs=1e-4)
    code = np.random.default_rng(8).random((500, 3))
    np.testing.assert_allclose(found.linear(code), monitor.decode(code), atol=1e-4)
    assert found.table.shape == (3, profile.SAMPLES)
    np.testing.assert_allclose(found.table[:, -1], 1.0, atol=1e-4)


def test_a_power_law_is_read_as_one() -> None:
    found = profile.decode(profile.encode(MONITORS["gamma"]))
    assert found.gammas == pytest.approx((2.2, 2.2, 2.2), abs=1e-5)
    assert profile.decode(profile.encode(MONITORS["linear"], version=2)).gammas == (1.0, 1.0, 1.0)
    assert profile.decode(profile.encode(MONITORS["sRGB"])).gammas == (None, None, None)


def test_the_same_display_gives_the_same_bytes_and_their_identity() -> None:
    content = profile.encode(MONITORS["sRGB"])
    assert content == profile.encode(Monitor())
    assert len(content) < 1000, "a formula needs no table, and three equal curves are one"
    plain = bytearray(content)
    for start, end in ((44, 48), (64, 68), (84, 100)):
        plain[start:end] = bytes(end - start)
    assert hashlib.md5(plain).digest() == content[84:100]


def test_littlecms_srgb_is_read_as_srgb() -> None:
    found = profile.decode(ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes())
    np.testing.assert_allclose(found.primaries, SRGB, atol=1e-3)
    np.testing.assert_allclose(found.white, D65, atol=1e-3)
    code = np.linspace(0, 1, profile.SAMPLES)
    np.testing.assert_allclose(found.table, np.tile(srgb(code), (3, 1)), atol=1e-3)
    assert found.peak is None and found.cicp is None and "sRGB" in found.description


def test_a_display_for_pq_has_a_curve_for_all_and_code_points_for_those_who_know() -> None:
    monitor = Monitor("HDR", REC2020, D65, "PQ", 1000.0, lambda code: pq(code) / 1000.0)
    found = profile.decode(profile.encode(monitor))
    assert found.cicp == (9, 16, 0, 1)
    code = np.linspace(0, 1, profile.SAMPLES)
    np.testing.assert_allclose(found.table[0], np.clip(pq(code) / 1000.0, 0, 1), atol=1e-5)
    assert profile.decode(profile.encode(monitor, version=2)).cicp is None
    odd = Monitor("HDR", SRGB, (0.3, 0.3), "PQ", 1000.0, monitor.curve)
    assert profile.decode(profile.encode(odd)).cicp is None
    opened(profile.encode(monitor))


def test_without_chad_the_white_of_version_2_is_taken() -> None:
    content = bytearray(profile.encode(MONITORS["sRGB"], version=2))
    (count,) = struct.unpack_from(">I", content, 128)
    for entry in range(132, 132 + 12 * count, 12):
        name, start, _ = struct.unpack_from(">4sII", content, entry)
        if name == b"chad":
            content[entry : entry + 4] = b"xxxx"
        if name == b"wtpt":
            white = (0.95046, 1.0, 1.08906)
            struct.pack_into(">3i", content, start + 8, *(round(v * 65536) for v in white))
    found = profile.decode(bytes(content))
    np.testing.assert_allclose(found.white, D65, atol=1e-4)
    np.testing.assert_allclose(found.primaries, SRGB, atol=2e-4)


@pytest.mark.parametrize(
    ("at", "with_", "sentence"),
    [
        (16, b"CMYK", "for CMYK colours, not RGB"),
        (16, b"GRAY", "for GRAY colours, not RGB"),
        (12, b"link", "of the class link"),
        (8, b"\5", "of version 5"),
        (36, b"nope", "not an ICC profile"),
        (128, b"\xff\xff\xff\xff", "4294967295 tags goes beyond its end"),
        (0, b"\xff\xff\xff\xff", "it ends after"),
    ],
)
def test_what_is_no_display_is_refused_with_its_reason(
    at: int, with_: bytes, sentence: str, tmp_path: Path
) -> None:
    content = bytearray(profile.encode(MONITORS["sRGB"]))
    content[at : at + len(with_)] = with_
    path = tmp_path / "bad.icc"
    path.write_bytes(content)
    with pytest.raises(DataError, match=sentence) as raised:
        profile.read(path)
    assert raised.value.file == str(path)


def test_a_profile_cut_anywhere_is_refused() -> None:
    content = profile.encode(MONITORS["sRGB"])
    for end in range(len(content)):
        with pytest.raises(DataError):
            profile.decode(content[:end])


@settings(max_examples=200, deadline=None)
@given(
    changes=st.lists(st.tuples(st.integers(0, 527), st.integers(0, 255)), max_size=8),
    junk=st.binary(max_size=300),
)
def test_damage_is_a_data_error_or_a_finite_display(changes: list[tuple[int, int]], junk: bytes) -> None:
    content = bytearray(profile.encode(MONITORS["sRGB"]))
    for at, value in changes:
        content[at % len(content)] = value
    for bytes_ in (bytes(content), junk):
        try:
            found = profile.decode(bytes_)
        except DataError:
            continue
        assert np.isfinite(found.primaries).all() and np.isfinite(found.white).all()
        assert np.isfinite(found.table).all()


def test_a_file_that_is_not_there_is_named() -> None:
    with pytest.raises(DataError, match=r"no\.icc: the profile cannot be read: there is no such file"):
        profile.read("no.icc")


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"primaries": ((0.1, 0.1), (0.2, 0.2), (0.3, 0.3))}, "one line"),
        ({"primaries": ((0.1, 0.1), (0.2, 0.2))}, "Monitor"),
        ({"white": (0.3, 0.0)}, "white"),
        ({"white": (float("nan"), 0.3)}, "chromaticity"),
        ({"peak": -1.0}, "luminance"),
        ({"curve": lambda c: c * 0.5}, "makes 0.5 of the code 1"),
        ({"curve": lambda c: c * np.nan}, "finite"),
        ({"name": " "}, "description"),
    ],
)
def test_a_display_that_no_profile_holds_is_refused(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises(UsageError, match=sentence):
        profile.encode(Monitor(**({"name": "Monitor"} | change)))


def test_a_version_that_is_none_is_refused() -> None:
    with pytest.raises(UsageError, match="version 2 or 4, not 3"):
        profile.encode(Monitor(), version=3)
