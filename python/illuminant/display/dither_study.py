"""What each dither does to a picture, in numbers: grain, banding, and errors of the mean (book 5.1.4, figure 5.12).

Two test images lie around the middle of the codes, grey in three channels, and errors are in codes:

- *fields*: 24 flat fields of 256 × 256 pixels between two neighbouring codes, at parts of the step that favour no tile
  (multiples of the golden section);
- a *gradation* that rises by a code in 512 columns, over two codes (one at 1 bit), 256 rows high.

| measure | what it is |
| --- | --- |
| grain | root mean square of the noise, code − mean code, over the fields |
| low | part of its power below 1/8 of the sampling frequency, relative to white noise: 1 if white, 0 if none |
| visible | root mean square of the noise of lightness after weighting by contrast sensitivity |
| step | largest step of the local mean on the gradation; 0.98 where whole codes follow one another |
| step, L* | the same on an sRGB display |
| mean | largest error of the mean of a field |

A step is that between the mean of the 8 columns before a column and that of the 8 from it on, less the gradation's own
rise. Power spectra are periodograms under a Hann window, the mean taken away; for `spectrum` they are averaged over
rings and divided by the power of white noise with the variance of a perfect dither between two codes, f (1 − f) (the
radially averaged power spectrum of Ulichney 1987).

`visible` weights spatial frequencies f (cycles/degree) by Mannos and Sakrison's sensitivity (1974),

    A(f) = 2.6 (0.0192 + 0.114 f) exp(−(0.114 f)^1.1),

at 42 pixels a degree unless told otherwise: pixels of 0.25 mm seen from 60 cm. Lightness is the sum of the channels'
errors by the luminances of sRGB's primaries; where channels have patterns of their own (shifted tiles, random numbers)
they cancel in part.

`random` leaves noise of its own in `step` (0.05) and `mean` (a few thousandths).

References: J. L. Mannos and D. J. Sakrison, The effects of a visual fidelity criterion on the encoding of images, IEEE
Transactions on Information Theory 20, 1974; R. Ulichney, Digital Halftoning, MIT Press, 1987.

Example:
    >>> from illuminant.display import dither_study
    >>> found = dither_study.study(["none", "ordered-2", "blue-noise"])
    >>> round(found["none"].step, 2), round(found["ordered-2"].step, 2)
    (0.98, 0.23)
    >>> found["blue-noise"].low < 0.1
    True
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from illuminant.display import dither, patterning
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = [
    "BANDS",
    "PIXELS_PER_DEGREE",
    "Measures",
    "comparison",
    "contrast_sensitivity",
    "measure",
    "spectrum",
    "study",
]

BANDS = ("none", "floyd-steinberg", "ordered-2", "ordered-4", "dot-diffusion-4")
"""The bands of figure 5.12, from the top."""

PIXELS_PER_DEGREE = 42.0
"""Of pixels of 0.25 mm from 60 cm."""

LOW = 1 / 8
"""Below this part of the sampling frequency, noise counts as low."""

_SIDE = 256
_MARGIN = 32  # error diffusion takes some rows to find its rhythm
_FIELDS = 24
_COLUMNS = 512  # of a code of the gradation
_WINDOW = 8
_LUMINANCE = (0.2126, 0.7152, 0.0722)


@dataclass(frozen=True)
class Measures:
    """What a dither does; see the table of the module. Codes unless said otherwise.

    Attributes:
        grain: root mean square of the noise on flat fields.
        low: its power at low frequencies, relative to white noise; NaN where there is no noise.
        visible: root mean square of what is seen of the noise on grey fields.
        step: largest step of the local mean.
        step_lightness: the same as L*.
        mean: largest error of the mean of a field.
    """

    grain: float
    low: float
    visible: float
    step: float
    step_lightness: float
    mean: float

    def to_dict(self) -> dict[str, float]:
        """The measures by name."""
        return asdict(self)


def contrast_sensitivity(cycles_per_degree: Array | float) -> Array:
    """The eye's relative sensitivity to a grating (Mannos and Sakrison 1974), 1 near 8 cycles a degree.

    Example:
        >>> [round(float(contrast_sensitivity(f)), 2) for f in (0.0, 8.0, 30.0)]
        [0.05, 0.98, 0.19]
    """
    import numpy as np

    scaled = 0.114 * np.asarray(cycles_per_degree, np.float64)
    return np.asarray(2.6 * (0.0192 + scaled) * np.exp(-(scaled**1.1)))


def _frequencies(height: int, width: int) -> Array:
    """Cycles a pixel of each place of a spectrum, in any direction."""
    import numpy as np

    return np.asarray(np.hypot(np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width)[None, :]))


def _power(error: Array) -> Array:
    """The periodogram of an error (h, w), without its mean: its mean is the variance."""
    import numpy as np

    height, width = error.shape
    window = np.hanning(height)[:, None] * np.hanning(width)[None, :]
    centred = (error - (error * window).sum() / window.sum()) * window
    return np.asarray(np.abs(np.fft.fft2(centred)) ** 2 / (window**2).sum())


def _base(bits: int, codes: int) -> int:
    """The lowest of `codes` + 1 neighbouring codes around the middle."""
    return ((1 << bits) - 1 - codes) // 2


def _field(name: str, bits: int, number: int, part: float) -> Array:
    """Code − value of a flat field, in codes, (h, w, 3), without its margin."""
    import numpy as np

    base, top = _base(bits, 1), (1 << bits) - 1
    values = np.full((_SIDE + 2 * _MARGIN, _SIDE + 2 * _MARGIN, 3), (base + part) / top)
    codes = patterning.codes(values, bits, name, seed=number)[_MARGIN:-_MARGIN, _MARGIN:-_MARGIN]
    return np.asarray(codes.astype(np.float64) - (base + part))


def _parts() -> list[float]:
    golden = (math.sqrt(5) - 1) / 2
    return [(number + 0.5) * golden % 1.0 for number in range(_FIELDS)]


def spectrum(name: str, bits: int = 8, part: float | None = None) -> tuple[Array, Array]:
    """The radially averaged power spectrum of a dither's noise on flat fields.

    Args:
        name: a dither, or `pattern-WxH`.
        bits: of the codes, 1 to 16.
        part: of the way from one code to the next at which the field lies, above 0 and below 1; the average over 24
            fields unless given.

    Returns:
        Frequencies in cycles a pixel, 0 to √½, and the power at each; 1 is that of white noise, as it has the best
        possible variance between two codes.

    Raises:
        UsageError: there is no such dither, or a number is not possible.
    """
    import numpy as np

    _check(name, bits)
    if part is not None and not 0.0 < part < 1.0:
        raise UsageError(f"A field lies between two codes, above 0 and below 1, not at {part:g}.")
    parts = _parts() if part is None else [part]
    fields = (_field(name, bits, number, one)[..., 0] for number, one in enumerate(parts))
    power = np.mean([_power(field) for field in fields], axis=0)
    ring = np.rint(_frequencies(_SIDE, _SIDE) * _SIDE).astype(int)
    inside = ring > 0
    count = np.bincount(ring[inside])[1:]
    total = np.bincount(ring[inside], power[inside])[1:]
    white = float(np.mean([one * (1.0 - one) for one in parts]))
    return np.arange(1, len(count) + 1) / _SIDE, total / count / white


def measure(name: str, bits: int = 8, pixels_per_degree: float = PIXELS_PER_DEGREE) -> Measures:
    """What a dither does at a number of bits.

    Args:
        name: a dither, or `pattern-WxH`.
        bits: of the codes, 1 to 16.
        pixels_per_degree: at the eye of the viewer.

    Raises:
        UsageError: there is no such dither, or a number is not possible.
    """
    import numpy as np

    _check(name, bits)
    if not (pixels_per_degree > 0 and math.isfinite(pixels_per_degree)):
        raise UsageError(f"Pixels a degree are a positive number, not {pixels_per_degree:g}.")
    frequency = _frequencies(_SIDE, _SIDE)
    sensitivity = contrast_sensitivity(frequency * pixels_per_degree) ** 2
    power, seen, means, noise = np.zeros_like(frequency), 0.0, [], 0.0
    for number, part in enumerate(_parts()):
        error = _field(name, bits, number, part)
        power += _power(error[..., 0]) / _FIELDS
        seen += float((_power(error @ np.array(_LUMINANCE)) * sensitivity).mean()) / _FIELDS
        means.append(abs(float(error[..., 0].mean())))
        noise += float(error[..., 0].var()) / _FIELDS
    low = frequency < LOW
    step = _step(name, bits)
    return Measures(
        grain=math.sqrt(noise),
        low=float(power[low].sum() / power.sum() / low.mean()) if noise > 0.0 else math.nan,
        visible=math.sqrt(seen) if noise > 0.0 else 0.0,
        step=step,
        step_lightness=step * _lightness_of_a_code(bits),
        mean=max(means),
    )


def _step(name: str, bits: int) -> float:
    """The largest step of the local mean on the gradation, less its own rise."""
    import numpy as np

    top = (1 << bits) - 1
    codes = min(2, top)
    wanted = _base(bits, codes) + (np.arange(_COLUMNS * codes) + 0.5) / _COLUMNS
    values = np.broadcast_to(wanted / top, (_SIDE + 2 * _MARGIN, len(wanted)))
    error = patterning.codes(values, bits, name)[_MARGIN:-_MARGIN].mean(axis=0) - wanted
    local = np.convolve(error, np.full(_WINDOW, 1.0 / _WINDOW), mode="valid")
    return float(np.abs(local[_WINDOW:] - local[:-_WINDOW]).max())


def _lightness_of_a_code(bits: int) -> float:
    """The step of L* between the two codes in the middle of an sRGB display."""
    import numpy as np

    from illuminant import color
    from illuminant.display import displays

    display, top = displays.named("sRGB"), (1 << bits) - 1
    codes = (_base(bits, 1) + np.arange(2.0)) / top
    linear = display.decode(np.repeat(codes[:, None], 3, axis=1))
    lab = color.xyz_to_lab(linear @ display.to_xyz_matrix.T, tuple(display.to_xyz_matrix.sum(axis=1)))
    return float(lab[1, 0] - lab[0, 0])


def study(
    names: Sequence[str] | None = None, bits: int = 8, pixels_per_degree: float = PIXELS_PER_DEGREE
) -> dict[str, Measures]:
    """Measures of dithers.

    Args:
        names: dithers and `pattern-WxH`; default all dithers.
        bits: of the codes, 1 to 16.
        pixels_per_degree: at the eye of the viewer.

    Raises:
        UsageError: there is no such dither, or a number is not possible.
    """
    return {name: measure(name, bits, pixels_per_degree) for name in names or dither.names()}


def comparison(
    names: Sequence[str] = BANDS,
    bits: int = 3,
    width: int = 256,
    band: int = 32,
    *,
    range_: tuple[float, float] = (0.0, 1.0),
    mean: str = "codes",
) -> NDArray[np.uint16]:
    """The bands of figure 5.12: one gradation from black to white under several dithers.

    Args:
        names: dithers and `pattern-WxH`, from the top.
        bits: of the codes, 1 to 16.
        width: of the gradation, 2 to 16,384 pixels.
        band: height of each band in pixels, 1 to 4,096.
        range_: code values at the left and the right edge, 0 to 1.
        mean: what the dither keeps: `codes`, as in the figure, or `light`, on an sRGB display.

    Returns:
        (len(names) · band, width) of codes.

    Raises:
        UsageError: there is no such dither, or a number is not possible.

    Example:
        >>> comparison(["none", "ordered-2"], bits=1, width=8, band=2).tolist()[::2]
        [[0, 0, 0, 0, 1, 1, 1, 1], [0, 0, 0, 1, 0, 1, 0, 1]]
    """
    import numpy as np

    for name in names:
        _check(name, bits)
    if not names:
        raise UsageError("A comparison needs at least one dither.")
    if not (2 <= width <= 16384 and 1 <= band <= 4096):
        raise UsageError(f"A band has 2 to 16,384 by 1 to 4,096 pixels, not {width} by {band}.")
    if not all(0.0 <= end <= 1.0 for end in range_):
        raise UsageError(
            f"A gradation lies between the code values 0 and 1, not {range_[0]:g} and {range_[1]:g}."
        )
    if mean not in ("light", "codes"):
        raise UsageError(f"A dither keeps the mean of light or of codes, not of {mean!r}.")
    values: Array = np.repeat(np.linspace(*range_, width)[None], band, axis=0)
    if mean == "light":
        values = dither.for_light(values, bits)
    return np.concatenate([patterning.codes(values, bits, name) for name in names]).astype(np.uint16)


def _check(name: str, bits: int) -> None:
    from illuminant.display.picture import check_bits

    patterning.check(name)
    check_bits(bits)
