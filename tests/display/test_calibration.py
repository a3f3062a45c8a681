"""A maladjusted monitor comes back by readings alone, and what is said of it is true."""

import datetime
import re
from dataclasses import replace

import numpy as np
import pytest

from illuminant import color
from illuminant.display.calibration import (
    adjust,
    analyzer,
    chroma_hue,
    description,
    fit,
    guide,
    monitor,
    readings,
    record,
    report,
    session,
)
from illuminant.display.displays import named
from illuminant.display.patterns import PATTERNS, Screen, options
from illuminant.errors import DataError, UsageError

SEEDS = range(8)


def measured(which, seed=0, codes=None, **noise):
    """Readings of a monitor with an instrument of realistic error."""
    codes = readings.plan() if codes is None else codes
    return readings.Readings(codes, monitor.Instrument(which, seed=seed, **noise).measure(codes))


def exact(which, codes=None):
    """What a monitor shows, without any error."""
    codes = readings.plan() if codes is None else codes
    return readings.Readings(codes, which.xyz(codes))


# --- the simulated monitor ---------------------------------------------------------------------------------------


def test_ideal_settings_give_d6500_at_all_levels():
    levels = np.repeat(np.linspace(0.05, 1.0, 20)[:, None], 3, axis=1)
    xyz = monitor.Monitor().xyz(levels)
    xy = xyz[:, :2] / xyz.sum(axis=1)[:, None]
    np.testing.assert_allclose(xy, np.tile(monitor.D6500, (20, 1)), atol=1e-12)
    assert xyz[-1, 1] == pytest.approx(103.0, abs=1e-9)
    assert pytest.approx(30 * 3.4262591, abs=0.3) == monitor.WHITE_LUMINANCE, "30 foot-lamberts"


def test_bias_tints_the_dark_gain_the_light_and_tracking_what_lies_between():
    codes = np.array([[0.1] * 3, [0.5] * 3, [1.0] * 3])

    def red_error(**knobs):
        light = monitor.Monitor(**knobs).light(codes)
        return np.abs(light[:, 0] / light[:, 1] - 1.0)

    by_bias = red_error(bias=(0.02, 0.0, 0.0))
    assert by_bias[0] > 4 * by_bias[1] > 4 * by_bias[2]
    by_gain = red_error(gain=(1.05, 1.0, 1.0))
    np.testing.assert_allclose(by_gain, by_gain[0])
    by_tracking = red_error(tracking=(0.1, 0.0, 0.0))
    assert by_tracking[2] == 0.0 and by_tracking[1] > 0.05


def test_a_monitor_warms_up_within_half_an_hour():
    cold = monitor.Monitor()
    white = [cold.xyz([1.0, 1.0, 1.0], minutes)[1] / 103.0 for minutes in (0, 10, 30, 120)]
    assert white[0] < 0.93 and abs(white[2] - 1.0) < 0.01 and abs(white[3] - 1.0) < 1e-4
    assert white == sorted(white)


def test_a_monitor_drifts_more_the_longer_it_is_left():
    def moved(days):
        white = np.ones(3)
        lab = [
            color.xyz_to_lab(m.xyz(white), monitor.Monitor().xyz(white).tolist())
            for m in (monitor.Monitor(), monitor.Monitor().age(days, seed=4))
        ]
        return float(color.delta_e_2000(*lab))

    assert moved(0) == 0.0
    assert 0.2 < moved(30) < moved(300) < 20.0


def test_an_instrument_errs_as_it_says_and_the_same_seed_errs_the_same():
    codes = np.repeat([[0.5, 0.5, 0.5]], 4000, axis=0)
    first = monitor.Instrument(monitor.Monitor(), seed=5).measure(codes)
    np.testing.assert_array_equal(first, monitor.Instrument(monitor.Monitor(), seed=5).measure(codes))
    true = monitor.Monitor().xyz([0.5] * 3)
    spread = np.sqrt(0.005**2 + (0.003 * true) ** 2)
    np.testing.assert_allclose(first.std(axis=0), spread, rtol=0.05)
    np.testing.assert_allclose(first.mean(axis=0), true, atol=4 * spread.max() / 4000**0.5)


# --- comparator and analyzer --------------------------------------------------------------------------------------


def test_a_comparator_matches_what_an_eye_cannot_tell_apart():
    reference = np.array(color.white_xyz(monitor.D6500)) * 103.0
    comparator = analyzer.Comparator()
    assert comparator.judge(reference).matches
    assert comparator.judge(1.01 * reference).matches
    brighter = comparator.judge(1.1 * reference)
    assert not brighter.matches and brighter.brighter == pytest.approx(0.1) and brighter.du == 0.0
    reddish = comparator.judge(reference + np.array([3.0, 1.5, 0.1]))
    assert not reddish.matches and reddish.du > 0.002
    assert not comparator.judge([0.0, 0.0, 0.0]).matches


def test_an_analyzer_shows_a_taught_white_as_alike_at_any_level():
    device = analyzer.Analyzer()
    white = monitor.maladjusted(5).xyz([1.0, 1.0, 1.0])
    device.teach("one", white)
    device.teach("other", [95.0, 100.0, 109.0])
    np.testing.assert_allclose(device.read(0.03 * white, "one"), 0.03, rtol=1e-12)
    assert np.ptp(device.read(white, "other")) > 0.02
    scales = device.scales(0.5 * white, "one")
    assert scales["green"] == pytest.approx(0.5) and scales["red"] == pytest.approx(1.0)


def test_an_analyzer_reads_each_gun_of_its_phosphors_alone():
    device = analyzer.Analyzer()
    device.teach("m", monitor.Monitor().xyz([1.0, 1.0, 1.0]))
    np.testing.assert_allclose(device.read(monitor.Monitor().xyz(np.eye(3)), "m"), np.eye(3), atol=1e-12)


def test_an_analyzer_that_was_taught_nothing_says_so():
    with pytest.raises(UsageError, match="memory 'studio' is empty"):
        analyzer.Analyzer().read([1.0, 1.0, 1.0], "studio")
    with pytest.raises(UsageError, match="no light"):
        analyzer.Analyzer().teach("studio", [0.0, 0.0, 0.0])


# --- fit -----------------------------------------------------------------------------------------------------------


def test_exact_readings_give_back_every_number_of_the_model():
    rows = np.array([[40.0, 21.0, 2.0], [35.0, 71.0, 12.0], [18.0, 8.0, 95.0]])
    true = fit.Characterisation(
        rows, np.array([0.3, 0.31, 0.35]), np.array([0.96, 1.03, 1.0]), np.array([2.1, 2.3, 2.6])
    )
    codes = readings.plan()
    found = fit.fit(readings.Readings(codes, true.xyz(codes)))
    for name in ("primaries", "black", "gain", "gamma"):
        np.testing.assert_allclose(getattr(found.model, name), getattr(true, name), rtol=1e-4, atol=1e-4)
    assert found.residuals.max() < 1e-3 and found.outliers == ()
    assert found.additivity == pytest.approx(0.0, abs=1e-12) and found.drift == 0.0


def test_codes_and_light_of_a_fit_are_inverse():
    model = fit.fit(measured(monitor.maladjusted(2))).model
    linear = np.random.default_rng(1).random((200, 3))
    np.testing.assert_allclose(model.light(model.codes(linear)), linear, atol=1e-12)
    np.testing.assert_allclose(model.linear(model.xyz(model.codes(linear))), linear, atol=1e-12)


def test_one_wrong_reading_is_named_and_does_little_harm():
    bad = monitor.maladjusted(6)
    table = measured(bad, seed=6)
    xyz = table.xyz.copy()
    xyz[7] *= 1.35
    found = fit.fit(readings.Readings(table.codes, xyz))
    assert found.outliers == (7,)
    assert report.described_chart(bad.xyz, found.model).mean < 0.6


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda c, x: (c[1:], x[1:]), "black"),
        (lambda c, x: (c[(c != [0, 1, 0]).any(axis=1)], x[(c != [0, 1, 0]).any(axis=1)]), "full green"),
        (lambda c, x: (c, np.tile(x[-1:], (len(x), 1))), "no three colours"),
        (lambda c, x: (c, x[::-1]), "no three colours|not those of a monitor"),
        (lambda c, x: (c[[0, 10, 17, 24, 31]], x[[0, 10, 17, 24, 31]]), "three levels"),
    ],
)
def test_readings_that_are_no_monitors_are_refused_with_what_is_missing(change, words):
    table = exact(monitor.Monitor())
    codes, xyz = change(table.codes, table.xyz)
    with pytest.raises(DataError, match=words):
        fit.fit(readings.Readings(codes, xyz))


# --- a monitor comes back ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", SEEDS)
def test_a_maladjusted_monitor_comes_back_by_its_description(seed):
    bad = monitor.maladjusted(seed)
    found = fit.fit(measured(bad, seed=seed))
    before = report.nominal_chart(bad.xyz)
    after = report.described_chart(bad.xyz, found.model, bits=8)
    assert before.mean > 2.0
    assert after.mean < 0.4 and after.max < 1.0, "with codes of 8 bits"
    assert after.outside == ("cyan",) and after.mean_all < 0.6
    # What the readings alone say of it agrees with the truth.
    said = report.described_chart(report.as_read(measured(bad, seed=seed), found.model), found.model)
    assert abs(said.mean - after.mean) < 0.4


@pytest.mark.parametrize("seed", SEEDS)
def test_a_maladjusted_monitor_comes_back_by_its_knobs(seed):
    bench = monitor.Instrument(monitor.maladjusted(seed, tracking=False), seed=seed)
    done = adjust.adjust(bench)
    assert done.converged and done.readings < 250
    greys = report.greys(exact(done.monitor))
    bright = [grey for grey in greys if grey.luminance > 2.0]
    assert max(grey.off for grey in bright) < 0.005, "D6500 at all levels"
    assert bright[-1].luminance == pytest.approx(103.0, rel=0.02)
    assert report.nominal_chart(done.monitor.xyz, assumed="SMPTE-C").mean < 1.4, "with phosphors of its type"
    after = fit.fit(measured(done.monitor, seed=seed))
    assert report.described_chart(done.monitor.xyz, after.model, bits=8).mean < 0.4


@pytest.mark.parametrize("seed", SEEDS)
def test_tracking_controls_bring_guns_of_different_gamma_together(seed):
    bench = monitor.Instrument(monitor.maladjusted(seed), seed=seed)
    done = adjust.adjust(bench, tracking=True)
    assert max(grey.off for grey in report.greys(exact(done.monitor)) if grey.luminance > 2.0) < 0.005
    assert report.nominal_chart(done.monitor.xyz, assumed="SMPTE-C").mean < 1.0


def test_without_tracking_controls_different_gammas_leave_a_tint_between():
    bad = replace(monitor.Monitor(), gamma=(2.1, 2.3, 2.2))
    done = adjust.adjust(monitor.Instrument(bad, seed=1))
    levels = {round(grey.code, 1): grey.off for grey in report.greys(exact(done.monitor))}
    assert levels[0.5] > 2 * max(levels[1.0], levels[0.2]), "low and high fields are set, the middle is not"


def test_pluge_sets_a_black_at_which_the_brighter_bar_is_just_seen():
    bench = monitor.Instrument(monitor.maladjusted(2, tracking=False), seed=2)
    done = adjust.adjust(bench, levels="pluge")
    black, brighter = (float(done.monitor.xyz([v] * 3)[1]) for v in (0.0, 0.04))
    assert brighter - black > 0.5 * adjust.VISIBLE * (black + adjust.VEIL)
    dimmer = replace(done.monitor, brightness=done.monitor.brightness - 0.012)
    lost = [float(dimmer.xyz([v] * 3)[1]) for v in (0.0, 0.04)]
    assert not adjust.pluge_visible(*lost)
    assert done.monitor.xyz([1.0] * 3)[1] == pytest.approx(103.0, rel=0.02)


def test_an_adjustment_uses_readings_alone():
    seen = []

    class Watched(monitor.Instrument):
        def measure(self, codes, repeat=1):
            seen.append(np.asarray(codes).tolist())
            return super().measure(codes, repeat)

    adjust.adjust(Watched(monitor.maladjusted(1, tracking=False), seed=1))
    assert {tuple(code) for code in seen} == {(0.0,) * 3, (0.2,) * 3, (1.0,) * 3}


def test_levels_that_are_not_known_are_refused():
    with pytest.raises(UsageError, match="not 'eye'"):
        adjust.adjust(monitor.Instrument(monitor.Monitor()), levels="eye")


# --- report ------------------------------------------------------------------------------------------------------


def test_an_ideal_monitor_passes_and_a_maladjusted_one_does_not():
    good = report.verdict(exact(monitor.Monitor()))
    assert [line.passed for line in good] == [True] * 4
    names = {line.name: line.passed for line in report.verdict(exact(monitor.maladjusted(4)))}
    assert not names["white point"] and not names["grey scale"]
    dim = report.verdict(exact(replace(monitor.Monitor(), peak=60.0)))
    assert {line.name: line.passed for line in dim}["white luminance"] is False


def test_the_ideal_monitor_shows_the_chart_without_error_through_its_own_numbers():
    ideal = monitor.Monitor()
    model = fit.fit(exact(ideal)).model
    chart = report.described_chart(ideal.xyz, model)
    assert chart.mean < 1e-3 and chart.white == pytest.approx(103.0, rel=1e-4)
    assert chart.outside == ("cyan",) and chart.differences["cyan"] > 1.0


def test_the_white_that_is_meant_is_the_brightest_the_monitor_reaches():
    model = fit.fit(exact(monitor.maladjusted(4))).model
    level = model.reachable(monitor.D6500)
    white = np.array(color.white_xyz(monitor.D6500))
    assert model.linear(white * level).max() == pytest.approx(1.0, abs=1e-12)
    assert model.linear(white * level).min() > 0.7


# --- description ---------------------------------------------------------------------------------------------------


def test_a_description_comes_back_from_its_file_and_shows_what_the_fit_says(tmp_path):
    bad = monitor.maladjusted(3)
    model = fit.fit(measured(bad, seed=3)).model
    path = tmp_path / "left.toml"
    description.save(path, model, 'left "bright" monitor')
    display = named(path)
    assert display == description.to_display(model, 'left "bright" monitor')
    codes = np.random.default_rng(4).random((50, 3))
    # All but the tint of black, which a display does not have.
    np.testing.assert_allclose(display.to_xyz(codes), model.xyz(codes), rtol=1e-3, atol=0.05)
    through = report.described_chart(bad.xyz, description.Described(display), bits=8)
    assert through.mean < 0.4


def test_a_chart_through_a_description_is_verified_by_readings(tmp_path):
    bad = monitor.maladjusted(7)
    path = tmp_path / "a.toml"
    description.save(path, fit.fit(measured(bad, seed=7)).model, "a")
    codes = description.chart_codes(path)
    np.testing.assert_allclose(codes * 255, np.round(codes * 255), atol=1e-9)
    chart = description.read_chart(path, measured(bad, seed=8, codes=codes[::-1]))
    assert chart.mean < 0.6
    other = monitor.maladjusted(1)
    assert description.read_chart(path, measured(other, codes=codes)).mean > 2.0
    with pytest.raises(DataError, match="no reading of dark skin"):
        description.read_chart(path, measured(bad, codes=codes[1:]))


# --- readings ------------------------------------------------------------------------------------------------------


def test_readings_come_back_from_their_file(tmp_path):
    table = measured(monitor.maladjusted(0))
    path = tmp_path / "a.csv"
    readings.Readings(table.codes, table.xyz, {"monitor": "left"}).save(path)
    back = readings.read(path)
    np.testing.assert_allclose(back.codes, table.codes, atol=1e-12)
    np.testing.assert_allclose(back.xyz, table.xyz, rtol=1e-4)
    assert back.about == {"monitor": "left"} and back.bits == 8


def test_chromaticities_are_readings_too():
    text = "# bits: 10\nr,g,b,x,y,Y\n1023,1023,1023,0.3127,0.3290,103\n\n0,0,0,0,0,0\n"
    found = readings.parse(text)
    np.testing.assert_allclose(found.xyz[0], np.array(color.white_xyz(monitor.D6500)) * 103.0)
    assert found.xyz[1].tolist() == [0.0, 0.0, 0.0] and found.codes[0].tolist() == [1.0] * 3


def test_a_spreadsheet_with_decimal_commas_is_read():
    found = readings.parse("﻿".strip("﻿") + "r;g;b;X;Y;Z\n1;1;1;95,1;100,0;108,9\n0,5;0;0;1;2;3\n")
    assert found.xyz[0].tolist() == [95.1, 100.0, 108.9] and found.codes[1].tolist() == [0.5, 0.0, 0.0]


def test_rows_without_a_reading_are_kept_apart():
    found = readings.parse("r,g,b,X,Y,Z\n0,0,0,,,\n1,1,1,95,100,109\n")
    assert len(found.codes) == 1 and found.unread.tolist() == [[0.0, 0.0, 0.0]]
    assert readings.parse(found.text()).unread.tolist() == [[0.0, 0.0, 0.0]]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 0, "no line that names the columns"),
        ("r,g,b,X,Y,Z\n", 0, "no readings"),
        ("r,g,b,X,Y,Z\n0,0,0,,,\n", 0, "no readings"),
        ("r,g,b,Y\n", 1, "Expected the columns"),
        ("1,2,3,4,5,6\n", 1, "Expected the columns"),
        ("r,g,b,X,Y,Z\n0,0,0,1,2\n", 2, "Expected 6 numbers"),
        ("r,g,b,X,Y,Z\n0,0,0,1,,3\n", 2, "Y is empty"),
        ("r,g,b,X,Y,Z\n0,0,0,1,two,3\n", 2, "Y is 'two'"),
        ("r,g,b,X,Y,Z\n0,0,0,1,nan,3\n", 2, "Y is nan"),
        ("r,g,b,X,Y,Z\n0,0,0,1,-2,3\n", 2, "Y is -2"),
        ("r,g,b,X,Y,Z\n0,0,0,1,1e300,3\n", 2, "Y is 1e300"),
        ("r,g,b,X,Y,Z\n255,0,0,1,2,3\n", 2, "write `# bits: 8`"),
        ("# bits: 8\nr,g,b,X,Y,Z\n256,0,0,1,2,3\n", 3, "from 0 to 255"),
        ("# bits: lots\nr,g,b,X,Y,Z\n", 1, "'lots'"),
        ("r,g,b,X,Y,Z\n# bits: 8\n", 2, "must stand above"),
        ("r,g,b,x,y,Y\n0,0,0,0.3,0,5\n", 2, "no colour has"),
        ("r,g,b,x,y,Y\n0,0,0,0.8,0.4,5\n", 2, "no colour has"),
    ],
)
def test_a_mistake_in_a_table_is_told_with_its_line(text, line, words):
    with pytest.raises(DataError) as caught:
        readings.parse(text, "a.csv")
    assert caught.value.line == line and words in str(caught.value)
    assert str(caught.value).startswith("a.csv")


def test_files_that_are_no_tables_are_refused(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"\xff\xfe\x00binary")
    with pytest.raises(DataError, match="not text in UTF-8"):
        readings.read(tmp_path / "a.csv")
    with pytest.raises(DataError, match="cannot be read"):
        readings.read(tmp_path / "none.csv")


def test_a_plan_has_exact_codes_and_all_a_fit_needs():
    for bits in (6, 8, 10):
        codes = readings.plan(bits=bits) * (2**bits - 1)
        np.testing.assert_allclose(codes, np.round(codes), atol=1e-9)
    assert readings.plan()[0].tolist() == [0.0] * 3
    assert fit.fit(exact(monitor.Monitor(), readings.plan(levels=3, channels=3))).residuals.max() < 0.05


# --- chroma and hue ------------------------------------------------------------------------------------------------


def test_a_right_decoder_gives_back_the_picture_and_shows_no_split():
    colors = np.random.default_rng(9).random((20, 3))
    np.testing.assert_allclose(chroma_hue.Decoder().rgb(colors), colors, atol=1e-12)
    assert np.abs(chroma_hue.split(chroma_hue.Decoder())).max() < 1e-12


def test_chroma_shows_in_the_outer_bars_most_and_hue_in_the_inner():
    outer, inner = np.abs(chroma_hue.split(chroma_hue.Decoder(chroma=1.1)))
    assert outer > 2 * inner
    outer, inner = np.abs(chroma_hue.split(chroma_hue.Decoder(hue_deg=8.0)))
    assert inner > 2 * outer


@pytest.mark.parametrize(
    ("chroma", "hue"), [(0.5, 0.0), (1.6, -20.0), (1.0, 40.0), (0.7, -45.0), (1.3, 25.0)]
)
def test_both_knobs_are_set_by_the_blue_view(chroma, hue):
    done = chroma_hue.adjust(chroma_hue.Decoder(chroma, hue))
    assert abs(done.chroma - 1.0) < 0.02 and abs(done.hue_deg) < 1.0


# --- guide, session, record --------------------------------------------------------------------------------------


def test_the_guide_has_six_steps_and_names_patterns_that_exist():
    assert len(guide.STEPS) == 6
    for step in guide.STEPS:
        assert step.todo and step.passes and step.modern
        for pattern in step.patterns:
            name, *words = pattern.split()
            assert name in PATTERNS
            given = {word[2:] for word in words if word.startswith("--")} - {"blue-only"}
            assert given <= set(options(name))
    text = " ".join(" ".join((*step.todo, *step.passes)) for step in guide.STEPS)
    for fact in (
        "30 minutes",
        "3 foot-candles",
        "10 %",
        "103 cd/m²",
        "28 foot-lamberts",
        "month",
        "six months",
    ):
        assert fact in text, fact


def test_a_session_has_a_page_that_shows_every_picture_and_a_table_to_fill_in(tmp_path):
    files = session.write(tmp_path / "studio", Screen(160, 90))
    page = files[0].read_text()
    pictures = re.findall(r'"file": "([^"]+)"', page)
    assert [path.name for path in files[2:]] == pictures
    assert all((tmp_path / "studio" / name).is_file() for name in pictures)
    table = readings.read(files[1], empty=True)
    np.testing.assert_allclose(table.unread, readings.plan(), atol=1e-12)
    assert len(pictures) == len(table.unread) + len(session.ADJUST)


def test_a_table_with_readings_is_not_overwritten(tmp_path):
    session.write(tmp_path, Screen(160, 90), codes=np.eye(3))
    (tmp_path / "readings.csv").write_text("r,g,b,X,Y,Z\n1,1,1,95,100,109\n")
    with pytest.raises(DataError, match="not overwritten"):
        session.write(tmp_path, Screen(160, 90), codes=np.eye(3))


def entry(day, white=(97.9, 103.0, 112.2), kind="analyzer"):
    return record.Entry(datetime.date.fromisoformat(day), kind, white, (2.8, 3.0, 3.3))


def test_a_record_tells_how_far_a_monitor_moved_and_when_to_look_again(tmp_path):
    path = tmp_path / "log.csv"
    assert record.append(path, entry("2026-01-01", kind="full")).moved is None
    second = record.append(path, entry("2026-01-31"), found=((98.6, 103.0, 112.2), (2.8, 3.0, 3.3)))
    assert 1.0 < second.moved < 5.0
    entries = record.read(path)
    assert len(entries) == 2 and entries[1].moved == pytest.approx(second.moved, abs=0.01)
    plan = record.schedule(entries)
    wait = (plan.analyzer - entries[1].date).days
    assert wait == int(30 / round(second.moved, 2)) and 7 <= wait < 30
    assert plan.full == datetime.date(2026, 7, 2)


def test_a_monitor_that_hardly_moves_is_looked_at_once_a_month(tmp_path):
    path = tmp_path / "log.csv"
    record.append(path, entry("2026-01-01", kind="full"))
    record.append(path, entry("2026-01-31"))
    plan = record.schedule(record.read(path))
    assert (plan.analyzer - datetime.date(2026, 1, 31)).days == 30


def test_a_monitor_that_moved_far_is_calibrated_in_full_at_once(tmp_path):
    path = tmp_path / "log.csv"
    record.append(path, entry("2026-01-01", kind="full"))
    record.append(path, entry("2026-01-31", white=(80.0, 70.0, 60.0)))
    plan = record.schedule(record.read(path))
    assert plan.full == datetime.date(2026, 1, 31) and "in full now" in plan.reason
    assert (plan.analyzer - datetime.date(2026, 1, 31)).days == 7


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("2026-13-01,full,1,1,1,1,1,1,,", "no date"),
        ("2026-01-01,half,1,1,1,1,1,1,,", "not 'half'"),
        ("2026-01-01,full,1,1,x,1,1,1,,", "Expected numbers"),
        ("2026-01-01,full,1,1,nan,1,1,1,,", "from 0 up"),
        ("2026-01-01,full,1,1", "found 4"),
    ],
)
def test_a_mistake_in_a_record_is_told_with_its_line(tmp_path, line, words):
    path = tmp_path / "log.csv"
    path.write_text(record.COLUMNS + "\n" + line + "\n")
    with pytest.raises(DataError, match=words) as caught:
        record.read(path)
    assert caught.value.line == 2


def test_a_record_goes_forward_in_time(tmp_path):
    path = tmp_path / "log.csv"
    record.append(path, entry("2026-02-01"))
    with pytest.raises(UsageError, match="goes on to 2026-02-01"):
        record.append(path, entry("2026-01-01"))
    with pytest.raises(UsageError, match="above 0"):
        record.append(path, entry("2026-03-01", white=(0.0, 0.0, 0.0)))
    (tmp_path / "other.csv").write_text("a,b\n1,2\n")
    with pytest.raises(DataError, match="no record"):
        record.read(tmp_path / "other.csv")
