"""How measured curves become the coefficients of illumination models, and which to choose (book appendix II).

A published reflectance curve is hemispherical, measured near normal incidence. Of a dielectric or a metal it is the
reflectance of its surface; of a composite, such as paint, it is mostly that of the pigment, under a neutral surface.
Empirical models take the curve as it is, energy models its value over π.

Example:
    >>> chosen = propose("metal", "satin")
    >>> 0 < chosen.specular < 1 and round(chosen.diffuse + chosen.specular, 9) == 1.0
    True
    >>> advise(chosen)
    []
    >>> advise(Proposal(beta=0.1, exponent=138.0, ambient=0.2, diffuse=0.9, specular=0.9))[0]
    'ambient and diffuse multipliers differ (0.2 and 0.9): the brightness of unlit areas belongs to the ambient light'
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from illuminant import finishes, optics
from illuminant.core import core
from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from illuminant.spectrum import Spectrum

__all__ = [
    "AMBIENT",
    "CHARACTERS",
    "COPPER_SPHERES",
    "Coefficients",
    "Proposal",
    "advise",
    "average_index",
    "coefficients",
    "energies",
    "preset",
    "propose",
    "romney_highlight",
    "source_curve",
]

AMBIENT = {"space": 0.0, "night": 0.05, "clear day": 0.15, "light interior": 0.15, "overcast": 0.3}
"""Multipliers of ambient light (book II.1.5: 0 to 0.3)."""

CHARACTERS = ("dielectric", "metal", "composite")

PRESETS: dict[str, tuple[str, str]] = {
    "dielectric": ("crown glass", "gloss"),
    "metal": ("copper", "satin"),
    "plastic": ("red plastic", "gloss"),
    "paint": ("blue paint", "matte"),
}
"""The kinds of material of `preset`, with what they are and their finish if nothing else is said."""

COPPER_SPHERES: tuple[dict[str, Any], ...] = tuple(
    {
        "mapped": mapped,
        "ambient": multipliers[0],
        "diffuse": multipliers[0],
        "specular": multipliers[1],
        "exponent": exponent,
    }
    for mapped in (False, True)
    for exponent, alone, with_map in core().copper_spheres()
    for multipliers in [with_map if mapped else alone]
)
"""The twenty copper spheres of figures II.4 and II.5, row by row; the third is printed 0.05 and taken as 0.35, like its
neighbours."""


@dataclass(frozen=True)
class Coefficients:
    """The spectra of an illumination model's terms.

    Attributes:
        ambient, diffuse, specular: K_a, K_d, K_s.
        n: average index of refraction.
        k: average extinction coefficient.
    """

    ambient: Spectrum
    diffuse: Spectrum
    specular: Spectrum
    n: float
    k: float


@dataclass(frozen=True)
class Proposal:
    """Multipliers and the width of the highlight.

    Attributes:
        beta: angle between N and H at which the highlight has half its strength, radians.
        exponent: N_s of Blinn's function for it.
        ambient, diffuse, specular: the multipliers C_Ka, C_Kd, C_Ks.
    """

    beta: float
    exponent: float
    ambient: float
    diffuse: float
    specular: float


def source_curve(curve: Spectrum) -> Spectrum:
    """A published curve of a lamp scaled to 1 at 560 nm (book II.1.4).

    Example:
        >>> from illuminant import spectra
        >>> round(float(source_curve(spectra.load("A")).at(560.0)), 9)
        1.0
    """
    return curve.normalised()


def average_index(curve: Spectrum, *, metal: bool) -> tuple[float, float]:
    """The average n (k = 0) or, of a metal, k (n = 1) of a reflectance over 380 to 780 nm (book III.17, III.19).

    Example:
        >>> from illuminant import spectra
        >>> n, k = average_index(spectra.load("book/crown glass"), metal=False)
        >>> round(n, 2), k
        (1.51, 0.0)
    """
    import numpy as np

    mean = float(np.mean(curve.at(np.arange(380.0, 781.0))))
    if not 0.0 <= mean < 1.0:
        raise DataError(
            f"a reflectance between 0 and 1 is needed; the mean of {curve.name or 'the curve'} is {mean:g}"
        )
    if metal:
        return 1.0, float(optics.extinction_of_reflectance(mean))
    return float(optics.index_of_reflectance(mean)), 0.0


def coefficients(curve: Spectrum, character: str, *, energy: bool = False, n: float = 1.5) -> Coefficients:
    """What a published curve means for the terms of an illumination model (book II.1.4, II.1.5).

    Args:
        curve: hemispherical reflectance near normal incidence.
        character: "dielectric" and "metal": one curve for all terms; "composite": the pigment's curve for the ambient
            and diffuse terms, the vehicle's neutral reflectance for the specular one.
        energy: for models of energy, whose diffuse term is M/π; empirical models take M.
        n: index of the vehicle of a composite.

    Example:
        >>> from illuminant import spectra
        >>> red = coefficients(spectra.load("ColorChecker/red"), "composite")
        >>> {round(float(v), 6) for v in red.specular.values}
        {0.04}
    """
    if character not in CHARACTERS:
        raise DataError(f'a character is one of {", ".join(CHARACTERS)}; found "{character}"')
    factor = 1.0 / math.pi if energy else 1.0
    # A reflectance over π is no fraction any more.
    scaled = replace(
        curve, values=tuple(factor * v for v in curve.values), quantity="" if energy else curve.quantity
    )
    if character != "composite":
        index = average_index(curve, metal=character == "metal")
        return Coefficients(scaled, scaled, curve, *index)
    surface = float(optics.normal_reflectance(n))
    vehicle = replace(curve, name="vehicle", values=tuple(surface for _ in curve.values))
    return Coefficients(scaled, scaled, vehicle, n, 0.0)


def energies(beta: float) -> tuple[float, float]:
    """How the energy of a perfect reflector is divided by the angle β: specular and diffuse (book figure II.3).

    The specular part is the hemispherical integral of the Cook-Torrance function at normal incidence with F = 1 and
    Torrance and Sparrow's masking; the diffuse part is the rest.

    Args:
        beta: radians, above 0 and below π/2.

    Example:
        >>> sharp, wide = energies(0.05), energies(0.8)
        >>> sharp[0] > 0.99 and sharp[0] > wide[0] and sum(wide) == 1.0
        True
    """
    if not 0.0 < beta < math.pi / 2:
        raise DataError(f"β lies between 0 and π/2; found {beta:g}")
    specular = float(optics.specular_energy(beta))
    return specular, 1.0 - specular


def propose(character: str, finish: str | float) -> Proposal:
    """Multipliers for a character and a finish, by the guidelines of book II.2.

    Args:
        character: "dielectric", "metal" or "composite". A composite keeps a diffuse part even when it shines.
        finish: the name of a finish, or β in radians.

    Example:
        >>> propose("composite", "gloss").diffuse > propose("metal", "polished").diffuse
        True
    """
    if character not in CHARACTERS:
        raise DataError(f'a character is one of {", ".join(CHARACTERS)}; found "{character}"')
    if isinstance(finish, str):
        slope = max(finishes.finish(finish).slope)
        beta = float(optics.lobe_half_angle("cook", max(slope, 0.01) ** 2))
    else:
        beta = float(finish)
    specular, diffuse = energies(beta)
    if character == "composite":
        # The pigment returns what the surface lets in; the highlight is the surface's.
        specular, diffuse = 0.5 * specular, 1.0 - 0.5 * specular
    return Proposal(beta, float(optics.lobe_coefficient("blinn", beta)), diffuse, diffuse, specular)


def preset(kind: str, name: str = "", finish: str = "") -> dict[str, Any]:
    """A material of the scene file by book appendix II: physics for `general`, coefficients for the other models.

    Args:
        kind: "dielectric", "metal", "plastic" or "paint".
        name: what it is, in the words of `illuminant.materials`, such as "gold" or "green paint".
        finish: the name of a finish, such as "polished", "satin" or "matte".

    Returns:
        The table `[materials.NAME]`, in which C_Ka = C_Kd, and C_Kd and C_Ks follow from the width of the highlight
        (book II.2, figure II.3).

    Raises:
        DataError: there is no such kind, or the words are not understood.

    Example:
        >>> made = preset("metal", "gold", "polished")
        >>> told = made["coefficients"]["all"]
        >>> made["metal"], told["ambient"] == told["diffuse"], told["specular"] > 0.9
        ('gold', True, True)
    """
    from illuminant import materials

    if kind not in PRESETS:
        raise DataError(f'a preset is one of {", ".join(PRESETS)}; found "{kind}"')
    usual, usual_finish = PRESETS[kind]
    words = f"{name or usual}, {finish or usual_finish}"
    table = materials.find(words)
    character = {"dielectric": "dielectric", "conductor": "metal"}.get(table["kind"], "composite")
    wanted = kind if kind in CHARACTERS else "composite"
    if character != wanted:
        raise DataError(f'"{words}" is no {kind}; for example "{usual}"')
    proposal = propose(character, finish or usual_finish)
    told = {
        "ambient": round(proposal.ambient, 4),
        "diffuse": round(proposal.diffuse, 4),
        "specular": round(proposal.specular, 4),
        "half_angle_deg": round(math.degrees(proposal.beta), 4),
    }
    return table | {"coefficients": {"all": told}}


def romney_highlight(
    cosine: npt.ArrayLike, distance: npt.ArrayLike, powers: tuple[float, float] = (2.0, 4.0)
) -> npt.NDArray[np.float64]:
    """(N·L)^p/r^q: the highlight of a light at the eye before there were models of highlights.

    A power of the cosine looks like a highlight, because the mirror direction leaves the view as the normal does; 2
    and 4 gave the best images (Romney 1969; book 4.2.2). In a scene these are the `terminator` p of a material's
    coefficients, a point light at the eye, whose own light falls as 1/r², and an atmosphere of kind `distance` with
    the power q − 2.

    Args:
        cosine: N·L, the same as N·V; below 0 there is no light.
        distance: r from the surface to the eye, above 0.
        powers: p and q.

    Returns:
        What intensity and reflectance are multiplied by, in the shape of both arguments broadcast.

    Raises:
        DataError: a distance is not above 0.

    Example:
        >>> float(romney_highlight(0.5, 2.0))
        0.015625
    """
    import numpy as np

    r = np.asarray(distance, dtype=float)
    if not (r > 0).all():
        raise DataError("distance: must be above 0")
    p, q = powers
    return np.asarray(np.maximum(np.asarray(cosine, dtype=float), 0.0) ** p / r**q)


def advise(chosen: Proposal) -> list[str]:
    """What the rules of thumb of book II.2 object to; empty if nothing.

    C_Ka = C_Kd; C_Kd + C_Ks about 1; the highlight is narrower where C_Ks is larger.
    """
    found = []
    if abs(chosen.ambient - chosen.diffuse) > 0.01:
        found.append(
            f"ambient and diffuse multipliers differ ({chosen.ambient:g} and {chosen.diffuse:g}): the brightness of "
            "unlit areas belongs to the ambient light"
        )
    total = chosen.diffuse + chosen.specular
    if not 0.8 <= total <= 1.25:
        found.append(
            f"diffuse and specular multipliers add to {total:g}; about 1 keeps colours within the display"
        )
    specular, _ = energies(chosen.beta)
    if chosen.specular > specular + 0.2:
        found.append(
            f"a highlight of β = {math.degrees(chosen.beta):.3g}° is too wide for a specular multiplier of "
            f"{chosen.specular:g}; about {specular:.2g} goes with it"
        )
    return found
