"""Memory against samples: prints a table.

    .venv/bin/python benches/memory.py                       # about four minutes
    .venv/bin/python benches/memory.py --size 128 --samples 16 1024

Each row is a process of its own (the largest resident size of a process never goes down): Python, the
packages, Embree, the scene, the film and one image. Memory shall depend on image and scene only: the table
gives its growth from the fewest to the most samples, which issue 2 bounds by 5 %.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from renderer_process import RendererProcess

SIDE = Path(__file__).resolve().parent / "illuminant_side.py"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scene", default="cornell", help="cornell, million, or a scene file")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, nargs="+", default=[16, 4096])
    parser.add_argument("--threads", type=int, default=2)
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


if __name__ == "__main__":
    main()
