"""Lookup tables of a frame buffer: a code of the image goes in, a code for the display comes out.

A table of 2^n entries, for images of n bits, holds whole numbers of m bits. For a correction curve c (book eq 5.1)

    entry(i) = round((2^m − 1) c(i / (2^n − 1)))

where `rounding` is "nearest" (halves go up) or "truncate". Table 5.1 of the book, 8 bits in and out with γ 2.2, is
truncated: all of its 52 printed entries come out so, and not when rounded.

Logarithmic storage (Blinn 1979; book 5.1.2, footnote 9) gives each step of an image's code the same ratio of
intensities. Over a contrast of C : 1, code i of N stands for

    intensity(i) = C^(i / (N − 1) − 1),       intensity(0) = 0

so black has code 0 for itself. `log_codes` stores, `log_intensity` reads, and `log_table` is the table through which a
monitor of gamma γ shows such codes; with 10 or 12 bits out hardly a step is lost.

Bits in are 1 to 16, bits out 1 to 16. Files: `illuminant.display.gamma.table_file`.

Example:
    >>> table = correction_table(2.2, rounding="truncate")          # table 5.1 of the book
    >>> table.entries[[0, 1, 3, 4, 255]].tolist()
    [0, 20, 33, 38, 255]
    >>> correction_table(2.2, out_bits=10)([1, 3, 4])
    array([ 82, 136, 155], dtype=uint16)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from illuminant.display.gamma.response import Curve, correction, curve_name
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Codes = NDArray[np.unsignedinteger[Any]]
    Float64 = NDArray[np.float64]

__all__ = [
    "LookupTable",
    "Rounding",
    "code_type",
    "correction_table",
    "log_codes",
    "log_intensity",
    "log_table",
    "quantised",
    "top_code",
]

Rounding = Literal["nearest", "truncate"]

# Powers come with a relative error of 1e-13, so a whole number of up to 16 bits may lie 1e-8 too low to be truncated.
_SLACK = 1e-7

CONTRAST = 1000.0
"""Ratio of white to the darkest intensity of logarithmic storage, when none is given."""


def top_code(bits: int, what: str = "A code") -> int:
    """The largest code of that many bits.

    Raises:
        UsageError: it is not a whole number from 1 to 16.

    Example:
        >>> top_code(10)
        1023
    """
    if isinstance(bits, bool) or not hasattr(bits, "__index__") or not 1 <= int(bits) <= 16:
        raise UsageError(f"{what} has 1 to 16 bits, not {bits}.")
    return int((1 << int(bits)) - 1)


def code_type(bits: int) -> Any:
    """The type of NumPy for codes of that many bits: uint8 or uint16."""
    import numpy as np

    top_code(bits)
    return np.uint8 if bits <= 8 else np.uint16


def quantised(values: ArrayLike, bits: int, rounding: Rounding = "nearest") -> Codes:
    """Whole codes of values 0 to 1; what lies outside is clamped, and NaN becomes 0.

    Args:
        values: any shape.
        bits: 1 to 16.
        rounding: "nearest" or "truncate".

    Raises:
        UsageError: the rounding or the number of bits is not possible.

    Example:
        >>> quantised([0.0, 0.5, 1.2], 8).tolist(), quantised(0.5, 8, "truncate").tolist()
        ([0, 128, 255], 127)
    """
    import numpy as np

    if rounding not in ("nearest", "truncate"):
        raise UsageError(f'There is no rounding "{rounding}": expected nearest or truncate.')
    top = top_code(bits)
    clean = np.nan_to_num(np.asarray(values, np.float64), nan=0.0, posinf=1.0, neginf=0.0)
    whole = np.floor(clean.clip(0.0, 1.0) * top + (0.5 if rounding == "nearest" else _SLACK))
    return np.minimum(whole, top).astype(code_type(bits))


@dataclass(frozen=True, eq=False)
class LookupTable:
    """A table, called like a function.

    Attributes:
        entries: (2^in_bits,) whole numbers from 0 to 2^out_bits − 1.
        in_bits: of the codes that go in.
        out_bits: of those that come out.
        name: what it does, for headings and files.
    """

    entries: Codes
    in_bits: int
    out_bits: int
    name: str = "table"

    def __post_init__(self) -> None:
        """Check size and values."""
        import numpy as np

        size, top = top_code(self.in_bits, "A table") + 1, top_code(self.out_bits, "An entry")
        entries = np.asarray(self.entries)
        if entries.shape != (size,) or entries.dtype.kind not in "iu":
            raise UsageError(f"A table for {self.in_bits} bits has {size} whole numbers.")
        if int(entries.min()) < 0 or int(entries.max()) > top:
            raise UsageError(f"An entry of {self.out_bits} bits is 0 to {top}, and the table has others.")
        object.__setattr__(self, "entries", entries.astype(code_type(self.out_bits)))

    def __call__(self, codes: ArrayLike) -> Codes:
        """The entries of codes of any shape.

        Raises:
            UsageError: a code is no whole number, or too large for the table.
        """
        import numpy as np

        array = np.asarray(codes)
        if array.dtype.kind not in "iu":
            raise UsageError(f"A table takes whole codes, not {array.dtype}.")
        if array.size and (array.min() < 0 or array.max() >= len(self.entries)):
            raise UsageError(
                f"A table for {self.in_bits} bits takes codes from 0 to {len(self.entries) - 1}."
            )
        return np.asarray(self.entries[array])

    @property
    def inputs(self) -> Float64:
        """What goes in, as values 0 to 1."""
        import numpy as np

        return np.arange(len(self.entries)) / (len(self.entries) - 1)

    @property
    def outputs(self) -> Float64:
        """What comes out, as values 0 to 1."""
        return self.entries / top_code(self.out_bits)


def correction_table(
    curve: Curve = 2.2, in_bits: int = 8, out_bits: int = 8, rounding: Rounding = "nearest"
) -> LookupTable:
    """The table that corrects for a monitor (book eq 5.1, table 5.1).

    Args:
        curve: γ of the monitor, or the name of a curve such as "sRGB"; 1 or "linear" leaves values as they are.
        in_bits: bits of the image, 1 to 16; there are 2^in_bits entries.
        out_bits: bits of the display, 1 to 16.
        rounding: "nearest" or "truncate".

    Raises:
        UsageError: an argument is not possible.

    Example:
        >>> correction_table(1, 8, 8, "truncate").entries.tolist() == list(range(256))
        True
    """
    import numpy as np

    top = top_code(in_bits, "A table")
    values = correction(np.arange(top + 1) / top, curve)
    return LookupTable(
        quantised(values, out_bits, rounding), in_bits, out_bits, f"correction for {curve_name(curve)}"
    )


# --- logarithmic storage ------------------------------------------------------------------------------------------


def _checked_contrast(contrast: float) -> float:
    """The contrast, when there is one."""
    if not 1.0 < contrast <= 1e12:
        raise UsageError(f"A contrast is above 1 and at most 1e12, not {contrast}.")
    return float(contrast)


def log_intensity(codes: ArrayLike, bits: int = 8, contrast: float = CONTRAST) -> Float64:
    """Intensities of logarithmic codes: C^(i/(N−1) − 1), and 0 for code 0.

    Args:
        codes: whole numbers of any shape.
        bits: of the codes.
        contrast: C, ratio of white to the intensity to which the scale would reach down at code 0.

    Example:
        >>> log_intensity([0, 1, 2, 255], 8, 1000).round(6).tolist()
        [0.0, 0.001027, 0.001056, 1.0]
    """
    import numpy as np

    array = np.asarray(codes, np.float64)
    exponent = array / top_code(bits) - 1.0
    return np.asarray(np.where(array > 0, _checked_contrast(contrast) ** exponent, 0.0))


def log_codes(
    linear: ArrayLike, bits: int = 8, contrast: float = CONTRAST, rounding: Rounding = "nearest"
) -> Codes:
    """Logarithmic codes of intensities 0 to 1 (Blinn 1979); what is darker than 1/C becomes 0.

    Example:
        >>> log_codes(log_intensity([0, 1, 77, 255])).tolist()
        [0, 1, 77, 255]
    """
    import numpy as np

    span = np.log(_checked_contrast(contrast))
    array = np.nan_to_num(np.asarray(linear, np.float64), nan=0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.where(array > 0, 1.0 + np.log(np.maximum(array, 0.0)) / span, 0.0)
    return quantised(values, bits, rounding)


def log_table(
    curve: Curve = 2.2,
    in_bits: int = 8,
    out_bits: int = 10,
    contrast: float = CONTRAST,
    rounding: Rounding = "nearest",
) -> LookupTable:
    """The table through which a monitor shows logarithmic codes: log to linear, and eq 5.1 after it.

    Example:
        >>> log_table(2.2, 8, 10)([0, 1, 128, 255])
        array([   0,   45,  214, 1023], dtype=uint16)
    """
    import numpy as np

    codes = np.arange(top_code(in_bits, "A table") + 1)
    values = correction(log_intensity(codes, in_bits, contrast), curve)
    name = f"logarithmic to {curve_name(curve)}, contrast {contrast:g}"
    return LookupTable(quantised(values, out_bits, rounding), in_bits, out_bits, name)
