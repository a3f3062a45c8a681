"""Checkpoints of a render: a file from which it goes on after a crash, a full disk or a power cut, to the same bits.

A checkpoint holds what the film holds (exact sums, so that it does not matter where the work was cut), how many
samples are complete, the time that was spent, the solution of the light between surfaces where there is one (or, while
it is being solved for, the rows of form factors that have been found), and the identity of the render: scene, settings,
versions. One of another identity is refused with each difference named.

The file: a line with the form, the length of a header in 8 bytes (little-endian), the header (JSON), the blocks that it
names, and the SHA-256 digest of all before it. It is written beside the old one, flushed to the disk and then renamed
(`illuminant.output`), so that at every moment there is a whole checkpoint: the new one or the one before.

Example:
    >>> import tempfile, pathlib
    >>> file = pathlib.Path(tempfile.mkdtemp(), "room.ckpt")
    >>> Checkpoint({"seed": 0}, done=64, end=64, samples=4096, seconds=2.5, part=b"sums").write(file)
    >>> Checkpoint.read(file).done
    64
"""

from __future__ import annotations

import hashlib
import json
import os
import struct
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output, sources
from illuminant.errors import DataError, Error, MachineError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    from illuminant.job import Job

__all__ = ["MAX_BYTES", "MAX_HEADER", "Checkpoint", "Keeper", "resumed"]

FIRST_LINE = b"illuminant checkpoint 2\n"
MAX_HEADER = 1_000_000
"""The longest header, bytes."""

MAX_BYTES = 64_000_000_000
"""The largest checkpoint."""

_DIGEST = 32
_MISSING = object()


@dataclass(frozen=True)
class Checkpoint:
    """What is kept of a render under way.

    Attributes:
        identity: of the render; equal for renders whose samples may be joined.
        done: samples of every pixel that complete ranges have taken.
        end: of the range under way, which was decided on and is to be completed; `done` if there is none.
        samples: that the film holds, over all pixels.
        seconds: spent so far.
        part: what the film holds, as `Render.part` of the core gives it.
        solution: the light between surfaces, as `radiosity.Solution.to_bytes` gives it; empty where there is none.
        rows: those of form factors that have been found, as `form_factor_rows.Rows.to_bytes` gives them, where that
            light is still being solved for; no sample has been taken then.
    """

    identity: Mapping[str, Any]
    done: int
    end: int
    samples: int
    seconds: float
    part: bytes
    solution: bytes = b""
    rows: bytes = b""

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write it in place of an older one, whole or not at all.

        Raises:
            ImageError: the path cannot be an output.
            MachineError: the disk is full or fails. In both cases the older one is as it was.
        """
        path = Path(path)
        numbers = {"done": self.done, "end": self.end, "samples": self.samples, "seconds": self.seconds}
        header: dict[str, Any] = {"identity": self.identity, **numbers}
        blocks = (self.part, self.solution, self.rows)
        header["blocks"] = [len(block) for block in blocks]
        text = json.dumps(header, sort_keys=True).encode()

        def encode(temporary: Path) -> None:
            digest = hashlib.sha256()
            with open(temporary, "wb") as file:
                for block in (FIRST_LINE, struct.pack("<Q", len(text)), text, *blocks):
                    digest.update(block)
                    file.write(block)
                file.write(digest.digest())

        output.write(path, encode)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Checkpoint:
        """Read a checkpoint.

        Raises:
            DataError: the file cannot be read, is no checkpoint, or is damaged.
        """
        name = os.fspath(path)
        try:
            content = sources.read(path, MAX_BYTES)
        except SourceError as error:
            raise DataError(f"{name} cannot be read: {error.clause}.") from None
        return cls.from_bytes(content, name)

    @classmethod
    def from_bytes(cls, content: bytes, name: str = "the checkpoint") -> Checkpoint:
        """As `read`, of the bytes of a file.

        Example:
            >>> Checkpoint.from_bytes(b"sums")
            Traceback (most recent call last):
            illuminant.errors.DataError: the checkpoint is no checkpoint of illuminant.
        """
        start = len(FIRST_LINE) + 8
        if not content.startswith(FIRST_LINE[:-2]) or len(content) < start + _DIGEST:
            raise DataError(f"{name} is no checkpoint of illuminant.")
        if not content.startswith(FIRST_LINE):
            raise DataError(f"{name} is a checkpoint of another form, which this version does not read.")
        view = memoryview(content)
        if hashlib.sha256(view[:-_DIGEST]).digest() != content[-_DIGEST:]:
            raise DataError(f"{name} is damaged: its digest is not that of its content.")
        (length,) = struct.unpack("<Q", content[start - 8 : start])
        try:
            if length > MAX_HEADER:
                raise ValueError("header")
            header = json.loads(content[start : start + length])
            identity, seconds = header["identity"], float(header["seconds"])
            done, end, samples = (header[key] for key in ("done", "end", "samples"))
            part, solution, rows = header["blocks"]
            whole = isinstance(identity, dict) and min(part, solution, rows) >= 0
            whole &= start + length + part + solution + rows + _DIGEST == len(content)
            whole &= all(isinstance(count, int) for count in (done, end, samples))
            # Without a film there are no samples.
            whole &= not rows or part == solution == end == samples == 0
            if not (whole and 0 <= done <= end < 2**32 and 0 <= samples < 2**63 and 0 <= seconds < 1e12):
                raise ValueError("numbers")
            first = start + length
            return cls(
                identity,
                done,
                end,
                samples,
                seconds,
                content[first : first + part],
                content[first + part : first + part + solution],
                content[first + part + solution : -_DIGEST],
            )
        except (ValueError, KeyError, TypeError, RecursionError, OverflowError) as error:
            raise DataError(f"{name} is damaged: its header cannot be.") from error

    def check(self, identity: Mapping[str, Any]) -> None:
        """Refuse the checkpoint of another render.

        Args:
            identity: of the render that shall go on.

        Raises:
            UsageError: they differ; the sentence names how.

        Example:
            >>> Checkpoint({"seed": 0}, 1, 1, 9, 0.0, b"").check({"seed": 1})
            Traceback (most recent call last):
            illuminant.errors.UsageError: The checkpoint is of another render: seed was 0 and is 1.
        """
        names = [
            key
            for key in dict.fromkeys([*self.identity, *identity])
            if self.identity.get(key, _MISSING) != identity.get(key, _MISSING)
        ]
        if names:
            apart = [_apart(key, self.identity.get(key), identity.get(key)) for key in names]
            raise UsageError(f"The checkpoint is of another render: {'; '.join(apart)}.")


def _apart(key: str, before: Any, now: Any) -> str:
    """How one thing differs, as part of a sentence."""
    if key == "scene":
        return "the scene has changed"
    words = [json.dumps(value) if isinstance(value, (list, dict)) else str(value) for value in (before, now)]
    return f"{key.replace('_', ' ')} was {words[0]} and is {words[1]}"


def resumed(path: str | os.PathLike[str], *, resume: bool) -> Checkpoint | None:
    """The checkpoint from which a render goes on; None where it begins.

    Args:
        path: the file, which need not exist.
        resume: whether to go on from it.

    Raises:
        UsageError: there is a checkpoint, and nobody said to go on from it.
        DataError: it cannot be read, or is damaged.
    """
    if not Path(path).exists():
        return None
    if not resume and not _is_checkpoint(path):
        raise UsageError(f"{os.fspath(path)} is there already, and is no checkpoint: name another file.")
    if not resume:
        raise UsageError(f"{os.fspath(path)} holds a checkpoint: go on from it with --resume, or remove it.")
    return Checkpoint.read(path)


def _is_checkpoint(path: str | os.PathLike[str]) -> bool:
    try:
        with sources.opened(path, MAX_BYTES) as file:
            return file.read(len(FIRST_LINE) - 2) == FIRST_LINE[:-2]
    except SourceError:
        return False


class Keeper:
    """Writes the checkpoints of a render, each so many seconds after the one before.

    Args:
        path: the file.
        every: seconds between checkpoints.
        trouble: is told when one cannot be written; the render goes on, and the checkpoint before stays. So it is
            where another process has written the file meanwhile, whose work is not overwritten.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        every: float = 60.0,
        trouble: Callable[[Error], object] | None = None,
    ) -> None:
        self.path = output.check(path)
        self.every = every
        self._trouble = trouble
        self._last = time.monotonic()
        self._left = self._there()

    def _there(self) -> tuple[int, int] | None:
        """What tells the file that is there now from others."""
        try:
            found = self.path.stat()
        except OSError:
            return None
        return found.st_ino, found.st_mtime_ns

    def due(self) -> bool:
        """Whether it is time for the next one."""
        return time.monotonic() - self._last >= self.every

    def keep(self, job: Job) -> bool:
        """Write one; False if that was not possible."""
        try:
            if self._there() not in (None, self._left):
                raise UsageError(
                    f"{self.path} is written by another process too: give each a file of its own."
                )
            job.checkpoint().write(self.path)
            self._left = self._there()
        except (Error, MemoryError, ValueError) as error:
            if self._trouble is not None:
                told = (
                    error if isinstance(error, Error) else MachineError("There is not enough memory for it.")
                )
                self._trouble(told)
            return False
        finally:
            # From its end, so that writing never takes all of the time.
            self._last = time.monotonic()
        return True
