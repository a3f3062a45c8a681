"""The colours of light on a display: of one wavelength, or of any tristimulus values, clipped to sRGB.

No display shows light of one wavelength. Its tristimulus values are taken to linear sRGB; what is negative there, the
part outside the gamut, becomes 0; and the core encodes the rest. Inside the gamut of sRGB the chromaticity is exact,
outside of it the colour is the nearest in this sense, and no more.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant import rgb_system
from illuminant.display.look import Look, show

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.plots.observer import Functions

__all__ = ["brightest", "spectrum"]


def brightest(xyz: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Code values of sRGB (h, w, 3) of colours (h, w, 3), each as bright as sRGB can show its chromaticity.

    Every colour is scaled so that the largest of its three values is 1, then those below 0 are clipped. Black, and what
    is not finite, stays black.

    Example:
        >>> import numpy as np
        >>> brightest(np.array([[[0.95047, 1.0, 1.08883], [0.0, 0.0, 0.0]]])).tolist()
        [[[255, 255, 255], [0, 0, 0]]]
    """
    import numpy as np

    finite = np.where(np.isfinite(xyz), xyz, 0.0)
    linear = finite @ np.asarray(rgb_system.named("sRGB")["from_xyz"]).T
    largest = linear.max(axis=-1, keepdims=True)
    scaled = np.where(largest > 0, finite / np.where(largest > 0, largest, 1.0), 0.0)
    return np.asarray(show(scaled, Look(gamut="clamp")).picture.codes, np.uint8)


def spectrum(observer: Functions, wavelengths_nm: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Code values of sRGB (n, 3) of light of equal power at each wavelength (n,), black where the eye sees none.

    The power is the largest at which no channel of any wavelength passes 1.

    Example:
        >>> import numpy as np
        >>> from illuminant.plots.observer import named
        >>> spectrum(named(), np.array([300.0, 400.0, 550.0, 650.0])).tolist()
        [[0, 0, 0], [22, 0, 63], [0, 255, 0], [191, 0, 0]]
    """
    import numpy as np

    xyz = observer.at(wavelengths_nm)[np.newaxis]
    largest = (xyz @ np.asarray(rgb_system.named("sRGB")["from_xyz"]).T).max()
    return np.asarray(show(xyz / max(largest, 1e-12), Look(gamut="clamp")).picture.codes[0], np.uint8)
