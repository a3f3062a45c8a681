"""Figure 4.3: the first approximation from the eye (book eq 4.1)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """What the eye sees of patch 3 when only the light is known; numbers with and without ambient light."""
    import numpy as np

    from illuminant.atlas.chapter_4.three_patches import draw_room, room

    found = room(120 if quick else 600)
    diffuse = found.diffuse
    balance = diffuse.solved()
    eye = diffuse.seen_from_eye()
    seen = np.array([eye.from_eye(patch, 1) for patch in range(3)])
    ambient = float(balance.mean())
    with_ambient = np.array([eye.from_eye(patch, 1, ambient) for patch in range(3)])
    shades = np.array([0.0, 0.0, seen[2]]) / balance.max()
    notes = (
        "not asked",
        "not asked",
        f"{1e3 * seen[2]:.2f}; with ambient light {1e3 * with_ambient[2]:.2f}; in balance {1e3 * balance[2]:.2f}",
    )
    figure, _ = draw_room(
        shades, [("light", "patch 3", "eye")], "from the eye: what patch 3 has of the light", True, notes
    )
    missing, left = 1.0 - seen[2] / balance[2], abs(with_ambient[2] / balance[2] - 1.0)
    return Sheet(
        picture=figure,
        columns={
            "patch": [1, 2, 3],
            "first approximation": seen,
            "with ambient light": with_ambient,
            "in balance": balance,
        },
        checks=(
            Check("part of patch 3 in balance that is missing", float(missing), at_least=0.01, at_most=0.6),
            Check("the same with ambient light, over that without", float(left / missing), at_most=0.5),
            Check("patches brighter than in balance", float((seen > balance).sum()), at_most=0.0),
        ),
    )


PLATE = Plate(
    number="4.3",
    title="First approximation from the eye",
    shows="Three diffuse patches and a light (intensity 1). The eye asks patch 3, and that the light; what other "
    "patches send, $I_{1,3}$ and $I_{2,3}$, is taken for 0 or for an ambient value (eq 4.1). Grey is what is known "
    "of a patch, and black nothing; numbers are intensities.",
    claim="Light that comes by way of other patches is missing, and an ambient value, the mean of the intensities, "
    "makes up for more than half of it.",
    today="The techniques that ask no further (`constant`, `gouraud`, `phong`) have an ambient light that is "
    "measured on the lamps; `path` has none, as it follows all of the light.",
    draw=draw,
    commands=("illuminant render scenes/cornell.toml --technique phong --samples 4 -o phong.png",),
)
