"""A small scene for the tests of the command."""

from pathlib import Path

import pytest

SCENE = """\
title = "a ball under a lamp"

[camera]
eye = [0.0, 1.0, 4.0]
target = [0.0, 0.6, 0.0]
size = [32, 24]

[render]
samples = 8

[materials.grey]
kind = "diffuse"
reflectance = 0.5

[materials.lamp]
kind = "emitter"
spectrum = "A"
luminance_cd_m2 = 2000.0

[objects.floor]
rectangle = { corner = [-3.0, 0.0, 3.0], edges = [[6.0, 0.0, 0.0], [0.0, 0.0, -6.0]] }
material = "grey"

[objects.ball]
sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }
material = "grey"

[objects.lamp]
sphere = { center = [1.0, 3.0, 1.0], radius = 0.3 }
material = "lamp"
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """The path of a small scene file, alone in its folder."""
    path = tmp_path / "ball.toml"
    path.write_text(SCENE)
    return path
