"""Figure 4.27: the four mechanisms of illumination (Wallace et al. 1987; book 4.5)."""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

WAYS = {
    "dd": "diffuse to diffuse",
    "sd": "specular to diffuse",
    "ds": "diffuse to specular",
    "ss": "specular to specular",
}


def draw(quick: bool) -> Sheet:
    """How light arrives and how it is reflected, and what each way brings to the image of a room."""
    from illuminant.plots.sketch import new_sketches

    ways = tuple(WAYS)
    whole = _room(ways, quick)
    shares = {
        one: 1.0 - _room(tuple(way for way in ways if way != one), quick).mean() / whole.mean()
        for one in ways
    }
    none = _room(("dd", "sd"), quick, at_mirror=True)
    figure, panels = new_sketches((8.6, 5.0), 2, 2)
    for axes, one in zip(panels, ways, strict=True):
        _mechanism(axes, one)
        axes.set_title(f"{WAYS[one]} ({100 * shares[one]:.2g} % missing without)")
    path = _room(None, quick)
    return Sheet(
        picture=figure,
        columns={
            "mechanism": list(WAYS.values()),
            "part of the mean luminance that is missing without it": [shares[one] for one in ways],
        },
        checks=(
            Check("smallest part that a mechanism brings", min(shares.values()), at_least=1e-4),
            Check("part that diffuse to diffuse brings", shares["dd"], at_least=0.5),
            Check(
                "luminance of a mirror without what arrives at the specular",
                float(none.max()),
                "cd/m²",
                at_most=1e-9,
            ),
            Check("all four over what paths find", float(whole.mean() / path.mean()), "", 0.9, 1.1),
        ),
    )


def _mechanism(axes: Any, way: str) -> None:
    """A surface with light that arrives from one direction or from all, and leaves in one lobe or in all directions."""
    import numpy as np

    from illuminant.plots.sketch import Sketch
    from illuminant.plots.style import line_look

    sketch = Sketch(axes)
    red, blue = line_look(1)["color"], line_look(0)["color"]
    sketch.surface([-1.3, 0.0], [1.3, 0.0], 0.1)

    def up(angle_deg: float) -> np.ndarray:
        return np.array([np.sin(np.radians(angle_deg)), np.cos(np.radians(angle_deg))])

    mirror = 45.0
    fan = (-75.0, -60.0, -45.0, -30.0, -15.0) if way[0] == "d" else (-mirror,)
    for angle in fan:
        look = {"linewidth": 0.8, "alpha": 0.8} if way[0] == "d" else {"linewidth": 1.8}
        sketch.ray(np.array([1.15 * up(angle), 0.0 * up(angle)]), red, **look)
    angles = np.linspace(-89.0, 89.0, 179)
    # A diffuse lobe has the cosine as its radius; a specular one is a Gaussian about the mirror direction.
    lobe = np.cos(np.radians(angles)) * 0.75 if way[1] == "d" else np.exp(-(((angles - mirror) / 9.0) ** 2))
    outline = np.stack([lobe * np.sin(np.radians(angles)), lobe * np.cos(np.radians(angles))], axis=-1)
    sketch.patch(outline, face="#dbe9f3", edge=blue, zorder=2.5)
    for angle in (-60.0, -30.0, 0.0, 30.0, 60.0) if way[1] == "d" else (mirror,):
        length = float(np.interp(angle, angles, lobe))
        sketch.arrow([0.0, 0.0], length * up(angle), colour=blue, linewidth=1.0 if way[1] == "d" else 1.8)
    sketch.paper([[0.0, 1.1]])
    sketch.frame(0.02)


def _room(ways: tuple[str, ...] | None, quick: bool, at_mirror: bool = False) -> Any:
    """Luminances of a room with two mirrors that face each other, by `hybrid` with some ways, or by `path`."""
    import numpy as np

    import illuminant
    from illuminant.scene import Scene

    def rectangle(material: str, at: list[float], *edges: list[float]) -> dict[str, Any]:
        return {"rectangle": {"corner": at, "edges": list(edges)}, "material": material}

    view = {"eye": [1, 0.9, 1], "target": [2, 0.9, 1], "field_of_view": 30}
    scene = Scene.build(
        camera=(view if at_mirror else {"eye": [0.5, 1, 1.7], "target": [1.9, 0.9, 0.9], "field_of_view": 70})
        | {"size": [24, 24]},
        objects={
            "floor": rectangle("white", [0, 0, 0], [0, 0, 2], [2, 0, 0]),
            "ceiling": rectangle("white", [0, 2, 0], [2, 0, 0], [0, 0, 2]),
            "back": rectangle("white", [0, 0, 0], [2, 0, 0], [0, 2, 0]),
            "left": rectangle("white", [0, 0, 0], [0, 2, 0], [0, 0, 2]),
            "right": rectangle("white", [2, 0, 0], [0, 0, 2], [0, 2, 0]),
            "front": rectangle("white", [0, 0, 2], [0, 2, 0], [2, 0, 0]),
            "lamp": rectangle("lamp", [0.6, 1.75, 0.6], [0.8, 0, 0], [0, 0, 0.8]),
            "mirror": rectangle("mirror", [1.98, 0.3, 0.4], [0, 0, 1.2], [0, 1.2, 0]),
            "other mirror": rectangle("mirror", [0.02, 0.3, 0.4], [0, 1.2, 0], [0, 0, 1.2]),
        },
        materials={
            "white": {"kind": "diffuse", "reflectance": 0.7},
            "lamp": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 5000.0},
            "mirror": {"kind": "conductor", "metal": "Ag"},
        },
    )
    options: dict[str, Any] = {"sampling": "uniform:4", "samples": 8 if quick else 32, "seed": 1}
    if ways is None:
        options |= {"technique": "path", "samples": 64 if quick else 256}
    else:
        options |= {"technique": "hybrid", "mechanisms": ways, "elements": 600 if quick else 1500}
        options["form_factors"] = "rays:64"
    return np.asarray(illuminant.render(scene, **options).xyz, float)[..., 1]


PLATE = Plate(
    number="4.27",
    title="The four mechanisms of illumination",
    shows="Light arrives at a surface from diffuse or from specular surfaces, and is reflected in a diffuse or a "
    "specular way. The share of each is that of the mean luminance of a white room with a lamp and two silver "
    "mirrors that face each other, as far as it is missing when the way is left out.",
    claim="Each of the four ways brings light, diffuse to diffuse most; without the two that end at the specular a "
    "mirror is black, and all four together are what paths find, to a tenth.",
    today="`hybrid` follows the ways that are asked for (`--mechanisms dd,sd`); `path` makes no difference between "
    "them, as every reflection is drawn from the material as a whole.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique hybrid --mechanisms dd,ds --samples 4 -o without.png",
    ),
)
