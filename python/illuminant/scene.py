"""The resolved scene: plain data that can be hashed, written, sent, changed in part, and given to the core.

A `Scene` is a description (a JSON-able dict: curves, materials, objects, lights, camera, in metres and nm) and arrays
(shapes, transforms, images). It comes from a scene file (`Scene.load`), from Python with the same keys and with arrays
for meshes and images (`Scene.build`), or from the bytes of another one (`Scene.from_bytes`).

Names of the arrays: `shape:I:positions` (V, 3) float32, `shape:I:indices` (F, 3) uint32, `shape:I:normals` (V, 3)
float32, `shape:I:uvs` (V, 2) float32, or `shape:I:sphere` (4,) float64 (centre and radius); `placements` (P,) uint32,
the shape of each object; `placement:P` (K, 3, 4) float64, its transforms from the object to the world, K keys spread
over the shutter; `image:NAME` (h, w, 3) float32, the linear RGB of an environment. They are read-only.

Example:
    >>> scene = Scene.build(
    ...     camera={"eye": [0, 0, 3], "target": [0, 0, 0], "size": [64, 64]},
    ...     materials={"grey": {"kind": "diffuse", "reflectance": 0.5}},
    ...     objects={"ball": {"sphere": {"radius": 1.0}, "material": "grey"}},
    ...     lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 1000.0}},
    ... )
    >>> scene.description["objects"]
    [{'name': 'ball', 'material': 0, 'emission': None}]
    >>> scene.hash() == Scene.from_bytes(scene.to_bytes()).hash()
    True
"""

from __future__ import annotations

import copy
import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import sources
from illuminant.errors import DataError, SceneError, suggestion
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Scene", "load"]

FORMAT = "illuminant scene 1"

MOST_BYTES = 16_000_000_000
"""The largest file that `Scene.save` wrote."""


class _Geometry:
    """What scenes share that differ only in camera, materials and lights: the core's ray structure and the digest."""

    def __init__(self) -> None:
        self.core: Any = None
        self.digest: bytes = b""


class Scene:
    """A scene as plain data; make one by `load`, `build`, `replace` or `from_bytes`.

    Attributes:
        description: what the core reads, JSON-able; see `docs/scene-file.md` for the meaning of each part.
        arrays: name to read-only array; see this module's page.
        title: what the scene shows.
        render_defaults: the table `[render]` of the file.
        frame: the keys of the file that `replace` needs again: length unit, up axis, range, named spectra, camera.
        path: the scene file, or None.
        warnings: sentences on what was accepted but may surprise.
    """

    def __init__(
        self,
        description: dict[str, Any],
        arrays: Mapping[str, np.ndarray],
        *,
        title: str = "",
        render_defaults: Mapping[str, Any] | None = None,
        frame: Mapping[str, Any] | None = None,
        path: str | None = None,
        warnings: Sequence[str] = (),
    ) -> None:
        self.description = description
        self.arrays: dict[str, np.ndarray] = dict(arrays)
        for array in self.arrays.values():
            array.setflags(write=False)
        self.title = title
        self.render_defaults: dict[str, Any] = dict(render_defaults or {})
        self.frame: dict[str, Any] = dict(frame or {})
        self.path = path
        self.warnings = list(warnings)
        self._geometry = _Geometry()
        self._core: Any = None

    def __repr__(self) -> str:
        """Title or file, and what the scene holds."""
        name = self.title or self.path or "scene"
        objects, lights = len(self.description["objects"]), len(self.description["lights"])
        return f"<Scene {name!r}: {objects} objects, {self.triangles} triangles, {lights} lights>"

    # --- making ------------------------------------------------------------------------------------------------

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, allow_outside: bool = False) -> Scene:
        """Read a scene file (TOML), or a scene written by `save`.

        Args:
            path: of the file.
            allow_outside: whether the files that it names may lie outside its folder: say so only of scenes that you
                trust.

        Raises:
            SceneError: the file cannot be read or has mistakes; all of them are in `problems`.
        """
        from illuminant import scene_file

        try:
            with sources.opened(path, MOST_BYTES) as stream:
                written = stream.read(4) == b"PK\x03\x04"
            if written:
                return cls.from_bytes(sources.read(path, MOST_BYTES))
        except SourceError:
            pass  # the reader of scene files says what is wrong
        except DataError as error:
            raise SceneError(f"{os.fspath(path)}: {error.message}") from None
        return scene_file.load(path, allow_outside=allow_outside)

    @classmethod
    def build(
        cls,
        *,
        camera: Mapping[str, Any],
        objects: Mapping[str, Mapping[str, Any]] | Sequence[Mapping[str, Any]],
        materials: Mapping[str, Mapping[str, Any]],
        lights: Mapping[str, Mapping[str, Any]] | None = None,
        spectra: Mapping[str, Any] | None = None,
        atmosphere: Mapping[str, Any] | None = None,
        medium: Mapping[str, Any] | None = None,
        render: Mapping[str, Any] | None = None,
        title: str = "",
        length_unit: str = "m",
        up: str = "y",
        range_nm: Sequence[float] = (380.0, 780.0),
        directory: str | os.PathLike[str] = ".",
        allow_outside: bool = True,
    ) -> Scene:
        """Make a scene in Python, without any file.

        The keys are those of the scene file; NumPy arrays and tuples may stand for lists, a `Spectrum` for a
        spectrum, an (h, w, 3) array of linear RGB for the `image` of an environment, and arrays for `positions`,
        `faces`, `normals` and `uvs` of a mesh.

        Args:
            camera: the table `[camera]`.
            objects: the tables `[objects.NAME]`, or a list of such tables, named "object 1" and so on unless a
                table has the key `name`.
            materials: the tables `[materials.NAME]`.
            lights: the tables `[lights.NAME]`.
            spectra: the table `[spectra]`.
            atmosphere: the table `[atmosphere]`.
            medium: the table `[medium]`; its `density` may be an (x, y, z) array.
            render: the table `[render]`.
            title: what the scene shows.
            length_unit: unit of all lengths: m, cm, mm, in, ft.
            up: axis of the world that is up: y, z.
            range_nm: first and last wavelength.
            directory: folder that file names are relative to.
            allow_outside: whether files may lie outside that folder. They may, since tables come from the program
                itself, which can read any file anyway; a service that passes on tables from others says False.

        Raises:
            SceneError: mistakes; all of them are in `problems`.

        Example:
            >>> import numpy as np
            >>> triangle = {"positions": np.eye(3), "faces": np.array([[0, 1, 2]])}
            >>> scene = Scene.build(
            ...     camera={"eye": (3, 3, 3), "target": (0, 0, 0)},
            ...     objects=[{"mesh": triangle, "material": "lamp"}],
            ...     materials={"lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 800}},
            ... )
            >>> scene.triangles
            1
        """
        from illuminant import scene_file

        if not isinstance(objects, Mapping):
            objects = {
                str(table.get("name", f"object {i}")): {key: table[key] for key in table if key != "name"}
                for i, table in enumerate(objects, start=1)
            }
        data: dict[str, Any] = {
            "title": title,
            "length_unit": length_unit,
            "up": up,
            "range_nm": range_nm,
            "camera": camera,
            "objects": objects,
            "materials": materials,
            "lights": lights,
            "spectra": spectra,
            "atmosphere": atmosphere,
            "medium": medium,
            "render": render,
        }
        return scene_file.resolve(
            scene_file.plain({key: data[key] for key in data if data[key] is not None}),
            directory,
            allow_outside=allow_outside,
        )

    def replace(
        self,
        *,
        camera: Mapping[str, Any] | None = None,
        materials: Mapping[str, Mapping[str, Any]] | None = None,
        lights: Mapping[str, Mapping[str, Any] | None] | None = None,
    ) -> Scene:
        """The same scene with another camera, other materials or other lights; the geometry is shared.

        The keys are those of the scene file, in the file's length unit; names of its `[spectra]` may be used.

        Args:
            camera: keys that change (the others stay); or a whole camera as `description["camera"]` has it.
            materials: whole tables of materials that the scene has.
            lights: whole tables of lights, new or in place of those of the same name; None takes one away.

        Returns:
            A new scene; this one does not change.

        Raises:
            SceneError: mistakes; all of them are in `problems`.
        """
        from illuminant import scene_file
        from illuminant.report import Report
        from illuminant.resolution import Resolver, in_place, indexed

        report = Report()
        resolver = Resolver(report, self.frame, allow_outside=True)
        parts = in_place(self.description)
        frame = dict(self.frame)
        if camera is not None:
            camera = scene_file.plain(camera)
            if "field_of_view_deg" in camera:
                metres = Resolver(report, self.frame | {"length_unit": "m"}, allow_outside=True)
                keys = {"field_of_view_deg": "field_of_view"}
                given = {
                    keys.get(key, key): one
                    for key, one in camera.items()
                    if key not in _RESOLVED and one is not None
                }
                parts["camera"] = metres.camera(given)
                if parts["camera"] is not None:
                    parts["camera"] |= {key: camera[key] for key in _RESOLVED if camera.get(key) is not None}
                back = resolver.unit_m
                stays = ("shutter", *(_OF_THE_LENS if camera.get("lens") is not None else ()))
                kept = {key: one for key, one in frame.get("camera", {}).items() if key in stays}
                places = {key: [x / back for x in given[key]] for key in ("eye", "target")}
                frame["camera"] = kept | given | places
            else:
                frame["camera"] = frame.get("camera", {}) | camera
                parts["camera"] = resolver.camera(frame["camera"])
        names = [material["name"] for material in parts["materials"]]
        for name, table in (materials or {}).items():
            if name not in names:
                report.add(
                    ("materials", name),
                    "is not a material of this scene",
                    suggestion(name, names),
                    "unknown-material",
                )
                continue
            resolved = resolver.material(name, scene_file.plain(table))
            if resolved is None:
                continue
            index = names.index(name)
            parts["materials"][index] = resolved.entry
            parts["skins"][index] = resolved.skin
            for thing in parts["objects"]:
                if thing["material"] == index:
                    thing["emission"] = copy.copy(resolved.emission)
        arrays = dict(self.arrays)
        for name, light in (lights or {}).items():
            entry = None if light is None else resolver.light(name, scene_file.plain(light))
            place = [i for i, present in enumerate(parts["lights"]) if present["name"] == name]
            if entry is None:
                parts["lights"] = [present for present in parts["lights"] if present["name"] != name]
            elif place:
                parts["lights"][place[0]] = entry
            else:
                parts["lights"].append(entry)
            arrays.pop(f"image:{name}", None)
        if not report.problems and not scene_file.shines(parts):
            report.add((), scene_file.NO_LIGHT, kind="no-light")
        report.raise_if_any()
        arrays |= {f"image:{name}": image for name, image in resolver.all_images().items()}
        # Images of surfaces that no material shows any more.
        shown = json.dumps(parts["skins"], default=lambda spectrum: spectrum.name)
        unused = [
            name for name in arrays if name.startswith("image:texture ") and json.dumps(name[6:]) not in shown
        ]
        arrays = {name: array for name, array in arrays.items() if name not in unused}
        result = Scene(
            indexed(parts),
            arrays,
            title=self.title,
            render_defaults=self.render_defaults,
            frame=frame,
            path=self.path,
            warnings=[*self.warnings, *resolver.warnings()],
        )
        result._geometry = self._geometry
        return result

    def share_geometry(self, other: Scene) -> bool:
        """Use the ray structure of another scene if all shapes stand alike in both, which changes no bit.

        Returns:
            Whether they do.
        """
        for scene in (self, other):
            if not scene._geometry.digest:
                scene._geometry.digest = _digest(scene.arrays, lambda name: not name.startswith("image:"))
        alike = self._geometry.digest == other._geometry.digest
        if alike and self._core is None:
            self._geometry = other._geometry
        return alike

    # --- plain data --------------------------------------------------------------------------------------------

    def hash(self) -> str:
        """SHA-256 over the description (canonical JSON) and the bytes of all arrays, as 64 hexadecimal digits.

        Equal for equal scenes, whatever they were made from; title, path and `[render]` do not count.
        """
        if not self._geometry.digest:
            self._geometry.digest = _digest(self.arrays, lambda name: not name.startswith("image:"))
        total = hashlib.sha256(_canonical(self.description))
        total.update(self._geometry.digest)
        total.update(_digest(self.arrays, lambda name: name.startswith("image:")))
        return total.hexdigest()

    def to_bytes(self) -> bytes:
        """The whole scene as bytes (a NumPy `.npz` archive with a JSON header), equal for equal scenes."""
        import io

        import numpy as np

        header = {
            "format": FORMAT,
            "description": self.description,
            "title": self.title,
            "render_defaults": self.render_defaults,
            "frame": self.frame,
            "path": self.path,
            "warnings": self.warnings,
        }
        stream = io.BytesIO()
        arrays = {name: self.arrays[name] for name in sorted(self.arrays)}
        np.savez(stream, allow_pickle=False, scene=np.frombuffer(_canonical(header), np.uint8), **arrays)
        return stream.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> Scene:
        """The scene that `to_bytes` wrote.

        `replace` no longer knows the names of spectra that came from files.

        Raises:
            DataError: the bytes are not such a scene.
        """
        import io

        from illuminant import archives, scene_arrays

        try:
            arrays = archives.read(io.BytesIO(data))
            header = json.loads(arrays.pop("scene").tobytes())
            if header["format"] != FORMAT:
                raise KeyError
            scene_arrays.check(arrays)
            # What they were read from may lie anywhere, and is none of a reader's business.
            frame = header["frame"]
            if "spectra" in frame:
                frame["spectra"] = {
                    key: one
                    for key, one in frame["spectra"].items()
                    if not (isinstance(one, dict) and "file" in one)
                }
            return cls(
                header["description"],
                arrays,
                title=header["title"],
                render_defaults=header["render_defaults"],
                frame=frame,
                path=header["path"],
                warnings=header["warnings"],
            )
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            raise DataError("is not a scene written by this version of illuminant") from None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `to_bytes` to a file, atomically; `Scene.load` reads it again."""
        from illuminant import output

        output.write_bytes(Path(path), self.to_bytes())

    # --- the core ----------------------------------------------------------------------------------------------

    def core(self, threads: int = 0) -> Any:
        """The scene as the core has it (`_core.Scene`), built when first asked for.

        The ray structure is built once for all scenes that `replace` made of one another.

        Args:
            threads: used for building; 0 for one a processor. Changes no bit of an image.

        Raises:
            SceneError: the core refuses the scene.
            MachineError: the core or Embree cannot be loaded.
        """
        if self._core is None:
            from illuminant import core as extension

            extension.embree()
            core = extension.core()
            try:
                if self._geometry.core is None:
                    self._geometry.core = core.Geometry(self.shapes(), self.placements(), threads)
                images = {name[6:]: self.arrays[name] for name in self.arrays if name.startswith("image:")}
                self._core = core.Scene(self._geometry.core, json.dumps(self.description), images)
            except ValueError as error:
                raise SceneError(f"{self.path}: {error}" if self.path else str(error)) from error
        return self._core

    def shapes(self) -> list[dict[str, Any]]:
        """The shapes as `_core.Geometry` takes them: meshes with their arrays, spheres with centre and radius."""
        found: dict[int, dict[str, Any]] = {}
        for name, array in self.arrays.items():
            kind, _, rest = name.partition(":")
            if kind != "shape":
                continue
            number, _, part = rest.partition(":")
            if part == "sphere":
                found[int(number)] = {"kind": "sphere", "center": array[:3], "radius": float(array[3])}
            else:
                mesh = found.setdefault(int(number), {"kind": "mesh", "normals": None, "uvs": None})
                mesh[part] = array
        return [found[number] for number in sorted(found)]

    def placements(self) -> list[tuple[int, np.ndarray]]:
        """For each object the number of its shape and its (K, 3, 4) transforms."""
        return [
            (int(shape), self.arrays[f"placement:{i}"]) for i, shape in enumerate(self.arrays["placements"])
        ]

    @property
    def triangles(self) -> int:
        """Triangles of all objects, each instance counted."""
        counts = [len(shape["indices"]) if shape["kind"] == "mesh" else 0 for shape in self.shapes()]
        return sum(counts[shape] for shape, _ in self.placements())

    def viewing_distance(self, image_width: float) -> float:
        """How far from an image of this width the eye sees it as the camera does (book 1.1).

        d_view = w_image / (2 tan(field of view / 2)).

        Args:
            image_width: of the displayed image, in any unit.

        Returns:
            The distance in that unit.

        Example:
            A field of view of 53.13° is that of a viewer as far away as the image is wide.
        """
        import math

        return image_width / (
            2.0 * math.tan(math.radians(self.description["camera"]["field_of_view_deg"]) / 2.0)
        )


_RESOLVED = ("shutter", "lens", "end")
"""Keys of a resolved camera that the scene file writes otherwise."""

_OF_THE_LENS = ("focal_length_mm", "f_number", "focus_distance", "blades", "blades_turned")


def load(path: str | os.PathLike[str], *, allow_outside: bool = False) -> Scene:
    """Read a scene file; see `Scene.load`.

    Example:
        >>> scene = load("scenes/cornell.toml")                # doctest: +SKIP
    """
    return Scene.load(path, allow_outside=allow_outside)


def _canonical(value: Any) -> bytes:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False).encode()


def _digest(arrays: Mapping[str, np.ndarray], wanted: Any) -> bytes:
    total = hashlib.sha256()
    for name in sorted(filter(wanted, arrays)):
        array = arrays[name]
        total.update(f"{name} {array.dtype.str} {array.shape};".encode())
        total.update(array.tobytes())
    return total.digest()
