"""Figure 5.6: perceived brightness against intensity (book section 5.1.2, footnote 8).

Steps look equal where ΔI/I is, so brightness is the logarithm of intensity, counted from the black of the monitor.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The logarithmic law with a black of 1 % and L* of today; beside, the monitor's response and their inverses."""
    import numpy as np

    from illuminant.display.gamma import brightness
    from illuminant.plots import gamma_curves

    at = np.linspace(0.0, 1.0, 101)
    alike = brightness.resemblance(2.2)
    near_black = brightness.brightness(at, 0.001)
    return Sheet(
        picture=gamma_curves.perceived(),
        columns={
            "relative intensity": at,
            "brightness, black 1 %": brightness.brightness(at),
            "brightness, black 0.1 %": near_black,
            "L* / 100": brightness.lightness(at, brightness.BLACK),
        },
        checks=(
            Check(
                "brightness of a tenth of the intensity, black 1 %",
                float(brightness.brightness(0.1)),
                "",
                0.5,
                0.54,
            ),
            Check(
                "correlation of code (γ 2.2) with logarithmic brightness", alike.logarithmic, at_least=0.95
            ),
            Check("correlation of code with L*", alike.lightness, at_least=0.999),
            Check(
                "straightness lost by linear storage: its correlation with L*",
                float(np.corrcoef(at, brightness.lightness(at, brightness.BLACK))[0, 1]),
                at_most=0.97,
            ),
        ),
    )


PLATE = Plate(
    number="5.6",
    title="Perceived brightness",
    shows="Brightness against relative intensity by the logarithmic law, $\\ln(L/b) / \\ln(1/b)$ with the luminance L "
    "and that of black, b, both over white. The book does not say which black it took; here it is 1 %.",
    claim="A tenth of the intensity looks half as bright as white, and because a monitor's response is much like the "
    "inverse of this curve, equal steps of its code look nearly equal.",
    today="L* (CIE 1976) stands in the same axes: with it, codes of γ = 2.2 are straight to a correlation of 0.999, "
    "better than with the logarithm, which is too steep near black.",
    draw=draw,
    commands=("illuminant gamma brightness --black 0.005 -o brightness.png",),
)
