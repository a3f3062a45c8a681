"""Figure III.5: three ways to evaluate the incoherent distribution of facets (book eqs 2.42b and c, III.4).

D against the apparent roughness g for several slopes m: by the series (eq 2.42b), by the expression to which it
converges for rough surfaces (eq 2.42c), and as the book's D_incoherent, which takes the series up to g = 5, the other
from g = 8 on, and mixes both between.
"""

from __future__ import annotations

from typing import Any

from illuminant.atlas.plate import Check, Plate, Sheet

SLOPES = (0.1, 0.25, 0.5, 1.0)
STEEPNESS = (0.0, 1.0, 2.0)
"""tan α/m of the second panel."""


def draw(quick: bool) -> Sheet:
    """D in the mirror direction on the left; on the right both approximations over the series, in three directions."""
    import numpy as np
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from illuminant import optics
    from illuminant.plots.style import DPI, GREY, PRINTED, line_look

    g = np.unique(np.r_[np.geomspace(0.1, 100.0, 61 if quick else 121), 5.0, 8.0])

    def three(m: float, tangent: float) -> list[Any]:
        cosine = 1.0 / np.sqrt(1.0 + tangent**2)
        rough = np.full(g.size, float(optics.beckmann(cosine, m)) / 4.0)
        return [
            optics.wave_distribution(cosine, m, g),
            rough,
            optics.wave_distribution(cosine, m, g, book=True),
        ]

    figure = Figure(figsize=(9.0, 4.0), dpi=DPI, layout="constrained", facecolor="white")
    grid: Any = figure.subplots(1, 2)
    left, right = grid
    found: list[tuple[float, float, list[Any]]] = []
    for i, m in enumerate(SLOPES):
        series, rough, book = three(m, 0.0)
        found.append((m, 0.0, [series, rough, book]))
        left.plot(g, series, **line_look(i), label=f"m = {m:g}")
        left.plot(g, rough, **{**line_look(i), "linestyle": ":"})
        left.plot(g, book, **{**line_look(i), **PRINTED})
    ratios = []
    for i, steep in enumerate(STEEPNESS):
        series, rough, book = three(0.5, 0.5 * steep)
        found.append((0.5, 0.5 * steep, [series, rough, book]))
        ratios.append((rough / series, book / series))
        right.plot(g, rough / series, **{**line_look(i), "linestyle": ":"})
        right.plot(g, book / series, **{**line_look(i), **PRINTED, "linewidth": 1.6})
    for axes in grid:
        axes.axvspan(5.0, 8.0, color=GREY, alpha=0.12, linewidth=0)
        axes.set(xscale="log", xlim=(0.1, 100), xlabel="apparent roughness g")
        axes.grid(True)
    right.axhline(1.0, color=GREY, linewidth=0.8)
    left.set(title="mirror direction, α = 0", yscale="log", ylabel="D, 1/sr")
    right.set(title="relative to the series", ylim=(0.5, 1.8), ylabel="D over D of the series")
    left.legend(ncols=2, loc="lower right")
    looks: tuple[dict[str, Any], ...] = ({}, {"linestyle": ":"}, PRINTED)
    entries = [Line2D([], [], color=line_look(i)["color"]) for i in range(len(STEEPNESS))]
    right.legend(entries, ["α = 0", "tan α = m", "tan α = 2 m"], loc="upper right")
    figure.legend(
        [Line2D([], [], color=GREY, **look) for look in looks],
        [
            "series, whole (today for any g)",
            "rough surfaces, eq 2.42c",
            "the book's program (grey: its transition)",
        ],
        loc="outside lower center",
        ncols=3,
    )

    low, at_eight = g <= 5.0, int(np.searchsorted(g, 8.0))
    columns: dict[str, Any] = {
        "m": np.repeat([m for m, _, _ in found], g.size),
        "tan alpha": np.repeat([tangent for _, tangent, _ in found], g.size),
        "g": np.tile(g, len(found)),
    }
    for k, name in enumerate(("series", "rough", "book")):
        columns[f"D, {name}, 1/sr"] = np.concatenate([curves[k] for _, _, curves in found])
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check(
                "largest relative departure of the book's program up to g = 5",
                max(float(np.abs(book - 1.0)[low].max()) for _, book in ratios),
                at_most=0.005,
            ),
            Check(
                "eq 2.42c over the series at g = 8, mirror direction",
                float(ratios[0][0][at_eight]),
                at_least=0.8,
                at_most=0.9,
            ),
            Check("the same at g = 100", float(ratios[0][0][-1]), at_least=0.98, at_most=1.0),
            Check(
                "eq 2.42c over the series at g = 0.1, mirror direction", float(ratios[0][0][0]), at_least=10.0
            ),
        ),
    )


PLATE = Plate(
    number="III.5",
    title="Regimes of the incoherent distribution",
    shows="$D$ against the apparent roughness $g$ by the series of eq 2.42b, by eq 2.42c for rough surfaces and as "
    "the book's program has it: the series for $g < 5$, eq 2.42c for $g > 8$, and a mixture between. Left for four "
    "slopes in the mirror direction, right relative to the series in three directions; there the curves hold for "
    "every $m$.",
    claim="The series joins the rough expression only slowly: where the program has gone over to it, at $g = 8$, the "
    "highlight is 15 % too dim, and 1 % too dim still at $g = 100$.",
    printed="Eq 2.42c lacks the minus in its exponent; drawn with it.",
    today="The terms of the series are Poisson's weights times Beckmann distributions of the slopes $m\\sqrt{i/g}$. "
    "Summed from the largest outwards they overflow for no $g$, so no transition is needed.",
    draw=draw,
)
