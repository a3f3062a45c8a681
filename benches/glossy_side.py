"""One side of `glossy.py`: a renderer with the glossy scene, as a process that answers requests.

    .venv/bin/python benches/glossy_side.py illuminant
    .venv-bench/bin/python benches/glossy_side.py mitsuba
    .venv-bench/bin/python benches/glossy_side.py luxcore

Each takes its own data of the metals and its own distribution of facets (Beckmann, Beckmann, Schlick), so that images
differ in colour; what compares is speed and noise, each against its own converged image. LuxCore renders RGB, the
others spectra. Its camera looks through the shorter side of the image, and balls are meshes to it; the others have
spheres.
"""

from __future__ import annotations

import argparse
import os
import time
from typing import Any

import numpy as np

import glossy_scene as given
from renderer_process import serve


def illuminant_side(width: int, height: int, threads: int) -> None:
    """illuminant: `fitted:8`."""
    import illuminant
    from illuminant.scene import Scene

    materials: dict[str, Any] = {
        "floor": {
            "kind": "diffuse",
            "reflectance": {
                "image": given.tiles(),
                "repeat": [given.FLOOR["repeat"]] * 2,
                "encoding": "linear",
            },
        },
        "lamp": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 10000.0},
    }
    objects: dict[str, Any] = {
        "floor": {"rectangle": {key: given.FLOOR[key] for key in ("corner", "edges")}, "material": "floor"},
        "lamp": {"rectangle": {key: given.LAMP[key] for key in ("corner", "edges")}, "material": "lamp"},
    }
    for i, one in enumerate(given.BALLS):
        materials[f"metal {i}"] = {"kind": "conductor", "metal": one["metal"], "roughness": one["roughness"]}
        objects[f"ball {i}"] = {
            "sphere": {"center": one["center"], "radius": one["radius"]},
            "material": f"metal {i}",
        }
    scene = Scene.build(
        camera=given.CAMERA | {"size": [width, height]}, objects=objects, materials=materials, up="z"
    )
    scene.core()

    def render(request: dict[str, Any]) -> dict[str, Any]:
        start = time.perf_counter()
        image = illuminant.render(
            scene,
            samples=int(request["samples"]),
            seed=int(request["seed"]),
            depth=given.DEPTH,
            threads=threads,
            filter=("box", 0.5),
        )
        seconds = time.perf_counter() - start
        if request.get("output"):
            np.save(request["output"], np.asarray(image.xyz, np.float64))
        return {"seconds": seconds, "rays": image.statistics["rays"]}

    serve({"name": "illuminant", "version": illuminant.__version__, "width": width, "height": height}, render)


def mitsuba_side(width: int, height: int, threads: int) -> None:
    """Mitsuba: `path`, compiled, spectral."""
    import drjit as dr
    import mitsuba as mi

    dr.set_thread_count(threads)
    mi.set_variant("llvm_ad_spectral")
    transform = mi.ScalarTransform4f

    def quad(corner: list[float], edges: list[list[float]]) -> Any:
        a, b = (0.5 * np.asarray(edge) for edge in edges)
        matrix = np.eye(4)
        matrix[:3, 0], matrix[:3, 1] = a, b
        matrix[:3, 2] = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
        matrix[:3, 3] = np.asarray(corner) + a + b
        return transform(matrix)

    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": given.DEPTH},
        "sensor": {
            "type": "perspective",
            "to_world": transform().look_at(
                origin=given.CAMERA["eye"], target=given.CAMERA["target"], up=given.CAMERA["up"]
            ),
            "fov": given.CAMERA["field_of_view"],
            "fov_axis": "x",
            "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
        "floor": {
            "type": "rectangle",
            "to_world": quad(given.FLOOR["corner"], given.FLOOR["edges"]),
            "bsdf": {
                "type": "diffuse",
                "reflectance": {
                    "type": "bitmap",
                    "bitmap": mi.Bitmap(given.tiles()),
                    "raw": False,
                    "to_uv": transform().scale([given.FLOOR["repeat"]] * 2 + [1.0]),
                },
            },
        },
        "lamp": {
            "type": "rectangle",
            "to_world": quad(given.LAMP["corner"], given.LAMP["edges"]),
            "emitter": {"type": "area", "radiance": {"type": "uniform", "value": given.LAMP["radiance"]}},
        },
    }
    for i, one in enumerate(given.BALLS):
        scene[f"ball{i}"] = {
            "type": "sphere",
            "center": one["center"],
            "radius": one["radius"],
            "bsdf": {
                "type": "roughconductor",
                "material": one["peer"],
                "alpha": one["roughness"],
                "distribution": "beckmann",
            },
        }
    loaded = mi.load_dict(scene)

    def render(request: dict[str, Any]) -> dict[str, Any]:
        samples, done, number, total, seconds = int(request["samples"]), 0, 0, 0.0, 0.0
        while done < samples:
            count = min(64, samples - done)
            start = time.perf_counter()
            image = mi.render(loaded, spp=count, seed=int(request["seed"]) * 1000 + number)
            dr.eval(image)
            dr.sync_thread()
            seconds += time.perf_counter() - start
            total = total + count * np.array(image, np.float64)
            done, number = done + count, number + 1
        if request.get("output"):
            np.save(request["output"], np.asarray(total) / samples)
        return {"seconds": seconds}

    render({"samples": 64, "seed": 1})
    serve({"name": "Mitsuba", "version": mi.__version__, "width": width, "height": height}, render)


def luxcore_side(width: int, height: int, threads: int) -> None:
    """LuxCore: PATHCPU with its Sobol sampler, RGB."""
    # What it prints as it is loaded must not fall into the conversation. (NumPy must be loaded before it.)
    conversation = os.dup(1)
    os.dup2(2, 1)
    import pyluxcore

    pyluxcore.Init()

    def properties(values: dict[str, Any]) -> Any:
        found = pyluxcore.Properties()
        for key, value in values.items():
            found.Set(pyluxcore.Property(key, value))
        return found

    scene = pyluxcore.Scene()
    picture = given.tiles()
    scene.DefineImageMap("tiles", np.ascontiguousarray(picture[::-1].reshape(-1)), 1.0, 3, *picture.shape[:2])
    # Its field of view is that of the shorter side.
    view = np.degrees(
        2 * np.arctan(np.tan(np.radians(given.CAMERA["field_of_view"] / 2)) * min(1.0, height / width))
    )
    values: dict[str, Any] = {
        "scene.camera.lookat.orig": given.CAMERA["eye"],
        "scene.camera.lookat.target": given.CAMERA["target"],
        "scene.camera.up": given.CAMERA["up"],
        "scene.camera.fieldofview": float(view),
        "scene.camera.autofocus.enable": 0,
        "scene.textures.tiles.type": "imagemap",
        "scene.textures.tiles.file": "tiles",
        "scene.textures.tiles.mapping.type": "uvmapping2d",
        "scene.textures.tiles.mapping.uvscale": [given.FLOOR["repeat"]] * 2,
        "scene.materials.floor.type": "matte",
        "scene.materials.floor.kd": "tiles",
        "scene.materials.lamp.type": "matte",
        "scene.materials.lamp.kd": [0.0, 0.0, 0.0],
        "scene.materials.lamp.emission": [given.LAMP["radiance"]] * 3,
    }
    for i, one in enumerate(given.BALLS):
        values |= {
            f"scene.textures.metal{i}.type": "fresnelpreset",
            f"scene.textures.metal{i}.name": one["metal"],
            f"scene.materials.metal{i}.type": "metal2",
            f"scene.materials.metal{i}.fresnel": f"metal{i}",
            f"scene.materials.metal{i}.uroughness": one["roughness"],
            f"scene.materials.metal{i}.vroughness": one["roughness"],
        }
    scene.Parse(properties(values))

    def mesh(name: str, points: Any, faces: Any, normals: Any = None, uvs: Any = None) -> None:
        def rows(table: Any, of: type) -> Any:
            return None if table is None else [tuple(map(of, row)) for row in table]

        lists = (rows(points, float), rows(faces, int), rows(normals, float), rows(uvs, float))
        scene.DefineMesh(name, *lists, None, None)

    for name, table in (("floor", given.FLOOR), ("lamp", given.LAMP)):
        a, (b, c) = np.asarray(table["corner"]), np.asarray(table["edges"])
        mesh(
            name, [a, a + b, a + b + c, a + c], [(0, 1, 2), (0, 2, 3)], None, [(0, 0), (1, 0), (1, 1), (0, 1)]
        )
    for i, one in enumerate(given.BALLS):
        points, normals, faces = given.ball(one["center"], one["radius"])
        mesh(f"ball{i}", points, faces, normals)
    shapes = {"floor": "floor", "lamp": "lamp"} | {f"ball{i}": f"metal{i}" for i in range(len(given.BALLS))}
    scene.Parse(
        properties(
            {f"scene.objects.{name}.shape": name for name in shapes}
            | {f"scene.objects.{name}.material": material for name, material in shapes.items()}
        )
    )

    def render(request: dict[str, Any]) -> dict[str, Any]:
        config = pyluxcore.RenderConfig(
            properties(
                {
                    "renderengine.type": "PATHCPU",
                    "renderengine.seed": int(request["seed"]) + 1,
                    "sampler.type": "SOBOL",
                    "sampler.sobol.adaptive.strength": 0.0,
                    "film.width": width,
                    "film.height": height,
                    "film.filter.type": "NONE",
                    "path.pathdepth.total": given.DEPTH,
                    "path.pathdepth.diffuse": given.DEPTH,
                    "path.pathdepth.glossy": given.DEPTH,
                    "path.pathdepth.specular": given.DEPTH,
                    "path.clamping.variance.maxvalue": 0.0,
                    "batch.haltspp": [int(request["samples"]), 0],
                    "native.threads.count": threads,
                    "film.imagepipelines.0.0.type": "NOP",
                    "film.outputs.0.type": "RGB",
                    "film.outputs.0.filename": "unused.exr",
                }
            ),
            scene,
        )
        session = pyluxcore.RenderSession(config)
        start = time.perf_counter()
        session.Start()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = time.perf_counter() - start
        rays = session.GetStats().Get("stats.renderengine.performance.total").GetFloat()
        session.Stop()
        if request.get("output"):
            image = np.zeros(width * height * 3, np.float32)
            session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, image, 0)
            np.save(request["output"], image.reshape(height, width, 3)[::-1].astype(np.float64))
        return {"seconds": seconds, "rays": rays * seconds}

    os.dup2(conversation, 1)
    serve({"name": "LuxCore", "version": pyluxcore.Version(), "width": width, "height": height}, render)


def main() -> None:
    """Take a side."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    sides = {"illuminant": illuminant_side, "mitsuba": mitsuba_side, "luxcore": luxcore_side}
    parser.add_argument("side", choices=sides)
    parser.add_argument("--size", type=int, nargs=2, default=[256, 192])
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    sides[options.side](*options.size, options.threads)


if __name__ == "__main__":
    main()
