"""The table `[animation]`: which frames there are, and which keys of the scene change with time.

These models are part of `schema`, which see. Time is in seconds; frame n is at the time n / `frames_per_second`, so
frame 0 is at 0 s whatever the first frame is.

Example:
    >>> Keys.model_validate({"times": [0.0, 1.0], "values": [5.0, 7.0]}).values
    [5.0, 7.0]
"""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from illuminant.table import Number, Table, key

__all__ = ["MOST_FRAMES", "MOST_KEYS", "AnimationTable", "Keys"]

MOST_FRAMES = 1_000_000
"""The largest number of a frame."""

MOST_KEYS = 100_000
"""The most values of one key of the scene."""

Interpolation = Literal["linear", "smooth", "step"]
_RATIO = r"[1-9]\d{0,6}/[1-9]\d{0,6}"


def _rate_form(value: Any) -> str | None:
    if isinstance(value, str):
        return "<ratio>" if re.fullmatch(_RATIO, value) else None
    return "<number>" if isinstance(value, (int, float)) and not isinstance(value, bool) else None


RateValue = Annotated[
    Annotated[str, Tag("<ratio>")] | Annotated[float, Field(ge=0.001, le=100_000), Tag("<number>")],
    Discriminator(
        _rate_form,
        custom_error_type="rate_form",
        custom_error_message='must be a number such as 24, or a ratio such as "30000/1001"',
    ),
]

FrameNumber = Annotated[int, Field(ge=0, le=MOST_FRAMES)]


class Keys(Table):
    """Values of one key of the scene and when it has them; before the first and after the last it stays as it is there.

    `linear` goes straight from value to value, `smooth` sets off and arrives gently and never leaves the range between
    two neighbouring values, `step` keeps a value until the next one. Numbers are interpolated one by one, in lists and
    tables too. Rotations about the same axes are interpolated by their angles, so that 0 to 720 degrees are two turns;
    about different axes they go the shortest way. Texts, names of spectra among them, and matrices change in steps.
    """

    times: Annotated[list[Number], Field(min_length=1, max_length=MOST_KEYS)] | None = key(
        "when, in seconds, increasing", "[0.0, 1.5]", None
    )
    frames: Annotated[list[Number], Field(min_length=1, max_length=MOST_KEYS)] | None = key(
        "when, as frames, instead of `times`", "[0, 36]", None
    )
    values: Annotated[list[Any], Field(min_length=1, max_length=MOST_KEYS)] = key(
        "the value at each of them, as the key itself takes it", "[[0.0, 1.0, 4.0], [1.0, 1.0, 4.0]]"
    )
    interpolation: Interpolation | None = key(
        "what is between them; default that of `[animation]`, and `step` for what changes in steps only",
        '"smooth"',
        None,
    )


class AnimationTable(Table):
    """What moves and changes. A key of the scene is named by its path, as in `[animation.keys."camera.eye"]`.

    `illuminant render --frames` makes the frames; otherwise the scene is shown as it is in its first frame. Keys of
    `camera`, `spectra`, `materials`, `objects`, `lights`, `atmosphere` and `medium` can change, but neither the size
    nor the crop of the image. If the camera states its `shutter`, that is a fraction of the time from one frame (or
    field) to the next, and a camera and objects that are keyed move while it is open; otherwise frames are sharp.
    """

    frames: Annotated[list[FrameNumber], Field(min_length=2, max_length=2)] = key(
        "first and last frame", "[0, 47]"
    )
    frames_per_second: RateValue = key("frames in a second, or a ratio as a text", '"30000/1001"', 30.0)
    fields: Literal["none", "odd-first", "even-first"] = key(
        "whether a frame holds two fields, the second half a frame later, and which lines are first: odd ones are the "
        "1st, 3rd, 5th from the top",
        '"odd-first"',
        "none",
    )
    interpolation: Interpolation = key("what is between values where `keys` do not say", '"smooth"', "linear")
    keys: dict[str, Keys] = key(
        "what changes, by its path in the scene file",
        '{ "camera.eye" = { times = [0.0, 1.0], values = [[0.0, 1.0, 4.0], [1.0, 1.0, 4.0]] } }',
        {},
    )
