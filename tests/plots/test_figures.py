"""Figures: what is drawn is what was computed, nothing is covered, and the same figure gives the same bytes."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from illuminant import plots, spectra
from illuminant.errors import ImageError, UsageError
from illuminant.plots import labels, lobes
from illuminant.plots.diagram import diagram
from illuminant.plots.monochromatic import spectrum
from illuminant.plots.observer import for_primaries, named
from illuminant.plots.projection_space import ON_PAPER, on_plane
from illuminant.plots.spectral_curves import curve_points
from illuminant.plots.wavelength_axis import shown_range
from illuminant.spectra import Spectrum


def load(*names: str) -> list[Spectrum]:
    return [spectra.load(name) for name in names]


# --- curves --------------------------------------------------------------------------------------------------


def test_curves_are_drawn_through_the_samples_and_normalised() -> None:
    d65, fl11 = load("D65", "FL11")
    axes = plots.curves([d65, fl11], normalise_nm=560).axes[0]
    first, second = axes.lines
    np.testing.assert_array_equal(second.get_xdata(), fl11.wavelengths_nm)
    np.testing.assert_allclose(second.get_ydata(), np.array(fl11.values) / fl11.at(560), rtol=1e-14)
    assert np.interp(560, first.get_xdata(), first.get_ydata()) == pytest.approx(1.0)
    assert first.get_xdata()[0] == 380 and axes.get_xlim() == (380, 780)
    assert axes.get_xlabel() == "wavelength (nm)"
    assert axes.get_ylabel() == "relative to the value at 560 nm"


def test_nothing_is_drawn_where_nothing_was_measured() -> None:
    wavelengths, values = curve_points(spectra.load("Cornell/white"), (380, 780))
    assert (wavelengths[0], wavelengths[-1]) == (400, 700)
    assert len(wavelengths) == len(values) == 76


def test_labels_name_quantity_and_unit() -> None:
    radiance = Spectrum("lamp", [400, 700], [1, 2], "zero", "W sr-1 m-2 nm-1", quantity="emission")
    assert plots.curves([radiance]).axes[0].get_ylabel() == "power (W sr⁻¹ m⁻² nm⁻¹)"
    assert plots.curves(load("book/copper")).axes[0].get_ylabel() == "reflectance"
    assert plots.curves(load("gold.n")).axes[0].get_ylabel() == "index of refraction n"
    both = plots.curves(load("gold.n", "gold.k")).axes
    assert [axes.get_ylabel() for axes in both] == ["index of refraction n, extinction coefficient k"]


def test_a_second_quantity_has_its_own_axis_and_a_third_is_refused() -> None:
    figure = plots.curves(load("D65", "book/copper"))
    assert [axes.get_ylabel() for axes in figure.axes] == ["relative power", "reflectance"]
    assert figure.legends[0].get_texts()[1].get_text() == "book/copper (right)"
    with pytest.raises(UsageError, match="3 quantities"):
        plots.curves(load("D65", "book/copper", "gold.n"))
    plots.curves(load("D65", "book/copper", "gold.n"), normalise_nm=560)


def test_many_reflectances_bear_their_own_colours() -> None:
    lines = plots.curves(load(*spectra.names("reflectance")[:24])).axes[0].lines
    red = next(line for line in lines if line.get_label() == "ColorChecker/red").get_color()
    green = next(line for line in lines if line.get_label() == "ColorChecker/green").get_color()
    assert red[0] > 2 * max(red[1:]) and green[1] > max(green[0], green[2])


def test_32_curves_of_a_kind_look_different() -> None:
    lines = plots.curves(load(*spectra.names("emission")[:32])).axes[0].lines
    assert len({(line.get_color(), str(line._dash_pattern)) for line in lines}) == 32


def test_mistakes_in_curves_are_sentences() -> None:
    with pytest.raises(UsageError, match="at least one spectrum"):
        plots.curves([])
    with pytest.raises(UsageError, match="D65 is not known at 900 nm"):
        plots.curves(load("D65"), normalise_nm=900)
    dark = Spectrum("dark", [400, 700], [0, 1])
    with pytest.raises(UsageError, match="dark is 0 at 400 nm: expected a value above zero"):
        plots.curves([dark], normalise_nm=400)
    with pytest.raises(UsageError, match="nothing of that lies in the range 900-1000 nm"):
        plots.curves(load("D65"), range_nm=(900, 1000))
    with pytest.raises(UsageError, match="expected two increasing wavelengths"):
        shown_range([], (700, 400))


# --- matching functions and diagrams ------------------------------------------------------------------------


def test_matching_functions_are_drawn_with_their_negative_lobes() -> None:
    """Book figure 3.5."""
    axes = plots.matching_functions(primaries_nm=(445, 535, 630)).axes[0]
    functions = for_primaries(named(), (445, 535, 630))
    for line, column in zip(axes.lines[:3], range(3), strict=True):
        expected = functions.at(line.get_xdata())[:, column]
        np.testing.assert_array_equal(line.get_ydata(), expected)
    assert axes.get_ylim()[0] < -0.2
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    assert [(float(m.get_xdata()[0]), float(m.get_ydata()[0])) for m in marks] == [
        (445, 1),
        (535, 1),
        (630, 1),
    ]


def test_the_figures_of_the_book_are_there() -> None:
    """Figures 3.8 and 3.14: three curves each, the first without negative values."""
    xyz, ac1c2 = plots.matching_functions().axes[0], plots.matching_functions(space="ac1c2").axes[0]
    assert [line.get_label() for line in xyz.lines] == ["x̄", "ȳ", "z̄"] and xyz.get_ylim()[0] == 0
    assert [line.get_label() for line in ac1c2.lines[:3]] == ["A", "C1", "C2"] and ac1c2.get_ylim()[0] < -1


def test_the_strip_is_the_colour_of_each_wavelength() -> None:
    violet, blue, green, red, dark = spectrum(named(), np.array([420.0, 460.0, 530.0, 640.0, 830.0])).astype(
        int
    )
    assert violet[2] > violet[0] > violet[1] and blue[2] > 1.5 * max(blue[:2])
    assert green[1] > 150 and green[1] > 2 * max(green[0], green[2])
    assert red[0] > 150 and red[1] == red[2] == 0
    assert dark.max() <= 1


def test_the_projection_is_the_diagram_seen_along_one_axis() -> None:
    """Book figures 3.6 and 3.7: points of the plane L + M + H = 1, of which the diagram shows H and M."""
    plane = diagram("445,535,630")
    wavelengths, locus = plane.spectral_locus()
    flat = on_plane(for_primaries(named(), (445, 535, 630)).at(wavelengths))
    np.testing.assert_allclose(flat.sum(axis=1), 1.0, rtol=1e-12)
    np.testing.assert_allclose(flat[:, [2, 1]], locus, atol=1e-12)
    axes = plots.projection((445, 535, 630)).axes[0]
    curve = axes.collections[1].get_segments()
    drawn = np.array([piece[0] for piece in curve])
    np.testing.assert_allclose(drawn, flat[10:310] @ np.array(ON_PAPER), atol=1e-12)


@pytest.mark.parametrize("kind", ["xy", "uv", "445,535,630"])
def test_a_diagram_shows_its_points_where_they_are(kind: str) -> None:
    plane = diagram(kind)
    points = {name: plane.point(spectra.load(name)) for name in ("D65", "A", "FL11")}
    figure = plots.chromaticity(plane, points, gamuts=["sRGB", "Rec.2020"])
    axes = figure.axes[0]
    circles = [line for line in axes.lines if line.get_marker() == "o"]
    for circle, point in zip(circles, points.values(), strict=False):
        np.testing.assert_array_equal(circle.get_xydata()[0], point)
    low, high = np.array(axes.get_xlim()), np.array(axes.get_ylim())
    assert all(low[0] < x < low[1] and high[0] < y < high[1] for x, y in points.values())
    names = {text.get_text() for text in axes.texts}
    assert names >= {"D65", "A", "FL11", "500"}
    assert ("6,500 K" in names) == (kind in ("xy", "uv"))
    assert {"445 nm", "535 nm", "630 nm"} <= names or kind != "445,535,630"
    labels_of_lines = [line.get_label() for line in axes.lines]
    assert "sRGB" in labels_of_lines and "Rec.2020" in labels_of_lines


def test_the_planckian_locus_and_the_ground_can_be_left_out() -> None:
    axes = plots.chromaticity("xy", plain=True, planckian=False).axes[0]
    assert not axes.images
    assert "blackbodies" not in [line.get_label() for line in axes.lines]
    assert plots.chromaticity("xy").axes[0].images


def test_a_zoomed_diagram_shows_its_points_and_little_else() -> None:
    plane = diagram("uv")
    points = {name: plane.point(spectra.load(name)) for name in ("FL1", "FL2", "FL3", "D50")}
    axes = plots.chromaticity(plane, points, zoom=True).axes[0]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    assert all(left < x < right and bottom < y < top for x, y in points.values())
    assert right - left == pytest.approx(top - bottom) and right - left < 0.15
    x0, x1, y0, y1 = axes.images[0].get_extent()
    assert left <= x0 < x1 <= right and bottom <= y0 < y1 <= top, "the ground is computed where it is shown"
    with pytest.raises(UsageError, match="zoomed to points only"):
        plots.chromaticity("xy", zoom=True)


def test_many_points_are_numbered() -> None:
    plane, light = diagram("uv"), spectra.load("D65")
    points = {name: plane.point(spectra.load(name), light) for name in spectra.names("reflectance")[:24]}
    figure = plots.chromaticity(plane, points)
    assert "24  ColorChecker/black 2" in [text.get_text() for text in figure.legends[0].get_texts()]
    assert "24" in [text.get_text() for text in figure.axes[0].texts]


def test_no_legend_covers_a_curve() -> None:
    figure = plots.curves(load("D65", "FL11", "A"), normalise_nm=560)
    figure.draw_without_rendering()
    assert not figure.legends[0].get_window_extent().overlaps(figure.axes[0].get_window_extent())
    plane = diagram("xy")
    figure = plots.chromaticity(plane, gamuts=["sRGB"])
    figure.draw_without_rendering()
    box = figure.axes[0].get_legend().get_window_extent()
    points = figure.axes[0].transData.transform(plane.spectral_locus()[1])
    assert not any(box.contains(*point) for point in points)


def test_names_cover_neither_each_other_nor_points() -> None:
    points = [(0.0, 0.0), (6.0, 0.0), (0.0, 6.0), (6.0, 6.0), (100.0, 3.0)]
    names = ["D65", "D50", "A", "FL11", "far"]
    centres = labels.place(points, names)
    boxes = []
    for (x, y), name in zip(centres, names, strict=True):
        width, height = labels.extent(name, 8.0)
        boxes.append((x - width / 2, y - height / 2, x + width / 2, y + height / 2))
    for number, box in enumerate(boxes):
        assert labels.free(box, boxes[:number]), names[number]
        assert labels.free(box, labels.around(points, 3.0)), names[number]
    assert abs(centres[-1][0] - 100.0) < 20, "a name alone stands beside its point"


# --- files ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ending", ["svg", "png"])
def test_the_same_figure_gives_the_same_bytes(tmp_path: Path, ending: str) -> None:
    for name in ("a", "b"):
        plots.save(plots.chromaticity("xy", gamuts=["sRGB"], size=(3, 3)), tmp_path / f"{name}.{ending}")
    content = (tmp_path / f"a.{ending}").read_bytes()
    assert content == (tmp_path / f"b.{ending}").read_bytes()
    assert b"<dc:date>" not in content and b"Software" not in content
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"a.{ending}", f"b.{ending}"]


def test_a_png_has_the_size_of_its_figure(tmp_path: Path) -> None:
    plots.save(plots.curves(load("D65"), size=(4.0, 2.5)), tmp_path / "a.PNG")
    header = (tmp_path / "a.PNG").read_bytes()[16:24]
    assert (int.from_bytes(header[:4]), int.from_bytes(header[4:])) == (800, 500)


def test_other_endings_and_folders_that_are_not_there_are_refused(tmp_path: Path) -> None:
    figure = plots.curves(load("E"))
    with pytest.raises(UsageError, match=r"a.pdf: expected a file that ends in .png or .svg"):
        plots.save(figure, tmp_path / "a.pdf")
    with pytest.raises(ImageError, match="there is no folder"):
        plots.save(figure, tmp_path / "none" / "a.png")


def test_settings_of_the_user_change_nothing_and_no_window_is_made_ready(tmp_path: Path) -> None:
    """A matplotlibrc with other sizes gives the same file, and pyplot is never imported."""
    (tmp_path / "matplotlibrc").write_text("lines.linewidth: 9\nfont.size: 20\nsvg.fonttype: none\n")
    program = (
        "import sys, illuminant.plots as p, illuminant.spectra as s;"
        "assert 'matplotlib' not in sys.modules;"
        "p.save(p.curves([s.load('D65')]), 'a.svg');"
        "assert 'matplotlib.pyplot' not in sys.modules and 'scipy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)
    plots.save(plots.curves(load("D65")), tmp_path / "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


# --- lobes ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", list(lobes.NAMES))
@pytest.mark.parametrize("beta", [5.0, 10.0, 30.0])
def test_every_distribution_is_half_at_beta(name: str, beta: float) -> None:
    views = np.array([20.0 - 2 * beta, 20.0, 20.0 + 2 * beta])
    np.testing.assert_allclose(lobes.distribution(name, beta, 20.0, views), [0.5, 1.0, 0.5], rtol=1e-9)


def test_blinn_and_beckmann_are_alike_where_surfaces_are_not_too_rough() -> None:
    view = np.linspace(-30.0, 90.0, 241)
    blinn, beckmann = (lobes.distribution(name, 10.0, 30.0, view) for name in ("blinn", "cook"))
    assert np.abs(blinn - beckmann).max() < 0.02


def test_the_curves_of_coefficients_are_those_of_optics() -> None:
    left, right = plots.coefficients().axes
    phong, blinn = left.lines
    beta = np.radians(np.asarray(phong.get_xdata(), float))
    np.testing.assert_allclose(phong.get_ydata(), -np.log(2) / np.log(np.cos(2 * beta)), rtol=1e-9)
    beta = np.radians(np.asarray(blinn.get_xdata(), float))
    np.testing.assert_allclose(blinn.get_ydata(), -np.log(2) / np.log(np.cos(beta)), rtol=1e-9)
    assert [line.get_label() for line in right.lines] == ["$C_1$", "$C_2$", "$m$"]


def test_a_polar_plot_has_a_row_for_each_width() -> None:
    figure = plots.distributions()
    assert [axes.get_title(loc="left") for axes in figure.axes][::3] == [
        "β = 10°, θ = 30°",
        "β = 30°, θ = 30°",
    ]
    with pytest.raises(UsageError, match="below 45"):
        plots.distributions(beta_deg=(50.0,))
    with pytest.raises(UsageError, match="no distribution"):
        plots.distributions(names=("cosine",))
