"""What docs/command-line.md says of `illuminant spectra` in its tables can be typed as it stands."""

import re
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def commands(page: Path) -> list[str]:
    """Every command in a table of the page; those in blocks are run by tests/test_snippets.py."""
    return re.findall(r"^\|.*`(illuminant spectra [^\n`]*)`", page.read_text(encoding="utf-8"), re.MULTILINE)


def test_every_command_of_the_page_runs(repository: Path, tmp_path: Path, inside: Command) -> None:
    found = commands(repository / "docs" / "command-line.md")
    assert len(found) >= 6
    for line in found:
        _, *words = shlex.split(line, comments=True)
        small = ["--size", "500x450"] if words[1] == "plot" else []
        done = inside(*words, *small, cwd=tmp_path)
        assert done.returncode == 0, f"{line}\n{done.stderr}"
        for word in words:
            if words[words.index(word) - 1] == "-o":
                assert (tmp_path / word).is_file(), line
