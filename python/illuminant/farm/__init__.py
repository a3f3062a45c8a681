"""Rendering on many machines: shares of the work go to the workers of a Ray cluster, and come as parts of the film.

A share is a range of samples of the pixels of some tiles. Its part of the film is exact, so parts are joined in any
order, and the image has the bits of one that was rendered here. What a worker was doing when it died is done again by
another; nothing else is. Shares are sized by the rate so far, to take about two seconds each, and no more of them are
under way than twice the workers, so that the memory for results stays bounded whatever the image.

Example:
    >>> from illuminant import farm
    >>> image = farm.render("scenes/cornell.toml", samples=256)              # doctest: +SKIP
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from illuminant.farm.cluster import cluster
from illuminant.farm.tasks import Brought, Work, rows, share

if TYPE_CHECKING:
    from illuminant.checkpoint import Checkpoint, Keeper
    from illuminant.image import Image
    from illuminant.job import Job, OnProgress
    from illuminant.scene import Scene
    from illuminant.settings import Settings

__all__ = ["Report", "cluster", "render", "render_job", "solve"]

STEP = 64
"""Samples of a pixel that are shared out before the next ones."""

SECONDS = 2.0
"""How long a share shall take."""

FIRST = 50_000.0
"""Samples of a share while the rate of workers is not known."""


@dataclass
class Report:
    """How the work went.

    Attributes:
        shares: how many came back.
        workers: processes that did them.
        seconds: since the first was sent.
        busy: seconds that workers spent on shares, and of these on preparing the render (`prepared`).
        merging: seconds spent here on joining parts, and their `bytes`.
    """

    shares: int = 0
    workers: set[int] = field(default_factory=set)
    seconds: float = 0.0
    busy: float = 0.0
    prepared: float = 0.0
    merging: float = 0.0
    bytes: int = 0

    def add(self, brought: Brought) -> None:
        """Count a share that came back."""
        self.shares += 1
        self.bytes += len(brought.part)
        self.workers.add(brought.process)
        self.busy += brought.seconds
        self.prepared += brought.prepared

    def to_dict(self) -> dict[str, Any]:
        """The same as plain numbers."""
        return {
            "shares": self.shares,
            "workers": len(self.workers),
            "seconds": self.seconds,
            "busy_seconds": self.busy,
            "preparing_seconds": self.prepared,
            "merging_seconds": self.merging,
            "bytes": self.bytes,
        }


def render(
    scene: Scene | str | os.PathLike[str],
    *,
    workers: int | None = None,
    address: str | None = None,
    threads: int = 1,
    progress: OnProgress | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    every: str | float = 60.0,
    resume: bool = False,
    **options: Any,
) -> Image:
    """Render a scene on the workers of a cluster; the image has the bits of `illuminant.render`.

    Args:
        scene: a `Scene`, or the path of a scene file.
        workers: of a cluster that is started here and stopped at the end; default as many as there are processors for.
        address: of a cluster that runs already, instead: `auto`, `host:6379` or `ray://host:10001`.
        threads: of each worker, which takes as many processors. Each has the scene in its memory, so few workers with
            many threads take less than many with one.
        progress: called after each part with a `Progress`; returning False ends the render with what is done.
        checkpoint, every, resume: as for `illuminant.render`.
        options: as for `illuminant.render`.

    Returns:
        The image; its statistics hold a `farm` with the numbers of `Report`.

    Raises:
        MachineError: Ray is not there, or the cluster cannot be reached or is lost.
        RenderInterrupted: Ctrl-C; its attribute `image` holds what was done.

    Example:
        >>> image = render("scenes/cornell.toml", samples=64, workers=2)      # doctest: +SKIP
        >>> image.statistics["farm"]["shares"]                               # doctest: +SKIP
        12
    """
    from illuminant.checkpoint import resumed
    from illuminant.job import Job, held
    from illuminant.rendering import RenderInterrupted, keeper_of, log_warnings

    keeper = keeper_of(checkpoint, every)
    before: Checkpoint | None = None if checkpoint is None else resumed(checkpoint, resume=resume)
    with cluster(workers, address, threads) as ray:
        job = Job(
            scene,
            checkpoint=before,
            solve_by=lambda scene, settings: solve(ray, scene, settings, threads=threads),
            keeper=keeper,
            **options,
        )
        log_warnings(job)
        report = render_job(ray, job, threads=threads, progress=progress, keeper=keeper)
    image = job.image()
    image.statistics["farm"] = report.to_dict()
    if job.interrupted:
        raise RenderInterrupted(f"The render was interrupted; {held(image)}.", image)
    return image


def render_job(
    ray: Any,
    job: Job,
    *,
    threads: int = 1,
    progress: OnProgress | None = None,
    keeper: Keeper | None = None,
) -> Report:
    """Do the work of a job on a cluster that is connected; the job then holds the image.

    Args:
        ray: what `cluster` yields.
        job: with an empty film, or one that goes on from a checkpoint.
        threads: of each worker.
        progress: as for `render`.
        keeper: writes checkpoints of what has been joined.

    Raises:
        UsageError: no machine of the cluster has so many processors.
        MachineError: the cluster is lost, or a share failed on its worker; the checkpoint has what was joined before.
    """
    from illuminant.farm.dispatch import dispatched, lanes

    report, sizes = Report(), _Sizes(job, lanes(ray, threads))
    work = _work(ray, job, threads)
    left: dict[int, int] = {}
    job.begin()
    began = time.monotonic()

    def settle(end: int) -> None:
        left[end] -= 1
        # Ranges end in order; a later one may have all of its shares before.
        while left and not next(iter(left.values())):
            job.done = next(iter(left))
            del left[job.done]

    def calls() -> Iterator[tuple[_Share, tuple[Any, ...]] | None]:
        for start, end in _ranges(job):
            left[end] = 1  # until all of its shares are sent
            for one in sizes.shares(start, end):
                left[end] += 1
                yield one, (work, one.samples, one.tiles, one.from_lamps)
            settle(end)
            if not _is_known(job):
                yield None  # what is done decides on the next range

    try:
        for done, brought in dispatched(
            ray, share, calls(), threads=threads, over=lambda: job.interrupted or job.stopped
        ):
            start = time.perf_counter()
            job.join(brought.part)
            report.merging += time.perf_counter() - start
            report.add(brought)
            sizes.learn(done, brought)
            settle(done.end)
            if progress is not None and progress(job.progress_at(sizes.samples)) is False:
                job.stopped = True
            if keeper is not None and keeper.due():
                job.keep(keeper)
    except KeyboardInterrupt:
        job.interrupted = True
    finally:
        # Where the cluster is lost, what it has brought is not.
        job.keep(keeper)
    report.seconds = time.monotonic() - began
    return report


def solve(ray: Any, scene: Scene, settings: Settings, *, threads: int = 1) -> Any:
    """Solve for the light between surfaces for `radiosity`: workers find the rows of form factors.

    Other techniques find them together with the light of lamps, and are left to this process.

    Args:
        ray: what `cluster` yields.
        scene: the scene.
        settings: of the render.
        threads: of each worker.

    Returns:
        The core's solution; the one that it finds itself, to the bit. None for other techniques.

    Raises:
        UsageError, MachineError: as for `render_job`.
    """
    if settings.technique != "radiosity":
        return None
    from illuminant.core import core, embree
    from illuminant.farm.dispatch import dispatched, lanes
    from illuminant.form_factor_rows import joined, solution_of

    embree()
    told = replace(settings, threads=threads).to_core()
    finder = core().RowFinder(scene.core(settings.threads), told)
    count, width = len(finder), finder.width
    del finder
    work = Work(f"{scene.hash()} {told}", told, threads, [ray.put(scene.to_bytes())])
    step = max(16, count // (8 * lanes(ray, threads)))
    calls = ((first, (work, first, min(first + step, count))) for first in range(0, count, step))
    found = [result for _, result in dispatched(ray, rows, calls, threads=threads)]
    return solution_of(scene, settings, joined(found), width)


def _work(ray: Any, job: Job, threads: int) -> Work:
    """The render for the workers: what is large goes into the store of the cluster."""
    settings = replace(job.settings, threads=threads).to_core()
    references = [ray.put(job.scene.to_bytes())]
    solution = job.solution_bytes()
    if solution:
        references.append(ray.put(solution))
    key = hashlib.sha256(json.dumps([job.identity(), settings], sort_keys=True).encode()).hexdigest()
    return Work(key, settings, threads, references)


def _is_known(job: Job) -> bool:
    """Whether it is known from the start which samples are taken: neither time nor error decide."""
    settings = job.settings
    return settings.time is None and settings.error is None


def _ranges(job: Job) -> Iterator[tuple[int, int]]:
    """First and last of the ranges of samples: known from the start, or each found when the one before is done."""
    if _is_known(job):
        for first in range(job.done, job.settings.samples or 0, STEP):
            yield first, min(first + STEP, job.settings.samples or 0)
        return
    while (end := job.next_end()) > job.done:
        job.under_way = end
        yield job.done, end


@dataclass(frozen=True)
class _Share:
    samples: tuple[int, int]
    tiles: tuple[int, int]
    from_lamps: bool
    end: int
    pixels: int

    @property
    def size(self) -> int:
        """Samples over all its pixels."""
        return self.pixels * (self.samples[1] - self.samples[0])


class _Sizes:
    """How large shares are: small ones until the rate of workers is known, then such that they take `SECONDS`."""

    def __init__(self, job: Job, lanes: int) -> None:
        areas = job.core_render.tiles()
        self._pixels = [(right - left) * (bottom - top) for left, top, right, bottom in areas]
        self._all = sum(self._pixels)
        self._caustics = job.settings.caustics
        # What a checkpoint brought is not done again.
        self._seen, self._from_lamps = job.core_render.seen()
        self._size = max(1.0, min(FIRST, self._all / (4 * lanes)))
        self._rates: list[float] = []
        held = (sum(end - start for start, end in seen) for seen in self._seen)
        self._taken = sum(pixels * count for pixels, count in zip(self._pixels, held, strict=True))

    @property
    def samples(self) -> float:
        """Samples of a pixel, mean over the image."""
        return float(self._taken / self._all)

    def learn(self, done: _Share, brought: Brought) -> None:
        """Take note of how long a share took."""
        if not done.from_lamps:
            self._taken += done.size
        worked = max(brought.seconds - brought.prepared, 1e-4)
        self._rates = [*self._rates[-15:], done.size / worked]
        # The slower ones of the last rates: no share shall take much too long.
        self._size = SECONDS * sorted(self._rates)[len(self._rates) // 4]

    def shares(self, first: int, end: int) -> Iterator[_Share]:
        """What is missing of a range of samples, as shares."""
        wanted = [_missing(seen, first, end) for seen in self._seen]
        start = 0
        while start < len(wanted):
            ranges, tiles, pixels = wanted[start], start, 0
            count = sum(last - at for at, last in ranges)
            while (
                tiles < len(wanted)
                and wanted[tiles] == ranges
                and (not pixels or not count or pixels * count < self._size)
            ):
                pixels += self._pixels[tiles]
                tiles += 1
            for at, last in ranges:
                yield from self._cut(at, last, end, (start, tiles), pixels, from_lamps=False)
            start = tiles
        if self._caustics:
            for at, last in _missing(self._from_lamps, first, end):
                yield from self._cut(at, last, end, (0, 0), self._all, from_lamps=True)

    def _cut(
        self, at: int, last: int, end: int, tiles: tuple[int, int], pixels: int, *, from_lamps: bool
    ) -> Iterator[_Share]:
        """The samples of some tiles, cut where they are still too many."""
        while at < last:
            until = min(last, at + max(1, int(self._size / pixels)))
            yield _Share((at, until), tiles, from_lamps, end, pixels)
            at = until


def _missing(seen: list[tuple[int, int]], first: int, end: int) -> list[tuple[int, int]]:
    """What of a range is in none of some ranges, which stand in order.

    Example:
        >>> _missing([(0, 4), (6, 8)], 2, 10)
        [(4, 6), (8, 10)]
    """
    found = []
    for start, stop in seen:
        if start > first and first < end:
            found.append((first, min(start, end)))
        first = max(first, stop)
    return [*found, (first, end)] if first < end else found
