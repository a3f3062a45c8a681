"""Figure 4.25: hemi-cubes that stand as their patches do (Immel et al. 1986; book 4.4.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

RESOLUTION = 8


def draw(quick: bool) -> Sheet:
    """Two patches that face each other at an angle, and what one hemi-cube's cell is in the other."""
    import numpy as np

    from illuminant.atlas.chapter_4.facing_patches import draw_cubes, frames, misfit_deg

    figure = draw_cubes(RESOLUTION, local=True)
    first, second = frames()
    misfit = misfit_deg(RESOLUTION, (first, second))
    aligned = misfit_deg(RESOLUTION, (first, np.diag([1.0, -1.0, -1.0]) @ first))
    cell = np.degrees(2.0 / RESOLUTION)
    return Sheet(
        picture=figure,
        columns={
            "cell of the source": np.arange(len(misfit)),
            "its direction from the middle of the nearest cell of the target, deg": misfit,
        },
        checks=(
            Check(
                "mean misfit of directions over the width of a cell",
                float(misfit.mean() / cell),
                at_least=0.1,
            ),
            Check("cells that fit exactly", float((misfit < 1e-9).mean()), at_most=0.05),
            Check(
                "the same for patches that lie opposite: misfit", float(aligned.max()), "deg", at_most=1e-5
            ),
        ),
    )


PLATE = Plate(
    number="4.25",
    title="Hemi-cubes that stand as their patches do",
    shows="With directional reflection a solution needs the light that a patch sends into each direction of its "
    "hemi-cube: 7,500 for 50 cells along an edge. The hemi-cubes stand as their patches do, and the direction between "
    "two of them passes through some cell of one and some cell of the other.",
    claim="A cell of one hemi-cube has no counterpart in the other: looked at from there its direction misses the "
    "middle of the nearest cell, unless the patches happen to lie opposite.",
    today="`specular-radiosity` takes cubes that all stand alike (figure 4.26), as Immel did.",
    draw=draw,
    commands=("illuminant atlas 4.26",),
)
