"""docs/video.md tells the truth: its program prints what it says, and every verb and measure is there."""

import contextlib
import io
import re
from pathlib import Path

import pytest

from illuminant.cli.video import app
from illuminant.display.video.hazards import HAZARDS


@pytest.fixture(scope="module")
def page(repository: Path) -> str:
    return (repository / "docs" / "video.md").read_text(encoding="utf-8")


def test_the_program_prints_what_the_page_says(page: str) -> None:
    program, printed = re.search(
        r"```python runnable\n(.*?)```\n\n```text output\n(.*?)```", page, re.S
    ).groups()
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(program, "video.md", "exec"), {})
    assert out.getvalue() == printed


def test_every_verb_and_every_measure_has_its_words(page: str, repository: Path) -> None:
    commands = (repository / "docs" / "command-line.md").read_text(encoding="utf-8")
    for command in app.registered_commands:
        assert f"| `video {command.name} " in commands
    for name in HAZARDS:
        assert f"| `{name.replace(' ', '-')}` |" in page
