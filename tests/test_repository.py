"""The repository keeps its own rules: one version, both licences, no leftovers, pinned packages."""

import json
import platform
import re
import subprocess
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

# Text that only people read, and text that machines write.
TEXT = {".rs", ".py", ".pyi", ".toml", ".md", ".txt", ".in", ".sh", ".csv", ".json", ""}


@pytest.fixture(scope="module")
def files(repository: Path) -> list[Path]:
    """Every file of the repository that git knows of or would take in."""
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=repository,
        capture_output=True,
        text=True,
    )
    if listing.returncode:
        pytest.skip("not a git checkout")
    return [
        repository / name for name in listing.stdout.split("\0") if name and (repository / name).is_file()
    ]


@pytest.fixture(scope="module")
def texts(files: list[Path]) -> dict[Path, str]:
    """The files that hold text, this one left out: it must name what it forbids."""
    return {f: f.read_text(encoding="utf-8") for f in files if f.suffix in TEXT and f != Path(__file__)}


@pytest.fixture(scope="module")
def version(repository: Path) -> str:
    """The version of the Cargo workspace, from which all others follow."""
    return tomllib.loads((repository / "Cargo.toml").read_text())["workspace"]["package"]["version"]


def found(texts: dict[Path, str], pattern: str) -> list[str]:
    """Every place (file:line) whose line matches the pattern."""
    wanted = re.compile(pattern)
    return [
        f"{file.name}:{number}: {line.strip()[:100]}"
        for file, text in texts.items()
        for number, line in enumerate(text.splitlines(), 1)
        if wanted.search(line)
    ]


# --- one version number --------------------------------------------------------------------------------------


def test_the_command_tells_the_version_of_the_workspace(command, version):
    assert command("--version").stdout.split()[-1] == version


def test_the_installed_package_and_its_core_have_the_version_of_the_workspace(version):
    import illuminant
    from illuminant.core import core

    assert metadata.version("illuminant") == version
    assert core().__version__ == version
    assert illuminant.__version__ == version


def test_the_newest_release_in_the_changelog_is_this_version(repository, version):
    headings = re.findall(r"^## \[?([^\]\s]+)", (repository / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert next(heading for heading in headings if heading != "Unreleased") == version


def test_the_changelog_uses_its_four_sections_and_no_other(repository):
    sections = re.findall(r"^### (.+)", (repository / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert set(sections) <= {"Added", "Changed", "Fixed", "Physics"}


def test_every_crate_takes_version_edition_and_licence_from_the_workspace(repository):
    for manifest in sorted((repository / "crates").glob("*/Cargo.toml")):
        package = tomllib.loads(manifest.read_text())["package"]
        for key in ("version", "edition", "rust-version", "license"):
            assert package[key] == {"workspace": True}, f"{manifest}: {key}"


# --- licences ------------------------------------------------------------------------------------------------


def test_the_licences_are_there_and_in_the_metadata_of_the_package(repository):
    assert (repository / "LICENSE-MIT").read_text().startswith("MIT License")
    assert "Apache License" in (repository / "LICENSE-APACHE").read_text()
    about = metadata.metadata("illuminant")
    assert about["License-Expression"] == "(MIT OR Apache-2.0) AND BSD-3-Clause"
    # The tables of the sky are in the core, and their licence goes with it.
    sky = "crates/optics/data/hosek_wilkie/LICENSE"
    assert set(about.get_all("License-File")) == {"LICENSE-MIT", "LICENSE-APACHE", sky}
    assert "Redistributions in binary form" in (repository / sky).read_text()


# --- no leftovers --------------------------------------------------------------------------------------------


def test_nothing_is_left_to_do_in_the_sources(texts):
    assert (
        found(texts, r"\b(TODO|FIXME|XXX|HACK)\b|\btodo!\(|\bunimplemented!\(|\bdbg!\(|\bbreakpoint\(\)")
        == []
    )


def test_every_file_is_named_by_a_concept(files, repository):
    nameless = {"util", "utils", "helper", "helpers", "common", "misc", "stuff"}
    parts = {f: set(f.relative_to(repository).with_suffix("").parts) for f in files}
    assert [f for f, names in parts.items() if names & nameless] == []


def test_no_path_of_a_machine_is_in_a_file(texts):
    assert found(texts, r"(?<![\w.])/(home|root|Users|work|mnt|workspace)/\w|[A-Z]:\\\\?Users") == []


def test_no_address_of_a_registry_is_in_a_requirements_file(texts):
    requirements = {f: t for f, t in texts.items() if f.parent.name == "requirements"}
    assert requirements
    assert found(requirements, r"https?://|--(extra-)?index-url|--find-links") == []


def test_no_file_is_larger_than_a_megabyte(files):
    assert [f for f in files if f.stat().st_size > 1_000_000] == []


# --- dependencies --------------------------------------------------------------------------------------------


def name_of(requirement: str) -> str:
    """The normalised name of the package that a line of requirements asks for."""
    return re.sub(r"[-_.]+", "-", re.match(r"[\w.-]+", requirement).group()).lower()


def pinned(file: Path) -> dict[str, str]:
    """Version of each package in a compiled requirements file."""
    return {
        name_of(name): version
        for name, version in re.findall(r"^([\w.-]+)==(\S+)", file.read_text(), re.MULTILINE)
    }


def wanted(repository: Path) -> dict[str, set[str]]:
    """Names of the packages asked for, by set of requirements."""
    project = tomllib.loads((repository / "pyproject.toml").read_text())["project"]
    sets = {"run": {name_of(line) for line in project["dependencies"]}}
    for file in sorted((repository / "requirements").glob("*.in")):
        lines = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
        sets[file.stem] = {name_of(line) for line in lines}
    return sets


def test_every_package_asked_for_is_pinned_with_hashes(repository):
    for stem, names in wanted(repository).items():
        file = repository / "requirements" / f"{stem}.txt"
        assert names <= pinned(file).keys(), file
        assert re.search(r"^[\w.-]+==\S+$", file.read_text(), re.MULTILINE) is None, "a pin without a hash"


def test_sets_that_share_an_environment_pin_the_same_versions(repository):
    versions: dict[str, set[str]] = {}
    for stem in ("run", "test", "docs"):
        for name, version in pinned(repository / "requirements" / f"{stem}.txt").items():
            versions.setdefault(name, set()).add(version)
    assert {name: found for name, found in versions.items() if len(found) > 1} == {}


def test_every_dependency_has_a_line_that_says_what_it_is_for(repository):
    page = (repository / "docs" / "dependencies.md").read_text()
    described = {name_of(name) for name in re.findall(r"^\| `([\w.-]+)`", page, re.MULTILINE)}
    asked = set().union(*wanted(repository).values())
    manifests = [repository / "Cargo.toml", repository / "fuzz" / "core" / "Cargo.toml"]
    for manifest in [*manifests, *sorted((repository / "crates").glob("*/Cargo.toml"))]:
        data = tomllib.loads(manifest.read_text())
        tables = [data, data.get("workspace", {}), *data.get("target", {}).values()]
        for table in tables:
            for kind in ("dependencies", "dev-dependencies", "build-dependencies"):
                asked |= {name_of(name) for name in table.get(kind, {})}
    asked = {name for name in asked if not name.startswith("illuminant")}
    assert asked - described == set(), "without a line"
    assert described - asked == set(), "no longer used"


def test_every_locked_crate_builds_with_the_oldest_rust_that_is_promised(repository):
    oldest = tomllib.loads((repository / "Cargo.toml").read_text())["workspace"]["package"]["rust-version"]
    # Crates of other systems are not fetched, so this asks for those of this one alone.
    target = f"{platform.machine()}-unknown-linux-gnu"
    options = ["--locked", "--offline", "--format-version", "1", "--filter-platform", target]
    listing = subprocess.run(["cargo", "metadata", *options], cwd=repository, capture_output=True, text=True)
    assert listing.returncode == 0, listing.stderr

    def number(version: str) -> tuple[int, ...]:
        return tuple(int(part) for part in version.split(".")[:2])

    packages = json.loads(listing.stdout)["packages"]
    wants = {f"{p['name']} {p['version']}": p["rust_version"] for p in packages if p["rust_version"]}
    assert {name: rust for name, rust in wants.items() if number(rust) > number(oldest)} == {}
    assert f'at_least "${{found:-0}}" {oldest} ' in (repository / "tools" / "check_toolchain.sh").read_text()


# --- commands ------------------------------------------------------------------------------------------------


def test_make_help_lists_every_verb_in_one_screen(repository):
    text = (repository / "Makefile").read_text()
    verbs = set(re.search(r"^\.PHONY: (.+)$", text, re.MULTILINE).group(1).split()) - {"FORCE"}
    lines = subprocess.run(
        ["make", "help"], cwd=repository, capture_output=True, text=True
    ).stdout.splitlines()
    assert {line.split()[1] for line in lines} == verbs
    assert len(lines) <= 24
    assert max(map(len, lines)) <= 100


@pytest.fixture
def toolchain(repository, tmp_path):
    """Runs the check of the toolchain with programs that say what the test wants, and gives its answer."""

    def run(**programs: str) -> subprocess.CompletedProcess[str]:
        for name, says in {
            "python": "exit 0",
            "cargo": "echo cargo 1.85.0",
            "cc": "exit 0",
            **programs,
        }.items():
            if says:
                (tmp_path / name).write_text(f"#!/bin/sh\n{says}\n")
                (tmp_path / name).chmod(0o755)
        for tool in ("sort", "head", "cut"):
            (tmp_path / tool).symlink_to(f"/usr/bin/{tool}")
        script = repository / "tools" / "check_toolchain.sh"
        options = {"capture_output": True, "text": True, "env": {"PATH": str(tmp_path)}}
        return subprocess.run(["/bin/bash", str(script), "python"], **options)

    return run


def test_the_oldest_supported_toolchain_is_accepted_in_silence(toolchain):
    answer = toolchain()
    assert (answer.returncode, answer.stdout, answer.stderr) == (0, "", "")


@pytest.mark.parametrize(
    ("programs", "reason"),
    [
        pytest.param(
            {"cargo": "echo cargo 0.66.0"}, "cargo 1.85 or newer is needed", id="cargo of Debian 12"
        ),
        pytest.param(
            {"cargo": "echo 'cargo 1.84.1 (66221abde 2024-11-19)'"}, "is 1.84.1", id="cargo one too old"
        ),
        pytest.param({"cargo": ""}, "was not found", id="no cargo"),
        pytest.param({"cc": ""}, "needs a C linker", id="no linker"),
        pytest.param({"python": "exit 1"}, "Python 3.11 or newer is needed", id="old Python"),
        pytest.param(
            {"python": 'case "$2" in *venv*) exit 1;; esac'}, "python3-venv", id="Python without venv"
        ),
        pytest.param({"python": ""}, "Python 3.11 or newer is needed", id="no Python"),
    ],
)
def test_a_toolchain_that_lacks_something_is_refused_with_one_sentence(toolchain, programs, reason):
    answer = toolchain(**programs)
    assert answer.returncode == 1
    assert answer.stdout == ""
    assert len(answer.stderr.splitlines()) == 1
    assert reason in answer.stderr
