"""Resolving wedges in Y, I and Q: the same wedge along each axis (book figure 5.24).

Three fans of stripes narrow downwards, so that the stripes of a row come ever closer: the cycles in the width of a line
grow from `coarsest` at the top to `finest` at the bottom, with even steps of their inverse, as the sides of a wedge are
straight. A stripe changes one axis alone, by the same amount for each wedge; the ground is grey of Y 0.5. Sent through
`transmission.transmit`, Q merges to grey first (26 cycles a line), then I (68), then Y (221).

Example:
    >>> image = wedges(640, 480)
    >>> image.shape, round(float(cycles_at(0.5, 20.0, 320.0)), 1)
    ((480, 640, 3), 37.6)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import yiq_to_rgb
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["AMPLITUDE", "MARGIN", "columns", "cycles_at", "wedges"]

AMPLITUDE = 0.29
"""Of the stripes, on each axis: the most for which Q stays within RGB at Y 0.5."""

MARGIN = 0.06
"""Of the height, grey above and below the wedges."""

_FINER = 8  # places looked at in a pixel


def cycles_at(height: ArrayLike, coarsest: float = 20.0, finest: float = 320.0) -> Float64:
    """Cycles in the width of the image, from the top (0) to the bottom (1) of a wedge."""
    import numpy as np

    t = np.asarray(height, np.float64)
    return np.asarray(1.0 / ((1.0 - t) / coarsest + t / finest))


def columns(width: int) -> list[slice]:
    """Columns of the wedges in Y, in I and in Q."""
    third = width / 3.0
    return [slice(round(k * third), round((k + 1) * third)) for k in range(3)]


def wedges(
    width: int = 640,
    height: int = 480,
    *,
    coarsest: float = 20.0,
    finest: float = 320.0,
    amplitude: float = AMPLITUDE,
) -> Float64:
    """The image (height, width, 3), code values of the NTSC primaries.

    Args:
        width, height: at least 48 by 16 pixels.
        coarsest, finest: cycles in the width of the image at the top and at the bottom of the wedges; 320 cycles are
            the most that 640 pixels can hold.
        amplitude: of the stripes, 0 to 0.29.

    Raises:
        UsageError: a size, a number of cycles or an amplitude that does not fit.
    """
    import numpy as np

    if not (48 <= width <= 16384 and 16 <= height <= 16384):
        raise UsageError(f"Wedges of {width} × {height} pixels: expected 48 × 16 to 16384 × 16384.")
    if not 3.0 <= coarsest < finest <= width / 2.0:
        raise UsageError(
            f"Wedges from {coarsest:g} to {finest:g} cycles: expected at least 3, rising to at most {width / 2:g} for "
            f"{width} pixels."
        )
    if not 0.0 < amplitude <= AMPLITUDE:
        raise UsageError(f"An amplitude of {amplitude:g} leaves RGB: expected above 0, up to {AMPLITUDE:g}.")
    rows = (np.arange(height) + 0.5) / height
    t = np.clip((rows - MARGIN) / (1.0 - 2.0 * MARGIN), 0.0, 1.0)
    inside = (rows >= MARGIN) & (rows <= 1.0 - MARGIN)
    rate = cycles_at(t, coarsest, finest)
    yiq = np.zeros((height, width, 3))
    yiq[..., 0] = 0.5
    # Whole stripes, as many as fit into nine tenths of a third at the top.
    stripes = max(int(0.9 * coarsest / 3.0), 1)
    for axis, where in enumerate(columns(width)):
        middle = (where.start + where.stop) / 2.0
        x = where.start + (np.arange((where.stop - where.start) * _FINER) + 0.5) / _FINER
        phase = (x - middle) / width * rate[:, None]
        wave = np.where(np.floor(2.0 * (phase + stripes / 2.0)) % 2 == 0, amplitude, -amplitude)
        wave = np.where((np.abs(phase) <= stripes / 2.0) & inside[:, None], wave, 0.0)
        yiq[:, where, axis] += wave.reshape(height, -1, _FINER).mean(axis=-1)
    return np.asarray(yiq_to_rgb(yiq), np.float64)
