"""Figure 2.19: what a rough surface scatters by its distribution of facets alone, with F = G = 1 (book eqs 2.39, 2.42).

1/cos θ ∫ D dω at 580 nm over the height σ and the angle of incidence, for four slopes m.
"""

from __future__ import annotations

from illuminant.atlas.chapter_2.energy_panels import TITLES, Column, columns, panels, today
from illuminant.atlas.chapter_2.reflected_energy import SLOPES, coherent, sections, surface
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Maps, and sections beside what `general` scatters."""
    import numpy as np

    shown = []
    for m, title in zip(SLOPES, TITLES, strict=True):
        whole, (series, book), general = surface(m, quick), sections(m, quick), today(m, quick)
        place = (title, whole.theta_deg, whole.sigma_nm, whole.facets, series.theta_deg, series.facets)
        shown.append(Column(*place, book.facets, (general.theta_deg, general.total - general.coherent)))
    gentle, *_, steep = shown
    left = 1.0 - coherent(0.0, gentle.sigma_nm)
    return Sheet(
        picture=panels(shown, "scattered share, D only", (0.0, 2.5)),
        columns=columns(shown, "scattered share"),
        checks=(
            Check(
                "largest departure from 1 − r_σ at m = 0.02, normal incidence",
                float(np.abs(gentle.share[:, 0] - left).max()),
                at_most=0.01,
            ),
            Check("largest share at m = 0.50", float(shown[2].share.max()), at_least=2.0),
            Check("largest share at m = 1.00", float(steep.share.max()), at_least=10.0),
            Check("share at m = 1.00, σ = 150 nm, normal incidence", float(steep.cut[-1, 0]), at_most=0.75),
        ),
    )


PLATE = Plate(
    number="2.19",
    title="Incoherent reflection by the distribution of facets alone",
    shows="The share that is scattered, $\\frac{1}{\\cos\\theta_i}\\int D\\,d\\omega$, with $F = G = 1$ at 580 nm, "
    "over the height σ (0 to 200 nm) and the angle of incidence, for slopes $m$ of 0.02, 0.10, 0.50 and 1.00; $D$ is "
    "that of eq 2.42. Orange is where the share is above 1; the sections end at 2.5. Where the book has "
    "surfaces, here are maps and sections.",
    claim="A gentle relief scatters at normal incidence just what is not coherent, $1 - r_\\sigma$; a steep one "
    "scatters too little there, and near grazing many times what arrives.",
    printed="Of eq 2.42 the book prints $\\exp(+\\tan^2\\alpha/m^2)$ for rough surfaces and a phase without its "
    "brackets; its program has both right, and so have the curves. The maps compute $D$ as that program does "
    "(appendix III.4); the sections have its series whole, and dashed as the program cuts it.",
    today="`general` scatters $1 - r_\\sigma$ of the light at every slope and angle.",
    draw=draw,
    commands=("illuminant audit 'copper, matte'",),
)
