"""Figure 4.4: the second approximation from the eye (book eqs 4.2 to 4.4)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Patch 3 asks the other patches, and these the light."""
    import numpy as np

    from illuminant.atlas.chapter_4.three_patches import draw_room, room

    found = room(120 if quick else 600)
    diffuse = found.diffuse
    balance = diffuse.solved()
    eye = diffuse.seen_from_eye()
    seen = np.array([[eye.from_eye(patch, step) for patch in range(3)] for step in (1, 2, 3)])
    shades = np.array([*seen[0, :2], seen[1, 2]]) / balance.max()
    ways = [
        ("light", "patch 3", "eye"),
        ("light", "patch 1", "patch 3", "eye"),
        ("light", "patch 2", "patch 3", "eye"),
    ]
    notes = (
        f"{1e3 * seen[0, 0]:.2f} of the light alone",
        f"{1e3 * seen[0, 1]:.2f} of the light alone",
        f"first {1e3 * seen[0, 2]:.2f}; second {1e3 * seen[1, 2]:.2f}; in balance {1e3 * balance[2]:.2f}",
    )
    figure, _ = draw_room(shades, ways, "from the eye: once and twice reflected", True, notes)
    light = np.array([diffuse.from_light(step) for step in (1, 2, 3)])
    return Sheet(
        picture=figure,
        columns={
            "patch": [1, 2, 3],
            "first approximation": seen[0],
            "second approximation": seen[1],
            "third approximation": seen[2],
            "in balance": balance,
        },
        checks=(
            Check(
                "second approximation of patch 3 over the first",
                float(seen[1, 2] / seen[0, 2]),
                at_least=1.01,
            ),
            Check(
                "part missing in the second over that in the first",
                float((balance[2] - seen[1, 2]) / (balance[2] - seen[0, 2])),
                at_least=0.0,
                at_most=float(np.abs(np.linalg.eigvals(diffuse.exchanged)).max() + 0.1),
            ),
            Check(
                "difference from the school of the light", float(np.abs(seen - light).max()), at_most=1e-12
            ),
            Check(
                "coefficients that the eye needs: n³ + n²", float(eye.coefficients), at_least=36, at_most=36
            ),
        ),
    )


PLATE = Plate(
    number="4.4",
    title="Second approximation from the eye",
    shows="Patch 3 asks patches 1 and 2, and these ask the light: $I_{eye,3} = \\xi_{eye,light,3} I_{light,3} + "
    "\\xi_{eye,1,3}\\,\\xi_{3,light,1} I_{light,1} + \\xi_{eye,2,3}\\,\\xi_{3,light,2} I_{light,2}$ (eq 4.4): light "
    "reflected once (red) and twice (blue).",
    claim="The second approximation counts the light that is reflected twice; what is missing shrinks with the "
    "share that patches send to each other, and the eye comes to the values of the light's school (figure 4.6).",
    printed="Equations 4.2 and 4.3 have a term of the light too many each, which belongs to another patch; equation "
    "4.4, and what is drawn here, is right.",
    today="`path` draws one way of light at a time instead of asking all patches from each, so its cost does not "
    "grow with the depth; its mean is the balance.",
    draw=draw,
    commands=("illuminant render scenes/cornell.toml --depth 3 --samples 4 -o twice.png",),
)
