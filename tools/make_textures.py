"""Paint the images of `scenes/tiles.toml`: glazed tiles, how worn they are, and the grooves between them.

    python tools/make_textures.py

It writes `tiles.png` (256 × 256, sRGB), `worn.png` (grey, linear) and `grooves.png` (grey, linear, heights) to
`scenes/images/`. All by formula, periodic in both directions.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO as oiio

FOLDER = Path(__file__).resolve().parent.parent / "scenes" / "images"
SIZE = 256
TILES = 4


def smooth(x: np.ndarray, width: float) -> np.ndarray:
    """0 below, 1 above, smooth over `width`."""
    t = np.clip(x / width + 0.5, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def noise(rng: np.random.Generator, cells: int) -> np.ndarray:
    """A periodic landscape of about so many hills along each side, from 0 to 1."""
    waves = np.fft.rfft2(rng.standard_normal((SIZE, SIZE)))
    frequency = np.hypot(np.fft.fftfreq(SIZE)[:, None], np.fft.rfftfreq(SIZE)[None, :]) * SIZE
    hills = np.fft.irfft2(waves * np.exp(-((frequency / cells) ** 2)), (SIZE, SIZE))
    return (hills - hills.min()) / (hills.max() - hills.min())


def write(name: str, image: np.ndarray) -> None:
    """Eight bits a channel."""
    pixels = np.round(image.clip(0.0, 1.0) * 255.0).astype(np.uint8)
    pixels = pixels[..., None] if pixels.ndim == 2 else pixels
    spec = oiio.ImageSpec(SIZE, SIZE, pixels.shape[2], "uint8")
    buffer = oiio.ImageBuf(spec)
    buffer.set_pixels(oiio.ROI(), pixels)
    buffer.write(str(FOLDER / name))


def main() -> None:
    """Write the three images."""
    rng = np.random.default_rng(7)
    x = (np.arange(SIZE) + 0.5) / SIZE * TILES
    u, v = np.meshgrid(x, x)
    edge = np.minimum(0.5 - np.abs(u % 1.0 - 0.5), 0.5 - np.abs(v % 1.0 - 0.5))
    glazed = smooth(edge - 0.045, 0.03)
    blue = ((u.astype(int) + v.astype(int)) % 2 == 0)[..., None]
    radius = np.hypot(u % 1.0 - 0.5, v % 1.0 - 0.5)
    flower = smooth(0.3 + 0.1 * np.cos(4 * np.arctan2(v % 1.0 - 0.5, u % 1.0 - 0.5)) - radius, 0.04)[
        ..., None
    ]
    ground = np.where(blue, [0.16, 0.33, 0.55], [0.86, 0.82, 0.72])
    motif = np.where(blue, [0.86, 0.82, 0.72], [0.16, 0.33, 0.55])
    tile = ground * (1.0 - flower) + motif * flower
    tile = tile * (0.92 + 0.16 * noise(rng, 12)[..., None])
    grout = np.array([0.55, 0.52, 0.48]) * (0.85 + 0.3 * noise(rng, 60)[..., None])
    write("tiles.png", tile * glazed[..., None] + grout * (1.0 - glazed[..., None]))
    write("worn.png", np.maximum(smooth(noise(rng, 5) - 0.55, 0.3), 1.0 - glazed))
    write("grooves.png", 0.9 * smooth(edge - 0.05, 0.08) + 0.1 * noise(rng, 20))


if __name__ == "__main__":
    main()
