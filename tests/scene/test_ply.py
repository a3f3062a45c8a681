"""Plain PLY files: read as trimesh reads them, without trimesh; all others are left to it."""

import gzip
import subprocess
import sys

import numpy as np
import pytest

from illuminant import meshes, ply
from illuminant.errors import DataError

POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.25]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def file(form="binary_little_endian", real="float", index="int", count="uchar", extra=(), texture="st"):
    """A PLY file of a square with normals, texture coordinates and a colour, which is not read."""
    order = {"binary_big_endian": ">"}.get(form, "<")
    kinds = {name: order + code for name, code in ply.TYPES.items()}
    names = ["x", "y", "z", "nx", "ny", "nz", *texture]
    vertex = np.zeros(4, [("red", "u1"), *((name, kinds[real]) for name in names)])
    for i, name in enumerate("xyz"):
        vertex[name] = POSITIONS[:, i]
    vertex["nz"] = 2.0
    for i, name in enumerate(texture):
        vertex[name] = POSITIONS[:, i] / 2
    face = np.zeros(2, [("count", kinds[count]), ("indices", kinds[index], 3), ("flags", order + "i2")])
    face["count"], face["indices"] = 3, FACES
    lines = ["ply", f"format {form} 1.0", "comment a square", "element vertex 4", "property uchar red"]
    lines += [f"property {real} {name}" for name in names]
    lines += ["element face 2", f"property list {count} {index} vertex_indices", "property short flags"]
    head = "\n".join([*lines, *extra, "end_header\n"]).encode()
    if form != "ascii":
        return head + vertex.tobytes() + face.tobytes()
    rows = [list(row) for row in vertex] + [[row[0], *row[1], row[2]] for row in face]
    return head + "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()


@pytest.mark.parametrize(
    ("form", "real", "index", "count", "texture"),
    [
        ("binary_little_endian", "float", "int", "uchar", "st"),
        ("binary_little_endian", "double", "uint", "int", "uv"),
        ("binary_big_endian", "float32", "int32", "uint8", "st"),
        ("ascii", "float", "ushort", "uchar", "uv"),
    ],
)
def test_every_plain_form(form, real, index, count, texture):
    mesh = ply.read(file(form, real, index, count, texture=texture))
    assert np.array_equal(mesh.positions, POSITIONS)
    assert np.array_equal(mesh.indices, FACES)
    assert np.array_equal(mesh.normals, np.tile([0.0, 0.0, 2.0], (4, 1)))
    assert np.array_equal(mesh.uvs, POSITIONS[:, :2] / 2)


def test_lines_may_end_as_on_windows():
    assert np.array_equal(ply.read(file("ascii").replace(b"\n", b"\r\n")).indices, FACES)


def test_the_meshes_that_ship_are_plain_and_as_trimesh_reads_them(scenes):
    paths = sorted(scenes.glob("meshes/*.ply.gz"))
    assert len(paths) >= 4
    for path in paths:
        [expected] = meshes._parts_by_trimesh(gzip.decompress(path.read_bytes()), "ply", path.parent)
        mesh = meshes.read(path)
        assert np.array_equal(mesh.positions, expected.positions), path
        assert np.array_equal(mesh.indices, expected.indices), path


def test_normals_are_made_unit_length(tmp_path):
    path = tmp_path / "a.ply"
    path.write_bytes(file())
    assert np.array_equal(meshes.read(path).normals, np.tile([0.0, 0.0, 1.0], (4, 1)))


def test_reading_a_plain_file_does_not_import_trimesh(scenes):
    statement = f"""
import sys
from illuminant import meshes
meshes.read({str(scenes / "meshes" / "bunny.ply.gz")!r})
sys.exit("trimesh" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", statement], check=False).returncode == 0


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"ply",
        b"ply\nend_header\n",
        file().replace(b"binary_little", b"binary_middle"),
        file().replace(b"comment", b"remark"),
        file().replace(b"vertex_indices", b"corners"),
        file().replace(b"property list uchar int", b"property list uchar float"),
        file().replace(b"property float x", b"property quad x"),
        file().replace(b"float nx", b"float x"),
        file().replace(b"float y", b"float w"),
        file().replace(b"element face", b"element side"),
        file(extra=["property list uchar float weights"]),
        file(extra=["element material 0"]),
        file("ascii").replace(b"\n3 ", b"\n4 "),
        file("ascii").replace(b"\n3 0 1 2", b"\n3 0 1 2.5"),
        file("ascii").replace(b"\n3 0 1 2", b"\n3 0 1 two"),
        file(count="char").replace(b"\x03\0\0\0\0\1", b"\x04\0\0\0\0\1"),
    ],
)
def test_all_else_is_left_to_trimesh(content):
    assert ply.read(content) is None


def test_quadrilaterals_are_read_by_trimesh(tmp_path):
    path = tmp_path / "a.ply"
    lines = ["ply", "format ascii 1.0", "element vertex 4", *(f"property float {axis}" for axis in "xyz")]
    lines += ["element face 1", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, row)) for row in POSITIONS] + ["4 0 1 2 3"]
    path.write_text("\n".join(lines))
    assert meshes.read(path).indices.shape == (2, 3)


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian"])
def test_a_file_that_is_cut_off_is_refused_wherever_it_ends(form):
    whole = file(form)
    body = whole.index(b"end_header\n") + len(b"end_header\n")
    for end in range(body, len(whole) - 3):
        try:
            mesh = ply.read(whole[:end])
        except DataError as error:
            assert "is cut off: it holds" in str(error)
        else:
            assert mesh is None


def test_more_elements_than_any_file_holds():
    text = file().replace(b"vertex 4", b"vertex 999999999999")
    with pytest.raises(DataError, match='of the 999999999999 elements "vertex"'):
        ply.read(text)
