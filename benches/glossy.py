"""Speed and noise on a glossy scene beside Mitsuba 3 and LuxCore; what soft shadows, gloss and a lens cost.

    eval "$(benches/peers.sh)"
    .venv/bin/python benches/glossy.py [--runs 3] [--samples 64] [--converged 4096]

Definitions are those of `docs/benchmarks.md`. Each renderer is a process of its own, runs alternate, seconds are the
median, and errors are against the renderer's own converged image of another seed.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

import numpy as np

import illuminant
from converged import converged
from error_measure import efficiency, relative_mse
from illuminant.scene import Scene
from renderer_process import RendererProcess

BENCHES = Path(__file__).resolve().parent
PEERS = BENCHES.parent / ".venv-bench" / "bin" / "python"


def beside_peers(runs: int, samples: int, reference: int) -> None:
    """The table of renderers."""
    commands = {
        "illuminant": [str(BENCHES.parent / ".venv" / "bin" / "python"), "illuminant"],
        "Mitsuba": [str(PEERS), "mitsuba"],
        "LuxCore": [str(PEERS), "luxcore"],
    }
    sides = {
        name: RendererProcess([python, str(BENCHES / "glossy_side.py"), side])
        for name, (python, side) in commands.items()
    }
    images = {
        name: converged(name, f"glossy {name} {process.opening['version']}", process, reference)
        for name, process in sides.items()
    }
    seconds: dict[str, list[float]] = {name: [] for name in sides}
    errors: dict[str, list[float]] = {name: [] for name in sides}
    rays: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "image.npy"
        for run in range(runs):
            for name, process in sides.items():
                answer = process.render(seed=run + 1, samples=samples, output=output)
                seconds[name].append(answer["seconds"])
                errors[name].append(relative_mse(np.load(output), images[name]))
                rays[name] = answer.get("rays", float("nan")) / answer["seconds"] / 1e6
    print(f"{'':12}{'seconds':>9}{'Msamples/s':>12}{'Mrays/s':>9}{'rel. MSE':>10}{'efficiency':>12}")
    for name, process in sides.items():
        pixels = process.opening["width"] * process.opening["height"]
        time, error = statistics.median(seconds[name]), statistics.mean(errors[name])
        print(
            f"{name:12}{time:9.2f}{pixels * samples / time / 1e6:12.2f}{rays[name]:9.2f}{error:10.5f}"
            f"{efficiency(error, time):12.1f}"
        )
        process.close()


def hall(soft: bool) -> Scene:
    """Three balls under a lamp: polished, a lamp without size and a pinhole; or rough, an area and a lens."""
    rough = 0.2 if soft else 0.0
    objects = {
        "floor": {"rectangle": {"corner": [-4, 0, 4], "edges": [[8, 0, 0], [0, 0, -8]]}, "material": "floor"},
    }
    for i, x in enumerate((-1.3, 0.0, 1.3)):
        objects[f"ball {i}"] = {"sphere": {"center": [x, 0.6, -0.5 * i], "radius": 0.6}, "material": "metal"}
    lights = {}
    if soft:
        objects["lamp"] = {
            "rectangle": {"corner": [-1, 4, -1], "edges": [[2, 0, 0], [0, 0, 2]]},
            "material": "lamp",
        }
    else:
        lights["key"] = {"kind": "point", "position": [0, 4, 0], "spectrum": "D65", "intensity_cd": 4000.0}
    camera = {"eye": [0, 1.6, 5], "target": [0, 0.5, 0], "size": [256, 192], "field_of_view": 40.0}
    return Scene.build(
        camera=camera | ({"focal_length_mm": 50.0, "f_number": 1.4, "focus_distance": 5.0} if soft else {}),
        objects=objects,
        materials={
            "floor": {"kind": "diffuse", "reflectance": 0.5},
            "metal": {"kind": "conductor", "metal": "copper", "roughness": rough},
            "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 1000.0},
        },
        lights=lights,
    )


def soft_against_plain(runs: int, samples: int) -> None:
    """What soft shadows, gloss and depth of field together cost."""
    scenes = {"plain": hall(False), "soft": hall(True)}
    for technique in ("distributed", "path"):
        times: dict[str, list[float]] = {name: [] for name in scenes}
        for run in range(runs):
            for name, scene in scenes.items():
                image = illuminant.render(
                    scene, technique=technique, samples=samples, depth=8, seed=run, ambient=0.0
                )
                times[name].append(image.statistics["seconds"])
        plain, soft = (statistics.median(times[name]) for name in ("plain", "soft"))
        print(
            f"{technique:12} plain {plain:.2f} s, with soft shadows, gloss and depth of field {soft:.2f} s: "
            f"ratio {soft / plain:.2f} (aim: below 1.5)"
        )


def main() -> None:
    """Print both."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--converged", type=int, default=4096)
    options = parser.parse_args()
    beside_peers(options.runs, options.samples, options.converged)
    print()
    soft_against_plain(options.runs, options.samples)


if __name__ == "__main__":
    main()
