"""Figure II.1: what surfaces of dielectrics reflect at normal incidence, by wavelength (book II.1.1, eq III.16)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

MEDIA = ("fused silica", "BK7", "water", "diamond")
RANGE_NM = (400.0, 700.0)


def draw(quick: bool) -> Sheet:
    """Reflectance of five media; the book's crown glass is drawn where its table holds values."""
    import numpy as np

    from illuminant import optics, spectra
    from illuminant.plots.style import INK, PRINTED, line_look, new_figure

    nm = np.arange(RANGE_NM[0], RANGE_NM[1] + 1)
    curves = {name: np.asarray(optics.normal_reflectance(spectra.load(f"{name}.n").at(nm))) for name in MEDIA}
    book = spectra.load("book/crown glass")
    within = (nm >= book.range_nm[0]) & (nm <= book.range_nm[1])
    curves["crown glass of the book"] = np.where(within, book.at(nm), np.nan)
    figure, axes = new_figure((7.4, 4.4))
    for i, name in enumerate(("diamond", "BK7", "crown glass of the book", "fused silica", "water")):
        look = PRINTED | {"color": INK} if name.endswith("book") else line_look(i)
        axes.plot(nm, curves[name], **look, label=name)
    axes.set(xlabel="wavelength, nm", ylabel="reflectance at normal incidence", xlim=RANGE_NM, ylim=(0, 0.2))
    axes.grid(True)
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.55))
    glass = np.array([curves[name] for name in ("fused silica", "BK7", "water")])
    every = np.array([curves[name] for name in MEDIA])
    bk7, own = curves["BK7"], curves["crown glass of the book"]
    return Sheet(
        picture=figure,
        columns={"wavelength, nm": nm, **curves},
        checks=(
            Check("largest reflectance of glass and water", float(glass.max()), at_most=0.05),
            Check(
                "largest ratio of a medium's reflectances in the visible range",
                float((every.max(axis=1) / every.min(axis=1)).max()),
                at_most=1.15,
            ),
            Check(
                "the book's crown glass against BK7, largest difference",
                float(np.nanmax(np.abs(own - bk7))),
                at_most=0.002,
            ),
        ),
    )


PLATE = Plate(
    number="II.1",
    title="Spectral curves of dielectrics",
    shows="Reflectance at normal incidence, $((n - 1)/(n + 1))^2$ (eq III.16), over the visible range for glasses, "
    "and for water and diamond beside them.",
    claim="Dielectrics reflect little, glass and water less than 5 %, and nearly the same at all wavelengths: no "
    "medium changes by more than 15 %.",
    today="Indices are measured at all wavelengths (refractiveindex.info), so that reflectance, refraction and "
    "dispersion come from one curve, where the book has a reflectance and one average index.",
    draw=draw,
    commands=(
        "illuminant spectra plot BK7.n diamond.n -o indices.png",
        'illuminant spectra show "book/crown glass"',
    ),
)
