"""Run-length encoded images of 24 bits and a matte, as animation houses kept them (book 5.1; after Wallace 1981).

A synthetic image has long runs of equal pixels, so a run is stored as a count and one pixel, and what does not repeat
as a count and its pixels. Nothing is lost. The header says what the numbers mean: primaries, white point, and whether
they are linear or corrected for a γ (code = value^(1/γ)), without which RGB is no specification of colour (book 5.1.1).
The matte is 8 bits of how much of a pixel is covered; a run is one of equal colour and equal matte.

The file, all numbers big-endian:

| bytes | what |
| --- | --- |
| 0–3 | `ILRL` |
| 4 | version, 1 |
| 5 | bytes of a pixel: 3 (RGB) or 4 (RGB and matte) |
| 6 | 0 for linear values, 1 for values corrected for γ |
| 7 | 0 |
| 8–15 | width and height, two unsigned integers of 4 bytes |
| 16–87 | x and y of red, green, blue and white, then γ (1 for linear values), nine numbers of 8 bytes (IEEE 754) |
| 88 on | how many records each scanline has, 4 bytes for each line, the topmost first |
| then | the records, one byte each: 128 + n − 1 for a run of n equal pixels, n − 1 for n pixels that differ (n ≤ 128) |
| last | the pixels of the records in their order: one for a run, n for a record that differs |

A record never crosses the end of its scanline. Wallace mixes counts and pixels; here they lie apart, so that the
file is encoded and decoded without a step for each record.

Limits: width and height up to 65,535, and 2^28 pixels. A record stands for 128 pixels at most, so a file can ask for no
more than that for each of its bytes, and is refused before anything is allocated when it asks for more.

Errors: a file that is no such image, ends too soon, or whose counts do not fill its lines is an `ImageError`; arrays of
another shape or type, and a header without meaning, are a `UsageError`.

Example:
    >>> import numpy as np
    >>> rgb = np.zeros((486, 512, 3), dtype=np.uint8)
    >>> ntsc = ((0.67, 0.33), (0.21, 0.71), (0.14, 0.08))
    >>> content = encode(rgb, primaries=ntsc, white=(0.3127, 0.329), gamma=2.2)
    >>> compression(content).unpacked, len(content)
    (746496, 9808)
    >>> bool((decode(content).rgb == rgb).all()), decode(content).gamma
    (True, 2.2)
"""

from __future__ import annotations

import math
import os
import struct
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant import output, sources
from illuminant.errors import ImageError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]

__all__ = [
    "FORMATS",
    "LARGEST_SIDE",
    "MOST_PIXELS",
    "Compression",
    "RunLengthImage",
    "compression",
    "decode",
    "encode",
    "read",
    "storage",
    "write",
]

LARGEST_SIDE = 65_535
"""Pixels of the longest width or height."""

MOST_PIXELS = 1 << 28
"""Pixels of the largest image."""

FORMATS = {"video": (512, 486), "wide video": (640, 486), "film": (1024, 1280)}
"""Width and height of the resolutions of the time (book 5.1)."""

_MAGIC = b"ILRL"
_VERSION = 1
_HEADER = struct.Struct(">4s4BII9d")
_LONGEST_RUN = 128
_RUN = 0x80

Chromaticities = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class RunLengthImage:
    """An image and what its numbers mean.

    Attributes:
        rgb: (h, w, 3), code values of 8 bits.
        matte: (h, w), how much of each pixel is covered, 255 for all of it; None when the file has none.
        primaries: x and y of red, green and blue.
        white: x and y of white.
        gamma: γ for which the values are corrected, code = value^(1/γ); None when they are linear.
    """

    rgb: Bytes
    matte: Bytes | None
    primaries: Chromaticities
    white: tuple[float, float]
    gamma: float | None


class Compression(NamedTuple):
    """What the encoding of an image saves.

    Attributes:
        unpacked: bytes of the pixels alone, without encoding.
        stored: bytes of the file, header and counts included.
        records: how many there are.
    """

    unpacked: int
    stored: int
    records: int

    @property
    def ratio(self) -> float:
        """Bytes before for each byte after."""
        return self.unpacked / self.stored

    @property
    def reduction(self) -> float:
        """Fraction that is saved; below 0 when the image has no runs."""
        return 1.0 - self.stored / self.unpacked


def storage(width: int, height: int, *, matte: bool = False, floating: bool = False) -> int:
    """Bytes that an image takes without encoding.

    Args:
        width, height: in pixels.
        matte: whether it has a matte beside RGB.
        floating: whether a number has the 4 bytes of a single, or one byte.

    Raises:
        UsageError: width or height is below 1.

    Example:
        >>> storage(512, 486), storage(512, 486, matte=True), storage(512, 486, floating=True)
        (746496, 995328, 2985984)
    """
    if width < 1 or height < 1:
        raise UsageError(f"An image has at least one pixel, not {width} x {height}.")
    return width * height * (4 if matte else 3) * (4 if floating else 1)


def encode(
    rgb: Bytes,
    matte: Bytes | None = None,
    *,
    primaries: Sequence[Sequence[float]],
    white: Sequence[float],
    gamma: float | None = None,
) -> bytes:
    """Encode an image.

    Args:
        rgb: (h, w, 3) of uint8.
        matte: (h, w) of uint8, or None.
        primaries: x and y of red, green and blue.
        white: x and y of white.
        gamma: γ for which the values are corrected; None for linear values.

    Raises:
        UsageError: an array has another shape or type, the image is empty or larger than the format holds, or a
            chromaticity or γ is not a number that means one.
    """
    import numpy as np

    rgb = np.asarray(rgb)
    if rgb.ndim != 3 or rgb.shape[2] != 3 or rgb.dtype != np.uint8:
        raise UsageError(f"The image should be uint8 of shape (h, w, 3), not {rgb.dtype} of {rgb.shape}.")
    height, width, _ = rgb.shape
    if trouble := _size_trouble(width, height):
        raise UsageError(f"The image {trouble}.")
    pixel = np.zeros((height, width, 4), dtype=np.uint8)
    pixel[..., :3] = rgb
    if matte is not None:
        matte = np.asarray(matte)
        if matte.shape != (height, width) or matte.dtype != np.uint8:
            wanted = f"uint8 of shape {(height, width)}"
            raise UsageError(f"The matte should be {wanted}, not {matte.dtype} of {matte.shape}.")
        pixel[..., 3] = matte
    try:
        numbers = [*(float(c) for pair in primaries for c in pair), *(float(c) for c in white)]
        numbers.append(1.0 if gamma is None else float(gamma))
    except (TypeError, ValueError) as error:
        raise UsageError(f"A chromaticity and γ are numbers: {error}.") from error
    if trouble := _meaning_trouble(numbers):
        raise UsageError(f"The header of the image {trouble}.")
    header = _HEADER.pack(
        _MAGIC, _VERSION, 3 if matte is None else 4, 0 if gamma is None else 1, 0, width, height, *numbers
    )
    counts, records, kept = _records(pixel.view(np.uint32).reshape(-1), width, height)
    values = kept.view(np.uint8).reshape(-1, 4)[:, : 3 if matte is None else 4]
    return b"".join((header, counts.astype(">u4").tobytes(), records.tobytes(), values.tobytes()))


def _records(pixel: Any, width: int, height: int) -> tuple[Any, Bytes, Any]:
    """Records of each line, all records, and the pixels that they keep, of pixels that lie in one row."""
    import numpy as np

    starts = np.empty(pixel.size, dtype=bool)
    np.not_equal(pixel[1:], pixel[:-1], out=starts[1:])
    starts[::width] = True
    first = np.flatnonzero(starts)  # of every stretch of equal pixels, which ends with its line
    length = np.diff(first, append=pixel.size)
    single = length == 1
    # Neighbouring single pixels of a line make one record. A pair is worth a run, even between single pixels.
    begins = np.empty(first.size, dtype=bool)
    begins[0] = True
    begins[1:] = ~(single[1:] & single[:-1]) | (first[1:] % width == 0)
    piece = np.flatnonzero(begins)
    run, first = ~single[piece], first[piece]
    length = np.diff(first, append=pixel.size)
    # What is longer than a record can say becomes several; all but the last are full.
    parts = (length + _LONGEST_RUN - 1) // _LONGEST_RUN
    run = np.repeat(run, parts)
    last = np.cumsum(parts) - 1
    size = np.full(run.size, _LONGEST_RUN, dtype=np.int64)
    size[last] = length - (parts - 1) * _LONGEST_RUN
    begin = np.cumsum(size) - size
    counts = np.bincount(begin // width, minlength=height)
    kept = np.repeat(~run, size)
    kept[begin] = True
    return counts, (size - 1 + np.where(run, _RUN, 0)).astype(np.uint8), pixel[kept]


def _size_trouble(width: int, height: int) -> str:
    """Why no image has this size, or ""."""
    if width < 1 or height < 1:
        return f"is empty: {width} x {height} pixels"
    if max(width, height) > LARGEST_SIDE or width * height > MOST_PIXELS:
        limit = f"{LARGEST_SIDE} a side and {MOST_PIXELS} in all"
        return f"of {width} x {height} pixels is larger than the format holds, {limit}"
    return ""


def _meaning_trouble(numbers: Sequence[float]) -> str:
    """Why x, y of three primaries and white, and γ, mean nothing, or ""."""
    if len(numbers) != 9:
        return f"should have x and y of three primaries and white, and γ, not {len(numbers)} numbers"
    *chromaticities, gamma = numbers
    if not all(math.isfinite(c) and abs(c) <= 10.0 for c in chromaticities) or chromaticities[7] <= 0.0:
        return "has a chromaticity that is none"
    if not 0.0 < gamma <= 100.0:
        return f"has a γ of {gamma}, which should lie between 0 and 100"
    return ""


class _Header(NamedTuple):
    """The header of a file, checked."""

    channels: int
    linear: bool
    width: int
    height: int
    numbers: tuple[float, ...]


def _header(content: bytes, name: str) -> _Header:
    if not content.startswith(_MAGIC):
        raise ImageError(
            f"{name} is not a run-length encoded image: it does not begin with {_MAGIC.decode()}."
        )
    if len(content) < _HEADER.size:
        raise ImageError(f"{name} ends too soon: a header has {_HEADER.size} bytes, not {len(content)}.")
    _, version, channels, state, spare, width, height, *numbers = _HEADER.unpack_from(content)
    if version != _VERSION:
        raise ImageError(f"{name} is of version {version} of this format, and version {_VERSION} is read.")
    if channels not in (3, 4) or state not in (0, 1) or spare:
        raise ImageError(f"{name} is damaged: its header has a value that no version of this format has.")
    trouble = _size_trouble(width, height) or _meaning_trouble(numbers)
    if trouble:
        raise ImageError(f"{name} is damaged: its header {trouble}.")
    return _Header(channels, state == 0, width, height, tuple(numbers))


class _Body(NamedTuple):
    """What follows the header, checked: records, how many pixels each stands for and keeps, and these pixels."""

    run: Any
    size: Any
    keeps: Any
    values: Bytes


def _body(content: bytes, header: _Header, name: str) -> _Body:
    import numpy as np

    width, height = header.width, header.height
    at = _HEADER.size + 4 * height
    # Each line has a count and a record, and each record at most 128 pixels: a smaller file is none of this size.
    if len(content) < at or width * height > _LONGEST_RUN * (len(content) - at):
        raise ImageError(f"{name} ends too soon: {len(content)} bytes cannot hold {width} x {height} pixels.")
    counts = np.frombuffer(content, dtype=">u4", count=height, offset=_HEADER.size).astype(np.int64)
    total = int(counts.sum())
    if total > len(content) - at:
        raise ImageError(f"{name} ends too soon: it should have {total} records.")
    records = np.frombuffer(content, dtype=np.uint8, count=total, offset=at)
    run = records >= _RUN
    size = (records & (_RUN - 1)).astype(np.int64) + 1
    reached = np.concatenate(([0], np.cumsum(size)))[np.cumsum(counts)]
    wrong = np.flatnonzero(reached != width * np.arange(1, height + 1))
    if wrong.size:
        raise ImageError(f"{name} is damaged: the records of line {wrong[0]} do not fill its {width} pixels.")
    keeps = np.where(run, 1, size)
    expected = at + total + header.channels * int(keeps.sum())
    if len(content) != expected:
        trouble = "ends too soon" if len(content) < expected else "goes on after its end"
        raise ImageError(f"{name} {trouble}: it should have {expected} bytes, not {len(content)}.")
    values = np.frombuffer(content, dtype=np.uint8, offset=at + total).reshape(-1, header.channels)
    return _Body(run, size, keeps, values)


def decode(content: bytes, file: str = "") -> RunLengthImage:
    """Decode an image.

    Args:
        content: the whole file.
        file: what a message shall call it.

    Raises:
        ImageError: it is no such image, is of another version, ends too soon, or its counts do not fill its lines.
    """
    import numpy as np

    content = bytes(content)
    name = file or "The image"
    header = _header(content, name)
    run, size, keeps, values = _body(content, header, name)
    repeats = np.ones(len(values), dtype=np.int64)
    repeats[(np.cumsum(keeps) - 1)[run]] = size[run]
    whole = np.zeros((len(values), 4), dtype=np.uint8)
    whole[:, : header.channels] = values
    pixel = np.repeat(whole.view(np.uint32)[:, 0], repeats)
    planes = pixel.view(np.uint8).reshape(header.height, header.width, 4)
    xr, yr, xg, yg, xb, yb, xw, yw, gamma = header.numbers
    return RunLengthImage(
        rgb=np.ascontiguousarray(planes[..., :3]),
        matte=np.ascontiguousarray(planes[..., 3]) if header.channels == 4 else None,
        primaries=((xr, yr), (xg, yg), (xb, yb)),
        white=(xw, yw),
        gamma=None if header.linear else gamma,
    )


def compression(content: bytes, file: str = "") -> Compression:
    """How much smaller an encoded image is, without decoding its pixels.

    Raises:
        ImageError: as `decode` raises it.
    """
    content = bytes(content)
    name = file or "The image"
    header = _header(content, name)
    body = _body(content, header, name)
    unpacked = storage(header.width, header.height, matte=header.channels == 4)
    return Compression(unpacked, len(content), len(body.size))


def write(
    path: str | os.PathLike[str],
    rgb: Bytes,
    matte: Bytes | None = None,
    *,
    primaries: Sequence[Sequence[float]],
    white: Sequence[float],
    gamma: float | None = None,
) -> Compression:
    """Encode an image into a file, whole or not at all.

    Args:
        path: the file, by custom `.rle`.
        rgb, matte, primaries, white, gamma: as for `encode`.

    Returns:
        What the encoding saved.

    Raises:
        UsageError: as `encode` raises it.
        ImageError: the path cannot be an output.
        MachineError: the disk is full or fails.
    """
    content = encode(rgb, matte, primaries=primaries, white=white, gamma=gamma)
    output.write_bytes(path, content)
    return compression(content, str(Path(path)))


def read(path: str | os.PathLike[str]) -> RunLengthImage:
    """Read an image from a file.

    Raises:
        ImageError: the file cannot be read, or as `decode` raises it.
    """
    # What no header can stand for need not be read.
    largest = _HEADER.size + 4 * LARGEST_SIDE + 5 * MOST_PIXELS
    try:
        with sources.opened(path, sys.maxsize) as file:
            # A file of another kind may be of any size.
            start = file.read(_HEADER.size)
            # Reading asks for memory before it knows how much there is to read.
            rest = min(os.fstat(file.fileno()).st_size, largest)
            content = start + (file.read(rest) if start.startswith(_MAGIC) else b"")
    except SourceError as error:
        raise ImageError(f"{path} cannot be read: {error.clause}.") from None
    return decode(content, str(Path(path)))
