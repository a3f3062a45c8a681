"""Curves of gamma: response and correction of a monitor, a fitted response, perceived brightness (book 5.1.2)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from illuminant.display.gamma.brightness import BLACK, brightness, equal_steps, lightness, resemblance
from illuminant.display.gamma.lookup_table import correction_table
from illuminant.display.gamma.response import Curve, correction, curve_name, response
from illuminant.plots.style import DPI, GREY, line_look, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from illuminant.display.gamma.fitting import GammaFit
    from illuminant.display.gamma.readings import Measured

__all__ = ["fitted", "perceived", "response_and_correction"]


def _pair(width: float = 8.0, height: float = 3.9) -> tuple[Figure, Any]:
    """A figure with two axes side by side."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=DPI, layout="constrained", facecolor="white")
    return figure, figure.subplots(1, 2)


def response_and_correction(curve: Curve = 2.2, bits: int = 6) -> Figure:
    """Response of a monitor, and the lookup table that corrects it (book figures 5.3 and 5.4).

    The right half also shows the composition of the two, which is the identity for the curves and, for the table of
    whole numbers, a staircase about it.

    Args:
        curve: γ of the monitor, or the name of a curve.
        bits: of the table, in and out; with 6 the staircase can be seen.

    Example:
        >>> [axes.get_xlabel() for axes in response_and_correction(2.2).axes]
        ['code value to the monitor', 'relative intensity in the image']
    """
    import numpy as np

    at = np.linspace(0.0, 1.0, 513)
    table = correction_table(curve, bits, bits)
    with styled():
        figure, (left, right) = _pair()
        left.plot(at, response(at, curve), label=f"response, {curve_name(curve)}", **line_look(0))
        left.plot(at, at, color=GREY, linewidth=0.8, linestyle="--", label="linear device")
        left.set_xlabel("code value to the monitor")
        left.set_ylabel("relative intensity on the monitor")
        left.set_title("Monitor response")
        right.plot(at, correction(at, curve), label="correction", **line_look(1))
        shown = response(table.outputs, curve)
        right.step(
            table.inputs,
            shown,
            where="mid",
            label=f"after the monitor, {bits}-bit table",
            color=line_look(2)["color"],
            linewidth=1.1,
        )
        right.plot(
            at,
            response(correction(at, curve), curve),
            color="black",
            linewidth=0.8,
            linestyle="--",
            label="after the monitor, exact",
        )
        right.set_xlabel("relative intensity in the image")
        right.set_ylabel("code value, or intensity shown")
        right.set_title("Correction, and the two together")
        for axes in (left, right):
            axes.set_xlim(0.0, 1.0)
            axes.set_ylim(0.0, 1.0)
            axes.set_aspect("equal")
            axes.grid(True)
        left.legend(loc="upper left")
        right.legend(loc="lower right")
    return figure


def fitted(readings: Mapping[str, Measured], fits: Mapping[str, GammaFit]) -> Figure:
    """Readings and the responses fitted to them, on logarithmic axes, with the residuals beside.

    Args:
        readings: columns by name.
        fits: the fit of each.

    Example:
        >>> from illuminant.display.gamma.fitting import fit_gamma
        >>> from illuminant.display.gamma.readings import Measured
        >>> read = Measured([51, 102, 153, 204, 255], [2.9, 13.3, 32.5, 61.2, 100.0])
        >>> figure = fitted({"grey": read}, {"grey": fit_gamma(*read)})
        >>> figure.axes[1].get_ylabel()
        'reading against fit (%)'
    """
    import numpy as np
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    with styled():
        figure, (left, right) = _pair(8.6, 4.0)
        for number, (name, fit) in enumerate(fits.items()):
            code, read = (np.asarray(column, np.float64) for column in readings[name])
            look = line_look(number)
            at = np.geomspace(0.6 * code[code > 0].min(), code.max(), 400)
            curve = fit.luminance(at)
            lit = curve > 0
            label = f"{name}: γ {fit.gamma:.3f} ± {fit.gamma_error:.3f}"
            left.plot(at[lit], curve[lit], label=label, linewidth=1.2, **look)
            for used, filled in ((fit.used, look["color"]), (~fit.used, "white")):
                visible = used & (read > 0) & (code > 0)
                marks: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 4.5}
                marks |= {"color": look["color"], "markerfacecolor": filled}
                left.plot(code[visible], read[visible], **marks)
                right.plot(code[used], 100.0 * fit.residuals[used], **marks)
        left.set_xscale("log")
        left.set_yscale("log")
        left.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        left.xaxis.set_major_formatter(FormatStrFormatter("%g"))
        left.xaxis.set_minor_formatter(NullFormatter())
        left.set_xlabel("code value")
        left.set_ylabel("luminance (cd/m²)")
        left.set_title("Readings and fit; open marks lie below the cutoff")
        right.axhline(0.0, color=GREY, linewidth=0.8)
        right.set_xlabel("code value")
        right.set_ylabel("reading against fit (%)")
        right.set_title("Residuals")
        spread = max(float(np.nanmax(np.abs(fit.residuals[fit.used]))) for fit in fits.values())
        limit = min(100.0, 100.0 * max(1.3 * spread, 0.01))
        right.set_ylim(-limit, limit)
        for axes in (left, right):
            axes.grid(True)
        left.legend(loc="upper left")
    return figure


def perceived(black: float = BLACK, curve: Curve = 2.2, steps: int = 16) -> Figure:
    """Perceived brightness over intensity, and its inverse beside the monitor's response (book figure 5.6).

    Args:
        black: luminance of black as a share of white's.
        curve: γ of the monitor, or the name of a curve.
        steps: equal steps of brightness that are marked.

    Example:
        >>> perceived(0.01).axes[0].get_ylabel()
        'perceived brightness, black 0 to white 1'
    """
    import numpy as np

    at = np.concatenate([[0.0], np.geomspace(1e-5, 1.0, 800)])
    even = np.linspace(0.0, 1.0, 401)
    alike = resemblance(curve, black)
    with styled():
        figure, (left, right) = _pair(8.0, 4.1)
        left.plot(at, brightness(at, black), label=f"logarithmic, black {black:g} of white", **line_look(0))
        left.plot(at, lightness(at, black), label="L* / 100 (CIE 1976)", **line_look(1))
        marks = equal_steps(steps, black)
        left.plot(
            marks,
            brightness(marks, black),
            linestyle="none",
            marker="o",
            markersize=3.5,
            color=line_look(0)["color"],
            label=f"{steps} steps of equal ΔI/I",
        )
        left.set_xlabel("relative intensity")
        left.set_ylabel("perceived brightness, black 0 to white 1")
        left.set_title("Brightness of intensities")
        right.plot(even, response(even, curve), label=f"monitor, {curve_name(curve)}", **line_look(2))
        right.plot(brightness(at, black), at, label="equal steps of ΔI/I", **line_look(0))
        right.plot(lightness(at, black), at, label="equal steps of L*", **line_look(1))
        right.set_xlabel("code value, or perceived brightness")
        right.set_ylabel("relative intensity")
        right.set_title(f"Inverse, and a monitor (r = {alike.response:.3f} with ΔI/I)")
        for axes in (left, right):
            axes.set_xlim(0.0, 1.0)
            axes.set_ylim(0.0, 1.0)
            axes.set_aspect("equal")
            axes.grid(True)
        left.legend(loc="lower right")
        right.legend(loc="upper left")
    return figure
