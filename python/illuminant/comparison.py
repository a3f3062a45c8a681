"""One scene by every technique and every illumination model, side by side (book 4.6, figures 4.29 to 4.37).

Example:
    >>> sorted({pair.verdict for pair in pairs()})
    ['refused', 'sensible', 'warned']
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from illuminant import machine
from illuminant.core import core
from illuminant.difference import diff
from illuminant.errors import UsageError
from illuminant.image import Image, check_output
from illuminant.rendering import render
from illuminant.scene import Scene, load

if TYPE_CHECKING:
    from illuminant.display.picture import Picture

__all__ = [
    "CAPTIONS",
    "Comparison",
    "Pair",
    "check_layout",
    "check_sheet",
    "compare",
    "contact_sheet",
    "pairs",
    "pairs_named",
    "save_sheet",
]

CAPTIONS = ("numbers", "difference", "names")
"""What may stand under the images of a contact sheet."""
REFERENCE = ("path", "general")


@dataclass(frozen=True)
class Pair:
    """A technique and an illumination model.

    Attributes:
        technique, illumination: their names.
        verdict: whether they belong together; what is warned of works, what is refused does not.
        reason: why.
    """

    technique: str
    illumination: str
    verdict: Literal["sensible", "warned", "refused"]
    reason: str


@dataclass(frozen=True)
class Comparison:
    """One image of a comparison.

    Attributes:
        pair: what made it.
        image: in absolute XYZ.
        seconds: of rendering.
        energy: mean luminance relative to the reference.
        delta_e: mean CIEDE2000 against the reference.
        flip: mean FLIP against the reference.
        exposure: of the reference, by which both are shown.
    """

    pair: Pair
    image: Image = field(repr=False)
    seconds: float
    energy: float
    delta_e: float
    flip: float
    exposure: float

    @property
    def reference(self) -> bool:
        """Whether it is what the others are compared with."""
        return (self.pair.technique, self.pair.illumination) == REFERENCE

    def facts(self) -> dict[str, Any]:
        """The numbers, by name."""
        return {
            "technique": self.pair.technique,
            "illumination": self.pair.illumination,
            "seconds": self.seconds,
            "energy": self.energy,
            "delta_e": self.delta_e,
            "flip": self.flip,
        }


@cache
def pairs() -> tuple[Pair, ...]:
    """Every technique with every illumination model, with the verdict on it."""
    return tuple(Pair(*one) for one in core().pairs())


def pairs_named(names: str) -> tuple[Pair, ...]:
    """The pairs of a text such as `gouraud:phong,path:general`, in its order.

    Raises:
        UsageError: there is no such pair, it stands there twice, or the two do not go together.

    Example:
        >>> [pair.illumination for pair in pairs_named("raytrace:whitted,path:general")]
        ['whitted', 'general']
    """
    known = {_pair(pair): pair for pair in pairs()}
    found: list[Pair] = []
    for name in names.split(","):
        if name not in known:
            raise UsageError(
                f"--only {name}: expected a technique and a model, such as raytrace:whitted, with commas between pairs."
            )
        pair = known[name]
        if pair.verdict == "refused":
            raise UsageError(f"{pair.technique} does not go with {pair.illumination}: {pair.reason}.")
        if pair in found:
            raise UsageError(f"--only {name}: stands there twice.")
        found.append(pair)
    return tuple(found)


def _names(which: Sequence[str] | None, known: Sequence[str], option: str) -> Sequence[str]:
    for name in which or ():
        if name not in known:
            raise UsageError(f"{option} {name}: known are {', '.join(known)}.")
    return which or known


def compare(
    scene: Scene | str | os.PathLike[str],
    *,
    techniques: Sequence[str] | None = None,
    illuminations: Sequence[str] | None = None,
    only: str | None = None,
    on_start: Callable[[Pair], object] | None = None,
    allow_outside: bool = False,
    memory_limit: int | str | None = None,
    **options: Any,
) -> list[Comparison]:
    """Render a scene by all pairs that are not refused, or some; `path` with `general` is the reference.

    The reference comes first, where no pairs are chosen.

    Args:
        scene: a `Scene`, or the path of a scene file.
        techniques, illuminations: only these; default all.
        only: these pairs in this order, such as "gouraud:phong,path:general"; in place of the two.
        on_start: called with each pair before it is rendered.
        allow_outside: whether the files that a scene file names may lie outside its folder.
        memory_limit: as for `render`.
        options: as for `render`.

    Raises:
        UsageError: a name is not known, nothing is left to compare, or `only` stands beside the other two.
        Further as `illuminant.render`.

    Example:
        >>> found = compare("scenes/cornell.toml", samples=16)    # doctest: +SKIP
        >>> found[0].delta_e                                      # doctest: +SKIP
        0.0
    """
    with machine.limited_to(memory_limit):
        scene = scene if isinstance(scene, Scene) else load(scene, allow_outside=allow_outside)
    if only is not None and (techniques is not None or illuminations is not None):
        raise UsageError("--only names pairs, and stands in place of --techniques and --illuminations.")
    chosen = pairs_named(only) if only is not None else _chosen(techniques, illuminations)
    reference = next(pair for pair in pairs() if (pair.technique, pair.illumination) == REFERENCE)
    images = {}
    for pair in [reference, *(pair for pair in chosen if pair != reference)]:
        if on_start is not None:
            on_start(pair)
        images[pair] = render(
            scene,
            technique=pair.technique,
            illumination=pair.illumination,
            memory_limit=memory_limit,
            **options,
        )
    right = images[reference]
    exposure = right.exposure or right.auto_exposure()
    level = float(right.xyz[..., 1].mean()) or 1.0
    found = []
    for pair in images if only is None else chosen:
        if pair is reference and pair not in chosen:
            continue
        image = images[pair]
        apart = diff(right, image, exposure=exposure)
        found.append(
            Comparison(
                pair=pair,
                image=image,
                seconds=float(image.statistics["seconds"]),
                energy=float(image.xyz[..., 1].mean()) / level,
                delta_e=apart.mean,
                flip=apart.flip,
                exposure=exposure,
            )
        )
    return found


def _chosen(techniques: Sequence[str] | None, illuminations: Sequence[str] | None) -> tuple[Pair, ...]:
    """The pairs of these techniques and models that are not refused."""
    wanted_techniques = _names(techniques, list(dict.fromkeys(p.technique for p in pairs())), "--techniques")
    wanted_models = _names(
        illuminations, list(dict.fromkeys(p.illumination for p in pairs())), "--illuminations"
    )
    asked = [p for p in pairs() if p.technique in wanted_techniques and p.illumination in wanted_models]
    chosen = tuple(pair for pair in asked if pair.verdict != "refused")
    if not chosen:
        first = asked[0]
        raise UsageError(f"{first.technique} does not go with {first.illumination}: {first.reason}.")
    return chosen


def check_sheet(path: str | os.PathLike[str]) -> Path:
    """Refuse a sheet's path before the work: it must be a PNG that can be written."""
    target = check_output(path)
    if target.suffix.lower() != ".png":
        raise UsageError(f"{target}: a contact sheet is a .png.")
    return target


def contact_sheet(
    found: Sequence[Comparison],
    exposure: float | None = None,
    *,
    columns: int | None = None,
    captions: str = "numbers",
    command: str | None = None,
) -> Picture:
    """All images on one contact sheet, pixel for pixel and all at one exposure, with captions under them.

    Args:
        found: what `compare` gave.
        exposure: factor from Y to the display's 0 to 1; default that of the reference.
        columns: so many in a row, in their order; default the techniques one below the other.
        captions: "numbers" (seconds, energy, ΔE00 and FLIP), "difference" (ΔE00) or "names" alone.
        command: that made it, without the file it writes; `illuminant info` shows it.

    Raises:
        UsageError: there is no such caption, or no column.
    """
    import json

    from illuminant.display.displays import named
    from illuminant.display.picture import Picture
    from illuminant.plots.contact_sheet import sheet

    check_layout(columns, captions)
    used = exposure or found[0].exposure
    if columns is None:
        names = dict.fromkeys(one.pair.technique for one in found)
        rows = [[one for one in found if one.pair.technique == name] for name in names]
    else:
        rows = [list(found[at : at + columns]) for at in range(0, len(found), columns)]
    shown = {id(one): one.image.shown(exposure=used).picture.codes for one in found}
    codes = sheet([[(shown[id(one)], _caption(one, captions)) for one in row] for row in rows])
    scene = str(found[0].image.settings.get("scene", ""))
    settings = {"scene": scene, "pairs": [_pair(one.pair) for one in found]}
    if command:
        settings["command"] = command
    text = {"Exposure": f"{used:.9g}", "Settings": json.dumps(settings)}
    return Picture(codes, named("sRGB"), text=text)


def save_sheet(
    path: str | os.PathLike[str], found: Sequence[Comparison], exposure: float | None = None, **layout: Any
) -> None:
    """Save all images as one contact sheet.

    Args:
        path: a PNG.
        found: what `compare` gave.
        exposure: as for `contact_sheet`.
        layout: columns, captions and command, as for `contact_sheet`.

    Raises:
        ImageError, UsageError: the file cannot be written, or the layout cannot be.
    """
    target = check_sheet(path)
    contact_sheet(found, exposure, **layout).save(target)


def check_layout(columns: int | None, captions: str) -> None:
    """Refuse a layout of a sheet before the work.

    Raises:
        UsageError: there is no such caption, or no column.
    """
    if captions not in CAPTIONS:
        raise UsageError(f"--captions {captions}: expected {', '.join(CAPTIONS)}.")
    if columns is not None and columns < 1:
        raise UsageError(f"--columns {columns}: expected 1 or more.")


def _pair(pair: Pair) -> str:
    return f"{pair.technique}:{pair.illumination}"


def _caption(one: Comparison, captions: str) -> tuple[str, ...]:
    name = f"{one.pair.technique} · {one.pair.illumination}"
    if captions == "names":
        return (name,)
    if captions == "difference":
        return (name, "the reference" if one.reference else f"ΔE00 {one.delta_e:.1f}")
    return (
        name,
        f"{one.seconds:.2g} s   energy {100 * one.energy:.0f} %",
        f"ΔE00 {one.delta_e:.2f}   FLIP {one.flip:.3f}",
    )
