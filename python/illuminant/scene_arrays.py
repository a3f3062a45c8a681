"""The arrays of a scene: what their names mean, and whether arrays from a file can be those of one.

| name | numbers | what |
| --- | --- | --- |
| `shape:N:sphere` | float64 (4,) | centre and radius |
| `shape:N:positions`, `:normals` | float32 (V, 3) | vertices of a mesh |
| `shape:N:uvs` | float32 (V, 2) | texture coordinates |
| `shape:N:indices` | uint32 (F, 3) | triangles |
| `placements` | uint32 (O,) | the shape of each object |
| `placement:O` | float64 (K, 3, 4) | transforms of an object over the shutter |
| `image:NAME` | float32 (h, w, c) | texture, environment or density |

Example:
    >>> import numpy as np
    >>> check({"placements": np.zeros(1, np.uint32), "placement:0": np.zeros((1, 3, 4))})
    Traceback (most recent call last):
    ValueError: an object has shape 0 of 0
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

__all__ = ["check"]

# Kind of number, and sides; None is any.
_SPHERE = ("float64", (4,))
_PARTS: dict[str, tuple[str, tuple[int | None, ...]]] = {
    "positions": ("float32", (None, 3)),
    "normals": ("float32", (None, 3)),
    "uvs": ("float32", (None, 2)),
    "indices": ("uint32", (None, 3)),
}
_PLACEMENTS = ("uint32", (None,))
_PLACEMENT = ("float64", (None, 3, 4))
_IMAGE = ("float32", (None, None, None))


def check(arrays: Mapping[str, np.ndarray]) -> None:
    """Refuse arrays that cannot be those of a scene; what their numbers mean is for the core to judge.

    Args:
        arrays: by name.

    Raises:
        ValueError: one is missing, unknown, or has other numbers or another shape than its name says.
    """
    shapes: dict[int, set[str]] = {}
    for name, array in arrays.items():
        kind, _, rest = name.partition(":")
        if kind == "shape":
            number, _, part = rest.partition(":")
            shapes.setdefault(int(number), set()).add(part)
            _fits(name, array, _SPHERE if part == "sphere" else _PARTS.get(part))
        elif kind == "placement":
            _fits(name, array, _PLACEMENT)
        elif kind == "image":
            _fits(name, array, _IMAGE)
        else:
            _fits(name, array, _PLACEMENTS if name == "placements" else None)
    for i, parts in shapes.items():
        if parts != {"sphere"} and not {"positions", "indices"} <= parts <= set(_PARTS):
            raise ValueError(f"shape {i} is neither a sphere nor a mesh")
    if "placements" not in arrays:
        raise ValueError("there are no placements")
    for i, shape in enumerate(arrays["placements"]):
        if shape >= len(shapes):
            raise ValueError(f"an object has shape {shape} of {len(shapes)}")
        if f"placement:{i}" not in arrays:
            raise ValueError(f"object {i} has no transform")


def _fits(name: str, array: np.ndarray, wanted: tuple[str, tuple[int | None, ...]] | None) -> None:
    if wanted is None:
        raise ValueError(f"{name} is no array of a scene")
    numbers, sides = wanted
    same = array.ndim == len(sides) and all(
        side in (None, n) for side, n in zip(sides, array.shape, strict=True)
    )
    if array.dtype != numbers or not same:
        raise ValueError(f"{name} has {array.dtype} {array.shape}")
