"""EXR files: numbers as they are, and everything that is needed to read them."""

import math
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

from illuminant import exr
from illuminant.errors import ImageError, UsageError
from illuminant.image import Image


@pytest.fixture
def image() -> Image:
    rng = np.random.default_rng(1)
    return Image(
        rng.random((6, 9, 3)) * 200,
        layers={
            "depth": rng.random((6, 9, 1)),
            "normal": rng.random((6, 9, 3)) - 0.5,
            "samples": np.full((6, 9, 1), 16.0),
            "lamp:key.left": rng.random((6, 9, 3)),
            "spectra": rng.random((6, 9, 4)),
            "emission": np.zeros((6, 9, 1)),
        },
        settings={"scene": "räume/a.toml", "samples": 16, "seed": 3},
        exposure=0.004,
        wavelengths_nm=np.array([386.25, 450.0, 500.0, 780.125]),
        to_xyz=rng.random((3, 4)),
    )


def test_everything_comes_back(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.exr")
    back = Image.open(tmp_path / "a.exr")
    assert np.array_equal(back.xyz, image.xyz.astype(np.float32))
    assert set(back.layers) == set(image.layers) - {"emission"}
    for name, layer in back.layers.items():
        assert np.array_equal(layer, image.layers[name].astype(np.float32)), name
    assert back.wavelengths_nm is not None and back.to_xyz is not None
    np.testing.assert_array_equal(back.wavelengths_nm, image.wavelengths_nm)
    np.testing.assert_allclose(back.to_xyz, image.to_xyz, rtol=1e-6)
    assert (back.settings, back.exposure, back.unit) == (image.settings, 0.004, "cd/m2")


def test_the_header_states_the_colour_space_and_the_unit(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.exr")
    spec = oiio.ImageInput.open(str(tmp_path / "a.exr")).spec()
    found = {item.name: item.value for item in spec.extra_attribs}
    np.testing.assert_allclose(found["chromaticities"], exr.XYZ, atol=1e-7)
    assert found["whiteLuminance"] == 1.0
    assert found["illuminant:unit"] == "cd/m2"
    assert "DateTime" not in found
    assert spec.channelnames[:3] == ("R", "G", "B")
    assert {"S0.386,250nm", "depth.Z", "normal.X", "lamp:key.left.Y", "samples"} <= set(spec.channelnames)
    assert found["emissiveUnits"] == "W.m^-2.sr^-1.nm^-1"


def test_the_same_image_gives_the_same_bytes(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.exr")
    image.save(tmp_path / "b.exr")
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


@pytest.mark.parametrize("rgb", ["sRGB", "rec.2020", "ACES AP0", "XYZ"])
def test_any_rgb_system_comes_back_as_the_same_xyz(image: Image, tmp_path: Path, rgb: str) -> None:
    image.save(tmp_path / "a.exr", rgb=rgb)
    np.testing.assert_allclose(Image.open(tmp_path / "a.exr").xyz, image.xyz, rtol=0, atol=1e-4)


def test_exposure_never_scales_an_exr(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.exr", exposure=3.0)
    back = Image.open(tmp_path / "a.exr")
    assert np.array_equal(back.xyz, image.xyz.astype(np.float32))
    assert back.exposure == 3.0


def test_half_floats_are_refused_where_they_would_overflow(tmp_path: Path) -> None:
    Image(np.full((2, 2, 3), 65504.0)).save(tmp_path / "a.exr", half=True)
    assert Image.open(tmp_path / "a.exr").xyz.max() == 65504.0
    with pytest.raises(UsageError, match=r"does not fit 16-bit floats, whose largest is 65504"):
        Image(np.full((2, 2, 3), 70000.0)).save(tmp_path / "b.exr", half=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr"]


def test_a_file_that_does_not_say_its_primaries_is_questioned(tmp_path: Path) -> None:
    spec = oiio.ImageSpec(2, 1, 3, oiio.FLOAT)
    file = oiio.ImageOutput.create("a.exr")
    file.open(str(tmp_path / "a.exr"), spec)
    file.write_image(np.ones((1, 2, 3), np.float32))
    file.close()
    with pytest.raises(
        ImageError, match=r"a\.exr does not say which primaries its numbers are for: name their RGB system"
    ):
        Image.open(tmp_path / "a.exr")
    image = Image.open(tmp_path / "a.exr", assume="Rec.709")
    np.testing.assert_allclose(image.xyz[0, 0], [0.9505, 1.0, 1.0891], atol=2e-4)
    assert image.unit == "relative" and image.exposure is None


def test_a_damaged_file_is_one_sentence(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.exr")
    content = (tmp_path / "a.exr").read_bytes()
    (tmp_path / "cut.exr").write_bytes(content[: len(content) * 2 // 3])
    (tmp_path / "text.exr").write_text("no image")
    for name in ("cut.exr", "text.exr", "none.exr"):
        with pytest.raises(ImageError, match=rf"{name} cannot be read") as caught:
            Image.open(tmp_path / name)
        assert "\n" not in str(caught.value)


def test_white_leaves_out_what_shines_itself() -> None:
    xyz = np.full((10, 10, 3), 10.0)
    emission = np.zeros((10, 10, 1))
    xyz[:3], emission[:3] = 1000.0, 1.0
    image = Image(xyz, layers={"emission": emission})
    assert image.white() == 10.0
    assert image.auto_exposure() == 0.08
    assert Image(xyz).white() == 1000.0


@pytest.mark.parametrize("value", [0.0, math.nan, 1e-320])
def test_an_image_without_a_white_has_exposure_one(value: float) -> None:
    assert Image(np.full((4, 4, 3), value)).auto_exposure() == 1.0
