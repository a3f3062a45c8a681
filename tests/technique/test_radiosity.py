"""Radiosity: what is known in closed form, what `path` finds, and what a solution can do afterwards."""

from __future__ import annotations

import dataclasses
import tomllib

import numpy as np
import pytest
import trimesh

import illuminant
from illuminant import radiosity
from illuminant.errors import DataError, UsageError
from illuminant.scene import Scene

METHODS = ["rays:1024", "hemicube:100", "scanline:100", "area:8"]
CAMERA = {"eye": [0, 1, 4], "target": [0, 1, 0], "size": [16, 16], "field_of_view": 50.0}
BLACK = {"kind": "diffuse", "reflectance": 0.0}


def solve(scene, **options):
    return radiosity.solve(scene, **{"sampling": "uniform:8"} | options)


def render(scene, **options):
    return illuminant.render(scene, **{"sampling": "uniform:8"} | options)


def rectangle(material, corner, *edges):
    return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}


def diffuse(reflectance):
    return {"kind": "diffuse", "reflectance": reflectance}


def glowing(luminance, reflectance=0.0):
    return {
        "kind": "emitter",
        "spectrum": "E",
        "luminance_cd_m2": luminance,
        "sides": "both",
        "reflectance": reflectance,
    }


def luminances(solution, inside=None):
    """Mean luminance of each object by its name, cd/m²; of sides that face a point alone if there is one."""
    mesh = solution.mesh()
    of_faces = mesh.xyz[mesh.faces, 1].mean(axis=1)
    areas = mesh.areas.copy()
    if inside is not None:
        normals, middles = mesh.normals[mesh.faces].mean(axis=1), mesh.positions[mesh.faces].mean(axis=1)
        areas[np.einsum("fi,fi->f", normals, inside - middles) < 0] = 0
    names = [thing["name"] for thing in solution.scene.description["objects"]]
    return {
        name: np.average(of_faces[mesh.objects == i], weights=areas[mesh.objects == i])
        for i, name in enumerate(names)
        if areas[mesh.objects == i].any()
    }


# The Cornell box


def regions(scenes, size):
    """Of each object of the Cornell box, the pixels that lie well inside what is seen of it."""
    data = tomllib.loads((scenes / "cornell.toml").read_text(encoding="utf-8"))
    names = list(data["objects"])
    for i, name in enumerate(names):
        data["objects"][name]["material"] = name
        data["materials"][name] = glowing(float(i + 1))
    del data["render"]
    image = render(Scene.build(**data), size=size, samples=1, depth=1, filter=("box", 1e-6))
    number = np.rint(image.xyz[..., 1]).astype(int)
    inside = {}
    for i, name in enumerate(names):
        own = np.pad(number == i + 1, 2)
        shifted = [np.roll(own, (x, y), (0, 1)) for x in range(-2, 3) for y in range(-2, 3)]
        inside[name] = np.all(shifted, axis=0)[2:-2, 2:-2]
    return {name: mask for name, mask in inside.items() if name != "lamp"}


SIZE = (64, 64)


@pytest.fixture(scope="module")
def by_path(scenes):
    return render(scenes / "cornell.toml", size=SIZE, samples=1024, keep_spectra=True)


@pytest.fixture(scope="module")
def cornell(scenes):
    return solve(scenes / "cornell.toml", elements=8000)


def test_every_wall_of_the_cornell_box_is_that_of_path_at_every_wavelength(scenes, cornell, by_path):
    found = cornell.render(size=SIZE, samples=64, keep_spectra=True).layers["spectra"]
    walls = regions(scenes, SIZE)
    assert len(walls) == 7
    for name, mask in walls.items():
        assert mask.sum() > 20, name
        path = by_path.layers["spectra"][mask].mean(axis=0)
        lit = path > 1e-3 * path.max()
        assert lit.sum() >= 5
        apart = found[mask].mean(axis=0)[lit] / path[lit] - 1
        assert np.abs(apart).max() < 0.015, (name, apart)


def test_a_final_gather_of_the_cornell_box_looks_like_path(cornell, by_path):
    found = cornell.render(size=SIZE, samples=256, gather="full")
    assert illuminant.diff(by_path, found).flip < 0.05
    np.testing.assert_allclose(found.xyz.mean(axis=(0, 1)), by_path.xyz.mean(axis=(0, 1)), rtol=0.01)


def test_asking_lamps_at_every_pixel_keeps_the_mean(cornell, by_path):
    found = cornell.render(size=SIZE, samples=64, gather="direct")
    np.testing.assert_allclose(found.xyz.mean(axis=(0, 1)), by_path.xyz.mean(axis=(0, 1)), rtol=0.015)


def test_the_report_tells_how_good_the_solution_is(cornell):
    report = cornell.report
    assert report["reciprocity"] < 0.01 and report["imbalance"] < 1e-3
    assert 0 < report["closure_mean"] < 0.2
    history = report["history"]
    assert history[-1] <= 1e-5 < history[0]
    assert report["memory"] > 4 * report["form_factors"]


# Closed enclosures


@pytest.mark.parametrize("reflectance", [0.3, 0.8])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "shape",
    [{"box": {"min": [-1, -0.7, -1.3], "max": [1.1, 0.9, 1]}}, {"sphere": {"radius": 1.0}}],
    ids=["box", "sphere"],
)
def test_a_glowing_enclosure_sends_emission_over_one_minus_reflectance(shape, method, reflectance):
    """B = E / (1 − ρ)."""
    scene = Scene.build(
        camera=CAMERA | {"eye": [0.3, -0.2, 0.1]},
        objects={"room": {"material": "wall"} | shape},
        materials={"wall": glowing(100.0, reflectance)},
    )
    # In corners the lamps are near, and few samples of them often miss what is nearest.
    mesh = solve(scene, elements=150, form_factors=method, light_samples=2048).mesh()
    mean = np.average(mesh.xyz[mesh.faces, 1].mean(axis=1), weights=mesh.areas)
    assert mean == pytest.approx(100.0 / (1 - reflectance), rel=5e-3)
    # Where each side sees nothing but others like it, none is brighter.
    np.testing.assert_allclose(mesh.xyz[:, 1], mean, rtol=0.02)


PARTS = {"top": (60.0, 0.2), "middle": (10.0, 0.7), "bottom": (200.0, 0.5)}


@pytest.fixture(scope="module")
def ball():
    """A sphere seen from inside, in three bands that shine and reflect each in its way."""
    mesh = trimesh.creation.icosphere(subdivisions=2)
    height = mesh.triangles_center[:, 1]
    bands = {"top": height > 0.4, "middle": (height <= 0.4) & (height > -0.2), "bottom": height <= -0.2}
    objects = {
        name: {
            "mesh": {"positions": mesh.vertices, "faces": mesh.faces[own][:, ::-1]},
            "material": name,
        }
        for name, own in bands.items()
    }
    shares = {name: mesh.area_faces[own].sum() / mesh.area for name, own in bands.items()}
    scene = Scene.build(
        camera=CAMERA | {"eye": [0, 0, 0], "target": [0, 0, -1], "field_of_view": 60.0},
        objects=objects,
        materials={name: glowing(*of) for name, of in PARTS.items()},
    )
    # In a sphere every part sees every other as its share of the area, from everywhere.
    arriving = sum(shares[name] * e for name, (e, _) in PARTS.items())
    arriving /= 1 - sum(shares[name] * rho for name, (_, rho) in PARTS.items())
    return scene, {name: e + rho * arriving for name, (e, rho) in PARTS.items()}


@pytest.mark.parametrize("method", METHODS)
def test_parts_of_a_sphere_share_their_light(ball, method):
    """H = Σ a E / (1 − Σ a ρ) arrives everywhere, and B = E + ρ H."""
    scene, expected = ball
    found = luminances(solve(scene, elements=1, form_factors=method), inside=np.zeros(3))
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=5e-3), name


def test_path_finds_the_same_parts_of_a_sphere(ball):
    scene, expected = ball
    for name, target in {"top": [0, 1, 0.01], "middle": [0, 0.1, -1], "bottom": [0, -1, 0.01]}.items():
        camera = {"target": target, "field_of_view": 10.0, "size": [8, 8]}
        image = render(scene.replace(camera=camera), samples=1024)
        assert image.xyz[..., 1].mean() == pytest.approx(expected[name], rel=0.01), name


def parallel(x, y, distance):
    """The form factor between opposite rectangles of x × y."""
    x, y = x / distance, y / distance
    a, b = np.sqrt(1 + x * x), np.sqrt(1 + y * y)
    return (2 / (np.pi * x * y)) * (
        np.log(a * b / np.sqrt(1 + x * x + y * y))
        + x * b * np.arctan(x / b)
        + y * a * np.arctan(y / a)
        - x * np.arctan(x)
        - y * np.arctan(y)
    )


def perpendicular(edge, depth, height):
    """The form factor from edge × depth to edge × height, at a right angle along the edge."""
    w, h = depth / edge, height / edge
    s = w * w + h * h
    return (1 / (np.pi * w)) * (
        w * np.arctan(1 / w)
        + h * np.arctan(1 / h)
        - np.sqrt(s) * np.arctan(1 / np.sqrt(s))
        + 0.25
        * (
            np.log((1 + w * w) * (1 + h * h) / (1 + s))
            + w * w * np.log(w * w * (1 + s) / ((1 + w * w) * s))
            + h * h * np.log(h * h * (1 + s) / ((1 + h * h) * s))
        )
    )


def test_two_parallel_plates():
    """B₁ = E + ρ₁ F B₂ and B₂ = ρ₂ F B₁; halves of a square receive alike, so that two elements a plate suffice."""
    x, y, distance, emission, (r1, r2) = 1.0, 1.0, 0.5, 100.0, (0.4, 0.8)
    scene = Scene.build(
        camera=CAMERA,
        objects={
            "lower": rectangle("lamp", [0, 0, 0], [0, 0, y], [x, 0, 0]),
            "upper": rectangle("upper", [0, distance, 0], [x, 0, 0], [0, 0, y]),
        },
        materials={"lamp": glowing(emission, r1) | {"sides": "front"}, "upper": diffuse(r2)},
    )
    f = parallel(x, y, distance)
    lower, upper = np.linalg.solve([[1, -r1 * f], [-r2 * f, 1]], [emission, 0])
    options = {"elements": 4, "light_samples": 16384}
    for method in ("rays:65536", "area:256"):
        found = luminances(solve(scene, form_factors=method, **options))
        assert found["lower"] == pytest.approx(lower, rel=5e-3), method
        assert found["upper"] == pytest.approx(upper, rel=5e-3), method


def test_a_box_of_three_pairs_of_walls():
    """Opposite walls are alike, so that three equations with closed factors tell all; halves of walls receive alike."""
    size = {"x": 2.0, "y": 1.0, "z": 1.5}
    emission, reflectance = {"x": 50.0, "y": 10.0, "z": 200.0}, {"x": 0.6, "y": 0.8, "z": 0.3}
    spans = {axis: np.eye(3)[i] * size[axis] for i, axis in enumerate(size)}
    objects = {}
    for axis in size:
        u, v = (spans[other] for other in size if other != axis)
        for end in (0, 1):
            objects[f"{axis}{end}"] = rectangle(axis, end * spans[axis], u, v)
    scene = Scene.build(
        camera=CAMERA | {"eye": [1, 0.5, 0.7], "target": [0, 0.5, 0.7]},
        objects=objects,
        materials={axis: glowing(emission[axis], reflectance[axis]) for axis in size},
    )
    factors = np.empty((3, 3))
    for i, axis in enumerate(size):
        for j, other in enumerate(size):
            a, b = (size[one] for one in size if one != axis)
            if axis == other:
                factors[i, j] = parallel(a, b, size[axis])
            else:
                # The edge that both share, how deep this wall is from it, and how high the other.
                (edge,) = (size[one] for one in size if one not in (axis, other))
                factors[i, j] = 2 * perpendicular(edge, size[other], size[axis])
    np.testing.assert_allclose(factors.sum(axis=1), 1.0, rtol=1e-12)
    rho = np.array(list(reflectance.values()))
    expected = np.linalg.solve(np.eye(3) - rho[:, None] * factors, list(emission.values()))
    for method in ("rays:16384", "area:256"):
        found = luminances(solve(scene, elements=1, form_factors=method, light_samples=16384))
        for axis, value in zip(size, expected, strict=True):
            mean = 0.5 * (found[f"{axis}0"] + found[f"{axis}1"])
            assert mean == pytest.approx(value, rel=5e-3), (method, axis)


# Lamps of all kinds


LIGHTS = {
    "point": {"kind": "point", "position": [0.4, 1.6, 0.5], "spectrum": "D65", "intensity_cd": 1000.0},
    "spot": {
        "kind": "spot",
        "position": [0.9, 1.9, 0.9],
        "direction": [-0.8, -1.2, -0.8],
        "half_angle_deg": 40.0,
        "penumbra_deg": 15.0,
        "spectrum": "A",
        "intensity_cd": 2000.0,
    },
    "directional": {
        "kind": "directional",
        "direction": [-0.5, -1.0, -0.8],
        "spectrum": "D65",
        "illuminance_lx": 5000.0,
    },
    "environment": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 500.0},
    "sky": {"kind": "sky", "elevation_deg": 45.0, "azimuth_deg": 140.0},
}


def corner(lights, size=(32, 32), **more):
    """A floor and two walls with a block on it."""
    return Scene.build(
        camera={
            "eye": [1.8, 1.5, 2.2],
            "target": [-0.3, 0.4, -0.3],
            "size": list(size),
            "field_of_view": 40.0,
        },
        objects={
            "floor": rectangle("white", [-1, 0, -1], [0, 0, 2], [2, 0, 0]),
            "back": rectangle("red", [-1, 0, -1], [2, 0, 0], [0, 1.5, 0]),
            "side": rectangle("white", [-1, 0, -1], [0, 1.5, 0], [0, 0, 2]),
            "block": {
                "box": {"min": [-0.2, 0.0, -0.2], "max": [0.2, 0.5, 0.2]},
                "material": "white",
                "translate": more.pop("block", [-0.1, 0.01, -0.1]),
            },
        },
        materials={"white": diffuse(0.8), "red": diffuse("Cornell/red")} | more.pop("materials", {}),
        lights=lights,
    )


@pytest.mark.parametrize("kind", LIGHTS)
def test_lamps_of_every_kind_shine_on_patches(kind):
    scene = corner({"key": LIGHTS[kind]})
    found = solve(scene, elements=6000, form_factors="rays:256").render(samples=64).xyz
    path = render(scene, samples=512).xyz
    np.testing.assert_allclose(found.mean(axis=(0, 1)), path.mean(axis=(0, 1)), rtol=0.015)
    a, b = (np.asarray(xyz, float)[..., 1].reshape(4, 8, 4, 8).mean(axis=(1, 3)) for xyz in (found, path))
    assert np.abs(a - b).max() < 0.06 * b.max()


# Other lamps, other paints, other places


LAMPS = {
    "key": LIGHTS["point"],
    "fill": LIGHTS["spot"],
}


@pytest.fixture(scope="module")
def solved():
    return solve(corner(LAMPS), elements=1500, form_factors="rays:256")


def again(scene, solution):
    """The same scene solved from scratch."""
    return radiosity.solve(scene, **dataclasses.asdict(solution.settings))


def test_other_lamps_are_a_matter_of_multiplying(solved):
    lights = {
        "key": LAMPS["key"] | {"intensity_cd": 300.0},
        "fill": LAMPS["fill"] | {"spectrum": "FL2"},
    }
    found = solved.relight(lamps={"key": 0.3, "fill": "FL2"})
    assert (
        found.report["rows_again"] == 0
        and found.report["seconds_form_factors"] == (solved.report["seconds_form_factors"])
    )
    expected = again(corner(lights), solved).render(samples=4, keep_spectra=True)
    np.testing.assert_allclose(found.render(samples=4).xyz, expected.xyz, rtol=1e-4, atol=1e-4)
    sent, wanted = found.mesh().xyz, again(corner(lights), solved).mesh().xyz
    np.testing.assert_allclose(sent, wanted, rtol=1e-4, atol=1e-4 * wanted.max())


def test_a_lamp_switched_off_leaves_the_others(solved):
    both = luminances(solved)
    parts = [luminances(solved.relight(lamps={off: 0})) for off in LAMPS]
    for name, value in both.items():
        # What would be below 0 at a corner is cut off, of each lamp or of both.
        assert sum(part[name] for part in parts) == pytest.approx(value, rel=2e-4), name
    assert not solved.relight(lamps=dict.fromkeys(LAMPS, 0)).mesh().xyz.any()


def test_other_paints_keep_the_form_factors(solved):
    paint = {"red": diffuse(0.3), "white": diffuse("ColorChecker/blue")}
    found = solved.relight(materials=paint)
    assert found.report["rows_again"] == 0
    expected = again(corner(LAMPS, materials=paint), solved)
    np.testing.assert_allclose(
        found.render(samples=4).xyz, expected.render(samples=4).xyz, rtol=1e-3, atol=1e-3
    )


def two_rooms(place):
    """Two rooms with a door between them; a box stands in one."""
    return Scene.build(
        camera={
            "eye": [2.9, 1.5, 1.9],
            "target": [1.0, 0.5, 0.6],
            "size": [24, 24],
            "field_of_view": 70.0,
        },
        objects={
            "room": {"box": {"min": [-2, 0, 0], "max": [3, 2, 2]}, "material": "white"},
            "divider": {"box": {"min": [0, 0, 0.4], "max": [0.1, 2, 2]}, "material": "white"},
            "box": {
                "box": {"min": [0, 0, 0], "max": [0.4, 0.4, 0.4]},
                "material": "white",
                "translate": place,
            },
        },
        materials={"white": diffuse(0.7)},
        lights={"key": {"kind": "point", "position": [1.5, 1.8, 1], "spectrum": "E", "intensity_cd": 100.0}},
    )


def test_an_object_that_moves_is_the_solution_from_scratch():
    """Bit for bit, and only form factors that see it are found again."""
    before, after = two_rooms([1.0, 0.01, 1.3]), two_rooms([2.0, 0.01, 1.0])
    solution = solve(before, elements=1500, form_factors="rays:128")
    found, expected = solution.of(after), again(after, solution)
    assert 0 < found.report["rows_again"] < 0.9 * solution.report["sides"]
    assert np.array_equal(found.render(samples=4).xyz, expected.render(samples=4).xyz)
    assert not np.array_equal(found.render(samples=4).xyz, solution.render(samples=4).xyz)
    back = found.of(before)
    assert np.array_equal(back.render(samples=4).xyz, solution.render(samples=4).xyz)


def test_a_camera_that_moves_changes_nothing_of_the_solution(solved):
    image = solved.render(samples=4, camera={"eye": [1.0, 2.0, 2.0]})
    elsewhere = corner(LAMPS).replace(camera={"eye": [1.0, 2.0, 2.0]})
    assert np.array_equal(image.xyz, again(elsewhere, solved).render(samples=4).xyz)


def test_what_needs_another_solution_is_said(solved):
    other = corner(LAMPS)
    with pytest.raises(UsageError, match=r"There is no lamp 'kez': did you mean \"key\"\?"):
        solved.relight(lamps={"kez": 0.5})
    with pytest.raises(UsageError, match="lamp 'key': a factor must be 0 or more, not -1"):
        solved.relight(lamps={"key": -1.0})
    with pytest.raises(UsageError, match="differ in more than spectrum and power"):
        solved.of(corner(LAMPS | {"key": LAMPS["key"] | {"position": [0.0, 1.0, 0.5]}}))
    with pytest.raises(UsageError, match="differ in more than spectrum and power"):
        solved.of(corner({"key": LAMPS["key"]}))
    more = Scene.build(
        camera=CAMERA,
        objects={"floor": rectangle("white", [-1, 0, -1], [0, 0, 2], [2, 0, 0])},
        materials={"white": diffuse(0.5)},
        lights=LAMPS,
    )
    with pytest.raises(UsageError, match="has other objects than the solution: solve it anew"):
        solved.of(more)
    for name, value in {"elements": 500, "technique": "path", "sampling": "uniform:8"}.items():
        with pytest.raises(UsageError, match=f"{name} belongs to the solution"):
            solved.render(**{name: value})
    with pytest.raises(UsageError, match="technique path: nothing is solved for"):
        solve(other, technique="path")


def test_the_light_of_many_lamps_is_not_kept_apart():
    lights = {
        f"lamp {i}": LIGHTS["point"] | {"position": [0.04 * i - 0.6, 1.6, 0.3], "intensity_cd": 30.0}
        for i in range(33)
    }
    scene = corner(lights)
    found = solve(scene, elements=500, form_factors="rays:128")
    assert found.report["per_lamp"] is False
    with pytest.raises(UsageError, match="more than 32 lamps is not kept apart"):
        found.relight(lamps={"lamp 3": 0.5})
    path = render(scene, samples=128).xyz.mean(axis=(0, 1))
    np.testing.assert_allclose(found.render(samples=16).xyz.mean(axis=(0, 1)), path, rtol=0.03)


# Files


def test_a_file_gives_the_same_image_and_can_be_relit(solved, tmp_path):
    solved.save(tmp_path / "a.solution")
    loaded = radiosity.Solution.load(tmp_path / "a.solution")
    assert np.array_equal(loaded.render(samples=4).xyz, solved.render(samples=4).xyz)
    assert np.array_equal(loaded.mesh().xyz, solved.mesh().xyz)
    assert loaded.settings == solved.settings
    relit = solved.relight(lamps={"key": 0.3, "fill": "FL2"})
    relit.save(tmp_path / "b.solution")
    dark = radiosity.Solution.load(tmp_path / "b.solution")
    assert np.array_equal(dark.render(samples=4).xyz, relit.render(samples=4).xyz)
    back = dark.relight(lamps={"key": 1 / 0.3, "fill": LAMPS["fill"]["spectrum"]})
    np.testing.assert_allclose(back.mesh().xyz, solved.mesh().xyz, rtol=1e-4, atol=1e-4)


def test_a_damaged_file_is_one_sentence(solved, tmp_path):
    path = tmp_path / "a.solution"
    solved.save(path)
    whole = path.read_bytes()
    with np.load(path) as data:
        arrays = {name: data[name] for name in data.files}

    def load(content):
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            with open(path, "wb") as stream:
                np.savez(stream, **content)
        with pytest.raises(DataError) as caught:
            radiosity.Solution.load(path)
        sentence = str(caught.value)
        assert sentence.startswith(str(path)) and sentence.endswith(".") and "\n" not in sentence
        assert len(sentence) < len(str(path)) + 200
        return sentence

    for content in (b"", whole[: len(whole) // 2], whole[:-100], b"\x89PNG\r\n" * 100, b"PK\x03\x04"):
        assert "is no solution" in load(content), content[:20]
    for name in arrays:
        load({key: one for key, one in arrays.items() if key != name})
        if len(arrays[name]):
            load(arrays | {name: arrays[name][:-1]})
        load(arrays | {name: np.zeros((3, 3))})
    load(arrays | {"columns": np.full_like(arrays["columns"], 2**31)})
    load(arrays | {"starts": arrays["starts"][::-1].copy()})
    load(arrays | {"header": np.frombuffer(b'{"format": "illuminant solution 99"}', np.uint8)})
    load({name: one for name, one in arrays.items() if name == "header"})
    middle = bytearray(whole)
    middle[len(whole) // 3] ^= 0xFF
    load(bytes(middle))
    with pytest.raises(DataError, match="cannot be read: there is no such file"):
        radiosity.Solution.load(tmp_path / "missing.solution")


def test_the_mesh_has_the_area_of_the_scene(solved):
    mesh = solved.mesh()
    block = 2 * 0.4 * 0.4 + 4 * 0.4 * 0.5
    assert mesh.areas.sum() == pytest.approx(2 * 2 + 2 * 2 * 1.5 + block, rel=1e-4)
    corners = mesh.positions[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    np.testing.assert_allclose(0.5 * np.linalg.norm(across, axis=1), mesh.areas, rtol=1e-3)
    # Corners run counter-clockwise on the side that is seen.
    facing = mesh.normals[mesh.faces].mean(axis=1)
    assert (np.einsum("fi,fi->f", across, facing) > 0).all()
    assert len(np.unique(mesh.patches)) == solved.report["patches"]
    assert len(mesh.faces) == solved.report["sides"]


def test_a_mesh_file_reads_back(solved, tmp_path):
    exposure = solved.save_mesh(tmp_path / "a.glb")
    mesh = solved.mesh()
    read = trimesh.load(tmp_path / "a.glb", process=False)
    assert set(read.geometry) == {"floor", "back", "side", "block"}
    assert sum(len(part.faces) for part in read.geometry.values()) == len(mesh.faces)
    for part in read.geometry.values():
        xyz = np.asarray(part.vertex_attributes["_XYZ"], float)
        assert xyz.shape == part.vertices.shape
        rgb = np.clip(illuminant.color.xyz_to_rgb(xyz * exposure), 0, 1)
        np.testing.assert_allclose(part.visual.vertex_colors[:, :3] / 255, rgb, atol=0.6 / 255)
    floor = read.geometry["floor"]
    assert np.allclose(floor.vertices[:, 1], 0) and np.allclose(floor.vertex_normals, [0, 1, 0])
    brightest = max(part.vertex_attributes["_XYZ"][:, 1].max() for part in read.geometry.values())
    assert brightest == pytest.approx(mesh.xyz[:, 1].max(), rel=1e-6)
    assert solved.save_mesh(tmp_path / "b.glb", exposure=0.25) == 0.25
    with pytest.raises(UsageError, match=r"a mesh is written as \.glb"):
        solved.save_mesh(tmp_path / "a.ply")


# Analytic cases in the manner of CIE 171:2006


def black_room(openings=None, lights=None, objects=None, materials=None):
    """A floor that returns nothing, with other things about it."""
    return Scene.build(
        camera=CAMERA,
        objects={"floor": rectangle("black", [-4, 0, -4], [0, 0, 8], [8, 0, 0])} | (objects or {}),
        materials={"black": BLACK} | (materials or {}),
        lights=lights,
    )


def lambert(point, normal, polygon):
    """The form factor from a point to a polygon above its horizon (Lambert 1760)."""
    ways = np.asarray(polygon, float) - point
    total = 0.0
    for a, b in zip(ways, np.roll(ways, -1, axis=0), strict=True):
        across = np.cross(a, b)
        length = np.linalg.norm(across)
        total += np.arctan2(length, a @ b) * (across @ np.asarray(normal, float)) / length
    return abs(total) / (2 * np.pi)


def check(solution, points, normal, expected, rel, samples=4096):
    found = solution.illuminance(points, normal, samples=samples)
    errors = found / np.asarray(expected) - 1
    assert np.abs(errors).max() < rel, f"errors of {np.round(errors, 5)}"


PLACES = [[0.0, 0.0, 0.0], [0.7, 0.0, 0.2], [-1.5, 0.0, 1.0], [2.5, 0.0, -2.5]]
UP = [0, 1, 0]


def test_cie_171_point_source_over_a_plane():
    """E = I cos³ θ / h²."""
    height, intensity = 3.0, 1000.0
    key = {
        "kind": "point",
        "position": [0.0, height, 0.0],
        "spectrum": "E",
        "intensity_cd": intensity,
    }
    solution = solve(black_room(lights={"key": key}), elements=200)
    cos = height / np.linalg.norm(np.array(PLACES) - [0, height, 0], axis=1)
    check(solution, PLACES, UP, intensity * cos**3 / height**2, 1e-3)
    # A sensor that faces the lamp, and one that faces away.
    tilted = solution.illuminance([[3.0, 0.0, 0.0]] * 2, [[-3.0, height, 0.0], [3.0, -height, 0.0]])
    assert tilted == pytest.approx([intensity / (3.0**2 + height**2), 0.0], rel=1e-3)


def test_cie_171_area_source_over_a_plane():
    """E = π L F with Lambert's formula, at points under and beside the source."""
    panel = [[-0.5, 2.0, -1.0], [0.5, 2.0, -1.0], [0.5, 2.0, 1.0], [-0.5, 2.0, 1.0]]
    solution = solve(
        black_room(
            objects={"panel": {"rectangle": {"corners": panel}, "material": "lamp"}},
            materials={"lamp": glowing(3000.0)},
        ),
        elements=200,
    )
    factors = [lambert(point, UP, panel) for point in PLACES]
    # Under a corner of a parallel rectangle (Lambert's formula in two arctangents).
    a, b, h = 1.0, 2.0, 2.0
    s, t = np.hypot(a, h), np.hypot(b, h)
    below = (a / s * np.arctan(b / s) + b / t * np.arctan(a / t)) / (2 * np.pi)
    assert lambert([-0.5, 0, -1.0], UP, panel) == pytest.approx(below, rel=1e-12)
    check(solution, PLACES, UP, 3000.0 * np.pi * np.array(factors), 2e-3)


SIDES = {
    "west": ([-2, 0, -2], [0, 3, 0], [0, 0, 4]),
    "east": ([2, 0, -2], [0, 0, 4], [0, 3, 0]),
    "north": ([-2, 0, -2], [4, 0, 0], [0, 3, 0]),
    "south": ([-2, 0, 2], [0, 3, 0], [4, 0, 0]),
}


@pytest.mark.parametrize("where", ["roof", "façade"])
def test_cie_171_daylight_through_an_opening_under_a_uniform_sky(where):
    """E = π L F, with F the factor from the floor to the opening."""
    walls = {name: rectangle("black", *wall) for name, wall in SIDES.items()}
    if where == "roof":
        opening = [[-0.5, 3, -1], [0.5, 3, -1], [0.5, 3, 1], [-0.5, 3, 1]]
        walls |= {
            "roof w": rectangle("black", [-2, 3, -2], [1.5, 0, 0], [0, 0, 4]),
            "roof e": rectangle("black", [0.5, 3, -2], [1.5, 0, 0], [0, 0, 4]),
            "roof n": rectangle("black", [-0.5, 3, -2], [1, 0, 0], [0, 0, 1]),
            "roof s": rectangle("black", [-0.5, 3, 1], [1, 0, 0], [0, 0, 1]),
        }
    else:
        opening = [[-1, 1, -2], [1, 1, -2], [1, 2.5, -2], [-1, 2.5, -2]]
        del walls["north"]
        walls |= {
            "roof": rectangle("black", [-2, 3, -2], [4, 0, 0], [0, 0, 4]),
            "north w": rectangle("black", [-2, 0, -2], [1, 0, 0], [0, 3, 0]),
            "north e": rectangle("black", [1, 0, -2], [1, 0, 0], [0, 3, 0]),
            "below": rectangle("black", [-1, 0, -2], [2, 0, 0], [0, 1, 0]),
            "above": rectangle("black", [-1, 2.5, -2], [2, 0, 0], [0, 0.5, 0]),
        }
    sky = {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 10000.0}
    solution = solve(black_room(lights={"sky": sky}, objects=walls), elements=300)
    points = [[0.0, 0.0, 0.0], [0.8, 0.0, -0.5], [-1.2, 0.0, 0.3], [0.0, 0.0, 1.5]]
    expected = [np.pi * 10000.0 * lambert(point, UP, opening) for point in points]
    check(solution, points, UP, expected, 0.015, samples=65536)


@pytest.mark.parametrize("facing", ["wall", "ceiling"])
def test_cie_171_diffuse_reflection_of_a_lit_floor(facing):
    """A floor in parallel light shines evenly, and a surface that the light does not reach gets π L F of it."""
    sun = {"kind": "directional", "direction": [0, -1, 0], "spectrum": "E", "illuminance_lx": 20000.0}
    floor = [[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]]
    scene = Scene.build(
        camera=CAMERA,
        objects={"floor": {"rectangle": {"corners": floor}, "material": "grey"}},
        materials={"grey": diffuse(0.3)},
        lights={"sun": sun},
    )
    solution = solve(scene, elements=200)
    luminance = 0.3 * 20000.0 / np.pi
    if facing == "wall":
        points, normal = [[x, y, -1.5] for x in (0.0, 0.8) for y in (0.3, 1.0, 2.5)], [0, 0, 1]
    else:
        points, normal = [[x, 2.5, z] for x in (0.0, 1.5) for z in (0.0, 1.5)], [0, -1, 0]
    expected = [np.pi * luminance * lambert(point, normal, floor) for point in points]
    check(solution, points, normal, expected, 0.01, samples=16384)


def test_cie_171_light_reflected_to_and_fro_in_a_sphere():
    """What comes by way of walls is Φ ρ / (S (1 − ρ)) everywhere."""
    radius, reflectance, intensity = 2.0, 0.6, 500.0
    scene = Scene.build(
        camera=CAMERA | {"eye": [0.3, 0, 0], "target": [1, 0, 0]},
        objects={"room": {"sphere": {"radius": radius}, "material": "wall"}},
        materials={"wall": diffuse(reflectance)},
        lights={"key": {"kind": "point", "position": [0, 0, 0], "spectrum": "E", "intensity_cd": intensity}},
    )
    solution = solve(scene, elements=400)
    reflected = intensity / radius**2 * reflectance / (1 - reflectance)
    points = [[0.0, 1.0, 0.0], [0.5, -1.2, 0.8], [-1.0, 0.0, 0.0]]
    # Away from the lamp, only walls are seen.
    normals = [[0, 1, 0], [0.5, -1.2, 0.8], [-1, 0, 0]]
    check(solution, points, normals, reflected, 0.01)
    towards = reflected + intensity / np.linalg.norm(points, axis=1) ** 2
    check(solution, points, -np.array(normals), towards, 0.01)


def test_sensors_in_a_room_read_what_path_finds():
    scene = corner(LAMPS)
    solution = solve(scene, elements=3000, form_factors="rays:512")
    points, normals = [[0.5, 0.0, 0.5], [-1.0, 0.8, 0.2]], [[0, 1, 0], [1, 0, 0]]
    found = solution.illuminance(points, normals)
    for point, normal, value in zip(points, normals, found, strict=True):
        camera = {
            "eye": np.array(point) + 0.05 * np.array(normal),
            "target": point,
            "up": [0, 0, 1],
            "field_of_view": 2.0,
            "size": [8, 8],
        }
        image = render(scene.replace(camera=camera), samples=1024)
        # Both surfaces are white, of reflectance 0.8.
        assert value == pytest.approx(np.pi * image.xyz[..., 1].mean() / 0.8, rel=0.015)
    xyz = solution.irradiance_xyz(points, normals)
    assert xyz.shape == (2, 3) and np.array_equal(xyz[:, 1], found)


def test_sensors_must_be_places(solved):
    for points, normals in (([[0, 0]], UP), ([[np.nan, 0, 0]], UP), ([[0, 0, 0]], [np.inf, 0, 0])):
        with pytest.raises(UsageError, match="Points and normals must"):
            solved.illuminance(points, normals)
    with pytest.raises(UsageError, match="samples 0: expected"):
        solved.illuminance([[0, 0, 0]], samples=0)


# What goes together


@pytest.mark.parametrize("technique", ["radiosity", "hybrid", "specular-radiosity"])
@pytest.mark.parametrize("model", ["phong", "blinn", "whitted", "hall", "cook-torrance"])
def test_models_that_create_light_are_refused(technique, model):
    with pytest.raises(
        UsageError, match=f"{technique} does not go with {model}.*more light than it receives"
    ):
        render(corner(LAMPS), technique=technique, illumination=model, samples=1)


@pytest.mark.parametrize("technique", ["radiosity", "hybrid", "specular-radiosity"])
def test_a_model_that_loses_light_is_warned_of(technique, caplog):
    options = {"technique": technique, "samples": 1, "elements": 60, "cube": 8, "form_factors": "rays:64"}
    general = render(corner(LAMPS), **options)
    assert "what is not diffuse is lost" not in caplog.text
    lossy = render(corner(LAMPS), illumination="bouknight", **options)
    assert f"{technique} with bouknight: what is not diffuse is lost" in caplog.text
    # Where all is diffuse nothing is.
    np.testing.assert_allclose(lossy.xyz, general.xyz, rtol=1e-3, atol=1e-3)


def test_options_that_belong_elsewhere_are_refused():
    with pytest.raises(UsageError, match="gather"):
        render(corner(LAMPS), technique="path", gather="full", samples=1)
    with pytest.raises(UsageError, match="frustum goes with hybrid alone"):
        render(corner(LAMPS), technique="radiosity", frustum=4, samples=1, elements=20)
    with pytest.raises(UsageError, match="patches must be 1 or more, and not more than elements"):
        solve(corner(LAMPS), elements=100, patches=101)


# Elements and solvers


def shadow(threshold, elements=300):
    """A floor under a point lamp and a square screen half way up, whose shadow is twice as wide."""
    scene = Scene.build(
        camera={
            "eye": [0, 2.0, 0],
            "target": [0, 0, 0],
            "up": [0, 0, -1],
            "size": [64, 64],
            "field_of_view": 50.0,
        },
        objects={
            "floor": rectangle("grey", [-1.5, 0, -1.5], [0, 0, 3], [3, 0, 0]),
            "screen": rectangle("black", [-0.25, 2.5, -0.21], [0.5, 0, 0], [0, 0, 0.5]),
        },
        materials={"grey": diffuse(0.5), "black": BLACK},
        lights={"key": LIGHTS["point"] | {"position": [0.0, 5.0, 0.0]}},
    )
    return scene, solve(scene, elements=elements, adaptive=threshold, form_factors="rays:64")


def test_adaptive_elements_gather_at_the_edge_of_a_shadow():
    """The shadow lies where rays from the lamp past the screen end."""
    error, density = {}, {}
    for threshold in (None, 0.2):
        scene, solution = shadow(threshold)
        mesh = solution.mesh()
        floor = mesh.objects == 0
        middles = mesh.positions[mesh.faces[floor]].mean(axis=1)
        low, high = np.array([-0.5, -0.42]), np.array([0.5, 0.58])
        x, z = middles[:, 0], middles[:, 2]
        outside = np.maximum(np.maximum(low[0] - x, x - high[0]), np.maximum(low[1] - z, z - high[1]))
        near = np.abs(outside) < 0.1
        density[threshold] = (near.sum(), (~near).sum())
        image = solution.render(samples=64).xyz[..., 1]
        exact = render(scene, samples=64).xyz[..., 1]
        error[threshold] = np.sqrt(np.mean((image - exact) ** 2)) / exact.mean()
    near, far = (b / a for a, b in zip(density[None], density[0.2], strict=True))
    assert near > 5 * far, density
    assert error[0.2] < 0.5 * error[None], error


def test_substructures_save_form_factors():
    """Patches send as elements receive: with a sixth of the patches, the image is nearly the same."""
    scene = corner(LAMPS)
    fine = solve(scene, elements=2400, form_factors="rays:512")
    coarse = solve(scene, elements=2400, patches=400, form_factors="rays:512")
    assert coarse.report["elements"] == pytest.approx(fine.report["elements"], rel=0.05)
    assert coarse.report["patches"] < 0.25 * fine.report["patches"]
    assert coarse.report["form_factors"] < 0.7 * fine.report["form_factors"]
    a, b = (solution.render(samples=16).xyz for solution in (coarse, fine))
    np.testing.assert_allclose(a.mean(axis=(0, 1)), b.mean(axis=(0, 1)), rtol=0.01)


def test_all_solvers_find_the_same():
    scene = corner(LAMPS)
    images = {
        solver: solve(scene, elements=600, form_factors="rays:256", solver=solver).render(samples=4).xyz
        for solver in ("bicgstab", "gauss-seidel", "gauss", "progressive")
    }
    for solver, image in images.items():
        np.testing.assert_allclose(image, images["gauss"], rtol=1e-3, atol=1e-3, err_msg=solver)


def test_form_factors_of_all_methods_make_the_same_image():
    scene = corner(LAMPS)
    images = {
        method: solve(scene, elements=800, form_factors=method).render(samples=16).xyz
        for method in ("rays:2048", "hemicube:64", "scanline:64", "area:16")
    }
    for method, image in images.items():
        mean, other = (one.mean(axis=(0, 1)) for one in (image, images["rays:2048"]))
        np.testing.assert_allclose(mean, other, rtol=0.01, err_msg=method)


def test_threads_change_no_bit():
    images = [
        solve(corner(LAMPS), elements=300, form_factors="rays:64", threads=threads).render(samples=2).xyz
        for threads in (1, 2)
    ]
    assert np.array_equal(*images)
