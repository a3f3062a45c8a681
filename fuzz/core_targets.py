"""The targets in Rust: `core/fuzz_targets`, built by cargo on the stable toolchain with libFuzzer.

The flags are those that cargo-fuzz passes with `--sanitizer none`, so that no further tool and no nightly compiler is
needed: counters at every edge of this project's crates and of what they use.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

__all__ = ["TARGETS", "build", "run"]

TARGETS: dict[str, int] = {
    "core-icc": 2_000_000,
    "core-description": 1_000_000,
    "core-optics": 2_000_000,
    "core-illumination": 500_000,
    "core-samplers": 2_000_000,
}
"""Name, and executions in the long run."""

CORE = Path(__file__).with_name("core")
BUILT = CORE / "target" / "x86_64-unknown-linux-gnu" / "fuzz"
FLAGS = (
    "-Ctarget-cpu=x86-64-v3 -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 "
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table "
    "-Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 -Cdebug-assertions --cfg fuzzing"
)


def build() -> None:
    """Build them; the output of cargo is shown only when it fails."""
    cargo = shutil.which("cargo") or str(Path.home() / ".cargo/bin/cargo")
    command = [
        cargo,
        "build",
        "--profile",
        "fuzz",
        "--target",
        "x86_64-unknown-linux-gnu",
        "--locked",
        "--quiet",
    ]
    found = subprocess.run(
        command, cwd=CORE, env={**os.environ, "RUSTFLAGS": FLAGS}, capture_output=True, text=True, check=False
    )
    if found.returncode:
        sys.stderr.write(found.stderr)
        raise SystemExit("Error: the targets in Rust could not be built.")


def run(name: str, executions: int, seconds: float, seed: int, work: Path) -> dict[str, Any]:
    """One target; a panic ends the process, is kept, and the work goes on with another seed."""
    seeds = Path(__file__).with_name("corpus") / name
    corpus = work / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    seeds.mkdir(parents=True, exist_ok=True)
    done, spent, reached, possible = 0, 0.0, 0, 0
    findings: dict[str, dict[str, Any]] = {}
    while done < executions and spent < seconds and len(findings) < 20:
        began = time.monotonic()
        command = [
            str(BUILT / name.replace("-", "_")), f"-runs={executions - done}", f"-seed={seed + len(findings)}",
            f"-max_total_time={int(max(1.0, min(seconds - spent, 1e8)))}", "-timeout=10", "-rss_limit_mb=1500",
            "-max_len=4096", "-print_final_stats=1", f"-artifact_prefix={work}/", str(corpus), str(seeds),
        ]  # fmt: skip
        dictionary = CORE / f"{name}.dict"
        command += [f"-dict={dictionary}"] if dictionary.exists() else []
        told = subprocess.run(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False
        ).stderr.decode("utf-8", "replace")
        spent += time.monotonic() - began
        counted = re.search(r"number_of_executed_units:\s*(\d+)", told) or re.search(
            r"#(\d+)\t(?!.*#\d+\t)", told, re.DOTALL
        )
        done += int(counted[1]) if counted else 0
        covered = re.findall(r"cov: (\d+)", told)
        reached = max([reached, *map(int, covered)])
        counters = re.search(r"Loaded \d+ PC tables? \((\d+) PCs\)", told)
        possible = int(counters[1]) if counters else possible
        if "Done " not in told:
            panic = re.search(r"panicked at ([^\n]*)\n([^\n]*)", told) or re.search(
                r"(ERROR: libFuzzer: [^\n]*)()", told
            )
            text = f"{panic[1]} {panic[2]}".strip() if panic else told[-300:]
            again = findings.setdefault(text, {"text": text, "times": 0, "bytes": 0})
            again["times"] += 1
            (work / "last.log").write_text(told[-20_000:], encoding="utf-8")
            if again["times"] > 3:
                break
    return {
        "target": name,
        "engine": "libFuzzer",
        "executions": done,
        "seconds": round(spent, 1),
        "reached": reached,
        "possible": possible,
        "unit": "edges",
        "corpus": len(list(corpus.glob("*"))),
        "findings": list(findings.values()),
    }


if __name__ == "__main__":
    build()
    sys.stdout.write(json.dumps(list(TARGETS)) + "\n")
