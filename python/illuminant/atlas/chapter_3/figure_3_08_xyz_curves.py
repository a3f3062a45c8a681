"""Figure 3.8: the matching functions x̄, ȳ, z̄ of the CIE's observer of 1931 (book section 3.2, table in III.7)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The CIE's table by 1 nm; the book's by 5 nm as printed, dashed; an inset shows its misprint at 480 nm."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots import observer as observers
    from illuminant.plots.style import GREY, PRINTED

    nm = np.arange(380.0, 781.0)
    names = ("1931", "book", "book-as-printed", "1964")
    right, corrected, printed, wide = (observers.named(name).at(nm) for name in names)
    figure = plots.matching_functions()
    figure.legends[0].remove()
    axes = figure.axes[0]
    colours = [line.get_color() for line in axes.lines[:3]]
    inset = axes.inset_axes((0.7, 0.52, 0.3, 0.4))
    for colour, curve, dashed, other in zip(colours, right.T, printed.T, wide.T, strict=True):
        axes.plot(nm, dashed, color=colour, **PRINTED)
        axes.plot(nm, other, color=colour, linestyle=(0, (1, 1.5)), linewidth=1.1)
        inset.plot(nm, curve, color=colour)
        inset.plot(nm, dashed, color=colour, **PRINTED)
    axes.plot([], [], color="black", label="dashed: as printed", **PRINTED)
    axes.plot(
        [], [], color="black", linestyle=(0, (1, 1.5)), linewidth=1.1, label="dotted: 10° observer (1964)"
    )
    axes.legend(loc="upper left", bbox_to_anchor=(0.27, 1.0))
    axes.set_ylim(0.0, 2.05)
    inset.set(xlim=(472, 488), ylim=(0.6, 1.05), xlabel="nm")
    inset.set_title("z̄ at 480 nm: 0.8130, printed 0.8310", fontsize=8)
    axes.indicate_inset_zoom(inset, edgecolor=GREY, alpha=0.6)
    areas = [table.sum(axis=0) for table in (right, corrected, printed)]
    nodes = nm % 5 == 0
    columns = {"wavelength, nm": nm}
    for table, label in ((right, "1931"), (printed, "as printed"), (wide, "1964")):
        columns |= {f"{name}, {label}": table[:, i] for i, name in enumerate(("x̄", "ȳ", "z̄"))}
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("spread of the three areas", float(np.ptp(areas[0])), "nm", at_most=0.02),
            Check("the same, of the book's table corrected", float(np.ptp(areas[1])), "nm", at_most=0.02),
            Check(
                "area of z̄ as printed (106.93 in section 3.5.1)", float(areas[2][2]), "nm", 106.925, 106.94
            ),
            Check(
                "largest error of the corrected table at its nodes",
                float(np.abs(corrected - right)[nodes].max()),
                at_most=0.00051,
            ),
        ),
    )


PLATE = Plate(
    number="3.8",
    title="CIE XYZ matching curves",
    shows="The functions $\\bar x$, $\\bar y$ and $\\bar z$ (CIE 1931, 2°) over 380 to 780 nm. All are positive, "
    "$\\bar y$ is the luminous efficiency, and the three have equal areas, so that a flat spectrum has X = Y = Z.",
    claim="The three areas are equal to 0.02 %; the book's larger area of $\\bar z$, 106.93, which it blames on "
    "interpolation, is a misprint of one number of its table.",
    printed="The table of the book has two misprints: $\\bar z$ at 480 nm is 0.8310 in place of 0.8130 (digits "
    "exchanged; the kink in the dashed curve), and $\\bar x$ at 380 nm is 0.00014 in place of 0.0014, which no plot "
    "shows.",
    today="The CIE's own table by 1 nm is used, from 360 to 830 nm (CIE 15:2018); the book's table, corrected or as "
    "printed, and the observer of 1964 (dotted) can be chosen by name.",
    draw=draw,
    commands=("illuminant spectra plot --observer book-as-printed -o printed.png",),
)
