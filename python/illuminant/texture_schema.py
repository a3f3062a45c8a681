"""Images on surfaces as the scene file has them: in place of a reflectance, of a roughness, and for relief.

Example:
    >>> from illuminant.texture_schema import ColourImage
    >>> ColourImage.model_validate({"image": "tiles.png", "repeat": [4, 4]}).wrap
    'repeat'
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from illuminant.pattern_schema import ColourPattern, HeightPattern, SlopePattern, is_pattern
from illuminant.spectrum_schema import SpectrumTable, SpectrumValue, spectrum_form
from illuminant.table import Fraction, Number, Table, key

__all__ = [
    "ColourImage",
    "ColourValue",
    "HeightImage",
    "HeightValue",
    "NormalImage",
    "SlopeImage",
    "SlopeValue",
]

Two = Annotated[list[Number], Field(min_length=2, max_length=2)]


class ImageOnSurface(Table):
    """An image over the unit square of texture coordinates: u to the right and v up from its lower left corner."""

    image: Any = key("file of any format that OpenImageIO reads, beside the scene file", '"images/tiles.png"')
    wrap: Literal["repeat", "clamp", "mirror"] = key(
        "what lies beyond the border: the image again, its border, or its mirror image", '"clamp"', "repeat"
    )
    repeat: Two = key("how often it stands along u and along v", "[4.0, 4.0]", [1.0, 1.0])
    offset: Two = key("where its lower left corner lies, in images", "[0.5, 0.0]", [0.0, 0.0])
    filtering: Literal["pyramid", "summed-area"] = key(
        "how the mean over a pixel is found: in a pyramid of smaller images along the pixel's ellipse (Williams 1983), "
        "or over the box around it from a table of sums (Crow 1984)",
        '"summed-area"',
        "pyramid",
    )


class ColourImage(ImageOnSurface):
    """An image in place of a reflectance, a pigment or a transmittance.

    Its channels are parts of three curves, so that a colour seen from far away has the spectrum of all that it is the
    mean of. By default they are the smoothest reflectances that are the primaries of sRGB under D65, `sRGB/red`,
    `sRGB/green` and `sRGB/blue`. Whole numbers (PNG, JPEG) are decoded, floating point is taken as linear.
    """

    encoding: Literal["encoded", "linear"] | None = key(
        "whether values are encoded as `rgb_system` says, or linear; default by the file", '"linear"', None
    )
    rgb_system: str | None = key('RGB system of the image; default "sRGB"', '"Rec.2020"', None)
    basis: Annotated[list[SpectrumValue], Field(min_length=3, max_length=3)] | None = key(
        "measured reflectances of which the channels are the parts, instead of colours",
        '["ColorChecker/red", "ColorChecker/white 9.5", "ColorChecker/black 2"]',
        None,
    )


class SlopeImage(ImageOnSurface):
    """An image in place of a roughness: not decoded, black is `black` and white is `white`."""

    channel: Literal["r", "g", "b"] = key("which channel", '"g"', "r")
    black: Fraction = key("roughness of the value 0", "0.05", 0.0)
    white: Fraction = key("roughness of the value 1", "0.4", 1.0)


class HeightImage(ImageOnSurface):
    """An image of heights, which perturb the normal (Blinn 1978): not decoded, and the outline stays as it is."""

    channel: Literal["r", "g", "b"] = key("which channel", '"g"', "r")
    height: Number = key("height of the value 1 above the value 0, in length units", "0.002")


class NormalImage(ImageOnSurface):
    """An image of normals: (n + 1)/2 with n along u, along v and away from the surface; not decoded."""

    strength: Number = key("factor on its slopes; 0 is flat", "0.5", 1.0)


def _colour_form(value: Any) -> str | None:
    if is_pattern(value):
        return "<pattern>"
    if isinstance(value, ColourImage) or (isinstance(value, dict) and "image" in value):
        return "<image>"
    return spectrum_form(value)


ColourValue = Annotated[
    Annotated[str, Tag("<name>")]
    | Annotated[float, Tag("<constant>")]
    | Annotated[SpectrumTable, Tag("<table>")]
    | Annotated[ColourImage, Tag("<image>")]
    | Annotated[ColourPattern, Tag("<pattern>")],
    Discriminator(
        _colour_form,
        custom_error_type="spectrum_form",
        custom_error_message="must be a spectrum (a name, a number, or a table such as { rgb = [0.6, 0.2, 0.1], "
        'role = "albedo" }), an image such as { image = "tiles.png" } or a pattern such as { pattern = "marble", '
        "colours = [0.1, 0.8] }",
    ),
]
"""A spectrum, or an image or a pattern of colours."""


def _slope_form(value: Any) -> str | None:
    if is_pattern(value):
        return "<pattern>"
    if isinstance(value, (dict, SlopeImage)):
        return "<image>"
    return "<constant>" if isinstance(value, (int, float)) and not isinstance(value, bool) else None


SlopeValue = Annotated[
    Annotated[Fraction, Tag("<constant>")]
    | Annotated[SlopeImage, Tag("<image>")]
    | Annotated[SlopePattern, Tag("<pattern>")],
    Discriminator(
        _slope_form,
        custom_error_type="slope_form",
        custom_error_message='must be a number from 0 to 1, or an image such as { image = "scratches.png" }',
    ),
]
"""A roughness, or an image or a pattern of it."""


def _height_form(value: Any) -> str | None:
    if is_pattern(value):
        return "<pattern>"
    return "<image>" if isinstance(value, (dict, HeightImage)) else None


HeightValue = Annotated[
    Annotated[HeightImage, Tag("<image>")] | Annotated[HeightPattern, Tag("<pattern>")],
    Discriminator(
        _height_form,
        custom_error_type="height_form",
        custom_error_message='must be an image of heights such as { image = "dents.png", height = 0.001 }, or a '
        'pattern such as { pattern = "noise", height = 0.001 }',
    ),
]
"""An image or a pattern of heights."""
