"""RGB systems by name: three primaries, a white, and a transfer function.

The systems themselves are in the core (`_core.rgb_systems()`): sRGB, Rec.709, Rec.2020, Display P3, Adobe
RGB, ACES AP0, ACES AP1 and XYZ. Here they become plain data for Python, and code values become linear again.

Example:
    >>> named("srgb")["name"]
    'sRGB'
    >>> [round(x, 4) for x in named("sRGB")["white"]]
    [0.3127, 0.329]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["chromaticities", "gamma", "linear", "named"]


def named(name: str) -> dict[str, Any]:
    """An RGB system: `name`, `primaries` (3, 2), `white` (2,), `to_xyz` and `from_xyz` (3, 3), `transfer` (its name).

    Args:
        name: as `_core.rgb_systems()` lists it; upper and lower case are one.

    Raises:
        UsageError: there is none of that name; the sentence lists those there are.
    """
    known = {str(system).casefold(): system for system in core().rgb_systems()}
    system = known.get(name.casefold())
    if system is None:
        raise UsageError(f"There is no RGB system {name!r}: known are {', '.join(known.values())}.")
    found: dict[str, Any] = core().rgb_system(system)
    return found


def chromaticities(system: dict[str, Any]) -> tuple[float, ...]:
    """x and y of red, green, blue and white, in the order of the attribute of OpenEXR and of the PNG chunk."""
    return tuple(float(c) for pair in (*system["primaries"], system["white"]) for c in pair)


def gamma(transfer: str) -> float | None:
    """Exponent of a transfer function that is a power law, code = value^(1/γ); None for other curves.

    Example:
        >>> gamma("linear"), gamma("gamma 2.2"), gamma("sRGB")
        (1.0, 2.2, None)
    """
    if transfer == "linear":
        return 1.0
    name, _, exponent = transfer.partition(" ")
    return float(exponent) if name == "gamma" else None


def linear(code: Array, transfer: str) -> Array:
    """Linear values of code values in [0, 1]: the inverse of the transfer function of that name.

    Sources: IEC 61966-2-1 (sRGB); ITU-R BT.709 and BT.2020, with their constants at full precision.
    """
    import numpy as np

    exponent = gamma(transfer)
    if exponent is not None:
        return np.asarray(code**exponent)
    if transfer == "sRGB":
        return np.where(code <= 0.040449936, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
    alpha, beta = 1.09929682680944, 0.018053968510807
    return np.where(code < 4.5 * beta, code / 4.5, ((code + alpha - 1.0) / alpha) ** (1 / 0.45))
