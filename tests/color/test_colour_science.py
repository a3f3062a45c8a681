"""Agreement with colour-science on the same inputs."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from illuminant import color

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

WHITE = (0.3127, 0.3290)


@pytest.fixture(autouse=True)
def quiet():
    """colour-science warns of packages that it does without, and of its own future."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@pytest.fixture(scope="module")
def xyz() -> np.ndarray:
    """Colours from nearly black to above the white, on both sides of every knee."""
    random = np.random.default_rng(7)
    colours = random.random((64, 32, 3)) * 10.0 ** random.uniform(-4, 0.3, (64, 32, 1))
    return np.concatenate([colours, np.zeros((1, 32, 3))])


def same(found: np.ndarray, wanted: np.ndarray, scale: float = 1.0) -> None:
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-9 * scale)


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        ("sRGB", "sRGB"),
        ("Rec.709", "ITU-R BT.709"),
        ("Rec.2020", "ITU-R BT.2020"),
        ("Display P3", "Display P3"),
        ("Adobe RGB", "Adobe RGB (1998)"),
        ("ACES AP0", "ACES2065-1"),
        ("ACES AP1", "ACEScg"),
        ("NTSC 1953", "NTSC (1953)"),
        ("SMPTE-C", "SMPTE C"),
    ],
)
def test_matrices_derived_from_primaries_and_white(ours, theirs):
    system, peer = color.system(ours), colour.RGB_COLOURSPACES[theirs].copy()
    peer.use_derived_transformation_matrices(True)
    np.testing.assert_array_equal(np.asarray(system.primaries), peer.primaries)
    np.testing.assert_allclose(system.white, peer.whitepoint, atol=1e-12)
    same(np.asarray(system.to_xyz), peer.matrix_RGB_to_XYZ)
    same(np.asarray(system.from_xyz), peer.matrix_XYZ_to_RGB)


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [("Adobe RGB", "Adobe RGB (1998)"), ("ACES AP0", "ACES2065-1"), ("ACES AP1", "ACEScg")],
)
def test_printed_matrices(ours, theirs):
    peer = colour.RGB_COLOURSPACES[theirs]
    np.testing.assert_allclose(color.published_matrix(f"{ours} to XYZ"), peer.matrix_RGB_to_XYZ, atol=1e-10)
    np.testing.assert_allclose(color.published_matrix(f"XYZ to {ours}"), peer.matrix_XYZ_to_RGB, atol=1e-10)


def test_printed_matrices_of_srgb():
    peer = colour.RGB_COLOURSPACES["sRGB"]
    np.testing.assert_array_equal(color.published_matrix("sRGB to XYZ"), peer.matrix_RGB_to_XYZ)
    np.testing.assert_array_equal(color.published_matrix("XYZ to sRGB"), peer.matrix_XYZ_to_RGB)


def test_lab_luv_and_back(xyz):
    lab, luv = color.xyz_to_lab(xyz, WHITE), color.xyz_to_luv(xyz, WHITE)
    same(lab, colour.XYZ_to_Lab(xyz, WHITE), 100)
    same(luv, colour.XYZ_to_Luv(xyz, WHITE), 100)
    same(color.lab_to_xyz(lab, WHITE), colour.Lab_to_XYZ(lab, WHITE))
    lit = luv[:-1]  # at L* = 0 their answer is NaN
    same(color.luv_to_xyz(lit, WHITE), colour.Luv_to_XYZ(lit, WHITE))


def test_chromaticities(xyz):
    lit = xyz[:-1]
    same(color.xyz_to_xyy(lit), colour.XYZ_to_xyY(lit))
    same(color.xyy_to_xyz(color.xyz_to_xyy(lit)), lit)
    white = color.white_xyz("E")
    same(
        color.xyz_to_uvy(lit)[..., :2],
        colour.Luv_to_uv(colour.XYZ_to_Luv(lit, (1 / 3, 1 / 3)), (1 / 3, 1 / 3)),
    )
    assert white == pytest.approx((1, 1, 1))


def test_transfer_functions():
    values = np.concatenate([np.linspace(0, 1, 2998), [0.0031308, 0.018]]).reshape(-1, 3)
    same(color.encode(values, "sRGB"), colour.cctf_encoding(values, "sRGB"))
    same(color.decode(values, "sRGB"), colour.cctf_decoding(values, "sRGB"))
    same(color.encode(values, "gamma 2.2"), colour.gamma_function(values, 1 / 2.2))
    # Theirs has the constants of BT.709 rounded to three digits.
    np.testing.assert_allclose(
        color.encode(values, "Rec.709"), colour.cctf_encoding(values, "ITU-R BT.709"), atol=4e-4
    )


@pytest.mark.parametrize("method", ["von Kries", "Bradford", "CAT16"])
@pytest.mark.parametrize(("one", "other"), [("D65", "D50"), ("A", "D65"), ("C", "E")])
def test_adaptation(method, one, other):
    whites = [np.asarray(color.white_xyz(name)) for name in (one, other)]
    wanted = colour.adaptation.matrix_chromatic_adaptation_VonKries(
        *whites, transform={"von Kries": "Von Kries"}.get(method, method)
    )
    same(color.adaptation_matrix(one, other, method=method), wanted)


def test_rgb_to_rgb(xyz):
    peers = [colour.RGB_COLOURSPACES[name].copy() for name in ("ITU-R BT.2020", "ACEScg")]
    for peer in peers:
        peer.use_derived_transformation_matrices(True)
    same(
        color.rgb_to_rgb(xyz, "Rec.2020", "ACES AP1"),
        colour.RGB_to_RGB(xyz, *peers, chromatic_adaptation_transform=None),
    )
    same(
        color.rgb_to_rgb(xyz, "Rec.2020", "ACES AP1", adaptation="Bradford"),
        colour.RGB_to_RGB(xyz, *peers, chromatic_adaptation_transform="Bradford"),
    )


def test_whites_of_the_standards():
    table = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
    # D60 is that of ACES, which is not the phase of daylight of that temperature.
    wanted = {name: table[name] for name in ("A", "C", "D50", "D55", "D65", "D75", "E")} | {
        "D60": colour.RGB_COLOURSPACES["ACEScg"].whitepoint
    }
    for name, xy in wanted.items():
        x, y, z = color.white_xyz(name)
        np.testing.assert_allclose([x / (x + y + z), y / (x + y + z)], xy, atol=6e-6, err_msg=name)
    x, y, z = color.white_xyz("FL11")
    np.testing.assert_allclose([x / (x + y + z), y / (x + y + z)], table["FL11"], atol=5e-4)


# --- differences ---------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def labs() -> list[np.ndarray]:
    random = np.random.default_rng(3)
    first = random.uniform([0, -100, -100], [100, 100, 100], (4000, 3))
    return [first, first + random.normal(0, 10, first.shape)]


def test_differences(labs):
    same(color.delta_e_1976(*labs), colour.delta_E(*labs, method="CIE 1976"))
    same(color.delta_e_2000(*labs), colour.delta_E(*labs, method="CIE 2000"))
    same(color.delta_e_1994(*labs), colour.delta_E(*labs, method="CIE 1994"))
    textiles = colour.delta_E(*labs, method="CIE 1994", textiles=True)
    same(color.delta_e_1994(*labs, constants="textiles"), textiles)


def test_ciede2000_of_all_published_pairs(repository: Path):
    table = np.loadtxt(
        repository / "tests" / "golden" / "sharma_2005.csv", delimiter=",", comments=["#", "L1"]
    )
    assert table.shape == (34, 7)
    first, second, wanted = table[:, :3], table[:, 3:6], table[:, 6]
    assert np.abs(color.delta_e_2000(first, second) - wanted).max() < 5.001e-5
    assert np.abs(color.delta_e_2000(second, first) - wanted).max() < 5.001e-5


# --- solids, axes --------------------------------------------------------------------------------------------


def test_hsv_and_hsl():
    rgb = np.random.default_rng(5).random((1000, 3))
    turn = np.array([360.0, 1.0, 1.0])
    same(color.rgb_to_hsv(rgb), colour.RGB_to_HSV(rgb) * turn)
    same(color.rgb_to_hsl(rgb), colour.RGB_to_HSL(rgb) * turn)


# --- spectra -------------------------------------------------------------------------------------------------


def cmfs() -> "colour.MultiSpectralDistributions":
    return colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]


def test_spectra_at_one_nanometre():
    grid = np.arange(380, 781.0)
    spectra = np.random.default_rng(11).random((7, 5, 401))
    shape = colour.SpectralShape(380, 780, 1)
    lamp = colour.SDS_ILLUMINANTS["A"].copy().align(shape)
    wanted = colour.msds_to_XYZ(spectra, cmfs(), lamp, method="Integration", shape=shape) / 100
    same(color.spectra_to_xyz(spectra, grid, illuminant=(grid, lamp.values)), wanted)


def test_bands_of_five_nanometres_without_interpolation():
    bands = np.arange(380, 781, 5.0)
    spectra = np.random.default_rng(12).random((4, 81))
    shape = colour.SpectralShape(380, 780, 5)
    lamp = colour.SDS_ILLUMINANTS["D65"].copy().align(shape)
    wanted = colour.msds_to_XYZ(spectra, cmfs(), lamp, method="Integration", shape=shape) / 100
    found = color.spectra_to_xyz(spectra, bands, illuminant=(bands, lamp.values), interpolation="none")
    same(found, wanted)


# --- Munsell -------------------------------------------------------------------------------------------------


def test_munsell_there_and_back():
    notations = ["5R 4/14", "N 5/", "2.5PB 6/4"]
    xyz = color.munsell_to_xyz(notations)
    same(xyz[0], colour.xyY_to_XYZ(colour.munsell_colour_to_xyY("5R 4/14")))
    assert xyz[1, 1] == pytest.approx(0.19272, abs=1e-4)
    white = np.asarray(color.white_xyz("C"))
    np.testing.assert_allclose(xyz[1] / xyz[1, 1], white, rtol=1e-9)
    assert [str(found) for found in color.xyz_to_munsell(xyz)] == notations
    assert color.xyz_to_munsell(xyz[1]).chroma == 0
