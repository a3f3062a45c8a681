"""Memory of the viewer under use: random moves and changes, pages opened and closed; prints memory over time.

    .venv/bin/python benches/viewer_soak.py                   # ten minutes
    .venv/bin/python benches/viewer_soak.py --minutes 3

A person who never rests: the camera turns, technique, sampling, lamp and paint change, each after 0.05 to 2 s, and one
page in twenty is closed in the middle of its work for a new one. What is kept for one setting (scene, wavelengths, a
solution) comes and goes, so memory goes up and down; growth is that of the median of the last third over that of the
middle third.
"""

from __future__ import annotations

import argparse
import datetime
import os
import random
import statistics
import threading
import time
from dataclasses import replace
from pathlib import Path

from illuminant.viewer.state import State
from viewer_page import SCENES, Page

TECHNIQUES = ("path", "path", "raytrace", "gouraud", "distributed", "radiosity", "hybrid")


def memory_mb() -> float:
    """Resident memory of this process now, MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def act(page: Page, chance: random.Random) -> str:
    """Do something that a person could do; what was done."""
    what = chance.choices(["turn", "lamp", "paint", "technique", "sampling"], [12, 3, 3, 1, 1])[0]
    state = page.state
    if what == "turn":
        page.turn(chance.uniform(-25.0, 25.0), chance.uniform(0.7, 1.0))
    elif what == "lamp":
        lamp = dict(state.tables["materials"]["lamp"], spectrum=chance.choice(["A", "D65", "FL7", "FL11"]))
        page.state = state.with_tables(materials={"lamp": lamp})
    elif what == "paint":
        paint = {"kind": "diffuse", "reflectance": round(chance.uniform(0.1, 0.9), 2)}
        page.state = state.with_tables(materials={chance.choice(["white", "red", "green"]): paint})
    elif what == "technique":
        page.state = replace(state, technique=chance.choice(TECHNIQUES), illumination="general")
    else:
        page.state = replace(state, sampling=chance.choice(["fitted:8", "uniform:8", "hall:4"]))
    page.ask()
    return what


def main() -> None:
    """Use the viewer, and print memory."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--size", type=int, nargs=2, default=(640, 400))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance, size = random.Random(options.seed), (options.size[0], options.size[1])
    start = State.of(SCENES / "cornell.toml", elements=1000)
    length, begun = 60.0 * options.minutes, time.monotonic()
    memory: list[tuple[float, float]] = [(0.0, memory_mb())]
    done, pages, wrong, printed = 0, 1, set[str](), 0.0
    print(f"{datetime.date.today()}, {size[0]} x {size[1]}, seed {options.seed}")
    print(f"{'seconds':>8}{'MB':>8}{'threads':>9}{'changes':>9}{'pages':>7}", flush=True)
    page = Page(start, size)
    while (now := time.monotonic() - begun) < length:
        if chance.random() < 0.05:
            page.close()
            wrong |= set(page.said)
            page, pages = Page(start, size), pages + 1
            page.ask()
        act(page, chance)
        done += 1
        time.sleep(chance.choice([0.05, 0.2, 0.5, 2.0]))
        memory.append((now, memory_mb()))
        if now >= printed:
            print(f"{now:8.0f}{memory[-1][1]:8.0f}{threading.active_count():9}{done:9}{pages:7}", flush=True)
            printed += length / 12
    page.close()
    wrong |= set(page.said)
    thirds = [
        statistics.median(mb for at, mb in memory if low <= at / length < low + 1 / 3)
        for low in (0.0, 1 / 3, 2 / 3)
    ]
    print(f"start {memory[0][1]:.0f} MB; medians of the thirds {', '.join(f'{mb:.0f}' for mb in thirds)} MB")
    print(f"growth from the middle third to the last: {100 * (thirds[2] / thirds[1] - 1):+.1f} %")
    print(f"sentences of refusal: {len(wrong)}" + "".join(f"\n  {one}" for one in sorted(wrong)))


if __name__ == "__main__":
    main()
