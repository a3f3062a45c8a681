"""Figure 2.16: what a rough surface reflects coherently with F = 1 (book eqs 2.35 to 2.37).

r_σ = exp(−g) with g = (4πσ cos θ/λ)² at 580 nm over the height σ and the angle of incidence, then r_σ G with Sancer's
G (eq 2.22) for four slopes m.
"""

from __future__ import annotations

from illuminant.atlas.chapter_2.energy_panels import TITLES, Column, columns, panels, today
from illuminant.atlas.chapter_2.reflected_energy import HEIGHTS_NM, SLOPES, coherent
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Maps and sections; `general` beside them."""
    import numpy as np

    sigma, theta = np.linspace(0.0, 200.0, 21), np.r_[0:80:2.5, 80:89.6:0.5]
    heights = np.array(HEIGHTS_NM)
    shown, departure = [], 0.0
    for m, title in ((None, "without G"), *zip(SLOPES, TITLES, strict=True)):
        general = today(m or 0.5, quick)
        right = coherent(general.theta_deg, heights[-1])
        departure = max(departure, float(np.abs(general.coherent - right).max()))
        share, cut = (coherent(theta, height[:, None], m) for height in (sigma, heights))
        shown.append(
            Column(title, theta, sigma, share, theta, cut, today=(general.theta_deg, general.coherent))
        )
    free, steep = shown[0], shown[-1]
    grazing = int(np.searchsorted(theta, 89.0))
    return Sheet(
        picture=panels(shown, "coherent share", (0.0, 1.05)),
        columns=columns(shown, "coherent share"),
        checks=(
            Check("r_σ at σ = 150 nm, normal incidence", float(free.cut[-1, 0]), at_most=0.001),
            Check("smallest r_σ at 89°", float(free.share[:, grazing].min()), at_least=0.99),
            Check("largest r_σ G at 89°, m = 1.00", float(steep.share[:, grazing].max()), at_most=0.05),
            Check("largest departure of general from r_σ, σ = 150 nm", departure, at_most=0.001),
        ),
    )


PLATE = Plate(
    number="2.16",
    title="Coherent reflection of a rough surface",
    shows="The ratio of coherently reflected to incident energy with $F = 1$ at 580 nm, over the height σ (0 to 200 "
    "nm) and the angle of incidence: $r_\\sigma = e^{-g}$ with $g = (4\\pi\\sigma\\cos\\theta/\\lambda)^2$ (eqs 2.36 "
    "and 2.37), then $r_\\sigma G$ with Sancer's $G$ (eq 2.22) for slopes $m$ of 0.02, 0.10, 0.50 and 1.00. "
    "Where the book has surfaces, here are maps and sections.",
    claim="At normal incidence a height of 150 nm (6 microinches) leaves no mirror image, at grazing every surface "
    "is a mirror, and geometric attenuation takes that mirror away from steep ones.",
    today="`general` keeps $r_\\sigma$ without $G$, at every slope: light that one facet hides has met another and "
    "is not lost. The two shares are balanced together (figure 2.21).",
    draw=draw,
    commands=("illuminant audit 'gold, polished, σ = 5 nm'",),
)
