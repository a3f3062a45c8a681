"""Errors as data with a place.

Every mistake that a person can make ends in one of these classes, grouped by who must act: the author of a scene
(`SceneError`), of a data file (`DataError`) or of an image (`ImageError`), the caller (`UsageError`), the owner of
the machine (`MachineError`), or nobody (`Interrupted`). Each says in one clear sentence what was found, where, and
what was expected; the same facts are attributes, so that a notebook can act on them. The command line prints the
sentence and ends with `exit_code`.

Example:
    >>> from illuminant.errors import Problem, SceneError
    >>> problem = Problem("a.toml", 3, "camera", "eyes", "is not a key of this table", 'did you mean "eye"?')
    >>> error = SceneError([problem])
    >>> print(error)
    a.toml:3: [camera] eyes: is not a key of this table (did you mean "eye"?)
    >>> error.problems[0].key
    'eyes'
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

__all__ = [
    "DataError",
    "Error",
    "ImageError",
    "Interrupted",
    "MachineError",
    "Problem",
    "SceneError",
    "UsageError",
    "printable",
    "suggestion",
]

LONGEST_LINE = 2000
"""Letters of a sentence that are shown at most."""


def suggestion(word: str, words: Iterable[str]) -> str:
    """A near-miss hint for a name that does not exist, or "" when nothing is near.

    Args:
        word: what was written.
        words: what could have been meant.

    Example:
        >>> suggestion("golld", ["gold", "silver"])
        'did you mean "gold"?'
    """
    words = [str(known) for known in words]
    folded = {known.casefold(): known for known in reversed(words)}
    near = difflib.get_close_matches(str(word).casefold(), list(folded), n=1, cutoff=0.6)
    return f'did you mean "{folded[near[0]]}"?' if near else ""


class Error(Exception):
    """Base of all errors that illuminant raises on purpose; `str()` is one clear sentence.

    Attributes:
        exit_code: what the command line ends with when this error reaches it.
    """

    exit_code: int = 2


def printable(text: str) -> str:
    """A line for people: what moves the cursor or changes colours is written as Python does, what is too long is cut.

    Example:
        >>> printable("red\\x1b[31m")
        'red\\\\x1b[31m'
    """
    if len(text) > LONGEST_LINE:
        text = f"{text[: LONGEST_LINE - 200]} ... {text[-195:]}"
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


@dataclass(frozen=True)
class Problem:
    """One mistake in a scene, with its place.

    Attributes:
        file: path of the scene file as it was given, or "" for a scene made in Python.
        line: 1-based line in `file`, or 0 when there is none.
        table: the table as TOML writes it, for example `materials.red`; "" for the top of the file.
        key: the key in that table, for example `reflectance.rgb`; "" when the table itself is meant.
        message: what is wrong and what was expected, as the rest of a sentence whose subject is the key.
        hint: what to do about it, for example a near-miss suggestion; may be "".
        kind: a stable word for the sort of mistake, for programs and tests, for example `unknown-key`.
    """

    file: str
    line: int
    table: str
    key: str
    message: str
    hint: str = ""
    kind: str = "value"

    def __str__(self) -> str:
        """The problem as one line: `file:line: [table] key: message (hint)`."""
        place = self.file or "scene"
        if self.line:
            place += f":{self.line}"
        subject = " ".join(part for part in (f"[{self.table}]" if self.table else "", self.key) if part)
        text = f"{place}: {subject}: {self.message}" if subject else f"{place}: {self.message}"
        return printable(f"{text} ({self.hint})" if self.hint else text)


class SceneError(Error, ValueError):
    """A scene cannot be used; `problems` holds every mistake found, in the order of the file.

    Args:
        problems: at least one `Problem`, or a sentence when there is no place to name.
    """

    def __init__(self, problems: Sequence[Problem] | str) -> None:
        if isinstance(problems, str):
            problems = [Problem("", 0, "", "", problems)]
        self.problems: list[Problem] = list(problems)
        super().__init__(self.problems)

    def __str__(self) -> str:
        """One line for each problem."""
        return "\n".join(str(problem) for problem in self.problems)


class DataError(Error, ValueError):
    """A data file (a spectrum, a table, a mesh) cannot be used.

    Args:
        message: the sentence, without the place.
        file: path of the file, or "" when the data came from Python.
        line: 1-based line in the file, or 0 when there is none.
    """

    def __init__(self, message: str, file: str = "", line: int = 0) -> None:
        self.message = message
        self.file = str(file)
        self.line = line
        super().__init__(message, self.file, line)

    def __str__(self) -> str:
        """`file:line: message`."""
        place = self.file + (f":{self.line}" if self.line else "")
        return f"{place}: {self.message}" if place else self.message


class ImageError(Error, OSError):
    """An image cannot be read, or is not of the kind that is needed."""


class MachineError(Error, OSError):
    """The machine fails: a full disk, no memory, an output that cannot be written."""

    exit_code = 3


class UsageError(Error, ValueError):
    """An argument or option is wrong, or does not go with another."""


class Interrupted(Error):
    """A person stopped the work; what was done so far is kept by whoever raised it."""

    exit_code = 130
