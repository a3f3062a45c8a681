"""A picture: code values for one display, and the PNG file that says which display they are for.

Between an image (absolute colour, `illuminant.image.Image`) and a picture lies the whole of book figure 5.1; here
only what was decided is kept. A file of ours holds the display's description as text (`Display`, JSON), beside the
chunks that other programs read:

- sRGB: `sRGB`, with `gAMA` and `cHRM` for older readers.
- Display P3, Rec.2020 PQ and HLG, and linear XYZ: `cICP` (code points of ITU-T H.273) and `cHRM`.
- All others: `cHRM`, `gAMA` where light is a power of the code value, and an ICC profile (`iCCP`).
- `sBIT` when the picture has other than 8 or 16 bits: its codes are spread over the next larger of the two.

A file that says nothing of this is not guessed at: it is refused until its display is named.

Reference: W3C, Portable Network Graphics (PNG) Specification, third edition, 2025.

Example:
    >>> import tempfile, pathlib
    >>> picture = Picture.of_values([[[0.0, 0.5, 1.0]]], "Display P3", bits=8)
    >>> picture.codes.tolist()
    [[[0, 128, 255]]]
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "a.png"
    >>> picture.save(path)
    >>> Picture.open(path).display.name
    'Display P3'
"""

from __future__ import annotations

import json
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from illuminant import machine, output, sources
from illuminant.display import displays
from illuminant.errors import ImageError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Codes = NDArray[np.uint8] | NDArray[np.uint16]
    Array = NDArray[np.float64]

__all__ = ["EXTENSIONS", "Picture", "check_bits", "check_name"]

EXTENSIONS = (".png", ".rle")


@dataclass
class Picture:
    """Code values for a display.

    Attributes:
        codes: (h, w, 3), uint8 up to 8 bits and uint16 above; from 0 to 2^bits − 1.
        display: whose code values they are.
        bits: of a channel, 1 to 16.
        text: keyword and value of each text chunk of the file.
        matte: (h, w) uint8, how much of each pixel is covered, 255 for all of it; None when nothing is known of it.
            It is read from a run-length file or from the opacity of a PNG, and kept by run-length files only.
    """

    codes: Codes
    display: displays.Display
    bits: int = 8
    text: dict[str, str] = field(default_factory=dict)
    matte: NDArray[np.uint8] | None = None

    def __post_init__(self) -> None:
        """Check shape, type and range."""
        import numpy as np

        self.display = displays.named(self.display)
        check_bits(self.bits)
        wanted = np.uint8 if self.bits <= 8 else np.uint16
        codes = np.asarray(self.codes)
        if codes.ndim != 3 or codes.shape[2] != 3 or codes.size == 0:
            raise UsageError(f"A picture is an array of shape (height, width, 3), not {codes.shape}.")
        if not np.issubdtype(codes.dtype, np.integer) or int(codes.max()) > self.top or int(codes.min()) < 0:
            raise UsageError(f"A picture of {self.bits} bits holds whole numbers from 0 to {self.top}.")
        self.codes = cast("Codes", np.ascontiguousarray(codes, wanted))
        if self.matte is not None:
            matte = np.asarray(self.matte)
            if matte.shape != codes.shape[:2] or matte.dtype != np.uint8:
                wanted_matte = f"uint8 of shape {codes.shape[:2]}"
                raise UsageError(
                    f"The matte of this picture is {wanted_matte}, not {matte.dtype} of {matte.shape}."
                )
            self.matte = matte

    @classmethod
    def of_values(
        cls,
        values: ArrayLike,
        display: str | displays.Display,
        bits: int = 8,
        text: dict[str, str] | None = None,
    ) -> Picture:
        """A picture of code values 0 to 1, rounded to the nearest code; what lies outside, and NaN, is clamped.

        Args:
            values: (h, w, 3).
            display: a display, or its name.
            bits: of a channel, 1 to 16.
            text: keyword and value of each text chunk.
        """
        import numpy as np

        check_bits(bits)
        top = (1 << bits) - 1
        inside = np.nan_to_num(np.clip(np.asarray(values, np.float64), 0.0, 1.0))
        codes = np.floor(inside * top + 0.5)  # halves go up, as in every table of the field
        kind = np.uint8 if bits <= 8 else np.uint16
        return cls(cast("Codes", codes.astype(kind)), displays.named(display), bits, dict(text or {}))

    @property
    def top(self) -> int:
        """The largest code, 2^bits − 1."""
        return (1 << self.bits) - 1

    @property
    def width(self) -> int:
        """Width in pixels."""
        return int(self.codes.shape[1])

    @property
    def height(self) -> int:
        """Height in pixels."""
        return int(self.codes.shape[0])

    @property
    def values(self) -> Array:
        """Code values from 0 to 1, (h, w, 3)."""
        import numpy as np

        return self.codes.astype(np.float64) / self.top

    def xyz(self) -> Array:
        """What the display sends, XYZ in cd/m², (h, w, 3)."""
        return self.display.to_xyz(self.values)

    def encode(self, text: dict[str, str] | None = None) -> bytes:
        """The PNG file; a matte is left out.

        Args:
            text: text chunks to be added to the picture's own.

        Raises:
            UsageError: no chunk of a PNG can state the primaries of the display.
        """
        from illuminant import png

        return png.encode(self.codes, self.bits, self.display, self.text | (text or {}))

    def save(self, path: str | os.PathLike[str], text: dict[str, str] | None = None) -> None:
        """Write the file, whole or not at all.

        Args:
            path: ends with `.png`, or with `.rle` for a run-length encoded image (`illuminant.display.run_length`).
            text: text chunks to be added to the picture's own; a run-length file has none. A PNG keeps no
                matte.

        Raises:
            UsageError: the name ends otherwise, or a run-length file cannot hold this picture.
            ImageError, MachineError: as `illuminant.output.write_bytes`.
        """
        path = check_name(path)
        if path.suffix.lower() == ".rle":
            self._save_run_length(path)
            return
        output.write_bytes(path, self.encode(text))

    def _save_run_length(self, path: Path) -> None:
        import numpy as np

        from illuminant.display import run_length

        gamma = self.display.gamma
        if self.bits != 8 or gamma is None:
            raise UsageError(
                f"{path}: a run-length file has 8 bits a channel, for a display whose light is a power of the code "
                f"value; {self.display.name} with {self.bits} bits is not that (try --display 'book NTSC')."
            )
        run_length.write(
            path,
            np.asarray(self.codes, np.uint8),
            self.matte,
            primaries=self.display.primaries,
            white=self.display.white,
            gamma=None if gamma == 1.0 else gamma,
        )

    @classmethod
    def open(
        cls,
        path: str | os.PathLike[str],
        assume: str | displays.Display | None = None,
        *,
        bytes_a_pixel: int = 24,
    ) -> Picture:
        """Open a PNG file, made here or elsewhere, or a run-length file.

        Args:
            path: the file.
            assume: the display to take when the file does not say which it is for.
            bytes_a_pixel: memory that will be needed for each pixel.

        Raises:
            ImageError: the file is not there, is no whole PNG, or does not say which display it is for.
            MachineError: the picture does not fit into the memory that is free.
        """
        if Path(path).suffix.lower() == ".rle":
            return cls._open_run_length(path, bytes_a_pixel)
        from illuminant import png

        codes, matte, header = png.decode(path, bytes_a_pixel)
        display = header.display
        if display is None:
            if assume is None:
                raise ImageError(
                    f"{path} does not say which display its numbers are for: name one (--assume sRGB, assume=...)."
                )
            display = displays.named(assume)
        return cls(codes, display, header.bits, header.text, matte)

    @classmethod
    def _open_run_length(cls, path: str | os.PathLike[str], bytes_a_pixel: int) -> Picture:
        import struct

        from illuminant.display import run_length

        try:
            with sources.opened(path, sys.maxsize) as file:
                start = file.read(16)
        except SourceError as error:
            raise ImageError(f"{path} cannot be read: {error.clause}.") from None
        if start.startswith(b"ILRL") and len(start) == 16:
            width, height = struct.unpack_from(">II", start, 8)
            if width * height <= run_length.MOST_PIXELS:  # what is larger is refused by its reader
                machine.check_file(path, bytes_a_pixel * width * height)
        found = run_length.read(path)
        red, green, blue = found.primaries
        response = "linear" if found.gamma is None else f"gamma {found.gamma:.9g}"
        display = displays.Display("run-length", (red, green, blue), found.white, response)
        return cls(found.rgb, display, matte=found.matte)

    @property
    def settings(self) -> dict[str, Any]:
        """How the picture was made, if its file says so."""
        try:
            found = json.loads(self.text.get("Settings", "{}"))
        except (ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}

    def _repr_png_(self) -> bytes:
        """The picture as a PNG, which notebooks show."""
        return self.encode()


def check_name(path: str | os.PathLike[str]) -> Path:
    """Refuse a name that no picture has.

    Raises:
        UsageError: it ends neither with `.png` nor with `.rle`.
    """
    path = Path(path)
    if path.suffix.lower() not in EXTENSIONS:
        raise UsageError(f"{path}: a picture for a display is saved as .png, or .rle for run lengths.")
    return path


def check_bits(bits: int) -> None:
    """Refuse a number of bits that no picture has.

    Raises:
        UsageError: it is not from 1 to 16.
    """
    if not 1 <= bits <= 16:
        raise UsageError(f"A picture has 1 to 16 bits a channel, not {bits}.")
