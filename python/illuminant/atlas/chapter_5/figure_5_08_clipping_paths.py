"""Figure 5.8: the paths along which clipping methods take gradients that leave the RGB cube (book 5.1.3, III.9)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

METHODS = ("constant-intensity", "scale", "clamp", "cook", "oklab", "soft")


def draw(quick: bool) -> Sheet:
    """A cube for each method, the three of the book above, today's below."""
    import numpy as np

    from illuminant.display import gamut, gamut_study
    from illuminant.plots.gamut_study import COLOURS, gradients, paths

    small = gamut_study.small_display()
    steps = 33 if quick else 129
    names, kinds, colours, asked_for, shown = [], [], [], [], []
    bright = gradients("bright", steps)
    for kind in gamut_study.KINDS:
        for colour, line in zip(COLOURS, gradients(kind, steps), strict=True):
            for method in METHODS:
                names += [method] * steps
                kinds += [kind] * steps
                colours += [colour] * steps
                asked_for.append(line)
                shown.append(gamut.bring_inside(line, method, small))
    asked, inside = np.concatenate(asked_for), np.concatenate(shown)
    kept = gamut.bring_inside(bright, "constant-intensity", small)
    farthest = float(max(-inside.min(), inside.max() - 1.0))
    dim = bright.sum(axis=-1) < 3.0 * 0.999
    scaled = gamut.bring_inside(bright, "scale", small)
    direction = np.cross(bright[:, 1:], scaled[:, 1:])
    clamped = gamut_study.measure(bright, "clamp", small)
    return Sheet(
        picture=paths(METHODS),
        columns={
            "method": names,
            "gradient": kinds,
            "colour": colours,
            **{f"{channel} asked for": asked[:, k] for k, channel in enumerate("RGB")},
            **{f"{channel} shown": inside[:, k] for k, channel in enumerate("RGB")},
        },
        checks=(
            Check("farthest of all paths outside the cube", farthest, at_most=1e-9),
            Check(
                "constant intensity: change of R + G + B below that of white",
                float(np.abs(kept.sum(axis=-1) - bright.sum(axis=-1))[dim].max()),
                at_most=2e-3,
            ),
            Check(
                "constant intensity: distance of the ends from white",
                float(np.linalg.norm(kept[:, -1] - 1.0, axis=-1).max()),
                at_most=2e-3,
            ),
            Check(
                "scale: change of direction", float(np.linalg.norm(direction, axis=-1).max()), at_most=1e-9
            ),
            Check("clamp: mean turn of the hue", clamped.hue, "degrees", at_least=10.0),
        ),
    )


PLATE = Plate(
    number="5.8",
    title="Clipping paths in the RGB cube",
    shows="Gradients of four hues that grow too bright at one chromaticity, or too saturated at one luminance "
    "(dotted), and where a method takes them (in colour): at constant intensity $R + G + B$ towards the "
    "neutral axis, by scaling $c/\\max(c)$, and by clamping each channel. The neutral axis is dashed.",
    claim="Constant intensity leads along the cube's faces into white, scaling stops where the gradient leaves the "
    "cube and keeps its direction, and clamping follows edges and turns hues by more than ten degrees.",
    today="Lower row: `cook`, the default, adds white until no channel is negative and scales the rest; `oklab` "
    "keeps hue and lightness as they are seen; `soft` gives way before the boundary, so that no path has a "
    "corner.",
    draw=draw,
    commands=("illuminant gamut paths -o paths.png", "illuminant gamut study"),
)
