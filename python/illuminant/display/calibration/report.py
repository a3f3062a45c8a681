"""How well a monitor shows what it should: ΔE00 over the ColorChecker, the greys, and a verdict.

The chart is meant as under D6500 (or another white), with a perfect diffuser as bright as the monitor can show that
white. It is driven in two ways:

- before: as though the monitor were the display that it is taken for (sRGB, say);
- after: through its fitted description.

ΔE00 lies between what is meant and what is shown, in L*a*b* beside the white that is meant. Patches that the monitor
cannot show, because a primary would have to be negative or above full, are clamped, named, and left out of the mean
and the maximum; `mean_all` has them too.

The criteria of the levels are those of book 5.4: white 103 cd/m² (30 foot-lamberts; 28 fL spare a tube), D6500 at all
levels, black dark. Tolerances are this program's: 10 % of luminance; 0.004 in u', v' for white, which is a barely
visible tint; 0.006 for greys down to 2 % of white, and ΔE00 ≤ 1 on the mean of the chart.

Example:
    >>> from illuminant.display.calibration.monitor import Monitor
    >>> ideal = Monitor()
    >>> chart = nominal_chart(ideal.xyz, assumed="sRGB")
    >>> round(chart.mean, 1)
    0.9
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from illuminant.display.calibration.monitor import D6500, WHITE_LUMINANCE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.calibration.fit import Characterisation
    from illuminant.display.calibration.readings import Readings
    from illuminant.display.displays import Display

    Array = NDArray[np.float64]
    Mask = NDArray[np.bool_]
    Show = Callable[[Any], Array]

__all__ = [
    "Chart",
    "Criterion",
    "Grey",
    "chart_codes",
    "described_chart",
    "greys",
    "nominal_chart",
    "verdict",
]

OUTSIDE = 1e-3
"""How far a linear value may leave 0 to 1 before its patch is called out of the gamut."""

DARKEST = 0.02
"""Greys darker than this fraction of white are not judged: a colorimeter does not know their colour well."""


@dataclass(frozen=True)
class Chart:
    """The ColorChecker as it was meant and as it was shown.

    Attributes:
        differences: ΔE00 by patch.
        outside: patches that the monitor cannot show.
        mean, max: ΔE00 over the others.
        mean_all: ΔE00 over all.
        white: luminance of a perfect diffuser, cd/m².
    """

    differences: dict[str, float]
    outside: tuple[str, ...]
    mean: float
    max: float
    mean_all: float
    white: float


class Description(Protocol):
    """What the report needs of a description: `Characterisation` has it, and `description.Described`."""

    def linear(self, xyz: Any) -> Array:
        """How much of each primary a colour in cd/m² needs."""
        ...

    def codes(self, linear: Any) -> Array:
        """Code values of amounts of the primaries, clamped."""
        ...

    def reachable(self, xy: tuple[float, float]) -> float:
        """The highest luminance of a white of this chromaticity, cd/m²."""
        ...


class Grey(NamedTuple):
    """One grey that was read.

    Attributes:
        code: its code value.
        luminance: cd/m², black included.
        x, y: chromaticity.
        off: distance from the white, in u', v'.
    """

    code: float
    luminance: float
    x: float
    y: float
    off: float


class Criterion(NamedTuple):
    """One line of a verdict.

    Attributes:
        name: what is judged.
        passed: whether it is good.
        found, wanted: in words.
    """

    name: str
    passed: bool
    found: str
    wanted: str


def _judged(meant: Array, shown: Array, outside: Mask, xy: tuple[float, float], white: float) -> Chart:
    import numpy as np

    from illuminant import color
    from illuminant.display.patterns.color_checker import NAMES

    beside = (np.array(color.white_xyz(xy)) * white).tolist()
    labs = [color.xyz_to_lab(xyz, beside) for xyz in (meant, shown)]
    errors = np.asarray(color.delta_e_2000(*labs), np.float64)
    inside = errors[~outside]
    return Chart(
        differences=dict(zip(NAMES, errors.tolist(), strict=True)),
        outside=tuple(name for name, out in zip(NAMES, outside.tolist(), strict=True) if out),
        mean=float(inside.mean()) if inside.size else float("nan"),
        max=float(inside.max()) if inside.size else float("nan"),
        mean_all=float(errors.mean()),
        white=white,
    )


def _outside(linear: NDArray[np.floating[Any]]) -> Mask:
    """Which colours (n, 3) a display cannot show."""
    import numpy as np

    return np.asarray(((linear < -OUTSIDE) | (linear > 1.0 + OUTSIDE)).any(axis=1), np.bool_)


def nominal_chart(
    show: Show, *, assumed: str | Display = "sRGB", white: tuple[float, float] = D6500
) -> Chart:
    """The chart on a monitor that is taken for another.

    Args:
        show: XYZ in cd/m² of code values: a monitor, or a description of one.
        assumed: display that it is taken for, or its name.
        white: x and y of the white that is meant; the diffuser is as bright as the monitor's own white.
    """
    import numpy as np

    from illuminant.display.displays import named
    from illuminant.display.patterns.color_checker import chart_xyz

    level = float(show(np.ones(3))[1])
    relative = chart_xyz(white)
    taken_for = named(assumed)
    # As fractions of its white: the display's own luminances do not matter here.
    linear = relative @ taken_for.from_xyz_matrix.T
    outside = _outside(linear)
    codes = np.clip(taken_for.encode(np.clip(linear, 0.0, 1.0)), 0.0, 1.0)
    return _judged(relative * level, show(codes), outside, white, level)


def chart_codes(model: Description, white: tuple[float, float] = D6500) -> tuple[Array, Array, Mask, float]:
    """Code values (24, 3) that show the chart through a description, XYZ meant, what is outside, and the white."""
    from illuminant.display.patterns.color_checker import chart_xyz

    level = model.reachable(white)
    meant = chart_xyz(white) * level
    linear = model.linear(meant)
    outside = _outside(linear)
    return model.codes(linear), meant, outside, level


def described_chart(
    show: Show, model: Description, *, white: tuple[float, float] = D6500, bits: int | None = None
) -> Chart:
    """The chart on a monitor that is driven through its description.

    Args:
        show: XYZ in cd/m² of code values: the monitor, or its readings.
        model: the description.
        white: x and y of the white that is meant.
        bits: of a code; None for codes without steps.
    """
    import numpy as np

    codes, meant, outside, level = chart_codes(model, white)
    if bits is not None:
        codes = np.round(codes * (2**bits - 1)) / (2**bits - 1)
    return _judged(meant, show(codes), outside, white, level)


def greys(readings: Readings, *, white: tuple[float, float] = D6500) -> list[Grey]:
    """The greys of a table, and how far each is from the white; black is not one of them."""
    import numpy as np

    from illuminant import color

    table = readings.greys()
    target = color.xyz_to_uvy(np.array(color.white_xyz(white)))
    found = []
    for code, xyz in zip(table.codes[:, 0].tolist(), table.xyz, strict=True):
        if code == 0.0 or xyz.sum() <= 0.0:
            continue
        x, y, luminance = color.xyz_to_xyy(xyz).tolist()
        off = float(np.hypot(*(color.xyz_to_uvy(xyz)[:2] - target[:2])))
        found.append(Grey(code, luminance, x, y, off))
    return found


def verdict(
    readings: Readings,
    *,
    after: Chart | None = None,
    white: tuple[float, float] = D6500,
    luminance: float = WHITE_LUMINANCE,
) -> list[Criterion]:
    """Whether a monitor is adjusted, by readings of its greys, and whether its description is good.

    Args:
        readings: black and greys with white.
        after: the chart through the fitted description.
        white: x and y to which it should be set.
        luminance: of white to which it should be set, cd/m².

    Raises:
        UsageError: the luminance is not above 0.
    """
    from illuminant.display.gamma.response import positive

    luminance = positive(luminance, "The luminance of white to be set")
    found = greys(readings, white=white)
    lines: list[Criterion] = []
    table = readings.greys()
    full = [grey for grey in found if grey.code == 1.0]
    if full:
        level = sum(grey.luminance for grey in full) / len(full)
        off = max(grey.off for grey in full)
        near = abs(level / luminance - 1.0) <= 0.1
        lines.append(
            Criterion("white luminance", near, f"{level:.1f} cd/m²", f"{luminance:g} cd/m² within 10 %")
        )
        shown = f"x, y = {full[-1].x:.4f}, {full[-1].y:.4f}: {off:.4f} off in u', v'"
        lines.append(
            Criterion("white point", off <= 0.004, shown, f"{white[0]:g}, {white[1]:g} within 0.004")
        )
        judged = [grey for grey in found if grey.luminance >= DARKEST * level]
        worst = max(judged, key=lambda grey: grey.off)
        shown = f"up to {worst.off:.4f} off, at code {worst.code:.2f}"
        lines.append(Criterion("grey scale", worst.off <= 0.006, shown, "all within 0.006 of white"))
        dark = table.xyz[table.codes[:, 0] == 0.0, 1]
        if dark.size:
            ratio = float(dark.mean()) / level
            lines.append(
                Criterion("black level", ratio <= 0.01, f"{100 * ratio:.2g} % of white", "1 % or less")
            )
    if after is not None:
        shown = f"mean ΔE00 {after.mean:.2f}, max {after.max:.2f}"
        lines.append(Criterion("description", after.mean <= 1.0, shown, "mean 1 or less"))
    return lines


def as_read(readings: Readings, model: Characterisation) -> Show:
    """What readings alone say that a monitor shows: each gun's own levels, with straight lines between.

    It judges a description by more than the description itself: where a gun does not follow gain, offset and γ, the
    lines still follow its readings.

    Args:
        readings: with at least two levels of each channel by itself, else the description stands for it.
        model: fitted to them; gives black and primaries, and the scale on which lines are straight.
    """
    import numpy as np

    light = (readings.xyz - model.black) @ np.linalg.inv(model.primaries)
    curves = []
    for gun in range(3):
        alone = (np.delete(readings.codes, gun, axis=1) == 0.0).all(axis=1)
        codes = np.unique(readings.codes[alone, gun])
        means = np.array([light[alone & (readings.codes[:, gun] == code), gun].mean() for code in codes])
        # Lines on the scale of the drive, on which light is nearly straight.
        curves.append((codes, np.maximum(means, 0.0) ** (1.0 / model.gamma[gun])) if len(codes) > 2 else None)

    def show(codes: Any) -> Array:
        wanted = np.asarray(codes, np.float64)
        found = model.light(wanted)
        for gun, curve in enumerate(curves):
            if curve is not None:
                found[..., gun] = np.interp(wanted[..., gun], *curve) ** model.gamma[gun]
        return np.asarray(found @ model.primaries + model.black)

    return show
