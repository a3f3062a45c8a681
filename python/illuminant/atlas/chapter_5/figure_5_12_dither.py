"""Figure 5.12: a gradation of three bits, 256 pixels wide, under several dithers (book 5.1.4)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

BOOK = ("none", "floyd-steinberg-book", "ordered-2", "ordered-4", "dot-diffusion-4")
TODAY = ("floyd-steinberg", "bayer-8", "blue-noise")
JUDGED = ("none", "ordered-2", "ordered-4")
BITS = 3


def draw(quick: bool) -> Sheet:
    """The five bands of the book, three of today below them; each pixel is drawn as 2 × 2."""
    import numpy as np

    from illuminant.display import dither_study
    from illuminant.plots import picture_sheet
    from illuminant.plots.dither_study import labelled

    names = (*BOOK, *TODAY)
    band = 28
    codes = dither_study.comparison(names, BITS, 256, band)
    grey = (codes.astype(np.float64) * (255.0 / (2**BITS - 1)) + 0.5).astype(np.uint8)
    bands = np.repeat(np.repeat(grey, 2, axis=0), 2, axis=1)[..., None].repeat(3, axis=-1)
    sheet = labelled(np.split(bands, len(names)), names)
    found = {
        name: dither_study.measure(name, BITS)
        for name in (("none", "ordered-2", "ordered-4") if quick else names)
    }
    kept = [found.get(name) for name in names]
    return Sheet(
        picture=picture_sheet([sheet], ["3 bits, 256 pixels wide; the lower three are today's"], columns=1),
        columns={
            "dither": names,
            "grain, codes": [one.grain if one else np.nan for one in kept],
            "step of the local mean, codes": [one.step if one else np.nan for one in kept],
            "step, L*": [one.step_lightness if one else np.nan for one in kept],
            "visible grain, codes": [one.visible if one else np.nan for one in kept],
        },
        checks=(
            Check("step without dither", found["none"].step, "codes", at_least=0.95, at_most=1.0),
            Check(
                "step with ordered-2, a quarter", found["ordered-2"].step, "codes", at_least=0.2, at_most=0.25
            ),
            Check(
                "step with ordered-4, a sixteenth",
                found["ordered-4"].step,
                "codes",
                at_least=0.03,
                at_most=0.0625,
            ),
            Check(
                "largest error of the mean of a band of the book but the first",
                float(
                    np.abs(np.stack(np.split(codes, len(names))).mean(axis=(1, 2)) - (2**BITS - 1) / 2)[
                        1:5
                    ].max()
                ),
                "codes",
                at_most=0.1,
            ),
        ),
    )


PLATE = Plate(
    number="5.12",
    title="Comparison of dithers",
    shows="A grey scale of three bits over 256 pixels: without dither, by Floyd and Steinberg's error diffusion with "
    "the weights that the book prints (3/8, 3/8, 1/4), by ordered dither in cells of 2 × 2 and 4 × 4, and by "
    "Knuth's dot diffusion in cells of 4 × 4.",
    claim="A cell of 2 × 2 leaves a quarter of a step between two codes, and one of 4 × 4 a sixteenth; each band "
    "keeps the mean of the gradation.",
    printed="Floyd and Steinberg published four weights, 7/16, 3/16, 5/16 and 1/16; the three in print are a "
    "simplification, which leaves more noise at low frequencies. Both are drawn.",
    today="`bayer-8` and `blue-noise` leave no step but the rise of the gradation itself; at eight bits they cost "
    "nothing that is seen. Blue noise has no regular texture and less noise at low frequencies than the "
    "printed weights.",
    draw=draw,
    commands=("illuminant dither compare --enlarge 3 -o bands.png", "illuminant dither study"),
)
