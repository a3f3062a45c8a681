"""Light whose intensity depends on direction: irradiance in closed form, and flux that stays what is stated."""

import numpy as np
import pytest

import illuminant
from illuminant.errors import SceneError
from illuminant.scene import Scene

HEIGHT = 2.0


def floor_under(light: dict | None = None, emitter: dict | None = None, size: float = 0.02) -> float:
    """Luminance of a white floor straight below a lamp, in cd/m²: E/π."""
    objects = {
        "floor": {
            "rectangle": {"corner": [-1, 0, 1], "edges": [[2, 0, 0], [0, 0, -2]]},
            "material": "white",
        }
    }
    materials = {"white": {"kind": "diffuse", "reflectance": 1.0}}
    if emitter is not None:
        materials["lamp"] = {"kind": "emitter", "spectrum": "E", **emitter}
        objects["lamp"] = {
            "rectangle": {"corner": [-size / 2, HEIGHT, -size / 2], "edges": [[size, 0, 0], [0, 0, size]]},
            "material": "lamp",
        }
    scene = Scene.build(
        camera={"eye": [0, 0.5, 0.3], "target": [0, 0, 0], "field_of_view": 1.0, "size": [4, 4]},
        objects=objects,
        materials=materials,
        lights={} if light is None else {"lamp": {"spectrum": "E", "position": [0, HEIGHT, 0], **light}},
    )
    return float(illuminant.render(scene, samples=256, depth=2, sampling="uniform:4").xyz[..., 1].mean())


@pytest.mark.parametrize("power", [0.0, 1.0, 3.0, 20.0])
def test_a_small_surface_with_a_power_of_the_cosine(power: float) -> None:
    # I(0) = Φ (p + 1)/2π, E = I/h², L = E/π.
    found = floor_under(emitter={"flux_lm": 1000.0, "cosine_power": power})
    assert found == pytest.approx(1000 * (power + 1) / (2 * np.pi) / HEIGHT**2 / np.pi, rel=0.02)


def test_a_table_that_is_lambertian_is_a_diffuse_lamp() -> None:
    angles = np.arange(0, 91, 5.0)
    table = [[float(a), float(max(0.0, np.cos(np.radians(a))))] for a in angles]
    by_table = floor_under(emitter={"flux_lm": 1000.0, "distribution": table})
    assert by_table == pytest.approx(floor_under(emitter={"flux_lm": 1000.0}), rel=0.02)


def test_a_luminaire_shines_along_its_axis() -> None:
    table = [[0.0, 300.0], [30.0, 300.0], [30.1, 0.0], [180.0, 0.0]]
    solid_angle = 2 * np.pi * (1 - np.cos(np.radians(30.0)))
    down = floor_under({"kind": "point", "flux_lm": 500.0, "distribution": table})
    assert down == pytest.approx(500 / solid_angle / HEIGHT**2 / np.pi, rel=0.02)
    assert floor_under({"kind": "point", "flux_lm": 500.0, "distribution": table, "axis": [0, 1, 0]}) == 0.0
    stated = floor_under({"kind": "point", "intensity_cd": 40.0, "distribution": table})
    assert stated == pytest.approx(40 / HEIGHT**2 / np.pi, rel=0.01)


@pytest.mark.parametrize(
    ("light", "says"),
    [
        ({"distribution": [[10.0, 1.0], [20.0, 1.0]]}, "grow from 0"),
        ({"distribution": [[0.0, 1.0], [0.0, 1.0]]}, "grow from 0"),
        ({"distribution": [[0.0, -1.0], [90.0, 1.0]]}, "not negative"),
        ({"distribution": [[0.0, 0.0], [90.0, 0.0]]}, "one above 0"),
        ({"cosine_power": 2.0, "distribution": [[0.0, 1.0], [90.0, 1.0]]}, "is given twice"),
        ({"cosine_power": -1.0}, "cosine_power"),
        ({"cosine_power": 1.0, "axis": [0, 0, 0]}, "must have a length"),
    ],
)
def test_mistakes_of_distributions_are_told(light: dict, says: str) -> None:
    with pytest.raises(SceneError, match=says):
        floor_under({"kind": "point", "flux_lm": 500.0, **light})
