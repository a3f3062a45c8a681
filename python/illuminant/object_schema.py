"""The tables of an object: its shape, and where it stands.

These models are part of `schema`, which see; lengths are in the file's `length_unit`, angles in degrees.

Example:
    >>> Object.model_validate({"material": "grey", "sphere": {"radius": 0.5}}).sphere.center
    [0.0, 0.0, 0.0]
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from illuminant.table import Corners, Edges, Length, Matrix, Number, Table, Vector, key

__all__ = ["Box", "Disc", "MeshTable", "MeshValue", "Move", "Object", "Rectangle", "Rotation", "Sphere"]

MOST_MOVES = 128
"""Steps of a motion: as many as Embree takes."""


class Sphere(Table):
    """A true sphere, not a mesh. It can be scaled only by the same factor in all directions."""

    center: Vector = key("centre, in length units", "[0.0, 0.5, 0.0]", [0.0, 0.0, 0.0])
    radius: Length = key("radius, in length units", "0.5")


class Rectangle(Table):
    """A flat four-sided face: `corner` with `edges`, or `corners`. Its front is where they run anticlockwise."""

    corner: Vector | None = key("one corner, in length units", "[0.0, 0.0, 0.0]", None)
    edges: Edges | None = key(
        "the two edges from it; the normal is first × second", "[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]", None
    )
    corners: Corners | None = key(
        "four corners in order, in one plane",
        "[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]]",
        None,
    )


class Box(Table):
    """A box along the axes; turn it with `rotate`."""

    min: Vector = key("the corner with the smallest coordinates, in length units", "[-1.0, 0.0, -1.0]")
    max: Vector = key("the corner with the largest coordinates, in length units", "[1.0, 2.0, 1.0]")


class Disc(Table):
    """A flat disc: a regular polygon of 128 sides with the area of the disc."""

    center: Vector = key("centre, in length units", "[0.0, 2.0, 0.0]", [0.0, 0.0, 0.0])
    normal: Vector = key("the direction that its front faces", "[0.0, -1.0, 0.0]")
    radius: Length = key("radius, in length units", "0.3")


class MeshTable(Table):
    """A mesh with what the file does not say of itself; or, instead of `file`, `positions` and `faces`."""

    file: str | None = key(
        "OBJ, PLY, STL, GLB or glTF file, or one of these compressed (.gz), beside the scene file",
        '"meshes/bunny.ply.gz"',
        None,
    )
    unit: Literal["m", "cm", "mm", "in", "ft"] | None = key(
        "length unit of the file; default metres for GLB and glTF, else the scene's `length_unit`",
        '"mm"',
        None,
    )
    up: Literal["y", "z"] | None = key(
        "axis that is up in the file; default y for GLB and glTF, else the scene's `up`", '"z"', None
    )
    zero_area: Literal["error", "remove"] = key(
        "what to do about faces without area: refuse the mesh, or leave them out", '"remove"', "error"
    )
    positions: Any = key(
        "vertices, in length units", "[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]", None
    )
    faces: Any = key(
        "vertex numbers (from 0) of each face, three or four, anticlockwise from its front",
        "[[0, 1, 2]]",
        None,
    )
    normals: Any = key(
        "a normal for each vertex", "[[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]", None
    )
    uvs: Any = key("a texture coordinate for each vertex", "[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]", None)


def _mesh_form(value: Any) -> str | None:
    if isinstance(value, str):
        return "<name>"
    return "<table>" if isinstance(value, (dict, MeshTable)) else None


MeshValue = Annotated[
    Annotated[str, Tag("<name>")] | Annotated[MeshTable, Tag("<table>")],
    Discriminator(
        _mesh_form,
        custom_error_type="mesh_form",
        custom_error_message='must be a mesh: a file name, or a table such as { file = "a.ply", unit = "mm" }',
    ),
]


def _axis_form(value: Any) -> str | None:
    if isinstance(value, str):
        return "<name>"
    return "<vector>" if isinstance(value, list) else None


AxisValue = Annotated[
    Annotated[Literal["x", "y", "z"], Tag("<name>")] | Annotated[Vector, Tag("<vector>")],
    Discriminator(
        _axis_form,
        custom_error_type="axis_form",
        custom_error_message='must be "x", "y", "z" or three numbers',
    ),
]


class Rotation(Table):
    """A turn about an axis through the origin, anticlockwise when the axis points at the viewer."""

    axis: AxisValue = key("the axis", '"y"')
    degrees: Number = key("the angle, in degrees", "30.0")


def _rotate_form(value: Any) -> str | None:
    if isinstance(value, (dict, Rotation)):
        return "<one>"
    return "<several>" if isinstance(value, list) else None


RotateValue = Annotated[
    Annotated[Rotation, Tag("<one>")] | Annotated[list[Rotation], Tag("<several>")],
    Discriminator(
        _rotate_form,
        custom_error_type="rotate_form",
        custom_error_message='must be a rotation such as { axis = "y", degrees = 30.0 }, or a list of them',
    ),
]


def _scale_form(value: Any) -> str | None:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return "<one>"
    return "<several>" if isinstance(value, list) else None


ScaleValue = Annotated[
    Annotated[Number, Tag("<one>")] | Annotated[Vector, Tag("<several>")],
    Discriminator(
        _scale_form,
        custom_error_type="scale_form",
        custom_error_message="must be a number, or three numbers for the three axes",
    ),
]


class Move(Table):
    """Where an object is at a later time: its whole transform, stated as that of the object itself."""

    scale: ScaleValue | None = key("a factor, or one for each axis", "0.01", None)
    rotate: RotateValue | None = key(
        "a rotation, or a list that is done in order", '{ axis = "y", degrees = 40.0 }', None
    )
    translate: Vector | None = key("a shift, in length units", "[0.2, 0.5, 0.0]", None)
    matrix: Matrix | None = key(
        "three or four rows of four numbers, instead of the other three; the last column is in length units",
        "[[1.0, 0.0, 0.0, 0.7], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]",
        None,
    )


class Object(Table):
    """A thing with one material: exactly one of `mesh`, `sphere`, `rectangle`, `box` and `disc`.

    It is scaled, then rotated, then translated; or placed by `matrix`. A mirroring transform keeps the outside out.
    """

    material: str = key("name of one of `[materials]`", '"red paint"')
    mesh: MeshValue | None = key("file of a mesh, or a table", '"meshes/bunny.ply.gz"', None)
    sphere: Sphere | None = key("a sphere", "{ center = [0.0, 0.5, 0.0], radius = 0.5 }", None)
    rectangle: Rectangle | None = key(
        "a flat four-sided face",
        "{ corner = [0.0, 0.0, 0.0], edges = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]] }",
        None,
    )
    box: Box | None = key("a box along the axes", "{ min = [0.0, 0.0, 0.0], max = [1.0, 2.0, 1.0] }", None)
    disc: Disc | None = key(
        "a flat disc", "{ center = [0.0, 2.0, 0.0], normal = [0.0, -1.0, 0.0], radius = 0.3 }", None
    )
    smooth: bool | None = key(
        "shade with vertex normals: those of the file, else made from the faces around each vertex (true), or never "
        "(false); default those of the file if it has them",
        "true",
        None,
    )
    scale: ScaleValue | None = key("a factor, or one for each axis", "0.01", None)
    rotate: RotateValue | None = key(
        "a rotation, or a list that is done in order", '{ axis = "y", degrees = 30.0 }', None
    )
    translate: Vector | None = key("a shift, in length units", "[0.0, 0.5, 0.0]", None)
    matrix: Matrix | None = key(
        "three or four rows of four numbers, instead of the other three; the last column is in length units",
        "[[1.0, 0.0, 0.0, 0.5], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]",
        None,
    )
    motion: Annotated[list[Move], Field(max_length=MOST_MOVES)] | None = key(
        "where the object is later, at even distances of time, the last at the end; between them it goes straight on",
        "[{ translate = [0.2, 0.5, 0.0] }]",
        None,
    )
