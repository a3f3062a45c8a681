"""A renderer as a process of its own, and the line protocol by which a benchmark drives it.

Two renderers that are compared must not share an interpreter (Mitsuba pins its own NumPy and its own
threads), and their runs are interleaved, A B A B, so that a slow minute of the machine falls on both. So each
lives in a process that stays warm: it loads the scene once, then renders on request. Both ends of that
conversation are in this file; it needs the standard library only, because it is imported in two environments.

Protocol: one JSON object a line. The child opens with ``{"ready": true, ...}`` (name, version, size of the
image). A request is ``{"seed": int, "samples": int, "output": path or null}``; the answer holds ``seconds``
(rendering only: no start, no scene, no compilation), ``processor_seconds`` (of all threads, for the whole
request; on a machine that is not quiet they vary less), ``peak_bytes`` of the process so far, whatever else the
renderer counts, and, when ``output`` was given, the image is there as ``.npy``, (height, width, 3), float64,
absolute XYZ (Y in cd/m2).
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any


class RendererProcess:
    """The parent's end: start a renderer, ask it for images, close it.

    Raises `RuntimeError` with the last lines of the child's messages when it ends early.
    """

    def __init__(self, command: Sequence[str], environment: dict[str, str] | None = None) -> None:
        self.command = list(command)
        self._child = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **(environment or {})},
            text=True,
        )
        self.opening = self._answer()

    def render(self, *, seed: int, samples: int, output: Path | None = None) -> dict[str, Any]:
        """Render one image; the answer is described at the top of this file."""
        return self.ask(seed=seed, samples=samples, output=None if output is None else str(output))

    def ask(self, **request: Any) -> dict[str, Any]:
        """Send one request as it stands and wait for the answer."""
        assert self._child.stdin is not None
        self._child.stdin.write(json.dumps(request) + "\n")
        self._child.stdin.flush()
        return self._answer()

    def close(self) -> None:
        """End the process (it leaves by itself when its input is closed)."""
        if self._child.stdin is not None:
            self._child.stdin.close()
        self._child.wait()

    def _answer(self) -> dict[str, Any]:
        assert self._child.stdout is not None
        line = self._child.stdout.readline()
        if not line:
            code = self._child.wait()
            raise RuntimeError(f"{' '.join(self.command)} ended with code {code}; its messages are above")
        answer: dict[str, Any] = json.loads(line)
        return answer

    def __enter__(self) -> RendererProcess:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def serve(opening: dict[str, Any], render: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    """The child's end: say what this renderer is, then answer requests until the input closes.

    Anything that a library prints goes to stderr, so it cannot fall into the conversation.
    """
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    _write(answers, {"ready": True, **opening})
    for line in sys.stdin:
        before = time.process_time()
        answer = render(json.loads(line))
        processor = time.process_time() - before
        _write(answers, {"peak_bytes": peak_bytes(), "processor_seconds": processor, **answer})


def peak_bytes() -> int:
    """Largest resident size of this process so far, in bytes."""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def _write(stream: Any, message: dict[str, Any]) -> None:
    stream.write(json.dumps(message) + "\n")
    stream.flush()
