"""The manual points at what exists: links, pages in the index, scenes, pictures; test_snippets.py runs its snippets."""

import itertools
import re
import shlex
from pathlib import Path

import illuminant

LARGEST_PICTURE, LARGEST_DEMO = 300_000, 700_000

ROOMS = (
    "lamps",
    "materials",
    "surfaces",
    "models",
    "transport",
    "radiosity",
    "sampling",
    "eye",
    "display",
    "choosing",
)
"""The pages of the way of light, in its order."""


def test_the_rooms_of_the_way_lead_to_each_other(repository):
    way = repository / "docs" / "way"
    assert sorted(ROOMS) == sorted(page.stem for page in way.glob("*.md"))
    for before, after in itertools.pairwise(ROOMS):
        assert f"({after}.md)" in (way / f"{before}.md").read_text(encoding="utf-8").splitlines()[-1]


def pages(repository: Path) -> list[Path]:
    """Every page that people read."""
    return sorted(
        [*repository.glob("*.md"), *repository.glob("docs/**/*.md"), *repository.glob("benches/*.md")]
    )


def anchors(page: Path) -> set[str]:
    """The names of the headings of a page, as links have them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(page: Path) -> list[str]:
    """The relative links of a page; code is no link, and what only the site shows is looked at there (tests/site)."""
    content = re.sub(
        r"^```.*?^```$|`[^`\n]*`|<!-- site\n.*?\n-->",
        "",
        page.read_text(encoding="utf-8"),
        flags=re.MULTILINE | re.DOTALL,
    )
    return [link for link in re.findall(r"\]\(([^)\s]+)\)", content) if not re.match(r"[a-z]+:", link)]


def test_every_relative_link_leads_somewhere(repository):
    lost = []
    for page in pages(repository):
        for link in links(page):
            file, _, anchor = link.partition("#")
            target = (page.parent / file).resolve() if file else page
            if not target.exists() or (anchor and anchor not in anchors(target)):
                lost.append(f"{page.name}: {link}")
    assert lost == []


def test_every_page_is_in_the_index(repository):
    docs = repository / "docs"
    known = {page.relative_to(docs).as_posix() for page in docs.rglob("*.md")} - {"index.md"}
    assert {page for page in known if not page.startswith("site/")} <= set(links(docs / "index.md"))


def test_the_index_names_every_scene(repository):
    text = (repository / "docs" / "index.md").read_text(encoding="utf-8")
    families = {
        re.sub(r"^(colorchecker)-(a|fl11)$", r"\1-d65", scene.stem)
        for scene in (repository / "scenes").glob("*.toml")
    }
    assert [name for name in sorted(families) if f"`{name}.toml`" not in text] == []


# --- pictures --------------------------------------------------------------------------------------------------


def test_every_picture_is_small_shown_and_made_by_illuminant(repository):
    shown = {Path(link).name for page in pages(repository) for link in links(page) if link.endswith(".png")}
    pictures = sorted((repository / "docs" / "images").iterdir())
    assert {picture.name for picture in pictures} == shown
    drawn = "".join(tool.read_text(encoding="utf-8") for tool in (repository / "tools").glob("draw_*.py"))
    plots = {picture.stem for picture in pictures if f'"{picture.name}"' in drawn}
    for picture in pictures:
        limit = LARGEST_DEMO if picture.name == "demo.png" else LARGEST_PICTURE
        assert picture.stat().st_size <= limit, picture
        if picture.stem in plots:
            continue
        settings = illuminant.Image.open(picture).settings
        assert settings["scene"].endswith(".toml"), picture


def test_the_banner_was_made_by_the_command_under_it(repository):
    banner = illuminant.Image.open(repository / "docs" / "images" / "banner.png")
    command = f"{banner.settings['command']} -o banner.png"
    printed = re.search(
        r"^```sh long\n(illuminant compare .*)\n```$", (repository / "README.md").read_text(), re.M
    )
    assert sorted(shlex.split(printed[1])) == sorted(shlex.split(command))


def test_the_readme_says_what_data_other_people_own(repository):
    readme = (repository / "README.md").read_text(encoding="utf-8")
    data = repository / "python" / "illuminant" / "data"
    folders = {path.parent.name for path in data.glob("*/*.csv")} - {
        "illuminants",
        "observers",
        "colorchecker",
    }
    assert [folder for folder in sorted(folders) if f"`{folder}`" not in readme] == []
    assert "Danny Pascale" in readme
