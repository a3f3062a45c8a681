"""Memory against samples, and time against spectral lanes: prints two tables.

    .venv/bin/python benches/memory.py                       # about six minutes
    .venv/bin/python benches/memory.py --size 128 --samples 16 1024

Each row is a process of its own (the largest resident size of a process never goes down): Python, the
packages, Embree, the scene, the film and one image. Memory shall depend on image and scene only: the first
table gives its growth from the fewest to the most samples, which issue 2 bounds by 5 %.
"""

from __future__ import annotations

import argparse
import statistics
import sys
from pathlib import Path

from renderer_process import RendererProcess

SIDE = Path(__file__).resolve().parent / "illuminant_side.py"


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scene", default="cornell", help="cornell, million, or a scene file")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, nargs="+", default=[16, 4096])
    parser.add_argument("--lanes", type=int, nargs="+", default=[4, 8, 16, 32])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=5, help="for the table of lanes")
    options = parser.parse_args()
    command = [sys.executable, str(SIDE), options.scene]
    command += ["--size", str(options.size), "--threads", str(options.threads)]

    print(f"{options.scene}, {options.size} x {options.size}: memory against samples, uniform:8")
    print(f"{'samples':>9}{'peak MB':>10}{'seconds':>10}")
    peaks = []
    for samples in options.samples:
        with RendererProcess([*command, "--sampling", "uniform:8"]) as process:
            answer = process.render(seed=1, samples=samples)
        peaks.append(int(answer["peak_bytes"]))
        print(f"{samples:9}{peaks[-1] / 1e6:10.1f}{answer['seconds']:10.2f}", flush=True)
    print(f"growth: {(peaks[-1] / peaks[0] - 1) * 100:+.2f} %")

    print("\ntime against lanes, 64 samples a pixel (runs alternate)")
    print(f"{'lanes':>9}{'seconds':>10}{'Msamples/s':>12}{'ns/sample':>11}{'to the first':>14}")
    processes = {n: RendererProcess([*command, "--sampling", f"uniform:{n}"]) for n in options.lanes}
    seconds: dict[int, list[float]] = {n: [] for n in options.lanes}
    try:
        for run in range(options.runs + 1):
            for lanes, process in processes.items():
                took = float(process.render(seed=run, samples=64)["seconds"])
                if run:  # the first run touches the memory
                    seconds[lanes].append(took)
    finally:
        for process in processes.values():
            process.close()
    count = options.size**2 * 64
    first = statistics.median(seconds[options.lanes[0]])
    for lanes in options.lanes:
        median = statistics.median(seconds[lanes])
        print(
            f"{lanes:9}{median:10.3f}{count / median / 1e6:12.3f}{median / count * 1e9:11.1f}{median / first:14.2f}"
        )


if __name__ == "__main__":
    main()
