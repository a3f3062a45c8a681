"""How an image is shown: every choice between absolute colour and the code values of a display (book figure 5.1).

The order is that of the ideal pipeline of figure 5.1, each step once, on unrounded numbers: exposure, colour correction
to the primaries and white of the display, tone operator, gamut, transfer function, dither, quantisation. The common
practice of the book's time, to which `pipeline="traditional"` reverts for comparison, stores linear light in 8 bits,
clamped unless another method is named, and corrects for gamma with a lookup table of 8 bits at display.

Example:
    >>> import numpy as np
    >>> from illuminant.display.look import Look, show
    >>> shown = show(np.full((1, 2, 3), 40.0), Look(exposure=0.0125))
    >>> shown.picture.codes.shape, shown.exposure
    ((1, 2, 3), 0.0125)
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.display import displays, gamut
from illuminant.display.picture import Picture, check_bits
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["PIPELINES", "Look", "Shown", "show", "tones"]

PIPELINES = ("ideal", "traditional")
"""The two columns of figure 5.1."""


def tones() -> list[str]:
    """The names of the tone operators."""
    return [str(name) for name in core().tone_operators()]


@dataclass(frozen=True)
class Look:
    """How an image is shown.

    Attributes:
        display: name of a display, or a file that describes one.
        exposure: factor from the image's unit to 1 for the display's (diffuse) white; None lets the image choose.
        transfer: response of the display in place of its own, such as `gamma 2.4`.
        tone: a tone operator of `tones()`.
        gamut: a method of `illuminant.display.gamut.methods()`; default that of the study, or `clamp`, as was the
            practice, in the traditional pipeline.
        dither: a dither of `illuminant.display.dither.names()`.
        bits: of a channel, 1 to 16.
        seed: of a random dither.
        pipeline: `ideal`, or `traditional`.

    Raises:
        UsageError: a name is not known, or a number cannot be.
    """

    display: str | displays.Display = "sRGB"
    exposure: float | None = None
    transfer: str | None = None
    tone: str = "none"
    gamut: str | None = None
    dither: str = "none"
    bits: int = 8
    seed: int = 0
    pipeline: str = "ideal"

    def __post_init__(self) -> None:
        """Refuse what cannot be, before any work; names are kept in lower case."""
        if self.gamut is None:
            object.__setattr__(
                self, "gamut", gamut.DEFAULT if self.pipeline.casefold() == "ideal" else "clamp"
            )
        for key in ("tone", "gamut", "dither", "pipeline"):
            object.__setattr__(self, key, getattr(self, key).casefold())
        check_bits(self.bits)
        if self.exposure is not None and not (self.exposure > 0 and math.isfinite(self.exposure)):
            raise UsageError(f"An exposure is a positive number, not {self.exposure:g}.")
        for what, name, known in (
            ("tone operator", self.tone, tones()),
            ("gamut method", self.method, gamut.methods()),
            ("pipeline", self.pipeline, list(PIPELINES)),
        ):
            if name not in known:
                raise UsageError(f"There is no {what} {name!r}: known are {', '.join(known)}.")
        if not 0 <= self.seed < 1 << 64:
            raise UsageError(f"The seed of a dither is from 0 to 2^64 - 1, not {self.seed}.")
        from illuminant.display import dither

        dither.check(self.dither)
        _ = self.target

    @functools.cached_property
    def target(self) -> displays.Display:
        """The display, with the response asked for."""
        found = displays.named(self.display)
        if self.transfer is None:
            return found
        return replace(found, name=f"{found.name}, {self.transfer}", response=self.transfer)

    @property
    def method(self) -> str:
        """The gamut method."""
        return self.gamut or gamut.DEFAULT

    def to_dict(self) -> dict[str, Any]:
        """What a file says of it: the choices by name."""
        word = self.display.name if isinstance(self.display, displays.Display) else str(self.display)
        found: dict[str, Any] = {
            "display": word,
            "tone": self.tone,
            "gamut": self.method,
            "dither": self.dither,
            "bits": self.bits,
            "pipeline": self.pipeline,
        }
        found |= {} if self.transfer is None else {"transfer": self.transfer}
        return found | ({"seed": self.seed} if self.dither == "random" else {})


@dataclass(frozen=True)
class Shown:
    """What `show` made.

    Attributes:
        picture: the code values.
        exposure: that was used.
        negative: fraction of pixels with a channel below 0: their chromaticity is outside the gamut.
        above: fraction of pixels that are too bright, and else inside.
        not_finite: number of pixels that are no numbers; they are black.
    """

    picture: Picture
    exposure: float
    negative: float
    above: float
    not_finite: int

    @property
    def outside(self) -> float:
        """Fraction of pixels that the gamut's method had to move."""
        return self.negative + self.above


def show(xyz: ArrayLike, look: Look | None = None, text: dict[str, str] | None = None) -> Shown:
    """Show an image of XYZ on a display.

    Args:
        xyz: (h, w, 3), float32 or float64; absolute or relative, since the exposure says what is white. Pixels that are
            NaN or infinite become black, and are counted.
        look: how; its exposure is 1 when it is None.
        text: text chunks for the file.

    Raises:
        UsageError: the array is no image, or a choice is not possible.
    """
    import numpy as np

    chosen = look or Look()
    image = np.asarray(xyz)
    if image.dtype != np.float32:
        image = image.astype(np.float64, copy=False)
    if image.ndim != 3 or image.shape[2] != 3 or image.size == 0:
        raise UsageError(f"An image is an array of shape (height, width, 3), not {image.shape}.")
    exposure = 1.0 if chosen.exposure is None else chosen.exposure
    display = chosen.target
    steps: dict[str, Any] = {
        "exposure": exposure,
        "reference": display.shown_white,
        "tone": chosen.tone,
        "gamut": chosen.method,
    }
    image = np.ascontiguousarray(image)
    if chosen.pipeline == "traditional":
        linear, met = replace(display, response="linear")._core.develop(image, **steps)
        codes = _through_table(linear, display, chosen)
    else:
        codes, met = display._core.show(
            image, bits=chosen.bits, dither=chosen.dither, seed=chosen.seed, **steps
        )
    pixels = image.shape[0] * image.shape[1]
    return Shown(
        Picture(codes, display, chosen.bits, dict(text or {})),
        exposure,
        met["negative"] / pixels,
        met["above"] / pixels,
        int(met["not_finite"]),
    )


def _through_table(linear: Array, display: displays.Display, look: Look) -> Any:
    """Codes that a frame buffer of linear light sends through its lookup table (figure 5.1, left)."""
    import numpy as np

    from illuminant.display import dither
    from illuminant.display.gamma.lookup_table import quantised, top_code

    stored = dither.quantise(linear, look.bits, look.dither, look.seed)
    top = top_code(look.bits)
    table = display.encode(np.repeat(np.arange(top + 1)[:, None] / top, 3, axis=1))
    lookup = quantised(table, look.bits, "truncate")  # as table 5.1 is
    return np.stack([lookup[stored[..., channel], channel] for channel in range(3)], axis=-1)
