"""Figure 5.10: how far clipping methods take colours from what they should be, in L*a*b* (book 5.1.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

BOOK = ("constant-intensity", "scale", "clamp")
TODAY = ("cook", "oklab")


def draw(quick: bool) -> Sheet:
    """ΔE*ab along four gradients that grow too bright, and four that grow too saturated."""
    import numpy as np

    from illuminant.display import gamut, gamut_study
    from illuminant.plots.gamut_study import COLOURS, deviation, gradients

    methods, steps = (*BOOK, *TODAY), 129 if quick else 513
    small = gamut_study.small_display()
    names: list[str] = []
    kinds: list[str] = []
    colours: list[str] = []
    along, lab, ciede = [], [], []
    mean: dict[tuple[str, str], list[float]] = {}
    for kind in gamut_study.KINDS:
        for colour, line in zip(COLOURS, gradients(kind, steps), strict=True):
            outside = gamut.classify(line) != 0
            for method in methods:
                delta_e, delta_lab = gamut_study.deviation(
                    line, gamut.bring_inside(line, method, small), small
                )
                names += [method] * steps
                kinds += [kind] * steps
                colours += [colour] * steps
                along.append(np.linspace(0.0, 1.0, steps))
                lab.append(delta_lab)
                ciede.append(delta_e)
                mean.setdefault((kind, method), []).append(float(delta_lab[outside].mean()))
    table = {key: np.array(values) for key, values in mean.items()}
    nearest = {kind: np.minimum(table[kind, "scale"], table[kind, "clamp"]) for kind in gamut_study.KINDS}
    both = np.concatenate(list(nearest.values()))
    others = np.concatenate([np.min([table[kind, m] for m in methods], axis=0) for kind in gamut_study.KINDS])
    everywhere = {m: float(np.mean([table[kind, m].mean() for kind in gamut_study.KINDS])) for m in methods}
    return Sheet(
        picture=deviation(methods, "lab", steps=steps, size=(9.0, 5.4)),
        columns={
            "method": names,
            "gradient": kinds,
            "colour": colours,
            "along": np.concatenate(along),
            "ΔE*ab": np.concatenate(lab),
            "ΔE00": np.concatenate(ciede),
        },
        checks=(
            Check(
                "gradients of eight on which no method lies nearer than the better of scale and clamp",
                float((both <= others + 1e-6).sum()),
                at_least=8,
            ),
            Check(
                "brighter orange and rose: clamp less scale",
                float((table["bright", "clamp"] - table["bright", "scale"])[[0, 3]].max()),
                "ΔE*ab",
                at_most=-1.0,
            ),
            Check(
                "brighter yellow-green and blue: scale less clamp",
                float((table["bright", "scale"] - table["bright", "clamp"])[[1, 2]].max()),
                "ΔE*ab",
                at_most=-1.0,
            ),
            Check(
                "constant intensity over the better of scale and clamp, mean",
                everywhere["constant-intensity"] / min(everywhere["scale"], everywhere["clamp"]),
                at_least=1.2,
            ),
        ),
    )


PLATE = Plate(
    number="5.10",
    title="Deviation of clipped colours in L*a*b*",
    shows="The distance $\\Delta E^*_{ab}$ between the colour that is asked for and the one that is shown, along "
    "gradients that leave the gamut of a small display: brighter at one chromaticity above, more saturated at "
    "one luminance below.",
    claim="Scaling or clamping is least wrong on every one of the gradients, as the book says: clamping on bright "
    "orange and rose, scaling on bright yellow-green and blue; keeping $R + G + B$ costs at least a fifth more "
    "on the mean.",
    today="`cook`, the default, is `scale` where only brightness is too high, and on saturated colours keeps the hue "
    "to a degree where clamping turns it by seven; `oklab` keeps lightness and hue exactly and pays with "
    "saturation. `illuminant gamut study` has the measures of ten methods over three sets of colours.",
    draw=draw,
    commands=("illuminant gamut deviation -o deviation.png", "illuminant gamut study"),
)
