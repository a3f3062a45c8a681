"""What a hostile scene, table or image may not do: each is refused in a sentence, soon, and without much memory."""

from __future__ import annotations

import gzip
import importlib
import io
import json
import os
import re
import resource
import socket
import struct
import subprocess
import sys
import time
import warnings
import zipfile
from contextlib import AbstractContextManager
from pathlib import Path

import numpy as np
import pytest

import illuminant
from illuminant import archives, environments, machine, meshes, scene_file, sources
from illuminant.errors import DataError, ImageError, MachineError, SceneError

ROOT = Path(__file__).parents[1]
SCENE = """
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
size = [8, 8]
[materials.grey]
kind = "diffuse"
reflectance = {reflectance}
[objects.ball]
{shape}
material = "grey"
[lights.sky]
kind = "environment"
{light}
"""


def beside(amount: int) -> AbstractContextManager[None]:
    """So much memory beside what this process holds, once what earlier tests have freed is given back."""
    machine.give_back()
    return machine.limited_to(machine.resident() + amount)


def scene(path: Path, reflectance="0.5", shape="sphere = { radius = 1.0 }", light='spectrum = "D65"') -> Path:
    path.write_text(
        SCENE.format(reflectance=reflectance, shape=shape, light=light + "\nluminance_cd_m2 = 100.0")
    )
    return path


def run(*words: object, memory: int | None = None) -> subprocess.CompletedProcess[str]:
    """The command, which must end within a minute, with so much address space."""

    def limit() -> None:
        if memory is not None:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    command = [sys.executable, "-m", "illuminant", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, preexec_fn=limit, check=False)


# --- files that are none ------------------------------------------------------------------------------------------


def test_only_regular_files_are_opened(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with socket.socket(socket.AF_UNIX) as one:
        one.bind(str(tmp_path / "socket"))
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    (tmp_path / "large").write_bytes(bytes(11))
    for name, kind, sentence in (
        ("pipe", "special", "is a pipe"),
        ("socket", "special", "is a socket"),
        ("loop", "loop", "is a loop of symbolic links"),
        (".", "folder", "is a folder"),
        ("none", "missing", "there is no such file"),
        ("large", "large", "is larger than 10 bytes"),
        ("/dev/zero", "special", "is a device"),
    ):
        for ask in (sources.read, sources.check, sources.opened):
            with pytest.raises(sources.SourceError, match=sentence) as caught:
                ask(tmp_path / name, 10)
            assert caught.value.kind == kind
    (tmp_path / "large").write_bytes(bytes(10))
    assert sources.read(tmp_path / "large", 10) == bytes(10)


def test_no_command_waits_for_a_pipe(tmp_path):
    for name in ("a.toml", "a.csv", "a.exr", "a.png"):
        os.mkfifo(tmp_path / name)
    here = scene(tmp_path / "scene.toml", reflectance='{ file = "a.csv" }')
    for words in (("check", tmp_path / "a.toml"), ("check", here), ("info", tmp_path / "a.exr")):
        done = run(*words)
        assert done.returncode in (1, 2)
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "parts",
    [
        {"reflectance": '{ file = "NAME" }'},
        {"reflectance": '{ image = "NAME" }'},
        {"shape": 'mesh = "NAME.ply"'},
        {"light": 'image = "NAME"'},
    ],
)
def test_a_pipe_in_a_scene_is_a_mistake_with_its_line(tmp_path, parts):
    for name in ("pipe", "pipe.ply"):
        os.mkfifo(tmp_path / name)
    path = scene(tmp_path / "a.toml", **{key: text.replace("NAME", "pipe") for key, text in parts.items()})
    (problem,) = scene_file.check(path)
    assert problem.line > 0
    assert "is a pipe" in problem.message


# --- what a scene may name ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("way", ["dots", "absolute", "link"])
@pytest.mark.parametrize(
    ("parts", "ending"),
    [
        ({"reflectance": '{ file = "NAME" }'}, ".csv"),
        ({"reflectance": '{ image = "NAME" }'}, ".exr"),
        ({"shape": 'mesh = "NAME"'}, ".ply"),
        ({"light": 'image = "NAME"'}, ".exr"),
    ],
)
def test_a_scene_names_files_of_its_own_folder_alone(tmp_path, way, parts, ending):
    inner = tmp_path / "inner"
    inner.mkdir()
    secret = tmp_path / f"secret{ending}"
    secret.write_bytes(b"400 0.5\n700 0.5\n")
    (inner / f"link{ending}").symlink_to(secret)
    name = {"dots": f"../{secret.name}", "absolute": str(secret), "link": f"link{ending}"}[way]
    path = scene(inner / "a.toml", **{key: text.replace("NAME", name) for key, text in parts.items()})
    (problem,) = scene_file.check(path)
    assert (problem.kind, problem.line > 0) == ("outside", True)
    assert name in problem.message
    assert "--allow-outside" in problem.message
    assert not any(one.kind == "outside" for one in scene_file.check(path, allow_outside=True))


def test_allow_outside_reaches_every_command(tmp_path):
    (tmp_path / "paint.csv").write_text("400 0.5\n700 0.5\n")
    (tmp_path / "in").mkdir()
    path = scene(tmp_path / "in" / "a.toml", reflectance='{ file = "../paint.csv" }')
    with pytest.raises(SceneError, match="lies outside the folder"):
        illuminant.load(path)
    assert illuminant.load(path, allow_outside=True).description["materials"]
    with pytest.raises(SceneError, match="lies outside"):
        illuminant.render(path, samples=1)
    assert illuminant.render(path, samples=1, allow_outside=True).xyz.shape == (8, 8, 3)
    assert run("check", path, "--allow-outside").returncode == 0


@pytest.mark.parametrize(
    "words",
    [
        ["check", "SCENE"],
        ["render", "SCENE", "-o", "OUT.exr"],
        ["render", "SCENE", "-o", "OUT.exr", "--frames", "1"],
        ["farm", "render", "SCENE", "-o", "OUT.exr"],
        ["radiosity", "solve", "SCENE", "-o", "OUT.solution"],
        ["compare", "SCENE", "-o", "OUT.png", "--techniques", "path,raytrace"],
        ["audit", "SCENE"],
        ["spectra", "error", "SCENE"],
    ],
    ids=lambda words: " ".join(word for word in words if word.islower() and "." not in word),
)
def test_no_command_reads_outside_a_scene_unless_told(tmp_path, words):
    (tmp_path / "paint.csv").write_text("400 0.5\n700 0.5\n")
    (tmp_path / "in").mkdir()
    path = scene(tmp_path / "in" / "a.toml", reflectance='{ file = "../paint.csv" }')
    if "--frames" in words:
        path.write_text(path.read_text() + "\n[animation]\nframes = 2\nrate = 24\n")
    found = run(*(word.replace("SCENE", str(path)).replace("OUT", str(tmp_path / "out")) for word in words))
    assert found.returncode == (1 if words[0] == "check" else 2)
    assert re.search(r"lies\s+outside\s+the\s+folder", found.stdout + found.stderr)
    assert "--allow-outside" in found.stdout + found.stderr
    assert sorted(item.name for item in tmp_path.iterdir()) == ["in", "paint.csv"]


def test_a_program_may_name_any_file_and_need_not(tmp_path):
    (tmp_path / "paint.csv").write_text("400 0.5\n700 0.5\n")
    (tmp_path / "in").mkdir()
    data, _ = scene_file.parse(scene(tmp_path / "a.toml", reflectance='{ file = "../paint.csv" }'))
    assert scene_file.resolve(data, tmp_path / "in")
    with pytest.raises(SceneError, match="lies outside"):
        scene_file.resolve(data, tmp_path / "in", allow_outside=False)


# --- odd numbers and names ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ({"reflectance": '"s0"\n[spectra]\n' + "".join(f's{i} = "s{i + 1}"\n' for i in range(900)) + "s900 = 0.5"},
         "is the end of 100 names for one spectrum"),
        ({"shape": "sphere = {}\nmotion = [" + "{ translate = [0, 0, 0] }," * 129 + "]"}, "128"),
        ({"reflectance": '0.5\n[animation]\nframes = [0, 1]\nframes_per_second = 5e-324'}, "at least 0.001"),
        ({"reflectance": '0.5\n[camera.x]\n' + "".join(f"key{i} = 1\n" for i in range(1000))}, "is not a key"),
        ({"reflectance": '0.5\n[materials."\\u001b]0;PWNED\\u0007"]'}, r"\\x1b\]0;PWNED\\x07"),
        ({"shape": "sphere = {}\nscale = [1e-162, 1e-162, 1e-162]"}, "flattens the object"),
        ({"reflectance": '0.5\n[medium]\nscattering = 1.0\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n'
                         "density = [[[1e300, 1.0], [1.0, 1.0]]]"}, "must be"),
    ],
    ids=["chain", "motion", "rate", "many", "escape", "scale", "density"],
)  # fmt: skip
def test_what_ended_in_no_sentence_once(tmp_path, parts, sentence):
    path = scene(tmp_path / "a.toml", **parts)
    begin = time.process_time()
    with warnings.catch_warnings(), pytest.raises(SceneError, match=sentence) as caught:
        warnings.simplefilter("error", RuntimeWarning)
        illuminant.load(path)
    assert time.process_time() - begin < 5.0
    assert len(caught.value.problems) <= 200
    assert "\x1b" not in str(caught.value)


def test_memory_that_parsing_takes_is_counted(tmp_path):
    path = scene(tmp_path / "a.toml")
    path.write_text("k = [" + "{a=1}," * 500_000 + "]\n" + path.read_text())
    with (
        beside(200_000_000),
        pytest.raises(MachineError, match=r"a\.toml needs about"),
    ):
        illuminant.load(path)


# --- bombs --------------------------------------------------------------------------------------------------------


def test_toml_that_is_nested_too_deeply(tmp_path):
    path = tmp_path / "a.toml"
    for text in ("a = " + "[" * 100_000, "a" + ".a" * 100_000 + " = 1", "a = " + "{a=" * 100_000):
        path.write_text(text)
        (problem,) = scene_file.check(path)
        assert problem.kind == "toml"


def test_a_mesh_that_states_more_than_it_has(tmp_path):
    path = tmp_path / "a.ply"
    head = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
    for more in ("property float z\n", "property list uchar int z\n"):
        path.write_bytes((head + more + "element face 1\nend_header\n").encode() + bytes(24))
        with pytest.raises(DataError, match="states 4,000,000,000 elements"):
            meshes.read(path)
    accessor = {"count": 4_000_000_000, "componentType": 5126, "type": "VEC3"}
    document = {"asset": {"version": "2.0"}, "accessors": [accessor], "bufferViews": [], "buffers": []}
    gltf = tmp_path / "a.gltf"
    gltf.write_text(json.dumps(document))
    with pytest.raises(DataError, match="at most"):
        meshes.read(gltf)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    (tmp_path / "a.glb").write_bytes(
        b"glTF" + struct.pack("<IIII", 2, 20 + len(text), len(text), 0x4E4F534A) + text
    )
    with pytest.raises(DataError, match="at most"):
        meshes.read(tmp_path / "a.glb")
    document["accessors"][0]["count"] = 3
    gltf.write_text(json.dumps(document))
    with pytest.raises(DataError, match="without a buffer"):
        meshes.read(gltf)


def test_a_gltf_reads_buffers_of_the_scene_alone(tmp_path):
    (tmp_path / "secret.bin").write_bytes(bytes(100))
    (tmp_path / "in").mkdir()
    document = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 100, "uri": "../secret.bin"}]}
    (tmp_path / "in" / "a.gltf").write_text(json.dumps(document))
    with pytest.raises(DataError, match="lies outside"):
        meshes.read(tmp_path / "in" / "a.gltf", within=tmp_path / "in")


def test_an_image_that_states_more_pixels_than_its_bytes_can_hold(tmp_path):
    import PIL.Image

    path = tmp_path / "a.jpg"
    PIL.Image.new("L", (16, 16), 9).save(path)
    environments.read(path)
    content = path.read_bytes()
    at = content.index(b"\xff\xc0") + 5
    path.write_bytes(content[:at] + struct.pack(">HH", 8000, 8000) + content[at + 4 :])
    before = machine.peak_memory()
    with pytest.raises(ImageError, match=r"a\.jpg: states 8000 × 8000 pixels, for which it is too short"):
        environments.read(path)
    assert machine.peak_memory() < before + 20_000_000
    # As many as there can be: black, one bit a pixel.
    PIL.Image.new("1", (4000, 4000), 1).save(tmp_path / "a.png", optimize=True)
    assert (tmp_path / "a.png").stat().st_size < 8000
    assert environments.read(tmp_path / "a.png").shape == (4000, 4000, 3)


def test_memory_is_looked_at_while_a_stream_goes_on():
    asked: list[int] = []

    class Endless(io.RawIOBase):
        def read(self, size=-1):
            asked.append(size)
            return bytes(size)

    stream = Endless()
    with (
        beside(100_000_000),
        pytest.raises(MachineError, match=r"a\.gz needs about"),
    ):
        sources.drained(stream, 4_000_000_000, name="a.gz")
    assert sum(asked) <= 200_000_000
    assert max(asked) <= 1_000_000


def test_the_end_of_a_file_is_asked_for_with_little_room():
    asked: list[int] = []

    class Told(io.BytesIO):
        def read(self, size=-1):
            asked.append(size)
            return super().read(size)

    stream = Told(bytes(5_000_000))
    assert len(sources.drained(stream, 2**40, 5_000_001)) == 5_000_000
    assert asked == [5_000_001, 1_000_000]
    stream.seek(0)
    assert sources.drained(stream, 2_500_000) == bytes(2_500_000)


def test_a_compressed_mesh_that_swells(tmp_path):
    path = tmp_path / "a.ply.gz"
    path.write_bytes(gzip.compress(bytes(64_000_000), 1))
    with (
        beside(40_000_000),
        pytest.raises(MachineError, match=r"a\.ply\.gz needs about [1-3]\d MB"),
    ):
        meshes.read(path)


TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32).tobytes()


def gltf(path: Path, **changed: object) -> Path:
    """One triangle, whose bytes are in a file beside it."""
    (path.parent / "a.bin").write_bytes(TRIANGLE)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "a.bin", "byteLength": 36}],
    }
    path.write_text(json.dumps(document | changed))
    return path


def test_a_gltf_reads_each_buffer_once(tmp_path, monkeypatch):
    read, asked = sources.read, []
    monkeypatch.setattr(sources, "read", lambda path, most: asked.append(Path(path).name) or read(path, most))
    uris = ["a.bin", "./a.bin"] * 20
    path = gltf(tmp_path / "a.gltf", buffers=[{"uri": uri, "byteLength": 36} for uri in uris])
    assert len(meshes.read(path).indices) == 1
    assert asked == ["a.gltf", "a.bin"]


@pytest.mark.parametrize("part", ["buffers", "bufferViews", "accessors"])
def test_a_gltf_whose_parts_are_many_copies(tmp_path, part):
    one = {
        "buffers": {"uri": "a.bin", "byteLength": 16_000_000},
        "bufferViews": {"buffer": 0, "byteOffset": 1, "byteLength": 16_000_000},
        "accessors": {"sparse": {"count": 1}, "componentType": 5126, "count": 1_400_000, "type": "VEC3"},
    }[part]
    path = gltf(tmp_path / "a.gltf", **{part: [one] * 1000})
    with machine.limited_to("4GB"), pytest.raises(MachineError, match=r"a\.gltf needs about 1\d GB"):
        meshes.read(path)
    for length in ({}, {"byteLength": -1}, {"byteLength": "36"}):
        if part != "accessors":
            with pytest.raises(DataError, match=f"has {part} without a length"):
                meshes.read(gltf(tmp_path / "a.gltf", **{part: [length]}))


def npy(header: bytes) -> bytes:
    """A file of NumPy with this header and eight numbers."""
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header + bytes(8)


def test_a_header_that_is_no_array():
    for header in (b"-" * 9000 + b"1", b"{[]: 1}", b"(" * 5000, b"{'descr': 1}"):
        with pytest.raises(ValueError, match=r"."):
            archives.array(io.BytesIO(npy(header)), 9000)


def test_a_density_takes_memory_for_its_cells(tmp_path):
    medium = (
        '[medium]\nscattering_per_m = 1.0\nbox = {{ min = [-1, -1, -1], max = [1, 1, 1] }}\ndensity = "{}"\n'
    )
    path = scene(tmp_path / "a.toml")
    text = path.read_text()
    path.write_text(text + medium.format("a.npy"))
    head = b"{'descr': '|u1', 'fortran_order': False, 'shape': (400, 500, 500), }\n"
    with (tmp_path / "a.npy").open("wb") as stream:
        stream.write(npy(head)[:-8])
        stream.truncate(stream.tell() + 100_000_000)
    # A cell is a byte in the file, and 32 in memory: three gigabytes, not one.
    with (
        beside(2_000_000_000),
        pytest.raises(MachineError, match=r"needs about 3\.2 GB"),
    ):
        illuminant.load(path)
    (tmp_path / "a.npy").write_bytes(npy(b"{[]: 1}"))
    with pytest.raises(SceneError, match="is no NumPy file of numbers"):
        illuminant.load(path)


def exr(path: Path, width: int, height: int, channels: int = 3) -> Path:
    """A header of an EXR without pixels."""

    def attribute(name: bytes, kind: bytes, data: bytes) -> bytes:
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data

    names = [b"B", b"G", b"R", *(b"c%05d" % i for i in range(channels - 3))]
    listed = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    head += attribute(b"channels", b"chlist", listed) + attribute(b"compression", b"compression", b"\3")
    head += attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window)
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", bytes(8))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    path.write_bytes(head + b"\0" + bytes(64))
    return path


LARGE_IMAGES = """
import sys
import illuminant
from illuminant import machine, pixels
from illuminant.errors import ImageError, MachineError
import numpy, OpenImageIO
illuminant.Image
held = machine.resident()
for path in sys.argv[1:]:
    for read in (pixels.read, illuminant.Image.open):
        try:
            read(path)
        except (ImageError, MachineError) as error:
            print(type(error).__name__)
print((machine.peak_memory() - held) // 10**6)
"""


def test_an_image_that_states_more_than_it_has(tmp_path):
    images = (exr(tmp_path / "a.exr", 100_000, 100_000), exr(tmp_path / "b.exr", 100, 100, 5000))
    # In a process of its own: the most that a process has held never falls.
    done = subprocess.run(
        [sys.executable, "-c", LARGE_IMAGES, *map(str, images)], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    *refused, megabytes = done.stdout.split()
    assert len(refused) == 4
    assert refused[0] == refused[2] == "ImageError"
    assert int(megabytes) < 300


def test_archives_that_swell(tmp_path):
    stream = io.BytesIO()
    np.savez_compressed(stream, scene=np.zeros(10_000_000))
    with pytest.raises(ValueError, match="compressed"):
        archives.read(stream)
    member = io.BytesIO()
    np.lib.format.write_array_header_1_0(member, {"descr": "<f8", "fortran_order": False, "shape": (10**12,)})
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("scene.npy", member.getvalue())
    with pytest.raises(ValueError, match="too short"):
        archives.read(stream)
    path = tmp_path / "a.scene"
    path.write_bytes(stream.getvalue())
    with pytest.raises(SceneError, match="is not a scene"):
        illuminant.load(path)


# --- headers and tables ------------------------------------------------------------------------------------------


def test_a_header_cannot_smuggle_a_command():
    from illuminant.info import remake

    for text in ("rm -rf ~", "illuminant compare a.toml; rm -rf ~", "illuminant compare 'a"):
        said = remake({"scene": "a.toml", "command": text}, Path("a b.png"), None)
        assert said is None or ";" not in said.replace("'a.toml;'", "")
    told = {"scene": "a.toml", "command": "illuminant compare a.toml --samples 4"}
    assert remake(told, Path("a b.png"), None) == "illuminant compare a.toml --samples 4 -o 'a b.png'"


def test_a_large_table_is_read_in_the_time_that_its_size_takes():
    from illuminant.core import core

    def seconds(count: int) -> float:
        text = "a = [\n" + "1,\n" * count + "]\n"
        start = time.process_time()
        data, lines = core().parse_toml(text)
        assert lines[("a", count - 1)] == count + 1
        assert len(data["a"]) == count
        return time.process_time() - start

    # The best of some: others use the machine too.
    small, large = (min(seconds(count) for _ in range(5)) for count in (40_000, 320_000))
    assert large < 24.0 * small, "eight times as much; it was sixty-four times as long"


# --- the page -----------------------------------------------------------------------------------------------------


def test_the_table_of_limits_is_that_of_the_code():
    page = (ROOT / "docs/security.md").read_text(encoding="utf-8")
    rows = re.findall(
        r"^\| .+? \| ([\d,e]+)(?: bytes)? \| `illuminant\.([\w.]+)\.(\w+)` \|$",
        page,
        re.MULTILINE,
    )
    table = page.partition("## Limits")[2].partition("\n## ")[0]
    # Beside the rows there are the head of the table and the line below it.
    assert len(rows) == len(re.findall(r"^\| ", table, re.MULTILINE)) - 2 > 15
    for number, module, constant in rows:
        value = getattr(importlib.import_module(f"illuminant.{module}"), constant)
        assert float(number.replace(",", "")) == value, f"{module}.{constant}"
