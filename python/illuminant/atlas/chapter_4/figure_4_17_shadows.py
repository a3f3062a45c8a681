"""Figure 4.17: shadows with one ray to the lamp, and with many (Cook, Porter and Carpenter 1984; book 4.3.4).

A square lamp of side a hangs at the height h over a floor, and a plate with a straight edge at the height e between.
The penumbra of the edge is a e/(h − e) wide. One ray to the middle of the lamp sees none of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from illuminant.scene import Scene

SIDE, HEIGHT, EDGE = 0.6, 3.0, 1.0
PENUMBRA = SIDE * EDGE / (HEIGHT - EDGE)


def stage(camera: dict[str, Any]) -> Scene:
    """A floor, a lamp over it, and a plate between whose right edge lies below the middle of the lamp."""
    from illuminant.scene import Scene

    return Scene.build(
        camera=camera,
        materials={
            "grey": {"kind": "diffuse", "reflectance": 0.6},
            "plate": {"kind": "diffuse", "reflectance": "ColorChecker/orange"},
            "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 20000.0},
        },
        objects={
            "floor": {
                "rectangle": {"corner": [-4, 0, 4], "edges": [[8, 0, 0], [0, 0, -8]]},
                "material": "grey",
            },
            "plate": {
                "rectangle": {"corner": [-1.2, EDGE, 0.6], "edges": [[1.2, 0, 0], [0, 0, -1.2]]},
                "material": "plate",
            },
            "lamp": {
                "rectangle": {
                    "corner": [-SIDE / 2, HEIGHT, -SIDE / 2],
                    "edges": [[SIDE, 0, 0], [0, 0, SIDE]],
                },
                "material": "lamp",
            },
        },
    )


def draw(quick: bool) -> Sheet:
    """The plate's shadow with one ray, four fixed places, and distributed rays; below, a line across its edge."""
    import numpy as np

    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.plots.style import TODAY, line_look
    from illuminant.rendering import render

    size = 160 if quick else 360
    kinds: dict[str, dict[str, Any]] = {
        "one ray to the middle": {"technique": "raytrace", "light_centres": "fixed:1"},
        "4 fixed places": {"technique": "raytrace", "light_centres": "fixed:4"},
        "distributed": {"technique": "distributed"},
    }
    view = {
        "eye": [1.4, 3.2, 4.6],
        "target": [-0.1, 0.2, 0.1],
        "field_of_view": 34.0,
        "size": [size, size * 3 // 4],
    }
    # From below the plate, straight down.
    width = 64
    low = 0.95
    close = {
        "eye": [0.0, low, 0.0],
        "target": [0.0, 0.0, 0.0],
        "up": [0.0, 0.0, -1.0],
        "field_of_view": 2.0 * np.degrees(np.arctan(0.35 / low)),
        "size": [width, 9],
    }
    x = ((np.arange(width) + 0.5) / width - 0.5) * 0.7
    local: dict[str, Any] = {"illumination": "bouknight", "ambient": 0.0, "sampling": "fitted:4"}
    samples = 32 if quick else 256
    pictures, curves = [], {}
    for name, options in kinds.items():
        sampled = {"samples": (16 if quick else 64) if name == "distributed" else 4}
        pictures.append(render(stage(view), **options | local | {"ambient": 0.08} | sampled))
        line = render(stage(close), **options | local, samples=16 * samples if name == "distributed" else 16)
        curves[name] = line.xyz[..., 1].mean(axis=0)
    right = render(stage(close), depth=2, samples=16 * samples).xyz[..., 1].mean(axis=0)
    full = right[-4:].mean()
    curves = {name: curve / curve[-4:].mean() for name, curve in curves.items()} | {"path": right / full}
    figure, axes = pictures_over_curve(
        [
            one.shown(exposure=0.8 / float(np.percentile(pictures[0].xyz[..., 1], 95))).picture.codes
            for one in pictures
        ],
        ["traditional: one ray to the\nmiddle of the lamp", "four fixed places", "distributed over the lamp"],
        curve_height=320,
    )
    for i, name in enumerate(kinds):
        axes.plot(x, curves[name], **line_look(i), label=name)
    axes.plot(x, curves["path"], **TODAY, label="path, direct light")
    axes.axvspan(-PENUMBRA / 2, PENUMBRA / 2, color="#f0f0f0", label="a e/(h − e)")
    axes.set(
        xlabel="place on the floor across the edge, m", ylabel="luminance, of what is lit", xlim=(-0.35, 0.35)
    )
    axes.legend(loc="upper left")

    def width_of(name: str) -> float:
        curve = (curves[name] - curves[name].min()) / (curves[name].max() - curves[name].min())
        inside = np.flatnonzero(curve < 0.02)[-1], np.flatnonzero(curve > 0.98)[0]
        return float(x[inside[1]] - x[inside[0]])

    def rise(name: str) -> float:
        return float(np.diff(np.interp([-0.06, 0.06], x, curves[name]))[0])

    apart = float(np.abs(curves["distributed"] - curves["path"]).mean())
    return Sheet(
        picture=figure,
        columns={"x, m": x, **curves},
        checks=(
            Check(
                "width of the edge with one ray, of the penumbra",
                width_of(next(iter(kinds))) / PENUMBRA,
                "",
                0,
                0.2,
            ),
            Check(
                "width with distributed rays, of the penumbra",
                width_of("distributed") / PENUMBRA,
                "",
                0.8,
                1.2,
            ),
            Check("rise over the middle 12 cm, four fixed places", rise("4 fixed places"), "", at_most=0.05),
            Check("the same, path", rise("path"), "", at_least=0.3),
            Check("mean difference of distributed rays from path, of what is lit", apart, "", at_most=0.03),
        ),
    )


PLATE = Plate(
    number="4.17",
    title="Hard and soft shadows",
    shows="The shadow of a plate under a square lamp, with one shadow ray to the lamp's middle, as ray tracing had "
    "it, and with rays distributed over the lamp; between them the four fixed centres of figure 4.18.",
    claim="One ray makes an edge with no penumbra at all; distributed rays make one as wide as geometry says, "
    "$a\\,e/(h-e)$ = 0.3 m; and four fixed places make steps, flat between.",
    today="Lamps are asked at places with low discrepancy by the solid angle that they fill (spherical rectangles), "
    "so the penumbra of `path` is smooth with few samples.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique raytrace --light-centres fixed:1 --samples 4",
        "illuminant render scenes/cornell.toml --technique distributed --samples 16",
    ),
)
