"""Figure 4.16: rays are followed as long as they can still be seen (Hall and Greenberg 1983; book 4.3.3).

The weight of a ray is the product of K_s F and of A^d on its way. Below a threshold, such as one step of the output,
1/255, it is followed no more. With a fixed depth instead, most rays are followed far beyond what can be seen, and a
few between mirrors not far enough.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from illuminant.scene import Scene

THRESHOLDS = (0.0, 0.001, 1 / 255, 0.01, 0.03, 0.1)
STEP = 1 / 255
DEEPEST = 14


def hall_of_mirrors(size: int) -> Scene:
    """A ball of glass and one of copper between two mirrors of silver, on a floor in two greys."""
    from illuminant.scene import Scene

    walls: dict[str, Any] = {}
    for name, x in (("left", -1.6), ("right", 1.6)):
        edges = [[0, 0, 4], [0, 3, 0]] if x > 0 else [[0, 3, 0], [0, 0, 4]]
        walls[name] = {"rectangle": {"corner": [x, 0, -2], "edges": edges}, "material": "mirror"}
    return Scene.build(
        camera={
            "eye": [1.3, 1.4, 4.2],
            "target": [-0.5, 0.75, 0.0],
            "field_of_view": 52.0,
            "size": [size, size * 3 // 4],
        },
        materials={
            "mirror": {"kind": "conductor", "metal": "silver"},
            "copper": {"kind": "conductor", "metal": "copper"},
            "glass": {"kind": "dielectric", "medium": "BK7", "dispersion": False, "absorption": 0.3},
            "floor": {
                "kind": "diffuse",
                "reflectance": {
                    "pattern": "checker",
                    "colours": [0.15, 0.6],
                    "scale": 0.8,
                    "origin": [0, 0.4, 0],
                },
            },
            "wall": {"kind": "diffuse", "reflectance": 0.5},
        },
        objects=walls
        | {
            "floor": {
                "rectangle": {"corner": [-1.6, 0, -2], "edges": [[0, 0, 6], [3.2, 0, 0]]},
                "material": "floor",
            },
            "back": {
                "rectangle": {"corner": [-1.6, 0, -2], "edges": [[3.2, 0, 0], [0, 3, 0]]},
                "material": "wall",
            },
            "glass": {"sphere": {"center": [0.6, 0.55, 0.5], "radius": 0.55}, "material": "glass"},
            "copper": {"sphere": {"center": [-0.6, 0.6, -0.5], "radius": 0.6}, "material": "copper"},
        },
        lights={
            "key": {"kind": "point", "position": [0.4, 2.6, 2.5], "spectrum": "D65", "intensity_cd": 900.0}
        },
    )


def draw(quick: bool) -> Sheet:
    """The room with all rays, with those above a step of the output, and how deep it matters; numbers below."""
    import numpy as np

    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.image import Image
    from illuminant.plots.style import GREY, line_look
    from illuminant.rendering import render

    scene = hall_of_mirrors(160 if quick else 360)

    def traced(threshold: float, depth: int = DEEPEST) -> Image:
        return render(
            scene,
            technique="raytrace",
            illumination="hall",
            samples=1,
            ambient=0.0,
            filter=("box", 1e-3),
            threshold=threshold,
            depth=depth,
        )

    images = [traced(threshold) for threshold in THRESHOLDS]
    white = float(np.percentile(images[0].xyz[..., 1], 99.0))
    shallow = traced(0.0, 4)
    pixels = images[0].width * images[0].height

    def error(picture: Image) -> float:
        return float(np.abs(picture.xyz[..., 1] - images[0].xyz[..., 1]).mean() / white)

    rays = np.array([image.statistics["rays"] / pixels for image in images])
    errors = np.array([error(image) for image in images])
    exposure = 0.9 / white
    output = THRESHOLDS.index(STEP)
    figure, axes = pictures_over_curve(
        [one.shown(exposure=exposure).picture.codes for one in (images[0], images[output], images[-1])],
        [
            f"all rays, {DEEPEST} segments deep\n{rays[0]:.1f} rays a pixel",
            f"weight from 1/255\n{rays[output]:.1f} rays a pixel",
            f"weight from 0.1\n{rays[-1]:.1f} rays a pixel",
        ],
        curve_height=300,
    )
    shallow_rays = shallow.statistics["rays"] / pixels
    axes.plot(rays[1:], errors[1:], marker="o", **line_look(0), label="adaptive depth, by threshold")
    for i in range(1, len(THRESHOLDS)):
        name = "1/255" if THRESHOLDS[i] == STEP else f"{THRESHOLDS[i]:g}"
        axes.annotate(f"  {name}", (rays[i], errors[i]), fontsize=8, va="bottom")
    axes.plot(
        [shallow_rays], [error(shallow)], "s", color=line_look(1)["color"], label="fixed depth of 4 segments"
    )
    axes.axhline(STEP, color=GREY, linestyle=":", linewidth=0.9, label="one step of the output, 1/255")
    axes.margins(x=0.09)
    axes.set(yscale="log", xlabel="rays a pixel", ylabel="mean error, of white")
    axes.legend(loc="upper right", bbox_to_anchor=(1.0, 0.9))
    return Sheet(
        picture=figure,
        columns={
            "threshold": [*THRESHOLDS, 0.0],
            "depth, segments": [DEEPEST] * len(THRESHOLDS) + [4],
            "rays a pixel": [*rays, shallow_rays],
            "mean error, of white": [*errors, error(shallow)],
        },
        checks=(
            Check(
                "rays with the threshold 1/255 over all rays", float(rays[output] / rays[0]), "", at_most=0.7
            ),
            Check(
                "mean error of that over a step of the output", float(errors[output] / STEP), "", at_most=1.0
            ),
            Check(
                "mean error of a fixed depth of 4 over that of the threshold 0.03",
                error(shallow) / float(errors[THRESHOLDS.index(0.03)]),
                "",
                at_least=2.0,
            ),
        ),
    )


PLATE = Plate(
    number="4.16",
    title="Adaptive depth of rays",
    shows="Dynamic adjustment of the depth of reflection and refraction: a ray ends where the product of $K_sF$ and "
    "$A^d$ on its way falls below a threshold, usually less than a step of the output. Here two mirrors face each "
    "other.",
    claim="Ending rays below 1/255 saves a third of them and more, and costs less than one step of the output in the "
    "mean; a fixed depth of 4 costs more than twice the error of a threshold of 0.03.",
    today="`--threshold` of `raytrace`, `distributed` and `hybrid` (0.002 by default) is this; `path` ends ways by "
    "chance (Russian roulette), which has no error in the mean.",
    draw=draw,
    commands=("illuminant render scenes/whitted.toml --size 480x360 --samples 1 --threshold 0.03",),
)
