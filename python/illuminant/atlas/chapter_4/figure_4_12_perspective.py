"""Figure 4.12: positions and normals interpolated on the screen are those of other places (book 4.2.4).

Perspective is not linear: half way between two corners on the screen is not half way between them in the world. Under
a local lamp the model is then evaluated with a wrong direction and distance to the lamp. With the perspective
division put off until after interpolation (a/w and 1/w are linear on the screen), every pixel has the place that a
ray meets.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

TILT_DEG = 65.0
CELLS = (1, 2, 4, 8, 16)


def draw(quick: bool) -> Sheet:
    """A tipped square with positions interpolated on the screen, and in the world; its middle column below."""
    import numpy as np

    from illuminant.atlas.chapter_4.incremental_shading import lit, shaded, square
    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.image import Image
    from illuminant.plots.style import TODAY, line_look

    size = 161 if quick else 361

    def image(cells: int, technique: str = "phong", **options: str) -> Image:
        scene = lit(
            {"mesh": square(cells, TILT_DEG)},
            {"kind": "point", "position": [0, 0.55, 0.1], "intensity_cd": 300.0},
            size=size,
            eye=(0.0, 0.0, 2.6),
            field_of_view=46.0,
        )
        return shaded(scene, technique, **options)

    images = {f"screen, {cells}": image(cells, interpolation="screen") for cells in CELLS}
    images["object"] = image(1, interpolation="object")
    ray = image(1, "raytrace")
    white = float(ray.xyz[..., 1].max())
    shown = [images["screen, 1"], images["screen, 4"], images["object"]]
    figure, axes = pictures_over_curve(
        [one.shown(exposure=0.95 / white).picture.codes[size // 5 : -(size // 4)] for one in shown],
        ["on the screen\ntwo triangles", "on the screen\n4 × 4 squares", "in the world\ntwo triangles"],
    )
    # Beside the diagonal that the triangles share.
    column = size // 2
    seen = np.flatnonzero(ray.xyz[:, column, 1] > 0)[2:-2]
    place = (size / 2 - seen - 0.5) / size
    curves = {name: one.xyz[seen, column, 1] for name, one in images.items()}
    axes.plot(place, curves["screen, 1"], **line_look(0), label="on the screen, two triangles")
    axes.plot(place, curves["screen, 4"], **line_look(1), label="on the screen, 4 × 4 squares")
    axes.plot(place, ray.xyz[seen, column, 1], **TODAY, label="in the world, and ray traced")
    axes.set(
        xlabel="height on the screen, in heights of the image",
        ylabel="luminance, middle column, cd/m²",
        ylim=(0, None),
    )
    axes.legend(loc="upper left", fontsize=8)
    inside = ray.xyz[..., 1] > 0
    for step in (-1, 1):
        for axis in (0, 1):
            inside &= np.roll(ray.xyz[..., 1] > 0, step, axis)
    errors = {
        name: float(np.abs(one.xyz[inside, 1] - ray.xyz[inside, 1]).mean() / ray.xyz[inside, 1].mean())
        for name, one in images.items()
    }
    return Sheet(
        picture=figure,
        columns={
            "height on the screen": place,
            **{f"on the screen, {cells} x {cells}, cd/m²": curves[f"screen, {cells}"] for cells in CELLS},
            "in the world, cd/m²": curves["object"],
            "ray traced, cd/m²": ray.xyz[seen, column, 1],
        },
        checks=(
            Check("mean error on the screen, two triangles", errors["screen, 1"], "", at_least=0.1),
            Check(
                "error of 16 × 16 squares over that of one",
                errors["screen, 16"] / errors["screen, 1"],
                "",
                at_most=0.1,
            ),
            Check("mean error in the world, two triangles", errors["object"], "", at_most=0.001),
        ),
    )


PLATE = Plate(
    number="4.12",
    title="Distortion by interpolation on the screen",
    shows="A diffuse square of two triangles, tipped away from the eye and lit by a lamp close to it; positions and "
    "normals are interpolated on the screen, after perspective.",
    claim="Interpolated on the screen, the pool of light lies in another place and breaks along the diagonal; small "
    "polygons lessen that, and interpolation in the world has none of it.",
    today="`--interpolation object`, the default, interpolates over w and gives the value of a ray within a "
    "thousandth; `screen` is kept to show what was.",
    draw=draw,
    commands=(
        "illuminant render scenes/demo.toml --technique phong --illumination phong --interpolation screen",
    ),
)
