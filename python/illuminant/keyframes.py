"""What is between two keyframes: steps, straight lines, smooth curves, and turns.

A key has values v₀, v₁, … at the times t₀ < t₁ < …; before the first and after the last it holds still. Between two of
them, with u = (t − tᵢ) / (tᵢ₊₁ − tᵢ):

- `step`: v = vᵢ.
- `linear`: v = vᵢ + u (vᵢ₊₁ − vᵢ).
- `smooth`: the cubic Hermite curve through both with slopes mᵢ and mᵢ₊₁. The slope at a key is the weighted harmonic
  mean of those of the straight lines at both sides, and 0 where they differ in sign (Fritsch and Butland 1984). So
  the curve is monotone between keys: a fraction stays a fraction, and a power does not become negative. At the first
  and the last key the slope is 0, since the value holds still beyond; two keys give 3u² − 2u³.

Lists and tables are interpolated number by number. Rotations whose axes stay are interpolated by their angles, as
they are written. Where an axis changes, the turns are unit quaternions q, of which q and −q are the same; each is
taken with the sign that is nearer to the one before. `linear` is then the great arc between two of them (slerp,
Shoemake 1985), and `smooth` the curve above in the four components, made of unit length again, as glTF 2.0 does with
its cubic splines.

Example:
    >>> between([0.0, 1.0], [0.0, 10.0], 0.25, "linear"), between([0.0, 1.0], [0.0, 10.0], 0.25, "smooth")
    (2.5, 1.5625)
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from typing import Any

__all__ = ["between", "misfit", "turned", "turns"]

Quaternion = tuple[float, float, float, float]


def between(times: Sequence[float], values: Sequence[Any], time: float, interpolation: str) -> Any:
    """The value at a time; at the time of a key exactly its own.

    Args:
        times: of the keys, increasing.
        values: of the keys; for `linear` and `smooth` without a `misfit`.
        time: any.
        interpolation: `step`, `linear` or `smooth`.

    Example:
        >>> between([0.0, 1.0, 2.0], ["a", "b", "c"], 1.9, "step")
        'b'
        >>> between([0.0, 2.0], [{"degrees": 0, "axis": "y"}, {"degrees": 720, "axis": "y"}], 0.5, "linear")
        {'degrees': 180.0, 'axis': 'y'}
    """
    at = bisect_right(times, time) - 1
    if at < 0:
        return values[0]
    if interpolation == "step" or at == len(times) - 1 or time == times[at]:
        return values[at]
    return _blend(times, values, time, at, interpolation)


def _blend(times: Sequence[float], values: Sequence[Any], time: float, at: int, interpolation: str) -> Any:
    first = values[at]
    if _is_number(first):
        if interpolation == "linear":
            return _line(times, values, time, at)
        return _curve(times, values, time, at)
    if isinstance(first, dict):
        return {
            key: _blend(times, [value[key] for value in values], time, at, interpolation) for key in first
        }
    if isinstance(first, (list, tuple)):
        parts = range(len(first))
        return [_blend(times, [value[i] for value in values], time, at, interpolation) for i in parts]
    return first


def misfit(values: Sequence[Any]) -> str:
    """Why values change in steps only, as the end of a sentence; "" when they can be interpolated.

    Example:
        >>> misfit([[1, 2], [3.0, 4.0]]), misfit(["A", "D65"])
        ('', 'texts differ')
    """
    first = values[0]
    if all(_is_number(value) for value in values):
        return ""
    if all(isinstance(value, dict) for value in values):
        if any(value.keys() != first.keys() for value in values):
            return "tables have different keys"
        return next((why for key in first if (why := misfit([value[key] for value in values]))), "")
    if all(isinstance(value, (list, tuple)) for value in values):
        if any(len(value) != len(first) for value in values):
            return "lists have different lengths"
        parts = range(len(first))
        return next((why for i in parts if (why := misfit([value[i] for value in values]))), "")
    if len({type(value) for value in values}) > 1:
        return "values differ in type"
    if all(value == first for value in values):
        return ""
    return {str: "texts differ", bool: "true and false differ"}.get(type(first), "values differ")


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _line(times: Sequence[float], values: Sequence[float], time: float, at: int) -> float:
    start, end = values[at], values[at + 1]
    u = (time - times[at]) / (times[at + 1] - times[at])
    return _within(start + u * (end - start), start, end)


def _curve(times: Sequence[float], values: Sequence[float], time: float, at: int) -> float:
    step = times[at + 1] - times[at]
    u = (time - times[at]) / step
    start, end = values[at], values[at + 1]
    leave, arrive = _slope(times, values, at), _slope(times, values, at + 1)
    rise = u * u * (3.0 - 2.0 * u)
    value = start + (end - start) * rise
    value += step * (leave * u * (1.0 - u) ** 2 - arrive * u * u * (1.0 - u))
    return _within(value, start, end)


def _slope(times: Sequence[float], values: Sequence[float], at: int) -> float:
    """Slope of the curve at a key."""
    if at in (0, len(times) - 1):
        return 0.0
    before, after = times[at] - times[at - 1], times[at + 1] - times[at]
    come, go = (values[at] - values[at - 1]) / before, (values[at + 1] - values[at]) / after
    if come == 0 or go == 0 or (come > 0) != (go > 0):
        return 0.0
    near, far = 2.0 * after + before, after + 2.0 * before
    return (near + far) / (near / come + far / go)


def _within(value: float, start: float, end: float) -> float:
    """A value that rounding may have taken out of the range of its neighbours."""
    return min(max(value, min(start, end)), max(start, end))


# --- turns ---------------------------------------------------------------------------------------------------------


def turned(times: Sequence[float], values: Sequence[Any], time: float, interpolation: str) -> Any:
    """A rotation between keys whose axes differ, as one turn `{ axis = [x, y, z], degrees = a }`.

    Args:
        times: of the keys, increasing.
        values: rotations as the scene file has them: a table, or a list of tables that are done in order.
        time: any.
        interpolation: `step`, `linear` or `smooth`.

    Raises:
        ValueError: an axis has no length.

    Example:
        >>> keys = [{"axis": "x", "degrees": 0.0}, {"axis": "y", "degrees": 90.0}]
        >>> turn = turned([0.0, 1.0], keys, 0.5, "linear")
        >>> [round(x, 9) for x in turn["axis"]], round(turn["degrees"], 9)
        ([0.0, 1.0, 0.0], 45.0)
    """
    at = bisect_right(times, time) - 1
    still = interpolation == "step" or at < 0 or at == len(times) - 1
    if still or time == times[at]:
        return values[max(at, 0)]
    if interpolation == "linear":
        u = (time - times[at]) / (times[at + 1] - times[at])
        return _as_rotation(_slerp(turns(values[at]), turns(values[at + 1]), u))
    # Slopes need the neighbours of both keys, and no more.
    low, high = max(at - 1, 0), min(at + 3, len(times))
    near = [turns(values[low])]
    for value in values[low + 1 : high]:
        q = turns(value)
        near.append(q if _dot(q, near[-1]) >= 0 else (-q[0], -q[1], -q[2], -q[3]))
    x, y, z, w = (_curve(times[low:high], [q[i] for q in near], time, at - low) for i in range(4))
    return _as_rotation((x, y, z, w))


def turns(value: Any) -> Quaternion:
    """The unit quaternion (x, y, z, w) of a rotation, or of several that are done in order.

    Raises:
        ValueError: an axis has no length.

    Example:
        >>> turns({"axis": "z", "degrees": 180.0})[:3]
        (0.0, 0.0, 1.0)
    """
    whole: Quaternion = (0.0, 0.0, 0.0, 1.0)
    for one in value if isinstance(value, (list, tuple)) else [value]:
        axis = one["axis"]
        if isinstance(axis, str):
            axis = [float(axis == name) for name in "xyz"]
        length = math.hypot(*axis)
        if not length > 0:
            raise ValueError("axis must have a length")
        half = math.radians(one["degrees"]) / 2.0
        x, y, z = (math.sin(half) * part / length for part in axis)
        whole = _product((x, y, z, math.cos(half)), whole)
    return whole


def _product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The turn b and then the turn a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _dot(a: Quaternion, b: Quaternion) -> float:
    return sum(p * q for p, q in zip(a, b, strict=True))


def _slerp(a: Quaternion, b: Quaternion, u: float) -> Quaternion:
    cosine = _dot(a, b)
    if cosine < 0:
        cosine, b = -cosine, (-b[0], -b[1], -b[2], -b[3])
    angle = math.acos(min(cosine, 1.0))
    if angle < 1e-9:
        return a
    p, q = math.sin((1.0 - u) * angle) / math.sin(angle), math.sin(u * angle) / math.sin(angle)
    x, y, z, w = (p * one + q * other for one, other in zip(a, b, strict=True))
    return (x, y, z, w)


def _as_rotation(q: Quaternion) -> dict[str, Any]:
    sine = math.hypot(q[0], q[1], q[2])
    if sine == 0:
        return {"axis": "z", "degrees": 0.0}
    axis = [part / sine for part in q[:3]]
    return {"axis": axis, "degrees": 2.0 * math.degrees(math.atan2(sine, q[3]))}
