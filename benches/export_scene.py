"""A resolved scene as plain numbers, so that a peer renders exactly what illuminant renders.

    .venv/bin/python benches/export_scene.py cornell cornell.json        # writes cornell.json and cornell.npz

The JSON holds `range` (nm), `camera` (eye, target, up, field of view across the width in degrees, size),
`curves` (each a list of values at every whole nm of the range), and `objects`: name, `reflectance` (number of
a curve) and `radiance` (None, or a curve and the scale that makes it W/(sr m2 nm)). The npz holds
`positions_I` (V, 3) float32 in metres in the world and `indices_I` (F, 3) uint32 of object I.

Only what every peer can say is exported: triangle meshes, diffuse materials, lamps that are objects. Anything
else is refused with a sentence. The quantity of a lamp becomes radiance as the scene's conventions say:
luminance by 683 lm/W times the 1 nm sum with y-bar; power and flux over area times pi (over both sides if
both shine).
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

    from illuminant import Scene

SCENES = Path(__file__).resolve().parent.parent / "scenes"


def resolve(name: str, size: int) -> Scene:
    """The scene of that name (cornell, million, or the path of a scene file) with a square image of that size."""
    from illuminant import Scene

    if name == "million":
        from million import scene

        return scene((size, size))
    path = Path(name) if name.endswith(".toml") else SCENES / f"{name}.toml"
    return Scene.load(path).replace(camera={"size": [size, size]})


def export(scene: Scene, path: Path) -> None:
    """Write the scene to `path` (.json) and beside it (.npz).

    Raises:
        ValueError: the scene holds something that a peer may not have; says what.
    """
    import numpy as np

    description = scene.description
    if description["lights"]:
        raise ValueError(
            f"light {description['lights'][0]['name']!r}: only lamps that are objects are exported"
        )
    first, last = (round(end) for end in description["range"])
    grid = np.arange(first, last + 1)
    curves = [_tabulated(curve, grid) for curve in description["curves"]]
    shapes, objects, arrays = scene.shapes(), [], {}
    for number, ((shape, transforms), object_) in enumerate(
        zip(scene.placements(), description["objects"], strict=True)
    ):
        material = description["materials"][object_["material"]]["surface"]
        if shapes[shape]["kind"] != "mesh" or material["kind"] != "diffuse":
            raise ValueError(f"object {object_['name']!r}: only diffuse meshes are exported")
        linear, shift = transforms[0][:, :3], transforms[0][:, 3]
        positions = (shapes[shape]["positions"] @ linear.T + shift).astype(np.float32)
        arrays[f"positions_{number}"] = positions
        arrays[f"indices_{number}"] = shapes[shape]["indices"]
        radiance = None
        if object_["emission"] is not None:
            emission = object_["emission"]
            area = _area(positions, shapes[shape]["indices"])
            radiance = {
                "curve": emission["spectrum"],
                "scale": _scale(emission, curves[emission["spectrum"]], grid, area),
            }
            if emission["sides"] != "front":
                raise ValueError(
                    f"object {object_['name']!r}: a lamp that shines on both sides is not exported"
                )
        objects.append(
            {"name": object_["name"], "reflectance": material["reflectance"], "radiance": radiance}
        )
    camera = {key: description["camera"][key] for key in ("eye", "target", "up", "field_of_view_deg", "size")}
    exported = {
        "range": [first, last],
        "camera": camera,
        "curves": [curve.tolist() for curve in curves],
        "objects": objects,
    }
    path.write_text(json.dumps(exported))
    np.savez(path.with_suffix(".npz"), **arrays)


def _tabulated(curve: dict[str, Any], grid: np.ndarray) -> np.ndarray:
    import numpy as np

    end = 0.0 if curve["outside"] == "zero" else None
    return np.interp(grid, curve["wavelengths"], curve["values"], left=end, right=end)


def _scale(emission: dict[str, Any], curve: np.ndarray, grid: np.ndarray, area: float) -> float:
    """The factor from the curve to spectral radiance in W/(sr m2 nm)."""
    from illuminant.core import core

    kind, value = emission["quantity"]["kind"], emission["quantity"]["value"]
    if kind == "radiance_scale":
        return float(value)
    if kind == "power_w":
        return float(value / (curve.sum() * area * math.pi))
    luminance = float(core().xyz(grid.astype(float), curve, "zero")[1])
    if kind == "luminance_cd_m2":
        return float(value / luminance)
    if kind == "flux_lm":
        return float(value / (luminance * area * math.pi))
    raise ValueError(f"a lamp given by {kind} is not exported")


def _area(positions: np.ndarray, indices: np.ndarray) -> float:
    import numpy as np

    a, b, c = (positions[indices[:, corner]].astype(float) for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: export_scene.py SCENE OUTPUT.json")
    export(resolve(sys.argv[1], 256), Path(sys.argv[2]))
