"""Gamma: tables against the book's print, fits against known monitors, drift and banding against what they claim."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from illuminant import color
from illuminant.display.calibration import readings as calibration
from illuminant.display.calibration.monitor import Monitor
from illuminant.display.displays import named
from illuminant.display.gamma.banding import banding, compared, gradation, shaded_sphere
from illuminant.display.gamma.brightness import brightness, equal_steps, lightness, resemblance
from illuminant.display.gamma.drift import shown, study
from illuminant.display.gamma.fitting import MODELS, fit_gamma
from illuminant.display.gamma.levels import lost_levels, spread
from illuminant.display.gamma.lookup_table import (
    LookupTable,
    correction_table,
    log_codes,
    log_intensity,
    log_table,
    quantised,
)
from illuminant.display.gamma.phosphors import read_phosphors
from illuminant.display.gamma.readings import Measured, read_readings
from illuminant.display.gamma.remapping import degradation, remap
from illuminant.display.gamma.response import correction, response
from illuminant.display.gamma.storage import (
    at_display,
    before_storage,
    light,
    show_through_table,
    store_corrected,
    store_linear,
)
from illuminant.display.gamma.table_file import read_table, write_table
from illuminant.errors import DataError, ImageError, UsageError
from illuminant.plots import gamma_curves
from illuminant.plots.banding_sheet import sheet, staircase, tile
from illuminant.plots.gamma_drift import drift as drawn_drift

# Table 5.1 of the book, γ 2.2: every entry that is printed.
BOOK = {
    **dict(enumerate([0, 20, 28, 33, 38, 42, 46, 49, 52, 55, 58, 61, 63, 65, 68, 70])),
    **dict(enumerate([72, 74, 76, 78, 80, 81, 83, 85, 87, 88, 90], 16)),
    **dict(enumerate([243, 244, 244, 245, 245, 246, 246, 247, 247], 231)),
    **dict(enumerate([248, 248, 249, 249, 249, 250, 250, 251, 251, 252, 252, 253, 253, 254, 254, 255], 240)),
}


# --- curves and tables -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("curve", [1.0, 1.8, 2.2, 3.0, "sRGB", "Rec.709"])
def test_black_and_white_are_fixed_and_the_two_curves_together_change_nothing(curve):
    at = np.linspace(0.0, 1.0, 1000).reshape(10, 100)
    np.testing.assert_allclose(response(correction(at, curve), curve), at, atol=1e-12)
    np.testing.assert_allclose(correction([0.0, 1.0], curve), [0.0, 1.0], atol=1e-12)
    assert correction(0.5, curve).shape == ()


def test_every_printed_entry_of_table_5_1_comes_out_truncated_and_not_rounded():
    assert len(BOOK) == 52
    codes, printed = np.array(list(BOOK)), np.array(list(BOOK.values()))
    np.testing.assert_array_equal(correction_table(2.2, rounding="truncate")(codes), printed)
    rounded = correction_table(2.2).entries[codes]
    assert np.count_nonzero(rounded != printed) > 15


@pytest.mark.parametrize("bits", [1, 6, 8, 10, 16])
@pytest.mark.parametrize("rounding", ["nearest", "truncate"])
def test_a_table_of_gamma_one_leaves_every_code_as_it_is(bits, rounding):
    np.testing.assert_array_equal(correction_table(1, bits, bits, rounding).entries, np.arange(1 << bits))


def test_a_table_rises_from_black_to_white_for_any_bits():
    for in_bits, out_bits in ((1, 16), (8, 12), (12, 8), (16, 1)):
        entries = correction_table(2.4, in_bits, out_bits).entries.astype(int)
        assert (np.diff(entries) >= 0).all()
        assert (entries[0], entries[-1]) == (0, (1 << out_bits) - 1)


def test_rounding_is_to_the_nearest_code_and_what_lies_outside_is_clamped():
    values = np.array([-1.0, 0.4999 / 255, 0.5001 / 255, 1.7, np.nan, np.inf])
    assert quantised(values, 8).tolist() == [0, 0, 1, 255, 0, 255]


def test_steps_of_logarithmic_storage_have_one_ratio():
    intensity = log_intensity(np.arange(1, 256), 8, 1000.0)
    ratios = intensity[1:] / intensity[:-1]
    np.testing.assert_allclose(ratios, 1000.0 ** (1 / 255), rtol=1e-12)
    np.testing.assert_array_equal(log_codes(log_intensity(np.arange(256))), np.arange(256))
    assert log_codes([0.0, 1e-9, -1.0, np.nan]).tolist() == [0, 0, 0, 0]


def test_twelve_bits_out_keep_every_step_of_logarithmic_storage_that_eight_lose():
    kept = {bits: lost_levels(log_table(2.2, 8, bits)).used for bits in (8, 10, 12)}
    assert kept[12] == 256
    assert kept[8] < kept[10] < kept[12]


@pytest.mark.parametrize("ending", [".csv", ".cube", ".spi1d"])
def test_a_table_comes_back_from_its_file(tmp_path, ending):
    for table in (correction_table(2.2, 8, 10, "truncate"), correction_table("sRGB", 4, 16)):
        write_table(table, tmp_path / f"a{ending}")
        back = read_table(tmp_path / f"a{ending}")
        np.testing.assert_array_equal(back.entries, table.entries)
        assert (back.in_bits, back.out_bits) == (table.in_bits, table.out_bits)


@pytest.mark.parametrize("ending", [".cube", ".spi1d"])
def test_opencolorio_applies_the_table_that_was_written(tmp_path, ending):
    oiio = pytest.importorskip("OpenImageIO")
    table = correction_table(2.2, 8, 8, "truncate")
    write_table(table, tmp_path / f"a{ending}")
    ramp = np.repeat(table.inputs.astype(np.float32)[None, :, None], 3, axis=2)
    buffer = oiio.ImageBuf(np.ascontiguousarray(ramp))
    through = oiio.ImageBufAlgo.ociofiletransform(buffer, str(tmp_path / f"a{ending}"))
    assert not through.has_error, through.geterror()
    found = np.asarray(through.get_pixels(oiio.FLOAT))[0, :, 1]
    np.testing.assert_allclose(found, table.outputs, atol=2e-5)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("code,entry\n0,0\n2,3\n", "code 1"),
        ("code,entry\n0,0\n1,300\n", "no entry of 8 bits"),
        ("# out_bits: 40\ncode,entry\n0,0\n1,1\n", "1 to 16"),
        ("code,entry\n0,0\n1,1\n2,2\n", "power of 2"),
        ("code,entry\n0,x\n", "no row of numbers"),
        ("code,entry\n0,nan\n1,1\n", "no entry"),
        ("", "0 entries"),
    ],
)
def test_a_damaged_table_is_one_sentence_with_its_file(tmp_path, content, message):
    path = tmp_path / "a.csv"
    path.write_text(content)
    with pytest.raises(DataError, match=message) as caught:
        read_table(path, out_bits=8)
    assert str(caught.value).startswith(str(path))


def test_tables_of_three_dimensions_of_colours_and_of_other_endings_are_refused(tmp_path):
    path = tmp_path / "a.cube"
    path.write_text("LUT_3D_SIZE 2\n0 0 0\n1 1 1\n")
    with pytest.raises(DataError, match="three dimensions"):
        read_table(path)
    path.write_text("LUT_1D_SIZE 2\n0 0 0\n1 0.9 1\n")
    with pytest.raises(DataError, match="same number three times"):
        read_table(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(DataError, match="not text"):
        read_table(path)
    with pytest.raises(DataError, match="cannot be read"):
        read_table(tmp_path / "none.cube")
    with pytest.raises(UsageError, match="ends in"):
        write_table(correction_table(2.2), tmp_path / "a.txt")
    with pytest.raises(ImageError, match="no folder"):
        write_table(correction_table(2.2), tmp_path / "no" / "a.cube")


def test_mistakes_in_tables_are_sentences():
    for wrong in (0, -1.0, float("nan"), float("inf")):
        with pytest.raises(UsageError, match="number above 0"):
            correction_table(wrong)
    with pytest.raises(UsageError, match="sRGBB"):
        correction_table("sRGBB")
    with pytest.raises(UsageError, match="1 to 16 bits"):
        correction_table(2.2, 17)
    with pytest.raises(UsageError, match="rounding"):
        correction_table(2.2, rounding="up")
    with pytest.raises(UsageError, match="0 to 255"):
        correction_table(2.2)([256])
    with pytest.raises(UsageError, match="whole codes"):
        correction_table(2.2)([0.5])
    with pytest.raises(UsageError, match="4 whole numbers"):
        LookupTable(np.arange(5), 2, 8)
    with pytest.raises(UsageError, match="contrast"):
        log_codes([0.1], contrast=1.0)


# --- lost levels -------------------------------------------------------------------------------------------------


def test_the_book_s_lost_levels_are_found():
    table = correction_table(2.2, rounding="truncate")
    found = lost_levels(table)
    assert {34, 35, 36, 37} <= set(found.unused.tolist())
    assert [253, 254, 254] in found.merged.tolist()
    assert found.used + len(found.unused) == 256
    assert found.used + found.merged_codes == 256
    # The lowest 10 % of intensities go to the lowest 35 % of the display's range.
    assert spread(table, 0.1)[1] == pytest.approx(0.1 ** (1 / 2.2), abs=0.01)
    assert round(100 * 0.1 ** (1 / 2.2)) == 35


@pytest.mark.parametrize("gamma", [1.0, 1.4, 2.2, 2.8])
@pytest.mark.parametrize(("in_bits", "out_bits"), [(8, 8), (6, 6), (8, 10), (10, 8)])
def test_counts_of_levels_agree_with_a_count_code_by_code(gamma, in_bits, out_bits):
    table = correction_table(gamma, in_bits, out_bits)
    found = lost_levels(table)
    entries = table.entries.tolist()
    present = set(entries)
    assert found.used == len(present)
    assert found.unused.tolist() == [code for code in range(1 << out_bits) if code not in present]
    runs = sum(last - first for first, last, _ in found.merged.tolist())
    assert runs == found.merged_codes == len(entries) - len(present)
    if gamma == 1.0 and in_bits == out_bits:
        assert (found.merged_codes, len(found.unused)) == (0, 0)


def test_a_table_that_falls_has_no_levels_to_count():
    with pytest.raises(UsageError, match="falls after code 1"):
        lost_levels(LookupTable(np.array([0, 3, 2, 3]), 2, 2))


# --- fits --------------------------------------------------------------------------------------------------------


CODES = np.arange(0, 256, 15)


def readings(seed, gamma, *, gain=1.0, floor=0.0, meter=0.0):
    """A monitor with 100 cd/m² of white, read with 2 % of noise and what else is asked for."""
    rng = np.random.default_rng(seed)
    true = 100.0 * np.maximum(gain * CODES / 255.0 + 1.0 - gain, 0.0) ** gamma
    noise = 0.02 * rng.standard_normal(len(CODES)), meter * rng.standard_normal(len(CODES))
    return true * (1.0 + noise[0]) + floor + noise[1]


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("gamma", [1.0, 2.2, 2.9])
def test_a_monitor_without_noise_is_found_to_the_last_digits(model, gamma):
    found = fit_gamma(CODES, readings(0, gamma) * 0 + 80.0 * (CODES / 255.0) ** gamma, model)
    assert found.gamma == pytest.approx(gamma, abs=1e-6)
    assert found.peak == pytest.approx(80.0, rel=1e-6)
    assert (found.floor, found.gain) == pytest.approx((0.0, 1.0), abs=1e-5)


def test_floor_and_gain_are_found_where_there_is_no_noise():
    v = CODES / 255.0
    found = fit_gamma(CODES, 90.0 * v**2.4 + 0.7, "offset")
    assert (found.gamma, found.peak, found.floor) == pytest.approx((2.4, 90.0, 0.7), rel=1e-6)
    found = fit_gamma(CODES, 90.0 * np.maximum(1.08 * v - 0.08, 0.0) ** 2.1, "gain-offset-gamma")
    assert (found.gamma, found.peak, found.gain) == pytest.approx((2.1, 90.0, 1.08), rel=1e-5)
    np.testing.assert_allclose(found.luminance([255, 0]), [90.0, 0.0], atol=1e-6)


@pytest.mark.parametrize(
    ("model", "monitor"),
    [
        ("power", {"meter": 0.05}),
        ("power", {"floor": 0.05}),
        ("offset", {"floor": 0.05}),
        ("gain-offset-gamma", {"gain": 1.05, "meter": 0.05}),
    ],
)
def test_gamma_comes_back_from_noise_within_its_stated_error(model, monitor):
    """2 % of noise and a floor of 0.05 cd/m²: of 12 monitors at most 2 may be off by more than three errors."""
    away = []
    for seed in range(12):
        gamma = 1.8 + seed / 12.0
        found = fit_gamma(CODES, readings(seed, gamma, **monitor), model)
        away.append((found.gamma - gamma) / found.gamma_error)
        assert found.gamma == pytest.approx(gamma, abs=0.15 if model == "gain-offset-gamma" else 0.06)
        assert 0.005 < found.scatter < 0.06
    assert np.count_nonzero(np.abs(away) > 3.0) <= 2
    # Errors are not stated larger than they are either.
    assert np.sqrt(np.mean(np.square(away))) > 0.4


def test_the_automatic_cutoff_leaves_out_what_stray_light_spoils():
    clean, lit = readings(1, 2.4), readings(1, 2.4, floor=0.5)
    assert fit_gamma(CODES, lit).cutoff > 4 * fit_gamma(CODES, clean).cutoff
    everything = fit_gamma(CODES, lit, cutoff=0.0)
    assert everything.used.sum() == len(CODES) - 1, "a line of logarithms cannot hold code 0"
    assert abs(fit_gamma(CODES, lit).gamma - 2.4) < 0.3 * abs(everything.gamma - 2.4)


def test_a_cutoff_by_hand_is_kept_and_the_code_of_white_may_be_given():
    read = readings(2, 2.2)
    found = fit_gamma(CODES, read, cutoff=10.0, white_code=1023)
    assert found.cutoff >= 10.0
    np.testing.assert_array_equal(found.used, read >= 10.0)
    assert found.peak == pytest.approx(100.0 * (1023 / 255) ** found.gamma, rel=0.05)


def test_the_order_and_the_unit_of_readings_change_nothing():
    read, order = readings(3, 2.2, floor=0.05), np.random.default_rng(0).permutation(len(CODES))
    for model in ("power", "offset"):
        found = fit_gamma(CODES, read, model)
        mixed = fit_gamma(CODES[order] * 4, read[order] / 3.4, model)
        assert mixed.gamma == pytest.approx(found.gamma, abs=1e-6)
        np.testing.assert_array_equal(mixed.used, found.used[order])


def test_mistakes_in_readings_are_sentences():
    good = 100.0 * (CODES / 255.0) ** 2.2
    with pytest.raises(UsageError, match="needs readings of 90 and more"):
        fit_gamma(CODES, good, cutoff=90.0)
    with pytest.raises(UsageError, match="did you mean"):
        fit_gamma(CODES, good, "ofset")
    with pytest.raises(UsageError, match="one length"):
        fit_gamma(CODES, good[:-1])
    with pytest.raises(UsageError, match="not a number"):
        fit_gamma(CODES, np.where(CODES == 15, np.nan, good))
    with pytest.raises(UsageError, match="above 0"):
        fit_gamma(CODES, 0 * good)
    with pytest.raises(UsageError, match="rise with the code"):
        fit_gamma(CODES, good[::-1])
    for model in MODELS:
        with pytest.raises(UsageError):
            fit_gamma([1, 1, 1, 1, 1], [1, 2, 3, 4, 5], model)


@pytest.mark.parametrize("model", MODELS)
def test_readings_that_tell_no_gamma_are_one_sentence(model):
    dark = np.where(CODES < 255, -1.0 - CODES / 255.0, 3.0)
    huge = np.full(len(CODES), 1e308)
    for read in (dark, huge, np.where(CODES < 255, 0.0, 1.0), np.where(CODES < 1, 1.0, -CODES)):
        with pytest.raises(DataError, match="two readings above 0 that differ"):
            fit_gamma(CODES, read, model)
    # Two that differ, or numbers near the largest there are: a finite fit or a sentence.
    few = np.where(CODES > 230, CODES / 255.0, -2.0)
    for read in (few, huge * (CODES / 255.0), np.where(CODES == 0, 2.0, np.where(CODES == 255, 3.0, -1.0))):
        try:
            found = fit_gamma(CODES, read, model)
        except (DataError, UsageError):
            continue
        assert np.isfinite([found.gamma, found.gamma_error, found.scatter, *found.errors.values()]).all()


def test_black_that_was_read_by_itself_is_taken_off_first():
    v = CODES / 255.0
    found = fit_gamma(CODES, 80.0 * v**2.3 + 0.5, black=0.5)
    assert (found.gamma, found.peak, found.floor) == pytest.approx((2.3, 80.0, 0.5), rel=1e-9)
    np.testing.assert_allclose(found.luminance([0, 255]), [0.5, 80.5], rtol=1e-9)
    np.testing.assert_allclose(found.residuals, 0.0, atol=1e-9)
    with pytest.raises(UsageError, match="above black"):
        fit_gamma(CODES, v, black=1.0)


def test_noise_in_the_dark_does_little_harm_to_a_fit_with_a_cutoff():
    random = np.random.default_rng(2)
    v = np.linspace(0.03, 1.0, 33)
    reads = [90.0 * v**2.35 + random.normal(0.0, 0.05, v.shape) for _ in range(40)]
    gammas = [fit_gamma(v, read).gamma for read in reads]
    assert abs(np.mean(gammas) - 2.35) < 0.005 and np.std(gammas) < 0.01
    # Without a cutoff the darkest readings spoil it.
    assert np.std([fit_gamma(v, read, cutoff=0.0).gamma for read in reads]) > 4 * np.std(gammas)


def test_a_table_of_calibration_gives_greys_and_guns(tmp_path):
    codes = calibration.plan()
    model = Monitor(gamma=(2.1, 2.3, 2.2))
    calibration.Readings(codes, model.xyz(codes)).save(tmp_path / "studio.csv")
    found = read_readings(tmp_path / "studio.csv")
    assert {name: len(column.codes) for name, column in found.items()} == {
        "grey": 12, "red": 8, "green": 8, "blue": 8
    }  # fmt: skip
    assert found["red"].codes.max() == 255.0
    gammas = [fit_gamma(*found[gun], "offset").gamma for gun in ("red", "green", "blue")]
    assert gammas == pytest.approx(model.gamma, abs=2e-3)
    short = calibration.Readings(codes[[0, -1]], model.xyz(codes[[0, -1]]))
    short.save(tmp_path / "short.csv")
    with pytest.raises(DataError, match="not 4 levels"):
        read_readings(tmp_path / "short.csv")


def test_readings_of_three_guns_come_from_one_file(tmp_path):
    path = tmp_path / "guns.csv"
    path.write_text("# a monitor\ncode, red, green, blue\n0,0,0.1,0\n255, 20, 70, 10  # white\n")
    found = read_readings(path)
    assert list(found) == ["red", "green", "blue"]
    assert found["green"].luminances.tolist() == [0.1, 70.0]
    for content, message in (("", "no readings"), ("a,b\n1,x\n", ":2: 'x'"), ("1,2\n1\n", ":2: Expected 2")):
        path.write_text(content)
        with pytest.raises(DataError, match=message):
            read_readings(path)


# --- phosphors ---------------------------------------------------------------------------------------------------


def test_xyz_of_the_guns_make_the_matrix_of_their_monitor(tmp_path):
    monitor = color.system("SMPTE-C")
    peak = 103.0 * np.array(monitor.to_xyz)
    rows = dict(zip(("red", "green", "blue"), peak.T, strict=True)) | {"white": peak.sum(axis=1)}
    path = tmp_path / "crt.csv"
    path.write_text("colour,X,Y,Z\n" + "".join(f"{n},{v[0]},{v[1]},{v[2]}\n" for n, v in rows.items()))
    found = read_phosphors(path)
    assert found.additivity == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(found.display().to_xyz_matrix, monitor.to_xyz, atol=1e-12)


def test_mistakes_in_phosphors_are_sentences(tmp_path):
    path = tmp_path / "crt.csv"
    rows = "red,0.63,0.34\ngreen,0.31,0.595\nblue,0.155,0.07\n"
    for content, message in (
        ("colour,x,y\n" + rows, "no white"),
        ("colour,x,y\n" + rows + "red,0.6,0.3\n", "twice"),
        ("colour,x,y\n" + rows + "white,0.9,0.9\n", "sum"),
        ("colour,x\n", "columns"),
        ("colour,x,y\nyellow,0.4,0.5\n", "none of"),
    ):
        path.write_text(content)
        with pytest.raises(DataError, match=message):
            read_phosphors(path)
    path.write_text("colour,x,y\n" + rows.replace("0.155,0.07", "0.47,0.4675") + "white,0.313,0.329\n")
    with pytest.raises(UsageError):
        read_phosphors(path).display()


# --- a wrong gamma -----------------------------------------------------------------------------------------------


def test_too_high_a_gamma_brightens_the_middle_component_of_the_book_s_example():
    colour = np.array([0.0, 127 / 255, 1.0])
    high, low = shown(colour, 2.8), shown(colour, 1.6)
    assert low[1] < colour[1] < high[1]
    np.testing.assert_allclose(high[[0, 2]], [0.0, 1.0], atol=1e-12)
    np.testing.assert_allclose(low[[0, 2]], [0.0, 1.0], atol=1e-12)
    # Too high shifts towards green, too low towards blue.
    y = color.chromaticity(color.rgb_to_xyz(np.stack([low, colour, high]), "book NTSC"))[:, 1]
    assert y[0] < y[1] < y[2]


@pytest.mark.parametrize("gamma", [0.5, 1.8, 2.6, 5.0])
def test_black_and_white_do_not_move(gamma):
    np.testing.assert_allclose(shown([0.0, 1.0], gamma), [0.0, 1.0], atol=1e-12)


def test_too_high_desaturates_and_too_low_moves_to_the_primaries():
    found = study((1.4, 1.8, 2.2, 2.6, 3.0))
    coloured = np.isfinite(found.saturation[0])
    assert coloured.sum() == 18, "six of the 24 are greys"
    # Distance from white falls as the gamma of correction rises, for each colour by itself.
    assert (np.diff(found.saturation[:, coloured], axis=0) < 0).all()
    np.testing.assert_allclose(found.saturation[2, coloured], 1.0, atol=1e-9)
    # With gamma of correction near 0 only the largest component is left, so a colour is at a primary.
    extreme = study((0.05,)).linear[0]
    for patch in np.flatnonzero(coloured):
        share = extreme[patch] / extreme[patch].max()
        assert np.sort(share)[1] < 0.3, found.names[patch]


def test_differences_grow_away_from_the_right_gamma_and_contrast_is_the_ratio_of_gammas():
    found = study((1.6, 1.9, 2.2, 2.5, 2.8))
    mean = found.difference.mean(axis=1)
    assert mean[0] > mean[1] > mean[2] < mean[3] < mean[4]
    assert mean[2] < 1e-9
    np.testing.assert_allclose(found.contrast, 2.2 / found.gammas, rtol=0.005)


def test_the_chart_lies_inside_the_book_s_monitor_and_cyan_outside_of_srgb():
    assert study((2.2,)).outside == ()
    assert study((2.2,), display="sRGB").outside == ("cyan",)
    with pytest.raises(UsageError, match="above 0"):
        study((0.0,))
    with pytest.raises(UsageError, match="at least one"):
        study(())


# --- perceived brightness ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("black", [0.001, 0.01, 0.1])
def test_steps_of_equal_brightness_have_equal_ratios_of_luminance(black):
    steps = equal_steps(20, black)
    luminance = black + (1 - black) * steps
    np.testing.assert_allclose(luminance[1:] / luminance[:-1], black ** (-1 / 20), rtol=1e-9)
    np.testing.assert_allclose(brightness(steps, black), np.arange(21) / 20, atol=1e-9)


def test_the_monitor_s_response_is_like_perceived_brightness():
    found = resemblance(2.2, 0.01)
    assert found.logarithmic > 0.97
    assert found.response > 0.96
    assert found.lightness > 0.999
    straight = resemblance(1.0, 0.01)
    assert straight.logarithmic < 0.93
    assert straight.lightness < 0.97
    # A darker black makes the curve begin steeper (footnote 8).
    assert brightness(0.01, 0.001) > brightness(0.01, 0.01) > brightness(0.01, 0.1)
    assert lightness(0.5) == pytest.approx((116 * 0.5 ** (1 / 3) - 16) / 100)
    with pytest.raises(UsageError, match="share"):
        brightness(0.5, 0.0)


# --- storage and banding -----------------------------------------------------------------------------------------


def test_each_way_of_storage_shows_what_it_stored_to_within_half_a_step():
    linear = np.random.default_rng(5).random((40, 50, 3))
    stored = store_corrected(linear, 8, 2.2)
    assert stored.dtype == np.uint8
    assert np.abs(stored / 255.0 - linear ** (1 / 2.2)).max() <= 0.5 / 255 + 1e-9
    shown_linear = light(show_through_table(store_linear(linear, 8), correction_table(2.2, 8, 16)), 16, 2.2)
    assert np.abs(shown_linear - linear).max() <= 0.5 / 255 + 1e-4
    np.testing.assert_array_equal(before_storage(linear, 8), light(stored, 8, 2.2))


@pytest.mark.parametrize("bits", [6, 8, 10])
@pytest.mark.parametrize("colour", [(1.0, 1.0, 1.0), (0.8, 0.55, 0.35), (0.2, 0.3, 0.7)])
def test_correction_before_storage_has_more_and_smaller_steps(bits, colour):
    before, at = compared(gradation(colour, 8192), bits)
    assert before.colours > 1.3 * at.colours
    assert before.low_colours > 2.5 * at.low_colours
    assert before.largest_step < 0.5 * at.largest_step
    assert before.mean_error < 0.5 * at.mean_error
    if len(set(colour)) > 1:
        assert before.largest_colour_step < 0.5 * at.largest_colour_step


def test_a_neutral_surface_has_no_colour_bands():
    for found in compared(gradation((1.0, 1.0, 1.0), 8192), 8):
        assert found.largest_colour_step < 1e-6
        assert found.levels[0] == found.colours
    assert compared(gradation((1.0, 1.0, 1.0), 8192), 8)[0].colours == 256
    assert compared(gradation((1.0, 1.0, 1.0), 8192), 8)[1].colours == lost_levels(correction_table(2.2)).used


def test_a_finer_table_at_display_helps_with_merged_codes_and_not_with_the_dark_ones():
    smooth = gradation((1.0, 1.0, 1.0), 8192)
    coarse, fine = compared(smooth, 8)[1], compared(smooth, 8, display_bits=12)[1]
    assert fine.colours == 256 > coarse.colours
    assert fine.largest_low_step > 2.0


def test_bits_halve_the_steps_of_dark_ramps():
    """Two bits more make the steps of a gradual dark ramp four times smaller (book footnote 10)."""
    smooth = gradation((1.0, 1.0, 1.0), 16384, top=0.05)
    steps = [compared(smooth, bits)[1].largest_step for bits in (8, 10)]
    assert steps[0] / steps[1] == pytest.approx(4.0, rel=0.2)


def test_a_smooth_gradation_has_no_error_and_mistakes_are_sentences():
    smooth = gradation(count=512)
    assert banding(smooth, smooth).mean_error == 0.0
    with pytest.raises(UsageError, match="two arrays"):
        banding(smooth, smooth[1:])
    with pytest.raises(UsageError, match="three numbers"):
        gradation((1.0, 2.0, 0.0))
    with pytest.raises(UsageError, match="at least 2 pixels"):
        shaded_sphere(1)


def test_the_sphere_is_brightest_towards_its_lamp():
    image = shaded_sphere(101, (1.0, 0.5, 0.25), light=(0.0, 0.0, 1.0), background=0.0)
    np.testing.assert_allclose(image[50, 50], [1.0, 0.5, 0.25], atol=1e-3)
    np.testing.assert_allclose(image, image[:, ::-1], atol=1e-12)
    assert image[0, 0].max() == 0.0


# --- from monitor to monitor -------------------------------------------------------------------------------------


def test_a_display_to_itself_changes_no_code():
    codes = np.random.default_rng(1).integers(0, 256, (30, 40, 3), dtype=np.uint8)
    for bits in (8, 10):
        mapped, clamped = remap(codes, named("sRGB"), replace(named("sRGB"), peak=250.0), bits=bits)
        np.testing.assert_array_equal(mapped, codes)
        assert clamped == 0.0


def test_a_mapped_colour_is_the_same_colour_to_within_its_rounding():
    codes = np.random.default_rng(2).integers(0, 256, (500, 3), dtype=np.uint8)
    a, b = named("sRGB"), named("Rec.2020")
    mapped, clamped = remap(codes, a, b, out_bits=16)
    assert clamped == 0.0
    np.testing.assert_allclose(
        b.to_xyz(mapped / 65535.0) / b.peak, a.to_xyz(codes / 255.0) / a.peak, atol=2e-4
    )


def test_white_goes_to_white_unless_luminance_is_kept():
    white = np.full((1, 3), 255, np.uint8)
    dim, bright = replace(named("sRGB"), peak=80.0), replace(named("Rec.709"), peak=100.0)
    assert remap(white, dim, bright)[0].tolist() == [[255, 255, 255]]
    kept, _ = remap(white, dim, bright, match="absolute")
    assert np.unique(kept).tolist() == [round(255 * float(named("Rec.709").encode([0.8] * 3)[0]))]
    assert remap(white, bright, dim, match="absolute")[1] == 1.0


def test_mapping_stored_codes_is_worse_than_mapping_floats_and_a_finer_file_is_better():
    # Colours of the smaller gamut alone, so that nothing is clamped.
    linear = np.random.default_rng(3).random((20000, 3)) ** 2.4
    a, b = named("sRGB"), named("Rec.2020")
    found = {bits: degradation(linear, a, b, bits=bits, out_bits=8) for bits in (6, 8, 12)}
    assert found[6].mean > found[8].mean > found[12].mean > 0.0
    assert found[8].clamped == 0.0
    # A half step of code, seen again on the other side: of the size of quantisation itself.
    assert 0.05 < found[8].mean < 1.0


def test_a_ramp_loses_codes_on_its_way_and_back():
    ramp = np.repeat(np.linspace(0.0, 1.0, 4096)[:, None] ** 2.2, 3, axis=1)
    found = degradation(ramp, named("NTSC 1953 D65"), named("sRGB"))
    assert max(found.levels) < max(found.float_levels) == 256
    assert found.colours < found.float_colours
    codes = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
    there, _ = remap(codes, named("NTSC 1953 D65"), named("sRGB"))
    back, _ = remap(there, named("sRGB"), named("NTSC 1953 D65"))
    assert 1 <= np.abs(back.astype(int) - codes).max() <= 8


def test_mistakes_in_a_mapping_are_sentences():
    a = named("sRGB")
    with pytest.raises(UsageError, match="whole numbers"):
        remap(np.zeros((2, 3)), a, a)
    with pytest.raises(UsageError, match="0 to 63"):
        remap(np.full((2, 3), 64), a, a, bits=6)
    with pytest.raises(UsageError, match="match"):
        remap(np.zeros((2, 3), int), a, a, match="near")
    with pytest.raises(UsageError, match="linear RGB"):
        degradation(np.zeros((2, 2)), a, a)


# --- figures -----------------------------------------------------------------------------------------------------


def test_the_pixels_of_the_sheet_are_the_codes_that_reach_the_monitor(tmp_path: Path):
    from PIL import Image

    from illuminant import plots

    figure = sheet((8, 6), size=90)
    plots.save(figure, tmp_path / "a.png")
    pixels = np.asarray(Image.open(tmp_path / "a.png").convert("RGB"))
    wanted = tile(shaded_sphere(90), "at display", 6)
    top = pixels.shape[0] - 8 - 90 - 90 // 6
    left = 8 + 90 + 8
    found = [
        np.array_equal(pixels[row : row + 90, left : left + 90], wanted) for row in range(top - 12, top + 12)
    ]
    assert sum(found) == 1
    assert set(np.unique(wanted)) <= set(np.round(np.arange(64) * 255 / 63).astype(int))


def test_plots_show_the_numbers_that_were_computed():
    axes = gamma_curves.response_and_correction(2.2).axes
    x, y = axes[0].lines[0].get_data()
    np.testing.assert_allclose(y, x**2.2, atol=1e-12)
    composition = axes[1].lines[-1]
    np.testing.assert_allclose(composition.get_ydata(), composition.get_xdata(), atol=1e-12)
    found = study((1.8, 2.2, 2.6))
    traces = [line.get_xydata() for line in drawn_drift(found).axes[0].lines if len(line.get_xydata()) == 3]
    assert any(np.allclose(trace, found.xy[:, 14]) for trace in traces)
    steps = staircase((8,)).axes[0].lines
    levels = [len(np.unique(np.round(line.get_ydata(), 9))) for line in steps]
    assert levels[1] < levels[0] < levels[2]
    read = readings(4, 2.2)
    drawn = gamma_curves.fitted({"grey": Measured(CODES, read)}, {"grey": fit_gamma(CODES, read)})
    assert drawn.axes[0].get_xscale() == "log"
    assert "γ 2.2" in drawn.axes[0].get_legend().get_texts()[0].get_text()
    assert gamma_curves.perceived(0.02).axes[1].get_xlabel() == "code value, or perceived brightness"
    with pytest.raises(UsageError, match="8 bits"):
        sheet((10,), size=60)
    with pytest.raises(UsageError, match="at least one"):
        sheet(())
    assert at_display([1.0], 8).tolist() == [1.0]
