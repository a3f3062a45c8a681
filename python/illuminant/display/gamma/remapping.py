"""An image made for one monitor, mapped to look the same on another, from its stored codes (book 5.1.1).

Codes are made linear by the first display's response, taken to XYZ and to the other's primaries (book eq 3.3), clamped
to what it can show, encoded by its response and rounded to whole codes again:

    codes' = round(encode'(clamp(M (decode(codes)))))

The file was rounded once already, so this is worse than mapping the image of floating-point numbers from which it was
made: levels fall together, others are skipped, and what lies outside the other's primaries is lost for good.
`degradation` says by how much: ΔE00 between what the other display shows of the mapped codes and of the mapped floats
(which are rounded once, for it), and how many codes of red, green and blue each of the two uses.

White goes to white: luminances are scaled by the ratio of the two whites, and a colour keeps its chromaticity. With
`match="absolute"` a luminance stays what it is, in cd/m², and what the other display cannot reach is clamped.

Shapes are (..., 3); bits are 1 to 16. A display is one of `illuminant.display.displays`.

Example:
    >>> from illuminant.display.displays import named
    >>> codes, clamped = remap([[255, 0, 0], [0, 0, 128]], named("SMPTE-C"), named("Display P3"))
    >>> codes.tolist(), clamped
    ([[228, 62, 34], [8, 12, 124]], 0.0)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from illuminant.display.gamma.lookup_table import quantised, top_code
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.displays import Display

    Codes = NDArray[np.unsignedinteger[Any]]
    Float64 = NDArray[np.float64]

__all__ = ["Degradation", "Loss", "Match", "degradation", "loss", "mapped", "remap"]

Match = Literal["relative", "absolute"]


@dataclass(frozen=True)
class Degradation:
    """What a mapping of stored codes costs.

    Attributes:
        mean: mean ΔE00 from the mapping of floats.
        largest: largest ΔE00.
        levels: codes of red, green and blue that occur after mapping the stored codes.
        float_levels: those that occur after mapping the floats.
        colours: distinct colours after mapping the stored codes.
        float_colours: those after mapping the floats.
        clamped: share of pixels that the other display cannot show.
    """

    mean: float
    largest: float
    levels: tuple[int, int, int]
    float_levels: tuple[int, int, int]
    colours: int
    float_colours: int
    clamped: float


@dataclass(frozen=True)
class Loss:
    """What became of stored codes, of which no floats are there any more.

    Attributes:
        mean: mean ΔE00 between the codes on the first display and their mapping on the other.
        largest: largest ΔE00.
        levels_before: codes of red, green and blue that occurred.
        levels: those that occur now.
        colours_before: distinct colours before.
        colours: distinct colours now.
    """

    mean: float
    largest: float
    levels_before: tuple[int, int, int]
    levels: tuple[int, int, int]
    colours_before: int
    colours: int


def _values(codes: ArrayLike, bits: int) -> Float64:
    """Code values 0 to 1 of whole codes."""
    import numpy as np

    array = np.asarray(codes)
    top = top_code(bits)
    if array.ndim < 1 or array.shape[-1] != 3 or array.dtype.kind not in "iu":
        raise UsageError(f"Codes are whole numbers of shape (..., 3), not {array.dtype} of {array.shape}.")
    if array.size and (array.min() < 0 or array.max() > top):
        raise UsageError(f"A code of {bits} bits is 0 to {top}, and there are others.")
    return np.asarray(array / top, np.float64)


def mapped(values: ArrayLike, source: Display, target: Display, match: str = "relative") -> Float64:
    """Linear RGB of another display that shows what a display shows of code values, both (..., 3); not clamped.

    Args:
        values: code values 0 to 1 of `source`.
        source: the display for which they were made.
        target: the display that shall show them.
        match: "relative" (white to white) or "absolute" (cd/m²).

    Raises:
        UsageError: there is no such match.
    """
    import numpy as np

    if match not in ("relative", "absolute"):
        raise UsageError(f'There is no match "{match}": expected relative or absolute.')
    xyz = np.asarray(source.to_xyz(values), np.float64)
    if match == "relative":
        xyz = xyz * (target.shown_white / source.shown_white)
    return np.asarray(target.from_xyz(xyz), np.float64)


# Beyond 0 and 1 by rounding alone no colour counts as clamped.
_ROUNDING = 1e-9


def remap(
    codes: ArrayLike,
    source: Display,
    target: Display,
    *,
    bits: int = 8,
    out_bits: int | None = None,
    match: Match = "relative",
) -> tuple[Codes, float]:
    """Codes for another display.

    Args:
        codes: (..., 3) whole codes made for `source`.
        source: the display for which they were made.
        target: the display that shall show them.
        bits: of the codes.
        out_bits: of the result; None: as many.
        match: "relative" (white to white) or "absolute" (cd/m²).

    Returns:
        The codes, and the share of pixels that were clamped.

    Raises:
        UsageError: the codes are not of these bits, or an argument is not possible.
    """
    linear = mapped(_values(codes, bits), source, target, match)
    beyond = ((linear < -_ROUNDING) | (linear > 1.0 + _ROUNDING)).any(axis=-1)
    shown = target.encode(linear.clip(0.0, 1.0))
    return quantised(shown, bits if out_bits is None else out_bits), float(
        beyond.mean() if beyond.size else 0.0
    )


def degradation(
    linear: ArrayLike,
    source: Display,
    target: Display,
    *,
    bits: int = 8,
    out_bits: int | None = None,
    match: Match = "relative",
) -> Degradation:
    """What is lost when an image is mapped from its stored codes and not from floating-point numbers.

    Args:
        linear: (..., 3) linear RGB of `source`, 0 to 1, as they were computed.
        source: the display for which the image was stored.
        target: the display that shall show it.
        bits: of the file.
        out_bits: of the result; None: as many.
        match: "relative" or "absolute".

    Raises:
        UsageError: the image is no RGB, or an argument is not possible.
    """
    import numpy as np

    from illuminant import color
    from illuminant.color.triples import floating

    image = np.nan_to_num(np.asarray(floating(linear), np.float64)).clip(0.0, 1.0)
    if image.ndim < 1 or image.shape[-1] != 3 or not image.size:
        raise UsageError(f"An image is linear RGB of shape (..., 3), not {image.shape}.")
    shown_bits = bits if out_bits is None else out_bits
    values = np.asarray(source.encode(image), np.float64)
    stored, clamped = remap(
        quantised(values, bits), source, target, bits=bits, out_bits=shown_bits, match=match
    )
    wanted = quantised(target.encode(mapped(values, source, target, match).clip(0.0, 1.0)), shown_bits)
    difference = np.asarray(
        color.delta_e_2000(_lab(wanted, shown_bits, target), _lab(stored, shown_bits, target))
    )
    return Degradation(
        float(difference.mean()),
        float(difference.max()),
        _levels(stored),
        _levels(wanted),
        _colours(stored),
        _colours(wanted),
        clamped,
    )


def loss(
    before: ArrayLike,
    after: ArrayLike,
    source: Display,
    target: Display,
    *,
    bits: int = 8,
    out_bits: int | None = None,
    match: Match = "relative",
) -> Loss:
    """What is lost by a mapping of codes, against the colours that the first display showed.

    Args:
        before: (..., 3) codes for `source`.
        after: (..., 3) what `remap` made of them.
        source: the display for which they were made.
        target: the display for which they are now.
        bits: of the codes before.
        out_bits: of the codes after; None: as many.
        match: as it was mapped.

    Raises:
        UsageError: the codes are not of these bits, or their shapes differ.
    """
    import numpy as np

    from illuminant import color

    old, new = np.asarray(before), np.asarray(after)
    if old.shape != new.shape or not old.size:
        raise UsageError(f"Codes before and after are of one shape, not {old.shape} and {new.shape}.")
    new_bits = bits if out_bits is None else out_bits
    white = source.shown_white if match == "relative" else target.shown_white
    xyz = np.asarray(source.to_xyz(_values(old, bits)), np.float64) / white
    wanted = color.xyz_to_lab(xyz, color.white_xyz(target.white))
    difference = np.asarray(color.delta_e_2000(wanted, _lab(new, new_bits, target)))
    return Loss(
        float(difference.mean()),
        float(difference.max()),
        _levels(old),
        _levels(new),
        _colours(old),
        _colours(new),
    )


def _lab(codes: Any, bits: int, display: Display) -> Float64:
    """L*a*b* of what a display shows of codes, under its own white."""
    import numpy as np

    from illuminant import color

    xyz = np.asarray(display.to_xyz(_values(codes, bits)), np.float64) / display.shown_white
    return np.asarray(color.xyz_to_lab(xyz, color.white_xyz(display.white)), np.float64)


def _levels(codes: Any) -> tuple[int, int, int]:
    """How many codes of red, green and blue occur."""
    import numpy as np

    red, green, blue = codes.reshape(-1, 3).T
    return (len(np.unique(red)), len(np.unique(green)), len(np.unique(blue)))


def _colours(codes: Any) -> int:
    """How many distinct colours there are."""
    import numpy as np

    red, green, blue = codes.reshape(-1, 3).astype(np.int64).T
    return len(np.unique((red << 32) + (green << 16) + blue))
