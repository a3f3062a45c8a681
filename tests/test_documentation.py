"""The manual tells the truth: what it asks the reader to type runs, and what it points at exists.

A fenced block says in its first line what is to be done with it, after the language:

- `sh runnable`: `illuminant` commands; `exit=1` there states their exit code. Renders are made tiny.
- `python runnable`: a program, whose renders are made tiny too.
- `toml FILE`: tables, each in place of the one of that name in FILE.
- `text FILE.csv`: the content of FILE.
- `text output`: what the block before printed, to the letter.

All others are only read.
"""

import itertools
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import illuminant
from illuminant.cli import run

TINY_OPTIONS = ("--size", "32x20", "--samples", "2")
TINY: dict[str, Any] = {"size": (32, 20), "samples": 2}
LARGEST_PICTURE, LARGEST_DEMO = 300_000, 700_000

THE_WAY = (
    "install.md",
    "way/lamps.md",
    "way/materials.md",
    "way/surfaces.md",
    "way/models.md",
    "way/transport.md",
    "way/radiosity.md",
    "way/sampling.md",
    "way/eye.md",
    "way/display.md",
    "way/choosing.md",
    "validation.md",
)
"""The pages that lead a newcomer through the house: how it is built, and its rooms as light passes through them."""


class Block(NamedTuple):
    """A fenced block: its language, the words after it, its text, and the line of its page."""

    language: str
    words: tuple[str, ...]
    text: str
    line: int


def blocks(page: Path) -> Iterator[Block]:
    """The fenced blocks of a page, in order."""
    content = page.read_text(encoding="utf-8")
    for found in re.finditer(r"^```(\S*) ?([^\n]*)\n(.*?)^```$", content, re.MULTILINE | re.DOTALL):
        yield Block(found[1], tuple(found[2].split()), found[3], content.count("\n", 0, found.start()) + 1)


def with_tables(content: str, new: str) -> str:
    """A TOML text with each table of `new` in place of the one of the same name; comments behind it stay."""
    for table in re.split(r"^(?=\[)", new, flags=re.MULTILINE)[1:]:
        header = re.escape(table.splitlines()[0])
        found = re.search(rf"^{header}.*\n(?:(?![#\[]|\s*$).*\n)*", content, re.MULTILINE)
        assert found, f"{table.splitlines()[0]} is not in the file"
        content = content[: found.start()] + table.strip() + "\n" + content[found.end() :]
    return content


def follow(page: Path, capsys: pytest.CaptureFixture[str]) -> int:
    """Do in the current folder what a page tells its reader to do; how many blocks were run."""
    printed, count = "", 0
    for block in blocks(page):
        where = f"{page.name}:{block.line}"
        runnable = "runnable" in block.words
        if block.language == "sh" and runnable:
            wanted = next((int(w.removeprefix("exit=")) for w in block.words if w.startswith("exit=")), 0)
            for line in block.text.splitlines():
                program, *arguments = shlex.split(line, comments=True)
                assert program == "illuminant", where
                tiny = TINY_OPTIONS if arguments[0] == "render" else ()
                assert run([*arguments, *tiny]) == wanted, f"{where}: {line}\n{capsys.readouterr().err}"
        elif block.language == "python" and runnable:
            exec(compile(block.text, where, "exec"), {})
        elif block.language == "toml" and block.words:
            file = Path(block.words[0])
            file.write_text(with_tables(file.read_text(), block.text))
        elif block.language == "text" and block.words == ("output",):
            assert printed == block.text, where
        elif block.language == "text" and block.words:
            Path(block.words[0]).write_text(block.text)
        if runnable:
            count += 1
            captured = capsys.readouterr()
            printed = captured.out + captured.err
    return count


@pytest.fixture
def newcomer(repository, tmp_path, monkeypatch):
    """An empty folder with the scenes of the repository, as the current one; renders from Python are tiny."""
    (tmp_path / "scenes").symlink_to(repository / "scenes")
    monkeypatch.chdir(tmp_path)
    whole = illuminant.render
    monkeypatch.setattr(illuminant, "render", lambda scene, **options: whole(scene, **(options | TINY)))
    return tmp_path


def test_a_newcomer_gets_from_the_starter_to_an_own_material(repository, newcomer, capsys):
    assert follow(repository / "docs" / "first-material.md", capsys) >= 10
    made = {path.name for path in newcomer.iterdir()}
    assert made >= {"room.png", "room.exr", "darker.png", "fine.exr", "coarse.exr", "day.png", "evening.png"}
    material = illuminant.load("room.toml").description["materials"][0]["surface"]
    curve = illuminant.load("room.toml").description["curves"][material["reflectance"]]
    assert max(curve["values"]) == 0.389, "the paint is the reader's own"


def test_the_examples_of_the_readme_run(repository, newcomer, capsys):
    assert follow(repository / "README.md", capsys) >= 2
    assert (newcomer / "room.png").is_file()
    assert (newcomer / "bunny.png").is_file()


def test_the_example_in_python_has_five_lines(repository):
    program = next(block for block in blocks(repository / "README.md") if block.language == "python")
    assert len(program.text.splitlines()) == 5


@pytest.mark.parametrize("page", THE_WAY)
def test_the_way_of_light_runs(repository, newcomer, capsys, page):
    file = repository / "docs" / page
    assert follow(file, capsys) >= 1
    only_read = [b for b in blocks(file) if b.language in ("sh", "python") and "runnable" not in b.words]
    assert [block.line for block in only_read if not re.match(r"git |make ", block.text)] == []


def test_the_rooms_of_the_way_lead_to_each_other(repository):
    way = repository / "docs" / "way"
    order = [Path(page).name for page in THE_WAY if page.startswith("way/")]
    assert sorted(order) == sorted(page.name for page in way.glob("*.md"))
    for before, after in itertools.pairwise(order):
        assert f"({after})" in (way / before).read_text(encoding="utf-8").splitlines()[-1]


def test_the_commands_to_make_are_verbs_of_the_makefile(repository):
    verbs = set(re.findall(r"^([a-z-]+):", (repository / "Makefile").read_text(), re.MULTILINE))
    for name in ("README.md", "docs/first-material.md", "docs/install.md"):
        page = repository / name
        asked = {
            verb for block in blocks(page) for verb in re.findall(r"^make (\S+)", block.text, re.MULTILINE)
        }
        assert asked
        assert asked <= verbs, page


# --- pages point at what exists --------------------------------------------------------------------------------


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
