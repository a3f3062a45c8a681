"""The order of the site: what stands under which heading.

A page of the manual that is not named here stands at the end of the topics, one of `docs/way` at the end of the way,
and one of the atlas in its chapter, so that none is lost.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from dialect import heading
from python_reference import FOLDER, Reference

__all__ = ["navigation", "toml"]

START = ("install.md", "first-material.md", "spectra.md")
"""Install, the first image, and materials and lamps of one's own."""

WAY = (
    "index.md",
    "lamps.md",
    "materials.md",
    "surfaces.md",
    "models.md",
    "transport.md",
    "radiosity.md",
    "sampling.md",
    "eye.md",
    "display.md",
    "choosing.md",
)
"""The way of light, from the lamp to the display (`docs/way`)."""

TOPICS = (
    "physics.md",
    "optics.md",
    "models.md",
    "radiosity.md",
    "sampling.md",
    "colorimetry.md",
    "color.md",
    "display.md",
    "gamma.md",
    "dither.md",
    "video.md",
    "test-patterns.md",
    "calibration.md",
    "develop.md",
    "animation.md",
    "farm.md",
    "reliability.md",
    "security.md",
)
REFERENCE = ("scene-file.md", "command-line.md", "commands.md")
PROOF = ("validation.md", "benchmarks.md", "benches.md")
PROJECT = ("readme.md", "dependencies.md", "contributing.md", "reporting.md", "changelog.md")

TITLES = {
    "index.md": "illuminant",
    "readme.md": "About",
    "reporting.md": "Reporting a fault",
    "benches.md": "Adding a peer",
    "atlas/index.md": "The atlas",
}
"""Titles that are not the heading of their page."""

CHAPTERS = {
    "1": "1 Introduction",
    "2": "2 The illumination process",
    "3": "3 Perceptual response",
    "4": "4 Illumination models",
    "5": "5 Image display",
    "I": "Appendix I",
    "II": "Appendix II",
    "III": "Appendix III",
    "IV": "Appendix IV",
}
"""Chapters of the book, by the first part of the number of a figure."""

Item = dict[str, Any]


def navigation(folder: Path, reference: Reference) -> list[Item]:
    """The navigation of the pages that are there."""
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*.md")}
    there = {page for page in there if not page.startswith(("site/", "files/"))}
    way = _ordered([f"way/{page}" for page in WAY], there, "way/")
    atlas = _atlas(sorted(page for page in there if page.startswith("atlas/")))
    named = {"index.md", *START, *REFERENCE, *PROOF, *PROJECT}
    topics = [page for page in TOPICS if page in there]
    topics += sorted(page for page in there - named - {*TOPICS} if "/" not in page)
    parts: list[tuple[str, list[Any]]] = [
        ("Start", ["index.md", *(page for page in START if page in there)]),
        ("The way of light", way),
        ("Topics", topics),
        ("Notebooks", sorted(page for page in there if page.startswith("notebooks/"))),
        ("Reference", [*(page for page in REFERENCE if page in there), _python(reference, "illuminant")]),
        ("Validation", [page for page in PROOF if page in there]),
        ("Atlas", atlas),
        ("Project", [page for page in PROJECT if page in there]),
    ]
    return [{title: _titled(items, folder)} for title, items in parts if items]


def toml(items: list[Item]) -> str:
    """The navigation as a value of a TOML file."""
    return "[\n" + "".join(f"  {_inline(item)},\n" for item in items) + "]"


def _inline(value: Any) -> str:
    """A value on one line."""
    if isinstance(value, dict):
        return (
            "{ "
            + ", ".join(f"{json.dumps(k, ensure_ascii=False)} = {_inline(v)}" for k, v in value.items())
            + " }"
        )
    if isinstance(value, list):
        return "[" + ", ".join(map(_inline, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def _ordered(order: list[str], there: set[str], folder: str) -> list[str]:
    """The pages of a folder in an order; those that it does not name come last."""
    rest = sorted(page for page in there - set(order) if page.startswith(folder))
    return [page for page in order if page in there] + rest


def _atlas(pages: list[str]) -> list[Any]:
    """The pages of the atlas by chapter: `figure-2-21.md` belongs to chapter 2."""
    chapters: dict[str, list[tuple[list[Any], str]]] = {}
    rest: list[Any] = []
    for page in pages:
        found = re.fullmatch(r"atlas/(?:\w+/)*(figure|table)-([IVX]+|\d+)-(\d+)(\w*)\.md", page)
        if found:
            order = [found[1], int(found[3]), found[4]]
            chapters.setdefault(found[2], []).append((order, page))
        else:
            rest.append(page)
    numbers = [*CHAPTERS, *sorted(chapters.keys() - CHAPTERS)]
    return rest + [
        {CHAPTERS.get(number, number): [page for _, page in sorted(chapters[number])]}
        for number in numbers
        if number in chapters
    ]


def _python(reference: Reference, package: str) -> Item:
    """The pages of a package, its own first."""
    items: list[Any] = [reference.path(package)]
    for name in reference.below(package):
        if reference.modules[name].package:
            items.append(_python(reference, name))
        else:
            items.append({name.rpartition(".")[2]: reference.path(name)})
    return {package.rpartition(".")[2] if package != "illuminant" else FOLDER.capitalize(): items}


def _titled(items: list[Any], folder: Path) -> list[Any]:
    """Pages with their titles."""
    titled: list[Any] = []
    for item in items:
        if isinstance(item, str):
            title = TITLES.get(item) or heading((folder / item).read_text(encoding="utf-8")) or item
            # The page of a part itself has no line below its heading.
            titled.append(item if item.endswith("/index.md") else {title: item})
        else:
            titled.append({k: _titled(v, folder) if isinstance(v, list) else v for k, v in item.items()})
    return titled
