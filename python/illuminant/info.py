"""What illuminant found on this machine, and what to do about what it did not find.

Example:
    >>> facts = machine_facts()              # doctest: +SKIP
    >>> facts["embree"]["version"]           # doctest: +SKIP
    '4.4.0'
"""

from __future__ import annotations

import math
import os
import platform
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from illuminant import embree as embree_library
from illuminant import machine, processor, sources
from illuminant.core import core, embree
from illuminant.errors import Error, ImageError, UsageError

__all__ = ["PACKAGES", "image_facts", "machine_facts", "remake", "same_scene"]

# Module, package to install, what for, and whether rendering needs it.
PACKAGES = (
    ("numpy", "numpy", "arrays", True),
    ("OpenImageIO", "openimageio", "EXR and PNG files, textures", True),
    ("pydantic", "pydantic", "scene files", True),
    ("trimesh", "trimesh", "OBJ, PLY, STL and GLB meshes", True),
    ("flip_evaluator", "flip-evaluator", "FLIP in illuminant diff", False),
    ("matplotlib", "matplotlib", "plots", False),
    ("ray", "ray", "illuminant farm", False),
)

# What of a look is said in words; the rest is in --json.
_LOOK = ("display", "tone", "gamut", "dither", "bits", "pipeline")


def machine_facts() -> dict[str, Any]:
    """What was found: versions, core, Embree, processor, memory, packages.

    Nothing that is missing is an error here: its entry has a `remedy` instead, one sentence on what to do.
    """
    import illuminant

    features = processor.features()
    absent = [] if features is None else processor.missing(features)
    facts: dict[str, Any] = {
        "illuminant": {"version": illuminant.__version__, "path": str(Path(__file__).parent)},
        "python": {"version": platform.python_version(), "path": sys.executable},
        "processor": {
            "model": processor.model(),
            "level": f"{processor.LEVEL} {'lacks ' + ', '.join(absent) if absent else 'found'}"
            if features is not None
            else "not checked here",
            "wide": [
                name
                for flag, name in (("avx2", "AVX2"), ("fma", "FMA"), ("avx512f", "AVX-512"))
                if features and flag in features
            ],
            "cores": machine.cores(),
        },
        "memory": {"total": machine.memory(), "available": machine.memory_available()},
    }
    if absent:
        facts["processor"]["remedy"] = f"illuminant is compiled for {processor.LEVEL} and cannot run here."
    facts["core"] = _found(lambda: {"version": core().__version__})
    facts["embree"] = _found(lambda: {"version": embree(), "path": str(embree_library.find())})
    facts["packages"] = {package: _package(module, package, use) for module, package, use, _ in PACKAGES}
    return facts


def _found(ask: Any) -> dict[str, Any]:
    try:
        return dict(ask())
    except Error as error:
        return {"version": None, "remedy": str(error)}


def _package(module: str, package: str, use: str) -> dict[str, Any]:
    from importlib.metadata import PackageNotFoundError, version
    from importlib.util import find_spec

    if find_spec(module) is None:
        return {"version": None, "for": use, "remedy": f"install it with: pip install {package}"}
    try:
        return {"version": version(package), "for": use}
    except PackageNotFoundError:
        return {"version": "unknown", "for": use}


def image_facts(path: Path) -> dict[str, Any]:
    """What an image file says of itself, and the command that makes it again.

    What a file says in another form than illuminant's own is left out.

    Args:
        path: an EXR, a PNG, or a run-length encoded image.

    Raises:
        ImageError: it cannot be read.
        MachineError: an EXR does not fit into the memory that is free.
    """
    if path.is_dir():
        raise ImageError(f"{path} cannot be read: it is a folder.")
    if not path.is_file():
        raise ImageError(f"{path} cannot be read: there is no such file.")
    if path.suffix.lower() == ".png":
        return _png_facts(path)
    if path.suffix.lower() == ".rle":
        return _run_length_facts(path)
    if path.suffix.lower() != ".exr":
        raise ImageError(f"{path} cannot be read: only .exr, .png and .rle are.")
    return _exr_facts(path)


def _png_facts(path: Path) -> dict[str, Any]:
    from illuminant import png

    header = png.read_header(path)
    meant = header.display.name if header.display else "which does not say for which display"
    facts: dict[str, Any] = {
        "file": str(path),
        "size": [header.width, header.height],
        "format": f"PNG, {header.bits} bits a channel, {meant}",
    }
    try:
        exposure = float(header.text.get("Exposure", "0"))
    except ValueError:
        exposure = 0.0
    if 0 < exposure < math.inf and 1 / exposure < math.inf:
        unit = header.text.get("Unit", "")
        facts["unit"] = f"1 is {1 / exposure:.6g} {unit}"
        facts["exposure"] = exposure
    look = {key: value for key, value in header.look.items() if isinstance(value, (str, int, float, bool))}
    shown = [f"{key} {value}" for key, value in look.items() if key in _LOOK]
    if shown:
        facts["format"] += f"; {', '.join(shown)}"
    settings = _settings(header.settings)
    facts["settings"] = settings
    facts["look"] = header.look
    facts["remake"] = remake(settings, path, facts.get("exposure"), look)
    return facts


def _run_length_facts(path: Path) -> dict[str, Any]:
    from illuminant.display import run_length
    from illuminant.display.picture import Picture

    picture = Picture.open(path)
    display = picture.display
    packed = run_length.compression(sources.read(path, sys.maxsize), str(path))
    matte = "" if picture.matte is None else " and a matte"
    light = "linear" if display.gamma in (None, 1.0) else f"γ = {display.gamma:g}"
    primaries = ", ".join(f"({x:g}, {y:g})" for x, y in display.primaries)
    white = f"({display.white[0]:g}, {display.white[1]:g})"
    facts: dict[str, Any] = {
        "file": str(path),
        "size": [picture.width, picture.height],
        "format": f"run lengths, 8 bits a channel{matte}, {light}, primaries {primaries}, white {white}; "
        f"{packed.stored:,} bytes for {packed.unpacked:,}, {packed.ratio:.3g} to 1",
        "display": display.to_dict(),
        "compression": {
            "unpacked": packed.unpacked,
            "stored": packed.stored,
            "records": packed.records,
            "ratio": packed.ratio,
        },
        "settings": {},
        "remake": None,
    }
    return facts


def _settings(found: dict[str, Any]) -> dict[str, Any]:
    """Settings of a render, without those of another form: other programs have a text of that name too."""
    kept = dict(found)
    if "size" in kept and not (_numbers(kept["size"]) and len(kept["size"]) == 2):
        del kept["size"]
    samples = kept.get("samples")
    if samples is not None and not (_number(samples) or (_numbers(samples) and samples)):
        del kept["samples"]
    if "scene" in kept and not isinstance(kept["scene"], str):
        del kept["scene"]
    if "developed" in kept:
        stages = kept["developed"] if isinstance(kept["developed"], list) else []
        kept["developed"] = [stage for stage in stages if _describable(stage)]
    return kept


def _number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _numbers(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and all(_number(one) for one in value)


def _describable(stage: Any) -> bool:
    """Whether a stage of development can be said in words."""
    from illuminant.display.developing import described

    try:
        described(stage)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
        return False
    return isinstance(stage, dict)


def _exr_facts(path: Path) -> dict[str, Any]:
    from illuminant import exr

    contents = exr.read(path)
    height, width = contents.rgb.shape[:2]
    found = contents.attributes
    stated = contents.chromaticities
    xyz = stated is not None and all(abs(a - b) < 1e-6 for a, b in zip(stated, exr.XYZ, strict=True))
    system = (
        "XYZ"
        if xyz
        else found.get("rgbSystem", "RGB, see chromaticities" if stated else "RGB of unknown primaries")
    )
    settings = found.get("settings")
    settings = _settings(settings) if isinstance(settings, dict) else {}
    facts: dict[str, Any] = {
        "file": str(path),
        "size": [width, height],
        "format": f"EXR, {16 if contents.half else 32}-bit floats, {system}",
        "unit": f"Y in {found['unit']}" if "unit" in found else "not stated",
        "exposure": found.get("exposure"),
        "layers": {name: int(layer.shape[2]) for name, layer in contents.layers.items()},
        "settings": settings,
    }
    if contents.wavelengths_nm is not None:
        facts["wavelengths_nm"] = [float(wavelength) for wavelength in contents.wavelengths_nm]
    asked = _asked_layers(contents.layers) | ({"half": True} if contents.half else {})
    facts["remake"] = remake(settings | asked, path, None)
    return facts


_OPTIONS = (
    "technique",
    "illumination",
    "sampling",
    "depth",
    "filter",
    "sampler",
    "seed",
    "error",
    "develop_for",
    "caustics",
    "ambient",
    "threshold",
    "light_centres",
    "cones",
    "interpolation",
    "shading",
    "shadows",
    "antialiasing",
    "infinite",
    "subdivide",
    "elements",
    "patches",
    "adaptive",
    "form_factors",
    "solver",
    "light_samples",
    "gather",
    "mechanisms",
    "frustum",
    "cube",
    "layers",
    "keep_spectra",
    "lamps",
    "half",
)
"""What a header names that is an option of `illuminant render` under the same name."""


def _asked_layers(names: Iterable[str]) -> dict[str, Any]:
    """The options that make the layers of an image.

    Example:
        >>> _asked_layers(["depth", "diffuse", "specular", "lamp:sun"])
        {'layers': 'depth,terms', 'lamps': True}
    """
    names = list(names)
    asked: list[str] = [name for name in ("depth", "normal", "albedo", "samples") if name in names]
    asked += ["terms"] * ("diffuse" in names)
    return {
        **({"layers": ",".join(asked)} if asked else {}),
        **({"keep_spectra": True} if "spectra" in names else {}),
        **({"lamps": True} if any(name.startswith("lamp:") for name in names) else {}),
    }


def same_scene(settings: Mapping[str, Any], scene: str | os.PathLike[str]) -> bool:
    """Whether an image was made from a scene as it is now: the hash in its header is that of the scene.

    Args:
        settings: of the image, as its header states them.
        scene: a scene file.

    Raises:
        UsageError: the header names no scene.
        SceneError: the scene has mistakes.
    """
    from illuminant.job import resized
    from illuminant.scene import Scene

    known = settings.get("scene_hash")
    if not isinstance(known, str):
        raise UsageError("--scene: the image does not say which scene it was made from.")
    now = Scene.load(scene)
    size = settings.get("size")
    if isinstance(size, list) and len(size) == 2 and _numbers(size) and min(size) >= 1:
        now = resized(now, (int(size[0]), int(size[1])))
    return now.hash() == known


def remake(
    settings: dict[str, Any], path: Path, exposure: float | None, look: dict[str, Any] | None = None
) -> str | None:
    """The command that makes an image again; None when its header does not say enough.

    Args:
        settings: of the render.
        path: of the image.
        exposure: of a PNG.
        look: how a PNG was shown; what is the default is left out.

    Example:
        >>> from pathlib import Path
        >>> remake({"scene": "a.toml", "samples": 16, "size": [8, 4], "seed": 0}, Path("a.png"), 0.01)
        'illuminant render a.toml -o a.png --samples 16 --size 8x4 --seed 0 --exposure 0.01'
    """
    import shlex

    if not settings.get("scene") or "developed" in settings:
        return None
    if isinstance(settings.get("command"), str):  # of a contact sheet
        try:
            told = shlex.split(settings["command"])
        except ValueError:
            return None
        # A header may come from anybody: nothing but our own command is passed on, with its words quoted.
        return shlex.join([*told, "-o", str(path)]) if told[:2] == ["illuminant", "compare"] else None
    words = ["illuminant", "render", str(settings["scene"]), "-o", str(path)]
    if _number(settings.get("frame")):
        words += ["--frames", str(settings["frame"])]
    samples = settings.get("samples")
    if samples is not None:
        words += ["--samples", str(max(samples) if isinstance(samples, list) else samples)]
    if settings.get("size"):
        width, height = settings["size"]
        words += ["--size", f"{width}x{height}"]
    for key in _OPTIONS:
        value = settings.get(key)
        if value is True:
            words.append(f"--{key.replace('_', '-')}")
        elif value is not None and value is not False:
            words += [f"--{key.replace('_', '-')}", str(value)]
    if exposure is not None:
        words += ["--exposure", f"{exposure:g}"]
    from illuminant.display.gamut import DEFAULT

    usual = {"display": "sRGB", "tone": "none", "gamut": DEFAULT, "dither": "none", "bits": 8}
    usual |= {"transfer": None, "pipeline": "ideal"}
    for key, default in usual.items():
        if look and look.get(key, default) != default:
            words += [f"--{key}", str(look[key])]
    return shlex.join(words)
