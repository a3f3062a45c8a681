"""Who looks at kept spectra: an observer of the CIE, or a camera by its curves.

An observer is three functions of wavelength that turn radiance into three numbers by 1 nm sums,
X = K_m Σ x̄(λ) L(λ), K_m = 683 lm/W. `2` is CIE 1931 2°, `10` is CIE 1964 10°.

A camera is a CSV file of four columns: wavelength in nm and its responses for red, green and blue, in any unit. What it
records is not XYZ, so a matrix takes it there:

- `fit` (default): the 3 × 3 matrix that makes the 24 ColorChecker patches under the light of the scene least wrong in
  CIEDE2000, white exact, as cameras are characterised. How far it misses them is told.
- `balance`: no more than a white balance. Red, green and blue are scaled so that the light of the scene is (1, 1, 1),
  and shown as they are as linear sRGB: colours as the sensor sees them.
- a CSV file of three lines of three numbers, from red, green, blue to X, Y, Z; its scale is set so that white has its
  luminance.

Errors: `UsageError` for a name that is none, `DataError` for a file that is damaged.

Example:
    >>> import numpy as np
    >>> nm = np.arange(380.0, 781.0)
    >>> named("10", nm, np.ones(401)).name
    'CIE 1964 10°'
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.display.refitting import Error, error_of, fitted
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["LUMINOUS_EFFICACY", "SHORT", "STANDARD", "Observer", "named", "standard"]

LUMINOUS_EFFICACY = 683.0
"""K_m in lm/W."""

STANDARD = "CIE 1931 2°"
"""The observer by which images are rendered."""

SHORT = {"2": STANDARD, "10": "CIE 1964 10°"}
"""Observers by their degrees."""


@dataclass(frozen=True, eq=False)
class Observer:
    """Three functions of wavelength.

    Attributes:
        name: of the CIE, or of the file.
        functions: (n, 3) K_m x̄, ȳ, z̄ at every nm, or what stands in for them.
        matrix: how a camera's numbers become XYZ; empty for an observer.
        error: ΔE00 of a camera over the ColorChecker, if that was its matrix's purpose.
    """

    name: str
    functions: Array
    matrix: str = ""
    error: Error | None = None


def standard(nm: Array, name: str = STANDARD) -> Observer:
    """An observer of the CIE at every nm."""
    return Observer(name, LUMINOUS_EFFICACY * core().matching_functions(nm, name))


def named(word: str, nm: Array, light: Array, matrix: str = "fit") -> Observer:
    """The observer or camera that a word means.

    Args:
        word: `2`, `10`, the name of an observer, or a CSV file.
        nm: (n,) every nm.
        light: (n,) the light of the scene, for a camera's white.
        matrix: for a camera: `fit`, `balance` or a CSV file.

    Raises:
        UsageError: there is no such observer, or the matrix cannot be.
        DataError: a file is damaged, or has not the columns that it should.
    """
    name = SHORT.get(word, word)
    if name in core().observers():
        return standard(nm, name)
    path = Path(word).expanduser()
    if not path.is_file() and path.suffix.lower() not in (".csv", ".txt", ".tsv"):
        known = ", ".join([*SHORT, *core().observers()])
        raise UsageError(
            f"--observer {word}: there is no such observer; known are {known}, or a CSV file of a camera's curves."
        )
    curves = _curves(path, nm)
    white = light @ curves
    if not (white > 0).all():
        raise DataError(f"{path}: the camera sees nothing of the light of this scene in one of its colours.")
    balanced = curves / white
    xyz = LUMINOUS_EFFICACY * core().matching_functions(nm, STANDARD)
    return _camera(path, balanced, white, light, xyz, matrix, nm)


def _camera(
    path: Path, balanced: Array, white: Array, light: Array, xyz: Array, matrix: str, nm: Array
) -> Observer:
    import numpy as np

    if matrix == "fit":
        patches = _colorchecker(nm) * light
        features, targets = patches @ balanced, patches @ xyz
        bare = np.broadcast_to(light @ xyz, targets.shape)
        weights = fitted(
            features, targets, bare, np.ones(len(targets)), np.tile(light @ xyz, (3, 1)).T / 3, positive=False
        )
        return Observer(path.name, balanced @ weights.T, matrix, error_of(weights, features, targets, bare))
    if matrix == "balance":
        rows = np.asarray(core().rgb_system("sRGB")["to_xyz"]) * float(light @ xyz[:, 1])
    else:
        rows = _matrix(matrix) * white
        luminance = float(rows[1].sum())
        if not luminance > 0:
            raise DataError(f"{matrix}: this matrix gives the light of the scene no luminance above 0.")
        rows = rows * (float(light @ xyz[:, 1]) / luminance)
        matrix = Path(matrix).name
    return Observer(path.name, balanced @ rows.T, matrix)


def _curves(path: Path, nm: Array) -> Array:
    """(n, 3) the curves of a camera at every nm, zero outside their range."""
    import numpy as np

    from illuminant.spectrum_file import read_table

    table = read_table(path)
    if not table.rows:
        raise DataError(
            "no numbers in it; expected a wavelength and responses for red, green and blue", str(path)
        )
    rows = np.array(table.rows)
    if rows.shape[1] != 4:
        raise DataError(
            f"{rows.shape[1]} columns; expected 4: a wavelength in nm and the camera's red, green and blue",
            str(path),
            table.lines[0],
        )
    falls = np.flatnonzero(np.diff(rows[:, 0]) <= 0)
    if falls.size:
        raise DataError("expected increasing wavelengths", str(path), table.lines[falls[0] + 1])
    if not np.isfinite(rows).all():
        raise DataError("expected finite numbers", str(path))
    return np.stack([np.interp(nm, rows[:, 0], rows[:, i], 0.0, 0.0) for i in (1, 2, 3)], axis=1)


def _matrix(word: str) -> Array:
    """A 3 × 3 matrix from a file."""
    import numpy as np

    from illuminant.spectrum_file import text_of

    path = Path(word).expanduser()
    if not path.is_file():
        raise UsageError(
            f"--matrix {word}: expected fit, balance, or a CSV file of three lines of three numbers."
        )
    lines = [line.partition("#")[0].strip() for line in text_of(path).splitlines()]
    try:
        rows = np.array([[float(part) for part in line.replace(",", " ").split()] for line in lines if line])
        if rows.shape != (3, 3) or not np.isfinite(rows).all():
            raise ValueError
    except ValueError:
        raise DataError(
            "expected three lines of three numbers, from red, green, blue to X, Y, Z", word
        ) from None
    return rows


def _colorchecker(nm: Array) -> Array:
    """(25, n) white and the 24 reflectances of the ColorChecker at every nm."""
    import numpy as np

    from illuminant.display.patterns.color_checker import reflectances

    return np.stack([np.ones(len(nm)), *(curve.at(nm) for curve in reflectances())])
