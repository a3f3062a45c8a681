"""What images say of a material: read, decoded and checked, for the entry of the description.

`Textures` keeps the images of one scene, each file once, under the names by which the description refers to them.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from illuminant import pixels, rgb_system, sources
from illuminant.curves import Curves
from illuminant.errors import ImageError
from illuminant.pattern_schema import ColourPattern, HeightPattern, PatternOnSurface, SlopePattern
from illuminant.report import Path, Report, found
from illuminant.sources import SourceError
from illuminant.spectra import Spectrum
from illuminant.texture_schema import ColourImage, HeightImage, ImageOnSurface, NormalImage, SlopeImage

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Textures"]

PREFIX = "texture "
"""What the names of texture images begin with, so that they are not those of lights."""

SRGB = ("sRGB/red", "sRGB/green", "sRGB/blue")


class Textures:
    """Resolves the images on the surfaces of one scene.

    Args:
        report: takes the mistakes.
        curves: resolves spectra.
        directory: folder that file names are relative to.
        allow_outside: whether files may lie outside that folder.
        up: axis that points up.
        unit_m: length unit, in m.
    """

    def __init__(
        self,
        report: Report,
        curves: Curves,
        directory: str | os.PathLike[str] = ".",
        up: str = "y",
        unit_m: float = 1.0,
        *,
        allow_outside: bool = False,
    ) -> None:
        self.up, self.unit_m = up, unit_m
        self.report = report
        self.curves = curves
        self.directory, self.allow_outside = FilePath(directory), allow_outside
        self.images: dict[str, np.ndarray] = {}
        self.warnings: list[str] = []

    def colour(
        self, image: ColourImage | ColourPattern, path: Path, *, finished: bool = False
    ) -> tuple[Spectrum, dict[str, Any]] | None:
        """The mean colour of an image or a pattern and its entry, or None after reporting mistakes.

        Args:
            image: the table.
            path: where it stands.
            finished: whether it shows finished paint, of which the pigment is wanted.
        """
        import numpy as np

        before = len(self.report.problems)
        if isinstance(image, ColourPattern):
            return self._between(image, path)
        if image.basis is not None and image.rgb_system is not None:
            self.report.add((*path, "rgb_system"), "goes with colours, not with basis", kind="unknown-key")
        system = self.curves.system(image.rgb_system, (*path, "rgb_system"))
        names: Sequence[Any] = image.basis or SRGB
        basis = [
            self.curves.resolve(value, "reflectance", (*path, "basis", i) if image.basis else path)
            for i, value in enumerate(names)
        ]
        read = self._read(image.image, path)
        if read is None or system is None or None in basis or len(self.report.problems) > before:
            return None
        values, whole_numbers = read
        encoded = image.encoding == "encoded" or (image.encoding is None and whole_numbers)
        curves = [curve for curve in basis if curve is not None]
        if image.basis is None:
            described = rgb_system.named(system)
            linear = np.asarray(
                rgb_system.linear(values, described["transfer"]) if encoded else values, np.float64
            )
            if system != "sRGB":
                to_srgb = np.array(rgb_system.named("sRGB")["from_xyz"]) @ np.array(described["to_xyz"])
                linear = linear @ to_srgb.T
            outside = ((linear < -1e-3) | (linear > 1.001)).any(axis=2)
            if outside.any():
                part = 100.0 * outside.mean()
                place = ".".join(str(one) for one in path)
                self.warnings.append(
                    f"{place}: {part:.2g} % of the pixels are no reflectance of sRGB's gamut, and are clipped to it"
                )
            linear = linear.clip(0.0, 1.0)
        else:
            linear = np.asarray(
                rgb_system.linear(values, "sRGB") if image.encoding == "encoded" else values,
                np.float64,
            )
            self._check_mixture(linear, curves, path)
        if len(self.report.problems) > before:
            return None
        kind = "colour" if image.basis is None else "parts"
        name = self._keep(image.image, f"{kind} {system} {encoded}", linear, path)
        r, g, b = (float(part) for part in linear.reshape(-1, 3).mean(axis=0))
        mean = r * curves[0] + g * curves[1] + b * curves[2]
        place = image.image if isinstance(image.image, str) else "an image"
        return replace(mean, name=f"mean of {place}"), {
            "map": self._map(image, name),
            "basis": curves,
            "finished": finished,
        }

    def _between(self, table: ColourPattern, path: Path) -> tuple[Spectrum, dict[str, Any]] | None:
        """The mean of the two colours of a pattern, and its entry."""
        curves = [
            self.curves.resolve(value, "reflectance", (*path, "colours", i))
            for i, value in enumerate(table.colours)
        ]
        none = self.curves.resolve(0.0, "reflectance", path)
        pattern = self._pattern(table, path)
        first, second = curves
        if first is None or second is None or none is None or pattern is None:
            return None
        mean = replace(0.5 * first + 0.5 * second, name=f"mean of {table.pattern}")
        return mean, {"map": pattern, "basis": [first, second, none], "finished": False}

    def _pattern(self, table: PatternOnSurface, path: Path) -> dict[str, Any] | None:
        """The entry of a pattern, or None after reporting mistakes."""
        up = [float(axis == self.up) for axis in "xyz"]
        axis = up if table.axis is None else [float(value) for value in table.axis]
        length = math.hypot(*axis)
        if not length > 0.0:
            self.report.add((*path, "axis"), "must have a length", kind="direction")
            return None
        on_surface = table.coordinates == "uv"
        unit = 1.0 if on_surface else self.unit_m
        return {
            "kind": table.pattern,
            "on_surface": on_surface,
            "scale": float(table.scale) * unit,
            "origin": [float(value) * unit for value in table.origin],
            "axis": [value / length for value in axis],
            "octaves": table.octaves,
            "amplitude": float(table.amplitude),
        }

    def slope(self, image: SlopeImage | SlopePattern, path: Path) -> dict[str, Any] | None:
        """The entry of an image or a pattern of roughness, or None after reporting mistakes."""
        if isinstance(image, SlopePattern):
            pattern, slopes = self._pattern(image, path), [float(image.black), float(image.white)]
            return pattern and {"map": pattern, "channel": 1, "slopes": slopes}
        read = self._read(image.image, path)
        if read is None or not self._fractions(read[0], path):
            return None
        name = self._keep(image.image, "values", read[0], path)
        slopes = [float(image.black), float(image.white)]
        return {"map": self._map(image, name), "channel": "rgb".index(image.channel), "slopes": slopes}

    def relief(self, image: HeightImage | NormalImage | HeightPattern, path: Path) -> dict[str, Any] | None:
        """The entry of an image of heights or normals or a pattern of heights, or None after reporting mistakes."""
        if isinstance(image, HeightPattern):
            pattern = self._pattern(image, path)
            return pattern and {
                "kind": "heights",
                "map": pattern,
                "height": float(image.height) * self.unit_m,
            }
        read = self._read(image.image, path)
        if read is None:
            return None
        name = self._keep(image.image, "values", read[0], path)
        if isinstance(image, HeightImage):
            return {
                "kind": "heights",
                "map": self._map(image, name),
                "channel": "rgb".index(image.channel),
                "height": float(image.height) * self.unit_m,
            }
        if read[0][..., 2].min() <= 0.525:
            message = (
                "is no map of normals: some point into the surface (the third channel must stay above 0.525)"
            )
            self.report.add((*path, "image"), message, kind="image")
            return None
        return {"kind": "normals", "map": self._map(image, name), "strength": float(image.strength)}

    def _read(self, image: Any, path: Path) -> tuple[np.ndarray, bool] | None:
        import numpy as np

        try:
            if isinstance(image, str):
                values, whole_numbers = pixels.read(
                    sources.located(image, self.directory, self.allow_outside)
                )
            elif isinstance(image, (dict, list, bool, int, float)) or image is None:
                raise ImageError(f"must be the name of a file, found {found(image)}")
            else:
                values, whole_numbers = np.asarray(image, np.float32), False
                if values.ndim == 2:
                    values = np.repeat(values[..., None], 3, axis=2)
                if values.ndim != 3 or values.shape[2] != 3 or not values.size:
                    raise ImageError(f"must have the shape (height, width, 3), found {values.shape}")
            if not np.isfinite(values).all():
                raise ImageError("has pixels that are not finite numbers")
        except SourceError as error:
            self.report.add_data_error((*path, "image"), error, error.kind)
            return None
        except ImageError as error:
            missing = str(error).endswith(": there is no such file")
            self.report.add((*path, "image"), str(error), kind="missing-file" if missing else "image")
            return None
        return values, whole_numbers

    def _fractions(self, values: np.ndarray, path: Path) -> bool:
        low, high = float(values.min()), float(values.max())
        if low < 0.0 or high > 1.0:
            message = f"must have values from 0 to 1, found {low:g} to {high:g}"
            self.report.add((*path, "image"), message, kind="range")
            return False
        return True

    def _check_mixture(self, parts: np.ndarray, basis: Sequence[Spectrum], path: Path) -> None:
        """No mixture may reflect less than nothing or more than all."""
        import numpy as np

        if float(parts.min()) < 0.0:
            self.report.add((*path, "image"), "has negative parts of its basis", kind="range")
            return
        first, last = self.curves.range_nm
        nanometres = np.arange(first, last + 1.0)
        rows = np.stack([np.asarray(curve.at(nanometres), float) for curve in basis])
        flat = parts.reshape(-1, 3)
        most = 0.0
        for start in range(0, len(flat), 65536):
            chunk = np.unique(flat[start : start + 65536], axis=0)
            most = max(most, float((chunk @ rows).max()))
        if most > 1.0 + 1e-5:
            message = f"has mixtures of its basis that reflect {most:.3f} of the light; at most 1 is possible"
            self.report.add((*path, "image"), message, kind="range")

    def _keep(self, image: Any, use: str, values: np.ndarray, path: Path) -> str:
        import numpy as np

        place = image if isinstance(image, str) else ".".join(str(part) for part in path)
        name = f"{PREFIX}{place} ({use})"
        if name not in self.images:
            self.images[name] = np.ascontiguousarray(values, np.float32)
        return name

    def _map(self, image: ImageOnSurface, name: str) -> dict[str, Any]:
        return {
            "image": name,
            "wrap": image.wrap,
            "filtering": image.filtering,
            "repeat": [float(value) for value in image.repeat],
            "offset": [float(value) for value in image.offset],
        }
