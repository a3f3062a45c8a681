"""The gamma of a monitor from measured luminances, by least squares (book 5.1.2).

With v = code / code of white, the models of the luminance L are

| model | L(v) | parameters | source |
| --- | --- | --- | --- |
| `power` | p v^γ | γ, p | book 5.1.2: a straight line of log I over log v |
| `offset` | p v^γ + f | γ, p, f | the same with a floor f, from stray light or from the meter |
| `gain-offset-gamma` | p (a v + 1 − a)^γ, 0 where a v + 1 − a < 0 | γ, p, a | Berns (1996) |

p is the luminance of white, a the gain of the amplifier and 1 − a its offset: a = 1 for a monitor whose black is set
right, a > 1 for one that swallows the lowest codes.

**power** is fitted to log I over log v, where every reading has the same relative error. Low readings suffer from the
meter and from stray light, so there is a cutoff below which they are left out. The book finds it by trial; here it is
the one with the smallest total error of γ,

    error² = (standard error of the line)² + (γ − γ of the readings above four times the cutoff)²

The first term falls as low readings join, since they are far out on the axis of log v; the second grows as soon as they
do not lie on the line of those above. At least five readings stay.

**offset** and **gain-offset-gamma** use all readings, also those of 0, unless a cutoff is given. A reading has the
error s (L + m): relative for bright fields, that of the meter for dark ones. `illuminant.display.least_squares`
minimises Σ ((reading − L) / (L + m))²; among ten values of m that of the largest likelihood is taken.

Where black was read by itself, it can be taken off first (`black`), as the book does.

Standard errors are those of the linearised least squares, s² (JᵀJ)⁻¹, and shrink with the root of the number of
readings. They hold for readings with independent errors; a wrong model shows in the residuals, and its γ is off by more
than they say: where there is stray light, `offset` is the model, and `power` reads a γ that is 0.01 too low for each
0.05 % of white in it.

Example:
    >>> import numpy as np
    >>> codes = np.arange(0, 256, 15)
    >>> found = fit_gamma(codes, 90.0 * (codes / 255.0) ** 2.35)
    >>> round(found.gamma, 6), round(found.peak, 6)
    (2.35, 90.0)
    >>> found = fit_gamma(codes, 90.0 * (codes / 255.0) ** 2.35 + 0.5, model="offset")
    >>> round(found.gamma, 6), round(found.floor, 6)
    (2.35, 0.5)
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from illuminant.display.gamma.response import positive
from illuminant.display.least_squares import minimised
from illuminant.errors import DataError, UsageError, suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["MODELS", "GammaFit", "Model", "fit_gamma"]

Model = Literal["power", "offset", "gain-offset-gamma"]

MODELS: tuple[Model, ...] = ("power", "offset", "gain-offset-gamma")

_PARAMETERS = {"power": ("gamma", "peak"), "offset": ("gamma", "peak", "floor")}
_PARAMETERS["gain-offset-gamma"] = ("gamma", "peak", "gain")

FEWEST = 5
"""Readings that an automatic cutoff leaves."""

OCTAVES = 4.0
"""How many times the cutoff the readings of the comparison lie above it."""


@dataclass(frozen=True, eq=False)
class GammaFit:
    """A fitted response.

    Attributes:
        model: its name.
        gamma: γ.
        gamma_error: its standard error; for `power` with an automatic cutoff the total error of this module.
        parameters: all of them by name: gamma, peak (cd/m²), floor (cd/m²) or gain.
        errors: their standard errors.
        cutoff: luminance of the lowest reading used, cd/m².
        used: (n,) which readings were, in the order in which they were given.
        residuals: (n,) reading / model − 1; nan where the model is 0.
        scatter: root mean square of the relative error that the readings used have, s.
        meter: m, cd/m²; 0 for `power`.
        white_code: code of white.
        black: what was taken off the readings first, cd/m².
    """

    model: Model
    gamma: float
    gamma_error: float
    parameters: dict[str, float]
    errors: dict[str, float]
    cutoff: float
    used: NDArray[np.bool_]
    residuals: Float64
    scatter: float
    meter: float
    white_code: float
    black: float = 0.0

    @property
    def peak(self) -> float:
        """Luminance of white above floor and black, cd/m²."""
        return self.parameters["peak"]

    @property
    def floor(self) -> float:
        """Luminance that is there at every code, cd/m²: what was fitted, and what was taken off."""
        return self.parameters.get("floor", 0.0) + self.black

    @property
    def gain(self) -> float:
        """Gain a; 1 for models without one."""
        return self.parameters.get("gain", 1.0)

    def luminance(self, codes: ArrayLike) -> Float64:
        """Luminances of codes of any shape, cd/m²."""
        import numpy as np

        v = np.asarray(codes, np.float64) / self.white_code
        parameters = np.array([self.parameters[name] for name in _PARAMETERS[self.model]])
        return _value_and_slopes(self.model, v.reshape(-1), parameters)[0].reshape(v.shape) + self.black


def fit_gamma(
    codes: ArrayLike,
    luminances: ArrayLike,
    model: str = "power",
    *,
    cutoff: float | None = None,
    white_code: float | None = None,
    black: float = 0.0,
) -> GammaFit:
    """Fit a model of this module to readings.

    Args:
        codes: (n,) code values of the fields, 0 or above, in any order.
        luminances: (n,) what was read there, cd/m² or any other unit.
        model: "power", "offset" or "gain-offset-gamma".
        cutoff: luminance below which readings are left out, in their unit; None: automatic for `power`, and all
            readings for the others.
        white_code: code of white; None: the largest that was measured.
        black: luminance to take off all readings first; a cutoff is a luminance above it.

    Raises:
        UsageError: the arrays do not go together, too few readings are left, they do not rise, or a name is not known.
        DataError: fewer than two readings above 0 differ, or they are so large that nothing finite fits them.
    """
    import numpy as np

    if model not in MODELS:
        hint = suggestion(model, MODELS)
        raise UsageError(
            f'There is no model "{model}": expected {", ".join(MODELS)}.{" " + hint if hint else ""}'
        )
    kind: Any = model
    with np.errstate(all="ignore"):
        return _fitted(kind, codes, luminances, cutoff, white_code, black)


def _fitted(
    model: Model,
    codes: ArrayLike,
    luminances: ArrayLike,
    cutoff: float | None,
    white_code: float | None,
    black: float,
) -> GammaFit:
    """The fit; what is too large for it shows in the result."""
    import numpy as np

    if not math.isfinite(black):
        raise UsageError(f"Black is a luminance, not {black}.")
    code, read = _checked(codes, luminances, black)
    white = positive(float(code.max()) if white_code is None else white_code, "The code of white")
    v = code / white
    if cutoff is not None and not (cutoff >= 0 and math.isfinite(cutoff)):
        raise UsageError(f"A cutoff is a luminance of 0 or more, not {cutoff}.")
    usable = (v > 0) & (read > 0) if model == "power" else np.ones(len(v), bool)
    used = usable & (read >= cutoff) if cutoff is not None else usable
    least = len(_PARAMETERS[model]) + 1
    if len(np.unique(v[used])) < least:
        where = f" of {cutoff:g} and more" if cutoff is not None else ""
        raise UsageError(
            f"The model {model} needs readings{where} at {least} codes, and has {len(np.unique(v[used]))}."
        )
    if model == "power":
        drift = 0.0
        if cutoff is None:
            used, drift = _automatic(v, read, used)
        values, covariance, scatter = _line(v[used], read[used])
        covariance[0, 0] += drift**2
        meter = 0.0
    else:
        values, covariance, scatter, meter = _likeliest(model, v[used], read[used])
    if not np.isfinite(values).all():
        raise DataError("No finite gamma fits these readings: they are too few or too large.")
    if not values[0] > 0:
        raise UsageError("No gamma fits these readings: expected luminances that rise with the code.")
    deviations = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    if not (np.isfinite(deviations).all() and math.isfinite(scatter)):
        raise DataError(
            "The errors of a gamma of these readings are not finite: they are too few or too large."
        )
    fitted = _value_and_slopes(model, v, values)[0] + black
    with np.errstate(divide="ignore", invalid="ignore"):
        residuals = np.where(fitted > 0, (read + black) / fitted - 1.0, np.nan)
    names = _PARAMETERS[model]
    return GammaFit(
        model,
        float(values[0]),
        float(deviations[0]),
        dict(zip(names, values.tolist(), strict=True)),
        dict(zip(names, deviations.tolist(), strict=True)),
        float(read[used].min()),
        used,
        residuals,
        scatter,
        meter,
        white,
        black,
    )


def _checked(codes: ArrayLike, luminances: ArrayLike, black: float) -> tuple[Float64, Float64]:
    """Two lists of numbers of one length."""
    import numpy as np

    from illuminant.color.triples import floating

    code = np.asarray(floating(codes, "codes"), np.float64)
    read = np.asarray(floating(luminances, "luminances"), np.float64) - black
    if code.ndim != 1 or code.shape != read.shape or not code.size:
        raise UsageError(
            f"Readings are two lists of one length, and the shapes are {code.shape} and {read.shape}."
        )
    if not (np.isfinite(code).all() and np.isfinite(read).all()):
        raise UsageError("A code or a luminance is not a number.")
    if code.min() < 0:
        raise UsageError(f"A code is 0 or above, not {code.min():g}.")
    if read.max() <= 0:
        raise UsageError(f"No luminance is above {f'black, {black:g}' if black else '0'}.")
    if len(np.unique(read[read > 0])) < 2:
        raise DataError("A gamma needs at least two readings above 0 that differ.")
    return code, read


# --- the straight line of logarithms -----------------------------------------------------------------------------


def _line(v: Float64, read: Float64) -> tuple[Float64, Float64, float]:
    """γ and peak, their covariance, and the scatter, of log I = log p + γ log v."""
    import numpy as np

    # Normalised first, so that p is near 1 and the columns of the design stay comparable.
    scale = float(read.max())
    design = np.stack([np.log(v), np.ones_like(v)], axis=1)
    found = np.linalg.lstsq(design, np.log(read / scale), rcond=None)[0]
    rest = np.log(read / scale) - design @ found
    variance = float(rest @ rest) / max(len(v) - 2, 1)
    covariance = variance * np.linalg.inv(design.T @ design)
    peak = scale * math.exp(found[1])
    slope = np.array([1.0, peak])
    return np.array([found[0], peak]), covariance * np.outer(slope, slope), math.sqrt(variance)


def _automatic(v: Float64, read: Float64, usable: NDArray[np.bool_]) -> tuple[NDArray[np.bool_], float]:
    """The readings above the best cutoff, and how far γ moves when the cutoff is four times as high."""
    import numpy as np

    # A cutoff cuts by code, so that noise does not choose among readings of one code.
    steps = np.unique(v[usable])
    best: tuple[float, NDArray[np.bool_], float] | None = None
    whole = usable & (v >= steps[0])
    for lowest in steps:
        used = usable & (v >= lowest)
        if np.count_nonzero(used) < FEWEST + 1 or len(np.unique(v[used])) < 4:
            break
        values, covariance, _ = _line(v[used], read[used])
        floor = OCTAVES * float(np.median(read[usable & (v == lowest)]))
        above = used & (read >= floor)
        order = np.sort(v[used])[::-1]
        above |= used & (v >= order[FEWEST - 1])
        drift = float(values[0] - _line(v[above], read[above])[0][0])
        total = math.hypot(math.sqrt(covariance[0, 0]), drift)
        if best is None or total < best[0]:
            best = (total, used, drift)
    return (best[1], best[2]) if best is not None else (whole, 0.0)


# --- models with a floor or an offset ------------------------------------------------------------------------------


def _value_and_slopes(model: Model, v: Float64, parameters: Float64) -> tuple[Float64, Float64]:
    """L(v), and its derivatives (n, k) by the parameters."""
    import numpy as np

    gamma, peak = parameters[:2]
    gain = parameters[2] if model == "gain-offset-gamma" else 1.0
    base = gain * v + (1.0 - gain)
    lit = base > 0
    safe = np.where(lit, base, 1.0)
    shape = np.where(lit, safe**gamma, 0.0)
    slopes = [peak * shape * np.log(safe), shape]
    if model == "gain-offset-gamma":
        slopes.append(np.where(lit, peak * gamma * safe ** (gamma - 1.0) * (v - 1.0), 0.0))
    if model == "offset":
        slopes.append(np.ones_like(v))
    floor = parameters[2] if model == "offset" else 0.0
    return peak * shape + floor, np.stack(slopes, axis=1)


def _weights(meter: float, value: Float64) -> Float64:
    return 1.0 / (abs(value) + meter)


def _likeliest(model: Model, v: Float64, read: Float64) -> tuple[Float64, Float64, float, float]:
    """Parameters, covariance, scatter and m of the fit with the largest likelihood."""
    import numpy as np

    peak = float(read.max())
    lit = (v > 0) & (read > 0.02 * peak)
    if len(np.unique(v[lit])) < 2:
        lit = (v > 0) & (read > 0)
    if len(np.unique(v[lit])) < 2:
        raise DataError("A gamma needs at least two readings above 0, at two codes above 0.")
    start = _line(v[lit], read[lit])[0]
    third = max(float(read.min()), 0.0) if model == "offset" else 1.0
    parameters = np.array([float(np.clip(start[0], 0.3, 6.0)), float(start[1]), third])
    bounds = (-0.5 * peak, 0.5 * peak) if model == "offset" else (0.3, 3.0)
    best: tuple[float, Float64, Float64, float, float] | None = None
    # From even weights to relative ones: dark readings, which lead astray, count for little until the rest is found.
    for meter in (*(peak * np.geomspace(0.1, 1e-5, 9)), 1e-6 * peak):
        found, _ = minimised(
            lambda p: _value_and_slopes(model, v, p),
            read,
            parameters,
            weights=functools.partial(_weights, float(meter)),
            low=(0.1, -np.inf, bounds[0]),
            high=(10.0, np.inf, bounds[1]),
        )
        value, slopes = _value_and_slopes(model, v, found)
        size = np.abs(value) + meter
        weighted = slopes / size[:, None]
        variance = float((((read - value) / size) ** 2).sum()) / max(len(v) - len(found), 1)
        # An exact fit has no noise to speak of; its likelihood must stay finite.
        unlikely = len(v) * math.log(max(variance, 1e-24)) + 2.0 * float(np.log(size).sum())
        if best is None or unlikely < best[0]:
            covariance = variance * np.linalg.pinv(weighted.T @ weighted)
            best = (unlikely, found, covariance, math.sqrt(variance), float(meter))
        parameters = found
    assert best is not None
    return best[1], best[2], best[3], best[4]
