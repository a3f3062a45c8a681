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

from illuminant.errors import ImageError
from illuminant.schema import MAX_PIXELS

if TYPE_CHECKING:
    import numpy as np

__all__ = ["checked", "decode_srgb", "read"]


def read(path: str | os.PathLike[str]) -> np.ndarray:
    """The image of a file.

    Returns:
        float32 (h, w, 3), linear RGB.

    Raises:
        ImageError: the file is missing or damaged, or the image cannot be an environment; names the file.
    """
    import OpenImageIO as oiio

    path = Path(path)
    if not path.is_file():
        raise ImageError(f"{path}: there is no such file")
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise ImageError(f"{path}: cannot be read as an image ({_clause(oiio.geterror())})")
    try:
        spec = source.spec()
        if spec.width * spec.height > MAX_PIXELS:
            raise ImageError(
                f"{path}: has {spec.width} × {spec.height} pixels; at most {MAX_PIXELS} can be used"
            )
        pixels = source.read_image(0, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ImageError(f"{path}: is damaged ({_clause(source.geterror())})")
        names = [name.upper() for name in spec.channelnames]
        whole_numbers = spec.format.basetype not in (oiio.HALF, oiio.FLOAT, oiio.DOUBLE)
    finally:
        source.close()
    if {"R", "G", "B"} <= set(names):
        pixels = pixels[..., [names.index(name) for name in "RGB"]]
    elif pixels.shape[-1] < 3:
        pixels = pixels[..., [0, 0, 0]]
    try:
        return checked(decode_srgb(pixels) if whole_numbers else pixels)
    except ImageError as error:
        raise ImageError(f"{path}: {error}") from None


def checked(pixels: Any) -> np.ndarray:
    """An array as an environment image.

    Args:
        pixels: (h, w, 3) linear RGB, at least 1 × 2.

    Returns:
        float32 (h, w, 3).

    Raises:
        ImageError: a wrong shape, a negative value, a NaN or infinity, or no light at all.
    """
    import numpy as np

    try:
        image = np.array(pixels, dtype=np.float32, order="C")
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


def decode_srgb(encoded: np.ndarray) -> np.ndarray:
    """Linear values from sRGB's (IEC 61966-2-1), both from 0 to 1."""
    import numpy as np

    encoded = np.asarray(encoded, np.float64)
    return np.where(
        encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.04045) + 0.055) / 1.055) ** 2.4
    )


def _clause(text: str) -> str:
    return " ".join(text.split()).rstrip(".") or "unknown reason"
