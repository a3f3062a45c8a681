"""Figure 5.2: the ColorChecker with its XYZ, as printed and from measured reflectances (book section 5.1.1).

The printed values are scaled so that the white patch has Y = 1 and the black one Y = 0, with chromaticity kept:
Y' = (Y − Y_black) / (Y_white − Y_black).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

LIGHT = "C"
"""The printed table is relative to illuminant C (ERRATA 59)."""


def between_black_and_white(xyz: NDArray[np.float64]) -> NDArray[np.float64]:
    """XYZ (24, 3) scaled to Y = 0 for the last patch, and Y = 1 for the white, the nineteenth."""
    import numpy as np

    luminance = (xyz[:, 1] - xyz[23, 1]) / (xyz[18, 1] - xyz[23, 1])
    return np.asarray(xyz * (luminance / xyz[:, 1])[:, None])


def draw(quick: bool) -> Sheet:
    """The chart from the printed XYZ, taken as they stand and adapted from C, and from measured reflectances."""
    import numpy as np

    from illuminant import color, plots
    from illuminant.display.patterns import color_checker
    from illuminant.display.patterns.screen import Screen

    printed = np.array(color_checker.BOOK)
    lamp = color.white_xyz(LIGHT)
    curves = color_checker.reflectances()
    own = between_black_and_white(
        np.asarray(
            color.spectra_to_xyz(
                np.stack([curve.values for curve in curves]), curves[0].wavelengths_nm, illuminant=LIGHT
            )
        )
    )
    delta_e = np.asarray(color.delta_e_2000(color.xyz_to_lab(printed, lamp), color.xyz_to_lab(own, lamp)))
    white = np.asarray(color.chromaticity(printed[18]))[:2]
    ntsc = np.asarray(color.xyz_to_rgb(printed[18], "book NTSC"))
    size = (192, 130) if quick else (288, 194)
    pictures = []
    for chart, light in (("book", "D65"), ("book adapted", "D65"), ("measured", "D65")):
        screen = Screen(*size, display_name="sRGB")
        values = color_checker.color_checker(screen, chart=chart, light=light)
        pictures.append(np.asarray(np.round(255 * values), np.uint8))
    return Sheet(
        picture=plots.picture_sheet(
            pictures,
            (
                "XYZ as printed, shown beside D65:\na bluish white, beyond the display",
                f"as printed, adapted from C to D65;\nmean ΔE00 {delta_e.mean():.1f} from measurements",
                "today: measured reflectances\nunder D65 (mean of 30 charts)",
            ),
            columns=3,
        ),
        columns={
            "patch": list(color_checker.NAMES),
            **{f"{name}, printed": printed[:, i] for i, name in enumerate("XYZ")},
            **{f"{name}, measured, scaled": own[:, i] for i, name in enumerate("XYZ")},
            "ΔE00": delta_e,
        },
        checks=(
            Check("mean ΔE00 of printed and measured, under C", float(delta_e.mean()), at_most=3.0),
            Check(
                "distance of the printed white from C in xy",
                float(np.hypot(*(white - np.asarray(color.chromaticity(lamp))[:2]))),
                at_most=0.001,
            ),
            Check(
                "its blue on the book's monitor with a white of D6500",
                float(ntsc[2]),
                at_least=1.09,
                at_most=1.1,
            ),
            Check("its green there", float(ntsc[1]), at_least=0.965, at_most=0.975),
        ),
    )


PLATE = Plate(
    number="5.2",
    title="ColorChecker chart with XYZ",
    shows="The 24 patches of the Macbeth ColorChecker with the XYZ printed for them, scaled so that the white patch "
    "has Y = 1 and the black one is black, for checking a monitor's matrix.",
    claim="The printed values agree with measured reflectances under illuminant C, and so do not fit the monitor of "
    "D6500 that they are printed for: its white would be blue, with RGB (1.030, 0.969, 1.096).",
    printed="The table is said to be scaled for the monitor, whose white is D6500; its own white patch has x, y = "
    "0.310, 0.316, which is illuminant C.",
    today="Patches are measured reflectances under any lamp, adapted to the white of the display (Bradford); what a "
    "display cannot show is named, as cyan with sRGB.",
    draw=draw,
    commands=(
        "illuminant pattern colorchecker --chart book -o book.png",
        "illuminant render scenes/colorchecker-d65.toml -o checker.png",
    ),
)
