"""Figure 4.10: what lies between the corners of a quadrilateral depends on how it lies to the scanlines (Duff 1979).

Incremental shading runs along edges from corner to corner, and along each scanline from edge to edge (book 4.2.4,
figure 4.8). Over a triangle that is the one linear function through three corners, whatever the angle. Through the
four corners of a square there is none, in general, and the value at a place changes as the square turns.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating]

ANGLES_DEG = (0.0, 22.5, 45.0)
LAMP = {"kind": "point", "position": [-0.85, 0.85, 0.45], "intensity_cd": 300.0}


def along_scanlines(corners: Array, values: Array, size: int) -> Array:
    """A convex polygon filled by interpolation along its edges and then along each scanline (book figure 4.8).

    Args:
        corners: (n, 2), x and y in pixels; y grows downwards.
        values: (n,).
        size: pixels along each side of the picture.

    Returns:
        (size, size), NaN outside.
    """
    import numpy as np

    filled = np.full((size, size), np.nan)
    middles = np.arange(size) + 0.5
    for row, y in enumerate(middles):
        ends = []
        for (a, b), (va, vb) in zip(
            zip(corners, np.roll(corners, -1, 0), strict=True),
            zip(values, np.roll(values, -1), strict=True),
            strict=True,
        ):
            if (a[1] <= y) != (b[1] <= y):
                t = (y - a[1]) / (b[1] - a[1])
                ends.append((a[0] + t * (b[0] - a[0]), va + t * (vb - va)))
        if len(ends) == 2:
            (left, first), (right, last) = sorted(ends)
            inside = (middles >= left) & (middles < right)
            filled[row, inside] = first + (last - first) * (middles[inside] - left) / (right - left)
    return filled


def draw(quick: bool) -> Sheet:
    """One square under a lamp near a corner, at three angles; below, its diagonal, as a square and as two triangles."""
    import numpy as np

    from illuminant.atlas.chapter_4.incremental_shading import lit, shaded, square
    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.image import Image
    from illuminant.plots.style import TODAY, line_look

    size, distance, field_of_view = (161 if quick else 361), 6.0, 28.0
    scale = size / 2 / np.tan(np.radians(field_of_view / 2)) / distance
    # From the bright corner across the square to the dark one.
    way = np.linspace(-0.96, 0.96, 97)
    places = np.stack([way, -way], axis=-1)
    corners = np.array([[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]])
    values: Array | None = None
    pictures, squares, triangles = [], [], []
    for angle in ANGLES_DEG:
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        scene = lit({"mesh": square(1)}, LAMP, size=size, field_of_view=field_of_view, up=[-s, c, 0.0])

        def on_screen(points: Array, c: float = c, s: float = s) -> Array:
            x, y = points[..., 0] * c + points[..., 1] * s, -points[..., 0] * s + points[..., 1] * c
            return np.stack([size / 2 + scale * x, size / 2 - scale * y], axis=-1)

        def seen(picture: Array, points: Array) -> Array:
            column, row = np.floor(on_screen(points)).astype(int).T
            found: Array = picture[row, column]
            return found

        whole = shaded(scene, "gouraud").xyz
        if values is None:
            # The renderer's own colours at the corners, just inside; they are the same at every angle.
            values = seen(whole[..., 1], corners * (1 - 1.5 / scale))
            white = whole.max(axis=(0, 1)) / whole[..., 1].max()
        filled = along_scanlines(on_screen(corners), values, size)
        pictures.append(Image(np.nan_to_num(filled)[..., None] * white))
        squares.append(seen(filled, places))
        triangles.append(seen(whole[..., 1], places))
    assert values is not None
    figure, axes = pictures_over_curve(
        [one.shown(exposure=0.95 / float(values.max())).picture.codes for one in pictures],
        [f"turned by {angle:g}°" for angle in ANGLES_DEG],
    )
    for i, angle in enumerate(ANGLES_DEG):
        axes.plot(way, squares[i], **line_look(i), label=f"square, turned by {angle:g}°")
        axes.plot(way, triangles[i], **TODAY | ({} if i == 0 else {"linewidth": 0.8}))
    axes.plot([], [], **TODAY, label="two triangles, at all three angles")
    axes.set(
        xlabel="place on the diagonal from the bright corner to the dark one, x",
        ylabel="luminance, cd/m²",
        xlim=(-1, 1),
        ylim=(0, None),
    )
    axes.legend(loc="upper right")
    largest = float(values.max())

    def apart(curves: list[Array]) -> float:
        return float(np.nanmax(np.ptp(np.array(curves), axis=0)) / largest)

    return Sheet(
        picture=figure,
        columns={
            "x": way,
            **{f"square at {a:g}°, cd/m²": squares[i] for i, a in enumerate(ANGLES_DEG)},
            **{f"triangles at {a:g}°, cd/m²": triangles[i] for i, a in enumerate(ANGLES_DEG)},
        },
        checks=(
            Check(
                "largest change of a place as the square turns, of the brightest corner",
                apart(squares),
                "",
                0.1,
            ),
            Check(
                "the same of two triangles (a pixel is shaded in its middle)",
                apart(triangles),
                "",
                at_most=0.03,
            ),
        ),
    )


PLATE = Plate(
    number="4.10",
    title="Shading that turns with the scanlines",
    shows="A diffuse square with a lamp near one corner, shaded by incremental interpolation of its corner colours "
    "along edges and scanlines, at three angles to the scanlines.",
    claim="The light of one place on a square changes by more than a tenth of its brightest corner as the square "
    "turns under the scanlines; over triangles it stays, because three corners have but one linear function.",
    today="Every polygon is cut into triangles before it is scanned, so nothing shimmers in an animation; where the "
    "cut goes still shows, and `--subdivide` takes that away too.",
    draw=draw,
    commands=(
        "illuminant render scenes/demo.toml --technique gouraud --illumination bouknight --subdivide 4",
    ),
)
