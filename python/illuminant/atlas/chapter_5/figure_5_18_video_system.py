"""Figure 5.18: a completely configured video system, as a chain with the numbers of four colours at each station."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch
    from numpy.typing import NDArray

    from illuminant.atlas.chapter_5.signal_chain import Stations

COLOURS = {
    "white": (1.0, 1.0, 1.0),
    "skin": (0.53, 0.33, 0.24),
    "leaf": (0.07, 0.19, 0.04),
    "deep blue": (0.03, 0.04, 0.35),
}
"""Linear RGB of the NTSC primaries."""

STATIONS = (
    "image",
    "frame buffer",
    "line",
    "encoder",
    "composite",
    "receiver",
    "guns",
    "light",
    "ΔE00",
)
UNITS = (
    "linear R G B",
    "codes, 8 bits",
    "R G B, parts\nof white",
    "Y I Q",
    "IRE, lowest\nto highest",
    "Y I Q",
    "R G B",
    "X Y Z",
    "right, line\nended twice,\nhue 10° off",
)
BETWEEN = (
    "γ 2.2, rounded",
    "amplifier, 75 Ω",
    "eq 5.2",
    "setup, subcarrier",
    "burst, comb",
    "eq 5.3",
    "γ 2.2",
)


def _three(values: NDArray[np.float64], form: str = "{:.3f}") -> str:
    return "\n".join(form.format(float(value)) for value in values).replace("-", "−")


def _cells(found: Stations, faulty: Sequence[Stations]) -> list[str]:
    """The numbers of a colour, in the order of the stations."""
    low, high = found.composite
    return [
        _three(found.linear),
        _three(found.codes, "{:.0f}"),
        _three(found.line),
        _three(found.yiq.round(6) + 0.0),
        f"{low:.1f}\nto\n{high:.1f}".replace("-", "−"),
        _three(found.received.round(6) + 0.0),
        _three(found.rgb),
        _three(found.xyz, "{:.1f}"),
        "\n".join(f"{one.delta_e:.1f}" for one in (found, *faulty)),
    ]


def _chain(axes: Axes, chains: dict[str, Stations], faulty: dict[str, list[Stations]]) -> None:
    """Boxes from left to right, arrows with what is done between them, and the numbers of each colour below."""
    from illuminant.atlas.chapter_5.still_life import seen
    from illuminant.plots.style import GREY, INK

    axes.set(xlim=(-1.0, len(STATIONS) - 0.4), ylim=(-len(chains) - 0.05, 1.75))
    axes.set_axis_off()
    for k, (station, unit) in enumerate(zip(STATIONS, UNITS, strict=True)):
        box = {"boxstyle": "round,pad=0.35", "facecolor": "#e4edf6", "edgecolor": GREY, "linewidth": 0.8}
        axes.text(k, 0.9, station, ha="center", va="center", fontsize=8, bbox=box)
        axes.text(k, 0.3, unit, ha="center", va="center", fontsize=7, color=GREY)
        if 0 < k <= len(BETWEEN):
            arrow = {"arrowstyle": "->", "color": INK, "linewidth": 0.9, "connectionstyle": "arc3,rad=-0.35"}
            axes.annotate("", (k - 0.25, 1.08), (k - 0.75, 1.08), arrowprops=arrow)
            axes.text(k - 0.5, 1.34, BETWEEN[k - 1], ha="center", va="bottom", fontsize=7, color=INK)
    for row, (name, found) in enumerate(chains.items()):
        y = -row - 0.5
        axes.axhline(y + 0.5, color="#d5d5d5", linewidth=0.6)
        axes.add_patch(
            _patch(-0.9, y - 0.28, tuple(float(part) / 255 for part in seen(found.rgb[None, None])[0, 0]))
        )
        axes.text(-0.9, y + 0.28, name, ha="left", va="center", fontsize=7.5)
        for k, cell in enumerate(_cells(found, faulty[name])):
            axes.text(k, y, cell, ha="center", va="center", fontsize=8, linespacing=1.3)


def _patch(x: float, y: float, colour: tuple[float, ...]) -> Patch:
    from matplotlib.patches import Rectangle

    return Rectangle((x, y), 0.36, 0.36, facecolor=colour, edgecolor="#555555", linewidth=0.5)


def draw(quick: bool) -> Sheet:
    """The chain; in the data also what a second terminator and a hue control that is off do to it."""
    import numpy as np

    from illuminant.atlas.chapter_5.signal_chain import passed
    from illuminant.plots.style import new_figure

    chains = {name: passed(linear) for name, linear in COLOURS.items()}
    double = {name: passed(linear, terminators=2) for name, linear in COLOURS.items()}
    turned = {name: passed(linear, hue_deg=10.0) for name, linear in COLOURS.items()}
    figure, axes = new_figure((9.0, 4.9))
    _chain(axes, chains, {name: [double[name], turned[name]] for name in chains})
    columns: dict[str, list[float] | list[str]] = {"colour": list(COLOURS)}
    for name in ("linear", "codes", "line", "yiq", "received", "rgb", "xyz"):
        for k in range(3):
            columns[f"{name} {k + 1}"] = [float(getattr(one, name)[k]) for one in chains.values()]
    for k, name in enumerate(("lowest, IRE", "highest, IRE")):
        columns[name] = [one.composite[k] for one in chains.values()]
    columns["ΔE00"] = [one.delta_e for one in chains.values()]
    columns["ΔE00, two terminators"] = [one.delta_e for one in double.values()]
    columns["ΔE00, hue 10° off"] = [one.delta_e for one in turned.values()]
    drift = max(float(np.abs(one.received - one.yiq).max()) for one in chains.values())
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check(
                "largest ΔE00 between computed and shown",
                max(one.delta_e for one in chains.values()),
                at_most=1.0,
            ),
            Check("largest change of Y, I, Q in the composite signal", drift, at_most=1e-6),
            Check("level of white, one terminator", chains["white"].composite[1], "IRE", 99.99, 100.01),
            Check("level of white, two terminators", double["white"].composite[1], "IRE", 69.0, 69.3),
            Check("ΔE00 of skin, hue 10° off", turned["skin"].delta_e, at_least=2.0),
        ),
    )


PLATE = Plate(
    number="5.18",
    title="A configured video system, in numbers",
    shows="The way of a colour from the computed image through frame buffer, distribution amplifier, encoder and "
    "composite signal to the light of a monitor; in place of the book's block diagram, the same stations with "
    "the numbers of four colours: $R, G, B$ after gamma (eq 5.1), $Y_t, I, Q$ (eq 5.2), the composite signal "
    "in IRE with a setup of 7.5, and $X, Y, Z$ of the light with 100 for white.",
    claim="A system in which all is set right returns the computed colour but for the rounding to 8 bits; a second "
    "terminator on the line lowers white from 100 to 69 IRE, and a hue control that is 10 degrees off is seen "
    "on skin.",
    today="Each station is a function, so that a fault can be put into any of them; digital links have none of these "
    "settings, and the rounding to bits is all that is left of the loss.",
    draw=draw,
    commands=(
        "illuminant video transmit room.png received.png",
        "illuminant video scope room.png -o line.png --line 100",
    ),
)
