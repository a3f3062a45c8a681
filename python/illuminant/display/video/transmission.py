"""An image on its way through NTSC: onto scan lines, through the composite signal, and back (book figures 5.25–5.27).

    image (h, w) → 754 samples a line → encode → decode → image (h, w)

Each row is a scan line unless `lines` says how many there shall be. Between pixels and samples stands a Lanczos filter
(three lobes, as wide as the coarser of the two, scaled so that a flat row stays flat); with 754 pixels a row nothing is
resampled. The picture's edge is held beyond it.

- `transmit`: the image that a receiver shows (figure 5.27).
- `components`: its parts in Y, in I and in Q, each as RGB; their sum is the image (figure 5.25).
- `band_limited`: any channel through a low-pass of a number of MHz (figure 5.26).

Code values are gamma-corrected RGB of the NTSC primaries, which is what the standard prescribes. `corrected` takes code
values of another display there and back (book eq 3.3).

Example:
    >>> import numpy as np
    >>> image = np.full((4, 100, 3), [0.5, 0.2, 0.2])
    >>> transmit(image)[2, 50].round(6).tolist()
    [0.5, 0.2, 0.2]
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from illuminant.color.axes import rgb_to_yiq, yiq_to_rgb
from illuminant.display.video import filters
from illuminant.display.video.composite import encode
from illuminant.display.video.decoders import decode
from illuminant.display.video.standard import ACTIVE, BANDWIDTH, Bandwidth, Levels
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.display.displays import Display

    Float64 = NDArray[np.float64]

__all__ = ["band_limited", "components", "corrected", "on_lines", "picture", "resampled", "transmit"]

LOBES = 3
"""Of the Lanczos filter between pixels and samples."""


def picture(rgb: ArrayLike, what: str = "A picture") -> Float64:
    """RGB (h, w, 3) as float64.

    Raises:
        UsageError: another shape, nothing in it, or values that are not finite.

    Example:
        >>> picture([[1.0, 0.5, 0.2]])
        Traceback (most recent call last):
        illuminant.errors.UsageError: A picture is RGB of the shape (h, w, 3), not (1, 3).
    """
    import numpy as np

    from illuminant.color.triples import floating

    array = floating(rgb).astype(np.float64)
    if array.ndim != 3 or array.shape[2] != 3:
        raise UsageError(f"{what} is RGB of the shape (h, w, 3), not {array.shape}.")
    if array.size == 0:
        raise UsageError(f"{what} of the shape {array.shape} holds no pixel.")
    bad = int((~np.isfinite(array)).any(axis=-1).sum())
    if bad:
        raise UsageError(f"{what} has {bad} pixels with values that are not finite.")
    return array


@lru_cache(maxsize=8)
def _weights(there: int, here: int) -> tuple[NDArray[np.intp], Float64]:
    """For each of `here` samples: which of `there` pixels it is made of (here, taps), and their weights."""
    import numpy as np

    scale = max(there / here, 1.0)
    centre = (np.arange(here) + 0.5) * there / here - 0.5
    reach = int(np.ceil(LOBES * scale)) + 1
    near = np.floor(centre)[:, None] + np.arange(-reach, reach + 1)
    distance = (near - centre[:, None]) / scale
    weights = np.sinc(distance) * np.sinc(distance / LOBES) * (np.abs(distance) < LOBES)
    weights /= weights.sum(axis=1, keepdims=True)
    return np.clip(near, 0, there - 1).astype(np.intp), weights


def resampled(values: ArrayLike, count: int, axis: int) -> Float64:
    """Values with another number of samples along an axis; the same number changes nothing.

    Raises:
        UsageError: the number is below 1.

    Example:
        >>> resampled([[2.0, 2.0, 2.0]], 5, axis=1).round(12).tolist()
        [[2.0, 2.0, 2.0, 2.0, 2.0]]
    """
    import numpy as np

    array = np.asarray(values, np.float64)
    if count < 1:
        raise UsageError(f"An image cannot have {count} samples on a side.")
    there = array.shape[axis]
    if there == count:
        return array.copy()
    which, weights = _weights(there, int(count))
    moved = np.moveaxis(array, axis, 0)
    total = np.zeros((count, *moved.shape[1:]))
    shape = (-1,) + (1,) * (moved.ndim - 1)
    for tap in range(which.shape[1]):
        total += weights[:, tap].reshape(shape) * moved[which[:, tap]]
    return np.moveaxis(total, 0, axis)


def on_lines(rgb: ArrayLike, lines: int | None = None) -> Float64:
    """An image on scan lines: (lines, 754, 3).

    Args:
        rgb: (h, w, 3).
        lines: how many; None: each row is one.

    Raises:
        UsageError: `rgb` is no picture, or `lines` is below 1.
    """
    array = picture(rgb)
    if lines is not None:
        array = resampled(array, lines, 0)
    return resampled(array, ACTIVE, 1)


def transmit(
    rgb: ArrayLike,
    *,
    decoder: str = "comb",
    hue_deg: float = 0.0,
    chroma: float = 1.0,
    bandwidth: Bandwidth = BANDWIDTH,
    levels: Levels | None = None,
    lines: int | None = None,
    frame: int = 0,
) -> Float64:
    """An image as it comes out of an NTSC receiver (book figure 5.27).

    Args:
        rgb: (h, w, 3), code values of the NTSC primaries from 0 to 1.
        decoder, hue_deg, chroma: as `decoders.decode`.
        bandwidth: of Y, I and Q, at both ends of the way.
        levels: of the signal; None: the standard's.
        lines: to how many scan lines the rows are resampled and back; None: each row is one.
        frame: number of the frame, which decides where dots and false colours stand.

    Returns:
        (h, w, 3), not clamped: filters overshoot at edges.

    Raises:
        UsageError: `rgb` is no picture, or an option is not usable.

    Example:
        >>> transmit([[[0.5, 0.5]]])
        Traceback (most recent call last):
        illuminant.errors.UsageError: A picture is RGB of the shape (h, w, 3), not (1, 1, 2).
    """
    array = picture(rgb)
    sent = encode(on_lines(array, lines), bandwidth=bandwidth, levels=levels, frame=frame)
    seen = decode(sent, decoder=decoder, hue_deg=hue_deg, chroma=chroma, bandwidth=bandwidth)
    height, width = array.shape[:2]
    return resampled(resampled(seen, width, 1), height, 0)


def components(rgb: ArrayLike) -> tuple[Float64, Float64, Float64]:
    """The parts of an image in Y, in I and in Q, each as RGB (h, w, 3); their sum is the image (book figure 5.25).

    The parts in I and Q have negative values: add a grey of 0.5 to see them.

    Example:
        >>> parts = components([[[0.9, 0.3, 0.1]]])
        >>> parts[0].round(4).tolist(), sum(parts).round(12).tolist()
        ([[[0.4566, 0.4566, 0.4566]]], [[[0.9, 0.3, 0.1]]])
    """
    import numpy as np

    yiq = rgb_to_yiq(picture(rgb))
    y, i, q = (np.asarray(yiq_to_rgb(yiq * np.eye(3)[axis]), np.float64) for axis in range(3))
    return y, i, q


def band_limited(values: ArrayLike, mhz: float, *, axis: int = 1) -> Float64:
    """A grey image, or any channels, as they pass a low-pass filter along scan lines (book figure 5.26).

    Args:
        values: pixels along `axis`, all of which are the seen part of a line.
        mhz: where the filter has −3 dB.
        axis: of the scan line.

    Raises:
        UsageError: the frequency is not from 0.1 to 6 MHz.

    Example:
        >>> import numpy as np
        >>> wave = np.sin(2 * np.pi * 100 * np.arange(400) / 400)[None]        # 100 cycles a line: 1.9 MHz
        >>> [round(float(np.ptp(band_limited(wave, mhz)[0, 100:300])), 1) for mhz in (4.2, 0.5)]
        [2.1, 0.0]
    """
    import numpy as np

    array = np.asarray(values, np.float64)
    line = np.moveaxis(resampled(array, ACTIVE, axis), axis, -1)
    passed = filters.filtered(line, filters.low_pass(float(mhz)), "hold")
    return resampled(np.moveaxis(passed, -1, axis), array.shape[axis], axis)


def corrected(rgb: ArrayLike, source: str | Display, target: str | Display) -> Float64:
    """Code values for one display as those for another, white to white, clamped to what it can show (book eq 3.3).

    Args:
        rgb: (..., 3).
        source, target: displays or their names; "NTSC 1953 D65" is what the signal is meant for.

    Example:
        >>> corrected([1.0, 1.0, 1.0], "sRGB", "NTSC 1953 D65").round(6).tolist()
        [1.0, 1.0, 1.0]
    """
    import numpy as np

    from illuminant.display.displays import named
    from illuminant.display.gamma.remapping import mapped

    other = named(target)
    linear = mapped(rgb, named(source), other)
    return np.asarray(np.clip(other.encode(np.clip(linear, 0.0, 1.0)), 0.0, 1.0))
