"""One page: its camera, its choices, its pictures. Pages share nothing, so that viewers do not disturb each other."""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant.errors import Error
from illuminant.viewer.camera import limited, scene_camera, vertical_rad
from illuminant.viewer.composition import MODES, compose, difference_map, enlarged, split
from illuminant.viewer.refinement import Frame, Refiner
from illuminant.viewer.scale import with_scale
from illuminant.viewer.sending import Sender, background, encoded
from illuminant.viewer.wireframe import WIRES, depth, edges

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.viewer.composition import Composed
    from illuminant.viewer.reading import Reading
    from illuminant.viewer.state import State

__all__ = ["Session"]

MOST_PIXELS = 1280 * 800
"""Of a picture; the page enlarges it to the window."""

ILLUMINANCE = MODES[3]

WIRE_COLOUR = (70, 160, 255)

ENOUGH_SAMPLES = 16
"""Of a picture that says what is white."""


class Session:
    """What one page sees and does.

    Args:
        client: viser's handle of the page.
        state: at the start.
        folder: where what the page keeps is written, and nowhere else.
        allow_outside: whether the scene was read with files outside its folder.
    """

    def __init__(self, client: Any, state: State, folder: Path, *, allow_outside: bool = False) -> None:
        self.client, self.state, self.folder = client, state, folder
        self.allow_outside = allow_outside
        self.start = state
        self.mode = MODES[0]
        self.frame: Frame | None = None
        self.sent: Frame | None = None
        self.codes: NDArray[np.uint8] | None = None
        """What was sent last, as the browser shows it."""
        self.composition: Composed | None = None
        """The latest frame in its look, or in false colours."""
        self.held: State | None = None
        self.held_frame: Frame | None = None
        self.divider = 0.5
        self.map = "none"
        self.wires = WIRES[0]
        self._wired: tuple[str, int] = (WIRES[0], 0)
        self._lines: Any = None
        self._depth: tuple[Any, NDArray[np.float32]] | None = None
        self._exposure_from = 0 if state.look.exposure is None else ENOUGH_SAMPLES
        self.lock = threading.RLock()
        self._shown_camera: Any = None
        self._sender = Sender(self._send, lambda text: self.say(text, True))
        self.refiner = Refiner(self._deliver, self.say)
        self._second: Refiner | None = None
        self.last_reading: Reading | None = None
        from illuminant.viewer.panels import Panels

        try:
            self.panels = Panels(self)
            client.camera.on_update(self._moved)
            client.scene.on_click()(self._clicked)
            self.ask()
        except BaseException:  # the page may have gone meanwhile; nobody else could end the threads
            self.close()
            raise

    # --- camera --------------------------------------------------------------------------------------------------

    def place_camera(self, camera: Any) -> None:
        """Turn the page's camera to one of the scene's."""
        view = self.client.camera
        width, height = camera["size"]
        with self.client.atomic():
            view.up_direction = camera["up"]
            view.position = camera["eye"]
            view.look_at = camera["target"]
            view.fov = vertical_rad(camera["field_of_view_deg"], width, height)

    def camera(self) -> dict[str, Any]:
        """The page's camera, as the scene has cameras."""
        import numpy as np

        view = self.client.camera
        size = limited(max(1, view.image_width), max(1, view.image_height), MOST_PIXELS)
        distance = float(np.linalg.norm(np.asarray(view.look_at) - np.asarray(view.position))) or 1.0
        own = self.state.scene.description["camera"]
        return scene_camera(own, view.wxyz, view.position, view.fov, size, distance)

    def _moved(self, _: Any) -> None:
        if self.camera() != self._shown_camera:
            self.ask()

    def preset(self, name: str) -> None:
        """Turn the page's camera to the scene's own, or to one beside or above what that looks at."""
        import numpy as np

        own = self.start.scene.description["camera"]
        if name == "scene":
            self.place_camera(own)
            return
        eye, target, up = (np.asarray(own[key], float) for key in ("eye", "target", "up"))
        away = eye - target
        up = up / np.linalg.norm(up)
        level = away - (away @ up) * up
        side = np.cross(up, level)
        turned = {
            "left": -side + (away @ up) * up,
            "right": side + (away @ up) * up,
            "above": np.linalg.norm(away) * up + 0.02 * level,
        }[name]
        self.place_camera(dict(own) | {"eye": (target + turned).tolist()})

    # --- rendering -----------------------------------------------------------------------------------------------

    def change(self, state: State) -> None:
        """Show another state."""
        with self.lock:
            self.state = state
        self.ask()

    def look_at(self, state: State) -> None:
        """Show the same light in another look."""
        with self.lock:
            self.state = state
        self.panels.forgive()
        self.show()

    def choose_mode(self, mode: str, state: State) -> None:
        """Show the picture, false colours or marks, in a look; illuminance is found for the purpose."""
        with self.lock:
            again = mode != self.mode and ILLUMINANCE in (mode, self.mode)
            self.mode = mode
        if again:
            self.change(state)
        else:
            self.look_at(state)

    def ask(self) -> None:
        """Render what is chosen, from where the page's camera stands."""
        with self.lock:
            self.panels.forgive()
            camera = self._shown_camera = self.camera()
            lux = self.mode == ILLUMINANCE
            self.refiner.ask(self.state, camera, illuminance=lux)
            if self.held is not None and self._second is not None:
                self._second.ask(self.held, camera, illuminance=lux)

    def hold(self, wanted: bool) -> None:
        """Hold the present setting, to be seen beside what is chosen from now on; or let it go."""
        with self.lock:
            self.held = self.state if wanted else None
            self.held_frame = None
            if wanted and self._second is None:
                self._second = Refiner(self._deliver_held, self.say)
        self.ask()

    def _deliver(self, frame: Frame) -> None:
        with self.lock:
            self.frame = frame
            if self._exposure_from < ENOUGH_SAMPLES:
                # A few noisy pixels say little of what is white: a better picture sets the exposure again. So does the
                # first one from the scene's camera: until a page has taken that over, it stands somewhere else.
                if self._is_at_start(frame):
                    self._exposure_from = frame.samples
                look = replace(self.state.look, exposure=frame.image.auto_exposure())
                self.state = replace(self.state, look=look)
        self.show()
        self.panels.progress(frame)

    def _is_at_start(self, frame: Frame) -> bool:
        """Whether a frame is seen from where the scene's own camera stands."""
        import numpy as np

        own = np.asarray(self.start.scene.description["camera"]["eye"], float)
        apart = np.linalg.norm(np.asarray(frame.request.camera["eye"], float) - own)
        return bool(apart <= 1e-3 * (1.0 + np.linalg.norm(own)))

    def _deliver_held(self, frame: Frame) -> None:
        with self.lock:
            self.held_frame = frame
        self.show()

    def show(self) -> None:
        """Send the picture as it is now, with all that is drawn into it, soon."""
        self._sender.ask()

    def _send(self) -> None:
        """Make of the latest frame what the page shows, and send it."""
        with self.lock:
            frame, other, state = self.frame, self.held_frame, self.state
            if frame is None:
                return
            held = None if self.held is None else replace(self.held, look=state.look, stops=state.stops)
        # Without the lock, for it takes a while; this thread alone sends, so an older picture never comes last.
        made = self.composed(frame, state)
        codes = made.codes
        if other is not None and held is not None:
            codes = self._beside(other, held, frame, made)
        wired = (self.wires != WIRES[0] or self._lines is not None) and not frame.preview
        far = self._wire(frame) if wired else None
        background(self.client, encoded(codes), far)
        self.codes, self.sent = codes, frame

    def _beside(self, other: Frame, held: State, frame: Frame, right: Composed) -> NDArray[np.uint8]:
        """The held setting at the left and the chosen one at the right, or the map of their difference."""
        a, b = other.image.xyz, frame.image.xyz
        if self.map != "none" and a.shape == b.shape:
            codes, mean = difference_map(a, b, self.state.exposure or 1.0, self.map)
            self.panels.compare.mean(self.map, mean)
            top = 10.0 if self.map == "ΔE00" else 1.0
            return with_scale(codes, "magma", 0.0, top, self.map, logarithmic=False)
        self.panels.compare.mean("none", 0.0)
        # One scale for both sides, or equal colours would not be equal light.
        return split(self.composed(other, held, right.scale).codes, right.codes, self.divider)

    def composed(self, frame: Frame, state: State, scale: tuple[float, float] | None = None) -> Composed:
        """A frame as the page shows it, in false colours on its own scale or a given one, which is drawn into it."""
        import numpy as np

        emission = frame.image.layers.get("emission")
        shining = None if emission is None else np.asarray((emission > 0).any(axis=2))
        made = compose(frame.image.xyz, state, self.mode, shining=shining, lux=frame.illuminance, scale=scale)
        if frame is self.frame:
            self.composition = made
            self.panels.facts(made)
        if made.scale is None:
            return made
        # A preview is enlarged first, or the page would enlarge the numbers with it.
        width, height = frame.request.camera["size"]
        codes = enlarged(made.codes, height, width)
        drawn = with_scale(codes, "viridis", *made.scale, made.title, logarithmic=True)
        return replace(made, codes=drawn)

    # --- wireframe -----------------------------------------------------------------------------------------------

    def wire(self, kind: str) -> None:
        """Draw the edges of a solution over the picture, or none."""
        self.wires = kind
        if kind != WIRES[0] and self.refiner.solution is None:
            self.say("Elements belong to a solution: choose radiosity or hybrid.", True)
        self.show()

    def _wire(self, frame: Frame) -> NDArray[np.float32] | None:
        """Draw the edges that are chosen, if there is a solution; how far the picture is away, which hides some."""
        found = self.refiner.found
        with self.lock:
            kind = self.wires if found is not None else WIRES[0]
            wired, lines, deep = self._wired, self._lines, self._depth
        # Without the lock, for both take a while; this thread alone draws edges.
        wanted = (kind, 0 if found is None else found.number)
        if wanted != wired:
            ends = edges(found.solution.mesh(), kind) if found is not None and kind != WIRES[0] else None
            if lines is not None:
                lines.remove()
            lines = None
            if ends is not None:
                lines = self.client.scene.add_line_segments(
                    "/wireframe", ends, WIRE_COLOUR, thickness=1.0, thickness_units="screen"
                )
        camera = frame.request.camera
        if lines is not None and (deep is None or deep[0] != camera):
            deep = camera, depth(frame.request.state.scene, camera)
        with self.lock:
            self._wired, self._lines, self._depth = wanted, lines, deep
        return None if lines is None or deep is None else deep[1]

    def say(self, text: str, wrong: bool) -> None:
        """Show a sentence in the page."""
        self.panels.say(text, wrong)

    # --- reading -------------------------------------------------------------------------------------------------

    def _clicked(self, event: Any) -> None:
        x, y = event.screen_pos
        self.read(float(x), float(y))

    def read(self, across: float, down: float) -> None:
        """Read the point at fractions of width and height."""
        from illuminant.viewer.reading import read

        with self.lock:
            camera, state = self._shown_camera, self.state
        width, height = camera["size"]
        pixel = min(int(across * width), width - 1), min(int(down * height), height - 1)
        try:
            found = self.last_reading = read(state, camera, pixel, self.refiner.solution_for(state))
            self.panels.measure.show(found)
            self.panels.material.select(found.material)
        except Exception as error:
            self.say(str(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}", True)

    # --- end -----------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """End all work of the page."""
        self.refiner.close()
        self._sender.close()
        if self._second is not None:
            self._second.close()
        self.frame = self.sent = self.codes = self.composition = self.held_frame = self._depth = None
