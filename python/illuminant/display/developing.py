"""Developing again: the same image under another observer, other lamps or other powers, without rendering again.

Light adds up, so an image is the sum of the light of its lamps. What `render --lamps --keep-spectra` keeps suffices to
change the sum:

- **powers** need a layer of XYZ for each lamp: X = X₀ + Σ (p − 1) X_lamp. With all powers 1 it is the image itself;
- **another observer** needs the lanes; their weights are found anew for its functions, for each lamp where its lanes
  were kept apart, else for all together;
- **another lamp** needs the lanes of the old one: divided by its light they are what paths left of it, whatever it is,
  and weights found anew for the new spectrum make a colour of that (`illuminant.display.refitting`). The new lamp has
  the old one's luminance, which `power` may change. Where an old lamp is dark, nothing is known of what paths leave:
  such lanes get no weight, and with fewer than three others it is refused;
- **cameras** see through curves of their own (`illuminant.display.observer`).

How far new weights are off is told as ΔE00 against 1 nm over what the scene can show, in the settings of the developed
image (`settings["developed"]`, one entry for each development). `render --develop-for A,FL11` chooses wavelengths that
suit those lamps too.

Light without a lamp (fog) stays as it is. Y is in cd/m², of 10° too by K_m = 683 lm/W; XYZ of another observer is shown
as if it were 2°, so a white under its lamp may have a tint: that is what the numbers say.

Errors: `UsageError` for lamps, powers and observers that are none; `ImageError` for an image that keeps too little.

Example:
    >>> import numpy as np
    >>> from illuminant.image import Image
    >>> desk, window = np.full((1, 1, 3), 2.0), np.full((1, 1, 3), 5.0)
    >>> image = Image(desk + window, layers={"lamp:desk": desk, "lamp:window": window})
    >>> develop(image, power={"window": 0.0}).xyz.tolist()
    [[[2.0, 2.0, 2.0]]]
"""

from __future__ import annotations

import copy
import dataclasses
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.display import regular_spectra
from illuminant.display.lane_weights import ALL, AT_WAVELENGTHS, DARK, LaneWeights
from illuminant.display.observer import LUMINOUS_EFFICACY, SHORT, STANDARD, Observer, named
from illuminant.errors import ImageError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.image import Image
    from illuminant.kept_spectra import KeptSpectra, LampLight
    from illuminant.spectrum import Spectrum

    Array = NDArray[np.floating[Any]]

__all__ = ["described", "develop", "lamps_of"]

MOST_POWER = 1e9


@dataclass
class _Group:
    """The light of one lamp in an image: its XYZ, its lanes if they were kept apart, and what its light is."""

    name: str
    xyz: Array
    lanes: Array | None
    light: LampLight | None


def lamps_of(image: Image) -> list[str]:
    """The names of the lamps whose light an image keeps apart; the one lamp of a scene always is, if lanes were kept.

    Example:
        >>> import numpy as np
        >>> from illuminant.image import Image
        >>> lamps_of(Image(np.ones((1, 1, 3)), layers={"lamp:desk": np.ones((1, 1, 3))}))
        ['desk']
    """
    return list(_groups(image))


def develop(
    image: Image | str | os.PathLike[str],
    *,
    observer: str | None = None,
    matrix: str = "fit",
    lamps: Mapping[str, str | Spectrum] | None = None,
    power: Mapping[str, float] | None = None,
    regular: float | None = None,
    name: str = "The image",
) -> Image:
    """Show an image under another observer, other lamps or other powers.

    Args:
        image: an image, or the path of one.
        observer: `2`, `10`, another of the core's observers, or a CSV file of a camera's curves; None leaves it.
        matrix: of a camera: `fit`, `balance` or a CSV file (`illuminant.display.observer`).
        lamps: new spectra by lamp: names of the library, `2856K`, files, or spectra.
        power: factors by lamp; 0 switches one off.
        regular: step in nm of a regular grid on which spectra are written again; None drops lanes where they do not
            hold any more.
        name: what messages call an image that is no path.

    Returns:
        A new image; this one does not change. Without lamps, powers, observer and grid it is a copy. Lanes stay where
        only powers change.

    Raises:
        UsageError: there is no such lamp, observer, or spectrum, or a power is none.
        ImageError: the image keeps too little, or cannot be read.
        DataError: a file of a spectrum or camera is damaged.

    Example:
        >>> develop("room.exr", lamps={"desk": "A"}, power={"window": 0.2})     # doctest: +SKIP
    """
    from illuminant.image import Image

    if not isinstance(image, Image):
        name, image = os.fspath(image), Image.open(image)
    lamps, power = dict(lamps or {}), {key: float(value) for key, value in (power or {}).items()}
    groups = _groups(image)
    _check_names(name, image, groups, {**lamps, **power})
    _check_layers(name, image, groups)
    for lamp, factor in power.items():
        if not (0 <= factor <= MOST_POWER):
            raise UsageError(f"--power {lamp}={factor:g}: expected a factor from 0 up, such as 0.5.")
    power = {lamp: factor for lamp, factor in power.items() if factor != 1.0}
    before = _seen_by(image)
    observer = observer or before
    anew = bool(lamps) or regular is not None or SHORT.get(observer, observer) != before
    if not anew:
        return _with_powers(image, groups, power) if power else copy.copy(image)
    basis = _basis(name, image)
    spectra = {lamp: _new_light(lamp, word, groups[lamp], basis) for lamp, word in lamps.items()}
    work = _Development(image, groups, LaneWeights(basis, name), spectra, power)
    seen = work.observer(observer, matrix)
    return work.image(seen, regular, {lamp: getattr(word, "name", word) for lamp, word in lamps.items()})


def _groups(image: Image) -> dict[str, _Group]:
    """The light of each lamp, as far as it is kept apart."""
    basis, layers = image.basis, image.layers
    lights = {} if basis is None else {light.name: light for light in basis.lamps}
    names = [name.partition(":")[2] for name in layers if name.startswith("lamp:")]
    if not names and basis is not None and len(lights) == 1 and not basis.fog and "spectra" in layers:
        [(name, light)] = lights.items()
        return {name: _Group(name, image.xyz, layers["spectra"], light)}
    return {
        name: _Group(name, layers[f"lamp:{name}"], layers.get(f"spectra:{name}"), lights.get(name))
        for name in names
    }


def _check_names(path: str, image: Image, groups: dict[str, _Group], wanted: Mapping[str, Any]) -> None:
    for lamp in wanted:
        if not groups:
            more = " --keep-spectra" if "spectra" not in image.layers else ""
            raise ImageError(
                f"{path} does not keep the light of its lamps apart: render it again with --lamps{more}, as EXR."
            )
        if lamp not in groups:
            raise UsageError(f"There is no lamp {lamp!r} in {path}; there are {', '.join(groups)}.")


def _check_layers(path: str, image: Image, groups: dict[str, _Group]) -> None:
    """Refuse layers of lamps that are not made like those of all light."""
    for name, group in groups.items():
        pairs = [(f"lamp:{name}", group.xyz, image.xyz.shape)]
        if group.lanes is not None and "spectra" in image.layers:
            pairs.append((f"spectra:{name}", group.lanes, image.layers["spectra"].shape))
        for layer, found, wanted in pairs:
            if found.shape != wanted:
                raise ImageError(
                    f"The layer {layer!r} of {path} cannot be a part of its light: expected the shape {wanted}, "
                    f"not {found.shape}."
                )


def _basis(path: str, image: Image) -> KeptSpectra:
    """What the lanes mean; refuses an image without lanes, or with lanes that are no wavelengths."""
    if "spectra" not in image.layers:
        raise ImageError(f"{path} keeps no spectra: render it again with --keep-spectra --lamps, as EXR.")
    basis = image.basis
    if basis is None or image.to_xyz is None:
        raise ImageError(
            f"{path} does not say what its spectra mean (illuminant:basis): only files of illuminant render "
            "--keep-spectra do."
        )
    if basis.sampling.partition(":")[0] not in AT_WAVELENGTHS:
        raise ImageError(
            f"{path} was rendered with {basis.sampling}, whose samples are no wavelengths: render it again with "
            "--sampling fitted:8, uniform:N or 1nm."
        )
    return basis


def _new_light(lamp: str, word: str | Spectrum, group: _Group, basis: KeptSpectra) -> Array:
    """The spectrum (n,) that a lamp shall have, with the luminance of the old one."""
    from illuminant.core import core
    from illuminant.spectrum_word import light

    if isinstance(word, str):
        word = light(word)
    if group.light is None or group.lanes is None:
        raise ImageError(
            f"The lanes of lamp {lamp!r} are not kept apart: render the scene again with --keep-spectra --lamps."
        )
    nm = basis.every_nm
    values = word.at(nm)
    seen = core().matching_functions(nm, STANDARD)[:, 1]
    new, old = float(values @ seen), float(group.light.spectrum @ seen)
    if not new > 0:
        raise UsageError(f"--lamp {lamp}={word.name}: this light has no luminance.")
    if not old > 0:
        raise UsageError(f"--lamp {lamp}={word.name}: lamp {lamp!r} of the scene has no light to begin with.")
    return values * (old / new)


def _with_powers(image: Image, groups: dict[str, _Group], power: Mapping[str, float]) -> Image:
    """The image with other powers; lanes and basis follow."""
    layers = dict(image.layers)
    xyz = image.xyz.copy()
    for lamp, factor in power.items():
        xyz += (factor - 1.0) * groups[lamp].xyz
        lanes = groups[lamp].lanes
        for layer in (f"lamp:{lamp}", f"spectra:{lamp}"):
            if layer in layers:
                layers[layer] = factor * layers[layer]
        if lanes is not None and "spectra" in layers:
            layers["spectra"] = layers["spectra"] + (factor - 1.0) * lanes
    basis = image.basis
    if basis is not None:
        changed = tuple(
            dataclasses.replace(
                light,
                spectrum=light.spectrum * power.get(light.name, 1.0),
                lanes=light.lanes * power.get(light.name, 1.0),
            )
            for light in basis.lamps
        )
        basis = dataclasses.replace(basis, lamps=changed)
    apart = all(groups[lamp].lanes is not None for lamp in power)
    if "spectra" in layers and not apart:
        del layers["spectra"]
    kept = "spectra" in layers
    settings = _told(image, {"power": dict(power)})
    return dataclasses.replace(
        image,
        xyz=xyz,
        layers=layers,
        settings=settings,
        wavelengths_nm=image.wavelengths_nm if kept else None,
        to_xyz=image.to_xyz if kept else None,
        basis=basis if kept else None,
    )


def _seen_by(image: Image) -> str:
    """The observer whose XYZ an image holds."""
    stages = image.settings.get("developed")
    seen = (
        [how.get("observer") for how in stages if isinstance(how, dict)] if isinstance(stages, list) else []
    )
    return str(next((name for name in reversed(seen) if name), STANDARD))


def _told(image: Image, how: dict[str, Any]) -> dict[str, Any]:
    """The settings of an image with one development more."""
    before = image.settings.get("developed")
    return {**image.settings, "developed": [*(before if isinstance(before, list) else []), how]}


@dataclass
class _Development:
    """One development that needs lanes.

    Attributes:
        source: the image that is developed; `groups` the light of its lamps.
        worth: what lanes are worth.
        spectra: new spectra (n,) by lamp.
        power: factors by lamp, other than 1.
    """

    source: Image
    groups: dict[str, _Group]
    worth: LaneWeights
    spectra: dict[str, Array]
    power: dict[str, float]

    def observer(self, word: str, matrix: str) -> Observer:
        """The observer, whose white, if it is a camera, is the light of all lamps as they are developed."""
        import numpy as np

        from illuminant.core import core

        nm = self.worth.nm
        seen = core().matching_functions(nm, STANDARD)[:, 1] * LUMINOUS_EFFICACY
        light = np.zeros(len(nm))
        for lamp in self.worth.basis.lamps:
            luminance = float(lamp.spectrum @ seen)
            group = self.groups.get(lamp.name)
            # A lamp counts by what it gives to the picture; units of lamps differ.
            share = float(group.xyz[..., 1].mean()) if group is not None else 1.0
            if luminance > 0:
                spectrum = self.spectra.get(lamp.name, lamp.spectrum)
                light += self.power.get(lamp.name, 1.0) * share / luminance * spectrum
        return named(word, nm, light if light.any() else np.ones(len(nm)), matrix)

    def _together(self, observer: Observer) -> Array:
        """(3, N) what the lanes of all light are worth."""
        before = self.source.to_xyz if observer.name == STANDARD else None
        return self.worth.together(observer) if before is None else before

    def image(self, observer: Observer, regular: float | None, lamps: dict[str, Any]) -> Image:
        """The developed image."""
        import numpy as np

        source, as_before = self.source, observer.name == STANDARD
        total = source.layers["spectra"]
        xyz = source.xyz.copy() if as_before else np.zeros_like(source.xyz)
        layers = {
            name: layer
            for name, layer in source.layers.items()
            if name.partition(":")[0] not in ("spectra", "lamp")
        }
        rest = total.astype(np.float64)
        maps: list[tuple[float, Array, Array, LampLight | None]] = []
        for group in self.groups.values():
            lanes, light, factor = group.lanes, group.light, self.power.get(group.name, 1.0)
            if lanes is None or light is None:
                continue
            rest -= lanes
            if as_before and group.name not in self.spectra:
                part, weights = group.xyz, self._together(observer)
            else:
                weights = self.worth.of_lamp(light, observer, self.spectra.get(group.name))
                part = lanes @ weights.T
            xyz += factor * part - (group.xyz if as_before else 0.0)
            if f"lamp:{group.name}" in source.layers:
                layers[f"lamp:{group.name}"] = factor * part
            maps.append((factor, lanes, weights, light))
        changed = [
            name for name in self.power if self.groups[name].lanes is None or self.groups[name].light is None
        ]
        if changed and not (as_before and regular is None):
            raise ImageError(
                f"The lanes of lamp {changed[0]!r} are not kept apart: render the scene again with --keep-spectra "
                "--lamps."
            )
        for name in changed:
            xyz += (self.power[name] - 1.0) * self.groups[name].xyz
        # Rounding of single precision is no light.
        left = float(np.abs(rest).max()) > 1e-4 * float(np.abs(total).max(initial=0.0))
        if left:
            weights = self._together(observer)
            if not as_before:
                xyz += rest @ weights.T
            maps.append((1.0, rest, weights, None))
        errors = self.worth.errors
        how: dict[str, Any] = {"observer": observer.name}
        how |= {"matrix": observer.matrix} if observer.matrix else {}
        how |= {"camera": observer.error.to_json()} if observer.error else {}
        how |= {"lamps": lamps} if lamps else {}
        how |= {"power": self.power} if self.power else {}
        how |= {"refit": {name: error.to_json() for name, error in errors.items()}} if errors else {}
        how |= {"dark": self.worth.dark} if self.worth.dark else {}
        made = dataclasses.replace(
            source, xyz=xyz, layers=layers, wavelengths_nm=None, to_xyz=None, basis=None, settings={}
        )
        if regular is not None:
            how["regular"] = self._write_regular(made, maps, observer, regular)
        made.settings = _told(source, how)
        return made

    def _write_regular(
        self,
        made: Image,
        maps: list[tuple[float, Array, Array, LampLight | None]],
        observer: Observer,
        step: float,
    ) -> dict[str, Any]:
        """Put spectra on a regular grid into an image; step and error."""
        import numpy as np

        wavelengths = regular_spectra.grid(*self.worth.basis.range_nm, step)
        spectra = np.zeros((*made.xyz.shape[:2], len(wavelengths)))
        for factor, lanes, weights, light in maps:
            own = np.ones(len(self.worth.basis.wavelengths_nm)) if light is None else light.lanes
            usable = own > DARK * own.max(initial=0.0)
            filters = np.zeros((len(self.worth.nm), len(own)))
            if usable.any():
                curves = regular_spectra.smooth(self.worth.nm, self.worth.basis.wavelengths_nm[usable])
                filters[:, usable] = curves / own[usable]
            shown = (
                np.ones(len(self.worth.nm)) if light is None else self.spectra.get(light.name, light.spectrum)
            )
            matrix = regular_spectra.spread(
                self.worth.nm, wavelengths, shown, filters, weights, observer.functions
            )
            spectra += factor * (lanes @ matrix.T)
        np.maximum(spectra, 0.0, out=spectra)
        by_sum, by_lines = regular_spectra.readers(self.worth.nm, wavelengths, observer.functions)
        white = made.white() / 0.8
        made.layers["spectra"] = spectra.astype(np.float32)
        made.wavelengths_nm, made.to_xyz = wavelengths, by_sum
        return {
            "step_nm": float(step),
            "sum": regular_spectra.reader_error(made.xyz, spectra @ by_sum.T, white).to_json(),
            "lines": regular_spectra.reader_error(made.xyz, spectra @ by_lines.T, white).to_json(),
        }


def described(how: Mapping[str, Any]) -> list[str]:
    """One development, as an entry of `settings["developed"]` has it, in sentences.

    Example:
        >>> described({"observer": "CIE 1931 2°", "power": {"desk": 0.5}, "lamps": {"window": "A"}})
        ['lamp window with the spectrum A', 'lamp desk times 0.5']
    """
    refit = how.get("refit", {})

    def cost(name: str) -> str:
        found = refit.get(name)
        return f", ΔE00 {found['mean']:.2g} (max {found['max']:.2g})" if found else ""

    said = []
    if how.get("observer", STANDARD) != STANDARD:
        matrix = f" by matrix {how['matrix']}" if how.get("matrix") else ""
        camera = how.get("camera")
        away = (
            f", off the 2° observer by ΔE00 {camera['mean']:.2g} (max {camera['max']:.2g})" if camera else ""
        )
        said.append(f"seen by {how['observer']}{matrix}{away}")
    lamps = how.get("lamps", {})
    said += [f"lamp {name} with the spectrum {spectrum}{cost(name)}" for name, spectrum in lamps.items()]
    said += [
        f"{'' if name == ALL else 'lamp '}{name} with new weights{cost(name)}"
        for name in refit
        if name not in lamps
    ]
    said += [f"lamp {name} times {factor:g}" for name, factor in how.get("power", {}).items()]
    said += [
        f"lamp {name} was dark in {count} of the wavelengths, which count for nothing"
        for name, count in how.get("dark", {}).items()
    ]
    regular = how.get("regular")
    if regular:
        errors = " and ".join(
            f"{regular[key]['mean']:.2g} (max {regular[key]['max']:.2g}) by {words}"
            for key, words in (("sum", "sums over the grid"), ("lines", "straight lines"))
        )
        said.append(f"spectra every {regular['step_nm']:g} nm, whose readers are off by ΔE00 {errors}")
    return said
