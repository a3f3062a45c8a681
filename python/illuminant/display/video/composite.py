"""The composite signal: from RGB lines to IRE (book 5.2, figure 5.13).

    Y, I, Q = M RGB                  band-limited to 4.2, 1.3 and 0.5 MHz
    C(t)    = I cos(ωt + 33°) + Q sin(ωt + 33°) = V cos ωt + U sin ωt
    signal  = setup + (100 − setup) (Y + C)       within the seen part of a line
    burst   = −20 sin ωt                          nine cycles on the back porch, the receiver's reference

ω is the subcarrier's, 3.579545 MHz; four samples make a cycle. M is the standard's own ("standard" of
`illuminant.color.axes`), of which the book's eq 5.2 is a rounding. Sync, porches and burst of each line are modelled
with edges of 140 ns (sin²); a line begins with the leading edge of its sync. In front of the picture and behind it
the RGB signal is black, so colour at the sides of a picture is filtered against black, as it is in an encoder.

The code values are taken as they are: they are gamma-corrected RGB of the NTSC primaries. The band is that of a studio:
the upper side band of I is not cut off at 4.2 MHz, as it is on the air.

Sources: book 5.2, 5.3; FCC 1953 (47 CFR 73.682); EIA RS-170A (1977, a tentative standard); SMPTE 170M (2004).

Example:
    >>> import numpy as np
    >>> signal = encode(np.ones((2, ACTIVE, 3)))
    >>> signal.ire.shape, round(float(signal.active[0, 377]), 9), float(signal.ire.min())
    ((2, 910), 100.0, -40.0)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from illuminant.color.axes import TURN_DEG, rgb_to_yiq
from illuminant.display.video import filters
from illuminant.display.video.standard import (
    ACTIVE,
    BANDWIDTH,
    FIRST_ACTIVE,
    SAMPLE_MHZ,
    SAMPLES,
    Bandwidth,
    Levels,
    Raster,
)
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["BURST", "Signal", "band_limited_yiq", "chroma", "encode", "subcarrier"]

BURST = slice(76, 112)
"""Samples of the nine cycles of the burst: 19 cycles after the leading edge of sync."""

_SYNC_SAMPLES = 67
# sin² over two samples: 10 % to 90 % in 140 ns.
_EDGE = (0.146447, 0.5, 0.853553)
_RASTER = Raster(blanked=20)


@dataclass(frozen=True)
class Signal:
    """Whole lines of a composite signal.

    Attributes:
        ire: (lines, 910), in IRE.
        lines: (lines,), the number of each line in its frame, from 1.
        frame: number of the frame: the subcarrier is turned over in every other one.
        levels: of black, white, sync and burst.
    """

    ire: Float64
    lines: NDArray[np.int64]
    frame: int = 0
    levels: Levels = field(default_factory=Levels)

    @property
    def active(self) -> Float64:
        """The seen part (lines, 754) of each line."""
        return self.ire[:, FIRST_ACTIVE : FIRST_ACTIVE + ACTIVE]

    @property
    def time_us(self) -> Float64:
        """Time (910,) of the samples of a line, from the leading edge of sync."""
        import numpy as np

        return np.arange(SAMPLES) / SAMPLE_MHZ


def subcarrier(lines: ArrayLike, frame: int = 0) -> tuple[Float64, Float64]:
    """sin ωt and cos ωt (lines, 910) of lines of a frame; each is −1, 0 or 1.

    Example:
        >>> sine, cosine = subcarrier([1, 2])
        >>> sine[:, :4].tolist(), bool((cosine[0] == -cosine[1]).all())
        ([[0.0, 1.0, 0.0, -1.0], [0.0, -1.0, 0.0, 1.0]], True)
    """
    import numpy as np

    numbers = np.asarray(lines, np.int64)
    # A frame has half a cycle over, so two of them are the period: numbers of any size stay small.
    start = (int(frame) % 2 * _RASTER.lines + numbers - 1) * SAMPLES
    quarter = (start[:, None] + np.arange(SAMPLES)) % 4
    return np.array([0.0, 1.0, 0.0, -1.0])[quarter], np.array([1.0, 0.0, -1.0, 0.0])[quarter]


def chroma(i: Float64, q: Float64, sine: Float64, cosine: Float64) -> Float64:
    """I and Q on the subcarrier."""
    import numpy as np

    turn = np.radians(TURN_DEG)
    v = i * np.cos(turn) + q * np.sin(turn)
    u = q * np.cos(turn) - i * np.sin(turn)
    return np.asarray(v * cosine + u * sine)


def band_limited_yiq(
    rgb: ArrayLike, bandwidth: Bandwidth = BANDWIDTH, *, edge: str = "zero", matrix: str = "standard"
) -> Float64:
    """Y, I, Q (lines, 754, 3) of RGB lines, each within its band.

    Args:
        rgb: (lines, 754, 3).
        bandwidth: of Y, I and Q.
        edge: what is taken to lie beside the picture: "zero" (black), or "hold": the colour of its edge.
        matrix: as `rgb_to_yiq`.

    Raises:
        UsageError: another shape.
    """
    import numpy as np

    from illuminant.color.triples import floating

    colours = floating(rgb).astype(np.float64)
    if colours.ndim != 3 or colours.shape[1:] != (ACTIVE, 3) or len(colours) == 0:
        raise UsageError(
            f"A signal is made of lines of {ACTIVE} samples, (lines, {ACTIVE}, 3), not of the shape {colours.shape}; "
            "transmit takes images of any width."
        )
    if not np.isfinite(colours).all():
        raise UsageError("A signal cannot be made of colours that are not finite.")
    y, i, q = np.moveaxis(rgb_to_yiq(colours, matrix=matrix), -1, 0)
    return np.stack(
        [
            filters.filtered(y, filters.low_pass(bandwidth.y), edge),
            filters.filtered(i, filters.i_pass(bandwidth.i), edge),
            filters.filtered(q, filters.chroma_pass(bandwidth.q), edge),
        ],
        axis=-1,
    )


def encode(
    rgb: ArrayLike,
    *,
    bandwidth: Bandwidth = BANDWIDTH,
    levels: Levels | None = None,
    frame: int = 0,
    matrix: str = "standard",
    first_row: int = 0,
) -> Signal:
    """The composite signal of RGB lines.

    Args:
        rgb: (lines, 754, 3), code values from 0 to 1; rows 0, 2, 4 … are the first field, see `Raster.line_number`.
        bandwidth: of Y, I and Q before they are joined.
        levels: of black, white, sync and burst; None: those of the standard.
        frame: number of the frame.
        matrix: from RGB to Y I Q, as `rgb_to_yiq`.
        first_row: row of the frame that the first line is.

    Returns:
        Whole lines with sync and burst.

    Raises:
        UsageError: another shape, or values that are not finite.
    """
    import numpy as np

    levels = Levels() if levels is None else levels
    yiq = band_limited_yiq(rgb, bandwidth, matrix=matrix)
    lines = np.array([_RASTER.line_number(first_row + row) for row in range(len(yiq))], np.int64)
    sine, cosine = subcarrier(lines, frame)
    seen = slice(FIRST_ACTIVE, FIRST_ACTIVE + ACTIVE)
    ire = np.tile(_blanking(levels), (len(lines), 1))
    ire[:, BURST] -= levels.burst * _burst_envelope() * sine[:, BURST]
    colour = chroma(yiq[..., 1], yiq[..., 2], sine[:, seen], cosine[:, seen])
    ire[:, seen] = levels.setup + levels.range * (yiq[..., 0] + colour)
    return Signal(ire, lines, frame, levels)


def _blanking(levels: Levels) -> Float64:
    """A line (910,) with its sync and nothing else."""
    import numpy as np

    line = np.full(SAMPLES, levels.blanking)
    line[:_SYNC_SAMPLES] = levels.sync
    depth = levels.sync - levels.blanking
    line[[-1, 0, 1]] = levels.blanking + depth * np.array(_EDGE)
    line[_SYNC_SAMPLES - 1 : _SYNC_SAMPLES + 2] = levels.blanking + depth * np.array(_EDGE[::-1])
    return line


def _burst_envelope() -> Float64:
    """Of the nine cycles (36,): the first and the last cycle rise and fall."""
    import numpy as np

    envelope = np.ones(BURST.stop - BURST.start)
    rise = np.sin(np.pi / 2.0 * np.arange(1, 4) / 4.0) ** 2
    envelope[:3], envelope[-3:] = rise, rise[::-1]
    return envelope
