"""Figure 5.17: the EIA colour bars for a frame buffer, with −I and +Q lifted until no signal is negative (book 5.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from numpy.typing import NDArray


def draw(quick: bool) -> Sheet:
    """The pattern, its waveform and its vectors."""
    import numpy as np

    from illuminant.atlas.chapter_5 import bars_on_instruments
    from illuminant.display.patterns.color_bars import bar_levels
    from illuminant.display.video.composite import encode

    values = bars_on_instruments.screen_of_bars(encoded=False)
    signal = encode(values)
    columns = bars_on_instruments.columns(signal, bar_levels(lift=True))
    encoder = bars_on_instruments.columns(
        encode(bars_on_instruments.screen_of_bars(encoded=True)), bar_levels(lift=False)
    )
    rows = [columns["bar"].index(name) for name in ("-I", "+Q")]

    def read(table: dict[str, Any], name: str) -> NDArray[np.float64]:
        return np.array([float(table[name][row]) for row in rows])

    luminance, hue, carrier = "luminance read, IRE", "hue read, degrees", "carrier read, IRE peak to peak"
    return Sheet(
        picture=bars_on_instruments.instruments(values, signal),
        columns=columns,
        checks=(
            Check("smallest signal of red, green and blue", float(values.min()), at_least=0.0, at_most=1e-12),
            Check(
                "turn of −I and +Q",
                float(np.abs(read(columns, hue) - read(encoder, hue)).max()),
                "degrees",
                at_most=0.1,
            ),
            Check(
                "change of their carriers",
                float(np.abs(read(columns, carrier) - read(encoder, carrier)).max()),
                "IRE",
                at_most=0.1,
            ),
            Check("rise of +Q", float(read(columns, luminance)[1]) - 7.5, "IRE", at_least=10.0, at_most=16.0),
            Check("rise of −I", float(read(columns, luminance)[0]) - 7.5, "IRE", at_least=16.0, at_most=22.0),
        ),
    )


PLATE = Plate(
    number="5.17",
    title="EIA colour bars for a frame buffer",
    shows="The bars of figure 5.16 as they are loaded into a frame buffer through linear tables: to −I and +Q as "
    "much $Y_t$ is added as leaves no signal below zero.",
    claim="With luminance added, −I and +Q can be loaded into a frame buffer: the waveform rises by 19 and 13 IRE, "
    "and the vectorscope shows what it showed.",
    today="The same lift, for systems without setup, is in SMPTE RP 219: (0, 0.2456, 0.4125) and (0.2536, 0, "
    "0.4703), which `--setup 0` gives.",
    draw=draw,
    commands=(
        "illuminant pattern eia --size 512x486 -o bars.png",
        "illuminant pattern eia --setup 0 -o rp219.png",
    ),
)
