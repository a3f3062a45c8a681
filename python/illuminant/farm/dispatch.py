"""Sending calls to the workers of a cluster, so many at a time, and taking what they bring.

Example:
    >>> with cluster(workers=2) as ray:                                            # doctest: +SKIP
    ...     dict(dispatched(ray, abs, [("a", (-1,)), ("b", (2,))], threads=1))
    {'a': 1, 'b': 2}
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from illuminant.errors import MachineError, UsageError

__all__ = ["MOST_RETRIES", "dispatched", "lanes"]

MOST_RETRIES = 100
"""How often a call is done again whose worker died."""

Key = TypeVar("Key")


def lanes(ray: Any, threads: int) -> int:
    """How many workers of so many threads the cluster has at a time.

    Raises:
        UsageError: none: no machine has so many processors.
    """
    if not 1 <= threads <= 4096:
        raise UsageError(f"--threads {threads}: a worker has 1 to 4096 threads.")
    processors = [int(node["Resources"].get("CPU", 0)) for node in ray.nodes() if node["Alive"]]
    found = sum(count // threads for count in processors)
    if not found:
        raise UsageError(
            f"--threads {threads}: no machine of the cluster lends so many processors; the largest lends "
            f"{max(processors, default=0)}."
        )
    return found


def dispatched(
    ray: Any,
    function: Callable[..., Any],
    calls: Iterable[tuple[Key, tuple[Any, ...]] | None],
    *,
    threads: int,
    over: Callable[[], bool] = lambda: False,
) -> Iterator[tuple[Key, Any]]:
    """Send calls, no more at a time than twice the workers, and yield their results in the order of their ends.

    Args:
        ray: what `cluster` yields.
        function: runs on the workers.
        calls: for each a key, with which its result is yielded, and the arguments. Where there is a None, the next one
            is asked for when all before are done.
        threads: processors that a call takes.
        over: whether the rest is wanted no more; what is under way is then cancelled.

    Raises:
        MachineError: the cluster is lost, or a call failed on its worker.
    """
    most = 2 * lanes(ray, threads)
    remote = ray.remote(num_cpus=threads, max_retries=MOST_RETRIES)(function)
    waiting: dict[Any, Key] = {}
    source, more, pausing = iter(calls), True, False
    try:
        while (more or waiting) and not over():
            pausing = pausing and bool(waiting)
            while more and not pausing and len(waiting) < most:
                try:
                    call = next(source)
                except StopIteration:
                    more = False
                    break
                if call is None:
                    pausing = bool(waiting)
                else:
                    key, arguments = call
                    waiting[remote.remote(*arguments)] = key
            if not waiting:
                continue
            ready, _ = ray.wait(list(waiting), num_returns=1, timeout=0.2)
            for reference in ready:
                key = waiting.pop(reference)
                yield key, ray.get(reference)
    except ray.exceptions.RayError as error:
        raise MachineError(f"The work failed on a worker of the cluster: {_cause(error)}.") from error
    finally:
        for reference in waiting:
            ray.cancel(reference, force=True)


def _cause(error: Exception) -> str:
    """Why, in a clause; Ray's own text begins with a traceback."""
    cause = getattr(error, "cause", None) or error
    lines = [line.strip() for line in str(cause).splitlines() if line.strip()]
    return (lines[-1] if lines else type(cause).__name__)[:300].rstrip(".")
