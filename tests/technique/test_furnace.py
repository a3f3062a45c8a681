"""White furnaces: where light is in equilibrium, its radiance is known in closed form.

In a closed room whose walls emit E and reflect the fraction ρ diffusely, the radiance L is the same everywhere and in
every direction, whatever the room's shape: L = E + ρ L, so L = E / (1 − ρ). A body that absorbs nothing takes no
part in equilibrium: before uniform surroundings it cannot be seen. In a medium of index n equilibrium radiance is
n² L; the two factors cancel on the way out (Hall 1989, section 2.2; Walter et al. 2007, appendix).
"""

import numpy as np
import pytest

from illuminant.scene import Scene

TOLERANCE = 0.003

WAVELENGTHS = [380.0, 450.0, 550.0, 620.0, 780.0]
EMISSION = [0.4, 2.0, 1.0, 3.0, 0.2]


def room(reflectance, shape) -> Scene:
    spectrum = {"wavelengths_nm": WAVELENGTHS, "values": EMISSION}
    return Scene.build(
        camera={
            "eye": [0.3, -0.2, 0.1],
            "target": [1.0, 0.4, 0.5],
            "size": [16, 16],
            "field_of_view": 100,
        },
        objects={"room": {"material": "wall", **shape}},
        materials={
            "wall": {
                "kind": "emitter",
                "spectrum": spectrum,
                "radiance_scale": 1.0,
                "sides": "both",
                "reflectance": reflectance,
            }
        },
    )


BOX = {"box": {"min": [-1, -0.7, -1.3], "max": [1.1, 0.9, 1]}}
SPHERE = {"sphere": {"radius": 1.0}}


@pytest.mark.parametrize("reflectance", [0.2, 0.5, 0.8])
@pytest.mark.parametrize("shape", [BOX, SPHERE], ids=["box", "sphere"])
def test_a_closed_room_shows_emission_over_one_minus_reflectance_at_every_wavelength(
    measure, shape, reflectance
):
    """L(λ) = E(λ) / (1 − ρ), in each of 32 lanes."""
    result = measure(room(reflectance, shape), samples=400, sampling="uniform:32")
    expected = np.interp(result.wavelengths_nm, WAVELENGTHS, EMISSION) / (1 - reflectance)
    assert result.lanes == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize(
    "reflectances",
    [[0.1, 0.1, 0.8, 0.3], [0.05, 0.05, 0.8, 0.8]],
    ids=["orange", "deep red"],
)
def test_a_closed_room_whose_reflectance_has_a_spectrum(measure, reflectances):
    """L(λ) = E(λ) / (1 − ρ(λ)): lanes share a path, and each keeps its own balance.

    A path must not be ended by what one lane has left: where ρ² is above the chance to survive a bounce, the
    variance of that lane has no bound. In a deep red room ρ is high far out in the red, where the eye sees little.
    """
    wavelengths = [380.0, 600.0, 640.0, 780.0]
    spectrum = {"wavelengths_nm": wavelengths, "values": reflectances}
    result = measure(room(spectrum, SPHERE), samples=900, sampling="uniform:32")
    emission = np.interp(result.wavelengths_nm, WAVELENGTHS, EMISSION)
    expected = emission / (1 - np.interp(result.wavelengths_nm, wavelengths, reflectances))
    assert result.lanes == pytest.approx(expected, rel=TOLERANCE)
    assert result.xyz == pytest.approx(result.image.to_xyz @ expected, rel=TOLERANCE)


# --- invisible bodies -----------------------------------------------------------------------------------------------


def surrounded(objects, materials, size=48) -> Scene:
    """A ball of radius 1 fills the view before uniform surroundings of 1 W/(sr m² nm)."""
    return Scene.build(
        camera={
            "eye": [1.2, 2.0, 3.0],
            "target": [0, 0, 0],
            "size": [size, size],
            "field_of_view": 2 * np.degrees(np.arcsin(1 / np.linalg.norm([1.2, 2.0, 3.0]))),
        },
        objects=objects,
        materials=materials,
        lights={"sky": {"kind": "environment", "spectrum": 1.0, "radiance_scale": 1.0}},
    )


def seen(image):
    """The pixels that see the ball and nothing else."""
    return np.linalg.norm(image.layers["normal"], axis=-1) > 0.1


BALL = {"ball": {"sphere": {"radius": 1.0}, "material": "ball"}}


def test_a_white_diffuse_sphere_in_uniform_surroundings_is_invisible(measure):
    """E = π L, so a diffuser of reflectance 1 shows E/π = L."""
    scene = surrounded(BALL, {"ball": {"kind": "diffuse", "reflectance": 1.0}})
    result = measure(scene, seen, samples=600, layers="normal", sampling="uniform:4")
    assert seen(result.image).sum() * 600 >= 1e6
    assert result.lanes == pytest.approx(np.ones(4), rel=TOLERANCE)


@pytest.mark.parametrize("dispersion", [False, True], ids=["one index", "dispersion"])
@pytest.mark.parametrize("medium", ["BK7", "water", "diamond"])
def test_a_clear_sphere_in_uniform_surroundings_is_invisible(measure, medium, dispersion):
    """What a smooth boundary does not reflect it transmits, and n² gained on the way in is lost on the way out."""
    scene = surrounded(BALL, {"ball": {"kind": "dielectric", "medium": medium, "dispersion": dispersion}})
    lanes = 8 if dispersion else 4
    result = measure(scene, seen, samples=600, layers="normal", sampling=f"uniform:{lanes}")
    assert seen(result.image).sum() * 600 >= 1e6
    # Dispersed light has wavelengths of its own, and each is kept in the nearest lane: what lies at the border of two
    # goes to one of them.
    assert result.lanes == pytest.approx(np.ones(lanes), rel=0.02 if dispersion else TOLERANCE)
    flat = result.image.to_xyz.sum(axis=1)
    assert result.xyz == pytest.approx(flat, rel=TOLERANCE)


def test_a_dispersive_sphere_is_invisible_at_every_nanometre(measure):
    """`1nm` follows the same paths in 13 passes; a path that dispersion has split lives in one of them alone."""
    scene = surrounded(BALL, {"ball": {"kind": "dielectric", "medium": "diamond"}}, size=24)
    result = measure(scene, seen, samples=401, layers="normal", sampling="1nm")
    assert result.xyz == pytest.approx(result.image.to_xyz.sum(axis=1), rel=0.02)


def nested(core_material) -> Scene:
    return surrounded(
        {
            "ball": {"sphere": {"radius": 1.0}, "material": "water"},
            "kernel": {"sphere": {"center": [0.1, 0.2, 0.0], "radius": 0.6}, "material": "kernel"},
        },
        {
            "water": {"kind": "dielectric", "medium": "water", "dispersion": False},
            "kernel": core_material,
        },
    )


@pytest.mark.parametrize(
    "kernel",
    [
        {"kind": "dielectric", "medium": "diamond", "dispersion": False},
        {"kind": "dielectric", "n": 1.1, "dispersion": False},
        {"kind": "diffuse", "reflectance": 1.0},
    ],
    ids=["diamond", "less dense than water", "white"],
)
def test_bodies_inside_a_water_ball_are_invisible(measure, kernel):
    """Nested media: each boundary works with the index on either side of it, and n² cancels through the stack."""
    result = measure(nested(kernel), seen, samples=256, layers="normal", sampling="uniform:4")
    assert result.lanes == pytest.approx(np.ones(4), rel=TOLERANCE)


def test_a_camera_inside_a_medium_in_equilibrium_sees_n_squared(measure):
    """Radiance over n² is invariant along a ray: inside glass before uniform surroundings L' = n² L.

    A boundary turned inside out (a bubble of air in glass would show 1/n²) keeps it too; here the eye is in the
    ball near its centre, so no direction is trapped.
    """
    scene = surrounded(BALL, {"ball": {"kind": "dielectric", "n": 1.5}})
    scene = scene.replace(
        camera={"eye": [0.1, 0.0, 0.0], "target": [0.0, 0.0, 1.0], "field_of_view": 60, "size": [16, 16]}
    )
    result = measure(scene, samples=256, sampling="uniform:4")
    assert result.lanes == pytest.approx(np.full(4, 1.5**2), rel=TOLERANCE)
