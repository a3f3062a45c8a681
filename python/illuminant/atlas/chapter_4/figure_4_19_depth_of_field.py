"""Figure 4.19: depth of field: rays start all over the lens and meet in the focal plane (book 4.3.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

FOCAL_MM, F_NUMBER, FOCUS_M = 100.0, 2.0, 2.0
WALLS_M = (1.0, 1.5, 2.0, 3.0, 4.0)


def draw(quick: bool) -> Sheet:
    """The lens, the focal plane and a pixel's rays in section; beside it the blur of traced rays and the formula."""
    import numpy as np

    from illuminant.plots.sketch import Sketch, new_sketches
    from illuminant.plots.style import GREY, line_look

    radius = 0.5e-3 * FOCAL_MM / F_NUMBER
    count = 32 if quick else 256
    met = [_met(distance, count) for distance in WALLS_M]
    blur = np.array([2.0 * np.hypot(*points.T).max() for points in met])
    # All points of the lens see one point of the focal plane: similar triangles.
    wanted = 2.0 * radius * np.abs(np.array(WALLS_M) / FOCUS_M - 1.0)
    # The same on the film of a camera, by the equation of the thin lens, 1/s + 1/s' = 1/f.
    focal = 1e-3 * FOCAL_MM
    film = 1.0 / (1.0 / focal - 1.0 / FOCUS_M)
    image = 1.0 / (1.0 / focal - 1.0 / np.array(WALLS_M))
    sharp = WALLS_M.index(FOCUS_M)
    others = np.arange(len(WALLS_M)) != sharp
    on_film = 2.0 * radius * np.abs(film - image) / image
    back = on_film * np.array(WALLS_M) / film

    figure, (left, right) = new_sketches((8.8, 4.0), 2)
    sketch = Sketch(left)
    red, blue = line_look(1)["color"], line_look(0)["color"]
    # Heights are drawn larger than lengths, or the lens would be a dot.
    taller = 36.0
    drawn = radius * taller
    bow = np.linspace(-1.0, 1.0, 41)
    lens = np.concatenate(
        [
            np.stack([0.09 * (1 - bow**2), drawn * bow], -1),
            np.stack([-0.09 * (1 - bow[::-1] ** 2), drawn * bow[::-1]], -1),
        ]
    )
    sketch.patch(lens, face="#dfeaf2", edge=GREY, zorder=4)
    for distance, name in ((FOCUS_M, "focal plane"), (4.0, "farther object")):
        sketch.line(
            [[distance, -1.4], [distance, 1.4]], color=GREY, linestyle="-" if distance == FOCUS_M else ":"
        )
        sketch.label([distance, 1.4], name, (0, 8), fontsize=8.5)
    sketch.line([[-0.25, 0.0], [4.3, 0.0]], linewidth=0.6, linestyle=(0, (6, 3)))
    for k in range(5):
        start = np.array([0.0, drawn * (k - 2) / 2])
        end = start + (np.array([FOCUS_M, 0.0]) - start) * 4.0 / FOCUS_M
        sketch.ray([start, end], red, head=0.27, linewidth=0.8)
    sketch.dot([FOCUS_M, 0.0], color=red)
    half = drawn * (4.0 / FOCUS_M - 1.0)
    sketch.line([[4.0, -half], [4.0, half]], color=blue, linewidth=3.0, zorder=6)
    sketch.label([4.0, 0.0], "circle of\nconfusion", (30, -16), color=blue, fontsize=8.5)
    sketch.label([0.0, -drawn], "lens, 100 mm f/2", (-8, -12), fontsize=8.5, ha="left")
    sketch.paper([[-0.25, -1.5], [4.85, -1.5]])
    sketch.axes.set_title("rays of one pixel (heights × 36)")
    sketch.frame(0.03)
    # As high as the plot beside it.
    left.set_aspect("auto")

    fine = np.linspace(0.8, 4.2, 200)
    right.plot(fine, 2e3 * radius * np.abs(fine / FOCUS_M - 1.0), **line_look(0), label="thin lens")
    right.plot(
        WALLS_M, 1e3 * blur, linestyle="none", marker="o", color=red, label=f"{count} rays of the camera"
    )
    right.set(
        xlabel="distance of a wall, m",
        ylabel="diameter of the circle of confusion there, mm",
        title="a pixel on walls",
        ylim=(0, 60),
    )
    right.grid(True)
    right.legend(loc="upper center")
    return Sheet(
        picture=figure,
        columns={
            "distance, m": WALLS_M,
            "traced, mm": 1e3 * blur,
            "thin lens, mm": 1e3 * wanted,
            "on the film, mm": 1e3 * on_film,
        },
        checks=(
            Check(
                "traced diameter over the formula, least",
                float((blur[others] / wanted[others]).min()),
                "",
                0.93,
                1.001,
            ),
            Check(
                "traced diameter over the formula, largest",
                float((blur[others] / wanted[others]).max()),
                "",
                0.93,
                1.001,
            ),
            Check("traced diameter in the focal plane", 1e3 * float(blur[sharp]), "mm", at_most=0.01),
            Check(
                "thin-lens equation, film and back, over similar triangles",
                float((back[others] / wanted[others]).max()),
                "",
                1 - 1e-9,
                1 + 1e-9,
            ),
        ),
    )


def _met(distance: float, count: int) -> Array:
    """Where rays of the middle pixel meet a wall, (n, 2), in metres from the axis."""
    import numpy as np

    from illuminant.job import Job
    from illuminant.rendering import replay_job
    from illuminant.scene import Scene

    scene = Scene.build(
        camera={
            "eye": [0, 0, 0],
            "target": [0, 0, -FOCUS_M],
            "size": [1, 1],
            "field_of_view": 1.0,
            "focal_length_mm": FOCAL_MM,
            "f_number": F_NUMBER,
            "focus_distance": FOCUS_M,
        },
        objects={
            "wall": {
                "rectangle": {"corner": [-2, -2, -distance], "edges": [[4, 0, 0], [0, 4, 0]]},
                "material": "wall",
            }
        },
        materials={"wall": {"kind": "diffuse", "reflectance": 0.5}},
        lights={"lamp": {"kind": "point", "position": [0, 0, 0.5], "spectrum": "E", "intensity_cd": 1.0}},
    )
    options: dict[str, Any] = {"technique": "path", "sampling": "uniform:4", "filter": ("box", 1e-6)}
    job = Job(scene, samples=count, **options)
    places = [replay_job(job, (0, 0), k)["passes"][0][0]["position"] for k in range(count)]
    return np.array(places, float)[:, :2]


PLATE = Plate(
    number="4.19",
    title="Depth of field",
    shows="The samples of a pixel start all over the lens, whose diameter is the focal length over the aperture, "
    "and go through one point of the focal plane. What lies in that plane is sharp; a point at the distance $z$ "
    "becomes a circle of confusion of diameter $\\frac{f}{a}\\,|z/z_f - 1|$ there.",
    claim="Rays that the camera sends through its lens fill the circle of confusion of the thin lens and no more, and "
    "meet in one point of the focal plane.",
    today="The aperture may have blades (a polygon, turned), and points on the lens are Owen-scrambled Sobol "
    "points, so that few samples fill it evenly.",
    draw=draw,
    commands=("illuminant check --schema",),
)
