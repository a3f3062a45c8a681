"""Figure 4.7: the Mach band where light ends on a ball, and an exponent that hides it (book eq 4.7, 4.2.1).

With a distant lamp at a right angle to the view, N·L along the equator of a ball is x/R: brightness falls as a
straight line to nothing, and its slope jumps. (N·L)^p with p a little above 1 meets the dark side without a jump.
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

EXPONENTS = (1.0, 1.5)
LAMP_DEG = 20.0
"""Radius of the ball of light, as seen from the ball that it lights."""


def draw(quick: bool) -> Sheet:
    """Balls with either exponent, and one under a lamp with a size; below, their luminance along the equator."""
    import math

    import numpy as np

    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.plots.style import TODAY, line_look
    from illuminant.rendering import render
    from illuminant.scene import Scene

    size = 161 if quick else 341
    eye, field_of_view = 60.0, 2.1
    distance = 50.0
    view: dict[str, Any] = {
        "camera": {
            "eye": [0, 0, eye],
            "target": [0, 0, 0],
            "field_of_view": field_of_view,
            "size": [size, size],
        },
        "objects": {"ball": {"sphere": {"center": [0, 0, 0], "radius": 1.0}, "material": "chalk"}},
    }
    sun = {"kind": "directional", "direction": [-1, 0, 0], "spectrum": "D65", "illuminance_lx": 1000.0}
    middle: dict[str, Any] = {"ambient": 0.0, "filter": ("box", 1e-3), "samples": 1}
    images = []
    for exponent in EXPONENTS:
        chalk = {
            "kind": "diffuse",
            "reflectance": 0.8,
            "coefficients": {"bouknight": {"terminator": exponent}},
        }
        scene = Scene.build(**view, materials={"chalk": chalk}, lights={"sun": sun})
        images.append(render(scene, technique="raytrace", illumination="bouknight", **middle))
    lamp = {
        "sphere": {"center": [distance, 0, 0], "radius": distance * math.sin(math.radians(LAMP_DEG))},
        "material": "lamp",
    }
    scene = Scene.build(
        camera=view["camera"],
        objects=view["objects"] | {"lamp": lamp},
        materials={
            "chalk": {"kind": "diffuse", "reflectance": 0.8},
            "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 3000.0},
        },
    )
    images.append(
        render(scene, technique="path", **middle | {"samples": 64 if quick else 100, "filter": ("box", 0.5)})
    )
    pixel = 2.0 * math.tan(math.radians(field_of_view / 2.0)) / size
    slope = (np.arange(size) + 0.5 - size / 2) * pixel
    # Where rays through the row of the middle meet the ball: x/R of the place, from the angle of the ray.
    inside = np.abs(slope) < 0.995 / math.sqrt(eye**2 - 1.0)
    t = slope[inside]
    z = (t**2 * eye + np.sqrt(1.0 - t**2 * (eye**2 - 1.0))) / (1.0 + t**2)
    x = t * (eye - z)
    rows = [image.xyz[size // 2, inside, 1] for image in images]
    curves = [row / row[np.abs(x) < 0.99].max() for row in rows]
    figure, axes = pictures_over_curve(
        [
            image.shown(exposure=0.9 / float(image.xyz[..., 1].max())).picture.codes[:, size // 4 :]
            for image in images
        ],
        [
            "exponent 1 (Lambert)",
            "exponent 1.5",
            f"today: exponent 1, and a\nlamp {2 * LAMP_DEG:.0f}° across",
        ],
    )
    for i, exponent in enumerate(EXPONENTS):
        axes.plot(x, curves[i], **line_look(i), label=f"exponent {exponent:g}")
    axes.plot(x, curves[2], **TODAY, label="lamp with a size, path × general")
    axes.set(
        xlabel="place on the equator, x/R (N·L of the distant lamp)",
        ylabel="luminance, of the largest",
        xlim=(-1, 1),
        ylim=(0, None),
    )
    axes.legend(loc="upper left")
    # A twentieth of the radius beside the terminator.
    near = (x > 0.0) & (x < 0.05)
    begins = [float(np.polyfit(x[near], curve[near], 1)[0]) for curve in curves]
    # The largest change of slope between two windows of a tenth of the radius, in what the eye sees about x = 0.
    half = [float(np.interp(0.5, x, curve)) for curve in curves]
    dark = float(np.interp(-0.1, x, curves[2]))
    return Sheet(
        picture=figure,
        columns={
            "x/R": x,
            "exponent 1": curves[0],
            "exponent 1.5": curves[1],
            "lamp with a size": curves[2],
        },
        checks=(
            Check("jump of the slope, exponent 1", begins[0], "per R", 0.95, 1.05),
            Check("slope over the first twentieth, exponent 1.5", begins[1], "per R", at_most=0.3),
            Check("half-lit place, exponent 1.5 over exponent 1", half[1] / half[0], "", 0.68, 0.73),
            Check("light beyond the terminator of the lamp with a size, at -R/10", dark, "", at_least=0.01),
        ),
    )


PLATE = Plate(
    number="4.7",
    title="Mach band where light ends",
    shows="A diffuse ball under a distant lamp at a right angle to the view, with the diffuse term $N\\cdot L$ and "
    "with $(N\\cdot L)^{1.5}$ (after eq 4.7). The eye draws a band where the slope of luminance jumps.",
    claim="With exponent 1 the slope jumps from 0 to its largest value at the terminator; exponent 1.5 takes the "
    "jump away, and makes what is half lit darker by $1-\\sqrt{1/2}$, 29 %.",
    today="The exponent is still there (`terminator = 1.5` among a material's coefficients). A lamp with a size "
    "needs none: part of it still shines beyond the terminator, so the slope changes over its whole width and "
    "Lambert's law stays as it is.",
    draw=draw,
    commands=("illuminant render scenes/demo.toml --technique raytrace --illumination bouknight",),
)
