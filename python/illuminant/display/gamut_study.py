"""What the gamut methods do to colours, in numbers: the study that the book asks for (5.1.3, figures 5.8 to 5.10).

Gradients lead through the gamut of a small display, whose primaries and white luminance lie inside those of the display
that shows the figure, so that a control strip with the right colours can stand beside the clipped ones. They are of two
kinds (book 5.1.3):

- *bright*: from black through a colour of the small gamut to the brightness of the large one, at constant chromaticity;
- *saturated*: from grey to the edge of the large gamut, at constant luminance.

For each method, with Δ between the colour asked for and the one shown, both seen beside the display's white:

| measure | what it is |
| --- | --- |
| ΔE00, ΔE*ab | CIEDE2000 and the distance in L*a*b* of the colours outside: mean, 95th percentile, largest |
| hue | mean angle between the two hues in Oklab, degrees, of colours that keep a chroma above 0.02 |
| lightness | mean of |ΔL*| |
| kink | largest jump of the first derivative of L*a*b* along a gradient of length 1, less that of the gradient itself |
| inside | mean ΔE00 of the colours that were inside, and should not have moved |

A kink is what shows as a Mach band.

Everything is computed; nothing is random.

Example:
    >>> from illuminant.display import gamut_study
    >>> found = gamut_study.study(["clamp", "scale"], hues=4, steps=33)
    >>> sorted(found)
    ['clamp', 'scale']
    >>> found["scale"]["bright"].hue < found["clamp"]["bright"].hue
    True
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from illuminant.display import displays, gamut

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["KINDS", "Deviation", "deviation", "gradients", "measure", "small_display", "strips", "study"]

KINDS = ("bright", "saturated")


@dataclass(frozen=True)
class Deviation:
    """How far a method takes colours from what they should be; see the table of the module.

    Attributes:
        mean, p95, max: CIEDE2000 of the colours outside.
        lab: mean ΔE*ab of the colours outside.
        hue: mean change of hue in Oklab, degrees.
        lightness: mean |ΔL*|.
        kink: largest jump of the first derivative along a gradient.
        inside: mean CIEDE2000 of the colours inside.
    """

    mean: float
    p95: float
    max: float
    lab: float
    hue: float
    lightness: float
    kink: float
    inside: float

    def to_dict(self) -> dict[str, float]:
        """The measures by name."""
        return asdict(self)


def small_display(
    base: str | displays.Display = "sRGB", saturation: float = 0.6, brightness: float = 0.5
) -> displays.Display:
    """A display whose gamut lies inside that of another (book figure 5.9).

    Args:
        base: the display that shows the figure.
        saturation: how far each primary lies from the white towards the base's own.
        brightness: its white, as a part of the base's.
    """
    outer = displays.named(base)
    white = outer.white
    red, green, blue = (
        (white[0] + saturation * (x - white[0]), white[1] + saturation * (y - white[1]))
        for x, y in outer.primaries
    )
    return displays.Display(
        f"small {outer.name}", (red, green, blue), white, outer.response, outer.peak * brightness
    )


def gradients(
    display: displays.Display, outer: displays.Display, kind: str, hues: int = 12, steps: int = 257
) -> Array:
    """Gradients that lead out of a display's gamut and stay in that of another.

    Args:
        display: the one whose gamut they leave.
        outer: the one that can show them whole.
        kind: `bright` or `saturated`.
        hues: how many, at equal steps of hue in HSV.
        steps: colours of a gradient.

    Returns:
        (hues, steps, 3), linear RGB of the display that they leave.
    """
    import numpy as np

    from illuminant.color import hsv_to_rgb

    angles = np.arange(hues) / hues * 360.0
    if kind == "bright":
        # More than half of the saturation at the edge, as surfaces have it.
        colour: Array = hsv_to_rgb(np.stack([angles, np.full(hues, 0.6), np.ones(hues)], axis=-1))
        along = np.linspace(0.0, outer.peak / display.peak, steps)
        return colour[:, None, :] * along[None, :, None]
    edge: Array = hsv_to_rgb(np.stack([angles, np.ones(hues), np.ones(hues)], axis=-1))
    # Dimmed so that the grey is no brighter than three quarters of the white of the gamut that is left.
    luminance = edge @ outer.to_xyz_matrix[1]
    edge *= np.minimum(0.75 * display.peak / outer.peak / luminance, 1.0)[:, None]
    grey = (edge @ outer.to_xyz_matrix[1])[:, None, None] * np.ones(3)
    along = np.linspace(0.0, 1.0, steps)
    shown = grey + (edge[:, None, :] - grey) * along[None, :, None]
    found: Array = shown @ (outer.peak / display.peak * outer.to_xyz_matrix.T) @ display.from_xyz_matrix.T
    return found


def _lab(linear: Array, display: displays.Display) -> Array:
    from illuminant import color

    white = display.to_xyz_matrix.sum(axis=1)
    lab: Array = color.xyz_to_lab(linear @ display.to_xyz_matrix.T, tuple(white))
    return lab


def _hue(linear: Array, display: displays.Display) -> tuple[Array, Array]:
    """Hue (degrees) and chroma in Oklab."""
    import numpy as np

    a, b = np.moveaxis(display.oklab(linear)[..., 1:], -1, 0)
    return np.degrees(np.arctan2(b, a)), np.hypot(a, b)


def deviation(asked: Array, shown: Array, display: displays.Display) -> tuple[Array, Array]:
    """CIEDE2000 and ΔE*ab of every colour of two arrays (..., 3) of linear RGB (figure 5.10)."""
    import numpy as np

    from illuminant import color

    first, second = _lab(asked, display), _lab(shown, display)
    return color.delta_e_2000(first, second), np.linalg.norm(first - second, axis=-1)


def _kink(linear: Array, display: displays.Display) -> Array:
    """Largest jump of the first derivative of L*a*b* along each gradient, whose length is 1."""
    import numpy as np

    lab = _lab(linear, display)
    # Over a sixty-fourth of the gradient the last bits of a bisection do not count.
    reach = max(1, linear.shape[1] // 64)
    slope = (lab[:, reach:] - lab[:, :-reach]) * ((linear.shape[1] - 1) / reach)
    jumps = np.linalg.norm(slope[:, reach:] - slope[:, :-reach], axis=-1)
    start = jumps.shape[1] // 8  # L* has a kink of its own near black
    return np.asarray(jumps[:, start:].max(axis=1))


def measure(asked: Array, method: str, display: displays.Display) -> Deviation:
    """What a method does to gradients.

    Args:
        asked: (gradients, steps, 3), linear RGB.
        method: one of `illuminant.display.gamut.methods()`.
        display: whose RGB this is, and whose gamut is meant.
    """
    import numpy as np

    shown = gamut.bring_inside(asked, method, display)
    outside = gamut.classify(asked) != 0
    delta_e, delta_lab = deviation(asked, shown, display)
    hue_asked, chroma_asked = _hue(asked, display)
    hue_shown, chroma_shown = _hue(shown, display)
    turned = np.abs((hue_shown - hue_asked + 180.0) % 360.0 - 180.0)
    coloured = outside & (chroma_asked > 0.02) & (chroma_shown > 0.02)
    lightness = np.abs(_lab(asked, display) - _lab(shown, display))[..., 0]
    kink = _kink(shown, display) - _kink(asked, display)
    return Deviation(
        mean=float(delta_e[outside].mean()),
        p95=float(np.percentile(delta_e[outside], 95)),
        max=float(delta_e[outside].max()),
        lab=float(delta_lab[outside].mean()),
        hue=float(turned[coloured].mean()) if coloured.any() else 0.0,
        lightness=float(lightness[outside].mean()),
        kink=float(max(kink.max(), 0.0)),
        inside=float(delta_e[~outside].mean()) if (~outside).any() else 0.0,
    )


def study(
    methods: Sequence[str] | None = None, hues: int = 24, steps: int = 513
) -> dict[str, dict[str, Deviation]]:
    """Measures of methods over bright and saturated gradients, and over wide-gamut colours.

    The third set, `wide`, is every colour of a grid of 17 × 17 × 17 in the cube of Rec.2020 that sRGB cannot show.

    Args:
        methods: names; default all.
        hues: gradients of each kind.
        steps: colours of each gradient.
    """
    import numpy as np

    display = displays.named("sRGB")
    small = small_display(display)
    wide = displays.named("Rec.2020")
    levels = np.linspace(0.0, 1.0, 17)
    grid = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(17, -1, 3)
    grid = grid @ wide.to_xyz_matrix.T @ display.from_xyz_matrix.T
    found: dict[str, dict[str, Deviation]] = {}
    for method in methods or gamut.methods():
        found[method] = {
            kind: measure(gradients(small, display, kind, hues, steps), method, small) for kind in KINDS
        }
        found[method]["wide"] = measure(grid, method, display)
    return found


def strips(methods: Sequence[str] | None = None, hues: int = 6, width: int = 768, band: int = 14) -> Array:
    """The comparison strips of figure 5.9: for each gradient a control strip, then one for each method.

    Args:
        methods: names, from the top of each group; default all.
        hues: gradients of each kind.
        width: of a strip in pixels.
        band: height of a strip in pixels.

    Returns:
        XYZ (height, width, 3), relative to the white of sRGB; groups are parted by black.
    """
    import numpy as np

    outer = displays.named("sRGB")
    small = small_display(outer)
    rows = []
    for kind in KINDS:
        for gradient in gradients(small, outer, kind, hues, width):
            asked = gradient[None]
            group = [
                asked,
                *(gamut.bring_inside(asked, method, small) for method in methods or gamut.methods()),
            ]
            rows += [np.repeat(one, band, axis=0) for one in group]
            rows.append(np.zeros((band // 2, width, 3)))
    return np.concatenate(rows[:-1]) @ small.to_xyz_matrix.T * (small.peak / outer.peak)
