"""Figure 3.9: the xy chromaticity diagram, x = X/(X + Y + Z), y = Y/(X + Y + Z) (CIE 1931; book section 3.2)."""

from __future__ import annotations

from illuminant.atlas.chapter_3.control_lights import covered
from illuminant.atlas.plate import Check, Plate, Sheet

SYSTEMS = ("book NTSC", "sRGB", "Rec.2020")


def draw(quick: bool) -> Sheet:
    """Spectral locus, blackbodies, and the triangles of the book's NTSC monitor, of sRGB and of Rec. 2020."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots.diagram import diagram

    plane = diagram("xy")
    nm, locus = plane.spectral_locus(400, 700)
    grid = np.arange(380.0, 781.0)
    equal = plane.project(plane.observer.at(grid).sum(axis=0))
    book, _, wide = (covered(plane, plane.gamut(system)[1]) for system in SYSTEMS)
    return Sheet(
        picture=plots.chromaticity("xy", {"E": equal}, gamuts=SYSTEMS, size=(6.4, 5.5)),
        columns={"wavelength, nm": nm, "x": locus[:, 0], "y": locus[:, 1]},
        checks=(
            Check("smallest X, Y or Z of a spectral light", float(plane.observer.at(nm).min()), at_least=0.0),
            Check(
                "distance of a flat spectrum from (1/3, 1/3)", float(np.hypot(*(equal - 1 / 3))), at_most=1e-4
            ),
            Check(
                "share of the diagram that the book's NTSC monitor shows", book, at_least=0.45, at_most=0.5
            ),
            Check("share that Rec. 2020 shows", wide, at_least=0.6, at_most=0.66),
        ),
    )


PLATE = Plate(
    number="3.9",
    title="CIE xy chromaticity diagram",
    shows="The spectral colours and all that lies between, by $x = X/(X+Y+Z)$ and $y = Y/(X+Y+Z)$; the primaries X, Y "
    "and Z stand at (1, 0), (0, 1) and (0, 0). E is a flat spectrum.",
    claim="All colours have positive XYZ, a flat spectrum stands at (1/3, 1/3), and a monitor with NTSC phosphors "
    "shows less than half of the diagram.",
    today="Triangles of today stand in the same axes: sRGB shows 34 %, Rec. 2020 63 %. Distances mean nothing in xy; "
    "where they matter, u'v' (CIE 1976) or a uniform space takes its place.",
    draw=draw,
    commands=("illuminant spectra plot D65 FL11 --chromaticity uv --gamut sRGB -o uv.png",),
)
