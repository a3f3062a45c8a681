"""Lookup tables as files: CSV, and the two one-dimensional formats that OpenColorIO reads.

| ending | content | numbers |
| --- | --- | --- |
| `.csv` | `code,entry` for each code; comments `# in_bits: 8` and `# out_bits: 8` | whole |
| `.cube` | `LUT_1D_SIZE`, then red, green and blue of each entry (Adobe and Resolve, 2013) | 0 to 1 |
| `.spi1d` | `Version 1`, `From`, `Length`, `Components`, then the entries in braces (Sony Imageworks) | 0 to 1 |

A `.cube` and a `.spi1d` hold entries divided by the largest code, with ten digits, and say their bits in a comment or,
where that is missing (a table from elsewhere), are read with the bits that are asked for. A table with three different
columns is refused: it is no single curve.

Errors: a file that is damaged is a `DataError` with its line; an ending of another kind is a `UsageError`.

Example:
    >>> import tempfile, pathlib
    >>> from illuminant.display.gamma.lookup_table import correction_table
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "table.cube"
    >>> write_table(correction_table(2.2), path)
    >>> read_table(path).entries[:5].tolist()
    [0, 21, 28, 34, 39]
"""

from __future__ import annotations

import math
import os
import re
from pathlib import Path

from illuminant import output
from illuminant.display.gamma.lookup_table import LookupTable, code_type, top_code
from illuminant.display.table_text import text_of
from illuminant.errors import DataError, UsageError

__all__ = ["FORMATS", "check_table_path", "read_table", "write_table"]

FORMATS = (".csv", ".cube", ".spi1d")


def check_table_path(path: str | os.PathLike[str]) -> Path:
    """The path, when a table can be written there.

    Raises:
        UsageError: another ending.
        ImageError, MachineError: as `illuminant.output.check`.
    """
    return output.check(_known(path))


def _known(path: str | os.PathLike[str]) -> Path:
    path = Path(path)
    if path.suffix.casefold() not in FORMATS:
        raise UsageError(
            f"{path}: a table is a file that ends in {', '.join(FORMATS[:-1])} or {FORMATS[-1]}."
        )
    return path


def write_table(table: LookupTable, path: str | os.PathLike[str]) -> None:
    """Write a table, whole or not at all, in the format of the ending.

    Raises:
        UsageError: another ending than `FORMATS`.
        ImageError, MachineError: the path cannot be written.
    """
    path = _known(path)
    kind = path.suffix.casefold()
    about = (f"in_bits: {table.in_bits}", f"out_bits: {table.out_bits}")
    size = len(table.entries)
    values = [f"{value:.10g}" for value in table.outputs.tolist()]
    if kind == ".csv":
        rows = [f"{code},{entry}" for code, entry in enumerate(table.entries.tolist())]
        lines = [f"# name: {table.name}", *(f"# {fact}" for fact in about), "code,entry", *rows]
    elif kind == ".cube":
        head = [f'TITLE "{table.name}"', *(f"# {fact}" for fact in about), f"LUT_1D_SIZE {size}"]
        lines = [*head, *(f"{value} {value} {value}" for value in values)]
    else:
        head = ["Version 1", "From 0.0 1.0", f"Length {size}", "Components 1", "{"]
        # Comments stand behind the braces, as readers take nothing but numbers between them.
        lines = [*head, *(f"    {value}" for value in values), "}", *(f"# {fact}" for fact in about)]
    output.write_bytes(path, ("\n".join(lines) + "\n").encode())


def read_table(path: str | os.PathLike[str], *, out_bits: int | None = None) -> LookupTable:
    """Read a table that was written here or elsewhere.

    Args:
        path: a file of `FORMATS`.
        out_bits: bits of the entries of a `.cube` or `.spi1d` that does not say them; default 16.

    Raises:
        UsageError: another ending.
        DataError: the file is not there or damaged, or holds no single curve of 2^n entries.
    """
    import numpy as np

    path = _known(path)
    text = text_of(path)
    facts = {key: value.strip() for key, value in re.findall(r"^#\s*(\w+):(.*)$", text, re.MULTILINE)}
    if title := re.search(r'^TITLE\s+"([^"]*)"', text, re.MULTILINE):
        facts["name"] = title[1]
    rows = _rows(path, text)
    in_bits = len(rows).bit_length() - 1
    if not rows or len(rows) != 1 << in_bits or not 1 <= in_bits <= 16:
        raise DataError(f"The table has {len(rows)} entries, expected a power of 2 up to 65536.", str(path))
    bits = _bits(path, facts.get("out_bits"), out_bits or 16)
    top = top_code(bits)
    scale = 1 if path.suffix.casefold() == ".csv" else top
    entries = []
    for line, value in rows:
        code = value * scale
        if not -0.5 < code < top + 0.5 or (scale == 1 and code != int(code)):
            raise DataError(f"{value:g} is no entry of {bits} bits.", str(path), line)
        entries.append(math.floor(code + 0.5))
    name = facts.get("name") or path.stem
    return LookupTable(np.array(entries, code_type(bits)), in_bits, bits, name)


def _bits(path: Path, found: str | None, default: int) -> int:
    """The bits that a comment states, or the default."""
    try:
        bits = int(found) if found is not None else default
        top_code(bits)
    except (ValueError, UsageError) as error:
        raise DataError(f"out_bits: expected 1 to 16, not {found}.", str(path)) from error
    return bits


def _rows(path: Path, text: str) -> list[tuple[int, float]]:
    """Line and number of each entry."""
    csv = path.suffix.casefold() == ".csv"
    rows: list[tuple[int, float]] = []
    size: int | None = None
    for line, content in enumerate(text.splitlines(), 1):
        words = content.replace(",", " ").split()
        if not words or words[0].startswith("#") or words == ["code", "entry"]:
            continue
        if re.match(r"[A-Za-z_{}]", words[0]) and words[0].casefold() not in ("nan", "inf"):
            if words[0] in ("LUT_1D_SIZE", "Length"):
                size = int(words[1]) if len(words) == 2 and words[1].isdigit() else None
            if words[0] == "LUT_3D_SIZE":
                raise DataError("This is a table of three dimensions, expected one.", str(path), line)
            if words[0] in ("From", "DOMAIN_MIN", "DOMAIN_MAX"):
                _check_domain(path, line, words)
            continue
        try:
            numbers = [float(word) for word in words]
        except ValueError:
            raise DataError(f"{content.strip()[:40]!r} is no row of numbers.", str(path), line) from None
        if csv and (len(numbers) != 2 or numbers[0] != len(rows)):
            raise DataError(f"Expected code {len(rows)} and its entry.", str(path), line)
        if not csv and (len(numbers) not in (1, 3) or max(numbers) - min(numbers) > 1e-9):
            raise DataError("Expected one number, or the same number three times.", str(path), line)
        if not math.isfinite(numbers[-1]):
            raise DataError(f"{numbers[-1]} is no entry.", str(path), line)
        rows.append((line, numbers[-1]))
    if not csv and size != len(rows):
        raise DataError(f"The table states {size} entries and has {len(rows)}.", str(path))
    return rows


def _check_domain(path: Path, line: int, words: list[str]) -> None:
    """Refuse a table whose first and last entry are not for 0 and 1."""
    wanted = {"From": {"0", "1"}, "DOMAIN_MIN": {"0"}, "DOMAIN_MAX": {"1"}}[words[0]]
    try:
        found = {f"{float(word):g}" for word in words[1:]}
    except ValueError:
        found = set()
    if found != wanted:
        raise DataError("Expected a table over 0 to 1.", str(path), line)
