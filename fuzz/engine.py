"""One target under fuzz: by atheris (libFuzzer, guided by coverage) where it is installed, else by `mutation` alone.

Called by `run` as a process of its own:
`python -m fuzz.engine TARGET --executions N --seconds S --seed K --work FOLDER`. It goes on after a finding; each kind
at each place is kept once, as `FOLDER/findings/*.bin` beside a text. At the end it writes `result.json` there.

Limits: an execution that takes more than 5 s is a finding, and so is one that wants 1 GB more than the process holds
when it begins. What ends the process itself (a fault in a library) leaves its input in `FOLDER/now.bin`.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import mmap
import os
import resource
import sys
import time
from pathlib import Path
from random import Random
from typing import Any

from fuzz.execution import Finding, Target, execute, strict
from fuzz.mutation import mutated
from fuzz.seeds import CORPUS

__all__ = ["Worker"]

MOST_MEMORY = 1 << 30
LONGEST_NOW = 1 << 20


class Worker:
    """Executes, counts and keeps what breaks a promise.

    Args:
        target: the reader.
        work: folder for what is found.
        executions: after how many to end.
        seconds: after which to end.
    """

    def __init__(self, target: Target, work: Path, executions: int, seconds: float) -> None:
        self.target, self.work, self.executions, self.seconds = target, work, executions, seconds
        self.done, self.began, self.written = 0, time.monotonic(), 0.0
        self.findings: dict[tuple[str, str], Finding] = {}
        self.counts: dict[tuple[str, str], int] = {}
        (work / "findings").mkdir(parents=True, exist_ok=True)
        with open(work / "now.bin", "wb") as file:
            file.truncate(LONGEST_NOW)
        with open(work / "now.bin", "r+b") as file:
            self.now = mmap.mmap(file.fileno(), LONGEST_NOW)

    def __call__(self, data: bytes) -> None:
        """One input."""
        # In shared memory, so that it is there after a fault, at no cost.
        self.now[:8] = len(data).to_bytes(8, "little")
        self.now[8 : 8 + len(data)] = data
        finding = execute(self.target, data)
        self.done += 1
        if finding is not None:
            key = (finding.kind, finding.place)
            self.counts[key] = self.counts.get(key, 0) + 1
            if key not in self.findings or len(data) < len(self.findings[key].data):
                self.findings[key] = finding
                name = hashlib.sha256("".join(key).encode()).hexdigest()[:12]
                (self.work / "findings" / f"{name}.bin").write_bytes(data)
                (self.work / "findings" / f"{name}.txt").write_text(f"{finding}\n", encoding="utf-8")
        now = time.monotonic()
        over = self.done >= self.executions or now - self.began >= self.seconds
        if over or now - self.written > 2.0:
            self.written = now
            self.save()
        if over:
            sys.stdout.flush()
            sys.stderr.flush()
            self.now[:8] = bytes(8)
            os._exit(0)

    def save(self) -> None:
        """Write how far it is."""
        told = {
            "executions": self.done,
            "seconds": time.monotonic() - self.began,
            "findings": [
                {"text": str(one), "times": self.counts[key], "bytes": len(one.data)}
                for key, one in self.findings.items()
            ],
        }
        place = self.work / "result.json"
        place.with_suffix(".new").write_text(json.dumps(told), encoding="utf-8")
        place.with_suffix(".new").replace(place)


def _limit_memory() -> None:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + MOST_MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def _seeds(target: str) -> list[bytes]:
    return [path.read_bytes() for path in sorted((CORPUS / target).glob("*.seed"))]


def main() -> None:
    """The process."""
    parser = argparse.ArgumentParser()
    parser.add_argument("target")
    parser.add_argument("--executions", type=int, default=1 << 60)
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--plain", action="store_true", help="without atheris")
    options = parser.parse_args()
    work: Path = options.work
    (work / "corpus").mkdir(parents=True, exist_ok=True)
    atheris: Any = None
    if not options.plain:
        try:
            import atheris  # type: ignore[import-not-found, no-redef]
        except ImportError:
            atheris = None
    from fuzz import targets

    target = targets.TARGETS[options.target]
    if atheris is not None:
        with atheris.instrument_imports(include=list(target.modules)):
            for module in target.modules:
                __import__(module)
    seeds = _seeds(options.target)
    for seed in seeds:  # what is imported late is there before memory is counted
        execute(target, seed)
    _limit_memory()
    strict()
    worker = Worker(target, work, options.executions, options.seconds)
    random = Random(f"{options.target} {options.seed}")

    def change(data: bytes, longest: int, seed: int) -> bytes:
        if random.random() < 0.5:
            return bytes(atheris.Mutate(data, longest))
        return mutated(random, data, seeds, text=target.text, words=target.words, longest=longest)

    if atheris is None or not target.guided:
        pool = list(seeds)
        for seed in pool:
            worker(seed)
        while True:
            start = random.choice(pool) if pool else b""
            worker(mutated(random, start, pool, text=target.text, words=target.words, longest=target.longest))
    words = work / "words.txt"
    lines = ["".join(f"\\x{byte:02x}" for byte in word.encode("utf-8")) for word in target.words if word]
    words.write_text("".join(f'"{line}"\n' for line in lines), encoding="ascii")
    atheris.Setup(
        [
            sys.argv[0],
            f"-max_len={target.longest}",
            f"-seed={options.seed}",
            "-rss_limit_mb=0",
            "-timeout=60",
            "-print_final_stats=0",
            "-len_control=0",
            "-reload=0",
            f"-artifact_prefix={work}/",
            *([f"-dict={words}"] if lines else []),
            str(work / "corpus"),
            str(CORPUS / options.target),
        ],
        worker,
        custom_mutator=change,
    )
    atheris.Fuzz()


if __name__ == "__main__":
    main()
