"""How our plots look, and how they are written.

One size of type, thin grey axes without a box, and the eight colours of Okabe and Ito (2008), which people with any
colour vision can tell apart; beyond eight curves the dashes change. A figure depends on its content alone: no
matplotlibrc is heeded, and an SVG holds no date and the same identifiers every time.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output
from illuminant.errors import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "DPI",
    "FORMATS",
    "GREY",
    "PRINTED",
    "TODAY",
    "check_format",
    "line_look",
    "new_figure",
    "save",
    "styled",
]

DPI = 200
"""Pixels per inch of a PNG; a figure of 8 inches is 1,600 pixels wide."""

FORMATS = (".png", ".svg")
GREY = "#555555"
INK = "#222222"

PRINTED: dict[str, Any] = {"linestyle": (0, (4, 2.5)), "linewidth": 1.1, "alpha": 0.8}
"""A curve as the book prints it where the book errs; in the colour of the right one."""

TODAY: dict[str, Any] = {"color": "#000000", "linestyle": "-", "linewidth": 2.2, "alpha": 0.55}
"""What is done today, in the axes of an older model."""

# Okabe and Ito (2008), Color universal design, in an order in which neighbours differ most; yellow, too light on
# white, gives way to a brown.
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#7A4B13")
_DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))

_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 9.0,
    "axes.labelsize": 9.0,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.7,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "text.color": INK,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.5,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "legend.handlelength": 2.4,
    "svg.hashsalt": "illuminant",
    "path.simplify": True,
}


@contextmanager
def styled() -> Iterator[None]:
    """The style of our plots, whatever the settings of the user; both drawing and writing happen inside of it."""
    import matplotlib
    import numpy as np

    # The identifiers of an SVG are made from printed numbers, and a package may have changed how NumPy prints them.
    with np.printoptions(legacy=False), matplotlib.rc_context():
        matplotlib.rcdefaults()
        parameters: Any = matplotlib.rcParams
        parameters.update(_STYLE)
        yield


def new_figure(size: tuple[float, float]) -> tuple[Figure, Axes]:
    """A figure of a size in inches with one pair of axes, which leave room for labels and legend by themselves."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, dpi=DPI, layout="constrained", facecolor="white")
    return figure, figure.add_subplot()


def line_look(number: int) -> dict[str, Any]:
    """Colour and dashes of the curve with that number, 32 different ones."""
    dashes = _DASHES[number // len(_COLOURS) % len(_DASHES)]
    return {"color": _COLOURS[number % len(_COLOURS)], "linestyle": dashes}


def check_format(path: str | os.PathLike[str]) -> Path:
    """The path, when a plot can be written there.

    Raises:
        UsageError: it does not end in .png or .svg.
        ImageError: there is no such folder, or it is one.

    Example:
        >>> check_format("plot.jpg")
        Traceback (most recent call last):
        illuminant.errors.UsageError: plot.jpg: expected a file that ends in .png or .svg.
    """
    path = Path(path)
    if path.suffix.casefold() not in FORMATS:
        raise UsageError(f"{path}: expected a file that ends in {' or '.join(FORMATS)}.")
    return output.check(path)


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure whole or not at all, as PNG or as SVG by the end of its name.

    The same figure gives the same bytes with the same matplotlib. Letters of an SVG are outlines, so that it looks the
    same wherever it is opened.

    Args:
        figure: from a function of this package, or any figure of matplotlib.
        path: a file that ends in .png or .svg.

    Raises:
        UsageError: another ending.
        ImageError, MachineError: see `illuminant.output`.
    """
    path = check_format(path)
    kind = path.suffix.casefold()[1:]
    nameless: dict[str, Any] = {"Date": None, "Creator": None} if kind == "svg" else {"Software": None}
    with styled():
        output.write(
            path, lambda temporary: figure.savefig(temporary, format=kind, dpi=figure.dpi, metadata=nameless)
        )
