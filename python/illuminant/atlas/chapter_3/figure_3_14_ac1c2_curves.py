"""Figure 3.14: the matching functions of Meyer's space AC1C2 (Meyer 1988; book eq 3.6)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

LAMP = "D65"


def draw(quick: bool) -> Sheet:
    """The three curves; marks at Meyer's four wavelengths, and at four that are fitted to the colours at hand."""
    import numpy as np

    from illuminant import plots, sampling
    from illuminant.plots import observer as observers
    from illuminant.plots.style import GREY, TODAY

    eye = observers.named("1931")
    space = observers.in_space(eye, "ac1c2")
    nm = np.arange(380.0, 781.0)
    values = space.at(nm)
    figure = plots.matching_functions(space="ac1c2")
    figure.legends[0].remove()
    axes = figure.axes[0]
    studies = {
        study.sampling: study
        for study in sampling.compare(
            ["meyer", "uniform:4", "fitted:4"], [LAMP], products=300 if quick else 3000
        )
    }
    meyer, fitted = (studies[name].wavelengths_nm[LAMP] for name in ("meyer", "fitted:4"))
    low, high = axes.get_ylim()
    axes.vlines(meyer, low, high, color=GREY, linestyle=":", linewidth=1.3, label="Meyer's four wavelengths")
    axes.vlines(fitted, low, high, **(TODAY | {"linewidth": 1.6}), label=f"today: fitted:4 under {LAMP}")
    axes.set_ylim(low, high)
    axes.legend(loc="upper right")
    mean = {name: study.by_lamp[LAMP].mean for name, study in studies.items()}
    return Sheet(
        picture=figure,
        columns={"wavelength, nm": nm, **dict(zip(space.labels, values.T, strict=True))},
        checks=(
            Check("largest |A − ȳ|", float(np.abs(values[:, 0] - eye.at(nm)[:, 1]).max()), at_most=0.02),
            Check("mean ΔE00 of products, Meyer's four wavelengths", mean["meyer"], "", 2.0, 5.0),
            Check("of four evenly placed, over it", mean["uniform:4"] / mean["meyer"], at_least=1.2),
            Check("of four fitted, over it", mean["fitted:4"] / mean["meyer"], at_most=0.5),
        ),
    )


PLATE = Plate(
    number="3.14",
    title="Sampling curves of AC1C2",
    shows="The CIE's matching functions in the space AC1C2 (eq 3.6), whose axes pass where tristimulus values are "
    "most likely to lie: A, achromatic, C1 between red and green, C2 between blue and yellow. Gauss quadrature along "
    "these axes gives Meyer's four wavelengths.",
    claim="A is the luminous efficiency to 2 %, and Meyer's four wavelengths render products of ColorChecker colours "
    "better than four evenly placed, though with a mean error above 2 ΔE00.",
    today="Wavelengths and weights are fitted to the lamps and materials of the scene: four fitted ones have less "
    "than half of the error of Meyer's, and the usual eight less than a tenth of it.",
    draw=draw,
    commands=(
        "illuminant spectra plot --observer 1931 --space ac1c2 -o ac1c2.svg",
        "illuminant spectra compare --sampling meyer --sampling fitted:4 --lamp D65",
    ),
)
