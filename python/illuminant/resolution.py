"""From the tables of a scene to plain data: names, files, units and spectra are looked up, and every mistake is kept.

`Resolver` knows the frame of a scene (unit, up axis, wavelength range, folder, named spectra) and turns one material,
light or camera at a time into its entry of the description that the core reads: metres, seconds, nm. It never stops
at a mistake; the `Report` holds them. Objects are resolved in `objects`.

A material's entry has curves in place (`Spectrum`); `indexed` numbers them at the end, each different curve once, in
the order of first use with keys in alphabetical order, so that equal scenes have equal descriptions.
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from illuminant import (
    archives,
    environments,
    finishes,
    machine,
    materials,
    panoramas,
    photometry_file,
    placement,
    sources,
    spectra,
)
from illuminant.coefficient_schema import ALL_MODELS, Coefficients
from illuminant.core import core
from illuminant.curves import Curves, curve_from_spectrum
from illuminant.errors import DataError, ImageError, MachineError, suggestion
from illuminant.pattern_schema import ColourPattern, SlopePattern
from illuminant.photometry_file import Photometry
from illuminant.quantities import FITTING, QUANTITIES
from illuminant.report import Path, Report, found, read_table
from illuminant.schema import (
    KINDS_OF_ATMOSPHERE,
    KINDS_OF_LIGHT,
    KINDS_OF_MATERIAL,
    MAX_PIXELS,
    Camera,
    Medium,
    Table,
)
from illuminant.sources import SourceError, is_outside
from illuminant.spectra import Spectrum
from illuminant.texture_schema import ColourImage, SlopeImage
from illuminant.textures import Textures

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Material", "Resolver", "in_place", "indexed"]

MOST_BYTES_OF_DENSITY = 4_000_000_000
"""The largest file of the density of a medium."""
MOST_CELLS_ALONG = 10_000
"""The most cells of a density along one axis: a ray passes as many."""

BYTES_A_CELL = 32
"""Memory that a cell of it takes while it is read, at 4 bytes a cell in the file."""

NAMES_OF_SOURCES = {
    "emitter": "an emitter",
    "point": "a point light",
    "spot": "a spot light",
    "directional": "a directional light",
    "environment": "an environment",
    "sky": "a sky",
    "environment image": "an environment image",
    "fog": "fog",
}


@dataclass(frozen=True)
class Material:
    """A material of the description, what images say of it, and what its objects emit (None: nothing)."""

    entry: dict[str, Any]
    skin: dict[str, Any]
    emission: dict[str, Any] | None


class Resolver:
    """Resolves the parts of one scene.

    Args:
        report: takes the mistakes.
        frame: the keys `length_unit`, `up`, `range_nm` and `spectra` of the scene.
        directory: folder that file names are relative to.
        allow_outside: whether files may lie outside that folder.
    """

    def __init__(
        self,
        report: Report,
        frame: Mapping[str, Any],
        directory: str | os.PathLike[str] = ".",
        *,
        allow_outside: bool = False,
    ) -> None:
        self.report = report
        self.unit_m = placement.METRES[frame.get("length_unit", "m")]
        self.up: str = frame.get("up", "y")
        first, last = frame.get("range_nm", (380.0, 780.0))
        self.directory, self.allow_outside = FilePath(directory), allow_outside
        self.curves = Curves(
            report, frame.get("spectra"), directory, (first, last), allow_outside=allow_outside
        )
        self.images: dict[str, np.ndarray] = {}
        self.textures = Textures(
            report, self.curves, directory, self.up, self.unit_m, allow_outside=allow_outside
        )

    def all_images(self) -> dict[str, np.ndarray]:
        """The images of environments and of surfaces, by the names that the description has for them."""
        return self.images | self.textures.images

    def warnings(self) -> list[str]:
        """Sentences on what was accepted but may surprise."""
        return [*self.curves.warnings, *self.textures.warnings, *self.curves.mixture()]

    # --- materials ---------------------------------------------------------------------------------------------

    def material(self, name: str, raw: Any) -> Material | None:
        """A material, or None after reporting its mistakes."""
        path: Path = ("materials", name)
        before = len(self.report.problems)
        table, bad = self._kind(KINDS_OF_MATERIAL, raw, path)
        if table is None:
            return None
        if table.kind == "named":
            return self._named(name, table, bad, path)
        entry: dict[str, Any] = {"kind": table.kind}
        skin: dict[str, Any] = {}
        emission = None
        if table.kind == "diffuse":
            entry["reflectance"] = self._colour(table, bad, "reflectance", path, skin)
        elif table.kind == "filter":
            entry["transmittance"] = self._colour(table, bad, "transmittance", path, skin)
        elif table.kind == "translucent":
            entry["reflectance"] = self._colour(table, bad, "reflectance", path, skin)
            entry["transmittance"] = self._spectrum(table, bad, "transmittance", "reflectance", path)
            self._shares(entry["reflectance"], entry["transmittance"], path)
        elif table.kind == "conductor":
            for part in ("n", "k"):
                entry[part] = self._part_of(table, bad, "metal", part, path)
            entry["finish"] = self._finish(table, raw, bad, path, table.metal or "")
        elif table.kind == "dielectric":
            entry["n"] = self._part_of(table, bad, "medium", "n", path)
            entry["finish"] = self._finish(table, raw, bad, path)
            entry["absorption"] = self._spectrum(table, bad, "absorption", "absorption", path)
            entry["dispersion"] = table.dispersion
            self._one_way(raw, ("medium", "n"), path)
        elif table.kind == "coated":
            entry |= self._coated(table, raw, bad, path, skin)
        else:
            black = 0.0 if table.reflectance is None else table.reflectance
            entry["kind"] = "diffuse"
            entry["reflectance"] = self._spectrum(table, bad, "reflectance", "reflectance", path, black)
            emission = {
                "spectrum": self._spectrum(table, bad, "spectrum", "emission", path),
                "quantity": self._quantity(table, raw, "emitter", path),
                "sides": table.sides,
                "distribution": self._distribution(table, raw, path),
            }
        if table.kind == "conductor":
            self._conductor_form(raw, path)
        self._on_surface(table, raw, bad, path, skin)
        told = [] if "coefficients" in bad else self._coefficients(table.coefficients, path)
        if len(self.report.problems) > before:
            return None
        return Material(
            {
                "name": name,
                "surface": entry,
                "coefficients": told,
                "priority": getattr(table, "priority", 0),
            },
            skin,
            emission,
        )

    def _named(self, name: str, table: Any, bad: set[str], path: Path) -> Material | None:
        """A material in words, by the table of the scene file that they stand for."""
        if "name" in bad:
            return None
        told = {} if table.coefficients is None else {"coefficients": table.coefficients}
        try:
            return self.material(name, materials.find(table.name) | told)
        except DataError as error:
            self.report.add((*path, "name"), error.message, kind="unknown-material")
            return None

    def _finish(
        self, table: Any, raw: dict[str, Any], bad: set[str], path: Path, material: str = ""
    ) -> dict[str, Any]:
        """The relief of a surface, by its own keys or by the name of a finish."""
        shape = table.distribution
        grain = None if table.grain is None else [float(value) for value in table.grain]
        if grain is not None and not any(grain) and "grain" not in bad:
            self.report.add((*path, "grain"), "must have a length", kind="direction")
        if table.finish is None or "finish" in bad:
            along = table.roughness
            if isinstance(along, (SlopeImage, SlopePattern)):
                along = 0.5 * (along.black + along.white)
            across = along if table.roughness_across is None else table.roughness_across
            sigma = None if table.sigma_nm is None else float(table.sigma_nm)
            slope = [float(along), float(across)]
            return {"slope": slope, "sigma_nm": sigma, "shape": shape, "grain": grain}
        for key in ("roughness", "roughness_across", "sigma_nm"):
            if key in raw:
                self.report.add(
                    (*path, key), f"is given twice: finish brings its own {key}", kind="exactly-one"
                )
        try:
            found = finishes.finish(table.finish, material)
        except DataError as error:
            self.report.add((*path, "finish"), error.message, kind="unknown-finish")
            return {"slope": [0.0, 0.0]}
        sigma = None if found.sigma_nm is None else max(found.sigma_nm)
        return {"slope": list(found.slope), "sigma_nm": sigma, "shape": shape, "grain": grain}

    def _coated(
        self, table: Any, raw: dict[str, Any], bad: set[str], path: Path, skin: dict[str, Any]
    ) -> dict[str, Any]:
        """A vehicle over a pigment or metal."""
        if "medium" in raw and "n" in raw:
            self.report.add((*path, "n"), "is given twice: medium brings its own n", kind="exactly-one")
        if table.medium is not None:
            index = self._part_of(table, bad, "medium", "n", path)
        else:
            index = self._spectrum(table, bad, "n", "n", path, 1.5)
        entry: dict[str, Any] = {"n": index, "finish": self._finish(table, raw, bad, path)}
        if "pigment" in raw and "reflectance" in raw:
            message = "is given twice: it follows from the reflectance of the finished paint"
            self.report.add((*path, "pigment"), message, kind="exactly-one")
        elif not {"pigment", "reflectance", "metal"} & set(raw):
            message = "pigment, reflectance or metal is missing"
            self.report.add(path, message, 'for example reflectance = "ColorChecker/red"', "missing-key")
        if "reflectance" in raw:
            paint = self._colour(table, bad, "reflectance", path, skin, finished=True)
            entry["pigment"] = None if paint is None or index is None else materials.pigment_of(paint, index)
        else:
            entry["pigment"] = self._colour(table, bad, "pigment", path, skin, default=0.0)
        entry["film"] = None
        if ("absorption" in raw) != ("thickness" in raw):
            missing = "thickness" if "absorption" in raw else "absorption"
            self.report.add(path, f"{missing} is missing: the other key goes with it", kind="missing-key")
        elif table.thickness is not None:
            entry["film"] = {
                "absorption": self._spectrum(table, bad, "absorption", "absorption", path),
                "thickness": float(table.thickness) * self.unit_m,
            }
        entry["flakes"] = None
        if table.metal is not None:
            entry["flakes"] = {
                part: self._part_of(table, bad, "metal", part, path) for part in ("n", "k")
            } | {
                "slope": float(table.metal_roughness),
                "coverage": float(table.coverage),
            }
        else:
            for key in ("metal_roughness", "coverage"):
                if key in raw:
                    self.report.add((*path, key), "goes with metal", kind="unknown-key")
        return entry

    def _colour(
        self,
        table: Any,
        bad: set[str],
        key: str,
        path: Path,
        skin: dict[str, Any],
        *,
        finished: bool = False,
        default: Any = None,
    ) -> Spectrum | None:
        """A fraction of light, or the mean of an image of it, which then goes to the skin."""
        value = getattr(table, key)
        if not isinstance(value, (ColourImage, ColourPattern)) or key in bad:
            return self._spectrum(table, bad, key, "reflectance", path, default)
        resolved = self.textures.colour(value, (*path, key), finished=finished)
        if resolved is None:
            return None
        mean, skin["colour"] = resolved
        return mean

    def _on_surface(
        self, table: Any, raw: dict[str, Any], bad: set[str], path: Path, skin: dict[str, Any]
    ) -> None:
        """Images of roughness and of relief."""
        roughness = getattr(table, "roughness", None)
        if isinstance(roughness, (SlopeImage, SlopePattern)) and "roughness" not in bad:
            if "roughness_across" in raw:
                message = "does not go with an image of roughness, which is the same along and across"
                self.report.add((*path, "roughness_across"), message, kind="exactly-one")
            skin["slope"] = self.textures.slope(roughness, (*path, "roughness"))
        if "bump" in raw and "normal_map" in raw:
            message = "is given twice: bump perturbs the normal too"
            self.report.add((*path, "normal_map"), message, kind="exactly-one")
        for key in ("bump", "normal_map"):
            image = getattr(table, key, None)
            if image is not None and key not in bad:
                skin["relief"] = self.textures.relief(image, (*path, key))

    def _coefficients(self, tables: dict[str, Any] | None, path: Path) -> list[dict[str, Any]]:
        """What historical models are told, one entry for each that is named."""
        models = dict.fromkeys(illumination for _, illumination, *_ in core().pairs())
        historical = [model for model in models if model != "general"]
        entries = []
        for model, raw in (tables or {}).items():
            place = (*path, "coefficients", model)
            if model not in (*historical, ALL_MODELS):
                message = f"is no historical model; known are {', '.join(historical)}, and {ALL_MODELS}"
                if model == "general":
                    message = "has no coefficients: it follows the physics of the surface"
                self.report.add(place, message, suggestion(model, historical), "unknown-key")
                continue
            table, bad = read_table(Coefficients, raw, place, self.report)
            if table is None:
                continue
            if table.half_angle_deg is not None and table.exponent is not None:
                message = "is given twice: half_angle_deg says it too"
                self.report.add((*place, "exponent"), message, kind="exactly-one")
            entry: dict[str, Any] = {} if model == ALL_MODELS else {"model": model}
            for key, value in table.model_dump(exclude_none=True).items():
                if key.endswith("_curve"):
                    entry[key] = self._spectrum(table, bad, key, "reflectance", place)
                else:
                    entry[key] = value
            entries.append(entry)
        return entries

    def _shares(self, reflectance: Spectrum | None, transmittance: Spectrum | None, path: Path) -> None:
        """Reports a reflectance and a transmittance of which more light leaves than came."""
        import numpy as np

        if reflectance is None or transmittance is None:
            return
        first, last = self.curves.range_nm
        points = (first, *reflectance.wavelengths_nm, *transmittance.wavelengths_nm, last)
        nanometres = np.clip(np.unique(points), first, last)
        sums = reflectance.at(nanometres) + transmittance.at(nanometres)
        worst = int(sums.argmax())
        # Decimal fractions that add up to 1 may round to a little more.
        if sums[worst] > 1.0 + 1e-9:
            message = (
                f"must not exceed 1 together with reflectance; at {nanometres[worst]:g} nm they add up to "
                f"{sums[worst]:.4g}"
            )
            self.report.add((*path, "transmittance"), message, kind="range")

    def _conductor_form(self, raw: dict[str, Any], path: Path) -> None:
        if "metal" in raw:
            for key in ("n", "k"):
                if key in raw:
                    self.report.add(
                        (*path, key), "is given twice: metal brings its own n and k", kind="exactly-one"
                    )
        elif "n" not in raw or "k" not in raw:
            missing = [key for key in ("n", "k") if key not in raw]
            what = "metal, or n and k, is" if len(missing) == 2 else f"{missing[0]} is"
            self.report.add(path, f"{what} missing", 'for example metal = "gold"', "missing-key")

    def _one_way(self, raw: dict[str, Any], keys: tuple[str, str], path: Path) -> None:
        given = [key for key in keys if key in raw]
        if len(given) == 2:
            self.report.add(
                (*path, given[1]), f"is given twice: {given[0]} brings its own {given[1]}", kind="exactly-one"
            )
        elif not given:
            self.report.add(
                path, f"{keys[0]} or {keys[1]} is missing", 'for example medium = "BK7"', "missing-key"
            )

    def _part_of(self, table: Any, bad: set[str], whole: str, part: str, path: Path) -> Spectrum | None:
        """n or k, from its own key or from the metal or medium that is named."""
        name = getattr(table, whole)
        if whole in bad:
            return None
        if name is None:
            return self._spectrum(table, bad, part, part, path)
        metals = [entry.removesuffix(".k") for entry in spectra.names("k")]
        media = [
            entry.removesuffix(".n") for entry in spectra.names("n") if entry.removesuffix(".n") not in metals
        ]
        known = metals if whole == "metal" else media
        try:
            entry = spectra.find(f"{name}.k" if whole == "metal" else f"{name}.n").name
        except DataError as error:
            message = (
                f'"{name}" is not in the library, whose {"metals" if whole == "metal" else "media"} are '
            )
            message = error.message if "but no k" in error.message else message + ", ".join(known)
            self.report.add((*path, whole), message, suggestion(name, known), "unknown-spectrum")
            return None
        if whole == "medium" and entry.removesuffix(".n") in metals:
            message = f'"{name}" is a metal; expected one of {", ".join(media)}'
            self.report.add((*path, whole), message, 'metals go with kind = "conductor"', "spectrum-use")
            return None
        return self.curves.resolve(f"{name}.{part}", part, (*path, whole))

    # --- lights ------------------------------------------------------------------------------------------------

    def light(self, name: str, raw: Any) -> dict[str, Any] | None:
        """A light, or None after reporting its mistakes; the image of an environment goes to `images`."""
        path: Path = ("lights", name)
        before = len(self.report.problems)
        web = self._photometry(raw, path)
        if web is not None and not any(key in raw for key in QUANTITIES):
            raw = raw | {"intensity_cd": float(web.candela.max())}
        table, bad = self._kind(KINDS_OF_LIGHT, raw, path)
        if table is None or (web is None and "photometry" in raw and "photometry" not in bad):
            return None
        entry: dict[str, Any] = {"name": name, "kind": table.kind}
        if table.kind == "sky":
            for key in ("turbidity", "ground_albedo", "elevation_deg", "azimuth_deg"):
                entry[key] = float(getattr(table, key))
            entry |= {"sun": table.sun, "up": table.up or self.up}
            return None if len(self.report.problems) > before else entry
        source = table.kind
        if table.kind == "environment":
            source = "environment image" if "image" in raw else "environment"
            entry |= self._environment(table, raw, bad, name, path)
        else:
            entry["spectrum"] = self._spectrum(table, bad, "spectrum", "emission", path)
            if table.kind != "directional":
                entry["position"] = self._lengths(table.position)
            if table.kind == "point":
                entry["distribution"] = self._distribution(table, raw, path)
                down = [-float(axis == self.up) for axis in "xyz"]
                axis = down if table.axis is None else [float(value) for value in table.axis]
                entry["axis"] = axis
                if "axis" in raw and not any(axis) and "axis" not in bad:
                    self.report.add((*path, "axis"), "must have a length", kind="direction")
            else:
                length = math.hypot(*table.direction)
                entry["direction"] = [value / (length or 1.0) for value in table.direction]
                if "direction" not in bad and length < 1e-30:
                    self.report.add((*path, "direction"), "must have a length", kind="direction")
            if table.kind == "spot":
                entry["half_angle_deg"] = float(table.half_angle_deg)
                entry["penumbra_deg"] = float(table.penumbra_deg)
                if not {"half_angle_deg", "penumbra_deg"} & bad and table.penumbra_deg > table.half_angle_deg:
                    self.report.add(
                        (*path, "penumbra_deg"),
                        f"must be at most half_angle_deg, {table.half_angle_deg:g}, found {table.penumbra_deg:g}",
                        kind="range",
                    )
        entry["quantity"] = self._quantity(table, raw, source, path)
        if web is not None and table.kind == "point":
            del entry["distribution"]
            entry |= self._luminaire(table, raw, bad, web, path)
        return None if len(self.report.problems) > before else entry

    def _photometry(self, raw: Any, path: Path) -> Photometry | None:
        """What the file of a luminaire says, or None if there is none, or after reporting its mistakes."""
        given = raw.get("photometry") if isinstance(raw, dict) and raw.get("kind") == "point" else None
        if not isinstance(given, str):
            return None
        try:
            return photometry_file.read(self._file(given))
        except DataError as error:
            kind = "missing-file" if error.message == "there is no such file" else "photometry"
            kind = "outside" if is_outside(error) else kind
            self.report.add_data_error((*path, "photometry"), error, kind)
            return None

    def _file(self, name: str) -> FilePath:
        """Where a file is that the scene names."""
        return sources.located(name, self.directory, self.allow_outside)

    def _luminaire(
        self, table: Any, raw: dict[str, Any], bad: set[str], web: Photometry, path: Path
    ) -> dict[str, Any]:
        """A point light that shines as a photometric web says."""
        import numpy as np

        for other in ("cosine_power", "distribution"):
            if other in raw:
                self.report.add((*path, other), "is given twice: photometry says it too", kind="exactly-one")
        down = [-float(axis == self.up) for axis in "xyz"]
        axis = np.array(down if table.axis is None or "axis" in bad else table.axis, float)
        axis /= np.linalg.norm(axis) or 1.0
        along = [1.0, 0.0, 0.0] if abs(axis[0]) < 0.99 else [0.0, 0.0, 1.0]
        across = placement.rotation(axis, float(table.turn_deg)) @ np.array(along) if axis.any() else along
        return {
            "kind": "luminaire",
            "axis": axis.tolist(),
            "across": list(map(float, across)),
            "planes_deg": web.planes_deg.tolist(),
            "angles_deg": web.angles_deg.tolist(),
            "values": web.candela.ravel().tolist(),
        }

    def _distribution(self, table: Any, raw: dict[str, Any], path: Path) -> dict[str, Any] | None:
        """How intensity depends on direction, or None."""
        if "cosine_power" in raw and "distribution" in raw:
            self.report.add(
                (*path, "distribution"), "is given twice: cosine_power says it too", kind="exactly-one"
            )
        if table.cosine_power is not None:
            return {"cosine_power": float(table.cosine_power)}
        if table.distribution is None:
            return None
        pairs = [[float(angle), float(value)] for angle, value in table.distribution]
        angles = [angle for angle, _ in pairs]
        growing = all(a < b for a, b in itertools.pairwise(angles))
        if angles[0] != 0.0 or not growing or angles[-1] > 180.0:
            message = "must have angles that grow from 0 to at most 180 degrees"
            self.report.add((*path, "distribution"), message, kind="range")
        elif min(value for _, value in pairs) < 0.0 or not any(value for _, value in pairs):
            message = "must have values that are not negative, and one above 0"
            self.report.add((*path, "distribution"), message, kind="range")
        return {"table": pairs}

    def _environment(
        self, table: Any, raw: dict[str, Any], bad: set[str], name: str, path: Path
    ) -> dict[str, Any]:
        entry: dict[str, Any] = {"spectrum": None, "image": None}
        if "spectrum" not in raw and "image" not in raw:
            self.report.add(path, "must have a spectrum or an image; found neither", kind="missing-key")
        if "spectrum" in raw:
            entry["spectrum"] = self._spectrum(table, bad, "spectrum", "emission", path)
        for key in ("rgb_system", "layout"):
            if key in raw and "image" not in raw:
                self.report.add((*path, key), "goes with image, not with spectrum", kind="unknown-key")
        if "image" in raw and "image" not in bad:
            entry["image"] = name
            try:
                self.images[name] = self._image(table.image, table.layout or "latlong")
            except SourceError as error:
                self.report.add_data_error((*path, "image"), error, error.kind)
            except ImageError as error:
                missing = str(error).endswith(": there is no such file")
                self.report.add((*path, "image"), str(error), kind="missing-file" if missing else "image")
        system = (
            self.curves.system(table.rgb_system, (*path, "rgb_system")) if "rgb_system" not in bad else None
        )
        return entry | {
            "rgb_system": system,
            "up": table.up or self.up,
            "rotation_deg": float(table.rotation_deg),
        }

    def _image(self, image: Any, layout: str) -> np.ndarray:
        if isinstance(image, str):
            read = environments.read(self._file(image))
            return environments.checked(panoramas.latitude_longitude(read, layout))
        if isinstance(image, (dict, list, bool, int, float)):
            raise ImageError(f"must be the name of a file, found {found(image)}")
        return environments.checked(panoramas.latitude_longitude(environments.checked(image), layout))

    # --- atmosphere --------------------------------------------------------------------------------------------

    def atmosphere(self, raw: Any) -> dict[str, Any] | None:
        """What is left of radiance on its way to the eye, or None after reporting mistakes."""
        path: Path = ("atmosphere",)
        before = len(self.report.problems)
        table, bad = self._kind(KINDS_OF_ATMOSPHERE, raw, path)
        if table is None:
            return None
        entry: dict[str, Any] = {"kind": table.kind}
        if table.kind == "fog":
            entry |= {"start": table.start * self.unit_m, "end": table.end * self.unit_m}
            if not {"start", "end"} & bad and table.start >= table.end:
                message = f"must be beyond start, {table.start:g}, found {table.end:g}"
                self.report.add((*path, "end"), message, kind="range")
            entry["spectrum"] = self._spectrum(table, bad, "spectrum", "emission", path)
            entry["quantity"] = self._quantity(table, raw, "fog", path)
        else:
            entry |= {"power": float(table.power), "unit": table.unit * self.unit_m}
        return None if len(self.report.problems) > before else entry

    def medium(self, raw: Any) -> dict[str, Any] | None:
        """What is in the air, or None after reporting mistakes."""
        path: Path = ("medium",)
        before = len(self.report.problems)
        table, bad = read_table(Medium, raw, path, self.report)
        if table is None:
            return None
        entry: dict[str, Any] = {
            name: self._spectrum(table, bad, name, "absorption", path)
            for name in ("absorption", "scattering")
        }
        if table.phase == "rayleigh" and table.mean_cosine is not None:
            self.report.add(
                (*path, "mean_cosine"), "belongs to the phase henyey-greenberg", kind="exactly-one"
            )
        even = "rayleigh" if table.phase == "rayleigh" else {"henyey_greenberg": table.mean_cosine or 0.0}
        box = None if table.box is None else [self._lengths(table.box.min), self._lengths(table.box.max)]
        if box is not None and not all(a < b for a, b in zip(*box, strict=True)):
            self.report.add((*path, "box"), "must have max above min along every axis", kind="range")
        density = None
        if table.density is not None:
            if box is None:
                self.report.add((*path, "box"), "is missing; density fills it", kind="missing-key")
            try:
                density = self._density(table.density)
            except DataError as error:
                self.report.add_data_error((*path, "density"), error, "density")
        return (
            None
            if len(self.report.problems) > before
            else entry
            | {
                "phase": even,
                "bounds": box,
                "density": density,
            }
        )

    def _density(self, given: Any) -> list[Any]:
        """The name of the image that holds a density, and its cells along x, y and z."""
        import numpy as np

        if isinstance(given, str):
            file = self._file(given)
            size = sources.check(file, MOST_BYTES_OF_DENSITY)

            def fits(shape: tuple[int, ...]) -> None:
                machine.check_file(file, BYTES_A_CELL * math.prod(shape))

            try:
                with sources.opened(file, MOST_BYTES_OF_DENSITY) as stream:
                    cells = archives.array(stream, size, fits)
            except MachineError:
                raise
            except (OSError, ValueError, EOFError) as error:
                raise DataError(f"is no NumPy file of numbers ({error})", str(file)) from error
        else:
            try:
                with np.errstate(over="ignore"):
                    cells = np.asarray(given, dtype=np.float32)
            except (TypeError, ValueError):
                raise DataError(f"must be the name of a NumPy file, found {found(given)}") from None
        if cells.ndim != 3 or cells.size == 0 or cells.dtype.kind not in "fiu":
            raise DataError(f"must hold numbers along three axes, x, y and z; found shape {cells.shape}")
        if max(cells.shape) > MOST_CELLS_ALONG:
            raise DataError(
                f"must have at most {MOST_CELLS_ALONG:,} cells along an axis, found shape {cells.shape}"
            )
        with np.errstate(over="ignore"):  # what is too large is refused with what is infinite
            cells = np.asarray(cells, dtype=np.float32)
        if not (np.isfinite(cells).all() and (cells >= 0).all() and cells.max() > 0):
            raise DataError("must be finite and not negative, and somewhere above 0")
        nx, ny, nz = cells.shape
        rows = cells.transpose(2, 1, 0).reshape(nz * ny, nx, 1)
        self.images["medium density"] = np.ascontiguousarray(np.repeat(rows, 3, axis=2))
        return ["medium density", [nx, ny, nz]]

    # --- camera ------------------------------------------------------------------------------------------------

    def camera(self, raw: Any) -> dict[str, Any] | None:
        """The camera, or None after reporting its mistakes."""
        path: Path = ("camera",)
        before = len(self.report.problems)
        table, bad = read_table(Camera, raw, path, self.report)
        if table is None:
            return None
        up = table.up or [float(axis == self.up) for axis in "xyz"]
        eye, target = (self._lengths(point) for point in (table.eye, table.target))
        view = [b - a for a, b in zip(eye, target, strict=True)]
        if not bad & {"eye", "target", "up"}:
            if not any(view):
                self.report.add(
                    (*path, "target"), "is the same point as eye; the camera looks nowhere", kind="camera"
                )
            elif not any(up):
                self.report.add((*path, "up"), "must have a length", kind="camera")
            elif _sine(view, up) < 1e-6:
                self.report.add(
                    (*path, "up"),
                    "is parallel to the direction of view; the image has no upright",
                    kind="camera",
                )
        width, height = table.size
        if "size" not in bad and width * height > MAX_PIXELS:
            self.report.add(
                (*path, "size"),
                f"is {width} × {height} pixels; at most {MAX_PIXELS} pixels are possible",
                kind="size",
            )
        if table.crop is not None and not bad & {"crop", "size"}:
            left, top, right, bottom = table.crop
            if not (left < right <= width and top < bottom <= height):
                self.report.add(
                    (*path, "crop"),
                    f"must be left, top, right, bottom inside {width} × {height} pixels, found {table.crop}",
                    kind="crop",
                )
        lens = self._lens(table, raw, math.hypot(*view), path)
        if table.shutter is not None and table.shutter[0] > table.shutter[1]:
            self.report.add((*path, "shutter"), "must open before it closes", kind="range")
        if len(self.report.problems) > before:
            return None
        return {
            "eye": eye,
            "target": target,
            "up": [float(value) for value in up],
            "field_of_view_deg": float(table.field_of_view),
            "size": list(table.size),
            "crop": None if table.crop is None else list(table.crop),
            "shutter": [0.0, 1.0] if table.shutter is None else [float(value) for value in table.shutter],
            "lens": lens,
            "end": self._camera_end(table, eye, target, up),
        }

    def _camera_end(self, table: Any, eye: list[float], target: list[float], up: list[float]) -> Any:
        """Eye, target and up at the end of the motion, or None for a camera at rest."""
        move = table.moves_to
        if move is None:
            return None
        return {
            "eye": eye if move.eye is None else self._lengths(move.eye),
            "target": target if move.target is None else self._lengths(move.target),
            "up": [float(value) for value in (up if move.up is None else move.up)],
        }

    def _lens(self, table: Any, raw: Any, distance_m: float, path: Path) -> dict[str, Any] | None:
        """The lens, or None for a pinhole."""
        pair = ("focal_length_mm", "f_number")
        given = [name for name in pair if raw.get(name) is not None]
        others = [name for name in ("focus_distance", "blades", "blades_turned") if raw.get(name) is not None]
        if len(given) == 1 or (others and not given):
            missing = next(name for name in pair if name not in given)
            self.report.add(
                (*path, missing), f"is missing; {(given or others)[0]} needs it", kind="missing-key"
            )
        if len(given) < 2:
            return None
        focus = distance_m if table.focus_distance is None else table.focus_distance * self.unit_m
        return {
            "radius": 0.5e-3 * table.focal_length_mm / table.f_number,
            "focus": focus,
            "blades": table.blades or 0,
            "turn_deg": float(table.blades_turned or 0.0),
        }

    # --- what all share ----------------------------------------------------------------------------------------

    def _kind(self, kinds: Mapping[str, type[Table]], raw: Any, path: Path) -> tuple[Any, set[str]]:
        """A table whose key `kind` says which model it follows."""
        if not isinstance(raw, dict):
            self.report.add(path, f"must be a table, found {found(raw)}", kind="type")
            return None, set()
        kind = raw.get("kind")
        if not isinstance(kind, str) or kind not in kinds:
            words = ", ".join(f'"{known}"' for known in kinds)
            if "kind" not in raw:
                self.report.add((*path, "kind"), f"is missing; expected one of {words}", kind="missing-key")
            else:
                hint = suggestion(kind, kinds) if isinstance(kind, str) else ""
                self.report.add(
                    (*path, "kind"), f"must be one of {words}, found {found(kind)}", hint, "choice"
                )
            return None, set()
        others = [model for known, model in kinds.items() if known != kind]
        return read_table(kinds[kind], raw, path, self.report, others)

    def _spectrum(
        self, table: Any, bad: set[str], key: str, use: str, path: Path, default: Any = None
    ) -> Spectrum | None:
        value = getattr(table, key)
        value = default if value is None else value
        return None if value is None or key in bad else self.curves.resolve(value, use, (*path, key))

    def _quantity(self, table: Any, raw: dict[str, Any], source: str, path: Path) -> dict[str, Any] | None:
        """The one quantity of a source, or None after reporting that there is none, two, or one that does not fit."""
        given = [key for key in QUANTITIES if key in raw]
        fitting = ", ".join(FITTING[source])
        unfit = [key for key in given if key not in FITTING[source]]
        for key in unfit:
            message = f"does not fit {NAMES_OF_SOURCES[source]}; expected one of {fitting}"
            self.report.add((*path, key), message, kind="quantity")
        if len(given) - len(unfit) != 1 and not (unfit and len(given) == 1):
            what = " and ".join(key for key in given if key not in unfit) or "none"
            self.report.add(
                path, f"must have exactly one quantity of {fitting}; found {what}", kind="quantity"
            )
        if unfit or len(given) != 1 or not isinstance(getattr(table, given[0]), (int, float)):
            return None
        return {"kind": given[0], "value": float(getattr(table, given[0]))}

    def _lengths(self, values: Any) -> list[float]:
        return [float(value) * self.unit_m for value in values]


def indexed(description: dict[str, Any]) -> dict[str, Any]:
    """A description whose curves stand in place, with the curves listed once each and referred to by number.

    Curves are equal when their points and their rule outside are; the first name is kept.
    """
    curves: list[dict[str, Any]] = []
    numbers: dict[tuple[Any, ...], int] = {}

    def number(spectrum: Spectrum) -> int:
        key = (spectrum.wavelengths_nm, spectrum.values, spectrum.outside)
        if key not in numbers:
            numbers[key] = len(curves)
            curves.append(curve_from_spectrum(spectrum))
        return numbers[key]

    def walk(value: Any) -> Any:
        if isinstance(value, Spectrum):
            return number(value)
        if isinstance(value, dict):
            walked = {key: walk(value[key]) for key in sorted(value)}
            return {key: walked[key] for key in value}
        return [walk(one) for one in value] if isinstance(value, list) else value

    parts = {
        key: walk(description[key])
        for key in ("materials", "skins", "objects", "lights", "camera", "atmosphere", "medium")
    }
    return {"range": description["range"], "curves": curves, **parts}


def in_place(description: Mapping[str, Any]) -> dict[str, Any]:
    """The inverse of `indexed`: a copy of a description whose curves stand in place of their numbers."""
    curves = [
        Spectrum(curve["name"], curve["wavelengths"], curve["values"], curve["outside"])
        for curve in description["curves"]
    ]
    curve_keys = ("reflectance", "transmittance", "pigment", "n", "k", "absorption", "scattering", "spectrum")
    keys = (*curve_keys, "diffuse_curve", "specular_curve", "transmitted_curve")

    def walk(value: Any) -> Any:
        if isinstance(value, dict):
            return {
                key: [curves[number] for number in one]
                if key == "basis"
                else curves[one]
                if key in keys and one is not None
                else walk(one)
                for key, one in value.items()
            }
        return [walk(one) for one in value] if isinstance(value, list) else value

    parts: dict[str, Any] = walk({key: value for key, value in description.items() if key != "curves"})
    return parts


def _sine(a: list[float], b: list[float]) -> float:
    cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return math.hypot(*cross) / (math.hypot(*a) * math.hypot(*b))
