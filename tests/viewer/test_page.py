"""The viewer in a real browser: Chromium without a window, driven as a person would; judged by pixels.

It is found as `chromium` on the path (Debian: apt-get install chromium); where there is none, these tests are skipped.
"""

import io
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import PIL.Image
import pytest
from matplotlib import colormaps
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError

from illuminant.viewer import view
from illuminant.viewer.composition import compose
from illuminant.viewer.refinement import _same
from illuminant.viewer.scale import amount

SIZE = {"width": 700, "height": 480}
CANVAS = (slice(210, 460), slice(20, 240))
"""The part of a screenshot that no control covers."""

PATIENCE_S = 180.0
"""A machine with two cores, both busy, is slow; a test that waits in vain fails all the same."""

AGREES = 3.0
"""Codes by which blocks of a screenshot may differ from what was sent: the browser may shift it by part of a pixel."""


@pytest.fixture(scope="module")
def browser(chromium: str) -> Iterator[Any]:
    """Chromium."""
    from playwright.sync_api import sync_playwright

    software = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox", *software])
        yield opened
        opened.close()


def until(holds: Callable[[], Any], seconds: float = PATIENCE_S) -> Any:
    """Wait until something holds, and return it."""
    end = time.monotonic() + seconds
    while not (found := holds()):
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.05)
    return found


def blocks(codes: np.ndarray) -> np.ndarray:
    """Means over blocks of 10 by 10 pixels."""
    return codes.reshape(25, 10, 22, 10, 3).astype(float).mean(axis=(1, 3))


class Page:
    """A page of a viewer, with the session behind it."""

    def __init__(self, browser: Any, viewer: Any) -> None:
        known = set(viewer.sessions)
        self.viewer = viewer
        self.page = browser.new_page(viewport=SIZE)
        self.page.set_default_timeout(1000 * PATIENCE_S)
        self.page.goto(viewer.url)
        self.until(lambda: set(viewer.sessions) - known)
        self.session = viewer.sessions[(set(viewer.sessions) - known).pop()]
        self.full()

    def until(self, holds: Callable[[], Any]) -> Any:
        """Wait until something holds, and let the browser work meanwhile."""
        return until(lambda: self.page.wait_for_timeout(50) or holds())

    def full(self, samples: int = 1) -> None:
        """Wait until the page shows a whole picture of what is chosen, from where its camera stands."""

        def there() -> bool:
            session, frame = self.session, self.session.sent
            return (
                frame is not None
                and not frame.preview
                and frame.samples >= samples
                and frame.request.number == session.refiner._number
                and _same(frame.request.state, session.state)
                and frame.request.camera == session.camera()
                and self.shows_what_was_sent()
            )

        self.until(there)

    def shows_what_was_sent(self) -> bool:
        """Whether a screenshot agrees with the codes that were sent last."""
        codes = self.session.codes
        rows, columns = (np.arange(n) for n in (SIZE["height"], SIZE["width"]))
        scaled = codes[rows * codes.shape[0] // len(rows)][:, columns * codes.shape[1] // len(columns)]
        return np.abs(blocks(self.pixels()) - blocks(scaled[CANVAS])).mean() < AGREES

    def pixels(self) -> np.ndarray:
        """What the page shows, where no control covers it, as codes."""
        with PIL.Image.open(io.BytesIO(self.page.screenshot())) as shot:
            return np.asarray(shot.convert("RGB"))[CANVAS].astype(float)

    def differs(self, before: np.ndarray, codes: float) -> np.ndarray:
        """Wait until the page shows something that differs so much from before; what it shows."""

        def seen() -> list[np.ndarray]:
            now = self.pixels()
            return [now] if np.abs(now - before).mean() > codes else []

        return self.until(seen)[0]

    def choose(self, label: str, value: str) -> None:
        """Choose from a list, and wait until something else is rendered."""
        number = self.session.refiner._number

        def chosen() -> bool:
            # A list that is clicked while its tab still unfolds closes again.
            self.page.get_by_label(label, exact=True).first.click()
            try:
                self.page.get_by_role("option", name=value, exact=True).click(timeout=10_000)
            except PlaywrightTimeoutError:
                return False
            return True

        self.until(chosen)
        self.until(lambda: self.session.refiner._number > number)


@contextmanager
def opened(browser: Any, scene: Any, **options: Any) -> Iterator[Page]:
    """A viewer with one page."""
    with view(scene, port=0, **options) as viewer:
        page = Page(browser, viewer)
        yield page
        page.page.close()
        until(lambda: not viewer.sessions)


@pytest.fixture(scope="module")
def page(browser, repository, tmp_path_factory) -> Iterator[Page]:
    folder = tmp_path_factory.mktemp("kept")
    with opened(browser, repository / "scenes" / "cornell.toml", folder=folder) as found:
        yield found


def test_the_page_shows_the_scene_as_it_is_rendered(page):
    page.full(4)  # the screenshot agrees with what was sent
    frame, state = page.session.frame, page.session.state
    rendered = compose(frame.image.xyz, state).codes
    assert rendered.shape == (SIZE["height"], SIZE["width"], 3)
    seen = page.pixels()
    assert np.abs(blocks(seen) - blocks(rendered[CANVAS])).mean() < AGREES
    assert seen.mean() > 20.0


def test_orbiting_shows_another_view_of_the_same_scene(page):
    before, camera = page.pixels(), page.session.camera()
    page.page.mouse.move(150, 300)
    page.page.mouse.down()
    page.page.mouse.move(210, 320, steps=6)
    page.page.mouse.up()
    page.until(lambda: page.session.camera()["eye"] != camera["eye"])
    page.full()
    after = page.differs(before, 5.0)
    page.session.preset("scene")
    page.until(lambda: np.allclose(page.session.camera()["eye"], camera["eye"]))
    page.full(4)
    page.until(lambda: np.abs(page.pixels() - before).mean() < np.abs(after - before).mean() / 2)


def test_another_technique_is_another_picture(page):
    page.full(4)
    before = page.pixels()
    page.choose("technique", "gouraud")
    page.until(lambda: page.session.state.technique == "gouraud")
    page.full()
    page.differs(before, 3.0)
    page.choose("technique", "path")
    page.full(4)


def test_a_lamp_of_another_spectrum_colours_the_room(page):
    page.full(4)
    before = page.pixels().mean(axis=(0, 1))
    page.page.get_by_text("Lamps", exact=True).click()
    page.choose("spectrum", "FL7")
    page.full(4)

    def bluer() -> bool:
        after = page.pixels().mean(axis=(0, 1))
        return after[2] / after[0] > 1.3 * before[2] / before[0]

    page.until(bluer)  # daylight is bluer than an incandescent lamp


def test_a_lamp_takes_a_spectrum_from_a_file(page, tmp_path):
    file = tmp_path / "sodium.csv"
    file.write_text("wavelength_nm,emission\n580,0\n589,1\n598,0\n")
    session = page.session
    before = set(session.folder.iterdir())
    with page.page.expect_file_chooser() as chooser:
        page.page.get_by_role("button", name="spectrum from a file").first.click()
    chooser.value.set_files(file)
    page.until(lambda: set(session.folder.iterdir()) - before)
    page.until(lambda: "file" in session.state.tables["materials"]["lamp"]["spectrum"])
    page.full(4)

    def yellow() -> bool:
        red, green, blue = page.pixels().mean(axis=(0, 1))
        return red > green > 5 * blue

    page.until(yellow)
    kept = (set(session.folder.iterdir()) - before).pop()
    assert kept.read_bytes() == file.read_bytes()
    file.write_text("no spectrum")
    with page.page.expect_file_chooser() as chooser:
        page.page.get_by_role("button", name="spectrum from a file").first.click()
    chooser.value.set_files(file)
    page.until(lambda: "**" in session.panels._trouble.content)
    assert set(session.folder.iterdir()) - before == {kept}
    page.choose("spectrum", "FL7")
    assert session.panels._trouble.content == "", "a sentence on a mistake stays until the next choice"
    page.full(4)


def test_a_click_reads_spectrum_and_material(page):
    from playwright.sync_api import expect

    page.full(4)
    page.page.mouse.click(180, 260)
    found = page.until(lambda: page.session.last_reading)
    assert found.material
    assert len(found.wavelengths_nm) == 401
    assert found.luminance > 0
    frame = page.session.frame
    row, column = (int(f * n) for f, n in zip((260 / 480, 180 / 700), frame.image.xyz.shape[:2], strict=True))
    near = frame.image.xyz[row - 2 : row + 3, column - 2 : column + 3, 1].mean()
    assert found.luminance == pytest.approx(near, rel=0.25)
    told = page.page.get_by_text(f"luminance {amount(found.luminance)} cd/m²")
    expect(told.first).to_be_visible(timeout=1000 * PATIENCE_S)


def test_a_page_can_choose_only_what_is_offered(page):
    """Whoever writes to the WebSocket sends what he likes: here a file in place of a display."""
    panel, state = page.session.panels.display, page.session.state
    control = panel._display
    known = control.value
    control._impl.value = "/etc/hostname"
    panel._stops.value = panel._stops.value + 0.1
    page.until(lambda: "not one of the choices" in page.session.panels._trouble.content)
    assert page.session.state.look.display == state.look.display
    control._impl.value = known


def test_a_map_of_illuminance_is_shown_with_its_scale(page):
    page.full(4)
    before, session = page.pixels(), page.session
    page.page.get_by_text("Display", exact=True).click()
    page.choose("show", "illuminance in false colours")
    page.until(lambda: session.sent.illuminance is not None and page.shows_what_was_sent())
    page.differs(before, 10.0)
    lux = session.sent.illuminance
    row, column = int(260 / 480 * lux.shape[0]), int(180 / 700 * lux.shape[1])
    low, high = session.composition.scale
    assert session.composition.title.startswith("illuminance, lx")
    assert low < lux[row, column] < 2 * high
    # The lowest part of the bar is violet, the rest of it green and yellow.
    bar = session.codes[-60:-20, 20:290].reshape(-1, 3)
    for part in (0.0, 0.5, 1.0):
        colour = np.array(colormaps["viridis"](part, bytes=True)[:3])
        assert (np.abs(bar.astype(int) - colour).max(axis=1) <= 3).any(), part
    page.choose("technique", "gouraud")
    page.until(lambda: "no map of illuminance" in session.panels._trouble.content)
    page.choose("technique", "path")
    page.choose("show", "picture")
    page.full(4)
    page.until(lambda: np.abs(page.pixels() - before).mean() < 10.0)


def test_the_buttons_of_keep_write_files_and_say_which(page):
    from playwright.sync_api import expect

    page.full(4)
    session, tab = page.session, page.page
    tab.get_by_text("Keep", exact=True).click()
    for button, endings in {
        "image (PNG and EXR)": [".exr", ".png"],
        "scene (TOML)": [".toml"],
        "spectrum of the last reading (CSV)": [".csv"],
    }.items():
        before = set(session.folder.iterdir())
        tab.get_by_role("button", name=button, exact=True).click()

        def written(before: set[Any] = before) -> set[Any]:
            return {file for file in session.folder.iterdir() if not file.name.startswith(".")} - before

        page.until(lambda written=written, endings=endings: len(written()) == len(endings))
        assert sorted(file.suffix for file in written()) == endings
        for file in written():
            expect(tab.get_by_text(file.name).first).to_be_visible(timeout=1000 * PATIENCE_S)
            page.until(lambda file=file: file.stat().st_size > 0)
    before = set(session.folder.iterdir())
    tab.get_by_role("button", name="solution of radiosity", exact=True).click()
    told = tab.get_by_text("There is no solution").first
    expect(told).to_be_visible(timeout=1000 * PATIENCE_S)
    assert set(session.folder.iterdir()) == before
    tab.get_by_role("button", name="command line", exact=True).click()
    expect(tab.get_by_text("illuminant render").first).to_be_visible(timeout=1000 * PATIENCE_S)


def test_what_is_kept_is_valid_and_stays_in_the_folder(page):
    from illuminant import spectrum_file
    from illuminant.image import Image
    from illuminant.scene import load
    from illuminant.viewer import keeping

    session = page.session
    before = set(session.folder.iterdir())
    png, exr = keeping.image(session)
    scene = keeping.scene(session)[0]
    csv = keeping.spectrum(session)[0]
    assert {png, exr, scene, csv} == set(session.folder.iterdir()) - before
    assert Image.open(exr).xyz.shape == session.frame.image.xyz.shape
    kept, shown = load(scene).description, session.state.scene.description
    assert {key: one for key, one in kept.items() if key != "camera"} == {
        key: one for key, one in shown.items() if key != "camera"
    }
    camera = session.camera()
    for key in ("eye", "field_of_view_deg", "size"):
        assert np.allclose(kept["camera"][key], camera[key], atol=1e-6), key
    assert tomllib.loads(scene.read_text())["materials"]["lamp"]["spectrum"] == "FL7"
    read = spectrum_file.read(csv)
    assert np.array_equal(read.values, session.last_reading.radiance)
    assert np.array_equal(read.wavelengths_nm, session.last_reading.wavelengths_nm)
    again = keeping.image(session)[0]
    assert again != png, "nothing is overwritten"


def test_the_command_line_makes_the_view_again(page):
    import shlex

    from illuminant.cli import run
    from illuminant.viewer import keeping

    program, *words = shlex.split(keeping.command(page.session))
    assert program == "illuminant"
    picture = page.session.folder / "again.png"
    words[words.index("-o") + 1] = str(picture)
    words[words.index("--samples") + 1] = "4"
    assert run(words) == 0
    with PIL.Image.open(picture) as image:
        assert list(image.size) == page.session.camera()["size"]


def test_two_pages_do_not_disturb_each_other(browser, page):
    from dataclasses import replace

    second = Page(browser, page.viewer)
    number = page.session.refiner._number
    second.session.look_at(replace(second.session.state, stops=2.0))
    second.session.change(replace(second.session.state, technique="constant", illumination="bouknight"))
    second.full()
    assert page.session.state.technique == "path"
    assert page.session.refiner._number == number
    second.differs(page.pixels(), 5.0)
    thread = second.session.refiner._thread
    second.page.close()
    page.until(lambda: len(page.viewer.sessions) == 1)
    page.until(lambda: not thread.is_alive())


def test_a_broken_scene_shows_its_mistakes(browser, repository, tmp_path):
    broken = tmp_path / "broken.toml"
    broken.write_text((repository / "scenes" / "cornell.toml").read_text().replace("kind =", "knd =", 1))
    with view(broken, port=0) as viewer:
        tab = browser.new_page(viewport=SIZE)
        tab.set_default_timeout(1000 * PATIENCE_S)
        tab.goto(viewer.url)
        tab.get_by_text("The scene cannot be shown").wait_for(timeout=1000 * PATIENCE_S)
        tab.get_by_text("materials.white").first.wait_for(timeout=1000 * PATIENCE_S)
        tab.close()


def test_radiosity_is_relit_at_once(browser, repository):
    with opened(browser, repository / "scenes" / "cornell.toml", technique="radiosity") as page:
        session = page.session
        before = page.pixels()
        kind, name, table = "materials", "lamp", session.state.tables["materials"]["lamp"]
        dimmed = session.state.with_tables(**{kind: {name: table | {"spectrum": "FL7"}}})
        session.change(dimmed)
        page.full()
        assert session.refiner.relit_seconds is not None
        relit = page.differs(before, 3.0)
        session.wire("patches")
        page.until(lambda: (np.abs(page.pixels() - relit).max(axis=2) > 20).mean() > 0.01)
        session.wire("none")
        page.until(lambda: np.abs(page.pixels() - relit).mean() < 2.0)
