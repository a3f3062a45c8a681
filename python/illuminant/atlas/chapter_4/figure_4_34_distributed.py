"""Figure 4.34: distributed rays by Hall's model (Cook, Porter and Carpenter 1984; Hall and Greenberg 1983; eq 4.21).

Rays to the lamp are spread over its area and over the samples of a pixel. What is not followed, light from one
diffuse surface to another, is still one ambient number.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.34"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the penumbra on the floor, the colour of copper, and what does not bleed."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    found, whitted = room.image(NUMBER, quick), room.image("4.33", quick)
    soft, true = (room.edge_width(*room.shadow_edge(which, quick)) for which in (NUMBER, None))
    front = room.on_block(*np.meshgrid(np.linspace(-0.7, 0.7, 8), np.linspace(-0.6, 0.6, 6)), 1.0)
    x = [float(room.chromaticity(room.at(one, front))[0]) for one in (found, whitted, room.reference(quick))]
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check("width of the penumbra over the reference's", soft / true, "", 0.75, 1.25),
            Check("x of the copper block, Hall over the reference", x[0] - x[2], "", -0.03, 0.03),
            Check("x of the copper block, Hall over Whitted", x[0] - x[1], "", at_least=0.02),
            Check(
                "bleeding of the red wall, change of x",
                float(np.abs(room.bleeding(found)).max()),
                "",
                at_most=1e-4,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: distributed rays, Hall",
    shows="The same room by distributed ray tracing with Hall's model. The book points at the spectral character of "
    "reflections, at what the rim of the glass ball reflects, and at soft shadows; only its light sources are "
    "distributed, here gloss is too.",
    claim="The penumbra is as wide as the reference's within a quarter, and copper reflects in copper's colour; of "
    "the red wall nothing bleeds to the white one beside it.",
    today="`path` follows light between diffuse surfaces too, and the ambient number is gone.",
    draw=draw,
    commands=("illuminant render scenes/demo.toml --technique distributed --illumination hall --samples 16",),
)
