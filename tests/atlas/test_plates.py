"""Every plate of the atlas: its claim holds in numbers, its data are there, its page says so, its commands exist."""

import csv
import shlex

import pytest

from illuminant import atlas
from illuminant.atlas import Check, Plate, Sheet
from illuminant.cli import _command
from illuminant.errors import UsageError

NAMES = [plate.name for plate in atlas.plates()]
CONTENTS = """
2.2 2.4 2.6 2.8 2.9 2.12 2.16 2.19 2.20 2.21 2.22 3.1 3.5 3.6 3.7 3.8 3.9 3.10 3.11 3.13 3.14
4.5 4.7 4.8 4.9 4.10 4.11 4.12 4.13 4.14 4.15 4.18 4.19 4.20 4.21 4.24 4.25 4.26 4.27
4.29 4.30 4.31 4.32 4.33 4.34 4.35 4.36 4.37
5.2 5.3 5.4 5.5 5.6 5.7 5.8 5.9 5.10 5.12 5.16 5.17 5.18 5.19 5.23 5.24 5.25 5.26 5.27 5.28
II.1 II.2 II.3 II.4 III.5 III.6 III.7 IV.1 table-2.1 table-4.1 table-5.1 table-II.5
"""
"""What of the book a computer can make: plots, pictures, tables, and the diagrams that explain the geometry."""


def test_the_atlas_holds_what_a_computer_can_make_of_the_book():
    assert {atlas.plate(number).name for number in CONTENTS.split()} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_the_claim_holds(drawn, name):
    told = drawn.plates[name]
    assert [check for check in told["checks"] if not check["holds"]] == []
    assert told["checks"]


def test_the_command_finds_every_claim_to_hold(drawn):
    assert drawn.code == 0
    assert list(drawn.plates) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_the_data_stand_beside_the_picture(drawn, name):
    plate = atlas.plate(name)
    with (drawn.folder / f"{plate.stem}.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    assert rows
    assert len(set(head)) == len(head)
    assert {len(row) for row in rows} == {len(head)}
    assert (drawn.folder / f"{plate.stem}.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", NAMES)
def test_the_page_states_claim_number_and_today(drawn, name):
    plate = atlas.plate(name)
    page = (drawn.folder / f"{plate.stem}.md").read_text(encoding="utf-8")
    for text in (plate.title, plate.shows, plate.claim, plate.today, f"({plate.stem}.csv)"):
        assert text and text in page
    for check in drawn.plates[name]["checks"]:
        assert check["what"] in page
    assert page.count("$") % 2 == 0, "a formula is not closed"
    index = (drawn.folder / "index.md").read_text(encoding="utf-8")
    assert f"({plate.stem}.md)" in index


@pytest.mark.parametrize("name", NAMES)
def test_the_commands_that_go_on_from_it_can_be_typed(name):
    for line in atlas.plate(name).commands:
        program, *arguments = shlex.split(line)
        assert program == "illuminant"
        command, path = _command(), [program]
        while getattr(command, "commands", None):
            path.append(arguments.pop(0))
            command = command.commands[path[-1]]
        if "--help" not in arguments:
            command.make_context(" ".join(path), arguments)


def test_a_plate_says_what_it_is_in_whole_sentences():
    for plate in atlas.plates():
        for text in (plate.shows, plate.claim, plate.today, plate.printed):
            assert not text or text.endswith("."), plate.name
        assert plate.title[0].isupper() and not plate.title.endswith("."), plate.name


def test_a_check_fails_outside_its_bounds_and_for_nan():
    assert Check("x", 1.0, at_least=0.5, at_most=1.0).holds
    assert not Check("x", 1.1, at_most=1.0).holds
    assert not Check("x", float("nan"), at_least=0.0).holds
    with pytest.raises(ValueError, match="cannot fail"):
        Check("x", 1.0)


def test_a_claim_that_fails_is_an_exit_code_of_one(monkeypatch, tmp_path, capsys):
    from illuminant.cli import run
    from illuminant.plots.style import new_figure

    def wrong(quick: bool) -> Sheet:
        return Sheet(new_figure((2, 2))[0], {"x": [1.0]}, (Check("two", 3.0, at_most=2.0),))

    one = Plate("5.99", "Wrong", "Nothing.", "Three is two.", "Nothing.", wrong)
    monkeypatch.setattr(atlas, "plate", lambda name: one)
    assert run(["atlas", "5.99", "-o", str(tmp_path / "a")]) == 1
    assert "the claim of figure 5.99 fails: two: 3 (at most 2)" in capsys.readouterr().err
    assert "**no**" in (tmp_path / "a" / "figure-5-99.md").read_text()


@pytest.mark.parametrize("name", ["9.9", "2.99", "table 9.1", "", "2", "list 2.6"])
def test_a_number_that_is_not_there_is_refused(name):
    with pytest.raises(UsageError, match="There is no plate"):
        atlas.plate(name)


def test_plates_are_found_by_the_words_of_the_book():
    assert atlas.plate("Figure 2.6") is atlas.plate("2.06") is atlas.plate("fig. 2.6")
    assert atlas.plate("table-2.1") is atlas.plate("Table 2.1")
