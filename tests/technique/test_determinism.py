"""The same seed gives the same bits, whatever the number of threads, the tiles, or the split of the samples.

The sums of the film are exact, so every comparison here is of bits (`array_equal`), with no tolerance.
"""

import json

import numpy as np
import pytest

import illuminant
from illuminant.core import core
from illuminant.scene import Scene

SAMPLING = {"sampling": "uniform:8"}


def bumps(n=60, shift=0):
    """A bumpy ground of 2 n² triangles that share their vertices; `shift` turns the list of faces round."""
    x, z = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    y = 0.08 * np.sin(7 * x) * np.cos(5 * z)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + j).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + n + 1], 1)])
    return {"positions": np.stack([x, y, z], -1).reshape(-1, 3), "faces": np.roll(faces, shift, axis=0)}


def crowded(size=(40, 28), **camera) -> Scene:
    """Shared edges, a second ground in the same place, faces listed twice, a true sphere, glass, and two lamps."""
    ground = bumps()
    twice = {"positions": ground["positions"] + [0, 0.2, 0], "faces": np.repeat(ground["faces"][::7], 2, 0)}
    return Scene.build(
        camera={"eye": [0.5, 1.1, 2.6], "target": [0, 0, 0], "size": list(size), **camera},
        objects={
            "ground": {"material": "red", "mesh": ground},
            "same ground": {"material": "green", "mesh": bumps(shift=1234)},
            "flakes": {"material": "green", "mesh": twice},
            "ball": {"material": "glass", "sphere": {"center": [-0.3, 0.5, 0.2], "radius": 0.25}},
            "lamp": {
                "material": "lamp",
                "rectangle": {"corner": [-0.4, 1.5, -0.4], "edges": [[0.8, 0, 0], [0, 0, 0.8]]},
            },
        },
        materials={
            "red": {"kind": "diffuse", "reflectance": "ColorChecker/red"},
            "green": {"kind": "diffuse", "reflectance": "ColorChecker/green"},
            "glass": {"kind": "dielectric", "medium": "BK7"},
            "lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 1000.0, "sides": "both"},
        },
        lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 20.0}},
    )


@pytest.fixture(scope="module")
def scene():
    return crowded()


@pytest.fixture(scope="module")
def whole(scene, core_render):
    """Samples 0 to 16 at once, with default tiles and threads."""
    return xyz_of(core_render(scene, **SAMPLING), (0, 16))


def xyz_of(render, *ranges):
    for first, last in ranges:
        assert render.run(first, last)
    return render.layer("xyz")


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_threads_change_no_bit(core_render, whole, threads):
    """Each render builds its own ray structure with that number of threads too."""
    fresh = crowded()
    assert np.array_equal(xyz_of(core_render(fresh, threads=threads, **SAMPLING), (0, 16)), whole)


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_threads_change_no_bit_of_any_layer(threads):
    scene = Scene.from_bytes(crowded().to_bytes())
    options = {
        "samples": 3,
        "threads": threads,
        "layers": "depth,normal,albedo,samples",
        "keep_spectra": True,
        "lamps": True,
    }
    image = illuminant.render(scene, **options)
    other = illuminant.render(crowded(), **(options | {"threads": 3}))
    assert set(image.layers) == set(other.layers)
    assert {"depth", "normal", "albedo", "spectra", "lamp:lamp", "lamp:sky"} <= set(image.layers)
    for name, layer in image.layers.items():
        assert np.array_equal(layer, other.layers[name]), name


def test_of_two_surfaces_in_one_place_the_first_is_seen(core_render):
    """A tie in distance is broken by the number of the object, then of the triangle: no pixel shows the second."""
    one = Scene.build(
        camera={"eye": [0.1, 2, 0.3], "target": [0, 0, 0], "size": [24, 24], "field_of_view": 30},
        objects={
            "first": {"material": "red", "mesh": bumps()},
            "second": {"material": "green", "mesh": bumps()},
        },
        materials={
            "red": {"kind": "diffuse", "reflectance": 0.5},
            "green": {"kind": "diffuse", "reflectance": 1.0},
        },
        lights={"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 1.0}},
    )
    render = core_render(one, layers=["albedo"], **SAMPLING)
    xyz_of(render, (0, 16))
    assert np.ptp(render.layer("albedo")[..., 1]) == 0
    assert render.layer("albedo")[0, 0, 1] == pytest.approx(0.5)


@pytest.mark.parametrize("tile", [1, 8, 16, 33, 100])
def test_tiles_change_no_bit(scene, core_render, whole, tile):
    assert np.array_equal(xyz_of(core_render(scene, tile=tile, **SAMPLING), (0, 16)), whole)


@pytest.mark.parametrize(
    "ranges",
    [
        [(0, 5), (5, 16)],
        [(5, 16), (0, 5)],
        [(15, 16), (3, 4), (0, 3), (4, 15)],
        [(i, i + 1) for i in range(16)],
    ],
    ids=["two", "the second first", "four in disorder", "one by one"],
)
def test_the_split_of_samples_changes_no_bit(scene, core_render, whole, ranges):
    render = core_render(scene, tile=13, **SAMPLING)
    assert np.array_equal(xyz_of(render, *ranges), whole)
    assert (render.samples() == 16).all()


def test_samples_go_on_beyond_65536(core_render):
    """One scramble of the sequence holds 2¹⁶ samples; from there another is taken, and nothing repeats."""
    tiny = crowded((6, 4))
    at_once = xyz_of(core_render(tiny, **SAMPLING), (65_530, 65_546))
    for split in (65_535, 65_536, 65_537):
        parts = xyz_of(core_render(tiny, **SAMPLING), (65_530, split), (split, 65_546))
        assert np.array_equal(parts, at_once)
    beyond = xyz_of(core_render(tiny, **SAMPLING), (65_536, 65_546))
    assert not np.array_equal(beyond, xyz_of(core_render(tiny, **SAMPLING), (0, 10)))
    far = xyz_of(core_render(tiny, **SAMPLING), (2 * 65_536, 2 * 65_536 + 10))
    assert not np.array_equal(far, beyond)
    # The same light, of course: 2,000 samples on both sides agree in the mean.
    low = xyz_of(core_render(tiny, **SAMPLING), (0, 2000)).mean(axis=(0, 1))
    high = xyz_of(core_render(tiny, **SAMPLING), (64_536, 66_536)).mean(axis=(0, 1))
    assert high == pytest.approx(low, rel=0.02)


def test_a_crop_is_a_part_of_the_whole_image(core_render, whole):
    part = crowded(crop=[7, 3, 30, 25])
    assert np.array_equal(xyz_of(core_render(part, **SAMPLING), (0, 16)), whole[3:25, 7:30])


def test_another_seed_is_another_noise(scene, core_render, whole):
    assert not np.array_equal(xyz_of(core_render(scene, seed=1, **SAMPLING), (0, 16)), whole)


def test_geometry_that_is_shared_gives_the_bits_of_geometry_built_anew(core_render, whole):
    """`replace` changes camera, lamps and materials without building the ray structure again."""
    dark = crowded(eye=[0, 3, 0.1])
    dark.core()
    back = dark.replace(camera={"eye": [0.5, 1.1, 2.6]})
    assert np.array_equal(xyz_of(core_render(back, **SAMPLING), (0, 16)), whole)


def test_a_cancelled_run_holds_whole_samples(scene, core_render, whole):
    """After a cancelled run each pixel holds all samples of the range or none, and those are the right ones."""
    render = core_render(scene, tile=4, threads=1, **SAMPLING)
    assert render.run(0, 4)
    calls = []

    def stop(fraction):
        calls.append(fraction)
        return False

    assert render.run(4, 4000, stop) is False
    assert calls
    held = render.samples()
    assert set(np.unique(held)) <= {4, 4000}
    assert (held == 4).any()
    four = xyz_of(core_render(scene, **SAMPLING), (0, 4))
    assert np.array_equal(render.layer("xyz")[held == 4], four[held == 4])


def test_a_cancelled_run_can_be_taken_up_again(scene, core_render):
    """The cancelled range is run again: tiles that have it keep it, the others catch up, and no bit differs."""
    complete = xyz_of(core_render(scene, **SAMPLING), (0, 400))
    render = core_render(scene, tile=4, threads=1, **SAMPLING)
    assert render.run(0, 400, lambda fraction: fraction == 0) is False
    assert (render.samples() == 400).any()
    assert render.run(0, 400)
    assert (render.samples() == 400).all()
    assert np.array_equal(render.layer("xyz"), complete)


def test_python_renders_the_bits_of_the_core(scene, whole):
    """`illuminant.render` takes the samples in ranges of its own choice."""
    image = illuminant.render(scene, samples=16, **SAMPLING)
    assert np.array_equal(image.xyz, whole)


def test_a_render_stopped_by_its_progress_is_an_image(scene):
    """Returning False from `progress` ends the render early and gives what is done."""
    image = illuminant.render(scene, samples=100_000, progress=lambda progress: False, **SAMPLING)
    assert np.isfinite(image.xyz).all()
    assert image.statistics["least_samples"] < 100_000


def test_geometry_is_the_same_for_any_number_of_threads(scene, core_render, whole):
    """Ray structures of one process, built by 1, 2 and 4 threads, and a scene on each."""
    for threads in (1, 2, 4):
        geometry = core().Geometry(scene.shapes(), scene.placements(), threads)
        built = core().Scene(geometry, json.dumps(scene.description), {})
        render = core().Render(built, json.dumps(SAMPLING))
        assert np.array_equal(xyz_of(render, (0, 16)), whole)
