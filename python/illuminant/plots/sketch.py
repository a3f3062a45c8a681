"""Drawings of geometry: arrows, angles, surfaces, patches, rays and solids, in the plane or seen in space.

A `Sketch` draws on axes without ticks, in which a unit is as long upwards as to the right. Points are (x, y) in a flat
sketch, and (x, y, z) with z upwards in one that has a `View`: a parallel projection from a direction, so that what is
parallel stays so and equal steps stay equal. Nothing is hidden by itself: what is drawn later lies above, and
`View.depth` says what is nearer.

Example:
    >>> view = View(azimuth_deg=-60.0, elevation_deg=25.0)
    >>> view.paper([[0.0, 0.0, 1.0]]).round(4).tolist()
    [[0.0, 0.9063]]
    >>> [round(float(d), 4) for d in view.towards_eye]
    [0.4532, -0.7849, 0.4226]
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import DPI, GREY, INK

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["LAMP", "PAPER", "SURFACE", "Sketch", "View", "arc", "circle", "hemisphere_mesh", "new_sketches"]

SURFACE = "#e9e6df"
"""The fill of a surface."""

PAPER = "#f7f6f3"
"""The fill of what only helps to see: planes, spheres."""

LAMP = "#f4c542"
"""The fill of a lamp."""


class View:
    """A parallel projection of space to paper.

    Args:
        azimuth_deg: from where, about z: 0 is from +x, −90 from −y.
        elevation_deg: above the xy plane.
    """

    def __init__(self, azimuth_deg: float, elevation_deg: float) -> None:
        import numpy as np

        a, e = np.radians(azimuth_deg), np.radians(elevation_deg)
        self.towards_eye: Array = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self._axes: Array = np.array(
            [[-np.sin(a), np.cos(a), 0.0], [-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)]]
        )

    def paper(self, points: ArrayLike) -> Array:
        """Points (..., 3) on the paper (..., 2)."""
        import numpy as np

        return np.asarray(np.asarray(points, float) @ self._axes.T)

    def depth(self, points: ArrayLike) -> Array:
        """How near points (..., 3) are to the eye: larger is nearer."""
        import numpy as np

        return np.asarray(np.asarray(points, float) @ self.towards_eye)


def new_sketches(size: tuple[float, float], columns: int = 1, rows: int = 1) -> tuple[Figure, list[Axes]]:
    """A figure of a size in inches with axes for sketches, row by row."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, dpi=DPI, layout="constrained", facecolor="white")
    return figure, list(figure.subplots(rows, columns, squeeze=False).ravel())


def arc(centre: ArrayLike, first: ArrayLike, second: ArrayLike, radius: float, count: int = 33) -> Array:
    """Points of a circle about a centre from one direction to another, the short way, in two or three dimensions.

    Example:
        >>> arc([0.0, 0.0], [1.0, 0.0], [0.0, 3.0], 2.0, count=2).round(6).tolist()
        [[2.0, 0.0], [0.0, 2.0]]
    """
    import numpy as np

    a = np.asarray(first, float) / np.linalg.norm(first)
    b = np.asarray(second, float) / np.linalg.norm(second)
    across = b - (a @ b) * a
    across = across / max(float(np.linalg.norm(across)), 1e-12)
    t = np.linspace(0.0, np.arccos(np.clip(a @ b, -1.0, 1.0)), count)[:, None]
    return np.asarray(np.asarray(centre, float) + radius * (np.cos(t) * a + np.sin(t) * across))


def circle(centre: ArrayLike, normal: ArrayLike, radius: float, count: int = 97) -> Array:
    """Points of a closed circle in space about a normal."""
    import numpy as np

    n = np.asarray(normal, float) / np.linalg.norm(normal)
    s = np.cross(n, [1.0, 0.0, 0.0] if abs(n[0]) < 0.9 else [0.0, 1.0, 0.0])
    s = s / np.linalg.norm(s)
    t = np.linspace(0.0, 2.0 * np.pi, count)[:, None]
    return np.asarray(np.asarray(centre, float) + radius * (np.cos(t) * s + np.sin(t) * np.cross(n, s)))


def hemisphere_mesh(radius: float = 1.0, latitudes: int = 3, longitudes: int = 12) -> list[Array]:
    """The circles of a hemisphere about z: its foot, circles of equal elevation, and half meridians."""
    import numpy as np

    lines = []
    for k in range(latitudes):
        rise = 0.5 * np.pi * k / latitudes
        lines.append(circle([0, 0, radius * np.sin(rise)], [0, 0, 1], radius * np.cos(rise)))
    for k in range(longitudes):
        phi = 2.0 * np.pi * k / longitudes
        lines.append(arc([0, 0, 0], [np.cos(phi), np.sin(phi), 0], [0, 0, 1], radius))
    return lines


class Sketch:
    """A drawing on axes.

    Args:
        axes: any; their ticks and frame go.
        view: how space is seen; without it points are those of the paper.
    """

    def __init__(self, axes: Axes, view: View | None = None) -> None:
        self.axes = axes
        self.view = view
        axes.set_axis_off()
        axes.set_aspect("equal")

    def paper(self, points: ArrayLike) -> Array:
        """Points on the paper, (..., 2); the axes grow to hold them."""
        import numpy as np

        seen = self.view.paper(points) if self.view else np.asarray(points, float)
        self.axes.update_datalim(seen.reshape(-1, 2))
        return seen

    def frame(self, margin: float = 0.06) -> None:
        """Set the limits about all that was drawn, with a margin in parts of the larger side."""
        box = self.axes.dataLim
        pad = margin * max(box.width, box.height)
        self.axes.set_xlim(box.x0 - pad, box.x1 + pad)
        self.axes.set_ylim(box.y0 - pad, box.y1 + pad)

    def label(self, at: ArrayLike, text: str, shift: tuple[float, float] = (0.0, 0.0), **look: Any) -> None:
        """Text at a point, shifted by typographic points to the right and upwards; centred if nothing is said."""
        x, y = self.paper(at)
        style: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 9.5, "zorder": 9, "color": INK}
        self.axes.annotate(text, (x, y), shift, textcoords="offset points", **style | look)

    def line(self, points: ArrayLike, **look: Any) -> None:
        """A line through points."""
        style: dict[str, Any] = {"color": GREY, "linewidth": 0.9, "zorder": 3, "solid_capstyle": "butt"}
        self.axes.plot(*self.paper(points).T, **style | look)

    def dot(self, at: ArrayLike, size: float = 4.0, **look: Any) -> None:
        """A point."""
        style: dict[str, Any] = {"color": INK, "markeredgewidth": 0.0, "zorder": 7}
        x, y = self.paper(at)
        self.axes.plot([x], [y], marker="o", markersize=size, **style | look)

    def arrow(
        self,
        tail: ArrayLike,
        tip: ArrayLike,
        text: str = "",
        colour: str = INK,
        away: float = 9.0,
        **look: Any,
    ) -> None:
        """An arrow; its label stands beyond the tip, away from it by typographic points."""
        import numpy as np

        ends = self.paper(np.array([tail, tip], float))
        style: dict[str, Any] = {"arrowstyle": "-|>,head_width=0.22,head_length=0.5", "color": colour}
        style |= {"linewidth": 1.5, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter"}
        self.axes.annotate(
            "", tuple(ends[1]), tuple(ends[0]), arrowprops=style | look, zorder=look.get("zorder", 6)
        )
        if text:
            out = ends[1] - ends[0]
            out = out / max(float(np.hypot(*out)), 1e-12) * away
            self.axes.annotate(
                text,
                tuple(ends[1]),
                (float(out[0]), float(out[1])),
                textcoords="offset points",
                ha="center",
                va="center",
                fontsize=10.0,
                color=colour,
                zorder=9,
            )

    def ray(self, points: ArrayLike, colour: str = INK, head: float = 0.53, **look: Any) -> None:
        """Light on its way through points: a thin line with a head on each part, so far along it."""
        import numpy as np

        path = self.paper(points)
        style: dict[str, Any] = {"color": colour, "linewidth": 1.1, "zorder": 5}
        style |= look
        self.axes.plot(*path.T, **style)
        width = float(style["linewidth"])
        for a, b in itertools.pairwise(path):
            if np.hypot(*(b - a)) > 0.0:
                arrow = {"arrowstyle": "-|>,head_width=0.2,head_length=0.42", "linewidth": width}
                arrow |= {"color": colour, "shrinkA": 0, "shrinkB": 0, "alpha": style.get("alpha")}
                self.axes.annotate(
                    "",
                    tuple(a + (head + 0.02) * (b - a)),
                    tuple(a + (head - 0.03) * (b - a)),
                    arrowprops=arrow,
                    zorder=style["zorder"],
                )

    def angle(
        self,
        apex: ArrayLike,
        first: ArrayLike,
        second: ArrayLike,
        radius: float,
        text: str = "",
        colour: str = GREY,
        out: float = 9.0,
    ) -> None:
        """The arc of an angle between two directions at a point, and its label beyond the middle of it."""
        import numpy as np

        points = arc(apex, first, second, radius)
        self.line(points, color=colour, linewidth=0.8, zorder=5)
        if text:
            middle, centre = self.paper(points[len(points) // 2]), self.paper(apex)
            away = middle - centre
            away = away / max(float(np.hypot(*away)), 1e-12) * out
            self.label(
                points[len(points) // 2],
                text,
                (float(away[0]), float(away[1])),
                color=colour if colour != GREY else INK,
            )

    def right_angle(self, apex: ArrayLike, first: ArrayLike, second: ArrayLike, size: float) -> None:
        """The mark of a right angle between two directions."""
        import numpy as np

        p = np.asarray(apex, float)
        a = size * np.asarray(first, float) / np.linalg.norm(first)
        b = size * np.asarray(second, float) / np.linalg.norm(second)
        self.line([p + a, p + a + b, p + b], linewidth=0.7)

    def patch(self, corners: ArrayLike, face: Any = SURFACE, edge: Any = GREY, **look: Any) -> None:
        """A filled polygon."""
        from matplotlib.patches import Polygon

        style: dict[str, Any] = {"linewidth": 0.8, "zorder": 2, "joinstyle": "round"}
        self.axes.add_patch(
            Polygon(self.paper(corners), closed=True, facecolor=face, edgecolor=edge, **style | look)
        )

    def patches(self, polygons: Sequence[ArrayLike], faces: Sequence[Any], **look: Any) -> None:
        """Many filled polygons, the far ones first if space is seen."""
        import numpy as np
        from matplotlib.collections import PolyCollection

        order = np.arange(len(polygons))
        if self.view is not None:
            view = self.view
            order = np.argsort([float(view.depth(one).mean()) for one in polygons], kind="stable")
        style: dict[str, Any] = {"linewidths": 0.4, "edgecolors": GREY, "zorder": 2}
        self.axes.add_collection(
            PolyCollection(
                [self.paper(polygons[int(i)]) for i in order],
                facecolors=[faces[int(i)] for i in order],
                **style | look,
            )
        )

    def surface(self, first: ArrayLike, second: ArrayLike, depth: float, fill: str = "") -> None:
        """The edge of a solid in a flat sketch, hatched on the right of the way from the first point to the second."""
        import numpy as np
        from matplotlib.patches import Polygon

        a, b = np.asarray(first, float), np.asarray(second, float)
        along = (b - a) / np.linalg.norm(b - a)
        down = depth * np.array([along[1], -along[0]])
        body = self.paper([a, b, b + down, a + down])
        self.axes.add_patch(
            Polygon(
                body, closed=True, facecolor=fill or "none", edgecolor="#b9b4a8", hatch="////", linewidth=0.0
            )
        )
        self.line([a, b], color=INK, linewidth=1.2, zorder=4)

    def hemisphere(self, radius: float = 1.0, latitudes: int = 3, longitudes: int = 12) -> None:
        """A hemisphere about z over its filled foot; what lies behind is paler."""
        import numpy as np

        assert self.view is not None, "a hemisphere needs a view of space"
        self.patch(circle([0, 0, 0], [0, 0, 1], radius), face=SURFACE, edge=GREY, zorder=1)
        for points in hemisphere_mesh(radius, latitudes, longitudes):
            near = self.view.depth(points) >= -1e-9
            for side, colour in ((near, "#9a9a9a"), (~near, "#d9d9d9")):
                shown = np.where(side[:, None], points, np.nan)
                self.axes.plot(
                    *self.view.paper(shown).T,
                    color=colour,
                    linewidth=0.6,
                    zorder=4 if colour == "#9a9a9a" else 1.5,
                )
        # Finely, for the rim ends between two points where the foot begins.
        rim = circle([0, 0, 0], self.view.towards_eye, radius, 961)
        upper = np.where((rim[:, 2] >= -1e-9)[:, None], rim, np.nan)
        self.axes.plot(*self.view.paper(upper).T, color=GREY, linewidth=0.9, zorder=4)

    def box(self, low: ArrayLike, high: ArrayLike, turn: ArrayLike | None = None, **look: Any) -> None:
        """The edges of a box between two corners, turned by a matrix (3, 3); edges behind are dotted."""
        import numpy as np

        assert self.view is not None, "a box needs a view of space"
        a, b = np.asarray(low, float), np.asarray(high, float)
        middle, half = (a + b) / 2.0, (b - a) / 2.0
        rotation = np.eye(3) if turn is None else np.asarray(turn, float)
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        corners = (signs * half) @ rotation.T + middle
        hidden = int(np.argmin(self.view.depth(corners)))
        for i in range(8):
            for j in range(i + 1, 8):
                if np.abs(signs[i] - signs[j]).sum() == 2.0:
                    behind = hidden in (i, j)
                    style: dict[str, Any] = {"linestyle": ":" if behind else "-"}
                    style |= {"color": GREY, "linewidth": 0.7 if behind else 1.0}
                    self.line([corners[i], corners[j]], **style | look)
