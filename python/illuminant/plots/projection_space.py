"""How a chromaticity diagram comes about, drawn in the space of three lights (book figure 3.6).

The amounts (L, M, H) of three monochromatic lights that match one wavelength are a point of space. The line from the
origin through it meets the plane L + M + H = 1 at the point divided by its sum: the chromaticity. Seen along -L, the
curve of these points is the diagram of `chromaticity`. Space is shown by a parallel projection.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from illuminant.plots import observer as observers
from illuminant.plots.monochromatic import spectrum
from illuminant.plots.style import GREY, INK, new_figure, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

__all__ = ["on_plane", "projection"]

ON_PAPER = ((-0.85, -0.22), (0.0, 0.91), (0.78, -0.34))
"""Where one unit of L, of M and of H lies on the paper, seen from a place with all three above zero."""


def on_plane(amounts: ArrayLike) -> NDArray[np.float64]:
    """Points (..., 3) of the plane L + M + H = 1 on the lines from the origin through amounts (..., 3).

    Example:
        >>> on_plane([[2.0, 1.0, 1.0], [1.0, 2.0, -1.0]]).tolist()
        [[0.5, 0.25, 0.25], [0.5, 1.0, -0.5]]
    """
    import numpy as np

    given = np.asarray(amounts, dtype=np.float64)
    return np.asarray(given / given.sum(axis=-1, keepdims=True))


def _seen(points: ArrayLike) -> NDArray[np.float64]:
    """Points (..., 3) of L, M, H on the paper (..., 2)."""
    import numpy as np

    return np.asarray(np.asarray(points, dtype=np.float64) @ np.array(ON_PAPER))


def projection(
    primaries_nm: Sequence[float],
    *,
    observer: str | observers.Functions = "1931",
    plain: bool = False,
    size: tuple[float, float] = (7.5, 6.5),
) -> Figure:
    """The amounts of three lights in space, and their chromaticities on the plane L + M + H = 1.

    Args:
        primaries_nm: three wavelengths, nm.
        observer: a name, see `observer.named`, or its functions.
        plain: the curves without the colours of the spectrum.
        size: width and height, inches.

    Raises:
        UsageError: no such observer, or unusable primaries.

    Example:
        >>> figure = projection((445, 535, 630))
        >>> figure.axes[0].get_title(loc="left")
        'Chromaticity on the plane L + M + H = 1, lights at 445, 535 and 630 nm'
    """
    import numpy as np

    eye = observers.named(observer) if isinstance(observer, str) else observer
    lights = observers.for_primaries(eye, primaries_nm)
    wavelengths = np.arange(400.0, 701.0)
    amounts = lights.at(wavelengths)
    flat = on_plane(amounts)
    colours = np.full((len(wavelengths), 3), 0.13) if plain else spectrum(eye, wavelengths) / 255.0
    with styled():
        figure, axes = new_figure(size)
        axes.set_aspect("equal")
        axes.set_axis_off()
        short, middle, long = sorted(primaries_nm)
        axes.set_title(
            f"Chromaticity on the plane L + M + H = 1, lights at {short:g}, {middle:g} and {long:g} nm",
            wrap=True,
        )
        _draw_space(axes, lights.labels)
        for wavelength in range(430, 671, 10):
            number = wavelength - 400
            farther = max(amounts[number], flat[number], key=lambda p: float(np.abs(p).sum()))
            axes.plot(*_seen([np.zeros(3), farther]).T, color="#b5b5b5", linewidth=0.6, zorder=2)
        _draw_coloured(axes, _seen(amounts), colours, 1.3)
        _draw_coloured(axes, _seen(flat), colours, 2.6)
        axes.plot([], [], color=INK, linewidth=2.6, label="chromaticity: divided by L + M + H")
        axes.plot([], [], color=INK, linewidth=1.3, label="amounts that match unit power")
        axes.legend(loc="upper right")
        for wavelength in (480, 500, 520, 540, 560, 580, 600):
            at = _seen(flat[wavelength - 400])
            axes.plot(*at, marker="o", markersize=3, color=INK, zorder=5)
            # Outside of the curve, which turns to the left below 510 nm.
            left = wavelength < 510
            axes.annotate(
                f"{wavelength}",
                tuple(at),
                (-6, 2) if left else (7, 1),
                textcoords="offset points",
                ha="right" if left else "left",
                va="center",
                fontsize=7.5,
                zorder=6,
            )
    return figure


def _draw_space(axes: Axes, names: Sequence[str]) -> None:
    """The three axes and the part of the plane between them."""
    import numpy as np
    from matplotlib.patches import Polygon

    corners = _seen(np.eye(3))
    axes.add_patch(
        Polygon(corners, closed=True, facecolor="#f1f1f1", edgecolor=GREY, linewidth=1.0, zorder=1)
    )
    for axis, name, place in zip(np.eye(3), names, ((0, -11), (0, 6), (0, -11)), strict=True):
        tip = _seen(1.75 * axis)
        arrow = {"arrowstyle": "->", "color": GREY, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", tuple(tip), tuple(_seen(np.zeros(3))), arrowprops=arrow, zorder=1.5)
        axes.annotate(name, tuple(tip), place, textcoords="offset points", ha="center", va="center")
        axes.plot(*_seen(axis), marker="o", markersize=4, color=GREY, zorder=4)
        axes.update_datalim([tuple(tip)])
    axes.autoscale_view()


def _draw_coloured(
    axes: Axes, points: NDArray[np.float64], colours: NDArray[np.float64], width: float
) -> None:
    """A curve whose pieces have the colours of their wavelengths."""
    import numpy as np
    from matplotlib.collections import LineCollection

    pieces = np.stack([points[:-1], points[1:]], axis=1)
    axes.add_collection(
        LineCollection(list(pieces), colors=list(colours[:-1]), linewidths=width, capstyle="round", zorder=3)
    )
