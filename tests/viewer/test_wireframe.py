"""Edges of a solution, and how far the picture is away."""

import numpy as np
import pytest

from illuminant import radiosity
from illuminant.scene import load
from illuminant.viewer.wireframe import BEHIND, depth, edges


@pytest.fixture(scope="module")
def mesh(repository):
    scene = load(repository / "scenes" / "cornell.toml")
    options = {"elements": 200, "patches": 30, "sampling": "uniform:4", "form_factors": "rays:16"}
    return radiosity.solve(scene, technique="radiosity", light_samples=4, **options).mesh()


def test_every_edge_is_there_once(mesh):
    found = edges(mesh, "elements")
    assert found.shape[1:] == (2, 3)
    ends = {tuple(sorted(map(tuple, np.round(pair, 5).tolist()))) for pair in found}
    assert len(ends) == len(found)
    corners = np.round(mesh.positions[mesh.faces], 5).astype(np.float32)
    sides = {
        tuple(sorted(map(tuple, np.round(face[[i, (i + 1) % 3]], 5).tolist())))
        for face in corners
        for i in range(3)
    }
    assert ends == sides


def test_patches_have_fewer_edges_than_elements(mesh):
    assert 0 < len(edges(mesh, "patches")) < len(edges(mesh, "elements"))


def test_a_wall_across_the_view_is_equally_deep_everywhere(repository):
    scene = load(repository / "scenes" / "cornell.toml")
    own = scene.description["camera"]
    eye, target = np.array(own["eye"]), np.array(own["target"])
    found = depth(scene, dict(own) | {"size": [64, 64]})
    # The back wall of the box, seen above the blocks: its middle and its sides are as deep.
    row = found[20, 20:44]
    assert np.ptp(row) < 0.01 * row.mean()
    assert row.mean() > BEHIND * 0.5 * np.linalg.norm(target - eye)
