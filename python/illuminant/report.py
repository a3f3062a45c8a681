"""The report of a scene: every mistake of a file, each with its place, gathered before anything is said.

Two sources are joined here: the line of every key path, from the TOML reader of the core, and the key path of every
mistake, from pydantic or from the checks that join tables. `read_table` reads one table and goes on after a mistake:
a key that is wrong is reported and replaced by its example, so that the rest of the table is still checked.

Example:
    >>> from illuminant.report import Report
    >>> report = Report("a.toml", {("camera",): 3, ("camera", "eye"): 4})
    >>> report.add(("camera", "eye"), "must be three numbers", kind="type")
    >>> print(report.problems[0])
    a.toml:4: [camera] eye: must be three numbers
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, TypeVar, get_args

from pydantic import ValidationError

from illuminant.errors import DataError, Problem, SceneError, suggestion
from illuminant.schema import Table

__all__ = ["MOST_PROBLEMS", "Path", "Report", "found", "keys_of", "read_table"]

MOST_PROBLEMS = 200
"""Mistakes after which no more are looked for."""

Path = tuple[str | int, ...]
"""Keys and indices that lead to a value of the file."""

NAMED_TABLES = ("spectra", "materials", "objects", "lights")
T = TypeVar("T", bound=Table)


class Report:
    """The mistakes found so far.

    Args:
        file: path of the scene file as it was given, or "" for a scene made in Python.
        lines: 1-based line of every key path of the file.
    """

    def __init__(self, file: str = "", lines: Mapping[Path, int] | None = None) -> None:
        self.file = file
        self.lines = dict(lines or {})
        self.problems: list[Problem] = []

    def add(self, path: Path, message: str, hint: str = "", kind: str = "value") -> None:
        """Add a mistake at a key path; a path that is not in the file gets the line of what holds it.

        Raises:
            SceneError: there are `MOST_PROBLEMS`, which is more than anybody reads.
        """
        depth = len(path)
        while depth and path[:depth] not in self.lines:
            depth -= 1
        line = self.lines.get(path[:depth], 0)
        split = min(2, len(path)) if path and path[0] in NAMED_TABLES else min(1, max(len(path) - 1, 0))
        if len(path) == 1 and path[0] in ("camera", "render", "animation", *NAMED_TABLES):
            split = 1
        if path[:2] == ("animation", "keys") and len(path) > 2:
            split = 3
        table = ".".join(_bare(part) for part in path[:split])
        key = ""
        for part in path[split:]:
            key += f"[{part}]" if isinstance(part, int) else ("." if key else "") + _bare(part)
        problem = Problem(self.file, line, table, key, message, hint, kind)
        if problem not in self.problems:
            self.problems.append(problem)
        if len(self.problems) >= MOST_PROBLEMS:
            self.raise_if_any()

    def add_data_error(self, path: Path, error: DataError, kind: str = "data") -> None:
        """Add the mistake of a data file or of points, with the place in that file where there is one."""
        place = error.file + (f":{error.line}" if error.line else "")
        self.add(path, f"{place}: {error.message}" if place else error.message, kind=kind)

    def raise_if_any(self) -> None:
        """Raise all mistakes at once, in the order of the file.

        Raises:
            SceneError: there is at least one.
        """
        if self.problems:
            raise SceneError(sorted(self.problems, key=lambda problem: problem.line))


def read_table(
    model: type[T], raw: Any, path: Path, report: Report, others: Iterable[type[Table]] = ()
) -> tuple[T | None, set[str]]:
    """One table of the file as its model, with every mistake of its form reported.

    Args:
        model: what the table must be.
        raw: the value in the file.
        path: its key path.
        report: takes the mistakes.
        others: models of the other kinds of such a table, to say where a misplaced key belongs.

    Returns:
        The table, in which keys with mistakes have their example's value, and the names of those keys. The table is
        None when `raw` is not a table.
    """
    if not isinstance(raw, dict):
        report.add(path, f"must be a table, found {found(raw)}", kind="type")
        return None, set()
    try:
        return model.model_validate(raw), set()
    except ValidationError as error:
        mistakes = error.errors(include_url=False)
    bad: set[str] = set()
    for mistake in mistakes:
        location = tuple(part for part in mistake["loc"] if not _is_tag(part))
        message, hint, kind = _sentence(model, mistake, location, tuple(others))
        report.add((*path, *location), message, hint, kind)
        bad.add(str(location[0]))
    patched = {name: value for name, value in raw.items() if name not in bad}
    for name in bad & set(model.model_fields):
        patched[name] = example(model, name)
    return model.model_validate(patched), bad


def example(model: type[Table], name: str) -> Any:
    """The example of a key, as a value."""
    texts = model.model_fields[name].examples
    return tomllib.loads(f"x = {texts[0]}")["x"] if texts and texts[0] else None


def found(value: Any) -> str:
    """How a message shows the value that it found."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'the text "{value if len(value) <= 40 else value[:37] + "..."}"'
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}"
    return "nothing" if value is None else f"a value of type {type(value).__name__}"


@cache
def keys_of(model: type[Table]) -> tuple[str, ...]:
    """The keys of a table."""
    return tuple(model.model_fields)


def _bare(part: str | int) -> str:
    text = str(part)
    return text if re.fullmatch(r"[A-Za-z0-9_-]+", text) else f'"{text}"'


def _is_tag(part: str | int) -> bool:
    return isinstance(part, str) and part.startswith("<") and part.endswith(">")


def _tables_in(annotation: Any) -> list[type[Table]]:
    if isinstance(annotation, type) and issubclass(annotation, Table):
        return [annotation]
    return [table for argument in get_args(annotation) for table in _tables_in(argument)]


def _model_at(model: type[Table], location: Path) -> type[Table]:
    """The model of the table that holds the last key of a location."""
    for part in location[:-1]:
        if isinstance(part, str) and part in model.model_fields:
            tables = _tables_in(model.model_fields[part].annotation)
            if len(tables) == 1:
                model = tables[0]
    return model


_EXPECTED = {
    "float_type": "a number",
    "int_type": "a whole number",
    "string_type": "a text in quotes",
    "bool_type": "true or false",
    "list_type": "a list",
    "dict_type": "a table",
    "model_type": "a table",
    "finite_number": "a finite number",
}
_BOUND = {
    "greater_than": ("gt", "above"),
    "greater_than_equal": ("ge", "at least"),
    "less_than": ("lt", "below"),
    "less_than_equal": ("le", "at most"),
}


def _sentence(
    model: type[Table], mistake: Any, location: Path, others: tuple[type[Table], ...]
) -> tuple[str, str, str]:
    """Message, hint and kind of one mistake that pydantic found."""
    sort, value, context = mistake["type"], mistake["input"], mistake.get("ctx", {})
    holder = _model_at(model, location)
    name = str(location[-1])
    if sort == "extra_forbidden":
        keys = keys_of(holder)
        hint = suggestion(name, keys)
        elsewhere = [kind_of(other) for other in others if name in other.model_fields]
        if not hint and elsewhere and holder is model:
            hint = f"it belongs to kind {' or '.join(elsewhere)}"
        return f"is not a key of this table, whose keys are {', '.join(keys)}", hint, "unknown-key"
    if sort == "missing":
        field = holder.model_fields.get(name)
        if field is None:
            return "is missing", "", "missing-key"
        text = f"is missing; expected {_meaning(field.description)}"
        return (
            text,
            f"for example {name} = {field.examples[0]}" if field.examples and field.examples[0] else "",
            "missing-key",
        )
    if sort == "literal_error":
        words = re.findall(r"'([^']*)'", str(context.get("expected", "")))
        hint = suggestion(value, words) if isinstance(value, str) else ""
        quoted = [f'"{word}"' for word in words]
        return f"must be {_one_of(quoted)}, found {found(value)}", hint, "choice"
    if sort in _BOUND:
        bound, relation = _BOUND[sort]
        limit = context[bound]
        return (
            f"must be {relation} {limit if isinstance(limit, int) else f'{limit:g}'}, found {found(value)}",
            "",
            "range",
        )
    if sort in ("too_short", "too_long"):
        wanted = context.get("min_length" if sort == "too_short" else "max_length")
        entries = "at least 1 entry" if wanted == 1 else f"{wanted} entries"
        return f"must have {entries}, found {context.get('actual_length')}", "", "length"
    if sort in _EXPECTED:
        return f"must be {_EXPECTED[sort]}, found {found(value)}", "", "type"
    if sort.endswith("_form"):
        return f"{mistake['msg']}; found {found(value)}", "", "type"
    return f"{mistake['msg'][:1].lower()}{mistake['msg'][1:]}, found {found(value)}", "", "value"


def kind_of(model: type[Table]) -> str:
    """The value of `kind` in tables of a model, or the name of the model."""
    field = model.model_fields.get("kind")
    return str(get_args(field.annotation)[0]) if field else model.__name__.lower()


def _meaning(description: str | None) -> str:
    return (description or "a value").split(";")[0]


def _one_of(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"
