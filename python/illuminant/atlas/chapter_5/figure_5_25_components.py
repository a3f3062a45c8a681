"""Figure 5.25: a picture and its parts in Y, in I and in Q (book 5.5, eqs 5.2 and 5.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The picture, Y as grey, I and Q on a grey of one half."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen, still_life
    from illuminant.color import rgb_to_yiq
    from illuminant.display.video.transmission import components
    from illuminant.plots import picture_sheet

    values = still_life(quick)
    parts = components(values)
    shown = [values, parts[0], 0.5 + 0.5 * parts[1], 0.5 + 0.5 * parts[2]]
    names = ["the picture", "Y", "I, half of it on grey", "Q, half of it on grey"]
    yiq = np.asarray(rgb_to_yiq(values))
    spread = yiq.std(axis=(0, 1))
    steps = np.abs(np.diff(yiq, axis=1)).mean(axis=(0, 1))
    luminances = [np.asarray(rgb_to_yiq(part))[..., 0] for part in parts[1:]]
    return Sheet(
        picture=picture_sheet([seen(one) for one in shown], names, columns=2),
        columns={
            "part": list("YIQ"),
            "mean": yiq.mean(axis=(0, 1)),
            "standard deviation": spread,
            "mean step to the next pixel": steps,
        },
        checks=(
            Check(
                "largest error of the sum of the parts",
                float(np.abs(sum(parts) - values).max()),
                at_most=1e-12,
            ),
            Check("largest Y in the parts of I and of Q", float(np.abs(luminances).max()), at_most=1e-12),
            Check("spread of Q over that of Y", float(spread[2] / spread[0]), at_most=0.9),
            Check("mean step of Q over that of Y", float(steps[2] / steps[0]), at_most=0.7),
        ),
    )


PLATE = Plate(
    number="5.25",
    title="A picture in its components Y, I and Q",
    shows="A picture taken apart by eq 5.2, each part at the full resolution: Y as grey, I from cyan to orange and Q "
    "from green to purple, halved and on grey since they are negative in part.",
    claim="The three parts add up to the picture, I and Q without any luminance; most of the detail lies in Y, and "
    "the least in Q.",
    today="The same division carries every digital video and JPEG as Y Cb Cr, the axes that I and Q are before they "
    "are turned by 33 degrees.",
    draw=draw,
    commands=("illuminant video components room.png parts.png",),
)
