"""RGB systems by name, as the readers and writers of images need them: plain data.

The systems themselves are in the core (`_core.rgb_systems()`); `illuminant.color` lists them, and computes with them.

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

    The formulas are in `illuminant.color.decode`, which this calls for any array (..., 3).
    """
    from illuminant.color import decode

    return decode(code, transfer)
