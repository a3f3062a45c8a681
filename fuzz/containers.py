"""Containers whose checksums are made right, so that what is changed inside reaches the reader behind them.

Example:
    >>> from fuzz.containers import with_png_checksums
    >>> with_png_checksums(b"no PNG")
    b'no PNG'
"""

from __future__ import annotations

import struct
import zlib

__all__ = ["with_png_checksums", "with_zip_checksums"]


def with_png_checksums(data: bytes) -> bytes:
    """A PNG with the right checksum in every chunk that is whole."""
    found = bytearray(data)
    at = 8
    while at + 12 <= len(found):
        (length,) = struct.unpack_from(">I", found, at)
        end = at + 8 + length
        if end + 4 > len(found):
            break
        struct.pack_into(">I", found, end, zlib.crc32(found[at + 4 : end]))
        at = end + 4
    return bytes(found)


def with_zip_checksums(data: bytes) -> bytes:
    """A ZIP file with the right checksum of every member that is stored as it is."""
    found = bytearray(data)
    at = found.find(b"PK\x01\x02")
    while at >= 0 and at + 46 <= len(found):
        method, stored, local = (
            struct.unpack_from(form, found, at + offset)[0]
            for form, offset in (("<H", 10), ("<I", 20), ("<I", 42))
        )
        if method == 0 and local + 30 <= len(found):
            name, extra = struct.unpack_from("<HH", found, local + 26)
            first = local + 30 + name + extra
            checksum = zlib.crc32(found[first : first + stored])
            struct.pack_into("<I", found, local + 14, checksum)
            struct.pack_into("<I", found, at + 16, checksum)
        at = found.find(b"PK\x01\x02", at + 46)
    return bytes(found)
