"""The compiled core, loaded when it is first needed.

`core()` checks the processor and imports the extension `illuminant._core`; `embree()` also loads the
ray-query library. Everything in this package reaches the compiled core through these two functions, so each
trouble has one sentence.

Example:
    >>> from illuminant.core import core
    >>> core().__version__        # doctest: +SKIP
    '0.1.0'
"""

from __future__ import annotations

from functools import cache
from types import ModuleType

from illuminant import embree as _embree
from illuminant import processor
from illuminant.errors import MachineError

__all__ = ["core", "embree"]


@cache
def core() -> ModuleType:
    """The extension module `illuminant._core`.

    Raises:
        MachineError: the processor is too old, or the extension is not there or does not fit this Python.
    """
    processor.check()
    try:
        from illuminant import _core
    except ImportError as error:
        raise MachineError(
            f"The compiled core of illuminant cannot be loaded ({error}): run `make setup` in a checkout, "
            "or install the wheel for this system and Python again."
        ) from error
    module: ModuleType = _core
    return module


@cache
def embree() -> str:
    """Load Embree 4 into the core, once.

    Returns:
        Its version, for example `4.4.0`.

    Raises:
        MachineError: no library was found, or the one found is not a usable Embree 4; says what to install.
    """
    path = _embree.find()
    try:
        return str(core().load_embree(str(path)))
    except RuntimeError as error:
        raise MachineError(
            f"{path} cannot be used as Embree 4 ({_clause(error)}): {_embree.REMEDY}."
        ) from error


def _clause(error: Exception) -> str:
    """Text of an error as part of a sentence: one line, without its full stop."""
    return " ".join(str(error).split()).rstrip(".")
