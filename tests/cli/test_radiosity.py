"""`illuminant radiosity`: from a scene file to a solution, other lamps and paints, and what is made of it."""

import csv
import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh

from illuminant import png
from illuminant.image import Image

Command = Callable[..., "subprocess.CompletedProcess[str]"]

SCENE = """\
title = "a corner"

[camera]
eye = [1.8, 1.5, 2.2]
target = [-0.3, 0.4, -0.3]
size = [32, 24]

[render]
technique = "radiosity"
sampling = "uniform:8"
elements = 200
form_factors = "rays:64"
samples = 4

[materials.white]
kind = "diffuse"
reflectance = 0.8

[materials.lamp]
kind = "emitter"
spectrum = "E"
luminance_cd_m2 = 2000.0

[lights.desk]
kind = "point"
position = [0.4, 1.2, 0.5]
spectrum = "E"
intensity_cd = 200.0

[objects.floor]
rectangle = { corner = [-1, 0, -1], edges = [[0, 0, 2], [2, 0, 0]] }
material = "white"

[objects.wall]
rectangle = { corner = [-1, 0, -1], edges = [[2, 0, 0], [0, 1.5, 0]] }
material = "white"

[objects.ceiling]
rectangle = { corner = [-0.5, 2, -0.5], edges = [[1, 0, 0], [0, 0, 1]] }
material = "lamp"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "room.toml").write_text(SCENE)
    return tmp_path


@pytest.fixture
def solved(folder: Path, inside: Command) -> Path:
    """A folder with the scene and its solution."""
    assert inside("radiosity", "solve", "room.toml", cwd=folder).returncode == 0
    return folder


def words(text: str) -> list[str]:
    return ["radiosity", *text.split()]


def test_solve_writes_a_solution_and_says_how_good_it_is(folder: Path, inside: Command) -> None:
    done = inside(*words("solve room.toml"), cwd=folder)
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr.startswith("room.solution: ") and " elements, " in done.stderr
    for word in ("patches", "form factors", "closure", "reciprocity", "energy"):
        assert word in done.stderr
    assert sorted(path.name for path in folder.iterdir()) == ["room.solution", "room.toml"]


def test_json_says_everything(folder: Path, inside: Command) -> None:
    text = "solve room.toml -o a.solution --elements 400 --patches 100 --solver gauss-seidel --json"
    facts = json.loads(inside(*words(text), cwd=folder).stdout)
    assert facts["file"] == "a.solution" and (folder / "a.solution").exists()
    assert 200 < facts["elements"] < 800 and facts["patches"] < 0.6 * facts["elements"]
    assert facts["residual"] <= 1e-5 and facts["steps"] == len(facts["history"])
    assert facts["seconds"] > 0 and facts["memory"] > 0 and facts["reciprocity"] < 0.05
    text = "relight a.solution --lamp desk=0.5 -o b.solution --json"
    facts = json.loads(inside(*words(text), cwd=folder).stdout)
    assert facts["file"] == "b.solution" and facts["seconds_relighting"] >= 0
    facts = json.loads(inside(*words("show b.solution --json"), cwd=folder).stdout)
    assert facts["file"] == "b.solution" and facts["outputs"] == []


def test_show_writes_images_meshes_and_maps(solved: Path, inside: Command) -> None:
    text = "show room.solution -o a.exr -o a.png -o a.glb --luminance map.png --samples 4"
    done = inside(*words(text), cwd=solved)
    assert done.returncode == 0, done.stderr
    image = Image.open(solved / "a.exr")
    assert (image.width, image.height, image.unit) == (32, 24, "cd/m2")
    assert image.settings["technique"] == "radiosity" and image.settings["elements"] == 200
    assert png.read_header(solved / "a.png").settings == image.settings
    assert (solved / "map.png").read_bytes().startswith(b"\x89PNG")
    read = trimesh.load(solved / "a.glb", process=False)
    assert {"floor", "wall"} <= set(read.geometry)
    assert "_XYZ" in read.geometry["floor"].vertex_attributes


def test_show_from_elsewhere(solved: Path, inside: Command) -> None:
    text = "show room.solution -o a.exr --eye 1,2,2 --target 0,0,0 --size 16x12 --gather full --samples 8"
    assert inside(*words(text), cwd=solved).returncode == 0
    image = Image.open(solved / "a.exr")
    assert (image.width, image.height) == (16, 12)
    assert image.settings["gather"] == "full" and image.settings["samples"] == 8
    assert image.xyz[..., 1].mean() > 1


def test_the_image_is_that_of_render(solved: Path, inside: Command) -> None:
    assert inside(*words("show room.solution -o a.exr --samples 4"), cwd=solved).returncode == 0
    assert inside("render", "room.toml", "-o", "b.exr", cwd=solved).returncode == 0
    a, b = (Image.open(solved / name).xyz for name in ("a.exr", "b.exr"))
    np.testing.assert_array_equal(a, b)


def table(path: Path) -> list[dict[str, float]]:
    with open(path, encoding="utf-8") as stream:
        return [{key: float(one) for key, one in row.items()} for row in csv.DictReader(stream)]


def test_illuminance_on_a_grid(solved: Path, inside: Command) -> None:
    text = "show room.solution -o floor.csv --grid -0.5,0.01,-0.5:0.5,0.01,0.5:4x3 --json"
    done = inside(*words(text), cwd=solved)
    facts, rows = json.loads(done.stdout), table(solved / "floor.csv")
    assert len(rows) == 12
    assert sorted({row["x"] for row in rows}) == [-0.375, -0.125, 0.125, 0.375]
    assert sorted({row["z"] for row in rows}) == pytest.approx([-1 / 3, 0, 1 / 3], rel=1e-5)
    lux = np.array([row["illuminance_lx"] for row in rows])
    assert facts["mean_lx"] == pytest.approx(lux.mean(), rel=1e-4)
    assert facts["least_lx"] == pytest.approx(lux.min(), rel=1e-4)
    assert facts["most_lx"] == pytest.approx(lux.max(), rel=1e-4)
    assert facts["uniformity"] == pytest.approx(lux.min() / lux.mean(), rel=1e-4)
    assert {(row["nx"], row["ny"], row["nz"]) for row in rows} == {(0.0, 1.0, 0.0)}
    plain = inside(*words(text.removesuffix(" --json")), cwd=solved)
    assert "illuminance: mean " in plain.stderr and "uniformity" in plain.stderr


def test_illuminance_at_sensors(solved: Path, inside: Command) -> None:
    """And none of it where all lamps are switched off."""
    (solved / "sensors.csv").write_text("x,y,z,nx,ny,nz\n0.4,0.2,0.5,0,1,0\n0.4,0.2,0.5,0,-1,0\n0,1,0,,,\n")
    text = "show {} -o {} --sensors sensors.csv"
    assert inside(*words(text.format("room.solution", "all.csv")), cwd=solved).returncode == 0
    rows = table(solved / "all.csv")
    assert rows[2]["ny"] == 1.0
    # 200 cd one metre above, and what the ceiling and walls add; from below, what the floor returns.
    assert rows[0]["illuminance_lx"] > 200 and rows[0]["illuminance_lx"] > rows[1]["illuminance_lx"] > 100
    assert rows[0]["X"] == pytest.approx(rows[0]["illuminance_lx"], rel=0.02)
    text_off = "relight room.solution --lamp desk=0 --lamp ceiling=0 -o off.solution"
    assert inside(*words(text_off), cwd=solved).returncode == 0
    assert inside(*words(text.format("off.solution", "off.csv")), cwd=solved).returncode == 0
    assert [row["illuminance_lx"] for row in table(solved / "off.csv")] == [0.0, 0.0, 0.0]


def test_relight_and_paint(solved: Path, inside: Command) -> None:
    def luminance(name: str) -> np.ndarray:
        assert inside(*words(f"show {name} -o a.exr --samples 4"), cwd=solved).returncode == 0
        return np.asarray(Image.open(solved / "a.exr").xyz, float).mean(axis=(0, 1))

    whole = luminance("room.solution")
    text = "relight room.solution --lamp desk=0.5 --lamp ceiling=0.5 -o half.solution"
    done = inside(*words(text), cwd=solved)
    assert done.returncode == 0 and done.stderr.startswith("half.solution: relit in ")
    np.testing.assert_allclose(luminance("half.solution"), 0.5 * whole, rtol=1e-3)
    text = "relight room.solution --paint white=0.2 --lamp desk=A -o dark.solution"
    assert inside(*words(text), cwd=solved).returncode == 0
    dark = luminance("dark.solution")
    assert dark[1] < 0.5 * whole[1] and dark[0] / dark[2] > 1.1 * whole[0] / whole[2]
    # Without an output the solution itself is changed.
    assert inside(*words("relight room.solution --lamp desk=0"), cwd=solved).returncode == 0
    assert luminance("room.solution")[1] < whole[1]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("solve missing.toml", "missing.toml: there is no such file"),
        ("solve room.toml -o none/a.solution", "there is no folder none."),
        ("solve room.toml --elements 0", "--elements 0: expected a whole number from 1 to"),
        ("solve room.toml --elements many", "--elements: expected a whole number"),
        ("solve room.toml --patches 201", "patches must be 1 or more, and not more than elements"),
        ("solve room.toml --adaptive 0", "--adaptive 0.0: expected a fraction above 0"),
        ("solve room.toml --form-factors dice:6", "--form-factors dice:6: expected rays, hemicube, scanline"),
        ("solve room.toml --form-factors hemicube:33", "a hemi-cube has an even number of cells"),
        ("solve room.toml --solver magic", "--solver magic: expected bicgstab"),
        ("solve room.toml --light-samples 0", "--light-samples 0: expected a whole number from 1"),
        ("solve room.toml --illumination phong", "radiosity does not go with phong"),
        ("solve room.toml --sampling rbg", 'no spectral sampling "rbg"'),
        ("relight missing.solution --lamp desk=1", "missing.solution cannot be read: there is no such file"),
        ("relight room.solution", "Nothing to change: give --lamp"),
        ("relight room.solution --lamp desk", "--lamp desk: expected a name, = and its new value."),
        ("relight room.solution --lamp dask=1", "There is no lamp 'dask': did you mean \"desk\"?"),
        ("relight room.solution --lamp desk=-1", "lamp 'desk': a factor must be 0 or more"),
        ("relight room.solution --lamp desk=magic", "magic"),
        ("relight room.solution --paint whyte=0.5", "whyte"),
        ("relight room.solution --paint white=1.5", "reflectance"),
        ("show missing.solution", "missing.solution cannot be read: there is no such file"),
        ("show room.solution -o a.txt", "a.txt: expected a name that ends with .png, .exr, .glb or .csv."),
        ("show room.solution -o a.csv", "a.csv: illuminance needs places: give --grid or --sensors."),
        ("show room.solution -o a.png --grid 0,0,0:1,0,1:2x2", "go with an output that ends with .csv."),
        ("show room.solution -o a.csv --grid 0,0:1,1:2x2", "--grid 0,0: expected three numbers"),
        ("show room.solution -o a.csv --grid 0,0,0:1,0,1:2", "expected two corners and a number of points"),
        ("show room.solution -o a.csv --grid 0,0,0:1,0,1:0x2", "expected two corners and a number of points"),
        ("show room.solution -o a.csv --sensors missing.csv", "missing.csv cannot be read as a table"),
        ("show room.solution -o a.csv --sensors bad.csv", "bad.csv:3: expected numbers in the columns"),
        ("show room.solution -o a.csv --sensors empty.csv", "empty.csv holds no sensors."),
        ("show room.solution -o a.png --eye 1,2", "--eye 1,2: expected three numbers"),
        ("show room.solution -o a.png --size 0x0", "--size 0x0: expected width and height"),
        ("show room.solution -o a.png --samples 0", "--samples 0: expected a whole number from 1"),
        ("show room.solution -o a.png --gather magic", "--gather magic: expected none, direct or full."),
        ("show room.solution -o a.png --exposure nan", "a positive number"),
        ("show room.toml", "room.toml is no solution of illuminant."),
        ("show half.solution", "half.solution is no solution of illuminant."),
        ("show void.solution", "void.solution is no solution of illuminant."),
        ("show .", "cannot be read: it is a folder."),
    ],
)
def test_mistakes_are_one_sentence_and_nothing_is_written(
    solved: Path, inside: Command, text: str, sentence: str
) -> None:
    whole = (solved / "room.solution").read_bytes()
    (solved / "half.solution").write_bytes(whole[: len(whole) // 2])
    (solved / "void.solution").touch()
    (solved / "bad.csv").write_text("x,y,z\n0,0,0\n1,one,1\n")
    (solved / "empty.csv").write_text("x,y,z\n")
    before = sorted(solved.iterdir())
    done = inside(*words(text), cwd=solved)
    assert (done.returncode, done.stdout) == (2, ""), done.stderr
    assert done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1, done.stderr
    assert sentence in done.stderr
    assert len(done.stderr) < 400
    assert sorted(solved.iterdir()) == before
    assert (solved / "room.solution").read_bytes() == whole


def test_without_a_verb_there_is_help(inside: Command) -> None:
    done = inside("radiosity")
    assert all(verb in done.stdout + done.stderr for verb in ("solve", "relight", "show"))
