"""Drawings of geometry: what the projection keeps, and where arcs and circles run."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from illuminant.plots.sketch import Sketch, View, arc, circle, hemisphere_mesh


@pytest.mark.parametrize("azimuth, elevation", [(-60.0, 25.0), (0.0, 0.0), (135.0, 80.0)])
def test_a_view_is_an_orthogonal_projection(azimuth, elevation):
    view = View(azimuth, elevation)
    points = np.random.default_rng(1).normal(size=(20, 3))
    # What the paper and the depth tell together is the length.
    length = (view.paper(points) ** 2).sum(axis=-1) + view.depth(points) ** 2
    np.testing.assert_allclose(length, (points**2).sum(axis=-1))
    assert np.abs(view.paper(view.towards_eye)).max() < 1e-12


def test_an_arc_runs_from_one_direction_to_the_other():
    found = arc([1.0, 2.0, 3.0], [2.0, 0.0, 0.0], [0.0, 0.0, 5.0], 0.5)
    np.testing.assert_allclose(np.linalg.norm(found - [1.0, 2.0, 3.0], axis=1), 0.5)
    np.testing.assert_allclose(found[[0, -1]], [[1.5, 2.0, 3.0], [1.0, 2.0, 3.5]], atol=1e-12)


def test_circles_stand_across_their_normal():
    normal = np.array([1.0, 2.0, -0.5])
    found = circle([0.0, 0.0, 0.0], normal, 2.0)
    np.testing.assert_allclose(found @ normal, 0.0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 2.0)


def test_a_hemisphere_lies_above_its_foot():
    lines = np.concatenate(hemisphere_mesh(1.5, 4, 8))
    np.testing.assert_allclose(np.linalg.norm(lines, axis=1), 1.5)
    assert lines[:, 2].min() > -1e-12


def test_the_frame_holds_all_that_was_drawn():
    axes = Figure().add_subplot()
    sketch = Sketch(axes)
    sketch.arrow([0.0, 0.0], [3.0, 1.0], "L")
    sketch.surface([-2.0, 0.0], [2.0, 0.0], 0.5)
    sketch.frame(0.1)
    assert axes.get_xlim() == pytest.approx((-2.5, 3.5))
    assert axes.get_ylim()[0] < -0.5 and axes.get_ylim()[1] > 1.0
