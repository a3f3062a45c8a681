"""`illuminant render --frames`: the frames of an animation, but for those that are finished already."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.cli.work import Stop
    from illuminant.frames import Frame
    from illuminant.scene import Scene

__all__ = ["one_frame", "render_frames"]


def render_frames(
    scene: Path,
    wanted: str,
    output: list[Path] | None,
    options: dict[str, Any],
    look: dict[str, Any],
    *,
    again: bool,
    json: bool,
    stop: Stop,
) -> None:
    """Render frames, and say how it went.

    Args:
        scene: the scene file.
        wanted: which frames.
        output: file names with `####` in the place of the number.
        options: of the render.
        look: the arguments `look`, `rgb` and `half` of `Image.save`.
        again: whether finished frames are rendered too.
        json: whether the result goes to stdout as JSON.
        stop: ends the work when a person asks for it.
    """
    from illuminant import frames, machine
    from illuminant.animation import Animation
    from illuminant.cli.outcome import save as save_image
    from illuminant.cli.report import emit_json, note, progress_bar, warning
    from illuminant.cli.work import done_by
    from illuminant.errors import Interrupted

    began = time.monotonic()
    options = dict(options)
    allow_outside, memory_limit = options.pop("allow_outside"), options.pop("memory_limit")
    with machine.limited_to(memory_limit):
        animation = Animation.load(scene, allow_outside=allow_outside)
    worker = done_by.get()
    done: list[dict[str, Any]] = []
    warned: set[str] = set()

    def watch(job: Any) -> None:
        stop.watch(job)
        for text in job.warnings():
            if text not in warned:
                warned.add(text)
                warning(text)

    def save(image: Any, path: Path, chosen: Any, *, exposure: float | None, rgb: Any, half: bool) -> Any:
        return save_image(image, path, look=chosen, exposure=exposure, rgb=rgb, half=half)

    with progress_bar(scene.name) as bar:
        made = frames.render_frames(
            animation,
            wanted,
            [*output] if output else None,
            again=again,
            save=save,
            on_job=watch,
            follow=lambda job, progress: worker.follow(job, progress, None),
            solve_by=worker.solve_by,
            progress=bar,
            memory_limit=memory_limit,
            **look,
            **options,
        )
        try:
            for frame in made:
                facts = _facts(frame, scene, options, allow_outside)
                done.append(facts)
                if not json:
                    note(_line(facts))
                # Its film makes room for that of the next one.
                del frame
                stop.job = None
                if stop.requested:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            there = len(frames.frame_numbers(wanted, animation.first, animation.last))
            raise Interrupted(f"{len(done)} of {there} frames are there. The same command goes on.") from None
        finally:
            if json:
                emit_json(done)
    if not json:
        if look["look"].exposure is None and animation.tables.get("render", {}).get("exposure") is None:
            _say_exposure(done)
        skipped = sum(bool(facts["skipped"]) for facts in done)
        parts = [f"{len(done) - skipped} rendered"] + ([f"{skipped} finished before"] if skipped else [])
        note(f"{len(done)} frame{'' if len(done) == 1 else 's'}: {', '.join(parts)}, {_seconds(began)}")


def one_frame(
    scene: Path, wanted: str, pixel: str, *, allow_outside: bool, memory_limit: str | None = None
) -> Scene:
    """The scene of the frame whose pixel is asked for.

    Raises:
        UsageError: more than one frame is named.
    """
    from illuminant import machine
    from illuminant.animation import Animation
    from illuminant.errors import UsageError
    from illuminant.frames import frame_numbers

    with machine.limited_to(memory_limit):
        animation = Animation.load(scene, allow_outside=allow_outside)
    numbers = frame_numbers(wanted, animation.first, animation.last)
    if len(numbers) > 1:
        raise UsageError(f"--pixel {pixel}: goes with --frames for one frame, not {len(numbers)}.")
    row = pixel.partition(",")[2].strip()
    odd = not row.isdigit() or int(row) % 2 == 0  # rows are counted from 0, lines from 1
    second = animation.fields == ("even-first" if odd else "odd-first")
    with machine.limited_to(memory_limit):
        return animation.still(numbers[0], int(second))


def _seconds(began: float) -> str:
    return f"{time.monotonic() - began:.1f} s"


def _facts(frame: Frame, scene: Path, options: dict[str, Any], allow_outside: bool) -> dict[str, Any]:
    """What is said of a frame: as of a still image, with its number and time."""
    from illuminant.cli import outcome

    facts: dict[str, Any] = {"frame": frame.number, "time_s": frame.time_s, "skipped": frame.skipped}
    if frame.image is None:
        return facts | {"files": list(frame.files)}
    again = f"{outcome.again_command(scene, options, allow_outside)} --frames {frame.number}"
    rest = outcome.facts(frame.jobs[0], frame.image, list(frame.saved), again)
    outcome.say_dropped(rest)
    return facts | rest


def _line(facts: dict[str, Any]) -> str:
    from illuminant.cli.report import closing

    if facts["skipped"]:
        return f"{', '.join(str(file) for file in facts['files'])}: finished before"
    return closing(facts)


def _say_exposure(done: list[dict[str, Any]]) -> None:
    """Say which exposure all pictures were given, if nobody had chosen one."""
    from illuminant.cli.report import note

    exposures = [
        facts["exposure"] for facts in done if facts.get("exposure") and not facts["settings"].get("black")
    ]
    if exposures:
        note(f"All pictures have one exposure; --exposure {exposures[0]:g} repeats it.")
