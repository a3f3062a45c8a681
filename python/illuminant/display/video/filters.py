"""Filters of a scan line: low-pass, chroma and notch, all of linear phase, at four times the subcarrier.

- `low_pass(mhz)`: a sinc in a Kaiser window (Kaiser 1974, β = 3.4: 40 dB), scaled to 1 at 0. Its cut-off is moved until
  the response is −3 dB (0.7071) at the frequency named, as a bandwidth is meant. The band of transition is 1.2 times
  as wide as that frequency, and at most 1 MHz.
- `chroma_pass(mhz)`: the same, times (z + 1/z)/2 · (z + 2 + 1/z)/4, which makes exact zeros at the subcarrier and at
  twice the subcarrier. A flat luminance thus gives no colour at all, and the product of twice the frequency that a
  demodulator makes is gone altogether.
- `i_pass(mhz)`: −1.9 dB at that frequency. The factor above alone takes more at 1.3 MHz, so here three terms of the
  window, at 0, at the subcarrier and at twice of it, are added to a sinc (β = 4), which make the response 1, 0 and 0.
- `chroma_band(mhz)`: `chroma_pass` moved to the subcarrier: 2 cos(π n/2) h(n), exactly 0 at 0 and 1 at the
  subcarrier.

    of the standard     taps   −3 dB    −6 dB    −20 dB   below −40 dB from
    Y  low_pass(4.2)      33   4.20     4.35     4.68     4.85 MHz
    I  i_pass(1.3)        37   1.38     1.52     1.84     2.02 MHz
    Q  chroma_pass(0.5)   59   0.50     0.59     0.79     0.89 MHz

I and Q keep within the limits of the FCC (47 CFR 73.682): I is 1.9 dB down at 1.3 MHz, where less than 2 are asked, and
83 dB at 3.6 MHz, at least 20; Q is 1.0 dB down at 0.4 MHz (less than 2), 3.0 at 0.5 (less than 6), 6.5 at 0.6 (at least
6).

A filter has an odd number of taps and is symmetric, so nothing moves along the line; beyond its reach of half its
taps, a flat line comes back unchanged.

Example:
    >>> taps = low_pass(4.2)
    >>> [round(float(abs(response(taps, mhz))), 4) for mhz in (0.0, 4.2)]
    [1.0, 0.7071]
    >>> abs(float(response(chroma_pass(1.3), SAMPLE_MHZ / 4))) < 1e-15
    True
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from illuminant.display.video.standard import SAMPLE_MHZ
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["chroma_band", "chroma_pass", "filtered", "i_pass", "low_pass", "response"]

KAISER_BETA = 3.4
"""Of the window: about 40 dB between what passes and what does not."""

I_GAIN = 10.0 ** (-1.9 / 20.0)
"""Of I at the end of its band, where the FCC allows less than 2 dB."""

I_BETA = 4.0
"""Of the window of I."""


def _windowed(cutoff_mhz: float, reach: int) -> Float64:
    import numpy as np

    n = np.arange(-reach, reach + 1)
    taps = np.sinc(2.0 * cutoff_mhz / SAMPLE_MHZ * n) * np.kaiser(2 * reach + 1, KAISER_BETA)
    return np.asarray(taps / taps.sum())


def _zeros() -> Float64:
    """Taps with zeros at the subcarrier and at twice of it."""
    import numpy as np

    return np.convolve([0.5, 0.0, 0.5], [0.25, 0.5, 0.25])


def _designed(mhz: float, factor: Float64) -> Float64:
    """The windowed sinc times a factor that has −3 dB at a frequency."""
    import numpy as np

    if not 0.1 <= mhz <= 6.0:
        raise UsageError(f"A filter of a scan line cannot end at {mhz:g} MHz: expected 0.1 to 6.")
    transition_mhz = min(1.0, 1.2 * mhz)
    # Kaiser's length for 40 dB: (40 − 7.95) / 14.36 = 2.23 samples of the inverse of the transition.
    reach = int(np.ceil(2.23 * SAMPLE_MHZ / transition_mhz / 2.0))
    low, high = 0.01, SAMPLE_MHZ / 2.0
    for _ in range(60):
        middle = (low + high) / 2.0
        if float(response(np.convolve(_windowed(middle, reach), factor), mhz)) < np.sqrt(0.5):
            low = middle
        else:
            high = middle
    taps = np.convolve(_windowed(high, reach), factor)
    taps.flags.writeable = False
    return np.asarray(taps)


@cache
def low_pass(mhz: float) -> Float64:
    """Taps of a low-pass filter with −3 dB at a frequency, 0.1 to 6 MHz.

    Raises:
        UsageError: the frequency lies outside that range.
    """
    import numpy as np

    return _designed(float(mhz), np.ones(1))


@cache
def chroma_pass(mhz: float) -> Float64:
    """Taps of a low-pass filter that also takes out the subcarrier and twice the subcarrier altogether.

    Args:
        mhz: where it has −3 dB, 0.1 to 1.4 MHz, so that it ends well before the subcarrier.

    Raises:
        UsageError: the frequency lies outside that range.
    """
    _check_colour(mhz)
    return _designed(float(mhz), _zeros())


@cache
def i_pass(mhz: float) -> Float64:
    """Taps of the filter of I: as `chroma_pass`, but no more than 1.9 dB down at its frequency, 0.1 to 1.4 MHz.

    Raises:
        UsageError: the frequency lies outside that range.
    """
    import numpy as np

    _check_colour(mhz)
    reach = int(np.ceil(2.23 * SAMPLE_MHZ / min(1.0, 1.2 * mhz) / 2.0)) + 2
    n = np.arange(-reach, reach + 1)
    window = np.kaiser(2 * reach + 1, I_BETA)
    # cos 2π f n at 0, at the subcarrier and at twice of it, where the gain shall be 1, 0 and 0.
    waves = np.array([np.ones(len(n)), np.array([1.0, 0.0, -1.0, 0.0])[n % 4], 1.0 - 2.0 * (n % 2)])
    low, high = 0.01, 3.0
    taps = window
    for _ in range(60):
        middle = (low + high) / 2.0
        taps = np.sinc(2.0 * middle / SAMPLE_MHZ * n) * window * 2.0 * middle / SAMPLE_MHZ
        short = np.array([1.0, 0.0, 0.0]) - waves @ taps
        taps = taps + np.linalg.solve(waves * window @ waves.T, short) @ waves * window
        if float(response(taps, mhz)) < I_GAIN:
            low = middle
        else:
            high = middle
    taps.flags.writeable = False
    return np.asarray(taps)


def _check_colour(mhz: float) -> None:
    if not 0.1 <= mhz <= 1.4:
        raise UsageError(
            f"Colour with {mhz:g} MHz does not fit about its subcarrier: expected 0.1 to 1.4 MHz."
        )


@cache
def chroma_band(mhz: float) -> Float64:
    """Taps of the band-pass filter about the subcarrier, with −3 dB at `mhz` to both sides of it."""
    import numpy as np

    taps = chroma_pass(mhz)
    n = np.arange(len(taps)) - len(taps) // 2
    moved = 2.0 * np.round(np.cos(np.pi * n / 2.0)) * taps
    moved.flags.writeable = False
    return np.asarray(moved)


def response(taps: ArrayLike, mhz: ArrayLike) -> Float64:
    """The factor (real, as the phase is linear) by which a filter changes a wave of a frequency.

    Args:
        taps: odd in number and symmetric.
        mhz: frequencies of any shape.

    Example:
        >>> response([0.25, 0.5, 0.25], [0.0, 3.5795454545]).round(6).tolist()
        [1.0, 0.5]
    """
    import numpy as np

    h = np.asarray(taps, np.float64)
    n = np.arange(len(h)) - len(h) // 2
    angle = 2.0 * np.pi * np.asarray(mhz, np.float64)[..., None] / SAMPLE_MHZ * n
    return np.asarray(np.cos(angle) @ h)


def filtered(lines: ArrayLike, taps: ArrayLike, edge: str = "zero") -> Float64:
    """Each line (..., n) through a filter; as many samples come back.

    Args:
        lines: samples along the last axis.
        taps: odd in number.
        edge: what lies beyond a line: "zero", as in blanking, or "hold": its first and last sample.

    Example:
        >>> filtered([0.0, 0.0, 4.0, 0.0, 0.0], [0.25, 0.5, 0.25]).tolist()
        [0.0, 1.0, 2.0, 1.0, 0.0]
    """
    import numpy as np

    x = np.asarray(lines, np.float64)
    h = np.asarray(taps, np.float64)
    reach, n = len(h) // 2, x.shape[-1]
    padded = np.pad(
        x, [(0, 0)] * (x.ndim - 1) + [(reach, reach)], mode="edge" if edge == "hold" else "constant"
    )
    # Symmetric taps: two samples share a product.
    total = h[reach] * padded[..., reach : reach + n]
    for k in range(reach):
        if h[k] != 0.0:
            total += h[k] * (padded[..., k : k + n] + padded[..., 2 * reach - k : 2 * reach - k + n])
    return np.asarray(total)
