"""Chromaticity diagrams as numbers: loci, gamuts, points."""

import numpy as np
import pytest

from illuminant import rgb_system, spectra
from illuminant.errors import UsageError
from illuminant.plots.diagram import diagram
from illuminant.plots.monochromatic import brightest
from illuminant.spectra import Spectrum

KINDS = ["xy", "uv", "445,535,630"]


def inside(point: np.ndarray, triangle: np.ndarray) -> bool:
    """Whether a point lies within a triangle: on the same side of its three edges."""
    a, b, c = triangle

    def side(p: np.ndarray, q: np.ndarray) -> float:
        return float((q - p)[0] * (point - p)[1] - (q - p)[1] * (point - p)[0])

    signs = np.sign([side(a, b), side(b, c), side(c, a)])
    return bool(abs(signs.sum()) == 3)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("system", ["sRGB", "Rec.2020", "Display P3", "Adobe RGB"])
def test_the_white_of_a_gamut_lies_within_its_triangle(kind: str, system: str) -> None:
    name, corners, white = diagram(kind).gamut(system.casefold())
    assert name == system
    assert inside(white, corners)


@pytest.mark.parametrize("system", ["sRGB", "Rec.2020"])
def test_the_corners_of_a_gamut_in_xy_are_the_primaries(system: str) -> None:
    _, corners, white = diagram("xy").gamut(system)
    np.testing.assert_allclose(corners, rgb_system.named(system)["primaries"], atol=1e-12)
    np.testing.assert_allclose(white, rgb_system.named(system)["white"], atol=1e-12)


def test_uv_is_that_of_1976() -> None:
    """Book eq 3.5: u' = 4X / (X + 15Y + 3Z), v' = 9Y / (X + 15Y + 3Z); D65 is 0.1978, 0.4683 (CIE 15)."""
    x, y, z = 0.3, 0.5, 0.7
    divisor = x + 15 * y + 3 * z
    np.testing.assert_allclose(
        diagram("uv").project([x, y, z]), [4 * x / divisor, 9 * y / divisor], rtol=1e-14
    )
    np.testing.assert_allclose(diagram("uv").point(spectra.load("D65")), [0.1978, 0.4683], atol=5e-5)


def test_lamps_lie_where_the_cie_says() -> None:
    """CIE 15:2004, table T.3 and table T.8.1 (four digits)."""
    known = {"A": (0.4476, 0.4074), "C": (0.3101, 0.3162), "D50": (0.3457, 0.3585), "D65": (0.3127, 0.3290),
             "FL2": (0.3721, 0.3751), "FL7": (0.3129, 0.3292), "FL11": (0.3805, 0.3769)}  # fmt: skip
    for name, xy in known.items():
        np.testing.assert_allclose(diagram("xy").point(spectra.load(name)), xy, atol=3e-4, err_msg=name)


def test_a_grey_lies_where_its_light_does() -> None:
    grey = Spectrum("grey", [300, 900], [0.3, 0.3], quantity="reflectance")
    for kind in KINDS:
        plane = diagram(kind)
        for lamp in map(spectra.load, ("D65", "FL11")):
            np.testing.assert_allclose(plane.point(grey, lamp), plane.point(lamp), atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_all_lamps_and_all_reflectances_lie_within_the_spectral_locus(kind: str) -> None:
    from matplotlib.path import Path

    plane = diagram(kind)
    border = Path(plane.spectral_locus()[1])
    light = spectra.load("D65")
    points = [plane.point(spectra.load(name)) for name in spectra.names("emission")]
    points += [plane.point(spectra.load(name), light) for name in spectra.names("reflectance")]
    assert len(points) > 80
    assert border.contains_points(points).all()


def test_the_primaries_are_the_corners_of_their_diagram() -> None:
    """Book figure 3.7: L at the origin, M up, H to the right; the locus leaves the triangle between them."""
    plane = diagram((630, 445, 535))
    np.testing.assert_allclose(
        plane.project(plane.observer.at([445, 535, 630])), [[0, 0], [0, 1], [1, 0]], atol=1e-12
    )
    wavelengths, locus = plane.spectral_locus()
    assert np.all(locus[(wavelengths > 450) & (wavelengths < 530), 0] < 0)
    assert plane.axes == ("H = share of 630 nm", "M = share of 535 nm")


@pytest.mark.parametrize("kind", KINDS)
def test_a_point_gives_back_its_colour_up_to_a_factor(kind: str) -> None:
    plane = diagram(kind)
    xyz = np.array([[0.2, 0.3, 0.4], [0.5, 0.1, 0.05]])
    back = plane.colour(plane.project(xyz))
    np.testing.assert_allclose(back / back[:, 1:2], xyz / xyz[:, 1:2], rtol=1e-11)


def test_black_has_no_point() -> None:
    assert np.isnan(diagram("xy").project([0.0, 0.0, 0.0])).all()


def test_blackbodies_pass_illuminant_a_and_end_at_the_blue_of_the_sky() -> None:
    """A is Planck's curve at 2855.5 K (CIE 15: 2848 K, c2 = 0.01435 m K); the bluest one is 0.2399, 0.2341."""
    plane = diagram("xy")
    points = plane.planckian_locus([2855.5, 1e9])
    np.testing.assert_allclose(points[0], plane.point(spectra.load("A")), atol=2e-5)
    np.testing.assert_allclose(points[1], [0.2399, 0.2341], atol=2e-4)


@pytest.mark.parametrize("kind", ["zz", "445,535", "445,535,x", "1,2,3", ""])
def test_no_such_diagram(kind: str) -> None:
    with pytest.raises(UsageError, match="expected"):
        diagram(kind)


def test_what_has_no_colour_has_no_point() -> None:
    plane = diagram("xy")
    with pytest.raises(UsageError, match=r"gold.n holds n: expected an emission or a reflectance"):
        plane.point(spectra.load("gold.n"))
    with pytest.raises(UsageError, match=r"does not say what it holds"):
        plane.point(Spectrum("mine", [400, 700], [1, 1]))
    with pytest.raises(UsageError, match=r"infrared has no light from 360 to 830 nm"):
        plane.point(Spectrum("infrared", [900, 1000], [1, 1], "zero", quantity="emission"))


def test_the_ground_is_the_srgb_of_its_chromaticity() -> None:
    """Within the gamut the encoded colour has the chromaticity again, to the 8 bits of the file."""
    plane = diagram("xy")
    points = np.array([[0.3127, 0.3290], [0.35, 0.40], [0.25, 0.25], [0.45, 0.35]])
    code = brightest(plane.colour(points)[np.newaxis])[0].astype(float) / 255
    linear = rgb_system.linear(code, "sRGB")
    assert np.all(code.max(axis=1) == 1)
    to_xyz = np.array(rgb_system.named("sRGB")["to_xyz"])
    np.testing.assert_allclose(plane.project(linear @ to_xyz.T), points, atol=3e-3)


def test_outside_the_gamut_the_ground_is_clipped() -> None:
    code = brightest(diagram("xy").colour([[[0.08, 0.83]]]))
    assert code.tolist() == [[[0, 255, 0]]]
