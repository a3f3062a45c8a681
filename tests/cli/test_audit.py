"""`illuminant audit`: tables, laws, exit codes, mistakes."""

import json
import subprocess
from collections.abc import Callable

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.mark.parametrize("words", ["copper, satin", "gold, polished, σ = 5 nm", "red paint, gloss"])
def test_what_keeps_its_laws_ends_with_0(command: Command, words: str) -> None:
    run = command("audit", words, "--angles", "0,60,85", "--wavelengths", "450,650")
    assert run.returncode == 0, run.stdout + run.stderr
    assert "kept" in run.stdout
    assert "BROKEN" not in run.stdout
    assert all(len(line) <= 80 for line in run.stdout.splitlines())


def test_all_light_is_accounted_for(command: Command) -> None:
    run = command("audit", "crown glass, ground", "--angles", "0,70,130", "--wavelengths", "550", "--json")
    (found,) = json.loads(run.stdout)
    parts = ("coherent_reflection", "scattered_reflection", "coherent_transmission", "scattered_transmission")
    for angle in range(3):
        assert sum(found[part][angle][0] for part in parts) == pytest.approx(1.0, abs=5e-3)
    assert {law["law"] for law in found["laws"]} == {
        "reciprocity",
        "conservation",
        "equilibrium",
        "normalisation",
    }


def test_a_material_of_a_scene_and_its_plot(command: Command, repository, tmp_path) -> None:
    scene = repository / "scenes" / "cornell.toml"
    name = json.loads(command("audit", scene, "--draws", "500", "--angles", "0", "--json").stdout)[0][
        "material"
    ]
    run = command("audit", f"{scene}#{name}", "--draws", "2000", "--angles", "0,60", "--plots", tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr
    assert len(list(tmp_path.glob("*.png"))) == 1


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["goldd"], 'did you mean "gold"'),
        (["gold", "--angles", "0,x"], "expected numbers with commas"),
        (["gold", "--angles", "90"], "expected 0 to 180"),
        (["gold", "--wavelengths", "200"], "expected 380 to 780"),
        (["gold", "--draws", "1"], "expected 100 to"),
        (["gold", "--illumination", "phongg"], "no illumination model"),
        (["missing.toml"], "missing.toml"),
    ],
)
def test_wrong_input_ends_with_2(command: Command, arguments: list[str], says: str) -> None:
    run = command("audit", *arguments)
    assert run.returncode == 2
    assert says in run.stderr
    assert "Traceback" not in run.stderr
