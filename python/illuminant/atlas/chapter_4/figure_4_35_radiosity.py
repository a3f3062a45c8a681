"""Figure 4.35: radiosity with hemi-cubes (Goral et al. 1984; Cohen and Greenberg 1985; book eqs 4.27, 4.31, 4.32).

Every surface is a diffuser of its reflectance, and all light between them is solved for, scanline by scanline through
hemi-cubes. What is transparent is left out.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.35"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the colour that the red wall lends to the white one beside it."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    found, right = room.image(NUMBER, quick), room.reference(quick)
    bleeding = [float(room.bleeding(one)[0]) for one in (found, right)]
    silver = room.ball("silver", found, 0.8)
    spread = [float(np.std(one.xyz[silver, 1]) / np.mean(one.xyz[silver, 1])) for one in (found, right)]
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check("bleeding of the red wall in the reference, change of x", bleeding[1], "", at_least=0.005),
            Check("the same by radiosity over the reference", bleeding[0] / bleeding[1], "", 0.85, 1.15),
            Check("mean luminance over the reference", room.energy(NUMBER, quick), "", 0.95, 1.05),
            Check("contrast on the silver ball over the reference", spread[0] / spread[1], "", at_most=0.25),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: hemi-cube radiosity",
    shows="The same room by diffuse radiosity, with form factors from hemi-cubes. The book points at colour bleeding "
    "and at subtle shading and shadows.",
    claim="The red wall bleeds to the white one as it does in the reference, within 15 %, and the room holds as much "
    "light, within 5 %; what mirrors and what is glass in it is lost.",
    today="Form factors are found by rays by default, `--gather direct` makes shadows sharp, and `--gather full` "
    "looks around from every pixel.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique radiosity --form-factors scanline:64 --samples 16",
    ),
)
