"""The three control lights of book section 3.2, and what share of the spectral colours' diagram a triangle covers.

The book chose 445, 535 and 630 nm to show the principle; no experiment was made with them. Their matching functions
follow from those of the CIE's observer by a matrix (book eq 3.1), as those of any three lights do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.plots.diagram import Diagram

__all__ = ["LIGHTS_NM", "covered"]

LIGHTS_NM = (445.0, 535.0, 630.0)
"""L, M and H: low, medium and high wavelength."""


def covered(plane: Diagram, corners: NDArray[np.float64]) -> float:
    """The area of a polygon (n, 2) of a diagram over that which the spectral colours and the purples enclose.

    Example:
        >>> from illuminant.plots.diagram import diagram
        >>> plane = diagram("xy")
        >>> round(covered(plane, plane.gamut("sRGB")[1]), 3)
        0.335
    """
    return _area(corners) / _area(plane.spectral_locus()[1])


def _area(corners: NDArray[np.float64]) -> float:
    import numpy as np

    x, y = corners.T
    return float(abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2)
