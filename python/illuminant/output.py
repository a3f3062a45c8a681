"""Writing a file whole or not at all.

A file is written under another name in the same folder and with the same extension (some encoders choose the
format by it), flushed to the disk, and then renamed, which replaces an older file in one step. Whatever goes
wrong in between, the older file is still there and nothing half-written remains.

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
import os
import tempfile
from collections.abc import Callable
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
    if not path.parent.is_dir():
        raise ImageError(f"{path} cannot be written: there is no folder {path.parent}.")
    _remove(_temporary(path))
    return path


def _temporary(path: Path) -> Path:
    handle, name = tempfile.mkstemp(prefix=f".{path.stem[:100]}-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    return Path(name)


def _remove(path: Path) -> None:
    path.unlink(missing_ok=True)


def _permissions(path: Path) -> int:
    """Mode of the file that is replaced, or what the process's umask gives a new one."""
    try:
        return path.stat().st_mode & 0o7777
    except OSError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask


def write(
    path: str | os.PathLike[str], encode: Callable[[Path], None], temporary: Path | None = None
) -> None:
    """Write a file atomically.

    Args:
        path: the file to make or to replace.
        encode: writes everything to the path it is given and raises when it cannot; called once.
        temporary: where it is written first; default a new name in the same folder.

    Raises:
        ImageError: the path cannot be an output.
        MachineError: the disk is full or fails. In both cases `path` is as it was before.
    """
    path = check(path)
    # A link is kept, and what it points to is replaced.
    target = path.resolve() if path.is_symlink() else path
    try:
        temporary = temporary or _temporary(target)
        try:
            encode(temporary)
            os.chmod(temporary, _permissions(target))
            _flush(temporary)
            os.replace(temporary, target)
            # The new name, too, is on the disk only now: a power cut would bring back the old file, or none.
            _flush(target.parent)
        finally:
            _remove(temporary)
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
