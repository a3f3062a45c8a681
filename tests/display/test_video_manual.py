"""docs/video.md is whole: every verb and every measure is there."""

from pathlib import Path

import pytest

from illuminant.cli.video import app
from illuminant.display.video.hazards import HAZARDS


@pytest.fixture(scope="module")
def page(repository: Path) -> str:
    return (repository / "docs" / "video.md").read_text(encoding="utf-8")


def test_every_verb_and_every_measure_has_its_words(page: str, repository: Path) -> None:
    commands = (repository / "docs" / "command-line.md").read_text(encoding="utf-8")
    for command in app.registered_commands:
        assert f"| `video {command.name} " in commands
    for name in HAZARDS:
        assert f"| `{name.replace(' ', '-')}` |" in page
