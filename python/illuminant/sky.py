"""The clear sky and the sun in it: the spectral model of Hošek and Wilkie (2012, 2013), over arrays.

`[lights.NAME]` with `kind = "sky"` shines with these numbers. Angles are radians, wavelengths nm, radiances absolute.
Between the wavelengths of the published tables (320 to 720 nm in steps of 40) radiance is linear, beyond them it is
that of the nearest.

Example:
    >>> from math import pi
    >>> blue, red = sky_radiance(pi / 4, 1.0, [440.0, 680.0], elevation=0.8)
    >>> bool(blue > 2 * red)
    True
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from illuminant.optics import _call

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Values = float | NDArray[np.float64]

__all__ = ["SUN_RADIUS", "sky_radiance", "sun_radiance"]

SUN_RADIUS = 0.255 * pi / 180.0
"""Half the angle across the sun, radians."""

TURBIDITY = (1.0, 10.0)
FRACTION = (0.0, 1.0)
ANGLE = (0.0, pi)
HEIGHT = (0.0, pi / 2)
WAVELENGTH = (1.0, 1e6)


def sky_radiance(
    theta: ArrayLike,
    gamma: ArrayLike,
    wavelength_nm: ArrayLike,
    *,
    elevation: ArrayLike,
    turbidity: ArrayLike = 3.0,
    ground_albedo: ArrayLike = 0.2,
) -> Values:
    """Radiance of the sky, W·sr⁻¹·m⁻²·nm⁻¹ (Hošek and Wilkie 2012, eq 8); 0 below the horizon.

    Args:
        theta: angle from the zenith, 0 to π.
        gamma: angle from the sun.
        wavelength_nm: wavelength.
        elevation: of the sun above the horizon, 0 to π/2.
        turbidity: 1 (pure air) to 10 (haze).
        ground_albedo: what the ground reflects, 0 to 1.

    Example:
        >>> sky_radiance(2.0, 1.0, 550.0, elevation=0.8)
        0.0
    """
    ranges = {
        "turbidity": TURBIDITY,
        "ground_albedo": FRACTION,
        "elevation": HEIGHT,
        "theta": ANGLE,
        "gamma": ANGLE,
        "wavelength_nm": WAVELENGTH,
    }
    return _call("sky", ranges, turbidity, ground_albedo, elevation, theta, gamma, wavelength_nm)


def sun_radiance(
    elevation: ArrayLike, gamma: ArrayLike, wavelength_nm: ArrayLike, *, turbidity: ArrayLike = 3.0
) -> Values:
    """Radiance of the sun's disc, W·sr⁻¹·m⁻²·nm⁻¹ (Hošek and Wilkie 2013), darker towards its limb; 0 outside.

    Args:
        elevation: of the direction of view above the horizon, 0 to π/2.
        gamma: angle from the middle of the disc.
        wavelength_nm: wavelength.
        turbidity: 1 to 10.

    Example:
        >>> bool(sun_radiance(0.8, 0.9 * SUN_RADIUS, 550.0) < sun_radiance(0.8, 0.0, 550.0))
        True
    """
    ranges = {"turbidity": TURBIDITY, "elevation": HEIGHT, "gamma": ANGLE, "wavelength_nm": WAVELENGTH}
    return _call("sun", ranges, turbidity, elevation, gamma, wavelength_nm)
