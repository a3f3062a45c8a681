"""Kept spectra written again on a regular grid, for readers that know of no other.

A reader of spectral images integrates what it finds, by sums over the grid or over straight lines between its
wavelengths. Of eight fitted wavelengths that gives wrong colours, so the spectra are made again:

1. The lanes of each lamp are divided by its light: a filter, what paths left of it, at a few wavelengths. Between them
   the smoothest filter is taken, which has these values and otherwise least ∫ f″² + f′²/s² (a spline in tension; s is
   30 nm), flat beyond the ends.
2. Times the lamp's spectrum on the grid: the values, none below zero, whose straight lines are nearest to the spectrum
   at every nm, so that lines keep their energy.
3. Changed as little as possible, in proportion to the lamp's light, so that both ways of integration give the XYZ that
   the lanes have: s + D Cᵀ (C D Cᵀ)⁻¹ (XYZ − C s), with D the diagonal of the lamp's light.

All of it is linear, one matrix (G × N) for each lamp. What would fall below zero becomes zero, and the error that is
left is told: ΔE00 between the XYZ of the image and that which a reader finds, over all pixels, beside the white.

Example:
    >>> import numpy as np
    >>> grid(400, 450, 20).tolist()
    [400.0, 420.0, 440.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.display.refitting import Error
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["grid", "reader_error", "readers", "smooth", "spread"]

TENSION_NM = 30.0
"""Over so many nm a filter turns flat where nothing is known of it."""

ALIKE = 1e-3
"""Readers who agree to this fraction are served as one: their difference would take large changes to mend."""

D65 = (0.95047, 1.0, 1.08883)


def grid(first_nm: int, last_nm: int, step_nm: float) -> Array:
    """The wavelengths of a regular grid over a range.

    Raises:
        UsageError: the step is not from 1 to 20 nm, or wider than the range.
    """
    import numpy as np

    if not 1 <= step_nm <= 20 or last_nm - first_nm < step_nm:
        raise UsageError(f"--regular {step_nm:g}: expected a step from 1 to 20 nm.")
    return np.asarray(first_nm + float(step_nm) * np.arange(int((last_nm - first_nm) / step_nm + 1e-9) + 1))


def readers(nm: Array, wavelengths_nm: Array, functions: Array) -> tuple[Array, Array]:
    """How readers integrate (3, G): by a sum over the grid, and by 1 nm sums over straight lines.

    Args:
        nm: (n,) every nm.
        wavelengths_nm: (G,) of the grid.
        functions: (n, 3) the observer's, K_m in them.
    """
    import numpy as np

    from illuminant.display.refitting import hats

    step = float(wavelengths_nm[1] - wavelengths_nm[0])
    at = np.stack([np.interp(wavelengths_nm, nm, row) for row in functions.T])
    inside = (nm >= wavelengths_nm[0]) & (nm <= wavelengths_nm[-1])
    return at * step, functions[inside].T @ hats(nm[inside], wavelengths_nm)


def smooth(nm: Array, wavelengths_nm: Array) -> Array:
    """(n, N) the smoothest curves at every nm that are 1 at one wavelength and 0 at the others.

    Example:
        >>> import numpy as np
        >>> nm = np.arange(400.0, 501.0)
        >>> of = smooth(nm, np.array([420.5, 480.0]))
        >>> bool(np.allclose(of.sum(axis=1), 1)), round(float(of[80, 1]), 6)
        (True, 1.0)
    """
    import numpy as np

    points, count = len(nm), len(wavelengths_nm)
    if count == points and np.array_equal(nm, wavelengths_nm):
        return np.eye(points)
    slope, bend = np.diff(np.eye(points), axis=0), np.diff(np.eye(points), 2, axis=0)
    stiff = bend.T @ bend + slope.T @ slope / TENSION_NM**2
    held = np.stack([np.interp(wavelengths_nm, nm, row) for row in np.eye(points)], axis=1)
    matrix = np.block([[stiff, held.T], [held, np.zeros((count, count))]])
    right = np.concatenate([np.zeros((points, count)), np.eye(count)])
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-13)[0][:points])


def spread(
    nm: Array, wavelengths_nm: Array, light: Array, filters: Array, to_xyz: Array, functions: Array
) -> Array:
    """(G, N) the map from what lanes hold to a regular grid.

    Args:
        nm: (n,) every nm.
        wavelengths_nm: (G,) of the grid.
        light: (n,) the lamp's spectrum.
        filters: (n, N) from lanes to the filter at every nm, as `smooth` has it, lanes divided by the lamp's.
        to_xyz: (3, N) what the lanes are worth.
        functions: (n, 3) of the observer, K_m in them.
    """
    import numpy as np

    weight = _on_grid(nm, wavelengths_nm, light)
    at = np.stack([np.interp(wavelengths_nm, nm, column) for column in filters.T], axis=1)
    spectra = weight[:, None] * at
    both = np.concatenate(readers(nm, wavelengths_nm, functions))
    missing = np.concatenate([to_xyz, to_xyz]) - both @ spectra
    room = weight[:, None] * both.T
    inner = both @ room
    return np.asarray(spectra + room @ (np.linalg.pinv(inner, rcond=ALIKE) @ missing))


def _on_grid(nm: Array, wavelengths_nm: Array, light: Array) -> Array:
    """(G,) a spectrum on the grid: the values whose straight lines are nearest to it."""
    import numpy as np

    from illuminant.display.refitting import hats, nonnegative

    lines = hats(nm, wavelengths_nm)
    nearest = np.linalg.lstsq(lines, light, rcond=None)[0]
    if (nearest >= 0).all() or len(nearest) == len(nm):
        return np.asarray(np.maximum(nearest, 0.0))
    return nonnegative(lines.T @ lines, lines.T @ light)


def reader_error(xyz: Array, read: Array, white: float) -> Error:
    """ΔE00 between the XYZ of an image and that which a reader finds, over all pixels, beside D65 of a luminance."""
    import numpy as np

    beside = np.array(D65) * (white or 1.0)
    lab = [core().xyz_to_lab(np.ascontiguousarray(part, np.float64), beside) for part in (xyz, read)]
    found = core().delta_e_2000(*lab)
    return Error(float(found.mean()), float(found.max()))
