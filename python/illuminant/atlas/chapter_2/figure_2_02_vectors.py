"""Figure 2.2: the vectors at a surface, N, L, V, R, H and T, and the angles θ and φ (book 2.2.1, eqs 2.1a to 2.1d)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

LIGHT_DEG = (40.0, 0.0)
VIEW_DEG = (55.0, 142.0)
"""Elevation from the normal θ and azimuth φ; φ = 0 for the light."""

INDEX = 1.5


def draw(quick: bool) -> Sheet:
    """The vectors in space, and the same scalar products after the whole is turned at random."""
    import numpy as np

    from illuminant.atlas.chapter_2.directions import between, half, reflected, refracted
    from illuminant.plots.sketch import PAPER, SURFACE, Sketch, View, circle, new_sketches
    from illuminant.plots.style import GREY, line_look

    def direction(theta_deg: float, phi_deg: float) -> np.ndarray:
        theta, phi = np.radians([theta_deg, phi_deg])
        return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])

    normal, light, view = np.array([0.0, 0.0, 1.0]), direction(*LIGHT_DEG), direction(*VIEW_DEG)
    through = refracted(light, normal, 1.0, INDEX)
    assert through is not None
    vectors = {
        "N": normal,
        "L": light,
        "V": view,
        "R_L": reflected(light, normal),
        "R_V": reflected(view, normal),
        "H": half(light, view),
        "T_L": through,
    }

    figure, (axes,) = new_sketches((6.6, 5.2))
    sketch = Sketch(axes, View(-66.0, 24.0))
    sketch.patch(circle([0, 0, 0], normal, 1.15), face=SURFACE, zorder=1)
    plane = [[-1.15, 0, 0], [1.15, 0, 0], [1.15, 0, 1.08], [-1.15, 0, 1.08]]
    sketch.patch(plane, face=PAPER, edge="#c9c9c9", zorder=1.5, alpha=0.6)
    sketch.line([[-1.15, 0, 0], [1.15, 0, 0]], linewidth=0.6)
    origin = np.zeros(3)
    names = {"R_L": "$\\mathbf{R}_L$", "R_V": "$\\mathbf{R}_V$", "T_L": "$\\mathbf{T}_L$"}
    colours = {"N": 4, "L": 5, "R_L": 5, "T_L": 5, "V": 0, "R_V": 0, "H": 1}
    for name, vector in vectors.items():
        foot = vector * [1.0, 1.0, 0.0]
        if name in ("V", "H", "R_V"):
            sketch.line([origin, foot, vector], linewidth=0.6, linestyle=(0, (3, 2)), zorder=2)
        text = names.get(name, f"$\\mathbf{{{name}}}$")
        sketch.arrow(origin, vector, text, line_look(colours[name])["color"], 10.0)
    sketch.angle(origin, normal, light, 0.62, "$\\theta_l$")
    sketch.angle(origin, normal, view, 0.42, "$\\theta_v$")
    sketch.angle(origin, [1.0, 0.0, 0.0], view * [1.0, 1.0, 0.0], 0.3)
    sketch.label([0.3, 0.0, 0.0], "$\\phi_v$", (-12, 12))
    sketch.label([0.62, -0.86, 0.0], "surface", color=GREY, fontsize=8.5)
    sketch.label([-0.98, 0.0, 0.99], "plane of N and L", (14, 0), color=GREY, fontsize=8.5)
    sketch.frame()

    # The same in any frame: random rotations, made by QR.
    random = np.random.default_rng(22)
    stacked = np.array(list(vectors.values()))
    turned = 0.0
    for _ in range(20 if quick else 200):
        rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
        there = stacked @ rotation.T
        turned = max(turned, float(np.abs(there @ there.T - stacked @ stacked.T).max()))
    trigonometry = 0.0
    for vector in (light, view, vectors["H"]):
        cos = float(normal @ vector)
        theta = np.arccos(cos)
        sine = np.sqrt(1.0 - cos * cos)
        found, wanted = (sine, sine / cos, cos / sine), (np.sin(theta), np.tan(theta), 1.0 / np.tan(theta))
        trigonometry = max(trigonometry, *(abs(a - b) for a, b in zip(found, wanted, strict=True)))
    mirrored = vectors["R_L"]
    return Sheet(
        picture=figure,
        columns={
            "vector": list(vectors),
            "x": stacked[:, 0],
            "y": stacked[:, 1],
            "z": stacked[:, 2],
            "theta, deg": [between(normal, one) for one in stacked],
            "phi, deg": np.degrees(np.arctan2(stacked[:, 1], stacked[:, 0])) % 360.0,
        },
        checks=(
            Check("change of scalar products when everything is turned", turned, at_most=1e-14),
            Check("sine, tangent and cotangent by eqs 2.1b to 2.1d, error", trigonometry, at_most=1e-12),
            Check(
                "azimuth of the mirror direction of the light",
                float(np.degrees(np.arctan2(mirrored[1], mirrored[0])) % 360.0),
                "deg",
                179.999,
                180.001,
            ),
            Check(
                "angle of L to H less that of V to H",
                abs(between(light, vectors["H"]) - between(view, vectors["H"])),
                "deg",
                at_most=1e-9,
            ),
        ),
    )


PLATE = Plate(
    number="2.2",
    title="Vectors at a surface",
    shows="All vectors are of unit length and point away from the surface: the normal **N**, to the light **L**, to "
    "the viewer **V**, the mirror directions **R**, halfway between light and viewer **H**, and what is transmitted, "
    "**T** (here into glass, $n = 1.5$). A direction has an angle $\\theta$ from the normal and $\\phi$ about "
    "it, which is 0 for the light. Cosines are scalar products, $\\cos\\theta = \\mathbf{N}\\cdot\\mathbf{L}$ "
    "(eq 2.1a), and with them sine, tangent and cotangent (eqs 2.1b to 2.1d).",
    claim="Scalar products alone tell the geometry: they stay when everything is turned in space, give all functions "
    "of the angles, and put the mirror direction of the light at $\\phi = 180°$.",
    today="The conventions are those of this program. It shades in a frame of the surface (tangent, bitangent, "
    "normal), where $\\mathbf{N}\\cdot\\mathbf{L}$ is a coordinate and surfaces with a grain need nothing new.",
    draw=draw,
    commands=("illuminant atlas 2.8",),
)
