"""Figure II.3: how a rough surface divides its reflection between highlight and diffuse part, by β (book II.2).

The specular share is the hemispherical integral of Cook and Torrance's function (book eq 4.24, 4.25; Torrance and
Sparrow's masking) at normal incidence with F = 1; what is missing to 1 is taken for the diffuse part.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

RANGE_RAD = (0.02, 1.2)


def draw(quick: bool) -> Sheet:
    """Both shares against β; in the same axes, what `general` scatters specularly with F = 1, facet to facet."""
    import numpy as np

    from illuminant import appearance, auditing, optics
    from illuminant.plots.style import TODAY, line_look, new_figure

    beta = np.linspace(*RANGE_RAD, 60)
    specular, diffuse = np.array([appearance.energies(float(b)) for b in beta]).T
    few = np.linspace(0.1, 1.05, 3 if quick else 6)
    ours = []
    for b in few:
        slope = float(optics.lobe_coefficient("cook", float(b))) ** 0.5
        perfect = {"kind": "conductor", "n": 1.0, "k": 1e4, "roughness": min(slope, 1.0)}
        found = auditing.audit(
            perfect, angles_deg=[0.0], wavelengths_nm=[550.0], draws=5_000 if quick else 20_000
        )[0]
        ours.append(float((found.coherent_reflection + found.scattered_reflection)[0, 0]))
    figure, axes = new_figure((7.2, 4.4))
    axes.plot(beta, specular, **line_look(0), label="specular")
    axes.plot(beta, diffuse, **line_look(1), label="diffuse: the rest")
    axes.plot(
        few, ours, **TODAY, marker="o", markersize=4, label="today: specular, with light from facet to facet"
    )
    axes.set(
        xlabel="β, angle at which the highlight has half its strength, rad",
        ylabel="share of the reflected energy, F = 1",
        xlim=(0, RANGE_RAD[1]),
        ylim=(0, 1.1),
    )
    axes.grid(True)
    axes.legend(loc="center left", bbox_to_anchor=(0.02, 0.5))
    equal = float(np.interp(0.0, diffuse - specular, beta))
    today = np.interp(beta, few, ours, np.nan, np.nan)
    return Sheet(
        picture=figure,
        columns={
            "β, rad": beta,
            "specular": specular,
            "diffuse": diffuse,
            "specular today, between the points": today,
        },
        checks=(
            Check("specular share at β = 0.2", float(np.interp(0.2, beta, specular)), at_least=0.99),
            Check("β at which the shares are equal", equal, "rad", 0.9, 1.1),
            Check(
                "largest rise of the specular share from one β to the next",
                float(np.diff(specular).max()),
                at_most=1e-6,
            ),
            Check("smallest specular share today", min(ours), at_least=0.97),
        ),
    )


PLATE = Plate(
    number="II.3",
    title="Specularly and diffusely reflected energy",
    shows="The share of energy that Cook and Torrance's model reflects specularly at normal incidence with F = 1, "
    "against β (the angle between N and H at which the highlight has half its strength), and the rest, which the book "
    "takes for the diffuse part. A guide for the multipliers $C_{Ks}$ and $C_{Kd}$, which add to 1.",
    claim="Sharp highlights take all energy, and as they widen their share falls, to a half where β is about 1.",
    today="The missing share is light that hits a second facet. It is followed there (`general`), so a perfect mirror "
    "however rough gives back all, and nothing has to be called diffuse. The points end where the slope is near 1, the "
    "roughest there is.",
    draw=draw,
    commands=('illuminant audit "copper, circular mill"',),
)
