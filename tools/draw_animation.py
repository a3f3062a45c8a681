"""Draw the pictures of docs/animation.md: `python tools/draw_animation.py` renders frames of scenes/turntable.toml."""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from illuminant import plots
from illuminant.animation import Animation
from illuminant.display.picture import Picture
from illuminant.frames import render_frames
from illuminant.plots.contact_sheet import picture_sheet

ROOT = Path(__file__).parent.parent
SCENE = ROOT / "scenes" / "turntable.toml"
IMAGES = ROOT / "docs" / "images"
OPTIONS: dict[str, Any] = {"samples": 64, "size": (176, 132)}


def pictures(animation: Animation, frames: str) -> list[Any]:
    """The code values of frames."""
    with tempfile.TemporaryDirectory() as folder:
        made = render_frames(animation, frames, Path(folder) / "####.png", **OPTIONS)
        return [Picture.open(frame.files[0]).codes for frame in made]


def turning(tables: Mapping[str, Any], camera: Mapping[str, Any], **more: Any) -> Animation:
    """The turntable, turning twice in a second of 30 frames."""
    keys = dict(tables["animation"]["keys"])
    for name in ("objects.cube.rotate.degrees", "objects.ball.rotate.degrees"):
        keys[name] = {"times": [0.0, 1.0], "values": [0.0, 720.0]}
    animation = {"frames": [0, 29], "frames_per_second": 30.0, "keys": keys, **more}
    return Animation.build(
        {**tables, "camera": {**tables["camera"], **camera}, "animation": animation}, SCENE.parent
    )


def main() -> None:
    """Draw both."""
    tables = tomllib.loads(SCENE.read_text(encoding="utf-8"))
    animation = Animation.load(SCENE)
    strip = pictures(animation, "0-47x6")
    times = [f"{animation.time(number):g} s" for number in range(0, 48, 6)]
    plots.save(picture_sheet(strip, times, columns=4), IMAGES / "animation.png")
    cases = {
        "no shutter": turning(tables, {}),
        "shutter = [0.0, 0.5]": turning(tables, {"shutter": [0.0, 0.5]}),
        'fields = "odd-first"': turning(tables, {}, fields="odd-first"),
    }
    moving = [pictures(case, "3")[0] for case in cases.values()]
    plots.save(picture_sheet(moving, list(cases), columns=3), IMAGES / "animation-shutter.png")


if __name__ == "__main__":
    main()
