"""How many samples are taken at a time, and how precise an image is: what decides when a render ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["next_range", "standard_error_fraction"]

FAST_UNTIL, STEP = 64, 64


def next_range(done: int, limit: int | None) -> int:
    """End of the range of samples that begins at `done`, when at most `limit` are wanted.

    Example:
        >>> ends = [0]
        >>> while ends[-1] < 1000:
        ...     ends.append(next_range(ends[-1], 1000))
        >>> ends
        [0, 1, 4, 16, 64, 128, 192, 256, 320, 384, 448, 512, 640, 768, 960, 1000]
    """
    if done < FAST_UNTIL:
        end = max(1, 4 * done)
    else:
        end = done + max(1, done // (4 * STEP)) * STEP
    return end if limit is None else min(end, limit)


def standard_error_fraction(luminance: Array, standard_error: Array, target: float) -> float:
    """Fraction of the pixels whose standard error of luminance is below `target`.

    Args:
        luminance: (h, w), in cd/m².
        standard_error: (h, w), its estimate from two halves.
        target: relative to the larger of the pixel's luminance and the mean of the image; 0.01 is 1 %.

    Returns:
        A number from 0 to 1; 0 for a black image, which proves nothing.

    Example:
        >>> import numpy as np
        >>> standard_error_fraction(np.ones((4, 4)), np.full((4, 4), 0.009), 0.01)
        1.0
    """
    import numpy as np

    mean = float(luminance.mean())
    if not mean > 0:
        return 0.0
    edge: Literal["reflect", "edge"] = "reflect" if min(luminance.shape) > 2 else "edge"
    variance = np.pad(np.asarray(standard_error, np.float64) ** 2, 2, mode=edge)
    for axis in (0, 1):
        size = variance.shape[axis] - 4
        variance = np.mean([np.take(variance, range(i, i + size), axis) for i in range(5)], axis=0)
    within = np.sqrt(variance) < target * np.maximum(luminance, mean)
    return float(within.mean())
