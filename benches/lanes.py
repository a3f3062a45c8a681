"""The price of spectral lanes: time per sample against the number of wavelengths a path carries; prints a table.

    .venv/bin/python benches/lanes.py                       # about two minutes
    .venv/bin/python benches/lanes.py --scene cornell-fl11 --sampling fitted:4 fitted:8 fitted:16 fitted:32

Every sampling follows the same paths for the same seed (decisions look at brightness, never at lanes), so rays
per sample are the same and what differs is arithmetic on lanes. Each sampling is a warm process of its own; runs
are short and alternate, A B C D A B C D, so that other work on the machine falls on all. In each round the time
of each is divided by that of the first, and the median of those ratios is the price; the quartiles beside it say
how sure it is. The same by processor time of the whole call varies less where other work shares the machine; for
`fitted:N` it holds the fit as well.

Time is that of taking samples: no scene, no ray structure. What a sampling needs before the first sample, such
as the fit of `fitted:N`, has a column of its own: the whole call of `illuminant.render` less its samples.
"""

from __future__ import annotations

import argparse
import statistics
import sys
from pathlib import Path
from typing import Any

from renderer_process import RendererProcess

SIDE = Path(__file__).resolve().parent / "illuminant_side.py"
SAMPLINGS = ["uniform:4", "uniform:8", "uniform:16", "uniform:32", "fitted:8", "fitted:16"]


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scene", default="cornell", help="cornell, cornell-fl11, million, or a scene file")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, default=16, help="per pixel, in one run")
    parser.add_argument(
        "--sampling", nargs="+", default=SAMPLINGS, help="the first is what others cost more than"
    )
    parser.add_argument("--depth", type=int, default=8, help="longest path in segments")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=21)
    options = parser.parse_args()
    rounds = _measure(options)
    _report(rounds, options)


def _measure(options: argparse.Namespace) -> list[dict[str, dict[str, Any]]]:
    """For each round, the answer of each sampling."""
    command = [sys.executable, str(SIDE), options.scene, "--size", str(options.size)]
    command += ["--depth", str(options.depth), "--threads", str(options.threads)]
    processes: dict[str, RendererProcess] = {}
    try:
        for sampling in options.sampling:
            processes[sampling] = RendererProcess([*command, "--sampling", sampling])
        return [
            {
                sampling: process.render(seed=run, samples=options.samples)
                for sampling, process in processes.items()
            }
            for run in range(options.runs + 1)
        ][1:]  # the first round touches the memory
    finally:
        for process in processes.values():
            process.close()


def _report(rounds: list[dict[str, dict[str, Any]]], options: argparse.Namespace) -> None:
    first = options.sampling[0]
    print(
        f"{options.scene}, {options.size} x {options.size}, {options.samples} samples a pixel, "
        f"{options.threads} threads, {options.runs} rounds"
    )
    print(
        f"{'sampling':14}{'ns/sample':>10}{f'to {first}':>14}{'quartiles':>13}{'CPU time to it':>16}{'quartiles':>13}"
        f"{'rays/sample':>13}{'before, s':>11}"
    )
    for sampling in options.sampling:
        own = [answers[sampling] for answers in rounds]
        per_sample = statistics.median(_seconds(answer) / answer["core"]["samples"] * 1e9 for answer in own)
        wall = [_seconds(answers[sampling]) / _seconds(answers[first]) for answers in rounds]
        processor = [
            answers[sampling]["processor_seconds"] / answers[first]["processor_seconds"] for answers in rounds
        ]
        rays = statistics.fmean(answer["core"]["rays"] / answer["core"]["samples"] for answer in own)
        before = statistics.median(answer["seconds"] - _seconds(answer) for answer in own)
        print(
            f"{sampling:14}{per_sample:10.1f}{_median_and_quartiles(wall, 14)}{_median_and_quartiles(processor, 16)}"
            f"{rays:13.4f}{before:11.3f}"
        )


def _seconds(answer: dict[str, Any]) -> float:
    """Wall time of taking samples."""
    return float(answer["core"]["seconds"])


def _median_and_quartiles(values: list[float], width: int) -> str:
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    return f"{middle:{width}.3f}{f'{low:.2f}-{high:.2f}':>13}"


if __name__ == "__main__":
    main()
