"""Pixels of image files, as they are stored: for environments, and for what lies on surfaces.

OpenImageIO reads the file (EXR, HDR, TIFF, PNG, JPEG and more). Whole numbers come as fractions of their largest
value; nothing is decoded or clamped here.

Example:
    >>> from illuminant.pixels import read
    >>> pixels, whole_numbers = read("scenes/images/studio.hdr")        # doctest: +SKIP
    >>> pixels.shape, whole_numbers                                     # doctest: +SKIP
    ((512, 1024, 3), False)
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import machine, sources
from illuminant.errors import ImageError
from illuminant.schema import MAX_PIXELS
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["MAX_BYTES", "MOST_CHANNELS", "decode_srgb", "read"]

MAX_BYTES = 4_000_000_000
"""The largest file of an image."""

MOST_CHANNELS = 64
"""Channels of an image at most."""

MOST_PIXELS_A_BYTE = 20_000
"""How many pixels a byte of a file can stand for: deflate packs black ones of one bit 8,000 times."""

PIXELS_A_BYTE = {"jpeg": 1000}
"""The same for formats that cannot pack so well; a block of JPEG has 64 pixels and takes a bit or more."""

BYTES_A_PIXEL = 12
"""Memory that a pixel takes beside the channels as they are read."""


def read(path: str | os.PathLike[str]) -> tuple[np.ndarray, bool]:
    """The pixels of a file.

    Returns:
        float32 (h, w, 3), rows from the top, R, G, B, where a grey image has its value three times; and whether the
        file holds whole numbers, which are usually encoded for a display.

    Raises:
        ImageError: the file is missing, damaged or too large; names the file.
    """
    import OpenImageIO as oiio

    path = Path(path)
    try:
        size = sources.check(path, MAX_BYTES)
    except SourceError as error:
        raise ImageError(f"{path}: {error.message}") from None
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise ImageError(f"{path}: cannot be read as an image ({_clause(oiio.geterror)})")
    try:
        spec = source.spec()
        if not 0 < spec.width * spec.height <= MAX_PIXELS or spec.depth > 1:
            raise ImageError(
                f"{path}: has {spec.width} × {spec.height} pixels; at most {MAX_PIXELS} can be used"
            )
        most = PIXELS_A_BYTE.get(source.format_name(), MOST_PIXELS_A_BYTE) * size
        for width, height in ((spec.width, spec.height), (spec.tile_width, spec.tile_height)):
            if width * height > most:
                raise ImageError(f"{path}: states {width} × {height} pixels, for which it is too short")
        if spec.nchannels > MOST_CHANNELS:
            raise ImageError(f"{path}: has {spec.nchannels} channels; at most {MOST_CHANNELS} are read")
        tile = 4 * spec.nchannels * spec.tile_width * spec.tile_height
        machine.check_file(path, spec.width * spec.height * (4 * spec.nchannels + BYTES_A_PIXEL) + tile)
        pixels = source.read_image(0, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ImageError(f"{path}: is damaged ({_clause(source.geterror)})")
        names = _names(spec)
        whole_numbers = spec.format.basetype not in (oiio.HALF, oiio.FLOAT, oiio.DOUBLE)
    finally:
        source.close()
    if {"R", "G", "B"} <= set(names):
        pixels = pixels[..., [names.index(name) for name in "RGB"]]
    elif pixels.shape[-1] < 3:
        pixels = pixels[..., [0, 0, 0]]
    else:
        pixels = pixels[..., :3]
    return pixels, whole_numbers


def decode_srgb(encoded: np.ndarray) -> np.ndarray:
    """Linear values from sRGB's (IEC 61966-2-1), both from 0 to 1."""
    import numpy as np

    encoded = np.asarray(encoded)
    linear = np.empty(encoded.shape, np.float64 if encoded.dtype == np.float64 else np.float32)
    # Row by row: in double precision at once, a large image would take many times its memory.
    for row, found in zip(encoded.reshape(len(encoded), -1), linear.reshape(len(encoded), -1), strict=True):
        exact = row.astype(np.float64)
        found[:] = np.where(
            exact <= 0.04045, exact / 12.92, ((np.maximum(exact, 0.04045) + 0.055) / 1.055) ** 2.4
        )
    return linear


def _names(spec: Any) -> list[str]:
    """The channels; where their names are no text, by their order."""
    try:
        return [name.upper() for name in spec.channelnames]
    except UnicodeDecodeError:
        return [""] * int(spec.nchannels)


def _clause(ask: Callable[[], str]) -> str:
    """What the library says of its failure, which may quote bytes that are no text."""
    try:
        return " ".join(ask().split()).rstrip(".") or "unknown reason"
    except UnicodeDecodeError:
        return "its header is damaged"
