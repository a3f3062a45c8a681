"""Figure 5.24: wedges of lines along Y, I and Q, and what NTSC resolves of them (book 5.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Float64 = NDArray[np.float64]

LOWER = 3
MHZ = {"Y": 4.2, "I": 1.3, "Q": 0.5}


def _contrast(sent: Float64, received: Float64) -> Float64:
    """What is left of each row (h, w) of lines: the part of the received that is in step with the sent."""
    import numpy as np

    wave = sent - sent.mean(axis=1, keepdims=True)
    return np.asarray((wave * received).sum(axis=1) / (wave**2).sum(axis=1))


def draw(quick: bool) -> Sheet:
    """The wedges, as they are received, and the contrast that is left of them along their height."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen
    from illuminant.color import rgb_to_yiq
    from illuminant.display.patterns.screen import Screen
    from illuminant.display.patterns.wedges import AXES, fineness, wedges
    from illuminant.display.video.standard import cycles
    from illuminant.display.video.transmission import transmit
    from illuminant.plots import picture_sheet

    width, height = 480, 360
    screen = Screen(width, height)
    coarsest, finest = 30, 360
    sent = wedges(screen, lines=finest, coarsest=coarsest)
    received = transmit(sent, decoder="comb")
    # For its contrast each wedge stands alone, wide, and lower by a factor, which keeps the frequencies.
    low = Screen(width, height // LOWER)
    rows, lines = fineness(low.height, coarsest, finest)
    mhz = lines * width / (2.0 * height) / cycles(1.0)
    left: dict[str, Float64] = {}
    limit = {}
    for k, axis in enumerate(AXES):
        alone = wedges(low, axis=axis, lines=finest // LOWER, coarsest=coarsest // LOWER)
        back = transmit(alone, decoder="comb")
        middle = slice(width // 4, width - width // 4)
        before, after = (np.asarray(rgb_to_yiq(one), np.float64)[rows, middle, k] for one in (alone, back))
        left[axis] = _contrast(before, after)
        # The comb mixes the first rows with the grey above them: the limit is where the contrast falls.
        falls = np.flatnonzero((left[axis][:-1] >= 0.5) & (left[axis][1:] < 0.5))
        limit[axis] = float(mhz[falls[0]]) if len(falls) else float("nan")
    pictures, captions = [seen(sent), seen(received)], ["as displayed", "as received through NTSC"]
    return Sheet(
        picture=picture_sheet(pictures, captions, columns=2),
        columns={
            "lines per picture height": lines,
            "MHz": mhz,
            **{f"contrast left along {axis}": left[axis] for axis in AXES},
        },
        checks=(
            *(
                Check(
                    f"half of the contrast along {axis} is left at",
                    limit[axis],
                    "MHz",
                    0.8 * band,
                    1.25 * band,
                )
                for axis, band in MHZ.items()
            ),
            Check("Y resolves finer than Q by", limit["Y"] / limit["Q"], at_least=6.0),
        ),
    )


PLATE = Plate(
    number="5.24",
    title="Resolving wedges along Y, I and Q",
    shows="Lines that run together, as light and dark, along I (orange and cyan) and along Q (purple and green), "
    "with the largest contrast that the signals allow; figures tell how many fit in the picture's height. "
    "Right: the same after encoding and decoding.",
    claim="I and Q merge to grey long before Y: in the signal half of the contrast is left at about 4.2, 1.3 and 0.5 "
    "MHz, the bandwidths of the standard.",
    today="The book's figure shows the eye's own weakness for fine lines of colour, which the bandwidths were made "
    "for; chroma subsampling of digital video (4:2:2, 4:2:0) lives by it still.",
    draw=draw,
    commands=(
        "illuminant pattern wedges --size 640x480 -o wedges.png",
        "illuminant video transmit wedges.png received.png",
    ),
)
