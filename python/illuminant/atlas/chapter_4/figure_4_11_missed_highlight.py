"""Figure 4.11: a highlight inside a polygon, which interpolated colours never see (Phong 1975; book 4.2.4).

The model is evaluated at the corners alone; a highlight that none of them lies in is lost.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """One shiny square by interpolated colours, by interpolated normals, and by colours on small polygons."""
    import numpy as np

    from illuminant.atlas.chapter_4.incremental_shading import lit, shaded, square
    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.plots.style import TODAY, line_look

    size = 161 if quick else 361
    scene = lit(
        {"mesh": square(1)},
        {"kind": "point", "position": [0, 0, 3], "intensity_cd": 2000.0},
        size=size,
        material="plastic",
    )
    images = [
        shaded(scene, "gouraud", "phong", layers="terms"),
        shaded(scene, "phong", "phong", layers="terms"),
        shaded(scene, "gouraud", "phong", subdivide=4.0, layers="terms"),
    ]
    white = float(images[1].xyz[..., 1].max())
    figure, axes = pictures_over_curve(
        [image.shown(exposure=0.4 / white).picture.codes for image in images],
        [
            "colours interpolated (Gouraud)\ntwo triangles",
            "normals interpolated (Phong)\ntwo triangles",
            "colours interpolated\ntriangles of 4 pixels",
        ],
        curve_height=300,
    )
    row = size // 2
    seen = images[1].xyz[row, :, 1] > 0
    place = ((np.arange(size) + 0.5 - size / 2) / (seen.sum() / 2))[seen]
    rows = [image.xyz[row, seen, 1] for image in images]
    axes.plot(place, rows[0], **line_look(0), label="colours interpolated")
    axes.plot(place, rows[1], **TODAY, label="normals interpolated")
    axes.plot(place, rows[2], **line_look(1), label="colours interpolated, 4 pixels")
    axes.set(xlabel="place across the square, x", ylabel="luminance, cd/m²", xlim=(-1, 1), ylim=(0, None))
    axes.legend(loc="lower center", ncols=3, borderaxespad=0.2)
    highlights = [float(image.layers["specular"][..., 1].max()) for image in images]
    return Sheet(
        picture=figure,
        columns={
            "x": place,
            "colours interpolated, cd/m²": rows[0],
            "normals interpolated, cd/m²": rows[1],
            "colours interpolated on polygons of 4 pixels, cd/m²": rows[2],
        },
        checks=(
            Check(
                "brightest specular term, colours over normals",
                highlights[0] / highlights[1],
                "",
                at_most=0.02,
            ),
            Check(
                "specular term in the middle over the diffuse, normals",
                highlights[1] / float(images[1].layers["diffuse"][row, row, 1]),
                "",
                at_least=0.5,
            ),
            Check(
                "brightest specular term, colours on small polygons",
                highlights[2] / highlights[1],
                "",
                0.95,
                1.05,
            ),
        ),
    )


PLATE = Plate(
    number="4.11",
    title="A highlight that is missed",
    shows="A square of shiny blue plastic, two triangles, with a lamp in front of its middle: Phong's model (eq "
    "4.11) with colours interpolated from the corners.",
    claim="Interpolated colours lose the whole highlight, because no corner lies in it; interpolated normals show "
    "it, more than half as bright again as the paint.",
    today="Every technique that evaluates the model at pixels finds the highlight; `--subdivide 4` finds it with "
    "interpolated colours too, within 5 %.",
    draw=draw,
    commands=(
        "illuminant compare scenes/demo.toml --techniques gouraud,phong --illuminations phong --size 320x180",
    ),
)
