"""Figure 4.33: rays towards mirror images, through glass and to the lamp (Whitted 1980; book eq 4.20).

One ray goes to the middle of the lamp, so a place is in the light or in the shadow and nothing between.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.33"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the edge of a shadow is measured on the floor, from above."""
    from illuminant.atlas.chapter_4 import compared_room as room

    hard, true = (room.edge_width(*room.shadow_edge(which, quick)) for which in (NUMBER, None))
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check("width of the edge of the ball's shadow (pixels of 1 cm)", 100 * hard, "cm", at_most=3.0),
            Check("the same in the reference", 100 * true, "cm", at_least=15.0),
            Check(
                "part of the silver ball that changes with the paint of the wall",
                room.repainted(NUMBER, quick),
                "",
                at_least=0.03,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: recursive rays, Whitted",
    shows="The same room by recursive ray tracing with Whitted's model. The book points at shadows, and at local "
    "reflection and refraction.",
    claim="The silver ball mirrors the red wall and the glass ball bends what is behind it; the lamp, asked at one "
    "place, casts a shadow whose edge is as sharp as a pixel where the real one is wider than a hand.",
    today="The constant K_s of the model knows no angle and no colour: copper mirrors white. `general` has Fresnel's "
    "equations for both.",
    draw=draw,
    commands=("illuminant render scenes/whitted.toml --size 480x360 --samples 4",),
)
