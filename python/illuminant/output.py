"""Writing a file whole or not at all.

A file is written under another name in the same folder and with the same extension (some encoders choose the
format by it), flushed to the disk, and then renamed, which replaces an older file in one step. Whatever goes
wrong in between, the older file is still there and nothing half-written remains. Where the process itself is killed,
its `.NAME.illuminant-XXXXXXXX.EXT` stays until the next one that writes the same file. Who writes holds a lock on it,
so what nobody has locked is nobody's.

Errors: a path that cannot be an output (no such folder, a folder itself, no permission) is an `ImageError`,
since another path helps; a full or failing disk is a `MachineError`.

Example:
    >>> import tempfile, pathlib
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> write_bytes(folder / "a.txt", b"whole")
    >>> (folder / "a.txt").read_bytes()
    b'whole'
"""

from __future__ import annotations

import errno
import fcntl
import os
import re
import struct
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from illuminant.errors import Error, ImageError, MachineError

__all__ = ["LONGEST_NAME", "check", "write", "write_bytes"]

LONGEST_NAME = 255
"""Bytes of the longest name of a file that Linux knows."""

_MARK = ".illuminant-"
_RANDOM = 8
"""Letters that `tempfile.mkstemp` adds."""

# Another path would meet the same trouble: the disk is full, over quota, failing, or refuses files of this size.
_MACHINE = {errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG, errno.ENOMEM, errno.EMFILE, errno.ENFILE}


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower() if error.errno else str(error)


def failure(path: Path, error: OSError) -> Error:
    """The error to raise for an operating-system error met while writing `path`."""
    kind = MachineError if error.errno in _MACHINE else ImageError
    name = str(path)
    if len(name) > 300:
        name = f"{name[:40]}...{name[-40:]}"
    return kind(f"{name} cannot be written: {_reason(error)}.")


def check(path: str | os.PathLike[str]) -> Path:
    """Refuse an output that cannot be written, before the work whose result it shall hold.

    Args:
        path: the file to be written later; it need not exist.

    Returns:
        The path.

    Raises:
        ImageError: its folder does not exist or is not writable, or it is a folder itself.
        MachineError: the disk has no room for even an empty file.
    """
    path = Path(path)
    try:
        return _checked(path)
    except OSError as error:
        if isinstance(error, Error):
            raise
        raise failure(path, error) from error


def _checked(path: Path) -> Path:
    if path.is_dir():
        raise ImageError(f"{path} cannot be written: it is a folder, so name a file in it.")
    if path.exists() and not path.is_file():
        raise ImageError(f"{path} cannot be written: it is not an ordinary file.")
    target = _target(path)
    if not target.parent.is_dir():
        raise ImageError(f"{path} cannot be written: there is no folder {target.parent}.")
    handle, place = _temporary(target)
    os.close(handle)
    place.unlink(missing_ok=True)
    return path


def _target(path: Path) -> Path:
    """The file itself: a link is kept, and what it points to is replaced."""
    if not path.is_symlink():
        return path
    try:
        return path.resolve()
    except RuntimeError:
        raise ImageError(f"{path} cannot be written: it is a link that leads back to itself.") from None


def _names(path: Path) -> tuple[str, str]:
    """How names of the temporary files of a path begin and end: as its own, as far as the file system has room."""
    suffix = path.suffix
    room = LONGEST_NAME - len(".") - len(_MARK) - _RANDOM - len(os.fsencode(suffix))
    if room < 0:
        suffix, room = "", room + len(os.fsencode(suffix))
    stem = path.stem
    while len(os.fsencode(stem)) > room:
        stem = stem[:-1]
    return f".{stem}{_MARK}", suffix


def _temporary(path: Path) -> tuple[int, Path]:
    """A new file beside the path, and a handle that has it locked until it is closed."""
    prefix, suffix = _names(path)
    while True:
        handle, name = tempfile.mkstemp(prefix=prefix, suffix=suffix, dir=path.parent)
        # Another process may take it for abandoned before it is locked.
        if _lock(handle) is not False and _is_there(handle, name):
            return handle, Path(name)
        os.close(handle)


def _lock(handle: int) -> bool | None:
    """Lock a file for this handle alone: False if another has it, None where the file system has no locks.

    The lock lies on a byte far beyond the end, since some network shares refuse to write what is locked, even to its
    owner; and belongs to the handle, not to the process, which may write the file with another thread.
    """
    one_byte = struct.pack("hhqqi4x", fcntl.F_WRLCK, os.SEEK_SET, 1 << 62, 1, 0)
    try:
        fcntl.fcntl(handle, fcntl.F_OFD_SETLK, one_byte)
    except OSError as error:
        return False if error.errno in (errno.EAGAIN, errno.EACCES) else None
    return True


def _is_there(handle: int, name: str) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(name))
    except FileNotFoundError:
        return False


def _remove_abandoned(path: Path) -> None:
    """Remove what killed processes have left of this file."""
    prefix, suffix = _names(path)
    abandoned = re.compile(rf"{re.escape(prefix)}\w{{{_RANDOM}}}{re.escape(suffix)}")
    with suppress(OSError), os.scandir(path.parent) as entries:
        names = [entry.path for entry in entries if abandoned.fullmatch(entry.name)]
        for name in names:
            with suppress(OSError):
                handle = os.open(name, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
                try:
                    if _lock(handle):
                        os.unlink(name)
                finally:
                    os.close(handle)


def _permissions(path: Path) -> int:
    """Mode of the file that is replaced, or what the process's umask gives a new one."""
    try:
        return path.stat().st_mode & 0o7777
    except OSError:
        return 0o666 & ~_umask()


def _umask() -> int:
    try:
        # To ask for it by `os.umask` is to change it, for all threads.
        with open("/proc/self/status", encoding="ascii", errors="replace") as status:
            return next(int(line.split()[1], 8) for line in status if line.startswith("Umask:"))
    except (OSError, StopIteration):
        mask = os.umask(0)
        os.umask(mask)
        return mask


def write(path: str | os.PathLike[str], encode: Callable[[Path], None]) -> None:
    """Write a file atomically.

    Args:
        path: the file to make or to replace.
        encode: writes everything to the path it is given and raises when it cannot; called once.

    Raises:
        ImageError: the path cannot be an output.
        MachineError: the disk is full or fails. In both cases `path` is as it was before.
    """
    path = check(path)
    target = _target(path)
    _remove_abandoned(target)
    try:
        handle, place = _temporary(target)
        try:
            encode(place)
            _flush(place)
            os.chmod(place, _permissions(target))
            os.replace(place, target)
        finally:
            place.unlink(missing_ok=True)
            os.close(handle)
        # The new name, too, is on the disk only now: a power cut would bring back the old file. Not every folder can
        # be flushed, and the file is there.
        with suppress(OSError):
            _flush(target.parent)
    except Error:
        raise
    except OSError as error:
        raise failure(path, error) from error


def _flush(path: Path) -> None:
    """Wait until a file or a folder is on the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def write_bytes(path: str | os.PathLike[str], content: bytes) -> None:
    """Write `content` atomically; errors as for `write`.

    Example:
        >>> write_bytes("no/a.png", b"")
        Traceback (most recent call last):
        illuminant.errors.ImageError: no/a.png cannot be written: there is no folder no.
    """
    write(path, lambda temporary: _store(temporary, content))


def _store(path: Path, content: bytes) -> None:
    with open(path, "wb") as file:
        file.write(content)
