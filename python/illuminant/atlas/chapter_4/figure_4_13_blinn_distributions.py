"""Figures 4.13a to c: the distributions that Blinn compared, and Phong's (book eqs 4.11 and 4.16 to 4.19).

Polar plots in the plane of incidence for half-widths β of 10° and 30° and light from 30° (a), 60° (b) and 80° (c); all
have the coefficient with which they fall to half where H stands at β from N.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NAMES = ("phong", "blinn", "gaussian", "trowbridge-reitz", "ggx")
BETAS_DEG = (10.0, 30.0)
LIGHTS_DEG = (30.0, 60.0, 80.0)


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
    columns = {
        "beta, degrees": np.repeat([beta for beta, _ in curves], view.size),
        "light, degrees": np.repeat([light for _, light in curves], view.size),
        "view, degrees": np.tile(view, len(curves)),
        **{WORDS[name]: row for name, row in zip(NAMES, values, strict=True)},
    }
    # Light from 60°, β = 10°: half where the view is at 2 β from the mirror direction, tails at 6 β.
    narrow = curves[10.0, 60.0]
    half = narrow[:, (view == 40.0) | (view == 80.0)]
    within = narrow[:4, np.abs(view - 60.0) <= 20.0]
    _, blinn, gaussian, reitz, _ = narrow[:, view == 0.0][:, 0]
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("largest departure from ½ at β", float(np.abs(half - 0.5).max()), at_most=1e-9),
            Check(
                "largest spread down to there, of the peak, β = 10°",
                float(np.ptp(within, 0).max()),
                at_most=0.05,
            ),
            Check(
                "Trowbridge and Reitz at 3 β over the larger of cosine and Gaussian",
                float(reitz / max(blinn, gaussian)),
                at_least=10.0,
            ),
            Check(
                "largest departure of GGX from Trowbridge and Reitz",
                float(np.abs(values[4] - values[3]).max()),
                at_most=1e-9,
            ),
        ),
    )


PLATE = Plate(
    number="4.13",
    title="Distributions of facets compared",
    shows="Phong's cosine power of $R \\cdot V$ (eq 4.11), and of $N \\cdot H$ Blinn's cosine power (eq 4.16), the "
    "Gaussian (eq 4.17) and the function of Trowbridge and Reitz (eq 4.18), relative to the mirror direction, in the "
    "plane of incidence, with coefficients for half-widths β of 10° and 30° (eq 4.19); light from 30° (figure "
    "4.13a), 60° (b) and 80° (c).",
    claim="With equal half-widths the four functions agree to 5 % of the peak down to a half of it; only the tails "
    "tell them apart, and that of Trowbridge and Reitz is by far the longest.",
    today="The function that Blinn preferred is GGX: with α = $C_2$ and its integral made 1 it is the distribution "
    'that most renderers use now, `distribution = "ggx"` of a rough material.',
    draw=draw,
    commands=("illuminant compare scenes/demo.toml --help",),
)
