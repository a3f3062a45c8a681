"""The rate of rays against raw Embree on the same kind of rays: prints a table (aim: 80 %).

    .venv/bin/python benches/embree_limit.py                  # both scenes, about two minutes

`embree_limit.rs` follows diffuse paths through the scene and records every query in the order of a path
tracer, then asks Embree those queries again with nothing else around them: that is the limit of a renderer
that traces single rays. illuminant then renders the same scene with the same depth, and its rays per second
(of `statistics["rays"]`) are divided by the limit's. Runs alternate, medians count.

The rays are those of a path tracer of its own, not of illuminant: same camera, same geometry, cosine-
distributed bounces, one shadow ray a vertex. illuminant chooses points on lamps by solid angle and may end
paths elsewhere, so queries per sample are printed for both. `--rays FILE` takes recorded queries instead
(records of eight 32-bit words: origin, direction, far, kind; see `Query` in `embree_limit.rs`).

Needs rustc (no crate is fetched) and the Embree of the wheel `embreex`.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from export_scene import export, resolve
from renderer_process import RendererProcess

BENCHES = Path(__file__).resolve().parent


def main() -> None:
    """Print the table of each scene."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "scenes", nargs="*", default=["cornell", "million"], help="cornell, million, or a scene file"
    )
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, default=64, help="of illuminant")
    parser.add_argument(
        "--recorded-samples", type=int, default=8, help="samples a pixel whose queries are recorded"
    )
    parser.add_argument("--sampling", default="uniform:8")
    parser.add_argument("--depth", type=int, default=8, help="longest path in segments")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--rays", type=Path, help="recorded queries, instead of the program's own")
    parser.add_argument("--no-illuminant", action="store_true", help="the limit alone")
    options = parser.parse_args()
    program = _compile()
    for name in options.scenes:
        _measure(name, program, options)


def _compile() -> Path:
    program = BENCHES.parent / "target" / "benches" / "embree_limit"
    source = BENCHES / "embree_limit.rs"
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        program.parent.mkdir(parents=True, exist_ok=True)
        command = ["rustc", "--edition", "2024", "-C", "opt-level=3", "-C", "target-cpu=native"]
        subprocess.run([*command, str(source), "-o", str(program)], check=True)
    return program


def _measure(name: str, program: Path, options: argparse.Namespace) -> None:
    from illuminant.embree import find

    with tempfile.TemporaryDirectory() as folder:
        exported, scene = Path(folder) / "scene.json", Path(folder) / "scene.bin"
        export(resolve(name, options.size), exported)
        scene.write_bytes(packed(exported, options.recorded_samples, options.depth))
        rays = options.rays
        if rays is None:
            rays = Path(folder) / "rays.bin"
            subprocess.run([str(program), "record", str(find()), str(scene), str(rays)], check=True)
        trace = [str(program), "trace", str(find()), str(scene), str(rays), str(options.threads)]

        own: list[float] = []
        per_sample = 0.0
        limits: dict[tuple[str, int], list[float]] = {}
        counts: dict[str, int] = {}
        side = None
        if not options.no_illuminant:
            command = [sys.executable, str(BENCHES / "illuminant_side.py"), name, "--size", str(options.size)]
            command += ["--sampling", options.sampling, "--depth", str(options.depth)]
            side = RendererProcess([*command, "--threads", str(options.threads)])
            side.render(seed=0, samples=options.samples)
        for run in range(options.runs):
            for robust in (0, 1):
                lines = subprocess.run([*trace, str(robust), "1"], check=True, capture_output=True, text=True)
                for line in lines.stdout.splitlines():
                    kind, count, _, seconds = line.split()
                    counts[kind] = int(count)
                    limits.setdefault((kind, robust), []).append(float(seconds))
            if side is not None:
                answer = side.render(seed=run, samples=options.samples)
                own.append(answer["core"]["rays"] / answer["seconds"] / 1e6)
                per_sample = answer["core"]["rays"] / (options.size**2 * options.samples)
        if side is not None:
            side.close()

    samples = options.size**2 * options.recorded_samples
    print(
        f"\n{name}: {options.size} x {options.size}, paths of {options.depth} segments, {options.threads} threads"
    )
    print(f"{'raw Embree':>14}{'per sample':>12}{'Mray/s':>10}{'robust Mray/s':>15}")
    for kind, count in counts.items():
        fast, robust = (count / statistics.median(limits[kind, flag]) / 1e6 for flag in (0, 1))
        print(f"{kind:>14}{count / samples:12.2f}{fast:10.2f}{robust:15.2f}")
    if own:
        rate = statistics.median(own)
        fast, robust = (counts["all"] / statistics.median(limits["all", flag]) / 1e6 for flag in (0, 1))
        print(f"{'illuminant':>14}{per_sample:12.2f}{rate:10.2f}")
        print(
            f"illuminant / raw Embree: {rate / fast * 100:.0f} %, of robust queries {rate / robust * 100:.0f} %"
        )


def packed(exported: Path, samples: int, depth: int) -> bytes:
    """The scene as `embree_limit.rs` reads it (its first page says how)."""
    description: dict[str, Any] = json.loads(exported.read_text())
    camera = description["camera"]
    width, height = camera["size"]
    eye, target, up = (np.asarray(camera[key], dtype=np.float64) for key in ("eye", "target", "up"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    pixel = 2.0 * np.tan(np.radians(camera["field_of_view_deg"]) / 2.0) / width
    corner = forward - right * pixel * width / 2.0 - down * pixel * height / 2.0
    parts = [np.array([width, height, samples, depth], dtype="<u4").tobytes()]
    parts.append(np.array([eye, corner, right * pixel, down * pixel], dtype="<f4").tobytes())
    parts.append(np.array([len(description["objects"])], dtype="<u4").tobytes())
    with np.load(exported.with_suffix(".npz")) as stored:
        for number, object_ in enumerate(description["objects"]):
            positions, indices = stored[f"positions_{number}"], stored[f"indices_{number}"]
            reflectance = np.mean(description["curves"][object_["reflectance"]])
            parts.append(np.array([len(positions), len(indices)], dtype="<u4").tobytes())
            parts.append(np.array([reflectance], dtype="<f4").tobytes())
            parts.append(np.array([object_["radiance"] is not None], dtype="<u4").tobytes())
            parts.append(np.ascontiguousarray(positions, dtype="<f4").tobytes())
            parts.append(np.ascontiguousarray(indices, dtype="<u4").tobytes())
    return b"".join(parts)


if __name__ == "__main__":
    main()
