"""Figure 4.29: one colour for each polygon, by Bouknight's model (1970; book eq 4.9).

The model is evaluated once a polygon, in its middle. So the ball is a faceted one, and a wall of two triangles has
two colours.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.29"
POLYGONS = 168
"""Triangles of the plastic ball; half of them face the eye."""


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; colours are counted in a picture with one sample in the middle of a pixel."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    middles = room.rendered(NUMBER, quick, samples=1, filter=("box", 1e-3))
    across, up = np.meshgrid(np.linspace(-1.6, 1.6, 41), np.linspace(1.4, 2.0, 21))
    wall = room.at(middles, np.stack([across, up, np.full_like(up, -2.0)], axis=-1))[..., 1]
    ball = middles.xyz[room.ball("plastic", middles), 1]
    smooth = room.rendered("4.30", quick, samples=1, filter=("box", 1e-3))
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check(
                "luminances of the back wall, which is two triangles", float(len(np.unique(wall))), "", 2, 2
            ),
            Check("luminances of the plastic ball", float(len(np.unique(ball))), "", at_most=POLYGONS),
            Check(
                "luminances of the same ball with colours interpolated",
                float(len(np.unique(smooth.xyz[room.ball("plastic", smooth), 1]))),
                "",
                at_least=2 * POLYGONS,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: one colour a polygon, Bouknight",
    shows="The first of nine pictures of one room (book 4.6): the colour of every polygon is constant, by "
    "Bouknight's model (eq 4.9). The book points at the faceted appearance. Below each picture stands how "
    "far it is from the reference: mean ΔE00 and FLIP, and its mean luminance in percent of the reference's (energy).",
    claim="Every polygon has one radiance: the back wall shows exactly two luminances, and the ball no more than it "
    "has polygons.",
    today="Beside it stands the reference of all nine, `path` with `general`, with its difference: what is missing "
    "here are shadows, highlights, mirrors, glass and the light that surfaces send each other.",
    draw=draw,
    commands=("illuminant render scenes/demo.toml --technique constant --illumination bouknight",),
)
