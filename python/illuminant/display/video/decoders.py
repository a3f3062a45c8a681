"""Decoders: from the composite signal back to RGB lines (book 5.2, figure 5.13).

    C      what the decoder takes for colour                    Y = signal − C
    V, U   = 2 C cos(ωt + φ), 2 C sin(ωt + φ), low-passed      φ from the burst, turned by the hue control
    RGB    = M⁻¹ (Y, c I, c Q)                                  c: the chroma control

Luminance and colour share one band, so they can be told apart only by guess:

- "notch": colour is all that lies about the subcarrier (±1.3 MHz); luminance is what a notch of ±0.6 MHz leaves.
- "low-pass": the same colour; luminance is what lies below 3 MHz, as in simple receivers.
- "comb": the subcarrier turns over from line to line of a field, and a picture seldom does: colour is the difference of
  a line from the mean of its neighbours, above 1.4 MHz; luminance is the rest and keeps its 4.2 MHz.

What is taken for the wrong one is seen: fine luminance as false colour (cross-colour), and the edges of colour as dots
(cross-luminance); with the comb, at edges between lines only.

Example:
    >>> import numpy as np
    >>> from illuminant.display.video.composite import encode
    >>> back = decode(encode(np.full((6, 754, 3), [0.2, 0.6, 0.4])))
    >>> back[3, 377].round(9).tolist()
    [0.2, 0.6, 0.4]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.color.axes import TURN_DEG, yiq_to_rgb
from illuminant.display.video import filters
from illuminant.display.video.composite import BURST, Signal, subcarrier
from illuminant.display.video.standard import ACTIVE, BANDWIDTH, FIRST_ACTIVE, Bandwidth
from illuminant.errors import UsageError, suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Float64 = NDArray[np.float64]

__all__ = ["DECODERS", "burst_phase_deg", "decode", "demodulate", "separate"]

DECODERS = ("comb", "notch", "low-pass")

NOTCH_MHZ = 0.6
"""To both sides of the subcarrier, −3 dB."""

PLAIN_MHZ = 3.0
"""Where luminance ends in the decoder "low-pass", −3 dB."""

COMB_MHZ = 1.4
"""Below this (−3 dB) all is luminance, whatever the neighbours of a line hold."""


def burst_phase_deg(signal: Signal) -> Float64:
    """Phase (lines,) of the burst against the subcarrier it should have: 180 on a vectorscope.

    Raises:
        UsageError: a line has no burst.
    """
    import numpy as np

    sine, cosine = subcarrier(signal.lines, signal.frame)
    burst = signal.ire[:, BURST] - signal.levels.blanking
    u = (burst * sine[:, BURST]).sum(axis=1)
    v = (burst * cosine[:, BURST]).sum(axis=1)
    if (np.hypot(u, v) < 0.1 * signal.levels.burst * (BURST.stop - BURST.start) / 2.0).any():
        raise UsageError("A line has no burst, so its colours have no reference.")
    return np.asarray(np.degrees(np.arctan2(v, u)) % 360.0)


def separate(signal: Signal, decoder: str = "comb") -> tuple[Float64, Float64]:
    """Luminance and colour (lines, 910) of a signal, in parts of its range from black to white.

    Sync and burst are gated out: beside the picture both are black.

    Args:
        signal: rows in the order of the picture, so that every other line belongs to the same field.
        decoder: "comb", "notch" or "low-pass".

    Raises:
        UsageError: no such decoder.
    """
    import numpy as np

    if decoder not in DECODERS:
        hint = suggestion(decoder, DECODERS)
        raise UsageError(
            f"There is no decoder {decoder!r}: expected comb, notch or low-pass{f' ({hint})' if hint else ''}."
        )
    picture = np.zeros_like(signal.ire)
    seen = slice(FIRST_ACTIVE, FIRST_ACTIVE + ACTIVE)
    picture[:, seen] = (signal.active - signal.levels.setup) / signal.levels.range
    if decoder == "comb" and len(picture) > 2:
        differs = _comb(picture)
        colour = differs - filters.filtered(differs, filters.chroma_pass(COMB_MHZ))
        return picture - colour, colour
    if decoder == "low-pass":
        return filters.filtered(picture, _plain()), picture
    return picture - filters.filtered(picture, filters.chroma_band(NOTCH_MHZ)), picture


def _plain() -> Float64:
    """Low-pass with a zero at the subcarrier, so that flat colours leave no dots."""
    import numpy as np

    return np.convolve(filters.low_pass(PLAIN_MHZ), [0.5, 0.0, 0.5])


def _comb(lines: Float64) -> Float64:
    """Half the difference of each line from the mean of its neighbours in its field; at an end, from the one it has."""
    import numpy as np

    colour = np.empty_like(lines)
    for first in (0, 1):
        field = lines[first::2]
        if len(field) == 1:  # no neighbour in its field: all that is left is the band
            colour[first::2] = field
            continue
        above = np.concatenate([field[1:2], field[:-1]])
        below = np.concatenate([field[1:], field[-2:-1]])
        colour[first::2] = (2.0 * field - above - below) / 4.0
    return colour


def demodulate(
    colour: Float64, signal: Signal, *, hue_deg: float = 0.0, bandwidth: Bandwidth = BANDWIDTH
) -> tuple[Float64, Float64]:
    """I and Q (lines, 910) of the colour on the subcarrier.

    Args:
        colour: (lines, 910), from `separate`.
        signal: gives the phase of each line by its burst.
        hue_deg: turns all colours counter-clockwise on a vectorscope.
        bandwidth: of I and Q.
    """
    import numpy as np

    sine, cosine = subcarrier(signal.lines, signal.frame)
    turn = np.radians(hue_deg + 180.0 - burst_phase_deg(signal))[:, None]
    # The colour stands on its own phase; these are the references for V and U, turned by what the burst says.
    v = 2.0 * colour * (cosine * np.cos(turn) + sine * np.sin(turn))
    u = 2.0 * colour * (sine * np.cos(turn) - cosine * np.sin(turn))
    axes = np.radians(TURN_DEG)
    i = filters.filtered(v * np.cos(axes) - u * np.sin(axes), filters.i_pass(bandwidth.i))
    q = filters.filtered(v * np.sin(axes) + u * np.cos(axes), filters.chroma_pass(bandwidth.q))
    return i, q


def decode(
    signal: Signal,
    *,
    decoder: str = "comb",
    hue_deg: float = 0.0,
    chroma: float = 1.0,
    bandwidth: Bandwidth = BANDWIDTH,
    matrix: str = "standard",
) -> Float64:
    """RGB lines of a composite signal.

    Args:
        signal: see `composite.encode`.
        decoder: "comb", "notch" or "low-pass".
        hue_deg: the hue control: turns all colours, counter-clockwise on a vectorscope.
        chroma: the chroma control: 0 is black and white, 1 is right.
        bandwidth: of I and Q after demodulation; Y ends where it ended at the encoder.
        matrix: of the encoder.

    Returns:
        Code values (lines, 754, 3), not clamped.

    Raises:
        UsageError: no such decoder, a hue that is not finite, a chroma below 0, or a signal without burst.
    """
    import numpy as np

    if not np.isfinite(hue_deg):
        raise UsageError("The hue control needs an angle in degrees.")
    if not 0.0 <= chroma <= 10.0:
        raise UsageError(f"A chroma control of {chroma:g} is not usable: expected 0 to 10, where 1 is right.")
    y, colour = separate(signal, decoder)
    i, q = demodulate(colour, signal, hue_deg=hue_deg, bandwidth=bandwidth)
    seen = slice(FIRST_ACTIVE, FIRST_ACTIVE + ACTIVE)
    yiq = np.stack([y[:, seen], chroma * i[:, seen], chroma * q[:, seen]], axis=-1)
    return np.asarray(yiq_to_rgb(yiq, matrix=matrix), np.float64)
