"""Figure 5.19: the SMPTE colour bars for a frame buffer, and how they are used with the blue gun alone (book 5.4)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

FAULTS = (("right", 0.0, 1.0), ("hue 20° off", 20.0, 1.0), ("chroma 30 % low", 0.0, 0.7))
"""Name, hue control in degrees and chroma control of three receivers."""


def draw(quick: bool) -> Sheet:
    """The pattern, and the blue picture of a receiver that is right and of two that are not."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen
    from illuminant.display.patterns.color_bars import blue_only, smpte
    from illuminant.display.patterns.screen import Screen
    from illuminant.display.video.transmission import transmit
    from illuminant.plots import picture_sheet

    width, height = (196, 144) if quick else (392, 294)
    values = smpte(Screen(width, height))
    # Clear of edges: the middle of each second bar from the left, above and in the split.
    middles = [round((bar + 0.5) / 7.0 * width) for bar in (0, 2, 4, 6)]
    bar_row, split_row = round(height * 0.55), round(height * 0.708)
    pictures, captions, blues, differences = [seen(values)], ["the pattern"], [], []
    for name, hue, chroma in FAULTS:
        blue = transmit(values, decoder="comb", hue_deg=hue, chroma=chroma)[..., 2]
        pictures.append(seen(blue_only(np.repeat(blue[..., None], 3, axis=-1))))
        captions.append(f"blue gun alone, {name}")
        blues.append((blue[bar_row, middles], blue[split_row, middles]))
        differences.append(float(np.abs(blues[-1][0] - blues[-1][1]).max()))
    step = float(values[-2, round(width * 5.83 / 7)].max())
    return Sheet(
        picture=picture_sheet(pictures, captions, columns=2),
        columns={
            "receiver": [name for name, _, _ in FAULTS for _ in middles],
            "bar": ["white", "cyan", "magenta", "blue"] * len(FAULTS),
            "blue above": np.concatenate([above for above, _ in blues]),
            "blue in the split": np.concatenate([below for _, below in blues]),
        },
        checks=(
            Check("blue across the split, receiver right", differences[0], at_most=1 / 255),
            Check("blue across the split, hue 20° off", differences[1], at_least=0.1),
            Check("blue across the split, chroma 30 % low", differences[2], at_least=0.1),
            Check("bar above black of PLUGE", step, at_least=0.039, at_most=0.041),
        ),
    )


PLATE = Plate(
    number="5.19",
    title="SMPTE colour bars for a frame buffer",
    shows="SMPTE ECR 1-1978: bars of 75 %, below them the split bars (blue, black, magenta, black, cyan, black, "
    "white), and a row of −I, white, +Q and PLUGE, whose bar below black a frame buffer cannot hold.",
    claim="With red and green turned off, bars and split are one where chroma and hue of a receiver are right, and "
    "differ by a tenth of white or more where the hue is 20 degrees off or the chroma 30 % low.",
    today="The signal is encoded, and decoded by receivers whose controls are set wrong, so that the adjustment can "
    "be practised without a monitor; `illuminant calibrate` takes one through all of it.",
    draw=draw,
    commands=(
        "illuminant pattern smpte --size 640x486 -o bars.png",
        "illuminant pattern smpte --blue-only --size 640x486 -o blue.png",
    ),
)
