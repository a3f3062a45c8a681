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
from typing import Any, Literal

from illuminant.core import core
from illuminant.difference import diff
from illuminant.errors import UsageError
from illuminant.image import Image, check_output
from illuminant.rendering import render
from illuminant.scene import Scene, load

__all__ = ["Comparison", "Pair", "check_sheet", "compare", "pairs", "save_sheet"]


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
    """

    pair: Pair
    image: Image = field(repr=False)
    seconds: float
    energy: float
    delta_e: float
    flip: float

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
    on_start: Callable[[Pair], object] | None = None,
    **options: Any,
) -> list[Comparison]:
    """Render a scene by all pairs that are not refused; `path` with `general` is the reference, and comes first.

    Args:
        scene: a `Scene`, or the path of a scene file.
        techniques, illuminations: only these; default all.
        on_start: called with each pair before it is rendered.
        options: as for `render`.

    Raises:
        UsageError: a name is not known, or nothing is left to compare.
        Further as `illuminant.render`.

    Example:
        >>> found = compare("scenes/cornell.toml", samples=16)    # doctest: +SKIP
        >>> found[0].delta_e                                      # doctest: +SKIP
        0.0
    """
    scene = scene if isinstance(scene, Scene) else load(scene)
    wanted_techniques = _names(techniques, list(dict.fromkeys(p.technique for p in pairs())), "--techniques")
    wanted_models = _names(
        illuminations, list(dict.fromkeys(p.illumination for p in pairs())), "--illuminations"
    )
    chosen = [
        pair
        for pair in pairs()
        if pair.technique in wanted_techniques
        and pair.illumination in wanted_models
        and pair.verdict != "refused"
    ]
    if not chosen:
        first = next(
            p for p in pairs() if p.technique in wanted_techniques and p.illumination in wanted_models
        )
        raise UsageError(f"{first.technique} does not go with {first.illumination}: {first.reason}.")
    reference = next(pair for pair in pairs() if (pair.technique, pair.illumination) == ("path", "general"))
    images = {}
    for pair in [reference, *(pair for pair in chosen if pair != reference)]:
        if on_start is not None:
            on_start(pair)
        images[pair] = render(scene, technique=pair.technique, illumination=pair.illumination, **options)
    right = images[reference]
    exposure = right.exposure or right.auto_exposure()
    level = float(right.xyz[..., 1].mean()) or 1.0
    found = []
    for pair, image in images.items():
        if pair is reference and pair not in chosen:
            continue
        apart = diff(right, image, exposure=exposure)
        found.append(
            Comparison(
                pair=pair,
                image=image,
                seconds=float(image.statistics["seconds"]),
                energy=float(image.xyz[..., 1].mean()) / level,
                delta_e=apart.mean,
                flip=apart.flip,
            )
        )
    return found


def check_sheet(path: str | os.PathLike[str]) -> Path:
    """Refuse a sheet's path before the work: it must be a PNG that can be written."""
    target = check_output(path)
    if target.suffix.lower() != ".png":
        raise UsageError(f"{target}: a contact sheet is a .png.")
    return target


def save_sheet(
    path: str | os.PathLike[str], found: Sequence[Comparison], exposure: float | None = None
) -> None:
    """Save all images as one contact sheet with their numbers under them, techniques one below the other.

    Args:
        path: a PNG.
        found: what `compare` gave.
        exposure: factor from Y to the display's 0 to 1; default that of the first image.

    Raises:
        ImageError, UsageError: the file cannot be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    from illuminant import output

    target = check_sheet(path)
    first = found[0].image
    used = exposure or first.exposure or first.auto_exposure()
    rows = list(dict.fromkeys(one.pair.technique for one in found))
    columns = max(sum(one.pair.technique == row for one in found) for row in rows)
    height = 2.4 * first.height / first.width + 0.75
    figure, axes = pyplot.subplots(
        len(rows), columns, figsize=(2.4 * columns, height * len(rows)), squeeze=False, layout="constrained"
    )
    for row, technique in enumerate(rows):
        of_row = [one for one in found if one.pair.technique == technique]
        for column in range(columns):
            axis = axes[row][column]
            axis.set_axis_off()
            if column >= len(of_row):
                continue
            one = of_row[column]
            axis.imshow(one.image.shown(exposure=used).picture.codes, interpolation="lanczos")
            axis.set_title(f"{technique} · {one.pair.illumination}", fontsize=8)
            numbers = f"{one.seconds:.2g} s   energy {100 * one.energy:.0f} %"
            caption = f"{numbers}\nΔE00 {one.delta_e:.2f}   FLIP {one.flip:.3f}"
            axis.text(0.5, -0.03, caption, transform=axis.transAxes, fontsize=7, ha="center", va="top")

    def write(temporary: Path) -> None:
        figure.savefig(temporary, dpi=130, format="png")

    output.write(target, write)
    pyplot.close(figure)
