"""Figure 2.6: how wrong π r²/d² is for the solid angle of a disc (book eqs 2.2 to 2.4).

The solid angle of a disc of radius r at the distance d is ω = 2π (1 − cos arctan(r/d)); for a small one it is
approximated by its area over d². The relative error of that grows as ¾ (r/d)².
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

RATIOS = (1e-6, 1.0)


def draw(quick: bool) -> Sheet:
    """The error against r/d; dotted in grey, the leading term ¾ (r/d)²."""
    import numpy as np

    from illuminant import optics
    from illuminant.plots.style import GREY, TODAY, line_look, new_figure

    ratio = np.linspace(*RATIOS, 101)
    error = np.asarray(optics.disc_solid_angle_error(ratio))
    figure, axes = new_figure((6.4, 4.0))
    axes.plot(ratio, 100 * error, **line_look(0), label="area over distance squared (eq 2.4)")
    axes.plot(ratio, 75 * ratio**2, color=GREY, linestyle=":", label="leading term ¾ (r/d)²")
    axes.plot(RATIOS, (0.0, 0.0), **TODAY, clip_on=False, label="today: the solid angle itself")
    axes.set(
        xlabel="radius over distance, r/d",
        ylabel="relative error of the solid angle, %",
        xlim=(0, 1),
        ylim=(0, 80),
    )
    axes.grid(True)
    axes.legend()
    one_percent = float(np.interp(0.01, error, ratio))
    return Sheet(
        picture=figure,
        columns={"r/d": ratio, "relative error": error, "leading term": 0.75 * ratio**2},
        checks=(
            Check("r/d at which the error is 1 %", one_percent, at_least=0.11, at_most=0.12),
            Check("error at r/d = 1", float(error[-1]), at_least=0.7070, at_most=0.7072),
        ),
    )


PLATE = Plate(
    number="2.6",
    title="Error of the solid angle of a small source",
    shows="The solid angle of a disc, $\\omega = 2\\pi(1 - \\cos\\arctan(r/d))$ (eq 2.2), is approximated by its "
    "projected area over the squared distance, $\\pi r^2/d^2$ (eqs 2.3 and 2.4). Plotted is the relative error against "
    "the radius over the distance.",
    claim="The approximation is good to 1 % while the source is farther away than nine of its radii, and 71 % too "
    "large where the distance equals the radius.",
    today="Sources are sampled by their exact solid angle (spheres, triangles, rectangles), so no such error is made.",
    draw=draw,
    commands=("illuminant render scenes/demo.toml -o demo.png",),
)
