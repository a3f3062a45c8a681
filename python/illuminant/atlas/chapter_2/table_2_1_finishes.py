"""Table 2.1: root mean square roughness of machined metals, and the mirror image that it leaves (eqs 2.36, 2.37)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

WAVELENGTH_NM = 580.0


def draw(quick: bool) -> Sheet:
    """Heights with and across the grain as bars, and the coherent share of what each reflects at normal incidence."""
    import numpy as np

    from illuminant import optics
    from illuminant.finishes import MACHINED, MICROINCH_NM, finish
    from illuminant.plots.style import line_look, new_figure

    names, metals, along, across = [], [], [], []
    for name in MACHINED:
        for metal in ("stainless steel", "aluminium"):
            found = finish(name, metal)
            assert found.sigma_nm is not None
            names.append(name)
            metals.append(metal)
            along.append(found.sigma_nm[0])
            across.append(found.sigma_nm[1])
    coherent = [
        np.asarray(
            optics.coherent_fraction(optics.apparent_roughness(np.array(heights), WAVELENGTH_NM, 1.0, 1.0))
        )
        for heights in (along, across)
    ]
    figure, axes = new_figure((7.2, 4.4))
    rows = np.arange(len(names))
    for i, (values, label) in enumerate(((along, "with the grain"), (across, "across the grain"))):
        axes.barh(rows - 0.2 + 0.4 * i, values, height=0.38, color=line_look(i)["color"], label=label)
    axes.axvline(WAVELENGTH_NM, color="black", linewidth=0.8)
    axes.text(WAVELENGTH_NM + 15.0, 0.0, "λ = 580 nm", va="center", fontsize=8)
    inches = axes.secondary_xaxis(
        "top",
        functions=(
            lambda nm: np.asarray(nm, float) / MICROINCH_NM,
            lambda inch: np.asarray(inch, float) * MICROINCH_NM,
        ),
    )
    inches.set_xlabel("σ, microinches, as printed")
    axes.set_yticks(rows, [f"{name}, {metal}" for name, metal in zip(names, metals, strict=True)])
    axes.set(xlabel="root mean square height σ, nm", ylim=(len(names) - 0.5, -0.5))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.3))
    heights = np.array([along, across]) / MICROINCH_NM
    return Sheet(
        picture=figure,
        columns={
            "finish": names,
            "metal": metals,
            "with the grain, microinch": heights[0],
            "across the grain, microinch": heights[1],
            "with the grain, nm": along,
            "across the grain, nm": across,
            "coherent share, with": np.round(coherent[0], 6),
            "coherent share, across": np.round(coherent[1], 6),
        },
        checks=(
            Check("smallest height", float(heights.min()), "microinch", 2.99, 3.01),
            Check("largest height", float(heights.max()), "microinch", 79.9, 80.1),
            Check(
                "coherent share of fine-ground steel with the grain",
                float(coherent[0][0]),
                at_least=0.05,
                at_most=0.1,
            ),
            Check(
                "largest coherent share of every other finish",
                float(np.max(coherent, axis=0)[2:].max()),
                at_most=1e-6,
            ),
        ),
    )


PLATE = Plate(
    number="2.1",
    kind="table",
    title="Roughness of machined metals",
    shows="Root mean square heights σ of machined stainless steel and aluminium, measured with and across the grain, "
    "in microinches (1 microinch = 25.4 nm).",
    claim="Only a fine grind leaves any mirror reflection of visible light: the other surfaces are about a wavelength "
    "rough, and the coherent share $e^{-g}$ (eqs 2.36 and 2.37) vanishes.",
    today='The finishes are materials by name (`finish = "side mill"`), with slopes that we have chosen; the two '
    "directions of the grain make an anisotropic surface.",
    draw=draw,
    commands=("illuminant audit 'aluminium, side mill'",),
)
