"""Figure 2.20: what a rough surface scatters by its facets and their shadows, with F = 1 (book eqs 2.22, 2.39, 2.42).

1/cos θ ∫ D G dω at 580 nm over the height σ and the angle of incidence, for four slopes m; G is Sancer's.
"""

from __future__ import annotations

from illuminant.atlas.chapter_2.energy_panels import TITLES, Column, columns, panels, today
from illuminant.atlas.chapter_2.reflected_energy import SLOPES, sections, surface
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Maps, and sections beside what `general` scatters."""
    shown, general = [], None
    for m, title in zip(SLOPES, TITLES, strict=True):
        whole, (series, book), general = surface(m, quick), sections(m, quick), today(m, quick)
        place = (
            title,
            whole.theta_deg,
            whole.sigma_nm,
            whole.incoherent,
            series.theta_deg,
            series.incoherent,
        )
        shown.append(Column(*place, book.incoherent, (general.theta_deg, general.total - general.coherent)))
    steep = shown[-1]
    assert steep.today is not None
    return Sheet(
        picture=panels(shown, "scattered share, D and G", (0.0, 1.1)),
        columns=columns(shown, "scattered share"),
        checks=(
            Check("largest share", max(float(one.share.max()) for one in shown), at_most=1.005),
            Check("share at m = 1.00, σ = 150 nm, normal incidence", float(steep.cut[-1, 0]), at_most=0.5),
            Check("the same of general", float(steep.today[1][0]), at_least=0.99, at_most=1.01),
        ),
    )


PLATE = Plate(
    number="2.20",
    title="Incoherent reflection with geometric attenuation",
    shows="The share that is scattered, $\\frac{1}{\\cos\\theta_i}\\int D G\\,d\\omega$, with $F = 1$ at 580 nm, "
    "over the height σ (0 to 200 nm) and the angle of incidence, for slopes $m$ of 0.02, 0.10, 0.50 and 1.00; $D$ is "
    "that of eq 2.42 and $G$ Sancer's of eq 2.22. Where the book has surfaces, here are maps and sections.",
    claim="Geometric attenuation ends the gain of figure 2.19, so that facets alone never scatter more than arrives, "
    "but of a steep relief half of the light is missing.",
    printed="The maps compute $D$ as the book's program does (appendix III.4); the sections have its series whole, "
    "and dashed as the program cuts it, which loses up to 0.02 more.",
    today="What is missing has met another facet. `general` follows it (the walk on Smith's microsurface of Heitz et "
    "al. 2016, without chance) and scatters all of it.",
    draw=draw,
    commands=("illuminant audit 'copper, matte'",),
)
