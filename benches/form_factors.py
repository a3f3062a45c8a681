"""Form factors of each method against closed forms, over resolution: a table for docs/radiosity.md.

    .venv/bin/python benches/form_factors.py

The walls of a box of 3 × 2 × 1 m see each other by the closed forms of parallel and perpendicular rectangles (Hottel
1931). Errors are relative, RMS and largest over the 30 pairs; closure is the mean of |1 − Σ F| over elements. Needs
only `.venv`.
"""

from __future__ import annotations

import math
import time

import numpy as np

from illuminant import Scene, radiosity

SIZE = (3.0, 2.0, 1.0)
ELEMENTS = 900
METHODS = ("rays", "hemicube", "scanline", "area")
NUMBERS = {
    "rays": (64, 256, 1024, 4096),
    "hemicube": (16, 32, 64, 128),
    "scanline": (16, 32, 64, 128),
    "area": (1, 4, 16),
}


def parallel(a: float, b: float, c: float) -> float:
    """Two opposed rectangles a × b at the distance c."""
    x, y = a / c, b / c
    p, q = math.sqrt(1 + x * x), math.sqrt(1 + y * y)
    logarithm = math.log(p * q / math.sqrt(1 + x * x + y * y))
    angles = x * q * math.atan(x / q) + y * p * math.atan(y / p) - x * math.atan(x) - y * math.atan(y)
    return 2 / (math.pi * x * y) * (logarithm + angles)


def perpendicular(a: float, b: float, c: float) -> float:
    """A rectangle a × b to one a × c along their common edge a."""
    h, w = c / a, b / a
    both = h * h + w * w
    logarithms = (
        math.log((1 + w * w) * (1 + h * h) / (1 + both))
        + w * w * math.log(w * w * (1 + both) / ((1 + w * w) * both))
        + h * h * math.log(h * h * (1 + both) / ((1 + h * h) * both))
    )
    angles = w * math.atan(1 / w) + h * math.atan(1 / h) - math.sqrt(both) * math.atan(1 / math.sqrt(both))
    return (angles + logarithms / 4) / (math.pi * w)


def exact(i: int, j: int) -> float:
    """From wall i to wall j; walls are pairs along z, y and x."""
    a, b = 2 - i // 2, 2 - j // 2
    if a == b:
        return parallel(SIZE[(a + 1) % 3], SIZE[(a + 2) % 3], SIZE[a])
    return perpendicular(SIZE[3 - a - b], SIZE[b], SIZE[a])


def box() -> Scene:
    """The box from inside, with a lamp without size in it."""
    x, y, z = (np.eye(3)[k] * SIZE[k] for k in range(3))
    walls = [(0 * x, x, y), (z, y, x), (0 * x, z, x), (y, x, z), (0 * x, y, z), (x, z, y)]
    objects = {
        f"wall {k}": {"rectangle": {"corners": [c, c + a, c + a + b, c + b]}, "material": "paint"}
        for k, (c, a, b) in enumerate(walls)
    }
    return Scene.build(
        camera={"eye": [1, 1, 0.5], "target": [2, 1, 0.5], "size": [16, 16]},
        materials={"paint": {"kind": "diffuse", "reflectance": 0.5}},
        objects=objects,
        lights={"lamp": {"kind": "point", "position": [1.5, 1.0, 0.5], "spectrum": "E", "intensity_cd": 1.0}},
    )


def main() -> None:
    """Print the table."""
    scene = box()
    print("| form factors | RMS error | largest error | closure | seconds |")
    print("| --- | --- | --- | --- | --- |")
    for method in METHODS:
        for number in NUMBERS[method]:
            begun = time.monotonic()
            solution = radiosity.solve(
                scene, elements=ELEMENTS, form_factors=f"{method}:{number}", sampling="uniform:8"
            )
            seconds = time.monotonic() - begun
            parts, mesh = solution._core.parts(), solution.mesh()
            rows = np.repeat(np.arange(len(mesh.areas)), np.diff(parts["starts"].astype(int)))
            wall_of_patch = np.zeros(mesh.patches.max() + 1, int)
            wall_of_patch[mesh.patches] = mesh.objects
            found = np.zeros((6, 6))
            weights = parts["values"] * mesh.areas[rows]
            np.add.at(found, (mesh.objects[rows], wall_of_patch[parts["columns"]]), weights)
            found /= np.bincount(mesh.objects, mesh.areas)[:, None]
            errors = np.array([found[i, j] / exact(i, j) - 1 for i in range(6) for j in range(6) if i != j])
            print(
                f"| `{method}:{number}` | {100 * np.sqrt((errors**2).mean()):.3f} % "
                f"| {100 * np.abs(errors).max():.3f} % | {100 * solution.report['closure_mean']:.3f} % "
                f"| {seconds:.2f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
