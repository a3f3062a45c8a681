"""Spectra of a scene: from any way of writing one to a curve of the description, each curve held once.

A spectrum is resolved for a use: "reflectance", "emission", "n", "k" or "absorption". The use decides which values
are refused (a reflectance is a fraction, light and absorption are not negative, n is above zero), which role RGB must
have (none at all for n, k and absorption), and the rule outside the range where none is stated (zero for light, hold
the end value for all others). Nothing is clamped, sorted or resampled.

Example:
    >>> from illuminant.curves import Curves
    >>> from illuminant.report import Report
    >>> curves = Curves(Report(), {"paint": 0.5})
    >>> curves.resolve("paint", "reflectance", ("materials", "wall", "reflectance")).values
    (0.5, 0.5)
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from illuminant import sources, spectra
from illuminant.core import core
from illuminant.errors import DataError, suggestion
from illuminant.report import Path, Report, read_table
from illuminant.schema import SpectrumTable
from illuminant.spectra import Spectrum

__all__ = ["SOURCES", "Curves", "curve_from_spectrum"]

SOURCES = ("library", "file", "constant", "blackbody_k", "daylight_k", "wavelengths_nm", "rgb")
"""The keys of which a spectrum in place has exactly one."""

ROLE_OF_USE = {"reflectance": "albedo", "emission": "emission"}
NAME_OF_USE = {
    "reflectance": "a reflectance",
    "emission": "a spectrum of light",
    "n": "an index of refraction n",
    "k": "an extinction coefficient k",
    "absorption": "an absorption coefficient",
}
MOST_NAMES = 100
"""How many names may lead from one to the next before there is a spectrum."""

MOST_INDEX = 100_000.0
"""The largest index of refraction or extinction coefficient in the scene's range; the core has the same."""

WARN_DELTA_E = 0.5
"""The round-trip error of an upsampled RGB value (CIEDE2000) above which the scene warns."""


class Curves:
    """Resolves the spectra of one scene.

    Args:
        report: takes the mistakes.
        named: the `[spectra]` table, as written.
        directory: folder that file names are relative to.
        allow_outside: whether files may lie outside that folder.
        range_nm: the wavelength range of the scene.
    """

    def __init__(
        self,
        report: Report,
        named: Mapping[str, Any] | None = None,
        directory: str | os.PathLike[str] = ".",
        range_nm: tuple[float, float] = (380.0, 780.0),
        *,
        allow_outside: bool = False,
    ) -> None:
        self.report = report
        self.named = dict(named or {})
        self.directory, self.allow_outside = FilePath(directory), allow_outside
        self.range_nm = (float(range_nm[0]), float(range_nm[1]))
        self.warnings: list[str] = []
        # Where materials are made from RGB, with the error; whether any is not; and the largest error by provenance.
        self.of_rgb: dict[str, float] = {}
        self.of_measurement = False
        self._round_trips: dict[str, float] = {}

    def resolve(self, value: Any, use: str, path: Path) -> Spectrum | None:
        """A spectrum for a use, or None after its mistakes were reported.

        Args:
            value: a name, a number, a table (raw or read), or a `Spectrum`.
            use: "reflectance", "emission", "n", "k", "absorption", or "" for one that is only named.
            path: where it is written.
        """
        before = len(self.report.problems)
        spectrum = self._find(value, use, path, ())
        if spectrum is None or len(self.report.problems) > before:
            return None
        if use == "reflectance" and path[0] == "materials":
            place = ".".join(str(part) for part in path)
            if spectrum.provenance in self._round_trips:
                self.of_rgb[place] = self._round_trips[spectrum.provenance]
            elif min(spectrum.values) < max(spectrum.values):
                self.of_measurement = True
        return self._fit(spectrum, use, path)

    def mixture(self) -> list[str]:
        """A sentence where materials made from RGB stand beside measured ones (book 3.5.3); else none."""
        if not (self.of_rgb and self.of_measurement):
            return []
        places = ", ".join(list(self.of_rgb)[:3]) + (" and others" if len(self.of_rgb) > 3 else "")
        worst = max(self.of_rgb.values())
        return [
            f"{places}: made from RGB (ΔE00 of the round trip at most {worst:.2g}), beside measured spectra; under "
            "another light than the white of its system such a colour is a guess"
        ]

    def check_named(self) -> None:
        """Report the mistakes of every spectrum of `[spectra]`, also of those that nothing uses."""
        for name in self.named:
            value = self.named[name]
            role = value.get("role") if isinstance(value, dict) else None
            use = {"albedo": "reflectance", "emission": "emission"}.get(str(role), "")
            self.resolve(value, use, ("spectra", name))

    def without_files(self) -> dict[str, Any]:
        """The `[spectra]` table with the points of each file in place, so that it can be used anywhere."""
        tables: dict[str, Any] = {}
        for name, value in self.named.items():
            tables[name] = value
            if isinstance(value, dict) and "file" in value:
                spectrum = self.resolve(value, "", ("spectra", name))
                if spectrum is not None:
                    outside = value.get("outside") or (spectrum.outside if spectrum.quantity else None)
                    tables[name] = {
                        "wavelengths_nm": list(spectrum.wavelengths_nm),
                        "values": list(spectrum.values),
                    }
                    tables[name] |= {"outside": outside} if outside else {}
        return tables

    def _find(self, value: Any, use: str, path: Path, chain: tuple[str, ...]) -> Spectrum | None:
        if isinstance(value, Spectrum):
            return value
        if isinstance(value, bool) or not isinstance(value, (str, int, float, dict, SpectrumTable)):
            self.report.add(
                path,
                "must be a spectrum: a name, a number, or a table such as { blackbody_k = 2700.0 }",
                kind="type",
            )
            return None
        if isinstance(value, str):
            return self._named(value, use, path, chain)
        if isinstance(value, (int, float)):
            try:
                return self._constant(float(value))
            except DataError as error:
                self.report.add_data_error(path, error, "spectrum")
                return None
        if isinstance(value, SpectrumTable):
            return self._table(value, use, path)
        table, bad = read_table(SpectrumTable, value, path, self.report)
        return None if table is None or bad else self._table(table, use, path)

    def _named(self, name: str, use: str, path: Path, chain: tuple[str, ...]) -> Spectrum | None:
        if name in self.named:
            if name in chain:
                around = " → ".join([*chain[chain.index(name) :], name])
                self.report.add(("spectra", name), f"is defined by itself: {around}", kind="cycle")
                return None
            if len(chain) >= MOST_NAMES:
                self.report.add(
                    ("spectra", name), f"is the end of {MOST_NAMES} names for one spectrum", kind="cycle"
                )
                return None
            value = self.named[name]
            spectrum = self._find(value, use, ("spectra", name), (*chain, name))
            if spectrum is None or not isinstance(value, dict):
                return spectrum
            return replace(spectrum, name=name)
        return self._library(name, path)

    def _library(self, name: str, path: Path) -> Spectrum | None:
        try:
            return spectra.load(name)
        except DataError as error:
            hint = suggestion(name, self.named)
            message = error.message if not hint else f"no spectrum {name!r} in [spectra] or in the library"
            self.report.add(path, message, hint, kind="unknown-spectrum")
            return None

    def _constant(self, value: float, name: str = "") -> Spectrum:
        return Spectrum(name or f"{value:g}", self.range_nm, (value, value), "hold", "1", "constant")

    def _table(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        given = [key for key in SOURCES if getattr(table, key) is not None]
        if len(given) != 1:
            what = "none" if not given else " and ".join(given)
            self.report.add(
                path, f"must have exactly one of {', '.join(SOURCES)}; found {what}", kind="exactly-one"
            )
            return None
        source = given[0]
        companions = {"values": "wavelengths_nm", "role": "rgb", "system": "rgb", "column": "file"}
        for key, owner in companions.items():
            if getattr(table, key) is not None and source != owner:
                self.report.add((*path, key), f"goes with {owner}, not with {source}", kind="unknown-key")
                return None
        try:
            spectrum: Spectrum | None = getattr(self, f"_from_{source}")(table, use, path)
            if spectrum is None:
                return None
            if table.scale is not None or table.outside is not None:
                factor = 1.0 if table.scale is None else table.scale
                values = tuple(factor * value for value in spectrum.values)
                spectrum = replace(spectrum, values=values, outside=table.outside or spectrum.outside)
        except DataError as error:
            kind = (
                "missing-file" if error.message in ("there is no such file", "no such file") else "spectrum"
            )
            kind = "outside" if sources.is_outside(error) else kind
            self.report.add_data_error((*path, source), error, kind)
            return None
        return spectrum

    def _from_library(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        return self._library(str(table.library), (*path, "library"))

    def _from_file(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        file = sources.located(str(table.file), self.directory, self.allow_outside)
        spectrum = spectra.read(file, column=table.column)
        if not spectrum.quantity and table.scale is not None:
            # Percents, say: what the values are is known only when they have been scaled.
            return replace(spectrum, outside="zero" if use == "emission" else "hold")
        if not spectrum.quantity and use in ("reflectance", "emission", "n", "k"):
            spectrum = spectra.read(file, column=table.column, quantity=use, name=spectrum.name)  # type: ignore[arg-type]
        return spectrum

    def _from_constant(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        return self._constant(float(table.constant or 0.0))

    def _from_blackbody_k(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        import numpy as np

        grid = self._grid()
        values = core().planck(np.array(grid), float(table.blackbody_k or 0.0))
        name = f"black body {table.blackbody_k:g} K"
        return Spectrum(name, grid, values.tolist(), "zero", "W sr-1 m-2 nm-1", "Planck", "emission")

    def _from_daylight_k(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        import numpy as np

        grid = self._grid()
        values = core().daylight(np.array(grid), float(table.daylight_k or 0.0))
        return Spectrum(
            f"daylight {table.daylight_k:g} K",
            grid,
            values.tolist(),
            "zero",
            "relative",
            "CIE daylight",
            "emission",
        )

    def _from_wavelengths_nm(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        if table.values is None:
            self.report.add(
                (*path, "values"),
                "is missing; expected a value for each of wavelengths_nm",
                kind="missing-key",
            )
            return None
        outside = table.outside or ("zero" if use == "emission" else "hold")
        name = str(path[1]) if path[:1] == ("spectra",) else ".".join(str(part) for part in path[1:])
        return Spectrum(name, table.wavelengths_nm or (), table.values, outside, "1", "points of the scene")  # type: ignore[arg-type]

    def _from_rgb(self, table: SpectrumTable, use: str, path: Path) -> Spectrum | None:
        rgb = [float(value) for value in table.rgb or ()]
        wanted = ROLE_OF_USE.get(use)
        if table.role is None:
            self.report.add(
                (*path, "role"),
                'is missing; RGB needs to say what it is: "albedo" for a surface, "emission" for light',
                kind="rgb-role",
            )
            return None
        if use and wanted is None:
            self.report.add(
                (*path, "rgb"),
                f"is not possible for {NAME_OF_USE[use]}: three numbers for the eye do not determine it",
                "give a measured spectrum or a number",
                kind="rgb-role",
            )
            return None
        if wanted is not None and table.role != wanted:
            self.report.add(
                (*path, "role"),
                f'must be "{wanted}" for {NAME_OF_USE[use]}, found "{table.role}"',
                kind="rgb-role",
            )
            return None
        system = self.system(table.system, (*path, "system"))
        high = 1.0 if table.role == "albedo" else float("inf")
        if any(not 0.0 <= value <= high for value in rgb):
            limits = "from 0 to 1" if table.role == "albedo" else "at least 0"
            self.report.add(
                (*path, "rgb"), f"must be {limits} for the role {table.role}, found {rgb}", kind="range"
            )
            return None
        if system is None:
            return None
        make = spectra.rgb_albedo if table.role == "albedo" else spectra.rgb_emission
        try:
            spectrum, error = make(rgb, system)
        except DataError as mistake:
            self.report.add((*path, "rgb"), mistake.message, kind="spectrum")
            return None
        known = self._round_trips.get(spectrum.provenance, 0.0)
        self._round_trips[spectrum.provenance] = max(error, known)
        if error > WARN_DELTA_E:
            place = ".".join(str(part) for part in path)
            self.warnings.append(
                f"{place}: no smooth spectrum has this RGB; the nearest is ΔE00 {error:.2f} away"
            )
        return spectrum

    def system(self, name: str | None, path: Path) -> str | None:
        """The name of an RGB system, sRGB where none is given, or None after reporting that there is no such one."""
        known = list(core().rgb_systems())
        if name is None:
            return "sRGB"
        if name in known:
            return name
        self.report.add(
            path,
            f'must be one of {", ".join(known)}, found "{name}"',
            suggestion(name, known),
            "unknown-rgb-system",
        )
        return None

    def _grid(self) -> tuple[float, ...]:
        first, last = min(360.0, self.range_nm[0]), max(830.0, self.range_nm[1])
        steps = max(1, round(last - first))
        return tuple(first + (last - first) * i / steps for i in range(steps + 1))

    def _most(self, spectrum: Spectrum) -> float:
        """The largest value in the scene's range; curves of metals grow beyond."""
        first, last = self.range_nm
        pairs = zip(spectrum.wavelengths_nm, spectrum.values, strict=True)
        return float(max((value for nm, value in pairs if first <= nm <= last), default=0.0))

    def _fit(self, spectrum: Spectrum, use: str, path: Path) -> Spectrum | None:
        """Make sure that a spectrum can be what it is used for."""
        if not use:
            return spectrum
        if spectrum.quantity and spectrum.quantity != use:
            what = NAME_OF_USE[spectrum.quantity]
            self.report.add(
                path,
                f'"{spectrum.name}" is {what}, where {NAME_OF_USE[use]} is expected',
                kind="spectrum-use",
            )
            return None
        values = spectrum.values
        wrong = ""
        if use == "reflectance" and not all(0.0 <= value <= 1.0 for value in values):
            worst = max(values) if max(values) > 1.0 else min(values)
            wrong = f"a reflectance is a fraction from 0 to 1, found {worst:g}"
        elif use == "n" and not min(values) > 0.0:
            wrong = f"n must be above 0, found {min(values):g}"
        elif use != "n" and min(values) < 0.0:
            wrong = f"{NAME_OF_USE[use]} is never negative, found {min(values):g}"
        elif use == "emission" and not max(values) > 0.0:
            wrong = "a spectrum of light is not zero everywhere"
        elif use in ("n", "k") and (most := self._most(spectrum)) > MOST_INDEX:
            wrong = f"{use} is at most {MOST_INDEX:,.0f} in visible light, found {most:g}"
        if wrong:
            percent = use == "reflectance" and 1.5 < max(values) <= 100.0 and min(values) >= 0.0
            self.report.add(
                path, wrong, "write scale = 0.01 for values in percent" if percent else "", "spectrum-value"
            )
            return None
        outside = spectrum.outside
        first, last = spectrum.range_nm
        if outside == "error":
            if first > self.range_nm[0] or last < self.range_nm[1]:
                self.report.add(
                    path,
                    f'"{spectrum.name}" is known from {first:g} to {last:g} nm, and the scene needs '
                    f"{self.range_nm[0]:g} to {self.range_nm[1]:g} nm",
                    'state outside = "hold" or "zero", or change range_nm',
                    "spectrum-range",
                )
                return None
            outside = "hold"
        return replace(spectrum, outside=outside)


def curve_from_spectrum(spectrum: Spectrum) -> dict[str, Any]:
    """The curve of a scene's description."""
    return {
        "name": spectrum.name,
        "wavelengths": list(spectrum.wavelengths_nm),
        "values": list(spectrum.values),
        "outside": spectrum.outside,
    }
