"""The refiner without a page: frames come in order, what is asked for later wins, solutions are relit."""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from illuminant import radiosity
from illuminant.viewer.refinement import Frame, Refiner
from illuminant.viewer.state import State

SIZE = [80, 50]


@contextmanager
def refiner() -> Iterator[tuple[Refiner, list[Frame], list[str]]]:
    """A refiner, its frames, and its sentences about what went wrong."""
    frames: list[Frame] = []
    wrong: list[str] = []
    made = Refiner(frames.append, lambda text, bad: wrong.append(text) if bad else None)
    yield made, frames, wrong
    made.close()


def until(holds: Callable[[], Any], seconds: float = 180.0) -> None:
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.01)


def camera(state: State) -> dict[str, Any]:
    return dict(state.scene.description["camera"]) | {"size": SIZE}


@pytest.fixture(scope="module")
def cornell(repository) -> State:
    return State.of(repository / "scenes" / "cornell.toml", elements=200)


def test_a_small_picture_comes_before_the_whole_and_later_requests_win(cornell):
    with refiner() as (made, frames, wrong):
        first = made.ask(cornell, camera(cornell))
        until(lambda: any(not frame.preview for frame in frames))
        second = made.ask(cornell, camera(cornell))
        until(lambda: any(frame.request.number == second for frame in frames))
        numbers = [frame.request.number for frame in frames]
    assert frames[0].preview
    assert numbers == sorted(numbers)
    assert first < second
    assert wrong == []


def test_a_moved_camera_keeps_the_wavelengths_and_another_lamp_does_not(cornell):
    moved = camera(cornell) | {"eye": [0.278, 0.273, -0.6]}
    lamp = cornell.tables["materials"]["lamp"] | {"spectrum": "FL7"}
    previews: dict[int, str] = {}
    fitted: dict[int, np.ndarray] = {}

    def deliver(frame: Frame) -> None:  # on the refiner's thread, between two passes
        if frame.preview:
            previews[frame.request.number] = frame.image.settings["sampling"]
        elif made._kept is not None:
            fitted[frame.request.number] = np.asarray(made._kept[1].core_render.wavelengths())

    made = Refiner(deliver, lambda text, bad: None)
    for number, state in enumerate((cornell, cornell, cornell.with_tables(materials={"lamp": lamp})), 1):
        made.ask(state, camera(state) if number == 1 else moved)
        until(lambda number=number: number in fitted)
    made.close()
    assert np.array_equal(fitted[1], fitted[2])
    assert not np.array_equal(fitted[2], fitted[3])
    assert [previews[number] == cornell.sampling for number in (1, 2, 3)] == [False, True, False]


def test_a_solution_found_elsewhere_is_relit(cornell):
    state = replace(cornell, technique="radiosity")
    options = {"elements": 200, "sampling": state.sampling, "form_factors": "rays:16", "light_samples": 4}
    found = radiosity.solve(state.scene, technique="radiosity", **options)
    lamp = state.tables["materials"]["lamp"] | {"spectrum": "FL7"}
    with refiner() as (made, frames, wrong):
        made.adopt(found, state)
        made.ask(state, camera(state))
        until(lambda: any(not frame.preview for frame in frames))
        made.ask(state.with_tables(materials={"lamp": lamp}), camera(state))
        until(lambda: made.relit_seconds is not None and frames[-1].request.number == 2)
        assert made.solved == 1
    before, after = frames[0].image.xyz.mean((0, 1)), frames[-1].image.xyz.mean((0, 1))
    assert after[2] / after[0] > 1.3 * before[2] / before[0]
    assert wrong == []


def test_maps_of_illuminance_become_finer_until_something_else_is_asked_for(cornell):
    with refiner() as (made, frames, wrong):
        made.ask(cornell, camera(cornell), illuminance=True)

        def mapped() -> list[tuple[int, ...]]:
            return [frame.illuminance.shape for frame in frames if frame.illuminance is not None]

        until(lambda: len(mapped()) >= 2)
        assert mapped() == [(25, 40), (50, 80)]
        assert all(frame.preview for frame in frames), "the whole picture is not rendered meanwhile"
        large = camera(cornell) | {"size": [1280, 800]}
        made.ask(cornell, large, illuminance=True)
        until(lambda: len(mapped()) >= 3)
        second = made.ask(cornell, camera(cornell))
        until(lambda: any(frame.request.number == second and not frame.preview for frame in frames))
        assert len(mapped()) < 6, "a map that is wanted no more is not finished"
        assert wrong == []
        made.ask(replace(cornell, technique="gouraud"), camera(cornell), illuminance=True)
        until(lambda: wrong)
        assert wrong[0].startswith("gouraud has no map of illuminance")


def test_first_pictures_disperse_nothing_and_differ_in_nothing_else(repository):
    state = State.of(repository / "scenes" / "demo.toml")
    with refiner() as (made, _, _):
        plain = made._undispersed(state)
        assert made._undispersed(state) is plain
    bending = [one for one in plain.description["materials"] if one["surface"]["kind"] == "dielectric"]
    assert bending
    assert not any(one["surface"]["dispersion"] for one in bending)
    other = [one for one in plain.description["materials"] if one["surface"]["kind"] != "dielectric"]
    assert [one["name"] for one in other] == [
        one["name"] for one in state.scene.description["materials"] if one["surface"]["kind"] != "dielectric"
    ]
    assert np.array_equal(plain.description["camera"]["eye"], state.scene.description["camera"]["eye"])


def test_a_closed_refiner_keeps_nothing(cornell):
    import gc
    import weakref

    with refiner() as (made, frames, _):
        made.ask(cornell, camera(cornell))
        until(lambda: any(not frame.preview for frame in frames))
        job = weakref.ref(made._kept[1])
        gc.disable()
    frames.clear()
    try:
        until(lambda: job() is None, 30.0)
    finally:
        gc.enable()


def test_a_solution_that_nobody_waits_for_is_cancelled(cornell):
    """A long one gives way to one of fewer elements, and ends with its page."""
    long = replace(cornell, technique="radiosity", elements=60_000)
    short = replace(long, elements=300)
    with refiner() as (made, _, wrong):
        made.ask(long, camera(long))
        until(lambda: made._solving is long)
        made.ask(short, camera(short))
        until(lambda: made.solution_for(short) is not None)
        assert made.solved == 1, "the long one came to its end"
        made.ask(long, camera(long))
        until(lambda: made._solving is long)
        solving = next(one for one in threading.enumerate() if one.name == "illuminant solver")
    solving.join(30.0)
    assert not solving.is_alive()
    assert wrong == []


class Relit:
    """Stands for a solution; `meanwhile` is called while it is relit."""

    def __init__(self, meanwhile: Callable[[], Any] = lambda: None) -> None:
        self.meanwhile = meanwhile

    def of(self, _: Any) -> "Relit":
        """As of a solution."""
        self.meanwhile()
        return Relit()


def test_a_solution_found_while_another_is_relit_keeps_its_state(cornell):
    state = replace(cornell, technique="radiosity")
    lamp = state.tables["materials"]["lamp"] | {"spectrum": "FL7"}
    other = state.with_tables(materials={"lamp": lamp})
    finer = replace(state, elements=400)
    with refiner() as (made, _, _):
        newer = Relit()
        made.adopt(Relit(lambda: made.adopt(newer, finer)), state)
        relit = made._at_hand(other)
        assert relit is not None and relit is not newer
        assert (made.found.solution, made.found.state, made.found.number) == (newer, finer, 2)
        assert made.solution_for(finer) is newer
        assert made.solution_for(other) is None and made.solution_for(state) is None


def test_a_closed_refiner_begins_no_solution(cornell):
    state = replace(cornell, technique="radiosity")
    with refiner() as (made, _, _):
        made.close()
        made._solve(state)
        made.adopt(Relit(), state)
        assert made._solving is None
        assert made.found is None
