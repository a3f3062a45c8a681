"""PNG files: code values, and the chunks that say which display they are for.

Which chunks belong to which display is told in `illuminant.display.picture`; the core packs them
(`_core.encode_png`), and writes exactly those asked for. A display with a primary of negative x or y (ACES AP0) is
refused, since no chunk can state it.

Reference: W3C, Portable Network Graphics (PNG) Specification, third edition, 2025.
"""

from __future__ import annotations

import json
import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant import machine, sources
from illuminant.core import core
from illuminant.display import displays
from illuminant.display.displays import Display
from illuminant.errors import DataError, ImageError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Codes = NDArray[np.uint8] | NDArray[np.uint16]

__all__ = ["SIGNATURE", "Header", "chunks", "decode", "encode", "read_header"]

SIGNATURE = b"\x89PNG\r\n\x1a\n"

# H.273: colour primaries, transfer characteristics, matrix (0: RGB), full range.
_CICP = {
    "Display P3": (12, 13, 0, 1),
    "Rec.2020 PQ": (9, 16, 0, 1),
    "Rec.2020 HLG": (9, 18, 0, 1),
    "XYZ": (10, 8, 0, 1),
}
# What other programs write: for the curves of cameras a display answers by BT.1886.
_OTHER_CICP: dict[tuple[int, ...], str] = {
    (1, 13): "sRGB",
    (1, 1): "Rec.709",
    (1, 6): "Rec.709",
    (9, 14): "Rec.2020",
    (9, 15): "Rec.2020",
}

LARGEST = 1 << 28
"""Pixels of the largest image that is read."""

MOST_BYTES = 4_000_000_000
"""The largest file."""

LARGEST_PROFILE = 1 << 24
"""Bytes of the largest ICC profile that is read from a PNG."""

LARGEST_TEXT = 1 << 24
"""Bytes of the longest text that is read from a PNG, and letters of all its texts together."""

BYTES_A_PIXEL = 24
"""Memory that a pixel takes while it is decoded: four samples of 16 bits, their copy, and the rounding to its bits."""

# Samples a pixel and possible bits a sample, by colour type.
_COLOUR_TYPES = {
    0: (1, (1, 2, 4, 8, 16)),
    2: (3, (8, 16)),
    3: (1, (1, 2, 4, 8)),
    4: (2, (8, 16)),
    6: (4, (8, 16)),
}
# First column, first row, and steps between columns and rows of the passes of an interlaced image (Adam7).
_PASSES = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))
_PIECE = 1 << 20


@dataclass(frozen=True)
class Header:
    """What a PNG file says of itself.

    Attributes:
        width, height: in pixels.
        bits: of a channel that carry the image.
        display: whose code values these are, or None when the file does not say.
        text: the text chunks by keyword; `Settings`, when there is one, is JSON.
    """

    width: int
    height: int
    bits: int
    display: Display | None
    text: dict[str, str]

    @property
    def settings(self) -> dict[str, Any]:
        """How the image was made, if the file says so."""
        return self._object("Settings")

    @property
    def look(self) -> dict[str, Any]:
        """How the image was shown, if the file says so."""
        return self._object("Look")

    def _object(self, keyword: str) -> dict[str, Any]:
        try:
            found = json.loads(self.text.get(keyword, "{}"))
        except (ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


def encode(codes: Codes, bits: int, display: Display, text: dict[str, str]) -> bytes:
    """Make a PNG file in memory.

    Args:
        codes: (h, w, 3), uint8 or uint16, from 0 to 2^bits − 1.
        bits: 1 to 16 a channel; other than 8 and 16 are spread over these, and stated by `sBIT`.
        display: whose code values they are.
        text: keyword and value of each text chunk. One that a PNG cannot hold (a keyword that is not 1 to 79 printable
            letters of Latin-1, a value with a zero) is left out, as is `Display`, which is always that of `display`.

    Raises:
        UsageError: a primary of the display has a negative y or x, which no chunk can state.
    """
    import numpy as np

    chromaticities = [
        c for pair in (display.white, *display.primaries) for c in pair
    ]  # cHRM begins with white
    if min(chromaticities) < 0:
        raise UsageError(
            f"A PNG cannot state the primaries of {display.name}: choose another display, or save as EXR."
        )
    depth = 8 if bits <= 8 else 16
    spread: Codes = codes
    if bits != depth:
        top, largest = (1 << bits) - 1, (1 << depth) - 1
        wide = (codes.astype(np.uint32) * largest + top // 2) // top
        spread = wide.astype(np.uint8) if depth == 8 else wide.astype(np.uint16)
    srgb = _same(display, displays.named("sRGB"))
    cicp = next((code for name, code in _CICP.items() if _same(display, displays.named(name))), None)
    stated = srgb or cicp is not None
    icc = None
    if not stated:
        from illuminant.display import profile

        icc = (display.name, profile.encode(display))
    content = core().encode_png(
        spread,
        chromaticities=chromaticities,
        # The sRGB curve is near a power of 2.2, which the specification tells readers without sRGB and cICP to use.
        gamma=2.2 if display.response == "sRGB" else display.gamma,
        cicp=cicp,
        srgb=srgb,
        icc=icc,
        significant_bits=None if bits == depth else bits,
        text=[
            *((key, value) for key, value in text.items() if key != "Display" and _writable(key, value)),
            ("Display", json.dumps(display.to_dict())),
        ],
    )
    return bytes(content)


def _writable(keyword: str, value: str) -> bool:
    """Whether a PNG can hold this text."""
    printable = all(" " <= letter <= "~" or "\xa1" <= letter <= "\xff" for letter in keyword)
    spaced = keyword == keyword.strip(" ") and "  " not in keyword
    return 0 < len(keyword) <= 79 and printable and spaced and "\0" not in value


def _same(one: Display, other: Display) -> bool:
    """Whether two displays answer code values alike, whatever their names and luminances."""
    return (one.primaries, one.white, one.response) == (other.primaries, other.white, other.response)


def chunks(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Type and data of every chunk, checked.

    Raises:
        ValueError: this is no PNG, or it ends too soon, or a checksum is wrong.
    """
    if not content.startswith(SIGNATURE):
        raise ValueError("it does not begin as a PNG does")
    at = len(SIGNATURE)
    while at < len(content):
        if at + 12 > len(content):
            raise ValueError("it ends too soon")
        (length,) = struct.unpack_from(">I", content, at)
        kind, data = content[at + 4 : at + 8], content[at + 8 : at + 8 + length]
        if at + 12 + length > len(content):
            raise ValueError("it ends too soon")
        (checksum,) = struct.unpack_from(">I", content, at + 8 + length)
        if zlib.crc32(kind + data) != checksum:
            raise ValueError(f"the checksum of a {kind.decode('latin-1')} chunk is wrong")
        yield kind, data
        at += 12 + length


def _text(kind: bytes, data: bytes) -> tuple[str, str]:
    keyword, _, rest = data.partition(b"\0")
    name = keyword.decode("latin-1")
    if kind == b"tEXt":
        return name, rest.decode("latin-1")
    if kind == b"zTXt":
        return name, _inflated(rest[1:], LARGEST_TEXT, f"text {name!r}").decode("latin-1")
    compressed = rest[:1] == b"\1"
    body = rest[2:].split(b"\0", 2)[2]
    return name, (_inflated(body, LARGEST_TEXT, f"text {name!r}") if compressed else body).decode("utf-8")


def read_header(path: str | os.PathLike[str]) -> Header:
    """Read what a PNG file says of itself.

    Raises:
        ImageError: the file is not there or is no whole PNG.
        MachineError: the file does not fit into the memory that is free.
    """
    return _header(_content(path), path)


def _content(path: str | os.PathLike[str]) -> bytes:
    try:
        return sources.read(path, MOST_BYTES)
    except SourceError as error:
        raise ImageError(f"{path} cannot be read: {error.clause}.") from None


def _header(content: bytes, path: str | os.PathLike[str]) -> Header:
    width = height = depth = bits = letters = 0
    found: dict[bytes, bytes] = {}
    text: dict[str, str] = {}
    try:
        for kind, data in chunks(content):
            if kind == b"IHDR":
                width, height, depth = struct.unpack_from(">IIB", data)
            elif kind == b"sBIT":
                bits = max(data)
            elif kind in (b"tEXt", b"zTXt", b"iTXt"):
                name, value = _text(kind, data)
                text[name] = value
                letters += len(value)
                if letters > LARGEST_TEXT:
                    raise ValueError(f"its texts are longer than {LARGEST_TEXT:,} letters")
            else:
                found.setdefault(kind, data)
        display = _stated(text, found)
    except (ValueError, IndexError, struct.error, zlib.error) as error:
        raise ImageError(f"{path} is not a whole PNG: {error}.") from error
    if not 0 < width * height <= LARGEST:
        raise ImageError(f"{path} has {width} × {height} pixels: 1 to {LARGEST:,} are read.")
    return Header(width, height, bits if 0 < bits <= depth else depth, display, text)


def _stated(text: dict[str, str], found: dict[bytes, bytes]) -> Display | None:
    """The display that a file states: by its chunks, or by our own text where that says the same and more."""
    by_chunks = _by_chunks(found)
    if "Display" not in text:
        return by_chunks
    try:
        ours = displays.described(json.loads(text["Display"]), "its text `Display`")
    except (DataError, ValueError, RecursionError, OverflowError, AttributeError, TypeError):
        return by_chunks  # another program's text of that name
    # A program that gave the picture another display may have left our text as it was.
    return ours if by_chunks is None or _agree(ours, by_chunks) else by_chunks


def _agree(ours: Display, other: Display) -> bool:
    """Whether two displays are one, as far as chunks can tell: primaries, white and response."""
    import numpy as np

    xy = [np.array([*one.primaries, one.white]) for one in (ours, other)]
    if np.abs(xy[0] - xy[1]).max() > 2e-3:
        return False
    if ours.response == other.response:
        return True
    codes = np.repeat(np.linspace(0.0, 1.0, 9)[:, None], 3, axis=1)
    return bool(np.abs(ours.decode(codes) - other.decode(codes)).max() < 0.02)


def _by_chunks(found: dict[bytes, bytes]) -> Display | None:
    """The display that the chunks state, in the order of the specification."""
    if b"cICP" in found:
        code, rest = tuple(found[b"cICP"][:2]), found[b"cICP"][2:]
        name = next((name for name, known in _CICP.items() if known[:2] == code), _OTHER_CICP.get(code))
        # A PNG holds RGB of full range; what says otherwise is mistaken, and the next chunk is asked.
        if name is not None and rest == b"\0\1":
            return displays.named(name)
    if b"iCCP" in found:
        from illuminant.display import profile

        _, _, rest = found[b"iCCP"].partition(b"\0")
        try:
            return displays.of_profile(
                profile.decode(_inflated(rest[1:], LARGEST_PROFILE, "ICC profile"), "its ICC profile"),
                "its ICC profile",
            )
        except (DataError, UsageError):
            pass
    if b"sRGB" in found:
        return displays.named("sRGB")
    if b"gAMA" in found and b"cHRM" in found:
        exponent = 100_000 / max(struct.unpack(">I", found[b"gAMA"])[0], 1)
        xy = [value / 100_000 for value in struct.unpack(">8I", found[b"cHRM"])]
        pairs = tuple(zip(xy[::2], xy[1::2], strict=True))
        try:
            return Display("stated by cHRM and gAMA", pairs[1:], pairs[0], f"gamma {exponent:.6g}")  # type: ignore[arg-type]
        except UsageError:
            return None
    return None


def _inflated(data: bytes, largest: int, what: str) -> bytes:
    """Decompressed data of at most so many bytes."""
    content = zlib.decompressobj().decompress(data, largest + 1)
    if len(content) > largest:
        raise ValueError(f"its {what} is larger than {largest:,} bytes")
    return content


def _rows(header: bytes) -> Iterator[tuple[int, int]]:
    """How many rows of how many bytes (with that of the filter) the pixels of an image take, for each of its passes.

    Raises:
        ValueError: there is no image with this IHDR chunk.
    """
    width, height, depth, kind, compression, filtering, interlace = struct.unpack(">IIBBBBB", header)
    samples, depths = _COLOUR_TYPES.get(kind, (0, ()))
    if depth not in depths or compression or filtering or interlace > 1:
        raise ValueError("its header (IHDR) is of no kind of PNG")
    for left, top, across, down in _PASSES if interlace else ((0, 0, 1, 1),):
        columns, rows = -(-(width - left) // across), -(-(height - top) // down)
        if columns > 0 and rows > 0:
            yield rows, 1 + (columns * samples * depth + 7) // 8


def _check_order(kinds: list[bytes]) -> None:
    """Refuse what no decoder accepts: chunks that are there twice, unknown ones that matter, parted or late ones.

    Raises:
        ValueError: which it is.
    """
    for kind in dict.fromkeys(kinds):
        name = kind.decode("latin-1")
        if kind in (b"IHDR", b"PLTE", b"IEND") and kinds.count(kind) > 1:
            raise ValueError(f"it has more than one {name} chunk")
        if kind[:1].isupper() and kind not in (b"IHDR", b"PLTE", b"IDAT", b"IEND"):
            raise ValueError(f"it has a chunk {name!r} that is unknown and may not be passed over")
    if b"IDAT" not in kinds:
        raise ValueError("its pixels are missing")
    first = kinds.index(b"IDAT")
    if set(kinds[first : first + kinds.count(b"IDAT")]) != {b"IDAT"}:
        raise ValueError("other chunks part its pixels")
    if b"PLTE" in kinds[first:]:
        raise ValueError("its palette follows its pixels")


def _check_pixels(content: bytes) -> None:
    """Refuse an image whose pixels are not all there: the library would speak of it on its own.

    Raises:
        ValueError: a chunk is missing, or the data of the pixels are too few, damaged, or of an unknown filter.
    """
    known = list(chunks(content))
    kinds = [kind for kind, _ in known]
    if kinds[0] != b"IHDR" or kinds[-1] != b"IEND":
        raise ValueError("it does not go from IHDR to IEND")
    rows = list(_rows(known[0][1]))
    _check_order(kinds)
    palette = next((data for kind, data in known if kind == b"PLTE"), None)
    if palette is None and known[0][1][9] == 3:
        raise ValueError("its palette is missing")
    if palette is not None and (len(palette) % 3 or not 0 < len(palette) <= 768):
        raise ValueError("its palette is not of 1 to 256 colours")
    inflate = zlib.decompressobj()
    at = done = 0  # bytes before this pass, and in all
    expected = sum(count * length for count, length in rows)
    passes = iter(rows)
    count, length = next(passes)
    for kind, data in known:
        if kind != b"IDAT":
            continue
        while data and not inflate.eof:
            if done == expected:
                if inflate.decompress(data, 1):
                    raise ValueError(f"its pixels have more than {expected:,} bytes")
                break  # what remained of the chunk is the end of the stream
            piece = inflate.decompress(data, min(_PIECE, at + count * length - done))
            data = inflate.unconsumed_tail
            if not piece:
                break
            first = (at - done) % length
            if piece[first::length] and max(piece[first::length]) > 4:
                raise ValueError("its pixels have an unknown filter")
            done += len(piece)
            if done == at + count * length and done < expected:
                at = done
                count, length = next(passes)
    if done < expected:
        raise ValueError(f"its pixels have {done:,} bytes instead of {expected:,}")
    if not inflate.eof:
        raise ValueError("its pixels end too soon")


def decode(
    path: str | os.PathLike[str], bytes_a_pixel: int = BYTES_A_PIXEL
) -> tuple[Codes, NDArray[np.uint8] | None, Header]:
    """Read the code values of a PNG.

    Args:
        path: the file.
        bytes_a_pixel: memory that the caller will need for each pixel.

    Returns:
        Codes (h, w, 3), uint8 or uint16, from 0 to 2^bits − 1; opacity (h, w), uint8, or None where the file has none;
        and what the file says of itself. A grey file has three equal channels.

    Raises:
        ImageError: the file is not there, is no whole PNG, or cannot be decoded.
        MachineError: the image does not fit into the memory that is free.
    """
    import numpy as np
    import OpenImageIO as oiio

    content = _content(path)
    header = _header(content, path)
    machine.check_file(path, bytes_a_pixel * header.width * header.height)
    try:
        _check_pixels(content)
    except (ValueError, struct.error, zlib.error) as error:
        raise ImageError(f"{path} is not a whole PNG: {error}.") from error
    # Codes as they are: the library would otherwise multiply colour by opacity.
    plain = oiio.ImageSpec()
    plain.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(str(path), plain)
    wide = header.bits > 8
    pixels = None if file is None else file.read_image(oiio.UINT16 if wide else oiio.UINT8)
    if file is None or pixels is None:
        raise ImageError(f"{path} cannot be read: {oiio.geterror() or 'it is damaged'}.")
    spec = file.spec()
    file.close()
    pixels = np.asarray(pixels).reshape(spec.height, spec.width, spec.nchannels)
    codes = pixels[..., :3] if spec.nchannels >= 3 else np.repeat(pixels[..., :1], 3, axis=2)
    largest, top = (65535 if wide else 255), (1 << header.bits) - 1
    if top != largest:
        codes = ((codes.astype(np.uint32) * top + largest // 2) // largest).astype(codes.dtype)
    matte = None
    if spec.nchannels in (2, 4):
        opacity = pixels[..., -1]
        matte = (
            ((opacity.astype(np.uint32) * 255 + 32767) // 65535).astype(np.uint8) if wide else opacity.copy()
        )
    return np.ascontiguousarray(codes), matte, header
