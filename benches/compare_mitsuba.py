"""Speed and noise beside Mitsuba 3, on the same scene, in the same run: prints a table.

    eval "$(benches/peers.sh)"
    .venv/bin/python benches/compare_mitsuba.py                      # both scenes, 5 runs each
    .venv/bin/python benches/compare_mitsuba.py cornell --runs 3 --reference-samples 1024
    .venv/bin/python benches/compare_mitsuba.py cornell-fl11 --reference 1nm    # bias counts

Each renderer is a process of its own that has loaded its scene and compiled its kernels; then runs alternate,
A B C A B C, and medians of seconds are taken, so that a slow minute of the machine falls on all.  Seconds are
those of rendering alone.  The error of each is measured against its own converged image of another seed (so a
difference of means, which has its own line, does not count as noise); with `--reference` against one converged
image for all, by illuminant with the sampling that is named, so that bias counts, and the mean dE00 of each
one's own converged image from that reference is printed.  Definitions: `error_measure.py`; converged images:
`converged.py`; conventions of the peer: `mitsuba_peer.py`.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import statistics
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from converged import converged, corrected
from error_measure import efficiency, largest_block_difference, mean_delta_e, relative_mse
from export_scene import export, resolve
from renderer_process import RendererProcess

BENCHES = Path(__file__).resolve().parent
BLOCK = 8
PEERS = {
    "spectral": ["--variant", "llvm_ad_spectral"],
    "rgb": ["--variant", "llvm_ad_rgb"],
    "spectral-multijitter": ["--variant", "llvm_ad_spectral", "--sampler", "multijitter"],
}


@dataclass
class Contender:
    """One renderer in the comparison, and what was measured of it."""

    name: str
    process: RendererProcess
    key: str
    # Its own converged image, and the one against which its error is measured.
    converged: np.ndarray = field(default_factory=lambda: np.zeros(0))
    reference: np.ndarray = field(default_factory=lambda: np.zeros(0))
    seconds: list[float] = field(default_factory=list)
    processor_seconds: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)
    peak_bytes: int = 0

    @property
    def median_seconds(self) -> float:
        """Median over the runs."""
        return statistics.median(self.seconds)

    @property
    def error(self) -> float:
        """Mean relative MSE over the runs."""
        return statistics.fmean(self.errors)


def main() -> None:
    """Compare on each scene that was named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "scenes",
        nargs="*",
        default=["cornell", "million"],
        help="cornell, cornell-fl11, million, or a scene file",
    )
    parser.add_argument("--size", type=int, default=256, help="width and height, pixels")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument(
        "--sampling",
        nargs="+",
        default=["fitted:8", "fitted:16", "uniform:32"],
        help="of illuminant, one row each; Mitsuba carries 4 wavelengths",
    )
    parser.add_argument("--depth", type=int, default=8, help="longest path in segments, in both")
    parser.add_argument("--rr-depth", type=int, default=5, help="of Mitsuba (its default is 5)")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--reference-samples", type=int, default=4096, help="of every converged image")
    parser.add_argument(
        "--reference",
        metavar="NAME",
        help="measure all against one converged image by illuminant with this sampling, such as 1nm",
    )
    parser.add_argument(
        "--carrier",
        metavar="NAME",
        default="fitted:16",
        help="the sampling that carries the samples of --reference; its error is corrected (converged.py)",
    )
    parser.add_argument(
        "--correction-samples", type=int, default=64, help="of --reference beside its carrier"
    )
    parser.add_argument("--peers", nargs="*", default=list(PEERS), choices=list(PEERS))
    parser.add_argument("--no-illuminant", action="store_true", help="the peers alone")
    parser.add_argument("--json", type=Path, help="write the numbers there too")
    options = parser.parse_args()
    if options.peers and "DRJIT_LIBLLVM_PATH" not in os.environ:
        sys.exit('compare_mitsuba.py: run  eval "$(benches/peers.sh)"  first')
    results = {name: _compare(name, options) for name in options.scenes}
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n")


def _compare(name: str, options: argparse.Namespace) -> list[dict[str, object]]:
    with tempfile.TemporaryDirectory() as folder:
        exported = Path(folder) / "scene.json"
        export(resolve(name, options.size), exported)
        contenders = _start(name, exported, options)
        try:
            for contender in contenders:
                contender.converged = converged(
                    contender.name, contender.key, contender.process, options.reference_samples
                )
            common = _common_reference(name, exported, options) if options.reference else None
            for contender in contenders:
                contender.reference = contender.converged if common is None else common
            _run(contenders, options, Path(folder))
        finally:
            for contender in contenders:
                contender.process.close()
    return _report(name, contenders, options)


def _start(name: str, exported: Path, options: argparse.Namespace) -> list[Contender]:
    """Start all, one after the other, and let each compile and touch its memory once."""
    scene = _digest(exported)
    contenders = [
        _start_illuminant(name, scene, sampling, options)
        for sampling in ([] if options.no_illuminant else options.sampling)
    ]
    peer = BENCHES.parent / ".venv-bench" / "bin" / "python"
    for label in options.peers:
        limits = ["--depth", str(options.depth), "--rr-depth", str(options.rr_depth)]
        limits += ["--threads", str(options.threads)]
        command = [str(peer), str(BENCHES / "mitsuba_peer.py"), str(exported), *PEERS[label], *limits]
        process = RendererProcess(command)
        version = str(process.opening["name"])
        # The sampler does not change what is converged to: its reference is that of its variant.
        variant = PEERS[label][1]
        contenders.append(
            Contender(f"Mitsuba {label}", process, " ".join([scene, version, variant, *limits]))
        )
    for contender in contenders:
        contender.process.render(seed=1, samples=options.samples)
    return contenders


def _start_illuminant(name: str, scene: str, sampling: str, options: argparse.Namespace) -> Contender:
    own = ["--size", str(options.size), "--sampling", sampling]
    own += ["--depth", str(options.depth), "--threads", str(options.threads)]
    process = RendererProcess([sys.executable, str(BENCHES / "illuminant_side.py"), name, *own])
    core = str(process.opening["core_sha256"])
    return Contender(f"illuminant {sampling}", process, " ".join([scene, core, *own]))


def _digest(exported: Path) -> str:
    return hashlib.sha256(exported.read_bytes() + exported.with_suffix(".npz").read_bytes()).hexdigest()


def _common_reference(name: str, exported: Path, options: argparse.Namespace) -> np.ndarray:
    """One converged image for all; `converged.py` says how its carrier saves time."""

    def image(sampling: str, samples: int) -> np.ndarray:
        one = _start_illuminant(name, _digest(exported), sampling, options)
        with one.process:
            return converged(one.name, one.key, one.process, samples)

    carried = image(options.carrier, options.reference_samples)
    if options.carrier == options.reference:
        return carried
    few = options.correction_samples
    return corrected(carried, image(options.reference, few), image(options.carrier, few))


def _run(contenders: list[Contender], options: argparse.Namespace, folder: Path) -> None:
    for run in range(options.runs):
        for contender in contenders:
            output = folder / "image.npy"
            answer = contender.process.render(seed=100 + run, samples=options.samples, output=output)
            contender.seconds.append(float(answer["seconds"]))
            contender.processor_seconds.append(float(answer["processor_seconds"]))
            contender.errors.append(relative_mse(np.load(output), contender.reference))
            contender.peak_bytes = int(answer["peak_bytes"])


def _report(name: str, contenders: list[Contender], options: argparse.Namespace) -> list[dict[str, object]]:
    count = options.size * options.size * options.samples
    judge = "each one's own converged image"
    if options.reference:
        judge = f"one image by illuminant {options.reference}"
    print(
        f"\n{name}: {options.size} x {options.size}, {options.samples} samples a pixel, "
        f"paths of {options.depth} segments, {options.threads} threads, {options.runs} runs; "
        f"errors against {judge}, {options.reference_samples} samples"
    )
    print(
        f"{'':30}{'seconds':>9}{'min-max':>13}{'CPU s':>8}{'Msamples/s':>12}{'rel. MSE':>10}{'efficiency':>12}"
        f"{'peak MB':>9}"
    )
    rows: list[dict[str, object]] = []
    for one in contenders:
        rate = count / one.median_seconds / 1e6
        value = efficiency(one.error, one.median_seconds)
        spread = f"{min(one.seconds):.2f}-{max(one.seconds):.2f}"
        print(
            f"{one.name:30}{one.median_seconds:9.3f}{spread:>13}{statistics.median(one.processor_seconds):8.2f}"
            f"{rate:12.3f}{one.error:10.5f}{value:12.1f}{one.peak_bytes / 1e6:9.0f}"
        )
        rows.append(
            {
                "scene": name,
                "renderer": one.name,
                "seconds": one.seconds,
                "processor_seconds": one.processor_seconds,
                "msamples_per_second": rate,
                "relative_mse": one.errors,
                "efficiency": value,
                "peak_bytes": one.peak_bytes,
                "mean_xyz": one.converged.mean(axis=(0, 1)).tolist(),
            }
        )
    if options.reference:
        _print_bias(contenders, rows)
    split = 0 if options.no_illuminant else len(options.sampling)
    for own in contenders[:split]:
        for peer in contenders[split:]:
            _print_ratios(own, peer)
    return rows


def _print_bias(contenders: list[Contender], rows: list[dict[str, object]]) -> None:
    """The distance of each converged image from the common reference; noise that is left in either counts too."""
    print(f"{'converged images':30}{'mean dE00':>10}{f'of {BLOCK}x{BLOCK} blocks':>16}{'mean X, Y, Z':>27}")
    for one, row in zip(contenders, rows, strict=True):
        pixels = mean_delta_e(one.converged, one.reference)
        blocks = mean_delta_e(one.converged, one.reference, BLOCK)
        x, y, z = (one.converged.mean(axis=(0, 1)) / one.reference.mean(axis=(0, 1)) - 1.0) * 100.0
        print(f"{one.name:30}{pixels:10.3f}{blocks:16.3f}{f'{x:+.2f} %, {y:+.2f} %, {z:+.2f} %':>27}")
        row |= {"mean_delta_e": pixels, "mean_delta_e_of_blocks": blocks}


def _print_ratios(own: Contender, peer: Contender) -> None:
    rate = peer.median_seconds / own.median_seconds
    value = efficiency(own.error, own.median_seconds) / efficiency(peer.error, peer.median_seconds)
    # Processor seconds tell more where other work shares the machine.
    work = statistics.median(peer.processor_seconds) / statistics.median(own.processor_seconds)
    x, y, z = (own.converged.mean(axis=(0, 1)) / peer.converged.mean(axis=(0, 1)) - 1.0) * 100.0
    block = largest_block_difference(own.converged, peer.converged) * 100.0
    print(
        f"{own.name} to {peer.name}: samples per second x {rate:.2f}, efficiency x {value:.2f} "
        f"(by processor time x {work:.2f}, x {work * peer.error / own.error:.2f}); "
        f"mean X {x:+.2f} %, Y {y:+.2f} %, Z {z:+.2f} %; largest block {block:.2f} %"
    )


if __name__ == "__main__":
    main()
