"""Figure 4.9: the slope of brightness jumps where polygons meet (Gouraud 1971; book 4.2.4).

On a cylinder of n faces seen along a distant lamp, N·L at the angle φ is cos φ and the place on the screen sin φ.
Between corners at φ and φ + Δ the interpolated slope is −tan(φ + Δ/2), so at the corner in the middle it jumps by 2
tan(Δ/2), where the round cylinder has none.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

FACES = 12


def draw(quick: bool) -> Sheet:
    """A cylinder of twelve faces by interpolated colours, by interpolated normals, and round; a row of each below."""
    import math

    import numpy as np

    from illuminant.atlas.chapter_4.incremental_shading import cylinder, lit, shaded
    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.plots.style import TODAY, line_look

    size = 201 if quick else 361
    eye, field_of_view = 60.0, 2.2
    images = []
    for faces, technique in ((FACES, "gouraud"), (FACES, "phong"), (720, "phong")):
        scene = lit(
            {"mesh": cylinder(faces)},
            {"kind": "directional", "direction": [0, 0, -1], "illuminance_lx": 1000.0},
            size=size,
            eye=(0.0, 0.0, eye),
            field_of_view=field_of_view,
        )
        images.append(shaded(scene, technique))
    white = float(images[2].xyz[..., 1].max())
    place = (np.arange(size) + 0.5 - size / 2) * 2.0 * math.tan(math.radians(field_of_view / 2)) / size * eye
    rows = [image.xyz[size // 2, :, 1] / white for image in images]
    seen = np.abs(place) < 0.85
    figure, axes = pictures_over_curve(
        [image.shown(exposure=0.95 / white).picture.codes[size // 5 : -(size // 5)] for image in images],
        [
            f"colours interpolated (Gouraud)\n{FACES} faces",
            f"normals interpolated (Phong)\n{FACES} faces",
            "round",
        ],
    )
    for i, label in enumerate(("colours interpolated", "normals interpolated")):
        axes.plot(place[seen], rows[i][seen], **line_look(i), label=label)
    axes.plot(place[seen], rows[2][seen], **TODAY, label="round, every pixel its own normal")
    axes.set(xlabel="place across the cylinder, x/R", ylabel="luminance, of the largest", xlim=(-0.85, 0.85))
    axes.legend(loc="lower center")

    def slope(row: np.ndarray, low: float, high: float) -> float:
        part = (place > low) & (place < high)
        return float(np.polyfit(place[part], row[part], 1)[0])

    # The faces beside the corner in the middle end at sin 30° = 0.5.
    jumps = [slope(row, -0.12, -0.01) - slope(row, 0.01, 0.12) for row in rows]
    expected = 2.0 * math.tan(math.pi / FACES)
    return Sheet(
        picture=figure,
        columns={
            "x/R": place[seen],
            "colours interpolated": rows[0][seen],
            "normals interpolated": rows[1][seen],
            "round": rows[2][seen],
        },
        checks=(
            Check("jump of the slope in the middle over 2 tan(π/12)", jumps[0] / expected, "", 0.95, 1.05),
            Check("the same place with normals interpolated, of that", jumps[1] / jumps[0], "", at_most=0.4),
            Check(
                "largest error of interpolated colours",
                float(np.abs(rows[0] - rows[2])[seen].max()),
                "of the largest luminance",
                at_least=0.02,
            ),
        ),
    )


PLATE = Plate(
    number="4.9",
    title="Mach bands of interpolated colours",
    shows=f"A cylinder of {FACES} faces whose corners have the normals of the round one, under a distant lamp, "
    "shaded by interpolated colours. The rate of change is constant across a face and differs from that of its "
    "neighbour.",
    claim="Where two faces meet, the slope of interpolated colours jumps by $2\\tan(\\Delta/2)$, $\\Delta$ being the "
    "angle between them, and the eye draws a band there; interpolated normals leave less than half of that.",
    today="The model is evaluated at every pixel, with the normal of the place; `--subdivide 4` brings `gouraud` "
    "there too, because its polygons are then no larger than four pixels.",
    draw=draw,
    commands=("illuminant compare scenes/demo.toml --techniques gouraud,phong --size 320x180",),
)
