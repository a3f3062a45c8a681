"""Speed of dithers, and of everything from XYZ to 8 bits beside OpenColorIO.

    .venv/bin/python benches/dither.py [--size 3840x2160] [--runs 9] [--rounds 5]

1. Each dither takes float32 values, three channels, to 8 bits, through `illuminant.display.dither.quantise`. The input
   exists and is not copied; the result is a new array, and the line "an array of that size" says what making and
   touching one costs by itself.
2. `illuminant.display.look.show` takes XYZ to codes: exposure, matrix, gamut by the default method, sRGB's curve,
   `ordered-4`. OpenColorIO does matrix, curve and rounding of the same image, cut in two halves for two threads, into
   an array that exists (`opencolorio_peer.py`). Their runs alternate. With no dither and nothing outside the gamut the
   codes are compared first: they may differ by one where rounding decides.

Times are the best of several runs, rates in megapixels (of three channels) a second.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from illuminant.display import displays, dither, gamut
from illuminant.display.look import Look, show
from renderer_process import RendererProcess

HERE = Path(__file__).parent
AIMS = {"floyd-steinberg": 100, "dot-diffusion": 40, "ordered-2": 300, "ordered-4": 300, "bayer-8": 300}
PIPELINE_AIM = 60
LOOK, PLAIN = Look(dither="ordered-4"), Look()


def best(work: Callable[[], object], runs: int) -> float:
    """Least seconds of a few runs, after one that warms up."""
    work()
    times = []
    for _ in range(runs):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return min(times)


def picture(width: int, height: int) -> np.ndarray:
    """A smooth image of linear sRGB, all inside, float32."""
    x = np.linspace(0.0, 1.0, width)[None, :, None]
    y = np.linspace(0.0, 1.0, height)[:, None, None]
    wave = np.sin(np.array([5.0, 7.0, 3.0]) * x + np.array([2.0, 3.0, 6.0]) * y + np.array([0.0, 1.0, 2.0]))
    return np.ascontiguousarray((0.5 + 0.48 * wave).astype(np.float32))


def dithers(size: tuple[int, int], runs: int, names: list[str]) -> None:
    """The table of dithers."""
    width, height = size
    values, megapixels = picture(width, height), width * height / 1e6
    made = best(lambda: np.zeros(values.shape, np.uint8).fill(1), runs)
    print(f"{width} x {height}, float32 to 8 bits       Mpixel/s       ms   ms less array   aim")
    print(f"{'an array of that size':33}{megapixels / made:10.0f}{1e3 * made:9.1f}")
    for name in names:
        took = best(lambda name=name: dither.quantise(values, 8, name), runs)  # type: ignore[misc]
        aim = f"{AIMS[name]:8}" if name in AIMS else ""
        print(
            f"{name:33}{megapixels / took:10.0f}{1e3 * took:9.1f}{1e3 * (took - made):12.1f}    {aim}",
            flush=True,
        )


def pipeline(size: tuple[int, int], runs: int, rounds: int, peer_python: Path) -> None:
    """The table of whole pipelines, and their ratio."""
    width, height = size
    threads = min(2, os.cpu_count() or 1)
    megapixels = width * height / 1e6
    inside = picture(width, height)
    outside = inside.copy()
    outside[: height // 10] *= np.float32(1.4)  # too bright, a tenth of the rows
    outside[-(height // 10) :, :, 0] -= np.float32(0.5)  # too saturated, another tenth
    to_xyz = displays.named("sRGB").to_xyz_matrix.T.astype(np.float32)
    images = {"all inside": inside @ to_xyz, "a fifth of the rows outside": outside @ to_xyz}
    with (
        tempfile.TemporaryDirectory() as folder,
        RendererProcess([str(peer_python), str(HERE / "opencolorio_peer.py")]) as peer,
    ):
        print(
            f"\n{peer.opening['name']} {peer.opening['version']}, {threads} threads; gamut method {gamut.DEFAULT}"
        )
        for number, (name, xyz) in enumerate(images.items()):
            path = Path(folder) / f"{number}.npy"
            np.save(path, xyz)
            request = {"input": str(path), "threads": threads}
            if name == "all inside":
                peer.ask(**request, runs=1, output=str(Path(folder) / "codes.npy"))
                theirs = np.load(Path(folder) / "codes.npy").astype(int)
                apart = np.abs(show(xyz, Look()).picture.codes - theirs)
                assert apart.max() <= 1, apart.max()
                print(f"codes of both without dither: {100 * (apart > 0).mean():.2f} % differ, by 1")
                print(f"{'':36}{'ordered-4':>12}{'none':>12}{'OpenColorIO':>14}{'ratio':>10}")
            took: dict[str, list[float]] = {"ours": [], "plain": [], "peer": []}
            for _ in range(rounds):
                took["ours"].append(best(lambda xyz=xyz: show(xyz, LOOK), runs))  # type: ignore[misc]
                took["plain"].append(best(lambda xyz=xyz: show(xyz, PLAIN), runs))  # type: ignore[misc]
                took["peer"].append(min(peer.ask(**request, runs=runs + 1)["seconds"][1:]))
            ours, plain_rate, theirs_rate = (megapixels / min(times) for times in took.values())
            print(
                f"{name:36}{ours:12.1f}{plain_rate:12.1f}{theirs_rate:14.1f}{ours / theirs_rate:10.2f}"
                f"   aim {PIPELINE_AIM}",
                flush=True,
            )


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--size", default="3840x2160", help="WxH of the image")
    parser.add_argument("--runs", type=int, default=9, help="of each measurement; the best counts")
    parser.add_argument(
        "--rounds", type=int, default=3, help="how often both sides of the pipeline take turns"
    )
    parser.add_argument("--dithers", default=",".join(dither.names()), help="which, in this order")
    parser.add_argument(
        "--peer-python",
        type=Path,
        default=HERE.parent / ".venv-bench" / "bin" / "python",
        help="with OpenColorIO",
    )
    options = parser.parse_args()
    width, height = (int(side) for side in options.size.split("x"))
    dithers((width, height), options.runs, options.dithers.split(","))
    pipeline((width, height), options.runs, options.rounds, options.peer_python)


if __name__ == "__main__":
    main()
