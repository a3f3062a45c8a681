"""The look that the display options of a verb ask for."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from illuminant.display.look import Look

__all__ = ["asked_look"]


def asked_look(
    display: str | None,
    exposure: float | None,
    transfer: str | None,
    tone: str,
    gamut: str | None,
    dither: str,
    bits: int,
    seed: int,
    pipeline: str = "ideal",
) -> Look:
    """The look of these options; what cannot be is refused before any work.

    Raises:
        UsageError: a name is not known, or a number cannot be.

    Example:
        >>> asked_look(None, None, None, "none", None, "none", 8, 0).target.name
        'sRGB'
    """
    from illuminant.display.look import Look
    from illuminant.errors import UsageError

    if exposure is not None and not 0 < exposure < float("inf"):
        raise UsageError(f"--exposure {exposure:g}: expected a positive number.")
    return Look(display or "sRGB", exposure, transfer, tone, gamut, dither, bits, seed, pipeline)
