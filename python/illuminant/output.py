"""Writing a file whole or not at all.

A file is written under another name in the same folder and with the same extension (some encoders choose the
format by it), flushed to the disk, and then renamed, which replaces an older file in one step. Whatever goes
wrong in between, the older file is still there and nothing half-written remains. Where the process itself is killed,
its `.NAME.illuminant-XXXXXXXX.EXT` stays until the next one that writes, or is about to write, the same file: who
writes holds a lock on it (flock), so what nobody has locked is nobody's.

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
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from illuminant.errors import Error, ImageError, MachineError

__all__ = ["check", "write", "write_bytes"]

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
    _remove_abandoned(target)
    handle, place = _temporary(target)
    os.close(handle)
    place.unlink(missing_ok=True)
    return path


def _target(path: Path) -> Path:
    """The file itself: a link is kept, and what it points to is replaced."""
    return path.resolve() if path.is_symlink() else path


def _prefix(path: Path) -> str:
    return f".{path.stem[:100]}.illuminant-"


def _temporary(path: Path) -> tuple[int, Path]:
    """A new file beside the path, and a handle that has it locked until it is closed."""
    handle, name = tempfile.mkstemp(prefix=_prefix(path), suffix=path.suffix, dir=path.parent)
    with suppress(OSError):  # not every file system has locks
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return handle, Path(name)


def _remove_abandoned(path: Path) -> None:
    """Remove what killed processes have left of this file."""
    abandoned = re.compile(rf"{re.escape(_prefix(path))}\w{{8}}{re.escape(path.suffix)}")
    with suppress(OSError), os.scandir(path.parent) as entries:
        names = [entry.path for entry in entries if abandoned.fullmatch(entry.name)]
        for name in names:
            with suppress(OSError):
                handle = os.open(name, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
                try:
                    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    os.unlink(name)
                finally:
                    os.close(handle)


def _permissions(path: Path) -> int:
    """Mode of the file that is replaced, or what the process's umask gives a new one."""
    try:
        return path.stat().st_mode & 0o7777
    except OSError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask


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
    try:
        handle, place = _temporary(target)
        try:
            encode(place)
            os.chmod(place, _permissions(target))
            _flush(place)
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
