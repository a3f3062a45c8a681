"""Figure 4.36: radiosity of an environment that reflects (Immel, Cohen and Greenberg 1986; book 4.4.3, appendix IV.3).

Every patch sends its own light into every cell of a cube, so what it shows depends on where it is seen from. A mirror
image is as blurred as the cells are wide.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.36"
ASIDE = (2.4, 1.7, 5.5)
"""Another place of the eye, to the right."""


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the top of the block is looked at from another place, too."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    along, deep = np.meshgrid(np.linspace(-0.6, 0.6, 9), np.linspace(-0.6, 0.6, 9))
    top = room.on_block(along, 1.0, deep)

    def change(number: str) -> float:
        aside = room.solved(number, quick).render(
            samples=room.SAMPLES[number][not quick], camera={"eye": ASIDE}
        )
        here = room.at(room.image(number, quick), top)[..., 1].mean()
        return float(room.at(aside, top, ASIDE)[..., 1].mean() / here)

    silver = room.ball("silver", room.reference(quick), 0.8)

    def steps(number: str | None) -> float:
        picture = room.reference(quick) if number is None else room.image(number, quick)
        luminance = np.asarray(picture.xyz[..., 1], float)
        return float(np.abs(np.diff(luminance, axis=1))[silver[:, 1:]].mean() / luminance[silver].mean())

    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check("block from the other place over this one, radiosity", change("4.35"), "", 0.98, 1.02),
            Check(
                "departure of the same from 1, specular radiosity",
                abs(change(NUMBER) - 1.0),
                "",
                at_least=0.05,
            ),
            Check(
                "steps of luminance on the silver ball, over the reference",
                steps(NUMBER) / steps(None),
                "",
                0,
                0.3,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: radiosity that reflects",
    shows="The same room by radiosity with directions: each patch has a cube of cells into which it sends light "
    "(Immel, Cohen and Greenberg). The book shows a reflective environment. What is glass is left out.",
    claim="The copper block looks different from another place, which diffuse radiosity cannot; but a mirror is no "
    "sharper than the cells of the cubes, and the silver ball shows less than a third of the reference's detail.",
    today="It is kept because it shows what directions cost in memory; `hybrid` follows mirrors with rays and is "
    "sharp for less.",
    draw=draw,
    commands=(
        "illuminant render scenes/cornell.toml --technique specular-radiosity --elements 300 --cube 8 --samples 4",
    ),
)
