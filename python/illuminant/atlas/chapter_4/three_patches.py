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
    shades: Sequence[float],
    paths: Sequence[Sequence[str]],
    title: str,
    eye: bool,
    notes: Sequence[str] = ("", "", ""),
) -> tuple[Figure, Sketch]:
    """The room with its patches in grey, and ways of light through it.

    Args:
        shades: how bright each patch is, of the brightest in balance.
        paths: the things between whose middles light goes: "light", "patch 1", "eye".
        title: above it.
        eye: whether the eye is there.
        notes: what is written under the number of each patch.
    """
    import numpy as np

    from illuminant.plots.style import GREY, line_look

    figure, (axes,) = new_sketches((6.4, 4.6))
    sketch = Sketch(axes, View(-88.0, 20.0))
    axes.set_title(f"{title} (thousandths of the light's intensity)" if any(notes) else title)
    middles = {"light": _corners(*LIGHT).mean(axis=0), "eye": np.array(EYE)}
    # The floor lies behind the others.
    for (name, thing), shade in reversed(list(zip(PATCHES.items(), shades, strict=True))):
        corners = _corners(*thing)
        middles[name] = corners.mean(axis=0)
        # Code values for a display, roughly: a power of 1/2.2.
        grey = 0.12 + 0.85 * float(np.clip(shade, 0.0, 1.0)) ** (1.0 / 2.2)
        sketch.patch(corners, face=(grey, grey, grey), edge="#222222")
        lowest = corners[np.argmin(sketch.paper(corners)[:, 1])]
        at, across = (lowest, 0.0) if name != "patch 3" else ((corners[0] + corners[1]) / 2, -60.0)
        sketch.label(at, f"patch {name[-1]}", (across, -10), fontsize=9)
        sketch.label(at, notes[int(name[-1]) - 1], (across, -22), fontsize=8.5, va="center")
    sketch.patch(_corners(*LIGHT), face=LAMP, edge="#222222")
    sketch.label(np.array(LIGHT[0]) + LIGHT[1], "light", (18, -2), fontsize=9)
    if eye:
        sketch.dot(middles["eye"], 7.0)
        sketch.label(middles["eye"], "eye", (16, -7))
    looks = {2: line_look(1)["color"], 3: line_look(0)["color"], 4: line_look(2)["color"]}
    used: dict[tuple[str, str], int] = {}
    for order, path in enumerate(paths):
        bounces = len(path) - (1 if eye else 0)
        colour = looks.get(bounces, GREY) if path[0] == "light" else looks[3]
        points = []
        for one in path:
            # Ways that share a patch meet it side by side.
            number = used[path[0], one] = used.get((path[0], one), -1) + 1
            points.append(middles[one] + np.array([0.12, 0.08, 0.0]) * (number if one == "patch 3" else 0))
        if path[0] != "light":
            # There and back lie side by side.
            way = middles[path[1]] - middles[path[0]]
            aside = np.cross(sketch.view.towards_eye, way) if sketch.view else np.zeros(3)
            points = [middles[one] + 0.045 * aside / np.linalg.norm(aside) for one in path]
        sketch.ray(points, colour, head=(0.53, 0.42, 0.64)[order % 3] if eye else 0.53)
    sketch.frame()
    return figure, sketch
