"""Draw the pictures of docs/display.md: `python tools/draw_display.py` writes them into docs/images."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

from illuminant.display import gamut_study
from illuminant.display.look import Look, show
from illuminant.plots import gamut_study as plots

IMAGES = Path(__file__).parent.parent / "docs" / "images"
STRIPS = ["constant-intensity", "scale", "clamp", "cook", "oklab", "soft"]


def main() -> None:
    """Draw them all."""
    deviation, paths = IMAGES / "gamut-deviation.png", IMAGES / "gamut-paths.png"
    plots.save_deviation(["constant-intensity", "scale", "clamp", "cook", "oklab"], "lab", deviation)
    plots.save_paths(["constant-intensity", "scale", "clamp"], paths)
    for path in (deviation, paths):
        with Image.open(path) as drawn:
            small = drawn.convert("RGB").resize(
                (drawn.width // 2, drawn.height // 2), Image.Resampling.LANCZOS
            )
        small.quantize(128).save(path, optimize=True)
    strips = gamut_study.strips(STRIPS, hues=4, width=640, band=8)
    show(strips, Look(gamut="clamp")).picture.save(IMAGES / "gamut-strips.png")


if __name__ == "__main__":
    main()
