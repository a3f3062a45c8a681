"""Arrays of three values, taken through a chain of conversions of the core.

Every function of `illuminant.color` that maps colours keeps these rules:

- any shape (..., 3); a list of numbers serves as well;
- float32 stays float32, float64 stays float64, and every other kind of number is taken as float64;
- `out=` takes an array of the same shape and type to be filled and returned; it may be the input itself, or overlap
  with it. Any memory layout is accepted; arrays in the order of C, which lie in one piece, are read as they are;
- nothing is clamped, and NaN goes through to its own colour and no other;
- the work is spread over all processors, lets go of the interpreter, and gives the same bits on any number of threads.

Example:
    >>> import numpy as np
    >>> pixels = np.array([[0.25, 0.5, 0.25]], np.float32)
    >>> converted([step("named", "xyz_to_xyy")], pixels, pixels) is pixels, pixels.tolist()
    (True, [[0.25, 0.5, 0.5]])
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["asked", "converted", "floating", "output", "step"]


def asked(function: str, *arguments: Any) -> Any:
    """What a function of the core answers; its complaint becomes a `UsageError`."""
    try:
        found: Any = core()
        for name in function.split("."):
            found = getattr(found, name)
        return found(*arguments)
    except ValueError as error:
        sentence = str(error)
        raise UsageError(f"{sentence[:1].upper()}{sentence[1:]}.") from error


def step(kind: str, *arguments: Any) -> Any:
    """A conversion of the core: `step("encode", "sRGB")`.

    Raises:
        UsageError: an argument is not known; the sentence lists what is.
    """
    return asked(f"Conversion.{kind}", *arguments)


def floating(values: ArrayLike, what: str = "colours") -> Array:
    """The values as an array of float32 or float64 in the order of C; no copy of one that is so already.

    Raises:
        UsageError: the values are no real numbers.
    """
    import numpy as np

    try:
        array = np.asarray(values)
    except ValueError as error:
        raise UsageError(f"The {what} are no array: the rows differ in length.") from error
    if array.dtype == np.float32:
        return np.ascontiguousarray(array, np.float32).reshape(array.shape)
    if array.dtype.kind not in "fiubO":
        raise UsageError(f"The {what} must be real numbers, not {array.dtype}.")
    try:
        return np.ascontiguousarray(array, np.float64).reshape(array.shape)
    except (TypeError, ValueError) as error:
        raise UsageError(f"The {what} must be real numbers.") from error


def output(shape: tuple[int, ...], dtype: Any, out: Any) -> Array:
    """The array to be filled: a new one, or the caller's.

    Raises:
        UsageError: the caller's has another shape or type, or cannot be written.
    """
    import numpy as np

    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray) or out.shape != shape or out.dtype != dtype:
        found = f"{out.shape} of {out.dtype}" if isinstance(out, np.ndarray) else type(out).__name__
        raise UsageError(f"out must be an array of shape {shape} and type {np.dtype(dtype)}, not {found}.")
    if not out.flags.writeable:
        raise UsageError("out cannot be written.")
    return out


def converted(chain: Sequence[Any], values: ArrayLike, out: Array | None = None) -> Array:
    """The values (..., 3) after a chain of conversions.

    Args:
        chain: of `step`, in the order in which they are done.
        values: (..., 3).
        out: array to fill, or None for a new one; see the rules of this module.

    Raises:
        UsageError: values or `out` break a rule of this module.
    """
    import numpy as np

    array = floating(values)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise UsageError(f"Colours need a last axis of length 3, and the shape is {array.shape}.")
    result = output(array.shape, array.dtype, out)
    direct = result if result.flags.c_contiguous and result.flags.aligned else np.empty_like(array)
    if direct is result and np.may_share_memory(array, result):
        same = array.ctypes.data == result.ctypes.data and array.strides == result.strides
        # The core reads and writes block by block: an input that is shifted against the output would be overwritten.
        array = result if same else array.copy()
    core().convert(list(chain), array, direct)
    if direct is not result:
        result[...] = direct
    return result
