"""The peer: Mitsuba 3 renders a scene that `export_scene.py` wrote (runs in `.venv-bench`).

    .venv-bench/bin/python benches/mitsuba_peer.py scene.json --variant llvm_ad_spectral

It takes the very same numbers as illuminant: triangles in world space, the camera, and every curve at 1 nm
between the ends of the scene's spectral range (zero outside it). Only what both can say is used: diffuse
materials and area lights of absolute spectral radiance.

Conventions of Mitsuba 3 and what is done about them:

* Its spectral film holds XYZ = (integral of L * cmf) / K with K = 106.7502593994140625, the integral of its
  own 5 nm table of y-bar (`MI_CIE_Y_NORMALIZATION` in `include/mitsuba/core/spectrum.h`); illuminant's images
  hold 683 lm/W times the integral. Hence absolute XYZ = 683 * 106.7502593994140625 * film: derived, never
  fitted.
* Its `max_depth` counts the edges of a path, camera ray included: 2 is direct light. `--depth` here counts
  the same way.
* Russian roulette starts at `rr_depth` (default 5) with probability min(0.95, largest throughput).
* `llvm_ad_rgb` cannot carry a curve: colours are made by `mitsuba.spectrum_list_to_srgb`, as its own scene
  loader does (reflectances under D65, radiance unbounded). Its image is another image; only its speed and
  noise compare.
* Triangle meshes, since a mesh is the fastest shape that it has (its `rectangle` is a callback inside
  Embree).
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from renderer_process import serve

# 683 lm/W times the integral of y-bar by which Mitsuba divides; see the top of this file.
FILM_TO_XYZ = 683.0 * 106.7502593994140625


def main() -> None:
    """Load the scene, compile the kernel, then answer requests."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "scene", type=Path, help="the .json written by export_scene.py (its .npz lies beside it)"
    )
    parser.add_argument("--variant", default="llvm_ad_spectral", choices=["llvm_ad_spectral", "llvm_ad_rgb"])
    parser.add_argument("--depth", type=int, default=8, help="longest path in edges, camera ray included")
    parser.add_argument("--rr-depth", type=int, default=5, help="depth at which Russian roulette begins")
    parser.add_argument(
        "--sampler", default="independent", help="independent, stratified, multijitter, orthogonal"
    )
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument(
        "--pass-samples", type=int, default=64, help="larger requests are means of such passes"
    )
    options = parser.parse_args()

    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        sys.exit("mitsuba_peer.py: DRJIT_LIBLLVM_PATH is not set; benches/peers.sh prints it")
    import drjit as dr
    import mitsuba as mi

    dr.set_thread_count(options.threads)
    mi.set_variant(options.variant)
    description = json.loads(options.scene.read_text())
    with np.load(options.scene.with_suffix(".npz")) as stored, tempfile.TemporaryDirectory() as folder:
        scene = mi.load_dict(_scene(mi, description, stored, options, Path(folder)))
    width, height = description["camera"]["size"]

    def render(request: dict[str, Any]) -> dict[str, Any]:
        samples, done, number = int(request["samples"]), 0, 0
        total = np.zeros((height, width, 3))
        seconds = 0.0
        while done < samples:
            count = min(options.pass_samples, samples - done)
            start = time.perf_counter()
            # Mitsuba keys its streams by (seed, wavefront index): passes of one request take seeds far from another's.
            image = mi.render(scene, spp=count, seed=(int(request["seed"]) * 1_000_003 + number) % 2**32)
            dr.eval(image)
            dr.sync_thread()
            seconds += time.perf_counter() - start
            if request.get("output"):
                total += np.asarray(image, dtype=np.float64)[..., :3] * count
            done += count
            number += 1
        if request.get("output"):
            np.save(request["output"], total / samples * FILM_TO_XYZ)
        return {"seconds": seconds}

    serve({"name": f"Mitsuba {mi.__version__} {options.variant}", "size": [width, height]}, render)


def _scene(
    mi: Any, description: dict[str, Any], stored: Any, options: argparse.Namespace, folder: Path
) -> dict[str, Any]:
    """The dictionary for `mitsuba.load_dict`."""
    camera = description["camera"]
    width, height = camera["size"]
    spectral = options.variant.endswith("spectral")
    first, last = description["range"]
    result: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": options.depth, "rr_depth": options.rr_depth},
        "sensor": {
            "type": "perspective",
            "fov": camera["field_of_view_deg"],
            "fov_axis": "x",
            "near_clip": 1e-4,
            "far_clip": 1e5,
            "to_world": mi.ScalarTransform4f().look_at(camera["eye"], camera["target"], camera["up"]),
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "pixel_format": "xyz",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": options.sampler, "sample_count": options.pass_samples},
        },
    }
    grid = np.arange(first, last + 1)

    def curve(index: int, scale: float, bounded: bool) -> dict[str, Any]:
        values = np.asarray(description["curves"][index], dtype=np.float64) * scale
        if not values.any():
            # Its tabulated curve refuses a curve of zeros.
            return {"type": "uniform", "value": 0.0} if spectral else {"type": "rgb", "value": 0.0}
        if spectral:
            return {
                "type": "regular",
                "wavelength_min": float(first),
                "wavelength_max": float(last),
                "values": ",".join(f"{value:.9g}" for value in values),
            }
        color = mi.spectrum_list_to_srgb(list(map(float, grid)), list(map(float, values)), bounded, bounded)
        return {"type": "rgb", "value": [float(c) for c in color]}

    for number, object_ in enumerate(description["objects"]):
        path = folder / f"{number}.ply"
        _write_ply(path, stored[f"positions_{number}"], stored[f"indices_{number}"])
        shape: dict[str, Any] = {
            "type": "ply",
            "filename": str(path),
            "face_normals": True,
            "bsdf": {"type": "diffuse", "reflectance": curve(object_["reflectance"], 1.0, True)},
        }
        if object_["radiance"] is not None:
            radiance = curve(object_["radiance"]["curve"], object_["radiance"]["scale"], False)
            shape["emitter"] = {"type": "area", "radiance": radiance}
        result[f"object_{number}"] = shape
    return result


def _write_ply(path: Path, positions: Any, indices: Any) -> None:
    """A binary PLY file of triangles."""
    faces = np.empty(len(indices), dtype=[("count", "u1"), ("index", "<i4", 3)])
    faces["count"] = 3
    faces["index"] = indices
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(positions)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(indices)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    path.write_bytes(
        header.encode() + np.ascontiguousarray(positions, dtype="<f4").tobytes() + faces.tobytes()
    )


if __name__ == "__main__":
    main()
