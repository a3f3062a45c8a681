"""A frame buffer: the code values of a PNG as they are stored, and a PNG of the same kind with others.

Video takes code values as they are, so nothing is decoded here. Which display a file is for is kept, and stated again
in what is written; a file that does not say is not guessed at, but refused until its display is named. What a file says
of how light became its codes (`Look`, `Exposure`) holds no more for other codes, and is not kept.

Example:
    >>> import numpy as np
    >>> from illuminant.display.picture import Picture
    >>> buffer = Picture.of_values(np.zeros((2, 3, 3)), "SMPTE-C", bits=8)
    >>> other = with_values(buffer, np.full((2, 3, 3), 0.5), "grey")
    >>> other.codes[0, 0].tolist(), other.display.name
    ([128, 128, 128], 'SMPTE-C')
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant import output
from illuminant.display.picture import Picture
from illuminant.errors import ImageError, UsageError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from illuminant.display.displays import Display

__all__ = ["OUTDATED", "check_png", "opened", "with_values"]

OUTDATED = ("Look", "Exposure", "Display")
"""Text chunks that are true of the codes they came with, and of no others."""


def check_png(path: str | os.PathLike[str]) -> Path:
    """Refuse a path that a PNG cannot be written to.

    Raises:
        UsageError: it does not end in .png.
        ImageError, MachineError: as `illuminant.output.check`.
    """
    path = Path(path)
    if path.suffix.lower() != ".png" and not path.is_dir():
        raise UsageError(f"{path}: expected a file that ends in .png, which holds code values.")
    return output.check(path)


def with_values(buffer: Picture, values: ArrayLike, what: str) -> Picture:
    """A picture for the same display and of as many bits, with other values (h, w, 3), clamped to 0 to 1 and rounded.

    Args:
        buffer: gives display, bits, and how it was made.
        values: code values from 0 to 1.
        what: becomes its description.

    Raises:
        UsageError: a value is not a number.
    """
    import numpy as np

    array = np.asarray(values, np.float64)
    if np.isnan(array).any():
        raise UsageError("A frame buffer cannot hold what is not a number.")
    text = {key: value for key, value in buffer.text.items() if key not in OUTDATED}
    return Picture.of_values(array, buffer.display, buffer.bits, text | {"Description": what})


def opened(path: str | os.PathLike[str], assume: str | Display | None = None) -> Picture:
    """The code values of a PNG; a grey one has its value three times, and transparency is left out.

    Args:
        path: the file.
        assume: the display to take when the file does not say which it is for.

    Raises:
        ImageError: there is no such file, it is no PNG, it is damaged, or it does not say its display.

    Example:
        >>> opened("none.png")
        Traceback (most recent call last):
        illuminant.errors.ImageError: none.png cannot be read: there is no such file.
    """
    path = Path(path)
    if path.is_dir():
        raise ImageError(f"{path} cannot be read: it is a folder.")
    if not path.is_file():
        raise ImageError(f"{path} cannot be read: there is no such file.")
    if path.suffix.lower() == ".exr":
        raise ImageError(
            f"{path} holds light, not code values: make a PNG of it first, for the display it is meant for."
        )
    return Picture.open(path, assume)
