"""The quantities by which an emitter or a light states how strong it is, and which kinds they fit.

A spectrum gives the colour of light; exactly one quantity gives its amount. The core computes the factor that makes
the spectrum absolute (radiance in W·sr⁻¹·m⁻²·nm⁻¹), with lumens, candelas and lux integrated at 1 nm against
683 lm/W times the CIE 1931 ȳ; here stands only which quantity means what, and for which kind of source.

Example:
    >>> from illuminant.quantities import FITTING
    >>> FITTING["directional"]
    ('illuminance_lx', 'irradiance_w_m2')
"""

from __future__ import annotations

__all__ = ["FITTING", "QUANTITIES"]

QUANTITIES: dict[str, str] = {
    "power_w": "radiant power over the whole source and the scene's wavelength range, in W",
    "flux_lm": "luminous flux over the whole source, in lm",
    "intensity_cd": "luminous intensity (for a spot: on its axis), in cd",
    "illuminance_lx": "illuminance on a plane that faces the light (an environment: on a horizontal plane), in lx",
    "irradiance_w_m2": "irradiance on a plane that faces the light, over the scene's wavelength range, in W/m²",
    "luminance_cd_m2": "luminance of the surface or of the sky (an image: of its RGB (1, 1, 1)), in cd/m²",
    "radiance_scale": "factor on a spectrum that is itself absolute, in W·sr⁻¹·m⁻²·nm⁻¹",
}
"""Every quantity key and what it states."""

FITTING: dict[str, tuple[str, ...]] = {
    "emitter": ("power_w", "flux_lm", "luminance_cd_m2", "radiance_scale"),
    "point": ("power_w", "flux_lm", "intensity_cd"),
    "spot": ("power_w", "flux_lm", "intensity_cd"),
    "directional": ("illuminance_lx", "irradiance_w_m2"),
    "environment": ("luminance_cd_m2", "illuminance_lx", "radiance_scale"),
    "environment image": ("luminance_cd_m2",),
    "fog": ("luminance_cd_m2", "radiance_scale"),
}
"""The quantity keys that each kind of source takes; the other keys are refused there with a sentence."""
