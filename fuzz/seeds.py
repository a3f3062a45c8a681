"""The valid files from which fuzzing begins: `python -m fuzz.seeds` writes those that `corpus` lacks.

They are small, and between them use most of what each format offers. What the engine finds beyond them is added by
`python fuzz/run.py --keep`.
"""

from __future__ import annotations

import gzip
import io
import json
import re
import struct
import sys
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path

__all__ = ["CORPUS", "all_seeds", "write_assets"]

CORPUS = Path(__file__).with_name("corpus")
ASSETS = Path(__file__).with_name("assets")

SCENE = """title = "seed"
length_unit = "cm"
range_nm = [400, 700]
[camera]
eye = [0, 1, 5]
target = [0, 0, 0]
field_of_view = 40
size = [16, 12]
[render]
samples = 4
depth = 4
[spectra]
mine = { wavelengths_nm = [400, 500, 700], values = [0.1, 0.5, 0.9] }
"from a file" = { file = "a.csv" }
[materials.lamp]
kind = "emitter"
spectrum = "D65"
luminance_cd_m2 = 1000
[materials.grey]
kind = "diffuse"
reflectance = 0.5
[materials.paint]
kind = "diffuse"
reflectance = { rgb = [0.8, 0.2, 0.1], role = "albedo" }
[materials.copper]
kind = "conductor"
metal = "copper"
roughness = 0.2
[materials.glass]
kind = "dielectric"
medium = "BK7"
[objects.light]
material = "lamp"
rectangle = { corner = [-1, 3, -1], edges = [[2, 0, 0], [0, 0, 2]] }
[objects.ball]
material = "copper"
sphere = { radius = 1.0 }
translate = [1, 0, 0]
[objects.lens]
material = "glass"
sphere = { radius = 0.5, center = [-1, 0, 1] }
[objects.mesh]
material = "paint"
mesh = "a.ply"
scale = 2
[objects.floor]
material = "grey"
mesh = { positions = [[-5, -1, -5], [5, -1, -5], [0, -1, 5]], faces = [[0, 2, 1]] }
"""

LIGHTS = """[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
size = [8, 8]
focal_length_mm = 50
f_number = 2.8
focus_distance = 5
blades = 6
shutter = [0.0, 0.5]
moves_to = { eye = [0.1, 0, 5] }
[render]
sampling = "uniform:8"
[materials.worn]
kind = "conductor"
metal = "gold"
roughness = { image = "a.png", black = 0.05, white = 0.4 }
[materials.tiles]
kind = "diffuse"
reflectance = { image = "a.png", repeat = [2, 2] }
bump = { image = "a.png", height = 0.01 }
[materials.plastic]
kind = "coated"
n = 1.5
pigment = 0.8
roughness = 0.1
absorption = 3000.0
thickness = 0.0001
metal = "copper"
metal_roughness = 0.15
coverage = 0.4
coefficients = { phong = { diffuse = 0.35, specular = 0.95, exponent = 330.0 } }
[materials.paper]
kind = "translucent"
reflectance = 0.55
transmittance = 0.35
[materials.shade]
kind = "emitter"
spectrum = "A"
cosine_power = 2.0
sides = "both"
flux_lm = 806
[objects.a]
material = "tiles"
sphere = { radius = 1 }
rotate = { axis = "y", degrees = 30.0 }
motion = [{ translate = [0.2, 0.5, 0.0] }]
[objects.b]
material = "tiles"
mesh = { file = "a.obj", unit = "cm", zero_area = "remove" }
[objects.c]
material = "plastic"
box = { min = [0, 0, 0], max = [1, 2, 1] }
smooth = false
[objects.d]
material = "paper"
disc = { center = [0, 2, 0], normal = [0, -1, 0], radius = 0.3 }
[objects.e]
material = "shade"
sphere = { radius = 0.1, center = [2, 2, 2] }
[objects.f]
material = "worn"
box = { min = [3, 0, 0], max = [4, 2, 1] }
[lights.studio]
kind = "environment"
image = "a.exr"
luminance_cd_m2 = 1000
[lights.point]
kind = "point"
position = [1, 2, 3]
spectrum = "A"
flux_lm = 800
[lights.web]
kind = "point"
photometry = "a.ies"
position = [0, 3, 0]
spectrum = "FL11"
[lights.spot]
kind = "spot"
position = [0, 2, 0]
direction = [0, -1, 0]
half_angle_deg = 25
penumbra_deg = 5
spectrum = { blackbody_k = 2700 }
intensity_cd = 100
[lights.far]
kind = "directional"
direction = [-1, -2, -1]
spectrum = { daylight_k = 6504 }
illuminance_lx = 1000
[atmosphere]
kind = "fog"
start = 2
end = 20
spectrum = "D65"
luminance_cd_m2 = 10
[medium]
absorption = 0.02
scattering = { wavelengths_nm = [380, 780], values = [0.4, 0.03] }
mean_cosine = 0.6
box = { min = [-2, 0, -2], max = [2, 3, 2] }
density = "a.npy"
"""

SKY = """up = "z"
[camera]
eye = [0, -5, 1]
target = [0, 0, 0]
[materials.wood]
kind = "named"
name = "copper, circular mill"
[materials.checks]
kind = "diffuse"
reflectance = { pattern = "checker", colours = [0.1, 0.8], scale = 0.5 }
[materials.gem]
kind = "dielectric"
n = { wavelengths_nm = [380, 780], values = [1.6, 1.5] }
roughness = 0.1
roughness_across = 0.3
grain = [1.0, 0.0, 0.0]
distribution = "ggx"
priority = 1
absorption = 2.0
[materials.gel]
kind = "filter"
transmittance = "mine"
[spectra]
mine = { rgb = [0.6, 0.1, 0.1], role = "albedo", system = "Rec.2020" }
[objects.a]
material = "wood"
rectangle = { corners = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]] }
matrix = [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0]]
[objects.b]
material = "checks"
sphere = { radius = 1 }
scale = 0.5
[objects.c]
material = "gem"
sphere = { radius = 0.4, center = [1, 1, 1] }
[objects.d]
material = "gel"
rectangle = { corner = [0, 0, 2], edges = [[0, 0, 1], [1, 0, 0]] }
[lights.sky]
kind = "sky"
elevation_deg = 35
azimuth_deg = 120
turbidity = 2.5
ground_albedo = 0.3
"""

IES = """IESNA:LM-63-2002
[TEST] 1
[MANUFAC] seed
[MORE] and more
[LUMCAT] a
TILT=NONE
1 1000 1 3 {planes} {kind} 2 0.1 0.2 0
1 1 50
0 45 90
{angles}
{values}
"""


def ies(kind: int, angles: str) -> bytes:
    """A file of LM-63 of a photometric type."""
    planes = len(angles.split())
    values = "\n".join("300 200 0" for _ in range(planes))
    return IES.format(planes=planes, kind=kind, angles=angles, values=values).encode()


def eulumdat(symmetry: int, planes: int) -> bytes:
    """An EULUMDAT file of a symmetry."""
    stored = {0: planes, 1: 1, 2: planes // 2 + 1, 3: planes // 2 + 1, 4: planes // 4 + 1}[symmetry]
    head = [
        "seed",
        "1",
        str(symmetry),
        str(planes),
        "90" if planes > 1 else "0",
        "3",
        "45",
        "report",
        "lamp",
        "1",
        "f.ldt",
        "date",
    ]
    sizes = ["100", "100", "50", "90", "90", "0", "0", "0", "0", "100", "80", "1", "0"]
    lamps = ["1", "1", "LED", "1000", "3000", "80", "12"]
    ratios = ["0.5"] * 10
    angles = [str(360 * i // planes) for i in range(planes)] + ["0", "45", "90"]
    return "\n".join(head + sizes + lamps + ratios + angles + ["300", "200", "10"] * stored).encode()


def ply(form: str) -> bytes:
    """Two triangles with normals and texture coordinates."""
    head = (
        f"ply\nformat {form} 1.0\ncomment seed\nelement vertex 4\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "s", "t"))
        + "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    )
    vertices = [(x, y, 0.0, 0.0, 0.0, 1.0, x, y) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    faces = [(3, 0, 1, 2), (3, 0, 2, 3)]
    if form == "ascii":
        lines = [" ".join(map(str, row)) for row in [*vertices, *faces]]
        return (head + "\n".join(lines) + "\n").encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(f"{order}8f", *row) for row in vertices)
    return head.encode() + body + b"".join(struct.pack(f"{order}B3i", *row) for row in faces)


def png(kind: int, *extra: tuple[bytes, bytes], depth: int = 8, interlace: int = 0) -> bytes:
    """A PNG of 3 × 2 pixels."""
    samples = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind]
    row = b"\0" + bytes(range(17, 17 + (3 * samples * depth + 7) // 8)) if kind != 3 else b"\0\0\1\1"
    rows = row * 2
    if interlace:
        rows = b"".join(b"\0" + bytes((width * samples * depth + 7) // 8) for width in (1, 1, 1, 3))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", 3, 2, depth, kind, 0, 0, interlace)), *extra]
    if kind == 3:
        chunks.append((b"PLTE", bytes((10, 20, 30, 200, 100, 50))))
    chunks += [(b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )


def picture(suffix: str, form: str = "float", channels: int = 3) -> bytes:
    """An image by OpenImageIO."""
    import numpy as np
    import OpenImageIO as oiio

    with tempfile.TemporaryDirectory() as place:
        path = str(Path(place, f"a{suffix}"))
        file = oiio.ImageOutput.create(path)
        assert file is not None
        spec = oiio.ImageSpec(8, 4, channels, form)
        spec.attribute("DateTime", "")
        values = np.linspace(0.1, 0.9, 8 * 4 * channels, dtype=np.float32).reshape(4, 8, channels)
        assert file.open(path, spec) and file.write_image(values), file.geterror()
        file.close()
        return Path(path).read_bytes()


def npy() -> bytes:
    """An array of 2 × 2 × 3 densities."""
    import numpy as np

    stream = io.BytesIO()
    np.save(stream, np.linspace(0, 1, 12, dtype=np.float32).reshape(2, 2, 3), allow_pickle=False)
    return stream.getvalue()


def gltf() -> bytes:
    """A GLB with one triangle under a transform."""
    positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    normals = struct.pack("<9f", 0, 0, 1, 0, 0, 1, 0, 0, 1)
    body = positions + normals + struct.pack("<3H2x", 0, 1, 2)
    view = {"buffer": 0}
    told = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [2, 1, 1], "translation": [1, 0, 0], "children": []}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "mode": 4}]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            },
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {**view, "byteOffset": 0, "byteLength": 36},
            {**view, "byteOffset": 36, "byteLength": 36},
            {**view, "byteOffset": 72, "byteLength": 6},
        ],
        "buffers": [{"byteLength": len(body)}],
    }
    text = json.dumps(told).encode()
    text += b" " * (-len(text) % 4)
    parts = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body
    return b"glTF" + struct.pack("<II", 2, 12 + len(parts)) + parts


def write_assets() -> None:
    """The files to which the scenes of the corpus refer."""
    ASSETS.mkdir(exist_ok=True)
    for name, content in {
        "a.csv": b"wavelength_nm,value\n400,0.1\n500,0.6\n700,0.3\n",
        "a.ply": ply("ascii"),
        "a.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
        "a.png": png(2),
        "a.exr": picture(".exr"),
        "a.ies": ies(1, "0"),
        "a.npy": npy(),
        "asset.toml": SCENE.encode(),
    }.items():
        (ASSETS / name).write_bytes(content)


def all_seeds() -> Iterator[tuple[str, str, bytes]]:
    """Target, name and content of every seed."""
    import numpy as np

    from illuminant import scene_file
    from illuminant.display import displays, profile, run_length
    from illuminant.image import Image
    from illuminant.kept_spectra import KeptSpectra, LampLight
    from illuminant.scene import Scene
    from illuminant.settings import Settings

    for name in ("toml", "scene", "render"):
        yield name, "surfaces", SCENE.encode()
        if name != "render":  # what takes seconds to prepare is left to it by chance
            yield name, "lights", LIGHTS.encode()
            yield name, "sky", SKY.encode()
    # Every key with an example: no scene, but what scenes are made of.
    keys = re.findall(r"```toml\n(.*?)```", scene_file.schema_text(), re.DOTALL)
    yield "scene", "keys", "".join(keys).encode()
    yield (
        "toml",
        "forms",
        b'a = 1\n[b.c]\nd = [1, 2.5, true, "x", {e = 1979-05-27}]\n[[f]]\ng = """\nx"""\nh."i j".k = \'y\'\n',
    )
    starter = Path(scene_file.__file__).with_name("data") / "starter.toml"
    yield "scene", "starter", starter.read_bytes()
    for one in sorted((Path(__file__).parents[1] / "scenes").glob("*.toml")):
        if one.stem in ("two-filters", "morning", "finishes", "prism"):
            yield "scene", one.stem, one.read_bytes()[:6000]
    yield (
        "spectrum",
        "csv",
        b"# name: a\n# quantity: reflectance\nwavelength_nm,value\n400,0.1\n500,0.5\n700,0.9\n",
    )
    yield "spectrum", "spd", b"; lamp\n# outside: zero\n400 0.1\n500.5\t0.5\n700 1e-3\n"
    for name in ("spectrum", "material"):
        yield name, "material", b"# Material: glass\ndielectric\nn 1.51\nk 0\n399 0.04\n656 0.041\n"
        yield name, "metal", b"# Material: copper\nconductor\nn 0.617\nk 2.63\n380 0.07\n700.25 0.755\n"
    yield "ies", "one", ies(1, "0")
    yield "ies", "quadrant", ies(1, "0 45 90")
    yield "ies", "half", ies(1, "0 90 180")
    yield "ies", "b", ies(2, "-90 0 90").replace(b"0 45 90\n", b"-90 0 90\n", 1)
    yield "ies", "a", ies(3, "0 45 90").replace(b"TILT=NONE", b"TILT=INCLUDE\n1\n2\n0 90\n1 0.9", 1)
    for symmetry, planes in ((0, 4), (1, 4), (2, 4), (3, 4), (4, 4)):
        yield "eulumdat", f"symmetry-{symmetry}", eulumdat(symmetry, planes)
    yield "sensors", "measured", b"x,y,z,nx,ny,nz,illuminance_lx\n1,0.8,2,0,1,0,512\n1,2,3,,,,4\n"
    yield "sensors", "places", b"x,y,z\n1,0.8,2\n"
    for display in ("sRGB", "Rec.2020 PQ", "Adobe RGB"):
        found = displays.named(display)
        with tempfile.TemporaryDirectory() as place:
            path = Path(place, "display.toml")
            found.save(path)
            yield "display-file", found.name.replace(" ", "-"), path.read_bytes()
        if found.response != "PQ":
            yield "icc", found.name.replace(" ", "-"), profile.encode(found)
            yield "icc", f"{found.name.replace(' ', '-')}-2", profile.encode(found, version=2)
    table = displays.Display(
        "t", ((0.64, 0.33), (0.3, 0.6), (0.15, 0.06)), (0.3127, 0.329), (0.0, 0.1, 0.4, 1.0), 90.0, 0.5
    )
    yield "icc", "table", profile.encode(table)
    yield (
        "display-file",
        "table",
        (
            b'name = "t"\nprimaries = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]]\nwhite = [0.3127, 0.329]\n'
            b"response = [[0, 0.2, 1], [0, 0.1, 1], [0, 0.3, 1]]\npeak = 90.0\nblack = 0.5\n"
        ),
    )
    yield (
        "gamma-table",
        "csv",
        b"# in_bits: 2\n# out_bits: 8\n# name: a\ncode,entry\n0,0\n1,80\n2,160\n3,255\n",
    )
    yield "gamma-table", "cube", b'TITLE "a"\n# out_bits: 8\nLUT_1D_SIZE 2\nDOMAIN_MIN 0 0 0\n0 0 0\n1 1 1\n'
    yield "gamma-table", "spi1d", b"Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n0.0\n1.0\n}\n"
    yield "gamma-readings", "grey", b"# a monitor\ncode, luminance\n0, 0.06\n128, 20\n255, 90\n"
    yield "gamma-readings", "colours", b"code,red,green,blue\n0,0.1,0.1,0.1\n255,20,60,8\n"
    yield (
        "gamma-readings",
        "phosphors",
        b"colour,x,y,Y\nred,0.64,0.33,21\ngreen,0.3,0.6,71\nblue,0.15,0.06,7\nwhite,0.31,0.33,100\n",
    )
    yield (
        "calibration-readings",
        "xyz",
        b"# bits: 8\nr,g,b,X,Y,Z\n0,0,0,0.1,0.1,0.1\n255,255,255,95,100,108\n",
    )
    yield "calibration-readings", "xyY", b"r,g,b,x,y,Y\n0,0,0,0.3,0.3,0.1\n1,1,1,0.31,0.33,100\n"
    from illuminant.display.calibration.record import COLUMNS

    rows = f"{COLUMNS}\n1988-05-02,full,95,100,108,5,6,7,,note\n1988-05-09,analyzer,95,99,108,5,6,7,1.5,\n"
    yield "calibration-record", "two", rows.encode()
    lanes = KeptSpectra(
        "uniform:4", (400, 410), np.array([401.0, 404.0, 406.0, 409.0]),
        (LampLight("a", np.ones(11), np.ones(4)),), np.full((1, 11), 0.5), ("D65",), False,
    )  # fmt: skip
    yield "kept-spectra", "two", lanes.to_json().encode()
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        yield "ply", form, ply(form)
    yield (
        "ply",
        "quads",
        (
            b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
        ),
    )
    yield (
        "obj",
        "triangle",
        b"# a\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n",
    )
    yield (
        "obj",
        "quads",
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 2\nf -5 -4 -3 -2\nf 1//  2// 5//\ng b\nf 1 2 5\n",
    )
    yield (
        "stl",
        "ascii",
        (
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
            b"vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
        ),
    )
    yield "stl", "binary", bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    yield "glb", "triangle", gltf()
    yield "gzip", "ply", gzip.compress(ply("ascii"), mtime=0)
    xy = struct.pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000)
    text = (
        b"tEXt",
        b"Settings\0"
        + json.dumps(
            {"technique": "path", "samples": 4, "scene": "a.toml", "size": [3, 2], "seed": 0}
        ).encode(),
    )
    icc = (b"iCCP", b"a\0\0" + zlib.compress(profile.encode(table)))
    display = (b"iTXt", b"Display\0\0\0\0\0" + json.dumps(displays.named("Adobe RGB").to_dict()).encode())
    for name in ("png", "image-facts"):
        yield name, "srgb", png(2, (b"sRGB", b"\0"), text)
        yield name, "chrm", png(0, (b"gAMA", struct.pack(">I", 45455)), (b"cHRM", xy), depth=16)
        yield name, "icc", png(6, icc, (b"sBIT", b"\5\6\5\5"))
        yield name, "display", png(3, (b"cICP", b"\x09\x10\0\1"), display, depth=8)
        yield name, "grey", png(4, (b"zTXt", b"Comment\0\0" + zlib.compress(b"x" * 50)))
        yield name, "passes", png(2, interlace=1)
    with tempfile.TemporaryDirectory() as place:
        path = Path(place, "a.exr")
        image = Image(
            np.linspace(0.1, 9, 18).reshape(2, 3, 3), {"depth": np.ones((2, 3, 1)), "spectra": np.ones((2, 3, 4))},
            settings={"samples": 4}, exposure=0.1, wavelengths_nm=lanes.wavelengths_nm, to_xyz=np.ones((3, 4)),
            basis=lanes,
        )  # fmt: skip
        image.save(path)
        yield "exr", "spectra", path.read_bytes()
        image.save(path, half=True, rgb="sRGB")
        yield "exr", "half", path.read_bytes()
    yield "exr", "foreign", picture(".exr", "half", 4)
    yield "texture-exr", "float", picture(".exr")
    yield "texture-exr", "grey", picture(".exr", "half", 1)
    yield "hdr", "float", picture(".hdr")
    yield "tiff", "float", picture(".tif")
    yield "tiff", "bytes", picture(".tif", "uint8")
    yield "jpeg", "bytes", picture(".jpg", "uint8")
    yield "density", "cells", npy()
    pixels = np.linspace(0, 1, 48, dtype=np.float32).tobytes()
    for number, (height, width) in enumerate(((2, 4), (3, 4), (4, 4))):
        yield "panorama", str(number), bytes((height, width, number)) + pixels
    rgb = np.arange(5 * 4 * 3, dtype=np.uint8).reshape(4, 5, 3)
    rgb[1] = 7
    ntsc = ((0.67, 0.33), (0.21, 0.71), (0.14, 0.08))
    yield "run-length", "rgb", run_length.encode(rgb, primaries=ntsc, white=(0.3127, 0.329), gamma=2.2)
    yield (
        "run-length",
        "matte",
        run_length.encode(rgb, primaries=ntsc, white=(0.3127, 0.329), gamma=None, matte=rgb[..., 0]),
    )
    scene = Scene.load(ASSETS / "asset.toml")
    yield "scene-bytes", "surfaces", scene.to_bytes()
    yield "description", "surfaces", json.dumps(scene.description).encode()
    yield "settings", "path", Settings(sampling="uniform:4").to_core().encode()
    yield (
        "settings",
        "raytrace",
        Settings(technique="raytrace", illumination="hall", sampling="rgb", depth=3).to_core().encode(),
    )
    yield (
        "checkpoint",
        "small",
        json.dumps(
            {
                "identity": {"seed": 0},
                "done": 64,
                "end": 128,
                "samples": 4096,
                "seconds": 2.5,
                "blocks": [4, 3, 0],
            }
        ).encode()
        + b"\0sumssol",
    )
    from illuminant.form_factor_rows import Rows

    rows = Rows(
        0, np.array([0, 1], np.uint64), np.array([0], np.uint32), np.array([0.5], np.float32)
    ).to_bytes()
    counts = {"done": 0, "end": 0, "samples": 0, "seconds": 0.0, "blocks": [0, 0, len(rows)]}
    yield "checkpoint", "rows", json.dumps({"identity": {}, **counts}).encode() + b"\0" + rows
    from illuminant.job import Job

    job = Job(scene, size=(8, 8), samples=1, sampling="uniform:4", threads=1)
    if hasattr(job.core_render, "part"):
        job.core_render.run(0, 1)
        yield "part", "one", job.core_render.part()
    box = Path(__file__).with_name("box.toml")
    if box.exists():
        from illuminant import radiosity

        buffer = io.BytesIO()
        found = radiosity.solve(box, elements=4, sampling="uniform:4", form_factors="rays:4", light_samples=1)
        path = Path(tempfile.mkdtemp(), "a.solution")
        found.save(path)
        buffer.write(path.read_bytes())
        yield "solution", "box", buffer.getvalue()


def main() -> None:
    """Write the seeds that are not there yet."""
    write_assets()
    for target, name, content in all_seeds():
        place = CORPUS / target / f"{name}.seed"
        place.parent.mkdir(parents=True, exist_ok=True)
        if not place.exists():
            place.write_bytes(content)
            sys.stdout.write(f"{place.relative_to(CORPUS)}: {len(content)} bytes\n")


if __name__ == "__main__":
    main()
