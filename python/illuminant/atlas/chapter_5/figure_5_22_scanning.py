"""Figure 5.22: how a frame of NTSC is scanned, and the time that a line takes (book 5.5, eq 5.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINES = 11
"""Of the raster that is drawn: odd, as 525 is, and few enough to be counted."""


def _raster(axes: Axes) -> None:
    """Two fields of 5½ lines, the beam's way back between lines and between fields."""
    from illuminant.plots.style import line_look

    half = LINES / 2
    for field, name in enumerate(("first field", "second field")):
        colour = line_look(field)["color"]
        done = 0.0
        while done < half - 1e-9:
            # The second field begins, and the first ends, in the middle of a line.
            begin = 0.5 if field == 1 and done == 0.0 else 0.0
            end = min(1.0, begin + half - done)
            y = 2.0 * (done + field * half)
            y -= LINES * field
            label = name if done == 0.0 else None
            axes.plot([begin, end], [y + 0.0, y + 2.0 * (end - begin)], color=colour, label=label)
            done += end - begin
            if done < half - 1e-9:
                axes.plot(
                    [end, 0.0], [y + 2.0 * (end - begin)] * 2, color=colour, linewidth=0.7, linestyle=":"
                )
        last = 0.5 if field == 0 else 1.0
        axes.plot(
            [last, 0.5 if field == 0 else 0.0], [LINES, 0.0], color=colour, linewidth=0.9, linestyle="--"
        )
    axes.plot([], [], color="#555555", linewidth=0.9, linestyle="--", label="vertical retrace, blanked")
    axes.plot([], [], color="#555555", linewidth=0.7, linestyle=":", label="horizontal retrace, blanked")
    axes.invert_yaxis()
    axes.set_axis_off()
    axes.set_title(f"Two fields of {LINES / 2:g} lines each")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.01), ncols=2)


def draw(quick: bool) -> Sheet:
    """Left the way of the beam in a frame of eleven lines; right the level of a line over its time."""
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant.display.video.composite import encode
    from illuminant.display.video.scopes import waveform
    from illuminant.display.video.standard import (
        ACTIVE,
        ACTIVE_US,
        BLANKING_US,
        FIRST_ACTIVE,
        SAMPLE_MHZ,
        SAMPLES,
        Raster,
        cycles,
        line_time_us,
    )
    from illuminant.plots.style import DPI, GREY, line_look

    ramp = np.repeat(np.linspace(0.0, 1.0, ACTIVE)[None, :, None], 4, axis=0).repeat(3, axis=2)
    time, levels = waveform(encode(ramp), 2, finer=4)
    whole, seen_us = line_time_us(), FIRST_ACTIVE / SAMPLE_MHZ
    begin = seen_us - BLANKING_US
    # What follows the fall at its end is drawn before its sync.
    time = np.where(time > seen_us + ACTIVE_US + 0.5, time - SAMPLES / SAMPLE_MHZ, time)
    order = np.argsort(time)
    time, level = time[order], levels[0][order]
    figure = Figure(figsize=(9.0, 4.4), dpi=DPI, layout="constrained", facecolor="white")
    left, axes = figure.subplots(1, 2, width_ratios=(0.8, 1.0))
    _raster(left)
    axes.plot(time, level, linewidth=0.9, color=line_look(0)["color"])
    for start, end, y, text in (
        (begin, begin + whole, 128.0, f"a line: {whole:.2f} µs"),
        (seen_us, seen_us + ACTIVE_US, 113.0, f"seen: {ACTIVE_US:g} µs"),
        (begin, seen_us, 60.0, f"blanked:\n{BLANKING_US:g} µs"),
    ):
        arrow = {"arrowstyle": "<->", "color": GREY, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (end, y), (start, y), arrowprops=arrow)
        axes.text((start + end) / 2, y + 2, text, ha="center", va="bottom", fontsize=8)
    axes.text(2.4, -36, "sync", ha="center", fontsize=8)
    axes.text(6.7, 24, "burst", ha="center", fontsize=8)
    axes.set(
        xlabel="time from the leading edge of sync, µs", ylabel="level, IRE", xlim=(-3, 64), ylim=(-45, 140)
    )
    axes.set_yticks(range(-40, 121, 20))
    axes.grid(True)
    axes.set_title("One line, from black to white")
    raster = Raster()
    return Sheet(
        picture=figure,
        columns={"time, µs": time, "level, IRE": level},
        checks=(
            Check("time of a line (eq 5.4)", whole, "µs", at_least=63.45, at_most=63.55),
            Check(
                "blanked and seen together, less a line",
                abs(BLANKING_US + ACTIVE_US - whole),
                "µs",
                at_most=0.05,
            ),
            Check("lines that are seen", raster.visible, at_least=483, at_most=483),
            Check("fields a second", raster.fields_per_second, at_least=60.0, at_most=60.0),
            Check("cycles of 4.2 MHz in the seen part", cycles(4.2), at_least=220.5, at_most=221.5),
        ),
    )


PLATE = Plate(
    number="5.22",
    title="Scanning of an NTSC frame",
    shows="A frame is scanned in two fields of 262½ lines, drawn here with eleven lines in place of 525; dotted and "
    "dashed the way back of the blanked beam. Right: the level of a line over its time, $\\frac{1}{525\\cdot "
    "30}\\,\\mathrm{s} = 63.49\\,\\mathrm{\\mu s}$ (eq 5.4).",
    claim="A line takes 63.5 µs, of which 52.6 are seen after 10.9 of blanking; 483 of 525 lines are seen, and as "
    "their number is odd, the lines of the second field fall between those of the first.",
    today="With colour a frame takes 1.001/30 s and a line 63.556 µs, by which the subcarrier has 227.5 cycles in a "
    "line and turns over from line to line. Displays of today show whole frames.",
    draw=draw,
    commands=("illuminant video fields --help", "illuminant video scope room.png -o line.png --line 100"),
)
