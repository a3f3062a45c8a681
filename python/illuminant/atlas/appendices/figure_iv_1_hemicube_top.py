"""Figure IV.1: the delta form factor of a cell on the top of a hemi-cube (book eqs IV.2 to IV.4)."""

from __future__ import annotations

from illuminant.atlas.plate import Plate, Sheet


def draw(quick: bool) -> Sheet:
    """A hemi-cube, its top shaded by delta form factors; their sums at several resolutions."""
    from illuminant.atlas.appendices.hemicube_face import face_sheet

    return face_sheet(
        True,
        (0.45, 0.55),
        [[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]],
        "IV.4",
        lambda cell: float(1.0 / (cell[0] ** 2 + cell[1] ** 2 + 1.0) ** 2),
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
