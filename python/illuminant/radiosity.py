"""Radiosity: the light between surfaces solved for once, then seen from anywhere and relit (book 4.4.2, appendix IV.2).

`solve` cuts the surfaces of a scene into elements, finds how they see each other (form factors) and solves
B = E + ρ F B for all lamps and all spectral samples at once. The `Solution` keeps the light of each lamp apart, for
one unit of light in every sample. So other lamps are a matter of multiplying, other paints of a few iterations, and
an object that moves changes only what sees it.

Example:
    >>> solution = solve("scenes/cornell.toml", elements=6000)          # doctest: +SKIP
    >>> solution.report["closure_mean"] < 0.1                           # doctest: +SKIP
    True
    >>> solution.relight(lamps={"lamp": "A"}).render(size=(256, 256))   # doctest: +SKIP
"""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Mapping, Sequence
from typing import IO, TYPE_CHECKING, Any

from illuminant import archives, machine, output, sources
from illuminant.core import core, embree
from illuminant.errors import DataError, MachineError, UsageError, suggestion
from illuminant.job import Job, OnProgress, held
from illuminant.rendering import RenderInterrupted
from illuminant.settings import SOLVED, Settings, resolve
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.image import Image
    from illuminant.scene import Scene
    from illuminant.spectrum import Spectrum

    Array = NDArray[np.floating[Any]]

__all__ = ["FORMAT", "Mesh", "Solution", "solve"]

FORMAT = "illuminant solution 1"
MOST_BYTES = 16_000_000_000
"""The largest file of a solution."""

MOST_LAMPS = 32
"""With more lamps than this their light is not kept apart."""


@dataclasses.dataclass(frozen=True)
class Mesh:
    """The surfaces of a solution as triangles, each a side that light reaches.

    Attributes:
        positions: (V, 3), in metres.
        normals: (V, 3), unit, on the side that is seen.
        faces: (F, 3), corners counter-clockwise on that side.
        objects: (F,), the number of the object in the scene.
        xyz: (V, 3), radiance that corners send, absolute XYZ (Y in cd/m²).
        areas: (F,), m².
        patches: (F,), the patch that each side belongs to.
    """

    positions: Array
    normals: Array
    faces: NDArray[np.integer[Any]]
    objects: NDArray[np.integer[Any]]
    xyz: Array
    areas: Array
    patches: NDArray[np.integer[Any]]


class Solution:
    """The light between the surfaces of a scene; made by `solve`, `load`, or from another one.

    Attributes:
        scene: the scene, with the lamps and paints of this solution.
        settings: how it was solved.
        report: how it came about: numbers of elements, sides, patches and form factors; `closure_mean` and
            `closure_worst`, how far rows of form factors are from 1 (in a closed scene an error, in an open one what
            leaves); `reciprocity`, the part of all exchange between objects in which A_i F_ij and A_j F_ji differ;
            `history`, the relative residual after each step; `imbalance`, the part of all light that is neither
            absorbed nor leaves; seconds for each stage; `memory` in bytes.
    """

    def __init__(
        self, scene: Scene, settings: Settings, solution: Any, *, fitted_to: Scene | None = None
    ) -> None:
        self.scene = scene
        self.settings = settings
        self._core = solution
        # Spectral samples are fitted to a scene, and kept when its lamps and paints change.
        self._fitted_to = fitted_to or scene
        self.report: dict[str, Any] = dict(solution.report())

    def __repr__(self) -> str:
        """The scene, and how many elements."""
        return f"<Solution of {self.scene!r}: {self.report['elements']} elements>"

    def _check_irradiance(self) -> None:
        if self.settings.technique == "specular-radiosity":
            raise UsageError(
                "specular-radiosity keeps radiance in all directions and no irradiance: it can only be rendered."
            )

    # --- other lamps, paints and places --------------------------------------------------------------------------

    def relight(
        self,
        *,
        lamps: Mapping[str, float | str | Spectrum] | None = None,
        materials: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> Solution:
        """The solution with other lamps or paints, without new form factors.

        Args:
            lamps: for each lamp by its name a factor (0 switches it off), or another spectrum that keeps its quantity
                (lm, cd/m², …): a name of the library or a `Spectrum`.
            materials: whole tables of materials that the scene has, as `Scene.replace` takes them.

        Raises:
            UsageError: there is no such lamp, or the lamps are so many that their light is not kept apart.
            SceneError: a material has mistakes.
        """
        scene = self.scene
        self._check_irradiance()
        if lamps:
            if not self.report["per_lamp"]:
                raise UsageError(
                    f"The light of more than {MOST_LAMPS} lamps is not kept apart, so they cannot be changed: solve "
                    "anew."
                )
            scene = _with_lamps(scene, lamps)
        if materials:
            scene = scene.replace(materials=materials)
        return self.of(scene)

    def of(self, scene: Scene, cancel: Any = None) -> Solution:
        """The solution for a scene that differs in spectra of lamps, materials, the camera, or where objects are.

        Only what changed is found again: nothing for lamps; the equations for paints; the form factors that see an
        object which moved (Baum et al. 1986). The number of rows of form factors that this took is
        `report["rows_again"]`.

        Args:
            scene: as it is now.
            cancel: a `Cancel` of the core, which ends the work from another thread with the core's `Cancelled`.

        Raises:
            UsageError: the scene differs in more than that; solve it anew.
        """
        self._check_irradiance()
        before, now = self.scene.description, scene.description
        names = [thing["name"] for thing in before["objects"]]
        if names != [thing["name"] for thing in now["objects"]]:
            raise UsageError("The scene has other objects than the solution: solve it anew.")
        if _lamp_forms(self.scene) != _lamp_forms(scene):
            raise UsageError(
                "The lamps of the scene differ in more than spectrum and power from those of the solution: solve anew."
            )
        embree()
        core_scene, settings = scene.core(self.settings.threads), self.settings.to_core()
        found = self._core
        moved = _moved(self.scene, scene)
        rows = 0
        if moved:
            found, rows = found.moved(core_scene, settings, moved, cancel)
        if _paints(self.scene) != _paints(scene):
            if self.settings.technique == "hybrid" and _mirrors(self.scene) != _mirrors(scene):
                raise UsageError(
                    "What mirrors or lets light through has changed, and with it form factors: solve anew."
                )
            found = found.repainted(core_scene, settings, cancel)
        result = Solution(scene, self.settings, found, fitted_to=self._fitted_to)
        result.report["rows_again"] = rows
        return result

    # --- seen ----------------------------------------------------------------------------------------------------

    def render(
        self,
        *,
        camera: Mapping[str, Any] | None = None,
        progress: OnProgress | None = None,
        **options: Any,
    ) -> Image:
        """The image of the solution from the scene's camera, or from another one.

        Args:
            camera: keys of the camera that change, as `Scene.replace` takes them.
            progress: as for `illuminant.render`.
            options: as for `illuminant.render`; those that made the solution are its own. With `gather="full"` a path
                looks around from every pixel.

        Raises:
            UsageError: an option cannot be, or belongs to the solution.
            RenderInterrupted: Ctrl-C; its attribute `image` holds what was done.
        """
        given = [
            name
            for name in (*_OF_SOLUTION, "sampling", "technique", "illumination")
            if options.get(name) is not None
        ]
        if given:
            raise UsageError(f"{given[0]} belongs to the solution, and is not an option of its image.")
        scene = self.scene if camera is None else self.scene.replace(camera=camera)
        own = {
            name: getattr(self.settings, name)
            for name in (*_OF_SOLUTION, "sampling", "technique", "illumination")
        }
        job = Job(scene, solution=self._core, **own | options)
        for _ in job.passes(progress):
            pass
        image = job.image()
        if job.interrupted:
            raise RenderInterrupted(f"The render was interrupted; {held(image)}.", image)
        return image

    def illuminance(
        self, points: ArrayLike, normals: ArrayLike = (0.0, 1.0, 0.0), *, samples: int = 1024
    ) -> Array:
        """Illuminance at points, lx.

        Args:
            points: (n, 3), in metres.
            normals: (n, 3) or (3,), the directions that they face.
            samples: at how many places each lamp is asked, and how many rays look around for light of surfaces.

        Returns:
            (n,).
        """
        return self.irradiance_xyz(points, normals, samples=samples)[:, 1]

    def irradiance_xyz(
        self, points: ArrayLike, normals: ArrayLike = (0.0, 1.0, 0.0), *, samples: int = 1024
    ) -> Array:
        """XYZ of the irradiance at points, (n, 3): Y is illuminance, lx. Arguments as `illuminance`."""
        import numpy as np

        self._check_irradiance()
        places = np.atleast_2d(np.asarray(points, float))
        if places.shape[1:] != (3,) or np.shape(normals) not in ((3,), places.shape):
            raise UsageError("Points and normals must have three coordinates each, and be as many.")
        facing = np.broadcast_to(np.asarray(normals, float), places.shape)
        if not np.isfinite(places).all() or not np.isfinite(facing).all():
            raise UsageError("Points and normals must be finite.")
        if not 1 <= samples <= 2**20:
            raise UsageError(f"samples {samples}: expected a whole number from 1 to {2**20}.")
        embree()
        found = self._core.illuminance(
            self.scene.core(self.settings.threads),
            np.ascontiguousarray(places),
            np.ascontiguousarray(facing),
            samples,
        )
        return np.asarray(found)

    def mesh(self) -> Mesh:
        """The surfaces with the light that they send, corner by corner."""
        import numpy as np

        self._check_irradiance()
        data = self._core.mesh(self.scene.core(self.settings.threads))
        back = np.asarray(data["back"])
        # A surface lit from both sides has two sets of corners.
        count = len(data["positions"])
        faces = data["faces"].astype(np.int64) + np.where(back, count, 0)[:, None]
        used, faces = np.unique(faces, return_inverse=True)
        return Mesh(
            positions=np.concatenate([data["positions"]] * 2)[used],
            normals=np.concatenate([data["normals"], -data["normals"]])[used],
            faces=faces.reshape(-1, 3),
            objects=np.asarray(data["objects"]),
            xyz=data["xyz"].reshape(-1, 3)[used],
            areas=np.asarray(data["areas"]),
            patches=np.asarray(data["patches"]),
        )

    # --- files ---------------------------------------------------------------------------------------------------

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the solution to a file that `load` reads: the scene, form factors, and the light of each lamp.

        Raises:
            ImageError: the path cannot be an output.
            MachineError: the disk is full or fails.
        """
        output.write_bytes(path, self.to_bytes())

    def to_bytes(self) -> bytes:
        """The solution as the bytes of such a file, for `from_bytes`."""
        import io

        import numpy as np

        self._check_irradiance()
        parts = dict(self._core.parts())
        header = {
            "format": FORMAT,
            "settings": dataclasses.asdict(self.settings),
            "width": parts.pop("width"),
            "history": self.report["history"],
        }
        arrays = {
            "header": np.frombuffer(json.dumps(header).encode(), np.uint8),
            "scene": np.frombuffer(self.scene.to_bytes(), np.uint8),
            "fitted_to": np.frombuffer(self._fitted_to.to_bytes(), np.uint8),
            **parts,
        }

        stream = io.BytesIO()
        np.savez(stream, allow_pickle=False, **arrays)
        return stream.getvalue()

    @property
    def core_solution(self) -> Any:
        """The solution as the core has it, for `Job`."""
        return self._core

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Solution:
        """Read a solution that `save` wrote.

        Raises:
            DataError: the file cannot be read, or is no solution.
        """
        name = os.fspath(path)
        try:
            with sources.opened(name, MOST_BYTES) as stream:
                return cls._read(stream, name)
        except SourceError as error:
            raise DataError(f"{name} cannot be read: {error.clause}.") from None

    @classmethod
    def from_bytes(cls, content: bytes, name: str = "the solution") -> Solution:
        """As `load`, of the bytes of a file; `name` is what errors call it."""
        import io

        return cls._read(io.BytesIO(content), name)

    @classmethod
    def _read(cls, stream: IO[bytes], name: str) -> Solution:
        import numpy as np

        from illuminant.scene import Scene

        try:
            arrays = archives.read(stream, name)
            header = json.loads(arrays.pop("header").tobytes())
            if header["format"] != FORMAT:
                raise DataError(
                    f"{name} has the format {header['format']!r}, which this version does not read."
                )
            told: dict[str, Any] = header["settings"]
            known: dict[str, Any] = {
                key: tuple(one) if isinstance(one, list) else one for key, one in told.items()
            }
            settings = Settings(**known)
            parts: dict[str, Any] = {**arrays, "width": int(header["width"])}
            core_settings, history = settings.to_core(), [float(value) for value in header["history"]]
            sound = settings.technique in SOLVED and 0 <= settings.threads <= 4096
            sound &= all(np.isfinite(arrays[key]).all() and (arrays[key] >= 0).all() for key in _NUMBERS)
            if not sound:
                raise ValueError("numbers that cannot be")
        except (DataError, MachineError, SourceError):
            raise
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise DataError(f"{name} is no solution of illuminant.") from error
        embree()
        try:
            scene = Scene.from_bytes(parts.pop("scene").tobytes())
            fitted = Scene.from_bytes(parts.pop("fitted_to").tobytes())
            found = core().Solution.restored(
                scene.core(settings.threads), core_settings, fitted.core(settings.threads), parts
            )
        except DataError as error:
            raise DataError(f"{name}: {error.message.rstrip('.')}.") from error
        except (ValueError, KeyError) as error:
            raise DataError(f"{name}: {str(error).rstrip('.')}.") from error
        result = cls(scene, settings, found, fitted_to=fitted)
        result.report["history"] = history
        return result

    def save_mesh(self, path: str | os.PathLike[str], *, exposure: float | None = None) -> float:
        """Write the surfaces as GLB (glTF 2): vertex colours are linear sRGB for a display, 8 bits a channel; the
        attribute `_XYZ` holds the absolute XYZ of each corner in floats.

        Args:
            path: the file, `.glb`.
            exposure: display value of 1 cd/m²; without it the 98th percentile of luminance becomes 0.8.

        Returns:
            The exposure.

        Raises:
            UsageError: the name does not end with .glb.
            ImageError: the path cannot be an output.
        """
        import numpy as np

        if not os.fspath(path).lower().endswith(".glb"):
            raise UsageError(f"{os.fspath(path)}: a mesh is written as .glb.")
        output.check(path)
        import trimesh

        from illuminant.color import xyz_to_rgb

        mesh = self.mesh()
        if exposure is None:
            white = float(np.percentile(mesh.xyz[:, 1], 98))
            exposure = 0.8 / white if white > 0 else 1.0
        rgb = xyz_to_rgb(mesh.xyz.astype(float) * exposure)
        colours = np.concatenate([np.clip(rgb, 0, 1), np.ones((len(rgb), 1))], axis=1)
        scene = trimesh.Scene()
        for number, thing in enumerate(self.scene.description["objects"]):
            own = mesh.faces[mesh.objects == number]
            if not len(own):
                continue
            used, faces = np.unique(own, return_inverse=True)
            part = trimesh.Trimesh(
                mesh.positions[used],
                faces.reshape(-1, 3),
                vertex_normals=mesh.normals[used],
                vertex_colors=np.round(colours[used] * 255).astype(np.uint8),
                process=False,
            )
            part.vertex_attributes["_XYZ"] = mesh.xyz[used].astype(np.float32)
            scene.add_geometry(part, node_name=thing["name"], geom_name=thing["name"])
        output.write_bytes(path, _glb(scene))
        return float(exposure)


def _glb(scene: Any) -> bytes:
    return bytes(scene.export(file_type="glb", include_normals=True))


_NUMBERS = ("values", "direct", "irradiance", "reflectance", "transmittance", "caustics")
"""The arrays of a file whose numbers are finite and not negative."""

_OF_SOLUTION = (
    "elements",
    "patches",
    "adaptive",
    "form_factors",
    "solver",
    "light_samples",
    "mechanisms",
    "threshold",
)
"""The options by which a solution is made."""


def solve(
    scene: Scene | str | os.PathLike[str],
    *,
    cancel: Any = None,
    allow_outside: bool = False,
    memory_limit: int | str | None = None,
    **options: Any,
) -> Solution:
    """Solve for the light between the surfaces of a scene; Ctrl-C ends it.

    Args:
        scene: a `Scene`, or the path of a scene file.
        cancel: a `Cancel` of the core, which ends the work from another thread with the core's `Cancelled`.
        allow_outside, memory_limit: as for `illuminant.render`.
        options: as `illuminant.render` has them: `elements`, `patches`, `adaptive`, `form_factors`, `solver`,
            `light_samples`, `sampling`, `illumination`, `technique` (`radiosity`), `threads`.

    Raises:
        SceneError: the scene has mistakes; all of them are in `problems`.
        UsageError: an option cannot be, or does not go with the scene.

    Example:
        >>> solution = solve("scenes/cornell.toml", elements=2000)     # doctest: +SKIP
        >>> solution.illuminance([[0.278, 0.0001, 0.28]])               # doctest: +SKIP
    """
    from illuminant.scene import Scene

    if not isinstance(scene, Scene):
        with machine.limited_to(memory_limit):
            scene = Scene.load(scene, allow_outside=allow_outside)
    defaults = dict(scene.render_defaults)
    if defaults.get("technique") not in SOLVED:
        defaults["technique"] = SOLVED[0]
    settings = resolve(defaults, **options)
    if settings.technique not in SOLVED:
        raise UsageError(
            f"technique {settings.technique}: nothing is solved for; expected {' or '.join(SOLVED)}."
        )

    def solve_by(scene: Scene, settings: Settings) -> Any:
        return core().Solution(scene.core(settings.threads), settings.to_core(), cancel)

    chosen = {field.name: getattr(settings, field.name) for field in dataclasses.fields(Settings)}
    job = Job(scene, solve_by=None if cancel is None else solve_by, memory_limit=memory_limit, **chosen)
    return Solution(scene, settings, job.core_render.solution())


def _with_lamps(scene: Scene, lamps: Mapping[str, float | str | Spectrum]) -> Scene:
    """A scene whose lamps have other spectra or powers."""
    from illuminant import spectra
    from illuminant.resolution import in_place, indexed
    from illuminant.scene import Scene
    from illuminant.spectrum import Spectrum

    parts = in_place(scene.description)
    entries = {
        thing["name"]: thing["emission"] for thing in parts["objects"] if thing["emission"] is not None
    }
    entries |= {light["name"]: light for light in parts["lights"]}
    for name, change in lamps.items():
        entry = entries.get(name)
        if entry is None:
            hint = suggestion(name, list(entries)) or f"there are {', '.join(sorted(entries))}"
            raise UsageError(f"There is no lamp {name!r}: {hint}.")
        if isinstance(change, (int, float)):
            if not 0 <= change < float("inf"):
                raise UsageError(f"lamp {name!r}: a factor must be 0 or more, not {change}.")
            if "quantity" not in entry:
                raise UsageError(f"lamp {name!r} has no power of its own to be multiplied.")
            entry["quantity"] = entry["quantity"] | {"value": entry["quantity"]["value"] * float(change)}
        else:
            if entry.get("spectrum") is None:
                raise UsageError(f"lamp {name!r} has no spectrum of its own to be replaced.")
            entry["spectrum"] = change if isinstance(change, Spectrum) else spectra.load(change)
    result = Scene(
        indexed(parts),
        scene.arrays,
        title=scene.title,
        render_defaults=scene.render_defaults,
        frame=scene.frame,
        path=scene.path,
        warnings=scene.warnings,
    )
    result._geometry = scene._geometry
    return result


def _lamp_forms(scene: Scene) -> list[dict[str, Any]]:
    """All that lamps are but for their spectra and powers."""
    description = scene.description
    things = [
        {"name": thing["name"], **thing["emission"]}
        for thing in description["objects"]
        if thing["emission"] is not None
    ]
    lamps: Sequence[dict[str, Any]] = [*things, *description["lights"]]
    return [{key: one for key, one in lamp.items() if key not in ("spectrum", "quantity")} for lamp in lamps]


def _paints(scene: Scene) -> Any:
    """What determines reflectances."""
    from illuminant.resolution import in_place

    parts = in_place(scene.description)
    images = {
        name: array.tobytes() for name, array in scene.arrays.items() if name.startswith("image:texture ")
    }
    return parts["materials"], parts["skins"], [thing["material"] for thing in parts["objects"]], images


def _mirrors(scene: Scene) -> list[Any]:
    """The materials that are more than diffuse."""
    from illuminant.resolution import in_place

    materials = in_place(scene.description)["materials"]
    return [
        one["surface"] if one["surface"]["kind"] not in ("diffuse", "translucent") else None
        for one in materials
    ]


def _moved(before: Scene, now: Scene) -> list[int]:
    """The objects that stand elsewhere, or are shaped otherwise."""
    import numpy as np

    if before._geometry is now._geometry:
        return []

    def shape(scene: Scene, number: int) -> list[np.ndarray]:
        own = int(scene.arrays["placements"][number])
        names = sorted(name for name in scene.arrays if name.startswith(f"shape:{own}:"))
        return [scene.arrays[f"placement:{number}"], *(scene.arrays[name] for name in names)]

    def same(number: int) -> bool:
        a, b = shape(before, number), shape(now, number)
        return len(a) == len(b) and all(np.array_equal(x, y) for x, y in zip(a, b, strict=True))

    return [number for number in range(len(now.arrays["placements"])) if not same(number)]
