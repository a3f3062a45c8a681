"""What a wrong gamma, two ways of storage and another monitor do to a picture, and the figures of it (book 5.1.2)."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from illuminant import color
from illuminant.display.displays import named
from illuminant.display.gamma.banding import banding, compared, gradation, shaded_sphere
from illuminant.display.gamma.brightness import brightness, equal_steps, lightness, resemblance
from illuminant.display.gamma.drift import shown, study
from illuminant.display.gamma.fitting import fit_gamma
from illuminant.display.gamma.levels import lost_levels
from illuminant.display.gamma.lookup_table import (
    correction_table,
)
from illuminant.display.gamma.readings import Measured
from illuminant.display.gamma.remapping import degradation, remap
from illuminant.display.gamma.storage import (
    at_display,
    before_storage,
    light,
    show_through_table,
    store_corrected,
    store_linear,
)
from illuminant.errors import UsageError
from illuminant.plots import gamma_curves
from illuminant.plots.banding_sheet import sheet, staircase, tile
from illuminant.plots.gamma_drift import drift as drawn_drift

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
    codes = np.linspace(15.0, 255.0, 17)
    read = 100.0 * (codes / 255.0) ** 2.2
    drawn = gamma_curves.fitted({"grey": Measured(codes, read)}, {"grey": fit_gamma(codes, read)})
    assert drawn.axes[0].get_xscale() == "log"
    assert "γ 2.2" in drawn.axes[0].get_legend().get_texts()[0].get_text()
    assert gamma_curves.perceived(0.02).axes[1].get_xlabel() == "code value, or perceived brightness"
    with pytest.raises(UsageError, match="8 bits"):
        sheet((10,), size=60)
    with pytest.raises(UsageError, match="at least one"):
        sheet(())
    assert at_display([1.0], 8).tolist() == [1.0]
