"""A docstring of the house as Markdown.

Prose is Markdown already (lists, tables, code in backticks); what is indented is a formula or an example and stays as
it is set. Of the sections of Google's style come `Args`, `Attributes`, `Raises` and `Operators` as lists of names,
`Returns` and `Yields` as prose, `Example` as code.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterator

__all__ = ["markdown", "summary"]

_SECTION = re.compile(r"^(Args|Attributes|Raises|Operators|Returns|Yields|Examples?):$")
_TITLES = {"Args": "Arguments"}
_ENTRY = re.compile(r"^(?P<name>[^\s:][^:]*?): +(?P<text>.+)$", re.DOTALL)


def summary(docstring: str) -> str:
    """The first paragraph on one line, as Markdown."""
    return _prose(" ".join(docstring.strip().split("\n\n")[0].split()), lambda code: code)


def markdown(docstring: str, link: Callable[[str], str]) -> str:
    """A docstring, already without its indentation.

    Args:
        docstring: the text.
        link: what becomes of a piece of code with its backticks: itself, or a link to what it names.
    """
    lines: list[str] = []
    for title, body in _sections(docstring):
        if title:
            lines += [f"**{_TITLES.get(title, title)}**", ""]
        if title.startswith("Example"):
            lines += _example(body)
        elif title in ("Args", "Attributes", "Raises", "Operators"):
            lines += _entries(body, link, code=title != "Operators")
        else:
            lines += _blocks(body, link)
        lines.append("")
    return "\n".join(lines)


def _sections(docstring: str) -> Iterator[tuple[str, str]]:
    """The sections of a docstring with their titles; what is before and between them has none."""
    title, body = "", list[str]()
    for line in docstring.strip().split("\n"):
        found = _SECTION.match(line)
        if found or (title and line and not line.startswith(" ")):
            if "".join(body).strip():
                yield title, textwrap.dedent("\n".join(body)).strip("\n")
            title, body = (found[1], []) if found else ("", [line])
        else:
            body.append(line)
    if "".join(body).strip():
        yield title, textwrap.dedent("\n".join(body)).strip("\n")


def _example(body: str) -> Iterator[str]:
    """Code as it is typed; prose between stays prose."""
    for block in re.split(r"\n{2,}(?=\S)", body):
        block = re.sub(r" *# doctest: *\+\w+", "", block)
        language = "pycon" if block.lstrip().startswith(">>>") else "text"
        yield from (f"```{language}", *block.split("\n"), "```", "")


def _entries(body: str, link: Callable[[str], str], code: bool) -> Iterator[str]:
    """A list of names, each with what it means."""
    for entry in re.split(r"\n+(?=\S)", body):
        text = re.sub(r"\n +", " ", entry)
        found = _ENTRY.match(text)
        if not found:
            yield f"- {_prose(text, link)}"
            continue
        names = ", ".join(f"`{name.strip('`')}`" for name in re.split(r",\s*", found["name"]))
        yield f"- {names if code else _prose(found['name'], link)}: {_prose(found['text'], link)}"


def _blocks(body: str, link: Callable[[str], str]) -> Iterator[str]:
    """Paragraphs, lists and tables of prose, and what is indented as it is set."""
    for block in re.split(r"\n\s*\n", body):
        lines = block.split("\n")
        while lines:
            indented = list(_leading(lines, lambda line: line.startswith("    ")))
            if indented:
                if re.match(r"\s*[-*] ", indented[0]):
                    yield from (_prose(textwrap.dedent("\n".join(indented)), link), "")
                else:
                    yield from ("```text", *textwrap.dedent("\n".join(indented)).split("\n"), "```", "")
            else:
                indented = list(_leading(lines, lambda line: not line.startswith("    ")))
                text = "\n".join(indented)
                # A list may follow its sentence directly, and its lines may be indented.
                text = re.sub(r"(?<=[^\n])\n(?=[-*] )", "\n\n", text, count=1) if text[:2] != "- " else text
                yield from (_prose(text, link), "")
            lines = lines[len(indented) :]


def _leading(lines: list[str], holds: Callable[[str], bool]) -> Iterator[str]:
    """The first lines for which something holds."""
    for line in lines:
        if not holds(line):
            return
        yield line


def _prose(text: str, link: Callable[[str], str]) -> str:
    """Prose with its code linked, and with nothing in it that Markdown would take for a link, a tag or a formula."""

    def one(piece: str) -> str:
        if piece.startswith("`"):
            return link(piece)
        piece = re.sub(r"([\[\]$])", r"\\\1", piece.replace("<", "&lt;"))
        return re.sub(r"(?<![\s*])\*(?![\s*])|(?<=\w)\*(?=[\s,;.:)]|$)", r"\*", piece)

    return "".join(one(piece) for piece in re.split(r"(``.+?``|`[^`]+`)", text, flags=re.DOTALL))
