"""Lamps and materials change as a scene file would have them."""

import pytest

from illuminant.errors import UsageError
from illuminant.scene import load
from illuminant.viewer.state import State, choices
from illuminant.viewer.tables import choices_of, lamps, relit, repainted


@pytest.fixture(scope="module")
def demo(repository):
    return State.of(repository / "scenes" / "demo.toml")


def test_the_lamps_of_a_scene_are_found(demo):
    assert [name for _, name, _ in lamps(demo.tables)]
    assert {kind for kind, *_ in lamps(demo.tables)} <= {"materials", "lights"}


def test_twice_the_power_is_twice_the_light(demo):
    kind, name, table = lamps(demo.tables)[0]
    brighter = demo.with_tables(**{kind: {name: relit(table, 2.0)}})
    assert brighter.scene.hash() != demo.scene.hash()
    assert brighter.with_tables(**{kind: {name: table}}).scene.hash() == demo.scene.hash()


def test_a_lamp_without_a_quantity_cannot_be_dimmed():
    with pytest.raises(UsageError, match="no quantity"):
        relit({"kind": "sky"}, 0.5)


def test_every_material_of_every_scene_takes_every_choice(repository):
    for path in sorted((repository / "scenes").glob("*.toml")):
        state = State.of(path)
        for name, table in state.tables.get("materials", {}).items():
            for key, kind, values, value in choices_of(table):
                assert value in values if kind == "choice" else values[0] <= value <= values[1], (
                    path,
                    name,
                    key,
                )
                other = values[-1] if kind == "choice" else values[0]
                changed = state.with_tables(materials={name: repainted(table, key, other)})
                assert changed.tables["materials"][name] != table or other == value


def test_a_finish_and_a_roughness_take_each_other_s_place():
    metal = {"kind": "conductor", "metal": "gold", "roughness": 0.2, "sigma_nm": 100.0}
    satin = repainted(metal, "finish", "satin")
    assert satin == {"kind": "conductor", "metal": "gold", "finish": "satin"}
    assert "finish" not in repainted(satin, "finish", "as its roughness")


def test_what_is_offered_renders_and_what_is_refused_has_a_reason():
    for technique in ("path", "radiosity", "phong"):
        sensible, refused = choices(technique)
        assert sensible
        assert all(refused.values())


def test_a_scene_that_is_no_file_has_no_tables(repository):
    scene = load(repository / "scenes" / "cornell.toml")
    scene.path = None
    assert State.of(scene).tables == {}
