"""RGB systems, and colours in them.

A system is three primaries, a white, and a transfer function. Its matrix to XYZ has the primaries' chromaticities as
columns, scaled so that RGB (1, 1, 1) is the white with Y = 1 (book eq 3.2). Matrices are derived, to all digits;
`published_matrix` gives those that standards print.

| name | primaries, white | transfer |
| --- | --- | --- |
| sRGB, Rec.709 | ITU-R BT.709, D65 | sRGB; Rec.709 |
| Rec.2020 | ITU-R BT.2020, D65 | Rec.709 |
| Display P3 | SMPTE EG 432-1, D65 | sRGB |
| Adobe RGB | Adobe RGB (1998), D65 | gamma 563/256 |
| ACES AP0, ACES AP1 | SMPTE ST 2065-1, S-2014-004, white near D60 | linear |
| NTSC 1953, NTSC 1953 D65 | FCC 1953, C or D65 | gamma 2.2 |
| book NTSC | the same, with the D6500 of the book (0.313, 0.329) | gamma 2.2 |
| SMPTE-C | SMPTE RP 145, D65 | Rec.709 |
| XYZ | the imaginary primaries, equal energy | linear |

Linear values are those of light; code values, those of a file, are linear values after the transfer function. Functions
take and give linear values unless `encoded=True`. Values outside [0, 1] are kept: they say that a colour lies outside
the system.

Example:
    >>> xyz_to_rgb([0.9505, 1.0, 1.0891], "sRGB", encoded=True).round(3).tolist()
    [1.0, 1.0, 1.0]
    >>> mine = monitor([(0.63, 0.34), (0.31, 0.595), (0.155, 0.07)], (0.313, 0.329), transfer="gamma 2.3")
    >>> rgb_to_rgb([0.2, 0.4, 0.6], "sRGB", mine).round(4).tolist()
    [0.1842, 0.401, 0.599]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant import rgb_system
from illuminant.color.adaptation import adaptation_matrix
from illuminant.color.triples import asked, converted, step
from illuminant.color.whites import White
from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]
    Float64 = NDArray[np.float64]

__all__ = [
    "RgbSystem",
    "System",
    "concatenate",
    "decode",
    "encode",
    "inverse",
    "monitor",
    "published_matrix",
    "rgb_to_rgb",
    "rgb_to_rgb_matrix",
    "rgb_to_xyz",
    "system",
    "systems",
    "transform",
    "xyz_to_rgb",
]

Rows = tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, slots=True)
class RgbSystem:
    """An RGB system; make one with `system` or `monitor`.

    Attributes:
        name: what messages call it.
        primaries: x and y of red, green and blue.
        white: x and y of RGB (1, 1, 1).
        transfer: name of the transfer function: "sRGB", "Rec.709", "linear" or "gamma" with its exponent.
        to_xyz: rows of the matrix from linear RGB to XYZ.
        from_xyz: rows of its inverse.
    """

    name: str
    primaries: tuple[tuple[float, float], ...]
    white: tuple[float, float]
    transfer: str
    to_xyz: Rows
    from_xyz: Rows


System = str | RgbSystem
"""A system, or its name."""


def systems() -> list[str]:
    """Names of the systems.

    Example:
        >>> systems()[:3]
        ['sRGB', 'Rec.709', 'Rec.2020']
    """
    return list(core().rgb_systems())


def system(name: System) -> RgbSystem:
    """The system of a name; upper and lower case are one.

    Raises:
        UsageError: there is none of that name; the sentence lists those there are.

    Example:
        >>> system("display p3").white
        (0.3127, 0.329)
    """
    return name if isinstance(name, RgbSystem) else _system(rgb_system.named(name))


def monitor(
    primaries: Sequence[Sequence[float]],
    white: Sequence[float],
    *,
    transfer: str = "linear",
    name: str = "monitor",
) -> RgbSystem:
    """The system of a display with these chromaticities (book eq 3.2).

    Args:
        primaries: x and y of red, green and blue, in any order of colours that the pixels share.
        white: x and y of RGB (1, 1, 1).
        transfer: "linear", "sRGB", "Rec.709", or "gamma" with its exponent, as "gamma 2.2".
        name: what messages call it.

    Raises:
        UsageError: these make no system (primaries on one line, a white with y = 0), or the transfer is not known.

    Example:
        >>> ntsc = monitor([(0.67, 0.33), (0.21, 0.71), (0.14, 0.08)], (0.313, 0.329))
        >>> [round(value, 4) for value in ntsc.to_xyz[0]]
        [0.5893, 0.179, 0.1831]
    """
    try:
        pairs = [(float(x), float(y)) for x, y in primaries]
        x, y = (float(value) for value in white)
        if len(pairs) != 3:
            raise ValueError
    except (TypeError, ValueError) as error:
        raise UsageError("A monitor needs x and y of three primaries, and x and y of its white.") from error
    return _system(asked("rgb_system_of", name, pairs, (x, y), transfer))


def _system(found: dict[str, Any]) -> RgbSystem:
    """The class of what the core describes."""
    primaries = tuple((float(x), float(y)) for x, y in found["primaries"])
    rows = [tuple((float(a), float(b), float(c)) for a, b, c in found[key]) for key in ("to_xyz", "from_xyz")]
    x, y = found["white"]
    return RgbSystem(str(found["name"]), primaries, (float(x), float(y)), str(found["transfer"]), *rows)


# --- matrices ----------------------------------------------------------------------------------------------


def published_matrix(name: str) -> Float64:
    """A matrix (3, 3) as its standard prints it, rounded.

    Args:
        name: "sRGB to XYZ" and "XYZ to sRGB" (IEC 61966-2-1), "Adobe RGB to XYZ" and back (Adobe RGB 1998),
            "ACES AP0 to XYZ" and back (SMPTE ST 2065-1), "ACES AP1 to XYZ" and back (S-2014-004).

    Raises:
        UsageError: there is none of that name.

    Example:
        >>> published_matrix("sRGB to XYZ")[1].tolist()
        [0.2126, 0.7152, 0.0722]
    """
    import numpy as np

    return np.asarray(asked("published_matrix", name))


def inverse(matrix: ArrayLike) -> Float64:
    """The inverse of a matrix (3, 3), by elimination with the largest pivot first.

    Raises:
        UsageError: the matrix is singular; the sentence says in which column.

    Example:
        >>> inverse([[2, 0, 0], [0, 4, 0], [0, 0, 1]]).tolist()
        [[0.5, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.0, 1.0]]
    """
    import numpy as np

    return np.asarray(asked("matrix_inverse", _rows(matrix)))


def concatenate(*matrices: ArrayLike) -> Float64:
    """The matrix (3, 3) that does the first of these, then the next, and so on.

    Example:
        >>> bigger = concatenate(system("sRGB").to_xyz, [[2, 0, 0], [0, 2, 0], [0, 0, 2]])
        >>> bool(abs(bigger.sum(axis=1)[1] - 2.0) < 1e-12)
        True
    """
    import numpy as np

    product = np.eye(3).tolist()
    for matrix in matrices:
        product = core().matrix_product(_rows(matrix), product)
    return np.asarray(product)


def transform(matrix: ArrayLike, values: ArrayLike, *, out: Array | None = None) -> Array:
    """The product of a matrix (3, 3) with each column of values (..., 3).

    Example:
        >>> transform([[0, 1, 0], [1, 0, 0], [0, 0, 1]], [0.1, 0.2, 0.3]).tolist()
        [0.2, 0.1, 0.3]
    """
    return converted([step("matrix", _rows(matrix))], values, out)


def _rows(matrix: ArrayLike) -> list[list[float]]:
    """A matrix as lists of float."""
    from illuminant.color.triples import floating

    array = floating(matrix, "values of a matrix")
    if array.shape != (3, 3):
        raise UsageError(f"A matrix between colours has the shape (3, 3), not {array.shape}.")
    rows: list[list[float]] = array.tolist()
    return rows


# --- colours ------------------------------------------------------------------------------------------------


def encode(linear: ArrayLike, transfer: System = "sRGB", *, out: Array | None = None) -> Array:
    """Code values of linear values (..., 3).

    - "sRGB" (IEC 61966-2-1): 12.92 v up to 0.0031308, then 1.055 v^(1/2.4) − 0.055;
    - "Rec.709" (ITU-R BT.709, BT.2020): 4.5 v below β = 0.018054, then α v^0.45 − (α − 1), α = 1.099297;
    - "gamma γ": v^(1/γ), below 0 with its sign (book eq 5.1);
    - "linear": v.

    The power has a relative error below 10⁻¹³ in float64 and 10⁻⁷ in float32.

    Args:
        linear: (..., 3), any size; nothing is clamped.
        transfer: a name of this list, of a system, or a system.
        out: as `illuminant.color.triples` says.

    Example:
        >>> encode([0.0, 0.18, 1.0]).round(4).tolist()
        [0.0, 0.4614, 1.0]
    """
    return converted([step("encode", _transfer(transfer))], linear, out)


def decode(code: ArrayLike, transfer: System = "sRGB", *, out: Array | None = None) -> Array:
    """Linear values of code values (..., 3): the inverse of `encode`.

    Example:
        >>> decode([0.0, 0.5, 1.0], "gamma 2").tolist()
        [0.0, 0.25, 1.0]
    """
    return converted([step("decode", _transfer(transfer))], code, out)


def rgb_to_xyz(
    rgb: ArrayLike,
    system: System = "sRGB",
    *,
    encoded: bool = False,
    white: White | None = None,
    adaptation: str | None = None,
    out: Array | None = None,
) -> Array:
    """XYZ of RGB (..., 3); RGB (1, 1, 1) has Y = 1.

    Args:
        rgb: linear values, or code values when `encoded`.
        system: a system or its name.
        encoded: whether `rgb` are code values.
        white: white under which the result is to look the same; goes with `adaptation`.
        adaptation: name of a method of `illuminant.color.adaptation`; None keeps the colour as it is.
        out: as `illuminant.color.triples` says.

    Raises:
        UsageError: a name is not known, or only one of `white` and `adaptation` is given.

    Example:
        >>> rgb_to_xyz([1, 1, 1], "sRGB").round(4).tolist()
        [0.9505, 1.0, 1.0891]
    """
    known = _named(system)
    to_xyz = concatenate(known.to_xyz, _adapted(known.white, white, adaptation))
    chain = [step("decode", known.transfer)] if encoded else []
    return converted([*chain, step("matrix", to_xyz.tolist())], rgb, out)


def xyz_to_rgb(
    xyz: ArrayLike,
    system: System = "sRGB",
    *,
    encoded: bool = False,
    white: White | None = None,
    adaptation: str | None = None,
    out: Array | None = None,
) -> Array:
    """RGB of XYZ (..., 3): the inverse of `rgb_to_xyz`; matrix and transfer function are one pass over the array.

    Args:
        xyz: tristimulus values, Y = 1 for the system's white.
        system: a system or its name.
        encoded: whether code values are wanted.
        white: white under which `xyz` is seen; goes with `adaptation`.
        adaptation: name of a method of `illuminant.color.adaptation`; None keeps the colour as it is.
        out: as `illuminant.color.triples` says.

    Example:
        >>> xyz_to_rgb([0.9642, 1.0, 0.8249], white="D50", adaptation="Bradford").round(3).tolist()
        [1.0, 1.0, 1.0]
    """
    known = _named(system)
    adapted = _adapted(known.white, white, adaptation, back=True)
    chain = [step("matrix", concatenate(adapted, known.from_xyz).tolist())]
    if encoded:
        chain.append(step("encode", known.transfer))
    return converted(chain, xyz, out)


def rgb_to_rgb_matrix(source: System, target: System, *, adaptation: str | None = None) -> Float64:
    """The matrix (3, 3) from the linear RGB of one system to that of another (book eq 3.3).

    Args:
        source, target: systems or their names.
        adaptation: name of a method that takes the one white to the other; None keeps the colour as it is, so that
            the white of one is not the white of the other.

    Example:
        >>> rgb_to_rgb_matrix("book NTSC", "sRGB", adaptation="Bradford").sum(axis=1).round(12).tolist()
        [1.0, 1.0, 1.0]
    """
    first, second = _named(source), _named(target)
    adapted = _adapted(first.white, second.white if adaptation is not None else None, adaptation)
    return concatenate(first.to_xyz, adapted, second.from_xyz)


def rgb_to_rgb(
    rgb: ArrayLike,
    source: System,
    target: System,
    *,
    encoded: bool = False,
    adaptation: str | None = None,
    out: Array | None = None,
) -> Array:
    """RGB of another system (book eq 3.3), in one pass over the array.

    Args:
        rgb: (..., 3), linear values, or code values of `source` when `encoded`.
        source, target: systems or their names.
        encoded: whether code values come in and go out, each by the transfer function of its system.
        adaptation: as `rgb_to_rgb_matrix`.
        out: as `illuminant.color.triples` says.

    Example:
        >>> rgb_to_rgb([1.0, 1.0, 1.0], "Display P3", "sRGB").round(12).tolist()
        [1.0, 1.0, 1.0]
    """
    matrix = step("matrix", rgb_to_rgb_matrix(source, target, adaptation=adaptation).tolist())
    if not encoded:
        return converted([matrix], rgb, out)
    ends = [step("decode", _transfer(source)), matrix, step("encode", _transfer(target))]
    return converted(ends, rgb, out)


def _named(wanted: System) -> RgbSystem:
    """`system`, for functions that have an argument of that name."""
    return system(wanted)


def _transfer(of: System) -> str:
    """Name of a transfer function, from a system, the name of one, or that name itself."""
    if isinstance(of, RgbSystem):
        return of.transfer
    known = {name.casefold(): name for name in systems()}
    return system(of).transfer if str(of).casefold() in known else str(of)


def _adapted(own: Sequence[float], other: White | None, method: str | None, *, back: bool = False) -> Float64:
    """The matrix from a system's white to another (or back), or that which changes nothing."""
    import numpy as np

    if (other is None) != (method is None):
        raise UsageError("An adaptation needs both: white, and adaptation with the name of a method.")
    if other is None or method is None:
        return np.eye(3)
    ends = (other, own) if back else (own, other)
    return adaptation_matrix(*ends, method=method)
