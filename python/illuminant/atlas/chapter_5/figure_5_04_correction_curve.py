"""Figure 5.4: the lookup table that corrects for a monitor, entry = intensity^(1/γ) (book eq 5.1)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The table of 8 bits for γ = 2.2, the part of the lower tenth marked; in the same axes, sRGB."""
    import numpy as np

    from illuminant.display.gamma.levels import lost_levels, spread
    from illuminant.display.gamma.lookup_table import correction_table
    from illuminant.plots.style import GREY, TODAY, line_look, new_figure

    table = correction_table(2.2, rounding="truncate")
    srgb = correction_table("sRGB")
    figure, axes = new_figure((5.3, 5.0))
    axes.plot(np.arange(256), srgb.entries, **TODAY, label="today: sRGB")
    axes.plot(
        np.arange(256),
        table.entries,
        linestyle="none",
        marker=".",
        markersize=3.5,
        color=line_look(0)["color"],
        label="γ = 2.2, 8 bits",
    )
    tenth = 255 / 10
    reached = 255 * spread(correction_table(2.2, in_bits=16, out_bits=16))[1]
    axes.plot([tenth, tenth, 0], [0, reached, reached], color=GREY, linestyle=":", linewidth=1.2)
    axes.annotate(
        f"10 % of intensity\n→ {100 * reached / 255:.0f} % of codes",
        (tenth, reached),
        (12, -18),
        textcoords="offset points",
        fontsize=8.5,
    )
    axes.set(
        xlabel="image value (intensity)",
        ylabel="table value (code)",
        xlim=(0, 255),
        ylim=(0, 255),
        aspect="equal",
    )
    axes.set_xticks([*range(0, 225, 32), 255])
    axes.set_yticks([*range(0, 225, 32), 255])
    axes.grid(True)
    axes.legend(loc="lower right")
    inset = axes.inset_axes((0.55, 0.24, 0.42, 0.4))
    inset.plot(np.arange(13), srgb.entries[:13], **TODAY, marker="o", markersize=3)
    inset.plot(np.arange(13), table.entries[:13], marker=".", color=line_look(0)["color"], linewidth=0.8)
    inset.set(xlim=(0, 12), ylim=(0, 70))
    inset.set_xticks(range(0, 13, 4))
    inset.set_title("near black", fontsize=8.5)
    inset.grid(True)
    lost = lost_levels(table)
    return Sheet(
        picture=figure,
        columns={
            "image value": np.arange(256),
            "table value, γ = 2.2": table.entries,
            "table value, sRGB": srgb.entries,
        },
        checks=(
            Check(
                "share of the codes that the lower tenth of intensities takes",
                reached / 255,
                at_least=0.345,
                at_most=0.355,
            ),
            Check(
                "largest step from one entry to the next", float(lost.steps.max()), at_least=20, at_most=20
            ),
            Check("codes that are never used", len(lost.unused), at_least=64),
        ),
    )


PLATE = Plate(
    number="5.4",
    title="Correction of a monitor in a lookup table",
    shows="The entries of a video lookup table of 8 bits that corrects for a monitor of γ = 2.2: $\\text{entry} = "
    "\\text{intensity}^{1/\\gamma}$ (eq 5.1), truncated to whole numbers as in table 5.1.",
    claim="The table stretches the lower 10 % of intensities over the lower 35 % of codes, by steps of up to 20, so "
    "that over a quarter of all codes can never be shown.",
    today="Values are corrected in floating point before they are stored, with dither on request, so no table loses "
    "codes; the curve is that of sRGB (grey), whose straight start has steps of 13 at most.",
    draw=draw,
    commands=("illuminant gamma levels --rounding truncate", "illuminant gamma levels --gamma sRGB"),
)
