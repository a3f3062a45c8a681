"""OpenEXR files: absolute colour, layers and lanes, with everything that is needed to read them rightly.

What a file written here holds:

- `R`, `G`, `B`: 32-bit floats (16-bit on request), in the RGB system that the standard attribute
  `chromaticities` states. The default is CIE XYZ itself, stated as ILM's own XYZ sample file does: primaries
  (1, 0), (0, 1), (0, 0) and white (1/3, 1/3), so that R is X, G is Y and B is Z. Viewers that honour
  `chromaticities` (tev, HDRView, openexr-viewer, exrdisplay) show it rightly; one that ignores it (GIMP, many
  compositors) shows XYZ as if it were sRGB: for those, save with `rgb="sRGB"`.
- `whiteLuminance` (standard) is the luminance in cd/m² of the value (1, 1, 1). It is 1, since Y is in cd/m²:
  values are never scaled.
- Layers as channels `NAME.X`, `NAME.Y`, `NAME.Z` or, with one value a pixel, `NAME.Z` for depth and `NAME`
  for others.
- Lanes, when they were kept, in the layout for spectral images of Fichet, Pacanowski and Wilkie (2021), one
  channel `S0.550,000nm` a lane, with `spectralLayoutVersion` and `emissiveUnits`, and in `illuminant:toXYZ`
  the 3 × N matrix (row by row) that takes the lanes to the image's XYZ. Those of each lamp by itself are channels
  `spectra:NAME.S0.550,000nm`, which readers of that layout pass over. `illuminant:basis` (JSON) says what they
  mean: see `illuminant.kept_spectra`.
- `illuminant:settings` (JSON) says how the image was made, `illuminant:exposure` which exposure shows it, and
  `illuminant:unit` what unit Y has. There is no date: the same render gives the same bytes.

References: OpenEXR standard attributes; Fichet, Pacanowski, Wilkie, "An OpenEXR Layout for Spectral Images",
JCGT 10(3), 2021.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import machine, sources
from illuminant.errors import ImageError, UsageError
from illuminant.sources import SourceError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["LARGEST_HALF", "XYZ", "Contents", "fits_half", "read", "write"]

LARGEST_HALF = 65504.0
"""The largest finite half float."""

LARGEST = 1 << 31
"""Values (pixels times channels) of the largest file that is read."""

MOST_BYTES = 16_000_000_000
"""The largest file."""

BYTES_A_VALUE = 12
"""Memory that a value takes while a file is read: 4 as it is in the file, and 8 in an image."""

MAGIC = b"\x76\x2f\x31\x01"
"""The first four bytes of every EXR file."""

XYZ = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1 / 3, 1 / 3)
"""`chromaticities` of CIE XYZ: x and y of red, green, blue and white."""

_LANE = re.compile(r"(?:(?P<layer>spectra:.*)\.)?S0\.(?P<nm>\d+),(?P<part>\d+)nm", re.DOTALL)
# Layers of one value a pixel whose channel compositing programs look for.
_SINGLE = {"depth": "Z"}


@dataclass
class Contents:
    """What an EXR file holds, as arrays.

    Attributes:
        rgb: (h, w, 3), in the system of `chromaticities`.
        chromaticities: x and y of red, green, blue and white; None when the file that was read does not say.
        layers: (h, w, c) arrays by name; those with three values are XYZ or vectors, never in an RGB system.
        wavelengths_nm: (N,) when lanes were kept.
        to_xyz: (3, N) when lanes were kept; the lanes themselves are the layer `spectra`, and those of each lamp the
            layers `spectra:NAME`.
        attributes: `illuminant:*` attributes without that prefix, and `whiteLuminance` when there is one.
        half: whether the numbers are (to be) 16-bit floats.
    """

    rgb: Array
    chromaticities: tuple[float, ...] | None = XYZ
    layers: dict[str, Array] = field(default_factory=dict)
    wavelengths_nm: Array | None = None
    to_xyz: Array | None = None
    attributes: dict[str, Any] = field(default_factory=dict)
    half: bool = False


def _lane(wavelength_nm: float) -> str:
    return f"S0.{wavelength_nm:.3f}nm".replace(".", ",").replace("S0,", "S0.", 1)


def _channels(contents: Contents) -> tuple[list[str], list[Array]]:
    """Names of the channels, and the arrays whose last axes they are, in the same order."""
    names = ["R", "G", "B"]
    arrays = [contents.rgb]
    for name, layer in contents.layers.items():
        count = layer.shape[2]
        if name.partition(":")[0] == "spectra" and contents.wavelengths_nm is not None:
            before = f"{name}." if ":" in name else ""
            names += [before + _lane(float(wavelength)) for wavelength in contents.wavelengths_nm]
        elif count == 1:
            names.append(f"{name}.{_SINGLE[name]}" if name in _SINGLE else name)
        elif count == 3:
            names += [f"{name}.{axis}" for axis in "XYZ"]
        else:
            names += [f"{name}.{index}" for index in range(count)]
        arrays.append(layer)
    return names, arrays


def fits_half(*arrays: Array) -> bool:
    """Whether every value of these arrays can be a 16-bit float.

    Example:
        >>> import numpy as np
        >>> fits_half(np.array([65504.0])), fits_half(np.array([1.0]), np.array([-7e4]))
        (True, False)
    """
    import numpy as np

    return all(float(np.abs(array).max(initial=0.0)) <= LARGEST_HALF for array in arrays)


def write(path: str | Path, contents: Contents) -> None:
    """Write an EXR file (not atomically: see `illuminant.output`).

    Args:
        path: the file; its name ends with `.exr`.
        contents: what to write; arrays of one height and width.

    Raises:
        UsageError: a value is too large for a half float.
        OSError: the file cannot be written whole (errno ENOSPC when nothing better is known).
    """
    import numpy as np
    import OpenImageIO as oiio

    names, arrays = _channels(contents)
    kind = np.float16 if contents.half else np.float32
    height, width = contents.rgb.shape[:2]
    if contents.half and not fits_half(*arrays):
        raise UsageError(
            f"A value of this image does not fit 16-bit floats, whose largest is {LARGEST_HALF:g}."
        )
    pixels = np.empty((height, width, len(names)), kind)
    first = 0
    for array in arrays:
        pixels[..., first : first + array.shape[2]] = array
        first += array.shape[2]

    spec = oiio.ImageSpec(width, height, len(names), oiio.HALF if contents.half else oiio.FLOAT)
    spec.channelnames = tuple(names)
    spec.attribute("compression", "zip")
    spec.attribute("DateTime", "")  # the same render shall give the same bytes
    spec.attribute("chromaticities", "float[8]", tuple(contents.chromaticities or XYZ))
    for key, value in contents.attributes.items():
        if key == "settings":
            value = json.dumps(value)
        if key in ("whiteLuminance", "Software"):
            spec.attribute(key, value)
        else:
            spec.attribute(f"illuminant:{key}", value)
    if contents.wavelengths_nm is not None:
        spec.attribute("spectralLayoutVersion", "1.0")
        spec.attribute("emissiveUnits", "W.m^-2.sr^-1.nm^-1")
    if contents.to_xyz is not None:
        matrix = contents.to_xyz
        if contents.wavelengths_nm is not None:
            matrix = matrix[
                :, contents.wavelengths_nm.argsort(kind="stable")
            ]  # the order in which lanes are read
        numbers = tuple(float(number) for number in matrix.ravel())
        spec.attribute("illuminant:toXYZ", f"float[{len(numbers)}]", numbers)

    file = oiio.ImageOutput.create(str(path))
    if file is None:
        raise ImageError(f"OpenImageIO cannot write EXR here: {oiio.geterror()}.")
    written = file.open(str(path), spec) and file.write_image(pixels)
    message = "" if written else file.geterror()
    written = file.close() and written
    if not written or not _whole(path, height):
        # The library says no more than "File output failed"; ask the system what it thinks of this file.
        _probe(Path(path))
        raise OSError(28, "no space left on device, or it failed", message)


def _whole(path: str | Path, height: int) -> bool:
    """Whether the last rows can be read back: closing reports no failure of its last flush."""
    import OpenImageIO as oiio

    file = oiio.ImageInput.open(str(path))
    if file is None:
        return False
    try:
        return file.read_scanlines(height - 1, height, 0, 0, 1) is not None
    finally:
        file.close()


def _probe(path: Path) -> None:
    """Append to the file that failed, so that the system raises its own error (full, too large, I/O)."""
    with open(path, "ab") as file:
        file.write(bytes(65536))


def _check_magic(path: str | Path) -> None:
    """Refuse what is no EXR at all in plainer words than the library's."""
    try:
        with sources.opened(path, MOST_BYTES) as file:
            magic = file.read(4)
    except SourceError as error:
        raise ImageError(f"{path} cannot be read: {error.clause}.") from None
    if magic != MAGIC:
        raise ImageError(f"{path} cannot be read: it does not begin as an EXR file does.")


def read(path: str | Path) -> Contents:
    """Read an EXR file, written here or elsewhere.

    Args:
        path: the file.

    Returns:
        Its contents; a file with luminance only is given three equal channels. What the data window leaves of the
        display window is 0, and what lies outside the display window is left out. An exposure or a luminance of white
        that is no positive number is left out as well, and a unit that is no text.

    Raises:
        ImageError: the file is not there, is no EXR, has no colour or has it as luminance and chroma, or states its
            chromaticities, settings or lanes by what cannot be that.
        MachineError: it does not fit into the memory that is free.
    """
    import numpy as np
    import OpenImageIO as oiio

    _check_magic(path)
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise ImageError(f"{path} cannot be read: {_reason(oiio.geterror)}.")
    try:
        spec = file.spec()
        size = max(spec.width * spec.height, spec.full_width * spec.full_height)
        values = size * spec.nchannels
        if not 0 < values <= LARGEST:
            raise ImageError(f"{path} has {values:,} values: 1 to {LARGEST:,} are read.")
        names, attributes = _described(spec, path)
        colour = _colour(names, path)
        tile = spec.tile_width * spec.tile_height * spec.nchannels
        if tile > LARGEST:
            raise ImageError(f"{path} has tiles of {tile:,} values: at most {LARGEST:,} are read.")
        machine.check_file(path, BYTES_A_VALUE * (values + tile))
        pixels = file.read_image(oiio.FLOAT)
        if pixels is None:
            raise ImageError(f"{path} cannot be read: {_reason(file.geterror)}.")
    finally:
        file.close()
    pixels = _in_display_window(np.asarray(pixels).reshape(spec.height, spec.width, spec.nchannels), spec)
    index = {name: i for i, name in enumerate(names)}
    with np.errstate(invalid="ignore"):  # a signalling NaN is as good as another
        rgb = pixels[..., [index[name] for name in colour]].astype(np.float64)
    contents = Contents(
        rgb=rgb,
        chromaticities=XYZ if colour[0] == "X" else _chromaticities(attributes.get("chromaticities"), path),
        half=spec.format == oiio.HALF,
    )
    _read_layers(contents, pixels, [name for name in names if name not in (*colour, "A")], index)
    for key, value in attributes.items():
        if key == "whiteLuminance" or (key.startswith("illuminant:") and key != "illuminant:toXYZ"):
            contents.attributes[key.removeprefix("illuminant:")] = value
    for key, fits in (
        ("exposure", _positive),
        ("whiteLuminance", _positive),
        ("unit", _words),
        ("rgbSystem", _words),
    ):
        if key in contents.attributes and not fits(contents.attributes[key]):
            del contents.attributes[key]
    if isinstance(contents.attributes.get("settings"), str):
        try:
            contents.attributes["settings"] = json.loads(contents.attributes["settings"])
        except (ValueError, RecursionError):
            raise ImageError(
                f"{path} cannot be read: its attribute illuminant:settings is damaged."
            ) from None
    numbers = attributes.get("illuminant:toXYZ")
    if numbers is not None:
        try:
            matrix = np.asarray(numbers, np.float64).ravel()
        except (ValueError, TypeError):
            raise ImageError(f"{path} cannot be read: illuminant:toXYZ holds no numbers.") from None
        lanes = 0 if contents.wavelengths_nm is None else len(contents.wavelengths_nm)
        if matrix.size != 3 * lanes:
            raise ImageError(
                f"{path} cannot be read: illuminant:toXYZ has {matrix.size} numbers for {lanes} wavelengths."
            )
        contents.to_xyz = matrix.reshape(3, -1)
    return contents


def _described(spec: Any, path: str | Path) -> tuple[list[str], dict[str, Any]]:
    """Names of the channels, and the attributes; one whose text is no UTF-8 is left out."""
    try:
        names = list(spec.channelnames)
    except UnicodeDecodeError:
        raise ImageError(f"{path} cannot be read: the name of a channel is no text.") from None
    attributes = {}
    for item in spec.extra_attribs:
        try:
            attributes[item.name] = item.value
        except UnicodeDecodeError:
            continue
    return names, attributes


def _colour(names: list[str], path: str | Path) -> tuple[str, str, str]:
    """Which channels are the colour."""
    if chroma := [name for name in ("Y", "RY", "BY") if name in names and {"RY", "BY"} & set(names)]:
        raise ImageError(
            f"{path} cannot be read: its channels {', '.join(chroma)} are luminance and chroma, and R, G, B or X, Y, Z "
            "are read."
        )
    known = (("R", "G", "B"), ("X", "Y", "Z"), ("Y", "Y", "Y"))
    colour = next((one for one in known if set(one) <= set(names)), None)
    if colour is None:
        raise ImageError(f"{path} has no colour: its channels are {', '.join(names)}.")
    return colour


def _in_display_window(pixels: Array, spec: Any) -> Array:
    """What the display window shows: 0 where the file has no data."""
    import numpy as np

    x, y = spec.x - spec.full_x, spec.y - spec.full_y
    width, height = spec.full_width, spec.full_height
    if (x, y, spec.width, spec.height) == (0, 0, width, height) or width < 1 or height < 1:
        return pixels
    whole = np.zeros((height, width, pixels.shape[2]), pixels.dtype)
    left, top = max(x, 0), max(y, 0)
    right, bottom = min(x + spec.width, width), min(y + spec.height, height)
    if left < right and top < bottom:
        whole[top:bottom, left:right] = pixels[top - y : bottom - y, left - x : right - x]
    return whole


def _positive(value: Any) -> bool:
    """Whether this is a positive number, and finite."""
    return isinstance(value, (int, float)) and 0 < value < math.inf


def _words(value: Any) -> bool:
    """Whether this is a text."""
    return isinstance(value, str)


def _reason(ask: Callable[[], str]) -> str:
    """What the library says of its failure, which may quote bytes that are no text."""
    try:
        return " ".join(ask().split()).rstrip(".") or "it is damaged"
    except UnicodeDecodeError:
        return "its header is damaged"


def _chromaticities(values: Any, path: str | Path) -> tuple[float, ...] | None:
    """x and y of red, green, blue and white, checked; None when they are not stated."""
    if values is None:
        return None
    try:
        found = tuple(float(value) for value in values)
    except (ValueError, TypeError):
        found = ()
    if len(found) != 8 or not all(abs(value) <= 10.0 for value in found):
        raise ImageError(f"{path} cannot be read: its chromaticities are not x and y of four colours.")
    xr, yr, xg, yg, xb, yb, _, white = found
    if not white > 1e-6:
        raise ImageError(f"{path} cannot be read: its white has a y of {white:g}.")
    if abs((xg - xr) * (yb - yr) - (xb - xr) * (yg - yr)) < 1e-6:
        raise ImageError(f"{path} cannot be read: its chromaticities lie on one line.")
    return found


def _read_layers(contents: Contents, pixels: Array, names: list[str], index: dict[str, int]) -> None:
    """Gather channels into layers by the part of their name before the last dot."""
    import numpy as np

    lanes = {name: match for name in names if (match := _LANE.fullmatch(name))}
    wavelengths = {name: float(f"{match['nm']}.{match['part']}") for name, match in lanes.items()}
    for layer in dict.fromkeys(match["layer"] for match in lanes.values()):
        own = [name for name, match in lanes.items() if match["layer"] == layer]
        order = sorted(own, key=wavelengths.__getitem__)
        if layer is None:
            contents.wavelengths_nm = np.array([wavelengths[name] for name in order])
        contents.layers[layer or "spectra"] = pixels[..., [index[name] for name in order]]
    groups: dict[str, list[str]] = {}
    for name in names:
        if name not in lanes:
            groups.setdefault(name.rpartition(".")[0] or name, []).append(name)
    for layer, channels in groups.items():
        contents.layers[layer] = pixels[..., [index[name] for name in channels]]
