"""A picture that becomes right while the camera rests.

One thread for each page renders what was asked for last. At first a picture of few pixels, in wavelengths that need no
fitting, so that it is there in a fifth of a second; then the whole picture, pass after pass. Whatever is asked for
meanwhile ends the work at the next tile. Nothing here knows of browsers: frames are handed to `deliver`, sentences to
`say`.

In that first picture nothing disperses: materials that bend each wavelength by its own are prepared for hundreds of
wavelengths, which takes longer than the picture.

What is expensive is kept: the wavelengths, while only the camera changes; the solution of radiosity, which is relit or
repainted (`Solution.of`) where that is enough.
"""

from __future__ import annotations

import threading
import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from illuminant.errors import Error, UsageError
from illuminant.job import Job
from illuminant.settings import SOLVED
from illuminant.viewer import heap
from illuminant.viewer.camera import limited
from illuminant.viewer.illuminance import maps, obstacle

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.image import Image
    from illuminant.radiosity import Solution
    from illuminant.scene import Scene
    from illuminant.viewer.state import State

__all__ = ["Found", "Frame", "Refiner", "Request"]

PREVIEW_SECONDS = 0.08
PREVIEW_SAMPLING = "uniform:8"
FIRST_RATE = 0.15
"""Millions of samples a second, by which the very first picture has its size; later ones go by how fast that was."""
MOST_SAMPLES = 4096
ERROR = 0.002
"""Relative standard error at which a picture is good."""
REST_S = 5.0
"""After so long without work memory is given back."""
GATHERED_SAMPLES = 16
"""Samples of a view of a solution, which shows no noise but at edges."""


@dataclass(frozen=True)
class Request:
    """What shall be shown.

    Attributes:
        state: what is chosen.
        camera: of the page, as `Scene.description["camera"]`; its size is that of the whole picture.
        number: later requests have larger ones.
        asked: when, by `time.perf_counter`.
        illuminance: whether a map of illuminance is wanted in place of the whole picture.
    """

    state: State
    camera: Mapping[str, Any]
    number: int
    asked: float
    illuminance: bool = False


@dataclass(frozen=True)
class Frame:
    """A picture on its way to the page.

    Attributes:
        request: what it answers.
        image: in absolute XYZ.
        preview: whether it is smaller than the whole.
        samples: of each pixel.
        seconds: since it was asked for.
        mrays: millions of rays a second.
        left: seconds until `MOST_SAMPLES`, if that can be told.
        error: relative standard error of luminance, a mean over the picture; None where it is not estimated.
        illuminance: map of it, lx (h, w), nan where there is none; its grid is another than that of the image.
    """

    request: Request
    image: Image
    preview: bool
    samples: int
    seconds: float
    mrays: float
    left: float | None
    error: float | None
    illuminance: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class Found:
    """A solution of radiosity at hand.

    Attributes:
        solution: of the state.
        state: what it was found or relit for.
        number: of the elements; solutions that were relit keep it.
    """

    solution: Solution
    state: State
    number: int


class Refiner:
    """The thread that renders for one page.

    Args:
        deliver: takes each frame, on the refiner's thread.
        say: takes a sentence on what is being done or what went wrong, and whether it is an error.
    """

    def __init__(self, deliver: Callable[[Frame], object], say: Callable[[str, bool], object]) -> None:
        self._deliver, self._say = deliver, say
        self._wanted: Request | None = None
        self._number = 0
        self._closed = False
        self._condition = threading.Condition()
        self._rate = FIRST_RATE
        self._kept: tuple[State, Job] | None = None
        self._bending: tuple[Scene, Scene] | None = None
        self._found: Found | None = None
        """Swapped as a whole under the condition, for two threads write it and several read it."""
        self.solved = 0
        """How many solutions were found anew, not relit; each has elements of its own."""
        self._solving: State | None = None
        self._cancel: Any = None
        self._latest: Request | None = None
        self.relit_seconds: float | None = None
        self._thread = threading.Thread(target=self._loop, name="illuminant refiner", daemon=True)
        heap.large_blocks_apart()
        self._thread.start()

    def ask(self, state: State, camera: Mapping[str, Any], *, illuminance: bool = False) -> int:
        """Show this instead of whatever is being rendered; the number of the request."""
        with self._condition:
            self._number += 1
            self._wanted = Request(state, camera, self._number, clock.perf_counter(), illuminance)
            self._condition.notify()
            return self._number

    @property
    def found(self) -> Found | None:
        """The solution at hand with its state and its number, which belong together."""
        return self._found

    @property
    def solution(self) -> Solution | None:
        """The solution at hand, of whatever state."""
        found = self._found
        return None if found is None else found.solution

    def solution_for(self, state: State) -> Solution | None:
        """The solution at hand, if it is that of a state."""
        found = self._found
        return found.solution if found is not None and _same(found.state, state, "elements") else None

    def adopt(self, solution: Solution, state: State) -> None:
        """Take over a solution that was found elsewhere for a state."""
        with self._condition:
            self._keep(solution, state)

    def _keep(self, solution: Solution, state: State) -> None:
        """Have a solution with elements of its own at hand; the caller holds the condition."""
        if not self._closed:
            self.solved += 1
            self._found = Found(solution, state, self.solved)

    def close(self) -> None:
        """End the work and the thread."""
        with self._condition:
            self._closed = True
            if self._cancel is not None:
                self._cancel.cancel()
            self._condition.notify()
        if threading.current_thread() is not self._thread:
            self._thread.join(timeout=10.0)
        # Pages and refiners know each other, so Python would free them late, and it knows nothing of the core's memory.
        self._deliver, self._say = _nothing, _nothing
        with self._condition:
            self._kept = self._bending = self._latest = self._wanted = self._found = None
        heap.give_back()

    def _current(self, request: Request) -> bool:
        return not self._closed and request.number == self._number

    def _loop(self) -> None:
        while True:
            with self._condition:
                while self._wanted is None and not self._closed:
                    if not self._condition.wait(REST_S):
                        heap.give_back()
                if self._closed:
                    return
                request, self._wanted = self._wanted, None
                self._latest = request
            assert request is not None
            try:
                self._follow(request)
            except Error as error:
                self._say(str(error), True)
            except Exception as error:  # the page shall show it, and the next request shall be served
                self._say(f"{type(error).__name__}: {error}", True)

    def _follow(self, request: Request) -> None:
        """Render what is asked for until it is good, or until something else is asked for."""
        preview = self._preview(request)
        if not self._current(request):
            return
        heap.give_back()
        if request.illuminance and preview is not None:
            self._map(request, preview)
            return
        job = self._job(request)
        if job is None or not self._current(request):
            return
        for samples in job.passes(lambda _: self._current(request)):
            if not self._current(request):
                return
            self._deliver(self._frame(request, job, samples, preview=False))
        if self._current(request):
            self._say("", False)

    # --- the picture of few pixels -------------------------------------------------------------------------------

    def _map(self, request: Request, preview: Frame) -> None:
        """Deliver maps of illuminance, finer and finer, with the small picture."""
        state = request.state
        if reason := obstacle(state):
            self._say(reason, True)
            return
        solution = self._ready(state) if state.technique in SOLVED else None
        if state.technique in SOLVED and (solution is None or not self._current(request)):
            return
        for lux in maps(state, request.camera, solution, lambda: self._current(request)):
            self._deliver(replace(preview, illuminance=lux))

    def _preview(self, request: Request) -> Frame | None:
        state = request.state
        width, height = request.camera["size"]
        size = limited(width, height, max(1000, int(self._rate * 1e6 * PREVIEW_SECONDS)))
        kept = self._like(request)
        solution = self._at_hand(state) if state.technique in SOLVED else None
        known = state.technique not in SOLVED or solution is not None
        camera = dict(request.camera) | {"size": list(size)}
        options: dict[str, Any] = {"technique": state.technique, "illumination": state.illumination}
        if not known:
            options = {"technique": "path", "illumination": "general"}
        job = Job(
            self._undispersed(state).replace(camera=camera),
            **options,
            sampling=state.sampling if kept else PREVIEW_SAMPLING,
            samples=1,
            like=kept,
            solution=None if solution is None else solution._core,
        )
        start, found = clock.perf_counter(), None
        for samples in job.passes(lambda _: self._current(request)):
            self._rate = size[0] * size[1] / max(clock.perf_counter() - start, 1e-4) / 1e6
            found = self._frame(request, job, samples, preview=True)
            self._deliver(found)
        return found

    def _undispersed(self, state: State) -> Scene:
        """The scene with glass that bends all wavelengths alike."""
        if self._bending is None or self._bending[0] is not state.scene:
            tables = {
                name: dict(table) | {"dispersion": False}
                for name, table in state.tables.get("materials", {}).items()
                if table.get("kind") == "dielectric" and isinstance(table.get("medium"), str)
            }
            plain = state.scene.replace(materials=tables) if tables else state.scene
            self._bending = state.scene, plain
        return self._bending[1]

    # --- the whole picture ---------------------------------------------------------------------------------------

    def _job(self, request: Request) -> Job | None:
        state = request.state
        samples = MOST_SAMPLES
        solution = None
        if state.technique in SOLVED:
            solution = self._ready(state)
            if solution is None or not self._current(request):
                return None
            samples = GATHERED_SAMPLES if state.technique != "hybrid" else MOST_SAMPLES
        job = Job(
            state.scene.replace(camera=request.camera),
            technique=state.technique,
            illumination=state.illumination,
            sampling=state.sampling,
            samples=samples,
            error=ERROR if state.technique in ("path", "distributed", "hybrid") else None,
            like=self._like(request),
            solution=None if solution is None else solution._core,
        )
        self._kept = (state, job)
        return job

    def _like(self, request: Request) -> Job | None:
        """A job whose wavelengths serve."""
        kept = self._kept
        return kept[1] if kept is not None and _same(kept[0], request.state) else None

    # --- the solution --------------------------------------------------------------------------------------------

    def _ready(self, state: State) -> Solution | None:
        """The solution of a state, relit or repainted if that does; without one it is solved for meanwhile."""
        solution = self._at_hand(state)
        if solution is None:
            self._solve(state)
        return solution

    def _at_hand(self, state: State) -> Solution | None:
        """The solution at hand, made one of a state with other lamps or paints where that is possible."""
        before = self._found
        if before is None:
            return None
        if _same(before.state, state, "elements"):
            return before.solution
        if not _same(replace(before.state, scene=state.scene), state, "elements"):
            return None
        start = clock.perf_counter()
        try:
            solution = before.solution.of(state.scene)
        except UsageError:
            return None  # more has changed than can be relit
        with self._condition:
            # One that was found meanwhile is newer, and stays.
            if self._found is before and not self._closed:
                self._found = Found(solution, state, before.number)
        self.relit_seconds = clock.perf_counter() - start
        return solution

    def _solve(self, state: State) -> None:
        """Solve for a state on a thread of its own, so that the camera can move on."""
        from illuminant.core import core

        with self._condition:
            # A request that waits may have a solution by now, and else begins what it needs.
            if self._closed or self._wanted is not None:
                return
            solving = self._solving
            if solving is not None:
                if not _same(replace(solving, scene=state.scene), state, "elements"):
                    # What it finds could not be relit for this state, which begins when it has ended.
                    self._cancel.cancel()
                return
        self._say(f"Solving for the light between about {state.elements} elements …", False)
        with self._condition:
            if self._closed:
                return
            self._solving, self._cancel = state, core().Cancel()
            threading.Thread(
                target=self._solver, args=(state, self._cancel), name="illuminant solver", daemon=True
            ).start()

    def _solver(self, state: State, cancel: Any) -> None:
        from illuminant import radiosity
        from illuminant.core import core

        options: dict[str, Any] = (
            {} if state.technique == "specular-radiosity" else {"elements": state.elements}
        )
        try:
            found = radiosity.solve(
                state.scene,
                technique=state.technique,
                illumination=state.illumination,
                sampling=state.sampling,
                cancel=cancel,
                **options,
            )
        except core().Cancelled:
            self._solved_or_not(None, state)
            return
        except Exception as error:
            self._say(str(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}", True)
            self._solved_or_not(None, state)
            return
        self._solved_or_not(found, state)

    def _solved_or_not(self, found: Solution | None, state: State) -> None:
        """Keep a solution, and let the latest request go on if it waits for one; it may be of another state by now."""
        with self._condition:
            self._solving = None
            if self._closed:
                return
            if found is not None:
                self._keep(found, state)
            latest = self._latest
            if latest is None or self._wanted is not None or latest.state.technique not in SOLVED:
                return
            if found is not None or latest.state is not state:
                self._number += 1
                self._wanted = replace(latest, number=self._number)
                self._condition.notify()

    # --- frames --------------------------------------------------------------------------------------------------

    def _frame(self, request: Request, job: Job, samples: int, *, preview: bool) -> Frame:
        image = job.image()
        seconds = max(float(image.statistics["seconds"]), 1e-6)
        limit = job.settings.samples or MOST_SAMPLES
        return Frame(
            request,
            image,
            preview,
            samples,
            seconds=clock.perf_counter() - request.asked,
            mrays=float(image.statistics["rays"]) / seconds / 1e6,
            left=None if preview else seconds * (limit / samples - 1.0),
            error=None if preview or samples < 4 or job.settings.error is None else _error(job),
        )


def _nothing(*_: object) -> None:
    """What a closed refiner delivers and says."""


def _error(job: Job) -> float:
    """Root mean square of the pixels' standard errors of luminance, relative to the mean of the picture."""
    import numpy as np

    mean = float(job.core_render.layer("xyz")[..., 1].mean())
    return float(np.sqrt(np.mean(np.square(job.core_render.standard_error())))) / mean if mean > 0 else 0.0


def _same(a: State, b: State, *more: str) -> bool:
    """Whether two states have the same scene and are rendered alike."""
    words = ("technique", "illumination", "sampling", *more)
    return a.scene is b.scene and all(getattr(a, word) == getattr(b, word) for word in words)
