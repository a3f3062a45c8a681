"""The vectors at a surface as drawn in the atlas, against the values for the book's own routines."""

import json
from pathlib import Path

import numpy as np
import pytest

from illuminant.atlas.chapter_2.directions import half, half_refracted, reflected, refracted

GOLDEN = json.loads((Path(__file__).parents[1] / "golden" / "geometry.json").read_text())
SETS = {one["function"]: one["cases"] for one in GOLDEN["sets"]}


@pytest.mark.parametrize("case", SETS["geo_rfl"], ids=lambda case: case["id"])
def test_mirror_direction(case):
    given = case["in"]
    found = reflected(np.array(given["V"]), np.array(given["N"]))
    np.testing.assert_allclose(found, case["out"]["R"], atol=1e-12)


@pytest.mark.parametrize("case", SETS["geo_H"], ids=lambda case: case["id"])
def test_half_vector(case):
    if case["out"]["H"] is not None:
        first, second = list(case["in"].values())[:2]
        np.testing.assert_allclose(half(np.array(first), np.array(second)), case["out"]["H"], atol=1e-9)


@pytest.mark.parametrize("ni, nt", [(1.0, 1.5), (1.5, 1.0), (1.0, 1.33)])
@pytest.mark.parametrize("angle_deg", [1.0, 20.0, 40.0])
def test_the_normal_asked_for_refracts_to_where_it_was_asked(ni, nt, angle_deg):
    normal = np.array([0.0, 0.6, 0.8])
    tangent = np.array([1.0, 0.0, 0.0])
    angle = np.radians(angle_deg)
    light = np.cos(angle) * normal + np.sin(angle) * tangent
    through = refracted(light, normal, ni, nt)
    np.testing.assert_allclose(half_refracted(light, through, ni, nt), normal, atol=1e-9)
