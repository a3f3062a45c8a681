"""Figure 4.21: the integral of the model of Cook and Torrance over the hemisphere (book eqs 2.39, 4.23 and 4.24).

1/cos θ ∫ D dω and 1/cos θ ∫ D G dω with F = 1, K_s = 1 and G of Torrance and Sparrow (eq 2.21), over half-widths β of
5° to 89° and angles of incidence of 0 to 85°.
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.chapter_2.energy_panels import share_bar, share_map
from illuminant.atlas.chapter_2.reflected_energy import directions, equilibrium
from illuminant.atlas.plate import Check, Plate, Sheet

CUTS_DEG = (0.0, 60.0, 85.0)


def integrals(beta_deg: float, theta_deg: float) -> tuple[float, float, float]:
    """What is reflected by D alone, by D and G, and by GGX of the same half-width with Smith's masking."""
    import numpy as np

    from illuminant import optics

    beta = np.radians(beta_deg)
    squared = optics.lobe_coefficient("cook", beta)
    alpha = optics.ggx_alpha(beta)
    at = directions(theta_deg, float(min(squared**0.5, alpha)))
    facets = np.asarray(optics.lobe_value("cook", at.cos_half, squared)) * at.weight / at.cos_in
    # The azimuth of eq 2.21 is that from the light.
    grooves = optics.masking_torrance_sparrow(np.radians(theta_deg), at.theta_out, np.pi - at.azimuth)
    ggx = optics.ggx(at.cos_half, alpha) * optics.masking_smith(at.cos_in, at.cos_out, alpha, "ggx") / 4.0
    return float(facets.sum()), float((facets * grooves).sum()), float((ggx * at.weight).sum() / at.cos_in)


def draw(quick: bool) -> Sheet:
    """Two maps, and cuts beside GGX with light that meets several facets."""
    import numpy as np
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from illuminant import optics
    from illuminant.plots.style import DPI, GREY, TODAY, line_look

    beta = np.linspace(5.0, 89.0, 12 if quick else 29)
    theta = np.array([0, 30, 60, 85.0]) if quick else np.linspace(0.0, 85.0, 18)
    theta = np.union1d(theta, CUTS_DEG)
    shares = np.array([[integrals(b, t) for t in theta] for b in beta])
    facets, both, ggx = (shares[:, :, k] for k in range(3))
    tried = np.array([20.0, 60.0] if quick else [10.0, 30.0, 50.0, 70.0])
    general = np.array(
        [
            equilibrium(float(optics.ggx_alpha(np.radians(b))), None, CUTS_DEG, 8_000, "ggx").total
            for b in tried
        ]
    )

    figure = Figure(figsize=(9.0, 3.6), dpi=DPI, layout="constrained", facecolor="white")
    grid: Any = figure.subplots(1, 3, width_ratios=(1.0, 1.0, 1.5))
    shown: Any = None
    for axes, share, title in zip(grid, (facets, both), ("D only, G = 1", "D and G"), strict=False):
        shown = share_map(axes, theta, beta, share)
        axes.set(title=title, xlabel="incidence θ, degrees", xticks=(0, 30, 60, 85), yticks=range(15, 90, 15))
    grid[0].set_ylabel("half-width β, degrees")
    grid[1].set_yticklabels([])
    share_bar(figure, grid[:2].tolist(), shown, "")
    cuts = grid[2]
    cuts.axhline(1.0, color=GREY, linewidth=0.6)
    at = [int(np.searchsorted(theta, cut)) for cut in CUTS_DEG]
    for i, column in enumerate(at):
        cuts.plot(beta, both[:, column], **line_look(i))
        cuts.plot(beta, facets[:, column], **{**line_look(i), "linestyle": ":"})
    cuts.plot(beta, ggx[:, 0], color="black", linestyle="-.", linewidth=1.0)
    cuts.plot(tried, general.mean(axis=1), marker="o", markersize=4, **TODAY)
    cuts.set(
        xlabel="half-width β, degrees",
        ylabel="reflected share",
        xlim=(5, 90),
        ylim=(0, 2),
        xticks=range(15, 91, 15),
    )
    cuts.grid(True)
    entries = [Line2D([], [], **line_look(i)) for i in range(3)]
    entries += [Line2D([], [], color=GREY), Line2D([], [], color=GREY, linestyle=":")]
    entries += [
        Line2D([], [], color="black", linestyle="-.", linewidth=1.0),
        Line2D([], [], marker="o", **TODAY),
    ]
    labels = [f"θ = {cut:g}°" for cut in CUTS_DEG]
    labels += ["D and G", "D only", "GGX, Smith, one facet, θ = 0", "today: GGX, several facets"]
    figure.legend(entries, labels, loc="outside lower center", ncols=7, fontsize=7.5, columnspacing=1.2)

    grid_theta, grid_beta = (one.ravel() for one in np.meshgrid(theta, beta))
    nothing = np.full(general.size, np.nan)
    return Sheet(
        picture=figure,
        columns={
            "beta, degrees": np.r_[grid_beta, np.repeat(tried, len(CUTS_DEG))],
            "theta, degrees": np.r_[grid_theta, np.tile(CUTS_DEG, len(tried))],
            "D only": np.r_[facets.ravel(), nothing],
            "D and G": np.r_[both.ravel(), nothing],
            "GGX and Smith, one facet": np.r_[ggx.ravel(), nothing],
            "today: GGX, several facets": np.r_[np.full(ggx.size, np.nan), general.ravel()],
        },
        checks=(
            Check(
                "share of D and G at β = 60°, normal incidence",
                float(np.interp(60.0, beta, both[:, 0])),
                at_most=0.55,
            ),
            Check("largest share of D only", float(facets.max()), at_least=5.0),
            Check("largest share of D and G", float(both.max()), at_most=1.005),
            Check("largest departure of general from 1", float(np.abs(general - 1.0).max()), at_most=0.01),
        ),
    )


PLATE = Plate(
    number="4.21",
    title="The energy of the model of Cook and Torrance",
    shows="The hemispherical integral of Cook and Torrance's bidirectional reflectance with $F = 1$ and $K_s = 1$ "
    "(eqs 2.39, 4.23 and 4.24), with the distribution only ($G = 1$) and with the attenuation of Torrance and "
    "Sparrow, for $m$ of half-widths β from 5° to 89° and angles of incidence from 0° to 85°. Orange is where it is "
    "above 1.",
    claim="With $G = 1$ wide lobes make several times the light that comes near grazing; with $G$ nothing is made, "
    "but at normal incidence half of the light is lost at β = 60° and nearly all at 89°.",
    printed="β = 90° has $m = \\infty$ and reflects nothing at all; the maps end at 89°.",
    today="GGX with Smith's masking loses light too where each ray meets one facet (58 % of it at β = 60°, normal "
    "incidence); `general` follows it from facet to facet and returns all.",
    draw=draw,
    commands=(
        "illuminant audit 'copper, matte' --illumination cook-torrance",
        "illuminant audit 'copper, matte'",
    ),
)
