"""Testers of reflectance functions and of materials: energy, reciprocity, normalisation, chi-square.

For a function of one's own, vectorised: `f(v, l)` takes unit vectors of shape (n, 3) with z along the normal, from the
surface to the viewer and to the light, and gives the bidirectional function, 1/sr, of shape (n,). For a material of
illuminant: `audit`.

Example:
    >>> import numpy as np
    >>> grey = lambda v, l: np.full(len(v), 0.5 / np.pi)
    >>> round(albedo(grey, 40.0), 3)
    0.5
    >>> reciprocity(grey).largest
    0.0
    >>> phong = lambda v, l: np.maximum(0, v[:, 2] * l[:, 2] - v[:, 0] * l[:, 0] - v[:, 1] * l[:, 1]) ** 5 / l[:, 2]
    >>> reciprocity(phong).passes
    False
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.core import core
from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Function = Callable[[Array, Array], Array]

__all__ = ["ChiSquare", "Reciprocity", "albedo", "chi_square", "furnace", "integrate", "reciprocity"]


def _values(result: object, count: int) -> Array:
    """What a function gave, one finite number for each direction."""
    import numpy as np

    values = np.asarray(result, dtype=np.float64)
    if values.shape != (count,):
        raise DataError(f"the function gave an array of shape {values.shape}; expected ({count},)")
    if not np.isfinite(values).all():
        raise DataError("the function gave a value that is not finite")
    return values


def _at(theta_deg: float, count: int) -> Array:
    import numpy as np

    if not 0.0 <= theta_deg < 90.0:
        raise DataError(f"an angle lies from 0 to below 90 degrees; found {theta_deg:g}")
    theta = np.radians(theta_deg)
    return np.tile([np.sin(theta), 0.0, np.cos(theta)], (count, 1))


def integrate(f: Callable[[Array], Array], *, tolerance: float = 1e-6, increments: int = 0) -> float:
    """The integral of a function of direction over the hemisphere, ∫ f dω.

    Args:
        f: takes directions (n, 3), gives (n,).
        tolerance: relative; the number of directions grows until two results agree. For functions whose features are
            wider than about a degree.
        increments: instead, the book's integrator (III.2) with this many steps of elevation.

    Example:
        >>> import numpy as np
        >>> round(integrate(lambda d: d[:, 2]), 6) == round(np.pi, 6)
        True
        >>> round(integrate(lambda d: d[:, 2], increments=32), 6)      # the book's value
        3.142539
    """
    import numpy as np

    if increments < 0 or increments > 2000:
        raise DataError(f"increments lie from 1 to 2000, found {increments}")
    if increments:
        cells = core().hemisphere_directions(increments)
        directions = np.array([direction for direction, _ in cells])
        return float(_values(f(directions), len(directions)) @ np.array([omega for _, omega in cells]))
    last = None
    for rows in (16, 32, 64, 128, 256, 512):
        x, w = np.polynomial.legendre.leggauss(rows)
        theta, weight = (x + 1) * np.pi / 4, w * np.pi / 4
        phi = (np.arange(2 * rows) + 0.5) * np.pi / rows
        t, p = np.meshgrid(theta, phi, indexing="ij")
        directions = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(
            -1, 3
        )
        weights = np.repeat(weight * np.sin(theta), 2 * rows) * np.pi / rows
        found = float(_values(f(directions), len(directions)) @ weights)
        if last is not None and abs(found - last) <= tolerance * max(abs(found), 1e-12):
            return found
        last = found
    return found


def albedo(f: Function, theta_deg: float, *, tolerance: float = 1e-6) -> float:
    """The share of the light from an angle that is reflected, ∫ f cos θ dω (book eq 2.38).

    Example:
        >>> import numpy as np
        >>> round(albedo(lambda v, l: np.full(len(v), 1 / np.pi), 80.0), 6)
        1.0
    """

    def given(directions: Array) -> Array:
        v = _at(theta_deg, len(directions))
        result: Array = _values(f(v, directions), len(directions)) * directions[:, 2]
        return result

    return integrate(given, tolerance=tolerance)


@dataclass(frozen=True)
class Reciprocity:
    """The pair of directions that differ most when they change places.

    Attributes:
        largest: |f(v, l) − f(l, v)| relative to the larger.
        v, l: the directions.
    """

    largest: float
    v: tuple[float, float, float]
    l: tuple[float, float, float]  # noqa: E741

    @property
    def passes(self) -> bool:
        """Whether they agree to 1e-4."""
        return self.largest <= 1e-4


def reciprocity(f: Function, *, pairs: int = 10_000, seed: int = 0, floor: float = 1e-3) -> Reciprocity:
    """Helmholtz reciprocity of a function, over random pairs of directions above the surface.

    Args:
        f: the function.
        pairs: how many pairs.
        seed: of the random numbers.
        floor: smaller values, 1/sr, are compared relative to this one.
    """
    import numpy as np

    random = np.random.default_rng(seed)

    def directions() -> Array:
        z = random.uniform(0.01, 1.0, pairs)
        phi = random.uniform(0.0, 2 * np.pi, pairs)
        r = np.sqrt(1 - z * z)
        return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)

    v, light = directions(), directions()
    a, b = _values(f(v, light), pairs), _values(f(light, v), pairs)
    relative = np.abs(a - b) / np.maximum(np.maximum(a, b), floor)
    worst = int(np.argmax(relative))
    one, two = (tuple(float(c) for c in side[worst]) for side in (v, light))
    return Reciprocity(float(relative[worst]), one, two)  # type: ignore[arg-type]


def furnace(f: Function, angles_deg: tuple[float, ...] = (0.0, 30.0, 60.0, 80.0)) -> dict[float, float]:
    """What a surface shows in a furnace that sends 1 from everywhere: its albedo at each angle, at most 1.

    Example:
        >>> import numpy as np
        >>> bright = furnace(lambda v, l: np.full(len(v), 1.2 / np.pi))
        >>> max(bright.values()) > 1       # it makes light
        True
    """
    return {angle: albedo(f, angle) for angle in angles_deg}


@dataclass(frozen=True)
class ChiSquare:
    """The result of a chi-square test.

    Attributes:
        statistic: Σ (observed − expected)²/expected.
        degrees_of_freedom: cells after pooling, less one.
        p_value: the chance of so large a statistic if the density is right.
        probability: ∫ pdf dω.
    """

    statistic: float
    degrees_of_freedom: int
    p_value: float
    probability: float

    @property
    def passes(self) -> bool:
        """Whether the density is believed at 1 %, and integrates to at most 1.001."""
        return self.p_value >= 0.01 and self.probability <= 1.001


def chi_square(
    sample: Callable[[Array], Array],
    pdf: Callable[[Array], Array],
    *,
    draws: int = 100_000,
    seed: int = 0,
    rows: int = 16,
) -> ChiSquare:
    """Whether directions have the density that is said of them (Pearson 1900).

    Args:
        sample: takes numbers (n, 3) in [0, 1), gives directions (n, 3); a row of NaN where it gives none.
        pdf: takes directions (n, 3), gives densities (n,), 1/sr; over the whole sphere.
        draws: how many directions.
        seed: of the random numbers.
        rows: rows of cells from pole to pole; twice as many around. Cells that expect fewer than 5 are pooled.

    Example:
        >>> import numpy as np
        >>> def cosine(u):
        ...     r, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
        ...     return np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=-1)
        >>> chi_square(cosine, lambda d: np.maximum(d[:, 2], 0) / np.pi).passes
        True
        >>> chi_square(cosine, lambda d: np.where(d[:, 2] > 0, 0.5 / np.pi, 0)).passes
        False
    """
    import numpy as np

    if not 100 <= draws <= 50_000_000 or not 2 <= rows <= 512:
        raise DataError("draws lie from 100 to 50,000,000 and rows from 2 to 512")
    directions = np.asarray(sample(np.random.default_rng(seed).random((draws, 3))), dtype=np.float64)
    if directions.shape != (draws, 3):
        raise DataError(f"sample gave an array of shape {directions.shape}; expected ({draws}, 3)")
    drawn = directions[~np.isnan(directions).any(axis=1)]
    lengths = np.linalg.norm(drawn, axis=1)
    if len(drawn) and np.abs(lengths - 1).max() > 1e-4:
        raise DataError("sample gave a direction that is no unit vector")
    theta = np.arccos(np.clip(drawn[:, 2], -1, 1))
    phi = np.arctan2(drawn[:, 1], drawn[:, 0]) % (2 * np.pi)
    i = np.minimum((theta / np.pi * rows).astype(int), rows - 1)
    j = np.minimum((phi / np.pi * rows).astype(int), 2 * rows - 1)
    observed = np.bincount(i * 2 * rows + j, minlength=2 * rows * rows).astype(float)
    expected = draws * _cells(pdf, rows)
    probability = float(expected.sum() / draws)
    # Draws without a direction are a cell of their own.
    observed = np.append(observed, draws - len(drawn))
    expected = np.append(expected, draws * max(0.0, 1.0 - probability))
    order = np.argsort(expected)
    observed, expected = observed[order], expected[order]
    pooled = int(np.searchsorted(expected, 5.0))
    while pooled < len(expected) and 0 < expected[:pooled].sum() < 5.0:
        pooled += 1
    small = expected[:pooled].sum()
    stray = observed[:pooled].sum()
    if small > 0:
        observed = np.append(observed[pooled:], stray)
        expected = np.append(expected[pooled:], small)
    else:
        observed, expected = observed[pooled:], expected[pooled:]
    freedom = max(len(expected) - 1, 1)
    statistic = float(((observed - expected) ** 2 / expected).sum())
    broken = small <= 0 and stray > 1e-4 * draws
    p_value = 0.0 if broken else float(core().chi_square_p_value(statistic, freedom))
    return ChiSquare(statistic, freedom, p_value, probability)


def _cells(pdf: Callable[[Array], Array], rows: int) -> Array:
    """The probability of each cell, by 4 × 4 Gauss points."""
    import numpy as np

    x, w = np.polynomial.legendre.leggauss(4)
    offsets, weights = (x + 1) / 2, w / 2
    theta = ((np.arange(rows)[:, None] + offsets) * np.pi / rows).reshape(-1)
    phi = ((np.arange(2 * rows)[:, None] + offsets) * np.pi / rows).reshape(-1)
    t, p = np.meshgrid(theta, phi, indexing="ij")
    directions = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
    density = _values(pdf(directions.reshape(-1, 3)), t.size).reshape(t.shape) * np.sin(t)
    each = np.outer(np.tile(weights, rows), np.tile(weights, 2 * rows)) * (np.pi / rows) ** 2
    result: Array = (density * each).reshape(rows, 4, 2 * rows, 4).sum(axis=(1, 3)).reshape(-1)
    return result
