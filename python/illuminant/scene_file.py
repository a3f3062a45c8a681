"""Scene files: TOML text to a resolved `Scene`, with every mistake of a file reported at once.

The core's TOML reader gives the data and the line of every key; `schema` says what each table may hold; `resolution`
and `objects` look up names, files and units. Nothing stops at the first mistake: the `SceneError` at the end holds all
of them, each with file, line, table, key, what was expected, and a near-miss suggestion.

Example:
    >>> from illuminant import scene_file
    >>> problems = scene_file.check("scenes/cornell.toml")     # doctest: +SKIP
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import machine, sources
from illuminant.core import core
from illuminant.errors import Problem, SceneError
from illuminant.objects import ObjectResolver, Placed
from illuminant.report import Report, found, read_table
from illuminant.resolution import Resolver, indexed
from illuminant.scene import Scene
from illuminant.schema import Camera, Render, SceneFile
from illuminant.sources import WORTH_A_LOOK, SourceError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["MAX_BYTES", "check", "load", "parse", "plain", "resolve", "schema_text", "shines", "still"]

BYTES_A_LETTER = 130
"""Memory that a letter of a scene file may take while it is parsed, with the line of every value."""

MAX_BYTES = 100_000_000
"""The largest scene file."""

NO_LIGHT = "the scene has no light; expected an object with an emitter material, or a table [lights.NAME]"
TABLES = (
    "camera", "render", "spectra", "materials", "objects", "lights", "atmosphere", "medium", "animation",
)  # fmt: skip


def load(path: str | os.PathLike[str], *, allow_outside: bool = False) -> Scene:
    """Read a scene file.

    Args:
        path: TOML; file names in it are relative to its folder.
        allow_outside: whether the files that it names may lie outside its folder.

    Raises:
        SceneError: the file cannot be read or has mistakes; all of them are in `problems`.
    """
    data, report = parse(path)
    return _resolved(data, report, Path(path).parent, allow_outside)


def check(path: str | os.PathLike[str], *, allow_outside: bool = False) -> list[Problem]:
    """Every mistake of a scene file, without rendering; none when it is right."""
    try:
        Scene.load(path, allow_outside=allow_outside)
    except SceneError as error:
        return error.problems
    return []


def parse(path: str | os.PathLike[str]) -> tuple[dict[str, Any], Report]:
    """The data of a TOML file, and a report that knows its lines.

    Raises:
        SceneError: the file cannot be read, or is not TOML.
    """
    file = os.fspath(path)
    try:
        content = sources.read(path, MAX_BYTES)
        text = content.decode("utf-8-sig")
    except SourceError as error:
        kind = "size" if error.kind == "large" else "missing-file"
        raise SceneError([Problem(file, 0, "", "", error.message, kind=kind)]) from None
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise SceneError([Problem(file, line, "", "", "is not UTF-8 text", kind="toml")]) from None
    if BYTES_A_LETTER * len(text) > WORTH_A_LOOK:
        machine.check_file(path, BYTES_A_LETTER * len(text))
    try:
        data, lines = core().parse_toml(text)
    except core().TomlError as error:
        message, line, column = error.args
        raise SceneError(
            [
                Problem(
                    file, int(line), "", "", f"is not valid TOML at column {column}: {message}", kind="toml"
                )
            ]
        ) from None
    return data, Report(file, lines)


def resolve(
    data: Mapping[str, Any], directory: str | os.PathLike[str] = ".", *, allow_outside: bool = True
) -> Scene:
    """A scene from the data of a scene file, as `plain` makes them.

    Args:
        data: the tables of the file.
        directory: folder that file names are relative to.
        allow_outside: whether files may lie outside that folder. They may, since data come from the program itself,
            which can read any file anyway; a service that passes on tables from others says False.

    Raises:
        SceneError: mistakes; all of them are in `problems`.
    """
    return _resolved(dict(data), Report(), Path(directory), allow_outside)


def plain(value: Any, key: str = "") -> Any:
    """Data from Python as a scene file would hold them: lists for tuples and arrays, numbers for NumPy's.

    Arrays of meshes and images stay arrays, and a `Spectrum` stays one; keys whose value is None are left out.
    """
    if isinstance(value, Mapping):
        return {str(name): plain(one, str(name)) for name, one in value.items() if one is not None}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    if hasattr(value, "wavelengths_nm"):
        return {
            "wavelengths_nm": list(value.wavelengths_nm),
            "values": list(value.values),
            "outside": value.outside,
        }
    if hasattr(value, "tolist") and not (
        key in ("positions", "faces", "normals", "uvs", "image") and value.ndim
    ):
        return value.tolist()
    return value


def shines(parts: Mapping[str, Any]) -> bool:
    """Whether anything in a description gives light."""
    return bool(parts["lights"]) or any(thing["emission"] for thing in parts["objects"])


def schema_text() -> str:
    """The reference of the scene file (Markdown): every table and key, with meaning, unit, default and example."""
    from illuminant.reference import scene_file_reference

    return scene_file_reference()


def _resolved(data: dict[str, Any], report: Report, directory: Path, allow_outside: bool) -> Scene:
    if "animation" not in data:
        return still(data, report, directory, allow_outside=allow_outside)
    from illuminant.animation import Animation

    animation = Animation.read(data, report, directory, allow_outside=allow_outside)
    animation.check()
    return animation.still(animation.first)


def still(
    data: Mapping[str, Any],
    report: Report,
    directory: Path,
    meshes: dict[tuple[Any, ...], Any] | None = None,
    *,
    allow_outside: bool = False,
) -> Scene:
    """A scene from the tables of a scene file, without `[animation]`.

    Args:
        data: the tables, as `plain` makes them.
        report: takes the mistakes, and knows the lines.
        directory: folder that file names are relative to.
        meshes: files of meshes that were read already; it grows.
        allow_outside: whether files may lie outside that folder.

    Raises:
        SceneError: the report has mistakes.
    """
    top = {key: value for key, value in data.items() if key not in TABLES}
    for key in TABLES:
        if key in data and not isinstance(data[key], dict):
            report.add((key,), f"must be a table, found {found(data[key])}", kind="type")
    tables = {key: data[key] if isinstance(data.get(key), dict) else {} for key in TABLES}
    head, _ = read_table(SceneFile, top | {"camera": _example_camera()}, (), report)
    assert head is not None
    range_nm = head.range_nm
    if not (range_nm[0] < range_nm[1] and all(nm.is_integer() for nm in range_nm)):
        message = f"must be the first and a larger last wavelength in whole nm, found {range_nm}"
        report.add(("range_nm",), message, kind="range")
        range_nm = [380.0, 780.0]
    frame: dict[str, Any] = {
        "length_unit": head.length_unit,
        "up": head.up,
        "range_nm": [float(value) for value in range_nm],
        "spectra": tables["spectra"],
        "camera": tables["camera"],
    }
    render, _ = read_table(Render, tables["render"], ("render",), report)
    resolver = Resolver(report, frame, directory, allow_outside=allow_outside)
    resolver.curves.check_named()
    if "camera" in data:
        camera = resolver.camera(data["camera"])
    else:
        report.add(
            ("camera",), "is missing; expected a table [camera] with eye and target", kind="missing-key"
        )
        camera = None
    materials = {name: resolver.material(name, raw) for name, raw in tables["materials"].items()}
    lights = [resolver.light(name, raw) for name, raw in tables["lights"].items()]
    atmosphere = resolver.atmosphere(tables["atmosphere"]) if "atmosphere" in data else None
    medium = resolver.medium(tables["medium"]) if "medium" in data else None
    placer = ObjectResolver(report, head.length_unit, head.up, directory, meshes, allow_outside=allow_outside)
    placed = {name: placer.placed(name, raw, materials) for name, raw in tables["objects"].items()}
    if not placed and not any(problem.table == "objects" for problem in report.problems):
        report.add(("objects",), "there is no object; expected a table [objects.NAME]", kind="no-objects")
    emitters = [
        name
        for name, raw in tables["materials"].items()
        if isinstance(raw, dict) and raw.get("kind") == "emitter"
    ]
    used = [raw.get("material") for raw in tables["objects"].values() if isinstance(raw, dict)]
    tabled = all(isinstance(data.get(key, {}), dict) for key in ("materials", "objects", "lights"))
    if tabled and not lights and not any(name in used for name in emitters):
        report.add((), NO_LIGHT, kind="no-light")
    for name, one in placed.items():
        material = materials.get(one[1]) if one else None
        if one and material and material.skin and not {"uvs", "sphere"} & set(one[0].arrays):
            message = f'"{one[1]}" has an image, and the mesh of this object no texture coordinates'
            report.add(("objects", name, "material"), message, kind="texture-coordinates")
    report.raise_if_any()

    numbers = {name: i for i, name in enumerate(materials)}
    objects, arrangement = [], []
    for name, one in placed.items():
        assert one is not None
        material = materials[one[1]]
        assert material is not None
        emission = None if material.emission is None else dict(material.emission)
        objects.append({"name": name, "material": numbers[one[1]], "emission": emission})
        arrangement.append(one[0])
    parts = {
        "range": frame["range_nm"],
        "materials": [material.entry for material in materials.values() if material],
        "skins": [material.skin for material in materials.values() if material],
        "objects": objects,
        "lights": lights,
        "camera": camera,
        "atmosphere": atmosphere,
        "medium": medium,
    }
    images = {f"image:{name}": image for name, image in resolver.all_images().items()}
    arrays = _arrays(arrangement) | images
    frame["spectra"] = resolver.curves.without_files()
    return Scene(
        indexed(parts),
        arrays,
        title=head.title,
        render_defaults=render.model_dump(exclude_none=True) if render else {},
        frame=frame,
        path=report.file or None,
        warnings=resolver.warnings(),
    )


def _example_camera() -> dict[str, Any]:
    return Camera(eye=[0.0, 0.0, 1.0], target=[0.0, 0.0, 0.0]).model_dump(exclude_none=True)


def _arrays(placed: list[Placed]) -> dict[str, np.ndarray]:
    """The arrays of shapes and placements; shapes with the same bytes are held once."""
    import hashlib

    import numpy as np

    arrays: dict[str, np.ndarray] = {}
    by_object: dict[int, int] = {}
    by_content: dict[bytes, int] = {}
    shape_of = []
    for i, one in enumerate(placed):
        if id(one.arrays) not in by_object:
            digest = hashlib.sha256()
            for part in sorted(one.arrays):
                digest.update(f"{part} {one.arrays[part].shape};".encode() + one.arrays[part].tobytes())
            content = digest.digest()
            if content not in by_content:
                by_content[content] = len(by_content)
                arrays |= {f"shape:{by_content[content]}:{part}": array for part, array in one.arrays.items()}
            by_object[id(one.arrays)] = by_content[content]
        shape_of.append(by_object[id(one.arrays)])
        arrays[f"placement:{i}"] = np.ascontiguousarray(one.transform)
    arrays["placements"] = np.array(shape_of, np.uint32)
    return arrays
