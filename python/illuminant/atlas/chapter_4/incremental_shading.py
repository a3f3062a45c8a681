"""Single bodies on which incremental shading shows its anomalies, and how they are rendered (book 4.2.4).

A square of n × n cells of two triangles each, tipped backwards, and a cylinder of n faces whose corners have the
normals of the round one. One lamp lights them; ambient light is off, so what is seen is the model alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.image import Image
    from illuminant.scene import Scene

__all__ = ["cylinder", "lit", "shaded", "square"]

MATERIALS: dict[str, Any] = {
    "chalk": {"kind": "diffuse", "reflectance": 0.8},
    "plastic": {"kind": "coated", "roughness": 0.12, "pigment": "ColorChecker/blue"},
}


def square(cells: int, tilt_deg: float = 0.0) -> dict[str, Any]:
    """A mesh: a square of side 2 in cells × cells, its upper edge tipped away from +z."""
    import numpy as np

    c, s = np.cos(np.radians(tilt_deg)), np.sin(np.radians(tilt_deg))
    y, x = np.meshgrid(*[np.linspace(-1.0, 1.0, cells + 1)] * 2, indexing="ij")
    positions = np.stack([x, y * c, -y * s], axis=-1).reshape(-1, 3)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, above = first + 1, first + cells + 1
    faces = np.concatenate([np.stack([first, right, above + 1], 1), np.stack([first, above + 1, above], 1)])
    return {"positions": positions, "normals": np.tile([0.0, s, c], (len(positions), 1)), "faces": faces}


def cylinder(faces: int) -> dict[str, Any]:
    """A mesh: a cylinder of radius 1 along y without ends, a corner in the middle of what the eye at +z sees."""
    import numpy as np

    angle = 2.0 * np.pi * np.arange(faces) / faces
    normals = np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=-1)
    half = np.array([0.0, 1.0, 0.0])
    low = np.arange(faces)
    next_low = (low + 1) % faces
    return {
        "positions": np.concatenate([normals - half, normals + half]),
        "normals": np.concatenate([normals, normals]),
        "faces": np.concatenate(
            [
                np.stack([low, next_low, next_low + faces], 1),
                np.stack([low, next_low + faces, low + faces], 1),
            ]
        ),
    }


def lit(
    thing: dict[str, Any],
    light: dict[str, Any],
    *,
    size: int,
    material: str = "chalk",
    eye: tuple[float, float, float] = (0.0, 0.0, 6.0),
    field_of_view: float = 22.0,
    **camera: Any,
) -> Scene:
    """A scene of one body under one lamp, seen from `eye` towards the origin, in `size` × `size` pixels.

    Args:
        thing: the table of an object, without its material.
        light: the table of a light, without its spectrum.
        size: pixels along each side.
        material: "chalk", a diffuser, or "plastic", with a highlight.
        eye: where the camera stands.
        field_of_view: degrees.
        camera: further keys of the table `[camera]`.
    """
    from illuminant.scene import Scene

    return Scene.build(
        camera={
            "eye": eye,
            "target": [0.0, 0.0, 0.0],
            "field_of_view": field_of_view,
            "size": [size, size],
            **camera,
        },
        objects={"thing": thing | {"material": material}},
        materials={material: MATERIALS[material]},
        lights={"key": {"spectrum": "D65", **light}},
    )


def shaded(scene: Scene, technique: str, illumination: str = "bouknight", **options: Any) -> Image:
    """One evaluation in the middle of every pixel, without ambient light."""
    from illuminant.rendering import render

    # Samples lie all over a pixel; a filter this narrow takes what its middle shows.
    still: dict[str, Any] = {"samples": 1, "ambient": 0.0, "filter": ("box", 1e-3), "sampling": "fitted:8"}
    return render(scene, technique=technique, illumination=illumination, **still | options)
