"""Figure 5.26: the bandwidths of Y, I and Q on a black and white picture (book 5.5)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

BANDS = (("Y", 4.2), ("I", 1.3), ("Q", 0.5))
SCANNED_US = 52.6


def draw(quick: bool) -> Sheet:
    """The grey picture, and after a low-pass of 4.2, 1.3 and 0.5 MHz along its lines."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen, still_life
    from illuminant.display.video.black_and_white import preview
    from illuminant.display.video.filters import chroma_pass, i_pass, low_pass, response
    from illuminant.display.video.standard import cycles, pixel_limit
    from illuminant.display.video.transmission import band_limited
    from illuminant.plots import picture_sheet

    grey = preview(still_life(quick))
    passed = [band_limited(grey, mhz) for _, mhz in BANDS]
    names = ["black and white", *(f"{name}: {mhz:g} MHz, {cycles(mhz):.0f} cycles" for name, mhz in BANDS)]
    lost = [float(np.sqrt(((one - grey) ** 2).mean())) for one in passed]
    taps = (low_pass(4.2), i_pass(1.3), chroma_pass(0.5))
    gains = [float(np.abs(response(tap, mhz))) for tap, (_, mhz) in zip(taps, BANDS, strict=True)]
    return Sheet(
        picture=picture_sheet([seen(one) for one in (grey, *passed)], names, columns=2),
        columns={
            "signal": [name for name, _ in BANDS],
            "bandwidth, MHz": [mhz for _, mhz in BANDS],
            "cycles a line": [cycles(mhz) for _, mhz in BANDS],
            "pixels a line": [pixel_limit(mhz) for _, mhz in BANDS],
            "response there": gains,
            "root mean square loss": lost,
        },
        checks=(
            Check("cycles of Y a line", cycles(4.2), at_least=220.5, at_most=221.5),
            Check("cycles of I a line", cycles(1.3), at_least=68.2, at_most=68.5),
            Check("cycles of Q a line", cycles(0.5), at_least=26.2, at_most=26.4),
            Check("loss at 0.5 MHz over that at 4.2", lost[2] / lost[0], at_least=4.0),
            Check("least response at the end of a band", min(gains), at_least=0.7),
        ),
    )


PLATE = Plate(
    number="5.26",
    title="The bandwidths of Y, I and Q",
    shows="A black and white picture whose lines pass the bandwidths of the three signals, 4.2, 1.3 and 0.5 MHz; a "
    "line is scanned in 52.6 µs.",
    claim="A line carries 221 cycles of Y, 68 of I and 26 of Q, so that a picture of 53 pixels a line holds all "
    "that Q can carry.",
    printed="For I the book has 68.3 cycles; 1.3 MHz in 52.6 µs are 68.4.",
    today="The filters are of linear phase and keep within the limits of 47 CFR 73.682, by which I is less than 2 dB "
    "down at 1.3 MHz and Q less than 6 dB at 0.5 MHz.",
    draw=draw,
    commands=("illuminant video components room.png bands.png --bands",),
)
