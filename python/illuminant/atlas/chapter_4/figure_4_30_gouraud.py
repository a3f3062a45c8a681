"""Figure 4.30: colours interpolated between corners, by Bouknight's model (Gouraud 1971; book 4.2.4).

Shadows are found at corners alone. Between a corner in the light and one in the shadow the colour runs over the whole
polygon, so the edge of a shadow shows the polygons of the floor.
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

NUMBER = "4.30"


def draw(quick: bool) -> Sheet:
    """The room, beside the reference; the error is that to the same model evaluated at every pixel."""
    import numpy as np

    from illuminant.atlas.chapter_4 import compared_room as room

    model: dict[str, Any] = {"technique": "phong", "illumination": "bouknight", "subdivide": None}
    found = room.image(NUMBER, quick).xyz[..., 1]
    exact = room.rendered(NUMBER, quick, **model).xyz[..., 1]
    lit = room.rendered(NUMBER, quick, **model | {"shadows": "none"}).xyz[..., 1]
    shadow = exact < 0.9 * lit
    # As far as a polygon reaches: twice its area is the square of its longest side.
    reach = round((2.0 * room.FINENESS[NUMBER][not quick]["subdivide"]) ** 0.5)
    near = np.zeros_like(shadow)
    for axis in (0, 1):
        edge = np.diff(shadow, axis=axis)
        rows, columns = np.nonzero(edge)
        for row, column in zip(rows, columns, strict=True):
            near[max(0, row - reach) : row + reach + 1, max(0, column - reach) : column + reach + 1] = True
    # Outlines of things are the same in both pictures but for their smoothing.
    error = np.abs(found - exact) / exact.mean()
    return room.beside_the_reference(
        NUMBER,
        quick,
        (
            Check("mean error within a polygon of a shadow's edge", float(error[near].mean()), "", 0.03),
            Check(
                "error farther away, over that",
                float(error[~near].mean() / error[near].mean()),
                "",
                at_most=1 / 3,
            ),
        ),
    )


PLATE = Plate(
    number=NUMBER,
    title="Compared: colours interpolated, Bouknight",
    shows="The same room with colours interpolated across polygons (Gouraud), by Bouknight's model, with shadows at "
    "the corners. The book points at the anomalies along the edge of the shadow.",
    claim="The facets are gone, and what is left of the error to the same model at every pixel lies about the edges "
    "of shadows, within a polygon of them: there it is more than three times that elsewhere.",
    today="`--shadows rays` with `phong` finds shadows at every pixel; how large the polygons are is then of no "
    "account.",
    draw=draw,
    commands=(
        "illuminant render scenes/demo.toml --technique gouraud --illumination bouknight --shadows rays",
    ),
)
