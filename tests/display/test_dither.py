"""Dithers and patterns: means by closed forms, error diffusion bit by bit, and the measures of the study."""

import os
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest

from illuminant.display import displays, dither, dither_study, patterning
from illuminant.display.picture import Picture
from illuminant.errors import UsageError

EVERY = dither.names()
TILES = {
    "ordered-2": 2,
    "ordered-4": 4,
    "bayer-2": 2,
    "bayer-4": 4,
    "bayer-8": 8,
    "bayer-16": 16,
    "bayer-32": 32,
    "bayer-64": 64,
    "blue-noise": 64,
}
DIFFUSION = {
    "floyd-steinberg": ((7, 3, 5, 1), False),
    "floyd-steinberg-book": ((6, 0, 6, 4), False),
    "floyd-steinberg-serpentine": ((7, 3, 5, 1), True),
}


def ramp() -> np.ndarray:
    """A megapixel from 0 to 1."""
    return np.repeat(np.linspace(0.0, 1.0, 1024, dtype=np.float32)[None], 1024, axis=0)


# --- means -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EVERY)
def test_eight_bits_keep_the_mean_of_a_ramp(name: str) -> None:
    values = ramp()
    for image in (values, values.T.copy()):
        codes = dither.quantise(image, 8, name)
        assert codes.dtype == np.uint8 and codes.shape == image.shape
        assert abs(codes.mean(dtype=np.float64) / 255 - image.mean(dtype=np.float64)) < 1e-4


@pytest.mark.parametrize("name", DIFFUSION)
def test_error_diffusion_keeps_the_mean_at_one_bit(name: str) -> None:
    values = ramp()
    for image in (values, values.T.copy()):
        assert abs(dither.quantise(image, 1, name).mean() - image.mean(dtype=np.float64)) < 1e-3


def test_random_keeps_the_mean_within_four_standard_errors() -> None:
    values = ramp().astype(np.float64)
    error = np.sqrt((values * (1.0 - values)).sum()) / values.size
    for seed in range(3):
        assert abs(dither.quantise(values, 1, "random", seed).mean() - values.mean()) < 4 * error
    field = np.full((256, 256, 3), 5.5 / 255, np.float32)
    codes = dither.quantise(field, 8, "random")
    assert set(np.unique(codes)) == {5, 6}  # the book's example: half of the pixels are 5 and half 6
    assert abs((codes == 6).mean() - 0.5) < 4 * 0.5 / np.sqrt(codes.size)


@pytest.mark.parametrize(("name", "size"), TILES.items())
def test_a_tile_rounds_the_mean_of_a_field_to_its_levels(name: str, size: int) -> None:
    count = size * size
    for value in (0.0, 0.1, 0.25, 0.313, 0.5, 0.7771, 0.99, 1.0):
        field = np.full((size, size), value)
        single = float(np.float32(value))
        assert dither.quantise(field, 1, name).mean() == np.floor(single * count + 0.5) / count


@pytest.mark.parametrize("name", TILES)
def test_a_tile_at_one_bit_is_its_closed_form_on_a_ramp(name: str) -> None:
    values, tile = ramp(), dither.thresholds(name)
    assert tile is not None
    size = len(tile)
    assert sorted((2 * size * size * tile).ravel().tolist()) == list(range(1, 2 * size * size, 2))
    thresholds = np.tile(tile.astype(np.float64), (1024 // size, 1024 // size))
    np.testing.assert_array_equal(dither.quantise(values, 1, name), np.floor(values + thresholds))


def bayer(size: int) -> np.ndarray:
    """Bayer's ranks by their recursion."""
    if size == 1:
        return np.zeros((1, 1), int)
    quarter = 4 * bayer(size // 2)
    return np.block([[quarter, quarter + 2], [quarter + 3, quarter + 1]])


def test_the_tiles_are_those_of_the_book() -> None:
    two, four = (
        np.array([[1, 5], [7, 3]]) / 8,
        [[1, 17, 5, 21], [25, 9, 29, 13], [7, 23, 3, 19], [31, 15, 27, 11]],
    )
    np.testing.assert_array_equal(dither.thresholds("ordered-2"), two)
    np.testing.assert_array_equal(dither.thresholds("ordered-4"), np.array(four) / 32)
    for size in (2, 8, 64):
        found = dither.thresholds(f"bayer-{size}")
        np.testing.assert_array_equal(found, (2 * bayer(size) + 1) / (2 * size * size))
    np.testing.assert_array_equal(dither.thresholds("none"), [[0.5]])
    assert dither.thresholds("random") is None and dither.thresholds("floyd-steinberg") is None


def test_dot_diffusion_keeps_the_mean_of_fields_but_for_its_barons() -> None:
    # A baron keeps up to half a code: two in 64 pixels, two in 16.
    for name, share in (("dot-diffusion", 2 / 64), ("dot-diffusion-4", 2 / 16)):
        for value in np.linspace(0.0, 1.0, 23):
            codes = dither.quantise(np.full((128, 128), (100 + value) / 255), 8, name)[32:96, 32:96]
            assert abs(codes.mean() - 100 - value) <= share / 2 + 1e-4


# --- error diffusion, bit by bit -------------------------------------------------------------------------------


def plain(values: np.ndarray, bits: int, weights: tuple[int, ...], serpentine: bool) -> np.ndarray:
    """Error diffusion pixel by pixel, in whole numbers with 30 − max(bits, 8) binary places."""
    places = 30 - max(bits, 8)
    one, half = 1 << places, 1 << (places - 1)
    scale = np.float32((1 << bits) - 1) * np.float32(one)
    height, width = values.shape
    right, below_left, below, below_right = weights
    pending = [[0] * (width + 2) for _ in range(height + 1)]
    codes = np.zeros((height, width), int)
    for y in range(height):
        step = -1 if serpentine and y % 2 else 1
        for x in range(width)[::step]:
            desired = int(np.float32(values[y, x]) * scale) + ((pending[y][x + 1] + 8) >> 4)
            code = (desired + half) >> places
            error = desired - (code << places)
            codes[y, x] = code
            pending[y][x + 1 + step] += right * error
            pending[y + 1][x + 1 - step] += below_left * error
            pending[y + 1][x + 1] += below * error
            pending[y + 1][x + 1 + step] += below_right * error
    return codes


@pytest.mark.parametrize("name", DIFFUSION)
@pytest.mark.parametrize(
    ("shape", "bits"), [((37, 61), 1), ((9, 300), 8), ((70, 5), 3), ((16, 16), 16), ((1, 40), 10)]
)
def test_error_diffusion_is_that_of_a_plain_loop(name: str, shape: tuple[int, int], bits: int) -> None:
    values = np.random.default_rng(7).random((*shape, 3), np.float32)
    values[0, :3] = [0.0, 1.0, 0.5]
    weights, serpentine = DIFFUSION[name]
    found = dither.quantise(values, bits, name)
    for channel in range(3):
        np.testing.assert_array_equal(
            found[..., channel], plain(values[..., channel], bits, weights, serpentine)
        )
    np.testing.assert_array_equal(dither.quantise(values[..., 0].copy(), bits, name), found[..., 0])


# --- what holds for all ----------------------------------------------------------------------------------------

DIGEST = """
import hashlib, numpy as np
from illuminant.display import dither
values = np.random.default_rng(3).random((150, 333, 3), np.float32)
for name in dither.names():
    for bits in (2, 8):
        print(name, hashlib.sha256(dither.quantise(values, bits, name, 5).tobytes()).hexdigest())
"""


def test_the_number_of_threads_does_not_matter() -> None:
    found = {
        subprocess.run(
            [sys.executable, "-c", DIGEST],
            env={**os.environ, "RAYON_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("1", "2", "7")
    }
    assert len(found) == 1 and len(found.pop().splitlines()) == 2 * len(EVERY)


@pytest.mark.parametrize("name", EVERY)
def test_codes_of_every_depth_are_next_to_their_values(name: str) -> None:
    values = np.random.default_rng(11).random((40, 50, 3))
    values[:4], values[4:8] = 0.0, 1.0
    for bits in range(1, 17):
        top = (1 << bits) - 1
        codes = dither.quantise(values, bits, name)
        assert codes.dtype == (np.uint8 if bits <= 8 else np.uint16)
        assert codes.max() == top and codes.min() == 0
        # Dot diffusion may gather the errors of several neighbours in one pixel.
        most = 3.0 if name.startswith("dot") else 1.0
        assert np.abs(codes - values * top).max() <= most + 0.01
        np.testing.assert_array_equal(codes, dither.quantise(values, bits, name.upper()))
        if not name.startswith("dot"):
            assert (codes[:4] == 0).all() and (codes[4:8] == top).all()


def test_another_seed_is_another_pattern_of_random_alone() -> None:
    values = np.random.default_rng(2).random((30, 30, 3), np.float32)
    for name in EVERY:
        same = (dither.quantise(values, 2, name, 1) == dither.quantise(values, 2, name, 2)).all()
        assert same == (name != "random")


@pytest.mark.parametrize("name", EVERY)
def test_what_is_no_value_is_taken_to_an_end(name: str) -> None:
    values = np.array([[np.nan, -np.inf, -3.0, 0.0, 1.0, 7.0, np.inf]])
    assert dither.quantise(values, 8, name).tolist() == [[0, 0, 0, 0, 255, 255, 255]]


def test_grey_stays_grey_where_channels_are_alike() -> None:
    grey = np.repeat(ramp()[::8, :, None], 3, axis=2)
    weights = np.array([0.2126, 0.7152, 0.0722])
    for name in ("bayer-8", "blue-noise"):
        alike = dither.quantise(grey, 8, name, channels_alike=True)
        apart = dither.quantise(grey, 8, name)
        assert (alike == alike[..., :1]).all() and not (apart == apart[..., :1]).all()
        np.testing.assert_array_equal(alike[..., 0], apart[..., 0])
        noise = [float(((codes - grey * 255.0) @ weights).var()) for codes in (alike, apart)]
        assert noise[1] < (0.5 if name == "bayer-8" else 0.75) * noise[0]


WRONG: list[tuple[Callable[[], object], str]] = [
    (lambda: dither.quantise([[0.5]], 8, "bayer-3"), "There is no dither 'bayer-3'"),
    (lambda: dither.quantise([[0.5]], 0), "1 to"),
    (lambda: dither.quantise([[0.5]], 17), "1 to 16 bits"),
    (lambda: dither.quantise([[0.5]], -1), "1 to 16 bits"),
    (lambda: dither.quantise([[0.5]], 8, "random", -1), "seed"),
    (lambda: dither.quantise([0.5]), "height, width"),
    (lambda: dither.quantise(np.zeros((0, 3, 3))), "height, width"),
    (lambda: dither.quantise("grey"), "numbers"),
    (lambda: dither.quantise([[1, 2], [3]]), "numbers"),
    (lambda: dither.for_light(np.zeros((2, 2, 4)), 8), "1 or 3 channels"),
    (lambda: dither.for_light(np.zeros((2, 2, 3)), 20), "1 to 16"),
    (lambda: dither.for_light(np.zeros((2, 2, 3)), 8, "Kodak"), "Kodak"),
    (lambda: patterning.levels("2x"), "WxH"),
    (lambda: patterning.levels("65x1"), "1 to 64"),
    (lambda: patterning.levels("2x2", 17), "1 to 16"),
    (lambda: patterning.quantise([[0.5]], 1, (0, 2)), "1 to 64"),
    (lambda: patterning.codes([[0.5]], 1, "stipple"), "pattern-WxH"),
    (lambda: dither_study.spectrum("none", 8, 1.0), "between two codes"),
    (lambda: dither_study.measure("none", 8, -1.0), "positive"),
    (lambda: dither_study.comparison([]), "at least one"),
    (lambda: dither_study.comparison(width=1), "2 to 16,384"),
    (lambda: dither_study.comparison(mean="grey"), "light or of codes"),
]


def test_what_cannot_be_dithered_is_told() -> None:
    for call, sentence in WRONG:
        with pytest.raises(UsageError, match=sentence) as caught:
            call()
        assert str(caught.value).endswith("."), sentence


# --- the mean of light -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("display", ["sRGB", "Rec.709", "Adobe RGB", "Rec.2020 PQ", "Rec.2020 HLG"])
def test_a_dither_for_light_sends_the_light_asked_for(display: str) -> None:
    target = displays.named(display)
    for bits in (1, 2, 4):
        top = (1 << bits) - 1
        value = np.linspace(0.0, 1.0, 41)
        wanted = target.decode(np.repeat(value[:, None], 3, axis=1))[:, 0]
        part = dither.for_light(value[None], bits, display)[0] * top
        below = np.minimum(np.floor(part), top - 1)
        light = target.decode(np.repeat((below[:, None] + [0, 1]).reshape(-1, 1) / top, 3, axis=1))[:, 0]
        dark, bright = light.reshape(-1, 2).T
        np.testing.assert_allclose(dark + (part - below) * (bright - dark), wanted, atol=1e-9)


def test_codes_stay_where_they_are_for_light() -> None:
    levels = np.arange(16.0)[None] / 15
    np.testing.assert_allclose(dither.for_light(levels, 4), levels, atol=1e-12)
    fine = np.linspace(0.0, 1.0, 1000)[None]
    assert np.abs(dither.for_light(fine, 8) - fine).max() < 0.1 / 255  # with 8 bits it hardly matters
    assert dither.for_light([[np.nan, -1.0, 2.0]], 1).tolist() == [[0.0, 0.0, 1.0]]


# --- patterns --------------------------------------------------------------------------------------------------


def test_cells_have_a_level_more_than_pixels_times_steps() -> None:
    assert [patterning.levels(cell) for cell in patterning.CELLS] == [5, 7, 10]
    assert patterning.levels("2x2", 8) == 1021
    assert patterning.levels((4, 4), 2) == 49


@pytest.mark.parametrize("cell", ["1x1", "2x2", "2x3", "3x2", "3x3", "4x4", "5x2"])
def test_patterns_grow_pixel_by_pixel(cell: str) -> None:
    every = patterning.patterns(cell).astype(int)
    width, height = patterning.sides(cell)
    assert every.shape == (width * height + 1, height, width)
    assert every.sum(axis=(1, 2)).tolist() == list(range(width * height + 1))
    assert (np.diff(every, axis=0) >= 0).all()


@pytest.mark.parametrize(
    ("cell", "bits"), [("2x2", 1), ("2x3", 1), ("3x3", 1), ("2x2", 8), ("3x2", 3), ("2x2", 16)]
)
def test_a_cell_shows_the_level_of_the_formula(cell: str, bits: int) -> None:
    width, height = patterning.sides(cell)
    levels = patterning.levels(cell, bits)
    values = np.random.default_rng(4).random((1, 3000))
    values[0, :3] = [0.0, 0.5, 1.0]
    codes = patterning.quantise(values, bits, cell, enlarge=True)
    sums = codes.reshape(height, -1, width).sum(axis=(0, 2), dtype=int)
    single = values.astype(np.float32).astype(np.float64)
    np.testing.assert_array_equal(sums, np.minimum(np.floor(single[0] * levels), levels - 1))
    assert codes.max() <= (1 << bits) - 1
    spread = codes.reshape(height, -1, width).max(axis=(0, 2)) - codes.reshape(height, -1, width).min(
        axis=(0, 2)
    )
    assert spread.max() <= 1


def test_a_cell_of_four_shows_all_of_its_1021_levels() -> None:
    values = (np.arange(1021) + 0.5)[None] / 1021
    codes = patterning.quantise(values, 8, "2x2", enlarge=True)
    assert codes.reshape(2, -1, 2).sum(axis=(0, 2), dtype=int).tolist() == list(range(1021))


def test_a_cell_of_an_image_shows_its_mean() -> None:
    values = np.random.default_rng(9).random((12, 18, 3), np.float32)
    found = patterning.quantise(values, 1, "3x2")
    means = values.astype(np.float64).reshape(6, 2, 6, 3, 3).mean(axis=(1, 3))
    np.testing.assert_array_equal(found, patterning.quantise(means, 1, "3x2", enlarge=True))
    # A cut cell shows the mean of what is there.
    assert patterning.quantise(np.full((3, 3), 0.5), 1, "2x2").tolist() == [[1, 0, 1], [0, 1, 0], [1, 0, 1]]
    assert patterning.quantise([[np.nan, 2.0]], 1, "2x2", enlarge=True).tolist() == [[0, 0, 1, 1]] * 2


# --- halftones -------------------------------------------------------------------------------------------------


def test_a_halftone_sends_the_light_of_its_picture() -> None:
    value = np.linspace(0.05, 0.95, 400)
    picture = Picture.of_values(np.repeat(np.repeat(value[None, :, None], 400, 0), 3, 2), "sRGB", bits=16)
    wanted = picture.xyz()[..., 1].mean()
    for by, close in (("floyd-steinberg", 0.003), ("blue-noise", 0.003), ("pattern-4x4", 0.05)):
        made = patterning.halftone(picture, by)
        assert made.bits == 1 and set(np.unique(made.codes)) == {0, 1}
        assert made.xyz()[..., 1].mean() == pytest.approx(wanted, rel=close)
        too_bright = patterning.halftone(picture, by, mean="codes")
        assert too_bright.xyz()[..., 1].mean() > 1.3 * wanted


def test_a_grey_halftone_keeps_luminance_and_has_no_colour() -> None:
    values = np.random.default_rng(6).random((96, 96, 3))
    picture = Picture.of_values(values, "Display P3")
    made = patterning.halftone(picture, "bayer-8", grey=True)
    assert (made.codes == made.codes[..., :1]).all() and made.display.name == "Display P3"
    assert made.xyz()[..., 1].mean() == pytest.approx(picture.xyz()[..., 1].mean(), rel=0.01)
    large = patterning.halftone(picture, "pattern-2x3", enlarge=True)
    assert (large.width, large.height) == (192, 288)
    with pytest.raises(UsageError, match="bayer-8 cannot enlarge"):
        patterning.halftone(picture, "bayer-8", enlarge=True)
    with pytest.raises(UsageError, match="light or of codes"):
        patterning.halftone(picture, mean="both")


# --- the study -------------------------------------------------------------------------------------------------


def test_steps_and_means_have_their_closed_forms() -> None:
    rise = 8 / 512  # of the gradation between two windows
    for name, levels in (("none", 1), ("ordered-2", 4), ("pattern-2x2", 4)):
        found = dither_study.measure(name)
        assert found.step == pytest.approx(1 / levels - rise, abs=1e-9)
        assert 0.9 / (2 * levels) < found.mean <= 0.5 / levels
    assert dither_study.measure("none").grain == 0.0
    # A perfect dither between two codes has the variance f (1 − f), one sixth on average.
    for name in ("random", "bayer-64", "blue-noise", "floyd-steinberg"):
        assert dither_study.measure(name).grain == pytest.approx(np.sqrt(1 / 6), rel=0.01)


def test_noise_lies_where_each_dither_puts_it() -> None:
    found = dither_study.study(["none", "random", "ordered-2", "blue-noise", "floyd-steinberg"])
    assert np.isnan(found["none"].low) and found["none"].visible == 0.0
    assert found["random"].low == pytest.approx(1.0, abs=0.05)
    assert found["ordered-2"].low < 1e-4  # its longest wave is two pixels
    assert found["blue-noise"].low < 0.06 and found["floyd-steinberg"].low < 0.06
    assert found["blue-noise"].visible < found["random"].visible
    near, far = (dither_study.measure("blue-noise", 8, density).visible for density in (42.0, 84.0))
    assert far < 0.4 * near
    assert dither_study.measure("blue-noise", 1).grain == pytest.approx(found["blue-noise"].grain, rel=0.01)


def test_a_spectrum_is_one_for_white_noise_and_has_all_the_power() -> None:
    frequency, power = dither_study.spectrum("random")
    assert frequency[0] == 1 / 256 and frequency[-1] == pytest.approx(np.sqrt(0.5), abs=1 / 256)
    assert np.abs(power[20:170] - 1.0).max() < 0.25 and power.mean() == pytest.approx(1.0, abs=0.03)
    # At half a code, Bayer's tile is a checkerboard: all power in the corner, at √½.
    frequency, power = dither_study.spectrum("bayer-8", 1, 0.5)
    assert power[frequency > 0.69].sum() > 0.999 * power.sum()


def test_the_eyes_sensitivity_is_that_of_mannos_and_sakrison() -> None:
    assert float(dither_study.contrast_sensitivity(0.0)) == pytest.approx(2.6 * 0.0192)
    cycles = np.linspace(0.0, 40.0, 4001)
    seen = dither_study.contrast_sensitivity(cycles)
    assert cycles[seen.argmax()] == pytest.approx(8.0, abs=0.3) and seen.max() == pytest.approx(
        0.98, abs=0.01
    )


def test_the_figure_has_five_bands_of_one_gradation() -> None:
    codes = dither_study.comparison()
    assert codes.shape == (5 * 32, 256) and len(dither_study.BANDS) == 5
    none, *others = np.split(codes.astype(float), 5)
    wanted = np.linspace(0.0, 7.0, 256)
    np.testing.assert_array_equal(none, np.broadcast_to(np.floor(wanted + 0.5), (32, 256)))
    for band in others:
        local = np.convolve((band - wanted).mean(axis=0), np.full(16, 1 / 16), mode="valid")
        assert np.abs(local).max() < 0.2
    light = dither_study.comparison(["bayer-8"], bits=1, band=8, mean="light").mean(axis=0)
    assert light[100:156].mean() == pytest.approx(0.214, abs=0.03)
