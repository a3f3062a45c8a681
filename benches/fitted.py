"""Seconds to choose wavelengths and weights for a scene (`fitted:N`), against the number of materials and lamps.

    .venv/bin/python benches/fitted.py

The scene is a grid of spheres, each of a material of its own (ColorChecker and CIE test colours, metals, glass with
absorption), under lamps of different spectra. Timed is all that a render does before its first path: following paths at
every nm, the fit, and the lanes; `uniform:N` in the same run is the same without the fit. Medians of five.
"""

from __future__ import annotations

import statistics
import time
from typing import Any

from illuminant import spectra
from illuminant.job import Job
from illuminant.scene import Scene

LAMPS = ("D65", "FL11", "A", "FL2", "LED-B3")
METALS = ("gold", "copper", "silver", "aluminium")


def scene(materials: int, lamps: int) -> Scene:
    """A grid of spheres over a floor."""
    paints = [name for name in spectra.names("reflectance") if name.startswith(("ColorChecker/", "TCS/"))]
    tables: dict[str, Any] = {"floor": {"kind": "diffuse", "reflectance": "ColorChecker/neutral 8"}}
    objects: dict[str, Any] = {
        "floor": {
            "material": "floor",
            "rectangle": {"corner": [-5, 0, 5], "edges": [[10, 0, 0], [0, 0, -10]]},
        }
    }
    for i in range(materials - 1):
        if i % 6 == 4:
            tables[f"m{i}"] = {"kind": "conductor", "metal": METALS[i // 6 % 4], "roughness": 0.2}
        elif i % 6 == 5:
            absorption = {"wavelengths_nm": [400, 550, 700], "values": [0.5 + i / 10, 1.0, 3.0 - i / 20]}
            tables[f"m{i}"] = {"kind": "dielectric", "n": 1.5, "absorption": absorption}
        else:
            tables[f"m{i}"] = {"kind": "diffuse", "reflectance": paints[i % len(paints)]}
        center = [i % 6 * 0.8 - 2.0, 0.35, i // 6 * 0.8 - 2.0]
        objects[f"m{i}"] = {"material": f"m{i}", "sphere": {"radius": 0.35, "center": center}}
    for i in range(lamps):
        tables[f"lamp{i}"] = {"kind": "emitter", "spectrum": LAMPS[i], "luminance_cd_m2": 5000.0}
        corner = [i * 1.5 - 3.0, 4.0, -0.5]
        objects[f"lamp{i}"] = {
            "material": f"lamp{i}",
            "rectangle": {"corner": corner, "edges": [[1, 0, 0], [0, 0, 1]]},
        }
    camera = {"eye": [0, 4, 6], "target": [0, 0, 0], "size": [480, 320], "field_of_view": 45}
    return Scene.build(camera=camera, objects=objects, materials=tables, lights={})


def seconds(made: Scene, sampling: str) -> float:
    """Median of five; the ray structure is there before."""
    times = []
    for _ in range(5):
        start = time.perf_counter()
        Job(made, sampling=sampling)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main() -> None:
    """Print the table."""
    print("| materials | lamps | " + " | ".join(f"`fitted:{n}`" for n in (4, 8, 12, 16)) + " | `uniform:8` |")
    print("| --- |" + " --- |" * 6)
    for materials, lamps in [(5, 1), (30, 1), (30, 2), (30, 3), (30, 5)]:
        made = scene(materials, lamps)
        Job(made, sampling="uniform:8")
        found = [seconds(made, f"fitted:{n}") for n in (4, 8, 12, 16)] + [seconds(made, "uniform:8")]
        print(f"| {materials} | {lamps} | " + " | ".join(f"{t:.2f}" for t in found) + " |", flush=True)


if __name__ == "__main__":
    main()
