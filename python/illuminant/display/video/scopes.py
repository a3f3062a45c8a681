"""Waveform monitor and vectorscope: the composite signal as instruments show it (book 5.3, R5.61).

- The waveform monitor shows IRE on time, of one line or of all lines over each other, either the signal itself ("flat")
  or its luminance alone ("luminance", through the standard instrument's low-pass, here with a zero at the subcarrier).
- The vectorscope shows the colour as a point: U to the right, V upwards; its angle is the hue, its distance the
  saturation. The burst points to 180°. Targets are the six colours of the 75 % bars (EIA RS-189-A), and I and Q:

      yellow 167.1°  62.1     cyan 283.5°  87.7     green 240.7°  81.9      (phase; IRE peak to peak)
      magenta 60.7°  81.9     red 103.5°  87.7      blue 347.1°  62.1

Distances on the vectorscope are amplitudes in IRE, half of peak to peak.

Example:
    >>> import numpy as np
    >>> from illuminant.display.video.composite import encode
    >>> signal = encode(np.full((4, 754, 3), [0.75, 0.0, 0.0]))
    >>> point = vectors(signal, line=2)[377]
    >>> target = targets()["red"]
    >>> bool(abs(point - target).max() < 1e-9)
    True
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import TURN_DEG, rgb_to_yvu
from illuminant.display.video import filters
from illuminant.display.video.composite import BURST, Signal
from illuminant.display.video.decoders import demodulate
from illuminant.display.video.standard import ACTIVE, BANDWIDTH, FIRST_ACTIVE, SAMPLES, Bandwidth, Levels
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Float64 = NDArray[np.float64]

__all__ = ["beam", "burst_vector", "density", "hue_and_amplitude", "targets", "vectors", "waveform"]


def _chosen(signal: Signal, line: int | None) -> slice:
    """The rows of the signal that are asked for; line counts from 0."""
    count = len(signal.ire)
    if line is None:
        return slice(0, count)
    if not 0 <= line < count:
        raise UsageError(f"There is no line {line}: the picture has lines 0 to {count - 1}.")
    return slice(line, line + 1)


def waveform(
    signal: Signal, line: int | None = None, *, show: str = "flat", finer: int = 1
) -> tuple[Float64, Float64]:
    """Time and level of a signal as a waveform monitor traces them.

    Args:
        signal: see `composite.encode`.
        line: row of the picture, from 0; None: all.
        show: "flat": the whole signal, or "luminance": without its colour.
        finer: points for each sample, between which the trace is the band-limited curve through the samples.

    Returns:
        Time (n,), µs from the leading edge of sync, and level (lines, n), IRE.

    Raises:
        UsageError: no such line, or another `show`.
    """
    import numpy as np

    if show not in ("flat", "luminance"):
        raise UsageError(f"A waveform monitor shows flat or luminance, not {show!r}.")
    if not 1 <= finer <= 16:
        raise UsageError(f"{finer} points for each sample: expected 1 to 16.")
    ire = signal.ire[_chosen(signal, line)]
    if show == "luminance":
        ire = filters.filtered(ire, np.convolve(filters.low_pass(3.0), [0.5, 0.0, 0.5]), "hold")
    time = signal.time_us
    if finer > 1:
        # A line ends as it began, at blanking, so its Fourier series is the curve between the samples.
        spectrum = np.fft.rfft(ire, axis=-1)
        spectrum[..., -1] *= 0.5
        ire = np.fft.irfft(spectrum, SAMPLES * finer, axis=-1) * finer
        time = np.arange(SAMPLES * finer) * (time[1] / finer)
    return time, ire


def beam(signal: Signal, *, show: str = "flat", finer: int = 4) -> tuple[Float64, Float64]:
    """Points of all lines over each other as a beam draws them, each line looked at a little later than the one before.

    Samples stand at the same four phases of the subcarrier on all lines; moved by parts of a sample they fill the
    trace.

    Returns:
        Time and level (lines, n) of each point, µs and IRE.

    Raises:
        UsageError: as `waveform`.
    """
    import numpy as np

    time, ire = waveform(signal, show=show, finer=finer)
    # Steps of the golden ratio leave no gaps.
    late = (np.arange(len(ire)) * 0.6180339887) % 1.0
    wave = np.fft.rfftfreq(ire.shape[-1])
    spectrum = np.fft.rfft(ire, axis=-1) * np.exp(2j * np.pi * wave * late[:, None])
    return time + late[:, None] * time[1], np.fft.irfft(spectrum, ire.shape[-1], axis=-1)


def vectors(
    signal: Signal, line: int | None = None, *, hue_deg: float = 0.0, bandwidth: Bandwidth | None = None
) -> Float64:
    """U and V of the samples of a picture, as a vectorscope shows them.

    Args:
        signal: see `composite.encode`.
        line: row of the picture, from 0; None: all.
        hue_deg: by which the display is turned, counter-clockwise.
        bandwidth: of the demodulator; None: 1.3 MHz for I and for Q, so that transitions are seen.

    Returns:
        (n, 2): U and V in IRE, 754 points a line.

    Raises:
        UsageError: no such line, or it has no burst.
    """
    import numpy as np

    rows = _chosen(signal, line)
    part = Signal(signal.ire[rows], signal.lines[rows], signal.frame, signal.levels)
    band = Bandwidth(BANDWIDTH.y, BANDWIDTH.i, BANDWIDTH.i) if bandwidth is None else bandwidth
    picture = np.zeros_like(part.ire)
    seen = slice(FIRST_ACTIVE, FIRST_ACTIVE + ACTIVE)
    picture[:, seen] = part.active - part.levels.setup
    i, q = demodulate(picture, part, hue_deg=hue_deg, bandwidth=band)
    turn = np.radians(TURN_DEG)
    v = i * np.cos(turn) + q * np.sin(turn)
    u = q * np.cos(turn) - i * np.sin(turn)
    return np.stack([u[:, seen].ravel(), v[:, seen].ravel()], axis=-1)


def burst_vector(signal: Signal, line: int = 0) -> Float64:
    """U and V (2,) of the burst of a line, in IRE: (−20, 0).

    Example:
        >>> import numpy as np
        >>> from illuminant.display.video.composite import encode
        >>> (burst_vector(encode(np.zeros((1, 754, 3)))).round(6) + 0.0).tolist()
        [-20.0, 0.0]
    """
    import numpy as np

    from illuminant.display.video.composite import subcarrier

    rows = _chosen(signal, line)
    sine, cosine = subcarrier(signal.lines[rows], signal.frame)
    # The cycles in the middle, which have their full amplitude.
    middle = slice(BURST.start + 8, BURST.stop - 8)
    burst = signal.ire[rows, middle] - signal.levels.blanking
    parts = [(burst * wave[:, middle]).mean() * 2.0 for wave in (sine, cosine)]
    return np.array(parts)


def targets(part: float = 0.75, *, levels: Levels | None = None) -> dict[str, Float64]:
    """Where (2,) bars of a part of full level fall on a vectorscope, U and V in IRE, and the burst.

    Raises:
        UsageError: the part is not above 0 and up to 1.
    """
    import numpy as np

    from illuminant.display.patterns.color_bars import BARS

    if not 0.0 < part <= 1.0:
        raise UsageError(f"Bars of {part:g} of full level: expected above 0, up to 1.")
    found = Levels() if levels is None else levels
    places = {}
    for name, rgb in BARS.items():
        if name != "white":
            _, v, u = rgb_to_yvu(np.array(rgb) * part) * found.range
            places[name] = np.array([u, v])
    places["burst"] = np.array([-found.burst, 0.0])
    return places


def hue_and_amplitude(point: Float64) -> tuple[float, float]:
    """Angle in degrees (0 to 360, from U counter-clockwise) and amplitude in IRE of a point (2,).

    Example:
        >>> [round(value, 1) for value in hue_and_amplitude(targets()["yellow"])]
        [167.1, 31.0]
    """
    import numpy as np

    return float(np.degrees(np.arctan2(point[1], point[0])) % 360.0), float(np.hypot(point[0], point[1]))


def density(
    x: Float64, y: Float64, ranges: tuple[tuple[float, float], tuple[float, float]], size: tuple[int, int]
) -> Float64:
    """How many points fall on each cell (height, width) of a screen, y upwards, as a beam would light it.

    Args:
        x, y: points of one shape.
        ranges: of x and of y.
        size: width and height of the screen.
    """
    import numpy as np

    counts, _, _ = np.histogram2d(
        np.ravel(y), np.ravel(x), bins=(size[1], size[0]), range=(ranges[1], ranges[0])
    )
    return counts[::-1]
