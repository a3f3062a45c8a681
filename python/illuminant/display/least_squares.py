"""The least squares of a model that is not linear, by damped Gauss–Newton steps (Levenberg 1944; Marquardt 1963).

    minimise Σ (w (reading − L(p)))²   over p within bounds
    step = (JᵀJ + λ diag JᵀJ)⁻¹ Jᵀ r,   J = w ∂L/∂p,   r = w (reading − L)

λ falls while steps lessen the sum and rises when one does not. Weights may follow the model, as where the error of a
reading is relative: they are renewed at each step, and a step is judged by the weights it was made with. Steps are
clipped to the bounds.

Example:
    >>> import numpy as np
    >>> x = np.linspace(0.1, 1.0, 10)
    >>> def power(p):
    ...     return p[1] * x ** p[0], np.stack([p[1] * x ** p[0] * np.log(x), x ** p[0]], axis=1)
    >>> found, steps = minimised(power, 90.0 * x**2.35, np.array([2.0, 80.0]))
    >>> found.round(9).tolist(), steps < 20
    ([2.35, 90.0], True)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["minimised"]

MOST_STEPS = 60

SMALLEST_MOVE = 1e-10
"""Of every parameter, relative, at which it is done."""


def minimised(
    model: Callable[[Float64], tuple[Float64, Float64]],
    readings: Float64,
    start: Float64,
    *,
    weights: Callable[[Float64], Float64] | Float64 | float = 1.0,
    low: ArrayLike = float("-inf"),
    high: ArrayLike = float("inf"),
) -> tuple[Float64, int]:
    """The parameters with the least sum of weighted squares near a start, and how many steps led there.

    Args:
        model: parameters (k,) to values (n,) and their derivatives (n, k).
        readings: (n,).
        start: (k,), within the bounds.
        weights: (n,), or values of the model to weights.
        low, high: bounds, one or (k,).
    """
    import numpy as np

    parameters, damping = start, 1e-3
    value, slopes = model(parameters)
    for step in range(1, MOST_STEPS + 1):
        weight = np.broadcast_to(weights(value) if callable(weights) else weights, value.shape)
        rest, jacobian = (readings - value) * weight, slopes * weight[:, None]
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ rest
        scale = np.diag(np.diag(normal) + 1e-12 * np.trace(normal) + 1e-30)
        while True:
            move = np.linalg.lstsq(normal + damping * scale, gradient, rcond=None)[0]
            trial = np.clip(parameters + move, low, high)
            then, then_slopes = model(trial)
            # A hair more is rounding, and ends the search by its small move.
            if float((((readings - then) * weight) ** 2).sum()) <= float(rest @ rest) * (1.0 + 1e-12):
                break
            damping *= 4.0
            if damping > 1e12:
                return parameters, step
        moved = float(np.max(np.abs(trial - parameters) / np.maximum(np.abs(trial), 1e-6)))
        parameters, value, slopes, damping = trial, then, then_slopes, max(damping / 8.0, 1e-12)
        if moved < SMALLEST_MOVE:
            break
    return parameters, step
