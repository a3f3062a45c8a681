"""The picture of figure 5.7, and its numbers: correction before storage beside correction at display."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from illuminant.display.gamma.banding import COLOUR, gradation, shaded_sphere
from illuminant.display.gamma.lookup_table import correction_table, top_code
from illuminant.display.gamma.response import Curve
from illuminant.display.gamma.storage import WAYS, at_display, before_storage, store_corrected, store_linear
from illuminant.errors import UsageError
from illuminant.plots.style import DPI, GREY, line_look, styled

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["sheet", "staircase", "tile"]


def tile(linear: NDArray[np.float64], way: str, bits: int, gamma: Curve = 2.2) -> NDArray[np.uint8]:
    """The 8-bit code values that reach a monitor of an image stored one way.

    Args:
        linear: (h, w, 3) linear RGB, 0 to 1.
        way: "before storage" or "at display".
        bits: of the file, and of the table at display; 8 or fewer.
        gamma: γ of the monitor, or the name of a curve.

    Raises:
        UsageError: there is no such way, or more bits than a picture of 8 bits holds.
    """
    import numpy as np

    if way not in WAYS:
        raise UsageError(f'There is no way "{way}": expected {" or ".join(WAYS)}.')
    if top_code(bits) > 255:
        raise UsageError(f"The picture has 8 bits, and cannot show a file of {bits}.")
    if way == WAYS[0]:
        codes = store_corrected(linear, bits, gamma)
    else:
        codes = correction_table(gamma, bits, bits)(store_linear(linear, bits))
    return np.asarray((codes.astype(np.float64) * (255.0 / top_code(bits)) + 0.5).astype(np.uint8))


def sheet(
    bits: Sequence[int] = (8, 6),
    *,
    size: int = 300,
    colour: Sequence[float] = COLOUR,
    gamma: Curve = 2.2,
) -> Figure:
    """Shaded spheres over a low-intensity ramp: a column for each way of storage, a row for each number of bits.

    The pixels of the tiles are the codes that reach a monitor of that gamma, unscaled: a PNG of this figure, saved with
    its own resolution, is to be looked at pixel by pixel on such a monitor.

    Args:
        bits: of the files, 8 or fewer.
        size: pixels along the side of a tile.
        colour: linear RGB of the surface.
        gamma: γ of the monitor, or the name of a curve.

    Raises:
        UsageError: an argument is not possible.

    Example:
        >>> (sheet((8, 6), size=100).get_size_inches() * 200).round().tolist()
        [224.0, 284.0]
    """
    import numpy as np
    from matplotlib.figure import Figure

    if not bits:
        raise UsageError("A comparison needs at least one number of bits.")
    ramp_height = max(size // 6, 2)
    low = np.linspace(0.0, 0.1, size)[None, :, None] * np.asarray(colour, np.float64)
    image = np.concatenate([shaded_sphere(size, colour), np.repeat(low, ramp_height, axis=0)])
    height = image.shape[0]
    gap, head = 8, 22
    width, depth = 2 * size + 3 * gap, len(bits) * (height + head) + gap
    with styled():
        figure = Figure(figsize=(width / DPI, depth / DPI), dpi=DPI, facecolor="white")
        for row, bit in enumerate(bits):
            bottom = depth - (row + 1) * (height + head)
            for column, way in enumerate(WAYS):
                left = gap + column * (size + gap)
                figure.figimage(tile(image, way, bit, gamma), left, bottom, origin="upper")
                figure.text(
                    left / DPI / (width / DPI),
                    (bottom + height + 6) / depth,
                    f"corrected {way}, {bit} bits",
                    fontsize=min(5.5, size / 50.0),
                )
    return figure


def staircase(
    bits: Sequence[int] = (8, 6), *, colour: Sequence[float] = COLOUR, gamma: Curve = 2.2, top: float = 0.05
) -> Figure:
    """Lightness over intensity in the darkest part of a gradation: the steps of both ways (figure 5.7 in numbers).

    Args:
        bits: of the files; a panel for each.
        colour: linear RGB of the surface.
        gamma: γ of the monitor, or the name of a curve.
        top: up to which share of the surface's colour.

    Example:
        >>> [axes.get_title(loc="left") for axes in staircase((8, 10)).axes]
        ['8 bits', '10 bits']
    """
    import numpy as np
    from matplotlib.figure import Figure

    from illuminant import color

    if not bits:
        raise UsageError("A comparison needs at least one number of bits.")
    smooth = gradation(colour, 4096, top=top)
    share = np.linspace(0.0, 1.0, len(smooth)) ** 2.4 * top
    white = color.white_xyz(color.system("book NTSC").white)

    def lightness(linear: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(color.xyz_to_lab(color.rgb_to_xyz(linear, "book NTSC"), white)[..., 0])

    with styled():
        figure = Figure(figsize=(4.2 * len(bits), 3.7), dpi=DPI, layout="constrained", facecolor="white")
        grid: Any = figure.subplots(1, len(bits), squeeze=False, sharey=True)
        for axes, bit in zip(grid[0], bits, strict=True):
            ways = (before_storage(smooth, bit, gamma), at_display(smooth, bit, gamma))
            for number, (way, linear) in enumerate(zip(WAYS, ways, strict=True)):
                axes.plot(100.0 * share, lightness(linear), label=f"corrected {way}", **line_look(number))
            axes.plot(
                100.0 * share, lightness(smooth), color=GREY, linewidth=0.8, linestyle="--", label="ideal"
            )
            axes.set_xlabel("intensity (% of the surface's colour)")
            axes.set_title(f"{bit} bits")
            axes.set_xlim(0.0, 100.0 * top)
            axes.set_ylim(bottom=0.0)
            axes.grid(True)
        grid[0][0].set_ylabel("L* shown")
        grid[0][-1].legend(loc="lower right")
    return figure
