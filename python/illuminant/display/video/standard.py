"""The times, the lines and the levels of an NTSC signal (book 5.5; eq 5.4, figure 5.22).

    time of a line = 1 / (525 lines · 30 frames a second) = 63.49 µs           (eq 5.4)
    seen of it     = time of a line − horizontal blanking = 63.49 − 10.9 = 52.6 µs
    cycles in it   = bandwidth · 52.6 µs: Y 220.9 (4.2 MHz), I 68.4 (1.3 MHz), Q 26.3 (0.5 MHz)

Two pixels make a cycle, so a line holds 442 pixels at most: whatever an image has beyond them is lost on the way.

Since colour was added, a frame takes 1.001/30 s, so that a line holds 227.5 cycles of the colour subcarrier and is
63.556 µs long; the composite signal of `composite` has those times, and samples at four times the subcarrier, 910 a
line. The half cycle turns the subcarrier over from line to line and, as 525 is odd, from frame to frame.

A frame of 525 lines is traced as two fields of 262.5. The lines of vertical blanking (20 or 21 a field) are not seen:
485 or 483 remain. As each field starts or ends in mid-line, the first and the last line of the picture are halves, and
a frame buffer holds one line more than is seen: 484 for 483 (book footnote 20).

Levels are in IRE, hundredths from blanking to white: sync −40, blanking 0, black 7.5 (the setup of 1953), white 100,
burst 20 to both sides.

Sources: book 5.3 and 5.5; FCC 1953 (47 CFR 73.682); EIA RS-170 (1957); SMPTE 170M (2004).

Example:
    >>> round(line_time_us(), 2), round(pixel_limit())
    (63.49, 442)
    >>> Raster().visible, Raster().stored
    (483, 484)
"""

from __future__ import annotations

from dataclasses import dataclass

from illuminant.errors import UsageError

__all__ = [
    "ACTIVE",
    "ACTIVE_US",
    "BANDWIDTH",
    "BLANKING_US",
    "FIRST_ACTIVE",
    "SAMPLES",
    "SAMPLE_MHZ",
    "SUBCARRIER_MHZ",
    "Bandwidth",
    "Levels",
    "Raster",
    "cycles",
    "line_time_us",
    "pixel_limit",
]

SUBCARRIER_MHZ = 315.0 / 88.0
"""Of the colour, 3.579545 MHz."""

SAMPLE_MHZ = 4.0 * SUBCARRIER_MHZ
"""Of the composite signal, 14.318182 MHz."""

SAMPLES = 910
"""Of a whole line: 227.5 cycles of the subcarrier."""

ACTIVE = 754
"""Of the part of a line that is seen: 52.66 µs."""

FIRST_ACTIVE = 134
"""Number of the first sample that is seen; a line begins with the leading edge of its sync."""

BLANKING_US = 10.9
"""Horizontal blanking (EIA RS-170)."""

ACTIVE_US = 52.6
"""What the standard leaves of a line to be seen."""


@dataclass(frozen=True)
class Bandwidth:
    """Up to which frequencies Y, I and Q pass, in MHz; see `filters` for what that means.

    Raises:
        UsageError: Y is not from 0.1 to 6 MHz, or I or Q not from 0.1 to 1.4.
    """

    y: float = 4.2
    i: float = 1.3
    q: float = 0.5

    def __post_init__(self) -> None:
        for name, mhz, most in (("Y", self.y, 6.0), ("I", self.i, 1.4), ("Q", self.q, 1.4)):
            if not 0.1 <= mhz <= most:
                raise UsageError(f"The bandwidth of {name} is {mhz:g} MHz: expected 0.1 to {most:g}.")


BANDWIDTH = Bandwidth()
"""Of the standard."""


@dataclass(frozen=True)
class Levels:
    """Levels of the composite signal in IRE.

    Attributes:
        setup: black; 7.5, or 0 as in Japan and as the book's footnote 16 says was proposed.
        white, blanking, sync: as they say.
        burst: amplitude, to both sides of blanking.

    Raises:
        UsageError: setup is not from 0 to 20.

    Example:
        >>> Levels().of(0.0), Levels().of(1.0)
        (7.5, 100.0)
    """

    setup: float = 7.5
    white: float = 100.0
    blanking: float = 0.0
    sync: float = -40.0
    burst: float = 20.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.setup <= 20.0:
            raise UsageError(f"A setup of {self.setup:g} IRE is not usable: expected 0 to 20.")

    @property
    def range(self) -> float:
        """From black to white, IRE; 92.5."""
        return self.white - self.setup

    def of(self, y: float) -> float:
        """IRE of a luminance from 0 to 1."""
        return self.setup + self.range * y


def line_time_us(lines: int = 525, frames_per_second: float = 30.0) -> float:
    """How long a line takes, with its blanking (book eq 5.4).

    Raises:
        UsageError: lines or frames are not positive.

    Example:
        >>> round(line_time_us(frames_per_second=30 / 1.001), 3)
        63.556
    """
    if not (lines > 0 and frames_per_second > 0):
        raise UsageError("The time of a line needs lines and frames above 0.")
    return 1e6 / (lines * frames_per_second)


def cycles(mhz: float, active_us: float = ACTIVE_US) -> float:
    """How many cycles of a frequency the seen part of a line holds.

    Example:
        >>> [round(cycles(mhz), 1) for mhz in (4.2, 1.3, 0.5)]
        [220.9, 68.4, 26.3]
    """
    return mhz * active_us


def pixel_limit(mhz: float = 4.2, active_us: float = ACTIVE_US) -> float:
    """How many pixels a line can hold at a bandwidth: two a cycle.

    Example:
        >>> round(pixel_limit()), round(pixel_limit(0.5))
        (442, 53)
    """
    return 2.0 * cycles(mhz, active_us)


@dataclass(frozen=True)
class Raster:
    """How a frame is made of lines.

    Attributes:
        lines: of a frame; odd, so that the second field falls between the lines of the first.
        blanked: lines of vertical blanking in each field, 21 or 20.
        frames_per_second: 30, or 30/1.001 with colour.

    Raises:
        UsageError: an even number of lines cannot interlace, or the blanking leaves no line.

    Example:
        >>> Raster(blanked=20).visible, Raster().fields_per_second
        (485, 60.0)
    """

    lines: int = 525
    blanked: int = 21
    frames_per_second: float = 30.0

    def __post_init__(self) -> None:
        if self.lines % 2 == 0:
            raise UsageError(f"{self.lines} lines do not interlace: expected an odd number, such as 525.")
        if not 0 <= 2 * self.blanked < self.lines:
            raise UsageError(f"{self.blanked} blanked lines a field leave none of {self.lines} to be seen.")

    @property
    def lines_per_field(self) -> float:
        """With a half: 262.5."""
        return self.lines / 2

    @property
    def visible(self) -> int:
        """Lines that are seen, two halves of which count as one."""
        return self.lines - 2 * self.blanked

    @property
    def stored(self) -> int:
        """Lines of a frame buffer, half of whose first and last are not shown."""
        return self.visible + 1

    @property
    def fields_per_second(self) -> float:
        """Pictures a second, each of every other line."""
        return 2 * self.frames_per_second

    @property
    def line_us(self) -> float:
        """Time of a line."""
        return line_time_us(self.lines, self.frames_per_second)

    def line_number(self, row: int) -> int:
        """The line of the frame, from 1, that carries a row of a picture, from 0.

        Rows 0, 2, 4 … are the first field (the book's odd lines, counted from 1), rows 1, 3, 5 … the second, which
        begins half a frame later.

        Example:
            >>> [Raster(blanked=20).line_number(row) for row in (0, 1, 2, 3)]
            [21, 284, 22, 285]
        """
        return 1 + self.blanked + row // 2 + (row % 2) * (self.lines + 1) // 2
