"""Figure 4.37: radiosity for diffuse light and rays for what mirrors (Wallace, Cohen and Greenberg 1987; book 4.5).

Both parts of light, each by the technique that suits it; the plate puts all nine pictures of the comparison beside
the reference, with their difference from it.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.37"


def draw(quick: bool) -> Sheet:
    """All nine pictures and the reference, in the order of the book."""
    from illuminant.atlas.chapter_4 import compared_room as room
    from illuminant.plots import picture_sheet

    numbers = list(room.TECHNIQUES)
    right = room.reference(quick)
    apart = {number: room.difference(number, quick) for number in numbers}
    light = {number: room.energy(number, quick) for number in numbers}
    others = [number for number in numbers if number != NUMBER]
    next_delta = min(apart[number].mean for number in others)
    next_flip = min(apart[number].flip for number in others)
    return Sheet(
        picture=picture_sheet(
            [room.codes(one, quick) for one in (*(room.image(number, quick) for number in numbers), right)],
            [
                *(
                    f"{number}  {room.CAPTIONS[number]}\nΔE00 {apart[number].mean:.1f}, "
                    f"FLIP {apart[number].flip:.2f}, energy {100 * light[number]:.0f} %"
                    for number in numbers
                ),
                "path × general: the reference",
            ],
            columns=5,
            magnify=2 if quick else 1,
        ),
        columns={
            "figure": [*numbers, "reference"],
            "technique": [*(room.TECHNIQUES[number]["technique"] for number in numbers), "path"],
            "illumination model": [
                *(room.TECHNIQUES[number].get("illumination", "general") for number in numbers),
                "general",
            ],
            "mean ΔE00 to the reference": [*(apart[number].mean for number in numbers), 0.0],
            "mean FLIP to the reference": [*(apart[number].flip for number in numbers), 0.0],
            "mean luminance over the reference": [*light.values(), 1.0],
        },
        checks=(
            Check(
                "ΔE00 of hybrid over that of the next best", apart[NUMBER].mean / next_delta, "", at_most=0.8
            ),
            Check(
                "FLIP of hybrid over that of the next best", apart[NUMBER].flip / next_flip, "", at_most=0.8
            ),
            Check("mean luminance of hybrid over the reference", light[NUMBER], "", 0.96, 1.04),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: hybrid, and all nine",
    shows="The same room by the hybrid of radiosity and ray tracing, and the eight pictures before it (book figures "
    "4.29 to 4.37), each with its difference from the reference.",
    claim="Of the nine the hybrid is nearest to the reference, by ΔE00 and by FLIP, and by a fifth at least nearer "
    "than the next; it holds as much light within 4 %.",
    today="The reference, `path` with `general` and `--caustics`, needs no solution, no elements and no choice of "
    "ways of light; what is left of its error is noise.",
    draw=draw,
    commands=(
        "illuminant compare scenes/demo.toml --size 320x180 --samples 16",
        "illuminant render scenes/cornell.toml --technique hybrid --gather full --samples 32",
    ),
)
