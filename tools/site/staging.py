"""The folder that the site is built from: the manual, what it links to, and the pages made out of the code.

Every page has two paths: where it lies in the repository, which its links start from, and where it lies on the site.
The atlas counts as the folder `docs/atlas`, and the executed notebooks as `notebooks`, wherever they were made.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from dialect import for_the_site
from links import rewritten

__all__ = ["PAGES_OUTSIDE", "Stage"]

PAGES_OUTSIDE = {
    "README.md": "readme.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "SECURITY.md": "reporting.md",
    "benches/README.md": "benches.md",
}
"""Pages of the repository outside `docs`, and their names on the site."""

MADE = {"docs/atlas": "atlas", "notebooks": "notebooks"}
"""Folders whose pages are made before the site is, and their names on the site."""

FILES = "files"
"""Folder of the site for files that pages link to."""


class Stage:
    """The folder while it is filled.

    Attributes:
        repository: root of the checkout.
        folder: the folder that is filled.
        made: where folders of `MADE` lie on the disk.
        pages: path on the site of each page, by its path in the repository.
    """

    def __init__(self, repository: Path, folder: Path, made: Mapping[str, Path]) -> None:
        self.repository = repository
        self.folder = folder
        self.made = dict(made)
        self._made: set[str] = set()
        shutil.rmtree(folder, ignore_errors=True)
        docs = repository / "docs"
        self.pages = dict(PAGES_OUTSIDE)
        for page in sorted(docs.rglob("*.md")):
            name = page.relative_to(docs).as_posix()
            if not name.startswith("site/"):
                self.pages[f"docs/{name}"] = name
        for name, place in self.made.items():
            for page in sorted(place.rglob("*.md")):
                below = page.relative_to(place).as_posix()
                self.pages[f"{name}/{below}"] = f"{MADE[name]}/{below}"

    def fill(self) -> None:
        """Put every page of the repository here, and every file that one of them links to."""
        programs = self.repository / "docs" / "site"
        shutil.copytree(programs, self.folder / "site", ignore=shutil.ignore_patterns("*.md"))
        for origin, staged in self.pages.items():
            text = for_the_site(self._file(origin).read_text(encoding="utf-8"))
            self._write(staged, rewritten(text, origin, staged, self.place))

    def make(self, staged: str, text: str) -> None:
        """Write a page that is made from the code. What only the site shows may link to it as to a file of `docs`."""
        if f"docs/{staged}" in self.pages:
            raise ValueError(f"docs/{staged} is the name of a page that is made from the code.")
        self._made.add(staged)
        self._write(staged, text)

    def _write(self, staged: str, text: str) -> None:
        path = self.folder / staged
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def place(self, origin: str) -> str:
        """The path on the site of a file of the repository, which is put there unless it is a page.

        Raises:
            FileNotFoundError: there is no such file in the repository.
        """
        if origin in self.pages:
            return self.pages[origin]
        if origin.removeprefix("docs/") in self._made:
            return origin.removeprefix("docs/")
        file = self._file(origin)
        if origin.startswith("..") or not file.is_file():
            raise FileNotFoundError(origin)
        made = next((name for name in self.made if origin.startswith(f"{name}/")), None)
        if made is not None and file.is_relative_to(self.made[made]):
            staged = MADE[made] + origin.removeprefix(made)
        else:
            staged = origin.removeprefix("docs/") if origin.startswith("docs/") else f"{FILES}/{origin}"
        if not PurePosixPath(staged).suffix:
            staged += ".txt"  # a browser shows a licence only when it knows that it is text
        path = self.folder / staged
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, path)
        return staged

    def _file(self, origin: str) -> Path:
        """Where a path of the repository lies on the disk."""
        for name, place in self.made.items():
            if origin.startswith(f"{name}/") and (place / origin.removeprefix(f"{name}/")).exists():
                return place / origin.removeprefix(f"{name}/")
        return self.repository / origin
