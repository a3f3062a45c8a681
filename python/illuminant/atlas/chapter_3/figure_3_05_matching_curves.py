"""Figure 3.5: how much of three lights of 445, 535 and 630 nm matches each wavelength (book section 3.2).

With M the XYZ of unit power of the three lights as columns, the amounts that match a wavelength are M⁻¹ (x̄, ȳ, z̄).
Where an amount is negative, that light is added to the other side of the match (book figure 3.4).
"""

from __future__ import annotations

from illuminant.atlas.chapter_3.control_lights import LIGHTS_NM
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The three curves of the 2° observer; dotted, those of the 10° observer of 1964."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots import observer as observers

    figure = plots.matching_functions(primaries_nm=LIGHTS_NM)
    figure.legends[0].remove()
    axes = figure.axes[0]
    nm = np.arange(380.0, 781.0)
    amounts = observers.for_primaries(observers.named("1931"), LIGHTS_NM).at(nm)
    wide = observers.for_primaries(observers.named("1964"), LIGHTS_NM).at(nm)
    for line, curve in zip(axes.lines[:3], wide.T, strict=True):
        axes.plot(nm, curve, color=line.get_color(), linestyle=(0, (1, 1.5)), linewidth=1.2)
    axes.plot(
        [], [], color="black", linestyle=(0, (1, 1.5)), linewidth=1.2, label="dotted: 10° observer (1964)"
    )
    axes.legend(loc="upper left", handlelength=1.6)
    seen = (nm >= 400) & (nm <= 700) & ~np.isin(nm, LIGHTS_NM)
    between = (nm > LIGHTS_NM[0]) & (nm < LIGHTS_NM[1])
    return Sheet(
        picture=figure,
        columns={
            "wavelength, nm": nm,
            **{f"{name} (2°)": column for name, column in zip("LMH", amounts.T, strict=True)},
            **{f"{name} (10°)": column for name, column in zip("LMH", wide.T, strict=True)},
        },
        checks=(
            Check(
                "share of wavelengths from 400 to 700 nm, without the three, that need a negative amount",
                float((amounts[seen].min(axis=1) < 0).mean()),
                at_least=1.0,
                at_most=1.0,
            ),
            Check("largest H between 445 and 535 nm", float(amounts[between, 2].max()), at_most=0.0),
            Check("smallest amount of any light", float(amounts.min()), at_least=-0.3, at_most=-0.2),
            Check(
                "wavelength where it is needed", float(nm[amounts.min(axis=1).argmin()]), "nm", 495.0, 520.0
            ),
        ),
    )


PLATE = Plate(
    number="3.5",
    title="Matching curves of three monochromatic lights",
    shows="The amounts of control lights at 445 nm (L), 535 nm (M) and 630 nm (H) that match unit power at each "
    "wavelength, over the visible range: $(L, M, H)^T = M^{-1} (\\bar x, \\bar y, \\bar z)^T$, where the columns of "
    "$M$ are the XYZ of the lights. Each light matches itself (marks at 1).",
    claim="No spectral light but the three themselves is matched by positive amounts: each needs a negative one, and "
    "blue-greens near 510 nm most, a quarter of their power in red.",
    today="The curves come from the CIE's table by 1 nm instead of an experiment, and likewise for any three lights, "
    "also the measured spectra of a display. Dotted are those of the observer of 1964, whose field of 10° includes "
    "more of the retina.",
    draw=draw,
    commands=("illuminant spectra plot --matching 445,535,630 -o matching.png",),
)
