"""Figure 2.4: the illuminating hemisphere, and the solid angle of what is projected onto it (book 2.2.3)."""

from __future__ import annotations

import itertools

from illuminant.atlas.plate import Check, Plate, Sheet

CORNER = (0.35, 0.15, 1.35)
EDGES = ((0.75, -0.45, 0.15), (0.30, 0.60, 0.30))
"""A source: a rectangle above the surface, whose normal is +z; lengths in radii of the hemisphere."""


def draw(quick: bool) -> Sheet:
    """The hemisphere, the source and its projection; the cells between the lines of both have their solid angles."""
    import numpy as np

    from illuminant import verify
    from illuminant.plots.sketch import LAMP, Sketch, View, new_sketches
    from illuminant.plots.style import GREY, line_look

    corner, (first, second) = np.array(CORNER), np.array(EDGES)
    across = np.cross(first, second)
    cells = 6

    def at(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return np.asarray(corner + u[..., None] * first + v[..., None] * second)

    def onto_sphere(points: np.ndarray) -> np.ndarray:
        return np.asarray(points / np.linalg.norm(points, axis=-1, keepdims=True))

    def seen_angle(u: tuple[float, float], v: tuple[float, float]) -> float:
        """∫ cos θ′/r² dA over a part of the source, by Gauss."""
        x, w = np.polynomial.legendre.leggauss(8)
        a, b = np.meshgrid(u[0] + (x + 1) / 2 * (u[1] - u[0]), v[0] + (x + 1) / 2 * (v[1] - v[0]))
        points = at(a, b)
        r = np.linalg.norm(points, axis=-1)
        weights = np.outer(w, w) / 4 * (u[1] - u[0]) * (v[1] - v[0])
        return float((weights * np.abs(points @ across) / r**3).sum())

    grid = np.linspace(0.0, 1.0, cells + 1)
    omega = np.array(
        [[seen_angle((a, b), (c, d)) for a, b in itertools.pairwise(grid)]
         for c, d in itertools.pairwise(grid)]
    )  # fmt: skip
    outline = at(np.array([0.0, 1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0, 1.0]))
    exact = _spherical_polygon(onto_sphere(outline))
    middle = corner + (first + second) / 2
    distance = float(np.linalg.norm(middle))
    approximated = abs(float(across @ middle)) / distance**3

    figure, (axes,) = new_sketches((6.4, 5.0))
    sketch = Sketch(axes, View(-58.0, 22.0))
    sketch.hemisphere(1.0, 6, 24)
    fine = np.linspace(0.0, 1.0, 25)
    edge = np.concatenate(
        [at(fine, 0 * fine), at(0 * fine + 1, fine), at(fine[::-1], 0 * fine + 1), at(0 * fine, fine[::-1])]
    )
    sketch.patch(onto_sphere(edge), face=LAMP, edge=line_look(1)["color"], zorder=5)
    for k in range(1, cells):
        for line in (at(0 * fine + k / cells, fine), at(fine, 0 * fine + k / cells)):
            sketch.line(onto_sphere(line), color=line_look(1)["color"], linewidth=0.4, zorder=5.5)
    for point in outline:
        sketch.line([[0, 0, 0], point], linewidth=0.7, color=line_look(1)["color"], zorder=5.2)
    sketch.patch(outline, face=LAMP, edge=line_look(1)["color"], zorder=6, alpha=0.9)
    sketch.dot([0, 0, 0])
    sketch.arrow([0, 0, 0], [0, 0, 1.28], "$\\mathbf{N}$")
    sketch.label(middle, "source", zorder=10)
    sketch.label(onto_sphere(outline)[1], f"ω = {exact:.3f} sr", (108, -4), color=line_look(1)["color"])
    sketch.label([0.53, -0.85, 0.0], "the whole hemisphere: 2π sr", (0, -12), color=GREY, fontsize=8.5)
    sketch.frame()

    def inside(directions: np.ndarray) -> np.ndarray:
        """1 where a direction meets the source."""
        t = (corner @ across) / np.maximum(directions @ across, 1e-9)
        offset = t[:, None] * directions - corner
        frame = np.linalg.lstsq(np.stack([first, second], axis=1), offset.T, rcond=None)[0]
        return np.asarray(((frame >= 0.0) & (frame <= 1.0)).all(axis=0).astype(float))

    counted = verify.integrate(inside, increments=90 if quick else 360)
    whole = verify.integrate(lambda d: np.ones(len(d)))
    u, v = np.meshgrid((grid[1:] + grid[:-1]) / 2, (grid[1:] + grid[:-1]) / 2)
    centres = at(u, v).reshape(-1, 3)
    return Sheet(
        picture=figure,
        columns={
            "x, radii": centres[:, 0],
            "y, radii": centres[:, 1],
            "z, radii": centres[:, 2],
            "solid angle of the cell, sr": omega.ravel(),
        },
        checks=(
            Check(
                "solid angle by integration over that of the spherical polygon",
                float(omega.sum() / exact),
                "",
                1 - 1e-9,
                1 + 1e-9,
            ),
            Check("directions counted on the hemisphere, over the same", counted / exact, "", 0.97, 1.03),
            Check("whole hemisphere over 2π", whole / (2.0 * np.pi), "", 1 - 1e-9, 1 + 1e-9),
            Check(
                "area over squared distance (eq 2.4), relative error",
                abs(approximated / exact - 1.0),
                at_most=float(np.linalg.norm(first + second) / 2 / distance) ** 2,
            ),
        ),
    )


def _spherical_polygon(corners: object) -> float:
    """The area of a convex quadrilateral of the unit sphere, two triangles (van Oosterom and Strackee 1983)."""
    import numpy as np

    p = np.asarray(corners, float)
    total = 0.0
    for a, b, c in ((p[0], p[1], p[2]), (p[0], p[2], p[3])):
        total += 2.0 * np.arctan2(abs(float(a @ np.cross(b, c))), 1.0 + a @ b + b @ c + c @ a)
    return float(total)


PLATE = Plate(
    number="2.4",
    title="The illuminating hemisphere",
    shows="All that lights a point is projected onto a hemisphere of radius 1 about it. The part that a source covers "
    "is its solid angle, $\\omega = \\int \\cos\\theta'\\,dA/r^2$: here a rectangle of "
    "0.89 by 0.73 radii with the lines that cut it into 36 cells, whose solid angles are the data.",
    claim="The solid angle is the area of the projection: the integral over the source is that of its spherical "
    "polygon, the hemisphere as a whole has $2\\pi$, and the area over the squared distance (eq 2.4) is wrong by less "
    "than the squared ratio of half its diagonal to its distance.",
    today="Rectangles and triangles that shine are sampled by their spherical polygons (Arvo 1995, Ureña 2013), so "
    "every direction drawn meets the lamp, and they are equally dense over all of it.",
    draw=draw,
    commands=("illuminant atlas 2.6", "illuminant render scenes/cornell.toml --samples 4 -o cornell.png"),
)
