"""What is made of a picture before the page gets it: the look, false colours, marks, and two settings side by side."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from illuminant.viewer.scale import amount

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.viewer.state import State

    Codes = NDArray[np.uint8]

__all__ = ["MODES", "Composed", "compose", "difference_map", "enlarged", "false_colour", "split"]

MODES = (
    "picture",
    "luminance in false colours",
    "colours out of gamut marked",
    "illuminance in false colours",
)
MARK = (255, 0, 255)

NO_NUMBER = (72, 72, 72)
"""Of pixels of a map of illuminance that have none."""


@dataclass(frozen=True)
class Composed:
    """A picture for the page.

    Attributes:
        codes: (h, w, 3), for the browser, which takes them for sRGB.
        scale: quantities at the ends of the scale of false colours; None for a picture.
        title: of the scale: quantity and unit, and above what the lightest colour stands if something is above.
        outside: fraction of pixels that the gamut's method had to move.
    """

    codes: Codes
    scale: tuple[float, float] | None
    outside: float
    title: str = ""


def compose(
    xyz: NDArray[np.floating[Any]],
    state: State,
    mode: str = MODES[0],
    *,
    shining: NDArray[np.bool_] | None = None,
    lux: NDArray[np.floating[Any]] | None = None,
    scale: tuple[float, float] | None = None,
) -> Composed:
    """The code values of an image as a state shows it.

    Args:
        xyz: (h, w, 3), absolute.
        state: whose look and exposure count.
        mode: one of `MODES`.
        shining: (h, w), where lamps are seen: the scale of luminance is for what they light.
        lux: a map of illuminance, on a grid of its own; without one the picture stands in for it.
        scale: ends of the scale of false colours, where another picture beside this one has made them.
    """
    import numpy as np

    if mode == MODES[3] and lux is not None:
        return _scaled(lux, np.isfinite(lux), "illuminance, lx", scale)
    if mode == MODES[1]:
        counted = np.ones(xyz.shape[:2], bool) if shining is None or shining.all() else ~shining
        return _scaled(xyz[..., 1], counted, "luminance, cd/m²", scale)

    from illuminant.display.look import show

    look = replace(state.look, exposure=state.exposure, bits=8)
    shown = show(xyz, look)
    codes = np.ascontiguousarray(shown.picture.codes).astype(np.uint8)
    if mode == MODES[2]:
        linear = xyz @ np.linalg.inv(look.target.to_xyz_matrix).T * (look.exposure or 1.0)
        outside = (linear < -1e-4).any(axis=2) | (linear > 1.0 + 1e-4).any(axis=2)
        codes[outside] = MARK
    return Composed(codes, None, shown.outside)


def _scaled(
    values: NDArray[np.floating[Any]],
    counted: NDArray[np.bool_],
    title: str,
    scale: tuple[float, float] | None,
) -> Composed:
    """A map in false colours; the lightest also stands for what is above the scale, and the title says so."""
    codes, (low, high) = false_colour(values, counted, scale)
    if (values > high).any():
        title = f"{title}; lightest: > {amount(float(f'{high:.3g}'))}"
    return Composed(codes, (low, high), 0.0, title)


def false_colour(
    values: NDArray[np.floating[Any]],
    counted: NDArray[np.bool_] | None = None,
    scale: tuple[float, float] | None = None,
) -> tuple[Codes, tuple[float, float]]:
    """Numbers on a logarithmic scale of three powers of ten below their 99.5th percentile, and the scale's ends.

    Args:
        values: (h, w); nan is grey.
        counted: (h, w), those that make the scale; without it all.
        scale: its ends, if they are given.

    Example:
        >>> import numpy as np
        >>> codes, (low, high) = false_colour(np.array([[1.0, 1000.0]]))
        >>> round(high / low)
        1000
    """
    import numpy as np
    from matplotlib import colormaps

    from illuminant.plots.luminance import DECADES, ends

    low, top = scale or ends(values if counted is None else values[counted])
    place = np.log10(np.maximum(values, low) / low) / DECADES
    codes = np.array(colormaps["viridis"](np.clip(place, 0, 1), bytes=True)[..., :3])
    codes[np.isnan(values)] = NO_NUMBER
    return codes, (low, top)


def split(left: Codes, right: Codes, fraction: float) -> Codes:
    """Two pictures with a divider, left of which the first is seen; the smaller is enlarged to the other.

    Example:
        >>> import numpy as np
        >>> a, b = np.zeros((2, 10, 3), np.uint8), np.full((2, 10, 3), 200, np.uint8)
        >>> split(a, b, 0.5)[0, :, 0].tolist()
        [0, 0, 0, 0, 0, 255, 200, 200, 200, 200]
    """
    import numpy as np

    height, width = max(left.shape[0], right.shape[0]), max(left.shape[1], right.shape[1])
    first, second = enlarged(left, height, width), enlarged(right, height, width)
    column = min(max(round(fraction * width), 0), width)
    joined = np.concatenate([first[:, :column], second[:, column:]], axis=1)
    if 0 < column < width:
        joined[:, column] = 255
    return joined


def difference_map(a: NDArray[Any], b: NDArray[Any], exposure: float, kind: str) -> tuple[Codes, float]:
    """A map of ΔE00 (0 to 10) or FLIP (0 to 1) between two images of XYZ of one size, and the mean.

    Args:
        a, b: (h, w, 3), absolute.
        exposure: factor to the display's white.
        kind: `ΔE00` or `FLIP`.
    """
    import numpy as np
    from matplotlib import colormaps

    from illuminant.difference import diff
    from illuminant.image import Image

    found = diff(Image(a), Image(b), exposure=exposure)
    values, top = (found.delta_e, 10.0) if kind == "ΔE00" else (found.flip_map, 1.0)
    mean = found.mean if kind == "ΔE00" else found.flip
    place = np.clip(np.asarray(values) / top, 0, 1)
    return np.asarray(colormaps["magma"](place, bytes=True)[..., :3]), float(mean)


def enlarged(codes: Codes, height: int, width: int) -> Codes:
    """A picture of another size, by the nearest pixel."""
    import numpy as np

    if codes.shape[:2] == (height, width):
        return codes.copy()
    rows = np.arange(height) * codes.shape[0] // height
    columns = np.arange(width) * codes.shape[1] // width
    return np.asarray(codes[rows][:, columns])
