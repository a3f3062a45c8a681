"""ICC profiles of displays: written for other programs, and read as the description of a monitor (ICC.1:2022).

A profile says what a display's code values show: linear = TRC(code) for each channel, and XYZ = M · linear, adapted
to the D50 of the profile connection space by the linear Bradford transform (Lam 1985). The tag `chad` keeps that
adaptation, so the display's own white and primaries come back when it is undone. Luminances are relative to the
display's white, whose cd/m² stand in the tag `lumi`; its black is not written, since a matrix has no place for it.

A curve that is the sRGB or the Rec.709 curve or a power law is written as its formula, any other sampled at 4096
codes along the greys. For PQ and HLG the samples are light relative to the display's white, which every program
understands; version 4 also gets the tag `cicp` (ITU-T H.273) when the primaries have a code point, and programs that
know it take the exact curve: 16-bit samples leave PQ steps of peak/65535 in the dark, and HLG's system gamma works on
luminance, so its samples are exact for greys alone.

Version 4 is the default; version 2 serves old programs, with a sampled table in place of each formula and its name in
ASCII where a program reads no more. The bytes depend on the display alone: the date in them is fixed.

Read are profiles of three primaries and curves of versions 2 to 4, whether or not they also have lookup tables. Without
`chad`, the white of `wtpt` tells what was adapted. A profile with lookup tables alone is refused: primaries and curves
cannot say what it says, and its perceptual table is a rendering, no measurement.

Errors: a file that cannot be read, is damaged, or describes no such display is a `DataError`; a display that no
profile can hold is a `UsageError`. Chromaticities come back within 1e-4: a profile has 16 bits behind the point.

Example:
    >>> from illuminant.display.profile import decode
    >>> decode(b"no profile", "a.icc")
    Traceback (most recent call last):
    illuminant.errors.DataError: a.icc: it is not an ICC profile: it has 10 bytes, and a header alone has 128
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from illuminant import output, sources
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["SAMPLES", "Described", "Profile", "decode", "encode", "read", "write"]

SAMPLES = 4096
"""Entries of the table of a channel."""

COPYRIGHT = "No copyright: this profile may be used, copied and changed by anyone."

LARGEST = 64 << 20
"""Bytes of the largest file that is taken for a profile."""

# Primaries by their code points of ITU-T H.273, and the transfer functions that no curve of one channel can hold.
_PRIMARIES = {
    1: ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06)),
    9: ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046)),
    12: ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060)),
}
_D65 = (0.3127, 0.3290)
_TRANSFER = {"PQ": 16, "HLG": 18}


class Described(Protocol):
    """What a profile needs of a display (`illuminant.display.displays.Display` has it)."""

    @property
    def name(self) -> str:
        """What programs show as the name of the profile."""

    @property
    def primaries(self) -> Any:
        """x and y of red, green and blue."""

    @property
    def white(self) -> Any:
        """x and y of white."""

    @property
    def peak(self) -> float:
        """Luminance of white, cd/m²."""

    @property
    def response(self) -> Any:
        """The response; only whether it names PQ or HLG counts here."""

    def decode(self, code: Any) -> Any:
        """Linear values (..., 3), 1 at white, of code values (..., 3) in [0, 1]."""


@dataclass(frozen=True, eq=False)
class Profile:
    """A display as a profile describes it.

    Attributes:
        description: name of the profile; "" when it has none that can be read.
        primaries: x and y of red, green and blue, as the display shows them (not adapted).
        white: x and y of what the three make together.
        table: (3, 4096), linear value of codes that divide [0, 1] evenly, for each channel; rising to 1.
        gammas: exponent of each channel whose curve is a pure power, None for the others.
        peak: luminance of white, cd/m², or None when the profile does not say.
        cicp: primaries, transfer, matrix and range of ITU-T H.273, or None.
        version: 2 or 4.
        rights: who may do what with it.
    """

    description: str
    primaries: tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
    white: tuple[float, float]
    table: Array
    gammas: tuple[float | None, float | None, float | None]
    peak: float | None
    cicp: tuple[int, int, int, int] | None
    version: int
    rights: str

    def linear(self, code: Array) -> Array:
        """Linear values of code values (..., 3) in [0, 1], with straight lines between the samples.

        A channel that is a pure power is computed as one.
        """
        import numpy as np

        code = np.clip(np.asarray(code, dtype=np.float64), 0.0, 1.0)
        at = np.linspace(0.0, 1.0, self.table.shape[1])
        channels = [
            np.interp(code[..., i], at, self.table[i]) if gamma is None else code[..., i] ** gamma
            for i, gamma in enumerate(self.gammas)
        ]
        return np.stack(channels, axis=-1)


def encode(display: Described, *, version: int = 4, rights: str = COPYRIGHT) -> bytes:
    """Make the profile of a display, in memory.

    Args:
        display: its name becomes the description.
        version: 4, or 2 for old programs.
        rights: who may do what with the profile; version 2 keeps ASCII only.

    Returns:
        The profile; the same display gives the same bytes.

    Raises:
        UsageError: the version is neither 2 nor 4, or a profile cannot hold the display: primaries on one line, a
            white that is none, a response that does not rise to 1, a peak that is not between 0 and 32768 cd/m².
    """
    if version not in (2, 4):
        raise UsageError(f"An ICC profile has version 2 or 4, not {version}.")
    try:
        primaries = [[float(c) for c in pair] for pair in display.primaries]
        white = [float(c) for c in display.white]
        content = core().encode_icc(
            str(display.name),
            rights,
            primaries,
            white,
            _curves(display),
            peak=float(display.peak),
            cicp=_code_points(display, primaries, white) if version == 4 else None,
            version=version,
        )
    except (ValueError, TypeError) as error:
        raise UsageError(f"{display.name}: {error}.") from error
    return bytes(content)


def _curves(display: Described) -> list[tuple[str, list[float]]]:
    """Kind and numbers of the curve of each channel, as the core takes them."""
    import numpy as np

    code = np.linspace(0.0, 1.0, SAMPLES)
    linear = np.asarray(display.decode(np.repeat(code[:, None], 3, axis=1)), dtype=np.float64)
    if linear.shape != (SAMPLES, 3) or not np.isfinite(linear).all():
        raise ValueError("the response does not make a finite linear value of every code value")
    return [_curve(code, linear[:, channel]) for channel in range(3)]


def _curve(code: Array, linear: Array) -> tuple[str, list[float]]:
    import numpy as np

    from illuminant import rgb_system

    middle = float(linear[SAMPLES // 2])
    if 0.0 < middle < 1.0:
        # A power law shows its exponent anywhere; digits beyond the sixth are rounding.
        gamma = round(math.log(middle) / math.log(float(code[SAMPLES // 2])), 6)
        if np.abs(linear - code**gamma).max() < 1e-6:
            return "gamma", [gamma]
    for name in ("sRGB", "Rec.709"):
        formula = rgb_system.linear(np.repeat(code[:, None], 3, axis=1), name)[:, 0]
        if np.abs(linear - formula).max() < 1e-6:
            return name, []
    # A code above the display's white (PQ has them) shows white.
    return "table", np.maximum.accumulate(np.clip(linear, 0.0, 1.0)).tolist()


def _code_points(display: Described, primaries: list[list[float]], white: list[float]) -> list[int] | None:
    response = str(getattr(display.response, "name", display.response)).upper()
    transfer = next((code for name, code in _TRANSFER.items() if name in response), None)

    def same(a: Any, b: Any) -> bool:
        return all(math.isclose(x, y, abs_tol=1e-3) for x, y in zip(a, b, strict=True))

    known = (
        code
        for code, known in _PRIMARIES.items()
        if all(same(a, b) for a, b in zip(primaries, known, strict=True))
    )
    code_point = next(known, None) if transfer is not None and same(white, _D65) else None
    return None if code_point is None or transfer is None else [code_point, transfer, 0, 1]


def write(
    path: str | os.PathLike[str], display: Described, *, version: int = 4, rights: str = COPYRIGHT
) -> None:
    """Write the profile of a display, whole or not at all.

    Args:
        path: the file, by custom `.icc`.
        display, version, rights: as for `encode`.

    Raises:
        UsageError: as `encode` raises it.
        ImageError: the path cannot be an output.
        MachineError: the disk is full or fails.
    """
    output.write_bytes(path, encode(display, version=version, rights=rights))


def decode(content: bytes, file: str = "") -> Profile:
    """Read a profile from its bytes.

    Args:
        content: the whole profile.
        file: what a message shall call it.

    Raises:
        DataError: the bytes are no profile, are damaged, or describe no display of primaries and curves.
    """
    try:
        found = core().decode_icc(bytes(content), SAMPLES)
    except ValueError as error:
        raise DataError(str(error), file) from error
    red, green, blue = ((float(x), float(y)) for x, y in found["primaries"])
    x, y = found["white"]
    first, second, third = (numbers[0] if kind == "gamma" else None for kind, numbers in found["curves"])
    return Profile(
        description=found["description"],
        primaries=(red, green, blue),
        white=(float(x), float(y)),
        table=found["table"],
        gammas=(first, second, third),
        peak=found["peak"],
        cicp=found["cicp"],
        version=found["version"],
        rights=found["rights"],
    )


def read(path: str | os.PathLike[str]) -> Profile:
    """Read a profile from a file.

    Raises:
        DataError: the file cannot be read, or as `decode` raises it.
    """
    try:
        content = sources.read(path, LARGEST)
    except SourceError as error:
        raise DataError(f"the profile cannot be read: {error.clause}", str(Path(path))) from None
    return decode(content, str(Path(path)))
