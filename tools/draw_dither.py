"""Draw the pictures of docs/dither.md: `python tools/draw_dither.py` writes them into docs/images."""

from __future__ import annotations

import tempfile
from pathlib import Path

from PIL import Image

from illuminant.cli import run
from illuminant.display import displays
from illuminant.display.picture import Picture
from illuminant.plots import dither_study as plots

IMAGES = Path(__file__).parent.parent / "docs" / "images"
HALFTONES = "none,pattern-2x2,ordered-4,dot-diffusion,floyd-steinberg,blue-noise"
SPECTRA = ["random", "bayer-8", "blue-noise", "floyd-steinberg", "floyd-steinberg-book", "dot-diffusion"]


def half(path: Path) -> Picture:
    """A picture at half its size: blocks of four pixels by the mean of their light."""
    whole = Picture.open(path)
    light = whole.display.decode(whole.values)
    height, width = light.shape[0] // 2, light.shape[1] // 2
    mean = light[: 2 * height, : 2 * width].reshape(height, 2, width, 2, 3).mean(axis=(1, 3))
    return Picture.of_values(whole.display.encode(mean), displays.named("sRGB"))


def main() -> None:
    """Draw them all."""
    path = IMAGES / "dither-bands.png"
    assert run(["dither", "compare", "--enlarge", "3", "--band", "24", "-o", str(path)]) == 0
    with tempfile.TemporaryDirectory() as folder:
        room = Path(folder) / "room.png"
        half(IMAGES / "starter.png").save(room)
        path = IMAGES / "dither-halftones.png"
        options = ["--grey", "--dithers", HALFTONES, "--columns", "2"]
        assert run(["dither", "compare", str(room), *options, "-o", str(path)]) == 0
    patterns, spectra = IMAGES / "dither-patterns.png", IMAGES / "dither-spectra.png"
    plots.save_patterns(None, patterns)
    plots.save_spectra(SPECTRA, spectra)
    for path in (patterns, spectra):
        with Image.open(path) as drawn:
            small = drawn.convert("RGB").resize(
                (drawn.width // 2, drawn.height // 2), Image.Resampling.LANCZOS
            )
        small.quantize(128).save(path, optimize=True)


if __name__ == "__main__":
    main()
