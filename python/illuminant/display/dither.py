"""Dither: fewer codes than the eye can count, without steps (book 5.1.4, figure 5.12).

The formulas are in the core (`crates/display/src/dither`). A dither comes last, after the transfer function and at
the depth of the display.

| name | where the error goes | source |
| --- | --- | --- |
| `none` | nowhere: the nearest code | – |
| `random` | a threshold of its own for every pixel and channel | book 5.1.4 |
| `ordered-2`, `ordered-4` | the book's tiles | Limb 1969; Jarvis, Judice and Ninke 1976 |
| `bayer-2` … `bayer-64` | recursive tiles | Bayer 1973 |
| `blue-noise` | a tile without low frequencies | Ulichney 1993 |
| `floyd-steinberg` | 7, 3, 5 and 1 sixteenths to the neighbours that come later | Floyd and Steinberg 1976 |
| `floyd-steinberg-book` | 3/8 right, 3/8 below, 1/4 below right | book 5.1.4 (ERRATA 58) |
| `floyd-steinberg-serpentine` | the same as the first, every other row backwards | Ulichney 1987 |
| `dot-diffusion`, `dot-diffusion-4` | to neighbours of a higher class, in cells of 8 × 8 or 4 × 4 | Knuth 1987 |

Values are code values, so the mean of the *codes* is right, and with codes as close as those of 8 bits the mean of the
*light* too. Far apart they differ: half of the pixels at 1 and half at 0 send half the light, where the code value ½ of
an sRGB display asks for 21 %. `for_light` turns values into those whose dither sends the right light: with L(c) the
light of a code, a value between the codes c and c + 1 becomes c + (L(v) − L(c)) / (L(c + 1) − L(c)). A halftone needs
it (`illuminant.display.patterning.halftone`).

Example:
    >>> import numpy as np
    >>> from illuminant.display import dither
    >>> field = np.full((8, 8, 3), 5.5 / 255, np.float32)
    >>> float(dither.quantise(field, 8, "ordered-2").mean())
    5.5
    >>> round(float(dither.for_light(np.full((1, 1, 3), 0.5), 1, "sRGB")[0, 0, 0]), 3)
    0.214
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.displays import Display

    Array = NDArray[np.floating[Any]]
    Codes = NDArray[np.uint8] | NDArray[np.uint16]

__all__ = ["check", "described", "for_light", "names", "quantise", "thresholds"]

_ABOUT = {
    "none": ("the nearest code, in steps", ""),
    "random": ("a threshold of its own for every pixel and channel", "book 5.1.4"),
    "ordered-2": ("the book's tile of 2 x 2", "Limb 1969"),
    "ordered-4": ("the book's tile of 4 x 4", "Jarvis, Judice, Ninke 1976"),
    "blue-noise": ("a tile without low frequencies (void and cluster)", "Ulichney 1993"),
    "floyd-steinberg": ("errors go on: 7, 3, 5 and 1 sixteenths", "Floyd, Steinberg 1976"),
    "floyd-steinberg-book": ("errors go on: 3/8, 3/8 and 1/4", "book 5.1.4"),
    "floyd-steinberg-serpentine": ("the published weights, to and fro", "Ulichney 1987"),
    "dot-diffusion": ("errors go to later classes, cells of 8 x 8", "Knuth 1987"),
    "dot-diffusion-4": ("errors go to later classes, cells of 4 x 4", "book figure 5.12"),
}


def names() -> list[str]:
    """The names of the dithers."""
    return [str(name) for name in core().dithers()]


def described(name: str) -> tuple[str, str]:
    """What a dither does, in a few words, and where it comes from.

    Raises:
        UsageError: there is no such dither.

    Example:
        >>> described("bayer-8")
        ('a recursive tile of 8 x 8', 'Bayer 1973')
    """
    check(name)
    kind, _, size = name.casefold().partition("-")
    if kind == "bayer":
        return f"a recursive tile of {size} x {size}", "Bayer 1973"
    return _ABOUT[name.casefold()]


def check(name: str) -> None:
    """Refuse a name that no dither has.

    Raises:
        UsageError: the sentence lists those there are.
    """
    if name.casefold() not in names():
        raise UsageError(f"There is no dither {name!r}: known are {', '.join(names())}.")


def quantise(
    values: ArrayLike, bits: int = 8, name: str = "none", seed: int = 0, *, channels_alike: bool = False
) -> Codes:
    """Codes of values from 0 to 1.

    Args:
        values: (h, w, c), or (h, w) for one channel, float32 or float64 (which is rounded to float32); values outside 0
            to 1 are taken to the nearer end, NaN to 0.
        bits: 1 to 16.
        name: one of `names()`.
        seed: of `random`.
        channels_alike: the tiles of `bayer-N` and `blue-noise` are not shifted from channel to channel. Shifted tiles
            make a grey gradation smoother in lightness, by a speckle of colour of one code; alike, grey stays grey.

    Returns:
        Of the same shape, uint8 up to 8 bits and uint16 above, from 0 to 2^bits − 1.

    Raises:
        UsageError: no such dither, or the array or the number of bits is not possible.
    """
    from illuminant.display.picture import check_bits

    check(name)
    check_bits(bits)
    if not 0 <= seed < 1 << 64:
        raise UsageError(f"A seed is a whole number from 0 to 2^64 − 1, not {seed}.")
    array, shape = as_image(values)
    codes: Codes = asked(
        core().dither, array, bits, name.casefold(), seed, channels_alike=channels_alike
    ).reshape(shape)
    return codes


def thresholds(name: str) -> Array | None:
    """The tile of thresholds of a dither, (h, w) from 0 to 1: code = ⌊value (2^bits − 1) + threshold⌋.

    Returns:
        None for a dither that has no tile: random, error and dot diffusion.

    Raises:
        UsageError: there is no such dither.

    Example:
        >>> (8 * thresholds("ordered-2")).tolist()
        [[1.0, 5.0], [7.0, 3.0]]
    """
    check(name)
    tile: Array | None = core().dither_thresholds(name.casefold())
    return tile


def for_light(values: ArrayLike, bits: int, display: str | Display = "sRGB") -> Array:
    """Values whose dither has the right mean of light, instead of the right mean of codes.

    Args:
        values: (h, w, 3), or one channel as (h, w) or (h, w, 1), from 0 to 1; what lies outside is taken to the nearer
            end, NaN to 0.
        bits: of the codes to come, 1 to 16.
        display: whose code values these are. One channel is taken as the first.

    Returns:
        float64 of the same shape; multiples of 1/(2^bits − 1) stay.

    Raises:
        UsageError: the array, the number of bits or the display is not possible.
    """
    import numpy as np

    from illuminant.display import displays
    from illuminant.display.picture import check_bits

    check_bits(bits)
    shown_on = displays.named(display)
    array, shape = as_image(values)
    if array.shape[2] not in (1, 3):
        raise UsageError(f"Values for a display have 1 or 3 channels, not {array.shape[2]}.")
    top = (1 << bits) - 1
    scaled = np.nan_to_num(np.clip(array.astype(np.float64), 0.0, 1.0)) * top
    below = np.minimum(np.floor(scaled), top - 1)

    def light(codes: Array, channel: int) -> Array:
        # As grey, since a display may let its channels act on each other (HLG).
        return shown_on.decode(np.repeat(codes[..., None] / top, 3, axis=-1))[..., channel]

    parts = []
    for channel in range(array.shape[2]):
        wanted, lower = scaled[..., channel], below[..., channel]
        dark, bright = light(lower, channel), light(lower + 1, channel)
        apart = bright > dark  # dark codes of a table may send the same
        part = np.divide(light(wanted, channel) - dark, bright - dark, out=wanted - lower, where=apart)
        parts.append((lower + np.clip(part, 0.0, 1.0)) / top)
    return np.stack(parts, axis=-1).reshape(shape)


def as_image(values: ArrayLike) -> tuple[Array, tuple[int, ...]]:
    """Values as an array (h, w, c) of floats in one piece, and the shape that they came in.

    Raises:
        UsageError: they are no such array.
    """
    import numpy as np

    try:
        array: Any = np.asarray(values)
        if array.dtype not in (np.float32, np.float64):
            array = array.astype(np.float64)
    except (TypeError, ValueError):
        raise UsageError("Values to be dithered are an array of numbers.") from None
    if array.ndim not in (2, 3) or array.size == 0:
        raise UsageError(f"Values to be dithered are an array (height, width, channels), not {array.shape}.")
    return np.ascontiguousarray(array if array.ndim == 3 else array[..., None]), array.shape


def asked(function: Any, *arguments: Any, **options: Any) -> Any:
    """What a function of the core answers; its refusals as our errors.

    Raises:
        UsageError: it refused.
    """
    try:
        return function(*arguments, **options)
    except (TypeError, ValueError, OverflowError) as error:
        raise UsageError(f"{str(error)[:1].upper()}{str(error)[1:].rstrip('.')}.") from error
