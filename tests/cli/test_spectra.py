"""`illuminant spectra list` and `show`, and what all its verbs share."""

import json
import os
import pty
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from illuminant import spectra

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def on_a_terminal(*arguments: str, **environment: str) -> str:
    """What the command prints on a terminal of 80 columns; plain unless the environment says otherwise."""
    controller, terminal = pty.openpty()
    process = subprocess.Popen(
        [str(Path(sys.executable).with_name("illuminant")), *arguments],
        stdout=terminal,
        stdin=subprocess.DEVNULL,
        env={**os.environ, "COLUMNS": "80", **(environment or {"NO_COLOR": "1"})},
    )
    os.close(terminal)
    parts: list[bytes] = []
    while True:
        try:
            part = os.read(controller, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        parts.append(part)
    os.close(controller)
    assert process.wait(timeout=60) == 0
    return b"".join(parts).decode().replace("\r\n", "\n")


# --- all verbs -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "verb", ["spectra", "spectra list", "spectra show", "spectra plot", "spectra convert"]
)
def test_every_help_has_an_example_and_fits_80_columns(verb: str, inside: Command) -> None:
    out = inside(*verb.split(), "--help").stdout
    assert f"illuminant {verb} " in out.split("Example")[1]
    assert max(map(len, out.splitlines())) <= 80


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["show", "D6"], "no spectrum 'D6' in the library; did you mean 'D65'?"),
        (["show", "ColorChecker/drak skin"], "did you mean 'ColorChecker/dark skin'"),
        (["show", "gold"], "'gold' is a material, not one spectrum; ask for 'gold.n' or 'gold.k'"),
        (["show", "none.csv"], "none.csv: there is no such file"),
        (["show", "./D65"], "D65: there is no such file"),
        (["show", "."], ".: is a folder; expected a spectrum file"),
        (["show", "broken.csv"], "broken.csv:3: wavelength 410 nm comes after 420 nm"),
        (["show", "word.csv"], "word.csv:2: expected a number in column 2, found 'high'"),
        (["show", "wide.csv"], "wide.csv:2: 3 columns (red, green)"),
        (["show", "wide.csv", "--column", "blue"], "wide.csv: no column 'blue'; expected 'red' or 'green'"),
        (
            ["show", "plain.csv", "--quantity", "light"],
            "--quantity light: expected emission, reflectance, n or k.",
        ),
        (["show", "lamp.csv", "--quantity", "n"], "--quantity n: lamp.csv says that it holds emission."),
        (["show", "bright.csv", "--quantity", "reflectance"], "bright.csv:2: value 50 at 500 nm"),
        (["show", "blackbody:hot"], "blackbody:hot: expected a temperature in K, such as blackbody:6504."),
        (["show", "blackbody:-3"], "blackbody:-3: expected a temperature in K"),
        (["show", "blackbody:nan"], "blackbody:nan: expected a temperature in K"),
        (["show", "daylight:300"], "daylight:300: expected a colour temperature of 4000 to 25000 K"),
        (["show", "D65", "--quantity", "n"], "--quantity goes with a file, and D65 is none."),
        (["show"], "Missing argument 'WHAT'"),
        (["list", "--quantity", "colour"], "--quantity colour: expected emission, reflectance, n or k."),
        (["frob"], "No such command 'frob'"),
    ],
)
def test_a_mistake_is_one_sentence(
    tmp_path: Path, inside: Command, arguments: list[str], sentence: str
) -> None:
    (tmp_path / "broken.csv").write_text("400,1\n420,1\n410,1\n")
    (tmp_path / "word.csv").write_text("400,1\n410,high\n")
    (tmp_path / "wide.csv").write_text("nm,red,green\n400,0.1,0.2\n500,0.1,0.2\n")
    (tmp_path / "plain.csv").write_text("400,0.1\n500,0.2\n")
    (tmp_path / "bright.csv").write_text("400,0.1\n500,50\n")
    (tmp_path / "lamp.csv").write_text("# quantity: emission\n400,0.1\n500,0.2\n")
    done = inside("spectra", *arguments, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert sentence in done.stderr and done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("verb", ["list", "show", "plot", "convert"])
def test_help_loads_no_large_package(verb: str) -> None:
    program = (
        f"import sys; from illuminant.cli import run; run(['spectra', {verb!r}, '--help']);"
        "print(sorted({'numpy', 'matplotlib', 'illuminant._core', 'illuminant.spectra'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


# --- list ----------------------------------------------------------------------------------------------------


def test_into_a_pipe_goes_a_line_for_each_name(inside: Command) -> None:
    rows = [line.split("\t") for line in inside("spectra", "list").stdout.splitlines()]
    assert [row[0] for row in rows] == spectra.names()
    assert {len(row) for row in rows} == {5}
    d65 = next(row for row in rows if row[0] == "D65")
    assert d65 == ["D65", "emission", "300-780 nm", "5 nm", "CIE 15:2004, Colorimetry, 3rd edition"]


def test_without_a_verb_the_library_is_listed(inside: Command) -> None:
    assert inside("spectra").stdout == inside("spectra", "list").stdout


def test_words_and_a_quantity_choose_names(inside: Command) -> None:
    def names(*arguments: str) -> list[str]:
        found = json.loads(inside("spectra", "list", *arguments, "--json").stdout)
        return [row["name"] for row in found]

    assert names("gold") == ["gold.n", "gold.k"]
    assert names("AU.") == ["gold.n", "gold.k"], "other names count too"
    assert names("checker", "skin") == [
        "ColorChecker/dark skin", "ColorChecker/light skin",
        "ColorChecker Ohta/dark skin", "ColorChecker Ohta/light skin",
    ]  # fmt: skip
    assert names("--quantity", "k") == spectra.names("k")
    assert names("gold", "--quantity", "emission") == []


def test_what_is_not_there_is_said(inside: Command) -> None:
    done = inside("spectra", "list", "frob")
    assert (done.returncode, done.stdout) == (0, "") and done.stderr.startswith("No name of the library")


def test_a_terminal_gets_a_table_with_headings_in_80_columns() -> None:
    out = on_a_terminal("spectra", "list")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 80
    assert any(line.startswith("metals: P. B. Johnson") and line.endswith("…") for line in lines)
    rows = [line for line in lines if line.startswith("  ")]
    assert [row[2:].split("  ")[0] for row in rows] == spectra.names()
    columns = {row.find("reflectance") for row in rows if "reflectance" in row}
    assert len(columns) == 1, "aligned"


# --- show ----------------------------------------------------------------------------------------------------


def shown(inside: Command, *arguments: object, cwd: Path | None = None) -> dict:
    done = inside("spectra", "show", *arguments, "--json", cwd=cwd)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_lamp_shows_its_chromaticity(inside: Command) -> None:
    found = shown(inside, "D65")
    assert found["quantity"] == "emission" and found["range_nm"] == [300, 780] and found["step_nm"] == 5
    assert found["licence"].startswith("colorimetric data") and found["source"].startswith("CIE 15:2004")
    # CIE 15:2004, table T.3: 0.31272, 0.32903.
    assert found["derived"]["x"] == pytest.approx(0.31272, abs=2e-5)
    assert found["derived"]["y"] == pytest.approx(0.32903, abs=2e-5)
    every_nm = np.interp(np.arange(300, 781), found["wavelengths_nm"], found["values"])
    assert found["area"] == pytest.approx(every_nm.sum())


def test_a_lamp_shows_its_colour_temperature_and_how_it_renders_colours(inside: Command) -> None:
    """CIE 15:2004, table T.8.2: FL2 has 4230 K and R_a 64; a green line has neither."""
    derived = shown(inside, "FL2")["derived"]
    assert derived["cct_k"] == pytest.approx(4230, abs=10) and derived["ra"] == pytest.approx(64, abs=0.5)
    out = inside("spectra", "show", "FL2", "--no-values").stdout
    assert "temperature   4225 K, Duv 0.0019; colour rendering R_a 64." in out


def test_a_lamp_far_from_all_blackbodies_has_no_temperature(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "green.csv").write_text("# quantity: emission\n520,0\n530,1\n540,0\n")
    derived = shown(inside, "green.csv", cwd=tmp_path)["derived"]
    assert derived["y"] > 0.75 and not {"cct_k", "duv", "ra"} & set(derived)


def test_a_material_file_shows_its_words(tmp_path: Path, inside: Command) -> None:
    """The copper of the book (III.7.1)."""
    (tmp_path / "copper.mat").write_text(
        "# Material: copper\nconductor\nn 0.617\nk 2.63\n380 0.07\n700 0.755\n"
    )
    found = shown(inside, "copper.mat", cwd=tmp_path)
    assert (found["n"], found["k"], found["conductor"], found["quantity"]) == (
        0.617,
        2.63,
        True,
        "reflectance",
    )
    out = inside("spectra", "show", "copper.mat", cwd=tmp_path).stdout
    assert "\nmaterial      n 0.617, k 2.63, conductor\n" in out


def test_a_radiance_shows_its_luminance_too(inside: Command) -> None:
    """At the freezing point of platinum, 2042 K, a blackbody has 60 cd/cm²: so the candela was defined until 1979."""
    derived = shown(inside, "blackbody:2042")["derived"]
    assert derived["luminance_cd_m2"] == pytest.approx(6e5, rel=0.01)
    assert "luminance_cd_m2" not in shown(inside, "daylight:6504")["derived"]


def test_a_reflectance_shows_its_colour_under_d65(inside: Command) -> None:
    """A perfect diffuser is white; ColorChecker's neutral 5 has L* near 50 and no colour (BabelColor)."""
    derived = shown(inside, "ColorChecker/neutral 5")["derived"]
    assert derived["light"] == "D65" and not derived["clipped"]
    lightness, a, b = derived["lab"]
    assert abs(lightness - 50.7) < 0.8 and abs(a) < 1 and abs(b) < 1
    assert derived["srgb"].startswith("#7") and len(derived["srgb"]) == 7
    assert shown(inside, "ColorChecker/cyan")["derived"]["clipped"]


def test_a_white_is_white(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "white.csv").write_text("300,1\n900,1\n")
    derived = shown(inside, "white.csv", "--quantity", "reflectance", cwd=tmp_path)["derived"]
    assert derived["lab"] == pytest.approx([100, 0, 0], abs=1e-9)
    assert derived["srgb"] == "#ffffff" and derived["xyz"][1] == pytest.approx(1)


def test_n_and_k_show_their_value_at_the_sodium_lines(inside: Command) -> None:
    """N-BK7 has n_D = 1.5167 at 589.3 nm (SCHOTT)."""
    derived = shown(inside, "BK7.n")["derived"]
    assert derived["wavelength_nm"] == 589.3 and derived["value"] == pytest.approx(1.51673, abs=2e-5)


def test_a_file_stands_in_place_of_a_name(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "wide.csv").write_text("nm,red,green\n400,0.1,0.2\n500,0.1,0.25\n")
    found = shown(inside, "wide.csv", "--column", "green", cwd=tmp_path)
    assert (found["quantity"], found["values"], found["derived"]) == ("", [0.2, 0.25], {})
    (tmp_path / "D65").write_text("400 3\n500 4\n")
    assert shown(inside, "./D65", cwd=tmp_path)["values"] == [3, 4]
    assert shown(inside, "D65", cwd=tmp_path)["points"] == 97, (
        "without a folder the name of the library is meant"
    )


def test_values_come_one_to_a_line_in_a_pipe_and_can_be_left_out(inside: Command) -> None:
    out = inside("spectra", "show", "D65").stdout
    assert "\n     560  100\n" in out and "300 to 780 nm, 97 points, 5 nm apart" in out
    assert "x 0.3127, y 0.3290 (CIE 1931 2°)" in out and "▁" in out
    assert max(map(len, out.splitlines())) <= 80
    short = inside("spectra", "show", "D65", "--no-values").stdout
    assert out.startswith(short.rstrip("\n")) and "560  100" not in short


@pytest.mark.parametrize("name", ["FL11", "ColorChecker/dark skin", "aluminium.k", "gold.n"])
def test_a_terminal_shows_it_all_in_80_columns(name: str) -> None:
    out = on_a_terminal("spectra", "show", name)
    assert max(map(len, out.splitlines())) <= 80
    spectrum = spectra.load(name)
    words = out.split()
    assert all(f"{value:.6g}" in words for value in spectrum.values)


def test_a_terminal_of_any_colour_shows_a_patch_of_it() -> None:
    arguments = ("spectra", "show", "ColorChecker/red", "--no-values")
    code = on_a_terminal(*arguments).split("sRGB #")[1][:6]
    patch = ";".join(str(int(code[i : i + 2], 16)) for i in (0, 2, 4))
    assert f"\x1b[48;2;{patch}m    \x1b[0m" in on_a_terminal(*arguments, COLORTERM="truecolor")
    assert "\x1b[48" not in on_a_terminal(*arguments, COLORTERM="")


def test_the_block_plot_has_its_peak_where_the_curve_has(inside: Command) -> None:
    from illuminant.cli.spectra.show import block_plot

    lines = block_plot(spectra.load("FL11"), 78)
    peak = lines[0].index("█") - len(lines[0].split()[0]) - 1
    columns = 78 - len("72.8") - 2
    assert 380 + 400 * peak / columns == pytest.approx(545, abs=6), "the green line of FL11"
    assert block_plot(spectra.Spectrum("zero", [400, 700], [0, 0]), 40)[0].startswith("0")
    negative = block_plot(spectra.Spectrum("gain", [400, 700], [-1, 1], quantity="k"), 40)
    assert negative[0].endswith("█") and negative[4].lstrip("-1 ").startswith(("▁", "█"))
