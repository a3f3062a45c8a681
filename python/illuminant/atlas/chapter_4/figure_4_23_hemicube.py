"""Figure 4.23: a hemi-cube for form factors: patches are seen through its cells (book eq 4.32)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

POLYGONS = (
    ((-0.25, -0.5, 2.0), (0.85, -0.5, 1.75), (0.85, 0.5, 1.75), (-0.25, 0.5, 2.0)),
    ((1.9, -0.75, 0.25), (1.9, 0.55, 0.25), (1.75, 0.55, 1.15), (1.75, -0.75, 1.15)),
)
DRAWN = 16


def draw(quick: bool) -> Sheet:
    """Two patches and the cells through which they are seen; errors at several resolutions."""
    import numpy as np

    from illuminant.atlas.chapter_4.hemicube import hemicube, point_to_polygon, seen_through
    from illuminant.plots.sketch import Sketch, View, new_sketches
    from illuminant.plots.style import line_look

    polygons = [np.array(one) for one in POLYGONS]
    colours = [line_look(k)["color"] for k in (1, 0)]
    cells = hemicube(DRAWN)
    covered = [seen_through(cells, one) for one in polygons]
    figure, (axes,) = new_sketches((6.6, 5.2))
    sketch = Sketch(axes, View(-42.0, 24.0))
    base = np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]], float)
    sketch.patch(1.3 * base, zorder=1)
    sketch.patches(list(cells.corners[cells.faces == 0]), ["none"] * DRAWN**2, linewidths=0.25, zorder=3)
    for face in (1, 4):
        own = cells.corners[cells.faces == face]
        sketch.patches(list(own), ["#ffffff66"] * len(own), linewidths=0.25, zorder=2.5)
    sketch.box([-1, -1, 0], [1, 1, 1])
    for name, polygon, cover, colour in zip("AB", polygons, covered, colours, strict=True):
        sketch.patches(list(cells.corners[cover]), [colour] * int(cover.sum()), zorder=4, linewidths=0.3)
        for corner in polygon:
            sketch.line([[0, 0, 0], corner], color=colour, linewidth=0.6, zorder=4.5)
        sketch.patch(polygon, face=colour, edge="#222222", zorder=6, alpha=0.6)
        sketch.label(polygon.mean(axis=0), name, (-16, 0), fontsize=12, zorder=10)
    sketch.dot([0, 0, 0])
    sketch.arrow([0, 0, 0], [0, 0, 1.35], "$\\mathbf{N}$")
    sketch.label([1.3, -1.3, 0], "patch that receives", (-72, 6), fontsize=8.5)
    sketch.frame()

    resolutions = np.array([8, 16, 32, 64, 128] if quick else [8, 16, 32, 64, 128, 256])
    exact = np.array([point_to_polygon(one) for one in polygons])
    sums = np.array(
        [[c.delta[seen_through(c, p)].sum() for p in polygons] for c in map(hemicube, resolutions)]
    )
    error = np.abs(sums / exact - 1.0)
    return Sheet(
        picture=figure,
        columns={
            "cells along an edge": resolutions,
            "form factor of A": sums[:, 0],
            "form factor of B": sums[:, 1],
            "exact, A": [exact[0]] * len(resolutions),
            "exact, B": [exact[1]] * len(resolutions),
        },
        checks=(
            Check("error with 64 cells along an edge", float(error[3].max()), at_most=0.03),
            Check("error with 128 cells along an edge", float(error[4].max()), at_most=0.015),
            Check("cells through which both are seen", float((covered[0] & covered[1]).sum()), at_most=0.0),
        ),
    )


PLATE = Plate(
    number="4.23",
    title="A hemi-cube for form factors",
    shows="Patches with the same projection have the same form factor, so the surroundings are projected onto half a "
    "cube about the middle of a patch, and the delta form factors of the cells that a patch covers are added, "
    "$F = \\sum\\Delta F_q$ (eq 4.32). Drawn with 16 cells along an edge; the book advises 50 to 100.",
    claim="With 64 cells along an edge the sum is within 3 % of the exact form factor from the point (Lambert 1760), "
    "with 128 within 1.5 %: the error is that of the cells along the rim.",
    today="A hemi-cube stands at one point and aliases; rays from all over the element with random places (`rays:N`) "
    "turn that into noise. `scanline:N` fills the cells by scan conversion, `hemicube:N` by rays.",
    draw=draw,
    commands=(
        "illuminant radiosity solve scenes/cornell.toml --form-factors scanline:64 --elements 1000 -o cornell.solution",
    ),
)
