"""Maps of illuminance against closed forms: a small lamp over a floor, by what floors send and by solutions."""

from types import SimpleNamespace

import numpy as np
import pytest

from illuminant import radiosity
from illuminant.viewer.composition import MODES, NO_NUMBER, compose
from illuminant.viewer.illuminance import BY_PAINT, BY_SOLUTION, maps, obstacle
from illuminant.viewer.reading import read
from illuminant.viewer.state import State

HEIGHT_M, INTENSITY_CD = 2.0, 100.0

FLOOR = f"""
[camera]
eye = [0.0, 3.0, 4.0]
target = [0.0, 0.0, 0.0]
field_of_view = 40.0
size = [40, 25]

[materials.paint]
kind = "diffuse"
reflectance = "Cornell/red"

[materials.gold]
kind = "conductor"
metal = "Au"
roughness = 0.3

[objects.floor]
material = "paint"
rectangle = {{ corners = [[-3, 0, 3], [3, 0, 3], [3, 0, 0], [-3, 0, 0]] }}

[objects.plate]
material = "gold"
rectangle = {{ corners = [[-3, 0, 0], [3, 0, 0], [3, 0, -3], [-3, 0, -3]] }}

[lights.lamp]
kind = "point"
position = [0.0, {HEIGHT_M}, 0.0]
spectrum = "FL11"
intensity_cd = {INTENSITY_CD}
"""


@pytest.fixture(scope="module")
def floor(tmp_path_factory):
    file = tmp_path_factory.mktemp("scene") / "floor.toml"
    file.write_text(FLOOR)
    return file


def expected(camera):
    """E = I cos θ / r² where the middle of each pixel meets the floor, lx, and where that is."""
    width, height = camera["size"]
    eye, target, up = (np.asarray(camera[key], float) for key in ("eye", "target", "up"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    above = np.cross(right, forward)
    half = np.tan(np.radians(camera["field_of_view_deg"]) / 2)
    u = half * (2 * (np.arange(width) + 0.5) / width - 1)
    v = half * height / width * (1 - 2 * (np.arange(height) + 0.5) / height)
    rays = forward + u[None, :, None] * right + v[:, None, None] * above
    places = eye - rays * (eye[1] / rays[..., 1:2])
    away = np.linalg.norm(places - [0.0, HEIGHT_M, 0.0], axis=2)
    return INTENSITY_CD * HEIGHT_M / away**3, places


def last(state, camera, solution=None):
    """The map on the grid of 40 by 25."""
    return next(maps(state, camera, solution, lambda: True))


@pytest.mark.parametrize("technique", ["path", "distributed", "raytrace"])
def test_a_matt_floor_tells_the_light_of_a_lamp(floor, technique):
    state = State.of(floor, technique=technique, illumination="general")
    camera = state.scene.description["camera"]
    lux, (wanted, places) = last(state, camera), expected(camera)
    assert lux.shape == (25, 40)
    inside = (np.abs(places[..., 0]) < 2.8) & (places[..., 2] > 0.1) & (places[..., 2] < 2.8)
    assert inside.sum() > 100
    ambient = 0.0
    if technique != "path":
        # Their ambient light arrives everywhere alike.
        ambient = np.median(lux[inside] - wanted[inside])
        assert ambient >= 0.0
    assert lux[inside] == pytest.approx(wanted[inside] + ambient, rel=0.02)
    gold = (np.abs(places[..., 0]) < 2.8) & (places[..., 2] < -0.1) & (places[..., 2] > -2.8)
    assert gold.sum() > 50
    assert np.isnan(lux[gold]).all(), "gold sends what it mirrors, which says nothing of illuminance"


@pytest.mark.parametrize("technique", ["radiosity", "hybrid"])
def test_a_solution_tells_the_light_of_a_lamp_on_whatever_is_seen(floor, technique):
    state = State.of(floor, technique=technique, illumination="general")
    if technique == "radiosity":
        paint = state.tables["materials"]["paint"]
        state = state.with_tables(materials={"gold": paint})
    found = radiosity.solve(
        state.scene,
        technique=technique,
        illumination="general",
        sampling=state.sampling,
        elements=300,
        form_factors="rays:16",
        light_samples=4,
    )
    camera = state.scene.description["camera"]
    lux, (wanted, places) = last(state, camera, found), expected(camera)
    inside = (np.abs(places[..., 0]) < 2.8) & (np.abs(places[..., 2]) < 2.8)
    assert inside.sum() > 200
    # The point of a cell is anywhere in its pixel.
    error = np.abs(lux[inside] / wanted[inside] - 1)
    assert np.median(error) < 0.02
    assert error.max() < 0.12


def test_the_map_says_what_a_click_says(repository):
    state = State.of(repository / "scenes" / "cornell.toml")
    camera = dict(state.scene.description["camera"]) | {"size": [40, 25]}
    lux = last(state, camera)
    for pixel in ((4, 12), (19, 8), (36, 12)):  # the walls at the left, behind and at the right
        clicked = read(state, camera, pixel).illuminance
        assert clicked is not None
        assert lux[pixel[1], pixel[0]] == pytest.approx(clicked, rel=0.15), pixel


def test_grids_become_finer_and_end_at_once_when_they_are_not_wanted(repository):
    state = State.of(repository / "scenes" / "cornell.toml")
    camera = dict(state.scene.description["camera"]) | {"size": [60, 40]}
    sizes = [lux.shape for lux in maps(state, camera, None, lambda: True)]
    assert sizes[-1] == (40, 60)
    assert len(sizes) == 2
    assert list(maps(state, camera, None, lambda: False)) == []
    asked = iter([True] * 30)
    assert list(maps(state, camera, None, lambda: next(asked, False))) == []


def test_every_technique_has_a_map_or_says_why_not():
    from illuminant.comparison import pairs

    for pair in pairs():
        sentence = obstacle(SimpleNamespace(technique=pair.technique, illumination=pair.illumination))
        known = pair.technique in BY_SOLUTION or (
            pair.technique in BY_PAINT and pair.illumination == "general"
        )
        assert (sentence == "") == known
        assert known or sentence.startswith(pair.technique)


def test_a_map_has_a_scale_in_lux_and_grey_where_there_is_no_number(repository):
    state = State.of(repository / "scenes" / "cornell.toml")
    lux = np.full((10, 10), 100.0)
    lux[0, 0], lux[0, 1] = np.nan, 1e5
    made = compose(np.zeros((2, 2, 3)), state, MODES[3], lux=lux)
    assert made.codes.shape == (10, 10, 3)
    assert tuple(made.codes[0, 0]) == NO_NUMBER
    assert made.title.startswith("illuminance, lx; lightest: > ")
    plain = compose(np.zeros((2, 2, 3)), state, MODES[3], lux=np.full((3, 3), 200.0))
    assert (plain.scale, plain.title) == (pytest.approx((0.2, 200.0)), "illuminance, lx")
