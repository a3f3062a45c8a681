"""Dithers in pictures: bands of a gradation (book figure 5.12), patterns of cells (figure 5.11), spectra of noise."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError
from illuminant.plots.style import DPI, GREY, INK, line_look, new_figure, save, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure, SubFigure
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]

__all__ = ["draw_patterns", "labelled", "patterns", "save_patterns", "save_spectra", "spectra"]

_MOST_PATTERNS = 64


def labelled(parts: Sequence[Bytes], labels: Sequence[str], *, columns: int = 1, gap: int = 2) -> Bytes:
    """Pictures in rows and columns, unscaled, each under its label (with one column: each beside it).

    Args:
        parts: (h, w, 3) of 8 bits, all of one shape.
        labels: one for each.
        columns: how many stand in a row.
        gap: pixels between them.

    Returns:
        (h, w, 3), black on white, the pixels of the parts as they were.
    """
    import numpy as np

    height, width = parts[0].shape[:2]
    names = [_text(label) for label in labels]
    tallest, widest = (max(name.shape[axis] for name in names) for axis in (0, 1))
    # What is beside the first pixel of a part: its label, to the left or above.
    left, above = (widest + 8, 0) if columns == 1 else (0, tallest + 4)
    cell = (
        above + max(height, tallest if columns == 1 else 0) + gap,
        left + max(width, 0 if left else widest) + gap,
    )
    rows = -(-len(parts) // columns)
    sheet = np.full((rows * cell[0] + gap, columns * cell[1] + gap, 3), 255, np.uint8)
    for number, (part, name) in enumerate(zip(parts, names, strict=True)):
        y, x = gap + number // columns * cell[0], gap + number % columns * cell[1]
        at = y + max(0, (height - name.shape[0]) // 2) if columns == 1 else y
        sheet[at : at + name.shape[0], x : x + name.shape[1]] = name
        sheet[y + above : y + above + height, x + left : x + left + width] = part
    return sheet


def _text(label: str) -> Bytes:
    """A word in pixels, cut out where it is not white."""
    import numpy as np
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with styled():
        figure = Figure(figsize=(4.0, 0.24), dpi=100, facecolor="white")
        figure.text(0.005, 0.3, label, fontsize=8.5, color=INK)
        canvas: Any = FigureCanvasAgg(figure)
        canvas.draw()
        drawn = np.asarray(canvas.buffer_rgba())[..., :3]
    columns = np.flatnonzero((drawn < 255).any(axis=(0, 2)))
    return np.array(drawn[:, : int(columns[-1]) + 2] if len(columns) else drawn[:, :1])


def patterns(cells: Sequence[str] | None = None) -> Figure:
    """The patterns of cells at one bit, each twice in both directions beside its neighbours (figure 5.11).

    Args:
        cells: `WxH`; default those of the book, 2x2, 2x3 and 3x3.

    Raises:
        UsageError: there is no such cell, or it has more than 64 patterns.

    Example:
        >>> len(patterns(["2x2"]).axes)
        5
    """
    from matplotlib.figure import Figure

    from illuminant.display import patterning

    chosen = list(cells or patterning.CELLS)
    for cell in chosen:
        if patterning.levels(cell) > _MOST_PATTERNS:
            raise UsageError(
                f"A figure shows up to {_MOST_PATTERNS} patterns of a cell, and {cell} has more."
            )
    most = max(patterning.levels(cell) for cell in chosen)
    with styled():
        size = (max(0.72 * most, 3.0), 1.15 * len(chosen))
        figure = Figure(figsize=size, dpi=DPI, layout="constrained", facecolor="white")
        draw_patterns(figure, chosen)
    return figure


def draw_patterns(figure: Figure | SubFigure, cells: Sequence[str]) -> None:
    """The same in a figure, or a part of one: a row for each cell."""
    from matplotlib.patches import Rectangle

    from illuminant.display import patterning

    most = max(patterning.levels(cell) for cell in cells)
    grid: Any = figure.subplots(len(cells), most, squeeze=False)
    for row, cell in zip(grid, cells, strict=True):
        width, height = patterning.sides(cell)
        every = patterning.patterns(cell)
        for level, axes in enumerate(row):
            if level >= len(every):
                axes.remove()
                continue
            axes.imshow(1 - every[level], cmap="gray_r", vmin=0, vmax=1, extent=(0, width, height, 0))
            for x in range(width):
                for y in range(height):
                    axes.add_patch(Rectangle((x, y), 1, 1, fill=False, edgecolor=GREY, linewidth=0.6))
            axes.set_xlim(0, width)
            axes.set_ylim(height, 0)
            axes.set_axis_off()
            axes.set_title(f"{level}/{len(every) - 1}", fontsize=7.5, loc="center", pad=3.0)
        row[0].text(
            -0.35,
            0.5,
            cell.replace("x", " × "),
            transform=row[0].transAxes,
            ha="right",
            va="center",
            fontsize=9,
        )


def save_patterns(cells: Sequence[str] | None, path: str | os.PathLike[str]) -> None:
    """Draw the patterns of cells into a file (figure 5.11).

    Raises:
        UsageError: as `patterns`, or the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    save(patterns(cells), path)


def spectra(names: Sequence[str], bits: int = 8, part: float | None = None) -> Figure:
    """Radially averaged power spectra of the noise of dithers, 1 for white noise.

    Args:
        names: dithers, and `pattern-WxH`.
        bits: of the codes.
        part: where between two codes the field lies; the average over many unless given.

    Raises:
        UsageError: there is no such dither, or a number is not possible.

    Example:
        >>> spectra(["random", "blue-noise"]).axes[0].get_yscale()
        'log'
    """
    import numpy as np

    from illuminant.display import dither_study

    if not names:
        raise UsageError("Spectra are drawn of at least one dither.")
    found = [(name, *dither_study.spectrum(name, bits, part)) for name in names]
    floor = 1e-3
    with styled():
        figure, axes = new_figure((8.0, 4.6))
        axes.axvspan(0.0, dither_study.LOW, color="#f1f1f1", linewidth=0)
        axes.axvline(0.5, color=GREY, linewidth=0.6, linestyle=":")
        for number, (name, frequency, power) in enumerate(found):
            axes.plot(frequency, np.maximum(power, floor / 10), label=name, **line_look(number))
        axes.set_yscale("log")
        axes.set_ylim(floor, 100.0)
        axes.set_xlim(0.0, float(np.sqrt(0.5)))
        axes.set_xlabel("cycles per pixel, in any direction")
        axes.set_ylabel("power, 1 = white noise")
        where = "the mean of 24 flat fields" if part is None else f"a field at {part:g} of a code"
        axes.set_title(f"Noise of dithers at {bits} bits, {where}")
        axes.grid(True)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return figure


def save_spectra(
    names: Sequence[str], path: str | os.PathLike[str], bits: int = 8, part: float | None = None
) -> None:
    """Draw the spectra of dithers into a file.

    Raises:
        UsageError: as `spectra`, or the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    save(spectra(names, bits, part), path)
