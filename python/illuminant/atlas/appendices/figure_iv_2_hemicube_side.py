"""Figure IV.2: the delta form factor of a cell on the side of a hemi-cube (book eqs IV.5 to IV.7)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """A hemi-cube, its side shaded by delta form factors; their sums at several resolutions."""
    import numpy as np

    from illuminant.atlas.appendices.hemicube_face import RESOLUTION, draw_cell
    from illuminant.atlas.chapter_4.hemicube import hemicube, point_to_polygon

    figure, middle = draw_cell(False, (-0.45, 0.6))
    cells = hemicube(RESOLUTION)
    own = cells.faces == 1
    error = [abs(float(hemicube(n).delta.sum()) - 1.0) for n in (16, 32, 64)]
    exact = point_to_polygon(np.array([[1, -1, 0], [1, 1, 0], [1, 1, 1], [1, -1, 1]], float))
    share = float(hemicube(64).delta[hemicube(64).faces == 1].sum())
    number = int(np.argmin(np.linalg.norm(cells.middles - middle, axis=1)))
    y, z = middle[1], middle[2]
    printed = float(z * (2.0 / RESOLUTION) ** 2 / (y * y + z * z + 1.0) ** 2 / np.pi)
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
            Check("share of the side over its exact form factor", share / exact, "", 0.999, 1.001),
            Check(
                "drawn cell over eq IV.7 divided by π, less 1",
                abs(float(cells.delta[number]) / printed - 1.0),
                at_most=1e-12,
            ),
        ),
    )


PLATE = Plate(
    number="IV.2",
    title="A cell on the side of a hemi-cube",
    shows="A cell on the side $x_q = 1$ is seen at the distance $r = \\sqrt{1 + y_q^2 + z_q^2}$ (eq IV.5) under the "
    "angles $\\cos\\theta_n = z_q/r$ and $\\cos\\theta_m = 1/r$ (eqs IV.6a and IV.6b), and has the delta form factor "
    "$\\Delta F_q = z_q \\Delta A_q/(1 + y_q^2 + z_q^2)^2$ (eq IV.7). The darker a cell, the larger is its own.",
    claim="Delta form factors of a whole hemi-cube sum to 1, and each of the four sides has 11 % of the sum, as the "
    "exact form factor of half a square says.",
    printed="As printed, delta form factors are for intensities and sum to $\\pi$; nothing is wrong, but $1/\\pi$ "
    "must not come in a second time with the reflectance. The text takes eq 4.21 for the form factor (it is 4.29) "
    "and cites IV.6a for both cosines.",
    today="Cells at the foot of a side bring next to nothing and cost as much as all others; rays drawn with the "
    "cosine (`rays:N`, what is taken if nothing is said) go where light counts.",
    draw=draw,
    commands=(
        "illuminant radiosity solve scenes/cornell.toml --form-factors hemicube:64 -o cornell.solution",
    ),
)
