"""How the farm scales: one and two workers of a local cluster beside a render here, and a model of cost for more.

    python benches/farm.py [SCENE] [--samples N] [--size WxH]

The model has four numbers, each measured in the same run:

- W, seconds of work in all (of workers, without preparing);
- p, seconds in which a worker prepares the scene;
- m, seconds in which a megabyte of parts is joined here;
- B, megabytes of parts, which the network carries at 1 Gbit/s, 125 MB/s.

With n workers the work ends after T(n) = p + W/n + S/2, where S = 2 s is the length of a share (the last one is on
average half done when the others end); and not before all parts have come through one network card and been joined by
one thread, B/125 + m B. The larger of the two is the time; where the second one is, more workers are of no use.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import illuminant
from illuminant import farm
from illuminant.job import Job

SCENES = Path(__file__).resolve().parent.parent / "scenes"
NETWORK_MB = 125.0


def here(options: dict, scene: Path, threads: int) -> float:
    """Seconds of a render here, without preparing."""
    job = Job(scene, threads=threads, **options)
    start = time.perf_counter()
    for _ in job.passes():
        pass
    return time.perf_counter() - start


def there(options: dict, scene: Path, workers: int) -> farm.Report:
    """The report of a render by workers."""
    with farm.cluster(workers=workers) as ray:
        return farm.render_job(ray, Job(scene, **options))


def model(report: farm.Report, workers: int) -> float:
    """Seconds with so many workers."""
    work = report.busy - report.prepared
    prepare = report.prepared / len(report.workers)
    megabytes = report.bytes / 1e6
    serial = megabytes / NETWORK_MB + report.merging
    return max(prepare + work / workers + farm.SECONDS / 2, serial)


def main() -> None:
    """Print the table."""
    told = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    told.add_argument("scene", nargs="?", type=Path, default=SCENES / "cornell.toml")
    told.add_argument("--samples", type=int, default=128)
    told.add_argument("--size", default="512x512")
    given = told.parse_args()
    options = {"samples": given.samples, "size": given.size}
    alone, both = here(options, given.scene, 1), here(options, given.scene, 2)
    reports = {workers: there(options, given.scene, workers) for workers in (1, 2)}
    print(
        f"{given.scene.name}, {given.size}, {given.samples} samples a pixel, illuminant {illuminant.__version__}"
    )
    print("| | seconds | of one thread here | shares | MB back | joining, s | preparing, s a worker |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, seconds in (("here, 1 thread", alone), ("here, 2 threads", both)):
        print(f"| {name} | {seconds:.1f} | {alone / seconds:.2f} | | | | |")
    for workers, report in reports.items():
        print(
            f"| farm, {workers} worker{'s' * (workers > 1)} | {report.seconds:.1f} | {alone / report.seconds:.2f} | "
            f"{report.shares} | {report.bytes / 1e6:.1f} | {report.merging:.2f} | "
            f"{report.prepared / len(report.workers):.2f} |"
        )
    known = reports[2]
    for workers in (1, 2, 10, 100):
        seconds = model(known, workers)
        print(
            f"| model, {workers} worker{'s' * (workers > 1)} | {seconds:.1f} | {alone / seconds:.2f} | | | | |"
        )
    megabytes = known.bytes / 1e6
    print(f"network and joining alone: {megabytes / NETWORK_MB + known.merging:.2f} s")


if __name__ == "__main__":
    main()
