"""What a rough surface reflects by the theory of chapter 2 with F = 1: coherent and incoherent (book eqs 2.36 to 2.47).

The coherent share is r_σ G (eqs 2.35 to 2.37). The incoherent one is the integral of eq 2.39 over the hemisphere,
∫ R_bd cos θ_r dω = 1/cos θ_i ∫ D G dω, with D of eq 2.42 and Sancer's G (eq 2.22). A lobe may be a degree wide, so the
integral is taken by Gauss's rule with directions that crowd about the mirror direction; it agrees with
`illuminant.verify.integrate` to 0.001 at a small part of its cost.

Angles are degrees from the normal, heights σ nm, slopes m those of eq 2.19.

Example:
    >>> glossy = coherent(0.0, 30.0) + incoherent(0.0, 0.1, [30.0])[0]
    >>> bool(abs(glossy - 1.0) < 0.02)
    True
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = [
    "HEIGHTS_NM",
    "SLOPES",
    "WAVELENGTH_NM",
    "Directions",
    "Energies",
    "Equilibrium",
    "coherent",
    "directions",
    "equilibrium",
    "incoherent",
    "sections",
    "surface",
]

WAVELENGTH_NM = 580.0
"""The wavelength of the book's figures 2.16 to 2.22."""

SLOPES = (0.02, 0.10, 0.50, 1.00)
"""The slopes m of those figures."""

HEIGHTS_NM = (30.0, 80.0, 150.0)
"""Heights at which the surfaces are cut."""


@dataclass(frozen=True)
class Directions:
    """Where light goes that comes from one angle: the nodes of a rule of integration over the hemisphere.

    Attributes:
        cos_in: cosine of the angle of incidence.
        theta_out: angles from the normal, radians.
        azimuth: from the plane of incidence, radians; 0 is the side of the mirror direction.
        cos_half: N·H.
        weight: solid angle that a node stands for, sr.
    """

    cos_in: float
    theta_out: Array
    azimuth: Array
    cos_half: Array
    weight: Array

    @property
    def cos_out(self) -> Array:
        """Cosines of the angles from the normal."""
        import numpy as np

        return np.cos(self.theta_out)


def directions(theta_deg: float, m: float, rows: int = 32) -> Directions:
    """Nodes that crowd about the mirror direction as closely as a lobe of slope m asks for.

    Args:
        theta_deg: angle of incidence, 0 to below 90.
        m: slope, above 0.
        rows: nodes in elevation; half as many in azimuth over a half of the hemisphere, which stands for both.
    """
    import numpy as np

    theta = np.radians(theta_deg)
    # A facet that is tilted by δ turns the light by 2δ in the plane of incidence and by 2δ cos θ across it.
    width = min(m, 1.0)
    across = min(np.pi, 2.0 * width * np.cos(theta) / max(np.sin(theta), 1e-3))
    out, out_weight = _crowded(-theta, np.pi / 2.0 - theta, width, rows)
    turn, turn_weight = _crowded(0.0, np.pi, across, rows // 2)
    t, phi = (one.ravel() for one in np.meshgrid(theta + out, turn, indexing="ij"))
    half = 2.0 + 2.0 * (np.cos(theta) * np.cos(t) - np.sin(theta) * np.sin(t) * np.cos(phi))
    cos_half = (np.cos(theta) + np.cos(t)) / np.sqrt(np.maximum(half, 1e-300))
    weight = 2.0 * np.outer(out_weight, turn_weight).ravel() * np.sin(t)
    return Directions(float(np.cos(theta)), t, phi, cos_half.clip(0.0, 1.0), weight)


def _crowded(low: float, high: float, width: float, count: int) -> tuple[Array, Array]:
    """Gauss's rule on x = w sinh u from low to high: nodes crowd about 0, evenly within w, then ever more sparsely."""
    import numpy as np

    node, weight = np.polynomial.legendre.leggauss(count)
    start, end = np.arcsinh(low / width), np.arcsinh(high / width)
    u = start + (end - start) * (node + 1.0) / 2.0
    return width * np.sinh(u), weight * (end - start) / 2.0 * width * np.cosh(u)


def coherent(theta_deg: ArrayLike, sigma_nm: ArrayLike, m: float | None = None) -> Array:
    """The coherent share r_σ, or r_σ G when a slope is given (book eqs 2.35 to 2.37)."""
    import numpy as np

    from illuminant import optics

    cosine = np.cos(np.radians(np.asarray(theta_deg, float)))
    kept = np.asarray(optics.coherent_fraction(optics.apparent_roughness(sigma_nm, WAVELENGTH_NM, cosine)))
    return kept if m is None else kept * optics.masking_sancer(cosine, cosine, m)


def incoherent(
    theta_deg: float, m: float, sigma_nm: ArrayLike, masked: bool = True, book: bool = False
) -> Array:
    """The incoherent share of what comes from one angle, for surfaces of several heights (book eqs 2.39 to 2.42).

    Args:
        theta_deg: angle of incidence, 0 to below 90.
        m: slope.
        sigma_nm: heights.
        masked: with Sancer's G; without, D alone.
        book: D as the book computes it (III.4), which takes a thirtieth of the time of the whole series.

    Returns:
        As many shares as there are heights.
    """
    import numpy as np

    from illuminant import optics

    at = directions(theta_deg, m)
    heights = np.asarray(sigma_nm, float).reshape(-1, 1)
    g = optics.apparent_roughness(heights, WAVELENGTH_NM, at.cos_in, at.cos_out)
    density = np.asarray(optics.wave_distribution(at.cos_half, m, g, book=book))
    if masked:
        density = density * optics.masking_sancer(at.cos_in, at.cos_out, m)
    return np.asarray(density @ at.weight / at.cos_in)


@dataclass(frozen=True)
class Energies:
    """Shares of what comes in, over height and angle: rows of heights, columns of angles.

    Attributes:
        sigma_nm: heights.
        theta_deg: angles of incidence.
        coherent: r_σ G.
        facets: the incoherent share of D alone.
        incoherent: that of D and G.
    """

    sigma_nm: Array
    theta_deg: Array
    coherent: Array
    facets: Array
    incoherent: Array

    @property
    def total(self) -> Array:
        """What the theory reflects, coherently and incoherently."""
        return self.coherent + self.incoherent


def _energies(m: float, sigma: Array, theta: Array, book: bool) -> Energies:
    import numpy as np

    facets, both = (
        np.stack([incoherent(float(one), m, sigma, masked, book) for one in theta], axis=1)
        for masked in (False, True)
    )
    return Energies(sigma, theta, coherent(theta, sigma[:, None], m), facets, both)


@cache
def surface(m: float, quick: bool) -> Energies:
    """Over 0 to 200 nm and 0 to 89 degrees, D as the book computes it; figures 2.19 to 2.22 share it."""
    import numpy as np

    sigma = np.linspace(0.0, 200.0, 9 if quick else 21)
    theta = np.array([0, 20, 40, 60, 70, 80, 85, 89.0]) if quick else np.r_[0:60:5, 60:86:2.5, 86:90:1.0]
    return _energies(m, sigma, theta, book=True)


@cache
def sections(m: float, quick: bool) -> tuple[Energies, Energies]:
    """At the heights `HEIGHTS_NM`: with the whole series of D, and with D as the book computes it."""
    import numpy as np

    theta = np.array(
        [0, 30, 60, 70, 80, 89.0] if quick else [0, 10, 20, 30, 40, 50, 60, 65, 70, 75, 80, 83, 86, 88, 89.0]
    )
    series, book = (_energies(m, np.array(HEIGHTS_NM), theta, one) for one in (False, True))
    return series, book


@dataclass(frozen=True)
class Equilibrium:
    """What the model `general` reflects of F = 1, at each angle.

    Attributes:
        theta_deg: angles of incidence.
        coherent: in the mirror direction.
        total: everywhere.
    """

    theta_deg: Array
    coherent: Array
    total: Array


@cache
def equilibrium(
    m: float,
    sigma_nm: float | None,
    theta_deg: tuple[float, ...],
    draws: int,
    distribution: str = "beckmann",
) -> Equilibrium:
    """An audit of the model `general` with a metal that reflects all.

    Args:
        m: slope, or α of GGX.
        sigma_nm: height, or None for one that is much higher than a wavelength.
        theta_deg: angles of incidence.
        draws: directions for each angle; the noise of the total is about 0.3/√draws.
        distribution: of slopes, beckmann or ggx.
    """
    import numpy as np

    from illuminant import auditing

    table: dict[str, str | float] = {"kind": "conductor", "n": 1.0, "k": 1e4, "roughness": m}
    table["distribution"] = distribution
    if sigma_nm is not None:
        table["sigma_nm"] = sigma_nm
    found = auditing.audit(table, angles_deg=theta_deg, wavelengths_nm=[WAVELENGTH_NM], draws=draws)[0]
    mirrored = found.coherent_reflection[:, 0]
    return Equilibrium(np.array(theta_deg), mirrored, mirrored + found.scattered_reflection[:, 0])
