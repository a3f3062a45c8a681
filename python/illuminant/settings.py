"""The options of a render, checked and complete.

One set of words serves the command line, Python and the table `[render]` of a scene. An option that was
given wins over the scene's own, and that over the default. Words of the command line (`"960x540"`, `"30s"`,
`"1%"`, `"gaussian:1.5"`) and plain values (`(960, 540)`, `30.0`, `0.01`, `("gaussian", 1.5)`) mean the same
everywhere.

Example:
    >>> settings = resolve({"samples": 256, "seed": 3}, samples=16, size="320x180")
    >>> settings.samples, settings.seed, settings.size
    (16, 3, (320, 180))
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

from illuminant.errors import UsageError

__all__ = [
    "LAYERS",
    "Settings",
    "duration",
    "filter_of",
    "form_factors_of",
    "fraction",
    "pixel",
    "resolve",
    "shadows_of",
    "size_of",
]

LAYERS = ("depth", "normal", "albedo", "samples", "terms")
"""Auxiliary images that can be asked for by name."""

SCANLINE = ("constant", "gouraud", "phong")
"""The techniques that scan polygons."""

RAY_TREES = ("raytrace", "distributed", "hybrid")
"""The techniques that follow trees of rays."""

SOLVED = ("radiosity", "specular-radiosity", "hybrid")
"""The techniques that solve for the light between surfaces first."""

SOLVERS = ("bicgstab", "gauss-seidel", "gauss", "progressive")
GATHERS = ("none", "direct", "full")
ELEMENTS_WITH_DIRECTIONS = 1000
"""About how many elements `specular-radiosity` has if nothing is said."""

MECHANISMS = ("dd", "sd", "ds", "ss")
"""The ways of light of `hybrid`: how it arrives, diffuse or specular, and how it is reflected (book figure 4.27)."""
FORM_FACTORS = {"rays": 1024, "hemicube": 64, "scanline": 64, "area": 16}
"""How form factors are found, with the number that each has if none is stated."""

INTERPOLATIONS = ("object", "screen")
SHADINGS = ("full", "duff", "bishop-weimer")

ANTIALIASINGS = ("supersampling", "coverage")
INFINITE = ("eye", "lights")

SHADOW_MAP = 1024
"""Texels across a shadow map of which no size is stated."""

SAMPLERS = ("sobol-owen", "random", "stratified", "jittered", "poisson-disk")

RADII = {"gaussian": 1.5, "box": 0.5, "tent": 1.0, "mitchell": 2.0, "blackman-harris": 1.5}
"""The reconstruction filters, with the radius in pixels that each has if none is stated."""

DEFAULT_SAMPLES = 64

UNKNOWN_SAMPLES = 64
"""Over so many samples a pixel samplers spread their numbers while nobody knows how many there will be."""

_UNITS = {"": 1.0, "s": 1.0, "m": 60.0, "min": 60.0, "h": 3600.0}


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Everything about a render that is not the scene.

    Attributes:
        technique: how light is followed.
        illumination: what a surface does.
        sampling: how wavelengths are carried.
        samples: paths for each pixel; None while `time` or `error` decides.
        size: width and height in pixels; None keeps the camera's.
        depth: longest path in segments; 1 shows lamps only, 2 direct light, None is no limit.
        seed: of the random numbers.
        threads: 0 for one a processor. Changes no bit of the image.
        filter: kind and radius in pixels of the reconstruction filter.
        layers: auxiliary images (`LAYERS`).
        keep_spectra: whether the lanes are kept.
        lamps: whether there is a layer for each lamp.
        develop_for: lamps under which the image shall be seen later, which a fitted sampling is to serve too.
        time: seconds after which to end, or None.
        error: relative standard error at which to end (0.01 is 1 %), or None.
        sampler: which random numbers: `sobol-owen`, `random`, `stratified`, `jittered` or `poisson-disk`.
        threshold: weight below which ray tracing follows a ray no more.
        caustics: whether `path` finds from the lamps what mirrors and smooth glass make of their light.
        cones: whether the rays of `raytrace` are cones.
        light_centres: where ray tracing asks lamps that have an area: `jittered`, `random`, or `fixed:N`.
        ambient: ambient light of all techniques but `path`, as a fraction of what the lamps would make of a white
            diffuser in the middle of the scene.
        interpolation: where they interpolate: `object` or `screen`.
        shading: how `phong` finds the illumination at a pixel: `full`, `duff` or `bishop-weimer`.
        shadows: how they look for what stands between a surface and a lamp: `none`, `rays`, or `maps:N` of N texels.
        antialiasing: how they smooth edges: `supersampling` or `coverage`.
        infinite: what they hold at infinity: `eye`, `lights`, both or nothing.
        subdivide: area in pixels above which they subdivide polygons; None leaves them whole.
        elements: about how many elements radiosity cuts surfaces into.
        patches: about how many patches these make, which send light on; None is one for each element.
        adaptive: fraction by which direct light may differ about an element before it is cut again; None never is.
        form_factors: how they are found: `rays:N`, `hemicube:N`, `scanline:N` or `area:N`.
        solver: `bicgstab`, `gauss-seidel`, `gauss` or `progressive`.
        light_samples: at how many places of an element each lamp is asked.
        gather: what a pixel makes of the solution: `none` shows it, `direct` asks lamps again, `full` looks around.
        mechanisms: ways of light that `hybrid` follows: `dd`, `sd`, `ds`, `ss`.
        cube: cells along an edge of the cubes into which each patch of `specular-radiosity` sends light.
        frustum: rays along an edge of the frustum in which `hybrid` samples gloss; None draws one ray.
    """

    technique: str = "path"
    illumination: str = "general"
    sampling: str = "fitted:8"
    samples: int | None = DEFAULT_SAMPLES
    size: tuple[int, int] | None = None
    depth: int | None = None
    seed: int = 0
    threads: int = 0
    filter: tuple[str, float] = ("gaussian", 1.5)
    layers: tuple[str, ...] = ()
    keep_spectra: bool = False
    lamps: bool = False
    develop_for: tuple[str, ...] = ()
    time: float | None = None
    error: float | None = None
    sampler: str = "sobol-owen"
    threshold: float = 0.002
    caustics: bool = False
    cones: bool = False
    light_centres: str = "jittered"
    ambient: float = 0.15
    interpolation: str = "object"
    shading: str = "full"
    shadows: str = "none"
    antialiasing: str = "supersampling"
    infinite: tuple[str, ...] = ()
    subdivide: float | None = None
    elements: int = 6000
    patches: int | None = None
    adaptive: float | None = None
    form_factors: str = "rays:1024"
    solver: str = "bicgstab"
    light_samples: int = 64
    gather: str = "none"
    mechanisms: tuple[str, ...] = MECHANISMS
    frustum: int | None = None
    cube: int = 32

    @property
    def replicates(self) -> int:
        """Independently scrambled parts of the samples: two when their difference must tell the error."""
        return 2 if self.error is not None else 1

    def to_core(self) -> str:
        """The settings as the core takes them (JSON)."""
        # Where lamps are, the image has to know to find its white.
        layers = ["emission", *(name for name in self.layers if name != "samples")]
        layers += ["spectra"] * self.keep_spectra + ["lamps"] * self.lamps
        kind, radius = self.filter
        shadows, _, texels = self.shadows.partition(":")
        centres, _, count = self.light_centres.partition(":")
        return json.dumps(
            {
                "technique": self.technique,
                "illumination": self.illumination,
                "sampling": self.sampling,
                "depth": self.depth,
                "seed": self.seed,
                "threads": self.threads,
                "filter": {"kind": kind, "radius": radius},
                "layers": layers,
                "develop_for": [_every_nm(lamp) for lamp in self.develop_for],
                "replicates": self.replicates,
                "sampler": self.sampler,
                "strata": min(self.samples or UNKNOWN_SAMPLES, 65536),
                "threshold": self.threshold,
                "caustics": self.caustics,
                "cones": self.cones,
                "light_centres": {"fixed": int(count)} if count else centres,
                "ambient": self.ambient,
                "interpolation": self.interpolation,
                "shading": self.shading,
                "shadows": {"maps": int(texels)} if texels else shadows,
                "antialiasing": self.antialiasing,
                "infinite": {name: name in self.infinite for name in INFINITE},
                "subdivide": self.subdivide,
                "radiosity": {
                    "elements": self.elements,
                    "patches": self.patches,
                    "adaptive": self.adaptive,
                    "form_factors": self.form_factors,
                    "solver": self.solver,
                    "light_samples": self.light_samples,
                    "gather": self.gather,
                    "mechanisms": {
                        "diffuse_to_diffuse": "dd" in self.mechanisms,
                        "specular_to_diffuse": "sd" in self.mechanisms,
                        "diffuse_to_specular": "ds" in self.mechanisms,
                        "specular_to_specular": "ss" in self.mechanisms,
                    },
                    "frustum": self.frustum,
                    "cube": self.cube,
                },
            }
        )

    def to_header(self) -> dict[str, Any]:
        """The settings that change a number of the image, as the header of its file states them."""
        kind, radius = self.filter
        return {
            "technique": self.technique,
            "illumination": self.illumination,
            "sampling": self.sampling,
            "depth": self.depth,
            "seed": self.seed,
            "filter": f"{kind}:{radius:g}",
            "sampler": self.sampler,
            "replicates": self.replicates,
            **({} if self.error is None else {"error": self.error}),
            **({"develop_for": ",".join(self.develop_for)} if self.develop_for else {}),
            **({"caustics": True} if self.caustics else {}),
            **(self._scanline() if self.technique in SCANLINE else {}),
            **(self._ray_trees() if self.technique in RAY_TREES else {}),
            **(self._solved() if self.technique in SOLVED else {}),
        }

    def _solved(self) -> dict[str, Any]:
        return {
            "elements": self.elements,
            **({} if self.patches is None else {"patches": self.patches}),
            **({} if self.adaptive is None else {"adaptive": self.adaptive}),
            "form_factors": self.form_factors,
            "solver": self.solver,
            "light_samples": self.light_samples,
            "gather": self.gather,
            **({"mechanisms": ",".join(self.mechanisms)} if self.mechanisms != MECHANISMS else {}),
            **({} if self.frustum is None else {"frustum": self.frustum}),
            **({"cube": self.cube} if self.technique == "specular-radiosity" else {}),
        }

    def _ray_trees(self) -> dict[str, Any]:
        return {
            "ambient": self.ambient,
            "threshold": self.threshold,
            "light_centres": self.light_centres,
            **({"cones": True} if self.cones else {}),
        }

    def _scanline(self) -> dict[str, Any]:
        return {
            "ambient": self.ambient,
            "interpolation": self.interpolation,
            "shadows": self.shadows,
            "antialiasing": self.antialiasing,
            **({"infinite": ",".join(self.infinite)} if self.infinite else {}),
            **({} if self.subdivide is None else {"subdivide": self.subdivide}),
            **({"shading": self.shading} if self.technique == "phong" else {}),
        }


def resolve(defaults: Mapping[str, Any] | None = None, **given: Any) -> Settings:
    """Settings from the options given, then the scene's `[render]` table, then the defaults.

    Args:
        defaults: the scene's own; keys that are no setting (exposure, say) are passed over.
        given: options by name; None means not given.

    Raises:
        UsageError: an option is unknown, or its value cannot be; the sentence names it.
    """
    names = {field.name for field in fields(Settings)}
    unknown = [name for name in given if name not in names]
    if unknown:
        raise UsageError(f"There is no render option {unknown[0]!r}: known are {', '.join(sorted(names))}.")
    chosen = {name: value for name, value in (defaults or {}).items() if name in names and value is not None}
    limit = given.get("time") is not None or given.get("error") is not None
    if limit and given.get("samples") is None:
        chosen["samples"] = None
    chosen |= {name: value for name, value in given.items() if value is not None}
    technique = chosen.get("technique", Settings.technique)
    for name, techniques in (
        ("caustics", ("path",)),
        ("cones", ("raytrace",)),
        ("frustum", ("hybrid",)),
        ("gather", ("radiosity", "hybrid")),
    ):
        # What a scene wants of its own technique is nothing to another.
        if given.get(name) is None and technique not in techniques:
            chosen.pop(name, None)
    if technique == "specular-radiosity":
        # Each patch has thousands of directions.
        chosen.setdefault("elements", ELEMENTS_WITH_DIRECTIONS)
    if chosen.get("cones") and given.get("samples") is None:
        # They are all the same.
        chosen["samples"] = 1
    if "filter" in chosen:
        chosen["filter"] = filter_of(chosen["filter"])
    if "size" in chosen:
        chosen["size"] = size_of(chosen["size"])
    if "time" in chosen:
        chosen["time"] = duration(chosen["time"])
    if "error" in chosen:
        chosen["error"] = fraction(chosen["error"])
    for name, known in (
        ("interpolation", INTERPOLATIONS),
        ("shading", SHADINGS),
        ("antialiasing", ANTIALIASINGS),
        ("sampler", SAMPLERS),
        ("solver", SOLVERS),
        ("gather", GATHERS),
    ):
        if chosen.get(name, known[0]) not in known:
            *others, last = known
            raise UsageError(f"--{name} {chosen[name]}: expected {', '.join(others)} or {last}.")
    if "threshold" in chosen and not (
        isinstance(chosen["threshold"], (int, float)) and 0 <= chosen["threshold"] < 1
    ):
        raise UsageError(
            f"--threshold {chosen['threshold']}: expected a weight from 0 to below 1, such as 0.002."
        )
    if not re.fullmatch(r"jittered|random|fixed:[1-9]\d{0,3}", str(chosen.get("light_centres", "jittered"))):
        raise UsageError(
            f"--light-centres {chosen['light_centres']}: expected jittered, random, or fixed with their number, such "
            "as fixed:4."
        )
    if "form_factors" in chosen:
        chosen["form_factors"] = form_factors_of(chosen["form_factors"])
    if "adaptive" in chosen and not (
        isinstance(chosen["adaptive"], (int, float)) and 0 < chosen["adaptive"] <= 10
    ):
        raise UsageError(
            f"--adaptive {chosen['adaptive']}: expected a fraction above 0 and up to 10, such as 0.2."
        )
    if "shadows" in chosen:
        chosen["shadows"] = shadows_of(chosen["shadows"])
    if "mechanisms" in chosen:
        chosen["mechanisms"] = _names("mechanisms", chosen["mechanisms"], MECHANISMS)
    if "infinite" in chosen:
        chosen["infinite"] = _names("infinite", chosen["infinite"], INFINITE)
    if "subdivide" in chosen and not (
        isinstance(chosen["subdivide"], (int, float)) and 1 <= chosen["subdivide"] < math.inf
    ):
        raise UsageError(
            f"--subdivide {chosen['subdivide']}: expected an area of 1 pixel or more, such as 4."
        )
    if "ambient" in chosen and not (
        isinstance(chosen["ambient"], (int, float)) and 0 <= chosen["ambient"] <= 10
    ):
        raise UsageError(f"--ambient {chosen['ambient']}: expected a fraction from 0 to 10, such as 0.15.")
    if "develop_for" in chosen:
        chosen["develop_for"] = _lamps(chosen["develop_for"], str(chosen.get("sampling", Settings.sampling)))
    if "layers" in chosen:
        chosen["layers"] = _names("layers", chosen["layers"], LAYERS)
    for name, least, most in (
        ("samples", 1, 2**32 - 1),
        ("depth", 1, 2**16 - 1),
        ("seed", 0, 2**63 - 1),
        ("threads", 0, 4096),
        ("elements", 1, 4_000_000),
        ("patches", 1, 4_000_000),
        ("light_samples", 1, 65536),
        ("frustum", 2, 32),
        ("cube", 4, 256),
    ):
        if chosen.get(name) is not None:
            chosen[name] = _whole(name, chosen[name], least, most)
    return Settings(**chosen)


def _whole(name: str, value: Any, least: int, most: int) -> int:
    try:
        number = int(value)
    except (TypeError, ValueError, OverflowError):
        number = least - 1
    if isinstance(value, (bool, str)) or number != value or not least <= number <= most:
        name = name.replace("_", "-")
        raise UsageError(f"--{name} {value}: expected a whole number from {least} to {most}.")
    return number


def _lamps(value: str | Sequence[str], sampling: str) -> tuple[str, ...]:
    """Lamps by their names, each of which means a light that can be seen."""
    from illuminant.errors import DataError

    names = value.split(",") if isinstance(value, str) else list(value)
    names = list(dict.fromkeys(name.strip() for name in names if name.strip()))
    for name in names:
        try:
            light = _every_nm(name)
        except (DataError, UsageError) as error:
            raise UsageError(f"--develop-for {name}: {str(error).rstrip('.')}.") from None
        if not any(light):
            raise UsageError(f"--develop-for {name}: it has no light from 360 to 830 nm.")
    if names and sampling.partition(":")[0] != "fitted":
        raise UsageError(
            f"--develop-for {','.join(names)}: only fitted:N is made for lamps; {sampling} is what it is."
        )
    return tuple(names)


def _every_nm(lamp: str) -> list[float]:
    """The spectrum that a word means at each nm that an observer sees, 360 to 830."""
    import numpy as np

    from illuminant import spectrum_word

    return [float(value) for value in spectrum_word.light(lamp).at(np.arange(360.0, 831.0))]


def size_of(value: str | Sequence[int]) -> tuple[int, int]:
    """Width and height from `960x540` or `(960, 540)`.

    Raises:
        UsageError: it is neither, or the image would be too large.

    Example:
        >>> size_of("960x540")
        (960, 540)
    """
    from illuminant.schema import MAX_PIXELS

    text = value if isinstance(value, str) else "x".join(str(side) for side in value)
    match = re.fullmatch(r"\s*(\d{1,30})\s*[xX×]\s*(\d{1,30})\s*", text)
    width, height = (int(match[1]), int(match[2])) if match else (0, 0)
    if width < 1 or height < 1:
        raise UsageError(f"--size {text}: expected width and height in pixels, such as 960x540.")
    if width * height > MAX_PIXELS:
        raise UsageError(
            f"--size {text}: that is {width * height:.3g} pixels, and an image has at most {MAX_PIXELS:,} "
            "(8192x8192, say)."
        )
    return width, height


def duration(value: str | float, option: str = "--time") -> float:
    """Seconds from `30`, `30s`, `5m` or `1.5h`; `option` is what an error calls it.

    Raises:
        UsageError: it is no such time, or not above zero.

    Example:
        >>> duration("5m"), duration("90s"), duration(2)
        (300.0, 90.0, 2.0)
    """
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*(s|m|min|h|)\s*", str(value))
    try:
        seconds = float(match[1]) * _UNITS[match[2]] if match else math.nan
    except ValueError:
        seconds = math.nan
    if not (seconds > 0 and math.isfinite(seconds)):
        raise UsageError(f"{option} {value}: expected a time such as 30s, 5m or 1.5h.")
    return seconds


def fraction(value: str | float) -> float:
    """A relative error from `1%` or `0.01`.

    Raises:
        UsageError: it is no number, or not between 0 and 1.

    Example:
        >>> fraction("1%"), fraction(0.02)
        (0.01, 0.02)
    """
    text = str(value).strip()
    try:
        number = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        number = math.nan
    if not 0 < number < 1:
        raise UsageError(f"--error {value}: expected a relative error such as 1% or 0.01.")
    return number


def filter_of(value: str | Sequence[Any] | Mapping[str, Any]) -> tuple[str, float]:
    """Kind and radius in pixels from `gaussian:1.5`, `box`, `("tent", 1.0)` or the scene's `{ kind, radius }`.

    Raises:
        UsageError: there is no such filter, or the radius is not from above 0 to 16.

    Example:
        >>> filter_of("box"), filter_of("gaussian:2"), filter_of("mitchell")
        (('box', 0.5), ('gaussian', 2.0), ('mitchell', 2.0))
    """
    if isinstance(value, Mapping):
        kind, radius = str(value["kind"]), value.get("radius")
        text = "" if radius is None else str(radius)
    elif isinstance(value, str):
        kind, _, text = value.partition(":")
    else:
        kind, text = str(value[0]), str(value[1])
    try:
        radius = float(text) if text else RADII.get(kind, math.nan)
    except ValueError:
        radius = math.nan
    if kind not in RADII or not 0 < radius <= 16:
        *others, last = RADII
        raise UsageError(
            f"--filter {kind}{':' if text else ''}{text}: expected {', '.join(others)} or {last}, with a radius "
            "in pixels if you like, such as gaussian:1.5."
        )
    return kind, radius


def pixel(value: str | Sequence[int]) -> tuple[int, int]:
    """Column and row, from the top left, from `120,80` or `(120, 80)`.

    Raises:
        UsageError: it is neither.
    """
    text = value if isinstance(value, str) else ",".join(str(part) for part in value)
    match = re.fullmatch(r"\s*(\d{1,9})\s*,\s*(\d{1,9})\s*", text)
    if match is None:
        raise UsageError(f"--pixel {text}: expected column and row from the top left, such as 120,80.")
    return int(match[1]), int(match[2])


def shadows_of(value: str) -> str:
    """How shadows are found, complete: `none`, `rays`, or `maps` with its texels.

    Raises:
        UsageError: it is none of them, or the maps are not from 64 to 16384 texels wide.

    Example:
        >>> shadows_of("maps"), shadows_of("maps:512"), shadows_of("rays")
        ('maps:1024', 'maps:512', 'rays')
    """
    kind, _, texels = str(value).partition(":")
    if str(value) in ("none", "rays"):
        return kind
    size = texels or str(SHADOW_MAP)
    if kind != "maps" or not re.fullmatch(r"\d{2,5}", size) or not 64 <= int(size) <= 16384:
        raise UsageError(
            f"--shadows {value}: expected none, rays, or maps with their width in texels if you like, such as "
            "maps:1024."
        )
    return f"maps:{int(size)}"


def form_factors_of(value: str) -> str:
    """How form factors are found, complete with its number.

    Raises:
        UsageError: there is no such way, or the number cannot be.

    Example:
        >>> form_factors_of("rays"), form_factors_of("hemicube:100")
        ('rays:1024', 'hemicube:100')
    """
    kind, _, text = str(value).partition(":")
    number = text or str(FORM_FACTORS.get(kind, ""))
    least, most = {"rays": (1, 2**20), "area": (1, 2**16)}.get(kind, (2, 2048))
    known = kind in FORM_FACTORS and re.fullmatch(r"\d{1,7}", number) is not None
    if not known or not least <= int(number) <= most:
        raise UsageError(
            f"--form-factors {value}: expected rays, hemicube, scanline or area, with a number if you like, such as "
            "rays:1024 or hemicube:64."
        )
    if kind in ("hemicube", "scanline") and int(number) % 2:
        raise UsageError(f"--form-factors {value}: a hemi-cube has an even number of cells along an edge.")
    return f"{kind}:{int(number)}"


def _names(option: str, value: str | Sequence[str], known: tuple[str, ...]) -> tuple[str, ...]:
    names = value.split(",") if isinstance(value, str) else list(value)
    names = [name.strip() for name in names if name.strip()]
    what = {"layers": "layer"}.get(option, "choice")
    for name in names:
        if name not in known:
            raise UsageError(f"--{option} {name}: there is no such {what}; known are {', '.join(known)}.")
    return tuple(dict.fromkeys(names))
