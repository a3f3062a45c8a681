"""The six steps of a calibration, with the patterns they need and what must hold before the next (book 5.4).

Each step is data: a title, what to do, the patterns of `illuminant.display.patterns` to show, and pass criteria. The
words are for a monitor with knobs; `modern` says what takes their place on a display without.

Sources: book 5.4, after SMPTE RP 71-1977 and Kane (1987).

Example:
    >>> [step.title for step in STEPS][:3]
    ['Preparation', 'White point', 'Grey scale']
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["STEPS", "Step"]


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes:
        title: its name.
        todo: what to do, a sentence each.
        patterns: names of patterns, with options as on the command line.
        passes: what must hold.
        modern: what to do where there are no such knobs.
    """

    title: str
    todo: tuple[str, ...]
    patterns: tuple[str, ...]
    passes: tuple[str, ...]
    modern: str


STEPS = (
    Step(
        "Preparation",
        (
            "Put the monitor where it will be used, and let it warm up for 30 minutes or more with a black field.",
            "Make the surround neutral: grey walls, light near D6500, at most 3 foot-candles (32 lx) on the screen, "
            "and nothing in view brighter than 10 % of the screen's white.",
            "Keep bright patterns such as colour bars off a tube except while they are needed.",
            "Set convergence, linearity, centring and size first.",
            "One person with normal colour vision makes all judgements by eye, in this light.",
        ),
        ("black", "crosshatch", "dots"),
        (
            "on for 30 minutes: white changes by less than 1 % in 5 minutes",
            "white lines have no coloured edges, and squares are square",
        ),
        "Turn off dynamic contrast, ambient light sensors, night colours and power saving.",
    ),
    Step(
        "White point",
        (
            "Show a white window no larger than the head of the instrument.",
            "Match its luminance to the comparator's white with contrast, and its colour with the gains.",
            "Teach this white to the analyzer, in the memory for this type of monitor.",
        ),
        ("window --color 1 --window 0.3",),
        (
            "white within 0.004 in u', v' of x, y = 0.3127, 0.3290 (D6500)",
            "the analyzer's three scales line up",
        ),
        "Choose the preset nearest to 6500 K; turn the RGB gains of its menu down, never all up.",
    ),
    Step(
        "Grey scale",
        (
            "Show a window of low intensity and turn the biases until the scales line up.",
            "Show the white window and turn the gains until they line up.",
            "Go back and forth until nothing is left to turn; leave slow phosphors time to settle.",
            "With tracking controls, look at intensities between as well.",
        ),
        ("window --color 0.2", "window --color 0.5", "window --color 1", "steps", "gamma"),
        (
            "greys from 2 % of white up within 0.006 in u', v' of white",
            "the grey row of the gamma chart has no tint",
        ),
        "Leave the monitor alone: the description that is fitted to readings corrects the greys.",
    ),
    Step(
        "Black and white levels",
        (
            "Show PLUGE. With video levels, turn brightness until the bar below black is lost in black and the bar "
            "above it is seen.",
            "On a frame buffer, turn brightness down until the bar above black is lost, then up until it appears.",
            "Show the white window, and turn contrast until it has 103 cd/m² (30 foot-lamberts); 28 foot-lamberts "
            "(96 cd/m²) spare the phosphors.",
            "Look at PLUGE again, and write down the readings of white and of the low field.",
        ),
        ("pluge", "pluge --levels video", "window --color 1", "window --color 0.2"),
        ("white 103 cd/m² within 10 %", "the bar 4 % above black is just seen", "black 1 % of white or less"),
        "The backlight sets white; leave contrast and black level where no code near 0 or full is lost.",
    ),
    Step(
        "Chroma and hue",
        (
            "Only for a monitor that decodes NTSC. Show the SMPTE bars with red and green off, or look at them "
            "through a blue filter (Wratten 50).",
            "Turn chroma until the split vanishes in the outer bars, hue until it does in the inner, and again.",
        ),
        ("smpte", "smpte --blue-only"),
        ("no split is seen in blue alone",),
        "A display that is driven with RGB has nothing to set here.",
    ),
    Step(
        "Recalibration",
        (
            "Once a month bring white and low field back to the recorded readings with the analyzer; sooner when "
            "they had moved far.",
            "After six months to a year go through all steps with the comparator or a colorimeter.",
            "Write readings into the record each time: `illuminant calibrate log`.",
        ),
        ("window --color 1", "window --color 0.2"),
        ("less than ΔE00 1 since the last record",),
        "The same: a backlight ages as a tube does. Measure and fit again.",
    ),
)
"""The steps in order."""
