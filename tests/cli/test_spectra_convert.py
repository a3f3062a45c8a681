"""`illuminant spectra convert`: what is written is what was asked for, and what was done is said."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant import spectra
from illuminant.cli.spectra.convert import regridded
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def converted(folder: Path, inside: Command, *arguments: str) -> tuple[Spectrum, str]:
    """The spectrum in the file that a conversion wrote, and what was said."""
    done = inside("spectra", "convert", *arguments, cwd=folder)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    (target,) = [word for word in arguments if word.startswith("out.")]
    return spectra.read(folder / target), done.stderr


# --- numbers -------------------------------------------------------------------------------------------------


def test_a_range_alone_keeps_the_samples_and_adds_the_ends() -> None:
    ramp = Spectrum("ramp", [400, 500, 600], [0, 1, 3])
    curve, done = regridded(ramp, (450, 560), None)
    assert curve.wavelengths_nm == (450, 500, 560)
    np.testing.assert_allclose(curve.values, [0.5, 1, 2.2])
    assert done == ["cut from 400-600 nm, 100 nm"]


def test_a_step_alone_takes_its_multiples_within_the_curve() -> None:
    gold = spectra.load("gold.n")
    curve, done = regridded(gold, None, 10)
    assert curve.range_nm == (190, 1930) and len(curve.values) == 175
    np.testing.assert_allclose(curve.values, gold.at(curve.wavelengths_nm))
    assert done[0] == "resampled to 10 nm from 187.9-1937 nm, 49 points"


def test_a_step_that_misses_what_lies_between_says_so() -> None:
    assert (
        regridded(spectra.load("FL11"), None, 10)[1][1]
        == "wider apart than before, so what lies between is lost"
    )
    assert len(regridded(spectra.load("FL11"), None, 5)[1]) == 1


def test_a_step_that_does_not_reach_the_end_says_so() -> None:
    curve, done = regridded(spectra.load("D65"), (400, 500), 30)
    assert curve.wavelengths_nm == (400, 430, 460, 490)
    assert done[-1] == "the last wavelength is 490 nm, as the step does not reach 500 nm"


def test_beyond_the_curve_its_own_rule_holds_and_is_said() -> None:
    lamp, done = regridded(spectra.load("FL11"), (370, 790), 10)
    assert lamp.values[0] == lamp.values[-1] == 0 and done[-1] == "beyond 380-780 nm zero"
    paint, done = regridded(spectra.load("ColorChecker/red"), (380, 780), 5)
    assert paint.values[-1] == paint.at(730) and done[-1] == "beyond 380-730 nm the value of the nearer end"
    with pytest.raises(DataError, match="400 to 500 nm"):
        regridded(Spectrum("strict", [400, 500], [1, 1], "error"), (390, 500), None)


def test_a_grid_of_one_wavelength_is_refused() -> None:
    with pytest.raises(UsageError, match="--step 900 leaves 0 wavelengths from 300 to 780 nm"):
        regridded(spectra.load("D65"), None, 900)


# --- the command ---------------------------------------------------------------------------------------------


def test_a_name_of_the_library_is_written_as_it_is(tmp_path: Path, inside: Command) -> None:
    for name in ("FL11", "ColorChecker/dark skin", "gold.k"):
        found, said = converted(tmp_path, inside, name, "out.csv")
        original = spectra.load(name)
        assert (found.wavelengths_nm, found.values) == (original.wavelengths_nm, original.values)
        assert (found.quantity, found.outside, found.unit) == (
            original.quantity, original.outside, original.unit
        )  # fmt: skip
        assert said.startswith(f"out.csv: {name}, {len(original.values)} points from ")


def test_resampled_normalised_and_scaled(tmp_path: Path, inside: Command) -> None:
    arguments = ["D65", "out.csv", "--range", "380-780", "--step", "1", "--normalise", "560", "--scale", "2"]
    found, said = converted(tmp_path, inside, *arguments)
    grid = np.arange(380, 781)
    assert found.wavelengths_nm == tuple(grid)
    np.testing.assert_allclose(found.values, spectra.load("D65").at(grid) / 50, rtol=1e-9)
    assert said == (
        "out.csv: D65, 401 points from 380 to 780 nm; resampled to 1 nm from 300-780 nm, 5 nm; "
        "normalised to 1 at 560 nm; scaled by 2\n"
    )


def test_a_normalised_radiance_becomes_relative(tmp_path: Path, inside: Command) -> None:
    found, _ = converted(tmp_path, inside, "blackbody:2856", "out.csv")
    assert found.unit == "W sr-1 m-2 nm-1"
    found, _ = converted(tmp_path, inside, "blackbody:2856", "out.csv", "--normalise", "560")
    assert found.unit == "relative" and found.at(560) == pytest.approx(1)


def test_percent_becomes_a_reflectance(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "percent.txt").write_text("400 12.5\n500 50\n700 80\n")
    arguments = ["percent.txt", "out.csv", "--scale", "0.01", "--quantity", "reflectance"]
    found, _ = converted(tmp_path, inside, *arguments)
    assert found.quantity == "reflectance"
    np.testing.assert_allclose(found.values, [0.125, 0.5, 0.8], rtol=1e-12)


def test_a_column_of_a_file_and_two_columns(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "wide.csv").write_text("nm,red,green\n400,0.1,0.2\n500,0.15,0.25\n")
    found, _ = converted(tmp_path, inside, "wide.csv", "out.spd", "--column", "green")
    assert (found.wavelengths_nm, found.values) == ((400, 500), (0.2, 0.25))


@pytest.mark.parametrize("ending", ["csv", "spd", "mat"])
def test_each_format_holds_the_numbers(tmp_path: Path, inside: Command, ending: str) -> None:
    found, _ = converted(tmp_path, inside, "ColorChecker/cyan", f"out.{ending}")
    original = spectra.load("ColorChecker/cyan")
    np.testing.assert_allclose(found.wavelengths_nm, original.wavelengths_nm)
    np.testing.assert_allclose(found.values, original.values, rtol=1e-12)


def test_a_material_file_keeps_its_words(tmp_path: Path, inside: Command) -> None:
    """The copper of the book (III.7.1)."""
    (tmp_path / "copper.mat").write_text(
        "# Material: copper\nconductor\nn 0.617\nk 2.63\n380 0.07\n700 0.755\n"
    )
    _, said = converted(tmp_path, inside, "copper.mat", "out.mat", "--range", "400-700", "--step", "50")
    found = spectra.read_material(tmp_path / "out.mat")
    assert (found.n, found.k, found.conductor, found.comments) == (0.617, 2.63, True, ("Material: copper",))
    assert found.curve.wavelengths_nm == tuple(range(400, 701, 50)) and "kept by" not in said
    _, said = converted(tmp_path, inside, "copper.mat", "out.csv")
    assert said.endswith("; n, k, conductor and dielectric are kept by .mat only\n")


def test_the_interpolation_can_be_chosen(tmp_path: Path, inside: Command) -> None:
    found, said = converted(tmp_path, inside, "D65", "out.csv", "--step", "1", "--interpolation", "sprague")
    expected = spectra.load("D65").resampled(found.wavelengths_nm, "sprague")
    np.testing.assert_allclose(found.values, expected.values, rtol=1e-14)
    assert "resampled by sprague to 1 nm" in said


def test_a_normalised_reflectance_is_none_any_more(tmp_path: Path, inside: Command) -> None:
    found, _ = converted(tmp_path, inside, "book/copper", "out.csv", "--normalise", "500")
    assert found.quantity == "" and max(found.values) > 1


@pytest.mark.parametrize(("role", "rgb"), [("albedo", "0.8,0.2,0.1"), ("emission", "2,1,0.5")])
def test_rgb_becomes_a_curve_of_that_colour(tmp_path: Path, inside: Command, role: str, rgb: str) -> None:
    found, said = converted(tmp_path, inside, "--rgb", rgb, "--role", role, "out.csv")
    grid = np.arange(380.0, 781.0)
    wanted = np.array([float(value) for value in rgb.split(",")])
    system = core().rgb_system("sRGB")
    if role == "albedo":
        # Of a white lamp of the system: D65.
        lamp = spectra.load("D65").at(grid)
        xyz = core().xyz(grid, lamp * found.at(grid), "zero") / core().xyz(grid, lamp, "zero")[1]
        assert max(found.values) <= 1 and found.quantity == "reflectance"
    else:
        xyz = core().xyz(grid, found.at(grid), "zero")
        assert found.quantity == "emission" and found.outside == "zero"
    np.testing.assert_allclose(np.array(system["from_xyz"]) @ xyz, wanted, atol=5e-3)
    first, warning = said.splitlines()
    assert "round trip of the colour ΔE00 0.0" in first
    assert warning.startswith("Warning: RGB does not determine a curve") and warning.endswith(" misleads.")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "0 arguments: expected a name or a file, and the file to write."),
        (["D65"], "1 argument: expected a name or a file, and the file to write."),
        (["D65", "a.csv", "b.csv"], "One argument is enough, and b.csv is more"),
        (["D65", "a.xls"], "a.xls: expected a file that ends in .csv, .spd or .mat."),
        (["D65", "none/a.csv"], "none/a.csv cannot be written: there is no folder none."),
        (["D66", "a.csv"], "no spectrum 'D66' in the library; did you mean 'D65'?"),
        (["broken.csv", "a.csv"], "broken.csv:2: wavelength 390 nm comes after 400 nm"),
        (["D65", "a.csv", "--step", "0"], "--step 0: expected a number above zero."),
        (["D65", "a.csv", "--step", "nan"], "--step nan: expected a number above zero."),
        (["D65", "a.csv", "--step", "1e-9"], "--step 1e-09 leaves 480000000001 wavelengths from 300 to 780 nm."),
        (["D65", "a.csv", "--interpolation", "pchip"], "--interpolation goes with --step."),
        (["D65", "a.csv", "--interpolation", "frob", "--step", "1"], "There is no 'frob': expected 'linear', 'pchip'"),
        (["D65", "a.csv", "--scale", "-1"], "--scale -1: expected a number above zero."),
        (["D65", "a.csv", "--range", "5"], "--range 5: expected two increasing wavelengths in nm"),
        (["D65", "a.csv", "--normalise", "900"], "D65 is not known at 900 nm"),
        (["D65", "a.csv", "--quantity", "emission"], "--quantity goes with a file, and D65 is none."),
        (["D65", "a.csv", "--column", "x"], "--column goes with a file, and D65 is none."),
        (["D65", "a.csv", "--role", "albedo"], "--role goes with --rgb."),
        (["lamp.csv", "a.csv", "--quantity", "n"], "--quantity n: lamp.csv says that it holds emission."),
        (["lamp.csv", "a.csv", "--quantity", "n", "--scale", "2"], "--quantity n: lamp.csv says that it holds"),
        (["percent.csv", "a.csv", "--quantity", "reflectance"], "percent.csv:1: value 50 at 400 nm"),
        (["percent.csv", "a.csv", "--quantity", "reflectance", "--scale", "0.1"], "expected a reflectance from 0 to 1"),
        (["--rgb", "1,1,1", "a.csv"], "--rgb without --role: expected --role albedo for a surface"),
        (["--rgb", "1,1,1", "--role", "raw", "a.csv"], "--role raw: expected --role albedo"),
        (["--rgb", "1,1", "--role", "albedo", "a.csv"], "--rgb 1,1: expected three numbers, such as 0.8,0.2,0.1."),
        (["--rgb", "2,1,1", "--role", "albedo", "a.csv"], "--rgb 2,1,1: RGB of the role albedo must be from 0 to 1"),
        (["--rgb", "-1,1,1", "--role", "emission", "a.csv"], "--rgb -1,1,1: RGB of the role emission must be"),
        (["--rgb", "1,1,1", "--role", "albedo", "D65", "a.csv"], "2 arguments: expected --rgb R,G,B, and the file"),
        (["--rgb", "1,1,1", "--role", "albedo", "--system", "RGB", "a.csv"], "There is no RGB system 'RGB'"),
        (["--rgb", "1,1,1", "--role", "albedo", "--column", "x", "a.csv"], "--column goes with a file, not with"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_sentence_and_leaves_no_file(
    tmp_path: Path, inside: Command, arguments: list[str], sentence: str
) -> None:
    (tmp_path / "broken.csv").write_text("400,1\n390,1\n")
    (tmp_path / "lamp.csv").write_text("# quantity: emission\n400,1\n500,1\n")
    (tmp_path / "percent.csv").write_text("400,50\n500,60\n")
    before = sorted(tmp_path.iterdir())
    done = inside("spectra", "convert", *arguments, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert sentence in done.stderr and done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1
    assert sorted(tmp_path.iterdir()) == before


def test_an_older_file_is_replaced_whole_or_stays(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "out.csv").write_text("older")
    inside("spectra", "convert", "D65", "out.csv", "--normalise", "900", cwd=tmp_path)
    assert (tmp_path / "out.csv").read_text() == "older"
    converted(tmp_path, inside, "D65", "out.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["out.csv"]
