"""Figure 4.26: cubes that all stand alike, so that a direction is the same cell for every patch (book 4.4.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

RESOLUTION = 8


def draw(quick: bool) -> Sheet:
    """The patches of figure 4.25 with cubes in one position; the solid angles of cells."""
    import numpy as np

    from illuminant.atlas.chapter_4.facing_patches import draw_cubes, misfit_deg, solid_angles

    figure = draw_cubes(RESOLUTION, local=False)
    same = np.eye(3)
    misfit = misfit_deg(RESOLUTION, (same, same), whole=True)
    counts = np.array([4, 8, 16, 32, 50])
    angles = [solid_angles(int(n)) for n in counts]
    smallest, largest = (np.array([f(one) for one in angles]) for f in (np.min, np.max))
    return Sheet(
        picture=figure,
        columns={
            "cells along an edge": counts,
            "directions": 6 * counts**2,
            "smallest solid angle, sr": smallest,
            "largest solid angle, sr": largest,
            "widest cell, deg": np.degrees(2.0 / counts),
        },
        checks=(
            Check("misfit of a direction and the opposite cell", float(misfit.max()), "deg", at_most=1e-5),
            Check(
                "solid angles of all cells over 4π",
                float(angles[1].sum() / (4 * np.pi)),
                "",
                1 - 1e-12,
                1 + 1e-12,
            ),
            Check(
                "largest over smallest cell of a cube of 50, over 3√3",
                float(largest[4] / smallest[4] / (3 * np.sqrt(3.0))),
                "",
                0.9,
                1.0,
            ),
            Check("widest cell of a cube of 50", float(np.degrees(2.0 / 50)), "deg", at_most=2.3),
        ),
    )


PLATE = Plate(
    number="4.26",
    title="The cube that stands alike everywhere",
    shows="About every patch stands a whole cube, turned as the world is and not as the patch. What leaves a source "
    "through a cell arrives at a target through the opposite one: an index, and no search.",
    claim="The opposite of every cell's direction is a cell again, the cells share the sphere without gap, and they "
    "differ by up to $3\\sqrt{3}$ in solid angle; 50 along an edge tell directions apart to $2.3°$, too few for a "
    "mirror.",
    today="`specular-radiosity` has `--cube 32` and shows its directions in sharp mirrors; `hybrid` follows rays "
    "for what is specular and stores no directions at all.",
    draw=draw,
    commands=("illuminant atlas 4.27",),
)
