"""Figure 4.31: normals interpolated, by Phong's model (1975; book eq 4.11).

K_s has no wavelength, so a highlight has the colour of the lamp on whatever it lies: everything looks like plastic.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.31"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the terms of the model apart tell the colour of highlights."""
    import numpy as np

    from illuminant import color
    from illuminant.atlas.chapter_4 import compared_room as room

    found = room.rendered(NUMBER, quick, layers="terms")
    lamp = np.asarray(color.xyz_to_xyy(color.white_xyz("D65")))[:2]
    plastic, silver = room.ball("plastic", found), room.ball("silver", found)
    highlight, paint = found.layers["specular"], found.layers["diffuse"]

    def away(xyz: np.ndarray) -> float:
        return float(np.abs(room.chromaticity(xyz) - lamp).max())

    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check(
                "brightest highlight over the brightest paint of the plastic ball",
                float(highlight[plastic, 1].max() / paint[plastic, 1].max()),
                "",
                at_least=1.0,
            ),
            Check(
                "chromaticity of its highlight from the lamp's", away(highlight[plastic]), "", at_most=0.002
            ),
            Check("the same of silver", away(highlight[silver]), "", at_most=0.002),
            Check("chromaticity of its paint from the lamp's", away(paint[plastic]), "", at_least=0.05),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: normals interpolated, Phong",
    shows="The same room with normals interpolated and Phong's model. The book points at the highlights that have "
    "come, and at the look of plastic.",
    claim="The round things have highlights, and these have the colour of the lamp on blue paint as on silver: no "
    "highlight takes part in the colour of its surface.",
    today="In `general` what a surface reflects at once follows from Fresnel's equations at every wavelength: white "
    "on plastic, the metal's colour on a metal.",
    draw=draw,
    commands=(
        "illuminant render scenes/demo.toml --technique phong --illumination phong --layers terms -o demo.exr",
    ),
)
