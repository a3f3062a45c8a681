"""What runs on the workers of a farm.

A worker keeps the last render that it was given work for, with its scene and all that was prepared, so that the next
task of the same render begins at once. The scene comes by way of the cluster's object store, once to each node, and is
fetched only by a worker that does not have it.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from typing import Any

from illuminant.form_factor_rows import Rows

__all__ = ["Brought", "Work", "rows", "share"]


@dataclass(frozen=True)
class Work:
    """A render, for workers.

    Attributes:
        key: equal for renders whose samples may be joined.
        settings: the core's (JSON).
        threads: of a worker.
        references: in a list, so that they are fetched only where they are needed: the scene, and the solution if
            there is one.
    """

    key: str
    settings: str
    threads: int
    references: list[Any]


@dataclass(frozen=True)
class Brought:
    """What a task brought.

    Attributes:
        part: of the film (`Render.part`).
        seconds: of the work itself, and of preparing the render where the worker did not have it.
        prepared: seconds of the latter.
        process: number of the worker's process.
    """

    part: bytes
    seconds: float
    prepared: float
    process: int


_kept: dict[str, Any] = {}


def _render(work: Work) -> Any:
    """The core's render, as this worker has it or makes it now."""
    if work.key not in _kept:
        import ray

        from illuminant.core import core, embree
        from illuminant.scene import Scene

        _kept.clear()  # before the next one, so that there is room for it
        embree()
        scene, *solution = ray.get(work.references)
        core_scene = Scene.from_bytes(scene).core(work.threads)
        solved = None
        if solution:
            from illuminant.radiosity import Solution

            solved = Solution.from_bytes(solution[0]).core_solution
        _kept[work.key] = core().Render(core_scene, work.settings, solved)
    return _kept[work.key]


def share(work: Work, samples: tuple[int, int], tiles: tuple[int, int] | None, from_lamps: bool) -> Brought:
    """Take a range of samples of the pixels of some tiles; without tiles, of all.

    Args:
        work: which render.
        samples: first and last.
        tiles: first and last, by number.
        from_lamps: whether the paths from lamps of these samples are followed.
    """
    began = time.perf_counter()
    render = _render(work)
    prepared = time.perf_counter() - began
    render.clear()
    render.run(*samples, tiles=tiles, from_lamps=from_lamps)
    part = render.part()
    return Brought(part, time.perf_counter() - began, prepared, os.getpid())


def rows(work: Work, first: int, last: int) -> Rows:
    """Find rows of form factors of `radiosity`.

    Args:
        work: which scene and settings.
        first: number of the first row.
        last: number of the row after the last.
    """
    key = f"rows of {work.key}"
    if key not in _kept:
        import ray

        from illuminant.core import core, embree
        from illuminant.scene import Scene

        _kept.clear()
        embree()
        (scene,) = ray.get(work.references)
        _kept[key] = core().RowFinder(Scene.from_bytes(scene).core(work.threads), work.settings)
    return Rows(first, *_kept[key].find(first, last))
