"""What this machine has to offer: processors that may be used, memory that is free, memory that was used.

Example:
    >>> cores() >= 1 and peak_memory() > 0
    True
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from illuminant.errors import MachineError, UsageError

__all__ = [
    "amount",
    "check_file",
    "cores",
    "give_back",
    "limited_to",
    "memory",
    "memory_available",
    "peak_memory",
    "refuse",
    "resident",
    "size",
]

_limit: ContextVar[int | None] = ContextVar("memory limit", default=None)
"""Bytes that this process shall not exceed in all."""

_GROUP = Path("/sys/fs/cgroup")

_UNITS = {"": 1, "B": 1, "KB": 10**3, "MB": 10**6, "GB": 10**9, "TB": 10**12}
_UNITS |= {"K": 2**10, "M": 2**20, "G": 2**30, "KIB": 2**10, "MIB": 2**20, "GIB": 2**30, "TIB": 2**40}


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
        text = (_GROUP / name).read_text(encoding="ascii").strip()
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
    """Bytes of memory that can still be had without swapping; None where that cannot be known.

    Within `limited_to` no more than what is left of that limit.
    """
    known = [free for free in (_free(), _left()) if free is not None]
    return min(known) if known else None


def _free() -> int | None:
    known = [one for one in (_meminfo("MemAvailable"), _address_space()) if one is not None]
    limit, used = _group("memory.max"), _group("memory.current")
    if limit is not None and used is not None:
        # Files that were read lately are counted as used, and make room when it is asked for.
        known.append(max(0, limit - max(0, used - _given_up())))
    return min(known) if known else None


def _given_up() -> int:
    """Bytes of the control group that the system takes back by itself: pages of files that nobody uses."""
    try:
        lines = (_GROUP / "memory.stat").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0
    words = (line.split() for line in lines)
    return next((int(word[1]) for word in words if len(word) == 2 and word[0] == "inactive_file"), 0)


def _left() -> int | None:
    """What is left of the limit that was set; None where none was."""
    limit = _limit.get()
    return None if limit is None else max(0, limit - resident())


def resident() -> int:
    """Bytes of memory that this process holds now (resident set)."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except OSError:
        return peak_memory()
    import resource

    return pages * resource.getpagesize()


@contextmanager
def limited_to(limit: int | str | None) -> Iterator[None]:
    """Count only so much memory as free as keeps this process below a limit.

    Args:
        limit: bytes, or text such as "4GB"; None sets none (one that is set already stays).

    Raises:
        UsageError: it is no amount of memory.

    Example:
        >>> with limited_to("1TB"), limited_to("10MB"):      # this process has more already
        ...     memory_available()
        0
    """
    if limit is None:
        yield
        return
    known = _limit.get()
    wanted = amount(limit)
    token = _limit.set(wanted if known is None else min(known, wanted))
    try:
        yield
    finally:
        _limit.reset(token)


def amount(limit: int | str) -> int:
    """An amount of memory as it is written for `--memory-limit`, in bytes.

    Raises:
        UsageError: it is none, or less than 1 MB.

    Example:
        >>> amount("4GB"), amount("1.5 GiB"), amount("500m"), amount(10**9)
        (4000000000, 1610612736, 524288000, 1000000000)
    """
    match = re.fullmatch(r"([0-9]{1,18}(?:\.[0-9]{1,9})?)\s*([A-Za-z]{0,3})", str(limit).strip())
    unit = match and _UNITS.get(match[2].upper())
    count = int(float(match[1]) * unit) if match and unit else 0
    if not 10**6 <= count < 2**63:
        raise UsageError(f"--memory-limit {limit}: expected an amount of memory, such as 4GB or 500MB.")
    return count


def refuse(what: str, needed: int, advice: str = "") -> None:
    """Refuse what does not fit into the memory that may be used.

    Args:
        what: subject of the sentence.
        needed: bytes that it takes beside what this process holds.
        advice: what to do about it.

    Raises:
        MachineError: one sentence with both amounts.
    """
    free, left = memory_available(), _left()
    if free is None or needed <= free:
        return
    # The C library keeps what an earlier render has freed, and the system counts it as used.
    give_back()
    free, left = memory_available(), _left()
    if free is None or needed <= free:
        return
    end = f": {advice}." if advice else "."
    if left is not None and left <= free:
        held, limit = resident(), _limit.get() or 0
        raise MachineError(
            f"{what} needs about {size(needed)} of memory beside the {size(held)} in use, and --memory-limit is "
            f"{size(limit)}{end}"
        )
    raise MachineError(f"{what} needs about {size(needed)} of memory, and {size(free)} are free{end}")


def give_back() -> None:
    """Give memory that was freed back to the system, if the C library can (`malloc_trim` of glibc)."""
    import ctypes
    import gc

    gc.collect()
    with suppress(OSError, TypeError):
        library = ctypes.CDLL(None)
        if hasattr(library, "malloc_trim"):
            library.malloc_trim(0)


def peak_memory() -> int:
    """Largest number of bytes of memory that this process has held so far (resident set)."""
    import resource

    # What `getrusage` says begins, on Linux, with what the process held that started this one.
    with suppress(OSError, ValueError, IndexError):
        return 1024 * int(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0])

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
    refuse(os.fspath(path), needed)


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
