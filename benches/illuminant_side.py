"""Our side of a comparison: illuminant, through its Python interface, as a process that answers requests.

    .venv/bin/python benches/illuminant_side.py cornell --sampling uniform:8

The scene is loaded and its ray structure built before the first request; `seconds` is the whole call of
`illuminant.render`, with its passes, its film and its image object, as a user waits for it. The
reconstruction filter is a box of one pixel, which is what the peers use.
"""

from __future__ import annotations

import argparse
import hashlib
import time
from pathlib import Path
from typing import Any

import numpy as np

from export_scene import resolve
from renderer_process import serve


def main() -> None:
    """Load the scene, then answer requests."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene", help="cornell, million, or a scene file")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--sampling", default="uniform:8")
    parser.add_argument("--depth", type=int, default=8, help="longest path in segments")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()

    import illuminant
    from illuminant.core import core, embree

    embree()
    scene = resolve(options.scene, options.size)
    scene.core()

    def render(request: dict[str, Any]) -> dict[str, Any]:
        start = time.perf_counter()
        image = illuminant.render(
            scene,
            sampling=options.sampling,
            samples=int(request["samples"]),
            depth=options.depth,
            threads=options.threads,
            seed=int(request["seed"]),
            filter=("box", 0.5),
        )
        seconds = time.perf_counter() - start
        if request.get("output"):
            np.save(request["output"], np.asarray(image.xyz, dtype=np.float64))
        counts = {key: image.statistics.get(key) for key in ("seconds", "samples", "rays", "dropped")}
        return {"seconds": seconds, "core": counts}

    library = Path(core().__file__).read_bytes()
    serve(
        {
            "name": f"illuminant {illuminant.__version__}",
            "size": [options.size, options.size],
            "core_sha256": hashlib.sha256(library).hexdigest(),
        },
        render,
    )


if __name__ == "__main__":
    main()
