"""A plate of the atlas: one figure or table of the book, the claim it makes, and how it is drawn.

A plate is drawn into a sheet: a picture, the data behind it as columns, and the numbers that prove or refute the claim.
The claim is judged by bounds on those numbers, never by looking.

Example:
    >>> check = Check("error at r = d", 0.47, "", at_most=0.5)
    >>> check.holds, str(check)
    (True, 'error at r = d: 0.47 (at most 0.5)')
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Check", "Plate", "Sheet"]

Number = float | int


@dataclass(frozen=True)
class Check:
    """A number on which a claim stands, and where it must lie.

    Attributes:
        what: what the number is.
        value: as computed for this sheet.
        unit: of the value; empty for a pure number.
        at_least, at_most: the bounds; at least one is finite, or nothing could fail.
    """

    what: str
    value: float
    unit: str = ""
    at_least: float = -math.inf
    at_most: float = math.inf

    def __post_init__(self) -> None:
        if not (math.isfinite(self.at_least) or math.isfinite(self.at_most)):
            raise ValueError(f"{self.what}: a check without a bound cannot fail")

    @property
    def holds(self) -> bool:
        """Whether the value lies within the bounds; never for NaN."""
        return self.at_least <= self.value <= self.at_most

    @property
    def bounds(self) -> str:
        """The bounds in words.

        Example:
            >>> Check("ratio", 1.0, at_least=0.9, at_most=1.1).bounds
            '0.9 to 1.1'
        """
        if math.isinf(self.at_most):
            return f"at least {self.at_least:.10g}"
        if math.isinf(self.at_least):
            return f"at most {self.at_most:.10g}"
        if self.at_least == self.at_most:
            return f"exactly {self.at_most:.10g}"
        return f"{self.at_least:.10g} to {self.at_most:.10g}"

    def __str__(self) -> str:
        return f"{self.what}: {f'{self.value:.5g} {self.unit}'.rstrip()} ({self.bounds})"


@dataclass(frozen=True)
class Sheet:
    """A plate as drawn.

    Attributes:
        picture: a figure of matplotlib in the style of `illuminant.plots`.
        columns: name with unit → values, all of one length; they are written as CSV.
        checks: the numbers of the claim.
        seconds: that drawing took; filled in by `Plate.sheet`.
    """

    picture: Figure
    columns: Mapping[str, Any]
    checks: tuple[Check, ...]
    seconds: float = 0.0

    @property
    def holds(self) -> bool:
        """Whether every number of the claim lies where it must."""
        return all(check.holds for check in self.checks)


@dataclass(frozen=True)
class Plate:
    """One figure or table of the book.

    Attributes:
        number: as in the book: "2.21", "II.5".
        title: a few words.
        shows: what the book shows there: quantities, ranges, units, equations; Markdown, formulas between $.
        claim: one sentence that the numbers of the sheet prove.
        today: what is done today in its place, drawn in the same axes or named.
        draw: makes the sheet; True for quick settings (tests), False for full ones (the site).
        commands: of `illuminant`, from which a reader goes on.
        printed: what is wrong in the book's own figure or formula, if anything; drawn dashed.
        kind: figure or table.
    """

    number: str
    title: str
    shows: str
    claim: str
    today: str
    draw: Callable[[bool], Sheet]
    commands: tuple[str, ...] = ()
    printed: str = ""
    kind: Literal["figure", "table"] = "figure"

    @property
    def name(self) -> str:
        """How it is asked for: "2.21" for a figure, "table 2.1" for a table."""
        return self.number if self.kind == "figure" else f"table {self.number}"

    @property
    def stem(self) -> str:
        """Of its files.

        Example:
            >>> Plate("2.21", "", "", "", "", lambda quick: None).stem
            'figure-2-21'
        """
        return f"{self.kind}-{self.number.replace('.', '-')}"

    @cached_property
    def order(self) -> tuple[int, int, int]:
        """Chapter (appendices behind), place in it, and tables before figures of one number."""
        chapter, place = self.number.split(".")
        roman = {"I": 101, "II": 102, "III": 103, "IV": 104}
        first = roman[chapter] if chapter in roman else int(chapter)
        digits = re.match(r"\d+", place)
        assert digits, self.number
        return first, int(digits[0]), 0 if self.kind == "table" else 1

    def sheet(self, quick: bool = False) -> Sheet:
        """Draw it, in the style of `illuminant.plots`.

        Args:
            quick: small settings: fewer samples and pixels, the same claim.
        """
        import time
        from dataclasses import replace

        from illuminant.plots.style import styled

        start = time.perf_counter()
        with styled():
            drawn = self.draw(quick)
        lengths = {name: len(values) for name, values in drawn.columns.items()}
        if len(set(lengths.values())) != 1:
            raise ValueError(f"{self.name}: the columns have different lengths: {lengths}")
        return replace(drawn, seconds=time.perf_counter() - start)
