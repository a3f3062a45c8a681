"""The numeric cases of the book's colour library (tests/golden/color.json), each set through the public functions."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from illuminant import color
from illuminant.errors import UsageError

GOLDEN = Path(__file__).resolve().parent.parent / "golden"
SETS = {found["function"]: found for found in json.loads((GOLDEN / "color.json").read_text())["sets"]}


def cases(function: str) -> Any:
    """The cases of a set, as parameters."""
    return pytest.mark.parametrize("case", SETS[function]["cases"], ids=lambda case: str(case["id"]))


def close(function: str, found: Any, wanted: Any) -> None:
    """Agree within the tolerance that the set states."""
    tolerance = SETS[function]["tolerance"]
    np.testing.assert_allclose(found, wanted, rtol=tolerance["rel"], atol=tolerance["abs"])


@pytest.fixture(scope="module")
def observer() -> tuple[np.ndarray, np.ndarray]:
    """The book's 5 nm observer, corrected."""
    table = np.loadtxt(GOLDEN / "book_observer.csv", delimiter=",", comments=["#", "wavelength"])
    assert table.shape == (81, 4)
    return table[:, 0], table[:, 1:]


def curve(about: dict[str, Any], grid: np.ndarray) -> np.ndarray:
    """The curve of a case at each nm."""
    kind = about["type"]
    if kind == "flat":
        return np.full(grid.shape, about["value"])
    if kind == "ramp":
        return np.asarray(about["a"] + about["b"] * (grid - 380.0) / 400.0)
    if kind == "gaussian":
        return np.asarray(about["scale"] * np.exp(-(((grid - about["center"]) / about["width"]) ** 2)))
    if kind == "box":
        return ((grid >= about["from"]) & (grid <= about["to"])).astype(float)
    if kind == "line":
        return np.where(grid == about["at"], about["value"], 0.0)
    assert kind == "points"
    return np.interp(grid, *np.transpose(about["points"]))


def sampled(case: dict[str, Any], observer: Any) -> np.ndarray:
    """XYZ of the curve of a case."""
    ends = case["in"]["min_wl"], case["in"]["max_wl"]
    grid = np.arange(ends[0], ends[1] + 1, dtype=float)
    return color.spectra_to_xyz(curve(case["in"]["curve"], grid), grid, observer=observer, range_nm=ends)


def monitor(chromaticities: list[list[float]]) -> color.RgbSystem:
    return color.monitor(chromaticities[:3], chromaticities[3])


def test_the_areas_of_the_table_are_those_of_the_errata(observer):
    grid = np.arange(380, 781.0)
    sums = color.spectra_to_xyz(np.ones(401), grid, observer=observer, scale="absolute") / 683
    np.testing.assert_allclose(sums, [106.854, 106.856, 106.845], atol=6e-4)


@cases("CLR_spect_to_xyz")
def test_spectrum_to_xyz(case, observer):
    close("CLR_spect_to_xyz", sampled(case, observer), case["out"]["xyz"])


@cases("CLR_spect_to_rgb")
def test_spectrum_to_rgb(case, observer):
    rgb = color.xyz_to_rgb(sampled(case, observer), monitor(case["in"]["primaries"]))
    close("CLR_spect_to_rgb", rgb, case["out"]["rgb"])


MATRICES = "CLR_get_rgb_xyz / CLR_get_xyz_rgb"


@cases(MATRICES)
def test_matrices(case):
    if case["out"]["rgb_to_xyz"] is None:
        with pytest.raises(UsageError, match="make no RGB system"):
            monitor(case["in"]["primaries"])
        return
    system = monitor(case["in"]["primaries"])
    close(MATRICES, system.to_xyz, case["out"]["rgb_to_xyz"])
    close(MATRICES, system.from_xyz, case["out"]["xyz_to_rgb"])


@cases("CLR_rgb_to_aux_rgb")
def test_monitor_to_monitor(case):
    systems = monitor(case["in"]["primaries"]), monitor(case["in"]["aux_primaries"])
    close("CLR_rgb_to_aux_rgb", color.rgb_to_rgb_matrix(*systems), case["out"]["to"])
    close("CLR_rgb_to_aux_rgb", color.rgb_to_rgb_matrix(*systems[::-1]), case["out"]["from"])


YIQ = "CLR_get_rgb_yiq / CLR_get_yiq_rgb"


@cases(YIQ)
def test_yiq(case):
    rgb = case["in"]["rgb"]
    close(YIQ, color.rgb_to_yiq(rgb), case["out"]["yiq"])
    close(YIQ, color.yiq_to_rgb(color.rgb_to_yiq(rgb), matrix="book"), case["out"]["rgb_back"])
    close(YIQ, color.monochrome(rgb), case["out"]["monochrome"])


@cases("CLR_xyz_to_lab")
def test_lab_of_the_book(case):
    lab = color.xyz_to_lab(case["in"]["xyz"], case["in"]["white_xy"], form="book")
    close("CLR_xyz_to_lab", lab, case["out"]["lab"])


@cases("CLR_xyz_to_luv")
def test_luv_of_the_book(case):
    luv = color.xyz_to_luv(case["in"]["xyz"], case["in"]["white_xy"], form="book")
    close("CLR_xyz_to_luv", luv, case["out"]["luv"])


def test_the_mirror_of_the_book_is_no_white_in_rgb(observer):
    """R3.29: a spectrum of 1 in RGB of NTSC with D6500 is (1.12, 0.96, 0.92)."""
    rgb = color.xyz_to_rgb(color.spectra_to_xyz(np.ones(81), observer[0], observer=observer), "book NTSC")
    np.testing.assert_allclose(rgb, [1.12, 0.96, 0.92], atol=5e-3)
