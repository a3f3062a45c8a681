"""Distributions of facets against each other, and their coefficients (book figures 4.13, 4.14, 4.20)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant import optics
from illuminant.errors import UsageError
from illuminant.plots.style import GREY, TODAY, line_look, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["NAMES", "coefficients", "distribution", "distributions"]

NAMES = {
    "phong": "Phong",
    "blinn": "Blinn, cosine power",
    "gaussian": "Gaussian",
    "trowbridge-reitz": "Trowbridge and Reitz",
    "cook": "Beckmann (Cook and Torrance)",
    "ggx": "today: GGX",
}
"""The distributions by name, and what the plots call them."""

LARGEST_BETA_DEG = {"phong": 44.9}
"""Beyond 45° Phong's lobe, which is seen at twice β from the mirror direction, never falls to half; 89.9° of others."""

CELL = (3.0, 1.95)
"""Width and height of one polar plot, in inches."""

BOX = 2.2
"""Diameter of its circle."""

BELOW = 0.32
"""What its labels take below it."""

LEGEND = 0.35

GGX = TODAY | {
    "linestyle": (0, (0.1, 4.0)),
    "linewidth": 1.5,
    "dash_capstyle": "round",
    "alpha": 1.0,
    "zorder": 3,
}
"""Dots on top: by itself GGX is the function of Trowbridge and Reitz, and either line would hide the other."""


def distribution(
    name: str, beta_deg: float, theta_deg: float, view_deg: NDArray[np.float64]
) -> NDArray[np.float64]:
    """A distribution in the plane of incidence, relative to its value in the mirror direction.

    Args:
        name: a key of `NAMES`.
        beta_deg: angle between N and H at which it has fallen to half, above 0 and below 90, or 45 for Phong's.
        theta_deg: angle of incidence, 0 to 90.
        view_deg: angles of view from the normal, -90 to 90; the mirror direction is at `theta_deg`.

    Returns:
        As many values, 1 at the mirror direction.

    Example:
        The view at twice β from the mirror direction has H at β.
        >>> import numpy as np
        >>> distribution("gaussian", 10.0, 30.0, np.array([30.0, 50.0])).round(6).tolist()
        [1.0, 0.5]
    """
    import numpy as np

    if name not in NAMES:
        raise UsageError(f'There is no distribution "{name}": known are {", ".join(NAMES)}.')
    largest = LARGEST_BETA_DEG.get(name, 89.9)
    if not 0.0 < beta_deg <= largest:
        raise UsageError(f"β lies above 0 and below {largest + 0.1:.0f} degrees; found {beta_deg:g}.")
    away = np.radians(np.asarray(view_deg, float) - theta_deg)
    # Phong's lobe is one of R·V, the others are of N·H.
    cosine = np.cos(away if name == "phong" else away / 2.0)
    if name == "ggx":
        alpha = optics.ggx_alpha(np.radians(beta_deg))
        return np.asarray(optics.ggx(cosine.clip(0.0, 1.0), alpha) / optics.ggx(1.0, alpha), float)
    coefficient = optics.lobe_coefficient(name, np.radians(beta_deg))
    values = optics.lobe_value(name, cosine.clip(0.0, 1.0), coefficient)
    return np.asarray(values / optics.lobe_value(name, 1.0, coefficient), float)


def distributions(
    beta_deg: Sequence[float] = (10.0, 30.0),
    theta_deg: Sequence[float] = (30.0, 60.0, 80.0),
    names: Sequence[str] = ("phong", "blinn", "gaussian", "trowbridge-reitz"),
) -> Figure:
    """Distributions in polar plots, a row for each β and a column for each angle of incidence (book figure 4.13).

    With `names=("blinn", "cook")` and θ of 30° and 80° it is book figure 4.20: for m below 0.6 the two are much alike.

    Args:
        beta_deg: half-widths, above 0 and below 90, or 45 with Phong's.
        theta_deg: angles of incidence, 0 to 90.
        names: keys of `NAMES`.

    Example:
        >>> len(distributions(beta_deg=(10,), theta_deg=(30, 60)).axes)
        2
    """
    import numpy as np
    from matplotlib.figure import Figure

    view = np.linspace(-90.0, 90.0, 1441)
    with styled():
        width, height = CELL[0] * len(theta_deg), CELL[1] * len(beta_deg) + LEGEND
        figure = Figure(figsize=(width, height), dpi=200, facecolor="white")
        lines: list[Any] = []
        for row, beta in enumerate(beta_deg):
            for column, theta in enumerate(theta_deg):
                # Half of the square box of polar axes is empty: a quarter above the half circle, one below it.
                left = CELL[0] * column + (CELL[0] - BOX) / 2.0
                bottom = height - CELL[1] * (row + 1) + BELOW - BOX / 4.0
                place = (left / width, bottom / height, BOX / width, BOX / height)
                axes: Any = figure.add_axes(place, projection="polar")
                axes.set_theta_zero_location("N")
                axes.set_theta_direction(-1)
                axes.set_thetalim(-np.pi / 2, np.pi / 2)
                axes.set_rlim(0.0, 1.05)
                axes.set_rticks([0.5, 1.0])
                axes.set_thetagrids([-90, -60, -30, 0, 30, 60, 90])
                axes.grid(True)
                axes.set_title(f"β = {beta:g}°, θ = {theta:g}°", x=-0.08, y=0.89, pad=0)
                axes.plot(np.radians([-theta, -theta]), [0.0, 1.0], color=GREY, linewidth=0.8, zorder=1.2)
                lines = [
                    axes.plot(
                        np.radians(view),
                        distribution(name, beta, theta, view),
                        **(GGX if name == "ggx" else line_look(i)),
                    )[0]
                    for i, name in enumerate(names)
                ]
        figure.legend(lines, [NAMES[name] for name in names], loc="lower center", ncols=min(5, len(names)))
    return figure


def coefficients(today: bool = False) -> Figure:
    """Coefficients of distributions that fall to half at the angle β (book eqs 4.19 and 4.25, figure 4.14).

    Args:
        today: with the α of GGX.

    Example:
        >>> [axes.get_xlabel() for axes in coefficients().axes]
        ['β (degrees)', 'β (degrees)']
    """
    import numpy as np
    from matplotlib.figure import Figure

    beta = np.linspace(1.0, 90.0, 357)[:-1]
    half = beta[beta < 45.0]
    with styled():
        figure = Figure(figsize=(8.0, 3.6), dpi=200, layout="constrained", facecolor="white")
        left, right = figure.subplots(1, 2)
        rows = (
            (left, half, "phong", "Phong $N_s$", optics.lobe_coefficient("phong", np.radians(half))),
            (left, beta, "blinn", "Blinn $N_s$", optics.lobe_coefficient("blinn", np.radians(beta))),
            (right, beta, "gaussian", "$C_1$", optics.lobe_coefficient("gaussian", np.radians(beta))),
            (
                right,
                beta,
                "trowbridge-reitz",
                "$C_2$",
                np.sqrt(optics.lobe_coefficient("trowbridge-reitz", np.radians(beta))),
            ),
            (right, beta, "cook", "$m$", np.sqrt(optics.lobe_coefficient("cook", np.radians(beta)))),
        )
        for number, (axes, at, _, label, values) in enumerate(rows):
            axes.plot(at, values, label=label, **line_look(number))
        if today:
            right.plot(beta, optics.ggx_alpha(np.radians(beta)), label="today: α of GGX", **GGX)
        left.set_yscale("log")
        left.set_ylim(0.05, 3000.0)
        right.set_ylim(0.0, 5.0)
        for axes, what in ((left, "exponent"), (right, "coefficient")):
            axes.set_xlim(0.0, 90.0)
            axes.set_xticks(range(0, 91, 15))
            axes.set_xlabel("β (degrees)")
            axes.set_ylabel(what)
            axes.grid(True)
            axes.legend()
    return figure
