"""A page without a browser: one scale for two pictures, edges without the lock, pages that go while they come."""

import threading
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from illuminant.image import Image
from illuminant.viewer import view
from illuminant.viewer.composition import MODES, compose
from illuminant.viewer.refinement import Found, Frame, Request
from illuminant.viewer.session import Session
from illuminant.viewer.state import State


@pytest.fixture(scope="module")
def state(repository) -> State:
    return State.of(repository / "scenes" / "cornell.toml")


def frame_of(state: State, luminance: float) -> Frame:
    camera = dict(state.scene.description["camera"]) | {"size": [400, 300]}
    image = Image(np.full((300, 400, 3), luminance))
    return Frame(Request(state, camera, 1, 0.0), image, False, 1, 1.0, 1.0, None, None)


def session_of(**attributes: Any) -> Session:
    """A session with no page, and only what a test needs."""
    made = Session.__new__(Session)
    made.__dict__.update(attributes)
    return made


def test_both_sides_have_the_scale_of_the_right_one_also_when_a_newer_frame_has_come(state):
    left, right, newer = (frame_of(state, luminance) for luminance in (5.0, 50.0, 5000.0))
    session = session_of(
        frame=newer,
        mode=MODES[1],
        map="none",
        divider=0.5,
        composition=compose(newer.image.xyz, state, MODES[1]),
        panels=SimpleNamespace(compare=SimpleNamespace(mean=lambda *_: None)),
    )
    made = session.composed(right, state)
    assert made.scale[1] == pytest.approx(50.0)
    codes = session._beside(left, state, right, made)
    wanted = compose(left.image.xyz, state, MODES[1], scale=made.scale).codes
    assert (codes[:200, :190] == wanted[:200, :190]).all()
    assert (codes[:200, 210:] == made.codes[:200, 210:]).all()


def test_edges_are_found_while_the_page_can_be_used(state, monkeypatch):
    lock = threading.RLock()

    def free() -> bool:
        """Whether another thread gets the lock at once."""
        got: list[bool] = []
        thread = threading.Thread(target=lambda: got.append(lock.acquire(timeout=1.0)) or lock.release())
        thread.start()
        thread.join()
        return got[0]

    monkeypatch.setattr("illuminant.viewer.session.edges", lambda *_: free() and "edges")
    monkeypatch.setattr("illuminant.viewer.session.depth", lambda *_: free() and "depth")
    drawn: list[Any] = []
    lines = SimpleNamespace(remove=drawn.clear)
    session = session_of(
        refiner=SimpleNamespace(found=Found(SimpleNamespace(mesh=lambda: None), state, 1)),
        lock=lock,
        wires="elements",
        _wired=("none", 0),
        _lines=None,
        _depth=None,
        client=SimpleNamespace(
            scene=SimpleNamespace(add_line_segments=lambda _, ends, *a, **b: drawn.append(ends) or lines)
        ),
    )
    frame = frame_of(state, 1.0)
    assert session._wire(frame) == "depth"
    assert drawn == ["edges"]
    assert session._wire(frame) == "depth"
    assert drawn == ["edges"], "they are drawn once"
    session.wires = "none"
    assert session._wire(frame) is None
    assert drawn == []


@pytest.mark.parametrize("leaves", ["before", "during", "stop"])
def test_a_page_that_closes_while_it_opens_leaves_nothing(state, monkeypatch, leaves):
    closed: list[int] = []
    client = SimpleNamespace(client_id=7)
    with view(state.scene, port=0) as viewer:

        class Slow:
            def __init__(self, *_: Any, **__: Any) -> None:
                if leaves == "during":
                    viewer._left(client)
                elif leaves == "stop":
                    viewer.stop()

            def close(self) -> None:
                closed.append(1)

        monkeypatch.setattr("illuminant.viewer.session.Session", Slow)
        if leaves == "before":
            viewer._left(client)
        viewer._opened(client)
        assert closed == [1]
        assert viewer.sessions == {}
        assert viewer._gone == set()
        if leaves != "stop":
            viewer._opened(client)
            assert (closed, list(viewer.sessions)) == (([1], [7]) if leaves == "before" else ([1, 1], []))
