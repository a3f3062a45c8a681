"""Radiosity with mirrors, glass and gloss: `hybrid`, which follows rays, and `specular-radiosity`, which solves."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant import radiosity
from illuminant.errors import MachineError, UsageError
from illuminant.scene import Scene

MATERIALS = {
    "white": {"kind": "diffuse", "reflectance": 0.7},
    "red": {"kind": "diffuse", "reflectance": "Cornell/red"},
    "yellow": {"kind": "diffuse", "reflectance": "ColorChecker/yellow"},
    "black": {"kind": "diffuse", "reflectance": 0.0},
    "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 5000.0},
    "mirror": {"kind": "conductor", "metal": "Ag"},
    "satin": {"kind": "conductor", "metal": "Al", "roughness": 0.3},
    "paper": {"kind": "translucent", "reflectance": 0.5, "transmittance": 0.35},
    "glass": {"kind": "dielectric", "n": 1.5, "dispersion": False},
    "grey": {"kind": "filter", "transmittance": 0.5},
}
ELEMENTS = {"elements": 2500, "form_factors": "rays:256"}


def rectangle(material, corner, *edges):
    return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}


MIRROR = {"mirror": rectangle("mirror", [1.98, 0.3, 0.4], [0, 0, 1.2], [0, 1.2, 0])}
PANEL = {"panel": rectangle("paper", [0.3, 0.2, 0.9], [0.8, 0, -0.3], [0, 1.0, 0])}
BALL = {"ball": {"sphere": {"center": [1, 0.6, 0.7], "radius": 0.45}, "material": "glass"}}
FILTER = {"filter": rectangle("grey", [0.4, 1.0, 0.2], [0, 0, 1.2], [1.2, 0, 0])}


def room(*more, floor="white", size=(48, 48)):
    """A room with a square lamp below its ceiling; things in it may be given."""
    objects = {
        "floor": rectangle(floor, [0, 0, 0], [0, 0, 2], [2, 0, 0]),
        "ceiling": rectangle("white", [0, 2, 0], [2, 0, 0], [0, 0, 2]),
        "back": rectangle("white", [0, 0, 0], [2, 0, 0], [0, 2, 0]),
        "left": rectangle("red", [0, 0, 0], [0, 2, 0], [0, 0, 2]),
        "right": rectangle("white", [2, 0, 0], [0, 0, 2], [0, 2, 0]),
        "front": rectangle("white", [0, 0, 2], [0, 2, 0], [2, 0, 0]),
        "lamp": rectangle("lamp", [0.6, 1.75, 0.6], [0.8, 0, 0], [0, 0, 0.8]),
    }
    for things in more:
        objects |= things
    return Scene.build(
        camera={"eye": [1, 1, 1.95], "target": [1, 0.8, 0], "field_of_view": 80, "size": list(size)},
        objects=objects,
        materials=MATERIALS,
    )


def render(scene, samples=64, **options):
    return illuminant.render(scene, samples=samples, **{"sampling": "uniform:8"} | options)


def hybrid(scene, samples=64, **options):
    return render(scene, samples, technique="hybrid", **ELEMENTS | options)


def mean(image):
    return np.asarray(image.xyz, float).mean(axis=(0, 1))


def blocks(image, size=8):
    luminance = np.asarray(image.xyz, float)[..., 1]
    h, w = luminance.shape
    return luminance.reshape(h // size, size, w // size, size).mean(axis=(1, 3))


@pytest.fixture(scope="module")
def mirrors():
    """A room with a mirror and a translucent panel, and what path finds of it."""
    scene = room(MIRROR, PANEL)
    return scene, render(scene, 1024)


# Against path


def test_a_room_with_a_mirror_and_a_sheet_is_that_of_path(mirrors):
    scene, path = mirrors
    found = hybrid(scene)
    np.testing.assert_allclose(mean(found), mean(path), rtol=0.03)
    apart = np.abs(blocks(found) - blocks(path)).max() / blocks(path).mean()
    assert apart < 0.08, apart
    apart = np.abs(blocks(found) - blocks(path)).mean() / blocks(path).mean()
    assert apart < 0.025, apart


def test_a_final_gather_is_nearer_to_path(mirrors):
    scene, path = mirrors
    found = hybrid(scene, 256, gather="full")
    np.testing.assert_allclose(mean(found), mean(path), rtol=0.02)
    assert np.abs(blocks(found) - blocks(path)).max() < 0.05 * blocks(path).mean()


@pytest.mark.parametrize("gather", ["none", "full"])
@pytest.mark.parametrize("thing", [BALL, FILTER], ids=["glass ball", "filter"])
def test_light_through_glass_is_that_of_path(thing, gather):
    scene = room(thing, size=(32, 32))
    # Light that the ball gathers is found by chance.
    path, found = render(scene, 512), hybrid(scene, 64, gather=gather, form_factors="rays:512")
    np.testing.assert_allclose(mean(found), mean(path), rtol=0.02)
    assert np.abs(blocks(found) - blocks(path)).mean() < 0.04 * blocks(path).mean()


def test_a_mirror_beside_a_wall_brightens_it():
    """Light that a mirror sends on to diffuse surfaces, R4.72: path finds as much more of it."""
    camera = {"eye": [1.9, 1.0, 1.0], "target": [1, 0, 1.0], "field_of_view": 40, "size": [16, 16]}
    views = [
        room({"mirror": MIRROR["mirror"] | {"material": one}}).replace(camera=camera)
        for one in ("mirror", "black")
    ]
    (found, dark), (path, without) = (
        [mean(technique(view))[1] for view in views]
        for technique in (hybrid, lambda view: render(view, 1024))
    )
    assert found > 1.03 * dark
    assert found / dark == pytest.approx(path / without, rel=0.01)


def test_sensors_see_what_mirrors_send():
    """A sensor on the floor reads what the camera sees there."""
    scene = room(MIRROR)
    solution = radiosity.solve(scene, technique="hybrid", sampling="uniform:8", **ELEMENTS)
    point = [1.5, 0.0, 1.0]
    camera = {"eye": [1.5, 0.3, 1.0], "target": point, "up": [0, 0, 1], "field_of_view": 10, "size": [8, 8]}
    seen = np.pi * mean(render(scene.replace(camera=camera), 2048))[1] / 0.7
    assert solution.illuminance([point], samples=16384)[0] == pytest.approx(seen, rel=0.02)


PAIR = {
    "one": rectangle("mirror", [0.2, 0.2, 0.05], [1.6, 0, 0], [0, 1.6, 0]),
    "two": rectangle("mirror", [0.2, 0.2, 1.9], [0, 1.6, 0], [1.6, 0, 0]),
}


def test_mirrors_that_face_each_other_are_those_of_path():
    """Reflections of reflections, each a little darker."""
    scene = room(PAIR, size=(32, 32)).replace(camera={"eye": [1.2, 1.0, 1.7], "target": [1.0, 1.0, 0.0]})
    path = render(scene, 1024)
    for gather in ("none", "full"):
        np.testing.assert_allclose(mean(hybrid(scene, gather=gather)), mean(path), rtol=0.03)


# Ways of light


def test_without_anything_specular_it_is_radiosity():
    scene = room(size=(24, 24))
    straight = render(scene, 4, technique="radiosity", **ELEMENTS)
    np.testing.assert_allclose(hybrid(scene, 4).xyz, straight.xyz, rtol=1e-4, atol=1e-4)
    found = hybrid(scene, 4, mechanisms="dd")
    np.testing.assert_allclose(found.xyz, straight.xyz, rtol=1e-4, atol=1e-4)


def test_each_way_of_light_adds_its_part():
    scene = room(PAIR, PANEL, size=(24, 24)).replace(camera={"eye": [1, 1, 1.7]})
    options = {"elements": 1000, "form_factors": "rays:128"}
    ways = ("dd", "sd", "ds", "ss")
    whole = mean(hybrid(scene, 32, **options))
    for one in ways:
        part = mean(hybrid(scene, 32, mechanisms=[way for way in ways if way != one], **options))
        assert (part < whole).all(), one
    # What two mirrors show of each other needs both ways; a mirror alone needs one.
    eye, once, again, both = (
        np.asarray(hybrid(scene, 4, mechanisms=["dd", "sd", *more], **options).xyz, float)
        for more in ([], ["ds"], ["ss"], ["ds", "ss"])
    )
    assert (once + again - eye <= 1.001 * both + 1e-3 * both.mean()).all()
    single = room(MIRROR, PANEL, size=(24, 24))
    found, whole = (hybrid(single, 4, mechanisms=of, **options).xyz for of in (ways[:3], ways))
    np.testing.assert_allclose(found, whole, rtol=1e-4, atol=1e-4)


def test_without_its_mechanisms_a_mirror_is_black():
    scene = room(MIRROR).replace(camera={"eye": [1, 0.9, 1], "target": [2, 0.9, 1], "field_of_view": 30})
    assert mean(hybrid(scene, 4))[1] > 10
    assert not np.asarray(hybrid(scene, 4, mechanisms="dd,sd").xyz).any()


def test_frustum_and_drawn_rays_have_the_same_mean():
    scene = room(floor="satin", size=(32, 32))
    drawn = mean(hybrid(scene, 256))
    np.testing.assert_allclose(mean(hybrid(scene, 16, frustum=4)), drawn, rtol=0.02)


def test_a_glossy_floor_is_that_of_path():
    scene = room(floor="satin", size=(32, 32))
    path = render(scene, 1024)
    found = hybrid(scene, 128)
    np.testing.assert_allclose(mean(found), mean(path), rtol=0.02)
    assert np.abs(blocks(found) - blocks(path)).mean() < 0.04 * blocks(path).mean()


def test_a_method_that_follows_no_light_is_refused():
    with pytest.raises(UsageError, match="hybrid follows light from mirror to mirror"):
        hybrid(room(MIRROR), 1, form_factors="area:8", elements=100)


def test_a_change_of_mirrors_is_another_solution():
    solution = radiosity.solve(
        room(MIRROR), technique="hybrid", sampling="uniform:8", elements=300, form_factors="rays:32"
    )
    with pytest.raises(UsageError, match="solve anew"):
        solution.relight(materials={"mirror": {"kind": "conductor", "metal": "Au"}})
    red = solution.relight(materials={"white": {"kind": "diffuse", "reflectance": "Cornell/red"}})
    xyz = mean(red.render(samples=4))
    assert xyz[0] > 1.05 * xyz[1]


def test_a_hybrid_solution_reads_back(tmp_path):
    solution = radiosity.solve(
        room(MIRROR, PANEL), technique="hybrid", sampling="uniform:8", elements=300, form_factors="rays:32"
    )
    solution.save(tmp_path / "a.solution")
    loaded = radiosity.Solution.load(tmp_path / "a.solution")
    for gather in ("none", "full"):
        images = [one.render(samples=4, gather=gather).xyz for one in (loaded, solution)]
        assert np.array_equal(*images)


# Specular radiosity


CUBE = {"cube": {"box": {"min": [0.7, 0.01, 0.4], "max": [1.3, 0.6, 0.9]}, "material": "yellow"}}


@pytest.fixture(scope="module")
def cube_on_satin():
    """Immel et al. 1986: the floor before a yellow cube shows it; by path, and solved in all directions."""
    scene = room(CUBE, floor="satin", size=(64, 48)).replace(
        camera={"eye": [1, 0.9, 1.95], "target": [1, 0.2, 0.6], "field_of_view": 60}
    )
    solution = radiosity.solve(
        scene, technique="specular-radiosity", sampling="uniform:8", elements=8000, cube=16
    )
    return render(scene, 256), solution.render(samples=16), solution.report


def test_a_cube_on_a_glossy_floor_creates_no_light(cube_on_satin):
    path, found, report = cube_on_satin
    assert report["creation"] <= 0.01
    np.testing.assert_allclose(mean(found), mean(path), rtol=0.05)


def test_a_cube_reflected_in_a_glossy_floor(cube_on_satin):
    path, found, _ = cube_on_satin
    floor = np.s_[34:46, 22:42]
    apart = found.xyz[floor].mean(axis=(0, 1)) / path.xyz[floor].mean(axis=(0, 1)) - 1
    assert np.abs(apart).max() < 0.05, apart


def test_specular_radiosity_of_diffusers_is_radiosity():
    scene = room(size=(24, 24))
    options = {"elements": 500, "sampling": "uniform:8"}
    found = radiosity.solve(scene, technique="specular-radiosity", cube=24, **options)
    expected = radiosity.solve(scene, form_factors="rays:4096", **options)
    assert found.report["creation"] <= 0.01
    images = [solution.render(samples=16) for solution in (found, expected)]
    np.testing.assert_allclose(*map(mean, images), rtol=0.01)


def test_what_would_not_fit_is_refused_before_the_work():
    with pytest.raises(MachineError, match=r"This render \(radiosity [\d.]+ TB, .* are free"):
        render(room(size=(8, 8)), 1, technique="specular-radiosity", elements=100_000, cube=128)


def test_a_solution_of_directions_can_only_be_seen(tmp_path):
    scene = room(size=(8, 8))
    solution = radiosity.solve(
        scene, technique="specular-radiosity", sampling="uniform:8", elements=100, cube=8
    )
    for use in (
        lambda: solution.save(tmp_path / "a.solution"),
        solution.mesh,
        lambda: solution.illuminance([[1, 0, 1]]),
        lambda: solution.relight(materials={"white": {"kind": "diffuse", "reflectance": 0.5}}),
    ):
        with pytest.raises(UsageError, match="no irradiance"):
            use()
    assert not list(tmp_path.iterdir())
