"""Speed and noise beside Mitsuba 3, on the same scene, in the same run: prints a table.

    eval "$(benches/peers.sh)"
    .venv/bin/python benches/compare_mitsuba.py                      # both scenes, 5 runs each
    .venv/bin/python benches/compare_mitsuba.py cornell --runs 3 --reference-samples 1024

Each renderer is a process of its own that has loaded its scene and compiled its kernels; then runs alternate,
A B C A B C, and medians of seconds are taken, so that a slow minute of the machine falls on all.  Seconds are
those of rendering alone.  The error of each is measured against its own converged image of another seed (so a
difference of means, which has its own line, does not count as noise).  Definitions: `error_measure.py`;
conventions of the peer: `mitsuba_peer.py`.

References are kept in the temporary folder, keyed by scene, renderer and number of samples.
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

from error_measure import efficiency, largest_block_difference, relative_mse
from export_scene import export, resolve
from renderer_process import RendererProcess

BENCHES = Path(__file__).resolve().parent
CACHE = Path(tempfile.gettempdir()) / "illuminant-benches"
REFERENCE_SEED = 987_654
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
        "scenes", nargs="*", default=["cornell", "million"], help="cornell, million, or a scene file"
    )
    parser.add_argument("--size", type=int, default=256, help="width and height, pixels")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument(
        "--sampling",
        nargs="+",
        default=["uniform:8", "uniform:32"],
        help="of illuminant, one row each; Mitsuba carries 4 wavelengths",
    )
    parser.add_argument("--depth", type=int, default=8, help="longest path in segments, in both")
    parser.add_argument("--rr-depth", type=int, default=5, help="of Mitsuba (its default is 5)")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--reference-samples", type=int, default=4096)
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
    CACHE.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        exported = Path(folder) / "scene.json"
        export(resolve(name, options.size), exported)
        contenders = _start(name, exported, options)
        try:
            _references(contenders, options.reference_samples, Path(folder))
            _run(contenders, options, Path(folder))
        finally:
            for contender in contenders:
                contender.process.close()
    return _report(name, contenders, options)


def _start(name: str, exported: Path, options: argparse.Namespace) -> list[Contender]:
    """Start all, one after the other, and let each compile and touch its memory once."""
    scene = hashlib.sha256(exported.read_bytes() + exported.with_suffix(".npz").read_bytes()).hexdigest()
    contenders = []
    for sampling in [] if options.no_illuminant else options.sampling:
        own = ["--size", str(options.size), "--sampling", sampling]
        own += ["--depth", str(options.depth), "--threads", str(options.threads)]
        process = RendererProcess([sys.executable, str(BENCHES / "illuminant_side.py"), name, *own])
        core = str(process.opening["core_sha256"])
        contenders.append(Contender(f"illuminant {sampling}", process, " ".join([scene, core, *own])))
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


def _references(contenders: list[Contender], samples: int, folder: Path) -> None:
    for contender in contenders:
        digest = hashlib.sha256(f"{contender.key} {samples} {REFERENCE_SEED}".encode()).hexdigest()[:24]
        kept = CACHE / f"{digest}.npy"
        if not kept.exists():
            print(f"reference of {contender.name}, {samples} samples ...", file=sys.stderr, flush=True)
            fresh = folder / "reference.npy"
            contender.process.render(seed=REFERENCE_SEED, samples=samples, output=fresh)
            partial = kept.with_suffix(f".{os.getpid()}")
            partial.write_bytes(fresh.read_bytes())
            partial.rename(kept)
        contender.reference = np.load(kept)


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
    print(
        f"\n{name}: {options.size} x {options.size}, {options.samples} samples a pixel, "
        f"paths of {options.depth} segments, {options.threads} threads, {options.runs} runs, "
        f"references of {options.reference_samples} samples"
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
                "mean_xyz": one.reference.mean(axis=(0, 1)).tolist(),
            }
        )
    split = 0 if options.no_illuminant else len(options.sampling)
    for own in contenders[:split]:
        for peer in contenders[split:]:
            _print_ratios(own, peer)
    return rows


def _print_ratios(own: Contender, peer: Contender) -> None:
    rate = peer.median_seconds / own.median_seconds
    value = efficiency(own.error, own.median_seconds) / efficiency(peer.error, peer.median_seconds)
    # Processor seconds tell more where other work shares the machine.
    work = statistics.median(peer.processor_seconds) / statistics.median(own.processor_seconds)
    x, y, z = (own.reference.mean(axis=(0, 1)) / peer.reference.mean(axis=(0, 1)) - 1.0) * 100.0
    block = largest_block_difference(own.reference, peer.reference) * 100.0
    print(
        f"{own.name} to {peer.name}: samples per second x {rate:.2f}, efficiency x {value:.2f} "
        f"(by processor time x {work:.2f}, x {work * peer.error / own.error:.2f}); "
        f"mean X {x:+.2f} %, Y {y:+.2f} %, Z {z:+.2f} %; largest block {block:.2f} %"
    )


if __name__ == "__main__":
    main()
