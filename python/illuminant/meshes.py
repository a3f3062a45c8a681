"""Meshes from files: OBJ, PLY, STL, GLB and glTF, also compressed by gzip (`.ply.gz`).

Plain PLY files are read by `ply`, all others by trimesh (it is imported only for them, which takes seconds). Neither
checks anything, so all is checked here: a mesh that comes back has faces, finite vertices, vertex numbers in range and
no face without area. All geometries of a file become one mesh, each under its transform in the file. Vertex normals
and texture coordinates are kept where every part has them; materials, colours and textures of the file are not read.

A GLB or glTF file is in metres with y up, by its standard. The other formats do not say: their unit is the scene's
`length_unit` and their up axis the scene's `up`, unless the scene file states `unit` or `up` for the mesh.

Example:
    >>> from illuminant.meshes import read
    >>> mesh = read("scenes/meshes/bunny.ply.gz")          # doctest: +SKIP
    >>> mesh.positions.shape, mesh.indices.shape           # doctest: +SKIP
    ((2503, 3), (4968, 3))
"""

from __future__ import annotations

import gzip
import io
import os
import re
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import gltf, machine, ply, sources
from illuminant.errors import DataError, MachineError
from illuminant.shapes import Mesh
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["FORMATS", "MAX_BYTES", "MOST_FACES", "MOST_VERTICES", "format_of", "read"]

FORMATS = ("obj", "ply", "stl", "glb", "gltf")
"""The mesh formats that are read."""

MAX_BYTES = 4_000_000_000
"""The largest mesh file, after decompression."""

MOST_VERTICES = 100_000_000
"""Vertices of a mesh at most."""

MOST_FACES = 100_000_000
"""Triangles of a mesh at most."""

BYTES_A_BYTE, BYTES_A_LETTER = 17, 12
"""Memory that a byte of a file takes while it is read: of numbers in binary, and in text."""

BYTES_A_VERTEX, BYTES_A_FACE = 130, 50
"""Memory that they take while parts are put together."""


def format_of(path: str | os.PathLike[str]) -> str:
    """The format of a mesh file by its name.

    Raises:
        DataError: it is none of `FORMATS`.
    """
    name = Path(path).name.lower().removesuffix(".gz")
    suffix = name.rpartition(".")[2] if "." in name else ""
    if suffix not in FORMATS:
        wanted = ", ".join(f".{known}" for known in FORMATS)
        raise DataError(
            f"is not a mesh file that can be read; expected {wanted}, or one of these with .gz", str(path)
        )
    return suffix


def read(
    path: str | os.PathLike[str], zero_area: str = "error", *, within: str | os.PathLike[str] | None = None
) -> Mesh:
    """One mesh of all that is in a file, in the file's own unit and axes.

    Args:
        path: a file in one of `FORMATS`, or one of these compressed by gzip.
        zero_area: "error" refuses faces without area, "remove" leaves them out.
        within: folder in which the files of buffers that a glTF file names must lie; None is anywhere.

    Returns:
        The mesh, checked; it has normals or texture coordinates when every part of the file has them.

    Raises:
        DataError: the file is missing, unreadable, damaged or empty, or its mesh is not usable; says what and where.
    """
    path = Path(path)
    kind = format_of(path)
    try:
        parts = _parts(_bytes(path), kind, path, within)
        mesh = _joined(parts)
    except DataError as error:
        raise DataError(error.message, str(path)) from None
    except MachineError:
        raise
    except MemoryError:
        raise DataError("is too large for the memory of this machine", str(path)) from None
    except Exception as error:  # whatever a damaged file makes of the reader
        if kind == "obj" and isinstance(error, IndexError):
            text = f"a face refers to a vertex that the file does not hold ({' '.join(str(error).split())})"
            raise DataError(text, str(path)) from None
        raise DataError(f"cannot be read as {kind.upper()} ({_clause(error)})", str(path)) from None
    try:
        return mesh.checked(zero_area)
    except DataError as error:
        raise DataError(error.message, str(path)) from None


def _bytes(path: Path) -> bytes:
    try:
        data = sources.read(path, MAX_BYTES)
        if path.name.lower().endswith(".gz"):
            with gzip.GzipFile(fileobj=io.BytesIO(data)) as stream:
                data = sources.drained(stream, MAX_BYTES + 1, name=str(path))
    except SourceError as error:
        raise DataError(error.message) from None
    except (EOFError, gzip.BadGzipFile, zlib.error) as error:
        raise DataError(f"is not compressed by gzip, or is damaged ({_clause(error)})") from None
    if len(data) > MAX_BYTES:
        raise DataError(f"is larger than {sources.amount(MAX_BYTES)}")
    if not data.strip():
        raise DataError("is an empty file")
    return data


def _parts(data: bytes, kind: str, path: Path, within: str | os.PathLike[str] | None) -> list[Mesh]:
    """The meshes in a file, each under its transform."""
    binary = kind in ("glb", "gltf") or b"\0" in data[:65536]
    machine.check_file(path, len(data) * (BYTES_A_BYTE if binary else BYTES_A_LETTER))
    if kind == "ply":
        _check_ply(data)
        if (plain := ply.read(data)) is not None:
            _check_count(len(plain.positions), len(plain.indices))
            return [plain if plain.normals is None else _with_unit_normals(plain)]
    if kind in ("glb", "gltf"):
        data, needed = gltf.stripped(data, kind, MOST_VERTICES, MOST_FACES)
        machine.check_file(path, needed)
    return _parts_by_trimesh(data, kind, path, within)


def _check_count(vertices: int, faces: int) -> None:
    """Refuse more than is possible."""
    for count, most, what in ((vertices, MOST_VERTICES, "vertices"), (faces, MOST_FACES, "faces")):
        if count > most:
            raise DataError(f"has {count:,} {what}; at most {most:,} can be used")


def _check_ply(data: bytes) -> None:
    """Refuse a header that states more elements than the file has bytes: trimesh believes it."""
    end = data.find(b"end_header", 0, ply.MAX_HEADER)
    if end < 0:
        raise ValueError("its header has no end, or is longer than 64 kB")
    for name, count in re.findall(rb"^element[ \t]+(\S+)[ \t]+([0-9]+)", data[:end], re.MULTILINE):
        if len(count) > 12 or int(count) > len(data):
            kind = name.decode("latin-1")[:40]
            raise DataError(
                f'states {int(count[:30]):,} elements "{kind}", and has {len(data):,} bytes in all'
            )


def _parts_by_trimesh(
    data: bytes, kind: str, path: Path, within: str | os.PathLike[str] | None = None
) -> list[Mesh]:
    import logging

    import numpy as np
    import trimesh
    from trimesh.resolvers import Resolver

    class Beside(Resolver):  # type: ignore[misc]
        """The files of buffers that a glTF file names."""

        def __init__(self) -> None:
            """Knows the folder already."""
            self.known: dict[str, bytes] = {}

        def get(self, key: str) -> bytes:
            """The bytes of one."""
            file = path.parent / key
            try:
                found = sources.located(file.absolute(), within or ".", within is None)
                real = os.path.realpath(found)
                # Many buffers may name one file.
                if real not in self.known:
                    self.known[real] = sources.read(found, MAX_BYTES)
                return self.known[real]
            except SourceError as error:
                raise DataError(f"names a file of its own: {key}: {error.message}") from None

        def write(self, name: str, data: bytes) -> None:
            """Refuse: a mesh that is read writes nothing."""
            raise DataError(f"would write a file of its own: {name}")

        def namespaced(self, namespace: str) -> Beside:
            """There is one folder."""
            return self

        def keys(self) -> list[str]:
            """No file is offered."""
            return []

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    options: dict[str, Any] = {"process": False, "maintain_order": False}
    if kind == "obj":
        options["skip_materials"] = True
    if kind == "gltf":
        options["resolver"] = Beside()
    with np.errstate(all="ignore"):
        scene = trimesh.load_scene(io.BytesIO(data), file_type=kind, **options)
        parts = []
        placed = [scene.geometry[scene.graph[node][1]] for node in scene.graph.nodes_geometry]
        placed = [geometry for geometry in placed if isinstance(geometry, trimesh.Trimesh)]
        vertices, faces = (sum(len(getattr(one, part)) for one in placed) for part in ("vertices", "faces"))
        # A few words can place one mesh many times.
        _check_count(vertices, faces)
        machine.check_file(path, BYTES_A_VERTEX * vertices + BYTES_A_FACE * faces)
        for node in scene.graph.nodes_geometry:
            matrix, name = scene.graph[node]
            geometry = scene.geometry[name]
            if not isinstance(geometry, trimesh.Trimesh):
                continue
            parts.append(_part(geometry, np.array(matrix, dtype=np.float64)))
    return parts


def _part(geometry: Any, matrix: np.ndarray) -> Mesh:
    import numpy as np

    normals = geometry._cache.cache.get("vertex_normals")  # only those of the file: asking would make them
    uvs = getattr(geometry.visual, "uv", None)
    positions = np.array(geometry.vertices, dtype=np.float64)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise DataError("has vertices that are not three numbers each")
    mesh = Mesh(
        positions,
        np.array(geometry.faces, dtype=np.int64).reshape(-1, 3),
        None if normals is None or len(normals) != len(positions) else np.array(normals, dtype=np.float64),
        None if uvs is None or len(uvs) != len(positions) else np.array(uvs, dtype=np.float64)[:, :2],
    )
    if mesh.normals is not None:
        mesh = _with_unit_normals(mesh)
    linear = matrix[:3, :3]
    if np.array_equal(matrix, np.eye(4)):
        return mesh
    determinant = np.linalg.det(linear)
    if not np.isfinite(matrix).all() or determinant == 0:
        raise DataError("a part has a transform that flattens it to nothing")
    moved = mesh.transformed(linear)
    moved = Mesh(moved.positions + matrix[:3, 3], moved.indices, moved.normals, moved.uvs)
    return moved.reversed() if determinant < 0 else moved


def _with_unit_normals(mesh: Mesh) -> Mesh:
    """The mesh with normals of unit length; one of length zero is made from the faces around its vertex."""
    import numpy as np

    assert mesh.normals is not None
    length = np.linalg.norm(mesh.normals, axis=1, keepdims=True)
    normals = mesh.normals / np.where(length > 0, length, 1.0)
    lost = np.flatnonzero(length[:, 0] == 0)
    if len(lost):
        made = mesh.smoothed().normals
        assert made is not None
        normals[lost] = made[lost]
    return Mesh(mesh.positions, mesh.indices, normals, mesh.uvs)


def _joined(parts: list[Mesh]) -> Mesh:
    import numpy as np

    if not parts:
        raise DataError("the mesh is empty (it has no faces)")
    if len(parts) == 1:
        return parts[0]
    offsets = np.cumsum([0] + [len(part.positions) for part in parts])
    normals = [part.normals for part in parts if part.normals is not None]
    uvs = [part.uvs for part in parts if part.uvs is not None]
    return Mesh(
        np.concatenate([part.positions for part in parts]),
        np.concatenate([part.indices + offset for part, offset in zip(parts, offsets, strict=False)]),
        np.concatenate(normals) if len(normals) == len(parts) else None,
        np.concatenate(uvs) if len(uvs) == len(parts) else None,
    )


def _clause(error: Exception) -> str:
    """Text of an error as part of a sentence: one line, short, without its full stop."""
    if isinstance(error, (NameError, AttributeError, LookupError, TypeError, AssertionError)):
        return "its parts do not fit together"  # what the reader says of itself helps nobody
    text = " ".join(str(error).split()).rstrip(".") or type(error).__name__
    return text if len(text) <= 120 else text[:117] + "..."
