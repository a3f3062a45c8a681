"""One input through one reader, and what counts as a finding.

Example:
    >>> from fuzz.execution import Target, execute
    >>> def first(data: bytes) -> None:
    ...     data[0]
    >>> target = Target("first", first, ())
    >>> execute(target, b"") .kind, execute(target, b"a")
    ('IndexError', None)
"""

from __future__ import annotations

import time
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass

from illuminant.errors import Error

__all__ = ["MOST_SECONDS", "Finding", "Target", "execute", "strict"]

MOST_SECONDS = 5.0
"""Longer is a finding."""


@dataclass(frozen=True)
class Target:
    """A reader under test.

    Attributes:
        name: of its folder in `corpus`.
        run: reads the bytes; may raise `Error` and the `allowed`.
        modules: whose lines are counted, and which the engine instruments.
        text: whether inputs are text, which is changed by words and numbers.
        words: that the format knows.
        allowed: exceptions that keep the promise of a part of the core, which knows no `Error`.
        longest: bytes of the longest input.
        wanted: executions in the long run.
        guided: whether coverage of the modules says anything; not where the core does all the work.
        most_seconds: of the processor; more is a finding.
    """

    name: str
    run: Callable[[bytes], object]
    modules: tuple[str, ...]
    text: bool = False
    words: tuple[str, ...] = ()
    allowed: tuple[type[BaseException], ...] = ()
    longest: int = 10_000
    wanted: int = 500_000
    guided: bool = True
    most_seconds: float = MOST_SECONDS


@dataclass(frozen=True)
class Finding:
    """A broken promise.

    Attributes:
        kind: name of the exception, or `slow`.
        place: innermost line of this project that it passed.
        text: what it says.
        data: the input.
    """

    kind: str
    place: str
    text: str
    data: bytes

    def __str__(self) -> str:
        """Kind, place and text in one line."""
        return f"{self.kind} at {self.place}: {self.text}"


def execute(target: Target, data: bytes) -> Finding | None:
    """One input; None when the reader keeps its promise."""
    begin = time.process_time()  # others may keep the machine busy
    try:
        target.run(data)
    except KeyboardInterrupt:
        raise
    except Error as error:
        if not str(error).strip():
            return Finding("silent", _place(error), "an error without a sentence", data)
    except target.allowed:
        pass
    except BaseException as error:  # a panic is no Exception
        return Finding(type(error).__name__, _place(error), " ".join(str(error).split())[:200], data)
    seconds = time.process_time() - begin
    if seconds > target.most_seconds:
        return Finding("slow", target.name, f"{seconds:.1f} s", data)
    return None


def strict() -> None:
    """Make every warning an exception, and so a finding: a reader that warns has met numbers it did not expect."""
    warnings.simplefilter("error")
    for harmless in (ResourceWarning, DeprecationWarning):
        warnings.simplefilter("ignore", harmless)


def _place(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if "/illuminant/" in frame.filename] or frames
    last = ours[-1]
    return f"{'/'.join(last.filename.rsplit('/', 2)[-2:])}:{last.lineno}"
