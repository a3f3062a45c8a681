"""The plates by their number: each is a module of a chapter's package, and the name of its file holds the number.

`chapter_2/figure_2_06_solid_angle.py` is figure 2.6, `chapter_2/table_2_1_finishes.py` is table 2.1, and
`appendices/figure_ii_1_dielectrics.py` is figure II.1. A new plate is a new file and nothing else; only the module of
the plate that is asked for is imported.

Example:
    >>> plate("2.6").title
    'Error of the solid angle of a small source'
    >>> plate("figure 2.6") is plate("2.6")
    True
"""

from __future__ import annotations

import re
from functools import cache
from importlib import import_module
from pathlib import Path

from illuminant.atlas.plate import Plate
from illuminant.errors import UsageError

__all__ = ["plate", "plates"]

_MODULE = re.compile(r"(figure|table)_([a-z]+|\d+)_(\d+)_\w+")


@cache
def _modules() -> dict[tuple[str, str], str]:
    """Kind and number → module."""
    found: dict[tuple[str, str], str] = {}
    for file in sorted(Path(__file__).parent.glob("*/*.py")):
        match = _MODULE.fullmatch(file.stem)
        if match:
            kind, chapter, place = match.groups()
            number = f"{chapter.upper()}.{int(place)}"
            assert (kind, number) not in found, f"{kind} {number} has two modules"
            found[kind, number] = f"illuminant.atlas.{file.parent.name}.{file.stem}"
    return found


@cache
def _loaded(kind: str, number: str) -> Plate:
    module = _modules()[kind, number]
    found: Plate = import_module(module).PLATE
    assert (found.kind, found.number) == (kind, number), f"{module} holds {found.name}"
    return found


def plate(name: str) -> Plate:
    """The plate of a number.

    Args:
        name: "2.21" or "figure 2.21" for a figure, "table 2.1" (or "table-2.1") for a table, "II.5" in the appendices.

    Raises:
        UsageError: there is no such plate; says which there are in that chapter.
    """
    match = re.fullmatch(
        r"\s*(?:(figure|fig\.?|table)[\s-]*)?([ivx]+|\d+)\.(\d+)([a-c]?)\s*", name, re.IGNORECASE
    )
    if match:
        number = f"{match[2].upper()}.{int(match[3])}"
        kind = "table" if (match[1] or "").casefold() == "table" else "figure"
        for wanted in (kind, "figure" if match[1] else "table"):
            if (wanted, number) in _modules():
                return _loaded(wanted, number)
        near = [one.name for one in plates() if one.number.split(".")[0] == match[2].upper()]
        if near:
            raise UsageError(
                f"There is no plate {name.strip()}: of that chapter there are {', '.join(near)}."
            )
    raise UsageError(
        f"There is no plate {name.strip()!r}: expected a number such as 2.21 or table 2.1 (`illuminant atlas list`)."
    )


@cache
def plates() -> tuple[Plate, ...]:
    """All plates in the order of the book.

    Example:
        >>> sorted({plate.kind for plate in plates()})
        ['figure', 'table']
    """
    return tuple(sorted((_loaded(*key) for key in _modules()), key=lambda one: one.order))
