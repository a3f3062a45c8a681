"""What every test may use: the folders of this repository, the command, and one setting for property tests."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import hypothesis
import pytest

BROWSERS = ("chromium", "chromium-browser", "google-chrome")

# A failure must come back on the next run, and a busy machine must not look like a slow property.
hypothesis.settings.register_profile("illuminant", derandomize=True, deadline=None)
hypothesis.settings.load_profile("illuminant")


@pytest.fixture(scope="session")
def repository() -> Path:
    """The root of the checkout."""
    return Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def scenes(repository: Path) -> Path:
    """The folder of the scenes that ship with the repository."""
    return repository / "scenes"


@pytest.fixture(scope="session")
def chromium() -> str:
    """A browser, found on the path (Debian: apt-get install chromium); where there is none, tests skip."""
    found = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if found is None:
        pytest.skip("no browser: there is no chromium on the path")
    return found


@pytest.fixture(scope="session")
def command() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs `illuminant` with the given arguments in a process of its own, as a shell would.

    Keyword arguments go to `subprocess.run` (`cwd`, `env`, `timeout`); text comes back in `stdout` and `stderr`.
    """

    def run(*arguments: object, **options: object) -> subprocess.CompletedProcess[str]:
        program = Path(sys.executable).with_name("illuminant")
        options = {"capture_output": True, "text": True, "timeout": 300, **options}
        return subprocess.run([str(program), *map(str, arguments)], **options)

    return run


@pytest.fixture
def inside(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs `illuminant` with the given arguments as `command` does, but in this process, which saves its start."""

    def call(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        from illuminant.cli import run

        words = [str(argument) for argument in arguments]
        with monkeypatch.context() as context:
            if cwd is not None:
                context.chdir(cwd)
            code = run(words)
        captured = capsys.readouterr()
        return subprocess.CompletedProcess(words, code, captured.out, captured.err)

    return call
