"""A page of the viewer without a browser: it asks as a page asks, and makes of every frame what is sent to a browser.

frame -> look -> codes -> PNG      as `illuminant.viewer.session.Session` does, on a thread of its own
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from illuminant.viewer.composition import compose
from illuminant.viewer.refinement import Frame, Refiner
from illuminant.viewer.sending import Sender, encoded
from illuminant.viewer.state import State

SCENES = Path(__file__).resolve().parent.parent / "scenes"


@dataclass(frozen=True)
class Sent:
    """A picture that is ready to be sent.

    Attributes:
        number: of the request that it answers.
        preview: whether it is smaller than the whole.
        samples: of each pixel.
        seconds: from the request until the PNG is there.
        size: bytes.
    """

    number: int
    preview: bool
    samples: int
    seconds: float
    size: int


class Page:
    """What stands in for a page.

    Args:
        state: at the start.
        size: pixels of the window.
    """

    def __init__(self, state: State, size: tuple[int, int] = (1280, 800)) -> None:
        self.state = state
        self._own: Mapping[str, Any] = dict(state.scene.description["camera"]) | {"size": list(size)}
        self.camera: Mapping[str, Any] = self._own
        self.sent: list[Sent] = []
        self.said: list[str] = []
        self._news = threading.Condition()
        self._frame: Frame | None = None
        self._sender = Sender(self._send, lambda text: self._say(text, True))
        self.refiner = Refiner(self._deliver, self._say)

    def __enter__(self) -> Page:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End all work of the page."""
        self.refiner.close()
        self._sender.close()
        self._frame = None

    def ask(self) -> int:
        """Ask for what is chosen; the number of the request."""
        return self.refiner.ask(self.state, self.camera)

    def turn(self, degrees: float, closer: float = 1.0) -> None:
        """Turn the scene's camera about what it looks at, and bring it closer."""
        eye, target, up = (np.asarray(self._own[key], float) for key in ("eye", "target", "up"))
        up, away, angle = up / np.linalg.norm(up), closer * (eye - target), math.radians(degrees)
        turned = (
            away * math.cos(angle)
            + np.cross(up, away) * math.sin(angle)
            + up * (up @ away) * (1 - math.cos(angle))
        )
        self.camera = dict(self._own) | {"eye": (target + turned).tolist()}

    def wait(self, number: int, *, preview: bool = True, seconds: float = 300.0) -> Sent:
        """The first picture of a request, or the first whole one.

        Raises:
            TimeoutError: it did not come.
        """
        end = time.monotonic() + seconds
        with self._news:
            while True:
                for one in self.sent:
                    if one.number >= number and (preview or not one.preview):
                        return one
                if not self._news.wait(end - time.monotonic()):
                    raise TimeoutError(f"no picture came: {self.said}")

    def _deliver(self, frame: Frame) -> None:
        if self.state.exposure is None:
            look = replace(self.state.look, exposure=frame.image.auto_exposure())
            self.state = replace(self.state, look=look)
        self._frame = frame
        self._sender.ask()

    def _send(self) -> None:
        frame = self._frame
        if frame is None:
            return
        png = encoded(compose(frame.image.xyz, self.state).codes)
        seconds = time.perf_counter() - frame.request.asked
        with self._news:
            self.sent.append(Sent(frame.request.number, frame.preview, frame.samples, seconds, len(png)))
            del self.sent[:-50]
            self._news.notify_all()

    def _say(self, text: str, wrong: bool) -> None:
        if wrong:
            self.said.append(text)
