"""The whole atlas with quick settings, drawn once by the command."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from illuminant.cli import run


class Drawn(NamedTuple):
    """The folder of a whole atlas, the exit code of the command, and what it said of each plate."""

    folder: Path
    code: int
    plates: dict[str, Any]


@pytest.fixture(scope="session")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Drawn:
    """`illuminant atlas --all --quick -o DIR --json`."""
    import contextlib
    import io

    folder = tmp_path_factory.mktemp("atlas") / "atlas"
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = run(["atlas", "--all", "--quick", "-o", str(folder), "--json"])
    return Drawn(folder, code, {one["name"]: one for one in json.loads(printed.getvalue())})
