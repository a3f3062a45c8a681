"""Figure 5.16: the colour bars of an encoder by EIA RS-189-A, with the levels of their signal (book 5.3)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The pattern, its waveform and its vectors."""
    import numpy as np

    from illuminant.atlas.chapter_5 import bars_on_instruments
    from illuminant.display.patterns.color_bars import bar_levels
    from illuminant.display.video.composite import encode

    values = bars_on_instruments.screen_of_bars(encoded=True)
    signal = encode(values)
    columns = bars_on_instruments.columns(signal, bar_levels())
    found = {name: np.array(column) for name, column in columns.items() if name != "bar"}
    at = columns["bar"].index("-I")
    return Sheet(
        picture=bars_on_instruments.instruments(values, signal),
        columns=columns,
        checks=(
            Check(
                "grey bar of 75 %", float(found["luminance read, IRE"][0]), "IRE", at_least=76.8, at_most=77.0
            ),
            Check(
                "highest level of the 75 % bars", float(found["highest, IRE"][:7].max()), "IRE", at_most=100.5
            ),
            Check(
                "carrier of −I and of the burst, peak to peak",
                float(found["carrier read, IRE peak to peak"][at]),
                "IRE",
                at_least=39.9,
                at_most=40.1,
            ),
            Check(
                "luminance of −I, that of black",
                float(found["luminance read, IRE"][at]),
                "IRE",
                at_least=7.4,
                at_most=7.6,
            ),
            Check("smallest signal of red, green and blue", float(values.min()), at_most=-0.1),
        ),
    )


PLATE = Plate(
    number="5.16",
    title="EIA colour bars of an encoder",
    shows="The pattern of EIA RS-189-A as an encoder makes it: seven bars of 75 % by falling luminance, and below "
    "them −I, white of 100 %, +Q and black; levels in IRE, with black at the setup of 7.5.",
    claim="The bars of 75 % stay within 100 IRE, and −I and +Q are carriers of the burst's 40 IRE on black: colours "
    "that need signals below zero, which no frame buffer holds.",
    today="Digital systems have no setup and no subcarrier; the pattern lives on in SMPTE RP 219. Here it is encoded "
    "to samples at four times the subcarrier, and its levels are read back from them.",
    draw=draw,
    commands=("illuminant pattern eia -o bars.png", "illuminant video scope bars.png -o line.png --line 100"),
)
