"""Latency of the viewer: prints a table.

    .venv/bin/python benches/viewer.py
    .venv/bin/python benches/viewer.py --moves 5 --scenes cornell

Seconds from a request until the PNG for the browser is there, without the browser and its connection:

- first picture: a page of a scene that was read but never rendered; the picture is a small one;
- camera: the camera turns by 5° while a picture is being refined; the next picture, a small one;
- whole: after that, the first picture of full size;
- relight: the solution of radiosity for other lamps or paints (`Solution.of`), without and with its picture.
"""

from __future__ import annotations

import argparse
import statistics
import time
from dataclasses import replace
from typing import Any

from illuminant import radiosity
from illuminant.viewer.state import State
from viewer_page import SCENES, Page


def row(what: str, seconds: list[float]) -> None:
    """Print a row: median and worst, ms."""
    ms = [1000.0 * one for one in seconds]
    print(f"{what:46}{statistics.median(ms):10.0f}{max(ms):10.0f}{len(ms):6}", flush=True)


def latency(name: str, pages: int, moves: int, size: tuple[int, int]) -> None:
    """Measure first pictures and moves of the camera."""
    file = SCENES / f"{name}.toml"
    first, moved, whole = [], [], []
    for _ in range(pages):
        with Page(State.of(file), size) as page:
            first.append(page.wait(page.ask()).seconds)
    with Page(State.of(file), size) as page:
        page.wait(page.ask(), preview=False)
        for step in range(moves):
            time.sleep(0.5)  # the picture is being refined meanwhile
            page.turn(5.0 * (step % 7 - 3))
            number = page.ask()
            moved.append(page.wait(number).seconds)
            if step % 4 == 0:
                whole.append(page.wait(number, preview=False).seconds)
    row(f"{name}: first picture", first)
    row(f"{name}: camera", moved)
    row(f"{name}: whole picture", whole)


def relight(name: str, patches: int, times: int, size: tuple[int, int]) -> None:
    """Measure other lamps and paints on a solution of about so many patches; each side of an element is one."""
    state = State.of(SCENES / f"{name}.toml", technique="radiosity", elements=round(0.85 * patches))
    start = time.perf_counter()
    found = radiosity.solve(
        state.scene, technique="radiosity", sampling=state.sampling, elements=state.elements
    )
    seconds = time.perf_counter() - start
    print(f"{name}: {found.report['elements']} elements, {found.report['patches']} patches: {seconds:.1f} s")
    lamp = state.tables["materials"]["lamp"]
    lamps = [dict(lamp, spectrum=one) for one in ("FL7", "D65", "FL11", "A")]
    paints = [{"kind": "diffuse", "reflectance": one} for one in (0.3, 0.5, 0.7, 0.4)]

    def others(key: str, tables: list[dict[str, Any]]) -> None:
        states = [state.with_tables(materials={key: tables[i % len(tables)]}) for i in range(times)]
        spent = []
        for one in states:
            start = time.perf_counter()
            found.of(one.scene)
            spent.append(time.perf_counter() - start)
        row(f"{name}: {key} changed, solution alone", spent)

    others("lamp", lamps)
    others("white", paints)
    with Page(replace(state), size) as page:
        page.refiner.adopt(found, state)
        page.wait(page.ask(), preview=False)
        spent = []
        for step in range(times):
            page.state = replace(
                state.with_tables(materials={"lamp": lamps[step % len(lamps)]}), look=page.state.look
            )
            spent.append(page.wait(page.ask()).seconds)
        row(f"{name}: lamp changed, first picture", spent)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenes", nargs="+", default=["cornell", "demo"])
    parser.add_argument("--pages", type=int, default=5)
    parser.add_argument("--moves", type=int, default=20)
    parser.add_argument("--patches", type=int, default=10_000)
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 800))
    options = parser.parse_args()
    size = (options.size[0], options.size[1])
    print(f"viewer, {size[0]} x {size[1]}")
    print(f"{'':46}{'median ms':>10}{'worst ms':>10}{'runs':>6}")
    for name in options.scenes:
        latency(name, options.pages, options.moves, size)
    relight("cornell", options.patches, options.pages * 2, size)


if __name__ == "__main__":
    main()
