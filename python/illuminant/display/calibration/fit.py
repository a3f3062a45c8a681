"""A monitor's description fitted to readings: black, primaries, and gain, offset and γ of each gun.

The model is that of Berns (1996), gain, offset, gamma: with code values v from 0 to 1,

    D_k(v) = max(g_k v + o_k, 0)^γ_k,   l_k = (D_k(v_k) − D_k(0)) / (1 − D_k(0)),   XYZ = K + Σ_k l_k P_k

with an offset o_k = 1 − g_k, so that l_k rises from 0 at code 0 to 1 at full code, where gun k adds its primary P_k. An
offset below 0 cuts the gun off above black. K is black: the room's light on the glass, and what guns that are not cut
off give at code 0. This is the response `gain-offset-gamma` of `illuminant.display.displays`.

All 18 numbers are found together from all readings, by `illuminant.display.least_squares` on residuals in units of the
instrument's error √(floor² + (relative · reading)²); so dark readings, which err most, count least (book 5.1.2: the low
end must be cut off, and where is trial and error). It starts from the γ of each gun by itself, the straight line of
logarithms of `illuminant.display.gamma.fitting`.
Residuals beyond 2.5 of their robust spread count less (Huber 1964), and readings beyond 6 are named as outliers.

Units: cd/m². Valid for displays whose channels add; `additivity` says how far they do.

References: Berns (1996), Methods for characterizing CRT displays, Displays 16; book 5.1.2, eq 5.1.

Example:
    >>> from illuminant.display.calibration import monitor, readings
    >>> codes = readings.plan()
    >>> fit(readings.Readings(codes, monitor.Monitor().xyz(codes))).model.gamma.round(6).tolist()
    [2.2, 2.2, 2.2]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.gamma.fitting import fit_gamma
from illuminant.display.least_squares import minimised
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.calibration.readings import Readings

    Array = NDArray[np.float64]

__all__ = ["Characterisation", "Fit", "fit"]

GUNS = ("red", "green", "blue")

HUBER, OUTLIER = 2.5, 6.0
"""Residuals, in robust standard deviations, that count less, and that are called outliers."""

# Bounds of primaries, black, gain and γ.
_LOW = (*[float("-inf")] * 9, *[0.0] * 3, *[0.5] * 3, *[0.3] * 3)
_HIGH = (*[float("inf")] * 12, *[2.0] * 3, *[8.0] * 3)


@dataclass(frozen=True)
class Characterisation:
    """The numbers of the model.

    Attributes:
        primaries: (3, 3) XYZ that red, green and blue add at full code, in rows, cd/m².
        black: (3,) XYZ at code 0, cd/m².
        gain: (3,) g of each gun; the offset is 1 − g.
        gamma: (3,) γ of each gun.
    """

    primaries: Array
    black: Array
    gain: Array
    gamma: Array

    @property
    def offset(self) -> Array:
        """Offset of each gun, 1 − gain."""
        return 1.0 - self.gain

    @property
    def white(self) -> Array:
        """XYZ (3,) of full code in all channels, cd/m²."""
        return self.xyz([1.0, 1.0, 1.0])

    def light(self, codes: ArrayLike) -> Array:
        """What each gun gives, 1 for full code, of code values (..., 3)."""
        import numpy as np

        drive = self.gain * np.asarray(codes, np.float64) + self.offset
        zero = self._zero()
        return np.asarray((np.maximum(drive, 0.0) ** self.gamma - zero) / (1.0 - zero))

    def _zero(self) -> Array:
        """D(0) of each gun: what it gives at code 0 before it is counted as black."""
        import numpy as np

        return np.asarray(np.maximum(self.offset, 0.0) ** self.gamma)

    def xyz(self, codes: ArrayLike) -> Array:
        """XYZ (..., 3) in cd/m² of code values (..., 3)."""
        import numpy as np

        return np.asarray(self.light(codes) @ self.primaries + self.black)

    def linear(self, xyz: ArrayLike) -> Array:
        """How much of each primary a colour (..., 3) in cd/m² needs; outside 0 to 1 it is out of the gamut."""
        import numpy as np

        return np.asarray((np.asarray(xyz, np.float64) - self.black) @ np.linalg.inv(self.primaries))

    def codes(self, linear: ArrayLike) -> Array:
        """Code values (..., 3), clamped to 0 to 1, that make each gun give this much."""
        import numpy as np

        zero = self._zero()
        part = np.clip(np.asarray(linear, np.float64), 0.0, 1.0) * (1.0 - zero) + zero
        return np.asarray(np.clip((part ** (1.0 / self.gamma) - self.offset) / self.gain, 0.0, 1.0))

    def reachable(self, xy: tuple[float, float]) -> float:
        """The highest luminance of a white of this chromaticity that the monitor shows, cd/m²."""
        import numpy as np

        from illuminant import color

        direction = np.array(color.white_xyz(xy)) @ np.linalg.inv(self.primaries)
        base = self.black @ np.linalg.inv(self.primaries)
        if (direction <= 0).any():
            raise UsageError(f"A white at x, y = {xy[0]:g}, {xy[1]:g} lies outside the monitor's gamut.")
        return float(((1.0 + base) / direction).min())


@dataclass(frozen=True)
class Fit:
    """What was found.

    Attributes:
        model: the description.
        residuals: ΔE00 (n,) between each reading and what the description says.
        outliers: rows of the readings, from 0, that are far from it.
        additivity: how much white differs from the sum of the channels, as a fraction of its luminance; None when one
            of them was not read.
        drift: how much the last reading of white differs from the first, as a fraction of luminance; None if read once.
        steps: of Marquardt's method.
    """

    model: Characterisation
    residuals: Array
    outliers: tuple[int, ...]
    additivity: float | None
    drift: float | None
    steps: int


def fit(readings: Readings, *, relative: float = 0.003, floor: float = 0.005, low: float = 0.0) -> Fit:
    """The description that fits all readings best.

    Args:
        readings: black, at least three levels of each channel or of grey, and full red, green and blue.
        relative, floor: error of the instrument, of the reading and in cd/m²; only their ratio counts much.
        low: fraction of white's luminance below which readings are left out, black excepted.

    Raises:
        DataError: something is missing from the readings, or they are not those of a monitor.
    """
    import numpy as np

    if not (relative > 0 and floor > 0 and 0 <= low < 0.5):
        raise UsageError("A fit needs errors above 0 and a low cutoff from 0 to 0.5.")
    start = _start(readings)
    codes, xyz = readings.codes, readings.xyz
    bright = (xyz[:, 1] >= low * xyz[:, 1].max()) | (codes.max(axis=1) == 0.0)
    spread = np.sqrt(floor**2 + (relative * np.maximum(xyz, xyz[:, 1:2])) ** 2)
    weights = np.where(bright[:, None], 1.0 / spread, 0.0)
    robust = np.ones_like(weights)
    steps = 0
    numbers = start
    scaled = np.zeros_like(weights)
    for _ in range(4):
        numbers, taken = minimised(
            lambda at: (_model(at).xyz(codes).ravel(), _jacobian(at, codes)),
            xyz.ravel(),
            numbers,
            weights=(weights * robust).ravel(),
            low=_LOW,
            high=_HIGH,
        )
        steps += taken
        scaled = (_model(numbers).xyz(codes) - xyz) / spread
        # The spread of readings that fit is not always what the instrument's maker says.
        sigma = max(1.0, 1.4826 * float(np.median(np.abs(scaled[bright]))))
        robust = np.sqrt(np.minimum(1.0, HUBER * sigma / np.maximum(np.abs(scaled), 1e-12)))
    model = _model(numbers)
    _sensible(model, readings)
    far = (np.abs(scaled) > OUTLIER * sigma).any(axis=1) & bright
    return Fit(
        model=model,
        residuals=_differences(model, readings),
        outliers=tuple(int(row) for row in np.flatnonzero(far)),
        additivity=_additivity(readings),
        drift=_drift(readings),
        steps=steps,
    )


def _mean_of(readings: Readings, code: Sequence[float]) -> Array | None:
    import numpy as np

    same = (np.abs(readings.codes - np.array(code)) < 1e-9).all(axis=1)
    return np.asarray(readings.xyz[same].mean(axis=0)) if same.any() else None


def _start(readings: Readings) -> Array:
    """A first guess: primaries and black as they were read, γ from logarithms, no offset."""
    import numpy as np

    def refuse(what: str) -> DataError:
        return DataError(f"A fit needs {what}.", readings.file)

    black = _mean_of(readings, (0.0, 0.0, 0.0))
    if black is None:
        raise refuse("a reading of black, code 0,0,0")
    full = [_mean_of(readings, tuple(row)) for row in np.eye(3).tolist()]
    for name, reading in zip(GUNS, full, strict=True):
        if reading is None:
            raise refuse(f"a reading of full {name}, without the other channels")
    primaries = np.array(full) - black
    if np.linalg.cond(primaries) > 1e4 or (primaries[:, 1] <= 0).any():
        raise DataError(
            "Full red, green and blue are no three colours: were the rows filled in in their order?",
            readings.file,
        )
    # Greys serve where a channel was not read by itself at enough levels.
    light = (readings.xyz - black) @ np.linalg.inv(primaries)
    gammas = []
    for k, name in enumerate(GUNS):
        others = np.delete(readings.codes, k, axis=1)
        own = (others == 0.0).all(axis=1) | (np.ptp(readings.codes, axis=1) < 1e-9)
        own &= readings.codes[:, k] > 0.0
        try:
            gammas.append(fit_gamma(readings.codes[own, k], light[own, k]).gamma)
        except (DataError, UsageError):
            raise refuse(f"three levels or more of {name} or grey, between black and full") from None
    gamma = np.clip(gammas, 0.8, 5.0)
    return np.concatenate([primaries.ravel(), black, np.ones(3), gamma])


def _model(numbers: Array) -> Characterisation:
    return Characterisation(numbers[:9].reshape(3, 3), numbers[9:12], numbers[12:15], numbers[15:18])


def _jacobian(numbers: Array, codes: Array) -> Array:
    """Derivatives (3 n, 18) of XYZ by the numbers of the model."""
    import numpy as np

    model = _model(numbers)

    def power(v: Array) -> tuple[Array, Array, Array]:
        """D at code values, and its derivatives by gain and γ."""
        drive = model.gain * v + model.offset
        lit = drive > 1e-9
        safe = np.where(lit, drive, 1.0)
        value = np.where(lit, safe**model.gamma, 0.0)
        slope = np.where(lit, model.gamma * safe ** (model.gamma - 1.0) * (v - 1.0), 0.0)
        return value, slope, np.where(lit, value * np.log(safe), 0.0)

    (full, full_gain, full_gamma), (zero, zero_gain, zero_gamma) = power(codes), power(np.zeros(3))
    light = (full - zero) / (1.0 - zero)
    by_gain = (full_gain - zero_gain * (1.0 - light)) / (1.0 - zero)
    by_gamma = (full_gamma - zero_gamma * (1.0 - light)) / (1.0 - zero)
    found = np.zeros((len(codes), 3, 18))
    for channel in range(3):
        found[:, channel, 9 + channel] = 1.0
        for gun in range(3):
            found[:, channel, 3 * gun + channel] = light[:, gun]
            found[:, channel, 12 + gun] = by_gain[:, gun] * model.primaries[gun, channel]
            found[:, channel, 15 + gun] = by_gamma[:, gun] * model.primaries[gun, channel]
    return found.reshape(-1, 18)


def _sensible(model: Characterisation, readings: Readings) -> None:
    import numpy as np

    if not all(
        np.isfinite(values).all() for values in (model.primaries, model.black, model.gain, model.gamma)
    ):
        raise DataError("The readings are not those of a monitor: no fit was found.", readings.file)
    if (model.gamma < 0.5).any() or (model.gamma > 6.0).any():
        shown = ", ".join(f"{gamma:.2f}" for gamma in model.gamma.tolist())
        raise DataError(f"The readings are not those of a monitor: γ would be {shown}.", readings.file)


def _differences(model: Characterisation, readings: Readings) -> Array:
    import numpy as np

    from illuminant import color

    white = np.maximum(model.white, 1e-9).tolist()
    said, read = (color.xyz_to_lab(xyz, white) for xyz in (model.xyz(readings.codes), readings.xyz))
    return np.atleast_1d(np.asarray(color.delta_e_2000(said, read), np.float64))


def _additivity(readings: Readings) -> float | None:
    import numpy as np

    parts = [
        _mean_of(readings, tuple(row)) for row in [*np.eye(3).tolist(), [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    ]
    if any(part is None for part in parts):
        return None
    r, g, b, black, white = (float(part[1]) for part in parts if part is not None)
    return (r + g + b - 2.0 * black) / white - 1.0


def _drift(readings: Readings) -> float | None:
    import numpy as np

    rows = np.flatnonzero((readings.codes == 1.0).all(axis=1))
    if len(rows) < 2:
        return None
    return float(readings.xyz[rows[-1], 1] / readings.xyz[rows[0], 1] - 1.0)
