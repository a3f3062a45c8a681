"""Atmospheres: what is left of light on its way to the eye."""

from __future__ import annotations

import numpy as np
import pytest

import illuminant
from illuminant.appearance import romney_highlight
from illuminant.errors import SceneError
from illuminant.scene import Scene

FOG = {"kind": "fog", "start": 1.0, "end": 5.0, "spectrum": "D65", "luminance_cd_m2": 50.0}


def scene(atmosphere=None, distance=3.0, sky=None):
    """A wall at a distance, large enough to fill the image, or nothing."""
    size = 10.0 if sky is None else 1e-3
    corner = [-size / 2, -size / 2, -distance]
    return Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, -1], "size": [9, 9], "field_of_view": 2.0},
        objects={
            "wall": {
                "rectangle": {"corner": corner, "edges": [[size, 0, 0], [0, size, 0]]},
                "material": "grey",
            }
        },
        materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
        lights={
            "sun": {"kind": "directional", "direction": [0, 0, -1], "spectrum": "A", "illuminance_lx": 1000.0}
        }
        | ({} if sky is None else {"sky": sky}),
        atmosphere=atmosphere,
    )


def middle(made, technique="path", layers=(), **options):
    """XYZ of the pixel in the middle."""
    image = illuminant.render(
        made, technique=technique, sampling="uniform:8", samples=4, layers=layers, ambient=0.0, **options
    )
    return np.asarray(image.xyz, float)[4, 4]


@pytest.mark.parametrize("technique", ["path", "constant", "gouraud", "phong"])
def test_light_falls_as_the_power_of_the_distance(technique):
    clear = middle(scene(), technique)
    for power, unit in ((1.0, 1.0), (2.0, 1.5), (4.0, 1.0)):
        hazy = middle(scene({"kind": "distance", "power": power, "unit": unit}), technique)
        np.testing.assert_allclose(hazy, clear * (unit / 3.0) ** power, rtol=1e-3)


@pytest.mark.parametrize("technique", ["path", "constant", "gouraud", "phong"])
def test_fog_begins_at_one_distance_and_ends_at_another(technique):
    clear = middle(scene(), technique)
    white = np.array([0.95047, 1.0, 1.08883]) * 50.0
    for distance, share in ((0.9, 0.0), (2.0, 0.25), (3.0, 0.5), (5.5, 1.0)):
        seen = middle(scene(FOG, distance), technique)
        np.testing.assert_allclose(seen, (1 - share) * clear + share * white, rtol=2e-3)


def test_surroundings_are_hidden_by_fog_and_left_by_distance():
    sky = {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 200.0}
    image = {
        kind: np.asarray(
            illuminant.render(scene(atmosphere, sky=sky), sampling="uniform:8", samples=1).xyz, float
        )[0, 0, 1]
        for kind, atmosphere in (
            ("clear", None),
            ("fog", FOG),
            ("distance", {"kind": "distance", "power": 4.0}),
        )
    }
    assert image["fog"] == pytest.approx(50.0, rel=1e-3)
    assert image["distance"] == image["clear"]


@pytest.mark.parametrize(
    ("atmosphere", "message"),
    [
        ({"kind": "smoke"}, 'must be one of "fog", "distance"'),
        (FOG | {"start": 6.0}, "must be beyond start"),
        ({"kind": "distance", "power": 0.0}, "must be above 0"),
        ({key: FOG[key] for key in FOG if key != "luminance_cd_m2"}, "exactly one quantity"),
        (FOG | {"colour": "D65"}, "is not a key of this table"),
    ],
)
def test_mistakes_are_named(atmosphere, message):
    with pytest.raises(SceneError, match=message):
        scene(atmosphere)


@pytest.mark.parametrize(("cosines", "distances"), [(2.0, 4.0), (1.0, 2.0), (3.0, 6.0)])
def test_romneys_highlight(cosines, distances):
    """A power of N·L over one of the distance, with the light at the eye (Romney 1969; book 4.2.2)."""
    made = Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, -1], "size": [41, 41], "field_of_view": 60.0},
        objects={"ball": {"sphere": {"center": [0.2, 0, -3], "radius": 1.2}, "material": "grey"}},
        materials={
            "grey": {
                "kind": "diffuse",
                "reflectance": 0.5,
                "coefficients": {"bouknight": {"terminator": cosines}},
            }
        },
        # The lamp's own light falls as 1/r².
        lights={
            "lamp": {
                "kind": "point",
                "position": [0, 0, 0],
                "spectrum": "D65",
                "intensity_cd": 1000.0 * np.pi,
            }
        },
        **(
            {"atmosphere": {"kind": "distance", "power": distances - 2.0, "unit": 1.0}}
            if distances > 2
            else {}
        ),
    )
    options = {"technique": "phong", "illumination": "bouknight", "sampling": "uniform:8", "samples": 1}
    image = illuminant.render(made, ambient=0.0, filter=("box", 1e-6), layers="depth", **options)
    found = np.asarray(image.xyz, float)[..., 1]
    step = 2 * np.tan(np.radians(30.0)) / 41
    x, y = np.meshgrid((np.arange(41) - 20) * step, (20 - np.arange(41)) * step)
    view = np.stack([x, y, -np.ones_like(x)], -1)
    view /= np.linalg.norm(view, axis=-1, keepdims=True)
    center = np.array([0.2, 0.0, -3.0])
    along = view @ center
    root = along**2 - center @ center + 1.2**2
    hit = root > 0.1
    r = along - np.sqrt(np.where(hit, root, 0))
    normal = (view * r[..., None] - center) / 1.2
    cos = -(normal * view).sum(-1)
    expected = 0.5 * 1000.0 * romney_highlight(cos, r, (cosines, distances))
    assert hit.sum() > 100
    # The facets of the ball lie a little inside it.
    np.testing.assert_allclose(found[hit], expected[hit], rtol=0.02, atol=0.005 * expected.max())
