"""Plain PLY meshes, read by NumPy alone: what scanners and most exporters write.

Plain means: scalar properties of the vertices with x, y and z among them, perhaps nx, ny, nz and texture coordinates
(s and t, u and v, or texture_u and texture_v), and faces of which every one is a triangle; ASCII or binary of either
byte order. Anything else is left to trimesh, whose import takes seconds.

The format is that of G. Turk, "The PLY Polygon File Format" (1994).

Example:
    >>> text = '''ply
    ... format ascii 1.0
    ... element vertex 3
    ... property float x
    ... property float y
    ... property float z
    ... element face 1
    ... property list uchar int vertex_indices
    ... end_header
    ... 0 0 0  1 0 0  0 1 0
    ... 3 0 1 2
    ... '''
    >>> read(text.encode()).indices.tolist()
    [[0, 1, 2]]
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from illuminant.errors import DataError
from illuminant.shapes import Mesh

if TYPE_CHECKING:
    import numpy as np

__all__ = ["read"]

TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float32": "f4", "float64": "f8",
}  # fmt: skip
BYTE_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
MAX_HEADER = 65536
TEXTURE_COORDINATES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
LISTS = ("vertex_indices", "vertex_index")
COUNT = "(count)"


@dataclass
class _Element:
    """One kind of record: its name, how many there are, and its fields as NumPy names them."""

    name: str
    count: int
    fields: list[tuple[str, str] | tuple[str, str, tuple[int]]] = field(default_factory=list)


def read(data: bytes) -> Mesh | None:
    """The mesh of a PLY file, or None when it is not a plain one.

    Args:
        data: the whole file.

    Returns:
        The mesh as the file has it, unchecked: indices may be out of range, positions not finite, normals of any
        length.

    Raises:
        DataError: the file is plain, and ends before its last record.
    """
    import numpy as np

    header = _header(data)
    if header is None:
        return None
    order, elements, start = header
    if {"vertex", "face"} - {element.name for element in elements}:
        return None
    tables = _ascii(data[start:], elements) if order == "" else _binary(data, start, order, elements)
    if tables is None:
        return None
    vertices, faces = tables["vertex"], tables["face"]
    name = next((name for name in LISTS if name in (faces.dtype.names or ())), None)
    if name is None or (faces[COUNT] != 3).any():
        return None
    names = vertices.dtype.names or ()
    if not {"x", "y", "z"} <= set(names):
        return None

    def columns(*wanted: str) -> np.ndarray | None:
        """These properties of the vertices, side by side; None if one of them is not there."""
        if not set(wanted) <= set(names):
            return None
        return np.stack([vertices[one].astype(np.float64) for one in wanted], axis=1)

    positions = columns("x", "y", "z")
    assert positions is not None
    uvs = (columns(*pair) for pair in TEXTURE_COORDINATES)
    return Mesh(
        positions,
        faces[name].astype(np.int64),
        columns("nx", "ny", "nz"),
        next((pair for pair in uvs if pair is not None), None),
    )


def _header(data: bytes) -> tuple[str, list[_Element], int] | None:
    """Byte order, elements, and where the records begin; None when the header is not that of a plain file."""
    end = re.search(rb"\nend_header[ \t]*\r?\n", data[:MAX_HEADER])
    if end is None:
        return None
    lines = [line.split() for line in data[: end.start()].decode("latin-1").splitlines()]
    order = None
    elements: list[_Element] = []
    for words in lines[1:]:
        match words:
            case [] | ["comment" | "obj_info", *_]:
                continue
            case ["format", name, "1.0"] if name in BYTE_ORDERS and order is None:
                order = BYTE_ORDERS[name]
            case ["element", name, count] if re.fullmatch("[0-9]{1,12}", count):
                if name in [element.name for element in elements]:
                    return None
                elements.append(_Element(name, int(count)))
            case ["property", "list", count, index, name] if (
                elements and elements[-1].name == "face" and name in LISTS and _whole(count) and _whole(index)
            ):
                elements[-1].fields += [(COUNT, TYPES[count]), (name, TYPES[index], (3,))]
            case ["property", kind, name] if kind in TYPES and elements:
                elements[-1].fields.append((name, TYPES[kind]))
            case _:
                return None
    repeated = any(len({one[0] for one in element.fields}) < len(element.fields) for element in elements)
    empty = any(not element.fields for element in elements)
    if lines[:1] != [["ply"]] or order is None or repeated or empty:
        return None
    return order, elements, end.end()


def _whole(kind: str) -> bool:
    return TYPES.get(kind, "f")[0] in "iu"


def _binary(data: bytes, start: int, order: str, elements: list[_Element]) -> dict[str, np.ndarray] | None:
    """The records of each element; those that come first decide where the next ones begin."""
    import numpy as np

    tables = {}
    for element in elements:
        record = np.dtype([(one[0], order + one[1], *one[2:]) for one in element.fields])
        held = max(0, len(data) - start) // record.itemsize
        table = np.frombuffer(data, record, min(element.count, held), start)
        if element.name == "face" and (table[COUNT] != 3).any():
            return None  # the records have other lengths than these
        if held < element.count:
            raise _cut_off(element, held)
        tables[element.name] = table
        start += table.nbytes
    return tables


def _cut_off(element: _Element, held: int) -> DataError:
    return DataError(
        f'is cut off: it holds {held} of the {element.count} elements "{element.name}" that its header states'
    )


def _ascii(body: bytes, elements: list[_Element]) -> dict[str, np.ndarray] | None:
    """The records of each element, whose numbers stand in a row whatever the lines are."""
    import numpy as np

    try:
        numbers = np.array(body.split(), dtype=np.float64)
    except ValueError:
        return None
    tables = {}
    start = 0
    for element in elements:
        widths = [one[2][0] if len(one) == 3 else 1 for one in element.fields]
        width = sum(widths)
        held = (len(numbers) - start) // width
        count = min(element.count, held)
        rows = numbers[start : start + count * width].reshape(count, width)
        table = np.zeros(count, np.dtype(element.fields))
        at = 0
        with np.errstate(all="ignore"):
            for one, size in zip(element.fields, widths, strict=True):
                column = rows[:, at : at + size]
                table[one[0]] = column if len(one) == 3 else column[:, 0]
                if one[1][0] != "f" and not np.array_equal(table[one[0]].reshape(column.shape), column):
                    return None  # a number that its type does not hold
                at += size
        if element.name == "face" and (table[COUNT] != 3).any():
            return None
        if held < element.count:
            raise _cut_off(element, held)
        tables[element.name] = table
        start += count * width
    return tables
