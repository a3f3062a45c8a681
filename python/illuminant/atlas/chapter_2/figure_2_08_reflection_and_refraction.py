"""Figure 2.8: the geometry of reflection and refraction, normals H and H′ (book eqs 2.11, 2.12, III.6 to III.15)."""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

INCIDENT_DEG = 50.0
NI, NT = 1.0, 1.5
VIEW_DEG, THROUGH_DEG = 38.0, 18.0
"""Of the arbitrary reflected and transmitted directions: from the normal, positive to the right."""


def draw(quick: bool) -> Sheet:
    """To the left what a surface does with L; to the right the facets that send it in two directions asked for."""
    import numpy as np

    from illuminant.atlas.chapter_2.directions import (
        between,
        half,
        half_refracted,
        half_refracted_printed,
        reflected,
        refracted,
    )
    from illuminant.plots.sketch import Sketch, new_sketches
    from illuminant.plots.style import line_look

    def up(angle_deg: float) -> np.ndarray:
        return np.array([np.sin(np.radians(angle_deg)), np.cos(np.radians(angle_deg))])

    normal, light = up(0.0), up(-INCIDENT_DEG)
    mirrored, through = reflected(light, normal), refracted(light, normal, NI, NT)
    assert through is not None
    view, asked = up(VIEW_DEG), -up(-THROUGH_DEG)
    h, h_through = half(light, view), half_refracted(light, asked, NI, NT)
    printed = half_refracted_printed(light, asked, NI, NT)
    blue, red = (line_look(i)["color"] for i in (0, 1))

    figure, (left, right) = new_sketches((8.6, 4.3), 2)
    sketch = Sketch(left)
    _ground(sketch, "the directions that a surface gives")
    for vector, text, colour in (
        (normal, "$\\mathbf{N}$", "#222222"),
        (light, "$\\mathbf{L}$", "#222222"),
        (mirrored, "$\\mathbf{R}_l$", blue),
        (through, "$\\mathbf{T}_l$", red),
    ):
        sketch.arrow([0, 0], vector, text, colour, 10.0)
    sketch.line([[0.0, 0.0], [0.0, -1.02]], linestyle=(0, (3, 2)))
    sketch.angle([0, 0], normal, light, 0.42, f"$\\theta_i$ = {between(normal, light):.0f}°", out=17.0)
    sketch.angle([0, 0], normal, mirrored, 0.42, f"$\\theta_r$ = {between(normal, mirrored):.0f}°", out=17.0)
    sketch.angle([0, 0], -normal, through, 0.5)
    sketch.label([0.0, -0.62], f"$\\theta_t$ = {between(-normal, through):.1f}°", (-32, 0))
    sketch.frame()

    sketch = Sketch(right)
    _ground(sketch, "the normals that two directions ask for")
    for vector, text, colour in (
        (light, "$\\mathbf{L}$", "#222222"),
        (view, "$\\mathbf{R}$", blue),
        (asked, "$\\mathbf{T}$", red),
    ):
        sketch.arrow([0, 0], vector, text, colour, 10.0)
    for facet, text, colour in ((h, "$\\mathbf{H}$", blue), (h_through, "$\\mathbf{H}'$", red)):
        along = np.array([facet[1], -facet[0]])
        sketch.line([-0.3 * along, 0.3 * along], color=colour, linewidth=2.6, zorder=6, alpha=0.7)
        sketch.arrow([0, 0], 0.86 * facet, text, colour, 9.0, linestyle="-", linewidth=1.0)
    sketch.arrow([0, 0], 0.86 * printed, "", red, 16.0, linestyle=(0, (4, 2.5)), linewidth=1.0)
    sketch.label(0.86 * printed, "$\\mathbf{H}'$ as printed", (0, 12), color=red)
    sketch.frame()

    met = _traced_angle_deg(INCIDENT_DEG, NT)
    snell = NT * np.sin(np.radians(met)) / (NI * np.sin(np.radians(INCIDENT_DEG)))
    again, wrong = refracted(light, h_through, NI, NT), refracted(light, printed, NI, NT)
    assert again is not None and wrong is not None
    rows = {"N": normal, "L": light, "R_l": mirrored, "T_l": through, "R": view, "T": asked}
    rows |= {"H": h, "H'": h_through, "H' as printed": printed}
    return Sheet(
        picture=figure,
        columns={
            "vector": list(rows),
            "along the surface": [one[0] for one in rows.values()],
            "along the normal": [one[1] for one in rows.values()],
            "angle from the normal, deg": [between(normal, one) for one in rows.values()],
        },
        checks=(
            Check("n_t sin θ_t over n_i sin θ_i of a ray traced into glass", snell, "", 1 - 1e-4, 1 + 1e-4),
            Check(
                "angle of the traced ray less that of T_l",
                abs(met - between(-normal, through)),
                "deg",
                at_most=5e-3,
            ),
            Check("facet of H′: what it refracts L to, from T", between(again, asked), "deg", at_most=1e-9),
            Check(
                "facet of H′ as printed: what it refracts L to, from T",
                between(wrong, asked),
                "deg",
                at_least=5.0,
            ),
        ),
    )


def _ground(sketch: Any, title: str) -> None:
    sketch.surface([-1.05, 0.0], [1.05, 0.0], 0.16)
    sketch.label([0.98, 0.0], "$n_i$ = 1", (-12, 9), fontsize=8.5)
    sketch.label([0.98, -0.16], "$n_t$ = 1.5", (-12, -9), fontsize=8.5)
    sketch.axes.set_title(title)
    sketch.paper([[0.0, 1.1], [0.0, -1.1]])


def _traced_angle_deg(incident_deg: float, index: float) -> float:
    """The angle to the normal at which the core sends a ray through the top of a block."""
    import numpy as np

    from illuminant.rendering import replay
    from illuminant.scene import Scene

    sin, cos = np.sin(np.radians(incident_deg)), np.cos(np.radians(incident_deg))
    scene = Scene.build(
        camera={"eye": [-4 * sin, 4 * cos, 0], "target": [0, 0, 0], "size": [1, 1], "field_of_view": 1.0},
        objects={"block": {"box": {"min": [-5, -2, -5], "max": [5, 0, 5]}, "material": "glass"}},
        materials={"glass": {"kind": "dielectric", "n": index, "dispersion": False}},
        lights={"lamp": {"kind": "point", "position": [0, 5, 0], "spectrum": "E", "intensity_cd": 1.0}},
    )
    options: dict[str, Any] = {"technique": "raytrace", "sampling": "uniform:4", "filter": ("box", 1e-6)}
    [vertices] = replay(scene, (0, 0), 0, samples=1, **options)["passes"]
    entry, leave = (np.array(one["position"]) for one in vertices[:2])
    down = leave - entry
    return float(np.degrees(np.arctan2(np.hypot(down[0], down[2]), -down[1])))


PLATE = Plate(
    number="2.8",
    title="Geometry of reflection and refraction",
    shows="Light from **L** meets a surface between two materials. It is mirrored to $\\mathbf{R}_l$ with "
    "$\\theta_r = \\theta_i$ (eq 2.11) and refracted to $\\mathbf{T}_l$ with $n_t\\sin\\theta_t = n_i\\sin\\theta_i$ "
    "(eq 2.12). Asked the other way round: the normal that mirrors **L** to a given **R** is **H** (eq III.11), the "
    "one that refracts it to a given **T** is **H**′ (eqs III.12 to III.15).",
    claim="A ray that the renderer traces into glass keeps Snell's law, and a facet with the normal **H**′ refracts "
    "exactly to where it was asked.",
    printed="Equation III.13 divides by $n_i/n_t - 1$ where $n_t/n_i - 1$ belongs (the book's code has it right); the "
    "**H**′ that follows from it is drawn dashed, and refracts elsewhere.",
    today="Rough glass is made of facets with these normals: directions are drawn by drawing **H**′ among the facets "
    "that are seen (Walter et al. 2007, Heitz 2018).",
    draw=draw,
    commands=("illuminant atlas 2.2",),
)
