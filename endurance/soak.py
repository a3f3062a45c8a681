"""Mixed work for a long time in one process under a memory limit: memory stays flat, and nothing is left behind.

Round after round, in an order that chance decides: renders by several techniques, with layers and spectra, cut off and
resumed from checkpoints; solutions of the light between surfaces, saved, loaded and relit; images saved, opened,
developed under another lamp, compared; scenes with mistakes; damaged files. After each round the process's resident
memory, threads, open files and temporary files are counted.

Memory is flat when the median of the last third lies within 5 % of that of the middle third. The address space is
limited, so that a leak ends the run.

    python endurance/soak.py [--minutes 30] [--limit-gb 4] [--record endurance/soak.txt]
"""

from __future__ import annotations

import argparse
import gc
import os
import random
import resource
import statistics
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import numpy as np

import illuminant
from illuminant import radiosity
from illuminant.checkpoint import Checkpoint, Keeper
from illuminant.difference import diff
from illuminant.display import develop
from illuminant.errors import Error
from illuminant.image import Image
from illuminant.job import Job
from illuminant.scene import Scene

SCENES = Path(__file__).resolve().parent.parent / "scenes"
SMALL = {"size": (96, 72), "samples": 16}
FLAT = 0.05


@dataclass(frozen=True)
class Held:
    """What the process holds after a round: bytes of resident memory, and numbers."""

    memory: int
    threads: int
    files: int
    temporary: int


def held(folder: Path) -> Held:
    """Count now."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    temporary = len(list(folder.rglob("*")))
    return Held(
        pages * resource.getpagesize(),
        threading.active_count() + native(),
        len(os.listdir("/proc/self/fd")),
        temporary,
    )


def native() -> int:
    """Threads that are not Python's."""
    return len(os.listdir("/proc/self/task")) - threading.active_count()


def paths(folder: Path, chance: random.Random) -> None:
    """A path-traced image with all layers, written and read back."""
    scene = SCENES / chance.choice(["cornell.toml", "demo.toml"])
    image = illuminant.render(scene, **SMALL, layers="depth,normal,albedo", keep_spectra=True, lamps=True)
    image.save(folder / "a.exr")
    image.save(folder / "a.png")
    Image.open(folder / "a.exr")
    Image.open(folder / "a.png", assume="sRGB")


def old_techniques(folder: Path, chance: random.Random) -> None:
    """An image by one of the older techniques."""
    kinds = [("phong", "blinn"), ("gouraud", "bouknight"), ("raytrace", "whitted"), ("distributed", "hall")]
    technique, model = chance.choice(kinds)
    illuminant.render(SCENES / "cornell.toml", **SMALL, technique=technique, illumination=model).save(
        folder / "b.png"
    )


def solutions(folder: Path, chance: random.Random) -> None:
    """A solution of the light between surfaces, kept, read and relit."""
    found = radiosity.solve(SCENES / "cornell.toml", elements=400, form_factors="rays:64")
    found.save(folder / "c.solution")
    again = radiosity.Solution.load(folder / "c.solution")
    again.relight(lamps={"lamp": chance.uniform(0.2, 2.0)}).render(size=(64, 48), samples=2)


def checkpoints(folder: Path, chance: random.Random) -> None:
    """A render that is cut off, and goes on from its checkpoint."""
    file, reports = folder / "d.ckpt", chance.randint(1, 4)

    def few(progress: object) -> bool:
        nonlocal reports
        reports -= 1
        return reports > 0

    list(Job(SCENES / "cornell.toml", **SMALL).passes(few, Keeper(file)))
    list(Job(SCENES / "cornell.toml", checkpoint=Checkpoint.read(file), **SMALL).passes())


def differences(folder: Path, chance: random.Random) -> None:
    """Two images compared, and one developed for another lamp."""
    image = illuminant.render(
        SCENES / "cornell.toml", **SMALL, keep_spectra=True, lamps=True, develop_for="FL11"
    )
    other = illuminant.render(SCENES / "cornell.toml", size=(96, 72), samples=4, seed=chance.randint(1, 99))
    diff(image, other)
    develop(image, observer="10", lamps={"lamp": "FL11"})


def mistakes(folder: Path, chance: random.Random) -> None:
    """Files that are damaged, each refused."""
    text = (SCENES / "cornell.toml").read_bytes()
    at = chance.randrange(len(text))
    broken = folder / "e.toml"
    broken.write_bytes(text[:at] + bytes([chance.randrange(256)]) + text[at + 1 :])
    for read in (Scene.load, Image.open, Checkpoint.read, radiosity.Solution.load):
        with suppress(Error):
            read(broken)


WORK: tuple[Callable[[Path, random.Random], None], ...] = (
    paths,
    old_techniques,
    solutions,
    checkpoints,
    differences,
    mistakes,
)


def soak(seconds: float, seed: int, folder: Path) -> list[Held]:
    """Work until the time is up; what was held after each round."""
    chance, found = random.Random(seed), []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for work in chance.sample(WORK, len(WORK)):
            work(folder, chance)
        for file in folder.iterdir():
            file.unlink()
        found.append(held(folder))
    return found


def judged(found: list[Held]) -> tuple[list[str], bool]:
    """What there is to say, and whether nothing grew."""
    third = len(found) // 3
    parts = (found[:third], found[third : 2 * third], found[2 * third :])
    medians = [statistics.median(one.memory for one in part) / 1e6 for part in parts]
    growth = medians[2] / medians[1] - 1.0
    first, last = found[third], found[-1]
    lines = [
        f"{len(found)} rounds of {len(WORK)} kinds of work",
        f"memory, medians of the thirds: {', '.join(f'{one:.0f}' for one in medians)} MB ({growth:+.1%}); "
        f"most {max(one.memory for one in found) / 1e6:.0f} MB",
        *(
            f"{name}: {getattr(first, name)}, at the end {getattr(last, name)}"
            for name in ("threads", "files")
        ),
        f"files left in the working folder: {max(one.temporary for one in found)}",
    ]
    sound = growth < FLAT and last.threads <= first.threads and last.files <= first.files
    return lines, sound and not any(one.temporary for one in found)


def main() -> None:
    """Run, and say what happened."""
    told = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    told.add_argument("--minutes", type=float, default=30.0)
    told.add_argument("--limit-gb", type=float, default=4.0)
    told.add_argument("--seed", type=int, default=1)
    told.add_argument("--record", type=Path, help="file that takes the result")
    given = told.parse_args()
    bound = int(given.limit_gb * 1e9)
    resource.setrlimit(resource.RLIMIT_AS, (bound, bound))
    np.seterr(all="raise", under="ignore")
    with tempfile.TemporaryDirectory() as folder:
        tempfile.tempdir = folder  # so that temporary files of libraries are seen too
        found = soak(60 * given.minutes, given.seed, Path(folder))
        tempfile.tempdir = None
    lines, sound = judged(found)
    head = f"illuminant {illuminant.__version__}, {date.today()}: mixed work for {given.minutes:g} minutes"
    text = "\n".join(
        [f"{head}, address space of {given.limit_gb:g} GB", *lines, "flat" if sound else "NOT FLAT"]
    )
    print(text)
    if given.record:
        given.record.write_text(text + "\n")
    raise SystemExit(0 if sound else 1)


if __name__ == "__main__":
    main()
