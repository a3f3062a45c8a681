"""Developing again: powers, observers, lamps, cameras and regular grids, against closed forms and renders."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import illuminant
from illuminant import spectra
from illuminant.core import core
from illuminant.difference import diff
from illuminant.display.developing import described, develop, lamps_of
from illuminant.display.lane_weights import LaneWeights
from illuminant.display.observer import named, standard
from illuminant.display.refitting import error_of, fitted, integrated, nonnegative, products
from illuminant.errors import DataError, ImageError, UsageError
from illuminant.image import Image
from illuminant.kept_spectra import KeptSpectra, LampLight
from illuminant.scene import Scene

NM = np.arange(380.0, 781.0)
SIZE = [32, 32]


def room(ceiling: str = "D65", desk: str = "A") -> Scene:
    """A box with coloured walls, a lamp at its ceiling and one that stands on the floor."""
    paints = ("foliage", "moderate red", "blue sky", "orange", "neutral 6.5")
    materials: dict[str, Any] = {
        paint: {"kind": "diffuse", "reflectance": f"ColorChecker/{paint}"} for paint in paints
    }
    walls = {
        "floor": ("neutral 6.5", [[0, 0, 0], [0, 0, 2], [2, 0, 2], [2, 0, 0]]),
        "ceiling": ("neutral 6.5", [[0, 2, 0], [2, 2, 0], [2, 2, 2], [0, 2, 2]]),
        "left": ("moderate red", [[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]]),
        "right": ("foliage", [[2, 0, 0], [2, 0, 2], [2, 2, 2], [2, 2, 0]]),
        "back": ("blue sky", [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]),
    }
    objects: dict[str, Any] = {
        name: {"material": paint, "rectangle": {"corners": corners}}
        for name, (paint, corners) in walls.items()
    }
    objects["ball"] = {"material": "orange", "sphere": {"center": [0.7, 0.35, 0.8], "radius": 0.35}}
    return Scene.build(
        camera={"eye": [1, 1, 4.6], "target": [1, 1, 0], "field_of_view": 42.0, "size": SIZE},
        materials=materials,
        objects=objects,
        lights={
            "ceiling lamp": {"kind": "point", "position": [1, 1.8, 1], "spectrum": ceiling, "flux_lm": 900},
            "desk": {"kind": "point", "position": [1.5, 0.3, 1.4], "spectrum": desk, "flux_lm": 300},
        },
    )


def rendered(scene: Scene, **options: Any) -> Image:
    return illuminant.render(scene, **{"samples": 8, "sampling": "fitted:8", "depth": 4, **options})


@pytest.fixture(scope="module")
def kept() -> Image:
    """The room with its light groups, as it is rendered."""
    return rendered(room(), keep_spectra=True, lamps=True)


@pytest.fixture(scope="module")
def prepared() -> Image:
    """The same, with a sampling that was fitted to the lamps which the tests put in."""
    return rendered(room(), keep_spectra=True, lamps=True, develop_for="FL11,A")


def synthetic(sampling: str, wavelengths: np.ndarray, lamp: np.ndarray, filters: np.ndarray) -> Image:
    """An image of one lamp whose pixels show filters (P, n), in lanes at some wavelengths."""
    at = np.stack([np.interp(wavelengths, NM, row) for row in filters])
    light = np.interp(wavelengths, NM, lamp)
    to_xyz = integrated(NM, wavelengths, standard(NM).functions)
    basis = KeptSpectra(sampling, (380, 780), wavelengths, (LampLight("lamp", lamp, light),), filters)
    lanes = (at * light)[None]
    return Image(
        lanes @ to_xyz.T,
        layers={"spectra": lanes},
        wavelengths_nm=wavelengths,
        to_xyz=to_xyz,
        basis=basis,
    )


def paints() -> np.ndarray:
    names = [name for name in spectra.names("reflectance") if name.startswith("ColorChecker/")]
    return np.stack([spectra.load(name).at(NM) for name in names])


# --- what a render keeps ----------------------------------------------------------------------------------------


def test_light_groups_add_up_to_the_image(kept: Image) -> None:
    assert lamps_of(kept) == ["ceiling lamp", "desk"]
    for layer, total in (("lamp", kept.xyz), ("spectra", kept.layers["spectra"])):
        parts = sum(kept.layers[f"{layer}:{name}"] for name in lamps_of(kept))
        assert np.abs(parts - total).max() <= 1e-6 * total.max()


def test_the_lanes_of_a_lamp_make_its_xyz(kept: Image) -> None:
    assert kept.to_xyz is not None
    for name in lamps_of(kept):
        made = kept.layers[f"spectra:{name}"] @ kept.to_xyz.T
        assert np.allclose(made, kept.layers[f"lamp:{name}"], rtol=1e-5, atol=1e-6 * kept.xyz.max())


def test_the_lanes_of_a_lamp_are_its_light_times_reflectances(kept: Image) -> None:
    # With one segment more than the lamp's the path has met one surface: at the back wall, one reflectance.
    image = rendered(room(), keep_spectra=True, lamps=True, depth=2)
    assert image.basis is not None
    light = {lamp.name: lamp.lanes for lamp in image.basis.lamps}
    wall = spectra.load("ColorChecker/blue sky").at(image.basis.wavelengths_nm)
    for name in lamps_of(image):
        found = image.layers[f"spectra:{name}"][8, 16] / light[name]
        assert np.allclose(found / found.mean(), wall / wall.mean(), rtol=1e-4)


def test_a_file_keeps_everything_that_developing_needs(kept: Image, tmp_path: Path) -> None:
    kept.save(tmp_path / "room.exr")
    again = Image.open(tmp_path / "room.exr")
    assert kept.basis is not None and again.basis is not None
    assert again.basis.sampling == "fitted:8"
    assert np.array_equal(again.basis.wavelengths_nm, kept.basis.wavelengths_nm)
    for before, after in zip(kept.basis.lamps, again.basis.lamps, strict=True):
        assert before.name == after.name
        assert np.allclose(before.spectrum, after.spectrum, rtol=1e-8)
        assert np.allclose(before.lanes, after.lanes, rtol=1e-8)
    for name in ("spectra", "spectra:desk", "spectra:ceiling lamp"):
        assert np.allclose(again.layers[name], kept.layers[name], rtol=1e-6)
    made = [develop(image, lamps={"desk": "D65"}).xyz for image in (kept, again)]
    assert np.allclose(made[0], made[1], rtol=1e-5, atol=1e-6)


def test_many_lanes_of_a_lamp_come_back_in_their_order(tmp_path: Path) -> None:
    from illuminant import exr

    lanes = np.arange(12.0).reshape(1, 1, 12)
    wavelengths = 400.0 + 25.125 * np.arange(12)
    contents = exr.Contents(
        np.ones((1, 1, 3)),
        layers={"spectra": lanes, "spectra:a.b lamp": 2 * lanes},
        wavelengths_nm=wavelengths,
    )
    exr.write(tmp_path / "a.exr", contents)
    again = exr.read(tmp_path / "a.exr")
    assert np.array_equal(again.layers["spectra"], lanes)
    assert np.array_equal(again.layers["spectra:a.b lamp"], 2 * lanes)
    assert again.wavelengths_nm is not None and np.allclose(again.wavelengths_nm, wavelengths)


# --- powers -----------------------------------------------------------------------------------------------------


def test_without_changes_it_is_the_image_itself(kept: Image) -> None:
    for made in (develop(kept), develop(kept, power={"desk": 1.0}), develop(kept, observer="2")):
        assert np.array_equal(made.xyz, kept.xyz)
        assert made.settings == kept.settings


def test_a_lamp_without_power_is_a_lamp_that_is_not_there(kept: Image) -> None:
    made = develop(kept, power={"desk": 0.0})
    assert np.allclose(made.xyz, kept.layers["lamp:ceiling lamp"], atol=1e-6 * kept.xyz.max())


def test_powers_are_linear_and_their_lanes_follow(kept: Image) -> None:
    made = develop(kept, power={"desk": 3.0, "ceiling lamp": 0.25})
    expected = 3.0 * kept.layers["lamp:desk"] + 0.25 * kept.layers["lamp:ceiling lamp"]
    assert np.allclose(made.xyz, expected, rtol=1e-5)
    assert made.to_xyz is not None
    assert np.allclose(made.layers["spectra"] @ made.to_xyz.T, made.xyz, rtol=1e-5)
    back = develop(made, power={"desk": 1 / 3, "ceiling lamp": 4.0})
    assert np.allclose(back.xyz, kept.xyz, rtol=1e-5)
    assert len(back.settings["developed"]) == 2


def test_layers_of_xyz_are_enough_for_powers() -> None:
    image = rendered(room(), lamps=True)
    assert np.allclose(develop(image, power={"desk": 0.0}).xyz, image.layers["lamp:ceiling lamp"], rtol=1e-5)
    with pytest.raises(ImageError, match="keeps no spectra"):
        develop(image, lamps={"desk": "A"})


# --- observers --------------------------------------------------------------------------------------------------


def test_spectra_are_not_written_of_lamps_whose_lanes_are_not_known(kept: Image) -> None:
    alone = {name: layer for name, layer in kept.layers.items() if not name.startswith("spectra:")}
    image = dataclasses.replace(kept, layers=alone)
    for change in (
        {"power": {"desk": 0.0}},
        {"power": {"desk": 2.0}, "observer": "10"},
        {"lamps": {"desk": "A"}},
    ):
        with pytest.raises(ImageError, match="lanes of lamp 'desk' are not kept apart"):
            develop(image, regular=10, **change)
    made = develop(image, regular=10)
    assert made.to_xyz is not None
    y = (made.layers["spectra"] @ made.to_xyz.T)[..., 1].sum()
    assert y == pytest.approx(image.xyz[..., 1].sum(), rel=0.01)
    # Where lanes are kept apart, what is written is what is left.
    off = develop(kept, power={"desk": 0.0}, regular=10)
    assert off.to_xyz is not None
    y = (off.layers["spectra"] @ off.to_xyz.T)[..., 1].sum()
    assert y == pytest.approx(off.xyz[..., 1].sum(), rel=0.01)


def test_a_layer_that_is_no_light_is_refused() -> None:
    ones = np.ones((2, 3, 3))
    for layer in (ones[..., :2], ones[:1]):
        image = Image(2 * ones, layers={"lamp:one": ones, "lamp:two": layer})
        with pytest.raises(ImageError, match=r"layer 'lamp:two' of a\.exr cannot be a part .* \(2, 3, 3\)"):
            develop(image, power={"two": 0.0}, name="a.exr")


def test_every_nm_is_integrated_by_hand() -> None:
    # Every nm of eight: the lanes of the render itself, summed with the functions of the 10° observer.
    scene = Scene.build(
        camera={"eye": [0, 0, 2], "target": [0, 0, 0], "size": [4, 4]},
        materials={"paint": {"kind": "diffuse", "reflectance": "ColorChecker/orange"}},
        objects={"ball": {"material": "paint", "sphere": {"radius": 0.8}}},
        lights={"lamp": {"kind": "point", "position": [1, 1, 3], "spectrum": "D65", "flux_lm": 900}},
        range_nm=(550, 557),
    )
    image = illuminant.render(scene, sampling="1nm", samples=4, keep_spectra=True)
    functions = core().matching_functions(np.arange(550.0, 558.0), "CIE 1964 10°")
    by_hand = 683.0 * image.layers["spectra"] @ functions
    assert by_hand.max() > 0
    assert np.abs(develop(image, observer="10").xyz - by_hand).max() <= 1e-9 * by_hand.max()


def test_every_nm_of_the_visible_is_integrated_by_hand() -> None:
    image = synthetic("1nm", NM, spectra.load("FL11").at(NM), paints())
    by_hand = 683.0 * image.layers["spectra"] @ core().matching_functions(NM, "CIE 1964 10°")
    assert np.abs(develop(image, observer="10").xyz - by_hand).max() <= 1e-9 * by_hand.max()


def test_fitted_wavelengths_see_what_ten_degrees_see(kept: Image) -> None:
    made = develop(kept, observer="10")
    [how] = made.settings["developed"]
    assert how["observer"] == "CIE 1964 10°"
    assert set(how["refit"]) == {"ceiling lamp", "desk"}
    assert all(cost["mean"] < 0.2 and cost["max"] < 1.5 for cost in how["refit"].values())
    fine = develop(rendered(room(), keep_spectra=True, lamps=True, sampling="1nm"), observer="10")
    found = diff(fine, made)
    assert found.mean < 0.15 and found.max < 0.6


def test_lamps_that_were_not_kept_apart_share_their_weights() -> None:
    image = rendered(room(), keep_spectra=True)
    assert lamps_of(image) == []
    made = develop(image, observer="10")
    [how] = made.settings["developed"]
    assert set(how["refit"]) == {"all lamps"}
    assert how["refit"]["all lamps"]["mean"] < 0.3
    apart = develop(rendered(room(), keep_spectra=True, lamps=True), observer="10")
    assert diff(apart, made).mean < 0.3


# --- lamps ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lamp", ["A", "FL11", "D50"])
def test_at_every_nm_a_new_lamp_is_exact(lamp: str) -> None:
    old, new = spectra.load("D65").at(NM), spectra.load(lamp).at(NM)
    eye = standard(NM).functions
    new = new * (old @ eye[:, 1]) / (new @ eye[:, 1])
    made = develop(synthetic("1nm", NM, old, paints()), lamps={"lamp": lamp})
    expected = (paints() * new) @ eye
    assert np.allclose(made.xyz[0], expected, rtol=1e-9)


def test_a_new_lamp_has_the_luminance_of_the_old_one(kept: Image) -> None:
    weights = LaneWeights(kept.basis, "room.exr")  # type: ignore[arg-type]
    lamp = next(lamp for lamp in weights.basis.lamps if lamp.name == "desk")
    new = spectra.load("FL11").at(NM)
    bare = weights.of_lamp(lamp, standard(NM), new) @ lamp.lanes
    assert np.allclose(bare, new @ standard(NM).functions, rtol=1e-4)


@pytest.mark.parametrize(("lamp", "bound", "without"), [("FL11", 0.2, 0.25), ("A", 0.1, 0.1)])
def test_a_room_developed_for_a_lamp_is_the_room_rendered_with_it(
    kept: Image, prepared: Image, lamp: str, bound: float, without: float
) -> None:
    truth = rendered(room(lamp, lamp), sampling="1nm")
    change = {"ceiling lamp": lamp, "desk": lamp}
    made = develop(prepared, lamps=change)
    assert diff(truth, made).mean <= bound
    assert diff(truth, develop(kept, lamps=change)).mean <= without
    [how] = made.settings["developed"]
    assert how["lamps"] == change
    assert all(cost["mean"] <= 0.3 for cost in how["refit"].values())


def test_a_sampling_made_for_lamps_serves_them_better(kept: Image, prepared: Image) -> None:
    change = {"ceiling lamp": "FL11"}
    costs = [
        develop(image, lamps=change).settings["developed"][0]["refit"]["ceiling lamp"]["mean"]
        for image in (kept, prepared)
    ]
    assert costs[1] < costs[0]
    assert prepared.settings["develop_for"] == "FL11,A"
    assert prepared.basis is not None and prepared.basis.develop_for == ("FL11", "A")


def test_the_same_lamp_again_changes_little(kept: Image) -> None:
    assert diff(kept, develop(kept, lamps={"ceiling lamp": "D65", "desk": "A"})).mean < 0.1


def test_a_lamp_that_is_dark_in_most_lanes_is_refused() -> None:
    line = np.where(np.abs(NM - 589.0) < 3, 1.0, 0.0)
    wavelengths = np.array([450.0, 500.0, 550.0, 589.0, 620.0, 660.0])
    image = synthetic("fitted:6", wavelengths, line, paints())
    with pytest.raises(ImageError, match="light in 1 of the 6 wavelengths"):
        develop(image, lamps={"lamp": "D65"})
    # Two lines and what is between: the dark lane is told of, and counts for nothing.
    some = np.where(np.abs(NM - 500.0) < 10, 0.0, 1.0)
    made = develop(synthetic("fitted:6", wavelengths, some, paints()), lamps={"lamp": "D65"})
    assert made.settings["developed"][0]["dark"] == {"lamp": 1}


def test_one_lamp_is_always_kept_apart() -> None:
    image = synthetic("1nm", NM, np.ones(401), paints())
    assert lamps_of(image) == ["lamp"]
    assert np.allclose(develop(image, power={"lamp": 2.0}).xyz, 2.0 * image.xyz)


# --- weights ----------------------------------------------------------------------------------------------------


def test_weights_that_can_be_exact_are() -> None:
    rng = np.random.default_rng(1)
    features = rng.uniform(0.1, 1.0, (200, 5))
    exact = rng.uniform(0.0, 2.0, (3, 5))
    targets = features @ exact.T
    white = np.tile(exact.sum(axis=1), (200, 1))
    found = fitted(features, targets, white, np.ones(200), np.zeros((3, 5)))
    assert np.allclose(found, exact, rtol=1e-4, atol=1e-6)
    assert error_of(found, features, targets, white).max < 1e-3


def test_negative_weights_are_kept_at_zero_by_the_conditions_of_the_optimum() -> None:
    rng = np.random.default_rng(2)
    for _ in range(20):
        m = rng.normal(size=(12, 8))
        a, b = m.T @ m, m.T @ rng.normal(size=12)
        x = nonnegative(a, b)
        slope = a @ x - b
        assert (x >= 0).all() and (slope > -1e-8).all() and np.abs(x * slope).max() < 1e-8


def test_products_are_the_same_each_time_and_begin_with_white() -> None:
    first, second = products(paints(), NM), products(paints(), NM)
    assert np.array_equal(first.filters, second.filters)
    assert np.array_equal(first.filters[0], np.ones(401))
    assert first.filters[: first.known].max() <= 1.0


# --- cameras ----------------------------------------------------------------------------------------------------


def camera(path: Path, columns: int = 3) -> Path:
    """The 2° observer, mixed by a matrix: a camera that can be made exact."""
    mixed = core().matching_functions(NM, "CIE 1931 2°") @ np.array([[2, 0.1, 0], [0.2, 1, 0.1], [0, 0.1, 3]])
    rows = np.column_stack([NM, mixed[:, :columns]])
    path.write_text("\n".join(",".join(f"{value:.9g}" for value in row) for row in rows))
    return path


def test_a_camera_that_is_the_observer_mixed_is_unmixed_by_its_matrix(kept: Image, tmp_path: Path) -> None:
    made = develop(kept, observer=str(camera(tmp_path / "luther.csv")))
    [how] = made.settings["developed"]
    assert how["camera"]["max"] < 0.01
    assert diff(kept, made).mean < 0.1


def test_a_balanced_camera_shows_the_light_of_the_scene_white(tmp_path: Path) -> None:
    lamp = spectra.load("A").at(NM)
    eye = named(str(camera(tmp_path / "luther.csv")), NM, lamp, "balance")
    white = np.linalg.solve(core().rgb_system("sRGB")["to_xyz"], lamp @ eye.functions)
    assert np.allclose(white, white[0])
    assert np.isclose(lamp @ eye.functions[:, 1], lamp @ standard(NM).functions[:, 1])


def test_a_camera_by_a_matrix_from_a_file(tmp_path: Path) -> None:
    path = camera(tmp_path / "luther.csv")
    inverse = np.linalg.inv(np.array([[2, 0.1, 0], [0.2, 1, 0.1], [0, 0.1, 3]])).T
    (tmp_path / "m.csv").write_text("\n".join(",".join(map(repr, row)) for row in inverse.tolist()))
    lamp = spectra.load("A").at(NM)
    eye = named(str(path), NM, lamp, str(tmp_path / "m.csv"))
    assert np.allclose(eye.functions, standard(NM).functions, rtol=1e-6, atol=1e-4)


# --- regular grids ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("step", [5, 10])
def test_readers_of_a_regular_grid_see_the_colours_of_the_image(kept: Image, step: int) -> None:
    made = develop(kept, regular=step)
    assert np.array_equal(made.xyz, kept.xyz)
    assert made.wavelengths_nm is not None
    assert np.array_equal(made.wavelengths_nm, np.arange(380.0, 781.0, step))
    lanes = made.layers["spectra"].astype(np.float64)
    assert lanes.min() >= 0
    read = Image(step * 683.0 * lanes @ core().matching_functions(made.wavelengths_nm, "CIE 1931 2°"))
    assert diff(kept, read).mean < 0.05
    told = made.settings["developed"][0]["regular"]
    assert told["step_nm"] == step and told["sum"]["mean"] < 0.05 and told["lines"]["mean"] < 0.05


def test_what_is_known_at_every_nm_is_written_every_nm() -> None:
    image = synthetic("1nm", NM, spectra.load("D65").at(NM), paints())
    made = develop(image, regular=1.0)
    assert np.allclose(made.layers["spectra"], image.layers["spectra"], rtol=1e-5)


def test_a_regular_spectrum_is_near_the_one_that_was_lost() -> None:
    wavelengths = np.array([420.0, 460.0, 500.0, 540.0, 580.0, 610.0, 650.0, 700.0])
    lamp = spectra.load("FL11").at(NM)
    image = synthetic("fitted:8", wavelengths, lamp, paints())
    image.xyz = ((paints() * lamp) @ standard(NM).functions)[None]
    made = develop(image, regular=5.0, lamps={"lamp": "FL11"})
    assert made.wavelengths_nm is not None
    truth = paints() * lamp
    lines = [np.interp(NM, made.wavelengths_nm, row) for row in made.layers["spectra"][0]]
    off = np.abs(np.array(lines) - truth)[:, 40:301].mean() / truth[:, 40:301].mean()
    assert off < 0.25


def test_colour_science_reads_the_regular_file(kept: Image, tmp_path: Path) -> None:
    colour = pytest.importorskip("colour")
    made = develop(kept, regular=10)
    made.save(tmp_path / "regular.exr")
    components = colour.read_spectral_image_Fichet2021(str(tmp_path / "regular.exr"))
    wavelengths, lanes = components["S0"]
    assert made.wavelengths_nm is not None and np.allclose(wavelengths, made.wavelengths_nm)
    lanes = lanes.astype(np.float64)
    assert np.allclose(lanes, made.layers["spectra"], rtol=1e-6)
    shape = colour.SpectralShape(380, 780, 10)
    functions = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    xyz = colour.msds_to_XYZ(
        lanes.reshape(-1, len(wavelengths)), cmfs=functions, method="Integration", shape=shape, k=683.0
    )
    read = Image(xyz.reshape(kept.xyz.shape))
    assert diff(kept, read).mean < 0.1


# --- what is told, and what is refused --------------------------------------------------------------------------


def test_the_settings_say_what_was_done(kept: Image, tmp_path: Path) -> None:
    made = develop(kept, lamps={"desk": "2856K"}, power={"ceiling lamp": 0.5}, observer="10")
    made.save(tmp_path / "made.exr")
    [how] = Image.open(tmp_path / "made.exr").settings["developed"]
    assert how == json.loads(json.dumps(made.settings["developed"][0]))
    said = "; ".join(described(how))
    assert "CIE 1964 10°" in said and "lamp desk with the spectrum 2856K, ΔE00" in said
    assert "lamp ceiling lamp times 0.5" in said
    assert made.settings["sampling"] == kept.settings["sampling"]


def test_what_another_observer_saw_is_not_taken_for_the_standard_one(kept: Image) -> None:
    made = develop(kept, observer="10")
    assert np.array_equal(develop(made, observer="10").xyz, made.xyz)
    assert np.allclose(develop(made, power={"desk": 2.0}).xyz, made.xyz + made.layers["lamp:desk"])
    with pytest.raises(ImageError, match="keeps no spectra"):
        develop(made, observer="2")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"lamps": {"dask": "A"}}, "There is no lamp 'dask' in The image; there are ceiling lamp, desk"),
        ({"power": {"sun": 1.0}}, "there are ceiling lamp, desk"),
        ({"power": {"desk": -1.0}}, "expected a factor from 0 up"),
        ({"power": {"desk": float("nan")}}, "expected a factor from 0 up"),
        ({"observer": "3"}, "there is no such observer"),
        ({"regular": 0.0}, "expected a step from 1 to 20 nm"),
    ],
)
def test_wrong_wishes_are_refused(kept: Image, options: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        develop(kept, **options)


def test_what_is_no_lamp_is_refused(kept: Image) -> None:
    for word in ("ColorChecker/red", "no such lamp", "gold.n"):
        with pytest.raises(DataError):
            develop(kept, lamps={"desk": word})


def test_a_camera_with_other_columns_is_refused(kept: Image, tmp_path: Path) -> None:
    path = camera(tmp_path / "two.csv", columns=2)
    with pytest.raises(DataError, match="3 columns; expected 4"):
        develop(kept, observer=str(path))
    with pytest.raises(UsageError, match="--matrix"):
        develop(kept, observer=str(camera(tmp_path / "three.csv")), matrix="no.csv")
    (tmp_path / "m.csv").write_text("1,0,0\n0,1\n0,0,1\n")
    with pytest.raises(DataError, match="three lines of three numbers"):
        develop(kept, observer=str(tmp_path / "three.csv"), matrix=str(tmp_path / "m.csv"))


def test_samples_that_are_no_wavelengths_are_refused() -> None:
    image = rendered(room(), keep_spectra=True, lamps=True, sampling="hall:8:even")
    with pytest.raises(ImageError, match="hall:8:even, whose samples are no wavelengths"):
        develop(image, observer="10")
    assert np.allclose(develop(image, power={"desk": 0.0}).xyz, image.layers["lamp:ceiling lamp"], rtol=1e-5)


def test_images_without_lanes_or_lamps_say_what_is_missing(kept: Image) -> None:
    plain = Image(kept.xyz)
    with pytest.raises(ImageError, match="keeps no spectra: render it again with --keep-spectra --lamps"):
        develop(plain, observer="10")
    with pytest.raises(ImageError, match="does not keep the light of its lamps apart"):
        develop(plain, power={"desk": 2.0})
    foreign = Image(kept.xyz, layers={"spectra": kept.layers["spectra"]}, wavelengths_nm=kept.wavelengths_nm)
    with pytest.raises(ImageError, match="does not say what its spectra mean"):
        develop(foreign, observer="10")


@pytest.mark.parametrize(
    "damage",
    [{"lamps": 3}, {"curves": [[1.0]]}, {"wavelengths_nm": [500.0]}, {"reflectances": [["x"]]}, "no JSON"],
)
def test_a_damaged_basis_is_one_sentence(kept: Image, damage: Any, tmp_path: Path) -> None:
    from illuminant import exr

    kept.save(tmp_path / "room.exr")
    contents = exr.read(tmp_path / "room.exr")
    text = contents.attributes["basis"]
    contents.attributes["basis"] = (
        damage if isinstance(damage, str) else json.dumps(json.loads(text) | damage)
    )
    exr.write(tmp_path / "damaged.exr", contents)
    with pytest.raises(ImageError, match=r"damaged\.exr cannot be read: "):
        Image.open(tmp_path / "damaged.exr")


def test_lamps_to_develop_for_go_with_fitted_samplings() -> None:
    with pytest.raises(UsageError, match="only fitted:N is made for lamps"):
        rendered(room(), sampling="uniform:8", develop_for="A")
    with pytest.raises(UsageError, match="--develop-for FL99"):
        rendered(room(), develop_for="FL99")
