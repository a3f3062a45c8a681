"""The reference of the Python package: a page for each public module, out of the docstrings.

A package has a page of its own with a table of its modules. A name in backticks leads to where it is described, whether
it is written in full (`illuminant.image.Image`) or belongs to the same module.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

from dialect import escaped
from docstrings import markdown, summary
from links import between
from modules import Member, Module, public_modules, read

__all__ = ["FOLDER", "Reference"]

FOLDER = "python"
"""Folder of the site for these pages."""


class Reference:
    """All pages of the reference.

    Attributes:
        modules: the modules by their dotted names, packages before what is in them.
    """

    def __init__(self, source: Path) -> None:
        self.modules: dict[str, Module] = {name: read(name, path) for name, path in public_modules(source)}
        self._places = dict(self._anchors())
        self._about = {
            f"{name}.{member.name}": member.doc
            for name, module in self.modules.items()
            for member in module.members
        }

    def path(self, name: str) -> str:
        """The page of a module on the site."""
        below = name.split(".")[1:]
        if self.modules[name].package:
            below.append("index")
        return "/".join([FOLDER, *below]) + ".md"

    def pages(self) -> Iterator[tuple[str, str]]:
        """Path and text of every page."""
        for name, module in self.modules.items():
            yield self.path(name), "\n".join(self._page(module)) + "\n"

    def below(self, package: str) -> list[str]:
        """The modules and packages that lie in a package itself."""
        return [name for name in self.modules if name.rpartition(".")[0] == package]

    # --- pages -------------------------------------------------------------------------------------------------

    def _page(self, module: Module) -> Iterator[str]:
        """The lines of one page."""
        yield from (f"# {escaped(module.name)}", "", markdown(module.doc, self._linker(module)), "")
        imports = [member for member in module.members if member.kind == "import"]
        if imports:
            yield from ("## Names", "", "| name | for |", "| --- | --- |")
            for member in imports:
                target = self._address(module, member.origin)
                name = f"[`{member.name}`]({target})" if target else f"`{member.name}`"
                yield f"| {name} | {_cell(self._about.get(member.origin, ''))} |"
            yield ""
        if module.package:
            yield from ("## Modules", "", "| module | for |", "| --- | --- |")
            for name in self.below(module.name):
                link = between(self.path(module.name), self.path(name))
                yield f"| [`{name.rpartition('.')[2]}`]({link}) | {_cell(self.modules[name].doc)} |"
            yield ""
        for member in module.members:
            if member.kind != "import":
                yield from self._member(module, member, 2)

    def _member(self, module: Module, member: Member, level: int) -> Iterator[str]:
        """The lines of a name: heading, signature, docstring, and what belongs to it."""
        yield from (f"{'#' * level} {escaped(member.name)}", "")
        yield from ("```python", *member.signature.split("\n"), "```", "")
        if member.doc:
            yield from (markdown(member.doc, self._linker(module)), "")
        for one in member.members:
            yield from self._member(module, one, level + 1)

    # --- links -------------------------------------------------------------------------------------------------

    def _anchors(self) -> Iterator[tuple[str, str]]:
        """Page and anchor of every module, and of every name by its dotted name."""
        for name, module in self.modules.items():
            yield name, self.path(name)
            taken: set[str] = set()

            if any(member.kind == "import" for member in module.members):
                taken.add("names")
            if module.package:
                taken.add("modules")
            taken.add(name.replace(".", ""))
            for member in _all(module.members):
                if member.kind == "import":
                    yield f"{name}.{member.name}", self.path(name)
                else:
                    anchor = _free(re.sub(r"[^\w\-]", "", member.name.lower()), taken)
                    yield f"{name}.{member.name}", f"{self.path(name)}#{anchor}"

    def _linker(self, module: Module) -> Callable[[str], str]:
        """The links of a module's docstrings."""
        return lambda code: self._link(module, code)

    def _link(self, module: Module, code: str) -> str:
        """A piece of code as a link, where it names something that has a place."""
        name = code.strip("`").split("(")[0]
        for full in (name, f"{module.name}.{name}", f"illuminant.errors.{name}"):
            target = self._address(module, full)
            if target:
                return f"[{code}]({target})"
        return code

    def _address(self, module: Module, full: str) -> str:
        """The link from the page of a module to what a dotted name stands for; empty where that has no place."""
        place = self._places.get(full)
        if place is None or full == module.name:
            return ""
        page, mark, anchor = place.partition("#")
        here = self.path(module.name)
        return ("" if page == here and anchor else between(here, page)) + mark + anchor


def _cell(docstring: str) -> str:
    """The first paragraph of a docstring, for a cell of a table."""
    return re.sub(r"(?<!\\)\|", r"\\|", summary(docstring)) if docstring else ""


def _all(members: list[Member]) -> Iterator[Member]:
    """Names and what belongs to them, in the order of their headings."""
    for member in members:
        yield member
        yield from _all(member.members)


def _free(anchor: str, taken: set[str]) -> str:
    """The anchor that Python-Markdown gives to a heading after those that came before it on the page."""
    number = 0
    free = anchor
    while free in taken:
        number += 1
        free = f"{anchor}_{number}"
    taken.add(free)
    return free
