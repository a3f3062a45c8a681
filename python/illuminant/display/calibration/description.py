"""The fitted display as others use it: a `Display`, a TOML file, an ICC profile.

A `Display` has one chromaticity for white and black, so the tint of black is lost: black keeps its luminance. All else
of the fit is kept: primaries and white are those that the guns add, the response of each channel is
`gain-offset-gamma`, the peak is white with black in it.

Example:
    >>> import numpy as np
    >>> from illuminant.display.calibration.fit import Characterisation
    >>> rows = np.array([[40.0, 20.0, 2.0], [35.0, 70.0, 12.0], [18.0, 8.0, 95.0]])
    >>> model = Characterisation(rows, np.zeros(3), np.ones(3), np.array([2.2, 2.2, 2.3]))
    >>> to_display(model, "left").response[2]
    'gain-offset-gamma 1 0 2.3'
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.calibration.fit import Characterisation
    from illuminant.display.calibration.readings import Readings
    from illuminant.display.calibration.report import Chart
    from illuminant.display.displays import Display

    Array = NDArray[np.float64]

__all__ = ["Described", "chart_codes", "read_chart", "save", "save_icc", "to_display"]

BITS = 8
"""Of the codes of a chart that verifies a description."""


def to_display(model: Characterisation, name: str) -> Display:
    """The display of a fit.

    Raises:
        UsageError: no display can have these numbers.
    """
    from illuminant import color
    from illuminant.display.displays import Display

    def pair(xyz: Array) -> tuple[float, float]:
        x, y = color.xyz_to_xyy(xyz)[:2].round(6).tolist()
        return x, y

    red, green, blue = (pair(row) for row in model.primaries)
    added, black = model.primaries.sum(axis=0), max(0.0, float(model.black[1]))
    first, second, third = (
        f"gain-offset-gamma {gain:.6g} {1.0 - gain:.6g} {gamma:.6g}"
        for gain, gamma in zip(model.gain.tolist(), model.gamma.tolist(), strict=True)
    )
    return Display(
        name,
        (red, green, blue),
        pair(added),
        (first, second, third),
        peak=float(f"{float(added[1]) + black:.6g}"),
        black=float(f"{black:.6g}"),
    )


def save(path: str | os.PathLike[str], model: Characterisation, name: str) -> None:
    """Write the description as a TOML file that `illuminant.display.displays.named` reads, atomically."""
    to_display(model, name).save(path, "Described by readings (`illuminant calibrate fit`).")


def save_icc(path: str | os.PathLike[str], model: Characterisation, name: str) -> None:
    """Write the description as an ICC profile, atomically."""
    from illuminant.display import profile

    output.write_bytes(path, profile.encode(to_display(model, name)))


class Described:
    """A `Display` in the words of a report: amounts of primaries, code values, the brightest white it reaches."""

    def __init__(self, display: Display) -> None:
        self.display = display

    def linear(self, xyz: Any) -> Array:
        """How much of each primary a colour (..., 3) in cd/m² needs."""
        return self.display.from_xyz(xyz)

    def codes(self, linear: Any) -> Array:
        """Code values (..., 3) of amounts of the primaries, clamped to 0 to 1."""
        import numpy as np

        return np.clip(self.display.encode(np.clip(linear, 0.0, 1.0)), 0.0, 1.0)

    def reachable(self, xy: tuple[float, float]) -> float:
        """The highest luminance of a white of this chromaticity, cd/m²."""
        import numpy as np

        from illuminant import color

        white = np.array(color.white_xyz(xy))
        # Amounts rise in proportion to luminance, from those of no light at all, which are below 0 where black is not.
        none, peak = self.display.from_xyz(np.zeros(3)), self.display.from_xyz(white * self.display.peak)
        slope = (peak - none) / self.display.peak
        if (slope <= 0).any():
            raise UsageError(f"A white at x, y = {xy[0]:g}, {xy[1]:g} lies outside the display's gamut.")
        return float(((1.0 - none) / slope).min())


def chart_codes(path: str | os.PathLike[str]) -> Array:
    """Code values (24, 3), exact codes of 8 bits, of the ColorChecker through a description."""
    import numpy as np

    from illuminant.display.calibration.report import chart_codes as through
    from illuminant.display.displays import named

    codes = through(Described(named(Path(path))))[0]
    most = 2**BITS - 1
    return np.asarray(np.round(codes * most) / most)


def read_chart(path: str | os.PathLike[str], readings: Readings) -> Chart:
    """The ColorChecker through a description, as it was read.

    Args:
        path: of the description.
        readings: of the code values of `chart_codes`, in any order.

    Raises:
        DataError: a patch was not read.
    """
    import numpy as np

    from illuminant.display.calibration.report import described_chart
    from illuminant.display.displays import named
    from illuminant.display.patterns.color_checker import NAMES

    rows = []
    for name, code in zip(NAMES, chart_codes(path), strict=True):
        near = np.abs(readings.codes - code).max(axis=1)
        if not near.min() < 1e-4:
            shown = ",".join(str(round(value * (2**BITS - 1))) for value in code.tolist())
            raise DataError(
                f"There is no reading of {name}, code {shown}: were these codes made by another description?",
                readings.file,
            )
        rows.append(readings.xyz[near == near.min()].mean(axis=0))
    read = np.array(rows)
    return described_chart(lambda _: read, Described(named(Path(path))))
