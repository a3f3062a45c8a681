"""Two images as the two fields of a frame, and a frame as its fields (book 5.5, figure 5.21).

A frame of NTSC is seen as two fields, 1/60 s apart: the odd lines (the 1st, 3rd, 5th … from the top), then the even
ones. Images computed every 1/60 s and shown as fields move more smoothly than images computed every 1/30 s; a single
frame that holds the odd lines of one image and the even lines of the next can be recorded as any other.

Nothing is computed, so code values of any type come back bit for bit.

Example:
    >>> import numpy as np
    >>> odd, even = np.full((4, 2), 1), np.full((4, 2), 2)
    >>> weave(odd, even).tolist()
    [[1, 1], [2, 2], [1, 1], [2, 2]]
    >>> [field.tolist() for field in split(weave(odd, even))]
    [[[1, 1], [1, 1]], [[2, 2], [2, 2]]]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Pixels = NDArray[Any]
    Float64 = NDArray[np.float64]

__all__ = ["field_times_s", "full_height", "join", "split", "weave"]


def _images(*images: ArrayLike) -> list[Pixels]:
    import numpy as np

    arrays = [np.asarray(image) for image in images]
    for array in arrays:
        if array.ndim < 2 or array.size == 0:
            raise UsageError(f"A field or frame has rows and columns, not the shape {array.shape}.")
    return arrays


def weave(odd: ArrayLike, even: ArrayLike) -> Pixels:
    """The frame (h, w, …) with the odd lines of one image and the even lines of another.

    Args:
        odd: (h, w, …), the image of the first field; its 1st, 3rd, 5th … line are taken.
        even: of the same shape and type, 1/60 s later; its 2nd, 4th, 6th … line are taken.

    Raises:
        UsageError: the images differ in shape or type.

    Example:
        >>> weave([[1, 2]], [[1.0, 2.0]])
        Traceback (most recent call last):
        illuminant.errors.UsageError: The two images of a frame are alike in type, not int64 and float64.
    """
    first, second = _images(odd, even)
    if first.shape != second.shape:
        raise UsageError(
            f"The two images of a frame have one shape, not {first.shape} and {second.shape}; join takes fields."
        )
    if first.dtype != second.dtype:
        raise UsageError(
            f"The two images of a frame are alike in type, not {first.dtype} and {second.dtype}."
        )
    frame = first.copy()
    frame[1::2] = second[1::2]
    return frame


def split(frame: ArrayLike) -> tuple[Pixels, Pixels]:
    """The two fields of a frame (h, w, …): its odd lines (⌈h/2⌉, w, …) and its even lines (⌊h/2⌋, w, …).

    Raises:
        UsageError: a frame of one line has no second field.
    """
    (array,) = _images(frame)
    if len(array) < 2:
        raise UsageError("A frame of one line has no second field.")
    return array[0::2].copy(), array[1::2].copy()


def join(odd: ArrayLike, even: ArrayLike) -> Pixels:
    """The frame of two fields: the inverse of `split`.

    Raises:
        UsageError: the fields do not fit together.

    Example:
        >>> join(*split([[1], [2], [3]])).tolist()
        [[1], [2], [3]]
    """
    import numpy as np

    first, second = _images(odd, even)
    fits = first.shape[1:] == second.shape[1:] and first.dtype == second.dtype
    if not fits or len(first) - len(second) not in (0, 1):
        raise UsageError(f"Fields of the shapes {first.shape} and {second.shape} make no frame.")
    frame = np.empty((len(first) + len(second), *first.shape[1:]), first.dtype)
    frame[0::2], frame[1::2] = first, second
    return frame


def full_height(field: ArrayLike, parity: int, height: int) -> Float64:
    """An image of a field alone: its lines where they belong, the lines between them as means of their neighbours.

    Args:
        field: (n, w, …), from `split`.
        parity: 0 for the odd lines (the first field), 1 for the even ones.
        height: of the frame.

    Raises:
        UsageError: the field has not the lines that such a frame gives it.

    Example:
        >>> full_height([[0.0], [2.0]], 0, 4).tolist()
        [[0.0], [1.0], [2.0], [2.0]]
        >>> full_height([[0.0], [2.0]], 1, 4).tolist()
        [[0.0], [0.0], [1.0], [2.0]]
    """
    import numpy as np

    (array,) = _images(field)
    if parity not in (0, 1) or len(array) != (height + 1 - parity) // 2:
        raise UsageError(f"{len(array)} lines are no field {parity} (0 or 1) of a frame of {height} lines.")
    at = (np.arange(height) - parity) / 2.0
    low = np.clip(np.floor(at), 0, len(array) - 1).astype(int)
    high = np.clip(np.ceil(at), 0, len(array) - 1).astype(int)
    return np.asarray((array[low].astype(np.float64) + array[high]) / 2.0)


def field_times_s(frames: int, *, frames_per_second: float = 30.0) -> Float64:
    """When the fields (frames, 2) of an animation are seen, so that each is computed for its own time.

    Raises:
        UsageError: no frames, or no rate.

    Example:
        >>> (field_times_s(2) * 60).round(9).tolist()
        [[0.0, 1.0], [2.0, 3.0]]
    """
    import numpy as np

    if frames < 1 or not frames_per_second > 0:
        raise UsageError("The times of fields need frames, and frames a second, above 0.")
    return np.arange(2.0 * frames).reshape(frames, 2) / (2.0 * frames_per_second)
