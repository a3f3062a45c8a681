"""Test patterns hold the values that their standards print, on any screen."""

import inspect

import numpy as np
import pytest

from illuminant import color
from illuminant.display import patterns
from illuminant.display.displays import named
from illuminant.display.patterns import (
    Screen,
    color_bars,
    color_checker,
    gamma_chart,
    pluge,
    safe_areas,
    wedges,
)
from illuminant.display.patterns.screen import rgb
from illuminant.display.video import transmission
from illuminant.errors import DataError, UsageError


def at(values, x, y):
    """The colour at a place given as fractions of the picture."""
    return values[int(values.shape[0] * y), int(values.shape[1] * x)]


def small(name, **options):
    entry = patterns.PATTERNS[name]
    return patterns.draw(name, Screen(192, 108, entry.bits), **options)


# --- all patterns ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", patterns.names())
@pytest.mark.parametrize("size", [(192, 108), (640, 486), (333, 501)])
def test_a_pattern_has_the_size_asked_for_legal_values_and_the_same_bits_each_time(name, size):
    screen = Screen(*size, bits=patterns.PATTERNS[name].bits)
    values = patterns.draw(name, screen)
    assert values.shape == (size[1], size[0], 3)
    assert values.min() >= 0.0 and values.max() <= 1.0
    np.testing.assert_array_equal(values, patterns.draw(name, screen))


@pytest.mark.parametrize("name", patterns.names())
def test_every_pattern_says_what_it_is_for_and_takes_its_options_by_keyword(name):
    entry = patterns.PATTERNS[name]
    assert 10 < len(entry.summary) < 66
    function = patterns._function(entry, entry.function)
    kinds = [parameter.kind for parameter in inspect.signature(function).parameters.values()]
    assert all(kind is inspect.Parameter.KEYWORD_ONLY for kind in kinds[1:])


@pytest.mark.parametrize("name", [n for n, e in patterns.PATTERNS.items() if e.loaded_raw])
def test_signals_are_loaded_as_they_are_on_every_display(name):
    bits = patterns.PATTERNS[name].bits
    first, second = (
        patterns.draw(name, Screen(192, 108, bits, display)) for display in ("sRGB", "book NTSC")
    )
    np.testing.assert_array_equal(first, second)


@pytest.mark.parametrize("bits", [1, 4, 8, 10, 12, 16])
def test_a_pattern_is_quantised_to_any_number_of_bits(bits):
    picture = patterns.picture("smpte", Screen(70, 48, bits))
    codes = np.unique(picture.codes)
    assert codes.max() == 2**bits - 1 and codes.min() == 0
    assert picture.codes[4, 15, 0] == round(0.75 * (2**bits - 1))


# --- fields ----------------------------------------------------------------------------------------------------


def test_a_window_covers_the_square_of_its_fraction_and_is_centred():
    values = patterns.draw("window", Screen(400, 200), color=(0.2, 0.4, 0.6), window=0.5)
    lit = values[..., 2] > 0
    assert lit.mean() == 0.25
    np.testing.assert_array_equal(lit, lit[::-1, ::-1])
    assert values[100, 200].tolist() == [0.2, 0.4, 0.6]


def test_black_and_white_fields_are_the_ends_of_the_range():
    assert small("black").max() == 0.0
    assert small("white").min() == 1.0
    assert (small("field", color=0.25) == 0.25).all()


# --- PLUGE -----------------------------------------------------------------------------------------------------


def test_pluge_with_video_levels_has_a_bar_below_black():
    screen = Screen(700, 100, bits=8)
    codes = np.round(pluge.pluge(screen, levels="video") * 255)
    below, black, above = (int(at(codes, x, 0.5)[0]) for x in (2.5 / 7, 3.5 / 7, 4.5 / 7))
    # 4 % of the 219 codes from black to white.
    assert (below, black, above) == (7, 16, 25)
    codes = np.round(pluge.pluge(Screen(700, 100, bits=10), levels="video") * 1023)
    assert sorted(np.unique(codes)) == [29, 64, 99]


def test_pluge_for_a_frame_buffer_has_no_bar_below_black():
    values = small("pluge")
    assert sorted(np.unique(values)) == [0.0, 0.04]
    assert values[54, 0, 0] == 0.0, "black around it"


def test_pluge_needs_room_below_black():
    with pytest.raises(UsageError, match="8 bits or more"):
        patterns.draw("pluge", Screen(100, 100, bits=6), levels="video")


# --- colour bars -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["eia", "smpte"])
def test_the_bars_are_75_percent_in_order_of_luminance(name):
    values = patterns.draw(name, Screen(700, 480))
    bars = [at(values, (k + 0.5) / 7, 0.3) for k in range(7)]
    wanted = [(1, 1, 1), (1, 1, 0), (0, 1, 1), (0, 1, 0), (1, 0, 1), (1, 0, 0), (0, 0, 1)]
    np.testing.assert_array_equal(bars, 0.75 * np.array(wanted))
    luminance = color.monochrome(bars)
    assert (np.diff(luminance) < 0).all()


def test_the_levels_of_the_bars_are_those_of_the_standard(eia):
    found = color_bars.bar_levels()
    for name, (luminance, carrier, angle) in eia.items():
        assert found[name].luminance == pytest.approx(luminance, abs=0.06), name
        assert found[name].carrier == pytest.approx(carrier, abs=0.06), name
        assert found[name].angle_deg == pytest.approx(angle, abs=0.06), name
    assert found["yellow"].high == pytest.approx(100.0, abs=0.1)
    assert found["red"].low == pytest.approx(-15.6, abs=0.1)
    assert found["white 100%"].luminance == pytest.approx(100.0, abs=1e-9)


def test_minus_i_and_plus_q_have_the_amplitude_of_the_burst_on_black():
    found = color_bars.bar_levels()
    for name, angle in (("-I", 303.0), ("+Q", 33.0)):
        assert found[name].luminance == pytest.approx(7.5, abs=1e-9)
        assert found[name].carrier == pytest.approx(40.0, abs=1e-9)
        assert found[name].angle_deg == pytest.approx(angle, abs=1e-9)
    assert min(color_bars.minus_i(lift=False)) < -0.1, "which no frame buffer holds"


def test_lifted_bars_keep_their_vectors_and_change_their_luminance(eia):
    plain, lifted = color_bars.bar_levels(), color_bars.bar_levels(lift=True)
    for name, function in (("-I", color_bars.minus_i), ("+Q", color_bars.plus_q)):
        assert lifted[name].angle_deg == pytest.approx(plain[name].angle_deg, abs=1e-9)
        assert lifted[name].carrier == pytest.approx(plain[name].carrier, abs=1e-9)
        assert lifted[name].luminance > plain[name].luminance + 10.0
        signals = function(lift=True)
        assert min(signals) == 0.0 and max(signals) < 1.0
    for name in eia:
        assert lifted[name] == plain[name]


def test_without_setup_lifted_signals_are_those_of_rp_219():
    np.testing.assert_allclose(color_bars.minus_i(lift=True, setup=0.0), (0.0, 0.2456, 0.4125), atol=1e-4)
    np.testing.assert_allclose(color_bars.plus_q(lift=True, setup=0.0), (0.2536, 0.0, 0.4703), atol=1e-4)


def test_the_bottom_of_the_eia_bars_is_minus_i_white_plus_q_black():
    values = patterns.draw("eia", Screen(1400, 480))
    places = [0.5 * 5 / 28, 1.5 * 5 / 28, 2.5 * 5 / 28, 0.9]
    wanted = [color_bars.minus_i(lift=True), (1, 1, 1), color_bars.plus_q(lift=True), (0, 0, 0)]
    np.testing.assert_allclose([at(values, x, 0.9) for x in places], wanted)
    # Three quarters of the height belong to the bars.
    assert values[359, 0].tolist() == [0.75] * 3 and values[360, 0, 0] == 0.0


def test_the_encoded_pattern_differs_from_that_of_the_frame_buffer_in_luminance_alone():
    screen = Screen(560, 120)
    encoded, stored = (
        color.rgb_to_yiq(f(screen), matrix="standard") for f in (color_bars.encoded_eia, color_bars.eia)
    )
    np.testing.assert_allclose(encoded[..., 1:], stored[..., 1:], atol=1e-12)
    assert encoded[-1, 10, 0] == pytest.approx(0.0, abs=1e-12)


def test_the_split_has_the_same_blue_as_the_bars_above_it():
    values = patterns.draw("smpte", Screen(700, 480))
    for k in range(7):
        bar, split = (at(values, (k + 0.5) / 7, y) for y in (0.3, 0.7))
        assert bar[2] == split[2]
        assert (bar != split).any() or k in (1, 3, 5) or bar[2] == 0.0
    shown = color_bars.blue_only(values)
    # Rows of bars and of the split cannot be told apart.
    np.testing.assert_array_equal(shown[100], shown[340])


def test_the_smpte_pattern_has_pluge_below_red():
    values = patterns.draw("smpte", Screen(2100, 480))
    third = [float(at(values, (5 + (k + 0.5) / 3) / 7, 0.9)[0]) for k in range(3)]
    assert third == [0.0, 0.0, 0.04]


# --- gamma, ramps ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("gamma", [1.0, 1.8, 2.2, 2.6, 3.0])
def test_the_patch_of_a_gamma_is_as_bright_as_the_lines_on_a_display_of_that_gamma(gamma):
    code = gamma_chart.matching_code(gamma)
    assert code**gamma == pytest.approx(0.5, abs=1e-12)
    screen = Screen(1100, 450)
    values = patterns.draw("gamma", screen)
    index = round((gamma - 1.0) / 0.2)
    patch = values[100:101, index * 100 + 50]
    assert patch[0].tolist() == [code] * 3
    lines = values[50:70, index * 100 + 2] ** gamma
    assert lines.mean() == pytest.approx(0.5)


def test_the_light_on_the_chart_is_any_word_of_a_lamp():
    white = (0.3127, 0.329)
    warm = color_checker.chart_xyz(white, light="2856K")
    np.testing.assert_allclose(warm, color_checker.chart_xyz(white, light="A"), atol=2e-4)
    assert np.abs(warm - color_checker.chart_xyz(white)).max() > 0.01
    with pytest.raises(DataError, match="a lamp has one of emission"):
        color_checker.chart_xyz(white, light="ColorChecker/red")


def test_the_patch_that_vanishes_on_a_display_of_srgb_is_that_of_2_2():
    half = float(named("sRGB").encode(np.full(3, 0.5))[0])
    off = [abs(gamma_chart.matching_code(gamma) - half) for gamma in gamma_chart.GAMMAS]
    assert round(gamma_chart.GAMMAS[int(np.argmin(off))], 1) == 2.2
    assert gamma_chart.matching_code(2.255) == pytest.approx(half, abs=5e-5)


def test_lines_and_checker_are_half_lit_in_every_row_of_the_gamma_chart():
    screen = Screen(1100, 450)
    for weave in gamma_chart.WEAVES:
        values = patterns.draw("gamma", screen, weave=weave)
        strip = values[50:450, 0:4]
        assert set(np.unique(strip)) == {0.0, 1.0}
        np.testing.assert_allclose(strip[0:100].mean(axis=(0, 1)), [0.5, 0.5, 0.5])
        np.testing.assert_allclose(strip[100:200].mean(axis=(0, 1)), [0.5, 0.0, 0.0])


def test_a_ramp_rises_evenly_in_code_or_in_light():
    coded = small("ramp", channel="green")
    np.testing.assert_allclose(np.diff(coded[50, :, 1]), 1 / 191, atol=1e-12)
    assert coded[..., [0, 2]].max() == 0.0
    light = small("ramp", channel="grey", even="light")
    srgb = named("sRGB")
    np.testing.assert_allclose(np.diff(srgb.decode(light[50])[:, 0]), 1 / 191, atol=1e-9)


def test_all_channels_have_a_band_in_the_ramp():
    values = small("ramp")
    ends = [values[int((k + 0.5) * 27), -1].tolist() for k in range(4)]
    assert ends == [[1, 1, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_steps_run_both_ways_and_are_even():
    values = small("steps", count=5)
    up = [float(at(values, (k + 0.5) / 5, 0.25)[0]) for k in range(5)]
    down = [float(at(values, (k + 0.5) / 5, 0.75)[0]) for k in range(5)]
    assert up == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert down == up[::-1]


def test_shadows_have_four_steps_of_10_bits_in_one_of_8():
    picture = patterns.picture("shadows", Screen(1920, 100, bits=10), level=0.125)
    above, below = (np.unique(picture.codes[row, :, 0]) for row in (20, 80))
    assert len(below) == 128 + 1
    assert len(above) == 32 + 1
    assert np.diff(below).max() == 1, "no code of 10 bits is left out"
    assert np.diff(above).min() >= 4
    with pytest.raises(UsageError, match="8 bits: 10 to 16"):
        patterns.draw("shadows", Screen(200, 100, bits=8))


# --- ColorChecker ------------------------------------------------------------------------------------------------


def test_the_printed_chart_gives_the_tinted_white_that_the_errata_name():
    linear = color.xyz_to_rgb(np.array(color_checker.BOOK), "book NTSC")
    np.testing.assert_allclose(linear[18], (1.030, 0.969, 1.096), atol=1.5e-3)
    found = color_checker.patches("book NTSC", "book")
    np.testing.assert_allclose(found.linear, linear, atol=1e-9)
    assert "white 9.5" in found.outside
    lines = color_checker.note(Screen(100, 100, display_name="book NTSC"), chart="book")
    assert "illuminant C" in lines[0] and "white 9.5" in lines[1]


def test_the_adapted_printed_chart_is_neutral_from_black_to_white():
    found = color_checker.patches("book NTSC", "book adapted")
    np.testing.assert_allclose(found.linear[18], 1.0, atol=1e-9)
    np.testing.assert_allclose(found.linear[23], 0.0, atol=1e-9)
    for row in found.linear[19:23]:
        assert np.ptp(row) < 0.02 * row.max() + 1e-3


@pytest.mark.parametrize(
    "pair", [("sRGB", "Display P3"), ("SMPTE-C", "NTSC 1953 D65"), ("Rec.709", "Rec.2020 PQ")]
)
def test_two_displays_show_the_same_chart(pair):
    first, second = (named(name) for name in pair)
    one, other = (color_checker.patches(display, white_luminance=70.0) for display in (first, second))
    inside = [k for k, name in enumerate(one.names) if name not in one.outside + other.outside]
    assert len(inside) >= 23
    np.testing.assert_allclose(
        first.to_xyz(one.codes)[inside], second.to_xyz(other.codes)[inside], rtol=1e-6, atol=1e-6
    )
    np.testing.assert_allclose(first.to_xyz(one.codes)[inside], one.xyz[inside], rtol=1e-6, atol=1e-6)


def test_only_cyan_lies_outside_srgb_and_nothing_outside_rec_2020():
    assert color_checker.patches("sRGB").outside == ("cyan",)
    assert color_checker.patches("Rec.2020").outside == ()


def test_the_measured_chart_is_near_the_colours_its_maker_states():
    # X-Rite's sRGB of dark skin, blue, green, red and white, of the charts before 2014.
    stated = {0: (115, 82, 68), 12: (56, 61, 150), 13: (70, 148, 73), 14: (175, 54, 60), 18: (243, 243, 242)}
    codes = color_checker.patches("sRGB").codes * 255
    for patch, wanted in stated.items():
        labs = [
            color.xyz_to_lab(color.rgb_to_xyz(np.array(c) / 255, "sRGB", encoded=True))
            for c in (codes[patch], wanted)
        ]
        assert color.delta_e_2000(*labs) < 3.0, color_checker.NAMES[patch]


def test_a_perfect_diffuser_is_the_white_of_any_display():
    for name in ("sRGB", "book NTSC", "NTSC 1953"):
        white = named(name).white
        for light in ("D65", "A"):
            greys = color_checker.chart_xyz(white, light=light)[18:23]
            xy = greys[:, :2] / greys.sum(axis=1)[:, None]
            np.testing.assert_allclose(xy, np.tile(white, (5, 1)), atol=0.006)


def test_the_chart_has_six_by_four_square_patches_in_order():
    screen = Screen(645, 435)
    values = patterns.draw("colorchecker", screen)
    codes = color_checker.patches("sRGB").codes
    for index in range(24):
        row, column = divmod(index, 6)
        center = values[15 + 105 * row + 45, 15 + 105 * column + 45]
        np.testing.assert_array_equal(center, codes[index])
    assert values[7].max() == 0.0, "black around them"


# --- wedges, convergence, safe areas -------------------------------------------------------------------------------


@pytest.mark.parametrize(("axis", "index"), [("Y", 0), ("I", 1), ("Q", 2)])
def test_a_wedge_differs_from_grey_along_its_axis_alone(axis, index):
    values = patterns.draw("wedges", Screen(320, 240), axis=axis)
    yiq = color.rgb_to_yiq(values[22:215, 60:260]) - [0.5, 0.0, 0.0]
    assert np.abs(np.delete(yiq, index, axis=-1)).max() < 1e-12
    assert np.abs(yiq[..., index]).max() > 0.29


def test_wedges_sent_through_ntsc_merge_in_the_order_of_the_bands():
    screen = Screen(640, 240)
    rows, lines = wedges.fineness(240, 10, 240)
    image = patterns.draw("wedges", screen, coarsest=10, lines=240)[rows]
    sent = color.rgb_to_yiq(transmission.transmit(image, decoder="notch"))
    merged = []
    for axis, left in enumerate(screen.edges([1, 1, 1], 640)[:3]):
        seen = np.ptp(sent[:, left + 60 : left + 150, axis], axis=1)
        merged.append(lines[np.flatnonzero(seen > 0.5 * seen[:20].max())[-1]] * 640 / 240 / 2)
    # Cycles in the width at which half of the contrast is left: I and Q by their filters, Y by the notch.
    assert 120 < merged[0] < 240 and 60 < merged[1] < 110 and 22 < merged[2] < 45


def test_a_wedge_has_as_many_lines_as_it_says():
    rows, lines = wedges.fineness(400, 20, 200)
    image = patterns.draw("wedges", Screen(1200, 400), axis="Y", coarsest=20, lines=200)[rows, :, 0] - 0.5
    for row in (30, 150, 300):
        line = image[row, 400:800]
        marked = np.flatnonzero(np.abs(line) > 0.1)
        flips = marked[np.flatnonzero(np.diff(np.sign(line[marked])))]
        assert 400 / np.diff(flips).mean() == pytest.approx(lines[row], rel=0.03)


def test_wedges_get_finer_and_fainter_but_never_change_their_mean():
    values = patterns.draw("wedges", Screen(640, 480), axis="Y", lines=480)
    row = values[:, 200:440, 0]
    contrast = [np.ptp(row[y]) for y in (45, 240, 438)]
    assert contrast[0] == 1.0
    assert contrast[0] >= contrast[1] >= contrast[2]
    np.testing.assert_allclose(row[45:430].mean(axis=1), 0.5, atol=5e-3)


def test_a_crosshatch_has_square_meshes_and_is_symmetric():
    values = patterns.draw("crosshatch", Screen(960, 540), count=12)[..., 0]
    np.testing.assert_array_equal(values, values[::-1, ::-1])
    columns = np.flatnonzero(np.diff(values[22]) > 0)
    rows = np.flatnonzero(np.diff(values[:, 22]) > 0)
    assert abs(np.diff(columns).mean() - np.diff(rows).mean()) < 0.6
    dots = patterns.draw("dots", Screen(960, 540), count=12)[..., 0]
    assert 0 < dots.mean() < values.mean()


def test_safe_areas_are_the_fractions_of_the_standards():
    assert safe_areas.rectangle(1000, 500, 0.9) == (50, 25, 950, 475)
    for action, title in safe_areas.STANDARDS.values():
        for part in (action, title):
            mask = safe_areas.inside(1000, 500, part)
            assert mask.mean() == pytest.approx(part**2, abs=3e-3)
            np.testing.assert_array_equal(mask, mask[::-1, ::-1])
    values = patterns.draw("safe-areas", Screen(1000, 500))
    assert values[25, 500, 0] == 1.0 and values[50, 500, 0] == 1.0
    assert values[24, 500, 0] == values[40, 500, 0] == 0.25
    other = patterns.draw("safe-areas", Screen(1000, 500), standard="ST 2046-1")
    assert other[25, 700, 0] == 1.0 and other[17, 700, 0] == 1.0, (
        "the title area is as large as the old action area"
    )


def test_an_overlay_is_seen_on_light_and_dark_and_leaves_the_picture():
    image = np.full((480, 640, 3), 0.2)
    drawn = safe_areas.overlay(image)
    changed = (drawn != image).any(axis=-1)
    assert (image == 0.2).all()
    assert changed[24, 32:608].all() and changed[48, 64:576].all() and changed[240, 320]
    assert not changed[:24].any() and changed.mean() < 0.02
    assert (drawn[changed] == 1.0).all()
    assert (safe_areas.overlay(np.ones((480, 640, 3))).min(axis=-1)[changed] == 0.0).all()
    assert (safe_areas.overlay(image, color=(1.0, 0.0, 0.0))[changed] == [1.0, 0.0, 0.0]).all()


def test_text_outside_the_title_area_is_found():
    title = np.zeros((100, 200))
    assert safe_areas.outside(title, 0.8) == 0.0
    title[50, 100], title[2, 2] = 3.0, 1.0
    assert safe_areas.outside(title, 0.8) == 0.25
    assert safe_areas.outside(np.eye(100), 0.8) == pytest.approx(0.2)
    image = np.zeros((100, 100, 3))
    image[50, 50] = 1.0
    assert safe_areas.outside(safe_areas.detail(image)) == 0.0
    image[95, 95] = 1.0
    assert safe_areas.outside(safe_areas.detail(image)) == 0.5
    assert safe_areas.outside(safe_areas.detail(image), safe_areas.ACTION) == 0.5
    for wrong in (lambda: safe_areas.outside(image), lambda: safe_areas.overlay(image[..., 0])):
        with pytest.raises(UsageError, match="not"):
            wrong()


# --- mistakes --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("windo", {}, 'did you mean "window"'),
        ("window", {"window": 0.0}, "above 0 up to 1, not 0"),
        ("window", {"window": float("nan")}, "not nan"),
        ("window", {"color": (0.1, 0.2)}, "not 2"),
        ("window", {"color": (0.1, 0.2, 1.5)}, "not 0.1, 0.2, 1.5"),
        ("window", {"color": float("nan")}, "not nan"),
        ("window", {"color": "red"}, "not 'red'"),
        ("black", {"color": 0.5}, "it has no options"),
        ("ramp", {"window": 0.5}, "its options are channel, even"),
        ("ramp", {"channel": "cyan"}, "not 'cyan'"),
        ("ramp", {"even": "lab"}, "not 'lab'"),
        ("steps", {"count": 1}, "not 1"),
        ("shadows", {"level": 2.0}, "not 2"),
        ("gamma", {"weave": "tartan"}, "not 'tartan'"),
        ("pluge", {"levels": "film"}, "not 'film'"),
        ("smpte", {"setup": 99.0}, "setup of 99 IRE"),
        ("wedges", {"axis": "U"}, "not 'U'"),
        ("wedges", {"lines": 5}, "not 30 to 5"),
        ("wedges", {"coarsest": 2}, "not 2 to"),
        ("crosshatch", {"count": 0}, "not 0"),
        ("safe-areas", {"standard": "EBU"}, "not 'EBU'"),
        ("colorchecker", {"chart": "Kodak"}, "not 'Kodak'"),
    ],
)
def test_a_mistake_is_told_in_one_sentence(name, options, words):
    with pytest.raises(UsageError) as caught:
        small(name, **options) if name in patterns.PATTERNS else patterns.draw(name, **options)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("arguments", [(8, 100), (100, 20_000), (100, 100, 0), (100, 100, 17)])
def test_a_screen_that_cannot_be_is_refused(arguments):
    with pytest.raises(UsageError):
        Screen(*arguments)


def test_a_colour_is_one_number_or_three():
    assert rgb(np.array([0.1, 0.2, 0.3])) == (0.1, 0.2, 0.3)
    assert rgb(1) == (1.0, 1.0, 1.0)
