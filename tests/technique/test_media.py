"""Light in and through transparent bodies, against Fresnel's, Snell's and Beer's laws summed over all reflections.

The bodies are so large, and the view so narrow, that a ray never meets a side face on its way. Polarisation: a path
carries the mean of Fresnel's two reflectances and sees each boundary anew, so sums are over that mean R.
"""

import numpy as np
import pytest

from illuminant.scene import Scene


def fresnel(cosine, n):
    """Reflectance of unpolarised light at a boundary into the relative index n; 1 beyond the critical angle."""
    sine2 = (1 - cosine**2) / n**2
    if sine2 >= 1:
        return 1.0
    inside = np.sqrt(1 - sine2)
    parallel = (n * cosine - inside) / (n * cosine + inside)
    perpendicular = (cosine - n * inside) / (cosine + n * inside)
    return (parallel**2 + perpendicular**2) / 2


def view(eye=(0, 0, 0), target=(0, 0, -1), **extra):
    return {"eye": eye, "target": target, "size": [8, 8], "field_of_view": 0.02, **extra}


LAMP = {"kind": "emitter", "spectrum": 1.0, "radiance_scale": 1.0, "sides": "both"}


def slab(thickness, tilt_deg, glass):
    """A large slab between eye and emitter, turned about the y axis."""
    return Scene.build(
        camera=view(),
        objects={
            "slab": {
                "material": "glass",
                "box": {"min": [-60, -60, -thickness / 2], "max": [60, 60, thickness / 2]},
                "rotate": {"axis": "y", "degrees": tilt_deg},
                "translate": [0, 0, -40],
            },
            "panel": {
                "material": "lamp",
                "rectangle": {"corner": [-300, -300, -120], "edges": [[600, 0, 0], [0, 600, 0]]},
            },
        },
        materials={"glass": {"kind": "dielectric", **glass}, "lamp": LAMP},
    )


@pytest.mark.parametrize("tilt", [0.0, 40.0])
def test_beers_law_alone(measure, tilt):
    """A body of index 1 bends and reflects nothing: T(λ) = exp(−a(λ) d / cos θ)."""
    absorption = {"wavelengths_nm": [380.0, 780.0], "values": [0.2, 3.0]}
    scene = slab(0.7, tilt, {"n": 1.0, "absorption": absorption})
    result = measure(scene, samples=4, sampling="uniform:32")
    a = np.interp(result.wavelengths_nm, *absorption.values())
    assert result.lanes == pytest.approx(np.exp(-a * 0.7 / np.cos(np.radians(tilt))), rel=0.003)


@pytest.mark.parametrize("tilt", [0.0, 35.0])
@pytest.mark.parametrize("n", [1.33, 1.5, 2.4])
def test_an_absorbing_slab_with_all_its_reflections(measure, n, tilt):
    """T = (1 − R)² t / (1 − R² t²) with t = exp(−a d / cos θ′) and sin θ′ = sin θ / n."""
    absorption = {"wavelengths_nm": [380.0, 780.0], "values": [0.05, 2.0]}
    scene = slab(0.7, tilt, {"n": n, "absorption": absorption})
    result = measure(scene, samples=1024, sampling="uniform:8")
    cosine = np.cos(np.radians(tilt))
    inside = np.sqrt(1 - (1 - cosine**2) / n**2)
    t = np.exp(-np.interp(result.wavelengths_nm, *absorption.values()) * 0.7 / inside)
    R = fresnel(cosine, n)
    assert result.lanes == pytest.approx((1 - R) ** 2 * t / (1 - R**2 * t**2), rel=0.003)


def test_absorption_is_stated_per_metre_whatever_the_length_unit(measure):
    """A slab of 20 mm with a = 10/m: T = exp(−0.2)."""
    scene = Scene.build(
        camera=view(),
        objects={
            "slab": {"material": "glass", "box": {"min": [-90, -90, -120], "max": [90, 90, -100]}},
            "panel": {
                "material": "lamp",
                "rectangle": {"corner": [-300, -300, -500], "edges": [[600, 0, 0], [0, 600, 0]]},
            },
        },
        materials={"glass": {"kind": "dielectric", "n": 1.0, "absorption": 10.0}, "lamp": LAMP},
        length_unit="mm",
    )
    assert measure(scene, samples=4, sampling="uniform:4").lanes == pytest.approx(np.exp(-0.2), rel=1e-4)


def test_a_lamp_and_what_it_lights_share_an_absorbing_medium(measure):
    """Under water of index 1: L = ρ/π · I cos θ / r² · exp(−a r) · exp(−a h), h being the way up to the surface."""
    depth, aside = 1.0, np.array([0.8, 0.6, 0.0])
    scene = Scene.build(
        camera=view(eye=(0, 20, 0), target=(0, 0, 0), up=[0, 0, 1]),
        objects={
            "sea": {"material": "sea", "box": {"min": [-50, -10, -50], "max": [50, 0, 50]}},
            "bed": {
                "material": "sand",
                "rectangle": {"corner": [-4, -depth, -4], "edges": [[0, 0, 8], [8, 0, 0]]},
            },
        },
        materials={
            "sea": {"kind": "dielectric", "n": 1.0, "absorption": 0.7},
            "sand": {"kind": "diffuse", "reflectance": 0.5},
        },
        lights={
            "bulb": {
                "kind": "point",
                "position": aside - [0, depth, 0],
                "spectrum": "E",
                "intensity_cd": 100.0,
            }
        },
    )
    luminance = measure(scene, samples=4, depth=3, sampling="uniform:4").Y
    r = np.linalg.norm(aside)
    expected = 0.5 / np.pi * 100.0 * aside[1] / r**3 * np.exp(-0.7 * (r + depth))
    assert luminance == pytest.approx(expected, rel=0.003)


@pytest.mark.parametrize("angle", [0.0, 30.0, 60.0])
@pytest.mark.parametrize("n", [1.33, 1.5, 2.4])
def test_an_emitter_inside_a_body_is_dimmed_by_n_squared(measure, n, angle):
    """A black emitter of radiance L deep in a body of index n shows L (1 − R(θ)) / n² outside.

    Radiance over n² is invariant at refraction (the solid angle widens by n² cos/cos′); what the boundary reflects
    back falls on the black emitter and is lost.
    """
    eye = 20 * np.array([np.sin(np.radians(angle)), np.cos(np.radians(angle)), 0.0])
    scene = Scene.build(
        camera=view(eye=eye, target=(0, 0, 0), up=[0, 0, 1]),
        objects={
            "body": {"material": "glass", "box": {"min": [-50, -10, -50], "max": [50, 0, 50]}},
            "panel": {
                "material": "lamp",
                "rectangle": {"corner": [-40, -1, -40], "edges": [[0, 0, 80], [80, 0, 0]]},
            },
        },
        materials={"glass": {"kind": "dielectric", "n": n}, "lamp": LAMP},
    )
    result = measure(scene, samples=1024, sampling="uniform:4")
    expected = (1 - fresnel(np.cos(np.radians(angle)), n)) / n**2
    assert result.lanes == pytest.approx(np.full(4, expected), rel=0.003)


@pytest.mark.parametrize("reflectance", [0.4, 0.9])
def test_a_diffuse_emitter_under_glass(measure, reflectance):
    """What the boundary throws back is reflected again: L_out = L (1 − R₀) / n² / (1 − ρ R̄′).

    R̄′ is the mean reflectance of the boundary for diffuse light from inside, 2 ∫ R(μ) μ dμ: beyond the critical
    angle it is 1, so R̄′ is near 0.6 for glass (Saunderson 1942). The emitter is a wide plane just below the surface.
    """
    n = 1.5
    scene = Scene.build(
        camera=view(eye=(0, 20, 0), target=(0, 0, 0), up=[0, 0, 1]),
        objects={
            "body": {"material": "glass", "box": {"min": [-900, -10, -900], "max": [900, 0, 900]}},
            "panel": {
                "material": "lamp",
                "rectangle": {"corner": [-800, -1, -800], "edges": [[0, 0, 1600], [1600, 0, 0]]},
            },
        },
        materials={"glass": {"kind": "dielectric", "n": n}, "lamp": LAMP | {"reflectance": reflectance}},
    )
    result = measure(scene, samples=2048, sampling="uniform:4")
    mu = (np.arange(200_000) + 0.5) / 200_000
    back = 2 * np.mean([fresnel(m, 1 / n) * m for m in mu])
    expected = (1 - fresnel(1.0, n)) / n**2 / (1 - reflectance * back)
    assert result.lanes == pytest.approx(np.full(4, expected), rel=0.003)


def prism(n, absorption=None):
    """A right-angled prism: light enters and leaves straight and meets the long face at 45° from inside."""
    a, b, c = [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]  # in the x-z plane
    corners = [[x, y, z] for y in (-50.0, 50.0) for x, z in (a, b, c)]
    faces = [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]
    return Scene.build(
        camera=view(eye=(0.3, 0.0, -3.0), target=(0.3, 0.0, 0.0)),
        objects={
            "prism": {"material": "glass", "mesh": {"positions": np.array(corners), "faces": faces}},
            "panel": {
                "material": "lamp",
                "rectangle": {"corner": [4, -40, -1], "edges": [[0, 0, 2], [0, 80, 0]]},
            },
        },
        materials={"glass": {"kind": "dielectric", "n": n, "absorption": absorption}, "lamp": LAMP},
    )


@pytest.mark.parametrize("n", [1.2, 1.38, 1.41, 1.42, 1.5, 2.4])
def test_total_reflection_begins_at_the_critical_angle(measure, n):
    """T = (1 − R₀)² R₄₅ / (1 − R₀² R₄₅²); R₄₅, from inside, is 1 for n > √2.

    The path is folded: in through one short face, off the long one, out through the other short one, where R₀ sends
    part of it back. What passes the long face misses the lamp.
    """
    result = measure(prism(n), samples=2048, sampling="uniform:4")
    entry, fold = fresnel(1.0, n), fresnel(np.sqrt(0.5), 1 / n)
    assert (fold == 1) == (n > np.sqrt(2))
    expected = (1 - entry) ** 2 * fold / (1 - entry**2 * fold**2)
    assert result.lanes == pytest.approx(np.full(4, expected), rel=0.003)


def test_absorption_along_a_folded_path(measure):
    """The way in the prism is one edge long, 2 m, and each further round adds two: t = exp(−2 a)."""
    result = measure(prism(1.5, 0.3), samples=1024, sampling="uniform:4")
    R, t = fresnel(1.0, 1.5), np.exp(-0.6)
    assert result.lanes == pytest.approx(np.full(4, (1 - R) ** 2 * t / (1 - R**2 * t**2)), rel=0.003)
