"""Patterning: cells of pixels that show more levels than a pixel can (book 5.1.4, figure 5.11), and halftones.

A cell of n pixels of b bits has L = n (2^b − 1) + 1 levels, from all dark to all bright: 5 for a cell of 2 × 2 at one
bit, 1,021 at eight. The cell shows level ⌊m L⌋ of the mean m of the values on it, and the highest for m = 1. (The book
multiplies m by a little less than L, which is the same; for the *sum* of four values that is 5/4 less a little, and not
the printed 1.5, which at one bit points at a sixth pattern: ERRATA 57.) A pixel that is on stays on at every higher
level, so no false contours arise.

What is gained in levels is lost in resolution. Either each cell of the image shows its mean and the size stays, or
every pixel becomes a cell (`enlarge`). A dither gives as many levels without the loss (`illuminant.display.dither`);
`pattern-WxH` stands beside their names wherever the two are compared.

A halftone is a picture of one bit (or a few) a channel. On it the eye adds up light, not codes, so `halftone` brings
the mean of the light right (`illuminant.display.dither.for_light`).

Example:
    >>> from illuminant.display import patterning
    >>> patterning.levels("2x2"), patterning.levels("2x2", bits=8)
    (5, 1021)
    >>> patterning.patterns("2x2")[2].tolist()
    [[1, 0], [0, 1]]
    >>> patterning.quantise([[0.5, 1.0]], 1, "2x2", enlarge=True).tolist()
    [[1, 0, 1, 1], [0, 1, 1, 1]]
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.display import dither
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.picture import Picture

    Array = NDArray[np.floating[Any]]
    Codes = NDArray[np.uint8] | NDArray[np.uint16]
    Cell = str | tuple[int, int]

__all__ = [
    "CELLS",
    "check",
    "codes",
    "halftone",
    "halftone_values",
    "levels",
    "patterns",
    "quantise",
    "sides",
    "turns",
]

CELLS = ("2x2", "2x3", "3x3")
"""The cells that the book names."""

_LARGEST = 64


def sides(cell: Cell) -> tuple[int, int]:
    """Width and height of a cell, from `WxH` or from the two numbers.

    Raises:
        UsageError: this is no cell, or a side is not from 1 to 64.

    Example:
        >>> sides("2x3")
        (2, 3)
    """
    found = (
        re.fullmatch(r"(\d{1,4})[x×](\d{1,4})", cell.strip().casefold()) if isinstance(cell, str) else None
    )
    width, height = (int(found[1]), int(found[2])) if found else (0, 0) if isinstance(cell, str) else cell
    if not (1 <= width <= _LARGEST and 1 <= height <= _LARGEST):
        raise UsageError(f"A cell is WxH with sides of 1 to {_LARGEST} pixels, such as 2x3, not {cell!r}.")
    return width, height


def levels(cell: Cell, bits: int = 1) -> int:
    """How many levels a cell shows.

    Args:
        cell: `WxH`, or width and height.
        bits: of a pixel, 1 to 16.

    Raises:
        UsageError: the cell or the number of bits is not possible.
    """
    from illuminant.display.picture import check_bits

    check_bits(bits)
    width, height = sides(cell)
    return width * height * ((1 << bits) - 1) + 1


def turns(cell: Cell) -> NDArray[np.uint32]:
    """When each pixel of a cell is switched on, (h, w), 0 first.

    Example:
        >>> turns("3x3").tolist()
        [[6, 8, 4], [1, 0, 3], [5, 2, 7]]
    """
    found: NDArray[np.uint32] = core().patterning_turns(sides(cell))
    return found


def patterns(cell: Cell) -> NDArray[np.uint8]:
    """The patterns of a cell at one bit, from dark to bright: (levels, h, w) of 0 and 1 (figure 5.11)."""
    import numpy as np

    order = turns(cell)
    return (order[None] < np.arange(levels(cell))[:, None, None]).astype(np.uint8)


def quantise(values: ArrayLike, bits: int, cell: Cell, *, enlarge: bool = False) -> Codes:
    """Codes of values from 0 to 1 in patterns.

    Args:
        values: (h, w, c) or (h, w); what lies outside 0 to 1 is taken to the nearer end, NaN to 0.
        bits: of a code, 1 to 16.
        cell: `WxH`, or width and height.
        enlarge: every value becomes a cell, (h · height, w · width, c). Otherwise the shape stays, and every cell shows
            the mean of the values on it; cells are cut off at the right and the lower edge.

    Returns:
        uint8 up to 8 bits and uint16 above.

    Raises:
        UsageError: the values, the cell or the number of bits is not possible.
    """
    from illuminant.display.picture import check_bits

    check_bits(bits)
    width_height = sides(cell)
    array, shape = dither.as_image(values)
    found: Codes = dither.asked(core().patterning, array, bits, width_height, enlarge=enlarge)
    return found if len(shape) == 3 else found[..., 0]


def _cell_of(name: str) -> str | None:
    """The cell of `pattern-WxH`."""
    return name.casefold().removeprefix("pattern-") if name.casefold().startswith("pattern-") else None


def check(name: str) -> None:
    """Refuse what is neither a dither nor `pattern-WxH`.

    Raises:
        UsageError: the sentence lists those there are.
    """
    cell = _cell_of(name)
    if cell is not None:
        sides(cell)
    elif name.casefold() not in dither.names():
        known = ", ".join(dither.names())
        raise UsageError(f"There is no dither {name!r}: known are {known}, and pattern-WxH.")


def codes(values: ArrayLike, bits: int, name: str, seed: int = 0, *, channels_alike: bool = False) -> Codes:
    """Codes of values by any dither, or by patterns in cells (`pattern-2x2`), of the same shape.

    Raises:
        UsageError: there is no such dither, or the values or the number of bits are not possible.
    """
    check(name)
    cell = _cell_of(name)
    if cell is not None:
        return quantise(values, bits, cell)
    return dither.quantise(values, bits, name, seed, channels_alike=channels_alike)


def halftone_values(picture: Picture, bits: int = 1, *, grey: bool = False, mean: str = "light") -> Array:
    """The code values of a picture as they go into a dither of few bits.

    Args:
        picture: of any display and number of bits.
        bits: of the codes to come.
        grey: luminance takes the place of colour.
        mean: what a dither shall keep, `light` or `codes`.

    Raises:
        UsageError: `mean` is neither.
    """
    import numpy as np

    if mean not in ("light", "codes"):
        raise UsageError(f"A dither keeps the mean of light or of codes, not of {mean!r}.")
    values = picture.values
    if grey:
        weights = picture.display.to_xyz_matrix[1]
        luminance = picture.display.decode(values) @ (weights / weights.sum())
        values = picture.display.encode(np.repeat(luminance[..., None], 3, axis=-1))
    return dither.for_light(values, bits, picture.display) if mean == "light" else values


def halftone(
    picture: Picture,
    by: str = "pattern-2x2",
    bits: int = 1,
    *,
    enlarge: bool = False,
    grey: bool = False,
    mean: str = "light",
    seed: int = 0,
) -> Picture:
    """A picture of few bits that looks, from afar, like one of many.

    Args:
        picture: of any display and number of bits.
        by: `pattern-WxH`, or a dither.
        bits: of the result, 1 to 16.
        enlarge: every pixel becomes a cell; of patterns only.
        grey: without colour.
        mean: `light`, which looks right, or `codes`, the practice of the book's time, which is too bright.
        seed: of `random`.

    Raises:
        UsageError: a choice is not possible.

    Example:
        >>> from illuminant.display.picture import Picture
        >>> halftone(Picture.of_values([[[0.735] * 3]], "sRGB"), enlarge=True).codes[..., 0].tolist()
        [[1, 0], [0, 1]]
    """
    from illuminant.display.picture import Picture, check_bits

    check_bits(bits)
    check(by)
    cell = _cell_of(by)
    if enlarge and cell is None:
        raise UsageError(f"Only patterns make every pixel a cell: {by} cannot enlarge.")
    values = halftone_values(picture, bits, grey=grey, mean=mean)
    if cell is not None:
        found = quantise(values, bits, cell, enlarge=enlarge)
    else:
        # What is grey shall stay grey.
        found = dither.quantise(values[..., :1] if grey else values, bits, by, seed)
        found = found.repeat(3, axis=-1) if grey else found
    return Picture(found, picture.display, bits, dict(picture.text))
