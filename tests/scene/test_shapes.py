"""Built-in shapes and transforms: areas, fronts, and the algebra of placing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant import placement, shapes
from illuminant.errors import DataError

coordinates = st.floats(-10, 10).map(lambda x: round(x, 6))
vectors = st.tuples(coordinates, coordinates, coordinates)
positive = st.floats(0.01, 10)
angles = st.floats(-720, 720)
axes = st.one_of(st.sampled_from("xyz"), vectors.filter(lambda v: np.linalg.norm(v) > 0.1))


def areas(mesh):
    """The vector areas of all faces."""
    corners = mesh.positions[mesh.indices]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2


@given(vectors, positive, positive, positive)
def test_a_box_is_closed_and_faces_outwards(low, x, y, z):
    mesh = shapes.box(low, np.add(low, [x, y, z])).checked()
    assert np.allclose(areas(mesh).sum(axis=0), 0, atol=1e-9)
    middles = mesh.positions[mesh.indices].mean(axis=1) - (np.array(low) + np.array([x, y, z]) / 2)
    assert (np.einsum("fi,fi->f", areas(mesh), middles) > 0).all()
    assert np.isclose(np.linalg.norm(areas(mesh), axis=1).sum(), 2 * (x * y + y * z + z * x))


@given(vectors, vectors.filter(lambda v: np.linalg.norm(v) > 0.1), positive)
def test_a_disc_has_its_area_and_its_front(center, normal, radius):
    mesh = shapes.disc(center, normal, radius).checked()
    total = areas(mesh).sum(axis=0)
    assert np.allclose(total, np.pi * radius**2 * np.array(normal) / np.linalg.norm(normal), rtol=1e-9)


def test_a_rectangle_faces_along_first_times_second_edge():
    mesh = shapes.rectangle([1, 2, 3], [[0, 0, 1], [2, 0, 0]])
    assert np.allclose(areas(mesh).sum(axis=0), [0, 2, 0])
    assert mesh.uvs.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.mark.parametrize(
    ("corners", "says"),
    [
        ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]], "not in one plane"),
        ([[0, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0]], "convex face in order"),
        ([[0, 0, 0], [1, 0, 0], [0.1, 0.1, 0], [0, 1, 0]], "convex face in order"),
        ([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]], "enclose no area"),
    ],
)
def test_corners_that_are_no_face(corners, says):
    with pytest.raises(DataError, match=says):
        shapes.quadrilateral(corners)


def test_smooth_normals_of_a_cube_point_to_its_corners():
    mesh = shapes.box([-1, -1, -1], [1, 1, 1]).smoothed()
    assert np.allclose(mesh.normals, mesh.positions / np.sqrt(3))


def test_quadrilaterals_and_triangles_may_be_mixed():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 2, 0]]
    mesh = shapes.mesh_from_arrays(points, [[0, 1, 2, 3], [3, 2, 4]])
    assert mesh.indices.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 4]]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (([[0, 0]], [[0, 0, 0]]), "positions must be rows of 3 numbers"),
        ((["a"], [[0, 0, 0]]), "positions must be rows of 3 numbers"),
        ((np.eye(3), [[0, 1]]), "three or four vertex numbers"),
        ((np.eye(3), [[0, 1, 1.5]]), "three or four vertex numbers"),
        ((np.eye(3), 3), "three or four vertex numbers"),
        ((np.eye(3), [[0, 1, 2]], np.eye(2)), "normals must be rows of 3 numbers"),
        ((np.eye(3), [[0, 1, 2]], np.zeros((3, 3))), "normal 0 has no length"),
        ((np.eye(3), [[0, 1, 2]], None, np.zeros((2, 2))), "uvs has 2 rows where positions has 3"),
    ],
)
def test_arrays_that_are_no_mesh(arguments, says):
    with pytest.raises(DataError, match=says):
        shapes.mesh_from_arrays(*arguments)


# --- placing ----------------------------------------------------------------------------------------------------


@given(axes, angles, vectors)
def test_a_rotation_keeps_lengths_and_handedness(axis, degrees, vector):
    matrix = placement.rotation(axis, degrees)
    assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    assert np.isclose(np.linalg.det(matrix), 1)
    assert np.allclose(placement.rotation(axis, -degrees) @ matrix @ vector, vector, atol=1e-9)


def test_rotations_are_right_handed_and_quarters_exact():
    assert placement.rotation("z", 90).tolist() == [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    assert (placement.rotation("y", 450) @ [0, 0, 1]).tolist() == [1, 0, 0]


@given(positive, axes, angles, vectors, vectors)
def test_points_are_scaled_then_turned_then_shifted(scale, axis, degrees, shift, point):
    matrix = placement.transform(scale, [(axis, degrees)], shift, unit_m=0.01)
    expected = placement.rotation(axis, degrees) @ (scale * np.array(point)) + 0.01 * np.array(shift)
    assert np.allclose(matrix[:, :3] @ point + matrix[:, 3], expected, atol=1e-9)
    assert np.isclose(placement.even_scale(matrix[:, :3]), scale)
    assert np.allclose(placement.transform(matrix=matrix.tolist()), matrix)


def test_uneven_scales_are_noticed():
    assert placement.even_scale(placement.transform([1, 2, 1])[:, :3]) is None
    assert placement.even_scale(placement.transform([-1, 1, 1])[:, :3]) == 1.0


@pytest.mark.parametrize(
    "arguments",
    [
        {"scale": [1, 0, 1]},
        {"matrix": [[1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]]},
        {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]},
        {"rotate": [([0, 0, 0], 3)]},
    ],
)
def test_transforms_that_are_refused(arguments):
    with pytest.raises(DataError):
        placement.transform(**arguments)


@given(vectors)
def test_turning_up_and_back(vector):
    there = placement.turn_up("y", "z")
    assert np.allclose(placement.turn_up("z", "y") @ there @ vector, vector)
    assert (there @ [0, 1, 0]).tolist() == [0, 0, 1]
