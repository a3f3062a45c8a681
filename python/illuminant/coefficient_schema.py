"""What a scene may tell the historical illumination models, instead of what the rule makes of a material.

The rule (docs/models.md) derives the coefficients of every model from the physics of a surface; what a table
`[materials.NAME.coefficients.MODEL]` states stands instead.

Example:
    >>> from illuminant.coefficient_schema import Coefficients
    >>> Coefficients.model_validate({"diffuse": 0.35, "specular": 0.95, "exponent": 330.0}).specular
    0.95
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from illuminant.spectrum_schema import SpectrumValue
from illuminant.table import Table, key

__all__ = ["ALL_MODELS", "Coefficients"]

ALL_MODELS = "all"
"""The name that stands for all historical models; what is said of one by its own name wins."""

Multiplier = Annotated[float, Field(ge=0, le=100)]


class Coefficients(Table):
    """Coefficients for one model; what is absent follows the rule."""

    ambient: Multiplier | None = key("multiplier C_Ka of ambient light", "0.35", None)
    diffuse: Multiplier | None = key("multiplier C_Kd of the diffuse term", "0.35", None)
    specular: Multiplier | None = key("multiplier C_Ks of the specular term", "0.95", None)
    transmitted: Multiplier | None = key("multiplier C_Kt of what is let through", "0.9", None)
    diffuse_curve: SpectrumValue | None = key("K_a and K_d: fraction of light, 0 to 1", '"book/copper"', None)
    specular_curve: SpectrumValue | None = key(
        "K_s, for models with Fresnel's equations at normal incidence: fraction of light, 0 to 1",
        '"book/copper"',
        None,
    )
    transmitted_curve: SpectrumValue | None = key("K_t: fraction of light, 0 to 1", "0.9", None)
    half_angle_deg: Annotated[float, Field(gt=0, lt=90)] | None = key(
        "angle β between the normal and H at which the highlight has half its strength", "8.0", None
    )
    exponent: Annotated[float, Field(gt=0, le=1_000_000)] | None = key(
        "N_s of the highlight (C₁, C₂² or m² of other distributions), instead of `half_angle_deg`",
        "80.0",
        None,
    )
    distribution: Literal["phong", "blinn", "gaussian", "trowbridge-reitz", "cook"] | None = key(
        "distribution of the highlight; default that with which the model was published",
        '"trowbridge-reitz"',
        None,
    )
    masking: Literal["none", "torrance-sparrow", "sancer"] | None = key(
        "masking of facets; default that with which the model was published", '"torrance-sparrow"', None
    )
    terminator: Annotated[float, Field(ge=1, le=5)] | None = key(
        "p of (N·L)^p; a little above 1 hides the Mach band where light ends", "1.5", None
    )
