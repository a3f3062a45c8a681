"""Operators of spectra: sums and products by wavelength, one Y by every route, and what cannot be combined."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from illuminant import spectra
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum

WHOLE = np.arange(200.0, 1200.0)


@st.composite
def curves(draw, quantity=""):
    steps = draw(st.lists(st.floats(0.5, 80.0), min_size=2, max_size=12))
    start = draw(st.floats(250.0, 600.0))
    wavelengths = np.cumsum([start, *steps[1:]])
    values = draw(st.lists(st.floats(0.0, 1.0), min_size=len(steps), max_size=len(steps)))
    outside = draw(st.sampled_from(["zero", "hold"]))
    return Spectrum("curve", wavelengths, values, outside, quantity=quantity)


@settings(max_examples=60)
@given(a=curves(), b=curves())
def test_sum_and_product_by_wavelength(a, b):
    np.testing.assert_allclose((a + b).at(WHOLE), a.at(WHOLE) + b.at(WHOLE), atol=1e-9)
    try:
        product = (a * b).at(WHOLE)
    except DataError as error:
        assert "do not overlap" in error.message
        product = np.zeros_like(WHOLE)
    np.testing.assert_allclose(product, a.at(WHOLE) * b.at(WHOLE), atol=1e-9)


@settings(max_examples=40)
@given(a=curves(), factor=st.floats(0.0, 1e3))
def test_scale(a, factor):
    assert (factor * a).values == (a * factor).values == tuple(factor * v for v in a.values)
    assert (np.float64(factor) * a).values == (a * factor).values
    assert (a / 2).values == (0.5 * a).values


@pytest.mark.parametrize("name", ["D65", "A", "FL11", "LED-RGB1", "HP1", "Cornell/light"])
@pytest.mark.parametrize("observer", ["CIE 1931 2°", "CIE 1964 10°", "book"])
def test_the_same_lamp_gives_the_same_y_by_every_route(name, observer, tmp_path):
    lamp = spectra.load(name)
    direct = lamp.xyz(observer=observer)
    grid = np.arange(380, 781)
    spectra.write(tmp_path / "lamp.spd", lamp)
    routes = {
        "twice the half": 2 * (lamp / 2),
        "sum of parts": 0.25 * lamp + 0.75 * lamp,
        "times a white": lamp * Spectrum("white", (300, 900), (1, 1), "hold"),
        "at 1 nm": lamp.resampled(grid),
        "its visible part": lamp.between(380, 780),
        "normalised and back": lamp.normalised(560) * float(lamp.at(560)),
        "file": spectra.read(tmp_path / "lamp.spd"),
        "plus nothing": lamp + 0 * lamp,
    }
    for route, spectrum in routes.items():
        np.testing.assert_allclose(spectrum.xyz(observer=observer), direct, rtol=1e-12, err_msg=route)
    # A surface under it: XYZ of the product, and of the pair.
    paint = spectra.load("ColorChecker/red")
    white = lamp.xyz(observer=observer)[1]
    np.testing.assert_allclose(
        (lamp * paint).xyz(observer=observer) / white, paint.xyz(lamp, observer), rtol=1e-12
    )


def test_a_white_mirror_has_y_1():
    white = Spectrum("white", (380, 780), (1, 1), quantity="reflectance")
    for name in spectra.names("emission"):
        assert white.xyz(spectra.load(name))[1] == pytest.approx(1.0, abs=1e-12)


def test_area_of_the_book():
    assert Spectrum("one", (380, 780), (1, 1)).area() == 401
    assert Spectrum("one", (380, 780), (1, 1)).area((400, 700)) == 301
    assert Spectrum("one", (380, 780), (1, 1), "zero").area((300, 500)) == 121
    with pytest.raises(UsageError, match="no two whole nm"):
        Spectrum("thin", (500.2, 500.8), (1, 1)).area()
    with pytest.raises(UsageError, match="from one whole nm to a larger one"):
        Spectrum("one", (380, 780), (1, 1)).area((700, 400))


def test_quantity_and_unit_follow():
    d65, red, green = (spectra.load(n) for n in ("D65", "ColorChecker/red", "ColorChecker/green"))
    assert ((d65 * red).quantity, (d65 * red).unit, (d65 * red).outside) == ("emission", "relative", "zero")
    assert ((red * green).quantity, (red * green).unit, (red * green).outside) == ("reflectance", "1", "hold")
    assert ((d65 + d65).quantity, (d65 + d65).name) == ("emission", "D65 + D65")
    assert (0.5 * red + 0.5 * green).quantity == "reflectance"
    assert red.normalised(560).quantity == ""
    power = Spectrum("power", (400, 700), (1, 1), "zero", "W m-2 nm-1", quantity="emission")
    assert ((power * red).unit, (d65 * power).unit, (d65 * power).quantity) == ("W m-2 nm-1", "relative", "")
    lower = spectra.load("gold.k") - spectra.load("silver.k")
    assert lower.quantity == "k"
    assert min(lower.values) < 0


def test_what_cannot_be_combined():
    d65, red = spectra.load("D65"), spectra.load("ColorChecker/red")
    with pytest.raises(UsageError, match="Spectra of one unit only can be added: 'D65' in 'relative'"):
        _ = d65 + red
    with pytest.raises(DataError, match="expected a reflectance from 0 to 1"):
        _ = 2 * red
    with pytest.raises(DataError, match="that is not negative"):
        _ = red - spectra.load("ColorChecker/white 9.5")
    with pytest.raises(DataError, match="do not overlap"):
        _ = d65 * Spectrum("far", (900, 1000), (1, 1), "zero")
    with pytest.raises(DataError, match="zero at 900 nm"):
        d65.normalised(900)
    with pytest.raises(UsageError, match="divided by zero"):
        _ = red / 0
    for wrong in (lambda: d65 + 1, lambda: d65 * "2", lambda: d65 / d65, lambda: True * d65):
        with pytest.raises(TypeError):
            wrong()


def test_a_reflectance_needs_a_lamp_and_the_lamp_light():
    red = spectra.load("ColorChecker/red")
    with pytest.raises(UsageError, match="under a lamp only"):
        red.xyz()
    with pytest.raises(DataError, match="gives no light from 380 to 780 nm"):
        red.xyz(Spectrum("heat", (900, 1000), (1, 1), "hold").between(900, 1000) * 0)


def test_unknown_outside_stays_unknown():
    part = Spectrum("part", (450, 600), (0.2, 0.4), "error")
    both = part * spectra.load("D65")
    assert (both.range_nm, both.outside) == ((450.0, 600.0), "error")
    assert (part + Spectrum("grey", (380, 780), (0.1, 0.1))).outside == "error"
    with pytest.raises(DataError, match="known from 450 to 600 nm only"):
        part.xyz()
    assert part.xyz(range_nm=(450, 600))[1] > 0
    assert part.area() == pytest.approx(0.3 * 151)
    assert part.normalised(500).outside == "error"
    with pytest.raises(DataError, match="known from 450 to 600 nm only"):
        part.normalised(700)


# --- between and beyond points ------------------------------------------------------------------------------


def test_interpolation_against_scipy_and_colour():
    interpolate = pytest.importorskip("scipy.interpolate")
    d65, fine = spectra.load("D65").between(380, 780), np.arange(380.0, 780.0, 0.7)
    w, v = np.array(d65.wavelengths_nm), np.array(d65.values)
    found = {kind: d65.resampled(fine, kind).values for kind in ("linear", "pchip", "cubic", "sprague")}
    np.testing.assert_allclose(found["linear"], np.interp(fine, w, v), rtol=1e-12)
    np.testing.assert_allclose(found["pchip"], interpolate.PchipInterpolator(w, v)(fine), rtol=1e-11)
    natural = interpolate.CubicSpline(w, v, bc_type="natural")
    np.testing.assert_allclose(found["cubic"], natural(fine), rtol=1e-11)
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    np.testing.assert_allclose(found["sprague"], colour.SpragueInterpolator(w, v)(fine), rtol=1e-9)


def test_a_smooth_curve_is_met_better_by_higher_orders():
    w = np.arange(380.0, 781.0, 10)
    paint = Spectrum("paint", w, 0.5 + 0.4 * np.sin(w / 40))
    fine = np.arange(400.0, 761.0)
    truth = 0.5 + 0.4 * np.sin(fine / 40)
    worst = [
        np.abs(np.array(paint.resampled(fine, kind).values) - truth).max()
        for kind in ("linear", "cubic", "sprague")
    ]
    assert worst[0] > 20 * worst[1] > 20 * worst[2]


def test_nothing_turns_negative_by_itself():
    line = Spectrum(
        "line", np.arange(500, 600, 10), [0, 0, 0, 0, 1, 0, 0, 0, 0, 0], "zero", quantity="emission"
    )
    fine = np.arange(500, 591)
    for kind in ("cubic", "sprague"):
        with pytest.raises(DataError, match=r"would become -0.*choose linear or pchip"):
            line.resampled(fine, kind)
    for kind in ("linear", "pchip"):
        assert min(line.resampled(fine, kind).values) == 0.0
    falling = Spectrum("falling", (400, 500), (1.0, 0.5))
    assert falling.resampled((500, 600), extrapolation="linear").values == (0.5, 0.0)
    with pytest.raises(DataError, match="at 610 nm"):
        falling.resampled((500, 610), extrapolation="linear")


def test_beyond_the_points_it_is_as_asked():
    lamp = Spectrum("lamp", (400, 500), (1.0, 3.0), "zero")
    assert lamp.resampled((300, 450, 600)).values == (0.0, 2.0, 0.0)
    assert lamp.resampled((300, 450, 600), extrapolation="hold").values == (1.0, 2.0, 3.0)
    assert lamp.resampled((380, 600), extrapolation="linear").values == pytest.approx((0.6, 5.0))
    with pytest.raises(DataError, match="300 nm lies outside 400 to 500 nm"):
        lamp.resampled((300, 450), extrapolation="error")
    with pytest.raises(DataError, match="six points at equal steps"):
        lamp.resampled((410, 450), "sprague")
    with pytest.raises(UsageError, match="There is no 'spline': expected 'linear', 'pchip'"):
        lamp.resampled((410, 450), "spline")
    with pytest.raises(DataError, match="wavelengths must increase"):
        lamp.resampled((450, 410))


# --- beyond the eye -----------------------------------------------------------------------------------------


def test_infrared_and_ultraviolet_are_carried():
    gold = spectra.load("gold.n")
    assert (gold + gold).range_nm == gold.range_nm == (187.9, 1937.0)
    a = spectra.load("A") * Spectrum("filter", (300, 400), (1.0, 1.0), "zero")
    assert a.range_nm == (300.0, 400.0)
    assert a.area((300, 360)) == pytest.approx(spectra.load("A").area((300, 360)))


def test_an_infrared_picture_in_pseudo_color():
    leaf = Spectrum("leaf", (700, 760, 1100), (0.05, 0.45, 0.5), quantity="reflectance")
    stone = Spectrum("stone", (700, 1100), (0.2, 0.3), quantity="reflectance")
    sun = Spectrum("sun", (300, 2500), (1.0, 0.2), "zero", quantity="emission")
    seen = {s.name: s.pseudo_color((780, 1100)) for s in (leaf, stone, sun)}
    grid = np.arange(380.0, 781.0)
    for spectrum in (leaf, stone, sun):
        np.testing.assert_allclose(
            seen[spectrum.name].at(grid), spectrum.at(780 + (grid - 380) * 320 / 400), atol=1e-12
        )
    # What is bright in the band is bright in the picture, and lamp and surface go together.
    lit = [seen[name].xyz(seen["sun"])[1] for name in ("leaf", "stone")]
    assert lit[0] > 1.5 * lit[1]
    product = (leaf * sun).pseudo_color((780, 1100))
    np.testing.assert_allclose(product.at(grid), (seen["leaf"] * seen["sun"]).at(grid), rtol=2e-4)
    ultraviolet = spectra.load("gold.n").pseudo_color((200, 400), (380, 780))
    assert float(ultraviolet.at(580)) == pytest.approx(float(spectra.load("gold.n").at(300)))
    with pytest.raises(DataError, match="a band runs from one positive wavelength to a larger one"):
        leaf.pseudo_color((1100, 780))


# --- RGB ----------------------------------------------------------------------------------------------------


def test_rgb_by_its_role():
    albedo = spectra.rgb_albedo((0.2, 0.6, 0.3))
    assert (albedo.spectrum.quantity, albedo.spectrum.outside) == ("reflectance", "hold")
    assert albedo.delta_e < 0.1
    light = spectra.rgb_emission((20, 5, 1), "Rec.2020")
    assert (light.spectrum.quantity, light.spectrum.unit) == ("emission", "relative")
    assert spectra.rgb_raw((0.1, -2, 7)) == (0.1, -2.0, 7.0)
    for wrong in (lambda: spectra.rgb_albedo((1.2, 0, 0)), lambda: spectra.rgb_emission((-1, 0, 0))):
        with pytest.raises(DataError, match="RGB of the role"):
            wrong()
    for wrong in ((1, 2), (1, 2, float("nan")), "red"):
        with pytest.raises(DataError):
            spectra.rgb_raw(wrong)
    with pytest.raises(UsageError, match="There is no RGB system 'PAL'"):
        spectra.rgb_albedo((0.1, 0.1, 0.1), "PAL")


def test_the_error_of_the_round_trip_is_reported():
    from illuminant.core import core

    system, rgb = "Rec.2020", (0.0, 1.0, 0.0)
    made = spectra.rgb_albedo(rgb, system)
    assert made.delta_e > 5, "no reflectance is as green as that"
    # The same number from outside: the curve's colour under the white of the system.
    white = spectra.rgb_emission((1, 1, 1), system).spectrum
    wanted = np.array(core().rgb_system(system)["to_xyz"]) @ rgb
    d65 = white.xyz()
    labs = [core().xyz_to_lab(xyz, d65) for xyz in (wanted, made.spectrum.xyz(white) * d65[1])]
    assert float(core().delta_e_2000(*labs)) == pytest.approx(made.delta_e, rel=1e-3)
    assert spectra.rgb_albedo((0.8, 0.1, 0.1)).delta_e < 0.1
