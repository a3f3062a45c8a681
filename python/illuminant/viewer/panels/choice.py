"""What a page may choose: only what its controls offer.

A page sends values as text and numbers, and whoever writes to its WebSocket sends whatever he likes: the name of a file
in place of that of a display, say. So every value is compared with what the control offers before it is used, and a
mistake becomes a sentence in the page.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from illuminant.errors import Error, UsageError

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["answering", "picked"]


def picked(control: Any) -> Any:
    """The value of a list, a slider or a checkbox.

    Raises:
        UsageError: the control does not offer it.

    Example:
        >>> from types import SimpleNamespace
        >>> picked(SimpleNamespace(value="sRGB", options=("sRGB", "Rec.709")))
        'sRGB'
        >>> picked(SimpleNamespace(value="../secret.toml", options=("sRGB", "Rec.709")))
        Traceback (most recent call last):
        illuminant.errors.UsageError: '../secret.toml' is not one of the choices.
    """
    value = control.value
    options, least = getattr(control, "options", None), getattr(control, "min", None)
    if options is not None and value not in options:
        raise UsageError(f"{str(value)[:80]!r} is not one of the choices.")
    if least is not None and not (isinstance(value, (int, float)) and least <= value <= control.max):
        raise UsageError(f"{str(value)[:80]} does not lie from {least} to {control.max}.")
    return value


def answering(session: Session, act: Callable[[], object]) -> Callable[[Any], None]:
    """A callback for a control: it acts, and a mistake becomes a sentence in the page."""

    def answer(_: Any) -> None:
        # viser calls from many threads: one choice after the other, or an older one could come last.
        with session.lock:
            try:
                act()
            except Error as error:
                session.say(str(error), True)
            except Exception as error:  # a silent page helps nobody
                session.say(f"{type(error).__name__}: {error}", True)

    return answer
