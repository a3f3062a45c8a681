"""Draw the pictures of docs/viewer.md: `python tools/draw_viewer.py` writes screenshots of the page into docs/images.

The page is opened in Chromium without a window (`chromium` on the path) and used as a person would use it. With names
(`look`, `change`, `measure`, `illuminance`, `compare`) only those are drawn.
"""

from __future__ import annotations

import io
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PIL import Image

from illuminant.viewer import view

ROOT = Path(__file__).parent.parent
IMAGES = ROOT / "docs" / "images"
SIZE = {"width": 960, "height": 640}
LARGEST = 250_000
SOFTWARE = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PATIENCE_S = 240.0


class Page:
    """A page of a viewer, with its session."""

    def __init__(self, tab: Any, session: Any) -> None:
        self.tab, self.session = tab, session

    def until(self, holds: Callable[[], Any]) -> None:
        """Wait until something holds."""
        end = time.monotonic() + PATIENCE_S
        while not holds():
            if time.monotonic() > end:
                raise SystemExit("the page did not get there in time")
            self.tab.wait_for_timeout(100)

    def rendered(self, samples: int) -> None:
        """Wait for a whole picture of what is chosen, of so many samples."""
        self.tab.wait_for_timeout(500)

        def there() -> bool:
            frame = self.session.frame
            if frame is None or frame.preview or frame.samples < samples:
                return False
            return frame.request.state.scene is self.session.state.scene

        self.until(there)
        self.tab.wait_for_timeout(1500)

    def fold(self, *names: str) -> None:
        """Open or close folders."""
        for name in names:
            self.tab.get_by_text(name, exact=True).first.click()
        self.tab.wait_for_timeout(400)

    def choose(self, label: str, value: str) -> None:
        """Choose from a list."""
        self.tab.get_by_label(label, exact=True).first.click()
        self.tab.get_by_role("option", name=value, exact=True).click()

    def read(self, x: int, y: int) -> None:
        """Click a point of the picture, and wait for its reading."""
        self.session.last_reading = None
        self.tab.mouse.click(x, y)
        self.until(lambda: self.session.last_reading)
        self.tab.wait_for_timeout(1000)

    def save(self, path: Path) -> None:
        """Save a screenshot, in fewer colours where it would not be small."""
        with Image.open(io.BytesIO(self.tab.screenshot())) as shot:
            picture = shot.convert("RGB")
        picture.save(path, optimize=True)
        for colours in (256, 128, 64):
            if path.stat().st_size <= LARGEST:
                return
            method = Image.Quantize.MAXCOVERAGE  # keeps the few colours of chart and scale
            few = picture.quantize(colours, method, dither=Image.Dither.FLOYDSTEINBERG)
            few.save(path, optimize=True)
        if path.stat().st_size <= LARGEST:
            return
        raise SystemExit(f"{path} has more than {LARGEST:,} bytes")


@contextmanager
def opened(browser: Any, scene: str, **options: Any) -> Iterator[Page]:
    """A viewer of a scene, and a page of it."""
    with (
        tempfile.TemporaryDirectory() as folder,
        view(ROOT / "scenes" / scene, port=0, folder=folder, **options) as viewer,
    ):
        tab = browser.new_page(viewport=SIZE)
        tab.goto(viewer.url)
        while not viewer.sessions:
            tab.wait_for_timeout(100)
        page = Page(tab, next(iter(viewer.sessions.values())))
        tab.locator(".mantine-Notification-closeButton").first.click()  # no graphics card is needed here
        yield page
        tab.close()


def look(browser: Any) -> None:
    """A room as its own camera sees it."""
    with opened(browser, "reading-room.toml") as page:
        page.rendered(4)
        page.save(IMAGES / "viewer-look.png")


def change(browser: Any) -> None:
    """The Cornell box by radiosity under a lamp of the library, with its patches."""
    with opened(browser, "cornell.toml", technique="radiosity") as page:
        page.rendered(1)
        page.choose("wireframe", "patches")
        page.fold("Measure", "Lamps", "Material")
        page.choose("spectrum", "FL7")
        page.rendered(4)
        page.save(IMAGES / "viewer-change.png")


def measure(browser: Any) -> None:
    """Luminance in false colours, and the reading of a point."""
    with opened(browser, "cornell.toml") as page:
        page.rendered(16)
        page.fold("Picture")
        page.read(200, 400)
        page.fold("Display")
        page.choose("show", "luminance in false colours")
        page.fold("Display")
        page.tab.mouse.move(750, 300)
        page.tab.mouse.wheel(0, -2000)
        page.tab.wait_for_timeout(1000)
        page.save(IMAGES / "viewer-measure.png")


def illuminance(browser: Any) -> None:
    """Illuminance in false colours, by the solution of radiosity."""
    with opened(browser, "cornell.toml", technique="radiosity") as page:
        page.rendered(1)
        page.fold("Picture", "Measure", "Display")
        page.choose("show", "illuminance in false colours")

        def fine() -> bool:
            lux = page.session.sent.illuminance
            return lux is not None and lux.size > 50_000

        page.until(fine)
        page.tab.wait_for_timeout(1500)
        page.save(IMAGES / "viewer-illuminance.png")


def compare(browser: Any) -> None:
    """Two lamps side by side."""
    with opened(browser, "cornell.toml", technique="radiosity") as page:
        page.rendered(4)
        page.fold("Picture", "Measure", "Compare", "Lamps")
        page.tab.get_by_label("hold at the left", exact=True).click()
        page.until(lambda: page.session.held_frame is not None and not page.session.held_frame.preview)
        page.choose("spectrum", "FL11")
        page.session.panels.compare.divider.value = 0.34
        page.until(lambda: page.session.divider == 0.34)
        page.rendered(4)
        page.save(IMAGES / "viewer-compare.png")


DRAWN = {
    "viewer-look.png": look,
    "viewer-change.png": change,
    "viewer-measure.png": measure,
    "viewer-illuminance.png": illuminance,
    "viewer-compare.png": compare,
}


def main() -> None:
    """Draw them all, or those that are named."""
    from playwright.sync_api import sync_playwright

    found = shutil.which("chromium")
    if found is None:
        raise SystemExit("there is no chromium on the path: apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found, args=SOFTWARE)
        for name, draw in DRAWN.items():
            if len(sys.argv) == 1 or draw.__name__ in sys.argv[1:]:
                draw(browser)
                print(f"{name}: {(IMAGES / name).stat().st_size:,} bytes", flush=True)
        browser.close()


if __name__ == "__main__":
    main()
