"""Figure 5.28: safe action and safe title areas (SMPTE RP 27.3; book 5.5)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The areas over a picture, by the standard of 1983 and by that of flat displays."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen, still_life
    from illuminant.display.patterns import safe_areas
    from illuminant.plots import picture_sheet

    values = still_life(quick)
    height, width = values.shape[:2]
    marks = safe_areas.detail(values, 0.2)
    pictures, captions, standards, areas, fractions, shares, lost = [], [], [], [], [], [], []
    for standard in safe_areas.STANDARDS:
        pictures.append(
            seen(safe_areas.overlay(values, standard=standard, color=1.0, thickness=1 if quick else 2))
        )
        action, title = safe_areas.fractions(standard)
        captions.append(f"{standard}: action {100 * action:g} %, title {100 * title:g} %")
        for area, fraction in (("action", action), ("title", title)):
            standards.append(standard)
            areas.append(area)
            fractions.append(fraction)
            shares.append(float(safe_areas.inside(width, height, fraction).mean()))
            lost.append(safe_areas.outside(marks, fraction))
    found = dict(zip(zip(standards, areas, strict=True), zip(shares, lost, strict=True), strict=True))
    old, new = safe_areas.STANDARDS
    sides = [safe_areas.rectangle(width, height, fraction) for fraction in fractions]
    centred = max(max(abs(a + c - width), abs(b + d - height)) for a, b, c, d in sides)
    return Sheet(
        picture=picture_sheet(pictures, captions, columns=2),
        columns={
            "standard": standards,
            "area": areas,
            "part of each side": fractions,
            "part of the picture": shares,
            "part of its edges outside": lost,
        },
        checks=(
            Check("safe action, part of the picture", found[old, "action"][0], at_least=0.80, at_most=0.82),
            Check("safe title, part of the picture", found[old, "title"][0], at_least=0.63, at_most=0.65),
            Check("areas off the middle", float(np.asarray(centred)), "pixels", at_most=1),
            Check(
                "edges outside safe title, 1983 over 2009",
                found[old, "title"][1] / found[new, "title"][1],
                at_least=1.2,
            ),
        ),
    )


PLATE = Plate(
    number="5.28",
    title="Safe action and safe title",
    shows="The middle 90 % of the picture's sides, within which all that matters should happen, and the middle 80 %, "
    "within which text is sure to be read (SMPTE RP 27.3-1983).",
    claim="Safe action is 81 % of the picture and safe title 64 %: more than a third of it cannot be trusted to show "
    "what must be read.",
    today="Flat displays hide less: SMPTE ST 2046-1 (2009) has 93 % and 90 %. `video check` says how much of a "
    "picture's edges lies outside.",
    draw=draw,
    commands=("illuminant video safe room.png framed.png", "illuminant pattern safe-areas -o safe.png"),
)
