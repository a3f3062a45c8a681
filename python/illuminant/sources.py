"""Files that a scene or a person names: what may be opened, how much of it is read, and where a scene may look.

Whoever sends a scene, an image or a table chooses names and contents. So every reader asks here for its bytes:

- only a regular file is opened. A pipe would wait for ever, a device gives bytes without end, a folder none: each is
  refused without being opened, and so is a loop of symbolic links;
- a file larger than the limit of its kind is refused before it is read, and so is one that does not fit into memory;
- the files that a scene file names lie in its own folder or below, once `..` and symbolic links are followed
  (`located`). What lies elsewhere is read only where a person allows it (`--allow-outside`): a scene from somebody
  else shall not copy `~/.ssh` into an image, nor tell which files a machine has.

A file that another user exchanges between these looks and the reading is not guarded against: whoever can write in the
folder of a scene is trusted with it.

Example:
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "a.txt"
    >>> _ = path.write_text("1 2 3")
    >>> read(path, 100)
    b'1 2 3'
    >>> read(path, 4)
    Traceback (most recent call last):
    illuminant.sources.SourceError: ...a.txt: is larger than 4 bytes
"""

from __future__ import annotations

import errno
import io
import os
import stat
from pathlib import Path
from typing import IO, Literal

from illuminant import machine
from illuminant.errors import DataError, MachineError

__all__ = ["Kind", "SourceError", "amount", "check", "drained", "is_outside", "located", "opened", "read"]

Kind = Literal["missing", "folder", "special", "loop", "outside", "large", "unreadable"]
"""Why a file is refused."""

A_PIECE = 1_000_000

WORTH_A_LOOK = 16_000_000
"""Bytes from which on memory is looked at before a file is read."""

_SPECIAL = (
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


class SourceError(DataError):
    """A named file is not opened.

    Args:
        message: what is wrong, as the rest of a sentence whose subject is the file.
        file: path of the file.
        kind: why.
        clause: the same after "it cannot be read: ".

    Attributes:
        kind: why.
        clause: what is wrong, as a clause of its own.
    """

    def __init__(self, message: str, file: str, kind: Kind, clause: str = "") -> None:
        super().__init__(message, file)
        self.kind = kind
        self.clause = clause or (message if message.startswith("there ") else f"it {message}")


def amount(count: int) -> str:
    """A limit in bytes, for people, exactly.

    Example:
        >>> amount(4), amount(10_000_000), amount(4_000_000_000)
        ('4 bytes', '10 MB', '4 GB')
    """
    for unit, name in ((10**9, "GB"), (10**6, "MB")):
        if count >= unit and count % unit == 0:
            return f"{count // unit} {name}"
    return f"{count:,} bytes"


def _refusal(file: str, error: OSError | ValueError) -> SourceError:
    if isinstance(error, FileNotFoundError):
        return SourceError("there is no such file", file, "missing")
    if isinstance(error, OSError) and error.errno == errno.ELOOP:
        return SourceError("is a loop of symbolic links", file, "loop")
    reason = ((getattr(error, "strerror", None) or str(error)) or "unknown reason").lower()
    return SourceError(f"cannot be read ({reason})", file, "unreadable", reason)


def _check_kind(mode: int, file: str) -> None:
    if stat.S_ISREG(mode):
        return
    if stat.S_ISDIR(mode):
        raise SourceError("is a folder", file, "folder")
    what = next((name for is_one, name in _SPECIAL if is_one(mode)), "no regular file")
    raise SourceError(f"is {what}, and only regular files are read", file, "special")


def _check_size(size: int, most: int, file: str) -> None:
    if size > most:
        raise SourceError(f"is larger than {amount(most)}", file, "large")


def check(path: str | os.PathLike[str], most: int) -> int:
    """Refuse what is no regular file of at most so many bytes, for readers that open their files themselves.

    Returns:
        The size, bytes.

    Raises:
        SourceError: which it is.
    """
    file = os.fspath(path)
    try:
        about = os.stat(path)
    except (OSError, ValueError) as error:
        raise _refusal(file, error) from None
    _check_kind(about.st_mode, file)
    _check_size(about.st_size, most, file)
    return about.st_size


def opened(path: str | os.PathLike[str], most: int) -> IO[bytes]:
    """A regular file of at most so many bytes, open for reading; close it.

    Raises:
        SourceError: it is none, or cannot be opened.
    """
    check(path, most)
    file = os.fspath(path)
    try:
        # Should it be a pipe by now, this does not wait for its writer.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except (OSError, ValueError) as error:
        raise _refusal(file, error) from None
    try:
        _check_kind(os.fstat(handle).st_mode, file)
        return os.fdopen(handle, "rb")
    except BaseException:
        os.close(handle)
        raise


def read(path: str | os.PathLike[str], most: int) -> bytes:
    """All bytes of a regular file.

    Args:
        path: of the file.
        most: bytes that a file of its kind has at most.

    Raises:
        SourceError: it is no regular file, cannot be read, or is larger than that.
        MachineError: it does not fit into the memory that is free.
    """
    file = os.fspath(path)
    try:
        with opened(path, most) as stream:
            if (size := os.fstat(stream.fileno()).st_size) >= WORTH_A_LOOK:
                machine.check_file(file, size)
            # A file may grow while it is read, and those of /proc state no size.
            content = drained(stream, most + 1, size + 1, file)
    except OSError as error:
        if isinstance(error, MachineError):
            raise
        raise _refusal(file, error) from None
    if len(content) > most:
        raise SourceError(f"is larger than {amount(most)}", file, "large")
    return content


def drained(
    stream: IO[bytes] | io.BufferedIOBase, most: int, piece: int = 0, name: str = "The file"
) -> bytes:
    """What a stream still holds, at most so many bytes.

    It is read in pieces, since a reader makes room at once for all that it is asked for. Memory is looked at again and
    again as they become more: a small file that is unpacked may have no end.

    Args:
        stream: is read.
        most: bytes.
        piece: how much is asked for at first; from then on a megabyte at a time.
        name: of the file, for the sentence on memory.

    Raises:
        MachineError: it does not fit into the memory that is free.

    Example:
        >>> import io
        >>> drained(io.BytesIO(b"four"), 3)
        b'fou'
    """
    first = stream.read(min(most, max(piece, A_PIECE)))
    found = stream.read(min(most - len(first), A_PIECE)) if first and len(first) < most else b""
    if not found:
        return first
    content = bytearray(first)
    del first
    looked = len(content)
    while found:
        content += found
        if len(content) - looked >= WORTH_A_LOOK:
            looked = len(content)
            # As it grows it may be copied, and once more when it is whole.
            machine.check_file(name, looked)
        found = stream.read(min(most - len(content), A_PIECE)) if len(content) < most else b""
    return bytes(content)


def is_outside(error: Exception) -> bool:
    """Whether a file was refused only because of where it lies."""
    return isinstance(error, SourceError) and error.kind == "outside"


def located(
    name: str | os.PathLike[str], folder: str | os.PathLike[str], allow_outside: bool = False
) -> Path:
    """Where a file is that a scene file names.

    Args:
        name: as it is written: relative to the folder, or absolute.
        folder: of the scene file.
        allow_outside: whether it may lie outside that folder.

    Returns:
        The path; whether there is a file is not looked at.

    Raises:
        SourceError: it lies outside the folder of the scene, and not among the data of this package.

    Example:
        >>> located("meshes/bunny.ply", "scenes").as_posix()
        'scenes/meshes/bunny.ply'
        >>> located("/etc/passwd", "scenes")
        Traceback (most recent call last):
        illuminant.sources.SourceError: /etc/passwd: lies outside the folder of the scene; ... give --allow-outside
    """
    path = Path(folder) / name
    if allow_outside:
        return path
    try:
        target = Path(os.path.realpath(path))
        homes = (Path(os.path.realpath(folder)), Path(__file__).resolve().with_name("data"))
    except (OSError, ValueError) as error:
        raise _refusal(str(path), error) from None
    if not any(target.is_relative_to(home) for home in homes):
        raise SourceError(
            "lies outside the folder of the scene; move it there, or trust the scene and give --allow-outside",
            os.fspath(name),
            "outside",
        )
    return path
