"""The starter scene: a small room with comments on every key, to be changed into one's own.

Example:
    >>> import tempfile, pathlib
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "room.toml"
    >>> write_starter(path)                 # doctest: +SKIP
"""

from __future__ import annotations

import os
from pathlib import Path

from illuminant import output
from illuminant.errors import UsageError

__all__ = ["starter", "write_starter"]


def starter() -> str:
    """Text of the starter scene (TOML)."""
    return Path(__file__).with_name("data").joinpath("starter.toml").read_text(encoding="utf-8")


def write_starter(path: str | os.PathLike[str]) -> None:
    """Write the starter scene to a file that does not exist yet.

    Raises:
        UsageError: there is such a file already, or its extension is not `.toml`.
        ImageError, MachineError: it cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() != ".toml":
        raise UsageError(f"{path}: a scene file ends with .toml.")
    if path.exists():
        raise UsageError(f"{path} exists already, and a scene is never overwritten: choose another name.")
    output.write_bytes(path, starter().encode())
