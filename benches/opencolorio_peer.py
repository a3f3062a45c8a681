"""The peer: OpenColorIO takes XYZ to 8-bit sRGB (runs in `.venv-bench`).

    .venv-bench/bin/python benches/opencolorio_peer.py

A request is ``{"input": path of .npy, (h, w, 3) float32, "runs": int, "threads": int, "output": path or null}``; the
answer holds ``seconds`` of each run and, when an output was given, the codes are there as ``.npy``.

What it does: a matrix (IEC 61966-2-1, in full precision, from XYZ with Y = 1 for white), the curve of sRGB as an
exponent with a linear part, and rounding to 8 bits, by a processor that goes from float32 to uint8 with OpenColorIO's
default optimisation. There is no gamut mapping but the clamping of the integers, and no dither. OpenColorIO starts no
threads of its own: the image is cut into as many parts as threads were asked for, and each is given to one (`apply`
lets go of the interpreter). Codes go into an array that exists.
"""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import PyOpenColorIO as ocio

from renderer_process import serve

PRIMARIES = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
WHITE = (0.3127, 0.3290)


def matrix() -> np.ndarray:
    """XYZ to linear RGB."""
    columns = np.array([(x / y, 1.0, (1 - x - y) / y) for x, y in PRIMARIES]).T
    x, y = WHITE
    white = np.array([x / y, 1.0, (1 - x - y) / y])
    return np.linalg.inv(columns * np.linalg.solve(columns, white))


def processor() -> Any:
    """From XYZ, float32, to code values of sRGB, uint8."""
    rows = np.eye(4)
    rows[:3, :3] = matrix()
    curve = ocio.ExponentWithLinearTransform()
    curve.setGamma([2.4, 2.4, 2.4, 1.0])
    curve.setOffset([0.055, 0.055, 0.055, 0.0])
    curve.setDirection(ocio.TRANSFORM_DIR_INVERSE)
    steps = ocio.GroupTransform([ocio.MatrixTransform(rows.ravel().tolist()), curve])
    made = ocio.Config.CreateRaw().getProcessor(steps)
    return made.getOptimizedCPUProcessor(
        ocio.BIT_DEPTH_F32, ocio.BIT_DEPTH_UINT8, ocio.OptimizationFlags.OPTIMIZATION_DEFAULT
    )


class Peer:
    """Holds the image between requests."""

    def __init__(self) -> None:
        self.cpu = processor()
        self.path = ""
        self.image = np.zeros((1, 1, 3), np.float32)

    def answer(self, request: dict[str, Any]) -> dict[str, Any]:
        """Run, and say how long it took."""
        if request["input"] != self.path:
            self.path = request["input"]
            self.image = np.load(self.path)
        codes = np.zeros(self.image.shape, np.uint8)
        threads = int(request["threads"])
        pairs = list(zip(np.array_split(self.image, threads), np.array_split(codes, threads), strict=True))

        def work(pair: tuple[np.ndarray, np.ndarray]) -> None:
            source, target = pair
            height, width = source.shape[:2]
            self.cpu.apply(
                ocio.PackedImageDesc(source, width, height, 3, ocio.BIT_DEPTH_F32, 4, 3 * 4, 3 * 4 * width),
                ocio.PackedImageDesc(target, width, height, 3, ocio.BIT_DEPTH_UINT8, 1, 3, 3 * width),
            )

        seconds = []
        with ThreadPoolExecutor(threads) as pool:
            for _ in range(int(request["runs"])):
                begun = time.perf_counter()
                list(pool.map(work, pairs))
                seconds.append(time.perf_counter() - begun)
        if request.get("output"):
            np.save(request["output"], codes)
        return {"seconds": seconds}


def main() -> None:
    """Answer requests."""
    serve({"name": "OpenColorIO", "version": ocio.__version__}, Peer().answer)


if __name__ == "__main__":
    main()
