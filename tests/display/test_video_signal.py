"""The composite signal against the standard: times, filters, levels of the bars, and what decoders make of it."""

import numpy as np
import pytest

from illuminant import color
from illuminant.display.patterns import color_bars
from illuminant.display.video import filters, scopes
from illuminant.display.video.composite import BURST, Signal, band_limited_yiq, encode, subcarrier
from illuminant.display.video.decoders import DECODERS, burst_phase_deg, decode, separate
from illuminant.display.video.standard import (
    ACTIVE,
    FIRST_ACTIVE,
    SAMPLE_MHZ,
    SUBCARRIER_MHZ,
    Bandwidth,
    Levels,
    Raster,
    cycles,
    line_time_us,
    pixel_limit,
)
from illuminant.errors import UsageError


def flat(rgb: tuple[float, ...], lines: int = 6) -> Signal:
    """The signal of a flat field."""
    return encode(np.full((lines, ACTIVE, 3), rgb))


# --- Y I Q ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("matrix", ["exact", "standard"])
def test_yiq_there_and_back_is_exact(matrix: str) -> None:
    rgb = np.random.default_rng(8).uniform(-0.5, 1.5, (1000, 3))
    back = color.yiq_to_rgb(color.rgb_to_yiq(rgb, matrix=matrix), matrix=matrix)
    np.testing.assert_allclose(back, rgb, rtol=0, atol=1e-12)


def test_the_pair_of_the_book_is_rounded_to_three_ten_thousandths() -> None:
    rgb = np.eye(3)
    off = np.abs(color.yiq_to_rgb(color.rgb_to_yiq(rgb), matrix="book") - rgb).max()
    assert 1e-5 < off < 3e-4


def test_the_book_rounds_what_the_standard_constructs() -> None:
    np.testing.assert_allclose(color.yiq_matrix("standard").round(3), color.yiq_matrix(), rtol=0, atol=1e-12)
    printed = [[1.0, 0.9557, 0.6199], [1.0, -0.2716, -0.6469], [1.0, -1.1082, 1.7051]]
    np.testing.assert_allclose(np.linalg.inv(color.yiq_matrix()), printed, rtol=0, atol=2e-4)


def test_the_differences_of_footnote_15_are_the_axes_before_they_are_turned() -> None:
    rgb = np.random.default_rng(5).random((50, 3))
    y, v, u = np.moveaxis(color.rgb_to_yvu(rgb), -1, 0)
    np.testing.assert_allclose(v, 0.877283 * (rgb[:, 0] - y), atol=1e-14)
    np.testing.assert_allclose(u, 0.492111 * (rgb[:, 2] - y), atol=1e-14)
    _, i, q = np.moveaxis(color.rgb_to_yiq(rgb, matrix="standard"), -1, 0)
    # ERRATA 15: what footnote 15 should have said.
    np.testing.assert_allclose(i, 0.736 * (rgb[:, 0] - y) - 0.268 * (rgb[:, 2] - y), atol=1e-3)
    np.testing.assert_allclose(q, 0.478 * (rgb[:, 0] - y) + 0.413 * (rgb[:, 2] - y), atol=1e-3)
    np.testing.assert_allclose(np.hypot(i, q), np.hypot(u, v), atol=1e-14)
    np.testing.assert_allclose(color.yvu_to_rgb(color.rgb_to_yvu(rgb)), rgb, atol=1e-13)


@pytest.mark.parametrize("matrix", ["exact", "book", "standard"])
def test_greys_have_no_colour_signal(matrix: str) -> None:
    yiq = color.rgb_to_yiq(np.full((1, 3), 0.7), matrix=matrix)
    np.testing.assert_allclose(yiq, [[0.7, 0.0, 0.0]], atol=1e-15)


def test_float32_stays_and_another_matrix_is_refused() -> None:
    assert color.rgb_to_yiq(np.ones(3, np.float32), matrix="standard").dtype == np.float32
    with pytest.raises(UsageError, match=r"no matrix 'pal' of Y I Q: expected exact, book or standard\."):
        color.yiq_to_rgb([0.0, 0.0, 0.0], matrix="pal")


# --- times and lines -----------------------------------------------------------------------------------------


def test_the_times_of_the_book() -> None:
    assert line_time_us() == pytest.approx(63.49, abs=0.005)
    assert line_time_us() - 10.9 == pytest.approx(52.6, abs=0.015)
    assert [cycles(mhz) for mhz in (4.2, 1.3, 0.5)] == pytest.approx([220.92, 68.38, 26.3])
    assert pixel_limit() == pytest.approx(441.84)
    # The sampled line is the seen part of a line to a sample.
    assert pytest.approx(52.6, abs=1.0 / SAMPLE_MHZ) == ACTIVE / SAMPLE_MHZ
    assert pytest.approx(line_time_us(frames_per_second=30.0 / 1.001), rel=1e-12) == 910 / SAMPLE_MHZ
    assert pytest.approx(3.579545, abs=5e-7) == SUBCARRIER_MHZ


def test_the_raster_has_half_lines() -> None:
    raster = Raster()
    assert (raster.lines_per_field, raster.visible, raster.stored) == (262.5, 483, 484)
    assert raster.fields_per_second == 60.0
    assert Raster(blanked=20).visible == 485
    numbers = [Raster(blanked=20).line_number(row) for row in range(484)]
    assert len(set(numbers)) == 484
    assert max(numbers[0::2]) < 263 and min(numbers[1::2]) == 284 and max(numbers) == 525
    with pytest.raises(UsageError, match="524 lines do not interlace"):
        Raster(lines=524)


def test_the_subcarrier_turns_over_from_line_to_line_and_from_frame_to_frame() -> None:
    rows = np.arange(1, 526)
    for wave, again in zip(subcarrier(rows), subcarrier(rows, 1), strict=True):
        np.testing.assert_array_equal(wave[1:], -wave[:-1])
        np.testing.assert_array_equal(again, -wave)
    rgb = np.full((6, ACTIVE, 3), [0.75, 0.0, 0.0])
    one, other = encode(rgb), encode(rgb, frame=1)
    middle = slice(300, 600)
    # Two lines of a field, and one line in two frames: their mean is the luminance alone.
    level = Levels().of(0.75 * 0.299)
    np.testing.assert_allclose((one.ire[0, middle] + one.ire[2, middle]) / 2, level, atol=1e-12)
    np.testing.assert_allclose((one.ire[0, middle] + other.ire[0, middle]) / 2, level, atol=1e-12)


# --- filters -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("taps", "mhz", "half", "stop"),
    [
        (filters.low_pass(4.2), 4.2, 4.35, 4.86),
        (filters.chroma_pass(0.5), 0.5, 0.59, 0.90),
    ],
    ids="YQ",
)
def test_a_filter_passes_its_band_and_no_more(taps: np.ndarray, mhz: float, half: float, stop: float) -> None:
    assert filters.response(taps, 0.0) == pytest.approx(1.0, abs=1e-14)
    assert filters.response(taps, mhz) == pytest.approx(10 ** (-3.0103 / 20), abs=1e-4)
    assert filters.response(taps, half) == pytest.approx(0.5, abs=0.02)
    grid = np.linspace(stop, SAMPLE_MHZ / 2, 400)
    assert np.abs(filters.response(taps, grid)).max() < 0.01
    assert filters.response(taps, np.linspace(0.0, 0.7 * mhz, 50)).min() > 0.88
    np.testing.assert_allclose(taps, taps[::-1], atol=1e-17)


def test_the_filters_of_colour_are_blind_to_flat_luminance_and_to_twice_the_subcarrier() -> None:
    for mhz in (0.5, 1.3):
        found = filters.response(filters.chroma_pass(mhz), [SUBCARRIER_MHZ, 2 * SUBCARRIER_MHZ])
        np.testing.assert_allclose(found, 0.0, atol=1e-15)
        band = filters.response(filters.chroma_band(mhz), [0.0, SUBCARRIER_MHZ])
        np.testing.assert_allclose(band, [0.0, 1.0], atol=1e-14)


def test_i_keeps_within_the_limits_of_the_fcc() -> None:
    """47 CFR 73.682 (a) (20): less than 2 dB down at 1.3 MHz, at least 20 dB at 3.6 MHz."""
    taps = filters.i_pass(1.3)
    i = -20 * np.log10(np.abs(filters.response(taps, [1.3, 3.6])))
    assert i[0] < 2.0 and i[1] >= 20.0
    assert filters.response(taps, np.linspace(0.0, 1.0, 50)).min() > 0.88
    assert np.abs(filters.response(taps, np.linspace(2.2, SAMPLE_MHZ / 2, 400))).max() < 0.01
    exact = filters.response(taps, [0.0, SUBCARRIER_MHZ, 2 * SUBCARRIER_MHZ])
    np.testing.assert_allclose(exact, [1.0, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(taps, taps[::-1], atol=1e-17)


def test_q_keeps_within_the_limits_of_the_fcc() -> None:
    q = -20 * np.log10(filters.response(filters.chroma_pass(0.5), [0.4, 0.5, 0.6]))
    assert q[0] < 2.0 and q[1] < 6.0 and q[2] >= 6.0


def test_a_wave_is_filtered_by_the_response_at_its_frequency() -> None:
    mhz = 1.1
    wave = np.cos(2 * np.pi * mhz / SAMPLE_MHZ * np.arange(800))
    taps = filters.chroma_pass(1.3)
    out = filters.filtered(wave, taps)
    np.testing.assert_allclose(out[100:-100], filters.response(taps, mhz) * wave[100:-100], atol=1e-12)


# --- levels --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", list(color_bars.BARS)[1:])
def test_the_bars_have_the_levels_of_the_standard(name: str, eia: dict[str, tuple[float, ...]]) -> None:
    luminance, peak_to_peak, phase = eia[name]
    signal = flat(color_bars.bars_75()[name])
    middle = signal.active[2, 300:340]
    assert middle.mean() == pytest.approx(luminance, abs=0.06)
    hue, amplitude = scopes.hue_and_amplitude(scopes.vectors(signal, 2)[377])
    assert 2 * amplitude == pytest.approx(peak_to_peak, abs=0.06)
    assert hue == pytest.approx(phase, abs=0.06)
    # The trace between the samples reaches the whole amplitude; the samples alone need not.
    _, fine = scopes.waveform(signal, 2, finer=8)
    part = fine[0, 8 * (FIRST_ACTIVE + 300) : 8 * (FIRST_ACTIVE + 340)]
    assert np.ptp(part) == pytest.approx(peak_to_peak, abs=0.5)


def test_grey_bars_and_the_ends_of_the_scale() -> None:
    assert flat((0.75, 0.75, 0.75)).active[2, 377] == pytest.approx(76.9, abs=0.05)
    assert flat((0.0, 0.0, 0.0)).active[2] == pytest.approx(np.full(ACTIVE, 7.5))
    assert flat((1.0, 1.0, 1.0)).active[2, 377] == pytest.approx(100.0)
    assert encode(np.zeros((1, ACTIVE, 3)), levels=Levels(setup=0.0)).active.max() == 0.0


def test_minus_i_and_q_of_40_ire_lie_on_their_axes() -> None:
    for axis, sign, phase in ((1, -1.0, 303.0), (2, 1.0, 33.0)):
        yiq = np.zeros(3)
        yiq[axis] = sign * 20.0 / 92.5
        hue, amplitude = scopes.hue_and_amplitude(
            scopes.vectors(flat(tuple(color.yiq_to_rgb(yiq, matrix="standard"))), 2)[377]
        )
        assert (hue, amplitude) == pytest.approx((phase, 20.0), abs=1e-9)


def test_a_line_has_sync_burst_and_porches_where_they_belong() -> None:
    signal = flat((1.0, 1.0, 1.0))
    line, time = signal.ire[2], signal.time_us
    assert line.min() == -40.0
    low = time[:76][line[:76] <= -20.0]
    assert low[-1] - low[0] == pytest.approx(4.7, abs=0.14)
    burst = line[BURST]
    assert (burst.max(), burst.min()) == (20.0, -20.0)
    assert time[BURST.start] == pytest.approx(5.3, abs=0.07)
    assert (BURST.stop - BURST.start) / 4 == 9
    seen = time[line > 50.0]
    assert seen[0] == pytest.approx(9.4, abs=0.15)
    assert time[-1] - seen[-1] == pytest.approx(1.5, abs=0.15)
    np.testing.assert_allclose(line[892:906], 0.0)
    np.testing.assert_allclose(burst_phase_deg(signal), 180.0)
    np.testing.assert_allclose(scopes.burst_vector(signal, 1), [-20.0, 0.0], atol=1e-12)


# --- decoders ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("decoder", DECODERS)
@pytest.mark.parametrize("rgb", [(0.75, 0.0, 0.0), (0.1, 0.2, 0.9), (0.5, 0.5, 0.5)])
def test_a_flat_field_comes_back_whole(decoder: str, rgb: tuple[float, ...]) -> None:
    for lines in (1, 2, 6, 7):
        back = decode(flat(rgb, lines), decoder=decoder)
        assert back.shape == (lines, ACTIVE, 3)
        np.testing.assert_allclose(back[:, 100:-100], np.full((lines, ACTIVE - 200, 3), rgb), atol=1e-9)
        np.testing.assert_allclose(back[:, 30:-30], np.full((lines, ACTIVE - 60, 3), rgb), atol=0.01)


@pytest.mark.parametrize("decoder", DECODERS)
def test_setup_and_frame_make_no_difference_to_what_comes_back(decoder: str) -> None:
    rgb = np.full((6, ACTIVE, 3), (0.6, 0.2, 0.4))
    wanted = decode(encode(rgb), decoder=decoder)
    for options in ({"frame": 1}, {"frame": 2}, {"levels": Levels(setup=0.0)}, {"first_row": 7}):
        found = decode(encode(rgb, **options), decoder=decoder)
        np.testing.assert_allclose(found[:, 100:-100], wanted[:, 100:-100], atol=1e-9)


@pytest.mark.parametrize("degrees", [-40.0, 10.0, 90.0])
def test_the_hue_control_turns_the_vectorscope_by_its_angle(degrees: float) -> None:
    signal = flat((0.75, 0.1, 0.2))

    def hue(rgb: np.ndarray) -> float:
        _, v, u = color.rgb_to_yvu(rgb)
        return float(np.degrees(np.arctan2(v, u)))

    turned = hue(decode(signal, hue_deg=degrees)[2, 377]) - hue(decode(signal)[2, 377])
    assert (turned + 180.0) % 360.0 - 180.0 == pytest.approx(degrees, abs=1e-9)
    point, scope = (scopes.vectors(signal, 2, hue_deg=turn)[377] for turn in (0.0, degrees))
    assert scopes.hue_and_amplitude(scope)[0] - scopes.hue_and_amplitude(point)[0] == pytest.approx(degrees)


def test_the_chroma_control_scales_colour_and_leaves_luminance() -> None:
    rgb = np.array([0.7, 0.3, 0.2])
    wanted = color.rgb_to_yiq(rgb, matrix="standard")
    for factor in (0.0, 0.5, 1.4):
        found = color.rgb_to_yiq(decode(flat(tuple(rgb)), chroma=factor)[2, 377], matrix="standard")
        np.testing.assert_allclose(found, wanted * [1.0, factor, factor], atol=1e-9)


def test_a_decoder_follows_the_burst() -> None:
    """A signal whose subcarrier as a whole is turned has the same colours: hue is measured against the burst."""
    rgb = np.array([0.75, 0.1, 0.2])
    signal = flat((0.75, 0.1, 0.2))
    middle = signal.levels.of(0.299 * 0.75 + 0.587 * 0.1 + 0.114 * 0.2)
    seen = slice(FIRST_ACTIVE, FIRST_ACTIVE + ACTIVE)
    picture, both = signal.ire.copy(), signal.ire.copy()
    picture[:, seen] = 2 * middle - picture[:, seen]
    both[:, seen], both[:, BURST] = picture[:, seen], -both[:, BURST]
    turned = Signal(both, signal.lines, signal.frame, signal.levels)
    np.testing.assert_allclose(burst_phase_deg(turned), 0.0, atol=1e-9)
    np.testing.assert_allclose(decode(turned)[2, 377], rgb, atol=1e-9)
    # Turned against its burst, a colour becomes its complement of the same luminance.
    alone = decode(Signal(picture, signal.lines, signal.frame, signal.levels))[2, 377]
    np.testing.assert_allclose(alone, 2 * (rgb @ [0.299, 0.587, 0.114]) - rgb, atol=1e-9)


def test_frames_of_any_number_have_the_subcarrier_of_one_of_two() -> None:
    for number in (3, 10**20 + 1, -1):
        np.testing.assert_array_equal(subcarrier([1, 2], number), subcarrier([1, 2], 1))
    np.testing.assert_array_equal(subcarrier([5], 10**20), subcarrier([5], 0))
    assert not np.array_equal(subcarrier([5], 1), subcarrier([5], 0))


def grating(mhz: float) -> np.ndarray:
    """Grey stripes (8, 754, 3), 0.5 ± 0.3."""
    wave = 0.5 + 0.3 * np.cos(2 * np.pi * mhz / SAMPLE_MHZ * np.arange(ACTIVE))
    return np.repeat(np.tile(wave, (8, 1))[..., None], 3, axis=-1)


def saturation(rgb: np.ndarray) -> float:
    """Largest colour signal in the middle of the picture."""
    yiq = color.rgb_to_yiq(rgb, matrix="standard")[2:-2, 150:-150]
    return float(np.hypot(yiq[..., 1], yiq[..., 2]).max())


def test_fine_luminance_near_the_subcarrier_yields_false_colour() -> None:
    fine, coarse = encode(grating(3.5)), encode(grating(1.0))
    assert saturation(decode(fine, decoder="notch")) > 0.25
    assert saturation(decode(fine, decoder="low-pass")) > 0.25
    assert saturation(decode(coarse, decoder="notch")) < 0.01
    # Vertical stripes are the same on all lines, the subcarrier is not: the comb tells them apart.
    assert saturation(decode(fine, decoder="comb")) < 1e-9


def test_the_comb_keeps_fine_luminance_that_a_notch_removes() -> None:
    fine = encode(grating(3.4))
    ranges = {d: np.ptp(separate(fine, d)[0][4, 400:600]) for d in DECODERS}
    assert ranges["comb"] == pytest.approx(0.6, abs=0.02)
    assert ranges["notch"] < 0.1 and ranges["low-pass"] < 0.12


def test_an_edge_of_colour_makes_dots() -> None:
    rgb = np.full((8, ACTIVE, 3), (0.75, 0.0, 0.0))
    rgb[:, 377:] = color.yiq_to_rgb(color.rgb_to_yiq([0.75, 0.0, 0.0]) * [1.0, -0.5, -0.5])
    luminance = separate(encode(rgb), "notch")[0][:, FIRST_ACTIVE + 340 : FIRST_ACTIVE + 420]
    assert np.ptp(luminance[4]) > 0.05
    # They crawl: on the next line of the field they stand where they did not.
    np.testing.assert_allclose(luminance[4] + luminance[6], 2 * luminance[4].mean(), atol=0.02)
    comb = separate(encode(rgb), "comb")[0][:, FIRST_ACTIVE + 340 : FIRST_ACTIVE + 420]
    assert np.ptp(comb[4]) < 0.005


def test_an_edge_of_q_smears_over_the_inverse_of_twice_its_band() -> None:
    """A low-pass of bandwidth B rises in about 1/(2B): 1 µs for Q, 0.38 µs for I; from 10 % to 90 %, 0.9 of that."""
    for axis, mhz in ((1, 1.3), (2, 0.5)):
        yiq = np.zeros((1, ACTIVE, 3))
        yiq[..., 0] = 0.5
        yiq[:, 377:, axis] = 0.2
        rise = band_limited_yiq(color.yiq_to_rgb(yiq, matrix="standard"))[0, :, axis] / 0.2
        t = np.interp([0.1, 0.9], rise[340:410], np.arange(340, 410) / SAMPLE_MHZ)
        assert t[1] - t[0] == pytest.approx(0.9 / (2 * mhz), rel=0.15)


def test_mistakes_are_told() -> None:
    with pytest.raises(UsageError, match=r"lines of 754 samples, .* not of the shape \(4, 700, 3\)"):
        encode(np.zeros((4, 700, 3)))
    with pytest.raises(UsageError, match="not finite"):
        encode(np.full((1, ACTIVE, 3), np.nan))
    with pytest.raises(UsageError, match=r"no decoder 'combs': .* \(did you mean"):
        decode(flat((0.0, 0.0, 0.0)), decoder="combs")
    with pytest.raises(UsageError, match="chroma control of -1"):
        decode(flat((0.0, 0.0, 0.0)), chroma=-1.0)
    with pytest.raises(UsageError, match=r"bandwidth of I is 3 MHz: expected 0.1 to 1.4"):
        Bandwidth(i=3.0)
    silent = flat((0.0, 0.0, 0.0))
    with pytest.raises(UsageError, match="has no burst"):
        decode(Signal(np.zeros_like(silent.ire), silent.lines))
    with pytest.raises(UsageError, match="no line 6: the picture has lines 0 to 5"):
        scopes.waveform(silent, 6)
