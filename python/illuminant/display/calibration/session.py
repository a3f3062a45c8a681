"""A folder to calibrate by: patterns to step through in a browser, and a table for the readings.

The folder holds

- `index.html`: shows one pattern after another, pixel for pixel, full screen; arrow keys step, `f` fills the screen,
  `t` hides the words;
- PNGs: those to adjust by, in the order of `illuminant.display.calibration.guide`, and a window for each reading;
- `readings.csv`: the code values of these windows, with empty places (see `readings`).

A browser takes part in colour management: while a display is measured its profile must be off (or sRGB), or the code
values that arrive are others.

With a description the windows are the ColorChecker's through it: their readings say how good it is (`verify`).
"""

from __future__ import annotations

import html
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output
from illuminant.display.calibration import readings
from illuminant.display.calibration.guide import STEPS
from illuminant.errors import ImageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.patterns.screen import Screen

    Array = NDArray[np.float64]

__all__ = ["ADJUST", "write"]

ADJUST: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("warm-up", "black", {}),
    ("crosshatch", "crosshatch", {}),
    ("dots", "dots", {}),
    ("white", "window", {"color": 1.0}),
    ("low", "window", {"color": 0.2}),
    ("middle", "window", {"color": 0.5}),
    ("steps", "steps", {}),
    ("gamma", "gamma", {}),
    ("pluge", "pluge", {}),
    ("smpte", "smpte", {}),
)
"""Patterns to adjust by: file, pattern, options."""

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>Calibration patterns</title>
<style>
html, body {{ margin: 0; height: 100%; background: #000; overflow: hidden; cursor: none }}
img {{ position: absolute; left: 50%; top: 50%; transform: translate(-50%, -50%); image-rendering: pixelated }}
p {{ position: absolute; left: 1em; bottom: 1em; margin: 0; font: 16px/1.4 sans-serif; color: #777; max-width: 60em }}
</style>
<img id="shown" alt=""><p id="words"></p>
<noscript><ol>{links}</ol></noscript>
<script>
const frames = {frames};
const shown = document.getElementById("shown"), words = document.getElementById("words");
let at = Math.min(Math.max(parseInt(location.hash.slice(1)) || 1, 1), frames.length) - 1;
function show() {{
  shown.src = frames[at].file;
  words.textContent = `${{at + 1}}/${{frames.length}}  ${{frames[at].words}}  (arrows: step, f: full screen, t: words)`;
  location.replace("#" + (at + 1));
}}
// A pixel of the picture is one of the screen, whatever the browser's zoom.
shown.onload = () => {{ shown.style.width = shown.naturalWidth / devicePixelRatio + "px"; }};
function step(by) {{ at = (at + by + frames.length) % frames.length; show(); }}
document.onkeydown = (event) => {{
  if (["ArrowRight", "ArrowDown", " ", "PageDown"].includes(event.key)) step(1);
  else if (["ArrowLeft", "ArrowUp", "PageUp"].includes(event.key)) step(-1);
  else if (event.key === "f") document.documentElement.requestFullscreen();
  else if (event.key === "t") words.hidden = !words.hidden;
}};
document.onclick = () => step(1);
show();
</script>
</html>
"""


def write(
    folder: str | os.PathLike[str],
    screen: Screen,
    *,
    codes: Array | None = None,
    window: float = 0.3,
    about: dict[str, str] | None = None,
) -> list[Path]:
    """Write the folder; it is made if there is none, and files in it of the same names are replaced.

    Args:
        folder: where to.
        screen: size, bits and display of the patterns.
        codes: (n, 3) code values to be read; default `readings.plan`, with the patterns to adjust by before them.
        window: side of the windows, as a fraction of the screen's.
        about: comments for the table.

    Returns:
        The files: page and table first.

    Raises:
        ImageError: the folder cannot be made or written.
        DataError: a table there has readings already; it is not overwritten.
    """
    from illuminant.display import patterns
    from illuminant.display.patterns.screen import Screen
    from illuminant.errors import DataError

    # A wrong window is told before anything is written.
    patterns.draw("window", Screen(32, 32), window=window)
    folder = Path(folder)
    table = folder / "readings.csv"
    if table.exists() and len(readings.read(table, empty=True).codes):
        raise DataError("This table has readings, and is not overwritten: name another folder.", str(table))
    frames: list[tuple[str, str]] = []
    # All are drawn before any is written, so that a screen that one does not fit leaves no files.
    drawn: list[tuple[Path, bytes]] = []
    if codes is None:
        for number, (file, name, options) in enumerate(ADJUST, 1):
            path = folder / f"adjust-{number:02d}-{file}.png"
            drawn.append((path, patterns.picture(name, screen, **options).encode()))
            step = next(
                (i for i, one in enumerate(STEPS, 1) if any(p.split()[0] == name for p in one.patterns)), 1
            )
            frames.append((path.name, f"step {step}, {STEPS[step - 1].title.lower()}: {file}"))
    wanted = readings.plan(bits=screen.bits) if codes is None else codes
    for number, code in enumerate(wanted.tolist(), 1):
        whole = [round(value * screen.most) for value in code]
        path = folder / f"read-{number:03d}.png"
        color = tuple(screen.code(value) for value in whole)
        drawn.append((path, patterns.picture("window", screen, color=color, window=window).encode()))
        frames.append((path.name, f"reading {number}: {','.join(map(str, whole))}"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ImageError(f"{folder} cannot be made: {reason}.") from error
    for path, content in drawn:
        output.write_bytes(path, content)
    output.write_bytes(table, readings.table(wanted, None, about, bits=screen.bits).encode())
    page = folder / "index.html"
    links = "".join(f'<li><a href="{file}">{html.escape(words)}</a>' for file, words in frames)
    listed = json.dumps([{"file": file, "words": words} for file, words in frames])
    output.write_bytes(page, _PAGE.format(frames=listed.replace("<", "\\u003c"), links=links).encode())
    return [page, table, *(folder / file for file, _ in frames)]
