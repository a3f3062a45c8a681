"""The memory that work may take: estimated before, refused with its largest parts, and counted once."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

import illuminant
from illuminant import job_memory, machine, radiosity
from illuminant.errors import MachineError, UsageError
from illuminant.job import Job
from illuminant.settings import Settings

ROOT = Path(__file__).parents[1]


def test_a_limit_that_is_none():
    for text in ("4XB", "-1", "much", "1e9", "0", ""):
        with pytest.raises(UsageError, match="expected an amount of memory"), machine.limited_to(text):
            pass


def test_work_above_the_limit_is_refused_with_its_parts(command):
    cornell = illuminant.load(ROOT / "scenes/cornell.toml")
    with pytest.raises(
        MachineError, match=r"needs about .* beside the .* in use, and --memory-limit is 1\.0 GB"
    ):
        illuminant.render(cornell, size=(8000, 8000), samples=1, memory_limit="1GB")
    with pytest.raises(MachineError, match=r"\(radiosity [0-9.]+ GB, .*--memory-limit is 1\.0 GB"):
        illuminant.render(cornell, technique="radiosity", elements=200_000, memory_limit="1GB")
    done = command("render", ROOT / "scenes/cornell.toml", "--size", "8000x8000", "--memory-limit", "500MB")
    assert done.returncode == 3
    assert "--memory-limit is 500 MB" in done.stderr


def test_a_limit_is_no_part_of_the_image():
    cornell = illuminant.load(ROOT / "scenes/cornell.toml")
    one = illuminant.render(cornell, size=(8, 8), samples=1)
    other = illuminant.render(cornell, size=(8, 8), samples=1, memory_limit="8TB")
    assert one.settings == other.settings


MEASURED = """
import sys, json
from illuminant import job_memory, machine
from illuminant.checkpoint import Keeper
from illuminant.core import core, embree
from illuminant.job import Job
from illuminant.scene import Scene
embree(), core()
import numpy, OpenImageIO
scene = Scene.load(sys.argv[1])
held, found, check = machine.resident(), [], job_memory.parts
job_memory.parts = lambda *given, **more: found.append(check(*given, **more)) or found[-1]
options = json.loads(sys.argv[2])
keeper = Keeper(sys.argv[3], every=0.0) if options.pop("checkpoints", False) else None
job = Job(scene, keeper=keeper, **options)
for _ in job.passes(None, keeper):
    pass
job.image()
print(held + sum(found[0].values()), machine.peak_memory())
"""


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("cornell", {"samples": 1, "size": [1200, 1200]}),
        ("cornell", {"samples": 1, "size": [1000, 1000], "keep_spectra": True}),
        ("cornell", {"samples": 1, "size": [1000, 1000], "checkpoints": True}),
        ("cornell", {"samples": 1, "size": [16, 16], "technique": "radiosity", "light_samples": 1}),
        (
            "cornell",
            {
                "samples": 1,
                "size": [16, 16],
                "technique": "radiosity",
                "light_samples": 1,
                "solver": "progressive",
            },
        ),
        (
            "cornell",
            {
                "samples": 1,
                "size": [16, 16],
                "technique": "radiosity",
                "light_samples": 1,
                "checkpoints": True,
            },
        ),
        ("bunny", {"samples": 1, "size": [600, 600], "layers": "depth,normal,albedo"}),
        ("tiles", {"samples": 1, "size": [600, 600]}),
        (
            "cornell",
            {
                "samples": 1,
                "size": [600, 600],
                "technique": "gouraud",
                "illumination": "phong",
                "subdivide": 1.0,
            },
        ),
    ],
)
def test_the_estimate_is_not_below_what_is_measured(name, options, tmp_path):
    given = [str(ROOT / f"scenes/{name}.toml"), json.dumps(options), str(tmp_path / "a.ckpt")]
    done = subprocess.run(
        [sys.executable, "-c", MEASURED, *given],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    estimate, measured = map(int, done.stdout.split())
    assert measured <= estimate <= 1.6 * measured


AGAIN = """
import gc, sys, json
from pathlib import Path
import illuminant
from illuminant import job_memory, machine
from illuminant.animation import Animation
from illuminant.core import core, embree
from illuminant.frames import render_frames
from illuminant.scene import Scene
from illuminant.settings import Settings
embree(), core()
import numpy, OpenImageIO
options = {"samples": 1, "size": (900, 900), "depth": 1, "sampling": "uniform:4"}
tables = {
    "camera": {"eye": [0, 0, 3], "target": [0, 0, 0]},
    "materials": {"grey": {"kind": "diffuse", "reflectance": 0.5}},
    "objects": {"ball": {"sphere": {"radius": 1.0}, "material": "grey"}},
    "lights": {"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0}},
}
keys = {"camera.eye": {"times": [0.0, 1.0], "values": [[0, 0, 3], [0, 0, 4]]}}
folder, frames = Path(sys.argv[1]), sys.argv[2] == "frames"
scene = Scene.build(**tables)
illuminant.render(scene, samples=1, size=(8, 8), sampling="uniform:4")
needed = sum(job_memory.parts(Settings(), scene, 900 * 900, 1).values())
limit = machine.resident() + int(1.5 * needed)
if frames:
    animation = Animation.build({**tables, "animation": {"frames": [0, 2], "keys": keys}})
    made = render_frames(animation, "all", folder / "f.####.exr", again=True, memory_limit=limit, **options)
    count = 0
    for frame in made:
        count += frame.image is not None
        del frame
else:
    for count in (1, 2, 3):
        illuminant.render(scene, memory_limit=limit, **options)
print(count)
"""


@pytest.mark.parametrize("what", ["renders", "frames"])
def test_what_fits_once_fits_again(tmp_path, what):
    done = subprocess.run(
        [sys.executable, "-c", AGAIN, str(tmp_path), what], capture_output=True, text=True, timeout=60
    )
    assert (done.stdout, done.returncode) == ("3\n", 0), done.stderr


def test_what_the_process_holds_is_not_counted_again():
    bunny = illuminant.load(ROOT / "scenes/bunny.toml")
    tiles = illuminant.load(ROOT / "scenes/tiles.toml")
    morning = illuminant.load(ROOT / "scenes/morning.toml")
    for one, part in ((bunny, "geometry"), (tiles, "textures and environments"), (morning, "skies")):
        assert part in job_memory.parts(Settings(), one, 64, 1)
        one.core()
        assert part not in job_memory.parts(Settings(), one, 64, 1)
    cornell = illuminant.load(ROOT / "scenes/cornell.toml")
    solved = Settings(technique="radiosity")
    assert job_memory.parts(solved, cornell, 64, 1)["radiosity"] > 10**6
    assert job_memory.parts(solved, cornell, 64, 1, 1000)["radiosity"] == 2000
    assert "radiosity" not in job_memory.parts(solved, cornell, 64, 1, 0)
    many = {"elements": 200_000}
    options = {"elements": 60, "form_factors": "rays:16", "light_samples": 1}
    solution = radiosity.solve(cornell, **options)
    # As many elements could not be solved for; the solution is there.
    job = Job(
        cornell,
        technique="radiosity",
        samples=1,
        size=(4, 4),
        solution=solution._core,
        memory_limit="4GB",
        **many,
    )
    with pytest.raises(MachineError, match="radiosity"):
        Job(cornell, technique="radiosity", samples=1, size=(4, 4), memory_limit="1GB", **many)
    assert list(job.passes()) == [1]


def test_free_memory_of_a_container(tmp_path, monkeypatch):
    monkeypatch.setattr(machine, "_GROUP", tmp_path)
    monkeypatch.setattr(machine, "_meminfo", lambda key: None)
    monkeypatch.setattr(machine, "_address_space", lambda: None)
    (tmp_path / "memory.max").write_text("1000\n")
    (tmp_path / "memory.current").write_text("900\n")
    assert machine.memory_available() == 100
    (tmp_path / "memory.stat").write_text("anon 200\nactive_file 100\ninactive_file 600\n")
    assert machine.memory_available() == 700
    (tmp_path / "memory.max").write_text("max\n")
    assert machine.memory_available() is None


FREED = """
from illuminant import machine
kept = [bytes(100_000) for _ in range(4000)]  # too small to be mapped one by one
held = machine.resident()
last = bytes(1000)
del kept
with machine.limited_to(held + 50_000_000):
    machine.refuse("A thing", 300_000_000)
print("fits")
"""


def test_memory_that_was_freed_is_free():
    done = subprocess.run([sys.executable, "-c", FREED], capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.returncode) == ("fits\n", 0), done.stderr


def test_a_limit_of_gigabytes_takes_no_memory():
    """A scene of small files is read in a process that may have a gigabyte and a half, whatever the limits are."""
    code = (
        "import resource; resource.setrlimit(resource.RLIMIT_AS, (1_500_000_000,) * 2)\n"
        f"from illuminant.scene import Scene; Scene.load({str(ROOT / 'scenes/demo.toml')!r})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
