"""Pictures on their way through NTSC: what is lost, what is illegal, where it may stand, what instruments show."""

import numpy as np
import PIL.Image
import pytest

from illuminant import color
from illuminant.display.patterns import color_bars
from illuminant.display.picture import Picture
from illuminant.display.video import (
    black_and_white,
    cube,
    distribution,
    hazards,
    interlace,
    legality,
    scopes,
    transmission,
)
from illuminant.display.video.composite import encode
from illuminant.display.video.decoders import DECODERS
from illuminant.display.video.frame_buffer import check_png, opened, with_values
from illuminant.display.video.standard import ACTIVE, ACTIVE_US, Bandwidth
from illuminant.errors import ImageError, UsageError

RNG = np.random.default_rng(55)


def stripes(cycles: float, width: int = 640, height: int = 6) -> np.ndarray:
    """A grey wave with a number of cycles in the width, 0.5 ± 0.4."""
    wave = 0.5 + 0.4 * np.cos(2 * np.pi * cycles * (np.arange(width) + 0.5) / width)
    return np.repeat(np.tile(wave, (height, 1))[..., None], 3, axis=-1)


def contrast(rgb: np.ndarray, axis: int = 0) -> float:
    """Half the range of Y, I or Q in the middle of a picture."""
    yiq = color.rgb_to_yiq(rgb)[2:-2, rgb.shape[1] // 4 : -rgb.shape[1] // 4, axis]
    return float(np.ptp(yiq)) / 2


# --- there and back ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [100, 512, 640, 754, 1920])
@pytest.mark.parametrize("decoder", DECODERS)
def test_a_flat_picture_of_any_width_comes_back(width: int, decoder: str) -> None:
    image = np.full((6, width, 3), (0.6, 0.3, 0.1))
    found = transmission.transmit(image, decoder=decoder)
    assert found.shape == image.shape
    edge = width // 12
    np.testing.assert_allclose(found[:, edge:-edge], image[:, edge:-edge], atol=1e-3)


def test_lines_can_be_other_than_rows() -> None:
    image = np.full((108, 90, 3), (0.6, 0.3, 0.1))
    found = transmission.transmit(image, lines=97)
    np.testing.assert_allclose(found[:, 10:-10], image[:, 10:-10], atol=1e-3)
    fine = np.tile(np.array([0.2, 0.8])[:, None, None], (54, 90, 3))
    # 108 lines of black and white do not fit into 97.
    assert np.ptp(transmission.transmit(fine, lines=97)[20:90, 45, 1]) < 0.45
    assert np.ptp(transmission.transmit(fine, decoder="notch")[20:90, 45, 1]) == pytest.approx(0.6, abs=1e-3)


def test_resampling_keeps_flat_and_smooth_rows_and_changes_nothing_without_need() -> None:
    row = RNG.random((2, 754, 3))
    np.testing.assert_array_equal(transmission.resampled(row, 754, 1), row)
    image = stripes(20, 512)
    back = transmission.resampled(transmission.resampled(image, ACTIVE, 1), 512, 1)
    np.testing.assert_allclose(back[:, 10:-10], image[:, 10:-10], atol=0.004)


def test_what_440_pixels_cannot_hold_is_lost() -> None:
    """The limit of the book: 221 cycles pass with 3 dB less, 300 do not, whatever the width of the image."""
    for width in (754, 1508):
        assert contrast(transmission.transmit(stripes(150, width))) == pytest.approx(0.4, abs=0.02)
        assert contrast(transmission.transmit(stripes(260, width))) < 0.04
    with_limit = transmission.transmit(stripes(150, 754), bandwidth=Bandwidth(y=2.0))
    assert contrast(with_limit) < 0.01


def test_colour_has_less_detail_than_luminance_and_q_less_than_i() -> None:
    """68 cycles a line are 1.29 MHz, where I is 1.8 dB down in the encoder and again in the decoder."""
    kept = []
    for axis in range(3):
        yiq = np.zeros((6, 640, 3))
        yiq[..., 0] = 0.5
        yiq[..., axis] += 0.2 * np.cos(2 * np.pi * 68 * np.arange(640) / 640)
        kept.append(contrast(transmission.transmit(color.yiq_to_rgb(yiq)), axis) / 0.2)
    assert kept[0] > 0.98 and 0.6 < kept[1] < 0.75 and kept[2] < 0.02


def test_the_parts_in_y_i_and_q_add_up_to_the_picture() -> None:
    image = RNG.random((4, 5, 3))
    parts = transmission.components(image)
    np.testing.assert_allclose(sum(parts), image, atol=1e-14)
    np.testing.assert_allclose(parts[0], black_and_white.preview(image), atol=1e-14)
    for k, part in enumerate(parts):
        others = np.delete(color.rgb_to_yiq(part), k, axis=-1)
        np.testing.assert_allclose(others, 0.0, atol=1e-14)


def test_a_grey_picture_in_the_three_bands() -> None:
    """Figure 5.26: each band takes what lies beyond it, and leaves flat parts alone."""
    for mhz, passes, stops in ((4.2, 180, 260), (1.3, 40, 115), (0.5, 15, 50)):
        assert np.ptp(transmission.band_limited(stripes(passes)[0], mhz, axis=0)[200:440]) > 0.7
        assert np.ptp(transmission.band_limited(stripes(stops)[0], mhz, axis=0)[200:440]) < 0.02
    np.testing.assert_allclose(transmission.band_limited(np.full((3, 200), 0.4), 0.5), 0.4, atol=1e-12)


def test_correction_for_other_primaries_keeps_greys_and_comes_back() -> None:
    rgb = np.array([[0.5, 0.5, 0.5], [0.7, 0.4, 0.3], [0.3, 0.5, 0.6]])
    there = transmission.corrected(rgb, "sRGB", "NTSC 1953 D65")
    assert np.ptp(there[0]) < 1e-3 and np.abs(there[1] - rgb[1]).max() > 0.01
    np.testing.assert_allclose(transmission.corrected(there, "NTSC 1953 D65", "sRGB"), rgb, atol=1e-9)


def test_pictures_that_are_none_are_refused() -> None:
    for image, sentence in (
        (np.zeros((4, 4)), r"\(h, w, 3\), not \(4, 4\)"),
        (np.zeros((0, 4, 3)), "holds no pixel"),
        (np.full((2, 2, 3), np.nan), "4 pixels with values that are not finite"),
        (np.zeros((2, 2, 4)), r"not \(2, 2, 4\)"),
    ):
        with pytest.raises(UsageError, match=sentence):
            transmission.transmit(image)


# --- fields --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
@pytest.mark.parametrize("height", [6, 7])
def test_fields_come_back_bit_for_bit(dtype: type, height: int) -> None:
    odd, even = (RNG.integers(0, 255, (height, 5, 3)).astype(dtype) for _ in range(2))
    frame = interlace.weave(odd, even)
    assert frame.dtype == dtype
    first, second = interlace.split(frame)
    np.testing.assert_array_equal(first, odd[0::2])
    np.testing.assert_array_equal(second, even[1::2])
    np.testing.assert_array_equal(interlace.join(first, second), frame)
    np.testing.assert_array_equal(interlace.weave(odd, odd), odd)


def test_a_field_alone_fills_the_frame() -> None:
    ramp = np.arange(8.0)[:, None] * np.ones((1, 2))
    first, second = interlace.split(ramp)
    np.testing.assert_allclose(interlace.full_height(first, 0, 8)[:7], ramp[:7])
    np.testing.assert_allclose(interlace.full_height(second, 1, 8)[1:], ramp[1:])


def test_sixty_fields_a_second_are_computed_for_their_own_times() -> None:
    times = interlace.field_times_s(30)
    assert times.shape == (30, 2)
    np.testing.assert_allclose(np.diff(times.ravel()), 1 / 60)
    with pytest.raises(UsageError, match="one shape"):
        interlace.weave(np.zeros((2, 2)), np.zeros((4, 2)))
    with pytest.raises(UsageError, match="no second field"):
        interlace.split(np.zeros((1, 2)))


# --- legality ------------------------------------------------------------------------------------------------


def test_hot_colours_are_those_of_the_closed_form() -> None:
    levels = {name: legality.composite_range(rgb) for name, rgb in cube.CORNERS.items()}
    # 7.5 + 92.5 (0.886 ± √(0.492111² 0.886² + 0.877283² 0.114²))
    assert levels["yellow"][1] == pytest.approx(
        7.5 + 92.5 * (0.886 + np.hypot(0.492111 * 0.886, 0.877283 * 0.114))
    )
    assert levels["blue"][0] == pytest.approx(
        7.5 + 92.5 * (0.114 - np.hypot(0.492111 * 0.886, 0.877283 * 0.114))
    )
    found = [name for name, rgb in cube.CORNERS.items() if legality.hot(rgb)]
    assert found == ["yellow", "cyan", "red", "blue"]
    assert not any(legality.hot(rgb) for rgb in color_bars.bars_75().values())
    limited = [n for n, rgb in cube.CORNERS.items() if legality.hot(rgb, legality.Limits(chroma=50.0))]
    assert limited == ["yellow", "cyan", "green", "magenta", "red", "blue"]


@pytest.mark.parametrize("limits", [legality.Limits(), legality.Limits(high=110.0, chroma=50.0)])
def test_the_repair_is_legal_and_touches_nothing_but_saturation(limits: legality.Limits) -> None:
    rgb = RNG.random((5000, 3)) ** 0.3
    rgb[:100] = RNG.integers(0, 2, (100, 3))
    found = legality.repaired(rgb, limits)
    was_hot = legality.hot(rgb, limits)
    assert 50 < was_hot.sum() < 4000
    assert not legality.hot(found, limits).any()
    np.testing.assert_array_equal(found[~was_hot], rgb[~was_hot])
    assert found.min() > -1e-12 and found.max() < 1 + 1e-12
    before, after = (color.rgb_to_yiq(x, matrix="standard")[was_hot] for x in (rgb, found))
    np.testing.assert_allclose(after[:, 0], before[:, 0], atol=1e-12)
    np.testing.assert_allclose(after[:, 1] * before[:, 2], after[:, 2] * before[:, 1], atol=1e-12)
    # As much saturation as is legal: a bound is reached.
    low, high = legality.composite_range(found[was_hot])
    reached = np.minimum(np.abs(low - limits.low), np.abs(high - limits.high))
    if limits.chroma is not None:
        reached = np.minimum(reached, np.abs(legality.chroma_amplitude(found[was_hot]) - limits.chroma))
    np.testing.assert_allclose(reached, 0.0, atol=1e-9)


def test_a_margin_leaves_room_for_eight_bits() -> None:
    rgb = RNG.integers(0, 256, (20000, 3)) / 255
    codes = np.rint(legality.repaired(rgb, margin_ire=0.5) * 255) / 255
    assert legality.hot(np.rint(legality.repaired(rgb) * 255) / 255).any()
    assert not legality.hot(codes).any()


def test_the_signal_of_a_legal_picture_stays_within_bounds_but_for_overshoot() -> None:
    image = np.full((4, ACTIVE, 3), legality.repaired([1.0, 1.0, 0.0]))
    excess = legality.signal_excess(encode(image).active)
    assert excess[:, 60:-60].max() == pytest.approx(0.0, abs=1e-9)
    assert legality.signal_excess(encode(np.full_like(image, (1.0, 1.0, 0.0))).active)[2, 377] >= 0.0


def test_impossible_limits_are_refused() -> None:
    with pytest.raises(UsageError, match="exclude greys"):
        legality.Limits(high=90.0)
    with pytest.raises(UsageError, match="bound of -1 IRE"):
        legality.Limits(chroma=-1.0)
    with pytest.raises(UsageError, match="luminance of a colour alone"):
        legality.repaired([2.0, 2.0, 2.0])


# --- hazards -------------------------------------------------------------------------------------------------


def test_soft_pictures_are_in_no_danger() -> None:
    soft = np.stack([stripes(c)[..., 0] for c in (2, 3, 4)], axis=-1) * 0.5 + 0.25
    assert {name: bool(mask.any()) for name, mask in hazards.hazards(soft).items()} == dict.fromkeys(
        hazards.HAZARDS, False
    )


def test_red_text_on_blue_is_flagged_and_so_is_each_kind_of_danger() -> None:
    text = np.full((6, 640, 3), (0.1, 0.1, 0.6))
    text[:, 320:324] = (0.7, 0.1, 0.1)
    found = hazards.hazards(text)
    assert found["chroma"][:, 318:326].any() and not found["chroma"][:, :200].any()
    assert hazards.hazards(stripes(300))["fine"][:, 100:500].any()
    assert not hazards.hazards(stripes(160))["fine"][:, 100:500].any()
    shimmer = hazards.hazards(stripes(188))  # 188.3 cycles are the subcarrier
    assert shimmer["cross-colour"][:, 100:500].mean() > 0.5
    assert not hazards.hazards(stripes(60))["cross-colour"][:, 100:500].any()
    assert hazards.hazards(np.full((2, 64, 3), (1.0, 1.0, 0.0)))["hot"].all()
    assert hazards.worst_share(shimmer)[0] == "cross-colour"


@pytest.mark.parametrize(("axis", "near"), [(1, False), (2, True)])
def test_colours_near_the_q_axis_are_told_from_those_near_i(axis: int, near: bool) -> None:
    yiq = np.zeros((3, 640, 3))
    yiq[..., 0] = 0.5
    yiq[:, 320:, axis] = 0.28
    found = hazards.hazards(color.yiq_to_rgb(yiq))
    assert found["chroma"].any() and bool(found["q axis"].any()) is near


# --- cube ----------------------------------------------------------------------------------------------------


def test_blue_magenta_and_red_have_much_colour_and_little_luminance() -> None:
    about = {corner.name: corner.yiq for corner in cube.corners()}
    ratio = {n: np.hypot(*yiq[1:]) / yiq[0] for n, yiq in about.items() if n not in ("black", "white")}
    assert sorted(ratio, key=ratio.get)[-3:] == ["magenta", "red", "blue"]
    # Opposite corners have opposite colours.
    np.testing.assert_allclose(about["red"] + about["cyan"], [1.0, 0.0, 0.0], atol=1e-12)
    ends = np.array([[edge.rgb[0], edge.rgb[-1]] for edge in cube.edges()])
    assert len(np.unique(ends.reshape(12, 6), axis=0)) == 12
    np.testing.assert_array_equal(np.abs(ends[:, 1] - ends[:, 0]).sum(axis=1), 1.0)
    assert cube.hot_share() == pytest.approx(0.005, abs=0.001)


# --- instruments ---------------------------------------------------------------------------------------------


def test_the_vectorscope_shows_bars_on_their_targets_and_greys_in_the_middle() -> None:
    bars = np.repeat(np.array(list(color_bars.bars_75().values())), 100, axis=0)
    image = np.tile(bars, (4, 1, 1))
    points = scopes.vectors(encode(transmission.on_lines(image)), 2)
    for k, name in enumerate(color_bars.BARS):
        point = points[int((k + 0.5) * ACTIVE / 7)]
        wanted = np.zeros(2) if name == "white" else scopes.targets()[name]
        np.testing.assert_allclose(point, wanted, atol=0.4)
    assert len(scopes.vectors(encode(transmission.on_lines(image)))) == 4 * ACTIVE


def test_the_waveform_between_samples_goes_through_them() -> None:
    signal = encode(transmission.on_lines(RNG.random((3, 300, 3))))
    time, coarse = scopes.waveform(signal, 1)
    fine_time, fine = scopes.waveform(signal, 1, finer=4)
    np.testing.assert_allclose(fine_time[::4], time)
    np.testing.assert_allclose(fine[:, ::4], coarse, atol=1e-9)
    _, flat = scopes.waveform(encode(np.full((2, ACTIVE, 3), (0.75, 0.0, 0.0))), 0, show="luminance")
    np.testing.assert_allclose(flat[0, 400:600], 28.2, atol=0.1)


def test_a_screen_counts_every_point_that_is_on_it() -> None:
    x, y = RNG.random(500), RNG.random(500)
    screen = scopes.density(x, y, ((0.0, 1.0), (0.0, 1.0)), (40, 30))
    assert screen.shape == (30, 40) and screen.sum() == 500
    corner = scopes.density(np.array([0.01]), np.array([0.99]), ((0, 1), (0, 1)), (40, 30))
    assert corner[0, 0] == 1


# --- black and white -----------------------------------------------------------------------------------------


def test_black_and_white_drives_the_three_guns_together() -> None:
    image = RNG.random((5, 6, 3))
    grey = black_and_white.preview(image)
    np.testing.assert_allclose(grey, np.repeat((image @ [0.299, 0.587, 0.114])[..., None], 3, -1), atol=1e-14)


def test_colours_that_black_and_white_makes_one_are_marked_and_others_not() -> None:
    image = np.zeros((20, 60, 3))
    red = np.array([0.8, 0.1, 0.1])
    green = np.array([0.1, 0.1, 0.1]) + (red @ [0.299, 0.587, 0.114] - 0.1) / 0.587 * np.array([0, 1, 0])
    image[:, :30], image[:, 30:] = red, green
    mask = black_and_white.isoluminant(image)
    assert mask[10, 27:33].all() and mask.mean() == pytest.approx(0.1)
    image[:, 30:] = green * 0.5
    assert not black_and_white.isoluminant(image).any()
    image[:, 30:] = red + np.array([0.0, 0.0, 0.1])
    assert not black_and_white.isoluminant(image).any()


# --- distribution --------------------------------------------------------------------------------------------


def test_a_distribution_amplifier_undoes_gain_and_offset() -> None:
    for _ in range(20):
        fault = distribution.Mismatch(tuple(RNG.uniform(0.5, 1.5, 3)), tuple(RNG.uniform(-0.2, 0.2, 3)))
        repair = distribution.matched(fault.applied(np.zeros(3)), fault.applied(np.ones(3)))
        image = RNG.random((3, 4, 3))
        np.testing.assert_allclose(repair.applied(fault.applied(image)), image, atol=1e-9)
    white = distribution.Mismatch(gain=(1.0, 1.0, 0.8)).applied(np.ones(3))
    assert np.hypot(*color.rgb_to_yiq(white)[1:]) > 0.08, "a white field is not white"


def test_a_delay_moves_the_picture_to_the_right_by_its_part_of_the_line() -> None:
    image = np.zeros((2, 526, 3))
    image[:, 100:200] = 1.0
    late = distribution.delayed(image, 1.0)  # 526 pixels in 52.6 µs
    np.testing.assert_allclose(late[:, 110:210], 1.0)
    assert late.sum() == pytest.approx(image.sum())
    np.testing.assert_allclose(distribution.delayed(late, -1.0), image, atol=1e-12)
    half = distribution.delayed(image, 0.05)
    np.testing.assert_allclose(half[0, [100, 200], 0], 0.5)
    assert not distribution.delayed(image, ACTIVE_US).any()
    assert distribution.load_factor(0) == 2.0 and distribution.load_factor(1) == 1.0
    with pytest.raises(UsageError, match="white above black"):
        distribution.matched([0.5] * 3, [0.4] * 3)


# --- frame buffer --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("bits", [8, 10, 16])
def test_code_values_of_a_png_come_back_bit_for_bit(bits: int, tmp_path) -> None:
    codes = RNG.integers(0, 2**bits - 1, (9, 7, 3), endpoint=True).astype(
        np.uint8 if bits == 8 else np.uint16
    )
    Picture(codes, "Display P3", bits).save(tmp_path / "a.png")
    found = opened(tmp_path / "a.png")
    np.testing.assert_array_equal(found.codes, codes)
    assert (found.display.name, found.bits) == ("Display P3", bits)
    again = with_values(found, found.values, "the same")
    np.testing.assert_array_equal(again.codes, codes)
    assert again.text["Description"] == "the same"


def test_transparency_is_left_out_and_grey_fills_three_channels(tmp_path) -> None:
    PIL.Image.new("RGBA", (4, 3), (9, 200, 3, 99)).save(tmp_path / "clear.png")
    PIL.Image.new("L", (4, 3), 77).save(tmp_path / "grey.png")
    assert opened(tmp_path / "clear.png", "sRGB").codes[1, 1].tolist() == [9, 200, 3]
    assert opened(tmp_path / "grey.png", "sRGB").codes[1, 1].tolist() == [77, 77, 77]


def test_files_that_are_no_frame_buffer_are_refused(tmp_path) -> None:
    (tmp_path / "a.png").write_bytes(b"no image")
    (tmp_path / "a.exr").write_bytes(b"light")
    for name, sentence in (
        ("a.png", "is not a whole PNG"),
        ("a.exr", "holds light"),
        ("b.png", "no such file"),
    ):
        with pytest.raises(ImageError, match=sentence):
            opened(tmp_path / name)
    with pytest.raises(UsageError, match=r"ends in \.png"):
        check_png(tmp_path / "a.jpg")
    with pytest.raises(UsageError, match="not a number"):
        with_values(Picture.of_values(np.zeros((1, 1, 3)), "sRGB"), np.full((1, 1, 3), np.nan), "")
    PIL.Image.new("RGB", (4, 3)).save(tmp_path / "mute.png")
    with pytest.raises(ImageError, match=r"does not say which display.*--assume"):
        opened(tmp_path / "mute.png")
    assert opened(tmp_path / "mute.png", "SMPTE-C").display.name == "SMPTE-C"


def test_other_codes_keep_no_word_of_how_light_became_the_old_ones() -> None:
    text = {"Look": "{}", "Exposure": "2", "Display": "{}", "Settings": "{}"}
    made = with_values(Picture(np.zeros((1, 1, 3), np.uint8), "sRGB", 8, text), np.ones((1, 1, 3)), "white")
    assert made.text == {"Settings": "{}", "Description": "white"}
