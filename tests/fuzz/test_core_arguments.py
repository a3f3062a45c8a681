"""Hostile arguments of every function of the compiled core: no panic crosses into Python.

Functions are found in the module itself, so that a new one is tested as it appears. Arguments come from the names of
their parameters' kinds: numbers at the ends of their ranges, arrays of wrong shapes, empty ones, what is none, and what
is of another type. Only `ValueError`, `TypeError`, `OverflowError`, `MemoryError` and `RuntimeError` may come.
"""

import inspect
import random
from typing import Any

import numpy as np
import pytest

from illuminant.core import core

ALLOWED = (ValueError, TypeError, OverflowError, MemoryError, RuntimeError)
CALLS = 400
# Opens a library; what it loads is the caller's choice.
LEFT_OUT = {"load_embree"}
BIG = 300
"""Largest number given where a number may be a count: more would only test patience."""

NAMES = (
    "sRGB", "Rec.709", "linear", "gamma 2.2", "gamma 0", "gamma nan", "PQ", "zero", "hold", "", "D65", "\0", "none",
    "CIE 1931 2°", "uniform:4", "hall:0", "uniform:0", "fitted:8", "1nm", "rgb", "Bradford", "CIE", "book", "bayer-8",
    "random", "blue-noise", "floyd-steinberg", "2000", "1976", "relative", "linear", "x" * 1000, "général", "cylinder",
    "clip", "table", "parametric", "gamma",
)  # fmt: skip
NUMBERS = (
    0, 1, -1, 2, 3, 8, 16, 17, 255, BIG, 0.0, -0.0, 0.5, 1.0, 1e-320, 5e-324, 1e-30, 1e30, 1e308, -1e308, np.nan,
    np.inf, -np.inf, 380.0, 560.0, 780.0, 5000.0,
)  # fmt: skip


def array(draw: random.Random) -> np.ndarray:
    shape = draw.choice([(), (0,), (1,), (2,), (3,), (4,), (31,), (0, 3), (1, 3), (2, 3), (3, 3), (3, 4), (2, 2, 3),
                         (1, 3, 4),
                         (4, 0, 3), (2, 2, 2, 2)])  # fmt: skip
    kind = draw.choice(["f8", "f8", "f8", "f4", "u1", "u2", "i8"])
    values = np.array([draw.choice(NUMBERS) for _ in range(int(np.prod(shape)))], np.float64)
    with np.errstate(all="ignore"):
        if kind[0] != "f":
            values = np.nan_to_num(values, posinf=9, neginf=0).clip(0, 200)
        found = values.reshape(shape).astype(kind)
    if draw.random() < 0.3:
        found = np.sort(found, axis=-1) if found.ndim else found
    return found[..., ::-1] if found.ndim and draw.random() < 0.1 else found


def value(draw: random.Random, depth: int = 0) -> Any:
    kind = draw.randrange(12)
    if kind < 3:
        return draw.choice(NUMBERS)
    if kind < 5:
        return draw.choice(NAMES)
    if kind < 8:
        return array(draw)
    if kind < 10 and depth < 3:
        parts = [value(draw, depth + 1) for _ in range(draw.choice([0, 1, 2, 2, 3, 3, 4, 8]))]
        return tuple(parts) if draw.random() < 0.4 else parts
    if kind == 10:
        return draw.choice([None, True, False, b"", b"\0" * 200, {}, [], (), 1 << 70, -(1 << 70), object()])
    return curve(draw)


def curve(draw: random.Random) -> Any:
    """Wavelengths, values and the rule outside: right as often as wrong, so that calls get behind the first check."""
    count = draw.choice([0, 1, 2, 2, 3, 5])
    wavelengths = sorted(draw.choice([1.0, 380.0, 400.0, 555.5, 700.0, 780.0, 1e4]) for _ in range(count))
    return wavelengths, [draw.choice(NUMBERS) * 1.0 for _ in wavelengths], draw.choice(["zero", "hold", "x"])


def callables() -> dict[str, Any]:
    module = core()
    found = {}
    for name, one in sorted(vars(module).items()):
        if name.startswith("_") or name in LEFT_OUT:
            continue
        if inspect.isclass(one) and issubclass(one, BaseException):
            continue
        if callable(one):
            found[name] = one
        if inspect.isclass(one):
            for part in sorted(vars(one)):
                if not part.startswith("_") and isinstance(vars(one)[part], staticmethod):
                    found[f"{name}.{part}"] = getattr(one, part)
    return found


def parameters(function: Any) -> list[inspect.Parameter]:
    try:
        return list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        return []


def likely(draw: random.Random, name: str) -> Any:
    """What a parameter of this name wants, more often than not, with hostile content."""
    if draw.random() < 0.3:
        return value(draw)
    match name:
        case "range_nm":
            return draw.choice([(380, 780), [400, 400], [1, 2], [780, 380], (-1, 5), (0, 20)])
        case (
            "observer"
            | "transfer"
            | "system"
            | "name"
            | "method"
            | "form"
            | "dither"
            | "formula"
            | "outside"
            | "sampling"
        ):
            return draw.choice(NAMES)
        case "curve" | "a" | "b" | "lamp" | "reflectance":
            return curve(draw)
        case "lamps" | "samples" | "fitted_on" | "judged_on":
            return [curve(draw) for _ in range(draw.randrange(3))]
        case (
            "seed"
            | "bits"
            | "steps"
            | "count"
            | "increments"
            | "depth"
            | "most_fitted"
            | "most_judged"
            | "draws"
            | "step_nm"
        ):
            return draw.choice([0, 1, 2, 5, 8, 16, 17, 255, -1])
        case "rgb" | "xy" | "white" | "white_from" | "white_to":
            return [draw.choice(NUMBERS) for _ in range(draw.choice([2, 3, 3]))]
        case "rows" | "primaries" | "first" | "second":
            return [[draw.choice(NUMBERS) for _ in range(draw.choice([2, 3]))] for _ in range(3)]
        case "cell":
            return draw.choice([(0, 0), (1, 1), (2, 3), (8, 8), (-1, 2), (17, 17)])
        case _:
            return value(draw)


@pytest.mark.parametrize("name", callables())
def test_no_panic_crosses_into_python(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    function = callables()[name]
    draw = random.Random(name)
    known = parameters(function)
    for _ in range(CALLS):
        positional = [one for one in known if one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)]
        given = [likely(draw, one.name) for one in positional]
        named = {
            one.name: likely(draw, one.name)
            for one in known
            if one.kind == one.KEYWORD_ONLY and draw.random() < 0.8
        }
        try:
            with np.errstate(all="ignore"):
                function(*given, **named)
        except ALLOWED as error:
            assert "panicked" not in str(error)
        except BaseException as error:
            pytest.fail(f"{name}{(*given, named)}: {type(error).__name__}: {error}")


def methods() -> list[tuple[str, Any, str]]:
    """Objects that can be made without a scene, and each of their methods."""
    module = core()
    primaries, white = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]], [0.3127, 0.329]
    display = module.Display("d", primaries, white, ["sRGB"] * 3, 100.0, 0.1)
    observer = (np.array([400.0, 500.0, 700.0]), np.ones((3, 3)))
    weights = module.SpectralWeights(
        [400.0, 500.0, 600.0], observer, None, [400.0, 700.0], "zero", "linear", "relative"
    )
    found = []
    for one in (display, weights):
        for part in sorted(vars(type(one))):
            if not part.startswith("_") and callable(getattr(one, part)):
                found.append((f"{type(one).__name__}.{part}", one, part))
    return found


@pytest.mark.parametrize(("name", "thing", "part"), methods(), ids=lambda x: x if isinstance(x, str) else "")
def test_no_method_panics(name: str, thing: Any, part: str) -> None:
    draw = random.Random(name)
    function = getattr(thing, part)
    words = {
        "exposure": 1.0,
        "reference": 100.0,
        "tone": "none",
        "gamut": "clip",
        "bits": 8,
        "dither": "none",
        "seed": 0,
    }
    for _ in range(CALLS):
        given, named = [], {}
        for one in parameters(function):
            if one.kind == one.KEYWORD_ONLY:
                named[one.name] = words[one.name] if draw.random() < 0.6 else likely(draw, one.name)
            else:
                given.append(array(draw) if draw.random() < 0.8 else likely(draw, one.name))
        try:
            function(*given, **named)
        except ALLOWED:
            continue
        except BaseException as error:
            pytest.fail(f"{name}{(*given, named)}: {type(error).__name__}: {error}")
