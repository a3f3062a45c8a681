"""What a point of the picture sends: its spectrum at every nm, its colour, and what this display makes of it.

The pixel is rendered anew, by itself, by the technique and model that are chosen, at 1 nm; so a reading does not depend
on the spectral sampling of the picture. Techniques that solve for light first carry the wavelengths of their solution.

    illuminance of a diffuse surface:  E = π ∫ L(λ) / ρ(λ) · V(λ) dλ · 683 lm/W
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.job import Job
from illuminant.settings import SOLVED
from illuminant.viewer.illuminance import paint

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.radiosity import Solution
    from illuminant.viewer.state import State

    Array = NDArray[np.float64]

__all__ = ["Reading", "read"]

SAMPLES = 256


@dataclass(frozen=True)
class Reading:
    """A reading at a pixel.

    Attributes:
        pixel: column and row, from the top left.
        thing, material: what is seen there; empty for surroundings.
        position: where, metres; None for surroundings.
        wavelengths_nm, radiance: the spectrum, W·sr⁻¹·m⁻²·nm⁻¹.
        xyz: absolute; Y is the luminance in cd/m².
        illuminance: of the surface, lx, where it is diffuse; else None.
        by: the technique and the wavelengths that were read.
        delta_e: ΔE00 between what the scene sends and what the display shows; None without an exposure.
    """

    pixel: tuple[int, int]
    thing: str
    material: str
    position: tuple[float, float, float] | None
    wavelengths_nm: Array
    radiance: Array
    xyz: tuple[float, float, float]
    illuminance: float | None
    delta_e: float | None
    by: str

    @property
    def luminance(self) -> float:
        """Of the point, cd/m²."""
        return self.xyz[1]

    @property
    def chromaticity(self) -> tuple[float, float]:
        """x and y; nan for black."""
        total = sum(self.xyz)
        return (self.xyz[0] / total, self.xyz[1] / total) if total > 0 else (float("nan"), float("nan"))


def read(
    state: State,
    camera: Mapping[str, Any],
    pixel: tuple[int, int],
    solution: Solution | None = None,
    samples: int = SAMPLES,
) -> Reading:
    """Read a pixel.

    Args:
        state: what is shown.
        camera: as the page has it, with the size of the whole picture.
        pixel: column and row.
        solution: of the state, where its technique solves for light first.
        samples: paths of the pixel.

    Raises:
        UsageError, SceneError: as `illuminant.render`.
    """
    import numpy as np

    x, y = pixel
    scene = state.scene.replace(camera=dict(camera) | {"crop": [x, y, x + 1, y + 1]})
    solved = state.technique in SOLVED and solution is not None
    job = Job(
        scene,
        technique=state.technique if solved or state.technique not in SOLVED else "path",
        illumination=state.illumination if solved or state.technique not in SOLVED else "general",
        sampling=state.sampling if solved else "1nm",
        samples=samples,
        keep_spectra=True,
        solution=solution._core if solved and solution is not None else None,
    )
    for _ in job.passes():
        pass
    image = job.image()
    follower = Job(scene, technique="path", sampling="uniform:4", samples=1)
    vertices: list[Any] = next(iter(follower.core_render.replay(x, y, 0)["passes"]), [])
    first = vertices[0] if vertices else None
    radiance = np.asarray(image.layers["spectra"][0, 0], float)
    wavelengths = np.asarray(image.wavelengths_nm, float)
    xyz = np.asarray(image.xyz[0, 0], float)
    return Reading(
        pixel=pixel,
        thing="" if first is None else first["object"],
        material="" if first is None else first["material"],
        position=None if first is None else _triple(first["position"]),
        wavelengths_nm=wavelengths,
        radiance=radiance,
        xyz=_triple(xyz),
        illuminance=None if first is None else _illuminance(state, first, wavelengths, radiance),
        delta_e=_shown_error(state, xyz),
        by=f"{job.settings.technique} × {job.settings.illumination}, {len(wavelengths)} wavelengths",
    )


def _triple(values: Any) -> tuple[float, float, float]:
    a, b, c = (float(value) for value in values)
    return a, b, c


def _illuminance(state: State, seen: Any, wavelengths: Array, radiance: Array) -> float | None:
    """Of a diffuse surface, lx; None where the light is not all reflected: a lamp, or air that scatters."""
    import numpy as np

    from illuminant.color import spectra_to_xyz

    reflectance = paint(state.scene, seen["object"], seen["material"], wavelengths)
    if reflectance is None or len(wavelengths) < 100:
        return None
    arriving = np.pi * radiance / reflectance
    return float(spectra_to_xyz(arriving, wavelengths, scale="absolute")[..., 1])


def _shown_error(state: State, xyz: Array) -> float | None:
    """ΔE00 between the colour that the scene sends and the one that the display shows, with the display's white."""
    import numpy as np

    from illuminant.color import delta_e_2000, xyz_to_lab
    from illuminant.viewer.composition import compose

    if state.exposure is None:
        return None
    target = state.look.target
    codes = compose(xyz[None, None], state).codes[0, 0] / 255.0
    white = target.to_xyz(np.ones(3))
    shown = target.to_xyz(codes) / white[1]
    wanted = xyz * state.exposure
    white = white / white[1]
    return float(delta_e_2000(xyz_to_lab(wanted, white=white), xyz_to_lab(shown, white=white)))
