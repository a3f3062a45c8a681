"""Figure 4.18: shadow tests by a bundle of rays to fixed centres of a lamp (Verbeck, Greenberg 1984; book 4.3.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

LAMP_Y, PLATE_Y, EYE_Z = 3.0, 1.5, 7.0
EYE_Y = 0.7
TURN = 0.5
"""Tangent of the lamp's turn about the vertical: its 2 × 2 centres stand at four places across the shadow's edge."""


def draw(quick: bool) -> Sheet:
    """The bundle in section over the floor; below it the illuminance of the floor by each way of asking the lamp."""
    import numpy as np

    from illuminant.plots.sketch import LAMP, Sketch, new_sketches
    from illuminant.plots.style import TODAY, line_look

    width = 120 if quick else 240
    x = np.hypot(EYE_Z, EYE_Y) * np.tan(np.radians(12.0)) * (2 * (np.arange(width) + 0.5) / width - 1)
    area = _floor(width, "path", 512 if quick else 4096, depth=2)
    full = _floor(width, "path", 512 if quick else 4096, depth=2, plate=False)
    four = _floor(width, "raytrace", 1, light_centres="fixed:4")
    many = _floor(width, "raytrace", 1, light_centres="fixed:64")
    jittered = _floor(width, "distributed", 16)
    area, four, many, jittered = (one / full for one in (area, four, many, jittered))

    figure, (upper, lower) = new_sketches((7.4, 6.0), 1, 2)
    sketch = Sketch(upper)
    cos, sin = 1.0 / np.hypot(1.0, TURN), TURN / np.hypot(1.0, TURN)
    centres = np.array(sorted(0.25 * (a * cos + b * sin) for a in (-1, 1) for b in (-1, 1)))
    reach = 0.5 * (cos + sin)
    sketch.surface([x[0], 0.0], [x[-1], 0.0], 0.12)
    sketch.patch(
        [[-reach, LAMP_Y], [reach, LAMP_Y], [reach, LAMP_Y + 0.07], [-reach, LAMP_Y + 0.07]], face=LAMP
    )
    sketch.line([[x[0], PLATE_Y], [0.0, PLATE_Y]], color="#222222", linewidth=3.0)
    red, blue = line_look(1)["color"], line_look(0)["color"]
    for place in (-0.08, 0.85):
        for centre in centres:
            crossing = place + (centre - place) * PLATE_Y / LAMP_Y
            blocked = crossing < 0.0
            end = np.array([crossing, PLATE_Y]) if blocked else np.array([centre, LAMP_Y])
            look: dict[str, Any] = (
                {"linestyle": (0, (3, 2)), "linewidth": 0.8} if blocked else {"linewidth": 0.9}
            )
            sketch.ray(
                np.array([[place, 0.0], end]),
                red if blocked else blue,
                head=0.6 if blocked or place < 0.0 else 0.8,
                **look,
            )
    for centre in centres:
        sketch.dot([centre, LAMP_Y])
        edge = -centre * PLATE_Y / (LAMP_Y - PLATE_Y)
        sketch.line([[centre, LAMP_Y], [edge, 0.0]], linewidth=0.5, linestyle=":")
    sketch.label([x[0], PLATE_Y], "plate", (20, 9), fontsize=8.5)
    sketch.label([reach, LAMP_Y], "lamp, 4 centres", (44, 3), fontsize=8.5)
    # Widths are those of the plot below, so that steps stand under the ends of the dotted lines.
    sketch.frame(0.03)
    upper.set_aspect("auto")
    upper.set_xlim(x[0], x[-1])
    lower.plot(x, area, **TODAY, label="the area of the lamp")
    lower.plot(x, four, **line_look(1), label="4 centres")
    lower.plot(x, many, **line_look(2), linewidth=1.0, label="64 centres")
    lower.plot(x, jittered, color=blue, linewidth=0.7, label="16 rays, jittered")
    lower.set(
        xlabel="place on the floor, m", ylabel="illuminance over that without the plate", xlim=(x[0], x[-1])
    )
    lower.grid(True)
    lower.legend(loc="upper left")

    penumbra = np.abs(x) < 0.6
    levels = [float(np.abs(one - area)[penumbra].max()) for one in (four, many)]
    noise = float(np.sqrt(((jittered - area)[penumbra] ** 2).mean()))
    banding = float(np.sqrt(((four - area)[penumbra] ** 2).mean()))
    return Sheet(
        picture=figure,
        columns={
            "place, m": x,
            "area": area,
            "4 centres": four,
            "64 centres": many,
            "16 rays, jittered": jittered,
        },
        checks=(
            Check("largest error of 4 centres, of unshaded", levels[0], "", 0.10, 0.20),
            Check("largest error of 64 centres over it", levels[1] / levels[0], at_most=0.6),
            Check(
                "noise of 16 jittered rays over the banding of 4 centres, root mean square",
                noise / banding,
                at_most=0.8,
            ),
        ),
    )


def _floor(width: int, technique: str, samples: int, plate: bool = True, **options: Any) -> Array:
    """Luminance along a line of the floor."""
    import numpy as np

    import illuminant
    from illuminant.scene import Scene

    cos, sin = 1.0 / np.hypot(1.0, TURN), TURN / np.hypot(1.0, TURN)
    first, second = np.array([cos, 0.0, sin]), np.array([-sin, 0.0, cos])
    corner = np.array([0.0, LAMP_Y, 0.0]) - (first + second) / 2

    def rectangle(material: str, at: Any, *edges: Any) -> dict[str, Any]:
        return {"rectangle": {"corner": at, "edges": list(edges)}, "material": material}

    scene = Scene.build(
        camera={"eye": [0, EYE_Y, EYE_Z], "target": [0, 0, 0], "size": [width, 1], "field_of_view": 24.0},
        objects={
            "floor": rectangle("white", [-9, 0, -9], [0, 0, 18], [18, 0, 0]),
            "lamp": rectangle("lamp", corner.tolist(), first.tolist(), second.tolist()),
        }
        | ({"plate": rectangle("black", [-6, PLATE_Y, -3], [0, 0, 6], [6, 0, 0])} if plate else {}),
        materials={
            "white": {"kind": "diffuse", "reflectance": 0.5},
            "black": {"kind": "diffuse", "reflectance": 0.0},
            "lamp": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 1000.0},
        },
    )
    common: dict[str, Any] = {"sampling": "uniform:4", "filter": ("box", 1e-6), "seed": 1}
    if technique != "path":
        common["ambient"] = 0.0
    image = illuminant.render(scene, technique=technique, samples=samples, **common, **options)
    return np.asarray(image.xyz, float)[0, :, 1]


PLATE = Plate(
    number="4.18",
    title="Shadow tests to fixed centres of a lamp",
    shows="Above a lamp, a plate and the floor in section: from each place a bundle of 4 rays goes to 4 fixed "
    "centres of the lamp; those that the plate stops are dashed. Below, with the same places under each other, the "
    "illuminance of the floor. The lamp (1 m × 1 m) is turned, so that its centres stand at four places across the "
    "edge of the shadow.",
    claim="Fixed centres make bands: with 4 the penumbra is wrong by about an eighth of the light, 64 make the "
    "bands finer, and jittered rays turn them into noise that is smaller.",
    today="Jittered or Sobol points in the solid angle of the lamp, so that noise falls faster than the number of rays "
    "grows; fixed centres remain as `--light-centres fixed:N`.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique raytrace --light-centres fixed:4 --samples 1 -o four.png",
    ),
)
