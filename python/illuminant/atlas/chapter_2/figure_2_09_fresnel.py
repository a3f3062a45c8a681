"""Figure 2.9: how much glass and copper reflect by Fresnel's equations (book eqs 2.13 to 2.17).

Reflectance against the angle of incidence, for light polarised parallel and perpendicular to the plane of incidence and
for their mean: glass n = 1.5, copper n = 0.617 and k = 2.63 (the book's sample material, III.7.1).
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

GLASS = 1.5
COPPER = (0.617, 2.63)
LINES_NM = (450.0, 580.0, 650.0)


def draw(quick: bool) -> Sheet:
    """The three curves of each; dashed eqs 2.16 and 2.17 for copper, which approximate; thick the library's copper."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant import optics, spectra
    from illuminant.plots.style import DPI, INK, PRINTED, TODAY, line_look

    angle = np.linspace(0.0, 90.0, 181 if quick else 361)
    cosine = np.cos(np.radians(angle)).clip(0.0, 1.0)
    kinds = ("perpendicular", "parallel", "")
    glass = [np.asarray(optics.fresnel_dielectric(cosine, GLASS, kind)) for kind in kinds]
    copper = [np.asarray(optics.fresnel_conductor(cosine, *COPPER, kind)) for kind in kinds]
    printed = np.asarray(optics.fresnel_conductor_approximated(cosine, *COPPER))
    index = spectra.load("copper.n").at(LINES_NM), spectra.load("copper.k").at(LINES_NM)
    today = [np.asarray(optics.fresnel_conductor(cosine, n, k)) for n, k in zip(*index, strict=True)]

    figure = Figure(figsize=(8.0, 4.2), dpi=DPI, layout="constrained", facecolor="white")
    grid: Any = figure.subplots(1, 2, sharey=True)
    names = ("perpendicular", "parallel", "mean (eq 2.15)")
    for axes, curves in zip(grid, (glass, copper), strict=True):
        for i, (curve, name) in enumerate(zip(curves, names, strict=True)):
            axes.plot(angle, curve, **line_look(i), label=name)
        axes.set(xlabel="angle of incidence, degrees", xlim=(0, 90), ylim=(0, 1.02), xticks=range(0, 91, 15))
        axes.grid(True)
    brewster = np.degrees(np.arctan(GLASS))
    grid[0].plot(brewster, 0.0, "o", color=INK, markersize=4, clip_on=False, label="Brewster's angle, 56.3°")
    grid[1].plot(angle, printed, **{**line_look(2), **PRINTED}, label="mean, eqs 2.16 and 2.17")
    for number, (curve, line) in enumerate(zip(today, LINES_NM, strict=True)):
        label = "today: at 450, 580 and 650 nm" if number == 0 else None
        grid[1].plot(angle, curve, **TODAY, label=label)
        grid[1].annotate(f"{line:g} nm", (2.0, curve[0] - 0.045), fontsize=8)
    grid[0].set(title=f"glass, n = {GLASS}", ylabel="reflectance")
    grid[1].set_title("copper, n = {}, k = {}".format(*COPPER))
    grid[0].legend(loc="upper left")
    grid[1].legend(loc="lower left")

    columns = {"angle, degrees": angle}
    for material, curves in (("glass", glass), ("copper", copper)):
        columns |= {f"{material}, {name}": curve for name, curve in zip(names, curves, strict=True)}
    columns["copper, mean, eqs 2.16 and 2.17"] = printed
    columns |= {f"copper at {line:g} nm": curve for line, curve in zip(LINES_NM, today, strict=True)}
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check(
                "angle at which glass reflects no parallel light",
                float(angle[glass[1].argmin()]),
                "°",
                56.0,
                56.6,
            ),
            Check("its smallest parallel reflectance", float(glass[1].min()), at_most=1e-5),
            Check(
                "smallest reflectance of copper", float(min(curve.min() for curve in copper)), at_least=0.5
            ),
            Check(
                "smallest mean reflectance at 90°", float(min(glass[2][-1], copper[2][-1])), at_least=0.999
            ),
        ),
    )


PLATE = Plate(
    number="2.9",
    title="Fresnel reflectance of glass and copper",
    shows="Reflectance against the angle of incidence for light polarised perpendicular and parallel to the plane of "
    "incidence, and their mean: glass with $n = 1.5$ (eqs 2.13 to 2.15) and copper with $n = 0.617$, $k = 2.63$.",
    claim="Parallel light is not reflected by glass at Brewster's angle, $\\arctan n = 56.3°$; copper, with $k > 0$, "
    "never falls below a half; and at grazing incidence both reflect all.",
    printed="The text of section 2.2.5 has it that the perpendicular curve of glass vanishes near 55°; the parallel "
    "one does. Eqs 2.16 and 2.17 hold for $n^2 + k^2 \\gg 1$; of copper, where it is 7, they miss up to 0.01 "
    "(dashed).",
    today="The equations of a conductor are solved exactly, at every wavelength that is traced: copper reflects 0.54 "
    "of the light at 450 nm and 0.93 of that at 650 nm, which one pair of n and k cannot tell.",
    draw=draw,
    commands=("illuminant spectra show copper.n", "illuminant audit copper"),
)
