"""PNG files: what a display shows of an image, labelled so that any viewer shows the same.

The pixels are made by the core (`_core.develop`: exposure, RGB system, transfer function, rounding) and
packed by it (`_core.encode_png`); this module says which colour chunks belong to which RGB system, writes the
text chunks, and reads both back.

- sRGB: an `sRGB` chunk.
- Rec.709, Rec.2020, Display P3 and XYZ: `cICP` (code points of ITU-T H.273).
- All: `cHRM`, and `gAMA` where the transfer function is a power law or near one; Adobe RGB and ACES AP1 have
  only these.
- ACES AP0 is refused: its blue primary has a negative y, which no chunk can state.

Reference: W3C, Portable Network Graphics (PNG) Specification, third edition, 2025.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import rgb_system
from illuminant.core import core
from illuminant.errors import ImageError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["SIGNATURE", "Header", "chunks", "decode", "encode", "read_header"]

SIGNATURE = b"\x89PNG\r\n\x1a\n"

# H.273: colour primaries, transfer characteristics, matrix (0: RGB), full range.
_CICP = {
    "Rec.709": (1, 1, 0, 1),
    "Rec.2020": (9, 14, 0, 1),
    "Display P3": (12, 13, 0, 1),
    "XYZ": (10, 8, 0, 1),
}
_SYSTEM_OF_CICP = {(code[0], code[1]): name for name, code in _CICP.items()} | {
    (1, 13): "sRGB",
    (9, 15): "Rec.2020",
}


@dataclass(frozen=True)
class Header:
    """What a PNG file says of itself.

    Attributes:
        width, height, bits: of the image.
        system: name of the RGB system, or None when the chunks state none that is known.
        text: the text chunks by keyword; `Settings`, when there is one, is JSON.
    """

    width: int
    height: int
    bits: int
    system: str | None
    text: dict[str, str]

    @property
    def settings(self) -> dict[str, Any]:
        """How the image was made, if the file says so."""
        try:
            found = json.loads(self.text.get("Settings", "{}"))
        except ValueError:
            return {}
        return found if isinstance(found, dict) else {}


def encode(xyz: Array, system: str, exposure: float, bits: int, text: dict[str, str]) -> tuple[bytes, float]:
    """Make a PNG file in memory.

    Args:
        xyz: (h, w, 3), absolute, Y in cd/m².
        system: name of an RGB system (`_core.rgb_systems()`).
        exposure: factor on Y that makes 1 the display's white.
        bits: 8 or 16.
        text: keyword and value of each text chunk.

    Returns:
        The bytes, and the fraction of pixels that lay outside the gamut or above white and were clamped.

    Raises:
        UsageError: the RGB system is unknown or cannot be stated in a PNG; bits is neither 8 nor 16.
    """
    if bits not in (8, 16):
        raise UsageError(f"A PNG has 8 or 16 bits a channel, not {bits}.")
    about = rgb_system.named(system)
    name = str(about["name"])
    chromaticities = list(rgb_system.chromaticities(about))
    if min(chromaticities) < 0:
        raise UsageError(f"A PNG cannot state the primaries of {name}: choose another RGB system, or EXR.")
    pixels, clamped = core().develop(xyz, name, exposure, bits)
    transfer = str(about["transfer"])
    content = core().encode_png(
        pixels,
        chromaticities=[*chromaticities[6:], *chromaticities[:6]],  # cHRM begins with white
        # The sRGB curve is near a power of 2.2, which the specification tells readers without sRGB and cICP to use.
        gamma=2.2 if transfer == "sRGB" else rgb_system.gamma(transfer),
        cicp=_CICP.get(name),
        srgb=name == "sRGB",
        text=list(text.items()),
    )
    return bytes(content), float(clamped)


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
        return name, zlib.decompress(rest[1:]).decode("latin-1")
    compressed = rest[:1] == b"\1"
    body = rest[2:].split(b"\0", 2)[2]
    return name, (zlib.decompress(body) if compressed else body).decode("utf-8")


def read_header(path: str | Path) -> Header:
    """Read what a PNG file says of itself.

    Raises:
        ImageError: the file is not there or is no whole PNG.
    """
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise ImageError(f"{path} cannot be read: {(error.strerror or str(error)).lower()}.") from error
    width = height = bits = 0
    system: str | None = None
    text: dict[str, str] = {}
    try:
        for kind, data in chunks(content):
            if kind == b"IHDR":
                width, height, bits = struct.unpack_from(">IIB", data)
            elif kind == b"sRGB":
                system = system or "sRGB"
            elif kind == b"cICP":
                system = _SYSTEM_OF_CICP.get((data[0], data[1]), system)
            elif kind in (b"tEXt", b"zTXt", b"iTXt"):
                name, value = _text(kind, data)
                text[name] = value
    except (ValueError, IndexError, struct.error, zlib.error) as error:
        raise ImageError(f"{path} is not a whole PNG: {error}.") from error
    return Header(width, height, bits, text.get("RGB system", system), text)


def decode(path: str | Path) -> tuple[Array, Header]:
    """Read the linear colour of a PNG.

    Returns:
        XYZ (h, w, 3), relative: the white of the RGB system has Y = 1. A file that names no RGB system is
        taken as sRGB.

    Raises:
        ImageError: the file is not there, is no whole PNG, or cannot be decoded.
    """
    import numpy as np
    import OpenImageIO as oiio

    header = read_header(path)
    file = oiio.ImageInput.open(str(path))
    pixels = None if file is None else file.read_image(oiio.DOUBLE)
    if file is None or pixels is None:
        raise ImageError(f"{path} cannot be read: {oiio.geterror() or 'it is damaged'}.")
    spec = file.spec()
    file.close()
    pixels = np.asarray(pixels).reshape(spec.height, spec.width, spec.nchannels)
    rgb = pixels[..., :3] if spec.nchannels >= 3 else np.repeat(pixels[..., :1], 3, axis=2)
    about = rgb_system.named(header.system or "sRGB")
    return rgb_system.linear(rgb, str(about["transfer"])) @ np.asarray(about["to_xyz"]).T, header
