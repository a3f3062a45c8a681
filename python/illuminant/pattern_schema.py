"""Patterns that a function makes, as the scene file has them: in place of a reflectance or a roughness, and for relief.

Example:
    >>> from illuminant.pattern_schema import ColourPattern
    >>> table = {"pattern": "marble", "colours": [0.1, 0.8], "scale": 0.2}
    >>> ColourPattern.model_validate(table).octaves
    6
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from illuminant.spectrum_schema import SpectrumValue
from illuminant.table import Fraction, Number, Positive, Table, Vector, key

__all__ = ["ColourPattern", "HeightPattern", "PatternOnSurface", "SlopePattern"]


class PatternOnSurface(Table):
    """A number from 0 to 1 at every point of space, as if the object were carved out of a block, or of the surface."""

    pattern: Literal["noise", "turbulence", "marble", "wood", "checker", "stripes"] = key(
        "`noise` and `turbulence` (Perlin 1985), waves that they shift (`marble` along the axis, `wood` around it), or "
        "`checker` and `stripes` (along the axis)",
        '"marble"',
    )
    coordinates: Literal["solid", "uv"] = key(
        "what it depends on: the place in the scene, or texture coordinates; what moves takes its pattern along",
        '"uv"',
        "solid",
    )
    scale: Positive = key(
        "size of a field or a wave: in length units, or in texture coordinates", "0.25", 1.0
    )
    origin: Vector = key(
        "where its origin lies, in length units or texture coordinates", "[0.0, 0.3, 0.0]", [0.0] * 3
    )
    axis: Vector | None = key("axis of layers and rings; default the scene's `up`", "[1.0, 0.2, 0.0]", None)
    octaves: Annotated[int, Field(ge=1, le=16)] = key(
        "sizes of noise, each half of the one before; what is finer than a pixel fades to its mean", "4", 6
    )
    amplitude: Number = key("how far noise shifts waves, in waves", "0.5", 1.0)


class ColourPattern(PatternOnSurface):
    """A pattern in place of a reflectance, a pigment or a transmittance: between two of them, in every wavelength."""

    colours: Annotated[list[SpectrumValue], Field(min_length=2, max_length=2)] = key(
        "where the pattern is 0, and where it is 1", '["ColorChecker/black 2", 0.8]'
    )


class SlopePattern(PatternOnSurface):
    """A pattern in place of a roughness."""

    black: Fraction = key("roughness where the pattern is 0", "0.05", 0.0)
    white: Fraction = key("roughness where the pattern is 1", "0.4", 1.0)


class HeightPattern(PatternOnSurface):
    """A pattern of heights, which perturb the normal; the outline stays as it is."""

    height: Number = key("height of the value 1 above the value 0, in length units", "0.002")


def is_pattern(value: Any) -> bool:
    """Whether a value of a scene file is meant as a pattern."""
    return isinstance(value, PatternOnSurface) or (isinstance(value, dict) and "pattern" in value)
