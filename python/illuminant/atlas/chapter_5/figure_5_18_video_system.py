"""Figure 5.18: a completely configured video system, as a chain with the numbers of four colours at each station."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from illuminant.atlas.chapter_5.signal_chain import Stations

COLOURS = {
    "white": (1.0, 1.0, 1.0),
    "skin": (0.53, 0.33, 0.24),
    "leaf": (0.07, 0.19, 0.04),
    "deep blue": (0.03, 0.04, 0.35),
}
"""Linear RGB of the NTSC primaries."""

STATIONS = ("image", "frame buffer", "line", "encoder", "composite", "receiver", "guns", "light")
UNITS = (
    "linear R G B",
    "codes, 8 bits",
    "R G B, parts of white",
    "Y I Q",
    "IRE, low to high",
    "Y I Q",
    "R G B",
    "X Y Z",
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


def _cells(found: Stations) -> list[str]:
    def triple(values: object, form: str = "{:.3f}") -> str:
        return "\n".join(form.format(float(value)) for value in values).replace("-", "−")  # type: ignore[attr-defined]

    low, high = found.composite
    return [
        triple(found.linear),
        triple(found.codes, "{:.0f}"),
        triple(found.line),
        triple(found.yiq + 0.0, "{:+.3f}"),
        f"{low:.1f}\nto\n{high:.1f}".replace("-", "−"),
        triple(found.received.round(6) + 0.0, "{:+.3f}"),
        triple(found.rgb),
        triple(found.xyz, "{:.1f}"),
    ]


def _chain(axes: Axes, chains: dict[str, Stations]) -> None:
    """Boxes from left to right, arrows with what is done between them, and the numbers of each colour below."""
    from illuminant.display.displays import named
    from illuminant.plots.style import GREY, INK

    display = named("sRGB")
    axes.set(xlim=(-0.95, len(STATIONS) - 0.42), ylim=(-len(chains) - 0.15, 1.35))
    axes.set_axis_off()
    for k, (station, unit) in enumerate(zip(STATIONS, UNITS, strict=True)):
        box = {"boxstyle": "round,pad=0.35", "facecolor": "#eef3f8", "edgecolor": GREY, "linewidth": 0.8}
        axes.text(k, 1.0, station, ha="center", va="center", fontsize=8, bbox=box)
        axes.text(k, 0.38, unit.replace(", ", ",\n"), ha="center", va="center", fontsize=6.8, color=GREY)
        if k:
            axes.annotate("", (k - 0.4, 0.72), (k - 0.6, 0.72), arrowprops={"arrowstyle": "->", "color": INK})
            axes.text(k - 0.5, 1.26 if k % 2 else 1.26, BETWEEN[k - 1], ha="center", fontsize=6.2, color=INK)
    for row, (name, found) in enumerate(chains.items()):
        y = -row - 0.5
        axes.axhline(y + 0.5, color="#dddddd", linewidth=0.6)
        patch = display.encode(found.linear)
        axes.add_patch(_patch(-0.9, y - 0.18, tuple(float(part) for part in patch)))
        axes.text(-0.72, y + 0.3, name, ha="center", va="center", fontsize=7.5)
        for k, cell in enumerate(_cells(found)):
            axes.text(k, y, cell, ha="center", va="center", fontsize=7.8, linespacing=1.25)
        axes.text(
            len(STATIONS) - 0.46, y + 0.36, f"ΔE00 {found.delta_e:.2f}", ha="right", fontsize=6.5, color=GREY
        )


def _patch(x: float, y: float, colour: tuple[float, ...]) -> object:
    from matplotlib.patches import Rectangle

    return Rectangle((x, y), 0.36, 0.36, facecolor=colour, edgecolor="#555555", linewidth=0.5)
