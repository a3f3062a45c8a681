"""Weights from the lanes of kept spectra to the colours of another lamp or another observer.

A path leaves of a lamp's light L(λ) a filter f(λ): the product of the reflectances that it met. Lanes know it at a few
wavelengths λᵢ only, fᵢ = laneᵢ / Lᵢ, so what a lamp L′ makes of it for an observer with the functions x̄ is estimated by

    X = K_m ∫ x̄(λ) L′(λ) f(λ) dλ ≈ Σᵢ wᵢ fᵢ          (K_m = 683 lm/W; sums at 1 nm; likewise Y and Z).

- Where the wavelengths are close and even (`1nm`, `uniform:N`), f is a straight line between neighbours, and
  wᵢ = K_m Σ hatᵢ(λ) x̄(λ) L′(λ) is integration (`integrated`).
- Else the weights are those that make the colours of what the scene can show least wrong (`fitted`): products of one to
  four of its reflectances, and with little weight smooth steps that stand for what is not known. The error is
  CIEDE2000 in its quadratic form, as exposed and as if each colour were lit to half the white; the bare lamp is held.
  This is the way by which `fitted:N` found its own weights (crates/sampling). Weights are kept from falling below
  zero wherever the observer's functions are (Lawson and Hanson 1974, chapter 23).

`error_of` says what weights cost in ΔE00 over those products.

References: Lawson, Hanson, "Solving Least Squares Problems", 1974; Luo, Cui, Rigg, "The development of the CIE 2000
colour-difference formula", 2001.

Example:
    >>> import numpy as np
    >>> nm = np.arange(380.0, 781.0)
    >>> weights = integrated(nm, np.array([450.0, 550.0, 650.0]), np.ones((401, 3)))
    >>> weights.shape, float(weights[0].sum())
    ((3, 3), 401.0)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.core import core

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Error", "Products", "error_of", "fitted", "integrated", "nonnegative", "products"]

DEPTH = 4
"""The most reflections of a product."""

MOST = 400
"""The most products of each number of reflections."""

UNKNOWN = 0.02
"""What materials that are not in the scene weigh beside all others."""

HOLD_WHITE = 1e6
"""How strongly the colour of a bare lamp is held, beside all products together."""

DARKEST = 1e-4
"""Products darker than this fraction of the white are lit no further when they are lit to half of it."""

LEAST_OF_WHITE = 0.01
"""The least that X or Z of a white may be beside its Y: beside deep red light lightness would know no bounds."""

RIDGE = 1e-9
"""How strongly weights are drawn to those of integration, beside the whole: it settles what the products leave open."""


@dataclass(frozen=True)
class Error:
    """ΔE00 against 1 nm over the products of a scene: mean and largest."""

    mean: float
    max: float

    def to_json(self) -> dict[str, float]:
        """For the settings of an image, to four digits."""
        return {"mean": float(f"{self.mean:.4g}"), "max": float(f"{self.max:.4g}")}


@dataclass(frozen=True, eq=False)
class Products:
    """What paths can leave of a lamp's light.

    Attributes:
        filters: (P, n) at every nm: white first, then products of the scene's reflectances, then what is not known.
        weights: (P,) how much each counts in a fit.
        known: how many of them, from the first, are white and products of the scene.
    """

    filters: Array
    weights: Array
    known: int


def products(reflectances: Array, nm: Array) -> Products:
    """The products of a scene.

    Args:
        reflectances: (M, n) at every nm.
        nm: (n,) those wavelengths.

    Returns:
        Products of one to four reflectances, all of them while they are few, else a sample (the same each time).

    Example:
        >>> import numpy as np
        >>> products(np.full((2, 3), 0.5), np.array([500.0, 501.0, 502.0])).known
        15
    """
    import itertools
    import math

    import numpy as np

    count = len(reflectances)
    random = np.random.default_rng(0)
    filters, weights = [np.ones((1, len(nm)))], [np.zeros(1)]
    for size in range(1, DEPTH + 1 if count else 1):
        if math.comb(count + size - 1, size) <= MOST:
            chosen = np.array(list(itertools.combinations_with_replacement(range(count), size)))
        else:
            chosen = np.unique(np.sort(random.integers(0, count, (MOST, size)), axis=1), axis=0)
        filters.append(reflectances[chosen].prod(axis=1))
        # Each reflection more leaves less light, so its products count for less of what a pixel shows.
        weights.append(np.full(len(chosen), 0.5**size / len(chosen)))
    known = sum(map(len, filters))
    total = float(np.concatenate(weights).sum()) or 1.0
    centres, widths = np.arange(400.0, 701.0, 20.0), np.array([8.0, 25.0, -8.0, -25.0])
    slope = (nm - centres[:, None, None]) / widths[:, None]
    steps = (0.05 + 0.85 / (1.0 + np.exp(-np.clip(slope, -50, 50)))).reshape(-1, len(nm))
    filters.append(steps)
    weights.append(np.full(len(steps), UNKNOWN * total / len(steps)))
    return Products(np.concatenate(filters), np.concatenate(weights), known)


def hats(nm: Array, wavelengths_nm: Array) -> Array:
    """The functions (n, N) that are 1 at one wavelength and 0 at the others, straight between, held at the ends."""
    import numpy as np

    return np.stack([np.interp(nm, wavelengths_nm, row) for row in np.eye(len(wavelengths_nm))], axis=1)


def integrated(nm: Array, wavelengths_nm: Array, curves: Array) -> Array:
    """The weights (3, N) that integrate straight lines between wavelengths against curves.

    Args:
        nm: (n,) every nm.
        wavelengths_nm: (N,) increasing.
        curves: (n, 3), such as K_m times the observer's functions times a lamp's spectrum.
    """
    return curves.T @ hats(nm, wavelengths_nm)


def fitted(
    features: Array, targets: Array, white: Array, counts: Array, prior: Array, *, positive: bool = True
) -> Array:
    """The weights (3, N) that make colours least wrong.

    Args:
        features: (P, N) what the lanes hold of each product.
        targets: (P, 3) XYZ of each product, integrated at 1 nm.
        white: (P, 3) XYZ of the white beside which each is seen. A product that is its own white is held.
        counts: (P,) how much each counts.
        prior: (3, N) the weights that are taken where the products leave them open.
        positive: whether weights must not be negative.
    """
    import numpy as np

    metric = _metric(targets, _floored(white)) * counts[:, None, None]
    bare = np.isclose(targets, white, rtol=1e-12).all(axis=1)
    held = np.einsum("pi,ij->pij", 1.0 / np.maximum(white, white[:, 1:2]) ** 2, np.eye(3))
    total = float(counts.sum()) or 1.0
    metric[bare] = HOLD_WHITE * total * held[bare]
    count = features.shape[1]
    matrix = np.einsum("pi,pab,pj->iajb", features, metric, features, optimize=True)
    matrix = matrix.reshape(3 * count, 3 * count)
    right = np.einsum("pi,pab,pb->ia", features, metric, targets, optimize=True).ravel()
    ridge = RIDGE * np.trace(matrix) / HOLD_WHITE / max(1, 3 * count)
    matrix[np.diag_indices_from(matrix)] += max(ridge, 1e-300)
    right += ridge * prior.T.ravel()
    solution = nonnegative(matrix, right) if positive else np.linalg.lstsq(matrix, right, rcond=None)[0]
    return np.asarray(solution.reshape(count, 3).T)


def error_of(weights: Array, features: Array, targets: Array, white: Array) -> Error:
    """What weights cost: ΔE00 between targets and what they make of the lanes.

    Args:
        weights, features, targets, white: as in `fitted`.
    """
    white = _floored(white)
    lab = [_lab(xyz, white) for xyz in (targets, features @ weights.T)]
    found = core().delta_e_2000(*lab)
    return Error(float(found.mean()), float(found.max()))


def nonnegative(matrix: Array, right: Array) -> Array:
    """The x ≥ 0 that minimises xᵀAx − 2bᵀx for a positive definite A (Lawson and Hanson 1974, NNLS).

    Example:
        >>> import numpy as np
        >>> nonnegative(np.eye(2), np.array([1.0, -1.0])).tolist()
        [1.0, 0.0]
    """
    import numpy as np

    # Unknowns of one size each: else rounding in the larger ones hides the smaller.
    scale = 1.0 / np.sqrt(np.diag(matrix))
    matrix, right = matrix * scale[:, None] * scale, right * scale
    count = len(right)
    free = np.zeros(count, bool)
    x = np.zeros(count)
    for _ in range(10 * count):
        slope = right - matrix @ x
        slope[free] = -np.inf
        enters = int(np.argmax(slope))
        if slope[enters] <= 1e-12 * float(np.abs(right).max()):
            break
        free[enters] = True
        for _ in range(count):
            wanted = np.zeros(count)
            wanted[free] = np.linalg.lstsq(matrix[np.ix_(free, free)], right[free], rcond=None)[0]
            below = free & (wanted <= 0.0)
            if not below.any():
                x = wanted
                break
            step = float((x[below] / np.maximum(x[below] - wanted[below], 1e-300)).min())
            x = x + step * (wanted - x)
            free &= x > 1e-15 * float(np.abs(x).max(initial=0.0))
            x[~free] = 0.0
    return np.asarray(x * scale)


def _floored(white: Array) -> Array:
    import numpy as np

    return np.asarray(np.maximum(white, LEAST_OF_WHITE * white[..., 1:2]))


def _lab(xyz: Array, white: Array) -> Array:
    """L*a*b* of each colour beside a white of its own, on which it depends by ratios alone."""
    import numpy as np

    return np.asarray(core().xyz_to_lab(np.ascontiguousarray(xyz / white), (1.0, 1.0, 1.0)))


def _metric(xyz: Array, white: Array) -> Array:
    """The matrices (P, 3, 3) of ΔE00² for small differences of XYZ: as exposed, and as if lit to half the white."""
    import numpy as np

    scale = 0.5 * white[:, 1] / np.maximum(xyz[:, 1], DARKEST * white[:, 1])
    lit = _metric_at(xyz * scale[:, None], white)
    return np.asarray(_metric_at(xyz, white) + (scale**2)[:, None, None] * lit)


def _metric_at(xyz: Array, white: Array) -> Array:
    """The same at these colours, by finite differences: ΔE00² is quadratic near 0, so six steps give its matrix."""
    import numpy as np

    lab = _lab(xyz, white)
    step = 1e-3 * white

    def squared(direction: Array) -> Array:
        moved = _lab(xyz + step * direction, white)
        back = _lab(xyz - step * direction, white)
        return np.asarray(0.5 * (core().delta_e_2000(lab, moved) ** 2 + core().delta_e_2000(lab, back) ** 2))

    axes = np.eye(3)
    single = [squared(axis) for axis in axes]
    metric = np.empty((len(xyz), 3, 3))
    for a in range(3):
        for b in range(3):
            both = squared(axes[a] + axes[b]) if a != b else 4.0 * single[a]
            metric[:, a, b] = 0.5 * (both - single[a] - single[b])
    metric /= step[:, :, None] * step[:, None, :]
    # Steps of finite size may leave it a trace below zero in one direction.
    values, vectors = np.linalg.eigh(metric)
    return np.asarray(np.einsum("pik,pk,pjk->pij", vectors, np.maximum(values, 0.0), vectors))
