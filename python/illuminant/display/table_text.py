"""Small tables as text, of which readings, records and lookup tables are made: a file's text, and its rows of cells.

A row is cells with commas between them; `#` begins a comment, blank lines are passed over, and so is a byte-order mark.
What the cells mean is the matter of who reads them.

Errors: `DataError` with the file.

Example:
    >>> list(rows("# a monitor\\ncode, luminance\\n\\n0, 0.06  # dark\\n"))
    [(2, ['code', 'luminance']), (4, ['0', '0.06'])]
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from illuminant import sources
from illuminant.errors import DataError
from illuminant.sources import SourceError

__all__ = ["rows", "text_of"]

MAX_BYTES = 10_000_000


def text_of(path: str | os.PathLike[str], what: str = "The file") -> str:
    """The text of a file in UTF-8.

    Args:
        path: of the file.
        what: how messages call it, such as "The record".

    Raises:
        DataError: there is no such file, it cannot be read, is no text, or is larger than 10 MB.
    """
    path = Path(path)
    try:
        return sources.read(path, MAX_BYTES).decode("utf-8-sig")
    except SourceError as error:
        raise DataError(f"{what} cannot be read: {error.clause}.", str(path)) from None
    except UnicodeDecodeError as error:
        raise DataError(f"{what} cannot be read: the file is not text in UTF-8.", str(path)) from error


def rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Number and cells of each line that has any."""
    for line, content in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in content.partition("#")[0].split(",")]
        if cells != [""]:
            yield line, cells
