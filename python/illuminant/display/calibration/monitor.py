"""A simulated monitor, with the knobs of a real one and the faults of a real one.

Each gun k turns a code value v into light by

    d = contrast · gain_k · v + brightness + bias_k
    l = max(d, 0)^(γ_k + tracking_k) · (1 + bow_k · 4 d (1 − d))

and the screen gives

    XYZ = Σ_k l_k P_k + room

where P_k is XYZ of phosphor k at d = 1: with all three at 1 the white is D6500 at `peak` (book 5.4; γ after eq 5.1).
Bias shifts the neutral near black, gain near white; a difference of γ (tracking) or a bow shifts it between. `room` is
the light of the room on the glass.

A cold monitor is dimmer, and its guns differ: gains are (1 − c_k e^(−t/10 min)) of what they are when warm. At 30
minutes 5 % of the fault is left. `age` makes the drift of months: a random walk of gains and biases.

Units: drive and code values from 0 to 1, cd/m², minutes. Beyond d = 1 a tube goes on by the same law.

References: book 5.4; Berns, Motta and Gorzynski (1993), CRT colorimetry, Color Res. Appl. 18; Berns (1996).

Example:
    >>> monitor = Monitor()
    >>> x, y, z = monitor.xyz([1.0, 1.0, 1.0]).tolist()
    >>> round(y, 1), round(x / (x + y + z), 4), round(y / (x + y + z), 4)
    (103.0, 0.3127, 0.329)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["D6500", "WHITE_LUMINANCE", "Instrument", "Monitor", "maladjusted"]

Triple = tuple[float, float, float]
Pairs = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

WHITE_LUMINANCE = 103.0
"""Luminance of white to which a monitor is set: 30 foot-lamberts, cd/m²."""

D6500 = (0.3127, 0.3290)
"""The reference white."""

TIME_CONSTANT_MINUTES = 10.0

SMPTE_C: Pairs = ((0.630, 0.340), (0.310, 0.595), (0.155, 0.070))

ZEROS: Triple = (0.0, 0.0, 0.0)
ONES: Triple = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Monitor:
    """The knobs and the faults; `replace` of dataclasses turns a knob.

    Attributes:
        bias, gain: knobs of the guns: red, green, blue.
        brightness, contrast: knobs of all guns together.
        tracking: knobs that trim γ of the guns.
        gamma: of the guns.
        bow: how far each gun leaves a power law, at half drive.
        primaries: x and y of the phosphors.
        white: x and y of all three at full drive.
        peak: their luminance, cd/m².
        room: XYZ of the room's light on the glass, cd/m².
        cold: by how much less gain each gun has when it is switched on.
    """

    bias: Triple = ZEROS
    gain: Triple = ONES
    brightness: float = 0.0
    contrast: float = 1.0
    tracking: Triple = ZEROS
    gamma: Triple = (2.2, 2.2, 2.2)
    bow: Triple = ZEROS
    primaries: Pairs = SMPTE_C
    white: tuple[float, float] = D6500
    peak: float = WHITE_LUMINANCE
    room: Triple = ZEROS
    cold: Triple = (0.06, 0.04, 0.08)

    def phosphors(self) -> Array:
        """XYZ (3, 3) of red, green and blue at full drive, in rows, cd/m²."""
        import numpy as np

        from illuminant import color

        return np.asarray(color.monitor(self.primaries, self.white).to_xyz).T * self.peak

    def light(self, codes: ArrayLike, minutes: float = math.inf) -> Array:
        """What each gun gives, 1 for full drive, for code values (..., 3).

        Args:
            codes: code values, 0 to 1.
            minutes: since the monitor was switched on.
        """
        import numpy as np

        warm = 1.0 - np.array(self.cold) * math.exp(-minutes / TIME_CONSTANT_MINUTES)
        drive = self.contrast * np.array(self.gain) * warm * np.asarray(codes, np.float64)
        drive = np.maximum(drive + self.brightness + np.array(self.bias), 0.0)
        bent = 1.0 + np.array(self.bow) * 4.0 * drive * (1.0 - drive)
        return np.asarray(np.maximum(drive ** (np.array(self.gamma) + np.array(self.tracking)) * bent, 0.0))

    def xyz(self, codes: ArrayLike, minutes: float = math.inf) -> Array:
        """XYZ in cd/m² of code values (..., 3), without any instrument."""
        import numpy as np

        return np.asarray(self.light(codes, minutes) @ self.phosphors() + np.array(self.room))

    def age(self, days: float, seed: int = 0) -> Monitor:
        """The monitor some days later: gains walk 1 % and biases 0.003 a month, at random."""
        import numpy as np

        if not days >= 0:
            raise UsageError(f"A monitor ages by a number of days from 0 up, not {days:g}.")
        steps = np.random.default_rng(seed).normal(size=6) * math.sqrt(days / 30.0)
        gain = tuple((np.array(self.gain) * (1.0 + 0.01 * steps[:3])).tolist())
        bias = tuple((np.array(self.bias) + 0.003 * steps[3:]).tolist())
        return replace(self, gain=gain, bias=bias)


@dataclass
class Instrument:
    """A colorimeter before a monitor: repeatable, not exact.

    Each of X, Y and Z is read with an error of its own, normal, of standard deviation √(floor² + (relative · value)²),
    and no reading is below 0. The defaults are those of a good filter colorimeter on one screen; the same seed gives
    the same readings.

    Attributes:
        monitor: what it looks at; its knobs may be turned between readings.
        relative: of the reading.
        floor: cd/m².
        minutes: since the monitor was switched on.
        seed: of the noise.
        count: readings made so far.
    """

    monitor: Monitor
    relative: float = 0.003
    floor: float = 0.005
    minutes: float = math.inf
    seed: int = 0
    count: int = 0
    _random: np.random.Generator | None = field(default=None, repr=False)

    def measure(self, codes: ArrayLike, repeat: int = 1) -> Array:
        """XYZ in cd/m² of code values (..., 3), as read; the mean of several readings when asked for."""
        import numpy as np

        if self._random is None:
            self._random = np.random.default_rng(self.seed)
        true = self.monitor.xyz(codes, self.minutes)
        sigma = np.sqrt(self.floor**2 + (self.relative * true) ** 2) / math.sqrt(repeat)
        self.count += repeat * int(true.size // 3)
        return np.asarray(np.maximum(true + sigma * self._random.normal(size=true.shape), 0.0))


def maladjusted(seed: int, *, tracking: bool = True) -> Monitor:
    """A monitor out of adjustment in every way, drawn from a seed.

    Gains are within 12 %, biases within 0.03, brightness within 0.02, contrast within 10 %, γ of each gun within 0.1
    of one from 2.1 to 2.5 (all alike without `tracking`), bows within 2 %, phosphors within 0.006 in x and y, and the
    room adds up to 0.3 cd/m².

    Example:
        >>> maladjusted(1) == maladjusted(1), maladjusted(1) == maladjusted(2)
        (True, False)
    """
    import numpy as np

    random = np.random.default_rng(seed)

    def triple(low: float, high: float) -> Triple:
        r, g, b = random.uniform(low, high, 3).tolist()
        return r, g, b

    gamma = random.uniform(2.1, 2.5)
    spread = triple(-0.1, 0.1)
    primaries = np.array(SMPTE_C) + random.uniform(-0.006, 0.006, (3, 2))
    room = random.uniform(0.0, 0.3)
    pairs: Pairs = tuple((float(x), float(y)) for x, y in primaries)  # type: ignore[assignment]
    return Monitor(
        gain=triple(0.88, 1.12),
        bias=triple(-0.03, 0.03),
        brightness=float(random.uniform(-0.02, 0.02)),
        contrast=float(random.uniform(0.9, 1.1)),
        gamma=(gamma + spread[0], gamma + spread[1], gamma + spread[2])
        if tracking
        else (gamma, gamma, gamma),
        bow=triple(-0.02, 0.02),
        primaries=pairs,
        room=(0.95 * room, room, 1.09 * room),
    )
