"""The viewer's server: viser, made to listen on loopback, to admit only who holds the token, and never to share."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import socket
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant.errors import DataError, MachineError, SceneError, UsageError
from illuminant.viewer.camera import vertical_rad
from illuminant.viewer.guard import Guard, new_token
from illuminant.viewer.state import State

if TYPE_CHECKING:
    from illuminant.scene import Scene
    from illuminant.viewer.session import Session

__all__ = ["Viewer"]

_STARTING = threading.Lock()


class Viewer:
    """A viewer that runs until `stop`; each page that opens its address has a session of its own.

    Args:
        scene: a `Scene`, or the path of a scene file. A file with mistakes is no error here: the page shows them.
        host: address to listen on.
        port: to listen on; when it is taken, the next free one is used.
        folder: where what a page keeps is written.
        choices: technique, illumination, sampling at the start.

    Attributes:
        url: of the page, with its token.
        port: that it listens on.

    Raises:
        UsageError: a choice is not known.
        MachineError: the address cannot be listened on.
    """

    def __init__(
        self,
        scene: Scene | str | os.PathLike[str],
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
        folder: str | os.PathLike[str] = ".",
        allow_outside: bool = False,
        **choices: Any,
    ) -> None:
        if not 0 <= port <= 65535:
            raise UsageError(f"--port {port}: expected a whole number from 0 to 65535.")
        self.folder = Path(folder)
        self.problem: str | None = None
        self.state: State | None = None
        try:
            named = scene if not isinstance(scene, os.PathLike) else Path(scene)
            self.state = State.of(named, allow_outside=allow_outside, **choices)
        except (SceneError, DataError) as error:
            if not isinstance(scene, (str, os.PathLike)) or not Path(scene).is_file():
                raise
            self.problem = str(error)
        self.sessions: dict[int, Session] = {}
        self._allow_outside = allow_outside
        self._lock = threading.Lock()
        self._gone: set[int] = set()
        """Pages that closed before they had a session; it is ended as soon as it is there."""
        self._stopped = False
        self._token = new_token()
        self._guard = Guard(self._token, host, port)
        self._server = self._listen(host, _free_port(host, port))
        self.port: int = self._server.get_port()
        self._guard.port = self.port
        shown = (
            socket.gethostname() if host in ("0.0.0.0", "::", "") else f"[{host}]" if ":" in host else host
        )
        self.url = f"http://{shown}:{self.port}/?token={self._token}"
        self._server.gui.configure_theme(
            control_layout="floating",
            control_width="large",
            dark_mode=True,
            show_logo=False,
            show_share_button=False,
        )
        if self.state is not None:
            self._place(self.state.scene)
        self._server.on_client_connect(self._opened)
        self._server.on_client_disconnect(self._left)

    # --- viser, guarded ------------------------------------------------------------------------------------------

    def _listen(self, host: str, port: int) -> Any:
        import viser
        from viser import _messages

        with _STARTING, _guarded(self._guard), contextlib.redirect_stdout(io.StringIO()):
            server = viser.ViserServer(host=host, port=port, label="illuminant", verbose=False)
        # The page can ask for a tunnel that shows it to the whole internet.
        for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            server._websock_server.unregister_handler(message)
        return server

    def _place(self, scene: Scene) -> None:
        """Let pages begin where the scene's camera stands."""
        camera = scene.description["camera"]
        first = self._server.initial_camera
        self._server.scene.set_up_direction({"y": "+y", "z": "+z"}[scene.frame.get("up", "y")])
        first.up = camera["up"]
        first.position = camera["eye"]
        first.look_at = camera["target"]
        first.fov = vertical_rad(camera["field_of_view_deg"], *camera["size"])

    # --- pages ---------------------------------------------------------------------------------------------------

    def _opened(self, client: Any) -> None:
        from illuminant.viewer.session import Session

        if self.state is None:
            client.gui.add_markdown(f"## The scene cannot be shown\n\n```\n{self.problem}\n```")
            return
        # Without the lock, for it takes a while, in which the page may close.
        session = Session(client, self.state, self.folder, allow_outside=self._allow_outside)
        with self._lock:
            wanted = not self._stopped and client.client_id not in self._gone
            self._gone.discard(client.client_id)
            if wanted:
                self.sessions[client.client_id] = session
        if not wanted:
            session.close()

    def _left(self, client: Any) -> None:
        with self._lock:
            session = self.sessions.pop(client.client_id, None)
            if session is None and self.state is not None:
                self._gone.add(client.client_id)
        if session is not None:
            session.close()

    # --- end -----------------------------------------------------------------------------------------------------

    def wait(self) -> None:
        """Wait until Ctrl-C."""
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()

    def stop(self) -> None:
        """End all sessions and the server."""
        with self._lock:
            self._stopped = True
            sessions = list(self.sessions.values())
            self.sessions.clear()
        for session in sessions:
            session.close()
        with contextlib.redirect_stdout(io.StringIO()):
            self._server.stop()

    def __enter__(self) -> Viewer:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def _repr_html_(self) -> str:
        """The page inside a notebook: under the notebook's own host name, or a browser would keep the cookie back."""
        frame = f"illuminant-{self.port}"
        address = f"'http://' + location.hostname + ':{self.port}/?token={self._token}'"
        return (
            f'<iframe id="{frame}" width="100%" height="640" style="border:0"></iframe>'
            f"<script>document.getElementById('{frame}').src = {address}</script>"
        )


def _free_port(host: str, port: int) -> int:
    """The port, or the next one that is free; viser would try a thousand, and wait for ever if none can be had.

    Raises:
        UsageError: there is no such host.
        MachineError: the address is not one of this machine, or no port is free.
    """
    try:
        family, *_, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    except (OSError, UnicodeError) as error:
        raise UsageError(f"--host {host}: there is no such address.") from error
    for candidate in [0] if port == 0 else range(port, min(port + 100, 65536)):
        with socket.socket(family) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((address[0], candidate))
            except OSError as error:
                if error.errno == errno.EADDRINUSE:
                    continue
                reason = (error.strerror or str(error)).lower()
                raise MachineError(f"{host}:{candidate} cannot be listened on: {reason}.") from error
            return int(probe.getsockname()[1])
    raise MachineError(f"{host}: no port from {port} on is free.")


@contextlib.contextmanager
def _guarded(guard: Guard) -> Iterator[None]:
    """While viser starts its server, put the guard before its answer to every request, WebSockets included."""
    import http
    from functools import wraps

    import websockets.asyncio.server as sockets
    from websockets.datastructures import Headers
    from websockets.http11 import Response

    original = sockets.serve

    @wraps(original)
    def serve(*arguments: Any, process_request: Any = None, **options: Any) -> Any:
        def answer(connection: Any, request: Any) -> Any:
            reason = guard.refusal(request.path, request.headers)
            if reason is not None:
                text = f"Refused: {reason}.\n".encode()
                head = Headers(
                    {"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(text))}
                )
                return Response(http.HTTPStatus.FORBIDDEN, "Forbidden", head, text)
            response = process_request(connection, request) if process_request is not None else None
            if response is not None:
                response.headers["Set-Cookie"] = guard.cookie
                response.headers["Referrer-Policy"] = "no-referrer"
                response.headers["X-Content-Type-Options"] = "nosniff"
            return response

        return original(*arguments, process_request=answer, **options)

    sockets.serve = serve  # type: ignore[assignment, misc]
    try:
        yield
    finally:
        sockets.serve = original  # type: ignore[misc]
