"""Table 5.1: an excerpt from the lookup table for a monitor of γ = 2.2 (book section 5.1.2, eq 5.1)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

# fmt: off
PRINTED = dict(enumerate((
    0, 20, 28, 33, 38, 42, 46, 49, 52, 55, 58, 61, 63, 65, 68, 70,
    72, 74, 76, 78, 80, 81, 83, 85, 87, 88, 90,
))) | dict(enumerate((
    243, 244, 244, 245, 245, 246, 246, 247, 247, 248, 248, 249, 249,
    249, 250, 250, 251, 251, 252, 252, 253, 253, 254, 254, 255,
), start=231))
# fmt: on
"""Image value → table value, as printed."""


def draw(quick: bool) -> Sheet:
    """The entries of both ends as printed, and the table truncated, as the book has it, and rounded."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant.display.gamma.lookup_table import correction_table
    from illuminant.plots.style import DPI, line_look

    inputs = np.array(list(PRINTED))
    printed = np.array(list(PRINTED.values()))
    truncated = correction_table(2.2, rounding="truncate").entries.astype(int)
    rounded = correction_table(2.2).entries.astype(int)
    fine = correction_table(2.2, out_bits=10).entries.astype(int)
    figure = Figure(figsize=(8.4, 4.2), dpi=DPI, layout="constrained", facecolor="white")
    panels = figure.subplots(1, 2)
    for axes, (first, last) in zip(panels, ((0, 26), (231, 255)), strict=True):
        within = np.arange(first, last + 1)
        axes.step(within, truncated[within], where="mid", **line_look(0), label="truncated")
        axes.step(within, rounded[within], where="mid", **line_look(1), label="rounded")
        axes.plot(
            within,
            fine[within] * 255 / 1023,
            color="black",
            linewidth=2.2,
            alpha=0.4,
            label="today: 10 bits out",
        )
        shown = (inputs >= first) & (inputs <= last)
        axes.plot(
            inputs[shown],
            printed[shown],
            linestyle="none",
            marker="o",
            markersize=4,
            color="black",
            markerfacecolor="white",
            label="printed",
        )
        axes.set(xlabel="image value", xlim=(first - 0.5, last + 0.5))
        axes.grid(True)
    panels[0].set_ylabel("table value")
    panels[0].legend(loc="lower right")
    return Sheet(
        picture=figure,
        columns={
            "image value": inputs,
            "table value, printed": printed,
            "truncated": truncated[inputs],
            "rounded": rounded[inputs],
            "10 bits out": fine[inputs],
        },
        checks=(
            Check("printed entries", len(printed), at_least=52, at_most=52),
            Check(
                "of them equal to the truncated table",
                float((truncated[inputs] == printed).sum()),
                at_least=52,
                at_most=52,
            ),
            Check(
                "of them equal to the rounded table", float((rounded[inputs] == printed).sum()), at_most=40
            ),
            Check(
                "codes from image value 3 to 4 (33 to 38)",
                float(truncated[4] - truncated[3]),
                at_least=5,
                at_most=5,
            ),
        ),
    )


PLATE = Plate(
    number="5.1",
    kind="table",
    title="Excerpt from the correction table for γ = 2.2",
    shows="The table values that correct image values 0 to 26 and 231 to 255 for a monitor of γ = 2.2 (eq 5.1), 8 "
    "bits in and out.",
    claim="All 52 printed entries are those of eq 5.1, truncated and not rounded; near black the table skips codes, "
    "near white it gives two image values one code.",
    today="Tables are rounded to the nearest entry, which halves the largest error, and have up to 16 bits; with 10 "
    "bits out near white no two image values fall on one code.",
    draw=draw,
    commands=(
        "illuminant gamma table --rounding truncate",
        "illuminant gamma table --out-bits 10 -o table.csv",
    ),
)
