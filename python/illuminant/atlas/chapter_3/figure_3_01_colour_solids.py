"""Figure 3.1: colour solids: Munsell, the RGB cube, HSV and three of HSL (book 3.1)."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

HUES = ("5R", "5Y", "5G", "5B", "5P")


def draw(quick: bool) -> Sheet:
    """The six solids in the colours that stand in them; the luminances that share a height."""
    import numpy as np

    from illuminant.color import hsl_to_rgb, hsv_to_rgb, rgb_to_hsl, rgb_to_hsv, rgb_to_xyz
    from illuminant.plots.sketch import Sketch, View, new_sketches

    figure, panels = new_sketches((8.8, 6.0), 3, 2)
    steps = 8 if quick else 12
    surface = _cube_surface(steps)
    rgb = surface.mean(axis=1)
    solids: dict[str, Any] = {
        "RGB cube": None,
        "HSV hexcone": rgb_to_hsv,
        "HSL double hexcone": rgb_to_hsl,
        "HSL double cone": lambda c: rgb_to_hsl(c, solid="double cone"),
        "HSL cylinder": lambda c: rgb_to_hsl(c, solid="cylinder"),
    }
    _munsell(Sketch(panels[0], View(-60.0, 22.0)), plain=quick)
    panels[0].set_title("Munsell")
    panels[0].set_anchor("N")
    for axes, (name, convert) in zip(panels[1:], solids.items(), strict=True):
        sketch = Sketch(axes, View(-60.0, 24.0))
        if convert is None:
            places, faces = surface, rgb
        else:
            cylinder = name == "HSL cylinder"
            places = _placed(np.asarray(convert(surface.reshape(-1, 3))), name).reshape(surface.shape)
            faces = rgb
            if cylinder:
                # Near its ends squares of the cube would be wide: its side is cut evenly, and coloured backwards.
                squares = _full_saturation(3 * steps, steps)
                faces = np.asarray(hsl_to_rgb(squares.mean(axis=1), solid="cylinder"))
                places = _placed(squares.reshape(-1, 3), name).reshape(squares.shape)
                # Its black and white ends are circles that stand for one colour each.
                for level in (0.0, 1.0):
                    ring = np.linspace(0.0, 2.0 * np.pi, 49)
                    disc = np.stack([np.cos(ring), np.sin(ring), np.full_like(ring, 1.2 * level)], axis=-1)
                    sketch.patch(disc, face=(level, level, level), zorder=1 if level == 0.0 else 3)
        sketch.patches(list(places), list(np.clip(faces, 0.0, 1.0)), linewidths=0.15)
        axes.set_title(name)
        sketch.frame(0.04)
        # Titles of one row stand at one height.
        axes.set_anchor("N")

    random = np.random.default_rng(31)
    colours = random.uniform(0.0, 1.0, (2000, 3))
    back = {
        "HSV hexcone": hsv_to_rgb(rgb_to_hsv(colours)),
        "HSL double hexcone": hsl_to_rgb(rgb_to_hsl(colours)),
        "HSL double cone": hsl_to_rgb(rgb_to_hsl(colours, solid="double cone"), solid="double cone"),
        "HSL cylinder": hsl_to_rgb(rgb_to_hsl(colours, solid="cylinder"), solid="cylinder"),
    }
    errors = [float(np.abs(np.asarray(one) - colours).max()) for one in back.values()]
    # The six full colours: as high as each other in HSL, as high as white in HSV.
    full = np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]], float)
    luminance = np.asarray(rgb_to_xyz(full))[:, 1]
    heights = np.asarray(rgb_to_hsl(full))[:, 2]
    names = ["red", "yellow", "green", "cyan", "blue", "magenta"]
    hsv = np.asarray(rgb_to_hsv(full))
    return Sheet(
        picture=figure,
        columns={
            "colour": names,
            "hue, deg": hsv[:, 0],
            "HSV value": hsv[:, 2],
            "HSL lightness": heights,
            "luminance of linear sRGB": luminance,
        },
        checks=(
            Check("RGB to each solid and back, largest error", max(errors), at_most=1e-12),
            Check(
                "HSL lightness of the full colours, largest less smallest",
                float(np.ptp(heights)),
                at_most=1e-12,
            ),
            Check(
                "luminance of yellow over that of blue, both of one height",
                float(luminance[1] / luminance[4]),
                "",
                12.5,
                13.2,
            ),
        ),
    )


def _cube_surface(steps: int) -> Array:
    """Small squares of the six faces of the RGB cube, (n, 4, 3)."""
    import numpy as np

    edge = np.linspace(0.0, 1.0, steps + 1)
    squares = []
    for axis in range(3):
        for level in (0.0, 1.0):
            for a, b in itertools.pairwise(edge):
                for c, d in itertools.pairwise(edge):
                    corners = np.array([[a, c], [b, c], [b, d], [a, d]])
                    squares.append(np.insert(corners, axis, level, axis=1))
    return np.array(squares)


def _full_saturation(around: int, upwards: int) -> Array:
    """Pieces of full saturation as hue in degrees, saturation and height, (n, 4, 3)."""
    import numpy as np

    hues, heights = np.linspace(0.0, 360.0, around + 1), np.linspace(0.0, 1.0, upwards + 1)
    squares = []
    for a, b in itertools.pairwise(hues):
        for c, d in itertools.pairwise(heights):
            squares.append([[a, 1.0, c], [b, 1.0, c], [b, 1.0, d], [a, 1.0, d]])
    return np.array(squares)


def _placed(triples: Array, name: str) -> Array:
    """Where hue, saturation and height stand in a solid: hexagonal or round, tapering or not."""
    import numpy as np

    hue, saturation, height = np.radians(triples[:, 0]), triples[:, 1], triples[:, 2]
    if name in ("HSL double cone", "HSL cylinder"):
        wide = saturation
    elif name == "HSV hexcone":
        wide = saturation * height
    else:
        wide = saturation * (1.0 - np.abs(2.0 * height - 1.0))
    if "hexcone" in name:
        # From the angle of the hexagon's rim, on which hue is linear, to the paper.
        sextant = np.floor(triples[:, 0] / 60.0)
        part = triples[:, 0] / 60.0 - sextant
        first, second = np.radians(60.0 * sextant), np.radians(60.0 * (sextant + 1.0))
        x = (1 - part) * np.cos(first) + part * np.cos(second)
        y = (1 - part) * np.sin(first) + part * np.sin(second)
    else:
        x, y = np.cos(hue), np.sin(hue)
    return np.stack([wide * x, wide * y, 1.2 * height], axis=-1)


def _munsell(sketch: Any, plain: bool) -> None:
    """Chips about the neutral axis: hue the direction, chroma the distance, value the height; plain without colours."""
    import numpy as np

    from illuminant.color import munsell_to_xyz, xyz_to_rgb

    names, places = [], []
    for value in (2, 4, 6, 8):
        names.append(f"N {value}/")
        places.append([0.0, 0.0, 2.2 * value])
    for k, hue in enumerate(HUES):
        angle = 2.0 * np.pi * k / len(HUES)
        for value, most in ((4, 8), (6, 8), (8, 4)):
            for chroma in range(4, most + 1, 4):
                names.append(f"{hue} {value}/{chroma}")
                places.append([chroma * np.cos(angle), chroma * np.sin(angle), 2.2 * value])
    # Munsell's renotation is colour-science's, which takes seconds to import.
    xyz = np.full((len(names), 3), 0.5) if plain else munsell_to_xyz(names)
    codes = np.clip(np.asarray(xyz_to_rgb(xyz, encoded=True, white="C", adaptation="Bradford")), 0.0, 1.0)
    at = np.array(places)
    sketch.line([[0, 0, 1.0], [0, 0, 21.0]], linewidth=0.9, zorder=1)
    sketch.label([0, 0, 21.0], "white", (0, 7), fontsize=7.5)
    sketch.label([0, 0, 1.0], "black", (0, -7), fontsize=7.5)
    assert sketch.view is not None
    for number in np.argsort(sketch.view.depth(at)):
        sketch.dot(at[number], 11.0, color=codes[number], markeredgewidth=0.4, markeredgecolor="#777777")
    for k, hue in enumerate(HUES):
        angle = 2.0 * np.pi * k / len(HUES)
        sketch.label([11.0 * np.cos(angle), 11.0 * np.sin(angle), 11.0], hue, fontsize=8)
    sketch.frame(0.1)


PLATE = Plate(
    number="3.1",
    title="Colour solids",
    shows="Colours by hue (a direction), saturation or chroma (a distance from the neutral axis) and value or "
    "lightness (a height): chips of Munsell's system in their colours, and solids made of the RGB cube: the cube "
    "itself on its axes, the HSV hexcone (Smith 1978), the HSL double hexcone, double cone and cylinder (Joblove "
    "and Greenberg 1978).",
    claim="Every solid holds the colours of the cube and gives them back exactly, but a height is no luminance: "
    "yellow and blue, of one lightness and one value, differ in luminance by a factor of 13.",
    today="Heights, distances and directions that look equal are those of CAM16 or Oklab, in which this program maps "
    "gamuts; HSV and HSL remain for picking.",
    draw=draw,
    commands=("illuminant atlas 3.10",),
)
