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


def test_a_value_outside_the_usual_range_widens_it():
    (_, kind, (low, high, _), value), *_ = choices_of({"kind": "dielectric", "n": 0.2})
    assert (kind, low, high, value) == ("number", 0.2, 4.0, 0.2)


@pytest.mark.parametrize(
    "choice",
    [
        {"technique": "pathh"},
        {"illumination": "lambert"},
        {"technique": "radiosity", "illumination": "phong"},
    ],
)
def test_a_choice_that_cannot_be_is_refused_at_once(repository, choice):
    with pytest.raises(UsageError):
        State.of(repository / "scenes" / "cornell.toml", **choice)


def test_a_camera_with_a_lens_can_be_turned(repository):
    from illuminant.viewer.camera import scene_camera

    state = State.of(repository / "scenes" / "crystal-ball.toml")
    own = state.scene.description["camera"]
    turned = scene_camera(own, [1, 0, 0, 0], [0.0, 1.0, 2.0], 0.8, (64, 48), 2.0)
    found = state.scene.replace(camera=turned)
    assert found.description["camera"]["lens"] == own["lens"]
    assert found.description["camera"]["shutter"] == own["shutter"]
    again = found.replace(camera={"size": [32, 24]}).description["camera"]
    assert again["lens"]["radius"] == pytest.approx(own["lens"]["radius"])
    assert found.core() is not None


def test_a_turned_camera_keeps_its_shutter_without_a_lens(repository):
    scene = load(repository / "scenes" / "cornell.toml").replace(camera={"shutter": [0.0, 0.5]})
    turned = scene.replace(camera=dict(scene.description["camera"]))
    assert turned.description["camera"]["shutter"] == [0.0, 0.5]
    assert turned.replace(camera={"size": [8, 8]}).description["camera"]["shutter"] == [0.0, 0.5]


def test_names_of_materials_are_no_files(repository, tmp_path):
    from illuminant.viewer.tables import relocate

    (tmp_path / "white").write_text("")
    (tmp_path / "white.csv").write_text("")
    tables = {"objects": [{"material": "white", "name": "white.csv"}], "reflectance": "white.csv"}
    relocate(tables, tmp_path, lambda file: file.with_name("moved.csv"))
    assert tables["objects"][0]["material"] == "white"
    assert tables["reflectance"].endswith("moved.csv")


def test_a_scene_that_is_no_file_has_no_tables(repository):
    assert State.of(load(repository / "scenes" / "cornell.toml")).tables == {}
