"""Spectral samplings against each other and against colour-science.

The reference integrates at 1 nm: X = 683 Σ L(λ) x̄(λ), and so on, with straight lines between the points of a
spectrum. colour-science does the same sums from its own copies of the spectra.
"""

import json

import colour
import numpy as np
import pytest

import illuminant
from illuminant import spectra
from illuminant.rendering import replay
from illuminant.scene import Scene

SHAPE = colour.SpectralShape(380, 780, 1)
D65 = np.array([0.95047, 1.0, 1.08883])


def at_1nm(distribution):
    """A spectrum of colour-science at 1 nm: straight lines, zero beyond the ends of a lamp, held for a reflectance."""
    return np.interp(SHAPE.wavelengths, distribution.wavelengths, distribution.values)


def matching():
    return colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(SHAPE).values


def delta_e(a, b, white):
    """ΔE00 of XYZ under a white of the same unit, by colour-science."""
    xy = colour.XYZ_to_xy(white)
    labs = [colour.XYZ_to_Lab(np.asarray(xyz) / white[1], xy) for xyz in (a, b)]
    return colour.delta_E(*labs, method="CIE 2000")


# --- the same paths ---------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cornell(scenes):
    return Scene.load(scenes / "cornell.toml").replace(camera={"size": [32, 32]})


def test_uniform_32_agrees_with_1_nm_on_the_cornell_box(cornell):
    """Mean ΔE00 over the pixels below 0.5, with the same noise in both: the same paths, 8 of each pixel.

    White is the 98th percentile of luminance over what does not emit, with the chromaticity of the lamp.
    """
    coarse = illuminant.render(cornell, samples=8, sampling="uniform:32")
    fine = illuminant.render(cornell, samples=8, sampling="1nm")
    lamp = fine.layers["emission"][..., 0] > 0
    assert lamp.any()
    assert np.array_equal(lamp, coarse.layers["emission"][..., 0] > 0)
    curve = spectra.load("Cornell/light")
    white = np.asarray(curve.at(SHAPE.wavelengths)) @ matching()
    white *= np.percentile(fine.xyz[~lamp][:, 1], 98) / white[1]
    seen = ~lamp & (fine.xyz[..., 1] > 0)
    assert seen.sum() > 500
    differences = delta_e(coarse.xyz[seen], fine.xyz[seen], white)
    assert differences.mean() < 0.5


@pytest.mark.parametrize("sampling", ["uniform:4", "uniform:13", "uniform:32"])
def test_every_sampling_follows_the_same_paths(cornell, sampling):
    """Where a path goes depends on seed, pixel and sample, never on the lanes: vertices are equal bit by bit."""
    for pixel, sample in [((16, 16), 0), ((3, 28), 1), ((20, 9), 2), ((9, 20), 63)]:
        reference = replay(cornell, pixel, sample, sampling="1nm")["passes"]
        assert len(reference) == 13
        other = replay(cornell, pixel, sample, sampling=sampling)["passes"]
        for path in [*reference, *other]:
            assert [(v["object"], v["primitive"], v["position"]) for v in path] == [
                (v["object"], v["primitive"], v["position"]) for v in reference[0]
            ]


def test_lanes_of_a_coarse_sampling_are_those_of_the_reference(cornell):
    """A lane at a whole nm carries what `1nm` has there: `uniform:1` sits at the middle of the range, 580 nm."""
    coarse = illuminant.render(cornell, samples=4, sampling="uniform:1", keep_spectra=True)
    fine = illuminant.render(cornell, samples=4, sampling="1nm", keep_spectra=True)
    assert coarse.wavelengths_nm == pytest.approx([580.0])
    lane = coarse.layers["spectra"][..., 0]
    assert lane == pytest.approx(fine.layers["spectra"][..., 200], rel=1e-5, abs=1e-12)


def test_the_lanes_make_the_xyz(cornell):
    """XYZ = M · lanes, with the matrix that the image carries."""
    image = illuminant.render(cornell, samples=4, sampling="uniform:8", keep_spectra=True)
    assert image.layers["spectra"] @ image.to_xyz.T == pytest.approx(image.xyz, rel=1e-5)


# --- ColorChecker -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "name"),
    [("colorchecker-d65", "D65"), ("colorchecker-a", "A"), ("colorchecker-fl11", "FL11")],
)
def test_the_colorchecker_has_the_xyz_of_colour_science(scenes, file, name):
    """XYZ of each patch = 1000 cd/m² · Σ S ρ (x̄, ȳ, z̄) / Σ S ȳ within 0.5 %."""
    scene = Scene.load(scenes / f"{file}.toml")
    image = illuminant.render(scene, samples=2, size=(60, 40), sampling="1nm")
    lamp = np.interp(
        SHAPE.wavelengths,
        colour.SDS_ILLUMINANTS[name].wavelengths,
        colour.SDS_ILLUMINANTS[name].values,
        left=0.0,
        right=0.0,
    )
    patches = colour.SDS_COLOURCHECKERS["BabelColor Average"]
    assert len(patches) == 24
    pixels_per_mm = 60 / (2 * 800 * np.tan(np.radians(21.2 / 2)))
    for i, (patch, distribution) in enumerate(patches.items()):
        row, column = divmod(i, 6)
        x, y = -115 + 46 * column, 69 - 46 * row
        px, py = int(30 + x * pixels_per_mm), int(20 - y * pixels_per_mm)
        light = lamp * at_1nm(distribution)
        expected = 1000 * (light @ matching()) / (lamp @ matching()[:, 1])
        found = image.xyz[py - 1 : py + 2, px - 1 : px + 2].reshape(-1, 3)
        assert np.ptp(found, axis=0) == pytest.approx(0, abs=1e-3 * expected[1]), patch
        assert found.mean(axis=0) == pytest.approx(expected, rel=0.005), patch


# --- neutral scenes, metamers -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("sampling", "tolerance"), [("1nm", 0.05), ("uniform:32", 0.5)])
def test_a_neutral_scene_stays_neutral(measure, sampling, tolerance):
    """Grey RGB walls under white RGB light: X : Y : Z is that of sRGB's white, after any number of bounces.

    The tolerance, in ΔE00, is that of the sampling; grey adds nothing to it, so direct and reflected light agree
    in colour ten times better.
    """
    white = {"rgb": [1.0, 1.0, 1.0], "role": "emission"}
    scene = Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, 1], "size": [8, 8], "field_of_view": 80},
        objects={
            "room": {"material": "grey", "box": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
            "lamp": {
                "material": "lamp",
                "rectangle": {"corner": [-0.5, 0.99, -0.5], "edges": [[1, 0, 0], [0, 0, 1]]},
            },
        },
        materials={
            "grey": {"kind": "diffuse", "reflectance": {"rgb": [0.6, 0.6, 0.6], "role": "albedo"}},
            "lamp": {"kind": "emitter", "spectrum": white, "luminance_cd_m2": 100.0},
        },
    )
    walls = measure(scene, samples=16, sampling=sampling)
    assert delta_e(walls.xyz, walls.Y * D65, walls.Y * D65) < tolerance
    up = scene.replace(camera={"target": [0, 1, 0], "up": [0, 0, 1], "field_of_view": 10})
    lamp = measure(up, samples=1, depth=1, sampling=sampling)
    assert delta_e(walls.xyz / walls.Y, lamp.xyz / lamp.Y, D65) < 0.05


@pytest.mark.parametrize("level", [0.02, 0.18, 0.5, 0.9, 1.0])
def test_a_grey_albedo_has_its_value_at_every_wavelength(measure, level):
    """RGB (g, g, g) as albedo reflects the fraction g everywhere."""
    scene = Scene.build(
        camera={"eye": [0, 0, 1], "target": [0, 0, 0], "size": [2, 2], "field_of_view": 5},
        objects={
            "wall": {
                "material": "grey",
                "rectangle": {"corner": [-1, -1, 0], "edges": [[2, 0, 0], [0, 2, 0]]},
            }
        },
        materials={"grey": {"kind": "diffuse", "reflectance": {"rgb": [level] * 3, "role": "albedo"}}},
        lights={"sky": {"kind": "environment", "spectrum": 1.0, "radiance_scale": 1.0}},
    )
    lanes = measure(scene, samples=4, sampling="uniform:32").lanes
    assert lanes == pytest.approx(np.full(32, level), rel=0.005)


@pytest.mark.parametrize("sampling", ["1nm", "uniform:32"])
def test_metamers_match_under_d65_and_not_under_a(scenes, sampling):
    """Two paints side by side under parallel light: ΔE00 in the rendered image below 0.5 under D65, above 5 under A."""
    differences = {}
    for lamp in ("D65", "A"):
        scene = Scene.build(
            camera={"eye": [0, 0, 1], "target": [0, 0, 0], "size": [8, 4], "field_of_view": 40},
            objects={
                name: {"material": name, "rectangle": {"corner": [x, -1, 0], "edges": [[1, 0, 0], [0, 2, 0]]}}
                for name, x in (("paint A", -1), ("paint B", 0))
            },
            materials={
                f"paint {one}": {
                    "kind": "diffuse",
                    "reflectance": {"file": f"spectra/metamer_{one.lower()}.csv"},
                }
                for one in "AB"
            },
            lights={
                "sun": {
                    "kind": "directional",
                    "direction": [0, 0, -1],
                    "spectrum": lamp,
                    "illuminance_lx": 1000 * np.pi,
                }
            },
            directory=scenes,
        )
        image = illuminant.render(scene, samples=2, sampling=sampling, filter="box")
        light = np.interp(
            SHAPE.wavelengths,
            colour.SDS_ILLUMINANTS[lamp].wavelengths,
            colour.SDS_ILLUMINANTS[lamp].values,
        )
        white = 1000 * (light @ matching()) / (light @ matching()[:, 1])
        left, right = image.xyz[:, :4].mean(axis=(0, 1)), image.xyz[:, 4:].mean(axis=(0, 1))
        differences[lamp] = float(delta_e(left, right, white))
    assert differences["D65"] < 0.5, json.dumps(differences)
    assert differences["A"] > 5, json.dumps(differences)


def test_two_lamps_keep_their_own_spectra(measure):
    """The layer of each lamp is its own light, and together they are the image."""
    scene = Scene.build(
        camera={"eye": [0, 0, 1], "target": [0, 0, 0], "size": [4, 4], "field_of_view": 5},
        objects={
            "wall": {
                "material": "white",
                "rectangle": {"corner": [-1, -1, 0], "edges": [[2, 0, 0], [0, 2, 0]]},
            }
        },
        materials={"white": {"kind": "diffuse", "reflectance": 1.0}},
        lights={
            "left": {"kind": "point", "position": [-1, 0, 2], "spectrum": "A", "intensity_cd": 100},
            "right": {"kind": "point", "position": [1, 0, 2], "spectrum": "D65", "intensity_cd": 300},
        },
    )
    image = measure(scene, samples=256, sampling="uniform:32", lamps=True).image
    left, right = image.layers["lamp:left"], image.layers["lamp:right"]
    assert left + right == pytest.approx(image.xyz, rel=1e-6)
    for layer, candela in ((left, 100), (right, 300)):
        assert layer[..., 1].mean() == pytest.approx(candela * 2 / 5**1.5 / np.pi, rel=0.003)
    ratio = right.mean(axis=(0, 1))
    assert ratio / ratio[1] == pytest.approx(D65, rel=0.005)
