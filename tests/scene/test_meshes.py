"""Meshes from files: what is kept, what is converted, and what is refused."""

import gzip

import numpy as np
import pytest

from illuminant import meshes
from illuminant.errors import DataError
from illuminant.scene import Scene

OBJ = """\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 2
f 1/1/1 2/2/1 3/3/1 4/4/1
"""
PLY = """\
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0
3 0 1 2
3 0 2 3
"""


@pytest.fixture(scope="module")
def trimesh():
    return pytest.importorskip("trimesh")


def read(folder, name, content, **options):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return meshes.read(path, **options)


def test_obj_keeps_normals_and_texture_coordinates(tmp_path):
    mesh = read(tmp_path, "a.obj", OBJ)
    assert mesh.positions.shape == (4, 3)
    assert mesh.indices.shape == (2, 3)
    assert np.allclose(mesh.normals, [0, 0, 1])
    order = np.lexsort(mesh.positions.T)
    assert np.allclose(mesh.uvs[order], mesh.positions[order, :2])


def test_obj_material_files_are_not_needed(tmp_path):
    assert len(read(tmp_path, "a.obj", "mtllib none.mtl\nusemtl none\n" + OBJ).indices) == 2


def test_ply_and_its_compressed_form(tmp_path):
    plain, packed = read(tmp_path, "a.ply", PLY), read(tmp_path, "a.ply.gz", gzip.compress(PLY.encode()))
    assert plain.normals is None
    assert plain.uvs is None
    assert np.array_equal(plain.positions, packed.positions)
    assert np.array_equal(plain.indices, [[0, 1, 2], [0, 2, 3]])


def test_stl(tmp_path, trimesh):
    mesh = read(tmp_path, "a.stl", trimesh.creation.box().export(file_type="stl"))
    assert mesh.indices.shape == (12, 3)
    assert len(np.unique(mesh.smoothed().normals.round(6), axis=0)) == 8  # the corners are found again


def test_glb_parts_are_joined_under_their_transforms(tmp_path, trimesh):
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box(), transform=np.diag([2.0, 1.0, 1.0, 1.0]))
    scene.add_geometry(
        trimesh.creation.box(), transform=trimesh.transformations.translation_matrix([10, 0, 0])
    )
    scene.add_geometry(trimesh.creation.box(), transform=np.diag([-1.0, 1.0, 1.0, 1.0]))
    mesh = read(tmp_path, "a.glb", scene.export(file_type="glb"))
    assert mesh.indices.shape == (36, 3)
    assert mesh.positions.min(axis=0).tolist() == [-1.0, -0.5, -0.5]
    assert mesh.positions.max(axis=0).tolist() == [10.5, 0.5, 0.5]
    corners = mesh.positions[mesh.indices]
    volume = np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    assert np.isclose(volume, 4.0)  # the mirrored part too faces outwards


def test_units_and_axes_of_files(tmp_path, trimesh):
    box = trimesh.creation.box(extents=[1, 2, 3])
    (tmp_path / "a.glb").write_bytes(trimesh.Scene(box).export(file_type="glb"))
    (tmp_path / "a.stl").write_bytes(box.export(file_type="stl"))

    def extent(mesh, **frame):
        scene = Scene.build(
            camera={"eye": [1, 1, 1], "target": [0, 0, 0]},
            materials={"lamp": {"kind": "emitter", "spectrum": "E", "power_w": 1}},
            objects={"a": {"material": "lamp", "mesh": mesh}},
            directory=tmp_path,
            **frame,
        )
        positions = scene.arrays["shape:0:positions"]
        return (positions.max(axis=0) - positions.min(axis=0)).astype(float).round(6).tolist()

    assert extent("a.glb", length_unit="mm", up="y") == [1.0, 2.0, 3.0]  # GLB is in metres, y up
    assert extent("a.glb", length_unit="mm", up="z") == [1.0, 3.0, 2.0]
    assert extent("a.stl", length_unit="mm", up="z") == [0.001, 0.002, 0.003]  # STL follows the scene
    assert extent({"file": "a.stl", "unit": "in", "up": "z"}) == [0.0254, 0.0762, 0.0508]
    assert extent({"file": "a.glb", "unit": "cm", "up": "z"}, up="z") == [0.01, 0.02, 0.03]


def test_zero_area_faces_are_refused_or_removed_on_request(tmp_path):
    text = PLY.replace("face 2", "face 4") + "3 0 0 1\n3 1 1 2\n"
    with pytest.raises(DataError, match="2 faces without area, first face 2 with vertices"):
        read(tmp_path, "a.ply", text)
    assert len(read(tmp_path, "a.ply", text, zero_area="remove").indices) == 2


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.ply", "hello", "cannot be read as PLY"),
        ("a.obj", "", "is an empty file"),
        ("a.obj", "hello", "the mesh is empty"),
        ("a.stl", "hello", "the mesh is empty"),
        ("a.glb", b"glTF nothing of the kind", "cannot be read as GLB"),
        ("a.gltf", "{", "cannot be read as GLTF"),
        ("a.gltf", "{}", "the mesh is empty"),
        ("a.ply", PLY[:-8], 'is cut off: it holds 1 of the 2 elements "face" that its header states'),
        ("a.ply", PLY[:-12], 'is cut off: it holds 0 of the 2 elements "face" that its header states'),
        ("a.ply", PLY.replace("3 0 2 3", "3 0 2 9"), "out of range 0 to 3, first face 1: [0, 2, 9]"),
        ("a.ply", PLY.replace("3 0 2 3", "3 0 2 -1"), "vertex"),
        ("a.obj", OBJ.replace("4/4/1", "9/4/1"), "refers to a vertex that the file does not hold"),
        ("a.ply", PLY.replace("1 1 0", "1 nan 0"), "1 vertex has a position that is not a finite number"),
        ("a.ply", PLY.replace("1 1 0", "1 1e300 0"), "not a finite number"),
        ("a.ply.gz", PLY, "is not compressed by gzip"),
        ("a.ply.gz", gzip.compress(PLY.encode())[:-20], "is not compressed by gzip, or is damaged"),
        ("a.txt", PLY, "is not a mesh file that can be read"),
    ],
)
def test_files_that_are_refused(name, content, says, tmp_path):
    with pytest.raises(DataError) as caught:
        read(tmp_path, name, content)
    assert says in str(caught.value)
    assert str(tmp_path / name) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_files_that_are_not_there(tmp_path):
    with pytest.raises(DataError, match="there is no such file"):
        meshes.read(tmp_path / "none.obj")
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(DataError, match="is a folder"):
        meshes.read(tmp_path / "folder.obj")
