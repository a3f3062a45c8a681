"""Figure 2.12: how much of a rough surface shadows and masks itself (book eqs 2.21 and 2.22).

G of Torrance and Sparrow (1967) and of Sancer (1969) against the angle of view in the plane of incidence. The mirror
direction of light from θ is the view at +θ; the light itself stands at −θ.

In that plane eq 2.21 is 1 about the mirror direction, up to the view 60° + θ/3, where 2 (N·H)(N·V) = V·H. For light
from beyond 45° it is 1 from 3 θ − 180° on and has a third kink at the light itself; otherwise from −60° + θ/3 on.
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

LIGHTS_DEG = (0.0, 30.0, 60.0, 80.0)
SLOPES = (0.25, 0.5, 1.0)
LIGHT_DEG = 60.0
"""Of the second panel."""


def draw(quick: bool) -> Sheet:
    """One panel for each function; thick, Smith's masking of GGX in the second."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant import optics
    from illuminant.plots.style import DPI, TODAY, line_look

    view = np.linspace(-90.0, 90.0, 1441)
    radians = np.radians(view)
    cosine = np.cos(radians).clip(0.0, 1.0)
    # The azimuth between light and view is 180° on the side of the mirror direction.
    azimuth = np.where(view >= 0.0, np.pi, 0.0)
    grooves = [
        np.asarray(optics.masking_torrance_sparrow(np.radians(light), np.abs(radians), azimuth))
        for light in LIGHTS_DEG
    ]
    lit = float(np.cos(np.radians(LIGHT_DEG)))
    sancer = [np.asarray(optics.masking_sancer(lit, cosine, m)) for m in SLOPES]
    smith = [np.asarray(optics.masking_smith(lit, cosine, m)) for m in SLOPES]
    ggx = np.asarray(optics.masking_smith(lit, cosine, SLOPES[1], "ggx"))

    figure = Figure(figsize=(9.0, 4.0), dpi=DPI, layout="constrained", facecolor="white")
    left, right = figure.subplots(1, 2, sharey=True)
    for i, (light, curve) in enumerate(zip(LIGHTS_DEG, grooves, strict=True)):
        left.plot(view, curve, **line_look(i), label=f"light at {light:g}°")
        left.plot([light], [1.0], marker="v", color=line_look(i)["color"], markersize=5, clip_on=False)
    for i, (m, curve) in enumerate(zip(SLOPES, sancer, strict=True)):
        right.plot(view, curve, **line_look(i), label=f"m = {m:g}")
    right.plot(view, ggx, **TODAY, label=f"today: Smith, GGX, α = {SLOPES[1]:g}")
    left.set(title="Torrance and Sparrow: any slope (▼ mirror direction)", ylabel="geometric attenuation G")
    right.set_title(f"Sancer (= Smith, Gaussian): light at {LIGHT_DEG:g}°")
    panels: tuple[Any, ...] = (left, right)
    for axes in panels:
        axes.set(xlabel="angle of view, degrees", xlim=(-90, 90), ylim=(0, 1.03), xticks=range(-90, 91, 30))
        axes.grid(True)
    left.legend(loc=(0.52, 0.03))
    right.legend(loc="lower center")

    step = np.radians(view[1] - view[0])
    bend = [np.abs(np.diff(curve, 2)) / step for curve in (grooves[2], sancer[1])]
    inner = slice(20, -20)
    kink = float(view[1:-1][inner][bend[0][inner].argmax()])
    columns: dict[str, Any] = {"view, degrees": view}
    for light, curve in zip(LIGHTS_DEG, grooves, strict=True):
        columns[f"Torrance-Sparrow, light {light:g}°"] = curve
    for m, curve in zip(SLOPES, sancer, strict=True):
        columns[f"Sancer, light {LIGHT_DEG:g}°, m = {m:g}"] = curve
    columns[f"Smith GGX, light {LIGHT_DEG:g}°, alpha = {SLOPES[1]:g}"] = ggx
    mirrored = max(float(np.abs(c - c[::-1]).max()) for c in sancer)
    return Sheet(
        picture=figure,
        columns={name: curve[::8] for name, curve in columns.items()},
        checks=(
            Check("V-groove kink with the light at 60° (60° + θ/3)", kink, "°", 79.5, 80.5),
            Check("leap of the slope there", float(bend[0][inner].max()), "per radian", at_least=1.0),
            Check(
                "largest leap of Sancer's slope, m = 0.5",
                float(bend[1][inner].max()),
                "per radian",
                at_most=0.25,
            ),
            Check(
                "the larger of Sancer's asymmetry and its departure from Smith's Gaussian masking",
                max(mirrored, *(float(np.abs(a - b).max()) for a, b in zip(sancer, smith, strict=True))),
                at_most=1e-6,
            ),
        ),
    )


PLATE = Plate(
    number="2.12",
    title="Geometric attenuation by V-grooves and by a Gaussian relief",
    shows="The share $G$ of the facets that both light and viewer see, against the angle of view in the plane of "
    "incidence: by the V-grooves of Torrance and Sparrow (eq 2.21) for light at 0, 30, 60 and 80 degrees, and by "
    "Sancer's Gaussian surface (eq 2.22) for light at 60 degrees and slopes $m$ of 0.25, 0.5 and 1.",
    claim="Whatever the slope, the V-groove function is 1 about the mirror direction and falls off with kinks, "
    "beyond the mirror at the view $60° + \\theta/3$; Sancer's is smooth, symmetric about the normal, and is Smith's.",
    printed="The text speaks of discontinuities; they are of the slope, and they stand beside the mirror direction, "
    "not at it. It also says that $m$ grows when σ is lowered; it grows when σ is raised. Eq 2.22 takes the slope of "
    "eq 2.20; drawn here for that of eq 2.19, as in the book's program.",
    today="Sancer's function is what is now called Smith's masking with correlated heights, and the library has it "
    "under that name too, for Gaussian and for GGX slopes (thick), whose long tails hide more: 0.14 instead of 0.01 "
    "at the normal.",
    draw=draw,
)
