"""The peer: Radiance computes irradiance at sensors (runs in `.venv-bench`; the wheel `pyradiance` carries it).

    .venv-bench/bin/python benches/radiance_peer.py

Its programs run as processes of their own, since that is how Radiance is used. A request is
``{"scene": text, "sensors": [[x, y, z, nx, ny, nz], ...], "options": [...], "repeat": int, "output": path or null}``:
a scene in Radiance's language, points with normals, and what `rtrace` is told beyond `-I -h-`; each sensor is asked
`repeat` times (once unless said) and its answers are averaged. `seconds` are by the clock, of `oconv` (scene to octree)
and `rtrace` together with their start; `oconv_seconds` is the first part of them. `processor_seconds` and `peak_bytes`
are those of these programs, not of this process. The output is `.npy`, (sensors,), float64: W/m² for radiances in
W/(m² sr), the mean of Radiance's three channels.

Options that this file always adds:

* `-I`: rays are points and normals, and what comes back is irradiance; `-h-`: without a header.
* `-fdd`: doubles in and out, so that no digits are lost in text.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyradiance

from renderer_process import serve


def main() -> None:
    """Answer requests."""
    # Importing pyradiance has set RAYPATH, where rtrace looks for rayinit.cal; without that it does not start.
    programs = Path(pyradiance.BINPATH)
    said = subprocess.run([programs / "rtrace", "-version"], capture_output=True, text=True, check=True)
    serve(
        {"name": "Radiance", "version": said.stdout.strip(), "wheel": pyradiance.__version__},
        lambda request: irradiance(programs, request),
    )


def irradiance(programs: Path, request: dict[str, Any]) -> dict[str, Any]:
    """One octree and one run of rtrace."""
    repeat = int(request.get("repeat", 1))
    sensors = np.tile(np.asarray(request["sensors"], dtype=np.float64), (repeat, 1))
    with tempfile.TemporaryDirectory() as folder:
        scene, octree = Path(folder) / "room.rad", Path(folder) / "room.oct"
        scene.write_text(request["scene"], encoding="utf-8")
        before = _processor_seconds()
        start = time.perf_counter()
        with octree.open("wb") as stream:
            subprocess.run([programs / "oconv", scene], stdout=stream, check=True)
        ready = time.perf_counter()
        answer = subprocess.run(
            [programs / "rtrace", "-I", "-h-", "-fdd", *request["options"], octree],
            input=sensors.tobytes(),
            stdout=subprocess.PIPE,
            cwd=folder,
            check=True,
        ).stdout
        end = time.perf_counter()
        processor = _processor_seconds() - before
    values = np.frombuffer(answer, dtype=np.float64).reshape(-1, 3)
    if len(values) != len(sensors):
        sys.exit(f"radiance_peer.py: {len(values)} answers to {len(sensors)} sensors; {request['options']}")
    if request.get("output"):
        np.save(request["output"], values.reshape(repeat, -1, 3).mean(axis=(0, 2)))
    return {
        "seconds": end - start,
        "oconv_seconds": ready - start,
        "processor_seconds": processor,
        "peak_bytes": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        * (1 if sys.platform == "darwin" else 1024),
    }


def _processor_seconds() -> float:
    """Of all processes that this one has started and that have ended."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return children.ru_utime + children.ru_stime


if __name__ == "__main__":
    main()
