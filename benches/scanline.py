"""Scanline techniques on 100,000 triangles at 1024x1024 with 4 spectral samples, beside path tracing.

    python benches/scanline.py

The aim for `gouraud` is 30 images a second on 2 cores. Corners are shaded ahead of the images, once for a camera at
rest; that time stands beside them. The fast forms of Phong's shading stand beside the full one, with their error (the
largest one of Y relative to the largest Y).
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from error_measure import mean_delta_e
from illuminant.job import Job

ROWS, COLUMNS = 224, 224
SAMPLING = "uniform:4"
IMAGES, RUNS = 64, 5  # the best of so many runs: other work on the machine only ever costs time

SCENE = """
[camera]
eye = [0, 0, 4]
target = [0, 0, 0]
field_of_view = 32
size = [1024, 1024]

[lights.key]
kind = "point"
position = [3, 4, 5]
spectrum = "D65"
intensity_cd = 2000

[materials]
"paint" = { kind = "coated", roughness = 0.15, pigment = "ColorChecker/blue" }

[objects]
"ball" = { material = "paint", mesh = "ball.obj" }
"""


def ball() -> str:
    """A ball as a mesh with normals."""
    theta, phi = np.meshgrid(
        np.linspace(0, np.pi, ROWS + 1), np.linspace(0, 2 * np.pi, COLUMNS + 1), indexing="ij"
    )
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(
        -1, 3
    )
    lines = [f"v {x:.7f} {y:.7f} {z:.7f}" for x, y, z in points]
    lines += [f"vn {x:.7f} {y:.7f} {z:.7f}" for x, y, z in points]
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column + 1
            b, c, d = a + COLUMNS + 1, a + COLUMNS + 2, a + 1
            # At the poles one of the two has no area.
            if row + 1 < ROWS:
                lines.append(f"f {a}//{a} {b}//{b} {c}//{c}")
            if row > 0:
                lines.append(f"f {a}//{a} {c}//{c} {d}//{d}")
    return "\n".join(lines)


def measured(scene: Path, technique: str, model: str, images: int, shading: str = "full") -> dict[str, Any]:
    """A render: its image, seconds ahead, and images and spans a second, by the clock and by processor time.

    By processor time is what two cores would give that do nothing else.
    """
    begun = time.perf_counter()
    job = Job(
        str(scene),
        technique=technique,
        illumination=model,
        sampling=SAMPLING,
        samples=images,
        depth=2,
        shading=shading,
    )
    ahead = time.perf_counter() - begun
    busy = time.process_time()
    for _ in job.passes(None):
        pass
    busy = time.process_time() - busy
    image = job.image()
    seconds = float(image.statistics["seconds"])
    spans = int(job.core_render.statistics()["spans"])
    return {
        "xyz": image.xyz,
        "ahead": ahead,
        "rate": images / seconds,
        "busy": images / (busy / 2),
        "spans": spans / seconds,
    }


def main() -> None:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(SCENE, encoding="utf-8")
        (scene.parent / "ball.obj").write_text(ball(), encoding="utf-8")
        print("| technique | model | ahead, s | images/s | by processor time | million spans/s | of path |")
        print("| --- | --- | --- | --- | --- | --- | --- |")
        path = measured(scene, "path", "general", 2)
        print(f"| path | general | {path['ahead']:.2f} | {path['rate']:.1f} | {path['busy']:.1f} | | 1 |")
        for technique, model in (
            ("constant", "phong"),
            ("gouraud", "phong"),
            ("gouraud", "general"),
            ("phong", "phong"),
            ("phong", "general"),
        ):
            found = max(
                (measured(scene, technique, model, IMAGES) for _ in range(RUNS)), key=lambda m: m["rate"]
            )
            print(
                f"| {technique} | {model} | {found['ahead']:.2f} | {found['rate']:.1f} | {found['busy']:.1f} | "
                f"{found['spans'] / 1e6:.1f} | {found['rate'] / path['rate']:.0f} |"
            )
        print()
        print("| shading | model | images/s | by processor time | mean ΔE00 | largest error of Y |")
        print("| --- | --- | --- | --- | --- | --- |")
        for model in ("bouknight", "phong"):
            full = None
            for shading in ("full", "duff", "bishop-weimer"):
                found = measured(scene, "phong", model, 16, shading)
                full = found["xyz"] if full is None else full
                apart = np.abs(found["xyz"] - full)[..., 1].max() / full[..., 1].max()
                print(
                    f"| {shading} | {model} | {found['rate']:.1f} | {found['busy']:.1f} | "
                    f"{mean_delta_e(found['xyz'], full):.4f} | {apart:.1e} |"
                )


if __name__ == "__main__":
    main()
