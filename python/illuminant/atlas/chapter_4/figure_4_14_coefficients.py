"""Figure 4.14: coefficients of the distributions against the half-width β (book eqs 4.19 and 4.25, III.4).

N_s of Phong and of Blinn, C_1 of the Gaussian, C_2 of Trowbridge and Reitz and m of Beckmann's distribution, with which
each falls to half where H stands at β from N. `GOLDEN` has what the book's own functions of appendix III.4 return.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

GOLDEN = {
    "phong": {0.3490658503988659: 2.600780231515868, 0.6981317007977318: 0.3959203066171855},
    "blinn": {0.5235987755982988: 4.81884167930642, 1.3089969389957472: 0.5128246381721744},
    "gaussian": {0.5235987755982988: 1.5900621811163813, 1.3089969389957472: 0.6360248724465525},
    "trowbridge-reitz": {0.5235987755982988: 0.37638496736923377, 1.3089969389957472: 0.6925434328590832},
    "cook": {0.3490658503988659: 0.14063734394368274, 1.3089969389957472: 2.2834423870344116},
}
"""β in radians → what D_phong_init, D_blinn_init, D_gaussian_init, D_reitz_init (C_2²) and D_cook_init (m²) return."""

SYMBOLS = ("Phong N_s", "Blinn N_s", "C_1", "C_2", "m")


def draw(quick: bool) -> Sheet:
    """The curves of `plots.coefficients`, the values of the functions of the book as points, and α of GGX."""
    import numpy as np

    from illuminant import optics, plots
    from illuminant.plots.style import INK

    figure = plots.coefficients(today=True)
    beta = np.linspace(1.0, 89.0, 353)
    columns = {"beta, degrees": beta}
    missed: list[float] = []
    half: list[float] = []
    for name, symbol in zip(GOLDEN, SYMBOLS, strict=True):
        squared = name in ("trowbridge-reitz", "cook")
        found = np.asarray(optics.lobe_coefficient(name, np.radians(beta)))
        columns[symbol] = np.sqrt(found) if squared else found
        if name == "phong":
            columns[symbol][beta >= 45.0] = np.nan
        for radians, value in GOLDEN[name].items():
            missed.append(abs(float(optics.lobe_coefficient(name, radians)) / value - 1.0))
            axes = figure.axes[0 if name in ("phong", "blinn") else 1]
            shown = value**0.5 if squared else value
            axes.plot(np.degrees(radians), shown, "o", color=INK, markersize=3.5, zorder=4)
        # R·V of Phong's lobe stands at twice the angle of N·H.
        turn = 2.0 if name == "phong" else 1.0
        at = beta[beta < 90.0 / turn - 1.0]
        cosine = np.cos(np.radians(turn * at))
        coefficient = optics.lobe_coefficient(name, np.radians(at))
        ratio = optics.lobe_value(name, cosine, coefficient) / np.asarray(
            optics.lobe_value(name, 1.0, coefficient)
        )
        half.append(float(np.abs(ratio - 0.5).max()))
    alpha = np.asarray(optics.ggx_alpha(np.radians(beta)))
    columns["alpha of GGX"] = alpha
    ggx = np.asarray(optics.ggx(np.cos(np.radians(beta)), alpha)) / optics.ggx(1.0, alpha)
    figure.axes[0].plot([], [], "o", color=INK, markersize=3.5, label="functions of III.4")
    figure.axes[0].legend()
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("largest relative departure from the book's functions", max(missed), at_most=1e-9),
            Check("largest departure from ½ of a lobe at its β", max(half), at_most=1e-9),
            Check("m at β = 40°", float(np.interp(40.0, beta, columns["m"])), at_least=0.55, at_most=0.65),
            Check("largest departure of GGX from ½ at β", float(np.abs(ggx - 0.5).max()), at_most=1e-9),
        ),
    )


PLATE = Plate(
    number="4.14",
    title="Coefficients of equal half-width",
    shows="The exponents $N_s$ of Phong and of Blinn (eq 4.19a; Phong's with 2β), $C_1$ of the Gaussian (eq 4.19b), "
    "$C_2$ of Trowbridge and Reitz (eq 4.19c) and $m$ of Beckmann's distribution (eq 4.25), with which each falls to "
    "half at β. The points are what the functions of the book's program return.",
    claim="The curves meet the values of the initialising functions of appendix III.4, and every lobe is a half at "
    "its β.",
    today="α of GGX is $C_2$, and ends at 0.84: wider lobes than β → 90° it has none, while $m$ grows without end. "
    "The inverse, `optics.lobe_half_angle`, turns the highlight of one model into that of another.",
    draw=draw,
)
