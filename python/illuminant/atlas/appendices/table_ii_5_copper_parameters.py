"""Figure II.5, a table: the multipliers and exponents of the twenty copper spheres of figure II.4 (book II.2)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

PRINTED_MISPRINT = 0.05
"""C_Kd of row 1, column 3 as printed; its neighbours have 0.35."""


def draw(quick: bool) -> Sheet:
    """Multipliers against β, for spheres under a lamp alone and with a reflection map; cross, the misprint."""
    import numpy as np

    from illuminant import appearance, optics
    from illuminant.appearance import COPPER_SPHERES
    from illuminant.plots.style import GREY, line_look, new_figure

    exponent = np.array([sphere["exponent"] for sphere in COPPER_SPHERES], np.float64)
    beta = np.asarray(optics.lobe_half_angle("blinn", exponent))
    diffuse, specular = (
        np.array([sphere[key] for sphere in COPPER_SPHERES]) for key in ("diffuse", "specular")
    )
    alone, mapped = np.split(np.arange(len(COPPER_SPHERES)), 2)
    figure, axes = new_figure((7.4, 4.6))
    theory = np.linspace(0.02, 0.62, 50)
    axes.plot(
        theory,
        [appearance.energies(float(b))[0] for b in theory],
        color=GREY,
        linestyle=":",
        label="specular energy (figure II.3)",
    )
    for i, (rows, which) in enumerate(((alone, "lamp alone"), (mapped, "with a map"))):
        for j, (values, name) in enumerate(((specular, "$C_{Ks}$"), (diffuse, "$C_{Kd} = C_{Ka}$"))):
            look = line_look(i) | {"linestyle": ("-", (0, (5, 1.5)))[j]}
            axes.plot(
                beta[rows], values[rows], **look, marker="os"[j], markersize=4, label=f"{name}, {which}"
            )
    axes.plot(
        beta[2],
        PRINTED_MISPRINT,
        marker="x",
        color=line_look(0)["color"],
        linestyle="none",
        label="as printed",
    )
    axes.set(xlabel="β of the exponent $N_s$, rad", ylabel="multiplier", ylim=(0, 1.05), xlim=(0, 0.62))
    axes.grid(True)
    figure.legend(loc="outside right upper")
    printed = diffuse.copy()
    printed[2] = PRINTED_MISPRINT
    falls = [int(np.sum(np.diff(values[alone]) < 0)) for values in (printed, diffuse)]
    rows, places = np.divmod(np.arange(len(COPPER_SPHERES)), 5)
    return Sheet(
        picture=figure,
        columns={
            "row": rows + 1,
            "column": places + 1,
            "reflection map": ["yes" if sphere["mapped"] else "no" for sphere in COPPER_SPHERES],
            "C_Ka": diffuse,
            "C_Kd": diffuse,
            "C_Ks": specular,
            "N_s": exponent,
            "β, rad": beta,
            "C_Kd as printed": printed,
        },
        checks=(
            Check(
                "steps in which C_Kd falls along rows 1 and 2, as printed", falls[0], at_least=1, at_most=1
            ),
            Check("the same, corrected", falls[1], at_least=0, at_most=0),
            Check(
                "steps in which C_Ks rises along rows 1 and 2, and 3 and 4",
                int(sum(np.sum(np.diff(specular[rows]) > 0) for rows in (alone, mapped))),
                at_least=0,
                at_most=0,
            ),
            Check(
                "smallest ratio of C_Ks to C_Kd with the map, over that without",
                float(((specular / diffuse)[mapped] / (specular / diffuse)[alone]).min()),
                at_least=1.5,
            ),
        ),
    )


PLATE = Plate(
    number="II.5",
    kind="table",
    title="Parameters of the copper spheres",
    shows="The multipliers $C_{Ka}$, $C_{Kd}$ and $C_{Ks}$ and Blinn's exponent $N_s$ of the spheres of figure II.4: "
    "rows 1 and 2 under a lamp alone, rows 3 and 4 with a reflection map. All three spectral curves are that of "
    "copper. The plot sets them against β, the half-width of the highlight.",
    claim="As highlights widen, the specular multiplier falls in every step, and the diffuse one never does once a "
    "misprint is corrected; with a reflection map the specular part is more dominant at each width.",
    printed="$C_{Ka}$ and $C_{Kd}$ of row 1, column 3 are printed 0.05 between neighbours of 0.35 (cross); 0.35 is "
    "used. The first line of each row is labelled $C_{ks}$ and is $C_{Ka}$.",
    today="`illuminant.appearance.propose` derives the three from β by figure II.3 (dotted), and they add to 1; the "
    "book's own are a matter of taste. Physical copper needs none of them.",
    draw=draw,
    commands=("illuminant render scenes/copper-spheres.toml -o spheres.png",),
)
