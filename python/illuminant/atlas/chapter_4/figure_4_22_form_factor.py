"""Figure 4.22: the form factor between two patches (book eqs 4.28 and 4.29)."""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

DISTANCES = (0.25, 0.5, 1.0, 2.0, 4.0)


def draw(quick: bool) -> Sheet:
    """Two patches with an element each; beside them the error of three ways to their form factor."""
    import numpy as np

    from illuminant.plots.sketch import SURFACE, Sketch, View, arc, new_sketches
    from illuminant.plots.style import line_look

    red = line_look(1)["color"]
    figure, (left, right) = new_sketches((8.8, 4.2), 2)
    sketch = Sketch(left, View(-58.0, 20.0))
    square = np.array([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]])
    lower, upper = square, square + np.array([0.0, 0.0, 1.0])
    small = 0.14 * square
    here, there = np.array([0.2, -0.15, 0.0]), np.array([-0.2, 0.15, 1.0])
    sketch.patch(upper, face=SURFACE, alpha=0.7)
    sketch.patch(lower, face=SURFACE)
    for place in (here, there):
        sketch.patch(small + place, face=red, edge=red, zorder=5)
    sketch.line([here, there], color=red, linewidth=1.1)
    z = np.array([0.0, 0.0, 1.0])
    sketch.arrow(here, here + 0.42 * z, "$\\mathbf{N}_n$")
    sketch.arrow(there, there - 0.42 * z, "$\\mathbf{N}_m$")
    for place, normal, other, name in ((here, z, there, "n"), (there, -z, here, "m")):
        sketch.angle(place, normal, other - place, 0.26)
        middle = arc(place, normal, other - place, 0.26)[16]
        # Beside the angle, which is too narrow to hold it.
        sketch.label(middle, f"$\\theta_{name}$", (-13, 3) if name == "n" else (14, -3))
        sketch.label(place, f"$dA_{name}$", (20, -7 if name == "n" else 7), color=red)
    sketch.label((here + there) / 2, "$r_{m,n}$", (16, 4), color=red)
    sketch.label(lower[1], "patch $n$", (16, -6), fontsize=9)
    sketch.label(upper[1], "patch $m$", (16, 12), fontsize=9)
    sketch.axes.set_title("two patches")
    sketch.frame()

    few, many = (4, 64) if quick else (4, 256)
    exact = np.array([parallel_squares(d) for d in DISTANCES])
    ways = {
        f"area:16, {few} elements": ("area:16", few),
        f"hemicube:64, {few} elements": ("hemicube:64", few),
        f"hemicube:64, {many} elements": ("hemicube:64", many),
    }
    found: dict[str, Any] = {
        name: np.array([_found(d, method, count) for d in DISTANCES])
        for name, (method, count) in ways.items()
    }
    for k, (name, values) in enumerate(found.items()):
        right.plot(
            DISTANCES, 100 * np.abs(values / exact - 1), marker="o", markersize=3, **line_look(k), label=name
        )
    right.set(
        xscale="log",
        yscale="log",
        xlabel="distance over edge",
        ylabel="error of the form factor, %",
        title="form factor of two squares",
    )
    right.set_xticks(DISTANCES, [f"{d:g}" for d in DISTANCES])
    right.minorticks_off()
    right.grid(True)
    right.legend()
    coarse, fine = (np.abs(found[name] / exact - 1) for name in list(ways)[1:])
    area = np.abs(found[next(iter(ways))] / exact - 1)
    return Sheet(
        picture=figure,
        columns={"distance over edge": DISTANCES, "closed form": exact, **found},
        checks=(
            Check("closed form at a distance of one edge", float(exact[2]), "", 0.19982, 0.19983),
            Check("error of the area integral from one edge on", float(area[2:].max()), at_most=0.01),
            Check("error of one hemi-cube an element at a quarter edge", float(coarse[0]), at_least=0.02),
            Check("the same with many elements, over it", float(fine[0] / coarse[0]), at_most=0.5),
        ),
    )


def parallel_squares(distance: float) -> float:
    """The form factor of opposite squares of edge 1 (Hottel 1931)."""
    import numpy as np

    x = 1.0 / distance
    root = np.sqrt(1.0 + x * x)
    inner = (
        np.log((1 + x * x) / np.sqrt(1 + 2 * x * x))
        + 2 * x * root * np.arctan(x / root)
        - 2 * x * np.arctan(x)
    )
    return float(2.0 / (np.pi * x * x) * inner)


def _found(distance: float, method: str, elements: int) -> float:
    """By the core, between squares with a point light between them so that both are lit."""
    from illuminant import radiosity
    from illuminant.atlas.chapter_4.form_factors import between_objects
    from illuminant.scene import Scene

    def square(y: float) -> dict[str, Any]:
        edges = [[0, 0, 1], [1, 0, 0]] if y == 0.0 else [[1, 0, 0], [0, 0, 1]]
        return {"rectangle": {"corner": [-0.5, y, -0.5], "edges": edges}, "material": "grey"}

    scene = Scene.build(
        camera={"eye": [0, 0.5 * distance, 5], "target": [0, 0.5 * distance, 0], "size": [4, 4]},
        objects={"n": square(0.0), "m": square(distance)},
        materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
        lights={
            "lamp": {
                "kind": "point",
                "position": [0, 0.5 * distance, 0],
                "spectrum": "E",
                "intensity_cd": 1.0,
            }
        },
    )
    solution = radiosity.solve(scene, elements=elements, form_factors=method, sampling="uniform:4")
    return float(between_objects(solution)[0, 1])


PLATE = Plate(
    number="4.22",
    title="The form factor",
    shows="The form factor relates what patch $n$ receives to what patch $m$ sends, "
    "$F_{m,n} = \\frac{1}{A_n}\\iint \\cos\\theta_n\\cos\\theta_m\\,dA_m\\,dA_n/r_{m,n}^2$ (eq 4.29). To the right "
    "the error of three ways to it, divided by $\\pi$, for opposite squares, against their distance.",
    claim="A hemi-cube stands for a whole element, so it errs where patches are near each other, and cutting them "
    "finer mends that.",
    printed="Form factors of the book are for intensities, $\\pi$ times those of most texts since.",
    today="Rays that start all over an element (`rays:N`, what is taken if nothing is said) have no such error at any "
    "distance, and noise instead.",
    draw=draw,
    commands=("illuminant radiosity solve scenes/cornell.toml --form-factors area:16 -o cornell.solution",),
)
