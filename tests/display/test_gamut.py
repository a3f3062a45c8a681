"""Gamut methods: the book's cases, what each method keeps, and the study that chose the default."""

import json
from pathlib import Path

import numpy as np
import pytest

from illuminant.display import displays, gamut, gamut_study
from illuminant.errors import UsageError

GOLDEN = json.loads((Path(__file__).parent.parent / "golden" / "clipping.json").read_text())
BOOK = {"CLR_clamp_rgb": "clamp", "CLR_scale_rgb": "scale", "CLR_clip_rgb": "constant-intensity"}


@pytest.mark.parametrize(
    ("function", "case"),
    [(one["function"], case) for one in GOLDEN["sets"] for case in one["cases"]],
    ids=lambda value: value["id"] if isinstance(value, dict) else "",
)
def test_the_books_clipping_comes_out(function: str, case: dict) -> None:
    found = gamut.bring_inside(case["in"]["rgb"], BOOK[function])
    np.testing.assert_allclose(found, case["out"]["rgb"], rtol=1e-9, atol=1e-12)


@pytest.fixture
def outside() -> np.ndarray:
    """Colours around the cube of sRGB, of luminance between 0 and 1."""
    colours = np.random.default_rng(5).uniform(-0.4, 1.5, (4000, 3))
    luminance = colours @ displays.named("sRGB").to_xyz_matrix[1]
    return colours[(gamut.classify(colours) > 0) & (luminance > 0.02) & (luminance < 0.98)]


def test_luminance_stays(outside: np.ndarray) -> None:
    weights = displays.named("sRGB").to_xyz_matrix[1]
    found = gamut.bring_inside(outside, "constant-luminance")
    np.testing.assert_allclose(found @ weights, outside @ weights, atol=1e-12)


def test_cook_moves_the_chromaticity_straight_to_white(outside: np.ndarray) -> None:
    srgb = displays.named("sRGB")
    real = (outside @ srgb.to_xyz_matrix.T > 0.01).all(axis=1)
    negative = outside[real & (outside.min(axis=1) < -1e-3)]

    def from_white(rgb: np.ndarray) -> np.ndarray:
        xyz = rgb @ srgb.to_xyz_matrix.T
        return xyz[:, :2] / xyz.sum(axis=1, keepdims=True) - np.array(srgb.white)

    asked, shown = from_white(negative), from_white(gamut.bring_inside(negative, "cook"))
    cross = asked[:, 0] * shown[:, 1] - asked[:, 1] * shown[:, 0]
    np.testing.assert_allclose(cross, 0.0, atol=1e-9)
    assert ((asked * shown).sum(axis=1) > 0).all()


@pytest.mark.parametrize("method", ["oklab", "oklab-adaptive"])
def test_hue_stays(outside: np.ndarray, method: str) -> None:
    found = gamut_study.measure(outside[None], method, displays.named("sRGB"))
    assert found.hue < 1e-3


def test_a_method_is_told_by_its_display() -> None:
    p3 = displays.named("Display P3")
    assert not np.allclose(
        gamut.bring_inside([1.2, -0.2, 0.4], "cook"), gamut.bring_inside([1.2, -0.2, 0.4], "cook", p3)
    )


def test_the_whole_image_is_scaled_by_its_brightest() -> None:
    found = gamut.bring_inside([[2.0, 1.0, 0.5], [0.5, 0.5, 0.5]], "scale-image")
    np.testing.assert_allclose(found, [[1.0, 0.5, 0.25], [0.25, 0.25, 0.25]])


def test_a_method_that_is_none_and_colours_that_are_none_are_refused() -> None:
    with pytest.raises(UsageError, match=r"There is no gamut method 'squash': known are clamp, "):
        gamut.bring_inside([0.5, 0.5, 0.5], "squash")
    with pytest.raises(UsageError, match="Colours are arrays"):
        gamut.bring_inside([0.5, 0.5], "clamp")


@pytest.fixture(scope="module")
def study() -> dict:
    return gamut_study.study(hues=24, steps=257)


def test_the_default_deviates_least(study: dict) -> None:
    def mean(name: str) -> float:
        return sum(one.mean for one in study[name].values()) / 3

    best = min(study, key=mean)
    assert best == gamut.DEFAULT, {name: mean(name) for name in study}
    # And it turns hues far less than clamping, in every set.
    for kind, one in study[gamut.DEFAULT].items():
        assert one.hue < 0.5 * study["clamp"][kind].hue


def test_the_book_is_right_about_clamping_and_scaling(study: dict) -> None:
    """Figure 5.10: clamping and scaling lie nearer in L*a*b* than desaturation; and both have kinks (5.1.3)."""
    for near in ("clamp", "scale"):
        assert study[near]["bright"].lab < study["constant-intensity"]["bright"].lab
        assert study[near]["bright"].kink > 5 * max(study["soft"]["bright"].kink, 1.0)


def test_only_compression_moves_what_is_inside(study: dict) -> None:
    for name, kinds in study.items():
        moved = max(one.inside for one in kinds.values())
        assert (moved > 0.01) == (name in ("soft", "scale-image")), name


def test_scaling_keeps_the_hue_of_what_is_too_bright(study: dict) -> None:
    assert study["scale"]["bright"].hue < 1e-6 < 1.0 < study["clamp"]["bright"].hue


def test_the_control_strip_is_right() -> None:
    rows = gamut_study.strips(["clamp"], hues=1, width=64, band=2)
    small = gamut_study.small_display()
    asked = gamut_study.gradients(small, displays.named("sRGB"), "bright", 1, 64)[0]
    shown = displays.named("sRGB").from_xyz(rows[0] * displays.named("sRGB").peak)
    assert gamut.classify(shown).max() == 0  # the outer display shows it all
    np.testing.assert_allclose(rows[0], asked @ small.to_xyz_matrix.T * 0.5, atol=1e-12)
    assert not np.allclose(rows[2], rows[0])
