"""glTF and GLB files before trimesh reads them: what they state is checked, and what is not wanted is taken out.

A glTF file is JSON that points into buffers of bytes, and it may state much with few words: an accessor of four
billion zeros without any buffer, or a thousand primitives that all are the same ten million vertices. Here everything
is counted before it is made. Images and textures are taken out of the file, since only geometry is read: nobody
decodes pictures that nobody sees.

The format is that of the Khronos Group, "glTF 2.0 Specification" (2021), sections 3.6 (accessors), 4 (GLB).

Example:
    >>> stripped(b'{"asset": {"version": "2.0"}, "images": [{"uri": "/etc/passwd"}]}', "gltf", 100, 100)
    (b'{"asset":{"version":"2.0"}}', 0)
"""

from __future__ import annotations

import json
import struct
from typing import Any

from illuminant.errors import DataError

__all__ = ["stripped"]

_MAGIC = b"glTF"
_JSON = 0x4E4F534A
_BYTES = {"5120": 1, "5121": 1, "5122": 2, "5123": 2, "5125": 4, "5126": 4}
"""Bytes of a number by its `componentType`."""

_NUMBERS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
"""Numbers of an element by its `type`."""

_PICTURES = ("images", "textures", "samplers", "animations", "skins")


def stripped(data: bytes, kind: str, most_vertices: int, most_faces: int) -> tuple[bytes, int]:
    """The file without its pictures, and how much its parts take, after its numbers were checked.

    Args:
        data: of the file.
        kind: "gltf" or "glb".
        most_vertices, most_faces: in all primitives together.

    Returns:
        The file, and the bytes of its buffers, views and accessors: a reader copies each of them.

    Raises:
        DataError: it states more than that, or what cannot be.
        ValueError: it is no such file.
    """
    start, end = 0, len(data)
    if kind == "glb":
        if len(data) < 20 or data[:4] != _MAGIC:
            raise ValueError("it does not begin as a GLB file does")
        length, type_of_chunk = struct.unpack_from("<II", data, 12)
        if type_of_chunk != _JSON or length > len(data) - 20:
            raise ValueError("its header of JSON is missing or cut off")
        start, end = 20, 20 + length
    try:
        header = json.loads(data[start:end])
    except RecursionError:
        raise DataError("has JSON that is nested too deeply") from None
    if not isinstance(header, dict):
        raise ValueError("its JSON is no object")
    _check(header, most_vertices, most_faces)
    needed = _needed(header)
    for key in _PICTURES:
        header.pop(key, None)
    if "materials" in header:
        header["materials"] = [{} for _ in _list(header, "materials")]
    text = json.dumps(header, separators=(",", ":")).encode()
    if kind == "gltf":
        return text, needed
    text += b" " * (-len(text) % 4)
    rest = data[end:]
    head = struct.pack("<IIII", 2, 20 + len(text) + len(rest), len(text), _JSON)
    return _MAGIC + head + text + rest, needed


def _check(header: dict[str, Any], most_vertices: int, most_faces: int) -> None:
    accessors = _list(header, "accessors")
    counts: list[int] = []
    for accessor in accessors:
        count = accessor.get("count") if isinstance(accessor, dict) else None
        if not isinstance(count, int) or count < 0:
            raise DataError("has an accessor without a count")
        counts.append(count)
    most = max(most_vertices, 3 * most_faces)
    if any(count > most for count in counts):
        raise DataError(f"has an accessor of {max(counts):,} elements; at most {most:,} can be used")
    if any("bufferView" not in accessor and "sparse" not in accessor for accessor in accessors):
        # Zeros, or what an extension would have to unpack.
        raise DataError(
            "has an accessor without a buffer, whose numbers are all zero or packed by an extension"
        )
    vertices = corners = 0
    for mesh in _list(header, "meshes"):
        for primitive in _list(mesh, "primitives") if isinstance(mesh, dict) else ():
            attributes = primitive.get("attributes") if isinstance(primitive, dict) else None
            position = attributes.get("POSITION") if isinstance(attributes, dict) else None
            indices = primitive.get("indices", position) if isinstance(primitive, dict) else None
            vertices += _count(counts, position)
            corners += _count(counts, indices)
    if vertices > most_vertices:
        raise DataError(f"has {vertices:,} vertices; at most {most_vertices:,} can be used")
    if corners > 3 * most_faces:
        raise DataError(f"has {corners // 3:,} faces; at most {most_faces:,} can be used")


def _needed(header: dict[str, Any]) -> int:
    """Bytes of all buffers, views and accessors, each with its own copy of what it shows."""
    total = 0
    for key in ("buffers", "bufferViews"):
        for part in _list(header, key):
            length = part.get("byteLength") if isinstance(part, dict) else None
            if not isinstance(length, int) or length < 0:
                raise DataError(f"has {key} without a length")
            total += length
    for accessor in _list(header, "accessors"):
        size = _BYTES.get(str(accessor.get("componentType")), 4)
        total += accessor["count"] * size * _NUMBERS.get(str(accessor.get("type")), 16)
    return total


def _count(counts: list[int], number: Any) -> int:
    known = isinstance(number, int) and 0 <= number < len(counts)
    return counts[number] if known else 0


def _list(table: dict[str, Any], key: str) -> list[Any]:
    found = table.get(key, [])
    if not isinstance(found, list):
        raise ValueError(f"its {key} are no list")
    return found
