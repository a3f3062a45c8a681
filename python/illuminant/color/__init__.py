"""Colours: spaces, systems, whites, differences, and spectra to XYZ; for one colour or a whole image.

| module | what is in it |
| --- | --- |
| `rgb` | RGB systems and monitors, XYZ and back, monitor to monitor, transfer functions, matrices |
| `whites`, `adaptation` | whites by name, x y or XYZ; von Kries, Bradford, CAT16 |
| `chromaticity` | xyY, u′v′Y, projection onto the plane of sum 1 |
| `uniform`, `differences` | L*a*b*, L*u*v*; ΔE 1976, 1994, 2000 and in L*u*v* |
| `solids` | HSV, and HSL in three solids |
| `axes` | YIQ, Y R−Y B−Y, AC₁C₂ |
| `spectral`, `matching` | spectra to XYZ; matching with three lights |
| `munsell` | Munsell notation (optional) |
| `triples` | rules on shapes, types, `out=` and NaN that all of them keep |

All public names are here too. Tristimulus values are relative, with Y = 1 for a perfect diffuser or the white, unless
it is said otherwise; functions that multiply only take any unit.

Example:
    >>> from illuminant import color
    >>> xyz = color.rgb_to_xyz([0.5, 0.25, 0.75], "sRGB", encoded=True)
    >>> lab = color.xyz_to_lab(xyz, "D65")
    >>> lab.round(2).tolist()
    [41.16, 51.41, -56.45]
    >>> round(float(color.delta_e_2000(lab, color.xyz_to_lab([0.1, 0.1, 0.1]))), 2)
    28.79
"""

from illuminant.color.adaptation import adapt, adaptation_matrix
from illuminant.color.axes import (
    ac1c2_to_xyz,
    monochrome,
    rgb_to_yiq,
    rgb_to_yvu,
    xyz_to_ac1c2,
    yiq_matrix,
    yiq_to_rgb,
    yvu_to_rgb,
)
from illuminant.color.chromaticity import chromaticity, uvy_to_xyz, xyy_to_xyz, xyz_to_uvy, xyz_to_xyy
from illuminant.color.differences import delta_e_1976, delta_e_1994, delta_e_2000, delta_e_luv
from illuminant.color.matching import matching_amounts, matching_functions, primaries_to_xyz
from illuminant.color.munsell import Munsell, munsell_to_xyz, parse_munsell, xyz_to_munsell
from illuminant.color.rgb import (
    RgbSystem,
    concatenate,
    decode,
    encode,
    inverse,
    monitor,
    published_matrix,
    rgb_to_rgb,
    rgb_to_rgb_matrix,
    rgb_to_xyz,
    system,
    systems,
    transform,
    xyz_to_rgb,
)
from illuminant.color.solids import hsl_to_rgb, hsv_to_rgb, rgb_to_hsl, rgb_to_hsv
from illuminant.color.spectral import observer_table, observers, spectra_to_xyz, spectral_weights
from illuminant.color.uniform import lab_to_xyz, luv_to_xyz, xyz_to_lab, xyz_to_luv
from illuminant.color.whites import white_xyz

__all__ = [
    "Munsell",
    "RgbSystem",
    "ac1c2_to_xyz",
    "adapt",
    "adaptation_matrix",
    "chromaticity",
    "concatenate",
    "decode",
    "delta_e_1976",
    "delta_e_1994",
    "delta_e_2000",
    "delta_e_luv",
    "encode",
    "hsl_to_rgb",
    "hsv_to_rgb",
    "inverse",
    "lab_to_xyz",
    "luv_to_xyz",
    "matching_amounts",
    "matching_functions",
    "monitor",
    "monochrome",
    "munsell_to_xyz",
    "observer_table",
    "observers",
    "parse_munsell",
    "primaries_to_xyz",
    "published_matrix",
    "rgb_to_hsl",
    "rgb_to_hsv",
    "rgb_to_rgb",
    "rgb_to_rgb_matrix",
    "rgb_to_xyz",
    "rgb_to_yiq",
    "rgb_to_yvu",
    "spectra_to_xyz",
    "spectral_weights",
    "system",
    "systems",
    "transform",
    "uvy_to_xyz",
    "white_xyz",
    "xyy_to_xyz",
    "xyz_to_ac1c2",
    "xyz_to_lab",
    "xyz_to_luv",
    "xyz_to_munsell",
    "xyz_to_rgb",
    "xyz_to_uvy",
    "xyz_to_xyy",
    "yiq_matrix",
    "yiq_to_rgb",
    "yvu_to_rgb",
]
