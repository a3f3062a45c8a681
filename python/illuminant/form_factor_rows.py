"""Rows of form factors, found range by range: work that can be shared out, and kept on the way.

For `radiosity` each side that light reaches has a row: the form factors to all patches. Rows do not depend on each
other, so any of them may be found anywhere and at any time, and together they are those that a solution finds itself,
to the bit.

Example:
    >>> import numpy as np
    >>> first = Rows(0, np.array([0, 2], np.uint64), np.array([1, 2], np.uint32), np.array([0.5, 0.25], np.float32))
    >>> second = Rows(1, np.array([0, 1], np.uint64), np.array([0], np.uint32), np.array([0.75], np.float32))
    >>> whole = joined([second, first])
    >>> whole.starts.tolist(), whole.columns.tolist()
    ([0, 2, 3], [1, 2, 0])
    >>> Rows.from_bytes(whole.to_bytes()).values.tolist()
    [0.5, 0.25, 0.75]
"""

from __future__ import annotations

import struct
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.errors import DataError

if TYPE_CHECKING:
    from illuminant.scene import Scene
    from illuminant.settings import Settings

__all__ = ["Rows", "joined", "solution_of", "solve"]

_COUNTS = struct.Struct("<QQ")
SECONDS = 0.5
"""Of work between two looks at the clock."""


@dataclass(frozen=True)
class Rows:
    """Rows that follow one another.

    Attributes:
        first: number of the first.
        starts: where each begins in the other two, and the end (uint64).
        columns: of the entries (uint32): numbers of patches.
        values: of the entries (float32): form factors.
    """

    first: int
    starts: Any
    columns: Any
    values: Any

    def __len__(self) -> int:
        return len(self.starts) - 1

    def to_bytes(self) -> bytes:
        """Bytes from which `from_bytes` makes the same rows; they must begin with the first of all."""
        counts = _COUNTS.pack(len(self), len(self.columns))
        return b"".join(
            [counts, *(memoryview(one).cast("B") for one in (self.starts, self.columns, self.values))]
        )

    @classmethod
    def from_bytes(cls, content: bytes) -> Rows:
        """The rows that `to_bytes` gave.

        Raises:
            DataError: the bytes are no rows.
        """
        import numpy as np

        damaged = DataError("The form factors of the checkpoint are damaged.")
        if len(content) < _COUNTS.size:
            raise damaged
        rows, entries = _COUNTS.unpack_from(content)
        if _COUNTS.size + 8 * (rows + 1) + 8 * entries != len(content):
            raise damaged
        starts = np.frombuffer(content, np.uint64, rows + 1, _COUNTS.size)
        columns = np.frombuffer(content, np.uint32, entries, _COUNTS.size + starts.nbytes)
        values = np.frombuffer(content, np.float32, entries, _COUNTS.size + starts.nbytes + columns.nbytes)
        rises = starts[0] == 0 and starts[-1] == entries and bool((starts[:-1] <= starts[1:]).all())
        if not (rises and np.isfinite(values).all() and (values >= 0).all()):
            raise damaged
        return cls(0, starts, columns, values)


def joined(found: Iterable[Rows]) -> Rows:
    """Rows in one piece, from ranges in any order that follow one another without a gap."""
    import numpy as np

    found = sorted(found, key=lambda one: one.first)
    starts, end = [np.zeros(1, np.uint64)], 0
    for one in found:
        starts.append(one.starts[1:] + np.uint64(end))
        end += int(one.starts[-1])
    none = [Rows(0, starts[0], np.zeros(0, np.uint32), np.zeros(0, np.float32))]
    return Rows(
        found[0].first if found else 0,
        np.concatenate(starts),
        np.concatenate([one.columns for one in found or none]),
        np.concatenate([one.values for one in found or none]),
    )


def solution_of(scene: Scene, settings: Settings, rows: Rows, width: int) -> Any:
    """The core's solution from all rows.

    Args:
        scene: what is solved for.
        settings: of the render.
        rows: all of them.
        width: how long they are.
    """
    from illuminant.core import core

    together = {"starts": rows.starts, "columns": rows.columns, "values": rows.values, "width": width}
    return core().Solution(scene.core(settings.threads), settings.to_core(), None, together)


def solve(scene: Scene, settings: Settings, ranges: list[Rows], look: Callable[[], object]) -> Any:
    """Solve for the light between surfaces for `radiosity`, row by row.

    Args:
        scene: what is solved for.
        settings: of the render.
        ranges: rows that are there already, from the first on; takes those that are found.
        look: is called after about each half second of work. It may put the ranges together.

    Returns:
        The core's solution.

    Raises:
        DataError: there are more rows than the scene has, or they are longer.
    """
    from illuminant.core import core

    finder = core().RowFinder(scene.core(settings.threads), settings.to_core())
    count, width = len(finder), finder.width
    done = sum(map(len, ranges))
    if done > count or any(len(one.columns) and int(one.columns.max()) >= width for one in ranges):
        raise DataError("The form factors of the checkpoint are damaged: the scene has fewer.")
    step = 1
    while done < count:
        end, began = min(done + step, count), time.monotonic()
        ranges.append(Rows(done, *finder.find(done, end)))
        done = end
        seconds = time.monotonic() - began
        step = max(1, int(step * min(2.0, SECONDS / max(seconds, 1e-6))))
        look()
    del finder
    ranges[:] = [joined(ranges)]
    return solution_of(scene, settings, ranges[0], width)
