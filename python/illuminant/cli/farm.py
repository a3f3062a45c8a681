"""`illuminant farm`: the work of a render on many machines."""

from __future__ import annotations

import inspect
from contextlib import ExitStack
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from illuminant.cli import render as rendering
from illuminant.cli.work import Here, done_by

if TYPE_CHECKING:
    from illuminant.checkpoint import Keeper
    from illuminant.job import Job, OnProgress
    from illuminant.scene import Scene
    from illuminant.settings import Settings

__all__ = ["app", "render"]

app = typer.Typer(no_args_is_help=True)

Workers = Annotated[
    int | None,
    typer.Option(
        "--workers",
        metavar="N",
        help="Workers of a cluster that is started here (as there are processors).",
    ),
]
Address = Annotated[
    str | None,
    typer.Option(
        "--address", metavar="HOST", help="A Ray cluster that runs: auto, host:6379, ray://host:10001."
    ),
]
Threads = Annotated[
    int,
    typer.Option(
        "--threads",
        metavar="N",
        help="Threads of a worker, each with the scene to itself (1).",
        show_default=False,
    ),
]


def render(*, workers: int | None, address: str | None, threads: int, **options: Any) -> None:
    """Render a scene on the workers of a Ray cluster, to the bits that `illuminant render` makes.

    Without --address a cluster is started on this machine for the time of the render. A worker that dies costs
    what it was just doing. All other options are those of `illuminant render`.

    \b
    Examples:
      illuminant farm render room.toml -o room.exr --samples 4096
      illuminant farm render room.toml --address head:6379 --threads 8
    """

    with ExitStack() as stack:
        token = done_by.set(_Farm(stack, workers, address, threads))
        try:
            rendering.render(**options)
        finally:
            done_by.reset(token)


class _Farm(Here):
    """Does the work of a job on a cluster, which is there from when it is first needed: mistakes are found before."""

    def __init__(self, stack: ExitStack, workers: int | None, address: str | None, threads: int) -> None:
        self._stack = stack
        self._asked = (workers, address)
        self._threads = threads
        self._ray: Any = None

    def _cluster(self) -> Any:
        if self._ray is None:
            from illuminant.farm import cluster

            self._ray = self._stack.enter_context(cluster(*self._asked, self._threads))
        return self._ray

    def solve_by(self, scene: Scene, settings: Settings) -> Any:
        """Solve for the light between surfaces."""
        from illuminant.farm import solve

        return solve(self._cluster(), scene, settings, threads=self._threads)

    def follow(self, job: Job, progress: OnProgress | None, keeper: Keeper | None) -> None:
        """Do the work, and say who did it."""
        from illuminant.cli.report import note
        from illuminant.farm import render_job

        report = render_job(self._cluster(), job, threads=self._threads, progress=progress, keeper=keeper)
        note(
            f"farm: {report.shares} shares by {len(report.workers)} workers, busy for {report.busy:.1f} s in all, in "
            f"{report.seconds:.1f} s; {report.bytes / 1e6:.1f} MB came back"
        )


def _signature() -> inspect.Signature:
    """The options of `illuminant render`, and those of the cluster."""
    hints = get_type_hints(rendering.render, include_extras=True)
    usual = inspect.signature(rendering.render).parameters.values()
    kept = [one.replace(annotation=hints[one.name]) for one in usual if one.name != "threads"]
    keyword = inspect.Parameter.KEYWORD_ONLY
    own = [
        inspect.Parameter("workers", keyword, default=None, annotation=Workers),
        inspect.Parameter("address", keyword, default=None, annotation=Address),
        inspect.Parameter("threads", keyword, default=1, annotation=Threads),
    ]
    return inspect.Signature([*kept, *own])


render.__signature__ = _signature()  # type: ignore[attr-defined]
app.command("render", short_help="Render a scene on the workers of a cluster.")(render)


@app.callback()
def _start() -> None:
    """Render on many machines, with Ray.

    \b
    Example:
      illuminant farm render room.toml -o room.exr --workers 2
    """
