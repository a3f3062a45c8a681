"""Figure III.7: the reflectance of copper by wavelength and angle, by Cook's interpolation (book eq III.20).

    F(λ, θ) = F(λ, 0) + (1 − F(λ, 0)) (F_ave(θ) − F_ave(0)) / (1 − F_ave(0)),    at least 0

with F(λ, 0) measured, and F_ave from one n and k for all wavelengths.
"""

from __future__ import annotations

from illuminant.atlas.appendices.figure_iii_6_metal_fresnel import BOOK_COPPER
from illuminant.atlas.plate import Check, Plate, Sheet

ANGLES = (0.0, 45.0, 60.0, 75.0, 85.0, 90.0)
RANGE_NM = (380.0, 700.0)


def draw(quick: bool) -> Sheet:
    """The interpolation with measured constants, with k = 0 and with n = 1; beside them, exact from n(λ) and k(λ)."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant import optics, spectra
    from illuminant.plots.style import DPI, line_look

    nm = np.arange(RANGE_NM[0], RANGE_NM[1] + 1, 2)
    normal = np.asarray(spectra.load("book/copper").at(nm))
    n, k = (np.asarray(spectra.load(f"copper.{letter}").at(nm)) for letter in "nk")
    cosine = np.cos(np.radians(ANGLES)).clip(0.0, 1.0)[:, None]

    def interpolated(at_normal: np.ndarray, one_n: float, one_k: float) -> np.ndarray:
        average = np.asarray(optics.fresnel_conductor(cosine, one_n, one_k))
        return np.asarray(
            optics.cook_interpolation(at_normal, average, optics.normal_reflectance(one_n, one_k))
        )

    mean = float(normal.mean())
    index, extinction = (
        float(optics.index_of_reflectance(mean)),
        float(optics.extinction_of_reflectance(mean)),
    )
    exact = np.asarray(optics.fresnel_conductor(cosine, n, k))
    panels = {
        "$n_{ave}$ = 0.617, $k_{ave}$ = 2.630": interpolated(normal, *BOOK_COPPER),
        f"k = 0, $n_{{ave}}$ = {index:.2f}": interpolated(normal, index, 0.0),
        f"n = 1, $k_{{ave}}$ = {extinction:.2f}": interpolated(normal, 1.0, extinction),
        "today: exact, measured n(λ), k(λ)": exact,
    }
    figure = Figure(figsize=(8.6, 6.0), dpi=DPI, layout="constrained", facecolor="white")
    columns = {"wavelength, nm": nm}
    names = ("n and k", "k = 0", "n = 1", "exact")
    for axes, (title, curves), name in zip(
        figure.subplots(2, 2, sharex=True, sharey=True).flat, panels.items(), names, strict=True
    ):
        for i, (angle, curve) in enumerate(zip(ANGLES, curves, strict=True)):
            axes.plot(nm, curve, **line_look(i), label=f"{angle:g}°")
            columns[f"{name}, {angle:g}°"] = curve
        axes.set_title(title, fontsize=9.5)
        axes.set(xlim=RANGE_NM, ylim=(0, 1.02))
        axes.grid(True)
    figure.legend(handles=figure.axes[0].lines, title="incidence", loc="outside right upper")
    figure.supxlabel("wavelength, nm", fontsize=9)
    figure.supylabel("reflectance", fontsize=9)
    known, no_k, no_n, _ = panels.values()
    near = np.array(ANGLES) <= 45
    spread = np.max([known, no_k, no_n], axis=0) - np.min([known, no_k, no_n], axis=0)
    own = interpolated(exact[0], float(n.mean()), float(k.mean()))
    columns |= {f"interpolated from averages of n and k, {a:g}°": c for a, c in zip(ANGLES, own, strict=True)}
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("largest spread of the three up to 45°", float(spread[near].max()), at_most=0.05),
            Check("largest spread at any angle", float(spread.max()), at_least=0.3),
            Check(
                "least dip below normal incidence, n and k or k = 0",
                float(min((normal - known).max(), (normal - no_k).max())),
                at_least=0.002,
            ),
            Check("dip below normal incidence, n = 1", float((normal - no_n).max()), at_most=1e-9),
        ),
    )


PLATE = Plate(
    number="III.7",
    title="Approximated Fresnel reflectance of copper",
    shows="The reflectance of copper against wavelength at angles of incidence from 0 to 90° by eq III.20, from the "
    "measured curve at normal incidence (Purdue 1970) and one average reflectance by angle: from $n_{ave} = 0.617$, "
    "$k_{ave} = 2.630$ (Jenkins and White 1976), with $k = 0$, and with $n = 1$.",
    claim="All three keep the colour of copper at normal incidence and turn white at grazing, and agree to 0.05 up to "
    "45°; at larger angles they part by more than 0.3, and only with $n = 1$ does no angle reflect less than normal "
    "incidence.",
    today="The reflectance is exact from n and k at each wavelength of clean copper (last panel; it reflects more "
    "than the sample of 1970). The book knew of no study of the interpolation's error: with averages of the same n "
    "and k it stays below 0.1.",
    draw=draw,
    commands=(
        "illuminant spectra show book/copper",
        "illuminant spectra plot copper.n copper.k -o copper.png",
    ),
)
