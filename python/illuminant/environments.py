"""Environment images: latitude-longitude pictures of the light from all around, as linear RGB.

HDR, EXR and other images in floating point are taken as they are, linear; PNG, JPEG and other images in whole numbers
are decoded from sRGB. The top row is the up axis. Values are radiances up to one factor, which the scene states as
the luminance of RGB (1, 1, 1).

Example:
    >>> from illuminant.environments import read
    >>> read("scenes/images/studio.hdr").shape             # doctest: +SKIP
    (512, 1024, 3)
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import pixels
from illuminant.errors import ImageError
from illuminant.schema import MAX_PIXELS

if TYPE_CHECKING:
    import numpy as np

__all__ = ["checked", "read"]


def read(path: str | os.PathLike[str]) -> np.ndarray:
    """The image of a file.

    Returns:
        float32 (h, w, 3), linear RGB.

    Raises:
        ImageError: the file is missing or damaged, or the image cannot be an environment; names the file.
    """
    values, whole_numbers = pixels.read(path)
    try:
        return checked(pixels.decode_srgb(values) if whole_numbers else values)
    except ImageError as error:
        raise ImageError(f"{Path(path)}: {error}") from None


def checked(values: Any) -> np.ndarray:
    """An array as an environment image.

    Args:
        values: (h, w, 3) linear RGB, at least 1 × 2.

    Returns:
        float32 (h, w, 3).

    Raises:
        ImageError: a wrong shape, a negative value, a NaN or infinity, or no light at all.
    """
    import numpy as np

    try:
        image = np.array(values, dtype=np.float32, order="C")
    except (TypeError, ValueError):
        image = np.zeros(0, np.float32)
    if image.ndim != 3 or image.shape[2] != 3 or not image.size:
        raise ImageError(f"must have the shape (height, width, 3), found {image.shape}")
    if image.shape[0] * image.shape[1] > MAX_PIXELS:
        raise ImageError(f"has {image.shape[1]} × {image.shape[0]} pixels; at most {MAX_PIXELS} can be used")
    for wrong, what in (
        (~np.isfinite(image), "that is not a finite number"),
        (image < 0, "that is negative"),
    ):
        if wrong.any():
            y, x, _ = np.argwhere(wrong)[0]
            raise ImageError(
                f"has {int(wrong.any(axis=2).sum())} pixels with a value {what}, first at ({x}, {y})"
            )
    if not image.any():
        raise ImageError("is black everywhere")
    return image
