"""Perceived brightness against intensity, and how much it is like the response of a monitor (book 5.1.2, figure 5.6).

Steps look equal where ΔI/I is equal (Weber 1834; Fechner 1860), so brightness is the logarithm of intensity, counted
from the black of the display. With I from 0 (black) to 1 (white) and black at the share b of white's luminance,

    luminance(I) = b + (1 − b) I,        brightness(I) = ln(luminance / b) / ln(1 / b)

which is 0 at black and 1 at white. b is set by the display and by the light in the room; it decides how steep the curve
begins. The inverse, intensity over brightness, is the curve that resembles I = v^γ: equal steps of code on a monitor
are then nearly equal steps of brightness. L* of the CIE (1976), close to a cube root, stands beside it.

Example:
    >>> brightness([0.0, 0.1, 1.0], black=0.01).round(3).tolist()
    [0.0, 0.519, 1.0]
    >>> found = resemblance(2.2, black=0.01)
    >>> round(found.logarithmic, 3), round(found.lightness, 4)
    (0.977, 0.9993)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.gamma.response import Curve, response
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["BLACK", "Resemblance", "brightness", "equal_steps", "lightness", "resemblance"]

BLACK = 0.01
"""Luminance of black as a share of white's: a picture tube in a dim room."""


@dataclass(frozen=True)
class Resemblance:
    """How straight brightness is over code on a monitor: coefficients of correlation, 1 for a straight line.

    Attributes:
        logarithmic: of code with the logarithmic brightness of what it shows.
        lightness: of code with L* of what it shows.
        response: of the monitor's response with the intensities of equal steps of brightness.
    """

    logarithmic: float
    lightness: float
    response: float


def _share(black: float) -> float:
    """The share of a black, when it is one."""
    if not 0.0 < black < 1.0:
        raise UsageError(f"Black is a share of white's luminance above 0 and below 1, not {black}.")
    return float(black)


def brightness(intensity: ArrayLike, black: float = BLACK) -> Float64:
    """Logarithmic brightness, 0 to 1, of intensities 0 to 1 of any shape; below black it stays 0.

    Raises:
        UsageError: black is not a share between 0 and 1.
    """
    import numpy as np

    b = _share(black)
    luminance = b + (1.0 - b) * np.asarray(intensity, np.float64)
    return np.asarray(np.log(np.maximum(luminance / b, 1.0)) / np.log(1.0 / b))


def equal_steps(count: int, black: float = BLACK) -> Float64:
    """Intensities of steps that look equal: luminances black, black r, black r², … white; the inverse of `brightness`.

    Args:
        count: of steps; there is one intensity more.
        black: luminance of black as a share of white's.

    Example:
        >>> equal_steps(2, black=0.01).round(4).tolist()
        [0.0, 0.0909, 1.0]
    """
    import numpy as np

    if count < 1:
        raise UsageError(f"There is at least one step, not {count}.")
    b = _share(black)
    return np.asarray((b ** (1.0 - np.arange(count + 1) / count) - b) / (1.0 - b))


def lightness(intensity: ArrayLike, black: float = 0.0) -> Float64:
    """L* / 100 (CIE 1976) of intensities 0 to 1 of any shape.

    Args:
        intensity: between the display's black and white.
        black: luminance of black as a share of white's, 0 included.

    Example:
        >>> lightness([0.184, 1.0]).round(3).tolist()
        [0.5, 1.0]
    """
    import numpy as np

    from illuminant.color import xyz_to_lab

    b = 0.0 if black == 0 else _share(black)
    luminance = b + (1.0 - b) * np.asarray(intensity, np.float64)
    return np.asarray(
        xyz_to_lab(np.repeat(luminance[..., None], 3, axis=-1), (1.0, 1.0, 1.0))[..., 0] / 100.0
    )


def resemblance(curve: Curve = 2.2, black: float = BLACK, count: int = 255) -> Resemblance:
    """How much perceived brightness is like the response of a monitor.

    Args:
        curve: γ of the monitor, or the name of a curve.
        black: luminance of black as a share of white's.
        count: of steps of code.
    """
    import numpy as np

    code = np.arange(count + 1) / count
    intensity = response(code, curve)

    def correlation(a: Float64, b: Float64) -> float:
        return float(np.corrcoef(a, b)[0, 1])

    return Resemblance(
        correlation(code, brightness(intensity, black)),
        correlation(code, lightness(intensity, black)),
        correlation(intensity, equal_steps(count, black)),
    )
