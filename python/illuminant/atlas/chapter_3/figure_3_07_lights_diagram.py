"""Figure 3.7: the chromaticity diagram of lights of 445, 535 and 630 nm, seen along −L (book section 3.2)."""

from __future__ import annotations

from illuminant.atlas.chapter_3.control_lights import LIGHTS_NM, covered
from illuminant.atlas.plate import Check, Plate, Sheet

SYSTEMS = ("Rec.2020", "sRGB")


def draw(quick: bool) -> Sheet:
    """Spectral locus and triangle of the lights; in the same axes, the triangles of two systems of today."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots.diagram import diagram

    plane = diagram(LIGHTS_NM)
    nm, locus = plane.spectral_locus(400, 700)
    figure = plots.chromaticity(LIGHTS_NM, gamuts=SYSTEMS, size=(6.6, 5.5))
    share = 1.0 - locus.sum(axis=1)
    seen = ~np.isin(nm, LIGHTS_NM)
    outside = (locus.min(axis=1) < 0) | (share < 0)
    xy = diagram("xy")
    lights = covered(xy, xy.project(xy.observer.at(LIGHTS_NM)))
    narrow = covered(xy, xy.gamut("sRGB")[1])
    return Sheet(
        picture=figure,
        columns={"wavelength, nm": nm, "H": locus[:, 0], "M": locus[:, 1], "L": share},
        checks=(
            Check(
                "spectral lights inside the triangle", float((seen & ~outside).sum()), at_least=0, at_most=0
            ),
            Check("wavelength of the smallest H", float(nm[locus[:, 0].argmin()]), "nm", 495.0, 505.0),
            Check("share of the xy diagram inside the triangle", lights, at_least=0.58, at_most=0.64),
            Check("what it is of sRGB's", lights / narrow, at_least=1.7, at_most=1.95),
        ),
    )


PLATE = Plate(
    number="3.7",
    title="Chromaticity diagram of three monochromatic lights",
    shows="The share of 535 nm (M) against that of 630 nm (H); what is missing to 1 is the share of 445 nm. The curve "
    "holds the spectral colours, its inside all colours there are, and the triangle (0, 0), (1, 0), (0, 1) those that "
    "the three lights make.",
    claim="Three spectral lights make well over half of the xy diagram, and none of the other spectral colours; "
    "blue-greens of 500 nm are the farthest outside.",
    today="Rec. 2020 has just such primaries (467, 532 and 630 nm), and covers 63 % of the xy diagram where sRGB "
    "covers 34 % and the book's lights 61 %: both triangles stand in the same axes.",
    draw=draw,
    commands=("illuminant spectra plot D65 --chromaticity 445,535,630 --gamut sRGB -o lights.png",),
)
