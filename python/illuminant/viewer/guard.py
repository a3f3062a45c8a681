"""Who may use the viewer: whoever holds its token, from its own page.

A server on loopback is open to every page that the browser shows and to every user of the machine: a page can send
requests there (and by DNS rebinding even read the answers), and WebSockets are bound by no same-origin rule. So every
request, for a file or for a WebSocket, needs

- a secret token: in the address (`?token=...`) at first, then in a cookie that only this site gets back;
- a `Host` that is the viewer's own, where it listens on loopback only;
- for a WebSocket, an `Origin` that is that host.

Example:
    >>> guard = Guard("secret", "127.0.0.1", 8080)
    >>> guard.refusal("/?token=secret", {"Host": "127.0.0.1:8080"}) is None
    True
    >>> guard.refusal("/", {"Host": "127.0.0.1:8080"})
    'open the address that the command printed: it holds a token'
    >>> guard.refusal("/?token=secret", {"Host": "evil.example:8080"})
    'this is not the host that the viewer listens on'
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Mapping
from urllib.parse import parse_qs, urlsplit

__all__ = ["LOOPBACK", "Guard", "new_token"]

LOOPBACK = ("127.0.0.1", "localhost", "::1")


def new_token() -> str:
    """A token that cannot be guessed: 128 random bits."""
    return secrets.token_urlsafe(16)


class Guard:
    """Admits requests that hold the token and come from the viewer's own page.

    Args:
        token: the secret.
        host: that the server listens on.
        port: of the server.
    """

    def __init__(self, token: str, host: str, port: int) -> None:
        self.token, self.host, self.port = token, host, port

    @property
    def cookie_name(self) -> str:
        """Of the cookie; cookies are shared by all ports of a host, so the port is in the name."""
        return f"illuminant-{self.port}"

    @property
    def cookie(self) -> str:
        """The header that gives a browser its cookie."""
        return f"{self.cookie_name}={self.token}; HttpOnly; SameSite=Strict; Path=/"

    def refusal(self, target: str, headers: Mapping[str, str]) -> str | None:
        """Why a request is refused; None when it is admitted.

        Args:
            target: path and query of the request.
            headers: of the request.
        """
        host = headers.get("Host") or ""
        if self.host in LOOPBACK and not self._own(host):
            return "this is not the host that the viewer listens on"
        if (headers.get("Upgrade") or "").casefold() == "websocket":
            origin = urlsplit(headers.get("Origin") or "")
            if origin.scheme not in ("http", "https") or origin.netloc != host:
                return "the request comes from another page"
        if not any(
            hmac.compare_digest(one.encode(), self.token.encode()) for one in self._tokens(target, headers)
        ):
            return "open the address that the command printed: it holds a token"
        return None

    def _own(self, host: str) -> bool:
        try:
            parts = urlsplit(f"//{host}")
            return parts.hostname in LOOPBACK and (parts.port or 80) == self.port
        except ValueError:
            return False

    def _tokens(self, target: str, headers: Mapping[str, str]) -> list[str]:
        found = parse_qs(urlsplit(target).query).get("token", [])
        # By hand: the standard library's reader drops all cookies behind one that another program has written oddly.
        pairs = (part.strip().partition("=") for part in (headers.get("Cookie") or "").split(";"))
        return [*found, *(value for name, _, value in pairs if name == self.cookie_name)]
