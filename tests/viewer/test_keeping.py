"""What is kept can be read again: files outside the folder, and the first frame of an animation."""

import shlex
import tomllib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from illuminant.errors import SceneError
from illuminant.scene import load
from illuminant.viewer import keeping
from illuminant.viewer.state import State
from illuminant.viewer.tables import relit

SCENE = """\
[camera]
eye = [0.0, 1.0, 4.0]
target = [0.0, 0.6, 0.0]
size = [32, 24]

[materials.paint]
kind = "diffuse"
reflectance = { file = "paint.csv" }

[objects.ball]
sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }
material = "paint"

[lights.sky]
kind = "environment"
spectrum = "D65"
"""
STILL = "luminance_cd_m2 = 100.0\n"
MOVES = """
[animation]
frames = [10, 20]
frames_per_second = 10

[animation.keys."lights.sky.luminance_cd_m2"]
times = [0.0, 2.0]
values = [100.0, 300.0]
"""


def session_of(path: Path, folder: Path, *, allow_outside: bool = False) -> Any:
    """A session with no page."""
    folder.mkdir(exist_ok=True)
    state = State.of(path, allow_outside=allow_outside)
    camera = dict(state.scene.description["camera"])
    return SimpleNamespace(
        state=state,
        start=state,
        folder=folder,
        frame=None,
        camera=lambda: camera,
        allow_outside=allow_outside,
    )


@pytest.fixture
def room(tmp_path) -> Path:
    inside = tmp_path / "in"
    inside.mkdir()
    (inside / "paint.csv").write_text("400,0.5\n500,0.4\n700,0.6\n")
    path = inside / "room.toml"
    path.write_text(SCENE + STILL)
    return path


def test_a_scene_kept_in_another_folder_says_that_its_files_lie_outside(room, tmp_path):
    session = session_of(room, tmp_path / "out")
    words = shlex.split(keeping.command(session))
    kept = Path(words[2])
    assert tomllib.loads(kept.read_text())["materials"]["paint"]["reflectance"]["file"] == "../in/paint.csv"
    with pytest.raises(SceneError, match="--allow-outside"):
        load(kept)
    assert "--allow-outside" in words
    assert load(kept, allow_outside=True).hash() == session.state.scene.hash()
    assert keeping.names_outside(session, kept.parent)


def test_a_scene_kept_in_its_own_folder_needs_nothing_unless_it_needed_it_before(room):
    session = session_of(room, room.parent)
    words = shlex.split(keeping.command(session))
    assert "--allow-outside" not in words
    assert load(words[2]).hash() == session.state.scene.hash()
    assert "--allow-outside" in keeping.command(session_of(room, room.parent, allow_outside=True))


def test_the_first_frame_of_an_animation_is_changed_and_kept(room):
    room.write_text(SCENE + MOVES)
    session = session_of(room, room.parent)
    sky = session.state.tables["lights"]["sky"]
    assert sky["luminance_cd_m2"] == pytest.approx(200.0)
    assert "animation" not in session.state.tables
    kept = keeping.scene(session)[0]
    assert "animation" not in tomllib.loads(kept.read_text())
    assert load(kept).hash() == session.state.scene.hash()

    session.state = session.state.with_tables(lights={"sky": relit(sky | {"spectrum": "A"}, 2.0)})
    kept = keeping.scene(session)[0]
    found = tomllib.loads(kept.read_text())["lights"]["sky"]
    assert (found["spectrum"], found["luminance_cd_m2"]) == ("A", pytest.approx(400.0))
    assert load(kept).hash() == session.state.scene.hash()
