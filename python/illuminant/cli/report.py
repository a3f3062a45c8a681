"""What the verbs say: sentences and closing lines on stderr, JSON on stdout, a progress bar on a terminal."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from illuminant.job import Progress

__all__ = ["closing", "emit_json", "note", "progress_bar", "sentence", "warning"]

_COLORS = {"Error": "31", "Warning": "33", "Interrupted": "33"}


def sentence(kind: str, text: str) -> None:
    """Write `kind: text` to stderr, the kind coloured on a terminal; every line of a longer text bears the kind."""
    import os

    from illuminant.errors import printable

    color = sys.stderr.isatty() and "NO_COLOR" not in os.environ
    head = f"\x1b[1;{_COLORS.get(kind, '0')}m{kind}:\x1b[0m" if color else f"{kind}:"
    for line in text.split("\n"):
        print(f"{head} {printable(line)}", file=sys.stderr)


def warning(text: str) -> None:
    """Write a warning to stderr."""
    sentence("Warning", text)


def note(text: str) -> None:
    """Write a line to stderr that is neither a warning nor an error."""
    print(text, file=sys.stderr)


def emit_json(data: Any) -> None:
    """Write one JSON value to stdout; numbers that JSON does not know become null."""
    print(json.dumps(_plain(data), indent=2, ensure_ascii=False))


def _plain(value: Any) -> Any:
    """The value in the types of JSON."""
    import math
    from pathlib import Path

    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def closing(facts: dict[str, Any]) -> str:
    """The closing line of a render: file, seconds, rates, memory, spectral error, dropped samples.

    Args:
        facts: as `illuminant render --json` prints them.
    """
    from illuminant.machine import size

    parts = [
        f"{facts['seconds']:.1f} s" if facts["seconds"] < 600 else _time(facts["seconds"]),
        f"{facts['samples_per_pixel']:.4g} samples per pixel",
        f"{facts['msamples_per_second']:.3g} Msamples/s",
        f"{facts['mrays_per_second']:.3g} Mrays/s",
        size(facts["peak_memory"]),
    ]
    error = facts.get("spectral_error")
    if error and not error["judged"]:
        parts.append("spectral ΔE00 not judged: no light, or only dispersed light")
    elif error:
        mean, largest = (value if value >= 0.001 else 0.0 for value in (error["mean"], error["max"]))
        parts.append(f"spectral ΔE00 {mean:.2g} (max {largest:.2g})")
    parts.append(f"{facts['dropped']} dropped")
    return f"{', '.join(str(file) for file in facts['files'])}: {', '.join(parts)}"


def _time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}" if hours else f"{minutes}:{rest:02d}"


@contextmanager
def progress_bar(name: str) -> Iterator[Callable[[Progress], object] | None]:
    """A bar on stderr with samples, rate and time left; None when stderr is no terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn
    from rich.progress import Progress as Bar

    bar = Bar(
        TextColumn("{task.description}"),
        BarColumn(bar_width=None),
        TextColumn("{task.fields[text]}"),
        console=Console(stderr=True),
        expand=True,
        transient=True,
    )
    with bar:
        task = bar.add_task(name, total=None, text="")

        def update(progress: Progress) -> None:
            parts = [
                f"{progress.samples:.0f} per pixel",
                f"{progress.msamples_per_second:.2f} Msamples/s",
            ]
            if progress.seconds_left is not None:
                parts.append(f"{_time(progress.seconds_left)} left")
            else:
                parts.append(_time(progress.seconds))
            if progress.fraction is not None:
                parts.insert(0, f"{100 * progress.fraction:.0f} %")
            bar.update(
                task,
                total=1.0 if progress.fraction is not None else None,
                completed=progress.fraction or 0.0,
                text="  ".join(parts),
            )

        yield update
