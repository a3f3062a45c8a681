"""The optics of a surface: closed forms of chapter 2 of the book and what has become of them, over arrays.

All functions take numbers or arrays that broadcast, and return an array of float64 (or a float for numbers). `cos` is
the cosine of the angle between a direction and the normal, 0 to 1; angles are radians, heights and wavelengths nm, and
n and k relative to the medium in front. The physics is in Rust (`crates/optics`); where the book errs, the right form
is the default and the book's own has `book` or `approximated` in its name.

Example:
    >>> round(fresnel_dielectric(1.0, 1.5), 4)          # glass from the front
    0.04
    >>> fresnel_dielectric([1.0, 0.5, 0.0], 1.5).round(3).tolist()
    [0.04, 0.089, 1.0]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.core import core
from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.spectrum import Spectrum

    Values = float | NDArray[np.float64]

__all__ = [
    "abbe_number",
    "apparent_roughness",
    "apparent_roughness_transmitted",
    "beckmann",
    "cauchy",
    "coherent_fraction",
    "cook_interpolation",
    "correlation_distance",
    "diffuse_reflectance",
    "disc_solid_angle",
    "disc_solid_angle_error",
    "extinction_of_reflectance",
    "fraunhofer_lines",
    "fresnel_conductor",
    "fresnel_conductor_approximated",
    "fresnel_dielectric",
    "ggx",
    "ggx_alpha",
    "index_of_reflectance",
    "internal_reflectance",
    "irradiance",
    "lobe_coefficient",
    "lobe_half_angle",
    "lobe_value",
    "masking_sancer",
    "masking_smith",
    "masking_torrance_sparrow",
    "normal_reflectance",
    "paint_reflectance",
    "pigment_reflectance",
    "profile",
    "pseudo_material",
    "sellmeier",
    "slope",
    "specular_energy",
    "wave_distribution",
]

LOBES = ("phong", "blinn", "gaussian", "trowbridge-reitz", "cook")
POLARISATIONS = ("", "parallel", "perpendicular")


def _call(name: str, checks: dict[str, tuple[float, float]], *arguments: ArrayLike) -> Values:
    """A function of the core over broadcast arguments, after a check that they are finite and in range."""
    import numpy as np

    arrays = [np.asarray(argument, dtype=np.float64) for argument in arguments]
    for (what, (low, high)), array in zip(checks.items(), arrays, strict=True):
        inside = (array >= low) & (array <= high)
        if not inside.all():
            worst = array[~inside].flat[0]
            raise DataError(f"{what} must lie between {low:g} and {high:g}; found {worst:g}")
    try:
        arrays = list(np.broadcast_arrays(*arrays))
    except ValueError:
        shapes = ", ".join(str(array.shape) for array in arrays)
        raise DataError(f"arrays of shapes {shapes} do not fit each other") from None
    flat = [np.ascontiguousarray(array).reshape(-1) for array in arrays]
    result: NDArray[np.float64] = core().optics(name, flat).reshape(arrays[0].shape)
    return float(result) if result.ndim == 0 else result


COSINE = (0.0, 1.0)
INDEX = (1e-6, 1e6)
POSITIVE = (1e-300, 1e300)
NOT_NEGATIVE = (0.0, 1e300)
FRACTION = (0.0, 1.0)


def _polarised(name: str, polarisation: str) -> str:
    if polarisation not in POLARISATIONS:
        raise DataError(f'polarisation must be "parallel", "perpendicular" or "", found "{polarisation}"')
    return f"{name}_{polarisation}" if polarisation else name


def fresnel_dielectric(cos: ArrayLike, n: ArrayLike, polarisation: str = "") -> Values:
    """Reflectance of the boundary between dielectrics (book eqs 2.13-2.15); 1 beyond the critical angle.

    Args:
        cos: cosine of the angle of incidence.
        n: index behind the boundary over that before it.
        polarisation: "parallel" or "perpendicular" to the plane of incidence, or "" for unpolarised light.

    Example:
        >>> import math
        >>> fresnel_dielectric(math.cos(math.atan(1.5)), 1.5, "parallel") < 1e-20   # Brewster
        True
    """
    return _call(_polarised("dielectric", polarisation), {"cos": COSINE, "n": INDEX}, cos, n)


def fresnel_conductor(cos: ArrayLike, n: ArrayLike, k: ArrayLike, polarisation: str = "") -> Values:
    """Reflectance of a conductor with the complex index n + ik, exactly.

    Example:
        >>> round(fresnel_conductor(1.0, 0.617, 2.63), 4)       # the book's copper
        0.7411
    """
    return _call(
        _polarised("conductor", polarisation), {"cos": COSINE, "n": INDEX, "k": NOT_NEGATIVE}, cos, n, k
    )


def fresnel_conductor_approximated(cos: ArrayLike, n: ArrayLike, k: ArrayLike) -> Values:
    """Reflectance of a conductor by the book's eqs 2.16 and 2.17, good for n² + k² far above 1."""
    return _call("conductor_approximated", {"cos": COSINE, "n": INDEX, "k": NOT_NEGATIVE}, cos, n, k)


def cook_interpolation(normal: ArrayLike, average: ArrayLike, average_at_normal: ArrayLike) -> Values:
    """Reflectance at an angle from that at normal incidence and an average's at both (Cook and Torrance; book III.20).

    Example:
        >>> cook_interpolation(0.3, 1.0, 0.5)        # grazing: everything is reflected
        1.0
    """
    checks = {"normal": FRACTION, "average": FRACTION, "average_at_normal": (0.0, 1.0 - 1e-12)}
    return _call("interpolated", checks, normal, average, average_at_normal)


def normal_reflectance(n: ArrayLike, k: ArrayLike = 0.0) -> Values:
    """Reflectance at normal incidence, ((n−1)² + k²)/((n+1)² + k²) (book III.16, III.18)."""
    return _call("normal_reflectance", {"n": INDEX, "k": NOT_NEGATIVE}, n, k)


def index_of_reflectance(reflectance: ArrayLike) -> Values:
    """The n, with k = 0, that has a reflectance at normal incidence (book III.17)."""
    return _call("index_of_reflectance", {"reflectance": (0.0, 1.0 - 1e-12)}, reflectance)


def extinction_of_reflectance(reflectance: ArrayLike) -> Values:
    """The k, with n = 1, that has a reflectance at normal incidence (book III.19)."""
    return _call("extinction_of_reflectance", {"reflectance": (0.0, 1.0 - 1e-12)}, reflectance)


def pseudo_material(near: ArrayLike, far: ArrayLike) -> Values:
    """Reflectance at normal incidence between two dielectrics, from those of both against air (book III.5.1)."""
    checks = {"near": (0.0, 1.0 - 1e-12), "far": (0.0, 1.0 - 1e-12)}
    return _call("pseudo_material", checks, near, far)


def diffuse_reflectance(n: ArrayLike) -> Values:
    """Reflectance of a boundary for diffuse light from outside.

    Example:
        >>> round(diffuse_reflectance(1.5), 4)
        0.0918
    """
    return _call("diffuse_reflectance", {"n": (0.05, 20.0)}, n)


def internal_reflectance(n: ArrayLike) -> Values:
    """Reflectance of a boundary for diffuse light from inside, 1 − (1 − K)/n²."""
    return _call("internal_reflectance", {"n": (1.0, 20.0)}, n)


def paint_reflectance(pigment: ArrayLike, n: ArrayLike = 1.5) -> Values:
    """Reflectance of paint near normal incidence, surface included, from its pigment's (Saunderson 1942)."""
    return _call("paint", {"pigment": FRACTION, "n": (1.0, 20.0)}, pigment, n)


def pigment_reflectance(paint: ArrayLike, n: ArrayLike = 1.5) -> Values:
    """The inverse of `paint_reflectance`; 0 below what the surface alone reflects.

    Example:
        >>> round(pigment_reflectance(paint_reflectance(0.25)), 9)
        0.25
    """
    return _call("pigment", {"paint": FRACTION, "n": (1.0, 20.0)}, paint, n)


def disc_solid_angle(radius: ArrayLike, distance: ArrayLike) -> Values:
    """Solid angle of a disc seen face-on, sr (book eq 2.2)."""
    return _call("disc", {"radius": NOT_NEGATIVE, "distance": POSITIVE}, radius, distance)


def disc_solid_angle_error(ratio: ArrayLike) -> Values:
    """Relative error of π r²/d² for the ratio r/d (book figure 2.6).

    Example:
        >>> disc_solid_angle_error([0.1, 1.0]).round(4).tolist()
        [0.0075, 0.7071]
    """
    return _call("disc_error", {"ratio": (1e-6, 1e6)}, ratio)


def irradiance(flux: ArrayLike, cos: ArrayLike, distance: ArrayLike) -> Values:
    """Irradiance of a point or sphere of `flux` watts, W/m² with the distance in m (book eqs 2.7-2.9)."""
    return _call(
        "irradiance", {"flux": NOT_NEGATIVE, "cos": COSINE, "distance": POSITIVE}, flux, cos, distance
    )


def slope(sigma: ArrayLike, tau: ArrayLike) -> Values:
    """The slope m = 2σ/τ (Beckmann; book eq 2.19); the root mean square slope is m/√2 (eq 2.20)."""
    return _call("slope", {"sigma": NOT_NEGATIVE, "tau": POSITIVE}, sigma, tau)


def correlation_distance(sigma: ArrayLike, m: ArrayLike) -> Values:
    """The correlation distance τ = 2σ/m."""
    return _call("correlation_distance", {"sigma": NOT_NEGATIVE, "m": POSITIVE}, sigma, m)


def apparent_roughness(
    sigma_nm: ArrayLike, wavelength_nm: ArrayLike, cos_in: ArrayLike, cos_out: ArrayLike | None = None
) -> Values:
    """The apparent roughness g = (2πσ/λ)² (cos θ_i + cos θ_r)² (book eq 2.36); by default in the mirror direction."""
    out = cos_in if cos_out is None else cos_out
    checks = {"sigma_nm": NOT_NEGATIVE, "wavelength_nm": POSITIVE, "cos_in": COSINE, "cos_out": COSINE}
    return _call("apparent_roughness", checks, sigma_nm, wavelength_nm, cos_in, out)


def apparent_roughness_transmitted(
    sigma_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    n_in: ArrayLike,
    cos_in: ArrayLike,
    n_out: ArrayLike,
    cos_out: ArrayLike,
) -> Values:
    """The apparent roughness of what goes through, (2πσ/λ)² (n_i cos θ_i − n_t cos θ_t)²; the book leaves it open."""
    checks = {
        "sigma_nm": NOT_NEGATIVE,
        "wavelength_nm": POSITIVE,
        "n_in": INDEX,
        "cos_in": COSINE,
        "n_out": INDEX,
        "cos_out": COSINE,
    }
    return _call(
        "apparent_roughness_transmitted", checks, sigma_nm, wavelength_nm, n_in, cos_in, n_out, cos_out
    )


def coherent_fraction(g: ArrayLike) -> Values:
    """What stays coherent, r_σ or t_σ = exp(−g) (book eq 2.37).

    Example:
        >>> coherent_fraction(apparent_roughness(150.0, 580.0, 1.0)) < 1e-4
        True
    """
    import numpy as np

    kept: NDArray[np.float64] = np.exp(-np.asarray(g, dtype=np.float64))
    return float(kept) if kept.ndim == 0 else kept


def masking_torrance_sparrow(theta_in: ArrayLike, theta_out: ArrayLike, azimuth: ArrayLike = 0.0) -> Values:
    """V-groove masking for two polar angles and the azimuth between them, in radians (book eq 2.21)."""
    checks = {"theta_in": (0.0, 1.5708), "theta_out": (0.0, 1.5708), "azimuth": (-100.0, 100.0)}
    return _call("torrance_sparrow", checks, theta_in, theta_out, azimuth)


def masking_sancer(cos_in: ArrayLike, cos_out: ArrayLike, m: ArrayLike) -> Values:
    """Masking of a Gaussian surface (Sancer 1969; book eq 2.22), with m of eq 2.19."""
    return _call("sancer", {"cos_in": COSINE, "cos_out": COSINE, "m": NOT_NEGATIVE}, cos_in, cos_out, m)


def masking_smith(
    cos_in: ArrayLike, cos_out: ArrayLike, m: ArrayLike, shape: str = "beckmann", correlated: bool = True
) -> Values:
    """Smith's masking of two directions on one side, with heights correlated or not (Smith 1967; Heitz 2014).

    Example:
        >>> import numpy as np
        >>> bool(np.isclose(masking_smith(0.4, 0.7, 0.5), masking_sancer(0.4, 0.7, 0.5), atol=1e-6))
        True
    """
    import numpy as np

    if shape not in ("beckmann", "ggx"):
        raise DataError(f'shape must be "beckmann" or "ggx", found "{shape}"')
    checks = {"cos": COSINE, "m": (1e-6, 1e6)}
    a, b = (np.asarray(_call(f"smith_lambda_{shape}", checks, cos, m)) for cos in (cos_in, cos_out))
    with np.errstate(over="ignore"):
        result: Values = 1.0 / (1.0 + a + b) if correlated else 1.0 / ((1.0 + a) * (1.0 + b))
    return result


def beckmann(
    cos: ArrayLike, m: ArrayLike, m_across: ArrayLike | None = None, azimuth: ArrayLike = 0.0
) -> Values:
    """Density of facets of Gaussian slopes, 1/sr, with ∫ D cos dω = 1; anisotropic with `m_across`."""
    across = m if m_across is None else m_across
    checks = {"cos": COSINE, "azimuth": (-100.0, 100.0), "m": (1e-6, 1e6), "m_across": (1e-6, 1e6)}
    return _call("beckmann", checks, cos, azimuth, m, across)


def ggx(
    cos: ArrayLike, alpha: ArrayLike, alpha_across: ArrayLike | None = None, azimuth: ArrayLike = 0.0
) -> Values:
    """Density of facets of GGX (Trowbridge and Reitz 1975; Walter et al. 2007), 1/sr, with ∫ D cos dω = 1."""
    across = alpha if alpha_across is None else alpha_across
    checks = {"cos": COSINE, "azimuth": (-100.0, 100.0), "alpha": (1e-6, 1e6), "alpha_across": (1e-6, 1e6)}
    return _call("ggx", checks, cos, azimuth, alpha, across)


def _lobe(name: str) -> str:
    if name not in LOBES:
        raise DataError(f'a lobe is one of {", ".join(LOBES)}; found "{name}"')
    return name.replace("-", "_")


def lobe_coefficient(name: str, beta: ArrayLike) -> Values:
    """The coefficient with which a lobe of the literature falls to half at the angle β (book eqs 4.19, 4.25).

    Args:
        name: "phong" and "blinn" (N_s), "gaussian" (C₁), "trowbridge-reitz" (C₂²), "cook" (m²).
        beta: angle between N and H in radians.

    Example:
        >>> round(lobe_coefficient("blinn", 0.2), 2)
        34.43
    """
    return _call(f"{_lobe(name)}_coefficient", {"beta": (0.0, 1.5708)}, beta)


def lobe_half_angle(name: str, coefficient: ArrayLike) -> Values:
    """The angle β at which a lobe of a coefficient has fallen to half: the inverse of `lobe_coefficient`.

    Example:
        >>> round(lobe_half_angle("blinn", lobe_coefficient("blinn", 0.2)), 6)
        0.2
    """
    return _call(f"{_lobe(name)}_half_angle", {"coefficient": (0.0, float("inf"))}, coefficient)


def specular_energy(beta: ArrayLike) -> Values:
    """The share of light at normal incidence that Cook and Torrance's function returns with F = 1 (book figure II.3).

    Args:
        beta: angle between N and H at which the highlight has half its strength, radians.

    Example:
        >>> specular_energy(0.05) > 0.99
        True
    """
    return _call("specular_energy", {"beta": (0.0, 1.5708)}, beta)


def lobe_value(name: str, cos: ArrayLike, coefficient: ArrayLike) -> Values:
    """A lobe of the literature at N·H (for Phong, R·L); 1 at its peak, but for "cook", which is Beckmann's over 4."""
    return _call(
        f"{_lobe(name)}_distribution", {"cos": COSINE, "coefficient": NOT_NEGATIVE}, cos, coefficient
    )


def ggx_alpha(beta: ArrayLike) -> Values:
    """GGX's α of which the lobe falls to half at β (figure 4.14 in today's terms)."""
    return _call("ggx_alpha", {"beta": (0.0, 1.5708)}, beta)


def wave_distribution(cos: ArrayLike, m: ArrayLike, g: ArrayLike, *, book: bool = False) -> Values:
    """Facets by wave optics (Beckmann, Bahar, Koestner; book eq 2.42), for any g without overflow.

    Args:
        cos: N·H.
        m: slope of book eq 2.19.
        g: apparent roughness.
        book: as the book computes it, with its end of the series and its transition between g = 5 and 8.

    Example:
        >>> import numpy as np
        >>> bool(np.isclose(wave_distribution(0.9, 0.5, 1e6) * 4, beckmann(0.9, 0.5), rtol=1e-4))
        True
    """
    name = "wave_blended" if book else "wave_series"
    return _call(name, {"cos": COSINE, "m": (1e-6, 1e6), "g": NOT_NEGATIVE}, cos, m, g)


def profile(count: int, spacing: float, sigma: float, tau: float, seed: int = 0) -> NDArray[np.float64]:
    """A rough profile as a stylus draws it: heights of a Gaussian surface with σ and τ (book 2.2.6).

    Example:
        >>> heights = profile(20_000, 0.05, 100.0, 1.0)
        >>> bool(abs(heights.std() / 100.0 - 1.0) < 0.1)
        True
    """
    if not 0 < count <= 10_000_000 or spacing <= 0 or tau <= 0 or sigma < 0 or tau / spacing > 1e5:
        raise DataError(
            "a profile needs a count above 0, a spacing and τ above 0 (τ at most 1e5 spacings), σ from 0"
        )
    result: NDArray[np.float64] = core().rough_profile(count, spacing, sigma, tau, seed)
    return result


def fraunhofer_lines() -> dict[str, float]:
    """The lines by which glasses are measured, in nm.

    Example:
        >>> fraunhofer_lines()["d"]
        587.561
    """
    return dict(core().fraunhofer_lines())


def sellmeier(terms: list[tuple[float, float]], wavelengths_nm: list[float]) -> NDArray[np.float64]:
    """Index of Sellmeier's formula, n² = 1 + Σ B λ²/(λ² − C) with C in µm²; NaN at a resonance."""
    import numpy as np

    return np.asarray(core().sellmeier([tuple(term) for term in terms], list(wavelengths_nm)))


def cauchy(coefficients: list[float], wavelengths_nm: list[float]) -> NDArray[np.float64]:
    """Index of Cauchy's formula, n = A + B/λ² + C/λ⁴ + … with coefficients in µm."""
    import numpy as np

    return np.asarray(core().cauchy(list(coefficients), list(wavelengths_nm)))


def abbe_number(n: Spectrum | str, lines: str = "dFC") -> float:
    """Abbe's number of an index: (n₁ − 1)/(n₂ − n₃) at three Fraunhofer lines.

    Args:
        n: a spectrum of n, or the name of a medium of the library.
        lines: "dFC" for V_d, "eF'C'" for V_e.

    Example:
        >>> round(abbe_number("BK7"), 1)
        64.2
    """
    from illuminant import spectra

    if isinstance(n, str):
        n = spectra.load(f"{n}.n")
    known = fraunhofer_lines()
    names = {"dFC": ("d", "F", "C"), "eF'C'": ("e", "F'", "C'")}.get(lines)
    if names is None:
        raise DataError(f'lines must be "dFC" or "eF\'C\'", found "{lines}"')
    first, blue, red = n.at([known[name] for name in names])
    return float((first - 1.0) / (blue - red))
