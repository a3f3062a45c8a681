"""A real browser shows the pictures as the right pixels: Chromium without a window, on a screen of sRGB.

It is found as `chromium` on the path (Debian: apt-get install chromium); where there is none, the test is skipped.
"""

import subprocess
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

from illuminant.display.displays import named
from illuminant.display.picture import Picture

DISPLAYS = ("sRGB", "Display P3", "Adobe RGB")

PATCH = 16
"""Pixels along a side of a patch."""

# Greys, and colours of any kind: codes of 8 bits of each display.
CODES = np.random.default_rng(11).integers(0, 256, (5, 8, 3), dtype=np.uint8)
CODES[0] = np.linspace(0, 255, 8).round()[:, None]


@pytest.fixture(scope="module")
def seen(chromium: str, tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """What the browser makes of the picture for each display: codes (5, 8, 3) of sRGB in the middle of the patches."""
    folder: Path = tmp_path_factory.mktemp("browser")
    big = np.repeat(np.repeat(CODES, PATCH, axis=0), PATCH, axis=1)
    rows = ["<!doctype html><style>body{margin:0;background:black}img{display:block}</style>"]
    for name in DISPLAYS:
        Picture(big, named(name), 8).save(folder / f"{name}.png")
        rows.append(f'<img src="{name}.png">')
    (folder / "page.html").write_text("\n".join(rows))
    done = subprocess.run(
        [
            chromium,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--force-color-profile=srgb",
            "--force-device-scale-factor=1",
            f"--window-size={big.shape[1] + 200},{len(DISPLAYS) * big.shape[0] + 200}",
            f"--user-data-dir={folder / 'profile'}",
            f"--screenshot={folder / 'seen.png'}",
            (folder / "page.html").as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert (folder / "seen.png").is_file(), done.stderr
    with PIL.Image.open(folder / "seen.png") as image:
        screen = np.asarray(image.convert("RGB")).astype(int)
    height = big.shape[0]
    places = slice(PATCH // 2, None, PATCH)
    return {
        name: screen[k * height : (k + 1) * height, : big.shape[1]][places, places]
        for k, name in enumerate(DISPLAYS)
    }


@pytest.mark.parametrize("name", DISPLAYS)
def test_a_browser_shows_each_picture_in_its_own_colours(name: str, seen: dict[str, np.ndarray]) -> None:
    display, screen = named(name), named("sRGB")
    # White is shown as white.
    linear = screen.from_xyz(display.to_xyz(CODES / 255.0) * screen.peak / display.peak)
    inside = ((linear > -1e-9) & (linear < 1.0 + 1e-9)).all(axis=-1)
    assert inside.sum() >= 15
    wanted = np.rint(255.0 * screen.encode(linear)).astype(int)
    assert np.abs(seen[name] - wanted)[inside].max() <= 1
    if name == "sRGB":
        np.testing.assert_array_equal(seen[name], CODES)
    else:
        # Shown as if it were for sRGB, it would be far off.
        assert np.abs(seen[name] - CODES.astype(int))[inside].max() > 10
