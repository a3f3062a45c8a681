"""Figure IV.1: the delta form factor of a cell on the top of a hemi-cube (book eqs IV.2 to IV.4)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """A hemi-cube, its top shaded by delta form factors; their sums at several resolutions."""
    import numpy as np

    from illuminant.atlas.appendices.hemicube_face import RESOLUTION, draw_cell
    from illuminant.atlas.chapter_4.hemicube import hemicube, point_to_polygon

    figure, middle = draw_cell(True, (0.45, 0.55))
    cells = hemicube(RESOLUTION)
    own = cells.faces == 0
    error = [abs(float(hemicube(n).delta.sum()) - 1.0) for n in (16, 32, 64)]
    exact = point_to_polygon(np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]], float))
    share = float(hemicube(64).delta[hemicube(64).faces == 0].sum())
    number = int(np.argmin(np.linalg.norm(cells.middles - middle, axis=1)))
    x, y = middle[0], middle[1]
    printed = float((2.0 / RESOLUTION) ** 2 / (x * x + y * y + 1.0) ** 2 / np.pi)
    return Sheet(
        picture=figure,
        columns={
            "x": cells.middles[own, 0],
            "y": cells.middles[own, 1],
            "z": cells.middles[own, 2],
            "delta form factor": cells.delta[own],
            "as printed, for intensities": np.pi * cells.delta[own],
        },
        checks=(
            Check("sum over all cells of a cube of 64, less 1", error[2], at_most=1e-3),
            Check("error at 32 cells along an edge over that at 64", error[1] / error[2], "", 3.5, 4.5),
            Check("share of the top over its exact form factor", share / exact, "", 0.999, 1.001),
            Check(
                "drawn cell over eq IV.4 divided by π, less 1",
                abs(float(cells.delta[number]) / printed - 1.0),
                at_most=1e-12,
            ),
        ),
    )


PLATE = Plate(
    number="IV.1",
    title="A cell on the top of a hemi-cube",
    shows="A cell of area $\\Delta A_q$ on the top, $z_q = 1$, at the distance $r = \\sqrt{x_q^2 + y_q^2 + 1}$ (eq "
    "IV.2) under equal angles, $\\cos\\theta_n = \\cos\\theta_m = 1/r$ (eq IV.3), has the delta form factor "
    "$\\Delta F_q = \\Delta A_q/(x_q^2 + y_q^2 + 1)^2$ (eq IV.4). The darker a cell, the larger is its own.",
    claim="Delta form factors of a whole hemi-cube sum to 1, the better the more cells it has (the error falls by "
    "four when their edges are halved), and the top has 55 % of the sum, as the exact form factor of a square says.",
    printed="As printed, delta form factors are for intensities and sum to $\\pi$; nothing is wrong, but $1/\\pi$ "
    "must not come in a second time with the reflectance. The text takes eq 4.21 for the form factor; it is eq 4.29.",
    today="Form factors are found by rays drawn with the cosine (`rays:N`) if nothing is said, so every ray counts "
    "the same; on the hemi-cube the largest cell counts some hundred times the smallest. `hemicube:N` and "
    "`scanline:N` are the book's.",
    draw=draw,
    commands=(
        "illuminant radiosity solve scenes/cornell.toml --form-factors hemicube:64 -o cornell.solution",
    ),
)
