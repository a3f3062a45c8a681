"""Files of photometric laboratories: how much a luminaire shines into every direction.

IES files (ANSI/IES LM-63, 1986 to 2019) of photometric types A, B and C, and EULUMDAT (.ldt), become one form:
luminous intensity in candela over half-planes C around the axis and angles γ from it (CIE 121; type C of LM-63), the
whole circle of planes written out.

Types A and B state directions otherwise, about another pole: type A by a vertical angle V and a horizontal angle H
with a vertical pole, d = cos V cos H z + cos V sin H x + sin V y; type B with a horizontal one,
d = cos H cos V z + sin H x + cos H sin V y. There z is the axis along which the luminaire is aimed, x is to its right
and y is up. Their values are interpolated, linear in both angles, at every 2.5° of C and γ.

Example:
    >>> text = "IESNA:LM-63-2002\\nTILT=NONE\\n1 1000 1 3 1 1 2 0 0 0\\n1 1 50\\n0 45 90\\n0\\n300 200 0\\n"
    >>> lamp = parse(text.encode(), "spot.ies")
    >>> lamp.angles_deg.tolist(), lamp.candela.tolist(), lamp.watts
    ([0.0, 45.0, 90.0], [[300.0, 200.0, 0.0]], 50.0)
    >>> round(lamp.flux_lm())
    851
"""

from __future__ import annotations

import itertools
import math
import os
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from illuminant import sources
from illuminant.errors import DataError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Photometry", "parse", "read"]

MOST_BYTES = 20_000_000
"""The largest file that is read."""

MOST_ANGLES = 10_000
"""The most angles along one axis of a table."""

MOST_CANDELA = 1e30
"""The largest intensity, cd; the sun has 3e27."""

STEP_DEG = 2.5
"""How finely types A and B are written out."""


@dataclass(frozen=True)
class Photometry:
    """What a file says of a luminaire.

    Attributes:
        planes_deg: angles C of the half-planes, growing in [0, 360); one for what is the same all around.
        angles_deg: angles γ from the axis, growing in [0, 180].
        candela: luminous intensity (planes, angles), cd, lamps and ballasts as the file has them.
        watts: input power, or 0 where the file has none.
        size_m: length, width and height of the luminous opening, m; 0 for a point, negative for a diameter (LM-63).
        keywords: what else the file says, such as MANUFAC or LUMCAT.
    """

    planes_deg: np.ndarray
    angles_deg: np.ndarray
    candela: np.ndarray
    watts: float = 0.0
    size_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    keywords: dict[str, str] = field(default_factory=dict)

    def flux_lm(self) -> float:
        """Luminous flux, lm: the integral of intensity over solid angle, linear between the angles of the table."""
        import numpy as np

        angles = np.radians(self.angles_deg)
        middle, h = 0.5 * (angles[:-1] + angles[1:]), 0.5 * (angles[1:] - angles[:-1])
        low, high = self.candela[:, :-1], self.candela[:, 1:]
        # Over x from -h to h: ∫ (mean + (high - low) x / 2h) sin(middle + x) dx, in a form in which nothing cancels.
        square = h * h
        near = square * (1 / 3 - square * (1 / 30 - square / 840))
        odd = np.where(h < 0.03, near, np.sinc(h / np.pi) - np.cos(h))  # sin h / h - cos h
        even = np.sin(middle) * np.sin(h)
        of_planes = ((low + high) * even + (high - low) * np.cos(middle) * odd).sum(axis=1).clip(0.0)
        if len(of_planes) == 1:
            return float(2 * math.pi * of_planes[0])
        widths = np.radians((np.roll(self.planes_deg, -1) - self.planes_deg) % 360.0)
        return float((0.5 * widths * (of_planes + np.roll(of_planes, -1))).sum())


def read(path: str | os.PathLike[str]) -> Photometry:
    """Reads an IES or EULUMDAT file.

    Raises:
        DataError: there is no such file, or it is not one of them; file, line and what was expected.
    """
    name = os.fspath(path)
    try:
        data = sources.read(path, MOST_BYTES)
    except sources.SourceError as error:
        raise DataError(error.message, name) from None
    return parse(data, name)


def parse(data: bytes, name: str = "") -> Photometry:
    """The same from the bytes of a file; `name` says which kind it is (.ldt, else IES) and stands in messages.

    Raises:
        DataError: it is not one of them; file, line and what was expected.
    """
    if not data.strip():
        raise DataError("is empty", name)
    if b"\0" in data[:4096]:
        raise DataError("is no text: a photometric file has lines of words and numbers", name)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if name.lower().endswith(".ldt"):
        return _eulumdat(lines, name)
    return _ies(lines, name)


# --- IES ------------------------------------------------------------------------------------------------------------


class _Numbers:
    """The numbers after TILT, wherever lines end."""

    def __init__(self, lines: list[str], first: int, name: str) -> None:
        self.name = name
        self.words = [
            (word, i + 1)
            for i, line in enumerate(lines[first:], first)
            for word in re.split(r"[\s,]+", line.strip())
            if word
        ]
        self.at = 0
        self.line = first + 1

    def next(self, what: str) -> float:
        if self.at >= len(self.words):
            raise DataError(f"ends before {what}", self.name, self.line)
        word, self.line = self.words[self.at]
        self.at += 1
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise DataError(f"expected {what}, a number; found {word[:40]!r}", self.name, self.line)
        return value

    def count(self, what: str, least: int) -> int:
        value = self.next(what)
        if value != int(value) or not least <= value <= MOST_ANGLES:
            message = f"expected {what}, a whole number from {least} to {MOST_ANGLES}; found {value:g}"
            raise DataError(message, self.name, self.line)
        return int(value)

    def several(self, count: int, what: str) -> list[float]:
        return [self.next(f"{what} {i + 1} of {count}") for i in range(count)]


def _ies(lines: list[str], name: str) -> Photometry:
    tilt = next((i for i, line in enumerate(lines) if line.strip().upper().startswith("TILT")), None)
    if tilt is None:
        raise DataError("has no line TILT=, which every IES file has", name)
    keywords: dict[str, str] = {}
    last = ""
    for line in lines[:tilt]:
        found = re.match(r"\s*\[(\w+)\]\s*(.*)", line)
        if found:
            last = last if found[1].upper() == "MORE" else found[1].upper()
            keywords[last] = f"{keywords[last]} {found[2].strip()}" if last in keywords else found[2].strip()
    kind = lines[tilt].split("=", 1)[1].strip().upper() if "=" in lines[tilt] else ""
    numbers = _Numbers(lines, tilt + 1, name)
    if kind == "INCLUDE":
        numbers.next("the geometry of lamp and luminaire")
        pairs = numbers.count("the number of tilt angles", 1)
        numbers.several(2 * pairs, "tilt value")
    elif kind != "NONE":
        raise DataError(
            f"expected TILT=NONE or TILT=INCLUDE; found {lines[tilt].strip()[:60]!r}", name, tilt + 1
        )
    numbers.next("the number of lamps")
    numbers.next("lumens per lamp")
    multiplier = numbers.next("the candela multiplier")
    vertical = numbers.count("the number of vertical angles", 2)
    horizontal = numbers.count("the number of horizontal angles", 1)
    kind_of = numbers.count("the photometric type", 1)
    if kind_of > 3:
        raise DataError(
            f"expected the photometric type, 1 (C), 2 (B) or 3 (A); found {kind_of}", name, numbers.line
        )
    units = numbers.count("the type of units", 1)
    if units > 2:
        raise DataError(
            f"expected the type of units, 1 (feet) or 2 (metres); found {units}", name, numbers.line
        )
    size = numbers.several(3, "dimension")
    ballast = numbers.next("the ballast factor")
    numbers.next("the factor for future use")
    watts = numbers.next("the input watts")
    at = numbers.at
    v = _growing(numbers.several(vertical, "vertical angle"), "vertical angles", name, numbers.words[at][1])
    at = min(numbers.at, len(numbers.words) - 1)
    h = _growing(
        numbers.several(horizontal, "horizontal angle"), "horizontal angles", name, numbers.words[at][1]
    )
    first_value = numbers.at
    table = [numbers.several(vertical, f"candela of horizontal angle {angle:g}, value") for angle in h]
    scale = multiplier * ballast
    if not (scale > 0 and math.isfinite(scale)):
        raise DataError(f"has the candela multiplier times ballast factor {scale:g}; expected above 0", name)
    candela = _intensities(table, scale, name, numbers.words[first_value][1])
    metre = 0.3048 if units == 1 else 1.0
    length = size[1] * metre, size[0] * metre, size[2] * metre
    if kind_of == 1:
        planes, angles, candela = _type_c(h, v, candela, name)
    else:
        planes, angles, candela = _about_another_pole(h, v, candela, "B" if kind_of == 2 else "A", name)
    return Photometry(planes, angles, candela, max(watts, 0.0), length, keywords)


def _growing(values: list[float], what: str, name: str, line: int) -> np.ndarray:
    import numpy as np

    for a, b in itertools.pairwise(values):
        if not a < b:
            raise DataError(f"has {what} that do not grow: {a:g} is followed by {b:g}", name, line)
    return np.array(values)


def _intensities(table: list[list[float]], scale: float, name: str, line: int) -> np.ndarray:
    import numpy as np

    with np.errstate(over="ignore"):  # infinities are refused below
        candela = np.array(table) * scale
    if candela.min() < 0:
        raise DataError(f"has a negative intensity, {candela.min():g} cd", name, line)
    if candela.max() > MOST_CANDELA:
        message = f"has an intensity of {candela.max():g} cd; at most {MOST_CANDELA:g} is read"
        raise DataError(message, name, line)
    if candela.max() <= 0:
        raise DataError("has no intensity above 0", name, line)
    return candela


def _type_c(
    h: np.ndarray, v: np.ndarray, candela: np.ndarray, name: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The whole circle of planes from those of type C."""
    if v[0] < 0 or v[-1] > 180:
        raise DataError(f"has vertical angles from {v[0]:g} to {v[-1]:g}; type C has 0 to 180", name)
    if h[0] < 0 or h[-1] > 360:
        raise DataError(f"has horizontal angles from {h[0]:g} to {h[-1]:g}; type C has 0 to 360", name)
    planes, values = _circle(h, candela, name)
    return planes, v, values


def _circle(h: np.ndarray, candela: np.ndarray, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Planes over 360 degrees from those of one, a quadrant, a half or all."""
    import numpy as np

    first, last = float(h[0]), float(h[-1])
    if len(h) == 1:
        return np.array([0.0]), candela
    if (first, last) == (0.0, 90.0):
        h, candela = np.concatenate([h, 180 - h[-2::-1]]), np.concatenate([candela, candela[-2::-1]])
        last = 180.0
    if (first, last) == (90.0, 270.0):
        # The two halves mirror each other about the plane of 90 and 270 degrees.
        other = (180.0 - h[1:-1]) % 360.0
        h, candela = np.concatenate([h, other]), np.concatenate([candela, candela[1:-1]])
    elif (first, last) == (0.0, 180.0):
        h, candela = np.concatenate([h, 360 - h[-2:0:-1]]), np.concatenate([candela, candela[-2:0:-1]])
    elif first == 0.0 and last == 360.0:
        h, candela = h[:-1], candela[:-1]
    elif not (first == 0.0 and last > 180.0):
        message = "expected 0, or from 0 to 90, 180 or 360, or from 90 to 270"
        raise DataError(f"has horizontal angles from {first:g} to {last:g}; {message}", name)
    order = np.argsort(h)
    return h[order], candela[order]


def _about_another_pole(
    h: np.ndarray, v: np.ndarray, candela: np.ndarray, kind: str, name: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Types A and B as planes C and angles γ."""
    import numpy as np

    if v[0] < -90 or v[-1] > 90 or h[0] < -90 or h[-1] > 90:
        raise DataError(f"has angles beyond 90 degrees; type {kind} has -90 to 90", name)
    if h[0] == 0.0 and len(h) > 1:
        h, candela = np.concatenate([-h[:0:-1], h]), np.concatenate([candela[:0:-1], candela])
    if v[0] == 0.0:
        v = np.concatenate([-v[:0:-1], v])
        candela = np.concatenate([candela[:, :0:-1], candela], axis=1)
    planes = np.arange(0.0, 360.0, STEP_DEG)
    angles = np.arange(0.0, 90.0 + STEP_DEG / 2, STEP_DEG)
    c, gamma = np.meshgrid(np.radians(planes), np.radians(angles), indexing="ij")
    x, y, z = np.sin(gamma) * np.cos(c), np.sin(gamma) * np.sin(c), np.cos(gamma)
    if kind == "A":
        elevation, turn = np.arcsin(np.clip(y, -1, 1)), np.arctan2(x, z)
    else:
        elevation, turn = np.arctan2(y, z), np.arcsin(np.clip(x, -1, 1))
    return planes, angles, _bilinear(h, v, candela, np.degrees(turn), np.degrees(elevation))


def _bilinear(
    h: np.ndarray, v: np.ndarray, candela: np.ndarray, turn: np.ndarray, elevation: np.ndarray
) -> np.ndarray:
    """Linear in both angles; 0 beyond the table, and for one horizontal angle the same at all."""
    import numpy as np

    def place(nodes: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        if len(nodes) == 1:
            return np.zeros(at.shape, int), np.zeros(at.shape), np.ones(at.shape, bool)
        i = np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, len(nodes) - 2)
        inside = (at >= nodes[0] - 1e-6) & (at <= nodes[-1] + 1e-6)
        with np.errstate(over="ignore"):  # angles that nearly coincide
            part = np.clip((at - nodes[i]) / (nodes[i + 1] - nodes[i]), 0, 1)
        return i, part, inside

    i, s, in_h = place(h, turn)
    k, t, in_v = place(v, elevation)
    i1, k1 = np.minimum(i + 1, len(h) - 1), np.minimum(k + 1, len(v) - 1)
    low = candela[i, k] * (1 - s) + candela[i1, k] * s
    high = candela[i, k1] * (1 - s) + candela[i1, k1] * s
    return np.where(in_h & in_v, low * (1 - t) + high * t, 0.0)


# --- EULUMDAT -------------------------------------------------------------------------------------------------------

HEADER_LINES = 26
"""The lines before those of the lamps."""


def _eulumdat(lines: list[str], name: str) -> Photometry:
    def number(i: int, what: str) -> float:
        if i >= len(lines) or (i == len(lines) - 1 and not lines[i].strip()):
            raise DataError(f"ends before {what}", name, len(lines))
        word = lines[i].strip().replace(",", ".")
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise DataError(f"expected {what}, a number; found {word[:40]!r}", name, i + 1)
        return value

    def count(i: int, what: str, least: int, most: int) -> int:
        value = number(i, what)
        if value != int(value) or not least <= value <= most:
            message = f"expected {what}, a whole number from {least} to {most}; found {value:g}"
            raise DataError(message, name, i + 1)
        return int(value)

    symmetry = count(2, "the symmetry indicator", 0, 4)
    planes_in_all = count(3, "the number of C-planes", 1, MOST_ANGLES)
    angles_in_all = count(5, "the number of angles in a plane", 2, MOST_ANGLES)
    size = [number(12 + i, "a dimension") * 1e-3 for i in range(3)]
    factor = number(23, "the conversion factor of intensities")
    sets = count(25, "the number of sets of lamps", 1, 20)
    flux = sum(number(HEADER_LINES + 2 * sets + i, "the flux of the lamps") for i in range(sets))
    watts = sum(number(HEADER_LINES + 5 * sets + i, "the watts of the lamps") for i in range(sets))
    at = HEADER_LINES + 6 * sets + 10
    c = _growing([number(at + i, f"C-plane {i + 1}") for i in range(planes_in_all)], "C-planes", name, at + 1)
    at += planes_in_all
    gamma = _growing([number(at + i, f"angle {i + 1}") for i in range(angles_in_all)], "angles", name, at + 1)
    at += angles_in_all
    if c[0] < 0 or c[-1] > 360 or gamma[0] < 0 or gamma[-1] > 180:
        raise DataError("has angles beyond 360 degrees of C or 180 of γ", name, at)
    if symmetry == 0:
        used = list(range(planes_in_all))
    elif symmetry == 1:
        used = [0]
    elif symmetry == 2:
        used = [i for i, plane in enumerate(c) if plane <= 180]
    elif symmetry == 3:
        # From C 270 over 0 to C 90.
        used = [i for i, plane in enumerate(c) if plane >= 270] + [
            i for i, plane in enumerate(c) if plane <= 90
        ]
    else:
        used = [i for i, plane in enumerate(c) if plane <= 90]
    if not used:
        raise DataError(f"has no C-plane that the symmetry indicator {symmetry} uses", name, at)
    scale = factor * flux / 1000.0
    if not (scale > 0 and math.isfinite(scale)):
        raise DataError(f"has conversion factor times flux {factor * flux:g}; expected above 0", name, 24)
    table = [
        [
            number(at + k * angles_in_all + i, f"intensity {i + 1} of plane C{c[plane]:g}")
            for i in range(angles_in_all)
        ]
        for k, plane in enumerate(used)
    ]
    candela = _intensities(table, scale, name, at + 1)
    planes, candela = _by_symmetry(symmetry, c[used], candela, name)
    words = {"NAME": lines[8].strip(), "MANUFAC": lines[0].strip(), "LUMCAT": lines[9].strip()}
    return Photometry(planes, gamma, candela, max(watts, 0.0), (size[0], size[1], size[2]), words)


def _by_symmetry(
    symmetry: int, c: np.ndarray, candela: np.ndarray, name: str
) -> tuple[np.ndarray, np.ndarray]:
    """The whole circle from the planes that the symmetry keeps."""
    import numpy as np

    if symmetry == 0:
        order = np.argsort(c % 360.0)
        planes, first = np.unique((c % 360.0)[order], return_index=True)
        return planes, candela[order][first]
    if symmetry == 1:
        return np.array([0.0]), candela[:1]
    if symmetry == 3:
        # −90 to 90 about 0; the other half is its mirror image about the plane of 90 and 270.
        around = np.where(c > 180, c - 360.0, c)
        mirrored = 180.0 - around
        planes = np.concatenate([around, mirrored]) % 360.0
        values = np.concatenate([candela, candela])
        planes, first = np.unique(planes, return_index=True)
        return planes, values[first]
    return _circle(c, candela, name)
