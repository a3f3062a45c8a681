"""An image: absolute colour, and everything that is known of how it was made.

The colour of a pixel is XYZ (CIE 1931 2°) in absolute units: Y is the luminance in cd/m² (with K_m = 683
lm/W). Nothing is scaled or clamped until a display is asked for: `save("a.png")` and `show()` take a
`illuminant.display.look.Look`; `save("a.exr")` writes the numbers as they are.

With no exposure given, the scene's white is mapped to 0.8 of the display's: white is the 98th percentile of Y
over the pixels that do not emit light themselves (a lamp in the picture shall not make the rest dark).

Example:
    >>> import numpy as np
    >>> image = Image(np.full((2, 3, 3), 50.0))
    >>> image.width, image.height, image.auto_exposure()
    (3, 2, 0.016)
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant import output
from illuminant.errors import ImageError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.displays import Display
    from illuminant.display.look import Look, Shown
    from illuminant.kept_spectra import KeptSpectra

    Array = NDArray[np.floating[Any]]

__all__ = ["EXTENSIONS", "UNIT", "WHITE", "Image", "Saved", "check_output"]

UNIT = "cd/m2"
"""Unit of Y of an image that was rendered."""

RELATIVE = "relative"
"""Unit of Y of an image that came from a file which states none: 1 is the display's white."""

WHITE = 0.8
"""Display value, linear, to which an exposure that was not given maps the scene's white."""

PERCENTILE = 98.0
"""Which percentile of Y is the scene's white."""

EXTENSIONS = (".exr", ".png")

BYTES_A_PIXEL = 80
"""Memory that a picture takes while it becomes an image: codes, code values, light and XYZ, the last three float64."""


class Saved(NamedTuple):
    """What `Image.save` did.

    Attributes:
        path: the file.
        exposure: factor from Y to the display's 0 to 1; None for an EXR, which is never scaled.
        chosen: whether the exposure was chosen from the image, not given.
        outside: fraction of pixels outside the display's gamut or above its white; None for an EXR.
    """

    path: Path
    exposure: float | None
    chosen: bool
    outside: float | None


def check_output(path: str | os.PathLike[str]) -> Path:
    """Refuse a path that an image cannot be saved to, before it is rendered.

    Raises:
        UsageError: its extension is neither `.exr` nor `.png`.
        ImageError, MachineError: as `illuminant.output.check`.
    """
    path = Path(path)
    if path.suffix.lower() not in EXTENSIONS and not path.is_dir():
        what = f"has the extension {path.suffix}" if path.suffix else "has no extension"
        raise UsageError(
            f"{path} {what}: an image is saved as .exr (absolute colour) or .png (for a display)."
        )
    return output.check(path)


@dataclass
class Image:
    """Absolute colour, layers, and how they were made.

    Attributes:
        xyz: (h, w, 3) float64; Y in `unit`.
        layers: further arrays (h, w, c) by name: `depth` (m), `normal`, `albedo` (XYZ, relative), `samples`,
            `lamp:NAME` (XYZ, in `unit`), `spectra` (lanes, W/(sr m² nm)), `spectra:NAME` (lanes of the light of
            one lamp), `emission` (1 where a pixel shines itself).
        unit: of Y: `cd/m2`, or `relative` for an image from a file that does not say.
        settings: what is needed to make it again: scene, hash, version, technique, sampling, samples, seed,
            ...
        exposure: factor from Y to the display's 0 to 1 that the scene's author or the caller gave; None if
            nobody did.
        statistics: how the work went: seconds, rays, dropped samples; not saved.
        wavelengths_nm, to_xyz: of the lanes (N,) and (3, N), when they were kept; xyz = to_xyz @ lanes.
        basis: what the lanes mean: sampling, lamps and reflectances; for `illuminant.display.develop`.
    """

    xyz: Array
    layers: dict[str, Array] = field(default_factory=dict)
    unit: str = UNIT
    settings: dict[str, Any] = field(default_factory=dict)
    exposure: float | None = None
    statistics: dict[str, Any] = field(default_factory=dict)
    wavelengths_nm: Array | None = None
    to_xyz: Array | None = None
    basis: KeptSpectra | None = None

    def __post_init__(self) -> None:
        """Check the shape of the colour."""
        import numpy as np

        self.xyz = np.asarray(self.xyz, np.float64)
        if self.xyz.ndim != 3 or self.xyz.shape[2] != 3 or self.xyz.size == 0:
            raise UsageError(f"An image is an array of shape (height, width, 3), not {self.xyz.shape}.")

    def __repr__(self) -> str:
        """Size, unit and layers, without the numbers."""
        layers = f", layers {', '.join(self.layers)}" if self.layers else ""
        return f"<Image {self.width}x{self.height}, XYZ in {self.unit}{layers}>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        """The absolute XYZ, so that NumPy takes an image as an array."""
        import numpy as np

        return np.array(self.xyz, dtype=dtype, copy=True if copy is None else copy)

    @property
    def width(self) -> int:
        """Width in pixels."""
        return int(self.xyz.shape[1])

    @property
    def height(self) -> int:
        """Height in pixels."""
        return int(self.xyz.shape[0])

    def white(self) -> float:
        """The scene's white: 98th percentile of Y over the pixels that do not emit; over all if there are none else.

        Returns:
            Luminance in `unit`; 0 for a black image.
        """
        import numpy as np

        luminance = self.xyz[..., 1]
        finite = np.isfinite(luminance)
        emission = self.layers.get("emission")
        if emission is not None:
            lit = luminance[finite & (emission[..., 0] == 0)]
            if lit.size and lit.max() > 0:
                return float(np.percentile(lit, PERCENTILE))
        return float(np.percentile(luminance[finite], PERCENTILE)) if finite.any() else 0.0

    def auto_exposure(self) -> float:
        """The exposure that maps the scene's white to 0.8 of the display's, to six digits; 1 for a black image.

        It is rounded so that the number printed repeats the picture exactly. Pixels that are infinite or no numbers
        have no say.
        """
        import numpy as np

        white = self.white()
        if white <= 0:
            luminance = self.xyz[..., 1]
            white = float(luminance.max(initial=0.0, where=np.isfinite(luminance)))
        if not white > 0 or not math.isfinite(WHITE / white):
            return 1.0
        return float(f"{WHITE / white:.6g}")

    def save(
        self,
        path: str | os.PathLike[str],
        look: Look | None = None,
        *,
        exposure: float | None = None,
        rgb: str | None = None,
        half: bool = False,
    ) -> Saved:
        """Save as EXR (absolute, all layers) or PNG (for a display), atomically.

        Args:
            path: ends with `.exr` or `.png`.
            look: for PNG, the display, tone operator, gamut method, dither and bits; default sRGB with 8 bits.
            exposure: for PNG, the factor from Y to the display's 0 to 1; default that of the look, else the image's
                own, else `auto_exposure()`. An EXR is never scaled: it only notes the exposure.
            rgb: name of the RGB system of an EXR; default XYZ.
            half: 16-bit floats, for EXR; their largest is 65,504.

        Returns:
            Path, exposure, whether it was chosen here, and the fraction of pixels outside the gamut.

        Raises:
            UsageError: the extension, RGB system or exposure is not possible.
            ImageError: the path cannot be written.
            MachineError: the disk is full or fails; nothing is left behind, and an older file is as it was.

        Example:
            >>> image.save("room.png", exposure=0.01)     # doctest: +SKIP
        """
        path = check_output(path)
        if exposure is None and look is not None:
            exposure = look.exposure
        given = self.exposure if exposure is None else exposure
        if given is not None and not (given > 0 and math.isfinite(given)):
            raise UsageError(f"An exposure is a positive number, not {given}.")
        used = self.auto_exposure() if given is None else float(given)
        self._say_what_is_no_number(path)
        if path.suffix.lower() == ".exr":
            self._save_exr(path, used, rgb or "XYZ", half)
            return Saved(path, None, False, None)
        shown = self.shown(look, exposure=used)
        shown.picture.save(path)
        return Saved(path, used, given is None, shown.outside)

    def _say_what_is_no_number(self, path: Path) -> None:
        """Count pixels that hold NaN, and say so in the log: renders drop such samples, arrays come from anywhere."""
        import logging

        import numpy as np

        for name, layer in {"colour": self.xyz, **self.layers}.items():
            count = int(np.isnan(layer).any(axis=-1).sum())
            if count:
                logging.getLogger("illuminant").warning(
                    "%s: the %s of %d pixel%s is no number (NaN).", path, name, count, "s" * (count != 1)
                )

    def shown(self, look: Look | None = None, *, exposure: float | None = None) -> Shown:
        """The image as a picture for a display, and what was met on the way.

        Args:
            look: the display, tone operator, gamut method, dither and bits; default sRGB with 8 bits.
            exposure: as for `save`.

        Raises:
            UsageError: a choice is not possible.

        Example:
            >>> import numpy as np
            >>> Image(np.full((1, 1, 3), 40.0)).shown(exposure=0.0125).picture.display.name
            'sRGB'
        """
        from dataclasses import replace

        from illuminant.display.look import Look, show

        look = look or Look()
        used = exposure or look.exposure or self.exposure or self.auto_exposure()
        if not (used > 0 and math.isfinite(used)):
            raise UsageError(f"An exposure is a positive number, not {used}.")
        text = {
            "Software": f"illuminant {_version()}",
            "Description": f"display white is {1 / used:.6g} {self.unit} (exposure {used:.6g})",
            "Exposure": f"{used:.9g}",
            "Unit": self.unit,
            "Look": json.dumps(look.to_dict()),
        }
        if self.settings:
            text["Settings"] = json.dumps(self.settings)
        return show(self.xyz, replace(look, exposure=used), text)

    def _save_exr(self, path: Path, exposure: float, rgb: str, half: bool) -> None:
        import numpy as np

        from illuminant import exr

        attributes: dict[str, Any] = {
            "Software": f"illuminant {_version()}",
            "unit": self.unit,
            "exposure": float(exposure),
            "settings": self.settings,
        }
        if self.unit == UNIT:
            attributes["whiteLuminance"] = 1.0
        if self.basis is not None and "spectra" in self.layers:
            attributes["basis"] = self.basis.to_json()
        colour = self.xyz
        chromaticities: tuple[float, ...] = exr.XYZ
        if rgb.upper() != "XYZ":
            from illuminant import rgb_system

            system = rgb_system.named(rgb)
            with np.errstate(invalid="ignore", over="ignore"):  # an infinite pixel becomes no number
                colour = self.xyz @ np.asarray(system["from_xyz"]).T
            chromaticities = rgb_system.chromaticities(system)
            attributes["rgbSystem"] = str(system["name"])
        contents = exr.Contents(
            rgb=colour,
            chromaticities=chromaticities,
            layers={name: layer for name, layer in self.layers.items() if name != "emission"},
            wavelengths_nm=self.wavelengths_nm,
            to_xyz=self.to_xyz,
            attributes=attributes,
            half=half,
        )
        output.write(path, lambda temporary: exr.write(temporary, contents))

    @classmethod
    def open(cls, path: str | os.PathLike[str], assume: str | Display | None = None) -> Image:
        """Open an EXR or a PNG, made here or elsewhere.

        An EXR written here comes back with its layers, lanes, unit, settings and exposure. One from
        elsewhere is taken to XYZ by its `chromaticities`, and is absolute if it has `whiteLuminance`, else relative. A
        PNG is decoded by the display that it states and is relative: the display's (diffuse) white has Y = 1.

        Args:
            path: the file.
            assume: the display (for EXR, the RGB system) whose numbers these are if the file does not say.

        Raises:
            ImageError: the file is not there, damaged, no image of these kinds, or does not say how its numbers are
                meant.
            MachineError: the image does not fit into the memory that is free.

        Example:
            >>> Image.open("room.exr").xyz.shape       # doctest: +SKIP
            (540, 960, 3)
        """
        path = Path(path)
        if path.is_dir():
            raise ImageError(f"{path} cannot be read: it is a folder.")
        if not path.is_file():
            raise ImageError(f"{path} cannot be read: there is no such file.")
        if path.suffix.lower() in (".png", ".rle"):
            from illuminant.display.picture import Picture

            picture = Picture.open(path, assume, bytes_a_pixel=BYTES_A_PIXEL)
            xyz = picture.xyz() / picture.display.shown_white
            return cls(xyz, unit=RELATIVE, settings=picture.settings, exposure=1.0)
        if path.suffix.lower() == ".exr":
            return cls._open_exr(path, assume)
        raise ImageError(f"{path} cannot be read: only .exr, .png and .rle are.")

    @classmethod
    def _open_exr(cls, path: Path, assume: str | Display | None) -> Image:
        import numpy as np

        from illuminant import exr
        from illuminant.display import displays

        contents = exr.read(path)
        xyz = contents.rgb
        if contents.chromaticities is None:
            if assume is None:
                raise ImageError(
                    f"{path} does not say which primaries its numbers are for: name their RGB system (--assume sRGB, "
                    "assume=...)."
                )
            matrix: Array = displays.named(assume).to_xyz_matrix
        else:
            matrix = _to_xyz(contents.chromaticities)
        if contents.chromaticities is None or not np.allclose(contents.chromaticities, exr.XYZ, atol=1e-6):
            with np.errstate(invalid="ignore", over="ignore"):  # an infinite pixel becomes no number
                xyz = xyz @ matrix.T
        found = contents.attributes
        white = found.get("whiteLuminance", 0.0)
        unit = found.get("unit") or (UNIT if white > 0 else RELATIVE)
        settings = found.get("settings")
        basis = None
        if contents.wavelengths_nm is not None and isinstance(found.get("basis"), str):
            from illuminant.kept_spectra import KeptSpectra

            try:
                basis = KeptSpectra.from_json(found["basis"])
            except ImageError as error:
                raise ImageError(f"{path} cannot be read: {error}.") from None
            except RecursionError:
                raise ImageError(
                    f"{path} cannot be read: its attribute illuminant:basis is damaged."
                ) from None
            if len(basis.wavelengths_nm) != len(contents.wavelengths_nm):
                raise ImageError(
                    f"{path} cannot be read: it has {len(contents.wavelengths_nm)} lanes, and illuminant:basis has "
                    f"{len(basis.wavelengths_nm)}."
                )
        return cls(
            xyz * white if white > 0 and white != 1.0 else xyz,
            layers=contents.layers,
            unit=str(unit),
            settings=settings if isinstance(settings, dict) else {},
            # Seven digits take back the rounding to a 32-bit float.
            exposure=float(f"{found['exposure']:.7g}") if found.get("exposure") else None,
            wavelengths_nm=contents.wavelengths_nm,
            to_xyz=contents.to_xyz,
            basis=basis,
        )

    def show(self, *, exposure: float | None = None) -> None:
        """Show the image: in a notebook as output, else in the system's viewer of PNG files.

        Args:
            exposure: as for `save`.
        """
        content = self.shown(exposure=exposure).picture.encode()
        try:
            from IPython import get_ipython

            notebook = get_ipython() is not None
        except ImportError:
            notebook = False
        if notebook:
            from IPython.display import Image as Picture
            from IPython.display import display

            display(Picture(content))
            return
        import tempfile
        import webbrowser

        handle, name = tempfile.mkstemp(prefix="illuminant-", suffix=".png")
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        webbrowser.open(Path(name).as_uri())

    def _repr_png_(self) -> bytes:
        """The image as a PNG, which notebooks show."""
        return self.shown().picture.encode()


def _version() -> str:
    import illuminant

    return illuminant.__version__


def _to_xyz(chromaticities: tuple[float, ...]) -> Array:
    """Matrix from an RGB system, stated by x and y of its primaries and white, to XYZ with Y = 1 for (1, 1, 1)."""
    import numpy as np

    xy = np.asarray(chromaticities, np.float64).reshape(4, 2)
    # Columns X, Y, Z of each primary with X + Y + Z = 1: a primary may have y = 0, as those of XYZ do.
    primaries = np.stack([xy[:3, 0], xy[:3, 1], 1.0 - xy[:3].sum(axis=1)])
    white = np.array([xy[3, 0], xy[3, 1], 1.0 - xy[3].sum()])
    return np.asarray(primaries * np.linalg.solve(primaries, white / white[1]))
