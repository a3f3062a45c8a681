"""Gamma: tables against the book's print, lost levels, and fits against known monitors."""

import numpy as np
import pytest

from illuminant import color
from illuminant.display.calibration import readings as calibration
from illuminant.display.calibration.monitor import Monitor
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
from illuminant.display.gamma.readings import read_readings
from illuminant.display.gamma.response import correction, response
from illuminant.display.gamma.table_file import read_table, write_table
from illuminant.errors import DataError, ImageError, UsageError

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
