"""Paint the environment image `scenes/images/studio.exr`: a photographer's studio, as linear sRGB.

    python tools/make_environment.py

Latitude-longitude, y up, 1024 × 512, half floats. RGB (1, 1, 1) is a white wall in full light. A dim grey room with a
wooden floor holds a large softbox (neutral), a strip light (warm), a window (blue sky over a bright horizon) and a
lamp with a red shade, so that metal and glass have edges, gradients and colours to show. All by formula; each edge is
softened over about a pixel, so that no texel aliases.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO as oiio

FILE = Path(__file__).resolve().parent.parent / "scenes" / "images" / "studio.exr"
WIDTH, HEIGHT = 1024, 512


def directions() -> np.ndarray:
    """The direction of each texel: the top row is +y, the middle column -z, columns to its right towards +x."""
    azimuth = 2 * np.pi * ((np.arange(WIDTH) + 0.5) / WIDTH - 0.5)
    polar = np.pi * (np.arange(HEIGHT) + 0.5) / HEIGHT
    sine = np.sin(polar)[:, None]
    x, z = sine * np.sin(azimuth), -sine * np.cos(azimuth)
    return np.stack([x, np.broadcast_to(np.cos(polar)[:, None], x.shape), z], axis=2)


def step(x: np.ndarray, width: float) -> np.ndarray:
    """0 below, 1 above, smooth over `width`."""
    t = np.clip(x / width + 0.5, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def panel(
    d: np.ndarray, azimuth: float, elevation: float, size: tuple[float, float], soft: float
) -> np.ndarray:
    """How much of each texel is covered by a flat panel, given the tangents of its half width and half height."""
    a, e = np.radians([azimuth, elevation])
    normal = np.array([np.cos(e) * np.sin(a), np.sin(e), -np.cos(e) * np.cos(a)])
    right = np.array([np.cos(a), 0.0, np.sin(a)])
    up = np.cross(right, normal)
    along = np.maximum(d @ normal, 1e-6)
    u, v = (d @ right) / along, (d @ up) / along
    return step(size[0] - np.abs(u), soft) * step(size[1] - np.abs(v), soft) * (d @ normal > 0)


def studio() -> np.ndarray:
    """The image, float32 (HEIGHT, WIDTH, 3)."""
    d = directions()
    y = d[..., 1]
    wall = 0.22 + 0.10 * step(y, 1.6)
    wall = (
        wall
        + 0.35 * np.exp(-6.0 * (1.0 - d @ unit(-55.0, 30.0)))
        + 0.10 * np.exp(-8.0 * (1.0 - d @ unit(62.0, 5.0)))
    )
    room = wall[..., None] * np.array([1.0, 0.98, 0.95])
    below = np.maximum(-y, 1e-3)
    grain = 0.5 + 0.5 * np.sin(9.0 * d[..., 0] / below)
    floor = 0.13 + 0.08 * grain * np.exp(-0.15 / below) + 0.08 * np.exp(-4.0 * (1.0 - d @ unit(-55.0, -20.0)))
    boards = (floor * np.clip(3.0 * below, 0.7, 1.0))[..., None] * np.array([1.0, 0.62, 0.36])
    image = room + step(-y - 0.02, 0.012)[..., None] * (boards - room)

    def add(cover: np.ndarray, light: np.ndarray) -> None:
        image[...] += cover[..., None] * (light - image)

    softbox = panel(d, -55.0, 38.0, (0.62, 0.48), 0.02)
    centre = np.exp(-3.0 * ((d @ unit(-55.0, 38.0) - 1.0) ** 2) * 40.0)
    add(softbox, (9.0 + 5.0 * centre)[..., None] * np.array([1.0, 1.0, 1.0]))
    add(panel(d, 62.0, 12.0, (0.07, 0.75), 0.012), np.array([9.0, 5.6, 2.7]))
    window = panel(d, 150.0, 16.0, (0.55, 0.42), 0.012)
    bars = np.maximum(panel(d, 150.0, 16.0, (0.018, 0.5), 0.008), panel(d, 150.0, 16.0, (0.6, 0.016), 0.008))
    sky = np.clip((y - 0.0) / 0.6, 0.0, 1.0)[..., None]
    add(window, (1 - sky) * np.array([3.6, 3.7, 3.6]) + sky * np.array([0.9, 1.7, 3.4]))
    add(bars * window, np.array([0.02, 0.02, 0.02]))
    add(panel(d, -140.0, 2.0, (0.14, 0.12), 0.03), np.array([1.9, 0.25, 0.10]))
    return image.astype(np.float32)


def unit(azimuth: float, elevation: float) -> np.ndarray:
    """A direction from its angles in degrees."""
    a, e = np.radians([azimuth, elevation])
    return np.array([np.cos(e) * np.sin(a), np.sin(e), -np.cos(e) * np.cos(a)])


def main() -> None:
    """Write the image."""
    FILE.parent.mkdir(parents=True, exist_ok=True)
    spec = oiio.ImageSpec(WIDTH, HEIGHT, 3, "half")
    spec.attribute("compression", "zip")
    spec.attribute(
        "ImageDescription", "A studio, linear sRGB, latitude-longitude; made by tools/make_environment.py"
    )
    spec.attribute("DateTime", "1970:01:01 00:00:00")
    spec.attribute("Software", "tools/make_environment.py")
    spec.attribute("oiio:ColorSpace", "lin_rec709")
    output = oiio.ImageOutput.create(str(FILE))
    if not output.open(str(FILE), spec) or not output.write_image(studio()):
        raise SystemExit(output.geterror())
    output.close()
    print(f"{FILE.name}: {FILE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
