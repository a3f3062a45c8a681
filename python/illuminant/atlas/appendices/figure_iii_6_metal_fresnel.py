"""Figure III.6: the Fresnel reflectance of metals, and what is made of it with only one constant (book III.5.1).

From the reflectance at normal incidence F: either k = 0 and n = (1 + √F)/(1 − √F) (eq III.17), or n = 1 and
k = 2 √(F/(1 − F)) (eq III.19). Both are right at normal and at grazing incidence.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

WAVELENGTH_NM = 589.3
BOOK_COPPER = (0.617, 2.630)
"""n and k of copper in the book, after Jenkins and White (1976)."""


def draw(quick: bool) -> Sheet:
    """Four panels; dashed, the book's own eqs 2.16 and 2.17 for the actual curve."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant import optics, spectra
    from illuminant.plots.style import DPI, PRINTED, TODAY, line_look

    degrees = np.linspace(0.0, 90.0, 361)
    cosine = np.cos(np.radians(degrees)).clip(0.0, 1.0)
    constants = {"copper": BOOK_COPPER}
    for name in ("gold", "silver", "iron"):
        n, k = (float(spectra.load(f"{name}.{letter}").at(WAVELENGTH_NM)) for letter in "nk")
        constants["steel (iron)" if name == "iron" else name] = (n, k)
    figure = Figure(figsize=(8.4, 5.8), dpi=DPI, layout="constrained", facecolor="white")
    columns = {"angle of incidence, degrees": degrees}
    near, no_k, no_n, above = [], [], [], {}
    for axes, name in zip(
        figure.subplots(2, 2, sharex=True, sharey=True).flat,
        ("gold", "silver", "copper", "steel (iron)"),
        strict=True,
    ):
        n, k = constants[name]
        normal = float(optics.normal_reflectance(n, k))
        exact = np.asarray(optics.fresnel_conductor(cosine, n, k))
        book = np.asarray(optics.fresnel_conductor_approximated(cosine, n, k))
        first = np.asarray(optics.fresnel_dielectric(cosine, optics.index_of_reflectance(normal)))
        second = np.asarray(optics.fresnel_conductor(cosine, 1.0, optics.extinction_of_reflectance(normal)))
        axes.plot(degrees, exact, **TODAY, label="actual, exact")
        axes.plot(degrees, book, **PRINTED | {"color": "black"}, label="actual, eqs 2.16 and 2.17")
        axes.plot(degrees, first, **line_look(0), label="k = 0")
        axes.plot(degrees, second, **line_look(1), label="n = 1")
        axes.set_title(f"{name}: n = {n:.3g}, k = {k:.3g}", fontsize=9.5)
        axes.set(xlim=(0, 90), ylim=(0.4, 1.0))
        axes.set_xticks(range(0, 91, 15))
        axes.grid(True)
        columns |= {
            f"{name}, exact": exact,
            f"{name}, eqs 2.16, 2.17": book,
            f"{name}, k = 0": first,
            f"{name}, n = 1": second,
        }
        errors = np.abs(np.stack([first, second]) - exact)
        near.append(float(errors[:, degrees <= 45].max()))
        no_k.append(float(errors[0].max()))
        no_n.append(float(errors[1].max()))
        above[name] = float((np.maximum(first, second) - exact).max())
    figure.axes[0].legend(loc="lower left")
    figure.supxlabel("angle of incidence, degrees", fontsize=9)
    figure.supylabel("reflectance, unpolarised", fontsize=9)
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("largest error of both up to 45°", max(near), at_most=0.02),
            Check("largest error of k = 0", max(no_k), at_least=0.3),
            Check("largest error of n = 1", max(no_n), at_most=0.2),
            Check(
                "how far the higher of both rises above gold, silver and copper",
                max(value for name, value in above.items() if name != "steel (iron)"),
                at_most=1e-9,
            ),
        ),
    )


PLATE = Plate(
    number="III.6",
    title="Actual and approximated reflectance of metals",
    shows="Reflectance of gold, silver, copper and steel for unpolarised light of 589 nm against the angle of "
    "incidence, from n and k, and from the reflectance at normal incidence alone with $k = 0$ (eqs III.16, III.17) or "
    "$n = 1$ (eqs III.18, III.19). Copper has the book's constants; iron stands for steel.",
    claim="Up to 45° both approximations are good to 0.02; beyond, $k = 0$ dips by as much as a half, $n = 1$ by less "
    "than 0.2, and for gold, silver and copper the actual curve lies above both.",
    printed="The text finds that the two appear to bound the actual curve. With measured constants they do for steel "
    "only. Eqs 2.16 and 2.17, by which the book draws the actual curve, hold for large $n^2 + k^2$ (dashed): here "
    "they are right to 0.01.",
    today="Fresnel's equations are evaluated exactly, with n and k of each wavelength; neither approximation is "
    "needed.",
    draw=draw,
    commands=("illuminant spectra plot gold.n gold.k -o gold.png",),
)
