"""Colour on one megapixel beside colour-science: prints a table for float64 and one for float32.

    .venv/bin/python benches/color.py                  # about a minute
    .venv/bin/python benches/color.py --size 512 --runs 5

Both sides get the same arrays of the same type, in one process, in alternating runs; each number is the best of its
runs, since other programs on the machine only add time. illuminant writes into an array that exists (`out=`), which
colour-science does not offer. Each result is compared with the peer's before it is timed. The limit printed is what a
read of the input and a write of the output cost at the bandwidth that a dot product and `numpy.copyto` reach in the
same run.

- spectra → XYZ: 81 bands, 380 to 780 nm by 5 nm, under D65. The peer's method "Integration" sums at the bands, so the
  results are compared with `interpolation="none"`; with straight lines between bands (the default) the product, and so
  the time, is the same.
- XYZ → sRGB: matrix and transfer function. The peer multiplies by the rounded matrix of IEC 61966-2-1, so the results
  are compared with that matrix.
- XYZ → L*a*b* under D65.
"""

from __future__ import annotations

import argparse
import os
import time
import warnings
from collections.abc import Callable

# Settings that slow NumPy down for the sake of other programs would flatter us.
for setting in ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE"):
    os.environ.pop(setting, None)

import numpy as np  # noqa: E402

from illuminant import color  # noqa: E402

warnings.simplefilter("ignore")
import colour  # noqa: E402

BANDS = np.arange(380, 781, 5)
WHITE = (0.3127, 0.3290)


def seconds(functions: list[Callable[[], object]], runs: int) -> list[float]:
    """Least seconds of each function, run in turn."""
    took: list[list[float]] = [[] for _ in functions]
    for run in range(runs + 1):
        for function, times in zip(functions, took, strict=True):
            begun = time.perf_counter()
            function()
            if run:  # the first run touches the memory
                times.append(time.perf_counter() - begun)
    return [min(times) for times in took]


def bandwidth(runs: int) -> tuple[float, float]:
    """Bytes per second that a dot product reads, and that a copy reads and writes together."""
    read = np.ones(80_000_000)
    source, target = np.ones((2, 4_000_000))
    times = seconds([lambda: np.dot(read, read), lambda: np.copyto(target, source)], runs)
    return read.nbytes / times[0], 2 * source.nbytes / times[1]


def table(dtype: type, size: int, runs: int, rates: tuple[float, float]) -> None:
    """One table: megapixels per second of both sides, their ratio, and the limit."""
    colour.utilities.set_default_float_dtype(dtype)
    random = np.random.default_rng(1)
    spectra = random.random((size, size, 81), np.float32).astype(dtype)
    xyz = random.random((size, size, 3), np.float32).astype(dtype) + dtype(0.001)
    out = np.empty_like(xyz)

    shape = colour.SpectralShape(380, 780, 5)
    cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    lamp = colour.SDS_ILLUMINANTS["D65"].copy().align(shape)
    d65 = (BANDS, np.asarray(lamp.values, np.float64))
    printed = color.published_matrix("XYZ to sRGB")
    chain = [color.triples.step("matrix", printed.tolist()), color.triples.step("encode", "sRGB")]

    def peer_spectra(values: np.ndarray) -> np.ndarray:
        return colour.msds_to_XYZ(values, cmfs, lamp, method="Integration", shape=shape)

    rows = [
        (
            "81 bands -> XYZ",
            lambda: color.spectra_to_xyz(spectra, BANDS, illuminant="D65", out=out),
            lambda: peer_spectra(spectra),
            lambda: color.spectra_to_xyz(spectra[:8], BANDS, illuminant=d65, interpolation="none"),
            lambda: peer_spectra(spectra[:8]) / 100,
            spectra.nbytes / rates[0],
        ),
        (
            "XYZ -> sRGB",
            lambda: color.xyz_to_rgb(xyz, "sRGB", encoded=True, out=out),
            lambda: colour.XYZ_to_sRGB(xyz),
            lambda: color.triples.converted(chain, xyz[:8]),
            lambda: colour.XYZ_to_sRGB(xyz[:8]),
            (xyz.nbytes + out.nbytes) / rates[1],
        ),
        (
            "XYZ -> Lab",
            lambda: color.xyz_to_lab(xyz, WHITE, out=out),
            lambda: colour.XYZ_to_Lab(xyz, WHITE),
            lambda: color.xyz_to_lab(xyz[:8], WHITE),
            lambda: colour.XYZ_to_Lab(xyz[:8], WHITE),
            (xyz.nbytes + out.nbytes) / rates[1],
        ),
    ]
    pixels = size * size
    name = np.dtype(dtype).name
    print(f"\n{name}, {size} x {size}, Mpixel/s (best of {runs} runs)")
    heads = ("illuminant", "colour", "ratio", "limit", "of limit", "largest difference")
    print(f"{'':16}" + "".join(f"{head:>12}" for head in heads[:5]) + f"{heads[5]:>20}")
    for label, ours, peer, our_result, peer_result, limit in rows:
        found, wanted = our_result(), peer_result()
        assert found.dtype == dtype and wanted.dtype == dtype, (label, found.dtype, wanted.dtype)
        apart = float(np.abs(found.astype(float) - wanted).max() / np.abs(wanted).max())
        assert apart < (1e-9 if dtype is np.float64 else 1e-5), (label, apart)
        took = seconds([ours, peer], runs)
        rate = [pixels / each / 1e6 for each in took]
        columns = f"{rate[0]:12.1f}{rate[1]:12.2f}{rate[0] / rate[1]:12.1f}"
        print(
            f"{label:16}{columns}{pixels / limit / 1e6:12.1f}{limit / took[0]:11.0%} {apart:19.1e}",
            flush=True,
        )


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--size", type=int, default=1024, help="side of the image, pixels")
    parser.add_argument("--runs", type=int, default=7)
    options = parser.parse_args()
    rates = bandwidth(options.runs)
    print(f"colour-science {colour.__version__}, NumPy {np.__version__}, {os.cpu_count()} processors")
    print(f"memory: {rates[0] / 1e9:.1f} GB/s read (dot), {rates[1] / 1e9:.1f} GB/s read and written (copy)")
    for dtype in (np.float64, np.float32):
        table(dtype, options.size, options.runs, rates)


if __name__ == "__main__":
    main()
