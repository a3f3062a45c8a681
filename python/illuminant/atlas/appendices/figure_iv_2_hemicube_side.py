"""Figure IV.2: the delta form factor of a cell on the side of a hemi-cube (book eqs IV.5 to IV.7)."""

from __future__ import annotations

from illuminant.atlas.plate import Plate, Sheet


def draw(quick: bool) -> Sheet:
    """A hemi-cube, its side shaded by delta form factors; their sums at several resolutions."""
    from illuminant.atlas.appendices.hemicube_face import face_sheet

    return face_sheet(
        False,
        (-0.45, 0.6),
        [[1, -1, 0], [1, 1, 0], [1, 1, 1], [1, -1, 1]],
        "IV.7",
        lambda cell: float(cell[2] / (cell[1] ** 2 + cell[2] ** 2 + 1.0) ** 2),
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
