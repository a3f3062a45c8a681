"""Figure 5.9: gradients that leave a small gamut, right in a control band and by each clipping method (book 5.1.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

METHODS = ("constant-intensity", "scale", "clamp", "cook", "oklab", "soft")
"""The book's, in its order below the control band, then today's."""

HUES = (0, 1, 4)
"""Of six gradients of each kind: red, yellow and blue."""


def draw(quick: bool) -> Sheet:
    """Six groups of bands: brighter to the right in the left column, more saturated in the right one."""
    import numpy as np

    from illuminant.display import displays, gamut, gamut_study
    from illuminant.display.look import Look, show
    from illuminant.plots import picture_sheet
    from illuminant.plots.dither_study import labelled

    width, band = 120 if quick else 320, 24
    outer = displays.named("sRGB")
    small = gamut_study.small_display(outer)
    sheets, captions, kinds, methods, hues, errors, kinks = [], [], [], [], [], [], []
    reach = 0.0
    asked = {kind: gamut_study.gradients(small, outer, kind, 6, width) for kind in gamut_study.KINDS}
    for hue, name in zip(HUES, ("red", "yellow", "blue"), strict=True):
        for kind, gradient in asked.items():
            line = gradient[hue]
            rows = [line, *(gamut.bring_inside(line, method, small) for method in METHODS)]
            on_page = np.stack(rows) @ small.to_xyz_matrix.T * (small.peak / outer.peak)
            linear = on_page[0] @ outer.from_xyz_matrix.T
            reach = max(reach, float(linear.max()) - 1.0, -float(linear.min()))
            codes = show(on_page, Look(outer, exposure=1.0, gamut="clamp")).picture.codes
            bands = [np.repeat(row[None].astype(np.uint8), band, axis=0) for row in codes]
            sheets.append(labelled(bands, ["control", *METHODS], gap=0))
            captions.append(f"{name}, {'brighter' if kind == 'bright' else 'more saturated'} to the right")
            for method in METHODS:
                found = gamut_study.measure(line[None], method, small)
                kinds.append(kind)
                methods.append(method)
                hues.append(name)
                errors.append(found.lab)
                kinks.append(found.kink)
    every = {method: gamut_study.measure(asked["bright"], method, small) for method in METHODS}
    return Sheet(
        picture=picture_sheet(sheets, captions, columns=2),
        columns={
            "gradient": kinds,
            "colour": hues,
            "method": methods,
            "mean ΔE*ab of what is outside": errors,
            "largest jump of the slope of L*a*b*": kinks,
        },
        checks=(
            Check("control bands beyond the gamut of the page", reach, at_most=1e-6),
            Check("scale: jump of slope where clipping begins", every["scale"].kink, at_least=20.0),
            Check("clamp: jump of slope where clipping begins", every["clamp"].kink, at_least=20.0),
            Check(
                "soft: jump of slope, as a part of that of scale",
                every["soft"].kink / every["scale"].kink,
                at_most=0.25,
            ),
        ),
    )


PLATE = Plate(
    number="5.9",
    title="Clipping bands",
    shows="Gradients through the gamut of a small display whose primaries and white lie inside those of the page, so "
    "that a control band can show the right colours; below it the same gradient by each method. Left: brighter "
    "at one chromaticity. Right: more saturated at one luminance.",
    claim="The control bands are shown without clipping; scaling and clamping begin with a corner in the gradient, "
    "which the eye sharpens to a Mach band.",
    today="`cook` (the default) and `oklab` keep the hue; `soft` compresses before the boundary, and leaves less "
    "than a quarter of the corner of scaling.",
    draw=draw,
    commands=("illuminant gamut strips -o strips.png", "illuminant gamut study"),
)
