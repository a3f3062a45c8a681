"""The documentation site: built from nothing, complete, whole without a network, its formulas drawn by a browser."""

import html
import importlib
import json
import pkgutil
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.main import get_command

import illuminant
from illuminant.cli import app, run

PLATES = ("2.6", "table 2.1")
"""Plates of the atlas that take no time."""


def builder(repository: Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Run a program of `tools/site`."""
    program = [sys.executable, str(repository / "tools" / "site" / "build.py"), *map(str, arguments)]
    return subprocess.run(program, capture_output=True, text=True, timeout=300)


@pytest.fixture(scope="module")
def site(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the built site, with a small atlas."""
    folder = tmp_path_factory.mktemp("site")
    assert run(["atlas", *PLATES, "--quick", "-o", str(folder / "atlas")]) == 0
    done = builder(repository, folder / "site", "--atlas", folder / "atlas")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Warning" not in done.stdout + done.stderr
    built = folder / "site" / "html"
    # The build inspects what it has made, so that nothing dead leaves `make site` either.
    assert done.stdout.splitlines() == [
        f"illuminant: {len(list(built.rglob('*.html')))} pages, no dead link, nothing from outside",
        f"illuminant: the site is {built / 'index.html'}",
    ]
    return built


@pytest.fixture(scope="module")
def mistakes(repository: Path, site: Path):
    """The function that finds the mistakes of a site."""
    sys.path.insert(0, str(repository / "tools" / "site"))
    try:
        return importlib.import_module("inspection").mistakes
    finally:
        sys.path.pop(0)


def headings(page: Path) -> set[str]:
    """The texts of the headings of a page."""
    found = re.findall(r"<h[1-6][^>]*>(.*?)</h[1-6]>", page.read_text(encoding="utf-8"), re.DOTALL)
    return {html.unescape(re.sub(r"<a .*?</a>|<[^>]+>", "", text)).strip() for text in found}


# --- what is there ---------------------------------------------------------------------------------------------


def commands(command: object, words: str = "illuminant") -> Iterator[tuple[str, object]]:
    """Every command below one, with its words."""
    for name, below in getattr(command, "commands", {}).items():
        yield f"{words} {name}", below
        yield from commands(below, f"{words} {name}")


def test_every_command_has_a_heading_and_every_option_a_line(site):
    page = site / "commands.html"
    text, found = html.unescape(page.read_text(encoding="utf-8")), headings(page)
    every = dict(commands(get_command(app)))
    assert len(every) > 40
    assert [name for name in every if name not in found] == []
    for command in every.values():
        for parameter in command.params:
            if parameter.param_type_name == "option" and parameter.name != "help":
                assert all(f"<code>{option}" in text for option in parameter.opts), parameter.opts


def test_every_public_module_has_a_page_with_every_name_that_it_offers(site):
    lost = []
    for module in pkgutil.walk_packages(illuminant.__path__, "illuminant."):
        parts = module.name.split(".")
        if parts[1] == "cli" or any(part.startswith("_") for part in parts):
            continue
        page = site / "python" / "/".join(parts[1:]) / "index.html"
        if not module.ispkg:
            page = page.parent.with_suffix(".html")
        text = html.unescape(page.read_text(encoding="utf-8")) if page.is_file() else ""
        offered = getattr(importlib.import_module(module.name), "__all__", [])
        lost += (
            [module.name] if not text else [f"{module.name}.{name}" for name in offered if name not in text]
        )
    assert lost == []
    assert {*illuminant.__all__} <= set(re.findall(r"\w+", (site / "python" / "index.html").read_text()))


def test_signatures_and_examples_of_a_module_are_shown(site):
    page = site / "python" / "color" / "differences.html"
    text = html.unescape(re.sub(r"<[^>]+>", "", page.read_text(encoding="utf-8")))
    assert {"delta_e_1976", "delta_e_2000"} <= headings(page)
    assert "delta_e_2000(lab_a: ArrayLike, lab_b: ArrayLike, *, out: Array | None = None) -> Any" in text
    assert ">>> round(float(delta_e_2000([50, 2.5, 0], [50, 0, -2.5])), 4)" in text
    assert "The distance in L*a*b*, √(ΔL² + Δa² + Δb²)" in text


def test_every_page_of_the_manual_can_be_reached_from_the_navigation(site, repository):
    settings = (site.parent / "zensical.toml").read_text(encoding="utf-8")
    docs = repository / "docs"
    pages = {page.relative_to(docs).as_posix() for page in docs.rglob("*.md")}
    pages = {page for page in pages if not page.startswith("site/")}
    pages |= {"contributing.md", "changelog.md", "commands.md", "python/index.md", "atlas/index.md"}
    assert {page for page in pages if f'"{page}"' not in settings} == set()


def test_the_search_knows_commands_functions_and_pages(site):
    entries = json.loads((site / "search.json").read_text(encoding="utf-8"))["items"]
    titles = {entry["title"] for entry in entries}
    assert {"illuminant radiosity solve", "delta_e_2000", "Your first material"} <= titles
    assert (site / "search.js").is_file(), "the search from the disk"


def test_a_scene_that_a_page_links_to_is_on_the_site(site, repository):
    for file in (site / "files").rglob("*.toml"):
        assert file.read_bytes() == (repository / file.relative_to(site / "files")).read_bytes()
    assert (site / "files" / "LICENSE-MIT.txt").is_file()


# --- nothing is dead, nothing comes from outside ---------------------------------------------------------------


def test_programs_name_no_address_that_they_would_load(site):
    addresses = set()
    for file in site.rglob("*.js"):
        if not file.name.startswith("search"):
            text = file.read_text(encoding="utf-8")
            addresses |= set(re.findall(r"https?://[\w.-]+(?:/[\w@.-]+)?", text))
    # Names of vocabularies and addresses of licences are not loaded. The others are, for what no page of ours has: the
    # inspection finds the classes of diagrams, of code that is run and of galleries; a repository is not set; every
    # browser of these years observes the size of an element by itself.
    named = r"https?://(www\.w3\.org|github\.com/[\w-]+$|\w+\.org|\w+\.io)"
    asked = r"https://(unpkg\.com/(mermaid|glightbox|pyodide|ace-builds|resize-observer)|cdn\.jsdelivr\.net/pyodide)"
    repositories = r"https://(api\.github\.com|gitlab\.com|codeberg\.org)"
    known = f"{named}|{asked}|{repositories}"
    assert {address for address in addresses if not re.match(known, address)} == set()


@pytest.mark.parametrize(
    ("body", "mistake"),
    [
        ('<a href="other.html">', "the link other.html leads to nothing"),
        ('<a href="#nowhere">', "the link #nowhere leads to no heading"),
        ('<a href="page.html#here">', None),
        ('<a href="https://example.org/">', None),
        ('<img src="lost.png">', "lost.png is not there"),
        ('<img src="https://example.org/a.png">', "https://example.org/a.png is loaded from outside"),
        ('<script src="//example.org/a.js"></script>', "//example.org/a.js is loaded from outside"),
        (
            '<link rel="stylesheet" href="https://example.org/a.css">',
            "https://example.org/a.css is loaded from outside",
        ),
        (
            "<style>@import 'https://example.org/b.css';</style>",
            "https://example.org/b.css is loaded from outside",
        ),
        (
            '<p style="background: url(http://example.org/c.png)">',
            "http://example.org/c.png is loaded from outside",
        ),
        ('<pre class="mermaid">', "`mermaid` fetches a program from outside"),
    ],
)
def test_a_mistake_of_a_page_is_found(mistakes, tmp_path, body, mistake):
    (tmp_path / "page.html").write_text(f'<h1 id="here">Page</h1>{body}')
    assert mistakes(tmp_path) == ([f"page.html: {mistake}"] if mistake else [])


PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")


def test_a_dead_link_of_the_manual_is_one_sentence(repository, tmp_path):
    # A checkout with two pages, in the place of ours.
    for name in ("tools/site", "docs/site"):
        shutil.copytree(repository / name, tmp_path / name)
    (tmp_path / "python").symlink_to(repository / "python")
    for name in (*PAGES, "benches/README.md", "docs/index.md"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("# Page\n")
    (tmp_path / "docs" / "index.md").write_text("# Page\n\n[gone](../scenes/gone.toml)\n")
    done = builder(tmp_path, tmp_path / "built")
    assert done.returncode == 1
    assert done.stderr == "illuminant: docs/index.md: the link to ../scenes/gone.toml leads to no file.\n"


# --- in a browser ----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def shown(site: Path, chromium: str, tmp_path_factory: pytest.TempPathFactory):
    """What a browser without a network makes of a page of the site: its document after all programs have run."""
    profile = tmp_path_factory.mktemp("profile")

    def document(page: Path) -> str:
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND"]
        options += [f"--user-data-dir={profile}", "--virtual-time-budget=10000", "--dump-dom", page.as_uri()]
        return subprocess.run([chromium, *options], capture_output=True, text=True, timeout=100).stdout

    return document


def test_a_browser_draws_every_formula_of_the_site(site, shown):
    formulas = []
    for page in sorted(site.rglob("*.html")):
        found = re.findall(
            r'<(span|div) class="arithmatex">(.*?)</\1>', page.read_text(encoding="utf-8"), re.DOTALL
        )
        formulas += [text for _, text in found]
    assert formulas
    # All of them on one page, so that the browser starts once.
    page = site / "all-formulas.html"
    head = (site / "index.html").read_text(encoding="utf-8")
    loads = re.findall(r'<script src="([^"]*(?:katex|formulas)[^"]*)"', head)
    assert [Path(one).name for one in loads] == ["katex.min.js", "auto-render.min.js", "formulas.js"]
    scripts = "".join(f'<script src="{one}"></script>' for one in loads)
    body = "".join(f'<div class="arithmatex">{text}</div>\n' for text in formulas)
    page.write_text(
        f'<!doctype html><meta charset="utf-8"><title>Formulas</title>{scripts}{body}', encoding="utf-8"
    )
    try:
        seen = shown(page)
    finally:
        page.unlink()
    errors = re.findall(r'<span class="katex-error" title="([^"]*)"', seen)
    assert errors == []
    assert seen.count('<span class="katex">') >= len(formulas)


def test_a_page_of_the_atlas_shows_its_formula_in_the_font_of_katex(site, shown):
    seen = shown(site / "atlas" / "figure-2-6.html")
    assert '<span class="katex">' in seen
    assert r"\omega" not in re.sub(r"<annotation.*?</annotation>", "", seen)
    assert "ω" in seen
