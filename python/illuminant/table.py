"""What every table of the scene file is made of: a strict base, keys that describe themselves, and lists of numbers.

A key carries its meaning and an example, from which the reference and the messages are written. Unknown keys,
infinities, NaN and silent conversions (a text for a number, a number for true) are refused.

Example:
    >>> class Ball(Table):
    ...     radius: Positive = key("radius, in length units", "0.5")
    >>> Ball.model_validate({"radius": 2}).radius
    2.0
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

__all__ = [
    "Corners",
    "Crop",
    "Edges",
    "Fraction",
    "Length",
    "Matrix",
    "Number",
    "Positive",
    "Range",
    "Rgb",
    "Size",
    "Table",
    "Vector",
    "key",
]


def key(description: str, example: str, default: Any = ...) -> Any:
    """A key of a table: what it means, and an example as TOML writes the value."""
    return Field(default, description=description, examples=[example])


class Table(BaseModel):
    """Base of all tables: unknown keys, infinities, NaN and silent conversions are refused."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


LARGEST = 1e9
"""The largest coordinate, size or factor: beyond it the single precision of ray tracing overflows."""

Number = Annotated[float, Field(ge=-LARGEST, le=LARGEST)]
Length = Annotated[float, Field(gt=0, le=LARGEST)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]
Edges = Annotated[list[Vector], Field(min_length=2, max_length=2)]
Corners = Annotated[list[Vector], Field(min_length=4, max_length=4)]
Row = Annotated[list[Number], Field(min_length=4, max_length=4)]
Matrix = Annotated[list[Row], Field(min_length=3, max_length=4)]
Size = Annotated[list[Annotated[int, Field(ge=1)]], Field(min_length=2, max_length=2)]
Crop = Annotated[list[Annotated[int, Field(ge=0)]], Field(min_length=4, max_length=4)]
Range = Annotated[list[Annotated[float, Field(gt=0, le=10_000)]], Field(min_length=2, max_length=2)]
Rgb = Annotated[list[float], Field(min_length=3, max_length=3)]
Positive = Annotated[float, Field(gt=0)]
Fraction = Annotated[float, Field(ge=0, le=1)]
