"""Every reader of outside bytes, as a function of bytes.

Where a reader wants a path, the bytes are written to a file in memory. What a reader returns is looked at: numbers that
reach a scene or an image must be finite where its page says so.

Example:
    >>> from fuzz.targets import TARGETS
    >>> "spectrum" in TARGETS and TARGETS["spectrum"].run(b"400 0.1\\n500 0.2\\n") is None
    True
"""

from __future__ import annotations

import atexit
import functools
import hashlib
import json
import os
import shutil
import struct
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fuzz.containers import with_png_checksums, with_zip_checksums
from fuzz.execution import Target

__all__ = ["TARGETS", "folder"]

TARGETS: dict[str, Target] = {}
"""By name."""

CORE = (ValueError, TypeError, OverflowError, MemoryError)
"""What a function of the core may raise by itself."""


@functools.cache
def folder() -> Path:
    """A folder in memory, with the small files to which scenes refer."""
    place = Path(
        tempfile.mkdtemp(prefix="illuminant-fuzz-", dir="/dev/shm" if os.path.isdir("/dev/shm") else None)
    )
    owner = os.getpid()
    atexit.register(lambda: os.getpid() == owner and shutil.rmtree(place, ignore_errors=True))
    assets = Path(__file__).with_name("assets")
    for asset in sorted(assets.iterdir()) if assets.is_dir() else ():
        shutil.copy(asset, place / asset.name)
    return place


def _small() -> None:
    """Lower the limits of readers that set aside memory for the largest file first, which takes most of their time."""
    from illuminant import scene_file, spectrum_file
    from illuminant.display import table_text

    for module in (scene_file, spectrum_file, table_text):
        vars(module)["MAX_BYTES"] = 1 << 16


def written(data: bytes, name: str, *, beside_assets: bool = False) -> Path:
    """The bytes as a file; beside the assets, if it refers to them or a scene to it."""
    place = folder() if beside_assets else folder() / "tested"
    place.mkdir(exist_ok=True)
    with open(place / name, "wb") as file:
        file.write(data)
    return place / name


def _words(name: str) -> tuple[str, ...]:
    """The words of a format: a line of `words/NAME.txt` each, with the escapes of Python."""
    file = Path(__file__).with_name("words") / f"{'scene' if name in ('toml', 'render') else name}.txt"
    if not file.exists():
        return ()
    lines = file.read_text(encoding="ascii").splitlines()
    return tuple(line.encode("ascii").decode("unicode_escape") for line in lines if line)


def target(
    name: str, *modules: str, text: bool = False, **more: Any
) -> Callable[[Callable[[bytes], object]], Callable[[bytes], object]]:
    """Puts a function into the registry."""

    def take(run: Callable[[bytes], object]) -> Callable[[bytes], object]:
        TARGETS[name] = Target(name, run, modules, text, _words(name), **more)
        return run

    return take


def finite(what: Any) -> None:
    """Fails when a number is none."""
    import numpy as np

    assert np.isfinite(np.asarray(what, float)).all(), "a number of the result is not finite"


# --- texts ----------------------------------------------------------------------------------------------------------


@target("toml", "illuminant.scene_file", text=True, guided=False)
def toml(data: bytes) -> None:
    """The text of a scene file, before anything is looked up."""
    from illuminant import scene_file

    _, report = scene_file.parse(written(data, "parsed.toml"))
    assert all(line > 0 for line in report.lines.values())


@target(
    "scene",
    "illuminant.scene_file",
    "illuminant.resolution",
    "illuminant.objects",
    "illuminant.curves",
    "illuminant.report",
    "illuminant.placement",
    "illuminant.textures",
    "illuminant.shapes",
    text=True,
    longest=6000,
)
def scene(data: bytes) -> None:
    """A scene file with all to which it refers."""
    from illuminant.scene import Scene

    found = Scene.load(written(data, "scene.toml", beside_assets=True))
    for name, array in found.arrays.items():
        if not name.startswith("image:"):
            finite(array)
    json.dumps(found.description, allow_nan=False)


@target("spectrum", "illuminant.spectrum_file", "illuminant.spectrum", text=True)
def spectrum(data: bytes) -> None:
    """A spectrum as text."""
    from illuminant import spectra

    found = spectra.read(written(data, "a.spd"))
    finite(found.values)
    finite(found.wavelengths_nm)


@target("material", "illuminant.material_file", "illuminant.spectrum_file", text=True)
def material(data: bytes) -> None:
    """A material file of the book."""
    from illuminant.material_file import read_material

    found = read_material(written(data, "a.mtl"))
    finite(found.curve.values)
    finite([found.n or 0.0, found.k or 0.0])


@target("ies", "illuminant.photometry_file", text=True)
def ies(data: bytes) -> None:
    """A photometric file of LM-63."""
    _photometry(data, "a.ies")


@target("eulumdat", "illuminant.photometry_file", text=True)
def eulumdat(data: bytes) -> None:
    """A photometric file of EULUMDAT."""
    _photometry(data, "a.ldt")


def _photometry(data: bytes, name: str) -> None:
    from illuminant import photometry_file

    found = photometry_file.parse(data, name)
    for numbers in (
        found.planes_deg,
        found.angles_deg,
        found.candela,
        found.watts,
        found.size_m,
        found.flux_lm(),
    ):
        finite(numbers)
    assert found.candela.shape == (len(found.planes_deg), len(found.angles_deg))


@target("sensors", "illuminant.sensor_file", text=True)
def sensors(data: bytes) -> None:
    """A table of sensors."""
    from illuminant import sensor_file

    found = sensor_file.read(written(data, "sensors.csv"), measured=data[:1] != b"x")
    finite(found.points)
    finite(found.normals)


@target("display-file", "illuminant.display.displays", text=True)
def display_file(data: bytes) -> None:
    """The description of a display."""
    from illuminant.display import displays

    found = displays.named(written(data, "display.toml"))
    finite(found.decode([[0.0, 0.5, 1.0]]))
    finite(found.to_xyz_matrix)


@target("gamma-table", "illuminant.display.gamma.table_file", text=True)
def gamma_table(data: bytes) -> None:
    """A lookup table, in each of its forms."""
    from illuminant.display.gamma.table_file import read_table

    kind = "cube" if b"LUT_1D" in data else "spi1d" if b"Version" in data else "csv"
    finite(read_table(written(data, f"table.{kind}")).entries)


@target(
    "gamma-readings",
    "illuminant.display.gamma.readings",
    "illuminant.display.gamma.phosphors",
    "illuminant.display.table_text",
    text=True,
)
def gamma_readings(data: bytes) -> None:
    """Luminances by code, and the colours of phosphors."""
    from illuminant.display.gamma.phosphors import read_phosphors
    from illuminant.display.gamma.readings import read_readings
    from illuminant.errors import Error

    path = written(data, "readings.csv")
    try:
        read_readings(path)
    except Error:
        found = read_phosphors(path)
        finite([*found.primaries, found.white])


@target("calibration-readings", "illuminant.display.calibration.readings", text=True)
def calibration_readings(data: bytes) -> None:
    """What an instrument read."""
    from illuminant.display.calibration import readings

    found = readings.read(written(data, "read.csv"))
    finite(found.codes)
    finite(found.xyz)


@target("calibration-record", "illuminant.display.calibration.record", text=True)
def calibration_record(data: bytes) -> None:
    """The record of calibrations."""
    from illuminant.display.calibration import record

    entries = record.read(written(data, "record.csv"))
    if entries:
        record.schedule(entries)


@target("kept-spectra", "illuminant.kept_spectra", text=True)
def kept_spectra(data: bytes) -> None:
    """What the lanes of an image mean."""
    from illuminant.kept_spectra import KeptSpectra

    found = KeptSpectra.from_json(data.decode("utf-8", "replace"))
    for lamp in found.lamps:
        finite(lamp.spectrum)
        finite(lamp.lanes)


# --- meshes ---------------------------------------------------------------------------------------------------------


def _mesh(data: bytes, name: str) -> None:
    from illuminant import meshes

    found = meshes.read(written(data, name), "remove" if len(data) % 2 else "error")
    finite(found.positions)
    assert len(found.indices) and int(found.indices.max()) < len(found.positions)
    for part in (found.normals, found.uvs):
        if part is not None:
            finite(part)


@target("ply", "illuminant.ply", "illuminant.meshes", "illuminant.shapes")
def ply(data: bytes) -> None:
    """A mesh as PLY; what is no plain one goes to trimesh."""
    _mesh(data, "a.ply")


@target("obj", "illuminant.meshes", "illuminant.shapes", text=True)
def obj(data: bytes) -> None:
    """A mesh as OBJ."""
    _mesh(data, "a.obj")


@target("stl", "illuminant.meshes", "illuminant.shapes")
def stl(data: bytes) -> None:
    """A mesh as STL."""
    _mesh(data, "a.stl")


@target("glb", "illuminant.meshes", "illuminant.shapes")
def glb(data: bytes) -> None:
    """A mesh as GLB."""
    _mesh(data, "b.glb")


@target("gzip", "illuminant.meshes")
def compressed(data: bytes) -> None:
    """A compressed mesh."""
    _mesh(data, "a.ply.gz")


# --- images ---------------------------------------------------------------------------------------------------------


@target("png", "illuminant.png", "illuminant.display.picture", "illuminant.display.displays")
def png(data: bytes) -> None:
    """A PNG, its checksums made right."""
    from illuminant.image import Image

    found = Image.open(written(with_png_checksums(data), "a.png"), "sRGB")
    finite(found.xyz)


@target("image-facts", "illuminant.info", "illuminant.png")
def image_facts(data: bytes) -> None:
    """What `info` tells of an image, and how to make it again."""
    from illuminant import info

    info.image_facts(written(with_png_checksums(data), "facts.png"))


@target("exr", "illuminant.exr", "illuminant.image")
def exr(data: bytes) -> None:
    """An EXR."""
    from illuminant.image import Image

    Image.open(written(data, "a.exr"), "sRGB")


@target("hdr", "illuminant.environments", "illuminant.pixels")
def hdr(data: bytes) -> None:
    """An environment as Radiance picture."""
    _environment(data, "a.hdr")


@target("tiff", "illuminant.environments", "illuminant.pixels")
def tiff(data: bytes) -> None:
    """An environment as TIFF."""
    _environment(data, "a.tif")


@target("jpeg", "illuminant.environments", "illuminant.pixels")
def jpeg(data: bytes) -> None:
    """An environment as JPEG."""
    _environment(data, "a.jpg")


@target("texture-exr", "illuminant.environments", "illuminant.pixels")
def texture_exr(data: bytes) -> None:
    """An environment as EXR."""
    _environment(data, "t.exr")


@target("density", "illuminant.resolution")
def density(data: bytes) -> None:
    """The density of a medium as a NumPy file."""
    from illuminant.scene_file import resolve

    written(data, "d.npy", beside_assets=True)
    box = {"min": [-2, 0, -2], "max": [2, 3, 2]}
    found = resolve(
        {
            "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]},
            "materials": {"grey": {"kind": "diffuse", "reflectance": 0.5}},
            "objects": {"ball": {"material": "grey", "sphere": {"radius": 1.0}}},
            "lights": {"sky": {"kind": "environment", "spectrum": 1.0, "luminance_cd_m2": 1.0}},
            "medium": {"scattering": 1.0, "box": box, "density": "d.npy"},
        },
        folder(),
    )
    for array in found.arrays.values():
        finite(array)


@target("panorama", "illuminant.panoramas")
def panorama(data: bytes) -> None:
    """Layouts of surroundings: size and layout from the first bytes, pixels from the others."""
    import numpy as np

    from illuminant import environments, panoramas

    if len(data) < 3:
        return
    height, width, kind = data[0] % 26, data[1] % 50, panoramas.LAYOUTS[data[2] % 3]
    pixels = np.resize(
        np.frombuffer(data[3:] + bytes(4), np.float32, (len(data) + 1) // 4), (height, width, 3)
    )
    finite(panoramas.latitude_longitude(environments.checked(pixels), kind))


def _environment(data: bytes, name: str) -> None:
    from illuminant import environments

    finite(environments.read(written(data, name)))


@target("run-length", "illuminant.display.run_length")
def run_length(data: bytes) -> None:
    """Run-length encoded images."""
    from illuminant.display.picture import Picture

    Picture.open(written(data, "a.rle")).xyz()


@target("icc", "illuminant.display.profile", "illuminant.display.displays")
def icc(data: bytes) -> None:
    """ICC profiles, and the display that one describes."""
    from illuminant.display import displays, profile

    found = displays.of_profile(profile.decode(data, "a.icc"), "profile")
    finite(found.to_xyz_matrix)
    finite(found.decode([[0.0, 0.5, 1.0]]))


# --- what illuminant itself has written -----------------------------------------------------------------------------


@target("scene-bytes", "illuminant.scene", longest=40_000)
def scene_bytes(data: bytes) -> None:
    """A scene as written by `save`, its checksums made right; and its core, where it has one."""
    from illuminant.core import embree
    from illuminant.scene import Scene

    embree()
    Scene.from_bytes(with_zip_checksums(data)).core(1)


@target("solution", "illuminant.radiosity", longest=40_000)
def solution(data: bytes) -> None:
    """A solution of the light between surfaces, its checksums made right."""
    from illuminant import radiosity

    if hasattr(radiosity.Solution, "from_bytes"):
        radiosity.Solution.from_bytes(with_zip_checksums(data))
    else:
        radiosity.Solution.load(written(with_zip_checksums(data), "a.solution"))


@target("checkpoint", "illuminant.checkpoint", "illuminant.form_factor_rows", text=True)
def checkpoint(data: bytes) -> None:
    """A checkpoint: the input is its header and blocks; form, length and digest are made right."""
    from illuminant.checkpoint import FIRST_LINE, Checkpoint
    from illuminant.form_factor_rows import Rows

    head, _, blocks = data.partition(b"\0")
    content = FIRST_LINE + struct.pack("<Q", len(head)) + head + blocks
    kept = Checkpoint.from_bytes(content + hashlib.sha256(content).digest())
    if kept.rows:
        Rows.from_bytes(kept.rows)


# --- what crosses into the core as JSON -----------------------------------------------------------------------------


@functools.cache
def _core_scene(file: Path) -> tuple[Any, Any, dict[str, Any]]:
    from illuminant.core import core, embree
    from illuminant.scene import Scene

    embree()
    found = Scene.load(file)
    geometry = core().Geometry(found.shapes(), found.placements(), 1)
    images = {
        name.removeprefix("image:"): array
        for name, array in found.arrays.items()
        if name.startswith("image:")
    }
    return core().Scene(geometry, json.dumps(found.description), images), geometry, images


@target("description", "illuminant.scene", text=True, allowed=CORE, longest=40_000, guided=False)
def description(data: bytes) -> None:
    """The description of a scene, as the core reads it."""
    from illuminant.core import core

    _, geometry, images = _core_scene(folder() / "asset.toml")
    core().Scene(geometry, data.decode("utf-8", "replace"), images)


@target("settings", "illuminant.settings", text=True, allowed=CORE, guided=False)
def settings(data: bytes) -> None:
    """Settings of a render, as the core reads them; of a small scene, since tables of rough surfaces take time."""
    from illuminant.core import core

    core().Render(_core_scene(Path(__file__).with_name("box.toml"))[0], data.decode("utf-8", "replace"))


@functools.cache
def _render() -> Any:
    from illuminant.job import Job

    return Job(folder() / "asset.toml", size=(8, 8), samples=1, sampling="uniform:4", threads=1).core_render


@target("part", "illuminant.checkpoint", allowed=CORE, longest=20_000, guided=False)
def part(data: bytes) -> None:
    """What a film held, as another process or a checkpoint brings it."""
    render = _render()
    if hasattr(render, "join"):
        import numpy as np

        render.clear()
        render.join(data)
        finite(np.asarray(render.layer("xyz")))


@target("render", "illuminant.job", text=True, longest=6000, most_seconds=60.0)
def render(data: bytes) -> None:
    """A scene file, and an image of a few pixels of it: no number of the image may be none unless it is counted."""
    import numpy as np

    from illuminant.job import Job
    from illuminant.scene import Scene

    found = Scene.load(written(data, "rendered.toml", beside_assets=True))
    if found.triangles > 20_000 or len(found.description["lights"]) > 50:
        return
    job = Job(
        found,
        size=(4, 4),
        samples=1,
        depth=3,
        threads=1,
        technique="path",
        sampling="uniform:4",
        caustics=False,
    )
    for _ in job.passes():
        pass
    image = job.image()
    for name, layer in {"xyz": image.xyz, **image.layers}.items():
        assert np.isfinite(layer).all(), f"the layer {name} has numbers that are none"
