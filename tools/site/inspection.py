"""What a browser would miss in the built site: dead links, dead anchors, and resources from outside.

Every page and style sheet is read. A link inside must lead to a file that is there, and its anchor to an element with
that id. What a browser loads by itself (scripts, styles, fonts, images, frames) must come from the site; a link that a
reader follows may lead outside. Zensical's own programs hold addresses of what a page could ask for (a diagram by
Mermaid, code that is run): such a page must not exist.
"""

from __future__ import annotations

import functools
import os
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

__all__ = ["mistakes"]

_LOADED = {
    "script": ("src",),
    "img": ("src", "srcset"),
    "source": ("src", "srcset"),
    "iframe": ("src",),
    "embed": ("src",),
    "object": ("data",),
    "video": ("src", "poster"),
    "audio": ("src",),
    "image": ("href", "xlink:href"),
    "use": ("href", "xlink:href"),
}
_LOADED_LINKS = {
    "stylesheet",
    "icon",
    "preload",
    "prefetch",
    "preconnect",
    "dns-prefetch",
    "manifest",
    "modulepreload",
}
_ASKS_FOR_MORE = {"mermaid", "pyodide", "glightbox"}
"""Classes for which Zensical's program fetches another from outside."""


class _Page(HTMLParser):
    """The ids of a page, the links that a reader follows, and the files that the browser loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.classes: set[str] = set()
        self._style = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = {name: value or "" for name, value in attrs}
        self.ids |= {attributes[name] for name in ("id", "name") if name in attributes and tag != "meta"}
        self.classes |= set(attributes.get("class", "").split())
        self._style = tag == "style"
        if "style" in attributes:
            self.loaded += _addresses(attributes["style"])
        if tag in ("a", "area") and "href" in attributes:
            self.links.append(attributes["href"])
        if tag == "link" and "href" in attributes:
            kinds = set(attributes.get("rel", "").split())
            (self.loaded if kinds & _LOADED_LINKS else self.links).append(attributes["href"])
        for name in _LOADED.get(tag, ()):
            value = attributes.get(name, "")
            self.loaded += (
                [part.split()[0] for part in value.split(",") if part.strip()]
                if name == "srcset"
                else [value]
            )

    def handle_endtag(self, tag: str) -> None:
        self._style = self._style and tag != "style"

    def handle_data(self, data: str) -> None:
        if self._style:
            self.loaded += _addresses(data)


def _addresses(style: str) -> list[str]:
    """What a style sheet loads."""
    found = re.findall(r"url\(\s*(?:\"([^\"]*)\"|'([^']*)'|([^)\s]*))\s*\)", style)
    imports = re.findall(r"@import\s+[\"']([^\"']+)", style)
    return ["".join(one) for one in found] + imports


def mistakes(folder: Path) -> list[str]:
    """One line for each mistake of the site in a folder; an empty list says that there is none."""
    _target.cache_clear()
    folder = folder.resolve()
    pages = {path: _Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(folder).as_posix()
        # The page for what is not found is shown at any address, so its links start at the root.
        home = folder if name == "404.html" else path.parent
        for link in dict.fromkeys(page.links):
            found += [f"{name}: {what}" for what in _wrong(link, path, home, folder, pages)]
        for link in dict.fromkeys(page.loaded):
            found += [f"{name}: {what}" for what in _wrong_resource(link, home, folder)]
        found += [
            f"{name}: `{what}` fetches a program from outside" for what in page.classes & _ASKS_FOR_MORE
        ]
    for path in sorted(folder.rglob("*.css")):
        for link in _addresses(path.read_text(encoding="utf-8")):
            name = path.relative_to(folder).as_posix()
            found += [f"{name}: {what}" for what in _wrong_resource(link, path.parent, folder)]
    return found


@functools.cache
def _target(path: str, home: Path, folder: Path) -> Path | None:
    """The file that the path of a link leads to, or None where it is not there."""
    path = unquote(path)
    target = Path(os.path.normpath(folder / path.lstrip("/") if path.startswith("/") else home / path))
    if target.is_dir():
        target /= "index.html"
    return target if target.is_file() and target.is_relative_to(folder) else None


def _wrong(link: str, path: Path, home: Path, folder: Path, pages: dict[Path, _Page]) -> list[str]:
    """What is wrong with a link that a reader follows."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return []
    target = _target(parts.path, home, folder) if parts.path else path
    if target is None:
        return [f"the link {link} leads to nothing"]
    page = pages.get(target)
    anchor = unquote(parts.fragment)
    if anchor and page is not None and anchor not in page.ids and parts.fragment not in page.ids:
        return [f"the link {link} leads to no heading"]
    return []


def _wrong_resource(link: str, home: Path, folder: Path) -> list[str]:
    """What is wrong with a file that the browser loads."""
    parts = urlsplit(link)
    if not link or parts.scheme == "data" or (not parts.path and parts.fragment):
        return []
    if parts.scheme or parts.netloc:
        return [f"{link} is loaded from outside"]
    return [] if _target(parts.path, home, folder) else [f"{link} is not there"]
