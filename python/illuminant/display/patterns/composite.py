"""Levels of the composite NTSC signal that a pattern makes: in IRE, and as a vector.

A signal reaches from blanking, 0 IRE, to white, 100 IRE. Black sits on a setup of 7.5 IRE, so Y_t from 0 to 1 takes
92.5 IRE (book 5.3, footnote 16). Colour rides on it as a carrier of amplitude √(I² + Q²), whose angle a vectorscope
shows from the axis of B−Y.

    U = 0.492111 (B − Y_t),  V = 0.877283 (R − Y_t)
    I = V cos 33° − U sin 33°,  Q = V sin 33° + U cos 33°
    level = setup + (100 − setup) Y_t,  carrier = (100 − setup) √(I² + Q²),  angle = atan2(V, U)

These are the factors from which the matrices of eqs 5.2 and 5.3 are rounded (SMPTE 170M-2004, annex); here they are
kept to all digits and inverted exactly, so that vectors come back to 10⁻¹⁵.

Example:
    >>> yellow = levels([0.75, 0.75, 0.0])
    >>> round(yellow.luminance, 1), round(yellow.carrier, 1), round(yellow.angle_deg, 1)
    (69.0, 62.1, 167.1)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["SETUP", "Levels", "levels", "rgb_to_yiq", "vector", "yiq_to_rgb"]

SETUP = 7.5
"""Level of black of NTSC, IRE; 0 without setup, as in Japan and in component video."""

_U, _V, _ROTATION_DEG = 0.492111, 0.877283, 33.0


class Levels(NamedTuple):
    """What a waveform monitor and a vectorscope show of a colour.

    Attributes:
        luminance: level without carrier, IRE.
        carrier: amplitude from peak to peak, IRE.
        low, high: where the carrier reaches, IRE.
        angle_deg: on the vectorscope, from the axis of B−Y, 0 to 360; 0 without carrier.
    """

    luminance: float
    carrier: float
    low: float
    high: float
    angle_deg: float


def _matrix() -> Array:
    import numpy as np

    luma = np.array([0.299, 0.587, 0.114])
    u = _U * (np.array([0.0, 0.0, 1.0]) - luma)
    v = _V * (np.array([1.0, 0.0, 0.0]) - luma)
    c, s = np.cos(np.radians(_ROTATION_DEG)), np.sin(np.radians(_ROTATION_DEG))
    return np.stack([luma, v * c - u * s, v * s + u * c])


def rgb_to_yiq(rgb: ArrayLike) -> Array:
    """Y_t, I and Q of RGB signals (..., 3)."""
    import numpy as np

    return np.asarray(np.asarray(rgb, np.float64) @ _matrix().T)


def yiq_to_rgb(yiq: ArrayLike) -> Array:
    """RGB signals of Y_t, I and Q (..., 3): the exact inverse.

    Example:
        >>> (yiq_to_rgb([0.0, 1.0, 0.0]).round(3) + 0.0).tolist()
        [0.956, -0.272, -1.107]
        >>> (yiq_to_rgb([0.0, 0.0, 1.0]).round(3) + 0.0).tolist()
        [0.621, -0.647, 1.704]
    """
    import numpy as np

    return np.asarray(np.asarray(yiq, np.float64) @ np.linalg.inv(_matrix()).T)


def vector(axis: str, ire: float, setup: float = SETUP) -> Array:
    """RGB signals, at Y_t = 0, of a carrier along an axis; some are negative, so no frame buffer holds them.

    Args:
        axis: "-I", "+I", "-Q" or "+Q".
        ire: amplitude of the carrier (half of what it is from peak to peak), IRE.
        setup: level of black, IRE.
    """
    amount = (-1.0 if axis[0] == "-" else 1.0) * ire / (100.0 - setup)
    return yiq_to_rgb([0.0, amount, 0.0] if axis[1] == "I" else [0.0, 0.0, amount])


def levels(rgb: Sequence[float] | Any, setup: float = SETUP) -> Levels:
    """Levels of one colour of three signals."""
    import math

    y, i, q = rgb_to_yiq(rgb).tolist()
    level, amplitude = setup + (100.0 - setup) * y, (100.0 - setup) * math.hypot(i, q)
    # I leads the axis of R−Y by 33°, that is, lies at 123° from B−Y, and Q at 33°.
    angle = (math.degrees(math.atan2(i, q)) + _ROTATION_DEG) % 360.0 if amplitude > 1e-9 else 0.0
    return Levels(level, 2 * amplitude, level - amplitude, level + amplitude, angle)
