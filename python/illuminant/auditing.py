"""`audit`: what becomes of the light that reaches a material, and which laws its model breaks.

Example:
    >>> found = audit("copper, satin", draws=2000)          # doctest: +SKIP
    >>> found[0].passes                                     # doctest: +SKIP
    True
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import materials
from illuminant.core import core
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.scene import Scene

__all__ = ["ANGLES_DEG", "WAVELENGTHS_NM", "Audit", "Law", "audit"]

ANGLES_DEG = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0, 91.0, 105.0, 120.0, 135.0, 150.0, 165.0, 180.0)
"""Where light comes from, in degrees from the normal; above 90 from inside."""

WAVELENGTHS_NM = (400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0)

ROUND_OFF = {"reciprocity": 1e-4, "energy": 2e-3, "normalisation": 0.01}
"""By how much a law may seem broken by rounding and by tables; to sums of energy the noise of the draws is added."""


@dataclass(frozen=True)
class Law:
    """A law and by how much it is broken.

    Attributes:
        name: reciprocity, conservation, equilibrium, normalisation.
        claimed: whether the model claims it.
        largest: the largest violation.
        allowed: what is still believed.
        where: of the largest violation, in words.
    """

    name: str
    claimed: bool
    largest: float
    allowed: float
    where: str = ""

    @property
    def kept(self) -> bool:
        """Whether the violation is not larger than what is allowed."""
        return self.largest <= self.allowed


@dataclass(frozen=True)
class Audit:
    """What was found of one material. Shares of power are arrays of (angles, wavelengths).

    Attributes:
        material: its name.
        illumination: the model.
        source: where the model comes from.
        angles_deg: angles of incidence.
        wavelengths_nm: wavelengths.
        coherent_reflection, scattered_reflection: what is reflected in the mirror direction, and elsewhere.
        coherent_transmission, scattered_transmission: what goes through as by a smooth boundary, and elsewhere.
        emitted: the radiant exitance of the surface itself, W/m²; 0 if it does not shine.
        laws: the laws.
        p_value: smallest of the chi-square tests of drawn directions.
        weight: the largest weight of a drawn direction.
    """

    material: str
    illumination: str
    source: str
    angles_deg: tuple[float, ...]
    wavelengths_nm: tuple[float, ...]
    coherent_reflection: NDArray[np.float64]
    scattered_reflection: NDArray[np.float64]
    coherent_transmission: NDArray[np.float64]
    scattered_transmission: NDArray[np.float64]
    emitted: bool
    laws: tuple[Law, ...]
    p_value: float
    weight: float

    @property
    def absorbed(self) -> NDArray[np.float64]:
        """What is neither reflected nor transmitted."""
        import numpy as np

        gone = self.coherent_reflection + self.scattered_reflection
        gone = gone + self.coherent_transmission + self.scattered_transmission
        result: NDArray[np.float64] = np.clip(1.0 - gone, 0.0, None)
        return result

    @property
    def passes(self) -> bool:
        """Whether every law that the model claims is kept."""
        return all(law.kept for law in self.laws if law.claimed)

    def facts(self) -> dict[str, Any]:
        """All of it as plain data."""
        arrays = (
            "coherent_reflection",
            "scattered_reflection",
            "coherent_transmission",
            "scattered_transmission",
        )
        return {
            "material": self.material,
            "illumination": self.illumination,
            "source": self.source,
            "angles_deg": list(self.angles_deg),
            "wavelengths_nm": list(self.wavelengths_nm),
            **{name: getattr(self, name).tolist() for name in arrays},
            "absorbed": self.absorbed.tolist(),
            "emits": self.emitted,
            "laws": [
                {
                    "law": law.name,
                    "claimed": law.claimed,
                    "kept": law.kept,
                    "largest": law.largest,
                    "allowed": law.allowed,
                    "where": law.where,
                }
                for law in self.laws
            ],
            "chi_square_p": self.p_value,
            "largest_weight": self.weight,
            "passes": self.passes,
        }


def audit(
    target: str | os.PathLike[str] | Scene | Mapping[str, Any],
    *,
    illumination: str = "general",
    angles_deg: Sequence[float] = ANGLES_DEG,
    wavelengths_nm: Sequence[float] = WAVELENGTHS_NM,
    draws: int = 20_000,
    allow_outside: bool = False,
) -> list[Audit]:
    """Audit a material, or every material of a scene.

    Args:
        target: a scene, a scene file, "FILE.toml#material", a material in words ("copper, circular mill"), or the
            table of a material as in the scene file.
        illumination: the illumination model.
        angles_deg: angles of incidence from the normal, 0 to 180; above 90 from inside.
        wavelengths_nm: wavelengths, 380 to 780.
        draws: directions drawn for each angle, 100 to 10,000,000.
        allow_outside: whether the files that a scene file names may lie outside its folder.

    Raises:
        SceneError, DataError: the target is not understood, or a number is out of range.
    """
    from illuminant.scene import Scene

    for angle in angles_deg:
        if not 0.0 <= angle <= 180.0 or angle == 90.0:
            raise UsageError(f"an angle of {angle:g} degrees: expected 0 to 180, but for 90 itself")
    for wavelength in wavelengths_nm:
        if not 380.0 <= wavelength <= 780.0:
            raise UsageError(f"a wavelength of {wavelength:g} nm: expected 380 to 780")
    if not 100 <= draws <= 10_000_000:
        raise UsageError(f"{draws} draws: expected 100 to 10,000,000")
    if not angles_deg or not wavelengths_nm:
        raise UsageError("an audit needs an angle and a wavelength")
    only = None
    if isinstance(target, Mapping):
        scene = _of_table("material", target)
    elif isinstance(target, (str, os.PathLike)):
        file, _, name = os.fspath(target).partition("#")
        if Path(file).suffix == ".toml" or Path(file).is_file():
            scene, only = Scene.load(file, allow_outside=allow_outside), name or None
        else:
            scene = _of_table(str(target), materials.find(str(target)))
    else:
        scene = target
    entries = scene.description["materials"]
    if only is not None and only not in [entry["name"] for entry in entries]:
        known = ", ".join(entry["name"] for entry in entries)
        raise DataError(f'{target}: there is no material "{only}"; the scene has {known}')
    shining = {one["material"] for one in scene.description["objects"] if one.get("emission")}
    found = []
    for number, entry in enumerate(entries):
        if only is None or entry["name"] == only:
            arguments = (list(map(float, wavelengths_nm)), list(map(float, angles_deg)), draws)
            try:
                facts = core().audit_material(scene.core(), number, illumination, *arguments)
            except ValueError as error:
                raise UsageError(f"{error}.") from None
            found.append(_audit(entry["name"], illumination, wavelengths_nm, facts, number in shining, draws))
    return found


def _of_table(name: str, table: Mapping[str, Any]) -> Scene:
    """A scene of one ball of the material."""
    from illuminant.scene import Scene

    return Scene.build(
        camera={"eye": [0, 0, 3], "target": [0, 0, 0]},
        objects={"ball": {"sphere": {"radius": 1.0}, "material": name}},
        materials={name: dict(table)},
        lights={"sky": {"kind": "environment", "spectrum": "E", "luminance_cd_m2": 1.0}},
    )


def _audit(
    name: str,
    illumination: str,
    wavelengths_nm: Sequence[float],
    facts: Mapping[str, Any],
    emits: bool,
    draws: int,
) -> Audit:
    import numpy as np

    def place(law: tuple[float, float, float]) -> str:
        return f"at {law[1]:g}° and {law[2]:g} nm" if law[0] > 0 else ""

    gain, equilibrium = facts["gain"], facts["equilibrium"]
    # Weights differ by about a half from each other.
    energy = ROUND_OFF["energy"] + 0.5 / draws**0.5
    laws = (
        Law("reciprocity", facts["claims_reciprocity"], facts["reciprocity"], ROUND_OFF["reciprocity"]),
        Law("conservation", facts["claims_conservation"], gain[0], energy, place(gain)),
        Law(
            "equilibrium",
            facts["claims_equilibrium"],
            equilibrium[0],
            energy,
            place(equilibrium),
        ),
        Law("normalisation", True, facts["normalisation"], ROUND_OFF["normalisation"]),
    )
    shares = {
        key: np.asarray(facts[key]).reshape(len(facts["angles_deg"]), len(wavelengths_nm))
        for key in (
            "coherent_reflection",
            "scattered_reflection",
            "coherent_transmission",
            "scattered_transmission",
        )
    }
    return Audit(
        name,
        illumination,
        facts["source"],
        tuple(facts["angles_deg"]),
        tuple(float(w) for w in wavelengths_nm),
        **shares,
        emitted=emits,
        laws=laws,
        p_value=facts["p_value"],
        weight=facts["weight"],
    )
