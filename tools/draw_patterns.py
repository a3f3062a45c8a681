"""Draw the pictures of docs/test-patterns.md: `python tools/draw_patterns.py` writes them into docs/images."""

from __future__ import annotations

from pathlib import Path

from illuminant.display import patterns

IMAGES = Path(__file__).parent.parent / "docs" / "images"

PICTURES = {
    "pattern-colorchecker.png": ("colorchecker", (330, 220)),
    "pattern-eia.png": ("eia", (320, 240)),
    "pattern-gamma.png": ("gamma", (440, 200)),
    "pattern-smpte.png": ("smpte", (320, 240)),
    "pattern-wedges.png": ("wedges", (480, 270)),
}
"""Pattern and size of each picture."""

for file, (name, (width, height)) in PICTURES.items():
    patterns.save(IMAGES / file, name, patterns.Screen(width, height))
    print(IMAGES / file)
