"""Figure 5.11: halftone patterns of one bit in cells of four pixels, and the index of the one that is shown."""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

CELL = "2x2"
PRINTED_FACTOR = 1.5


def draw(quick: bool) -> Sheet:
    """The five patterns of 2 × 2 and the ten of 3 × 3; below, the index of a pattern over the sum of a cell."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant.display import patterning
    from illuminant.plots.dither_study import draw_patterns
    from illuminant.plots.style import DPI, PRINTED, line_look

    levels = patterning.levels(CELL)
    total = np.linspace(0.0, 4.0, 401)
    codes = patterning.quantise(np.repeat(total / 4.0, 2)[None, :].repeat(2, axis=0), 1, CELL)
    index = codes.astype(int).reshape(2, -1, 2).sum(axis=(0, 2))
    printed = np.floor((PRINTED_FACTOR - 1e-9) * total).astype(int)
    figure = Figure(figsize=(7.2, 5.2), dpi=DPI, layout="constrained", facecolor="white")
    parts: Any = figure.subfigures(2, 1, height_ratios=(0.8, 1.0))
    top, bottom = parts
    draw_patterns(top, [CELL, "3x3"])
    axes = bottom.subplots()
    colour = line_look(0)["color"]
    axes.step(total, index, where="post", color=colour, label="factor 5/4 less a little")
    axes.step(
        total,
        printed,
        where="post",
        **{**PRINTED, "color": colour},
        label="factor 1.5 less a little (printed)",
    )
    axes.axhspan(levels - 0.5, 5.6, color="#f1f1f1", linewidth=0)
    axes.text(0.06, 5.05, "no such pattern", va="center")
    axes.set(
        xlim=(0, 4),
        ylim=(-0.3, 5.6),
        xlabel="sum of the four values of a cell",
        ylabel="index of its pattern",
    )
    axes.grid(True)
    axes.legend(loc="lower right")
    switched = np.diff(patterning.patterns(CELL).astype(int), axis=0)
    return Sheet(
        picture=figure,
        columns={"sum of four values": total, "index": index, "index as printed": printed},
        checks=(
            Check("levels of 2 × 2 pixels of one bit", levels, at_least=5, at_most=5),
            Check(
                "levels of 2 × 2 pixels of eight bits",
                patterning.levels(CELL, 8),
                at_least=1021,
                at_most=1021,
            ),
            Check("highest index that is asked for", int(index.max()), at_least=4, at_most=4),
            Check("highest index by the printed factor", int(printed.max()), at_least=levels),
            Check(
                "pixels switched off from one pattern to the next",
                int((switched < 0).sum()),
                at_most=0,
            ),
        ),
    )


PLATE = Plate(
    number="5.11",
    title="Halftone patterns of one bit",
    shows="Five intensities from four pixels of one bit, by switching on none to all of them. The index of a pattern "
    "is the mean of the cell times the number of levels, cut to a whole number.",
    claim="A cell of 2 × 2 pixels shows 5 levels at one bit and 1,021 at eight, and a pixel that is on stays on at "
    "every higher level.",
    printed="The factor for the sum of the four values is printed as slightly less than 1.5, which would ask for a "
    "sixth pattern; it is 5/4 less a little (dashed: as printed).",
    today="A dither gives as many levels without halving the resolution (figure 5.12); `halftone` keeps the mean of "
    "light rather than of codes, by which half of the pixels white no longer stand for a code of one half.",
    draw=draw,
    commands=("illuminant dither patterns -o patterns.png", "illuminant dither halftone --help"),
)
