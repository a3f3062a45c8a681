"""Renders that are killed at random moments, and go on from their checkpoints: nothing is lost, no bit differs.

A render with a checkpoint every tenth of a second is started as a process of its own, and ended by SIGKILL after a
random time: while it starts, renders, or writes. After every kill the checkpoint on the disk must be whole and hold at
least what the one before held. Then it is resumed, and killed again, until it comes to its end; the image must then
equal, bit for bit, that of a render which was left in peace. Now and then the disk is full instead (a limit on the size
of files): the checkpoint that was there must stay.

    python endurance/kills.py [--kills 200] [--seed 1] [--record endurance/kills.txt]
"""

from __future__ import annotations

import argparse
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from datetime import date
from pathlib import Path

import numpy as np

import illuminant
from illuminant.checkpoint import Checkpoint
from illuminant.image import Image

SCENE = Path(__file__).resolve().parent.parent / "scenes" / "cornell.toml"
EVERY = 0.1
FULL = 50_000
"""Bytes that a file may have on a full disk: less than a checkpoint takes."""


def command(folder: Path, options: list[str]) -> list[str]:
    """The render that is killed."""
    words = ["render", str(SCENE), "-o", str(folder / "image.exr"), *options]
    kept = ["--checkpoint", str(folder / "image.ckpt"), "--every", f"{EVERY}s", "--resume"]
    return [sys.executable, "-m", "illuminant", *words, *kept]


def killed(words: list[str], seconds: float, *, full: bool) -> int | None:
    """Run a command and kill it after a time; its exit code if it ended before."""

    def limit() -> None:
        if full:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (FULL, FULL))

    with subprocess.Popen(
        words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limit
    ) as process:
        try:
            return process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return None


def amount(file: Path) -> tuple[int, int]:
    """How much work a checkpoint holds, in its order: rows of form factors, then samples; raises if it is not whole."""
    kept = Checkpoint.read(file)
    return (0, len(kept.rows)) if kept.rows else (1, kept.samples)


NOTHING = (0, 0)


def survive(kills: int, seed: int, options: list[str], folder: Path) -> Counter[str]:
    """Kill renders until so many kills are survived, and count what happened."""
    chance, found = random.Random(seed), Counter[str]()
    reference = folder / "reference.exr"
    start = time.monotonic()
    plain = [sys.executable, "-m", "illuminant", "render", str(SCENE), "-o", str(reference), *options]
    subprocess.run(plain, check=True, capture_output=True)
    whole = time.monotonic() - start
    wanted = Image.open(reference)
    checkpoint, before = folder / "image.ckpt", NOTHING
    while found["kills"] < kills or checkpoint.exists():
        full = chance.random() < 0.1 and found["kills"] < kills
        # After the last kill it is left in peace.
        seconds = chance.uniform(0.05, 1.3 * whole) if found["kills"] < kills else 600.0
        ended = killed(command(folder, options), seconds, full=full)
        writing = any(folder.glob(".image.illuminant-*.ckpt"))
        if checkpoint.exists():
            now = amount(checkpoint)
            assert now >= before, f"a kill after {seconds:.3f} s lost {before} and left {now}"
            before = now
        else:
            assert before == NOTHING, "the checkpoint is gone"
        if ended is None:
            found["kills"] += 1
            found["while a checkpoint was written"] += writing
            found["before the first checkpoint"] += before == NOTHING
            found["while form factors were found"] += NOTHING < before < (1, 0)
            found["with a full disk"] += full
            continue
        if full:
            # An image does not fit on a full disk either; what was done must not be lost with it.
            assert ended == 3, f"a full disk ended the render with code {ended}"
            found["full disks met to the end"] += 1
            continue
        assert ended == 0, f"the render ended with code {ended}"
        image = Image.open(folder / "image.exr")
        assert np.array_equal(image.xyz, wanted.xyz), "the image is another one"
        assert image.settings == wanted.settings
        found["renders that came to their end, to the bit"] += 1
        checkpoint.unlink()
        before = NOTHING
    return found


def main() -> None:
    """Run, and say what happened."""
    told = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    told.add_argument("--kills", type=int, default=200)
    told.add_argument("--seed", type=int, default=1)
    told.add_argument("--size", default="256x256")
    told.add_argument("--samples", default="12")
    told.add_argument("--techniques", default="path,radiosity", help="each has its share of the kills")
    told.add_argument("--record", type=Path, help="file that takes the result")
    given = told.parse_args()
    options = ["--size", given.size, "--samples", given.samples]
    options += ["--layers", "depth,normal,albedo", "--keep-spectra"]
    techniques = given.techniques.split(",")
    lines = [f"illuminant {illuminant.__version__}, {date.today()}: renders killed at random moments"]
    for technique in techniques:
        start = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            kills = given.kills // len(techniques)
            found = survive(kills, given.seed, [*options, "--technique", technique], Path(folder))
            left = sorted(path.name for path in Path(folder).iterdir())
        lines += [f"{technique}: {time.monotonic() - start:.0f} seconds; files left: {', '.join(left)}"]
        lines += [f"{count:6}  {what}" for what, count in found.items() if count]
    text = "\n".join(lines)
    print(text)
    if given.record:
        given.record.write_text(text + "\n")


if __name__ == "__main__":
    main()
