"""Turning a monitor's knobs until its greys are D6500 at all levels: steps 2 to 4 of book 5.4, by readings alone.

2. White: contrast and gains are turned until a white field has the chromaticity and luminance of the reference; then
   the analyzer is taught this white.
3. Grey scale: with a field of low intensity the biases are turned until the analyzer's red, green and blue are alike,
   with a white field the gains, and again, until nothing is left to turn. Where a monitor has tracking controls, a
   field between is looked at as well.
4. Levels: brightness by PLUGE, contrast to the luminance of white; then white and grey scale once more.

How far to turn comes from the readings. With a drive d = g v + b and light d^γ, where γ is near 2.2, the logarithm of a
field's light changes by 2.2 for a turn of log g, 2.2/v of b, and log v of tracking. Each round reads all fields and
turns all knobs of a gun together by these numbers, so that they do not undo each other; since the real γ differs, it
takes a few rounds, as it does by hand. From the fourth round on knobs are turned by ever less of it, which averages the
errors of readings.

What "should" means at the low field:

- `levels="gamma"`: the fraction v^γ of white for the code value v, so that the monitor follows a power of a wanted γ;
- `levels="pluge"`: the book's way. Only balance is set with the biases, against green, and brightness is turned down
  until the bar 4 % above black is lost, then up until it appears. An eye sees it when it is 2 % brighter than black,
  above a veil of 1 cd/m² from its surroundings.

The light of the room on the glass is read first, with brightness turned down, and taken off.

Example:
    >>> from illuminant.display.calibration.monitor import Instrument, maladjusted
    >>> done = adjust(Instrument(maladjusted(3, tracking=False), seed=3))
    >>> done.converged, round(float(done.monitor.xyz([1.0, 1.0, 1.0])[1]) / 103.0, 1)
    (True, 1.0)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from illuminant.display.calibration.analyzer import Analyzer
from illuminant.display.calibration.monitor import D6500, WHITE_LUMINANCE, Instrument, Monitor, Triple
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["LEVELS", "Adjustment", "Round", "adjust", "pluge_visible"]

LEVELS = ("gamma", "pluge")

LOW, MIDDLE = 0.2, 0.5
"""Code values of the fields of low and of middle intensity."""

TYPICAL_GAMMA = 2.2
MEMORY = "white"

VEIL, VISIBLE = 1.0, 0.02
"""cd/m² that an eye adds to a dark bar, and the fraction by which another must be brighter to be seen."""


class Round(NamedTuple):
    """Balance after one round of step 3: the largest difference of a channel from what it should be, as a fraction.

    Attributes:
        low, middle, white: at the three fields; middle is 0 without tracking controls.
    """

    low: float
    middle: float
    white: float


@dataclass(frozen=True)
class Adjustment:
    """What was done.

    Attributes:
        monitor: with its knobs as they were left.
        rounds: balance after each.
        converged: nothing was left to turn.
        readings: how many were made.
    """

    monitor: Monitor
    rounds: tuple[Round, ...]
    converged: bool
    readings: int


def pluge_visible(black: float, brighter: float) -> bool:
    """Whether an eye tells the bar 4 % above black from black; luminances in cd/m².

    Example:
        >>> pluge_visible(0.2, 0.21), pluge_visible(0.2, 0.25)
        (False, True)
    """
    return brighter - black > VISIBLE * (black + VEIL)


def adjust(
    instrument: Instrument,
    *,
    white: tuple[float, float] = D6500,
    luminance: float = WHITE_LUMINANCE,
    gamma: float = TYPICAL_GAMMA,
    levels: str = "gamma",
    tracking: bool = False,
    analyzer: Analyzer | None = None,
    repeat: int = 3,
    most_rounds: int = 20,
) -> Adjustment:
    """Adjust a monitor; the instrument's monitor is left with its new knobs.

    Args:
        instrument: looks at the monitor; nothing but its readings is used.
        white, luminance: of the reference.
        gamma: wanted, with `levels="gamma"`.
        levels: "gamma" or "pluge".
        tracking: whether the monitor has tracking controls.
        analyzer: with its memories; the white is taught to "white".
        repeat: readings averaged at each field.
        most_rounds: before giving up.

    Raises:
        UsageError: levels are not known, or an argument is not possible.
    """
    import numpy as np

    from illuminant import color

    if levels not in LEVELS:
        raise UsageError(f"Levels are set by {' or '.join(LEVELS)}, not {levels!r}.")
    if not (luminance > 0.0 and gamma > 0.5 and repeat >= 1 and most_rounds >= 1):
        raise UsageError("Luminance, γ, readings and rounds of an adjustment are above 0.")
    bench = _Bench(instrument, analyzer or Analyzer(), repeat)
    before = instrument.count
    bench.read_room()
    # Step 2. The comparator's reference, as the sensors see it, is what white is turned to.
    bench.analyzer.teach(MEMORY, np.array(color.white_xyz(white)) * luminance)
    for _ in range(6):
        bench.turn_white()
    rounds: list[Round] = []
    converged = False
    for _ in range(most_rounds):
        if levels == "pluge":
            bench.set_brightness()
        part = 1.0 if len(rounds) < 4 else 3.0 / len(rounds)
        bench.turn([LOW, MIDDLE, 1.0] if tracking else [LOW, 1.0], gamma, levels, part)
        if levels == "pluge":
            bench.turn_contrast()
        rounds.append(_balance(bench, gamma, levels, tracking))
        # Some errors of a reading are as near as readings can tell.
        near = 3.5 * instrument.relative / repeat**0.5 + 0.001
        dark = near + 2.0 * instrument.floor / repeat**0.5 / (LOW**TYPICAL_GAMMA * luminance)
        if rounds[-1].low < dark and rounds[-1].middle < near and rounds[-1].white < near:
            converged = True
            break
    return Adjustment(instrument.monitor, tuple(rounds), converged, instrument.count - before)


def _wanted(seen: Array, code: float, gamma: float, levels: str) -> Array:
    """What the analyzer should show: all alike, at the level of a power law or at that of green."""
    import numpy as np

    # A power law at code 1 is 1, whatever its γ.
    level = code**gamma if levels == "gamma" else max(float(seen[1]), 1e-6)
    return np.full(3, level)


def _balance(bench: _Bench, gamma: float, levels: str, tracking: bool) -> Round:
    import numpy as np

    def off(code: float) -> float:
        seen = bench.seen(code)
        wanted = _wanted(seen, code, gamma, levels) if code < 1.0 else np.ones(3)
        return float(np.abs(seen / wanted - 1.0).max())

    return Round(off(LOW), off(MIDDLE) if tracking else 0.0, off(1.0))


class _Bench:
    """Monitor, instrument and analyzer side by side, and the turning of knobs."""

    def __init__(self, instrument: Instrument, analyzer: Analyzer, repeat: int) -> None:
        self.instrument, self.analyzer, self.repeat = instrument, analyzer, repeat
        self.room: Array | None = None

    def measure(self, code: float) -> Array:
        return self.instrument.measure([code] * 3, self.repeat)

    def read_room(self) -> None:
        """The light of the room, read from a black field with brightness turned down."""
        monitor = self.instrument.monitor
        self.instrument.monitor = replace(monitor, brightness=monitor.brightness - 0.3)
        self.room = self.measure(0.0)
        self.instrument.monitor = monitor

    def seen(self, code: float) -> Array:
        """What the analyzer shows of a neutral field, without the room."""
        assert self.room is not None
        return self.analyzer.read(self.measure(code) - self.room, MEMORY)

    def turn_white(self) -> None:
        """Gains by a white field: step 2."""
        import numpy as np

        self._turn_gains(np.clip(np.maximum(self.seen(1.0), 1e-3) ** (-1.0 / TYPICAL_GAMMA), 0.5, 2.0))

    def turn_contrast(self) -> None:
        """Contrast by green in a white field: step 4."""
        monitor, green = self.instrument.monitor, max(float(self.seen(1.0)[1]), 1e-3)
        turn = green ** (-1.0 / TYPICAL_GAMMA)
        self.instrument.monitor = replace(monitor, contrast=monitor.contrast * turn)

    def _turn_gains(self, turn: Array) -> None:
        """Contrast takes what all three have in common, the gains the balance; green keeps its gain."""
        import numpy as np

        monitor = self.instrument.monitor
        gain = np.array(monitor.gain) * turn / turn[1]
        self.instrument.monitor = replace(
            monitor, contrast=float(monitor.contrast * turn[1]), gain=_triple(gain)
        )

    def turn(self, fields: list[float], gamma: float, levels: str, part: float) -> None:
        """One round of step 3: gain and bias, and tracking when three fields are given, of each gun."""
        import numpy as np

        monitor = self.instrument.monitor
        ratios = []
        for code in fields:
            seen = self.seen(code)
            wanted = _wanted(seen, code, gamma, levels)
            # A gun that is cut off shows nothing of how far it is below: turn it up a step.
            ratios.append(np.log(np.clip(wanted / np.maximum(seen, 1e-6), 0.2, 5.0)))
        v = np.array(fields)
        columns = [np.full_like(v, TYPICAL_GAMMA), TYPICAL_GAMMA / v, np.log(v)][: len(fields)]
        turned = np.linalg.solve(np.stack(columns, axis=1), np.array(ratios)) * part
        if len(fields) > 2:
            limited = np.clip(turned[2], -0.3, 0.3)
            monitor = replace(monitor, tracking=_triple(np.array(monitor.tracking) + limited))
        self.instrument.monitor = replace(monitor, bias=_triple(np.array(monitor.bias) + turned[1]))
        self._turn_gains(np.exp(turned[0]))

    def set_brightness(self) -> None:
        """Brightness by PLUGE: down until the brighter bar is lost, then up until it appears."""

        def visible(brightness: float) -> bool:
            self.instrument.monitor = replace(self.instrument.monitor, brightness=brightness)
            return pluge_visible(float(self.measure(0.0)[1]), float(self.measure(0.04)[1]))

        step, at = 0.004, self.instrument.monitor.brightness
        for _ in range(60):
            if not visible(at):
                break
            at -= step
        for _ in range(60):
            at += step / 2
            if visible(at):
                break


def _triple(values: Array) -> Triple:
    r, g, b = values.tolist()
    return r, g, b
