"""The cluster that a farm works on: Ray, started here or somewhere else.

Ray is told to send no usage statistics and to start no dashboard. What it starts listens on all interfaces of the
machine all the same, and who has its token (`~/.ray/auth_token`, which Ray writes) can run code: see docs/security.md.

Example:
    >>> with cluster(workers=2) as ray:                                    # doctest: +SKIP
    ...     ray.get(ray.remote(len).remote("abc"))
    3
"""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from illuminant import machine
from illuminant.errors import MachineError, UsageError

__all__ = ["OBJECT_STORE", "cluster"]

OBJECT_STORE = 256_000_000
"""Bytes of the object store of a cluster started here: scenes and results on their way."""

PATIENCE = 5.0
"""Seconds in which a cluster at an address must answer."""

_MISSING = "The farm needs Ray: install it with `pip install illuminant[farm]`."


@contextmanager
def cluster(workers: int | None = None, address: str | None = None, threads: int = 1) -> Iterator[Any]:
    """Ray, connected; what was started here is stopped at the end.

    Args:
        workers: how many a cluster started here has; default as many as this machine has processors for.
        address: of a cluster that runs already, such as `ray://host:10001`, `host:6379` or `auto`.
        threads: of a worker.

    Yields:
        The module `ray`.

    Raises:
        UsageError: both are given, or the number cannot be.
        MachineError: Ray is not installed, does not start, or is not found at the address.
    """
    if address is not None and workers is not None:
        raise UsageError("--workers: is for a cluster that is started here; one at --address has its own.")
    if workers is not None and not 1 <= workers <= 1024:
        raise UsageError(f"--workers {workers}: expected a whole number from 1 to 1024.")
    if not 1 <= threads <= 4096:
        raise UsageError(f"--threads {threads}: a worker has 1 to 4096 threads.")
    # Ray reads these when it is imported.
    for name, value in _QUIET.items():
        os.environ.setdefault(name, value)
    try:
        import ray
    except ImportError as error:
        raise MachineError(_MISSING) from error
    if ray.is_initialized():
        if workers is not None or address is not None:
            raise UsageError(
                "This process is connected to a Ray cluster already: leave workers and address out."
            )
        yield ray  # the caller's, which stays
        return
    if address is not None:
        _reach(address)
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR"}
    folder = None
    if address is None:
        # Ray leaves its folder behind. Its sockets lie in it, and their names must be short.
        folder = tempfile.mkdtemp(prefix="ray-", dir="/tmp" if os.path.isdir("/tmp") else None)
        options |= {
            "_temp_dir": folder,
            "address": "local",
            "num_cpus": threads * (workers or max(1, machine.cores() // threads)),
            "num_gpus": 0,
            "include_dashboard": False,
            "object_store_memory": OBJECT_STORE,
        }
    else:
        options |= {"address": address}
    # Ray puts its own way of ending in the place of the caller's, who has work to save.
    mine = threading.current_thread() is threading.main_thread()
    ended_by = signal.getsignal(signal.SIGTERM)
    # The token that Ray writes is for this user alone.
    mask = os.umask(0o077)
    try:
        ray.init(**options)
    except Exception as error:  # Ray raises all kinds
        where = "be started" if address is None else f"be reached at {address}"
        reason = " ".join(str(error).split())[:300].rstrip(".")
        _remove(folder)
        raise MachineError(f"The Ray cluster cannot {where}: {reason}.") from error
    finally:
        os.umask(mask)
        if mine and ended_by is not None:
            signal.signal(signal.SIGTERM, ended_by)
    try:
        yield ray
    finally:
        ray.shutdown()
        _remove(folder)


def _remove(folder: str | None) -> None:
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)


def _reach(address: str) -> None:
    """Find out at once whether anything answers at an address; Ray would go on trying for minutes."""
    import socket

    host, _, port = address.removeprefix("ray://").rpartition(":")
    if not port.isdigit():
        return  # `auto`, or another word of Ray's
    try:
        socket.create_connection((host.strip("[]"), int(port)), PATIENCE).close()
    except (OSError, OverflowError) as error:
        reason = str(getattr(error, "strerror", None) or error).lower()
        raise MachineError(f"The Ray cluster cannot be reached at {address}: {reason}.") from error


_QUIET = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",
    "RAY_DEDUP_LOGS": "0",
    "RAY_LOG_TO_DRIVER": "0",
}
