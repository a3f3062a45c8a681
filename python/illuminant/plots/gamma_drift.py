"""The ColorChecker through corrections of a wrong gamma: traces of chromaticity, difference, contrast (figure 5.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.plots.diagram import diagram
from illuminant.plots.style import DPI, GREY, INK, line_look, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from illuminant.display.gamma.drift import Drift

__all__ = ["drift"]


def drift(found: Drift, *, labels: bool = True) -> Figure:
    """Traces of the 24 colours in the xy diagram; difference and contrast over the gamma of correction beside them.

    The black point of a trace is where the colour belongs. Marks grow with the gamma of correction.

    Args:
        found: from `illuminant.display.gamma.drift.study`.
        labels: name the colours that move far.

    Example:
        >>> from illuminant.display.gamma.drift import study
        >>> [axes.get_ylabel() for axes in drift(study([1.8, 2.2, 2.6])).axes]
        ['y', 'ΔE00', "contrast γ/γ'"]
    """
    import numpy as np
    from matplotlib.figure import Figure
    from matplotlib.patheffects import Normal, Stroke

    from illuminant import color

    order = np.argsort(found.gammas)
    gammas, xy = found.gammas[order], found.xy[order]
    right_xyz = found.xyz[int(np.argmin(np.abs(found.gammas - found.monitor_gamma)))]
    look = np.asarray(color.xyz_to_rgb(right_xyz, "sRGB", encoded=True)).clip(0.0, 1.0)
    monitor = found.display
    with styled():
        figure = Figure(figsize=(9.4, 5.6), dpi=DPI, layout="constrained", facecolor="white")
        grid: Any = figure.add_gridspec(2, 2, width_ratios=(1.9, 1.0))
        axes = figure.add_subplot(grid[:, 0])
        _, locus = diagram("xy").spectral_locus()
        axes.plot(*np.concatenate([locus, locus[:1]]).T, color=GREY, linewidth=0.8)
        triangle = np.array([*monitor.primaries, monitor.primaries[0]])
        axes.plot(*triangle.T, color=INK, linewidth=1.0, label=monitor.name)
        edge = [Stroke(linewidth=3.4, foreground="#999999"), Normal()]
        for patch, name in enumerate(found.names):
            trace = xy[:, patch]
            axes.plot(*trace.T, color=look[patch], linewidth=2.4, path_effects=edge, zorder=3)
            sizes = np.linspace(3.0, 22.0, len(gammas))
            axes.scatter(
                trace[:, 0], trace[:, 1], s=sizes, color=look[patch], edgecolors=INK, linewidths=0.4, zorder=4
            )
            home = right_xyz[patch, :2] / right_xyz[patch].sum()
            axes.plot(*home, marker="o", markersize=4.0, color="black", zorder=5)
            if labels and np.linalg.norm(trace[0] - trace[-1]) > 0.12:
                # Above the middle of a trace that ends near the rim, beside the end of an upright one.
                level = abs(trace[0, 0] - trace[-1, 0]) > abs(trace[0, 1] - trace[-1, 1])
                axes.annotate(
                    name,
                    trace.mean(axis=0) if level else trace[0],
                    xytext=(0, 6) if level else (4, 3),
                    textcoords="offset points",
                    fontsize=7.0,
                    zorder=6,
                    path_effects=[Stroke(linewidth=2.0, foreground="white"), Normal()],
                )
        axes.plot(*monitor.white, marker="+", markersize=10, color=INK, zorder=5, label="white")
        axes.set_xlim(0.0, 0.8)
        axes.set_ylim(0.0, 0.9)
        axes.set_aspect("equal")
        axes.set_xlabel("x")
        axes.set_ylabel("y")
        axes.grid(True)
        axes.set_title(
            f"ColorChecker on a monitor of γ {found.monitor_gamma:g},\n"
            f"corrected for γ' {gammas[0]:g} (small marks) to {gammas[-1]:g} (large)"
        )
        axes.legend(loc="upper right")
        upper, lower = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
        upper.plot(gammas, found.difference[order].max(axis=1), label="largest", **line_look(1))
        upper.plot(gammas, found.difference[order].mean(axis=1), label="mean", **line_look(0))
        upper.set_ylabel("ΔE00")
        upper.set_ylim(bottom=0.0)
        upper.set_title("Difference")
        upper.legend(loc="upper right")
        lower.plot(gammas, found.contrast[order], marker="o", markersize=3.5, **line_look(2))
        lower.set_ylabel("contrast γ/γ'")
        lower.set_title("Contrast")
        lower.set_xlabel("γ' of the correction")
        for beside in (upper, lower):
            beside.axvline(found.monitor_gamma, color=GREY, linewidth=0.8, linestyle="--")
            beside.grid(True)
    return figure
