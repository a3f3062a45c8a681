"""Links between the pages of the repository, as they must read on the site.

A link leads from one file of the repository to another. On the site a page lies elsewhere (`CONTRIBUTING.md` is
`contributing.md`, `docs/color.md` is `color.md`), and a file that is no page (a scene, a licence) is put beside them.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable
from urllib.parse import unquote

from dialect import parts

__all__ = ["DeadLinkError", "between", "rewritten"]

# Code first, so that a link in it is none; then the targets of Markdown and of HTML.
_LINK = re.compile(
    r"(?P<code>`+)(?:(?!`).|(?<=`)`)*?(?P=code)(?!`)"
    r"|(?P<before>\]\()(?P<target>[^)\s]+)"
    r"|(?P<html>\b(?:src|href)=\")(?P<address>[^\"]+)"
    r"|(?P<name>^\[[^\]]+\]:\s+)(?P<defined>\S+)"
)


class DeadLinkError(ValueError):
    """A link leads to nothing that could be put on the site."""


def between(source: str, target: str) -> str:
    """The relative link from one file to another, both as paths with `/` from the same folder."""
    return posixpath.relpath(target, posixpath.dirname(source) or ".")


def rewritten(text: str, origin: str, staged: str, place: Callable[[str], str]) -> str:
    """A page with its links as the site needs them.

    Args:
        text: the page.
        origin: its path in the repository.
        staged: its path on the site.
        place: the path on the site of a path in the repository; it may put the file there.
    """

    def moved(link: str) -> str:
        file, mark, anchor = link.partition("#")
        if not file or re.match(r"[a-z]+:|//", link):
            return link
        target = posixpath.normpath(posixpath.join(posixpath.dirname(origin), unquote(file)))
        try:
            return between(staged, place(target)) + mark + anchor
        except FileNotFoundError as error:
            raise DeadLinkError(f"{origin}: the link to {link} leads to no file.") from error

    def replaced(found: re.Match[str]) -> str:
        for before, target in (("before", "target"), ("html", "address"), ("name", "defined")):
            if found[before]:
                return found[before] + moved(found[target])
        return found[0]

    lines = [line if code else _LINK.sub(replaced, line) for code, line in parts(text)]
    return "\n".join(lines) + "\n"
