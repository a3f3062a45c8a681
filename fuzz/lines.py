"""Which lines of a reader's modules a set of inputs reaches.

A line counts when Python has code for it inside a function; what runs at import does not.

Example:
    >>> from fuzz.lines import Lines
    >>> len(Lines(("illuminant.sensor_file",)).possible) > 10
    True
"""

from __future__ import annotations

import importlib
import sys
import types
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

__all__ = ["Lines"]


class Lines:
    """The lines of some modules.

    Args:
        modules: their names.

    Attributes:
        possible: file and number of every line in their functions.
        reached: of these, those that were run within `with`.
    """

    def __init__(self, modules: Iterable[str]) -> None:
        self.possible: set[tuple[str, int]] = set()
        self.reached: set[tuple[str, int]] = set()
        self._files: set[str] = set()
        for name in modules:
            try:
                file = importlib.import_module(name).__file__
            except ModuleNotFoundError:
                continue
            assert file is not None
            self._files.add(file)
            code = compile(Path(file).read_text(encoding="utf-8"), file, "exec")
            for inner in _functions(code):
                self.possible |= {
                    (file, line) for _, _, line in inner.co_lines() if line and line > inner.co_firstlineno
                }

    def __enter__(self) -> Lines:
        """Begin to look."""
        sys.settrace(self._call)
        return self

    def __exit__(self, *_: object) -> None:
        """End."""
        sys.settrace(None)

    def _call(self, frame: Any, event: str, argument: Any) -> Any:
        return self._line if frame.f_code.co_filename in self._files else None

    def _line(self, frame: Any, event: str, argument: Any) -> Any:
        if event == "line":
            self.reached.add((frame.f_code.co_filename, frame.f_lineno))
        return self._line

    def fraction(self) -> float:
        """Reached over possible; 0 where there is none."""
        return len(self.reached & self.possible) / len(self.possible) if self.possible else 0.0


def _functions(code: types.CodeType) -> Iterator[types.CodeType]:
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            if constant.co_flags & 2:  # has local variables of its own: a function, not the body of a class
                yield constant
            yield from _functions(constant)
