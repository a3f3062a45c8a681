"""What this machine has to offer: processors that may be used, memory that is free, memory that was used.

Example:
    >>> cores() >= 1 and peak_memory() > 0
    True
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from illuminant.errors import MachineError

__all__ = ["check_file", "cores", "memory", "memory_available", "peak_memory", "size"]


def cores() -> int:
    """Number of processors that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def _meminfo(key: str) -> int | None:
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith(f"{key}:")), None)


def _group(name: str) -> int | None:
    """A number of the control group (containers have their own limit); None where there is none, or no limit."""
    try:
        text = Path("/sys/fs/cgroup", name).read_text(encoding="ascii").strip()
    except OSError:
        return None
    return int(text) if text.isdigit() else None


def _address_space() -> int | None:
    """Bytes that this process may still ask for under its own limit (`ulimit -v`); None where there is none."""
    import resource

    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    if limit == resource.RLIM_INFINITY:
        return None
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except OSError:
        return limit
    return max(0, limit - pages * resource.getpagesize())


def memory() -> int | None:
    """Bytes of memory that the system, or the container, has in all; None where that cannot be known."""
    known = [amount for amount in (_meminfo("MemTotal"), _group("memory.max")) if amount is not None]
    return min(known) if known else None


def memory_available() -> int | None:
    """Bytes of memory that can still be had without swapping; None where that cannot be known."""
    known = [amount for amount in (_meminfo("MemAvailable"), _address_space()) if amount is not None]
    limit, used = _group("memory.max"), _group("memory.current")
    if limit is not None and used is not None:
        known.append(max(0, limit - used))
    return min(known) if known else None


def peak_memory() -> int:
    """Largest number of bytes of memory that this process has held so far (resident set)."""
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024


def check_file(path: str | os.PathLike[str], needed: int) -> None:
    """Refuse a file whose contents do not fit into the memory that is free.

    Args:
        path: of the file.
        needed: bytes that its contents take.

    Raises:
        MachineError: one sentence with both amounts.
    """
    free = memory_available()
    if free is not None and needed > free:
        raise MachineError(f"{path} needs about {size(needed)} of memory, and {size(free)} are free.")


def size(count: float) -> str:
    """A number of bytes for people.

    Example:
        >>> size(512), size(3.2e6), size(24e12)
        ('512 B', '3.2 MB', '24 TB')
    """
    units = ["B", "kB", "MB", "GB", "TB", "PB", "EB"]
    while count >= 999.5 and len(units) > 1:
        count /= 1000
        del units[0]
    unit = units[0]
    return f"{count:.0f} {unit}" if count >= 9.95 or unit == "B" else f"{count:.1f} {unit}"
