"""A diffuse surface of exactly a million triangles under an area light: the benchmark scene with a large mesh.

A relief of 800 x 625 squares, two triangles each, over 1.6 m x 1.25 m: eleven octaves of plane waves, each of
0.6 of the amplitude and 1.7 times the frequency of the one before, in directions that turn by the golden
angle. It is a closed formula, so every machine gets the same mesh without a file. A square lamp of 0.6 m
hangs to one side, turned down, so that the hills throw soft shadows; the camera looks down such that the
relief fills the image. Light that leaves the relief upward is lost, so paths are short, and what is measured
is tracing in a mesh that does not fit in the caches.

    python benches/million.py          # says what the scene holds
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from illuminant import Scene

COLUMNS, ROWS = 800, 625
SIZE_M = (1.6, 1.25)
LAMP_SIZE_M, LAMP_CENTER_M = 0.6, (-0.9, 0.6, -0.2)
LAMP_CD_M2 = 10_000.0


def relief() -> tuple[np.ndarray, np.ndarray]:
    """The mesh: positions (V, 3) float32 in metres, y up, and indices (1,000,000, 3) uint32, seen from above."""
    import numpy as np

    x = np.linspace(-SIZE_M[0] / 2, SIZE_M[0] / 2, COLUMNS + 1)
    z = np.linspace(-SIZE_M[1] / 2, SIZE_M[1] / 2, ROWS + 1)
    x, z = np.meshgrid(x, z)
    height = np.zeros_like(x)
    golden = np.pi * (3.0 - np.sqrt(5.0))
    for octave in range(11):
        frequency = 2.0 * np.pi * 1.1 * 1.7**octave
        angle = octave * golden
        height += 0.055 * 0.6**octave * np.sin(frequency * (np.cos(angle) * x + np.sin(angle) * z) + octave)
    positions = np.stack([x, height, z], axis=-1).reshape(-1, 3).astype(np.float32)

    corner = (np.arange(ROWS)[:, None] * (COLUMNS + 1) + np.arange(COLUMNS)[None, :]).ravel()
    below = corner + COLUMNS + 1
    indices = np.stack([corner, below, below + 1, corner, below + 1, corner + 1], axis=-1)
    return positions, indices.reshape(-1, 3).astype(np.uint32)


def lamp() -> tuple[np.ndarray, np.ndarray]:
    """The lamp: positions (4, 3) and indices (2, 3) of a square that faces down."""
    import numpy as np

    h = LAMP_SIZE_M / 2
    positions = np.array([[-h, 0, -h], [h, 0, -h], [h, 0, h], [-h, 0, h]]) + np.array(LAMP_CENTER_M)
    return positions.astype(np.float32), np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32)


def scene(size: tuple[int, int] = (256, 256)) -> Scene:
    """The scene, made from arrays: no file is read but the two spectra."""
    from illuminant import Scene

    positions, indices = relief()
    lamp_positions, lamp_indices = lamp()
    return Scene.build(
        title="A million triangles under an area light",
        camera={
            "eye": [0.0, 1.3, 0.9],
            "target": [0.0, 0.0, 0.12],
            "up": [0.0, 1.0, 0.0],
            "field_of_view": 33.0,
            "size": list(size),
        },
        materials={
            "stone": {"kind": "diffuse", "reflectance": "ColorChecker/light skin"},
            "lamp": {"kind": "emitter", "spectrum": "A", "luminance_cd_m2": LAMP_CD_M2},
        },
        objects={
            "relief": {"mesh": {"positions": positions, "faces": indices}, "material": "stone"},
            "lamp": {"mesh": {"positions": lamp_positions, "faces": lamp_indices}, "material": "lamp"},
        },
    )


if __name__ == "__main__":
    print(scene())
