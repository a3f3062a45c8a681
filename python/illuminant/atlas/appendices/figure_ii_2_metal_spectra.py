"""Figure II.2: spectral curves of metals: what they reflect at normal incidence (book II.1.2, eq III.18)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

METALS = ("silver", "aluminium", "gold", "copper", "chromium", "iron")
RANGE_NM = (380.0, 700.0)


def draw(quick: bool) -> Sheet:
    """Reflectance of six metals from their measured n and k; dashed, the measured copper of the book."""
    import numpy as np

    from illuminant import optics, spectra
    from illuminant.plots.style import PRINTED, line_look, new_figure

    nm = np.arange(RANGE_NM[0], RANGE_NM[1] + 1)
    curves = {
        name: np.asarray(
            optics.normal_reflectance(spectra.load(f"{name}.n").at(nm), spectra.load(f"{name}.k").at(nm))
        )
        for name in METALS
    }
    measured = np.asarray(spectra.load("book/copper").at(nm))
    figure, axes = new_figure((7.4, 4.6))
    for i, (name, curve) in enumerate(curves.items()):
        axes.plot(nm, curve, **line_look(i), label=name)
    colour = line_look(METALS.index("copper"))["color"]
    axes.plot(nm, measured, color=colour, **PRINTED, label="copper of the book (1970)")
    axes.set(xlabel="wavelength, nm", ylabel="reflectance at normal incidence", xlim=RANGE_NM, ylim=(0, 1))
    axes.grid(True)
    axes.legend(loc="lower right", ncols=2)
    ratio = {
        name: float(np.interp(650, nm, curve) / np.interp(450, nm, curve)) for name, curve in curves.items()
    }
    neutral = max(abs(ratio[name] - 1.0) for name in ("silver", "aluminium", "chromium", "iron"))
    return Sheet(
        picture=figure,
        columns={"wavelength, nm": nm, **curves, "copper of the book": measured},
        checks=(
            Check(
                "red over blue (650, 450 nm), the smaller of gold and copper",
                min(ratio["gold"], ratio["copper"]),
                at_least=1.5,
            ),
            Check("its distance from 1, largest of the other four", neutral, at_most=0.15),
            Check(
                "smallest reflectance of silver and aluminium",
                float(min(curves["silver"].min(), curves["aluminium"].min())),
                at_least=0.8,
            ),
            Check(
                "the book's copper less that of n and k, at 650 nm",
                float(np.interp(650, nm, measured - curves["copper"])),
                at_most=-0.1,
            ),
        ),
    )


PLATE = Plate(
    number="II.2",
    title="Spectral curves of metals",
    shows="Reflectance at normal incidence, $((n-1)^2 + k^2)/((n+1)^2 + k^2)$ (eq III.18), over the visible range.",
    claim="Grey metals reflect all wavelengths nearly alike; gold and copper, whose bound electrons absorb, reflect "
    "at least half as much again in the red as in the blue.",
    today="n and k are measured at each wavelength on clean films (refractiveindex.info). The curve of the book, "
    "measured on a sample with a finish of its own (dashed), reflects a good deal less in the red.",
    draw=draw,
    commands=(
        "illuminant spectra plot copper.n copper.k -o copper.png",
        "illuminant spectra show book/copper",
    ),
)
