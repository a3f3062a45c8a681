"""Scanline techniques on 100,000 triangles at 1024x1024 with 4 spectral samples, beside path tracing.

    python benches/scanline.py

The aim for `gouraud` is 30 images a second on 2 cores. Corners are shaded ahead of the images, once for a camera at
rest; that time stands beside them.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

from illuminant.rendering import Job

SIZE, ROWS, COLUMNS = 1024, 224, 224

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


def main() -> None:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(SCENE, encoding="utf-8")
        (scene.parent / "ball.obj").write_text(ball(), encoding="utf-8")
        print("technique  model          ahead, s   images/s   of path")
        rates = {}
        for technique, model in (
            ("path", "general"),
            ("constant", "phong"),
            ("gouraud", "phong"),
            ("gouraud", "general"),
            ("phong", "phong"),
            ("phong", "general"),
        ):
            images = 16 if technique != "path" else 2
            begun = time.perf_counter()
            job = Job(
                str(scene),
                technique=technique,
                illumination=model,
                sampling="uniform:4",
                samples=images,
                depth=2,
            )
            ahead = time.perf_counter() - begun
            for _ in job.passes(None):
                pass
            rates[technique, model] = images / float(job.image().statistics["seconds"])
            ratio = rates[technique, model] / rates["path", "general"]
            print(f"{technique:<10} {model:<14} {ahead:8.2f} {rates[technique, model]:10.1f} {ratio:9.1f}")


if __name__ == "__main__":
    main()
