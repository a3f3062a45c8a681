"""From radiance to what the eye gets: the display, its code values, and what is lost on the way (book chapter 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.display.developing import develop as develop

__all__ = ["develop"]

_HOME = {"develop": "developing"}


def __getattr__(name: str) -> Any:
    """Look up a lazy name of this package and keep it (PEP 562)."""
    from importlib import import_module

    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value
