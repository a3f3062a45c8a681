"""A real room beside its image: radiometry, the sheet, and what answers say (book 4.4.2)."""

import math
from pathlib import Path

import numpy as np
import pytest

from illuminant import Image, Scene, radiosity
from illuminant.errors import DataError, UsageError
from illuminant.real_and_synthetic import judge, radiometry, sheet, trials
from illuminant.sensor_file import read


def test_measurements_of_a_known_lamp_are_met(tmp_path: Path) -> None:
    scene = Scene.build(
        camera={"eye": [0, 1, 3], "target": [0, 0, 0]},
        materials={"black": {"kind": "diffuse", "reflectance": 0.0}},
        objects={
            "floor": {
                "rectangle": {"corners": [[-2, 0, -2], [-2, 0, 2], [2, 0, 2], [2, 0, -2]]},
                "material": "black",
            }
        },
        lights={"lamp": {"kind": "point", "position": [0, 2, 0], "spectrum": "E", "intensity_cd": 100.0}},
    )
    solution = radiosity.solve(scene, elements=50, sampling="uniform:8")
    places = [[0.0, 0.01, 0.0], [1.0, 0.01, 0.0], [1.0, 0.01, 1.5]]
    lux = [100.0 * 1.99 / (x * x + z * z + 1.99**2) ** 1.5 for x, _, z in places]
    table = tmp_path / "meter.csv"
    lines = [f"{x},{y},{z},0,1,0,{e}" for (x, y, z), e in zip(places, lux, strict=True)]
    table.write_text("x,y,z,nx,ny,nz,illuminance_lx\n" + "\n".join(lines) + "\n")
    meter = read(table, measured=True)
    found = radiometry(solution, meter.points, meter.normals, meter.illuminance_lx)
    # Eight samples are not quite the observer's curve.
    assert found.largest < 0.02, found.errors
    table.write_text("x,y,z,nx,ny,nz,illuminance_lx\n0,0,0,0,1,0,dark\n")
    with pytest.raises(DataError, match=r"meter\.csv:2"):
        read(table, measured=True)


def test_the_sheet_shows_both_and_names_neither(tmp_path: Path) -> None:
    bright, dark = Image(np.full((24, 32, 3), 80.0)), Image(np.full((24, 32, 3), 20.0))
    values = {}
    for side in ("left", "right"):
        sheet(bright, dark, side, tmp_path / f"{side}.png", exposure=0.01)
        import OpenImageIO as oiio

        pixels = oiio.ImageBuf(str(tmp_path / f"{side}.png")).get_pixels(oiio.UINT8)
        values[side] = (int(pixels[20, 12, 1]), int(pixels[20, 60, 1]))
    assert values["left"] == values["right"][::-1] and values["left"][0] > values["left"][1]
    with pytest.raises(UsageError, match="differ in size"):
        sheet(bright, Image(np.zeros((2, 2, 3))), "left", tmp_path / "x.png", exposure=0.01)


def test_answers_are_judged_by_the_binomial_law() -> None:
    assert sorted(trials(10, seed=3)) == ["left"] * 5 + ["right"] * 5
    assert trials(10, seed=3) == trials(10, seed=3) != trials(10, seed=4)
    # Nine or more of ten, or one or fewer: 22 of 1024 outcomes.
    assert judge(right=9, total=10).p_value == pytest.approx(22 / 1024)
    low, high = judge(right=5, total=10).interval
    assert low + high == pytest.approx(1.0) and 0.23 < low < 0.24
    assert math.isclose(judge(right=10, total=20).p_value, 1.0)
    with pytest.raises(UsageError):
        trials(3)
