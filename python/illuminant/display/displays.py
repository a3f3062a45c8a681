"""Displays by name, by measurement, or by a file: what light each sends for its code values.

XYZ = (peak − black) M R(v) + black W: v are the code values 0 to 1, R the response of each channel, M the matrix of the
primaries and the white (book eq 3.2), W the white with Y = 1. Luminances are in cd/m². Two displays show the same
picture when code values are chosen that give the same XYZ: `second.encode(second.from_xyz(first.to_xyz(code)))`.

| name | primaries and white | response | white, cd/m² |
| --- | --- | --- | --- |
| `sRGB` | ITU-R BT.709, D65 | IEC 61966-2-1 | 80 |
| `Rec.709` | ITU-R BT.709, D65 | ITU-R BT.1886 | 100 |
| `Display P3` | DCI-P3, D65 | IEC 61966-2-1 | 80 |
| `Adobe RGB` | Adobe RGB (1998), D65 | γ = 563/256 | 160 |
| `Rec.2020` | ITU-R BT.2020, D65 | ITU-R BT.1886 | 100 |
| `Rec.2020 PQ` | ITU-R BT.2020, D65 | SMPTE ST 2084 | 1000, diffuse white 203 |
| `Rec.2020 HLG` | ITU-R BT.2020, D65 | ITU-R BT.2100 HLG | 1000, diffuse white 203 |
| `SMPTE-C` | SMPTE RP 145, D65 | γ = 2.2 | 103 |
| `NTSC 1953 D65` | FCC 1953, D65 | γ = 2.2 | 103 |
| `book NTSC` | FCC 1953, D6500 (book 5.1.1) | γ = 2.2 | 103 |

The RGB systems of `illuminant.color` that are not in this table (`ACES AP1`, `XYZ`, `NTSC 1953`, ...) are displays
too, with their own transfer function and a white of 100 cd/m².

A description is a TOML file:

    name = "left monitor"
    primaries = [[0.641, 0.334], [0.298, 0.602], [0.151, 0.062]]
    white = [0.3121, 0.3297]
    response = "gamma 2.35"       # or three of these, or three tables of light at equally spaced codes
    peak = 118.0                  # cd/m²
    black = 0.21                  # cd/m²

A response is `sRGB`, `Rec.709`, `linear`, `gamma γ`, `BT.1886`, `PQ`, `HLG`, `gain-offset-gamma G O γ`, or a table.
An ICC profile of a monitor (`.icc`, `.icm`) is read as well.

References: IEC 61966-2-1:1999; ITU-R BT.709-6, BT.1886-0, BT.2020-2, BT.2100-3, BT.2408-7; SMPTE RP 145:2004; Adobe RGB
(1998) Color Image Encoding, 2005.
"""

from __future__ import annotations

import functools
import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import sources
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.profile import Profile

    Array = NDArray[np.float64]

__all__ = ["EXTENSIONS", "Display", "described", "named", "names", "of_profile"]

Pair = tuple[float, float]
Response = str | tuple[float, ...]

EXTENSIONS = (".toml", ".icc", ".icm")
"""Of the files that describe a display."""

_KEYS = ("name", "primaries", "white", "response", "peak", "black", "reference")


@dataclass(frozen=True)
class Display:
    """A display.

    Attributes:
        name: for people.
        primaries: x and y of red, green and blue.
        white: x and y of the code values (1, 1, 1).
        response: name of the response of all channels, or three names or tables, one a channel.
        peak: luminance of white, cd/m².
        black: luminance of the code values (0, 0, 0), cd/m²; its chromaticity is that of white.
        reference: luminance at which diffuse white is shown, cd/m²; None: that of white.

    Raises:
        UsageError: the numbers make no display.

    Example:
        >>> from illuminant.display import displays
        >>> srgb = displays.named("sRGB")
        >>> srgb.to_xyz([1.0, 1.0, 1.0]).round(2).tolist()
        [76.04, 80.0, 87.12]
        >>> p3 = displays.named("Display P3")
        >>> p3.encode(p3.from_xyz(srgb.to_xyz([1.0, 0.0, 0.0]))).round(3).tolist()
        [0.917, 0.2, 0.139]
    """

    name: str
    primaries: tuple[Pair, Pair, Pair]
    white: Pair
    response: Response | tuple[Response, Response, Response] = "sRGB"
    peak: float = 100.0
    black: float = 0.0
    reference: float | None = None

    def __post_init__(self) -> None:
        """Refuse what is no display."""
        if not self.name.strip():
            raise UsageError("A display has a name.")
        numbers = [self.peak, self.black, *self.white, *(c for pair in self.primaries for c in pair)]
        if not all(math.isfinite(number) for number in numbers):
            raise UsageError(f"Display {self.name!r} has a number that is not finite.")
        if self.reference is not None and not 0 < self.reference <= self.peak:
            raise UsageError(
                f"Display {self.name!r} shows diffuse white at {self.reference:g} cd/m²: expected above 0, and not "
                f"above its peak of {self.peak:g}."
            )
        _ = self._core

    @functools.cached_property
    def _core(self) -> Any:
        try:
            return core().Display(
                self.name,
                [list(pair) for pair in self.primaries],
                list(self.white),
                [one if isinstance(one, str) else list(one) for one in self.responses],
                self.peak,
                self.black,
            )
        except (ValueError, TypeError) as error:
            raise UsageError(f"Display {self.name!r} cannot be: {error}.") from error

    @property
    def responses(self) -> tuple[Response, Response, Response]:
        """The response of each channel."""
        one = self.response
        if isinstance(one, str) or (one and isinstance(one[0], (int, float))):
            return (one, one, one)
        if len(one) != 3:
            raise UsageError(f"Display {self.name!r} has {len(one)} responses: expected one, or three.")
        return one  # type: ignore[return-value]

    @property
    def shown_white(self) -> float:
        """Luminance at which diffuse white is shown, cd/m²."""
        return self.peak if self.reference is None else self.reference

    @property
    def gamma(self) -> float | None:
        """The exponent, if light is a power of the code value; else None."""
        first = self.response
        if first == "BT.1886" and self.black == 0:
            return 2.4
        if first == "linear":
            return 1.0
        if isinstance(first, str) and first.casefold().startswith("gamma "):
            return float(first.split()[1])
        return None

    @property
    def to_xyz_matrix(self) -> Array:
        """The matrix (3, 3) from linear RGB to XYZ with Y = 1 for white (book eq 3.2)."""
        import numpy as np

        return np.asarray(self._core.to_xyz_matrix(), np.float64)

    @property
    def from_xyz_matrix(self) -> Array:
        """The inverse of `to_xyz_matrix`."""
        import numpy as np

        return np.asarray(self._core.from_xyz_matrix(), np.float64)

    def decode(self, code: ArrayLike) -> Array:
        """Linear RGB, 0 to 1, of code values 0 to 1, both (..., 3); codes outside are taken to the nearer end."""
        return self._each(self._core.decode, code)

    def encode(self, linear: ArrayLike) -> Array:
        """Code values 0 to 1 of linear RGB, both (..., 3); light outside 0 to 1 is taken to the nearer end."""
        return self._each(self._core.encode, linear)

    def to_xyz(self, code: ArrayLike) -> Array:
        """XYZ in cd/m² that the display sends for code values 0 to 1, both (..., 3); its black is part of it."""
        return self._each(self._core.to_xyz, code)

    def from_xyz(self, xyz: ArrayLike) -> Array:
        """Linear RGB that sends an XYZ in cd/m², both (..., 3); outside 0 to 1 the display cannot show it."""
        return self._each(self._core.from_xyz, xyz)

    def map_gamut(self, linear: ArrayLike, method: str) -> Array:
        """Linear RGB (..., 3) brought into the gamut by a method of `illuminant.display.gamut`."""
        return self._each(lambda values: self._core.map_gamut(values, method), linear)

    def oklab(self, linear: ArrayLike) -> Array:
        """L, a, b of Oklab (Ottosson 2020) of linear RGB (..., 3), beside the display's white.

        Example:
            >>> (named("Display P3").oklab([1.0, 1.0, 1.0]).round(6) + 0.0).tolist()
            [1.0, 0.0, 0.0]
        """
        return self._each(self._core.oklab, linear)

    def apply_tone(self, linear: ArrayLike, operator: str) -> Array:
        """Linear RGB (..., 3) after a tone operator of `illuminant.display.tone`."""
        return self._each(lambda values: self._core.apply_tone(values, operator), linear)

    @staticmethod
    def _each(function: Any, values: ArrayLike) -> Array:
        import numpy as np

        array = np.ascontiguousarray(values, np.float64)
        if array.ndim == 0 or array.shape[-1] != 3:
            raise UsageError(f"Colours are arrays (..., 3), not {array.shape}.")
        try:
            return np.asarray(function(array), np.float64).reshape(array.shape)
        except ValueError as error:
            raise UsageError(str(error)) from error

    def to_dict(self) -> dict[str, Any]:
        """The description as plain data, as files hold it."""
        found: dict[str, Any] = {"name": self.name, "primaries": [list(pair) for pair in self.primaries]}
        found["white"] = list(self.white)
        same = len(set(self.responses)) == 1
        one = [item if isinstance(item, str) else list(item) for item in self.responses]
        found["response"] = one[0] if same and isinstance(one[0], str) else one
        found |= {"peak": self.peak, "black": self.black}
        return found if self.reference is None else found | {"reference": self.reference}

    def save(self, path: str | os.PathLike[str], comment: str = "") -> None:
        """Write the description as a TOML file that `named` reads, atomically; the comment is its first line."""
        from illuminant import output

        lines = [f"# {comment} Luminances in cd/m².".replace("  ", " "), ""]
        lines += [f"{key} = {_toml(value)}" for key, value in self.to_dict().items()]
        output.write_bytes(path, ("\n".join(lines) + "\n").encode())


def _toml(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_toml(item) for item in value)}]"
    return repr(value)


_REC709 = ((0.640, 0.330), (0.300, 0.600), (0.150, 0.060))
_P3 = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060))
_REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))
_NTSC = ((0.67, 0.33), (0.21, 0.71), (0.14, 0.08))
_D65 = (0.3127, 0.3290)
_SMPTE_C = ((0.630, 0.340), (0.310, 0.595), (0.155, 0.070))
_ADOBE = ((0.640, 0.330), (0.210, 0.710), (0.150, 0.060))

_STANDARDS: tuple[tuple[Any, ...], ...] = (
    ("sRGB", _REC709, _D65, "sRGB", 80.0),
    ("Rec.709", _REC709, _D65, "BT.1886", 100.0),
    ("Display P3", _P3, _D65, "sRGB", 80.0),
    ("Adobe RGB", _ADOBE, _D65, "gamma 2.19921875", 160.0),
    ("Rec.2020", _REC2020, _D65, "BT.1886", 100.0),
    ("Rec.2020 PQ", _REC2020, _D65, "PQ", 1000.0, 0.0, 203.0),
    ("Rec.2020 HLG", _REC2020, _D65, "HLG", 1000.0, 0.0, 203.0),
    ("SMPTE-C", _SMPTE_C, _D65, "gamma 2.2", 103.0),
    ("NTSC 1953 D65", _NTSC, _D65, "gamma 2.2", 103.0),
    ("book NTSC", _NTSC, (0.313, 0.329), "gamma 2.2", 103.0),
)


def names() -> list[str]:
    """The displays that are known by name."""
    standards = [str(about[0]) for about in _STANDARDS]
    return standards + [str(name) for name in core().rgb_systems() if name not in standards]


def named(name: str | os.PathLike[str] | Display) -> Display:
    """A display by its name, whatever its case, or by a file that describes it.

    Args:
        name: one of `names()`, or a file whose name ends with `.toml`, `.icc` or `.icm`; a display is returned as it
            is.

    Raises:
        UsageError: there is no display of that name; the sentence lists those there are.
        DataError: the file cannot be read, or describes no display.

    Example:
        >>> named("display p3").peak
        80.0
    """
    if isinstance(name, Display):
        return name
    wanted = os.fspath(name)
    if wanted.lower().endswith(EXTENSIONS):
        return _of_file(Path(wanted))
    for about in _STANDARDS:
        if about[0].casefold() == wanted.casefold():
            return _standard(about)
    from illuminant import rgb_system

    known = {str(one).casefold(): str(one) for one in core().rgb_systems()}
    if wanted.casefold() not in known:
        raise UsageError(
            f"There is no display {wanted!r}: known are {', '.join(names())}; or name a file .toml or .icc."
        )
    system = rgb_system.named(wanted)
    red, green, blue = (_pair(pair) for pair in system["primaries"])
    return Display(str(system["name"]), (red, green, blue), _pair(system["white"]), str(system["transfer"]))


MOST_BYTES = 10_000_000
"""The largest description of a display."""


@functools.cache
def _standard(about: tuple[Any, ...]) -> Display:
    return Display(*about)


def _of_file(path: Path) -> Display:
    if path.suffix.lower() != ".toml":
        from illuminant.display import profile

        return of_profile(profile.read(path), path.stem)
    import tomllib

    try:
        found = tomllib.loads(sources.read(path, MOST_BYTES).decode("utf-8"))
    except SourceError as error:
        raise DataError(f"{path} cannot be read: {error.clause}.") from None
    except RecursionError:
        raise DataError(
            f"{path} is no TOML that can be read: its tables and lists are nested too deeply."
        ) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise DataError(f"{path} is no TOML: {' '.join(str(error).split()).rstrip('.').lower()}.") from error
    return described(found, str(path))


def of_profile(profile: Profile, name: str) -> Display:
    """A display as its ICC profile describes it.

    Args:
        profile: from `illuminant.display.profile.read` or `decode`.
        name: for a profile that has no description.

    Raises:
        DataError: a curve sends all light at code 0.
        UsageError: the display cannot be.
    """
    peak = profile.peak or 100.0
    # Measured curves may begin above 0: what all three channels send at code 0 is the display's black.
    lifts = [
        0.0 if gamma else float(table[0]) for table, gamma in zip(profile.table, profile.gammas, strict=True)
    ]
    if max(lifts) >= 1.0:
        raise DataError(f"{profile.description or name}: has a curve that sends all light at code 0.")
    responses = tuple(
        f"gamma {gamma:.6g}" if gamma else tuple(float((v - lift) / (1.0 - lift)) for v in table)
        for table, gamma, lift in zip(profile.table, profile.gammas, lifts, strict=True)
    )
    response: Any = responses[0] if len(set(responses)) == 1 else responses
    black = peak * min(lifts)
    return Display(profile.description or name, profile.primaries, profile.white, response, peak, black)


def described(found: dict[str, Any], source: str) -> Display:
    """A display from its description as plain data, the inverse of `Display.to_dict`.

    Args:
        found: the keys `name`, `primaries`, `white`, and optionally `response`, `peak`, `black`, `reference`.
        source: where it comes from, for messages.

    Raises:
        DataError: a key is missing, unknown, or not what it should be.

    Example:
        >>> about = {"name": "a", "primaries": [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]], "white": [0.31, 0.33]}
        >>> described(about, "here").peak
        100.0
    """
    unknown = [key for key in found if key not in _KEYS]
    if unknown:
        raise DataError(f"{source} has an unknown key {unknown[0]!r}: a display has {', '.join(_KEYS)}.")
    missing = [key for key in ("name", "primaries", "white") if key not in found]
    if missing:
        raise DataError(f"{source} describes no display: {missing[0]!r} is missing.")
    try:
        red, green, blue = (_pair(pair) for pair in found["primaries"])
        numbers = {key: float(found[key]) for key in ("peak", "black", "reference") if key in found}
        display = Display(
            str(found["name"]),
            (red, green, blue),
            _pair(found["white"]),
            _response(found.get("response", "sRGB")),
            **numbers,
        )
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, UsageError):
            raise DataError(f"{source}: {error}") from error
        raise DataError(
            f"{source} describes no display: expected three pairs of numbers as primaries, a pair as white, and a name "
            "or numbers as response."
        ) from error
    return display


def _pair(found: Any) -> Pair:
    x, y = found
    return float(x), float(y)


def _response(found: Any) -> Any:
    if isinstance(found, str):
        return found
    if not isinstance(found, Sequence) or not found:
        raise TypeError
    if all(isinstance(one, (int, float)) for one in found):
        return tuple(float(one) for one in found)
    return tuple(one if isinstance(one, str) else tuple(float(v) for v in one) for one in found)
