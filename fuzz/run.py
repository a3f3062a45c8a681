"""The long fuzz run by one command: every target, or those that are named.

    python fuzz/run.py                          all targets, each as many executions as it wants (hours)
    python fuzz/run.py spectrum ies --seconds 30
    python fuzz/run.py --executions 500000 --jobs 2

Readers in Python run under atheris where it is installed (`pip install atheris`), targets in Rust under libFuzzer,
which cargo builds with the stable toolchain. Coverage is counted in lines of the reader's modules (Python) and in edges
of the crates (Rust). The table is printed, and kept as `fuzz/last-run.txt` and `fuzz/last-run.json`; inputs that break
a promise lie in `build/fuzz/TARGET/findings`.

Exit code: 0 when nothing was found, 1 when something was, 2 for a target that there is not.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import datetime
import hashlib
import json
import os
import platform
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from fuzz import core_targets  # noqa: E402
from fuzz.execution import execute  # noqa: E402
from fuzz.lines import Lines  # noqa: E402
from fuzz.seeds import CORPUS  # noqa: E402
from fuzz.targets import TARGETS  # noqa: E402

LAST = ROOT / "fuzz" / "last-run.json"
LARGEST_KEPT = 3000
A_PROCESS = 50_000
"""Inputs for one process: the engine and the libraries of images and meshes grow, and memory is limited."""

MOST_KEPT = 24


def _say(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def python_target(
    name: str, executions: int, seconds: float, seed: int, work: Path, plain: bool
) -> dict[str, Any]:
    """One reader, in processes of `A_PROCESS` inputs each, and as many more as faults make necessary."""
    done, spent, processes, faults = 0, 0.0, 0, []
    findings: dict[str, Any] = {}
    while done < executions and spent < seconds and len(faults) < 20:
        (work / "result.json").unlink(missing_ok=True)
        command = [
            sys.executable, "-m", "fuzz.engine", name, "--executions", str(min(executions - done, A_PROCESS)),
            "--seconds", str(seconds - spent), "--seed", str(seed + processes), "--work", str(work),
        ]  # fmt: skip
        processes += 1
        with open(work / "engine.log", "ab") as log:
            code = subprocess.run(
                command + ["--plain"] * plain,
                cwd=ROOT,
                stdout=log,
                stderr=log,
                check=False,
                env=_environment(),
            ).returncode
        result = work / "result.json"
        told = (
            json.loads(result.read_text(encoding="utf-8"))
            if result.exists()
            else {"executions": 0, "seconds": 1.0, "findings": []}
        )
        done, spent = done + told["executions"], spent + told["seconds"]
        findings |= {one["text"]: one for one in told["findings"]}
        if code != 0:
            now = (work / "now.bin").read_bytes() if (work / "now.bin").exists() else bytes(8)
            data = now[8 : 8 + int.from_bytes(now[:8], "little")]
            kept = work / "findings" / f"fault-{hashlib.sha256(data).hexdigest()[:12]}.bin"
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_bytes(data)
            faults.append(
                {"text": f"the process ended with {code}; input {kept.name}", "times": 1, "bytes": len(data)}
            )
    corpus = list((work / "corpus").glob("*"))
    reached, possible = _lines(name, work)
    return {
        "target": name,
        "engine": "mutation" if plain else "atheris",
        "executions": done,
        "seconds": round(spent, 1),
        "reached": reached,
        "possible": possible,
        "unit": "lines",
        "corpus": len(corpus) + len(list((CORPUS / name).glob("*"))),
        "findings": [*findings.values(), *faults],
    }


def _environment() -> dict[str, str]:
    paths = [str(ROOT), str(ROOT / "python"), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in paths if path), "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}  # fmt: skip


def _lines(name: str, work: Path) -> tuple[int, int]:
    """Lines that the corpus reaches, in a process of their own: a library may fail."""
    command = [sys.executable, str(Path(__file__)), "--lines", name, str(work)]
    found = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=False, env=_environment()
    ).stdout
    last = found.strip().splitlines()[-1:] or ["0 0"]
    try:
        reached, possible = map(int, last[0].split())
    except ValueError:
        return 0, 0
    return reached, possible


def _count_lines(name: str, work: Path) -> None:
    target = TARGETS[name]
    lines = Lines(target.modules)
    files = [*sorted((CORPUS / name).glob("*")), *sorted((work / "corpus").glob("*"))[:4000]]
    with lines:
        for file in files:
            execute(target, file.read_bytes())
    _say(f"{len(lines.reached & lines.possible)} {len(lines.possible)}")


def keep(name: str, work: Path) -> int:
    """Add to the committed corpus the smallest inputs that reach lines which it does not."""
    target = TARGETS[name]
    lines = Lines(target.modules)
    with lines:
        for file in sorted((CORPUS / name).glob("*")):
            execute(target, file.read_bytes())
    found = sorted((work / "corpus").glob("*"), key=lambda path: (path.stat().st_size, path.name))
    kept = 0
    for file in found:
        data = file.read_bytes()
        if len(data) > LARGEST_KEPT or kept >= MOST_KEPT:
            break
        before = len(lines.reached)
        with lines:
            execute(target, data)
        if len(lines.reached) > before:
            kept += 1
            (CORPUS / name / f"{hashlib.sha256(data).hexdigest()[:12]}.seed").write_bytes(data)
    return kept


def table(results: list[dict[str, Any]]) -> str:
    """The results for people."""
    rows = [("target", "executions", "seconds", "per second", "coverage", "corpus", "findings")]
    for one in results:
        share = (
            f"{one['reached']}/{one['possible']} {one['unit']}"
            if one["possible"]
            else f"{one['reached']} {one['unit']}"
        )
        rate = one["executions"] / max(one["seconds"], 1e-9)
        rows.append(
            (
                one["target"],
                f"{one['executions']:,}",
                f"{one['seconds']:.0f}",
                f"{rate:,.0f}",
                share,
                str(one["corpus"]),
                str(len(one["findings"])),
            )
        )
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = [
        "  ".join(
            cell.ljust(w) if i in (0, 4) else cell.rjust(w)
            for i, (cell, w) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    for one in results:
        lines += [
            f"{one['target']}: {finding['text']} ({finding['times']} times)" for finding in one["findings"]
        ]
    return "\n".join(lines)


def _heading(results: list[dict[str, Any]]) -> dict[str, Any]:
    import illuminant

    return {
        "date": datetime.date.today().isoformat(),
        "version": illuminant.__version__,
        "python": platform.python_version(),
        "executions": sum(one["executions"] for one in results),
        "findings": sum(len(one["findings"]) for one in results),
    }


def main() -> int:
    """The command."""
    if sys.argv[1:2] == ["--lines"]:
        _count_lines(sys.argv[2], Path(sys.argv[3]))
        return 0
    parser = argparse.ArgumentParser(description="Fuzz the readers and samplers of illuminant.")
    parser.add_argument("targets", nargs="*", help="names of targets; default all")
    parser.add_argument("--executions", type=int, help="of each target; default what each wants")
    parser.add_argument("--seconds", type=float, default=1e9, help="for each target at most")
    parser.add_argument("--jobs", type=int, default=2, help="targets at a time")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers")
    parser.add_argument("--plain", action="store_true", help="without atheris")
    parser.add_argument("--no-record", action="store_true", help="leave fuzz/last-run.* as they are")
    parser.add_argument("--keep", action="store_true", help="add inputs that reach new lines to fuzz/corpus")
    parser.add_argument("--list", action="store_true", help="list the targets and end")
    options = parser.parse_args()
    known = [*TARGETS, *core_targets.TARGETS]
    if options.list:
        _say("\n".join(known))
        return 0
    unknown = [name for name in options.targets if name not in known]
    if unknown:
        sys.stderr.write(f"Error: there is no target {unknown[0]!r}; --list shows those there are.\n")
        return 2
    try:
        import atheris  # noqa: F401  # type: ignore[import-not-found]
    except ImportError:
        options.plain = True
    chosen = options.targets or known
    if any(name in core_targets.TARGETS for name in chosen):
        core_targets.build()
    results: dict[str, dict[str, Any]] = {}

    def one(name: str) -> dict[str, Any]:
        work = ROOT / "build" / "fuzz" / name
        work.mkdir(parents=True, exist_ok=True)
        if name in core_targets.TARGETS:
            wanted = options.executions or core_targets.TARGETS[name]
            return core_targets.run(name, wanted, options.seconds, options.seed, work)
        wanted = options.executions or TARGETS[name].wanted
        return python_target(name, wanted, options.seconds, options.seed, work, options.plain)

    with concurrent.futures.ThreadPoolExecutor(max(1, options.jobs)) as pool:
        waiting = {pool.submit(one, name): name for name in chosen}
        for future in concurrent.futures.as_completed(waiting):
            result = future.result()
            results[waiting[future]] = result
            _say(table([result]).partition("\n")[2])
            if options.keep and waiting[future] in TARGETS:
                keep(waiting[future], ROOT / "build" / "fuzz" / waiting[future])
            if not options.no_record:
                record(results, known)
    _say(table([results[name] for name in chosen]))
    return 1 if any(one["findings"] for one in results.values()) else 0


def record(results: dict[str, dict[str, Any]], known: list[str]) -> None:
    """Write the last run; targets that were not run keep what they had."""
    before = json.loads(LAST.read_text(encoding="utf-8"))["targets"] if LAST.exists() else []
    dated = {one["target"]: one for one in before if one["target"] in known}
    today = datetime.date.today().isoformat()
    dated |= {name: {**one, "date": today} for name, one in results.items()}
    ordered = [dated[name] for name in known if name in dated]
    told = _heading(ordered) | {"targets": ordered}
    LAST.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    head = (
        f"illuminant {told['version']}, {told['date']}, Python {told['python']}: {told['executions']:,} executions, "
        f"{told['findings']} findings"
    )
    LAST.with_suffix(".txt").write_text(f"{head}\n\n{table(ordered)}\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
