"""What docs/command-line.md says of `illuminant spectra` can be typed as it stands."""

import re
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def commands(page: Path) -> list[str]:
    """Every command of the page, in blocks and in tables."""
    text = page.read_text(encoding="utf-8")
    found = [line.rstrip("`").strip() for line in re.findall(r"(?<=[`\n])illuminant spectra [^\n`]*", text)]
    return [line for line in found if "room.toml" not in line]  # the scene is the reader's own


def test_every_command_of_the_page_runs(repository: Path, tmp_path: Path, inside: Command) -> None:
    (tmp_path / "paint.csv").write_text("400,0.1\n700,0.4\n")
    (tmp_path / "percent.txt").write_text("400 10\n700 40\n")
    found = commands(repository / "docs" / "command-line.md")
    for verb in ("list", "show", "plot", "convert"):
        assert sum(f" spectra {verb} " in line for line in found) >= (1 if verb == "list" else 2), verb
    for line in found:
        _, *words = shlex.split(line, comments=True)
        small = ["--size", "500x450"] if words[1] == "plot" else []
        done = inside(*words, *small, cwd=tmp_path)
        assert done.returncode == 0, f"{line}\n{done.stderr}"
        for word in words:
            if words[words.index(word) - 1] == "-o":
                assert (tmp_path / word).is_file(), line
