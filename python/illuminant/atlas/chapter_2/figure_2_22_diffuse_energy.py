"""Figure 2.22: the diffuse coefficient that brings the theory into equilibrium with F = 1 (book eq 2.50).

K_d = 1 − r_σ G − 1/cos θ ∫ D G dω at 580 nm over the height σ and the angle of incidence, for four slopes m.
"""

from __future__ import annotations

from illuminant.atlas.chapter_2.energy_panels import TITLES, Column, columns, panels, today
from illuminant.atlas.chapter_2.reflected_energy import SLOPES, sections, surface
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Maps, and sections beside the coefficient that `general` needs."""
    import numpy as np

    shown, now = [], []
    for m, title in zip(SLOPES, TITLES, strict=True):
        whole, (series, book), general = surface(m, quick), sections(m, quick), today(m, quick)
        place = (
            title,
            whole.theta_deg,
            whole.sigma_nm,
            1.0 - whole.total,
            series.theta_deg,
            1.0 - series.total,
        )
        shown.append(Column(*place, 1.0 - book.total, (general.theta_deg, 1.0 - general.total)))
        now.append(1.0 - general.total)
    middle = shown[2].cut[1]
    return Sheet(
        picture=panels(shown, "$K_d$ for equilibrium", (-0.2, 1.0), "Blues"),
        columns=columns(shown, "K_d"),
        checks=(
            Check("smallest K_d at m = 0.50, σ = 80 nm", float(middle.min()), at_most=-0.05),
            Check("its spread over angles", float(np.ptp(middle)), at_least=0.25),
            Check("K_d at m = 1.00, σ = 80 nm, normal incidence", float(shown[3].cut[1, 0]), at_least=0.5),
            Check("largest |K_d| of general", float(np.abs(np.array(now)).max()), at_most=0.01),
        ),
    )


PLATE = Plate(
    number="2.22",
    title="The diffuse coefficient that equilibrium asks for",
    shows="The diffuse coefficient $K_d = 1 - r_\\sigma G - \\frac{1}{\\cos\\theta_i}\\int D G\\,d\\omega$ with "
    "which a surface of $F = 1$ returns all light at 580 nm (eq 2.50), over the height σ (0 to 200 nm) and the angle "
    "of incidence, for slopes $m$ of 0.02, 0.10, 0.50 and 1.00. Orange is where it is negative. Where "
    "the book has surfaces, here are maps and sections.",
    claim="No constant diffuse coefficient restores equilibrium: of one and the same surface it ranges over more "
    "than a quarter with the angle, and a negative one is needed where the sum of figure 2.21 is above 1.",
    printed="Eq 2.50 carries $n_v^2/n_t^2$ in the energy that is transmitted; a sum of energies must not. With $F = "
    "1$ nothing is transmitted, so these surfaces are right.",
    today="`general` needs none. What remains after multiple scattering is spread as $e(a)e(b)/\\Sigma e$ with $e "
    "\\ge 0$, which is reciprocal and never negative.",
    draw=draw,
    commands=("illuminant audit 'copper, satin'",),
)
