"""Many lamps: time of a sample with 10,000 emitters against 10, and how noisy it is.

Both halls have the same area of lamps and the same flux in all: squares under the ceiling, so only their number
differs.

    python benches/many_lamps.py
"""

from __future__ import annotations

import argparse
import time

import numpy as np

import illuminant
from illuminant.scene import Scene


def room(count: int, size: int) -> Scene:
    """A hall of 100 m by 100 m under so many square lamps, seen from the middle."""
    side = round(np.sqrt(count))
    rng = np.random.default_rng(1)
    area = 100.0
    edge = float(np.sqrt(area / count))
    objects = {
        "floor": {
            "rectangle": {"corner": [-50, 0, 50], "edges": [[100, 0, 0], [0, 0, -100]]},
            "material": "grey",
        }
    }
    for i in range(count):
        x, z = (
            (i % side + rng.uniform(0.2, 0.8)) / side * 100 - 50,
            (i // side + rng.uniform(0.2, 0.8)) / side * 100 - 50,
        )
        objects[f"lamp {i}"] = {
            "rectangle": {"corner": [x, 4.0, z], "edges": [[edge, 0, 0], [0, 0, edge]]},
            "material": "lamp",
        }
    return Scene.build(
        camera={"eye": [0, 1.7, 20], "target": [0, 0.5, 0], "size": [size, size // 2], "field_of_view": 60.0},
        objects=objects,
        materials={
            "grey": {"kind": "diffuse", "reflectance": 0.5},
            "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 1000.0},
        },
    )


def main() -> None:
    """Prints both times, their ratio and the noise."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    times = {}
    for count in (10, 10_000):
        scene = room(count, options.size)
        render = {"sampling": "uniform:8", "depth": 2, "samples": options.samples}
        start = time.perf_counter()
        illuminant.render(scene, **render | {"samples": 1})
        ready = time.perf_counter() - start
        runs = []
        for seed in range(options.runs):
            image = illuminant.render(scene, seed=seed, **render)
            # Of the samples alone: a scene is made ready once for all of them.
            runs.append((image.statistics["seconds"], np.asarray(image.xyz, float)[..., 1]))
        seconds = [image for image, _ in runs]
        times[count] = min(seconds) / (options.size * (options.size // 2) * options.samples) * 1e9
        floor = np.stack([y for _, y in runs])[:, options.size // 4 + 20 :]
        noise = floor.std(axis=0, ddof=1).mean() / floor.mean()
        print(
            f"{count:>6} lamps: {times[count]:7.0f} ns a sample, "
            f"noise {100 * noise:.2f} % of the mean at {options.samples} samples, first image after {ready:.1f} s"
        )
    print(f"ratio of times: {times[10_000] / times[10]:.2f} (aim: 2)")


if __name__ == "__main__":
    main()
