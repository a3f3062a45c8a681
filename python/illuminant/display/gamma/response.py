"""The response of a monitor, and the curve that corrects it.

    intensity = code^γ               what a monitor of gamma γ makes of a code value (book figure 5.3)
    code = intensity^(1/γ)           the correction (book eq 5.1, figure 5.4)

Both are relative: 0 is black, 1 is white, and both are fixed points for every γ. Monitors have γ of 2 to 3, the NTSC
signal 2.2, a linear device 1. A curve may also be named, as `illuminant.color.encode` names them ("sRGB", "Rec.709",
"linear", "gamma 2.4"), which has the formulas; here they take arrays of any shape. Values below 0 keep their sign in a
power law, nothing is clamped, and NaN stays NaN.

Example:
    >>> correction([0.0, 0.5, 1.0], 2.2).round(4).tolist()
    [0.0, 0.7297, 1.0]
    >>> response(correction(0.18, "sRGB"), "sRGB").round(12).tolist()
    0.18
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["Curve", "correction", "curve_name", "positive", "response"]

Curve = float | str
"""A γ, or the name of a curve or of an RGB system."""


def positive(value: float, what: str) -> float:
    """The number, when it is above 0 and finite.

    Raises:
        UsageError: it is not; says what was meant by it.
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not (number > 0 and math.isfinite(number)):
        raise UsageError(f"{what} is a number above 0, not {value}.")
    return number


def curve_name(curve: Curve) -> str:
    """The name by which `illuminant.color` knows a curve.

    Raises:
        UsageError: a γ that is not above 0, or a name that is not known.

    Example:
        >>> curve_name(2.2), curve_name("2.2"), curve_name("srgb")
        ('gamma 2.2', 'gamma 2.2', 'srgb')
    """
    if isinstance(curve, str):
        try:
            curve = float(curve)
        except ValueError:
            return _known(str(curve))
    return f"gamma {positive(curve, 'A γ')!r}"


def _known(name: str) -> str:
    """The name of a system or of a curve, when there is one."""
    from illuminant.color.triples import step
    from illuminant.rgb_system import named

    try:
        named(name)
    except UsageError:
        step("encode", name)
    return name


def correction(intensity: ArrayLike, curve: Curve = 2.2) -> Float64:
    """Code values of intensities, of any shape (book eq 5.1).

    Args:
        intensity: relative, 0 to 1.
        curve: γ of the monitor, or the name of a curve.

    Raises:
        UsageError: the γ is not above 0, or the name is not known.

    Example:
        >>> correction(0.25, 2.0).tolist()
        0.5
    """
    return _mapped("encode", intensity, curve)


def response(code: ArrayLike, curve: Curve = 2.2) -> Float64:
    """Intensities of code values, of any shape: the inverse of `correction`.

    Example:
        >>> response([0.0, 0.5, 1.0], 2.0).tolist()
        [0.0, 0.25, 1.0]
    """
    return _mapped("decode", code, curve)


def _mapped(direction: str, values: ArrayLike, curve: Curve) -> Float64:
    """The values through a curve of `illuminant.color`, which takes triples."""
    import numpy as np

    from illuminant.color import decode, encode
    from illuminant.color.triples import floating

    array: Any = np.asarray(floating(values, "values"), np.float64)
    triples = np.zeros((-(-array.size // 3), 3))
    triples.reshape(-1)[: array.size] = array.reshape(-1)
    mapped = (encode if direction == "encode" else decode)(triples, curve_name(curve))
    return np.asarray(mapped.reshape(-1)[: array.size].reshape(array.shape), np.float64)
