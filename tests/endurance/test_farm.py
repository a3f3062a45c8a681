"""The farm: an image made by workers has the bits of one made here, whatever happens to the workers."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import illuminant
from illuminant import farm
from illuminant.checkpoint import Checkpoint
from illuminant.errors import MachineError, UsageError
from illuminant.job import Job

SMALL = {"size": (48, 32), "samples": 72}
KINDS = [
    {"technique": "path", "layers": "depth,normal,samples"},
    {"technique": "path", "caustics": True, "lamps": True},
    {"technique": "path", "error": 0.15, "samples": 256},
    {"technique": "path", "sampling": "uniform:20", "keep_spectra": True, "samples": 8},
    {"technique": "phong", "illumination": "phong", "samples": 8},
    {"technique": "radiosity", "elements": 300, "form_factors": "rays:64", "samples": 8},
    {"technique": "hybrid", "elements": 200, "form_factors": "rays:64", "samples": 8},
    {"technique": "specular-radiosity", "elements": 100, "samples": 4},
]


@pytest.fixture(scope="module")
def ray() -> Iterator[Any]:
    pytest.importorskip("ray", reason="Ray is not installed")
    with farm.cluster(workers=2) as connected:
        yield connected


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: "-".join(map(str, kind.values())))
def test_the_image_has_the_bits_of_one_made_here(ray, scenes, kind, same):
    image = farm.render(scenes / "cornell.toml", **{**SMALL, **kind})
    same(image, illuminant.render(scenes / "cornell.toml", **{**SMALL, **kind}))
    assert image.statistics["farm"]["shares"] >= 4
    assert image.statistics["farm"]["bytes"] > 0


def workers() -> list[int]:
    """Processes that are doing a share now."""
    found = []
    for folder in Path("/proc").iterdir():
        try:
            if (folder / "cmdline").read_bytes().startswith(b"ray::share"):
                found.append(int(folder.name))
        except (OSError, ValueError):
            pass
    return found


def test_a_worker_that_is_killed_costs_what_it_was_doing(ray, scenes, same):
    options = {"size": (128, 96), "samples": 1024}
    job, killed, over = Job(scenes / "cornell.toml", **options), set(), threading.Event()

    def kill() -> None:
        while not over.is_set() and len(killed) < 3:
            time.sleep(0.4)
            for process in workers()[:1]:
                os.kill(process, signal.SIGKILL)
                killed.add(process)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        report = farm.render_job(ray, job)
    finally:
        over.set()
        killer.join()
    assert len(killed) == 3, "workers were not met at their work"
    same(job.image(), illuminant.render(scenes / "cornell.toml", **options))
    # Each sample was joined once: what a dead worker was doing came from another, and nothing twice.
    assert job.image().statistics["samples"] == 128 * 96 * 1024
    assert len(report.workers - killed) >= 1


def test_no_more_is_under_way_than_twice_the_workers(ray, scenes, monkeypatch):
    most = 0
    wait = ray.wait

    def counted(references: list[Any], **options: Any) -> Any:
        nonlocal most
        most = max(most, len(references))
        return wait(references, **options)

    monkeypatch.setattr(ray, "wait", counted)
    monkeypatch.setattr(farm, "SECONDS", 0.02)
    image = farm.render(scenes / "cornell.toml", **SMALL)
    assert image.statistics["farm"]["shares"] > 8
    assert 2 <= most <= 4


def test_it_ends_when_it_is_told(ray, scenes):
    seen: list[float] = []

    def enough(progress: illuminant.job.Progress) -> bool:
        seen.append(progress.samples)
        return len(seen) < 2

    image = farm.render(scenes / "cornell.toml", size=(64, 64), samples=10_000, progress=enough)
    assert len(seen) == 2
    assert 0 < image.statistics["samples"] < 64 * 64 * 10_000


@pytest.mark.parametrize("kind", [{}, {"caustics": True}, {"error": 0.04, "samples": 512}], ids=str)
def test_it_takes_only_what_a_checkpoint_lacks(ray, scenes, kind, same):
    """One that was written within a range, where some tiles hold more than others."""
    options = {**SMALL, "samples": 200, **kind}
    job = Job(scenes / "cornell.toml", **options)
    for done in job.passes():
        if done >= 64:
            break
    job.under_way = job.next_end()
    job.core_render.run(job.done, job.under_way, tiles=(1, 3))
    later = Job(scenes / "cornell.toml", checkpoint=job.checkpoint(), **options)
    farm.render_job(ray, later)
    same(later.image(), illuminant.render(scenes / "cornell.toml", **options))


def test_it_goes_on_from_one_that_a_farm_left(ray, scenes, tmp_path, same):
    file = tmp_path / "image.ckpt"
    options = {"size": (64, 64), "samples": 300}
    seen: list[float] = []

    def enough(progress: illuminant.job.Progress) -> bool:
        seen.append(progress.samples)
        return len(seen) < 5

    farm.render(scenes / "cornell.toml", **options, progress=enough, checkpoint=file)
    there = farm.render(scenes / "cornell.toml", **options, checkpoint=file, resume=True)
    same(there, illuminant.render(scenes / "cornell.toml", **options))


def test_it_goes_on_from_a_checkpoint_made_here(ray, scenes, tmp_path, same):
    file = tmp_path / "image.ckpt"
    illuminant.render(scenes / "cornell.toml", size=(48, 32), samples=10, checkpoint=file)
    image = farm.render(scenes / "cornell.toml", **SMALL, checkpoint=file, resume=True)
    same(image, illuminant.render(scenes / "cornell.toml", **SMALL))
    again = illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=file, resume=True)
    assert again.xyz.tobytes() == image.xyz.tobytes()


def test_what_cannot_be_is_said_in_a_sentence():
    with pytest.raises(UsageError, match="--workers: is for a cluster that is started here"):
        farm.render("nowhere.toml", workers=2, address="auto")
    with pytest.raises(UsageError, match="--workers 0"):
        farm.render("nowhere.toml", workers=0)
    with pytest.raises(UsageError, match="--threads 0"):
        farm.render("nowhere.toml", threads=0)


def test_more_threads_than_any_machine_has_are_refused(ray, scenes):
    with pytest.raises(UsageError, match="--threads 64: no machine of the cluster lends so many"):
        farm.render(scenes / "cornell.toml", **SMALL, threads=64)
    with pytest.raises(UsageError, match="connected to a Ray cluster already"):
        farm.render(scenes / "cornell.toml", **SMALL, workers=2)


def test_why_a_share_fails_on_its_worker_is_said(ray):
    from illuminant.farm.dispatch import dispatched

    def broken(number: int) -> None:
        raise ValueError(f"there is no Embree on worker {number}")

    with pytest.raises(
        MachineError, match=r"failed on a worker of the cluster: .*there is no Embree on worker 7"
    ):
        list(dispatched(ray, broken, [(0, (7,))], threads=1))


def test_what_a_lost_cluster_has_brought_is_kept(ray, scenes, tmp_path, same, monkeypatch):
    from illuminant.farm import dispatch

    whole = dispatch.dispatched

    def lost(*given: Any, **more: Any) -> Iterator[Any]:
        for count, found in enumerate(whole(*given, **more)):
            if count == 3:
                raise MachineError("The cluster is lost.")
            yield found

    monkeypatch.setattr(dispatch, "dispatched", lost)
    file = tmp_path / "image.ckpt"
    with pytest.raises(MachineError, match="is lost"):
        farm.render(scenes / "cornell.toml", **SMALL, checkpoint=file)
    assert Checkpoint.read(file).samples > 0
    again = illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=file, resume=True)
    same(again, illuminant.render(scenes / "cornell.toml", **SMALL))


def test_a_batch_system_that_ends_it_loses_nothing(scenes, tmp_path):
    """SIGTERM, which Ray would take for itself."""
    pytest.importorskip("ray", reason="Ray is not installed")
    file, words = tmp_path / "a.ckpt", ["--workers", "1", "--size", "64x64", "--samples", "1000000"]
    kept = ["--checkpoint", str(file), "--every", "1s", "-o", str(tmp_path / "a.exr")]
    program = [sys.executable, "-m", "illuminant", "farm", "render", str(scenes / "cornell.toml")]
    process = subprocess.Popen([*program, *words, *kept], stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + 120.0
    while not file.exists() and process.poll() is None and time.monotonic() < end:
        time.sleep(0.1)
    process.send_signal(signal.SIGTERM)
    _, told = process.communicate(timeout=120)
    assert process.returncode == 130, told
    assert Checkpoint.read(file).samples > 0
    assert illuminant.Image.open(tmp_path / "a.exr").xyz.shape == (64, 64, 3)


def test_the_command_starts_and_stops_a_cluster(command, scenes, tmp_path):
    pytest.importorskip("ray", reason="Ray is not installed")
    before = set(Path("/tmp").glob("ray-*"))
    words = ["farm", "render", scenes / "cornell.toml", "--size", "32x32", "--samples", "16"]
    done = command(*words, "--workers", 1, "-o", tmp_path / "a.exr")
    assert done.returncode == 0, done.stderr
    assert "farm: " in done.stderr + done.stdout
    here = illuminant.render(scenes / "cornell.toml", size=(32, 32), samples=16)
    assert (
        illuminant.Image.open(tmp_path / "a.exr").xyz.astype("f4").tobytes()
        == here.xyz.astype("f4").tobytes()
    )
    assert set(Path("/tmp").glob("ray-*")) == before
    lost = command(*words, "--address", "127.0.0.1:1", "-o", tmp_path / "b.exr", timeout=120)
    assert lost.returncode == 3
    assert "cannot be reached at 127.0.0.1:1" in lost.stderr
