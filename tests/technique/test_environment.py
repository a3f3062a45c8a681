"""Environment images: as uniform surroundings, as seen, and as the light they give.

A latitude-longitude image has its zenith at the top; its middle column lies along −z and the columns to the right of
it towards +x. Radiance is bilinear between the centres of the texels.
"""

import numpy as np
import pytest

import illuminant
from illuminant.scene import Scene


def sky(image, **extra):
    return {"sky": {"kind": "environment", "image": image, "spectrum": "E", "luminance_cd_m2": 1.0, **extra}}


def texel_direction(x, y, width, height):
    """The direction of the centre of a texel."""
    phi, theta = ((x + 0.5) / width - 0.5) * 2 * np.pi, (y + 0.5) / height * np.pi
    return np.array([np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi)])


def one_bright(x, y, width, height, value=1e5):
    image = np.zeros((height, width, 3), np.float32)
    image[y, x] = value
    return image


def texel_solid_angle(y, width, height):
    """∫ of the bilinear tent of one texel: Δφ ∫ (1 − |θ − θ₀|/Δθ) sin θ dθ = Δφ sin θ₀ (2 sin(Δθ/2)/Δθ)² Δθ."""
    step, theta = np.pi / height, (y + 0.5) / height * np.pi
    return 2 * np.pi / width * np.sin(theta) * (2 * np.sin(step / 2) / step) ** 2 * step


@pytest.mark.parametrize("size", [(1, 1), (64, 32)], ids=str)
def test_a_constant_image_is_uniform_surroundings(measure, size):
    """Seen directly, on a grey ball, and through glass, at every wavelength."""
    width, height = size
    uniform = {"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 0.7}}
    results = []
    for light in (sky(np.full((height, width, 3), 0.7, np.float32)), uniform):
        scene = Scene.build(
            camera={"eye": [0, 1, 6], "target": [0, 0, 0], "size": [24, 12], "field_of_view": 40},
            objects={
                "ball": {"material": "grey", "sphere": {"center": [-1, 0, 0], "radius": 1}},
                "glass ball": {"material": "glass", "sphere": {"center": [1, 0, 0], "radius": 1}},
            },
            materials={
                "grey": {"kind": "diffuse", "reflectance": 0.8},
                "glass": {"kind": "dielectric", "n": 1.5},
            },
            lights=light,
        )
        results.append(measure(scene, samples=400, sampling="uniform:8"))
    assert results[0].lanes == pytest.approx(results[1].lanes, rel=0.003)
    left, right = (result.image.xyz[..., 1] for result in results)
    assert left == pytest.approx(right, rel=0.03)


def test_what_is_seen_is_the_image():
    """The camera looks at texels: each in its place, with its luminance, and rows from the zenith down."""
    rng = np.random.default_rng(1)
    values = rng.uniform(0.1, 1.0, (8, 16)).astype(np.float32)
    image = np.repeat(values[..., None], 3, axis=2)
    far = {"ball": {"material": "grey", "sphere": {"center": [0, 0, 1e4], "radius": 0.001}}}
    for x, y in [(8, 3), (0, 4), (11, 6)]:
        direction = texel_direction(x, y, 16, 8)
        scene = Scene.build(
            camera={"eye": [0, 0, 0], "target": direction, "size": [1, 1], "field_of_view": 0.01},
            objects=far,
            materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
            lights=sky(image),
        )
        assert illuminant.render(scene, samples=1, sampling="1nm").xyz[0, 0, 1] == pytest.approx(
            values[y, x], rel=0.003
        )


@pytest.mark.parametrize(("up", "turn"), [("y", 0.0), ("y", 90.0), ("z", 0.0), ("z", 30.0)])
def test_where_a_bright_part_stands(illuminance, up, turn):
    """E(n) = Σ L Ω max(0, n · d) over the texels: from their directions d follow axes, `up`, and `rotation_deg`.

    The turn is anticlockwise seen from the zenith; in a z-up world the middle column lies along +y.
    """
    width, height = 128, 64
    rows, columns = np.mgrid[0:height, 0:width]
    luminance = 1e4 * np.exp(-((columns - 76) ** 2 + (rows - 20) ** 2) / (2 * 6.0**2))
    d = np.moveaxis(texel_direction(columns, rows, width, height), 0, -1)
    angle = np.radians(turn)
    d = d @ np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]).T
    if up == "z":
        d = np.stack([d[..., 0], -d[..., 2], d[..., 1]], axis=-1)
    flux = luminance * texel_solid_angle(rows, width, height)
    image = luminance[..., None].repeat(3, axis=-1).astype(np.float32)
    for normal in (np.array([0.94, 0.28, 0.19]), np.array([0.2, 0.7, -0.7])):
        expected = (flux * np.maximum(0, d @ normal / np.linalg.norm(normal))).sum()
        found = illuminance([0, 0, 0], normal, lights=sky(image, up=up, rotation_deg=turn))
        assert found == pytest.approx(expected, rel=0.003, abs=1e-3 * flux.sum())


@pytest.mark.parametrize("y", [2, 31, 40])
def test_the_illuminance_from_one_bright_texel(illuminance, y):
    """E = L Δφ sin θ₀ Δθ (sin(Δθ/2)/(Δθ/2))² facing the texel, within 0.3 %.

    The mean of the cosine over the tent is 1 − (σ_θ² + σ_φ² sin² θ)/2 with variances of Δ²/6.
    """
    width, height, x = 256, 128, 200
    lights = sky(one_bright(x, y, width, height))
    d = texel_direction(x, y, width, height)
    found = illuminance([0, 0, 0], d, lights=lights, samples=4096)
    assert found == pytest.approx(1e5 * texel_solid_angle(y, width, height), rel=0.003)


def varied(width=32, height=16):
    """A dim sky, a broad bright part, and a small very bright one."""
    rng = np.random.default_rng(2)
    image = rng.uniform(0.2, 1.0, (height, width, 1)).astype(np.float32).repeat(3, 2)
    image[2:6, 18:26] *= 20
    image[4, 9] = 3000
    return image


def test_importance_sampling_agrees_with_brute_force(illuminance):
    """E by asking the image against E = ∫ L cos θ dω from a picture of it, where no light is sampled.

    A black frame around the point leaves a square window of 90°. In a view of that window pixel (u, v) on the plane
    at distance 1 covers dω = du dv / (1 + u² + v²)^(3/2), and cos θ = 1 / √(1 + u² + v²).
    """
    lights = sky(varied(), rotation_deg=80.0)
    frame = {
        f"frame {i}": {"material": "black", "rectangle": {"corner": corner, "edges": edges}}
        for i, (corner, edges) in enumerate(
            [
                ([-500, 1, 1], [[1000, 0, 0], [0, 0, 499]]),
                ([-500, 1, -500], [[1000, 0, 0], [0, 0, 499]]),
                ([-500, 1, -1], [[499, 0, 0], [0, 0, 2]]),
                ([1, 1, -1], [[499, 0, 0], [0, 0, 2]]),
            ]
        )
    }
    black = {"black": {"kind": "diffuse", "reflectance": 0.0}}
    n = 512
    ticks = (np.arange(n) + 0.5) / n * 2 - 1
    u, v = np.meshgrid(ticks, ticks)
    view = Scene.build(
        camera={
            "eye": [0, 0, 0],
            "target": [0, 1, 0],
            "up": [0, 0, 1],
            "size": [n, n],
            "field_of_view": 90.0,
        },
        objects=frame,
        materials=black,
        lights=lights,
    )
    image = illuminant.render(view, samples=4, depth=1, filter="box", sampling="uniform:4")
    brute = (image.xyz[..., 1] * (2 / n) ** 2 / (1 + u**2 + v**2) ** 2).sum()
    found = illuminance([0, 0, 0], [0, 1, 0], objects=frame, materials=black, lights=lights, samples=4096)
    assert found == pytest.approx(brute, rel=0.005)
