"""`illuminant farm`: the work of a render on many machines."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from illuminant.cli import render as rendering

if TYPE_CHECKING:
    from illuminant.checkpoint import Keeper
    from illuminant.job import Job, OnProgress

__all__ = ["app", "render"]

app = typer.Typer(no_args_is_help=True)

Workers = Annotated[
    int | None,
    typer.Option(
        "--workers", metavar="N", help="Workers of a cluster that is started here (one a processor)."
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
    typer.Option("--threads", metavar="N", help="Threads of each worker, which has the scene to itself (1)."),
]


def render(*, workers: int | None, address: str | None, threads: int, **options: Any) -> None:
    """Render a scene on the workers of a Ray cluster, to the bits that `illuminant render` makes.

    Without --address a cluster is started on this machine for the time of the render. A worker that dies costs
    what it was just doing. All other options are those of `illuminant render`.

    \\b
    Examples:
      illuminant farm render room.toml -o room.exr --samples 4096
      illuminant farm render room.toml --address ray://head:10001 --threads 8 --checkpoint room.ckpt --resume
    """

    def follow(job: Job, progress: OnProgress | None, keeper: Keeper | None) -> None:
        from illuminant.cli.report import note
        from illuminant.farm import cluster, render_job

        with cluster(workers, address) as ray:
            report = render_job(ray, job, threads=threads, progress=progress, keeper=keeper)
        note(
            f"farm: {report.shares} shares by {len(report.workers)} workers, busy for {report.busy:.1f} s of "
            f"{report.seconds:.1f} s each; {report.bytes / 1e6:.1f} MB came back"
        )

    token = rendering.followed_by.set(follow)
    try:
        rendering.render(**options)
    finally:
        rendering.followed_by.reset(token)


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

    \\b
    Example:
      illuminant farm render room.toml -o room.exr --workers 2
    """
