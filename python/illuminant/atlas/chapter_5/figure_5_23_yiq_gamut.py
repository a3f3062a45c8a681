"""Figure 5.23: the gamut of a monitor in Y I Q (book 5.5, eq 5.2)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The cube from its side and along Y, with the colours whose signal leaves its bounds."""
    import numpy as np

    from illuminant.display.video import cube
    from illuminant.display.video.legality import composite_range
    from illuminant.plots import yiq_gamut

    corners = cube.corners()
    yiq = np.array([corner.yiq for corner in corners])
    names = [corner.name for corner in corners]
    chroma = np.hypot(yiq[:, 1], yiq[:, 2])
    low, high = (np.array(levels) for levels in composite_range([corner.rgb for corner in corners]))
    careful = [names.index(name) for name in ("blue", "magenta", "red")]
    others = [names.index(name) for name in ("yellow", "cyan", "green")]
    return Sheet(
        picture=yiq_gamut(),
        columns={
            "corner": names,
            **{axis: yiq[:, k] for k, axis in enumerate("YIQ")},
            "√(I² + Q²)": chroma,
            "lowest, IRE": low,
            "highest, IRE": high,
        },
        checks=(
            Check("largest Y of blue, magenta and red", float(yiq[careful, 0].max()), at_most=0.42),
            Check("smallest Y of yellow, cyan and green", float(yiq[others, 0].min()), at_least=0.58),
            Check(
                "smallest chroma over Y of blue, magenta and red",
                float((chroma / np.maximum(yiq[:, 0], 1e-9))[careful].min()),
                at_least=1.0,
            ),
            Check("chroma of white", float(chroma[names.index("white")]), at_most=1e-12),
            Check("part of the cube that is hot", cube.hot_share(steps=32), at_least=0.001, at_most=0.02),
        ),
    )


PLATE = Plate(
    number="5.23",
    title="The gamut of a monitor in Y I Q",
    shows="The cube of RGB after eq 5.2: a slanted box that stands on black and ends in white, with Y from 0 to 1. "
    "Corners in bold are hot: their signal $7.5 + 92.5\\,(Y \\pm\\sqrt{I^2 + Q^2})$ leaves −20 to 120 IRE.",
    claim="Blue, magenta and red have more chroma than luminance, with a Y of at most 0.41, as the book warns; "
    "yellow, cyan and green have the same chroma at a Y of 0.59 or more.",
    printed="Two numbers of eq 5.2 are wrong in print: 0.144 for 0.114 in Y, by which white would have a Y of 1.03, "
    "and −0.528 for −0.523 in Q, by which greys would have a colour.",
    today="Half a percent of all colours cannot be sent at all: `video check` finds them, and `--repair` takes "
    "saturation away until they are legal, at the same Y and hue.",
    draw=draw,
    commands=("illuminant video gamut -o gamut.png",),
)
