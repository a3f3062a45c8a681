"""Figure 4.20: Blinn's cosine power beside Beckmann's distribution (book eqs 4.16, 4.24 and 4.25).

Polar plots in the plane of incidence for half-widths β of 10° and 30° and light from 30° and 80°, relative to the
mirror direction.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NAMES = ("blinn", "cook", "ggx")
BETAS_DEG = (10.0, 30.0)
LIGHTS_DEG = (30.0, 80.0)


def draw(quick: bool) -> Sheet:
    """The polar plots of `plots.distributions`, with GGX."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots.lobes import NAMES as WORDS
    from illuminant.plots.lobes import distribution

    view = np.linspace(-90.0, 90.0, 181)
    curves = {
        (beta, light): np.stack([distribution(name, beta, light, view) for name in NAMES])
        for beta in BETAS_DEG
        for light in LIGHTS_DEG
    }
    figure = plots.distributions(BETAS_DEG, LIGHTS_DEG, NAMES)
    values = np.concatenate(list(curves.values()), axis=1)

    def apart(beta: float) -> float:
        """The largest difference of the two, of the peak, over all facets."""
        # With the light at 80° the view from -90° to 90° sees facets from 85° before the normal to 5° behind it.
        blinn, beckmann = (distribution(name, beta, 80.0, view) for name in NAMES[:2])
        return float(np.abs(blinn - beckmann).max())

    return Sheet(
        picture=figure,
        columns={
            "beta, degrees": np.repeat([beta for beta, _ in curves], view.size),
            "light, degrees": np.repeat([light for _, light in curves], view.size),
            "view, degrees": np.tile(view, len(curves)),
            **{WORDS[name]: row for name, row in zip(NAMES, values, strict=True)},
        },
        checks=(
            Check("largest difference at β = 10° (m = 0.20)", apart(10.0), at_most=0.02),
            Check("largest difference at β = 30° (m = 0.51)", apart(30.0), at_most=0.12),
            Check("largest difference at β = 60° (m = 0.93)", apart(60.0), at_least=0.5),
            Check(
                "Beckmann's largest value over that at the normal, β = 60°",
                float(distribution("cook", 60.0, 80.0, view).max()),
                at_least=1.2,
            ),
        ),
    )


PLATE = Plate(
    number="4.20",
    title="Blinn's cosine power and Beckmann's distribution",
    shows="$(N \\cdot H)^{N_s}$ (eq 4.16) and Beckmann's distribution as Cook and Torrance use it (eq 4.24), "
    "relative to the mirror direction, in the plane of incidence, for half-widths β of 10° and 30° and light from "
    "30° and 80°.",
    claim="While $m$ is below 0.6 the two are alike to a tenth of the peak; beyond, they part, and Beckmann's even "
    "grows away from the normal.",
    printed="Cook (1981, 1982) left out the 4 of eq 4.24, as the book says. With the 4, $\\int 4 D "
    "\\cos\\alpha\\,d\\omega = 1$ over the facets.",
    today="GGX with the same half-width (thick) has the longer tail of measured surfaces: at three half-widths it "
    "still is at 5 % of its peak, where both others are below 0.2 %.",
    draw=draw,
    commands=("illuminant audit 'copper, satin' --illumination cook-torrance",),
)
