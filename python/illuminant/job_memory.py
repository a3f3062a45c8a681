"""What a render will take of memory, by parts, before anything of it is made.

| part | bytes | measured with Embree 4.4 |
| --- | --- | --- |
| film and image | `film_memory.memory_needed` | 130 a pixel of 148, 360 of 436 with 8 lanes kept |
| geometry | its arrays once more, and 100 a triangle for the ray structure | 236 MB for 2.0 million triangles |
| images of surfaces and surroundings | 50 a pixel | 48 while tables are made, 18 and 30 after it |
| skies | 3.3 million each | 3.1 million |
| form factors | 18.5 each: 8, and as they are put together; 32 with checkpoints, by copies | 18 to 19; 29 to 32 |
| directions of `specular-radiosity` | 12 a lane and cell | 11 |
| subdivided polygons | 1200 a pixel over `subdivide` | 870 to 950 |
| shadow maps | `film_memory.shadow_map_memory`, at most | fewer where a lamp sees part of the scene |

How many form factors there will be is a guess: 1.3 sides for each element (2 where sheets are lit from both sides),
and for each side as many as it sees patches, at most 0.75 of its rays. What the process holds already is no part of
this, since `machine` counts it as used: packages, the arrays of the scene, a ray structure and images that the core has
from an earlier render of the same scene, and light between surfaces that was solved for before.

Example:
    >>> from illuminant.scene import Scene
    >>> from illuminant.settings import Settings
    >>> scene = Scene.build(
    ...     camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [960, 540]},
    ...     materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
    ...     objects={"ball": {"sphere": {"radius": 1.0}, "material": "grey"}},
    ...     lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 1000.0}},
    ... )
    >>> {name: bytes // 1_000_000 for name, bytes in parts(Settings(), scene, 960 * 540, 1).items()}
    {'libraries': 50, 'film and image': 76}
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant import machine
from illuminant.film_memory import lanes, memory_needed, shadow_map_memory
from illuminant.settings import SCANLINE, SOLVED, Settings

if TYPE_CHECKING:
    from illuminant.scene import Scene

__all__ = ["check", "parts"]

LIBRARIES = 50_000_000
"""Embree, threads, and what a small scene takes."""

BYTES_A_SKY = 3_300_000
BYTES_A_TRIANGLE, BYTES_A_PIXEL, BYTES_A_FACTOR, BYTES_A_KEPT_FACTOR = 100, 50, 18.5, 32.0
SIDES_AN_ELEMENT, FACTORS_A_RAY = 1.3, 0.75
BYTES_A_SUBDIVISION = 1200
"""Of the triangles that stand for an area of `subdivide` pixels: two or more, with their vertices and edges."""

COPIES = 2
"""Of the bytes of a solution while it is read: its arrays, and those of the core."""
ELEMENTS_MORE = 1.2
"""How many more elements there may be than asked for, beside one for each triangle."""


def parts(
    settings: Settings,
    scene: Scene,
    pixels: int,
    lamps: int,
    solution: int | None = None,
    *,
    checkpoints: bool = False,
) -> dict[str, int]:
    """Bytes of each part that there is, beside what the process holds.

    Args:
        settings: of the render.
        scene: what is rendered.
        pixels: of the image, or its crop.
        lamps: how many lamps the scene has.
        solution: bytes from which the light between surfaces is still to be read; 0 where the core has it already,
            None where it must be solved for.
        checkpoints: whether some will be made. That of a film takes 14 bytes a channel while it is made, less than the
            image later does.
    """
    arrays = scene.arrays
    shapes = [array for name, array in arrays.items() if name.startswith("shape:")]
    faces = sum(len(array) for name, array in arrays.items() if name.endswith(":indices"))
    images = sum(
        array.shape[0] * array.shape[1] for name, array in arrays.items() if name.startswith("image:")
    )
    geometry = sum(array.nbytes for array in shapes if array.nbytes > 32) + BYTES_A_TRIANGLE * faces
    skies = sum(light["kind"] == "sky" for light in scene.description["lights"])
    built = scene._geometry.core is not None
    found = {
        "libraries": 0 if built else LIBRARIES,
        "film and image": memory_needed(settings, pixels, lamps),
        "geometry": 0 if built else geometry,
        "textures and environments": 0 if scene._core is not None else BYTES_A_PIXEL * images,
        "skies": 0 if scene._core is not None else BYTES_A_SKY * skies,
        "shadow maps": shadow_map_memory(settings, scene.description),
        "subdivided polygons": int(BYTES_A_SUBDIVISION * pixels / settings.subdivide)
        if settings.subdivide and settings.technique in SCANLINE
        else 0,
    }
    if settings.technique in SOLVED or settings.technique == "specular-radiosity":
        solved = solution is not None
        found["radiosity"] = (
            COPIES * (solution or 0) if solved else _radiosity(settings, scene.triangles, checkpoints)
        )
    return {name: count for name, count in found.items() if count}


def _radiosity(settings: Settings, triangles: int, checkpoints: bool) -> int:
    elements = ELEMENTS_MORE * settings.elements + triangles
    sides = SIDES_AN_ELEMENT * elements
    values = lanes(settings.sampling)
    if settings.technique == "specular-radiosity":
        return int(sides * 6 * settings.cube**2 * 12 * values)
    patches = sides
    if settings.patches is not None:
        patches = min(sides, SIDES_AN_ELEMENT * (ELEMENTS_MORE * settings.patches + triangles))
    kind, _, count = settings.form_factors.partition(":")
    number = int(count) if count.isdigit() else 1
    asked = {"rays": number, "hemicube": 3 * number**2}.get(kind)
    each = patches if asked is None else min(patches, FACTORS_A_RAY * asked)
    dense = 4 * patches**2 * values if settings.solver == "gauss" else 0
    of_a_factor = BYTES_A_KEPT_FACTOR if checkpoints else BYTES_A_FACTOR
    return int(of_a_factor * sides * each + dense + 40 * values * sides)


def check(found: dict[str, int]) -> None:
    """Refuse what does not fit into the memory that may be used (`machine.limited_to`).

    Args:
        found: what `parts` gives.

    Raises:
        MachineError: one sentence with both amounts and the largest parts.
    """
    largest = sorted(found, key=lambda name: -found[name])[:3]
    told = ", ".join(f"{name} {machine.size(found[name])}" for name in largest)
    machine.refuse(f"This render ({told})", sum(found.values()))
