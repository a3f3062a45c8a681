"""A short fuzz run: every target reads its corpus, and a second of changed inputs, the same at every run.

The long run is `python fuzz/run.py`. An input that broke a promise once lies in `crashes/TARGET`, with the sentence
that it must end in now; `ok` where it is read.
"""

import importlib.util
import time
import tomllib
import tracemalloc
import warnings
from pathlib import Path
from random import Random
from typing import Any

import pytest
from fuzz.execution import execute
from fuzz.mutation import mutated
from fuzz.run import table
from fuzz.seeds import CORPUS
from fuzz.targets import TARGETS

from illuminant.errors import Error

CRASHES = Path(__file__).with_name("crashes")
SECONDS = 1.0
MOST = 300


def usable(name: str) -> None:
    missing = [module for module in TARGETS[name].modules if importlib.util.find_spec(module) is None]
    if missing:
        pytest.skip(f"this version has no {missing[0]}")


@pytest.mark.parametrize("name", TARGETS)
def test_a_reader_keeps_its_promise_with_changed_inputs(name: str) -> None:
    usable(name)
    target = TARGETS[name]
    seeds = [path.read_bytes() for path in sorted((CORPUS / name).glob("*.seed"))]
    random = Random(name)
    until = time.monotonic() + SECONDS
    found = [execute(target, seed) for seed in seeds]
    for _ in range(MOST):
        if time.monotonic() > until:
            break
        start = random.choice(seeds) if seeds else b""
        data = mutated(random, start, seeds, text=target.text, words=target.words, longest=target.longest)
        found.append(execute(target, data))
    broken = [finding for finding in found if finding]
    assert not broken, f"{broken[0]}\n{broken[0].data!r}"


@pytest.mark.parametrize("name", [name for name in TARGETS if name not in ("part", "solution", "checkpoint")])
def test_some_seed_of_every_target_is_read(name: str) -> None:
    """Or the corpus would only test how files are refused."""
    usable(name)
    read = 0
    for path in sorted((CORPUS / name).glob("*.seed")):
        try:
            TARGETS[name].run(path.read_bytes())
        except (Error, ValueError, TypeError):
            continue
        read += 1
    assert read


CASES = sorted(path for path in CRASHES.glob("*/*.bin")) if CRASHES.is_dir() else []


@pytest.mark.parametrize("case", CASES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_what_broke_a_promise_once_keeps_it(case: Path) -> None:
    target, data = TARGETS[case.parent.name], case.read_bytes()
    sentence = case.with_suffix(".txt").read_text(encoding="utf-8").strip()
    usable(target.name)
    assert execute(target, data) is None
    if sentence == "ok":
        target.run(data)
        return
    with pytest.raises((Error, *target.allowed)) as caught:
        target.run(data)
    assert sentence in str(caught.value)


def test_a_short_file_asks_for_little_memory(tmp_path: Path) -> None:
    """Run-length images once set 1.3 GB aside before a byte was read, and compressed meshes 4 GB."""
    from illuminant import meshes
    from illuminant.display import run_length

    (tmp_path / "a.rle").write_bytes((CORPUS / "run-length" / "rgb.seed").read_bytes())
    (tmp_path / "a.ply.gz").write_bytes((CORPUS / "gzip" / "ply.seed").read_bytes())
    tracemalloc.start()
    try:
        run_length.read(tmp_path / "a.rle")
        meshes.read(tmp_path / "a.ply.gz")
        assert tracemalloc.get_traced_memory()[1] < 20_000_000
    finally:
        tracemalloc.stop()


def test_changes_are_the_same_for_the_same_seed_and_none_is_longer_than_allowed() -> None:
    def changed(seed: int) -> list[bytes]:
        random = Random(seed)
        return [
            mutated(random, b"n 1.5\n400 0.2\n", [b"k 2"], text=True, words=("n",), longest=64)
            for _ in range(200)
        ]

    assert changed(1) == changed(1) != changed(2)
    assert max(map(len, changed(3))) <= 64
    assert len(set(changed(4))) > 100


def test_what_is_no_error_of_ours_is_a_finding() -> None:
    from fuzz.execution import Target

    def broken(data: bytes) -> None:
        if data == b"warn":
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                warnings.warn("a number", RuntimeWarning, stacklevel=1)
        if data == b"error":
            raise Error("a sentence")
        if data == b"silent":
            raise Error("")
        if data == b"panic":
            raise BaseException("panicked")  # as a panic of the core arrives
        if data:
            raise ValueError("a value")

    target = Target("broken", broken, ())
    kinds = [found.kind if (found := execute(target, data)) else None for data in
             (b"warn", b"error", b"silent", b"panic", b"other", b"")]  # fmt: skip
    assert kinds == ["RuntimeWarning", None, "silent", "BaseException", "ValueError", None]


def test_the_table_of_a_run_names_its_findings() -> None:
    one = {"target": "a", "executions": 1000, "seconds": 2.0, "reached": 3, "possible": 4, "unit": "lines", "corpus": 1,
           "findings": [{"text": "ValueError at x.py:1: no", "times": 2}]}  # fmt: skip
    assert "500  3/4 lines" in table([one])
    assert table([one]).endswith("a: ValueError at x.py:1: no (2 times)")


def test_the_lock_of_the_targets_in_rust_is_that_of_the_crates() -> None:
    """Else cargo, told `--locked`, builds none of them."""
    root = Path(__file__).parents[2]

    def locked(path: Path) -> dict[str, dict[str, Any]]:
        return {one["name"]: one for one in tomllib.loads(path.read_text(encoding="utf-8"))["package"]}

    ours, theirs = locked(root / "fuzz/core/Cargo.lock"), locked(root / "Cargo.lock")
    seen = 0
    for manifest in sorted((root / "crates").glob("*/Cargo.toml")):
        crate = tomllib.loads(manifest.read_text(encoding="utf-8"))
        name = crate["package"]["name"]
        if name in ours:
            seen += 1
            assert set(ours[name].get("dependencies", [])) == set(crate.get("dependencies", {})), name
    assert seen > 5
    assert ours["pxfm"]["version"] == theirs["pxfm"]["version"], "the functions are those of the program"
