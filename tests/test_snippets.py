"""Every snippet of the manual is executed, or says in its first line why not.

A fenced block says what it is by its language and the words after it:

- `sh runnable`: `illuminant` commands; `exit=1` there states their exit code, `exit=1,0` one for each.
- `sh long`, `sh asks`: commands that take minutes, or ask their reader; their words are read, and nothing is done.
- `sh checkout`: what is done to the checkout: verbs of the Makefile, scripts, the environment. Each must exist.
- `python runnable`: a program.
- `toml`: a scene, or a table of one; it must be without mistakes.
- `toml display`: a file that describes a display.
- `toml FILE`: tables, each in place of the one of that name in FILE.
- `text FILE`: the content of FILE.
- `text output`: what the block before printed, to the letter.
- `text`: something to be read.

The reader's folder holds what pages take for granted: the starter scene, images of it and some measurements. Renders
and patterns are made tiny.
"""

import re
import shlex
import shutil
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pydantic
import pytest
import typer

import illuminant
from illuminant import (
    coefficient_schema,
    object_schema,
    pattern_schema,
    schema,
    spectrum_schema,
    texture_schema,
)
from illuminant.cli import app, run
from illuminant.display import displays
from illuminant.new import write_starter
from illuminant.scene_file import resolve
from illuminant.table import Table

REPOSITORY = Path(__file__).resolve().parent.parent
MANUAL = sorted(
    page for pages in ("README.md", "CONTRIBUTING.md", "docs/**/*.md") for page in REPOSITORY.glob(pages)
)
TINY: dict[str, Any] = {"size": (32, 20), "samples": 2}
SHRUNK: dict[tuple[str, ...], dict[str, str]] = {
    ("render",): {
        "--size": "32x20",
        "--samples": "2",
        "--elements": "300",
        "--time": "0.2s",
        "--error": "50%",
    },
    ("compare",): {
        "--size": "32x20",
        "--samples": "2",
        "--techniques": "path,phong",
        "--illuminations": "general",
    },
    ("radiosity", "solve"): {"--elements": "300", "--form-factors": "rays:64", "--light-samples": "8"},
    ("radiosity", "show"): {"--size": "32x20"},
    ("spectra", "plot"): {"--size": "500x450"},
    ("spectra", "compare"): {"--products": "200"},
    ("pattern",): {"--size": "160x120"},
    ("calibrate", "patterns"): {"--size": "160x120"},
}
"""What is put in place of, or added to, the options of a command."""
UNASKED = ("--time", "--error")
"""Options that are only put in place of others."""

VERBS = typer.main.get_command(app)
SCHEMAS = (schema, object_schema, coefficient_schema, pattern_schema, spectrum_schema, texture_schema)


class Block(NamedTuple):
    """A fenced block: its language, the words after it, its text, and the line of its page."""

    language: str
    words: tuple[str, ...]
    text: str
    line: int

    def lines(self) -> list[str]:
        """Its commands: a line that ends with a backslash goes on in the next; comments alone are none."""
        whole = self.text.replace("\\\n", " ").splitlines()
        return [line for line in whole if line.strip() and not line.lstrip().startswith("#")]


def blocks(page: Path) -> Iterator[Block]:
    """The fenced blocks of a page, in order."""
    content = page.read_text(encoding="utf-8")
    for found in re.finditer(r"^```(\S*) ?([^\n]*)\n(.*?)^```$", content, re.MULTILINE | re.DOTALL):
        yield Block(found[1], tuple(found[2].split()), found[3], content.count("\n", 0, found.start()) + 1)


# --- commands --------------------------------------------------------------------------------------------------


def verb_of(arguments: Sequence[str]) -> tuple[Any, int]:
    """The verb, or the group of verbs, that arguments begin with, and how many words its name has."""
    found, words = VERBS, 0
    while hasattr(found, "commands") and words < len(arguments) and not arguments[words].startswith("-"):
        assert arguments[words] in found.commands, " ".join(arguments)
        found, words = found.commands[arguments[words]], words + 1
    return found, words


def read_only(arguments: Sequence[str]) -> None:
    """Read a command as Click does, without running it."""
    verb, words = verb_of(arguments)
    verb.make_context("illuminant", list(arguments[words:]))


def shrunk(arguments: Sequence[str]) -> list[str]:
    """The same command, at less cost."""
    for name, options in SHRUNK.items():
        if tuple(arguments[: len(name)]) == name and "--pixel" not in arguments and arguments[1:] != ["list"]:
            kept = list(arguments)
            for option, value in options.items():
                if "--only" in kept and option in ("--techniques", "--illuminations"):
                    continue
                if option in kept:
                    kept[kept.index(option) + 1] = value
                elif option not in UNASKED:
                    kept += [option, value]
            return kept
    return list(arguments)


def commands(block: Block, where: str) -> Iterator[list[str]]:
    """The words of each `illuminant` command of a block."""
    for line in block.lines():
        program, *arguments = shlex.split(line, comments=True)
        assert program == "illuminant", f"{where}: {line}"
        yield arguments


def exists_in_checkout(line: str, repository: Path) -> bool:
    """Whether a command to the checkout calls a verb of the Makefile, or a script by options that it has."""
    first, *others = shlex.split(line, comments=True)
    if first == "make":
        verbs = re.findall(r"^([a-z-]+):", (repository / "Makefile").read_text(), re.MULTILINE)
        return others[0] in verbs
    if first == ".venv/bin/python":
        script = repository / others[0]
        options = [word for word in others[1:] if word.startswith("--")]
        return script.is_file() and all(f'"{option}"' in script.read_text() for option in options)
    if first == "eval":
        return all((repository / file).is_file() for file in re.findall(r"[\w./]+\.sh", line))
    return line in (
        ". .venv/bin/activate",
        "export ILLUMINANT_EMBREE=$(ls $PWD/.venv/lib/python3*/site-packages/embreex.libs/libembree4*)",
    )


# --- tables ----------------------------------------------------------------------------------------------------


def accepted(model: type[Table], table: dict[str, Any]) -> bool:
    """Whether a table of the schema takes these keys; others may be missing at its top."""
    try:
        model.model_validate(table)
    except pydantic.ValidationError as error:
        return all(e["type"] == "missing" and len(e["loc"]) == 1 for e in error.errors())
    return True


def mistakes(text: str) -> list[str]:
    """What is wrong with a scene, or with tables of one."""
    table = tomllib.loads(text)
    if {"camera", "objects", "materials"} <= table.keys():
        resolve(table)
        return []
    if accepted(schema.SceneFile, table):
        return []
    models = [m for of in SCHEMAS for m in vars(of).values() if isinstance(m, type) and issubclass(m, Table)]
    if any(accepted(model, table) for model in models if model.model_fields):
        return []
    return [f"neither a scene nor a table of one: {', '.join(table)}"]


def with_tables(content: str, new: str) -> str:
    """A TOML text with each table of `new` in place of the one of the same name; comments behind it stay."""
    for table in re.split(r"^(?=\[)", new, flags=re.MULTILINE)[1:]:
        header = re.escape(table.splitlines()[0])
        found = re.search(rf"^{header}.*\n(?:(?![#\[]|\s*$).*\n)*", content, re.MULTILINE)
        assert found, f"{table.splitlines()[0]} is not in the file"
        content = content[: found.start()] + table.strip() + "\n" + content[found.end() :]
    return content


# --- a page, followed ------------------------------------------------------------------------------------------


def follow(page: Path, repository: Path, capsys: pytest.CaptureFixture[str]) -> int:
    """Do in the current folder what a page tells its reader to do; how many blocks were run."""
    printed, count = "", 0
    for block in blocks(page):
        where = f"{page.name}:{block.line}"
        ran = False
        match block.language, block.words:
            case "sh", ("runnable", *rest):
                stated = next((w.removeprefix("exit=") for w in rest if w.startswith("exit=")), "0").split(
                    ","
                )
                given = list(commands(block, where))
                codes = stated * len(given) if len(stated) == 1 else stated
                for arguments, code in zip(given, codes, strict=True):
                    read_only(arguments)
                    done = run(shrunk(arguments))
                    assert done == int(code), f"{where}: {' '.join(arguments)}\n{capsys.readouterr().err}"
                ran = True
            case "sh", ("long" | "asks",):
                for arguments in commands(block, where):
                    read_only(arguments)
            case "sh", ("checkout",):
                for line in block.lines():
                    assert exists_in_checkout(line, repository), f"{where}: {line}"
            case "python", ("runnable",):
                exec(compile(block.text, where, "exec"), {})
                ran = True
            case "toml", ():
                assert mistakes(block.text) == [], where
            case "toml", ("display",):
                Path("described.toml").write_text(block.text, encoding="utf-8")
                assert displays.named("described.toml").name, where
            case ("toml", (file,)) if "." in file:
                Path(file).write_text(with_tables(Path(file).read_text(), block.text))
            case "text", ("output",):
                assert printed == block.text, where
            case ("text", (file,)) if "." in file:
                Path(file).write_text(block.text)
            case "text", ():
                pass
            case _:
                pytest.fail(
                    f"{where}: say behind ``` what to do with it, in words of tests/{Path(__file__).name}"
                )
        if ran:
            count += 1
            captured = capsys.readouterr()
            printed = captured.out + captured.err
    return count


@pytest.fixture(scope="module")
def at_hand(tmp_path_factory) -> Path:
    """A folder with what the pages take for granted."""
    folder = tmp_path_factory.mktemp("at-hand")
    write_starter(folder / "room.toml")
    room = illuminant.render(folder / "room.toml", lamps=True, keep_spectra=True, size=(200, 125), samples=2)
    for name in ("room.exr", "room.png", "old.png", "small.png"):
        room.save(folder / name)
    illuminant.render(folder / "room.toml", **TINY).save(folder / "reference.exr")
    (folder / "paint.csv").write_text("400,0.1\n700,0.4\n")
    (folder / "percent.txt").write_text("400 10\n700 40\n")
    (folder / "camera.csv").write_text(
        "nm,red,green,blue\n400,0,0,0.4\n450,0,0.1,1\n500,0,0.5,0.3\n550,0.1,1,0\n600,1,0.3,0\n700,0.1,0,0\n"
    )
    return folder


@pytest.fixture
def newcomer(repository, tmp_path, monkeypatch):
    """An empty folder with the scenes of the repository, as the current one; renders from Python are tiny."""
    (tmp_path / "scenes").symlink_to(repository / "scenes")
    monkeypatch.chdir(tmp_path)
    whole = illuminant.render
    monkeypatch.setattr(illuminant, "render", lambda scene, **options: whole(scene, **(options | TINY)))
    return tmp_path


def named(page: Path) -> str:
    """A page by its place in the repository."""
    return str(page.relative_to(REPOSITORY))


@pytest.fixture(params=MANUAL, ids=named)
def page(request) -> Path:
    """Each page that tells its reader what to type."""
    return request.param


# "Your first material" has a test of its own, which begins in an empty folder.
@pytest.mark.parametrize("page", [page for page in MANUAL if page.stem != "first-material"], ids=named)
def test_what_a_page_tells_its_reader_to_do_works(page, repository, at_hand, newcomer, capsys):
    made = re.findall(r"^illuminant new (\S+)", page.read_text(encoding="utf-8"), re.MULTILINE)
    for file in at_hand.iterdir():
        if file.name not in made:
            shutil.copy(file, newcomer)  # a page that makes a file finds none of that name
    follow(page, repository, capsys)


def test_a_newcomer_gets_from_the_starter_to_an_own_material(repository, newcomer, capsys):
    assert follow(repository / "docs" / "first-material.md", repository, capsys) >= 10
    made = {path.name for path in newcomer.iterdir()}
    assert made >= {"room.png", "room.exr", "darker.png", "fine.exr", "coarse.exr", "day.png", "evening.png"}
    material = illuminant.load("room.toml").description["materials"][0]["surface"]
    curve = illuminant.load("room.toml").description["curves"][material["reflectance"]]
    assert max(curve["values"]) == 0.389, "the paint is the reader's own"


def test_the_example_in_python_has_five_lines(repository):
    program = next(block for block in blocks(repository / "README.md") if block.language == "python")
    assert len(program.text.splitlines()) == 5


def test_no_command_hides_in_an_indented_block(page):
    assert (
        re.findall(r"^(?: {4}|\t)(?:illuminant|make|import|from) .*", page.read_text(encoding="utf-8"), re.M)
        == []
    )


def test_every_option_that_a_page_names_beside_its_verb_exists(page):
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for line in re.findall(r"`illuminant ([a-z][^`\n]*)`", text):
        verb, _ = verb_of(line.split())
        known = {option for one in verb.params for option in (*one.opts, *one.secondary_opts)}
        named = set(re.findall(r"(?<!\S)--?[a-z][a-z-]*", line))
        assert named <= known | {"--help", "-h", "--debug"}, line
