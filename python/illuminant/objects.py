"""The objects of a scene: which shape, where it stands, and of which material.

A sphere stays a true sphere and can only be scaled evenly; all other shapes are triangle meshes in metres, in the axes
of the world, in single precision. A transform that mirrors turns the faces of the mesh round, so that what was outside
stays outside. Objects that use the same file share its arrays.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from illuminant import meshes, placement, shapes, sources
from illuminant.errors import DataError, suggestion
from illuminant.report import Path, Report, read_table
from illuminant.schema import MeshTable, Move, Object

if TYPE_CHECKING:
    import numpy as np

__all__ = ["SHAPES", "ObjectResolver", "Placed"]

SHAPES = ("mesh", "sphere", "rectangle", "box", "disc")
"""The keys of which an object has exactly one."""

SMALLEST_RADIUS = 1e-12
"""The smallest radius of a sphere, in metres."""


@dataclass(frozen=True)
class Placed:
    """The shape of an object and where it stands.

    Attributes:
        arrays: "positions", "indices" and perhaps "normals" and "uvs" of a mesh, or "sphere" (centre and radius).
        transform: float64 (K, 3, 4), keys at even distances over the time in which things move; one is at rest.
    """

    arrays: dict[str, np.ndarray]
    transform: np.ndarray


class ObjectResolver:
    """Resolves the objects of one scene.

    Args:
        report: takes the mistakes.
        length_unit: unit of all lengths in the scene.
        up: axis of the world that is up.
        directory: folder that file names are relative to.
        files: meshes that were read already, to be shared by scenes of one file; it grows.
        allow_outside: whether files may lie outside that folder.
    """

    def __init__(
        self,
        report: Report,
        length_unit: str = "m",
        up: str = "y",
        directory: str | os.PathLike[str] = ".",
        files: dict[tuple[Any, ...], shapes.Mesh | DataError] | None = None,
        *,
        allow_outside: bool = False,
    ) -> None:
        self.report = report
        self.unit_m = placement.METRES[length_unit]
        self.up = up
        self.directory, self.allow_outside = FilePath(directory), allow_outside
        self._files = {} if files is None else files
        self._shared: dict[tuple[int, bool | None, bool], tuple[shapes.Mesh, dict[str, np.ndarray]]] = {}

    def placed(self, name: str, raw: Any, materials: Mapping[str, Any]) -> tuple[Placed, str] | None:
        """The shape of an object with its place and the name of its material, or None after reporting mistakes."""
        path: Path = ("objects", name)
        before = len(self.report.problems)
        table, bad = read_table(Object, raw, path, self.report)
        if table is None:
            return None
        if "material" not in bad and table.material not in materials:
            known = ", ".join(materials) if 0 < len(materials) <= 12 else ""
            self.report.add(
                (*path, "material"),
                f'there is no material "{table.material}"' + (f"; [materials] has {known}" if known else ""),
                suggestion(table.material, materials),
                "unknown-material",
            )
        given = [key for key in SHAPES if key in raw]
        matrix = (
            self._transform(table, raw, path)
            if not bad & {"scale", "rotate", "translate", "matrix"}
            else None
        )
        placed = None
        if len(given) != 1:
            what = " and ".join(given) or "none"
            self.report.add(
                path, f"must have exactly one of {', '.join(SHAPES)}; found {what}", kind="exactly-one"
            )
        elif given[0] not in bad:
            arrays = self._shape(table, given[0], matrix, path)
            if arrays is not None and matrix is not None:
                placed = Placed(arrays, self._keys(table, raw, matrix, path))
        return None if placed is None or len(self.report.problems) > before else (placed, table.material)

    def _keys(self, table: Object, raw: dict[str, Any], first: np.ndarray, path: Path) -> np.ndarray:
        """The transform and those of `motion`."""
        import numpy as np

        keys = [first]
        for i, move in enumerate(table.motion or []):
            matrix = self._transform(move, raw["motion"][i], (*path, "motion", i))
            if matrix is None:
                continue
            if (np.linalg.det(matrix[:, :3]) > 0) != (np.linalg.det(first[:, :3]) > 0):
                self.report.add(
                    (*path, "motion", i), "turns the object inside out on its way", kind="transform"
                )
            if table.sphere is not None and placement.even_scale(matrix[:, :3]) is None:
                message = "must scale a sphere the same in all directions"
                self.report.add((*path, "motion", i), message, kind="transform")
            keys.append(matrix)
        return np.array(keys)

    def _transform(self, table: Move | Object, raw: dict[str, Any], path: Path) -> np.ndarray | None:
        others = [key for key in ("scale", "rotate", "translate") if key in raw]
        if "matrix" in raw and others:
            self.report.add(
                (*path, "matrix"),
                f"stands instead of {', '.join(others)}; give one or the other",
                kind="exactly-one",
            )
            return None
        rotations = (
            [] if table.rotate is None else table.rotate if isinstance(table.rotate, list) else [table.rotate]
        )
        try:
            return placement.transform(
                table.scale,
                [(rotation.axis, rotation.degrees) for rotation in rotations],
                table.translate,
                table.matrix,
                self.unit_m,
            )
        except DataError as error:
            key = "matrix" if "matrix" in raw else "rotate" if "axis" in error.message else "scale"
            self.report.add((*path, key), error.message, kind="transform")
            return None

    def _shape(
        self, table: Object, which: str, matrix: np.ndarray | None, path: Path
    ) -> dict[str, np.ndarray] | None:
        import numpy as np

        place = (*path, which)
        if table.sphere is not None:
            if matrix is not None and placement.even_scale(matrix[:, :3]) is None:
                key = "matrix" if table.matrix is not None else "scale"
                self.report.add(
                    (*path, key),
                    "must be the same in all directions for a sphere, which stays a true sphere",
                    "use a mesh for an ellipsoid",
                    "transform",
                )
            sphere = np.array([*table.sphere.center, table.sphere.radius]) * self.unit_m
            if sphere[3] < SMALLEST_RADIUS:
                message = f"must be at least {SMALLEST_RADIUS:g} m, found {table.sphere.radius:g}"
                self.report.add((*place, "radius"), message, kind="range")
            return {"sphere": sphere}
        mirrored = matrix is not None and float(np.linalg.det(matrix[:, :3])) < 0
        try:
            return self._arrays(self._mesh(table, place), table.smooth, mirrored)
        except DataError as error:
            kind = "missing-file" if error.message == "there is no such file" else "mesh"
            kind = "outside" if sources.is_outside(error) else kind
            self.report.add_data_error(place, error, kind)
            return None

    def _arrays(self, mesh: shapes.Mesh, smooth: bool | None, mirrored: bool) -> dict[str, np.ndarray]:
        """A mesh as the core takes it; objects that share a mesh share its arrays."""
        import numpy as np

        key = (id(mesh), smooth, mirrored)
        if key not in self._shared:
            if smooth and mesh.normals is None:
                shown = mesh.smoothed()
            else:
                shown = mesh
            if mirrored:
                shown = shown.reversed()
            arrays = {
                "positions": np.ascontiguousarray(shown.positions, np.float32),
                "indices": np.ascontiguousarray(shown.indices, np.uint32),
            }
            if shown.normals is not None and smooth is not False:
                arrays["normals"] = np.ascontiguousarray(shown.normals, np.float32)
            if shown.uvs is not None:
                arrays["uvs"] = np.ascontiguousarray(shown.uvs, np.float32)
            self._shared[key] = (mesh, arrays)
        return self._shared[key][1]

    def _mesh(self, table: Object, place: Path) -> shapes.Mesh:
        """The mesh of an object in metres and in the axes of the world, checked."""
        if table.mesh is not None:
            given = table.mesh if isinstance(table.mesh, MeshTable) else MeshTable(file=table.mesh)
            if given.file is not None:
                return self._mesh_file(given)
            if given.positions is None or given.faces is None:
                raise DataError("must have file, or positions and faces")
            mesh = shapes.mesh_from_arrays(given.positions, given.faces, given.normals, given.uvs)
            return self._in_world(mesh, given.unit, given.up, given.zero_area)
        if table.rectangle is not None:
            one = table.rectangle
            if one.corners is not None and one.corner is None and one.edges is None:
                mesh = shapes.quadrilateral(one.corners)
            elif one.corner is not None and one.edges is not None and one.corners is None:
                mesh = shapes.rectangle(one.corner, one.edges)
            else:
                raise DataError("must have corner and edges, or corners")
        elif table.box is not None:
            mesh = shapes.box(table.box.min, table.box.max)
        else:
            assert table.disc is not None
            mesh = shapes.disc(table.disc.center, table.disc.normal, table.disc.radius)
        return self._in_world(mesh, None, None, "error")

    def _mesh_file(self, given: MeshTable) -> shapes.Mesh:
        if given.positions is not None or given.faces is not None:
            raise DataError("must have file, or positions and faces, not both")
        file = sources.located(str(given.file), self.directory, self.allow_outside)
        key = (str(file), given.unit, given.up, given.zero_area)
        if key not in self._files:
            try:
                mesh = meshes.read(
                    file, given.zero_area, within=None if self.allow_outside else self.directory
                )
                standard = meshes.format_of(file) in ("glb", "gltf")
                unit = given.unit or ("m" if standard else None)
                self._files[key] = self._in_world(
                    mesh, unit, given.up or ("y" if standard else None), given.zero_area
                )
            except DataError as error:
                self._files[key] = DataError(error.message, error.file or str(file))
        result = self._files[key]
        if isinstance(result, DataError):
            raise result
        return result

    def _in_world(self, mesh: shapes.Mesh, unit: str | None, up: str | None, zero_area: str) -> shapes.Mesh:
        scale = placement.METRES[unit] if unit else self.unit_m
        linear = scale * placement.turn_up(up or self.up, self.up)
        return mesh.transformed(linear).checked(zero_area)
