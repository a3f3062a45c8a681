"""Figure 2.21: what a rough surface reflects by theory with F = 1, coherently and incoherently (book eqs 2.35 to 2.42).

r_σ G + 1/cos θ ∫ D G dω at 580 nm, over the height σ and the angle of incidence, for four slopes m.
"""

from __future__ import annotations

from illuminant.atlas.chapter_2.energy_panels import TITLES, Column, columns, panels, today
from illuminant.atlas.chapter_2.reflected_energy import SLOPES, sections, surface
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Maps, and sections beside the balance of `general`."""
    import numpy as np

    shown, now = [], []
    for m, title in zip(SLOPES, TITLES, strict=True):
        whole, (series, book), general = surface(m, quick), sections(m, quick), today(m, quick)
        now.append(general.total)
        place = (title, whole.theta_deg, whole.sigma_nm, whole.total, series.theta_deg, series.total)
        shown.append(Column(*place, book.total, (general.theta_deg, general.total)))
    polished, *_, steep = shown
    middle = shown[2]
    return Sheet(
        picture=panels(shown, "reflected share", (0.0, 1.25)),
        columns=columns(shown, "reflected share"),
        checks=(
            Check("largest share at m = 0.50", float(middle.share.max()), at_least=1.1),
            Check("share at m = 1.00, σ = 80 nm, normal incidence", float(steep.cut[1, 0]), at_most=0.5),
            Check(
                "largest departure from 1 at m = 0.02, θ up to 80°",
                float(np.abs(polished.share[:, polished.theta_deg <= 80.0] - 1.0).max()),
                at_most=0.01,
            ),
            Check(
                "largest departure of general from 1", float(np.abs(np.array(now) - 1.0).max()), at_most=0.01
            ),
        ),
    )


PLATE = Plate(
    number="2.21",
    title="Coherent and incoherent reflection together",
    shows="The coherent share $r_\\sigma G$ plus the incoherent one, $\\frac{1}{\\cos\\theta_i}\\int D "
    "G\\,d\\omega$, with $F = 1$ at 580 nm, over the height σ (0 to 200 nm) and the angle of incidence, for slopes "
    "$m$ of 0.02, 0.10, 0.50 and 1.00 (the surfaces of figures 2.16 and 2.20, summed). Orange is where the share is "
    "above 1. Where the book has surfaces, here are maps and sections.",
    claim="The sum is 1 for a gentle relief only: at $m = 1$ and 80 nm more than half of the light is lost at normal "
    "incidence, and at $m = 0.5$ more than a tenth too much leaves towards grazing.",
    printed="The caption of the second surface says m = .010; it is 0.10, as in figure 2.22. The maps compute $D$ as "
    "the book does (appendix III.4); the sections have its series whole, and dashed as the book cuts it.",
    today="`general` follows light that meets several facets, lets coherent and scattered light share one amplitude, "
    "and balances the rest: its sum is 1 at every angle of the sections, to within 0.005.",
    draw=draw,
    commands=("illuminant audit 'copper, satin'",),
)
