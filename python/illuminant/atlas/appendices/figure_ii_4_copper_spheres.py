"""Figure II.4: twenty copper spheres of ten finishes, by the parameters of figure II.5 (book II.2).

Rows 1 and 2 have a lamp alone, rows 3 and 4 the lamp and a map of the surroundings. Radii, places and camera are those
of `scenes/copper-spheres.toml`; the map is painted here by formula.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

FIELD_OF_VIEW = 26.0
DISTANCE = 12.0
RADIUS = 0.48
TO_LAMP = (1.0, 1.0, 1.6)
DISC = 0.97
"""How much of a sphere's radius is measured: the outermost pixels are mixed with the ground."""


def studio() -> NDArray[np.float32]:
    """A map of a grey room with a wooden floor, a large lamp above to the left and a window behind the camera."""
    import numpy as np

    height = 128
    azimuth, polar = np.meshgrid(
        360.0 * ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5),
        180.0 * (np.arange(height) + 0.5) / height,
    )
    elevation = 90.0 - polar
    room = np.where(elevation[..., None] > -3.0, [0.26, 0.25, 0.24], [0.16, 0.10, 0.06])
    for left, right, bottom, top, light in (
        (-85.0, -25.0, 15.0, 60.0, (9.0, 9.0, 9.0)),
        (57.0, 66.0, -20.0, 45.0, (7.0, 4.4, 2.1)),
        (125.0, 170.0, -5.0, 40.0, (1.6, 2.4, 3.6)),
    ):
        inside = (azimuth > left) & (azimuth < right) & (elevation > bottom) & (elevation < top)
        room = np.where(inside[..., None], light, room)
    return np.asarray(room, np.float32)


def scene(mapped: bool, size: tuple[int, int], lamp: bool = True) -> Any:
    """Ten spheres with the coefficients of the book, and with n, k and a roughness of the same highlight.

    Args:
        mapped: with the map, and the coefficients for it.
        size: of the picture, pixels.
        lamp: with the lamp.
    """
    from illuminant import optics
    from illuminant.appearance import COPPER_SPHERES
    from illuminant.scene import Scene

    materials: dict[str, Any] = {}
    objects: dict[str, Any] = {}
    for i, sphere in enumerate(one for one in COPPER_SPHERES if one["mapped"] == mapped):
        beta = float(optics.lobe_half_angle("blinn", sphere["exponent"]))
        told: dict[str, Any] = {
            key: float(sphere[key]) for key in ("ambient", "diffuse", "specular", "exponent")
        }
        told |= {"distribution": "blinn", "diffuse_curve": "book/copper", "specular_curve": "book/copper"}
        materials[f"copper {i + 1}"] = {
            "kind": "conductor",
            "metal": "copper",
            "roughness": min(1.0, float(optics.lobe_coefficient("cook", beta)) ** 0.5),
            "coefficients": {"all": told},
        }
        center = [1.05 * (i % 5 - 2), 0.525 if i < 5 else -0.525, 0.0]
        objects[f"copper {i + 1}"] = {
            "material": f"copper {i + 1}",
            "sphere": {"center": center, "radius": RADIUS},
        }
    lights: dict[str, Any] = {}
    if lamp:
        lights["lamp"] = {
            "kind": "directional",
            "direction": [-one for one in TO_LAMP],
            "spectrum": "D65",
            "illuminance_lx": 10000.0,
        }
    if mapped:
        lights["room"] = {"kind": "environment", "image": studio(), "luminance_cd_m2": 2000.0}
    return Scene.build(
        camera={
            "eye": [0.0, 0.0, DISTANCE],
            "target": [0.0, 0.0, 0.0],
            "field_of_view": FIELD_OF_VIEW,
            "size": list(size),
        },
        materials=materials,
        objects=objects,
        lights=lights,
    )


def discs(values: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Of an image (h, w, 3), the pixels (n, 3) of each sphere, row by row."""
    import numpy as np

    height, width = values.shape[:2]
    scale = width / (2.0 * DISTANCE * np.tan(np.radians(FIELD_OF_VIEW / 2)))
    y, x = np.mgrid[:height, :width] + 0.5
    found = []
    for i in range(10):
        across = (x - width / 2) / scale - 1.05 * (i % 5 - 2)
        up = (height / 2 - y) / scale - (0.525 if i < 5 else -0.525)
        found.append(values[across**2 + up**2 < (DISC * RADIUS) ** 2])
    return found


def highlight_share(exponent: float) -> float:
    """The share of a sphere's disc where Blinn's function is above half, seen from afar: sin² β times cos θ of H."""
    import numpy as np

    from illuminant import optics

    beta = float(optics.lobe_half_angle("blinn", exponent))
    half = np.array(TO_LAMP) / np.linalg.norm(TO_LAMP) + [0.0, 0.0, 1.0]
    return float(np.sin(beta) ** 2 * half[2] / np.linalg.norm(half))


def draw(quick: bool) -> Sheet:
    """Rows 1 and 2 by Phong's model, rows 3 and 4 by Whitted's; below, physical copper in the same room."""
    import numpy as np

    from illuminant import color, plots
    from illuminant.appearance import COPPER_SPHERES
    from illuminant.rendering import render

    size = (250, 110) if quick else (500, 220)
    old: dict[str, Any] = {"technique": "phong", "samples": 4 if quick else 9, "ambient": 0.15}
    alone = render(scene(False, size), illumination="phong", layers="terms", **old)
    mapped = render(scene(True, size), illumination="whitted", **old)
    today = render(scene(True, size, lamp=False), samples=4 if quick else 36)
    captions = (
        "rows 1 and 2: a lamp and ambient light (Phong's model, Blinn's highlight)",
        "rows 3 and 4: the lamp and a reflection map (Whitted's model)",
        "today: n, k and rough facets of copper in the room of that map (path tracing)",
    )
    exposures = (0.95 / float(alone.xyz[..., 1].max()), 0.8 / mapped.white(), 1.4 / today.white())
    exponents = [float(sphere["exponent"]) for sphere in COPPER_SPHERES[:10]]
    terms = np.asarray(alone.layers["specular"], np.float64)
    peak, area, chroma = [], [], []
    for specular, whole in zip(discs(terms), discs(np.asarray(alone.xyz, np.float64)), strict=True):
        luminance = specular[:, 1]
        peak.append(float(luminance.max()))
        # Of the whole disc, whose edge `discs` leaves out.
        area.append(float(np.mean(luminance > luminance.max() / 2)) * DISC**2)
        bright = whole[luminance.argmax()]
        lab = color.xyz_to_lab(bright / bright[1], "D65")
        chroma.append(float(np.hypot(lab[1], lab[2])))
    expected = [highlight_share(exponent) for exponent in exponents]
    ratios = [area[i] / expected[i] for i, exponent in enumerate(exponents) if exponent <= 80]
    return Sheet(
        picture=plots.picture_sheet(
            [
                np.asarray(image.shown(exposure=exposure).picture.codes)
                for image, exposure in zip((alone, mapped, today), exposures, strict=True)
            ],
            captions,
            columns=1,
        ),
        columns={
            "sphere of rows 1 and 2": np.arange(1, 11),
            "exponent": exponents,
            "luminance of the specular term, cd/m2": peak,
            "share of the disc above half of it": area,
            "the same, expected": expected,
            "chroma at the highlight, C*": chroma,
        },
        checks=(
            Check("area of the highlight over that expected, smallest", min(ratios), at_least=0.85),
            Check("the same, largest (exponents up to 80)", max(ratios), at_most=1.15),
            Check("steps in which the highlight grows brighter", float(np.sum(np.diff(peak) > 0)), at_most=0),
            Check("smallest chroma at a highlight (that of the lamp is 0)", min(chroma), at_least=15.0),
        ),
    )


PLATE = Plate(
    number="II.4",
    title="Copper at different roughness",
    shows="Twenty copper spheres, from sharp to dull (exponents from 330 to 5), with the multipliers of figure II.5: "
    "rows 1 and 2 under a lamp with ambient light, rows 3 and 4 with a reflection map in place of most of the diffuse "
    "light. Ambient, diffuse and specular light have the spectral curve of copper.",
    claim="From one finish to the next the highlight grows wider, as its exponent says, and darker, and it has the "
    "colour of copper, never that of the lamp.",
    today="The last picture has n and k of copper, facets of the same half-width and light from the whole room: one "
    "number, the roughness, in place of four, and no energy is lost or made. No sphere has a diffuse part, for copper "
    "has none; what a rough one mirrors is only blurred.",
    draw=draw,
    commands=(
        "illuminant render scenes/copper-spheres.toml -o spheres.png",
        "illuminant render scenes/copper-spheres-mapped.toml -o mapped.png",
    ),
)
