"""Materials in words, finishes, and what the scene file makes of them."""

import numpy as np
import pytest

from illuminant import finishes, materials
from illuminant.errors import DataError, SceneError
from illuminant.scene import Scene


def scene_of(table: dict) -> Scene:
    return Scene.build(
        camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [16, 16]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": "m"}},
        materials={"m": table},
        lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0}},
    )


def entry(table: dict) -> dict:
    return scene_of(table).description["materials"][0]["surface"]


def test_the_heights_of_table_2_1() -> None:
    assert finishes.finish("fine grind", "aluminium").sigma_nm == (pytest.approx(76.2), pytest.approx(228.6))
    assert finishes.finish("side mill").sigma_nm == (762.0, 1143.0)
    along, across = finishes.finish("coarse grind").correlation_nm
    assert along == pytest.approx(2 * 381.0 / 0.08)
    assert across == pytest.approx(2 * 711.2 / 0.25)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("copper, circular mill", "conductor"),
        ("Gold, polished, σ = 5 nm", "conductor"),
        ("stainless steel, fine grind", "conductor"),
        ("silver, sandblasted, m = 0.4", "conductor"),
        ("crown glass, ground", "dielectric"),
        ("water", "dielectric"),
        ("red paint, gloss", "coated"),
        ("ColorChecker/blue sky plastic, matte", "coated"),
        ("copper, satin, lacquered", "coated"),
        ("blue metal flake", "coated"),
        ("white glaze, gloss, m = 0.05", "coated"),
    ],
)
def test_words_become_materials(text: str, kind: str) -> None:
    assert materials.find(text)["kind"] == kind
    assert entry({"kind": "named", "name": text})["kind"] == kind


def test_numbers_replace_a_part_of_the_finish() -> None:
    finish = entry({"kind": "named", "name": "gold, polished, σ = 12 nm"})["finish"]
    assert finish == {"slope": [0.02, 0.02], "sigma_nm": 12.0, "shape": "beckmann", "grain": None}
    finish = entry({"kind": "named", "name": "copper, circular mill, m = 0.3"})["finish"]
    assert finish["slope"] == [0.3, 0.3]
    assert finish["sigma_nm"] == 1016.0


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("goldd", 'did you mean "gold"'),
        ("", "names no material"),
        ("copper, shiny", "is no finish"),
        ("copper, satin, matte", "names two finishes"),
        ("copper, m = 2", "between 0 and 1"),
        ("copper, σ = 5", "needs its unit"),
        ("mauve paint", "is no colour of paint"),
        ("red paint, lacquered", "only metals are lacquered"),
    ],
)
def test_words_that_are_not_understood(text: str, says: str) -> None:
    with pytest.raises(DataError, match=says):
        materials.find(text)
    with pytest.raises(SceneError, match=says):
        scene_of({"kind": "named", "name": text})


@pytest.mark.parametrize(
    ("table", "says"),
    [
        (
            {"kind": "conductor", "metal": "gold", "finish": "satin", "roughness": 0.2},
            "finish brings its own",
        ),
        ({"kind": "conductor", "metal": "gold", "finish": "satinn"}, "satin"),
        ({"kind": "conductor", "metal": "gold", "sigma_nm": -1.0}, "sigma_nm"),
        ({"kind": "coated"}, "pigment, reflectance or metal is missing"),
        ({"kind": "coated", "pigment": 0.5, "reflectance": 0.5}, "is given twice"),
        ({"kind": "coated", "pigment": 0.5, "coverage": 0.5}, "goes with metal"),
        ({"kind": "coated", "pigment": 0.5, "thickness": 0.1}, "absorption is missing"),
        ({"kind": "coated", "pigment": 1.5}, "pigment"),
        ({"kind": "coated", "pigment": 0.5, "medium": "water", "n": 1.5}, "is given twice"),
    ],
)
def test_mistakes_of_materials_are_told(table: dict, says: str) -> None:
    with pytest.raises(SceneError, match=says):
        scene_of(table)


def test_a_measured_paint_has_that_reflectance() -> None:
    from illuminant import audit

    found = audit({"kind": "coated", "reflectance": 0.4}, angles_deg=[0.0], wavelengths_nm=[550.0])[0]
    reflected = found.coherent_reflection + found.scattered_reflection
    assert reflected[0, 0] == pytest.approx(0.4, abs=2e-3)


def test_a_scene_with_layers_can_be_written_and_read(tmp_path) -> None:
    scene = scene_of({"kind": "coated", "pigment": 0.3, "metal": "copper", "coverage": 0.5})
    assert Scene.from_bytes(scene.to_bytes()).hash() == scene.hash()


def test_a_grain_turns_the_highlight() -> None:
    """A brushed ball: turning its grain by 90 degrees swaps the long and the short side of the highlight."""
    import illuminant

    def spread(grain: list[float]) -> tuple[float, float]:
        scene = Scene.build(
            camera={"eye": [0, 0, 6], "target": [0, 0, 0], "field_of_view": 20, "size": [48, 48]},
            objects={"ball": {"sphere": {"radius": 1.0}, "material": "m"}},
            materials={"m": {"kind": "conductor", "metal": "silver", "finish": "brushed", "grain": grain}},
            lights={
                "lamp": {
                    "kind": "directional",
                    "direction": [0, 0, -1],
                    "spectrum": "D65",
                    "illuminance_lx": 1e3,
                }
            },
        )
        y = illuminant.render(scene, samples=16, sampling="uniform:4").xyz[..., 1]
        rows, columns = np.indices(y.shape) - 23.5
        return float((y * rows**2).sum() / y.sum()), float((y * columns**2).sum() / y.sum())

    high, wide = spread([1.0, 0.0, 0.0])
    turned_high, turned_wide = spread([0.0, 1.0, 0.0])
    assert high > 2 * wide
    assert turned_high == pytest.approx(wide, rel=0.1)
    assert turned_wide == pytest.approx(high, rel=0.1)
