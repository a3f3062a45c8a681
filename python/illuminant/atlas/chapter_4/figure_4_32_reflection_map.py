"""Figure 4.32: reflection mapping (Blinn and Newell 1976; book 4.1.1, figure 4.2).

What a surface mirrors is looked up in a picture of the surroundings, by direction alone. So the horizon is there, and
nothing that stands in the room.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.32"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; painting a wall and darkening the sky tell what the silver ball shows."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    found = room.image(NUMBER, quick)
    dusk = room.scene(quick).replace(
        lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 5.0}}
    )
    dark = room.rendered(NUMBER, quick, dusk)
    silver = room.ball("silver", found)
    change = np.abs(dark.xyz - found.xyz)[silver, 1] / found.xyz[silver, 1]
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check(
                "part of the silver ball that changes with the paint of the wall",
                room.repainted(NUMBER, quick),
                "",
                at_most=0.001,
            ),
            Check(
                "part of it that changes with the sky, by more than a twentieth",
                float((change > 0.05).mean()),
                "",
                at_least=0.9,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: reflection map",
    shows="The same room with a highlight by a power of the cosine and a reflection map. The book points at the "
    "horizon that is reflected, and at the lack of what is near. It traces rays to the first surface; here normals "
    "are interpolated, which shows the same. Light goes straight through the glass ball; from $1/n$ of its radius on "
    "it meets the far side beyond the critical angle, and none comes through: the dark ring.",
    claim="The silver ball shows the horizon and nothing of the room: it changes with the sky all over, and not at "
    "all when the red wall beside it is painted grey.",
    today="`raytrace` and everything after it asks what stands in the mirror direction; the map is what is left for "
    "rays that meet nothing.",
    draw=draw,
    commands=("illuminant render scenes/copper-spheres-mapped.toml --size 480x270",),
)
