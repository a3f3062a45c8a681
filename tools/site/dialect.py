"""From the Markdown that GitHub reads to that of Python-Markdown, which the site is built with.

What is different, and what becomes of it:

- The words after the language of a fence (`sh runnable`, `toml room.toml`, `text output`) are for the tests of the
  manual. A file name becomes the title of the block; the others go.
- A list may follow a paragraph without a blank line; here it gets one. A list inside a list is indented by four.
- `<!-- site ... -->` holds what is for the site alone; GitHub does not show it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

__all__ = ["escaped", "for_the_site", "heading", "parts", "plain"]

_FENCE = re.compile(r"^(?P<mark> *(`{3,}|~{3,}))(?P<info>[^\n`]*)$")
_ITEM = re.compile(r"^(?P<indent> *)(?:[-*+]|\d+[.)]) +\S")
_SITE = re.compile(r"<!-- site\n(.*?)\n-->", re.DOTALL)


def parts(text: str) -> Iterator[tuple[bool, str]]:
    """The lines of a page, each with whether it is code (a line of a fence, or between its two)."""
    closing = ""
    for line in text.splitlines():
        fence = _FENCE.match(line)
        if closing:
            yield True, line
            if fence and fence["mark"].strip().startswith(closing) and not fence["info"].strip():
                closing = ""
        elif fence:
            closing = fence["mark"].strip()
            yield True, line
        else:
            yield False, line


def for_the_site(text: str) -> str:
    """A page of the manual as Python-Markdown reads it."""
    lines: list[str] = []
    inside, in_list = False, False
    for code, line in parts(_SITE.sub(r"\1", text)):
        if code:
            lines.append(line if inside else _opened(line))
            inside = not inside or not _FENCE.match(line)
            continue
        inside = False
        item = _ITEM.match(line)
        if item and len(item["indent"]) in (2, 3) and in_list:
            line = "    " + line.lstrip()
        elif item and not item["indent"] and not in_list and lines and lines[-1].strip():
            lines.append("")
        in_list = bool(item) or (in_list and (line.startswith(" ") or not line.strip()))
        lines.append(line)
    return "\n".join(lines) + "\n"


def _opened(line: str) -> str:
    """The first line of a fence, with the name of the file as its title."""
    fence = _FENCE.match(line)
    if fence is None:
        return line
    language, *words = fence["info"].split() or [""]
    title = next((f' title="{word}"' for word in words if re.fullmatch(r"[\w-]+\.\w+", word)), "")
    return f"{fence['mark']}{language}{title}"


def heading(text: str) -> str | None:
    """The title of a page: its first heading, without marks."""
    for code, line in parts(text):
        if not code and line.startswith("# "):
            return plain(line[2:])
    return None


def plain(text: str) -> str:
    """A line of Markdown without its marks, for a title."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"\\([\\`*_{}\[\]()#+.!|$-])", r"\1", re.sub(r"(?<!\\)[`*]", "", text)).strip()


def escaped(text: str) -> str:
    """A text that is no Markdown, so that it is shown as it stands, in a cell of a table too."""
    text = re.sub(r"([\\`*_{}\[\]|$#+])", r"\\\1", text)
    return text.replace("&", "&amp;").replace("<", "&lt;")
