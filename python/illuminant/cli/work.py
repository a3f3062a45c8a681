"""Who does the work of a render, and how a person ends it."""

from __future__ import annotations

import signal
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.checkpoint import Keeper
    from illuminant.image import Image
    from illuminant.job import Job, OnProgress
    from illuminant.scene import Scene
    from illuminant.settings import Settings

__all__ = ["Here", "Stop", "done_by", "work"]


class Stop:
    """Ctrl-C and SIGTERM: before the work they end the program, during it they end the work; a second one the program.

    The request is remembered, since a library that is being imported may swallow the exception.
    """

    def __init__(self) -> None:
        self.requested = False
        self.job: Job | None = None
        self.before: dict[int, Any] = {}

    def _handle(self, number: int, frame: Any) -> None:
        if self.requested or self.job is None:
            self.requested = True
            raise KeyboardInterrupt
        self.requested = True
        self.job.interrupt()

    def watch(self, job: Job) -> Job:
        """From now on a request ends the work of this job."""
        if self.requested:
            raise KeyboardInterrupt
        self.job = job
        return job

    def __enter__(self) -> Stop:
        self.before = {
            number: signal.signal(number, self._handle) for number in (signal.SIGINT, signal.SIGTERM)
        }
        return self

    def __exit__(self, *error: object) -> None:
        for number, handler in self.before.items():
            signal.signal(number, handler)


class Here:
    """Does the work of a job in this process."""

    def solve_by(self, scene: Scene, settings: Settings) -> Any:
        """Solve for the light between surfaces; None leaves it to the job."""
        return None

    def follow(self, job: Job, progress: OnProgress | None, keeper: Keeper | None) -> None:
        """Do it to its end."""
        for _ in job.passes(progress, keeper):
            pass


done_by: ContextVar[Here] = ContextVar("done_by", default=Here())  # noqa: B039 - it holds nothing that changes
"""Who does the work of a job: this process, or the farm."""


def work(job: Job, keeper: Keeper | None) -> Image:
    """Render until the settings, or a request to stop, end it."""
    from illuminant.cli.report import progress_bar

    with progress_bar(Path(job.source).name) as bar:
        done_by.get().follow(job, bar, keeper)
        return job.image()
