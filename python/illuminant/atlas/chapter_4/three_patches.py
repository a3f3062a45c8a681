"""The three diffuse patches and the light of the book's figure 4.1, seen by figures 4.3 to 4.6 (eqs 4.1 to 4.5).

Their coefficients ξ come from form factors that the core finds: what a patch sends on of what a source sends is
ξ(source, active) = ρ F(active, source). No patch hides another.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant.plots.sketch import LAMP, Sketch, View, new_sketches

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from illuminant.transport_coefficients import Diffuse

    Array = NDArray[np.float64]

__all__ = ["EYE", "LIGHT", "PATCHES", "REFLECTANCES", "Room", "draw_room", "room"]

# Corner and edges, z upwards, metres; the front is the side of the cross product of the edges.
PATCHES = {
    "patch 1": ((-1.6, -0.5, 0.25), (0.5, 1.2, 0.0), (-0.35, 0.0, 1.2)),
    "patch 2": ((1.1, 0.7, 0.25), (0.5, -1.2, 0.0), (0.35, 0.0, 1.2)),
    "patch 3": ((-0.9, -0.7, 0.0), (1.8, 0.0, 0.0), (0.0, 1.4, 0.0)),
}
LIGHT = ((-0.3, 0.3, 2.1), (0.6, 0.0, 0.0), (0.0, -0.6, 0.0))
REFLECTANCES = (0.7, 0.5, 0.6)
EYE = (1.5, -2.4, 0.4)


class Room(NamedTuple):
    """The room and what is known of it.

    Attributes:
        diffuse: its coefficients, with the light sending an intensity of 1.
        form_factors: between patches 1 to 3 and the light, (4, 4).
        solved: mean luminance of each patch as radiosity with many elements has it, the light's being 1.
    """

    diffuse: Diffuse
    form_factors: Array
    solved: Array


def _corners(corner: Any, first: Any, second: Any) -> Array:
    import numpy as np

    a, u, v = (np.array(one, float) for one in (corner, first, second))
    return np.array([a, a + u, a + u + v, a + v])


@cache
def room(elements: int) -> Room:
    """The room, with form factors from radiosity of so many elements."""
    import numpy as np

    from illuminant import radiosity
    from illuminant.atlas.chapter_4.form_factors import between_objects
    from illuminant.scene import Scene
    from illuminant.transport_coefficients import Diffuse

    def rectangle(thing: Any, material: str) -> dict[str, Any]:
        corner, *edges = ([x, z, -y] for x, y, z in thing)
        return {"rectangle": {"corner": corner, "edges": edges}, "material": material}

    luminance = 1000.0
    scene = Scene.build(
        camera={"eye": [0, 1, 5], "target": [0, 1, 0], "size": [8, 8]},
        objects={name: rectangle(thing, name) for name, thing in PATCHES.items()}
        | {"light": rectangle(LIGHT, "light")},
        materials={
            name: {"kind": "diffuse", "reflectance": value}
            for name, value in zip(PATCHES, REFLECTANCES, strict=True)
        }
        | {"light": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": luminance}},
    )
    solution = radiosity.solve(scene, elements=elements, form_factors="area:16", sampling="uniform:4")
    factors = between_objects(solution)
    rho = np.array(REFLECTANCES)
    mesh = solution.mesh()
    send, areas = mesh.xyz[:, 1][mesh.faces].mean(axis=1) / luminance, np.asarray(mesh.areas, float)
    own = [np.asarray(mesh.objects) == k for k in range(3)]
    solved = np.array([np.average(send[one], weights=areas[one]) for one in own])
    return Room(Diffuse(rho * factors[:3, 3], (rho[:, None] * factors[:3, :3]).T), factors, solved)


def draw_room(
    shades: Sequence[float], paths: Sequence[Sequence[str]], title: str, eye: bool
) -> tuple[Figure, Sketch]:
    """The room with its patches in grey, and ways of light through it.

    Args:
        shades: how bright each patch is, of the brightest in balance.
        paths: the things between whose middles light goes: "light", "patch 1", "eye".
        title: above it.
        eye: whether the eye is there.
    """
    import numpy as np

    from illuminant.plots.style import GREY, line_look

    figure, (axes,) = new_sketches((6.4, 4.6))
    sketch = Sketch(axes, View(-88.0, 20.0))
    axes.set_title(title)
    middles = {"light": _corners(*LIGHT).mean(axis=0), "eye": np.array(EYE)}
    # The floor lies behind the others.
    for (name, thing), shade in reversed(list(zip(PATCHES.items(), shades, strict=True))):
        corners = _corners(*thing)
        middles[name] = corners.mean(axis=0)
        # Code values for a display, roughly: a power of 1/2.2.
        grey = 0.12 + 0.85 * float(np.clip(shade, 0.0, 1.0)) ** (1.0 / 2.2)
        sketch.patch(corners, face=(grey, grey, grey), edge="#222222")
        ink = "#222222" if grey > 0.5 else "white"
        at = corners[0] + 0.14 * (corners[1] - corners[0]) + 0.14 * (corners[3] - corners[0])
        sketch.label(at, name[-1], color=ink, fontsize=11)
    sketch.patch(_corners(*LIGHT), face=LAMP, edge="#222222")
    sketch.label(middles["light"], "light", (0, 0), fontsize=9)
    if eye:
        sketch.dot(middles["eye"], 7.0)
        sketch.label(middles["eye"], "eye", (16, -7))
    looks = {2: line_look(1)["color"], 3: line_look(0)["color"], 4: line_look(2)["color"]}
    used: dict[tuple[str, str], int] = {}
    for path in paths:
        bounces = len(path) - (1 if eye else 0)
        colour = looks.get(bounces, GREY) if path[0] == "light" else looks[3]
        points = []
        for one in path:
            # Ways that share a patch meet it side by side.
            number = used[path[0], one] = used.get((path[0], one), -1) + 1
            points.append(middles[one] + np.array([0.07, 0.05, 0.0]) * (number if one != "eye" else 0))
        sketch.ray(points, colour)
    sketch.frame()
    return figure, sketch
