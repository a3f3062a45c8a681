"""One room by nine techniques, as the book compares them (4.6, figures 4.29 to 4.37), beside what a path tracer finds.

A stage with a red and a green wall, open to a sky with a horizon, under one bright panel. On its white floor stand a
ball of blue plastic, built of flat polygons; a silver ball; a glass ball; and a block of brushed copper. So there is
something for every technique to have or to lack: facets, a shadow, a highlight, a horizon, neighbours in a mirror,
bleeding of the walls, gloss.

The reference is `path` with `general`, with light followed from the lamps too. All pictures have its exposure.
Ambient light of the older techniques is chosen by hand, as it was: `ambient = 0.05`; so is the highlight of Phong's
model on the plastic, whose reflectance of 0.04 at normal incidence that model would hardly show.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.atlas.plate import Check
    from illuminant.difference import Difference
    from illuminant.image import Image
    from illuminant.radiosity import Solution
    from illuminant.scene import Scene

    Array = NDArray[np.floating[Any]]

__all__ = [
    "CAPTIONS",
    "FINENESS",
    "TECHNIQUES",
    "at",
    "ball",
    "beside_the_reference",
    "bleeding",
    "chromaticity",
    "codes",
    "difference",
    "edge_width",
    "energy",
    "image",
    "on_block",
    "reference",
    "rendered",
    "repainted",
    "scene",
    "shadow_edge",
    "solved",
]

BY_HAND: dict[str, Any] = {"ambient": 0.05}

TECHNIQUES: dict[str, dict[str, Any]] = {
    "4.29": {"technique": "constant", "illumination": "bouknight", **BY_HAND},
    "4.30": {
        "technique": "gouraud",
        "illumination": "bouknight",
        "shadows": "rays",
        **BY_HAND,
    },
    "4.31": {"technique": "phong", "illumination": "phong", **BY_HAND},
    "4.32": {"technique": "phong", "illumination": "whitted", **BY_HAND},
    "4.33": {"technique": "raytrace", "illumination": "whitted", "light_centres": "fixed:1", **BY_HAND},
    "4.34": {"technique": "distributed", "illumination": "hall", **BY_HAND},
    "4.35": {"technique": "radiosity", "form_factors": "scanline:64"},
    "4.36": {"technique": "specular-radiosity"},
    "4.37": {"technique": "hybrid", "gather": "full"},
}
"""The options of `render` by the number of the figure."""

CAPTIONS = {
    "4.29": "constant × bouknight",
    "4.30": "gouraud × bouknight",
    "4.31": "phong × phong",
    "4.32": "phong × whitted (reflection map)",
    "4.33": "raytrace × whitted",
    "4.34": "distributed × hall",
    "4.35": "radiosity × general",
    "4.36": "specular-radiosity × general",
    "4.37": "hybrid × general",
}

SAMPLES = {
    "4.29": (16, 16),
    "4.30": (16, 16),
    "4.31": (16, 16),
    "4.32": (16, 16),
    "4.33": (4, 16),
    "4.34": (16, 48),
    "4.35": (8, 16),
    "4.36": (8, 16),
    "4.37": (16, 32),
    "reference": (24, 64),
}
"""Of a pixel, with quick settings and with full ones."""

FINENESS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "4.30": ({"subdivide": 100.0}, {"subdivide": 500.0}),
    "4.35": ({"elements": 1200, "form_factors": "scanline:32"}, {"elements": 6000}),
    "4.36": ({"elements": 300, "cube": 4, "light_samples": 4}, {"elements": 1000, "cube": 12}),
    "4.37": ({"elements": 800, "form_factors": "rays:128"}, {"elements": 3000, "form_factors": "rays:512"}),
}

EYE, TARGET, FIELD_OF_VIEW_DEG = (0.0, 1.7, 6.0), (0.0, 0.9, 0.0), 36.0
BALLS = {
    "plastic": ((-0.95, 0.62, -0.55), 0.62),
    "silver": ((0.35, 0.55, -0.95), 0.55),
    "glass": ((1.05, 0.42, 0.45), 0.42),
}
BLOCK_CENTRE, BLOCK_HALF, BLOCK_TURN_DEG = (-0.4, 0.225, 0.65), (0.3, 0.225, 0.3), 25.0
MATERIALS: dict[str, dict[str, Any]] = {
    "white": {"kind": "diffuse", "reflectance": 0.7},
    "red": {"kind": "diffuse", "reflectance": "Cornell/red"},
    "green": {"kind": "diffuse", "reflectance": "Cornell/green"},
    "panel": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 9000.0},
    "plastic": {
        "kind": "coated",
        "pigment": "ColorChecker/blue",
        "roughness": 0.12,
        "coefficients": {"phong": {"specular_curve": 0.4}},
    },
    "silver": {"kind": "conductor", "metal": "silver"},
    "glass": {"kind": "dielectric", "medium": "BK7", "dispersion": False},
    "copper": {"kind": "conductor", "metal": "copper", "roughness": 0.1},
}


def _horizon() -> Array:
    """Sky and ground by latitude and longitude, linear RGB: brightest at the horizon, brown below it."""
    import numpy as np

    height, width = 64, 128
    elevation = 0.5 - (np.arange(height) + 0.5) / height
    sky = np.array([0.35, 0.55, 1.0]) * (1.0 - 1.2 * elevation[:, None])
    ground = np.array([0.18, 0.13, 0.09])
    rows = np.where(elevation[:, None] > 0, sky, ground)
    return np.repeat(rows[:, None, :], width, axis=1)


def _facets(centre: tuple[float, float, float], radius: float, rings: int = 7) -> dict[str, Any]:
    """A ball of flat polygons between circles of latitude, with the normals of a round one at its corners."""
    import numpy as np

    around = 2 * rings
    theta = np.linspace(0.0, np.pi, rings + 1)[1:-1, None]
    phi = 2.0 * np.pi * np.arange(around) / around
    circles = np.stack(
        [np.sin(theta) * np.cos(phi), np.cos(theta) + 0.0 * phi, np.sin(theta) * np.sin(phi)], -1
    )
    normals = np.concatenate([[[0.0, 1.0, 0.0]], circles.reshape(-1, 3), [[0.0, -1.0, 0.0]]])
    along, last = np.arange(around), len(normals) - 1
    after = (along + 1) % around
    faces = [np.stack([0 * along, 1 + after, 1 + along], 1)]
    for ring in range(rings - 2):
        first = 1 + ring * around
        a, b, c, d = first + along, first + after, first + around + after, first + around + along
        faces += [np.stack([a, b, c], 1), np.stack([a, c, d], 1)]
    bottom = last - around
    faces.append(np.stack([bottom + along, bottom + after, last + 0 * along], 1))
    return {
        "positions": normals * radius + np.array(centre),
        "normals": normals,
        "faces": np.concatenate(faces),
    }


def _rectangle(material: str, corner: list[float], *edges: list[float]) -> dict[str, Any]:
    return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}


@cache
def scene(quick: bool) -> Scene:
    """The room, in 160 × 120 pixels with quick settings and in 360 × 270 with full ones."""
    from illuminant.scene import Scene

    def round_ball(name: str) -> dict[str, Any]:
        centre, radius = BALLS[name]
        return {"sphere": {"center": centre, "radius": radius}, "material": name}

    return Scene.build(
        title="One room by nine techniques",
        camera={
            "eye": EYE,
            "target": TARGET,
            "field_of_view": FIELD_OF_VIEW_DEG,
            "size": [160, 120] if quick else [360, 270],
        },
        materials=MATERIALS,
        objects={
            "floor": _rectangle("white", [-2, 0, -2], [0, 0, 4], [4, 0, 0]),
            "back": _rectangle("white", [-2, 0, -2], [4, 0, 0], [0, 2.6, 0]),
            "left": _rectangle("red", [-2, 0, -2], [0, 2.6, 0], [0, 0, 4]),
            "right": _rectangle("green", [2, 0, -2], [0, 0, 4], [0, 2.6, 0]),
            "panel": _rectangle("panel", [-0.5, 2.8, -0.3], [1, 0, 0], [0, 0, 1]),
            "plastic": {"mesh": _facets(*BALLS["plastic"]), "material": "plastic"},
            "silver": round_ball("silver"),
            "glass": round_ball("glass"),
            "block": {
                "box": {"min": [-half for half in BLOCK_HALF], "max": BLOCK_HALF},
                "rotate": {"axis": "y", "degrees": BLOCK_TURN_DEG},
                "translate": BLOCK_CENTRE,
                "material": "copper",
            },
        },
        lights={"sky": {"kind": "environment", "image": _horizon(), "luminance_cd_m2": 90.0}},
    )


@cache
def reference(quick: bool) -> Image:
    """The room by `path` with `general`."""
    from illuminant.rendering import render

    return render(scene(quick), samples=SAMPLES["reference"][not quick], caustics=True)


def rendered(number: str, quick: bool, of: Scene | None = None, **options: Any) -> Image:
    """The room, or one that differs from it, by the technique of a figure; not kept."""
    from illuminant.rendering import render

    fineness = FINENESS[number][not quick] if number in FINENESS else {}
    given = {"samples": SAMPLES[number][not quick]} | TECHNIQUES[number] | fineness | options
    return render(of or scene(quick), **given)


@cache
def solved(number: str, quick: bool) -> Solution:
    """The light between the surfaces of the room, for figure 4.35 or 4.36."""
    from illuminant import radiosity

    of = scene(quick)
    if quick and number == "4.36":
        # A table of what a rough coat reflects into all directions takes longer than all the rest; the figure's claim
        # is about copper and silver.
        of = of.replace(materials={"plastic": {**MATERIALS["plastic"], "roughness": 0.0}})
    return radiosity.solve(of, **TECHNIQUES[number] | FINENESS[number][not quick])


@cache
def image(number: str, quick: bool) -> Image:
    """The room by the technique of a figure."""
    if number in ("4.35", "4.36"):
        return solved(number, quick).render(samples=SAMPLES[number][not quick])
    return rendered(number, quick)


@cache
def difference(number: str, quick: bool) -> Difference:
    """What tells the room by the technique of a figure from the reference."""
    from illuminant.difference import diff

    right = reference(quick)
    return diff(right, image(number, quick), exposure=right.auto_exposure())


def energy(number: str, quick: bool) -> float:
    """Mean luminance relative to the reference."""
    return float(image(number, quick).xyz[..., 1].mean() / reference(quick).xyz[..., 1].mean())


@cache
def shadow_edge(number: str | None, quick: bool) -> tuple[Array, Array]:
    """Light across the edge of the shadow of the plastic ball on the floor, seen from straight above.

    Args:
        number: of the figure; None for the reference.
        quick: as everywhere.

    Returns:
        z in metres, and luminance over what it is without shadows, from the shadow into the light.
    """
    import numpy as np

    from illuminant.rendering import render

    x, height, pixels = -1.45, 1.2, 64
    camera = {
        "eye": [x, height, 0.0],
        "target": [x, 0.0, 0.0],
        "up": [0.0, 0.0, -1.0],
        "field_of_view": 30.0,
        "size": [pixels, pixels],
    }
    above = scene(quick).replace(camera=camera)
    samples = 128 if quick else 256
    if number is None:
        found = render(above, samples=samples)
    else:
        found = rendered(number, quick, above, samples=samples)
    bare = rendered("4.31", quick, above, illumination="bouknight", samples=16)
    middle = slice(pixels // 2 - 3, pixels // 2 + 3)
    z = ((np.arange(pixels) + 0.5) / pixels - 0.5) * 2.0 * height * np.tan(np.radians(15.0))
    light = found.xyz[:, middle, 1].mean(axis=1) / bare.xyz[:, middle, 1].mean(axis=1)
    return z, light


def edge_width(z: Array, light: Array) -> float:
    """How far it is from a tenth to nine tenths of the way out of a shadow, in metres."""
    import numpy as np

    rise = (light - light.min()) / (light.max() - light.min())
    begins = int(np.flatnonzero(rise < 0.1)[-1])
    ends = begins + int(np.flatnonzero(rise[begins:] > 0.9)[0])
    return float(z[ends] - z[begins])


def bleeding(picture: Image) -> Array:
    """How much redder the back wall is beside the red wall than in its middle: differences of x and y."""
    import numpy as np

    across, up = np.meshgrid(np.linspace(-1.95, -1.8, 4), np.linspace(1.4, 2.1, 15))
    beside = np.stack([across, up, np.full_like(up, -2.0)], axis=-1)
    middle = beside + np.array([1.9, 0.0, 0.0])
    return chromaticity(at(picture, beside)) - chromaticity(at(picture, middle))


def place(points: Any, size: tuple[int, int], eye: Sequence[float] = EYE) -> Array:
    """Column and row, as fractions of pixels, at which points of the room are seen.

    Args:
        points: (..., 3), in metres.
        size: width and height of the image.
        eye: where the camera stands.
    """
    import numpy as np

    forward = np.subtract(TARGET, eye)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right = right / np.linalg.norm(right)
    up = np.cross(right, forward)
    ways = np.asarray(points, float) - eye
    scale = size[0] / 2 / np.tan(np.radians(FIELD_OF_VIEW_DEG / 2)) / (ways @ forward)
    return np.stack([size[0] / 2 + scale * (ways @ right), size[1] / 2 - scale * (ways @ up)], axis=-1)


def at(picture: Image, points: Any, eye: Sequence[float] = EYE) -> Array:
    """XYZ of the pixels at which points of the room are seen, (..., 3)."""
    import numpy as np

    column, row = np.moveaxis(
        np.floor(place(points, (picture.width, picture.height), eye)).astype(int), -1, 0
    )
    found: Array = np.asarray(picture.xyz, float)[row, column]
    return found


def on_block(along: Any, up: Any, deep: Any) -> Array:
    """Points of the copper block by its own coordinates, each −1 to 1: to the right, up, and to the front."""
    import numpy as np

    c, s = np.cos(np.radians(BLOCK_TURN_DEG)), np.sin(np.radians(BLOCK_TURN_DEG))
    x, y, z = (np.asarray(one, float) * half for one, half in zip((along, up, deep), BLOCK_HALF, strict=True))
    x, y, z = np.broadcast_arrays(x, y, z)
    return np.asarray(np.stack([c * x + s * z, y, c * z - s * x], axis=-1) + BLOCK_CENTRE)


def ball(name: str, picture: Image, part: float = 0.9) -> NDArray[np.bool_]:
    """The pixels of a ball, out to a part of its radius."""
    import numpy as np

    centre, radius = BALLS[name]
    size = (picture.width, picture.height)
    middle = place(centre, size)
    away = np.linalg.norm(np.subtract(centre, EYE))
    across = size[0] / 2 / np.tan(np.radians(FIELD_OF_VIEW_DEG / 2)) * radius / away
    row, column = np.mgrid[: size[1], : size[0]] + 0.5
    found: NDArray[np.bool_] = np.hypot(column - middle[0], row - middle[1]) < part * across
    return found


def repainted(number: str, quick: bool) -> float:
    """The part of the silver ball's pixels that change by more than a twentieth when the red wall is painted grey."""
    import numpy as np

    grey = scene(quick).replace(materials={"red": {"kind": "diffuse", "reflectance": 0.4}})
    before, after = image(number, quick), rendered(number, quick, grey)
    seen = ball("silver", before)
    change = np.abs(after.xyz - before.xyz)[seen].max(axis=-1)
    return float((change > 0.05 * before.xyz[seen].max(axis=-1)).mean())


def chromaticity(xyz: Array) -> Array:
    """x and y of a mean colour."""
    import numpy as np

    from illuminant import color

    return np.asarray(color.xyz_to_xyy(np.asarray(xyz, float).reshape(-1, 3).mean(axis=0)))[:2]


def codes(picture: Image, quick: bool) -> NDArray[np.uint8]:
    """A picture of the room as it is shown, with the exposure of the reference."""
    import numpy as np

    return picture.shown(exposure=reference(quick).auto_exposure()).picture.codes.astype(np.uint8)


def beside_the_reference(number: str, quick: bool, checks: tuple[Check, ...]) -> Sheet:
    """The room by the technique of a figure, and the reference, with what tells them apart."""
    from illuminant.plots import picture_sheet

    right, found = reference(quick), image(number, quick)
    apart = difference(number, quick)
    options = TECHNIQUES[number]
    return Sheet(
        picture=picture_sheet(
            [codes(one, quick) for one in (found, right)],
            [
                f"{CAPTIONS[number]}\nΔE00 {apart.mean:.1f}, FLIP {apart.flip:.2f}, "
                f"energy {100 * energy(number, quick):.0f} %",
                "path × general: the reference",
            ],
            columns=2,
            magnify=3 if quick else 1,
        ),
        columns={
            "technique": [options["technique"], "path"],
            "illumination model": [options.get("illumination", "general"), "general"],
            "mean luminance, cd/m²": [float(one.xyz[..., 1].mean()) for one in (found, right)],
            "mean ΔE00 to the reference": [apart.mean, 0.0],
            "mean FLIP to the reference": [apart.flip, 0.0],
        },
        checks=checks,
    )
