"""A frame buffer: the code values of a PNG as they are stored, and a PNG of the same kind with others.

Video takes code values as they are, so nothing is decoded here. What a file says of its colours (`sRGB`, `cICP`, or the
text "RGB system") is kept, and stated again in what is written.

Example:
    >>> import numpy as np
    >>> buffer = FrameBuffer(np.zeros((2, 3, 3), np.uint8))
    >>> buffer.with_values(np.full((2, 3, 3), 0.5)).codes[0, 0].tolist()
    [128, 128, 128]
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output
from illuminant.errors import ImageError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["FrameBuffer", "check_png", "opened"]


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


@dataclass(frozen=True)
class FrameBuffer:
    """Code values and whose they are.

    Attributes:
        codes: (h, w, 3), uint8 or uint16.
        system: name of the RGB system.
    """

    codes: NDArray[Any]
    system: str = "sRGB"

    @property
    def bits(self) -> int:
        """Of a channel: 8 or 16."""
        return int(self.codes.dtype.itemsize) * 8

    @property
    def values(self) -> Float64:
        """The code values from 0 to 1."""
        import numpy as np

        return np.asarray(self.codes / float(2**self.bits - 1), np.float64)

    def with_values(self, values: ArrayLike) -> FrameBuffer:
        """The same kind of buffer with other values (h, w, 3), clamped to 0 to 1 and rounded.

        Raises:
            UsageError: a value is not a number.
        """
        import numpy as np

        array = np.asarray(values, np.float64)
        if np.isnan(array).any():
            raise UsageError("A frame buffer cannot hold what is not a number.")
        top = 2**self.bits - 1
        codes = np.rint(np.clip(array, 0.0, 1.0) * top).astype(self.codes.dtype)
        return FrameBuffer(codes, self.system)

    def save(self, path: str | os.PathLike[str], *, what: str = "") -> None:
        """Write a PNG, whole or not at all.

        Args:
            path: ends in .png.
            what: is written as the file's description.

        Raises:
            UsageError, ImageError, MachineError: as `check_png`.
        """
        import numpy as np

        from illuminant import rgb_system
        from illuminant.core import core

        path = check_png(path)
        about = rgb_system.named(self.system)
        chromaticities = list(rgb_system.chromaticities(about))
        transfer = str(about["transfer"])
        text = [("RGB system", str(about["name"]))]
        content = core().encode_png(
            np.ascontiguousarray(self.codes),
            chromaticities=[*chromaticities[6:], *chromaticities[:6]],
            gamma=2.2 if transfer == "sRGB" else rgb_system.gamma(transfer),
            srgb=str(about["name"]) == "sRGB",
            text=[*text, ("Description", what)] if what else text,
        )
        output.write_bytes(path, bytes(content))


def opened(path: str | os.PathLike[str]) -> FrameBuffer:
    """The code values of a PNG; a grey one has its value three times, and transparency is left out.

    Raises:
        ImageError: there is no such file, it is no PNG, or it is damaged.

    Example:
        >>> opened("none.png")
        Traceback (most recent call last):
        illuminant.errors.ImageError: none.png cannot be read: there is no such file.
    """
    import numpy as np
    import OpenImageIO as oiio

    from illuminant import png

    path = Path(path)
    if path.is_dir():
        raise ImageError(f"{path} cannot be read: it is a folder.")
    if not path.is_file():
        raise ImageError(f"{path} cannot be read: there is no such file.")
    if path.suffix.lower() == ".exr":
        raise ImageError(
            f"{path} holds light, not code values: make a PNG of it first, for the display it is meant for."
        )
    header = png.read_header(path)
    # As stored: else what is transparent would be darkened.
    config = oiio.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(str(path), config)
    if file is None:
        raise ImageError(f"{path} cannot be read: {oiio.geterror() or 'it is damaged'}.")
    try:
        spec = file.spec()
        wide = spec.format.basetype == oiio.UINT16
        pixels = file.read_image(0, 0, 0, spec.nchannels, oiio.UINT16 if wide else oiio.UINT8)
        if pixels is None:
            raise ImageError(f"{path} cannot be read: {file.geterror() or 'it is damaged'}.")
    finally:
        file.close()
    codes = np.asarray(pixels).reshape(spec.height, spec.width, spec.nchannels)
    rgb = codes[..., :3] if spec.nchannels >= 3 else np.repeat(codes[..., :1], 3, axis=2)
    return FrameBuffer(np.ascontiguousarray(rgb), header.system or "sRGB")
