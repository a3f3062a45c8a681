"""NumPy's archives (`.npz`) from files that may be damaged or meant to do harm.

`numpy.load` believes what an archive says: a member of a few bytes may swell to gigabytes, and the header of an array
may state any shape. Here nothing is compressed (illuminant writes no other archives), each array has as many bytes as
its header states, and all together have no more than the file.

Example:
    >>> import io
    >>> import numpy as np
    >>> stream = io.BytesIO()
    >>> np.savez(stream, a=np.arange(3))
    >>> read(stream)["a"].tolist()
    [0, 1, 2]
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from typing import IO, TYPE_CHECKING

from illuminant import machine

if TYPE_CHECKING:
    import numpy as np

__all__ = ["MOST_MEMBERS", "array", "read"]

MOST_MEMBERS = 1_000_000
"""Arrays that an archive holds at most."""


def read(stream: IO[bytes], name: str = "") -> dict[str, np.ndarray]:
    """The arrays of an archive.

    Args:
        stream: the file, which can seek.
        name: of the file, for the sentence on memory.

    Raises:
        ValueError: it is no such archive, is damaged, or is compressed.
        MachineError: it does not fit into the memory that is free.
    """
    try:
        size = stream.seek(0, 2)
        stream.seek(0)
        with zipfile.ZipFile(stream) as archive:
            members = archive.infolist()
            if len(members) > MOST_MEMBERS:
                raise ValueError(f"holds {len(members)} arrays; at most {MOST_MEMBERS} are read")
            if any(member.compress_type != zipfile.ZIP_STORED or member.flag_bits & 1 for member in members):
                raise ValueError("holds compressed arrays")
            # Members may lie on one another: many names for the same bytes.
            if sum(member.file_size for member in members) > size:
                raise ValueError("states more bytes than it has")
            machine.check_file(name or "The archive", size)
            found = {}
            for member in members:
                with archive.open(member) as part:
                    found[member.filename.removesuffix(".npy")] = array(part, member.file_size)
            return found
    # `zipfile` raises RuntimeError, or a kind of it, for members that it cannot read.
    except (zipfile.BadZipFile, EOFError, RuntimeError, OverflowError) as error:
        raise ValueError(str(error) or "is damaged") from error


def array(
    stream: IO[bytes], size: int, of_shape: Callable[[tuple[int, ...]], object] | None = None
) -> np.ndarray:
    """One array of NumPy's format (`.npy`) that has so many bytes in all.

    Args:
        stream: is read.
        size: bytes in all.
        of_shape: called with the shape before the numbers are read; it may refuse it.

    Raises:
        ValueError: it is none, holds Python objects, or states another shape than it has numbers for.
    """
    import math
    import warnings
    from tokenize import TokenError

    import numpy as np
    from numpy.lib import format as npy

    version = npy.read_magic(stream)
    if version not in ((1, 0), (2, 0)):
        raise ValueError(f"has the version {version[0]}.{version[1]} of NumPy's format")
    read_header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that an array of Python 2 is slow to read
            shape, by_columns, kind = read_header(stream)
    except (SyntaxError, TokenError, TypeError, ValueError, MemoryError, RecursionError) as error:
        # The header is an expression of Python, and may be nested deeply or have lists as keys.
        raise ValueError("has a damaged header") from error
    if kind.hasobject:
        raise ValueError("holds Python objects")
    # NumPy takes a truth for a number here, and for none later.
    if any(isinstance(side, bool) for side in shape):
        raise ValueError("has a damaged header")
    needed = math.prod(shape) * kind.itemsize
    if any(side < 0 for side in shape) or needed > size:
        raise ValueError(f"states the shape {shape}, for which it is too short")
    if of_shape is not None:
        of_shape(shape)
    content = np.empty(needed, np.uint8)
    rest = content.data
    while rest:
        count = stream.readinto(rest)  # type: ignore[attr-defined]
        if not count:
            raise ValueError("is cut off")
        rest = rest[count:]
    return content.view(kind).reshape(shape, order="F" if by_columns else "C")
