"""Appendix II of the book: curves, multipliers, rules of thumb."""

import math

import pytest

from illuminant import appearance, optics, spectra
from illuminant.errors import DataError
from illuminant.scene import Scene


def test_twenty_spheres_from_sharp_to_matte() -> None:
    spheres = appearance.COPPER_SPHERES
    assert len(spheres) == 20
    for row in (spheres[:10], spheres[10:]):
        assert [s["exponent"] for s in row] == sorted((s["exponent"] for s in row), reverse=True)
        assert [s["specular"] for s in row] == sorted((s["specular"] for s in row), reverse=True)
        assert [s["diffuse"] for s in row] == sorted(s["diffuse"] for s in row)


def test_specular_and_diffuse_energy_are_all() -> None:
    last = 1.0
    for degrees in (2, 10, 20, 40, 60, 80):
        specular, diffuse = appearance.energies(math.radians(degrees))
        assert specular + diffuse == pytest.approx(1.0)
        assert specular <= last + 1e-9
        last = specular


def test_the_integral_is_that_of_the_golden_case() -> None:
    # integrate-11: m² = 0.25 with Torrance and Sparrow at normal incidence.
    beta = float(optics.lobe_half_angle("cook", 0.25))
    assert optics.lobe_coefficient("cook", beta) == pytest.approx(0.25, rel=1e-6)
    assert appearance.energies(beta)[0] == pytest.approx(0.8924, abs=0.01)


@pytest.mark.parametrize("character", appearance.CHARACTERS)
@pytest.mark.parametrize("finish", ["mirror", "satin", "matte", 0.3])
def test_what_is_proposed_keeps_the_rules(character: str, finish: str | float) -> None:
    assert appearance.advise(appearance.propose(character, finish)) == []


def test_curves_of_homogeneous_and_composite_materials() -> None:
    copper = spectra.load("book/copper")
    metal = appearance.coefficients(copper, "metal", energy=True)
    assert metal.specular == copper
    assert metal.diffuse.values[3] == pytest.approx(copper.values[3] / math.pi)
    assert metal.n == 1.0
    assert optics.normal_reflectance(1.0, metal.k) == pytest.approx(
        float(copper.at(list(range(380, 781))).mean())
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda: appearance.propose("wood", "satin"),
        lambda: appearance.propose("metal", "shiny"),
        lambda: appearance.propose("metal", 2.0),
        lambda: appearance.coefficients(spectra.load("book/copper"), "wood"),
        lambda: appearance.average_index(spectra.load("A"), metal=True),
    ],
    ids=["character", "finish", "angle", "composite", "light"],
)
def test_mistakes_are_told(call: object) -> None:
    with pytest.raises(DataError):
        call()  # type: ignore[operator]


@pytest.mark.parametrize("kind", list(appearance.PRESETS))
@pytest.mark.parametrize("finish", ["gloss", "satin", "matte"])
def test_presets_keep_the_rules_and_are_materials(kind: str, finish: str) -> None:
    table = appearance.preset(kind, finish=finish)
    told = table["coefficients"]["all"]
    assert told["ambient"] == told["diffuse"]
    assert told["diffuse"] + told["specular"] == pytest.approx(1.0, abs=1e-3)
    scene = Scene.build(
        camera={"eye": [0, 0, 3], "target": [0, 0, 0]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": "m"}},
        materials={"m": table},
        lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0}},
    )
    entry = scene.description["materials"][0]
    assert entry["coefficients"] == [told]
    assert entry["surface"]["kind"] == {"dielectric": "dielectric", "metal": "conductor"}.get(kind, "coated")


def test_a_preset_of_another_kind_is_refused() -> None:
    with pytest.raises(DataError, match="is no metal"):
        appearance.preset("metal", "red paint")
    with pytest.raises(DataError, match="a preset is one of"):
        appearance.preset("wood")
