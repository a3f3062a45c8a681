"""Changes to an input: of bytes for any format, of words and numbers for texts. The same generator gives the same.

Numbers in texts become those at which readers fail: zeros, signs, the ends of the floating-point range, infinities, and
what is none. Whole numbers in bytes become those at the ends of their types.

Example:
    >>> import random
    >>> mutated(random.Random(3), b"n 1.5\\n400 0.2\\n", text=True) == mutated(
    ...     random.Random(3), b"n 1.5\\n400 0.2\\n", text=True)
    True
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from random import Random

__all__ = ["NUMBERS", "mutated"]

NUMBERS = (
    "0", "-0", "0.0", "1", "-1", "2", "3", "7", "0.5", "-0.5", "1e-320", "5e-324", "1e-45", "1e-30", "1e-9", "1e9",
    "1e19", "1e30", "1e38", "3.5e38", "1e154", "1e200", "1.8e308", "1e309", "-1e38", "-1e308", "nan", "inf", "-inf",
    "NaN", "Infinity", "127", "128", "255", "256", "360", "400", "560", "780", "65535", "65536", "2147483647",
    "2147483648", "4294967295", "4294967296", "9223372036854775807", "9223372036854775808", "18446744073709551615",
    "-2147483648", "-9223372036854775808", "1" + "0" * 30, "1" + "0" * 400, "0x10", "1_000", "1,5", "١٢", "1e", ".", "",
)  # fmt: skip
_NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_][A-Za-z_0-9-]*")
_STRING = re.compile(rb'"[^"\n]*"')
_STRINGS = (
    b'""', b'"\\u0000"', b'"/dev/zero"', b'"../../etc/passwd"', b'"a.csv"', b'"a.png"', b'"a.ply"', b'"nan"', b"true",
    b"[]", b"{}", b"0", b"[[]]", b"-1.5", b"1e308", b'"' + b"x" * 300 + b'"', b"1979-05-27T07:32:00Z",
)  # fmt: skip
_SPECIAL = (b"\0", b"\xff", b"\xef\xbb\xbf", b"\xff\xfe", b"\r", b"\n", b"\r\n", b"\t", b'"', b"'", b"\\", b"#", b"=",
            b"[", b"]", b"{", b"}", b",", b";", b":",
            b"\xc2\x85", b"\xe2\x80\xa8", b"\xed\xa0\x80", b"\x1a")  # fmt: skip
_EDGES = {
    1: (0, 1, 2, 4, 127, 128, 254, 255),
    2: (0, 1, 255, 256, 32767, 32768, 65535, 0x7C00, 0x7E00, 0xFC00),
    4: (
        0,
        1,
        255,
        65535,
        65536,
        2**31 - 1,
        2**31,
        2**32 - 1,
        0x7F800000,
        0xFF800000,
        0x7FC00000,
        0x7F7FFFFF,
        1 << 24,
    ),
    8: (0, 1, 2**31, 2**32, 2**63 - 1, 2**63, 2**64 - 1, 0x7FF0 << 48, 0x7FF8 << 48, 0x7FEF << 48),
}


def mutated(
    random: Random,
    data: bytes,
    others: Sequence[bytes] = (),
    *,
    text: bool = False,
    words: Sequence[str] = (),
    longest: int = 4096,
) -> bytes:
    """An input with one to eight changes.

    Args:
        random: the generator.
        data: the input.
        others: inputs of the same kind, of which parts are taken.
        text: whether words and numbers are changed as such.
        words: that the format knows.
        longest: bytes that are kept.
    """
    for _ in range(1 + min(7, int(random.expovariate(0.7)))):
        if text and random.random() < 0.8:
            data = _text(random, data, others, words)
        else:
            data = _bytes(random, data, others, words)
    return data[:longest]


def _span(random: Random, data: bytes, most: int = 64) -> tuple[int, int]:
    at = random.randrange(len(data) + 1)
    return at, min(len(data), at + 1 + int(random.random() ** 3 * most))


def _bytes(random: Random, data: bytes, others: Sequence[bytes], words: Sequence[str]) -> bytes:
    choice = random.randrange(10)
    at, end = _span(random, data)
    if choice == 0 and at < len(data):
        return data[:at] + bytes([data[at] ^ 1 << random.randrange(8)]) + data[at + 1 :]
    if choice == 1:
        return data[:at] + bytes([random.randrange(256)]) + data[at + 1 :]
    if choice in (2, 3):
        size = random.choice((1, 2, 4, 8))
        value = random.choice(_EDGES[size])
        return data[:at] + value.to_bytes(size, random.choice(("big", "little"))) + data[at + size :]
    if choice == 4:
        return data[:at] + data[end:]
    if choice == 5:
        return data[:end] + data[at:end] * random.choice((1, 1, 2, 8)) + data[end:]
    if choice == 6:
        to = random.randrange(len(data) + 1)
        rest = data[:at] + data[end:]
        return rest[:to] + data[at:end] + rest[to:]
    if choice == 7 and others:
        other = random.choice(others)
        first, last = _span(random, other, 256)
        return data[:at] + other[first:last] + data[random.choice((at, end)) :]
    if choice == 8 and words:
        return data[:at] + random.choice(words).encode() + data[random.choice((at, end)) :]
    if random.random() < 0.2:
        return data[:at]
    return data[:at] + random.choice(_SPECIAL) + data[at:]


def _replaced(random: Random, data: bytes, pattern: re.Pattern[bytes], by: bytes) -> bytes:
    found = list(pattern.finditer(data))
    if not found:
        return data
    match = random.choice(found)
    return data[: match.start()] + by + data[match.end() :]


def _text(random: Random, data: bytes, others: Sequence[bytes], words: Sequence[str]) -> bytes:
    choice = random.randrange(9)
    if choice <= 2:
        return _replaced(random, data, _NUMBER, random.choice(NUMBERS).encode())
    if choice == 3 and words:
        return _replaced(random, data, _WORD, random.choice(words).encode())
    if choice == 4:
        return _replaced(random, data, _STRING, random.choice(_STRINGS))
    lines = data.split(b"\n")
    at = random.randrange(len(lines))
    if choice == 5:
        del lines[at]
    elif choice == 6:
        lines.insert(random.randrange(len(lines) + 1), lines[at])
    elif choice == 7 and others:
        lines.insert(at, random.choice(random.choice(others).split(b"\n")))
    else:
        other = random.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    return b"\n".join(lines)
