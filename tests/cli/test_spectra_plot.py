"""`illuminant spectra plot`: each kind of plot as a file, and every wrong choice as a sentence."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def written(folder: Path, inside: Command, *arguments: str) -> tuple[str, str]:
    """Name of the one file that a small plot makes in an empty folder, and what was said."""
    small = () if "--size" in arguments else ("--size", "500x450")
    done = inside("spectra", "plot", *arguments, *small, cwd=folder)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    (file,) = folder.iterdir()
    start = {".png": b"\x89PNG", ".svg": b"<?xml"}[file.suffix]
    assert file.read_bytes().startswith(start) and file.stat().st_size > 5000
    return file.name, done.stderr


@pytest.mark.parametrize(
    ("arguments", "name", "said"),
    [
        (["D65", "FL11", "--normalise", "560", "-o", "lamps.svg"], "lamps.svg", "curves of 2 spectra"),
        (["ColorChecker/dark skin", "--range", "400-700"], "ColorChecker-dark-skin.png", "curves"),
        (["blackbody:2856", "daylight:6504", "--normalise", "560"], "blackbody-2856.png", "curves of 2 spectra"),
        (["--observer", "1931"], "observer-1931.png", "matching functions"),
        (["--space", "ac1c2", "--plain", "-o", "a.svg"], "a.svg", "matching functions"),
        (["--matching", "445,535,630"], "matching-445-535-630.png", "matching functions"),
        (["--chromaticity", "445,535,630"], "chromaticity-445-535-630.png", "a chromaticity diagram"),
        (["--chromaticity", "445,535,630", "--projection", "-o", "c.svg"], "c.svg", "a chromaticity diagram in space"),
        (
            ["D65", "ColorChecker/red", "--light", "A", "--chromaticity", "uv", "--gamut", "srgb", "-o", "b.svg"],
            "b.svg",
            "a chromaticity diagram of 2 spectra",
        ),
    ],
)  # fmt: skip
def test_each_kind_of_plot(
    tmp_path: Path, inside: Command, arguments: list[str], name: str, said: str
) -> None:
    assert written(tmp_path, inside, *arguments) == (name, f"{name}: {said}\n")


@pytest.mark.parametrize("size", [(800, 600), (777, 501), (321, 900)])
def test_the_size_is_that_of_the_png(tmp_path: Path, inside: Command, size: tuple[int, int]) -> None:
    written(tmp_path, inside, "E", "--size", f"{size[0]}x{size[1]}")
    header = (tmp_path / "E.png").read_bytes()[16:24]
    assert (int.from_bytes(header[:4]), int.from_bytes(header[4:])) == size


def test_a_file_is_plotted_beside_a_name(tmp_path: Path, inside: Command) -> None:
    source = tmp_path / "in"
    source.mkdir()
    (source / "lamp.csv").write_text("nm,one,two\n400,1,2\n700,3,4\n")
    folder = tmp_path / "out"
    folder.mkdir()
    arguments = [str(source / "lamp.csv"), "D65", "--column", "two", "--quantity", "emission"]
    assert written(folder, inside, *arguments, "--normalise", "560")[0] == "lamp.png"


def test_two_files_of_one_name_are_two_points(tmp_path: Path, inside: Command) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    for folder, end in (("a", 1), ("b", 9)):
        (tmp_path / folder / "lamp.csv").write_text(f"# quantity: emission\n400,1\n700,{end}\n")
    done = inside(
        "spectra",
        "plot",
        "a/lamp.csv",
        "b/lamp.csv",
        "--chromaticity",
        "xy",
        "--plain",
        "-o",
        "c.svg",
        cwd=tmp_path,
    )
    assert done.stderr == "c.svg: a chromaticity diagram of 2 spectra\n"
    plot = inside(
        "spectra", "plot", "a/lamp.csv", "--chromaticity", "xy", "--plain", "-o", "d.svg", cwd=tmp_path
    )
    assert plot.returncode == 0
    circles = [(tmp_path / name).read_text().count("ffffff; stroke: #000000") for name in ("c.svg", "d.svg")]
    assert circles[0] > circles[1]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "Name what to plot: spectra, --observer 1931, --matching 445,535,630 or --chromaticity xy."),
        (["D65", "-o", "a.jpg"], "a.jpg: expected a file that ends in .png or .svg."),
        (["D65", "-o", "a"], "a: expected a file that ends in .png or .svg."),
        (["D65", "-o", "none/a.png"], "none/a.png cannot be written: there is no folder none."),
        (["D66"], "no spectrum 'D66' in the library; did you mean 'D65'?"),
        (["D65", "--normalise", "900"], "D65 is not known at 900 nm"),
        (["D65", "--normalise", "green"], "--normalise: expected a number"),
        (["D65", "--range", "700-400"], "--range 700-400: expected two increasing wavelengths in nm, such as 380-780."),
        (["D65", "--range", "visible"], "--range visible: expected two increasing wavelengths"),
        (["D65", "--range", "900-1000"], "nothing of that lies in the range 900-1000 nm"),
        (["D65", "--gamut", "sRGB"], "--gamut does not go with curves."),
        (["D65", "--light", "A"], "--light does not go with curves."),
        (["--matching", "445,535,630", "--space", "ac1c2"], "--space does not go with matching functions."),
        (["--observer", "1931", "--normalise", "560"], "--normalise does not go with matching functions."),
        (["D65", "--observer", "1931"], "Matching functions are a plot by themselves, without D65."),
        (["--matching", "445,535"], "--matching 445,535: expected three wavelengths in nm, such as 445,535,630."),
        (["--matching", "445,535,inf"], "--matching 445,535,inf: expected three wavelengths"),
        (["--matching", "445,535,900"], "expected three different wavelengths from 360 to 830 nm"),
        (["--matching", "1,2,3", "--chromaticity", "xy"], "--matching and --chromaticity are two plots"),
        (["--observer", "1913"], "There is no observer '1913' (did you mean \"1931\"?): known are 1931, 1964, book"),
        (["--space", "foo"], "There is no space 'foo': expected xyz, ac1c2 or an RGB system"),
        (["--chromaticity", "yx"], "There is no diagram 'yx': expected xy, uv, or three wavelengths"),
        (["--chromaticity", "xy", "--gamut", "sGRB"], "There is no RGB system 'sGRB': known are sRGB"),
        (["--chromaticity", "xy", "--projection"], "--chromaticity xy: expected three wavelengths in nm"),
        (["D65", "--chromaticity", "1,2,3", "--projection"], "--projection shows three lights by themselves"),
        (["--matching", "445,535,630", "--projection"], "--projection does not go with matching functions."),
        (["--chromaticity", "xy", "--normalise", "5"], "--normalise does not go with a chromaticity diagram."),
        (["gold.n", "--chromaticity", "xy"], "gold.n holds n: expected an emission or a reflectance"),
        (["D65", "--light", "A", "--chromaticity", "xy"], "--light goes with reflectances, and none is named."),
        (
            ["book/copper", "--light", "book/copper", "--chromaticity", "xy"],
            "--light book/copper: expected a lamp, not reflectance.",
        ),
        (["--chromaticity", "xy", "--zoom"], "A diagram can be zoomed to points only, and none is given."),
        (["D65", "FL2", "--column", "x"], "--column goes with a file, and D65 is none."),
        (["--matching", "445,535,630", "--quantity", "n"], "--quantity goes with a file."),
        (["D65", "--size", "4000x500"], "at most three to one, such as 1600x1000."),
        (["D65", "--size", "wide"], "--size wide: expected width and height"),
        (["D65", "--size", "10x10"], "--size 10x10: expected width and height from 200 to 10000"),
    ],
)  # fmt: skip
def test_a_wrong_choice_is_one_sentence_and_leaves_no_file(
    tmp_path: Path, inside: Command, arguments: list[str], sentence: str
) -> None:
    done = inside("spectra", "plot", *arguments, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert sentence in done.stderr and done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())
